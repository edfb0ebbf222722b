//! What is wrong in the paper, as the library finds it, and what is left where it is mended.

use robot_model::identify::output_error::{
    OutputError, OutputErrorError, OutputEstimate, other_ranges, ranges_within,
};
use robot_model::simulate::Functions as _;

use super::model::{Arm, Model, errors, rest, simulate, with};
use super::plant::{Arm as ByHand, Position};
use super::releases::at;
use super::search::{Found, exact, look, names, recording, settings};
use super::truth::{BOUNDS, CAD, ESTIMATED, G, HEIGHTS, NAMES, Physical, Printed, SHARE};
use crate::paper::{Error, in_threads};

/// Seconds after which every release has ended.
const END: f64 = 60.0;

/// What releases tell of which parameters, at those of Table 6.
#[derive(Debug, Clone)]
pub struct Told {
    /// Of the eleven of Table 2.
    pub eleven: OutputEstimate,
    /// Of those that are left where both masses and the second center of mass are known from elsewhere.
    pub mended: OutputEstimate,
    /// Of the nine base parameters, by the means of the last height.
    pub base: OutputEstimate,
    /// Names of these.
    pub names: Vec<String>,
}

/// Which of the eleven are known in the mended case.
pub const KNOWN: [&str; 3] = ["m1", "m2", "c2"];

impl Told {
    /// From releases of the last height.
    ///
    /// # Errors
    /// Those of the library, of which none are expected.
    pub fn new(model: &Model, arm: &Arm, found: &Found) -> Result<Self, Error> {
        let last = HEIGHTS.len() - 1;
        let [one, other] = exact(&HEIGHTS[last]);
        let releases = [recording(&one)?, recording(&other)?];
        let [one, other] = &found.batches[last];
        let means = [recording(&one.mean)?, recording(&other.mean)?];
        let whole = OutputError {
            bounds: Vec::new(),
            window: None,
            ..settings()
        };
        let truth = ESTIMATED.values();
        let bound = |(name, value): (&&str, f64)| {
            if KNOWN.contains(name) {
                [value; 2]
            } else {
                [f64::NEG_INFINITY, f64::INFINITY]
            }
        };
        let known = OutputError {
            bounds: NAMES.iter().zip(truth).map(bound).collect(),
            ..whole.clone()
        };
        let free = OutputError {
            bounds: Vec::new(),
            ..settings()
        };
        let base = model.base(&ESTIMATED)?;
        let base_names = model.compiled.base.names.clone();
        let start = model.constants.own(&found.means[last].values);
        let jobs: [Job<'_>; 3] = [
            Box::new(|| look(&whole, arm, &names(), &truth, &releases)),
            Box::new(|| look(&known, arm, &names(), &truth, &releases)),
            Box::new(|| look(&free, &base, &base_names, &start, &means)),
        ];
        let told = in_threads(&jobs, |job| Ok(job()?))?;
        let told: [OutputEstimate; 3] = told
            .try_into()
            .map_err(|_| "there is a result of each search")?;
        let [eleven, mended, of_base] = told;
        Ok(Self {
            eleven,
            mended,
            base: of_base,
            names: base_names.clone(),
        })
    }
}

/// A search that waits for a core.
type Job<'a> = Box<dyn Fn() -> Result<OutputEstimate, OutputErrorError> + Sync + 'a>;

/// A parameter whose printed bounds are not what the text says.
#[derive(Debug, Clone, PartialEq)]
pub struct Off {
    /// Its name.
    pub name: &'static str,
    /// As the text says.
    pub said: [f64; 2],
    /// As Table 5 has them.
    pub printed: [f64; 2],
}

/// Bounds as the text says, of all but friction, whose bounds are no share of anything.
#[must_use]
pub fn said() -> [[f64; 2]; 7] {
    let said = ranges_within(&CAD.values()[..7], SHARE);
    std::array::from_fn(|k| said[k])
}

/// Parameters of which the library finds another range than the text says.
#[must_use]
pub fn off(bounds: &[[f64; 2]]) -> Vec<Off> {
    let said = said();
    let others = other_ranges(bounds, &said).into_iter();
    others
        .map(|k| Off {
            name: NAMES[k],
            said: said[k],
            printed: bounds[k],
        })
        .collect()
}

