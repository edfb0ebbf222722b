//! What the logs leave open: effects that would do as well as those that are named, and the experiment that tells them apart.

mod rivals;

use std::fmt::Write;

use robot_model::trace::Alternative;

use super::doubt::{called, on_joints};
use crate::close_the_loop::Loop;
use crate::excite::have_own_columns;
use crate::output::quoted;

use rivals::{has_memory, rivals};

/// Laws whose errors differ by less, percent, do the same along the logs.
const SAME_PERCENT: f64 = 0.05;

/// How long the search for a motion takes at most where states have to be followed, s: the best one until then is written.
const BUDGET_S: u32 = 600;

/// Motions of no more alternatives than this are told: the spec is compiled with each.
const MOST_MOTIONS: usize = 3;

const PUT: &str = "a string takes all";

/// How many effects do as well as one that is named: those that are not worse in every fold.
pub(super) fn undistinguished(alternatives: &[Alternative]) -> usize {
    let worse = alternatives.iter().map(|rival| rival.worse_folds);
    worse.filter(|folds| !is_worse(*folds)).count()
}

/// Whether an effect is worse in all of so many folds.
fn is_worse(folds: Option<(usize, usize)>) -> bool {
    folds.is_some_and(|(worse, of)| worse == of)
}

/// One line an alternative, and for the spec at a path, of a text, the commands that design motions for those doubts that have one.
pub(super) fn apart(spec: &str, text: &str, closed: &Loop) -> String {
    let mut out = String::new();
    let alternatives = &closed.verdict.alternatives;
    for alternative in alternatives {
        writeln!(
            out,
            "  or {} instead of {}: {:+.1} % raw error on folds not fitted{}",
            on_joints(closed, &alternative.effect, &alternative.joints),
            called(&closed.verdict.findings[alternative.instead_of].effect),
            alternative.worse_percent,
            in_folds(alternative.worse_folds),
        )
        .expect(PUT);
    }
    out + &experiments(spec, text, closed)
}

/// How often it is worse, where the folds are the same.
fn in_folds(worse: Option<(usize, usize)>) -> String {
    worse.map_or_else(String::new, |(worse, of)| {
        format!("; in the band of the fit, all joints together, its error is the larger one in {worse} of {of} folds")
    })
}

/// Why no motion is designed that tells two effects apart.
#[derive(Clone, Copy)]
enum Without {
    /// One of them is no torque of the motion alone.
    Motion,
    /// One of them has a parameter without a column of its own.
    Column,
    /// The spec does not compile with both.
    Spec,
}

impl Without {
    const fn words(self) -> &'static str {
        match self {
            Self::Motion => "one of them follows more than the motion, or changes the arm itself",
            Self::Column => "a parameter of one of them is part of the other, or of the arm",
            Self::Spec => "the spec does not compile with both of them",
        }
    }
}

