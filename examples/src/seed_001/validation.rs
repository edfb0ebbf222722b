//! Models beside measured releases, before and after estimation.

use super::model::{Arm, errors, simulate, with};
use super::plant::{Position, release};
use super::releases::at;
use super::search::{Found, exact};
use super::truth::{CAD, ESTIMATED, HEIGHTS, Physical, Printed};
use crate::paper::{Error, in_threads};

/// Samples after which the fit of Table 2 is told besides: 5 s.
const FIRST: usize = 1000;

/// A released link beside models, from one height.
#[derive(Debug, Clone)]
pub struct Validation {
    /// Place of the height.
    pub height: usize,
    /// The link.
    pub link: usize,
    /// Mean of the measured releases, with the models let go where it starts.
    pub measured: Vec<Position>,
    /// By Table 2.
    pub cad: Vec<Position>,
    /// By the estimate of this height.
    pub fitted: Vec<Position>,
    /// Errors of Table 2.
    pub before: Printed,
    /// Fit of Table 2 with the dry friction of Table 6, percent.
    pub before_by_dry: f64,
    /// Errors of the estimate.
    pub after: Printed,
    /// Fit of the arm that was measured, let go once where the mean starts, percent: no model is nearer than that by being right.
    pub itself: f64,
    /// Fit of Table 2 to a release without noise, percent: all of it, and its first 5 s.
    pub exact_before: [f64; 2],
    /// Fit of the one estimate without noise to it, percent.
    pub exact_after: f64,
    /// How far the library's motion of Table 6 is from the one by hand, degrees at most.
    pub apart: f64,
}

impl Validation {
    /// Where the link hangs at the end, degrees: in the mean of releases, and by Table 2.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        let end = |path: &[Position]| path[path.len() - 1][self.link].to_degrees();
        [end(&self.measured), end(&self.cad)]
    }
}

/// Both links from all heights.
///
/// # Errors
/// Those of the library, of which none are expected.
pub fn all(arm: &Arm, found: &Found) -> Result<Vec<Validation>, Error> {
    let heights = 0..HEIGHTS.len();
    let jobs: Vec<(usize, usize)> = heights.flat_map(|k| [(k, 0), (k, 1)]).collect();
    in_threads(&jobs, |&(height, link)| one(arm, found, height, link))
}

fn one(arm: &Arm, found: &Found, height: usize, link: usize) -> Result<Validation, Error> {
    let measured = found.batches[height][link].mean.clone();
    let samples = measured.len();
    let run = |values: &[f64], q: Position| simulate(&with(arm, values), q, samples);
    let cad = run(&CAD.values(), measured[0])?;
    let fitted = run(&found.means[height].values, measured[0])?;
    let lighter = Physical {
        dry: ESTIMATED.dry,
        ..CAD
    };
    let lighter = run(&lighter.values(), measured[0])?;
    let own = at(link, HEIGHTS[height].angle);
    let truth = &exact(&HEIGHTS[height])[link];
    let cad_beside = run(&CAD.values(), own)?;
    let again = run(&ESTIMATED.values(), own)?;
    let (by_hand, _) = release(ESTIMATED, own, samples);
    let apart = by_hand.iter().zip(&again);
    let apart = apart.flat_map(|(one, other)| [one[0] - other[0], one[1] - other[1]]);
    let first = errors(&truth[..FIRST], &cad_beside[..FIRST], link);
    let after = run(&found.exact.values, own)?;
    Ok(Validation {
        height,
        link,
        before: errors(&measured, &cad, link),
        before_by_dry: errors(&measured, &lighter, link).nrmse,
        itself: errors(&measured, &release(ESTIMATED, measured[0], samples).0, link).nrmse,
        after: errors(&measured, &fitted, link),
        exact_before: [errors(truth, &cad_beside, link).nrmse, first.nrmse],
        exact_after: errors(truth, &after, link).nrmse,
        apart: apart.fold(0.0, |most: f64, x| most.max(x.abs().to_degrees())),
        measured,
        cad,
        fitted,
    })
}
