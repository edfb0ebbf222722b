//! Whether parameters that cannot be negative are not.

use robot_model_codegen::Compiled;
use robot_model_spec::parameter::Owner;

use super::{Check, Finding, MISSED, Quantity};
use crate::output::{counted, rounded};
use crate::parameters::Values;

/// Parameters that the language says are not negative. Deviations are those of base parameters, as far as they are known: an estimate of what is
/// zero is below zero as often as above.
pub(super) fn check(compiled: &Compiled, values: &Values, deviations: &[Option<f64>]) -> Check {
    let model = &compiled.model;
    // Those of links are of bodies.
    let all: Vec<usize> = (0..compiled.standard.len())
        .filter(|&k| matches!(compiled.standard[k].owner, Owner::Effect { .. }))
        .filter(|&k| model.is_nonnegative(&compiled.standard[k]))
        .collect();
    let below = all.iter().filter_map(|&k| {
        // A base parameter that is the parameter itself.
        let combinations = compiled.base.combinations.iter();
        let place = combinations
            .zip(&compiled.base.kept)
            .position(|(combination, &kept)| kept == k && combination.len() == 1);
        let value = match &values.standard {
            Some(standard) => standard[k],
            None => place.map(|place| values.beta[place]),
        };
        let std = place.and_then(|place| deviations.get(place).copied().flatten());
        let value = value.filter(|value| *value < 0.0)?;
        Some(Below {
            name: &compiled.standard[k].name,
            value,
            deviations: std.map(|std| -value / std),
        })
    });
    let below: Vec<Below> = below.collect();
    let scope = format!(
        "{} that cannot be negative: friction, rotors",
        counted(all.len(), "parameter")
    );
    judged(scope, &below)
}

/// A parameter below zero.
struct Below<'a> {
    name: &'a str,
    value: f64,
    /// So many standard deviations, where one is known.
    deviations: Option<f64>,
}

impl Below<'_> {
    fn is_wrong(&self) -> bool {
        self.deviations.is_none_or(|deviations| deviations > MISSED)
    }

    fn told(&self) -> Finding {
        let mut quantities = vec![Quantity::of("value", self.name, self.value, "")];
        let mut said = format!("`{}` is {}", self.name, rounded(self.value));
        if let Some(deviations) = self.deviations {
            quantities.push(Quantity::of("deviations", self.name, deviations, ""));
            said = format!("{said}, {deviations:.1} standard deviations below zero");
        }
        if !self.is_wrong() {
            said = format!("may be zero or more within standard deviations: {said}");
        }
        (said, quantities)
    }
}

/// What is wrong, or else what deviations leave open.
fn judged(scope: String, below: &[Below]) -> Check {
    let told = |wrong: bool| {
        let some = below.iter().filter(move |one| one.is_wrong() == wrong);
        some.map(Below::told).collect::<Vec<Finding>>()
    };
    let wrong = told(true);
    if wrong.is_empty() {
        Check::noted("signs", scope, told(false))
    } else {
        Check::new("signs", scope, wrong)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_below_zero_by_less_than_chance_is_noted() {
        let below = |deviations| Below {
            name: "elbow.coulomb_friction.fc",
            value: -0.012,
            deviations,
        };
        let judged = |all: &[Below]| judged(String::new(), all);
        let noted = judged(&[below(Some(0.3))]);
        assert_eq!(noted.passed, Some(true));
        assert_eq!(
            noted.findings,
            [
                "may be zero or more within standard deviations: `elbow.coulomb_friction.fc` is -0.012, 0.3 standard deviations below zero"
            ]
        );
        let wrong = judged(&[below(Some(0.3)), below(Some(2.5)), below(None)]);
        assert_eq!(wrong.passed, Some(false));
        assert_eq!(
            wrong.findings,
            [
                "`elbow.coulomb_friction.fc` is -0.012, 2.5 standard deviations below zero",
                "`elbow.coulomb_friction.fc` is -0.012"
            ]
        );
    }
}
