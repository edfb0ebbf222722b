//! Of candidates that pass, the one that is named.

use super::gate::{self, Judged, MATERIAL_PERCENT};
use super::search::{Accepted, OwnShapes, is_of_phase};
use super::verdict::Alternative;

/// Of the power that a law of the part of a period explains, how much one of the motion has to explain to go before it.
const NEARLY_ALL: f64 = 0.9;

/// In a motion that repeats every law of the motion is one of the part of the period as well, and a force that sets in and ends with a stroke takes
/// in whatever goes with the direction. So laws of the motion go before it, where they explain nearly as much; what they leave is for the next
/// round.
fn motion_first(judged: &mut Vec<Judged>) {
    let explained = |judged: &Judged| -> f64 {
        let percent = judged.evidence.raw_percent.iter();
        percent
            .map(|percent| 1.0 - (1.0 - percent / 100.0).powi(2))
            .sum()
    };
    let is_first = judged
        .first()
        .filter(|first| is_of_phase(first.trial.candidate));
    let Some(enough) = is_first.map(|first| NEARLY_ALL * explained(first)) else {
        return;
    };
    let is_rival =
        |judged: &Judged| !is_of_phase(judged.trial.candidate) && explained(judged) >= enough;
    if judged.iter().any(is_rival) {
        judged.retain(|judged| !is_of_phase(judged.trial.candidate));
    }
}

/// The best candidate and those that are as good within the size that matters; of these the simplest is taken that none encompasses.
pub(super) fn choose<'a>(
    mut judged: Vec<Judged<'a>>,
    encompasses: &dyn Fn(&Judged, &Judged, usize) -> bool,
) -> Option<Accepted<'a>> {
    motion_first(&mut judged);
    let best = judged.first()?.raw_power.clone();
    let mut class: Vec<Judged<'a>> = judged
        .into_iter()
        .filter(|judged| gate::worse_percent(&judged.raw_power, &best) <= MATERIAL_PERCENT)
        .collect();
    // Stable: among equally simple laws the one with the larger merit stays first. A logged channel that accounts for a change goes before
    // a law of time alone.
    class.sort_by_key(|judged| {
        let reads_no_channel = judged.trial.candidate.inputs().is_empty();
        (judged.trial.complexity(), reads_no_channel)
    });
    let mut place = 0;
    for other in 1..class.len() {
        if encompasses(&class[other], &class[place], class.len() - 1) {
            place = other;
        }
    }
    let chosen = class.remove(place);
    let rivals = class
        .into_iter()
        .map(|rival| {
            let worse = gate::worse_percent(&rival.raw_power, &chosen.raw_power);
            Alternative {
                worse_folds: worse_folds(&rival.fold_power, &chosen.fold_power),
                ..Alternative::of(rival.trial.candidate, 0, worse)
            }
        })
        .collect();
    Some(Accepted {
        changed: chosen.changed.map(|changed| OwnShapes {
            values: changed.shapes,
            std: changed.std,
        }),
        is_small: false,
        evidence: chosen.evidence,
        trial: chosen.trial,
        rivals,
    })
}

/// In how many folds the error of `one` is larger than that of `other`, and of how many; none where folds are not the same.
fn worse_folds(one: &[f64], other: &[f64]) -> Option<(usize, usize)> {
    let larger = one.iter().zip(other).filter(|(one, other)| one > other);
    (!one.is_empty() && one.len() == other.len()).then(|| (larger.count(), one.len()))
}

#[cfg(test)]
mod tests {
    use super::super::trial::Trial;
    use super::super::verdict::Evidence;
    use super::*;
    use crate::columns::{Candidate, Columns, Entry, Shape, Unknown};
    use crate::motion::Motion;

    /// A law by its name, how many parameters it has, and the channels that it reads.
    struct Law {
        kind: &'static str,
        unknowns: Vec<Unknown>,
        inputs: Vec<String>,
        shapes: Vec<Shape>,
    }

    impl Columns for Law {
        fn unknowns(&self) -> &[Unknown] {
            &self.unknowns
        }

        fn shapes(&self) -> &[Shape] {
            &self.shapes
        }

        fn uses_rigid_torque(&self) -> bool {
            false
        }

        fn inputs(&self) -> &[String] {
            &self.inputs
        }

        fn entries(&self, _: &Motion, _: &[f64]) -> Vec<Entry> {
            Vec::new()
        }
    }

    impl Candidate for Law {
        fn kind(&self) -> &str {
            self.kind
        }

        fn joints(&self) -> &[usize] {
            &[0]
        }
    }

    fn law(kind: &'static str, parameters: usize, inputs: &[&str]) -> Law {
        let unknown = |number| Unknown {
            name: format!("{kind}.{number}"),
            nonnegative: false,
        };
        Law {
            kind,
            unknowns: (0..parameters).map(unknown).collect(),
            inputs: inputs.iter().map(|&name| name.to_owned()).collect(),
            shapes: Vec::new(),
        }
    }