/// The arm where `f_c` is read as dry friction and `f_d` as viscous.
#[must_use]
pub fn exchanged() -> Physical {
    Physical {
        viscous: ESTIMATED.dry,
        dry: ESTIMATED.viscous,
        ..ESTIMATED
    }
}

/// How well parameters fit releases of Table 6 from the last height without noise, each link.
///
/// # Errors
/// Those of the library, of which none are expected.
pub fn fit_of(arm: &Arm, physical: &Physical) -> Result<[f64; 2], Error> {
    let height = &HEIGHTS[HEIGHTS.len() - 1];
    let truth = exact(height);
    let arm = with(arm, &physical.values());
    let fit = |link: usize| -> Result<f64, Error> {
        let run = simulate(&arm, at(link, height.angle), height.samples)?;
        Ok(errors(&truth[link], &run, link).nrmse)
    };
    Ok([fit(0)?, fit(1)?])
}

/// How many values (10) looks for in the text, which calls what it looks for, `lambda`, the measured angles: those of both joints in both
/// releases from the last height.
#[must_use]
pub fn angles() -> usize {
    let releases = exact(&HEIGHTS[HEIGHTS.len() - 1]);
    releases.iter().flatten().flatten().count()
}

/// Equations (7) and (8) where both `y` are outputs of the system, as the text has them, and where one is the model's.
#[must_use]
pub fn metrics(measured: &[Position], model: &[Position], joint: usize) -> [Printed; 2] {
    [
        errors(measured, measured, joint),
        errors(measured, model, joint),
    ]
}

/// Where a released arm comes to rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rest {
    /// Place of the height.
    pub height: usize,
    /// The link.
    pub link: usize,
    /// By hand, rad.
    pub by_hand: Position,
    /// By the library.
    pub library: Position,
    /// By the library, with a steep curve in place of dry friction.
    pub smooth: Position,
    /// Torque of gravity at rest over what dry friction can hold, each joint.
    pub share: [f64; 2],
}

/// Of both links from all heights, with the parameters of Table 6.
///
/// # Errors
/// Those of the library, of which none are expected.
pub fn rests(arm: &Arm) -> Result<Vec<Rest>, Error> {
    let dry = with(arm, &ESTIMATED.values());
    let smooth = Model::smooth()?.arm(&ESTIMATED)?;
    let heights = HEIGHTS.iter().enumerate();
    let places = heights.flat_map(|(k, height)| [(k, height, 0), (k, height, 1)]);
    let one = |(height, own, link): (usize, &super::truth::Height, usize)| {
        let q = at(link, own.angle);
        let mut by_hand = ByHand::released(ESTIMATED, q);
        while by_hand.time() < END && !by_hand.is_at_rest() {
            by_hand.advance(1e-3);
        }
        let library = rest(&dry, q)?;
        Ok(Rest {
            height,
            link,
            by_hand: by_hand.position(),
            library,
            smooth: rest(&smooth, q)?,
            share: gravity(&ESTIMATED, library, ESTIMATED.dry),
        })
    };
    places.map(one).collect()
}

/// Torque of gravity over what can hold it.
fn gravity(p: &Physical, q: Position, dry: [f64; 2]) -> [f64; 2] {
    let second = p.m[1] * p.c[1] * G * (q[0] + q[1]).sin();
    let first = (p.m[0] * p.c[0] + p.m[1] * p.l1) * G * q[0].sin() + second;
    [first.abs() / dry[0], second.abs() / dry[1]]
}

/// Whether all values of a search stay within the bounds of Table 5.
#[must_use]
pub fn stays_within(estimate: &OutputEstimate) -> bool {
    estimate.iterates.iter().all(|iterate| {
        let mut pairs = iterate.values.iter().zip(&BOUNDS);
        pairs.all(|(value, [low, high])| low <= value && value <= high)
    })
}

/// Whether the cost falls from each step to the next of the same part.
#[must_use]
pub fn falls(estimate: &OutputEstimate) -> bool {
    let mut pairs = estimate.iterates.windows(2);
    pairs.all(|pair| pair[0].stage != pair[1].stage || pair[1].cost <= pair[0].cost)
}