/// A line for every alternative that some motion may tell from what is named: those that the logs tell apart by something first, since no
/// motion may tell the others. Then one, with the reason, for every alternative of those looked at that has no motion.
fn experiments(spec: &str, text: &str, closed: &Loop) -> String {
    let alternatives = &closed.verdict.alternatives;
    let is_same = |rival: &&Alternative| rival.worse_percent.abs() < SAME_PERCENT;
    let apart = alternatives.iter().filter(|rival| !is_same(rival));
    let by_hope = apart.chain(alternatives.iter().filter(is_same));
    let mut pairs: Vec<(&Alternative, [String; 2])> = Vec::new();
    let mut others = String::new();
    let mut more = 0;
    for rival in by_hope {
        let place = rival.instead_of;
        let finding = &closed.verdict.findings[place];
        let other = on_joints(closed, &rival.effect, &rival.joints);
        let words = parted_by(closed, &finding.effect, &rival.effect);
        if let (true, Some(words)) = (is_same(&rival), words) {
            others.push_str(&by_no_motion(&called(&finding.effect), &other, &words));
            continue;
        }
        let without = match rivals(closed, finding, place, rival) {
            None => Without::Motion,
            Some(_) if pairs.len() == MOST_MOTIONS => {
                more += 1;
                continue;
            }
            Some(both) => match have_own_columns(spec, text, &both[0], &both[1]) {
                Ok(true) => {
                    pairs.push((rival, both));
                    continue;
                }
                Ok(false) => Without::Column,
                Err(_) => Without::Spec,
            },
        };
        others.push_str(&no_motion(&called(&finding.effect), &other, without));
    }
    let joints = &closed.before.arm.compiled().model.joints;
    let unbound = joints.iter().find(|joint| joint.limits.velocity.is_none());
    let first = unbound.map(|joint| {
        format!(
            ", after adding limits of `{}` and the other joints to the spec (`velocity = ..`)",
            joint.name
        )
    });
    let first = first.unwrap_or_default();
    let pairs = pairs.iter().map(|(rival, both)| Pair {
        named: called(&closed.verdict.findings[rival.instead_of].effect),
        rival: on_joints(closed, &rival.effect, &rival.joints),
        is_same: is_same(rival),
        is_worse: is_worse(rival.worse_folds),
        has_memory: has_memory(closed, &closed.verdict.findings[rival.instead_of].effect)
            || has_memory(closed, &rival.effect),
        both,
    });
    if more > 0 {
        others.push_str(&not_tried(more));
    }
    let is_one = alternatives.len() == 1;
    commands(spec, &first, is_one, &pairs.collect::<Vec<_>>()) + &others
}

/// The line of an alternative for which no motion is designed.
fn no_motion(named: &str, rival: &str, without: Without) -> String {
    format!(
        "  no motion is designed that separates {named} from {rival}: {}; declare each in turn and compare their errors on a log of another \
         motion (`robot-model identify --validate`)\n",
        without.words()
    )
}

/// The line of an alternative that is the same along the logs, and that no motion tells apart, as the effects' own comments say.
fn by_no_motion(named: &str, rival: &str, words: &str) -> String {
    format!(
        "  along these logs {named} and {rival} are identical; they are distinguished by {words}\n"
    )
}

/// What distinguishes two effects, where that is no motion.
fn parted_by(closed: &Loop, one: &str, other: &str) -> Option<String> {
    let definitions = &closed.before.arm.compiled().model.definitions;
    let of = |name: &str, other: &str| -> Option<String> {
        let definition = definitions.iter().find(|one| one.name == name)?;
        let confusions = definition.confusions().ok()?.into_iter();
        let mut own = confusions.filter(|one| one.effects.iter().any(|name| name == other));
        let without = own.find(|one| !one.is_parted_by_motion())?;
        Some(without.parted_by.trim_end_matches('.').to_owned())
    };
    of(one, other).or_else(|| of(other, one))
}

/// The line of so many alternatives beyond those whose motions are told.
fn not_tried(more: usize) -> String {
    let (them, is) = if more == 1 {
        ("alternative", "is")
    } else {
        ("alternatives", "are")
    };
    format!(
        "  {more} more {them} {is} not tried for a motion of their own: put the name in the place of that behind `--from`, or trace the log of a \
         motion above beside these logs first\n"
    )
}

/// What is named and what may be instead, in words and as `excite` takes them.
struct Pair<'a> {
    named: String,
    rival: String,
    /// Whether they are the same along the logs.
    is_same: bool,
    /// Whether the rival has the larger error in every fold.
    is_worse: bool,
    /// Whether one of them has internal states, which a search follows along every motion.
    has_memory: bool,
    both: &'a [String; 2],
}

/// A line for each of them, with its command; `first` is what has to be done before, and `is_one` whether there is but one alternative.
fn commands(spec: &str, first: &str, is_one: bool, pairs: &[Pair]) -> String {
    let mut out = String::new();
    for (number, pair) in pairs.iter().enumerate() {
        let tells = if is_one {
            "separates them".to_owned()
        } else {
            format!("separates {} from {}", pair.named, pair.rival)
        };
        let what = if pair.is_same {
            format!("along these logs they are identical; find out which motion {tells}, if any")
        } else if pair.is_worse {
            format!(
                "{} is worse in every fold of these logs; to be sure, design the motion that best {tells}",
                pair.rival
            )
        } else {
            format!("these logs cannot decide; design the motion that best {tells}")
        };
        let command = experiment(spec, pair, number);
        writeln!(out, "  {what}{first}: {command}").expect(PUT);
    }
    out
}