    /// The law that is named and the rest, of laws with their errors in the order of their merit.
    fn chosen<'a>(
        laws: &'a [(Law, f64)],
        encompasses: &dyn Fn(&str, &str) -> bool,
    ) -> (&'a str, Vec<String>) {
        // Of an error of 2 without any law.
        let judged = laws.iter().map(|(law, error)| Judged {
            trial: Trial::first_order(law, Vec::new()),
            evidence: Evidence::certain(&[50.0], &[100.0 - 50.0 * error]),
            merit: -error.ln(),
            raw_power: vec![error * error],
            fold_power: vec![error * error; 5],
            refusals: Vec::new(),
            keeps_signs: true,
            changed: None,
        });
        let kind = |judged: &Judged| judged.trial.candidate.kind().to_owned();
        let chosen = choose(judged.collect(), &|one, other, _| {
            encompasses(&kind(one), &kind(other))
        });
        let chosen = chosen.expect("one of them");
        let rivals = chosen.rivals.into_iter().map(|rival| rival.kind).collect();
        (chosen.trial.candidate.kind(), rivals)
    }

    #[test]
    fn the_simplest_of_those_that_are_alike_is_named() {
        let laws = [
            (law("long", 3, &[]), 1.0),
            (law("middling", 2, &[]), 1.01),
            (law("short", 1, &[]), 1.04),
            (law("worse", 1, &[]), 1.06),
        ];
        let (named, rivals) = chosen(&laws, &|_, _| false);
        assert_eq!(named, "short");
        assert_eq!(rivals, ["middling", "long"], "`worse` is by 6 %");
    }

    #[test]
    fn folds_tell_how_often_an_alternative_is_worse() {
        assert_eq!(worse_folds(&[1.1, 0.9, 1.2], &[1.0; 3]), Some((2, 3)));
        assert_eq!(worse_folds(&[1.0; 3], &[1.0; 3]), Some((0, 3)));
        assert_eq!(worse_folds(&[1.0; 3], &[1.0; 10]), None);
        assert_eq!(worse_folds(&[], &[]), None);
    }

    #[test]
    fn a_law_of_a_channel_goes_before_one_of_time() {
        let laws = [
            (law("drift", 2, &[]), 1.0),
            (law("warmth", 2, &["temperature"]), 1.02),
        ];
        let (named, rivals) = chosen(&laws, &|_, _| false);
        assert_eq!((named, rivals), ("warmth", vec!["drift".to_owned()]));
    }

    #[test]
    fn a_law_of_the_motion_goes_before_one_of_the_part_of_a_period() {
        let phase = law("stroke", 1, &[crate::log::MOTION_PHASE]);
        let mut laws = [
            (phase, 0.7),
            (law("bent", 2, &[]), 0.79),
            (law("dry", 1, &[]), 0.8),
        ];
        // 88 % of the power is explained by it, and 84 % by the others.
        let (named, rivals) = chosen(&laws, &|_, _| false);
        assert_eq!((named, rivals), ("dry", vec!["bent".to_owned()]));
        // 79 %, and 48 and 45 %.
        (laws[1].1, laws[2].1) = (1.44, 1.48);
        assert_eq!(chosen(&laws, &|_, _| false), ("stroke", Vec::new()));
    }

    /// Bristles whose friction does not rise have no use for a speed at which it does.
    #[test]
    fn a_law_with_a_shape_at_zero_is_a_simpler_one() {
        let grids = [[0.1, 0.2, 0.3], [0.1, 0.2, 0.3], [0.0, 1.0, 2.0]].map(Vec::from);
        let shapes = grids.map(|grid| Shape {
            name: String::new(),
            grid,
        });
        let bristles = Law {
            shapes: shapes.into(),
            ..law("bristles", 2, &[])
        };
        let complexity = |rise: f64, is_felt: [bool; 3]| {
            let trial = Trial {
                shapes: vec![0.15, 0.15, rise],
                is_felt: is_felt.into(),
                ..Trial::first_order(&bristles, Vec::new())
            };
            trial.complexity()
        };
        assert_eq!(complexity(0.5, [true; 3]), 5);
        assert_eq!(complexity(0.5, [true, false, true]), 5);
        assert_eq!(complexity(0.0, [true, false, true]), 3);
        assert_eq!(complexity(0.0, [true; 3]), 4);
    }

    #[test]
    fn a_law_that_encompasses_the_simpler_one_is_named() {
        let laws = [
            (law("spring", 2, &[]), 1.0),
            (law("offset", 1, &[]), 1.01),
            (law("other", 1, &[]), 1.02),
        ];
        let is_said = |one: &str, other: &str| (one, other) == ("spring", "offset");
        let (named, rivals) = chosen(&laws, &is_said);
        assert_eq!(named, "spring");
        assert_eq!(rivals, ["offset", "other"]);
    }
}
