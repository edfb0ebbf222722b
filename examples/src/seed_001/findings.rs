//! What is wrong in the paper, item by item, as the library shows it.

use robot_model::identify::output_error::{OutputErrorError, OutputEstimate};
use robot_model::simulate::Functions as _;

use super::audit::{self, Rest};
use super::rows::Results;
use super::truth::{BOUNDS, CAD, NAMES, Printed};
use crate::paper::{Error, Row};

impl Results {
    pub(super) fn metrics_of_text(&self) -> Row {
        let own = self.validations.iter();
        let pairs = own.map(|own| audit::metrics(&own.measured, &own.cad, own.link));
        let pairs: Vec<[Printed; 2]> = pairs.collect();
        let is_void = |[as_said, mended]: &[Printed; 2]| {
            as_said.mae < 1e-12 && (as_said.nrmse - 100.0).abs() < 1e-9 && mended.mae > 1e-3
        };
        let [as_said, mended] = pairs[0];
        Row::wrong_in_print(
            "1.errors",
            "(7), (8): y and y-bar are both the output of the system in the text",
            "MAE 1.0932, NRMSE 35.47 at 10 degrees",
            format!(
                "so {} and {} % whatever the model; with the model's output {:.4} and {:.2} %",
                as_said.mae, as_said.nrmse, mended.mae, mended.nrmse
            ),
            pairs.iter().all(is_void),
            "one of the two is the model's output",
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
            "eleven parameters from releases: m1 6.813 kg, m2 3.361 kg, ..",
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
            "five sums of products and friction times any factor move alike, so no mass, center, inertia or friction has a value",
        )
    }

    pub(super) fn cost_of_text(&self) -> Result<Row, Error> {
        let said = audit::look_for_angles(&self.arm)?;
        let is_size = matches!(
            said,
            Err(OutputErrorError::Size { expected: 11, found, .. }) if found > 11
        );
        Ok(Row::wrong_in_print(
            "1.cost",
            "(9), (10): the text looks for lambda, the measured angles, and calls theta the parameters",
            "lambda-hat = arg min of (9)",
            said.map_or_else(|error| error.to_string(), |()| "accepted".to_owned()),
            is_size,
            "lambda and theta are exchanged in the text",
        ))
    }

    pub(super) fn friction(&self) -> Row {
        let told = &self.told;
        let ratio = told
            .base
            .ratios
            .iter()
            .find(|ratio| ratio.name.contains("q2.coulomb"));
        let is_refused = told.eleven.std[7..].iter().all(Option::is_none);
        let cad = self.model.constants.own(&CAD.values());
        let of_cad = |name: &String| {
            let place = told.names.iter().position(|other| other == name);
            place.map_or(f64::NAN, |place| cad[place])
        };
        let frictions = told.base.ratios.iter();
        let frictions = frictions.filter(|ratio| ratio.name.contains("friction"));
        let is_less = frictions.clone().count() == 4
            && frictions
                .into_iter()
                .all(|ratio| ratio.value < of_cad(&ratio.name) / of_cad(&ratio.reference));
        Row::wrong_in_print(
            "1.friction",
            "friction \"determined experimentally\" as 0.35, and found oversized by the estimation",
            "0.35 -> 0.335, 0.279, 0.203, 0.076",
            format!(
                "no value of f_c, f_d is told; {}",
                ratio.map_or("nor a ratio".to_owned(), |ratio| format!(
                    "{} / {} = {:.4}, by Table 2 {:.4}",
                    ratio.name,
                    ratio.reference,
                    ratio.value,
                    of_cad(&ratio.name) / of_cad(&ratio.reference)
                ))
            ),
            is_refused && is_less,
            "a release tells friction over gravity's moment only; all four such ratios are less than Table 2 has them",
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
                "up to {largest:.2} degrees from 0, gravity at most {share:.2} of dry friction, {apart:.0e} degrees from the motion by hand; with tanh in its place all end within {smooth:.0e} degrees of 0"
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
        "Table 5 is said to be 30 % less and more than Table 2",
        "+- 30 %",
        names.join("; "),
        off.iter().map(|off| off.name).eq(["m1", "m2", "l1", "c1"]),
        "four of the seven bounds are others",
    )
}

/// Parameters that have a value of their own.
fn names_told(estimate: &OutputEstimate) -> Vec<&'static str> {
    let pairs = NAMES.into_iter().zip(&estimate.std);
    let told = pairs.filter(|(_, std)| std.is_some());
    told.map(|(name, _)| name).collect()
}
