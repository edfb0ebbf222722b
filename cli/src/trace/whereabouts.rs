//! What the structure of a residual follows from, for people.

use robot_model::columns::Arm;
use robot_model::trace::{Outcome, Quantity, Share, Step, Whereabouts};

use crate::close_the_loop::Loop;
use crate::output::significant;
use crate::units::Units;

/// Quantities that are told of a joint, and the least share of one, percent.
const TOLD: usize = 3;
const LEAST_PERCENT: f64 = 10.0;

/// A step is what structure is where it takes this share off it.
const MOST: f64 = 0.5;

/// Structure follows what says so much of it.
const FOLLOWS: f64 = 0.25;

/// Two quantities at once are told where they say so much more than one alone.
const MORE: f64 = 0.1;

/// What structure goes along with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Along {
    Motion,
    /// Nothing says more of it than time or a constant does: a zero that wanders.
    Time,
    /// A level that changes.
    Step,
    /// Nothing that was asked says a quarter of it.
    Nothing,
}

impl Along {
    /// Of one joint, whose error repeats with the motion or is not known to.
    fn of(one: &Whereabouts, repeats: bool) -> Self {
        let most = |is: &dyn Fn(Quantity) -> bool| {
            let shares = one.shares.iter().filter(|share| is(share.of));
            shares.map(|share| share.share).fold(0.0, f64::max)
        };
        let terms = one.terms.iter().map(|term| term.share);
        let of_time = most(&|of| of == Quantity::Time).max(one.level);
        let of_one = most(&|of| of != Quantity::Time && !of.is_surface());
        let of_two = most(&Quantity::is_surface) - MORE;
        let of_motion = terms.fold(of_one.max(of_two), f64::max);
        let of_step = one.step.map_or(0.0, |step| step.share);
        Self::by(of_step, of_time, of_motion, repeats)
    }

    /// By the shares that steps, time and the motion have.
    fn by(of_step: f64, of_time: f64, of_motion: f64, repeats: bool) -> Self {
        if of_step > MOST {
            Self::Step
        } else if repeats {
            Self::Motion
        } else if of_time.max(of_motion) < FOLLOWS {
            Self::Nothing
        } else if of_time > of_motion {
            Self::Time
        } else {
            Self::Motion
        }
    }

    /// Of all joints: with the motion where they differ, or where none is known.
    pub(super) fn all(closed: &Loop) -> Self {
        let verdict = &closed.verdict;
        let repeats = |joint: usize| verdict.noise_floor[joint].exceeded().is_some();
        let each = verdict.left.iter();
        Self::together(each.map(|one| Self::of(one, repeats(one.joint))))
    }

    fn together(each: impl Iterator<Item = Self>) -> Self {
        let mut each: Vec<Self> = each.collect();
        // What follows from nothing that was asked says nothing against the others.
        if each.iter().any(|along| *along != Self::Nothing) {
            each.retain(|along| *along != Self::Nothing);
        }
        each.dedup();
        match each[..] {
            [along] => along,
            _ => Self::Motion,
        }
    }
}

/// What is said of each joint's error that still follows the motion, or where it lives: the first says of which joint it is.
pub(super) fn structure_left(closed: &Loop) -> Vec<Vec<String>> {
    let verdict = &closed.verdict;
    let joints = closed.before.arm.joints().iter().enumerate();
    let told = joints.filter_map(|(joint, name)| {
        let found = verdict.left.iter().filter(|one| one.joint == joint);
        let found: Vec<Whereabouts> = found.cloned().collect();
        let left = &verdict.after[joint];
        if !left.is_material() && found.is_empty() {
            return None;
        }
        let share = 100.0 * left.share;
        let step = found.iter().find_map(|one| one.step);
        let exceeded = verdict.noise_floor[joint].exceeded();
        let each = found.iter();
        let along = Along::together(each.map(|one| Along::of(one, exceeded.is_some())));
        let follows = match (along, left.is_material()) {
            (Along::Step, true) => "comes from a level that changes",
            (Along::Time, true) => "wanders in time",
            (Along::Motion, true) => "still follows the motion",
            (Along::Nothing, true) => "is no noise",
            (Along::Time, false) => "wanders in time in part",
            (Along::Nothing, false) => "is no noise in part",
            (Along::Step, false) => "comes in part from a level that changes",
            (Along::Motion, false) => "follows the motion in part",
        };
        let follows = if left.is_material() {
            format!("{share:.0} % of the error's power on {name} {follows}")
        } else {
            format!("the error on {name} {follows}")
        };
        let step = step.map(|step| stepped(closed, joint, &step));
        let exceeded = exceeded.filter(|_| verdict.outcome == Outcome::Unexplained);
        let exceeded = exceeded.map(|times| {
            format!(
                "errors away from velocity reversals are {times:.1} times the variation between periods: a repeating effect is missing"
            )
        });
        let pulsed = verdict.noise_floor[joint].pulsed();
        let pulsed = pulsed.filter(|_| verdict.outcome == Outcome::Unexplained);
        let pulsed = pulsed.map(|share| {
            format!(
                "a twentieth of the samples has {:.0} % of its power, away from velocity reversals: pulses, as of impacts in a gap",
                100.0 * share
            )
        });
        let said = std::iter::once(follows).chain(step).chain(exceeded);
        let found = found.iter().map(|one| whereabouts(closed, one));
        let said = said.chain(pulsed).chain(found);
        Some(said.collect())
    });
    told.collect()
}

