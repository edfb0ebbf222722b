//! Parameters from releases, by the output error of the library.

use robot_model::identify::output_error::{
    Hold, OutputError, OutputErrorError, OutputEstimate, Recording, Search,
};
use robot_model::log::Log;
use robot_model::simulate::Adjustable;

use super::model::Arm;
use super::plant::{Position, release};
use super::releases::{Batch, at};
use super::truth::{BOUNDS, CAD, ESTIMATED, HEIGHTS, Height, NAMES, STEP};
use crate::paper::{Error, in_threads, rounded};

/// Every so many samples is read: 20 ms are a fortieth of the fastest swing.
const EVERY: usize = 4;

/// Seconds of a window. Along whole releases a motion that is out of step by half a swing is a valley of its own.
const WINDOW: f64 = 1.0;

/// Angles without noise are rounded to this, rad, as logs are.
const DIGITS: f64 = 1e-6;

/// What the search of the paper is: a trust region within the bounds of Table 5, here along windows.
#[must_use]
pub fn settings() -> OutputError {
    OutputError {
        search: Search::TrustRegion,
        bounds: BOUNDS.to_vec(),
        window: Some(WINDOW),
        hold: Some(Hold::Mean),
        ..OutputError::default()
    }
}

/// Names of unknowns, for the library.
#[must_use]
pub fn names() -> Vec<String> {
    NAMES.map(str::to_owned).to_vec()
}

/// An arm that moves no more than this stands, rad; and so many samples of that are read.
const STILL: f64 = 1e-4;
const STANDING: usize = 200;

/// The samples of a release until it stands: what follows tells nothing.
fn moving(positions: &[Position]) -> &[Position] {
    let end = positions[positions.len() - 1];
    let moves = |q: &Position| q.iter().zip(end).any(|(q, end)| (q - end).abs() > STILL);
    let last = positions.iter().rposition(moves).unwrap_or(0);
    &positions[..positions.len().min(last + STANDING)]
}

/// A release as a log without torque.
///
/// # Errors
/// None are expected.
pub fn recording(positions: &[Position]) -> Result<Recording, Error> {
    let read: Vec<&Position> = moving(positions).iter().step_by(EVERY).collect();
    let time = (0..read.len()).map(|k| (k * EVERY) as f64 * STEP).collect();
    let joint = |joint: usize| read.iter().map(|q| q[joint]).collect::<Vec<f64>>();
    let torque = vec![vec![0.0; read.len()]; 2];
    let log = Log::from_samples("release", time, vec![joint(0), joint(1)], torque)?;
    Ok(Recording::new(&log, &[1.0; 2], 0.0, Vec::new()))
}

/// Both links let go from a height, without noise.
#[must_use]
pub fn exact(height: &Height) -> [Vec<Position>; 2] {
    [0, 1].map(|link| {
        let (positions, _) = release(ESTIMATED, at(link, height.angle), height.samples);
        let round = |x: f64| rounded(x, DIGITS);
        positions.iter().map(|q| q.map(round)).collect()
    })
}

/// The parameters with which both releases of a height come out, from those of Table 2 on.
///
/// # Errors
/// Those of the library, of which none are expected.
pub fn find(arm: &Arm, releases: [&[Position]; 2]) -> Result<OutputEstimate, Error> {
    let [first, second] = releases;
    let recordings = [recording(first)?, recording(second)?];
    Ok(look(
        &settings(),
        arm,
        &names(),
        &CAD.values(),
        &recordings,
    )?)
}

/// One search, untold.
///
/// # Errors
/// Those of the library.
pub fn look<P: Adjustable + Clone + Sync>(
    settings: &OutputError,
    arm: &P,
    names: &[String],
    start: &[f64],
    recordings: &[Recording],
) -> Result<OutputEstimate, OutputErrorError> {
    settings.fit(arm, names, start, recordings, &mut |_| ())
}

/// What was measured, and the parameters that come out of it.
#[derive(Debug, Clone)]
pub struct Found {
    /// Both links, of each height.
    pub batches: Vec<[Batch; 2]>,
    /// By the means of twenty releases, each height.
    pub means: Vec<OutputEstimate>,
    /// By single releases without noise, from the last height.
    pub exact: OutputEstimate,
}

/// All searches, as many at a time as there are cores.
///
/// # Errors
/// Those of the library, of which none are expected.
pub fn all(arm: &Arm) -> Result<Found, Error> {
    let heights = HEIGHTS.iter().enumerate();
    let batches = heights.map(|(k, height)| {
        let seed = 2 * k as u64;
        [
            Batch::measured(height, 0, seed),
            Batch::measured(height, 1, seed + 1),
        ]
    });
    let batches: Vec<[Batch; 2]> = batches.collect();
    let last = exact(&HEIGHTS[HEIGHTS.len() - 1]);
    let means = batches
        .iter()
        .map(|[one, other]| [one.mean.as_slice(), &other.mean]);
    let jobs: Vec<_> = means.chain([[last[0].as_slice(), &last[1]]]).collect();
    let mut found = in_threads(&jobs, |job| find(arm, *job))?;
    let exact = found.pop().ok_or("there is a search without noise")?;
    Ok(Found {
        batches,
        means: found,
        exact,
    })
}
