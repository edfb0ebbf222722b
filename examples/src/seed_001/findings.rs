//! What is wrong in the paper, item by item, as the library shows it.

use robot_model::identify::output_error::{Ending, OutputEstimate, Ratio};
use robot_model::simulate::Functions as _;

use super::audit::{self, Rest};
use super::rows::Results;
use super::truth::{BOUNDS, CAD, ESTIMATED, HEIGHTS, NAMES, Printed, SHARE};
use crate::paper::Row;

impl Results {
    pub(super) fn metrics_of_text(&self) -> Row {
        let own = self.validations.iter();
        let pairs = own.map(|own| audit::metrics(&own.measured, &own.cad, own.link));
        let pairs: Vec<[Printed; 2]> = pairs.collect();
        let [as_said, mended] = pairs[0];
        let is_blind = pairs.iter().all(|pair| pair[0] == as_said);
        let heights = HEIGHTS.iter();
        let printed = heights.flat_map(|height| height.before.iter().chain(&height.after));
        let printed: Vec<&Printed> = printed.collect();
        // To the digits that are printed.
        let near = |x: f64, y: f64, digits: f64| (x - y).abs() < digits;
        let same = |one: &&&Printed| {
            near(one.mae, as_said.mae, 1e-4) || near(one.nrmse, as_said.nrmse, 1e-2)
        };
        let same = printed.iter().filter(same).count();
        Row::remark(
            "1.errors",
            "the sentence that explains (7), (8), which are right: y and y-bar are both the output of the system; beside Tables 3, 4, 7 and 8",
            format!(
                "MAE {}, NRMSE {} at {} degrees",
                printed[0].mae, printed[0].nrmse, HEIGHTS[0].angle
            ),
            format!(
                "so {} and {} % whatever the model, which {same} of {} printed pairs are; with the model's output {:.4} and {:.2} %",
                as_said.mae,
                as_said.nrmse,
                printed.len(),
                mended.mae,
                mended.nrmse
            ),
            is_blind && same == 0 && pairs.iter().any(|pair| pair[1] != mended),
            "the sentence has the wrong symbols, the equations are right: one of the two is the model's output",
        )
    }

    pub(super) fn rank(&self) -> Row {
        let own = &self.told.eleven.identifiability;
        let (rank, mended) = (own.rank, &self.told.mended.identifiability);
        let told: Vec<&str> = names_told(&self.told.eleven);
        let silent: Vec<&str> = own
            .directions
            .iter()
            .filter(|direction| direction.is_silent())
            .flat_map(|direction| direction.moves.iter().map(|(name, _)| name.as_str()))
            .collect();
        let is_moved = |name: &&str| silent.contains(name);
        let moved: Vec<&str> = NAMES.into_iter().filter(is_moved).collect();
        let weakest = own.singular.get(7).copied().unwrap_or(0.0);
        let null = own.singular.get(8).copied().unwrap_or(1.0);
        Row::wrong_in_print(
            "1.rank",
            "eleven parameters from releases: m1 6.813 kg, m2 3.361 kg, ..; by the `identifiability` of the library's output error, which `identify --method \
             output-error` prints of the spec's own constants, too: rank, null directions, and which of them have no value; there is no verb of that name",
            "11 values (Tables 6, 11)",
            format!(
                "rank {rank} of {}: the eighth singular value is {weakest:.1e} of the first, the ninth {null:.0e}; null directions move {}; told is {}; with {} known rank {} of {}",
                own.singular.len(),
                moved.join(", "),
                told.join(", "),
                audit::KNOWN.join(", "),
                mended.rank,
                mended.singular.len()
            ),
            rank == 8
                && own.singular.len() == 11
                && weakest >= 7e-3
                && null <= 1.3e-6
                && moved.len() == 10
                && told == ["l1"],
            &format!(
                "{} sums of products and friction times any factor move alike, so no mass, center, inertia or friction has a value",
                self.differences.base.len()
            ),
        )
    }

    pub(super) fn cost_of_text(&self) -> Row {
        let (angles, values) = (audit::angles(), NAMES.len());
        let own = &self.found.exact;
        let ending = if own.ending == Ending::Converged {
            "converges"
        } else {
            "does not converge"
        };
        Row::remark(
            "1.cost",
            "the sentences that explain (9), (10), which are right: the text looks for lambda, the measured angles, and calls theta the parameters; by counts",
            "lambda-hat = arg min of (9)",
            format!(
                "lambda has {angles} values at {} degrees, Tables 6 and 11 have {values}; a search for these {ending}",
                HEIGHTS[HEIGHTS.len() - 1].angle
            ),
            angles != values && own.values.len() == values && own.ending == Ending::Converged,
            "the sentences have the wrong symbols, the equations are right: lambda and theta are exchanged",
        )
    }