/// The command, whose motion has a file of its own.
fn experiment(spec: &str, pair: &Pair, number: usize) -> String {
    let number = match number {
        0 => String::new(),
        number => (number + 1).to_string(),
    };
    let [own, other] = pair.both;
    let budget = if pair.has_memory {
        format!(" --budget {BUDGET_S}")
    } else {
        String::new()
    };
    format!(
        "robot-model excite {} --separate '{own}' --from '{other}'{budget} --out next{number}.csv",
        quoted(spec)
    )
}

#[cfg(test)]
mod tests {
    use super::{Pair, Without, by_no_motion, commands, is_worse, no_motion, not_tried};

    #[test]
    fn each_alternative_has_the_command_of_a_motion() {
        let both = ["cubic_viscous on elbow", "stribeck on elbow"].map(|rival| {
            [
                "quadratic_viscous on elbow: c = 0.2".to_owned(),
                rival.to_owned(),
            ]
        });
        let pair = |k: usize| Pair {
            named: "quadratic-viscous".to_owned(),
            rival: ["cubic-viscous on elbow", "stribeck on elbow"][k].to_owned(),
            is_same: k == 1,
            is_worse: false,
            has_memory: false,
            both: &both[k],
        };
        assert_eq!(
            commands("arm.robot", "", false, &[pair(0), pair(1)]),
            "  these logs cannot decide; design the motion that best separates quadratic-viscous from cubic-viscous on elbow: robot-model excite \
             arm.robot --separate 'quadratic_viscous on elbow: c = 0.2' --from 'cubic_viscous on elbow' --out next.csv\n  along these logs they \
             are identical; find out which motion separates quadratic-viscous from stribeck on elbow, if any: robot-model excite arm.robot \
             --separate 'quadratic_viscous on elbow: c = 0.2' --from 'stribeck on elbow' --out next2.csv\n"
        );
        let one = commands("arm.robot", "", true, &[pair(0)]);
        assert!(one.contains("the motion that best separates them"), "{one}");
        let bristles = Pair {
            has_memory: true,
            ..pair(0)
        };
        let told = commands("arm.robot", "", true, &[bristles]);
        assert!(told.ends_with(" --budget 600 --out next.csv\n"), "{told}");
        let worse = Pair {
            is_worse: true,
            ..pair(0)
        };
        let told = commands("arm.robot", "", true, &[worse]);
        let words =
            "cubic-viscous on elbow is worse in every fold of these logs; to be sure, design";
        assert!(told.contains(words), "{told}");
    }

    #[test]
    fn alternatives_that_no_motion_tells_apart_are_told_with_what_does() {
        assert_eq!(
            by_no_motion(
                "asymmetric-coulomb",
                "torque-offset on elbow",
                "no motion; samples at rest distinguish them"
            ),
            "  along these logs asymmetric-coulomb and torque-offset on elbow are identical; they are distinguished by no motion; samples \
             at rest distinguish them\n"
        );
        assert!(not_tried(1).starts_with("  1 more alternative is not tried"));
        assert!(not_tried(2).starts_with("  2 more alternatives are not tried"));
    }

    #[test]
    fn what_is_worse_in_every_fold_is_distinguished() {
        assert!(is_worse(Some((5, 5))));
        assert!(!is_worse(Some((4, 5))) && !is_worse(None));
    }

    #[test]
    fn an_alternative_without_a_motion_has_the_reason() {
        let told = no_motion(
            "joint-spring",
            "gravity-compensation-spring on hip",
            Without::Column,
        );
        assert!(
            told.starts_with(
                "  no motion is designed that separates joint-spring from gravity-compensation-spring on hip: a parameter of one of them"
            ),
            "{told}"
        );
        assert_ne!(Without::Motion.words(), Without::Column.words());
    }
}
