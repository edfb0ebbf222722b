//! Figures 7 to 10: how far a small change carries.

use super::data::Data;
use super::law::Law;
use super::motion::{apart, simulate};
use super::plant::Experiment;
use super::replay::Own;
use super::truth::{ARM, BACK_EMF, FIGURE_7, FIGURE_7_C1, FIGURE_8, FIGURE_9_C1, FIGURE_10, RATE};
use crate::paper::Error;

/// A figure of section 5: a motion, and one with a small change.
#[derive(Debug, Clone)]
pub struct Change {
    /// Number of the figure.
    pub figure: u32,
    /// What is changed.
    pub what: &'static str,
    /// By how much.
    pub by: f64,
    /// The solid and the dotted graph, rad.
    pub paths: [Vec<f64>; 2],
}

impl Change {
    /// Largest distance of both, rad.
    #[must_use]
    pub fn apart(&self) -> f64 {
        apart(&self.paths[0], &self.paths[1])
    }

    /// When they are a tenth of a radian apart, s after the start.
    #[must_use]
    pub fn parted(&self) -> Option<f64> {
        let mut pairs = self.paths[0].iter().zip(&self.paths[1]);
        let sample = pairs.position(|(x, y)| (x - y).abs() > 0.1)?;
        Some(sample as f64 / RATE)
    }
}

/// Parameters of the arm in model (5.1): the back-EMF is not friction there.
fn own() -> [f64; 4] {
    let [alpha, beta, c1, c2] = ARM;
    [alpha, beta, c1 - BACK_EMF * beta, c2 - BACK_EMF * beta]
}

/// Where figures start, and what drives them.
struct Runs {
    angle: f64,
    /// The arm's, which a log with steps of an encoder does not tell, rad/s.
    velocity: f64,
    measured: Vec<f64>,
    commanded: Vec<f64>,
}

impl Runs {
    fn of(experiment: &Experiment, data: &Data) -> Self {
        let part = |input: &[f64]| input[data.window.clone()].to_vec();
        Self {
            angle: data.start()[0],
            velocity: experiment.velocity[data.window.start],
            measured: part(&data.u),
            commanded: part(&data.wave),
        }
    }

    fn path(&self, values: [f64; 4], velocity: f64, is_second: bool) -> Result<Vec<f64>, Error> {
        let drive = if is_second {
            &self.commanded
        } else {
            &self.measured
        };
        let plant = Law::Directional.plant(&values)?;
        Ok(simulate(plant, [self.angle, velocity], drive, is_second)?.angle)
    }

