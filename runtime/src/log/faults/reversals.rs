//! Whether a torque that jumps away and back was the drive's, at a place where its joint hardly moves: a controller that compensates dry friction
//! changes the sign of it there, and changes it back where the velocity that it wants only touches zero.

use std::ops::Range;

use super::resolution;

/// Samples before and behind in which a joint that turns round moves by no more steps of its encoder than this, or no more of the most that it
/// moves in as many elsewhere.
const REACH: usize = 10;
const STEPS: f64 = 4.0;
const OF_MOST: f64 = 0.005;

/// Jumps that chance has all of them at such places with less than this probability are of the friction there.
const CHANCE: f64 = 0.05;

/// Ranges of a torque; none where all are where its joint hardly moves, and such places are few.
pub(super) fn without(found: Vec<Range<usize>>, position: &[f64]) -> Vec<Range<usize>> {
    let Some(longest) = found.iter().map(Range::len).max() else {
        return found;
    };
    let moves = |range: &Range<usize>| {
        let around = range.start.saturating_sub(REACH)..(range.end + REACH).min(position.len());
        let own = position[around].iter().copied();
        let (least, most) = own.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), q| {
            (least.min(q), most.max(q))
        });
        most - least
    };
    let places = (0..position.len().saturating_sub(longest)).step_by(longest);
    let elsewhere: Vec<f64> = places.map(|k| moves(&(k..k + longest))).collect();
    let most = elsewhere.iter().copied().fold(0.0, f64::max);
    let far = (STEPS * resolution(position)).max(OF_MOST * most);
    let still = elsewhere.iter().filter(|moved| **moved <= far).count() as f64;
    let share = still / elsewhere.len().max(1) as f64;
    let times = i32::try_from(found.len()).unwrap_or(i32::MAX);
    let is_friction = found.iter().all(|range| moves(range) <= far) && share.powi(times) < CHANCE;
    if is_friction { Vec::new() } else { found }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// A joint whose velocity touches zero at 2 s, 4 s, and so on, 500 samples a second.
    fn position() -> Vec<f64> {
        let angle = |k: usize| TAU * 0.5 * k as f64 / 500.0;
        let moved = |k: usize| 0.3 * (angle(k) - angle(k).sin());
        (0..5000)
            .map(|k| (moved(k) / 2e-5).round() * 2e-5)
            .collect()
    }

    #[test]
    fn a_torque_that_changes_its_sign_where_a_joint_turns_is_no_fault() {
        let turns = vec![998..1002, 1999..2002];
        assert_eq!(without(turns.clone(), &position()), Vec::new());
        // Others elsewhere, and none of them is friction.
        let faults = [turns, vec![2500..2504, 3800..3801]].concat();
        assert_eq!(without(faults.clone(), &position()), faults);
    }

    #[test]
    fn jumps_of_a_joint_that_rests_are_faults() {
        let faults = vec![248..252, 1249..1252];
        assert_eq!(without(faults.clone(), &vec![0.3; 5000]), faults);
    }
}
