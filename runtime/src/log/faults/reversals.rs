//! Whether a torque that jumps away and back was the drive's, at a place where its joint hardly moves: a controller that compensates dry friction
//! changes the sign of that there, and changes it back where the velocity that it wants only touches zero.

use std::ops::Range;

use super::{quantile, resolution};
use crate::signal::resample::whole_steps;

/// Seconds before and behind in which a joint that turns round moves by no more steps of its encoder than this, or no more of the most that it
/// moves in as much time elsewhere.
const REACH_S: f64 = 0.02;
const STEPS: f64 = 4.0;
const OF_MOST: f64 = 0.005;

/// Jumps that chance has all of them at such places with less than this probability are of the friction there.
const CHANCE: f64 = 0.05;

/// A torque of friction and what else the joint has there is between these shares of its values.
const USUAL: [f64; 2] = [0.005, 0.995];

/// Jumps of a torque, as ranges of its samples; none where all are where its joint hardly moves, such places are few, and the torque is nowhere
/// further away than it is elsewhere.
pub(super) fn without(
    found: Vec<Range<usize>>,
    tau: &[f64],
    position: &[f64],
    rate_hz: f64,
) -> Vec<Range<usize>> {
    if found.is_empty() {
        return found;
    }
    let [low, high] = USUAL.map(|share| quantile(tau.to_vec(), share));
    let is_usual = |range: &Range<usize>| {
        let mut inside = tau[range.clone()].iter();
        inside.all(|value| *value != 0.0 && (low..=high).contains(value))
    };
    if !found.iter().all(is_usual) {
        return found;
    }
    let steps = STEPS * resolution(position);
    let mut chance = 1.0;
    for range in &found {
        match share_of_places(range, position, steps, whole_steps(REACH_S * rate_hz)) {
            Some(share) => chance *= share,
            None => return found,
        }
    }
    if chance < CHANCE { Vec::new() } else { found }
}

/// How large a share of as long ranges has the joint move as little as around this one; `None` where it moves there.
fn share_of_places(
    range: &Range<usize>,
    position: &[f64],
    steps: f64,
    reach: usize,
) -> Option<f64> {
    let length = range.len();
    let windows = position.len().saturating_sub(length);
    let moved = |start: usize| {
        let around = start.saturating_sub(reach)..(start + length + reach).min(position.len());
        let own = position[around].iter();
        let (least, most) = own.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), q| {
            (least.min(*q), most.max(*q))
        });
        most - least
    };
    let elsewhere: Vec<f64> = (0..windows).step_by(length).map(moved).collect();
    let most = elsewhere.iter().copied().fold(0.0, f64::max);
    let far = steps.max(OF_MOST * most);
    let still = elsewhere.iter().filter(|moved| **moved <= far).count();
    (moved(range.start) <= far).then(|| still as f64 / elsewhere.len().max(1) as f64)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    const HZ: f64 = 500.0;

    /// A joint whose velocity touches zero at 2 s, 4 s, and so on.
    fn position() -> Vec<f64> {
        let angle = |k: usize| TAU * 0.5 * k as f64 / HZ;
        let moved = |k: usize| 0.3 * (angle(k) - angle(k).sin());
        (0..5000)
            .map(|k| (moved(k) / 2e-5).round() * 2e-5)
            .collect()
    }

    /// A torque that swings between -5 and 9, with another value in some ranges.
    fn torque(ranges: &[Range<usize>], inside: f64) -> Vec<f64> {
        let mut tau: Vec<f64> = (0..5000)
            .map(|k| 2.0 + 7.0 * (1e-2 * f64::from(k)).sin())
            .collect();
        for range in ranges {
            tau[range.clone()].fill(inside);
        }
        tau
    }

    #[test]
    fn a_torque_that_changes_for_a_moment_where_a_joint_turns_is_no_fault() {
        let turns = vec![998..1002, 1999..2002];
        let found = |ranges: &[Range<usize>], inside: f64| {
            without(ranges.to_vec(), &torque(ranges, inside), &position(), HZ)
        };
        assert_eq!(found(&turns, -3.0), Vec::new());
        // What is larger than it is anywhere, and no torque at all, are faults there, too.
        assert_eq!(found(&turns, -30.0), turns);
        assert_eq!(found(&turns, 0.0), turns);
        // Others elsewhere, and none of them is friction.
        let faults = [turns, vec![2500..2504, 3800..3801]].concat();
        assert_eq!(found(&faults, -3.0), faults);
    }

    /// A joint that moves for a half of the log, and rests for the other.
    #[test]
    fn jumps_of_a_joint_that_rests_are_faults() {
        let mut moves = position();
        let last = moves[2500];
        moves[2500..].fill(last);
        let faults = vec![3000..3004, 4000..4003];
        let tau = torque(&faults, -3.0);
        assert_eq!(without(faults.clone(), &tau, &moves, HZ), faults);
    }
}