    pub(super) fn friction(&self) -> Row {
        let told = &self.told;
        let [cad, truth] = [CAD, ESTIMATED].map(|arm| self.model.constants.own(&arm.values()));
        let of = |values: &[f64], name: &str| {
            let place = told.names.iter().position(|other| other == name);
            place.map_or(f64::NAN, |place| values[place])
        };
        let ratio =
            |values: &[f64], ratio: &Ratio| of(values, &ratio.name) / of(values, &ratio.reference);
        let frictions = told.base.ratios.iter();
        let frictions: Vec<&Ratio> = frictions
            .filter(|ratio| ratio.name.contains("friction"))
            .collect();
        let values = told.eleven.std[7..].iter().flatten().count();
        let is_right = |one: &&Ratio| (one.value / ratio(&truth, one) - 1.0).abs() < 0.03;
        let said = frictions.iter().map(|one| {
            format!(
                "{} {:.4} ({:.4}, {:.4})",
                one.name,
                one.value,
                ratio(&truth, one),
                ratio(&cad, one)
            )
        });
        Row::remark(
            "1.friction",
            "what releases tell of friction, \"determined experimentally\" and then found oversized",
            "0.35 -> 0.335, 0.279, 0.203, 0.076",
            format!(
                "{values} of four values in newton meters; over {} (Table 6, of the arm that is let go; Table 2): {}",
                frictions.first().map_or("", |one| &one.reference),
                said.collect::<Vec<_>>().join(", ")
            ),
            values == 0 && frictions.len() == 4 && frictions.iter().all(is_right),
            "no misprint: friction has no value in newton meters, only its ratios are told",
        )
    }

    pub(super) fn rest(&self) -> Row {
        let far = |of: fn(&Rest) -> [f64; 2]| {
            let all = self.rests.iter().flat_map(of);
            all.fold(0.0_f64, |most, q| most.max(q.abs().to_degrees()))
        };
        let apart = far(|rest| {
            [
                rest.by_hand[0] - rest.library[0],
                rest.by_hand[1] - rest.library[1],
            ]
        });
        let largest = far(|rest| rest.library);
        let smooth = far(|rest| rest.smooth);
        let shares = self.rests.iter().flat_map(|rest| rest.share);
        let share = shares.fold(0.0, f64::max);
        Row::holds(
            "1.rest",
            "arms do not stop at 0 degrees: they stand where dry friction holds gravity",
            "not at 0 in any case",
            format!(
                "up to {largest:.2} degrees from 0, gravity at most {share:.2} of dry friction, {apart:.0e} degrees from the motion by hand; with tanh in its place they end within {smooth:.0e} degrees of 0"
            ),
            share <= 1.0 && apart < 1e-3 && largest > 0.1 && smooth < 1e-3,
            "arms stand elsewhere",
        )
    }
}

pub(super) fn bounds_of_text() -> Row {
    let off = audit::off(&BOUNDS);
    let names: Vec<String> = off
        .iter()
        .map(|off| {
            let ([low, high], [least, most]) = (off.said, off.printed);
            format!("{}: {low:.2} .. {high:.2}, not {least} .. {most}", off.name)
        })
        .collect();
    Row::wrong_in_print(
        "1.bounds",
        "Table 5 is said to be 30 % less and more than Table 2: ranges that are others, by `other_ranges` of the library, as `--within 30` says beside `--bounds`",
        format!("+- {:.0} %", 100.0 * SHARE),
        names.join("; "),
        off.iter().map(|off| off.name).eq(["m1", "m2", "l1", "c1"]),
        &format!(
            "{} of the {} bounds are others",
            off.len(),
            audit::said().len()
        ),
    )
}

/// Parameters that have a value of their own.
fn names_told(estimate: &OutputEstimate) -> Vec<&'static str> {
    let pairs = NAMES.into_iter().zip(&estimate.std);
    let told = pairs.filter(|(_, std)| std.is_some());
    told.map(|(name, _)| name).collect()
}
