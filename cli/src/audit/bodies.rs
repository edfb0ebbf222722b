//! Whether links are bodies: mass that is spread over space.

use robot_model::Inertial;
use robot_model_codegen::Compiled;

use super::{Check, Finding, Quantity};
use crate::interpreted::{payloads, possible_arms, share_deviations};
use crate::output::{counted, rounded};
use crate::parameters::Values;

/// Second moments of mass are taken to be known to this share of the largest: published ones have three digits or more.
const SHARE: f64 = 1e-3;

/// Rounding of sums.
const ROUNDING: f64 = 1e-9;

/// How many of them are shown.
const SHOWN: usize = 8;

/// Deviations, at most, by which base parameters of an arm that can be miss the values.
const MISSED: f64 = 3.0;

/// By how much wider deviations are searched with where a search with narrower ones comes to no end.
const WIDER: [f64; 3] = [1.0, 10.0, 100.0];

/// `None` for a robot that says its energies.
pub(super) fn check(compiled: &Compiled, values: &Values) -> Option<Check> {
    let chain = compiled.model.chain()?;
    let count = counted(chain.links.len(), "link");
    let Some(standard) = &values.standard else {
        let scope = format!("{count}, by base parameters: whether some bodies have them");
        return Some(of_base(compiled, &values.beta, scope));
    };
    let links = chain.links.iter().zip(standard.chunks(10));
    let links = links.map(|(link, ten)| ("link ", link.name.clone(), ten.to_vec()));
    let payloads = payloads(compiled).into_iter().map(|payload| {
        let ten = payload.parameters.map(|k| standard[k]);
        ("", payload.name, ten.to_vec())
    });
    let findings = links.chain(payloads).filter_map(|(kind, name, ten)| {
        let ten: Option<Vec<f64>> = ten.into_iter().collect();
        let ten: [f64; 10] = ten?.try_into().ok()?;
        let (reason, what, value, unit) = impossible(&Inertial::from(ten))?;
        let said = format!("{kind}`{name}`: {reason}");
        Some((said, vec![Quantity::of(what, &name, value, unit)]))
    });
    let findings = findings.collect();
    let scope = format!("{count}: mass spread over space");
    Some(Check::new("bodies", scope, findings))
}

/// Why no body has these parameters, and the number that shows it.
fn impossible(inertial: &Inertial) -> Option<(String, &'static str, f64, &'static str)> {
    let mass = inertial.mass;
    let [ixx, _, _, iyy, _, izz] = inertial.inertia;
    if mass < 0.0 {
        return Some((
            format!("a mass of {} kg", rounded(mass)),
            "mass",
            mass,
            "kg",
        ));
    }
    let first = inertial.first_moments;
    let Some(moments) = inertial.second_moments() else {
        let is_nothing = first.iter().chain(&inertial.inertia).all(|x| *x == 0.0);
        let said = "no mass, and moments of mass all the same".to_owned();
        return (!is_nothing).then_some((said, "mass", mass, "kg"));
    };
    let spread = moments.symmetric_eigenvalues();
    let about_origin = inertial.pseudo_inertia().fixed_view::<3, 3>(0, 0).norm();
    // Rounded values of a plate or a rod miss a plane by their last digit.
    if spread.min() >= -SHARE * spread.max().max(ROUNDING * about_origin) {
        return None;
    }
    let com = inertial.com().unwrap_or_default();
    let away = com.iter().map(|x| x * x).sum::<f64>().sqrt();
    // `S` is positive where each moment of inertia is positive and at most the sum of the other two.
    let far = mass * away * away;
    let why = if [ixx, iyy, izz].iter().any(|moment| *moment < 0.0) {
        "a moment of inertia is below zero".to_owned()
    } else if far > 0.5 * (ixx + iyy + izz) {
        format!(
            "its center of mass would be {away:.3} m from the frame's origin, too far for its moments of inertia"
        )
    } else {
        "about the center of mass a moment of inertia exceeds the sum of the other two".to_owned()
    };
    let least = spread.min();
    let said = format!("{why}: least second moment of mass {least:.3e} kg m^2");
    Some((said, "least_second_moment", least, "kg m^2"))
}

/// Base parameters that would have to be others, were every link a body.
fn of_base(compiled: &Compiled, beta: &[f64], scope: String) -> Check {
    let Some(mut arms) = possible_arms(compiled) else {
        return Check::new("bodies", scope, Vec::new());
    };
    // Signs that are no link's are a check of their own.
    let base = &compiled.base;
    let is_rigid = |column: usize| {
        let mut parts = base.combinations[column].iter();
        parts.any(|&(k, _)| compiled.model.is_rigid(&compiled.standard[k]))
    };
    let alone: Vec<usize> = (0..beta.len())
        .filter(|&column| !is_rigid(column))
        .map(|column| base.kept[column])
        .collect();
    arms.nonnegative.retain(|k| !alone.contains(k));
    let deviations = share_deviations(compiled, beta);
    let findings = WIDER.into_iter().find_map(|wider| {
        let wide: Vec<f64> = deviations.iter().map(|one| wider * one).collect();
        let (nearest, _) = arms.nearest_to(beta, &wide)?;
        let missed = |least: f64| missed(compiled, [beta, &nearest, &deviations], least, &is_rigid);
        // What is missed by less than the wider search may miss is told by no one.
        let findings = missed(wider * MISSED);
        (!findings.is_empty() || missed(MISSED).is_empty()).then_some(findings)
    });
    judged(scope, findings)
}

/// A search that has come to no end says nothing of the values.
fn judged(scope: String, findings: Option<Vec<Finding>>) -> Check {
    match findings {
        Some(findings) => Check::new("bodies", scope, findings),
        None => Check::undecided(
            "bodies",
            scope,
            "the search for an arm whose links have bodies came to no end near these parameters; `identify --method physical` on the logs \
             decides, or values of standard parameters do",
        ),
    }
}

/// Base parameters that the nearest arm misses by more than `least` deviations.
fn missed(
    compiled: &Compiled,
    [beta, nearest, deviations]: [&[f64]; 3],
    least: f64,
    is_rigid: &dyn Fn(usize) -> bool,
) -> Vec<Finding> {
    let pairs = beta.iter().zip(nearest).zip(deviations);
    let missed = pairs.map(|((value, near), deviation)| (value - near).abs() / deviation);
    let mut missed: Vec<(f64, usize)> = missed.zip(0..).collect();
    missed.retain(|&(missed, column)| missed > least && is_rigid(column));
    missed.sort_by(|x, y| y.0.total_cmp(&x.0));
    let mut findings: Vec<Finding> = missed
        .iter()
        .take(SHOWN)
        .map(|&(_, k)| {
            let name = &compiled.base.names[k];
            let said = format!(
                "`{name}` is {:.4}; of arms whose links have bodies the nearest has {:.4}",
                beta[k], nearest[k]
            );
            (said, vec![Quantity::of("nearest", name, nearest[k], "")])
        })
        .collect();
    if missed.len() > SHOWN {
        findings.push((format!("and {} more", missed.len() - SHOWN), Vec::new()));
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_without_an_end_decides_nothing() {
        let passed = |findings| judged(String::new(), findings).passed;
        assert_eq!(passed(None), None);
        assert_eq!(passed(Some(Vec::new())), Some(true));
        assert_eq!(
            passed(Some(vec![("`a.mx`".to_owned(), Vec::new())])),
            Some(false)
        );
    }
}
