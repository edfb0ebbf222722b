//! Laws that may not be named and say that something is missing all the same.

use super::super::structure::Structure;
use super::{Refusal, Tried};

/// From which share of a joint's error on, percent, a law that may not be named says that something is missing all the same.
pub(in super::super) const DOUBT_PERCENT: f64 = 10.0;

/// The same of a law that is no better in every fold, as a gap is not that the joint crosses in some of them: what takes so much off both errors
/// of all folds together is more than what a fit has by being a fit. A zero that wanders takes as much, by an offset that is chance.
pub(super) const MUCH_PERCENT: f64 = 20.0;

/// See [`Verdict::doubtful`](super::Verdict::doubtful); with the structure that is left of every joint.
pub(in super::super) fn doubtful<'a>(tried: &'a [Tried], left: &[Structure]) -> Option<&'a Tried> {
    let last = tried.iter().map(|tried| tried.round).max()?;
    let most = |tried: &Tried| tried.of_its_joints(&tried.evidence.raw_percent);
    let takes_much = |tried: &Tried| {
        if tried.refusals.contains(&Refusal::HeldOut) {
            tried.takes_much()
        } else {
            most(tried) >= DOUBT_PERCENT
        }
    };
    let is_of_law = |refusal: &Refusal| {
        use Refusal::{EndOfRange, HeldOut, Sign, Undetermined, Unsteady};
        matches!(
            refusal,
            EndOfRange | HeldOut | Sign | Undetermined | Unsteady
        )
    };
    // What reads the logged torque explains its noise.
    let may_be_noise = |tried: &Tried| {
        let mut joints = tried.joints.iter();
        tried.follows_torque && !joints.any(|joint| left[*joint].is_material())
    };
    let doubted = tried.iter().filter(|tried| {
        tried.round == last
            && !may_be_noise(tried)
            && !tried.refusals.is_empty()
            && tried.refusals.iter().all(is_of_law)
            && takes_much(tried)
    });
    doubted.max_by(|a, b| most(a).total_cmp(&most(b)))
}