    /// A figure of a change of `c1`, and one of a change of the initial velocity.
    fn both(
        &self,
        (values, velocity): ([f64; 4], f64),
        by: [f64; 2],
        figures: [u32; 2],
        what: [&'static str; 2],
    ) -> Result<[Change; 2], Error> {
        let is_second = figures[0] == 9;
        let mut other = values;
        other[2] += by[0];
        let solid = self.path(values, velocity, is_second)?;
        let dotted = [
            self.path(other, velocity, is_second)?,
            self.path(values, velocity + by[1], is_second)?,
        ];
        let [c1, start] = dotted.map(|dotted| [solid.clone(), dotted]);
        let change = |k: usize, paths| Change {
            figure: figures[k],
            what: what[k],
            by: by[k],
            paths,
        };
        Ok([change(0, c1), change(1, start)])
    }

    /// Figures 7 and 8 with the arm's own parameters and its own velocity at the start.
    fn own(&self) -> Result<[Change; 2], Error> {
        let what = [
            "c1, (5.1), the arm's own, noisy log",
            "velocity, (5.1), the arm's own, noisy log",
        ];
        self.both((own(), self.velocity), SMALL, [7, 8], what)
    }
}

/// Changes of figures 7 and 8, and of 9 and 10.
const SMALL: [f64; 2] = [FIGURE_7_C1 - FIGURE_7[2], FIGURE_8[1] - FIGURE_8[0]];
const LARGE: [f64; 2] = [FIGURE_9_C1 - ARM[2], FIGURE_10[1] - FIGURE_10[0]];

/// Figures 7 and 8 of an arm with their parameters, along its own current and from its own start at 1.67 s.
fn replayed(own: &Own) -> Result<[Change; 2], Error> {
    let [angle, velocity] = own.start;
    let mut values = FIGURE_7;
    values[2] += SMALL[0];
    let change = |figure, what, by, dotted| Change {
        figure,
        what,
        by,
        paths: [own.path.clone(), dotted],
    };
    let [c1, start] = [
        own.again(&values, own.start)?,
        own.again(&FIGURE_7, [angle, velocity + SMALL[1]])?,
    ];
    Ok([
        change(7, "c1, (5.1), along the arm's own current", SMALL[0], c1),
        change(
            8,
            "velocity, (5.1), along the arm's own current",
            SMALL[1],
            start,
        ),
    ])
}

/// Figures 7 and 8 of an arm that has the printed parameters, and figures 9 and 10 from the measured position at 1.67 s; then, as a remark,
/// 7 and 8 along the noisy log of the arm of Table 2, with the printed parameters and with its own.
///
/// The printed parameters of figures 7 and 8 are of the paper's log. On another arm's the arm falls soon with them, and what has fallen is
/// less sensitive than what is held up.
///
/// # Errors
/// Where the simulator stops.
pub fn changes(experiment: &Experiment, data: &Data) -> Result<[Change; 8], Error> {
    let runs = Runs::of(experiment, data);
    let replayed = replayed(&Own::new(data.window.start, data.window.len())?)?;
    let of_printed = [
        "c1, (5.1), as printed, noisy log",
        "velocity, (5.1), as printed, noisy log",
    ];
    let of_second = ["c1, (5.2)", "velocity, (5.2)"];
    let [a, b] = runs.both((FIGURE_7, FIGURE_8[0]), SMALL, [7, 8], of_printed)?;
    let [c, d] = runs.own()?;
    let [e, f] = runs.both((ARM, FIGURE_10[0]), LARGE, [9, 10], of_second)?;
    let [first, second] = replayed;
    Ok([first, second, e, f, a, b, c, d])
}

/// Changes of the initial velocity of figure 8, rad/s, to both sides.
const NEARBY: [f64; 5] = [0.001, 0.002, 0.005, 0.01, 0.02];

/// How far changes of figure 8 carry that are smaller and larger than the printed one, and less than nothing: the change, rad/s, and the largest
/// distance, rad. The motion is nearly chaotic, so that no one of them says how far.
///
/// # Errors
/// Where the simulator stops.
pub fn nearby(data: &Data) -> Result<Vec<[f64; 2]>, Error> {
    let own = Own::new(data.window.start, data.window.len())?;
    let [angle, velocity] = own.start;
    let changes = NEARBY.iter().rev().map(|by| -by).chain(NEARBY);
    let distance = |by: f64| -> Result<[f64; 2], Error> {
        let path = own.again(&FIGURE_7, [angle, velocity + by])?;
        Ok([by, apart(&own.path, &path)])
    };
    changes.map(distance).collect()
}

/// How far changes carry in figures 7 and 8 with the arm's own parameters, on logs of other noise, rad, from the least on. How soon the arm
/// falls along a measured input depends on the noise in it, and an arm that hangs down is not sensitive.
///
/// # Errors
/// Where the simulator stops.
pub fn carried(seeds: std::ops::Range<u64>) -> Result<[Vec<f64>; 2], Error> {
    let mut apart: [Vec<f64>; 2] = Default::default();
    for seed in seeds {
        let experiment = Experiment::run(seed);
        let own = Runs::of(&experiment, &Data::new(&experiment)?).own()?;
        for (all, change) in apart.iter_mut().zip(&own) {
            all.push(change.apart());
        }
    }
    for all in &mut apart {
        all.sort_by(f64::total_cmp);
    }
    Ok(apart)
}