/// When a joint's level changes, and by how much.
fn stepped(closed: &Loop, joint: usize, step: &Step) -> String {
    let size = significant(step.size, 3);
    let unit = Units::of(closed.before.arm.compiled().model.joints[joint].kind).torque;
    let log = if closed.traced.len() > 1 {
        format!(" of log {}", step.log + 1)
    } else {
        String::new()
    };
    let time = step.time;
    match step.until {
        Some(until) => format!(
            "its residual steps by {size} {unit} at {time:.1} s{log} and back at {until:.1} s, as when something holds or pushes the joint \
             for a while, or its zero is set twice: fit the log without that part"
        ),
        None => format!(
            "its residual steps by {size} {unit} at {time:.1} s{log} and stays there, as when something slips, breaks or is reset, or the arm \
             continues at another place: fit the parts before and after it separately"
        ),
    }
}

/// One line: the term of the equations and the quantities a curve in which explains most of a joint's residual, and the highest line of its spectrum.
fn whereabouts(closed: &Loop, one: &Whereabouts) -> String {
    let names = closed.before.arm.joints();
    let is_both = |share: &&Share| share.of.is_surface();
    let mut alone = one.shares.iter().filter(|share| !is_both(share));
    let most = alone.next().map_or(0.0, |share| share.share);
    let counts = |share: &&Share| !is_both(share) || share.share > most + MORE;
    let shares = one.shares.iter().filter(counts).take(TOLD);
    let told: Vec<String> = shares
        .map(|share| (share.of, 100.0 * share.share))
        .filter(|(_, percent)| *percent >= LEAST_PERCENT)
        .map(|(of, percent)| format!("{percent:.0} % a function of {}", quantity(of, names)))
        .collect();
    let term = one.terms.first().map(|term| {
        let percent = 100.0 * term.share;
        let coefficient = significant(term.coefficient, 3);
        (
            percent,
            format!(
                "{percent:.0} % {coefficient} times the term {} of the equations",
                term.term
            ),
        )
    });
    let term = term.filter(|(percent, _)| *percent >= LEAST_PERCENT);
    let level = 100.0 * one.level;
    let level = (level >= LEAST_PERCENT).then(|| format!("{level:.0} % a constant"));
    let term = term.map(|(_, told)| told);
    let told: Vec<String> = level.into_iter().chain(term).chain(told).collect();
    let told = if told.is_empty() {
        "not a function of position, velocity, acceleration, load or time alone, so perhaps of several of them or of the motion before".to_owned()
    } else {
        told.join(", ")
    };
    let (peak, percent) = (one.peak_hz, 100.0 * one.peak_share);
    format!(
        "of its residual on folds not fitted: {told}; highest spectral line at {peak:.2} Hz ({percent:.0} %)"
    )
}

/// A quantity in words.
fn quantity(of: Quantity, names: &[String]) -> String {
    let joints = of.joints();
    let joints: Vec<&str> = joints.iter().map(|&joint| names[joint].as_str()).collect();
    let name = of.name().replace('-', " ");
    match (of, &joints[..]) {
        (Quantity::VelocityAndPosition(..), [joint, other]) => {
            format!("velocity of {joint} and position of {other}")
        }
        (Quantity::VelocityAndTime(_), [joint]) => format!("velocity of {joint} and time"),
        (_, []) => name,
        _ => format!("{name} of {}", joints.join(" and ")),
    }
}

#[cfg(test)]
mod tests {
    use super::Along;

    #[test]
    fn structure_goes_along_with_what_says_most_of_it() {
        assert_eq!(Along::by(0.6, 0.9, 0.9, true), Along::Step);
        assert_eq!(Along::by(0.4, 0.6, 0.3, false), Along::Time);
        assert_eq!(Along::by(0.4, 0.3, 0.6, false), Along::Motion);
        assert_eq!(Along::by(0.4, 0.2, 0.2, false), Along::Nothing);
        // What comes back in every period is none of time's.
        assert_eq!(Along::by(0.4, 0.2, 0.2, true), Along::Motion);
    }

    #[test]
    fn joints_go_along_with_what_all_that_is_known_of_them_does() {
        use Along::{Motion, Nothing, Step, Time};
        let together = |each: &[Along]| Along::together(each.iter().copied());
        assert_eq!(together(&[]), Motion);
        assert_eq!(together(&[Time, Time]), Time);
        assert_eq!(together(&[Time, Nothing]), Time);
        assert_eq!(together(&[Nothing]), Nothing);
        assert_eq!(together(&[Step, Time]), Motion);
        assert_eq!(together(&[Step, Motion, Step]), Motion);
    }
}
