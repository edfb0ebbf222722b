//! The mixed cost (23), `q1 sum e^2 + q2 max |e|`: output error of the tool minimizes squares alone, so its simulation serves a search here.

use robot_model::log::Log;
use robot_model::simulate::{Loop, Tolerances, Torques, Trajectory};
use robot_model_codegen::Compiled;

use super::plant::Friction;
use super::tool;
use super::truth;
use crate::paper::{Error, compiled};

/// One pair of values, and what they leave of a log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// `s0`, N m/rad.
    pub stiffness: f64,
    /// `s1`, N m s/rad.
    pub damping: f64,
    /// `sum e^2`, rad^2.
    pub squares: f64,
    /// `max |e|`, rad.
    pub largest: f64,
}

/// The mixed cost at its least, and where squares alone are least.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mixed {
    /// Where a search for the least squares from the result of output error ends: that knows nothing of the rest at the start.
    pub of_squares: Point,
    /// Where one for the mixed cost from there ends.
    pub found: Point,
    /// Where one from the first values ends.
    pub from_first: Point,
    /// `q1`, 1/rad^2, and `q2`, 1/rad: with them both terms are 1 where squares are least, as the paper has no values.
    pub weights: [f64; 2],
}

/// A search is over where the ends of its triangle are within this share of each other.
const SAME: f64 = 1e-4;

/// The first triangle: one value is more by this share.
const FIRST: f64 = 0.05;

/// Steps of a search.
const STEPS: usize = 200;

impl Mixed {
    /// The cost (23).
    #[must_use]
    pub fn cost(&self, point: &Point) -> f64 {
        let [q1, q2] = self.weights;
        q1 * point.squares + q2 * point.largest
    }
}

/// The least mixed cost on a log; `start` has the static parameters too, and `first` is another pair to begin with.
///
/// # Errors
/// Those of the libraries.
pub fn mixed(start: &Friction, first: [f64; 2], log: &Log) -> Result<Mixed, Error> {
    let compiled = compiled("bristles.robot", tool::BRISTLES)?;
    let of = |[stiffness, damping]: [f64; 2]| {
        let friction = Friction {
            stiffness,
            damping,
            ..*start
        };
        at(&compiled, &friction, log)
    };
    let near = [start.stiffness, start.damping];
    let least = search(near, &of, &|point| point.squares)?;
    let mut mixed = Mixed {
        of_squares: least,
        found: least,
        from_first: least,
        weights: [1.0 / least.squares, 1.0 / least.largest],
    };
    mixed.found = search([least.stiffness, least.damping], &of, &|point| {
        mixed.cost(point)
    })?;
    mixed.from_first = search(first, &of, &|point| mixed.cost(point))?;
    Ok(mixed)
}

/// What the model with this friction leaves of the positions of a log, under its torques.
fn at(compiled: &Compiled, friction: &Friction, log: &Log) -> Result<Point, Error> {
    let tau = log.tau[0].iter();
    let torque = tau
        .map(|current| truth::TORQUE_CONSTANT * current)
        .collect();
    let mut given = Torques::new(log.time.clone(), vec![torque])?;
    let setting = Loop {
        rate: log.rate_hz(),
        log_rate: log.rate_hz(),
        duration: log.seconds(),
        tolerances: Tolerances {
            relative: 1e-7,
            absolute: 1e-9,
            ..Tolerances::default()
        },
        ..Loop::default()
    };
    let still = Trajectory::new(
        (0..4).map(f64::from).collect(),
        vec![vec![0.0; 4]],
        vec![],
        vec![],
        vec![],
    )?;
    let plant = tool::plant_of(compiled.clone(), friction)?;
    let (record, _) = setting.run(plant, &mut given, &still, &mut |_| ())?;
    let errors = record.q[0].iter().zip(&log.q[0]).map(|(q, seen)| seen - q);
    let (squares, largest) = errors.fold((0.0, 0.0_f64), |(squares, largest), e| {
        (squares + e * e, largest.max(e.abs()))
    });
    Ok(Point {
        stiffness: friction.stiffness,
        damping: friction.damping,
        squares,
        largest,
    })
}

/// The simplex of Nelder and Mead over both values' logarithms: the largest error has kinks, which it does not mind.
fn search(
    start: [f64; 2],
    of: &impl Fn([f64; 2]) -> Result<Point, Error>,
    cost: &impl Fn(&Point) -> f64,
) -> Result<Point, Error> {
    let evaluate = |x: [f64; 2]| -> Result<(f64, [f64; 2], Point), Error> {
        let point = of(x.map(f64::exp))?;
        Ok((cost(&point), x, point))
    };
    let x = start.map(f64::ln);
    let mut triangle = [
        evaluate(x)?,
        evaluate([x[0] + FIRST, x[1]])?,
        evaluate([x[0], x[1] + FIRST])?,
    ];
    for _ in 0..STEPS {
        triangle.sort_by(|one, other| one.0.total_cmp(&other.0));
        let [best, middle, worst] = triangle;
        let width = (0..2).map(|k| (worst.1[k] - best.1[k]).abs());
        if width.fold(0.0, f64::max) < SAME {
            break;
        }
        let center = [0, 1].map(|k| 0.5 * (best.1[k] + middle.1[k]));
        let toward = |way: f64| [0, 1].map(|k| center[k] + way * (worst.1[k] - center[k]));
        let over = evaluate(toward(-1.0))?;
        let next = if over.0 < best.0 {
            let farther = evaluate(toward(-2.0))?;
            if farther.0 < over.0 { farther } else { over }
        } else if over.0 < middle.0 {
            over
        } else {
            evaluate(toward(if over.0 < worst.0 { -0.5 } else { 0.5 }))?
        };
        if next.0 < worst.0 {
            triangle[2] = next;
            continue;
        }
        for end in &mut triangle[1..] {
            *end = evaluate([0, 1].map(|k| 0.5 * (end.1[k] + best.1[k])))?;
        }
    }
    let least = triangle
        .into_iter()
        .min_by(|one, other| one.0.total_cmp(&other.0));
    Ok(least.ok_or("a triangle has three ends")?.2)
}
