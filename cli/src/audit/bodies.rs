//! Whether links are bodies: mass that is spread over space.

use robot_model::Inertial;
use robot_model_codegen::Compiled;

use super::{Check, Finding, MISSED, Quantity};
use crate::interpreted::{Moved, Widths, payloads, possible_arms};
use crate::output::{counted, rounded};
use crate::parameters::Values;

/// Second moments of mass are taken to be known to this share of the largest: published ones have three digits or more.
const SHARE: f64 = 1e-3;

/// Rounding of sums.
const ROUNDING: f64 = 1e-9;

/// How many of them are shown.
const SHOWN: usize = 8;

/// The same of deviations that stand for those of a file where nobody says any, by which base parameters of an arm that can be miss the values.
const MISSED_SHARES: f64 = 3.0;

/// Deviations below which a value is missed by the search alone.
const OF_SEARCH: f64 = 0.1;

/// By how much wider deviations are searched with where a search with narrower ones comes to no end.
const WIDER: [f64; 3] = [1.0, 10.0, 100.0];

/// `None` for a robot that says its energies. Deviations are those of base parameters, as far as they are known.
pub(super) fn check(
    compiled: &Compiled,
    values: &Values,
    deviations: &[Option<f64>],
) -> Option<Check> {
    let chain = compiled.model.chain()?;
    let count = counted(chain.links.len(), "link");
    let Some(standard) = &values.standard else {
        let scope =
            format!("{count}, by base parameters: whether physically possible links have them");
        let widths = Widths::new(compiled, &values.beta, deviations);
        return Some(of_base(compiled, &values.beta, &widths, scope));
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
        let said = "no mass, but nonzero moments of mass".to_owned();
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
        "a moment of inertia is negative".to_owned()
    } else if far > 0.5 * (ixx + iyy + izz) {
        format!(
            "its center of mass is {away:.3} m from the frame's origin, too far for its moments of inertia"
        )
    } else {
        "about the center of mass a moment of inertia exceeds the sum of the other two".to_owned()
    };
    let least = spread.min();
    let said = format!("{why}: least second moment of mass {least:.3e} kg m^2");
    Some((said, "least_second_moment", least, "kg m^2"))
}

/// Base parameters that would have to be others, were every link a body.
fn of_base(compiled: &Compiled, beta: &[f64], widths: &Widths, scope: String) -> Check {
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
    let missed = WIDER.into_iter().find_map(|wider| {
        let wide: Vec<f64> = widths.values.iter().map(|one| wider * one).collect();
        let (nearest, _) = arms.nearest_to(beta, &wide)?;
        let mut moved = Moved::all(compiled, beta, &nearest, widths);
        moved.retain(|moved| is_rigid(moved.column));
        let is_missed = |times: f64| moved.iter().any(|moved| moved.widths > times * most(moved));
        // What is missed by less than the wider search may miss is told by no one.
        (is_missed(wider) || !is_missed(1.0)).then_some((wider, moved))
    });
    judged(scope, missed)
}

/// Deviations, at most, by which an arm that can be misses a value.
fn most(moved: &Moved) -> f64 {
    if moved.has_deviation {
        MISSED
    } else {
        MISSED_SHARES
    }
}

/// What the nearest arm misses, those that are farthest off first. A search that has come to no end says nothing of the values.
fn judged(scope: String, found: Option<(f64, Vec<Moved>)>) -> Check {
    let Some((wider, mut missed)) = found else {
        return Check::undecided(
            "bodies",
            scope,
            "the search for a physically possible arm near these parameters did not converge; run `identify --method physical` on the logs, \
             or give values of standard parameters",
        );
    };
    let is_failed = |moved: &Moved| moved.widths > wider * most(moved);
    if missed.iter().any(is_failed) {
        missed.retain(is_failed);
        let mut findings = listed(
            &missed,
            "not physically possible; the nearest possible arm has ",
        );
        let way_out = "`identify --method physical` finds the possible arm that fits the logs best";
        findings.push((way_out.to_owned(), Vec::new()));
        return Check::new("bodies", scope, findings);
    }
    missed.retain(|moved| moved.has_deviation && moved.widths > OF_SEARCH);
    let note = "possible within standard deviations; the nearest possible arm has ";
    Check::noted("bodies", scope, listed(&missed, note))
}

/// Sentences about values that the nearest arm misses.
fn listed(missed: &[Moved], said: &str) -> Vec<Finding> {
    let mut findings: Vec<Finding> = missed
        .iter()
        .take(SHOWN)
        .map(|moved| {
            let mut quantities = vec![Quantity::of("nearest", &moved.name, moved.nearest, "")];
            if moved.has_deviation {
                quantities.push(Quantity::of("deviations", &moved.name, moved.widths, ""));
            }
            (format!("{said}{}", moved.said()), quantities)
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

    fn moved(widths: f64, has_deviation: bool) -> Moved {
        Moved {
            column: 0,
            name: "a.mx".to_owned(),
            given: 0.0111,
            nearest: 0.011_100_1,
            widths,
            has_deviation,
        }
    }

    #[test]
    fn what_is_within_deviations_is_noted_and_no_failure() {
        let judged =
            |missed: Option<Vec<Moved>>| judged(String::new(), missed.map(|all| (1.0, all)));
        // A search without an end decides nothing.
        assert_eq!(judged(None).passed, None);
        assert_eq!(judged(Some(Vec::new())).passed, Some(true));
        let noted = judged(Some(vec![
            moved(1.9, true),
            moved(0.01, true),
            moved(2.9, false),
        ]));
        assert_eq!(noted.passed, Some(true));
        let said = "possible within standard deviations; the nearest possible arm has `a.mx` 0.0111001 in place of 0.0111000 (1.9 standard \
                    deviations)";
        assert_eq!(noted.findings, [said]);
        assert_eq!(noted.quantity("deviations", Some("a.mx")), Some(1.9));
        for missed in [moved(2.1, true), moved(3.1, false)] {
            let failed = judged(Some(vec![missed, moved(1.0, true)]));
            assert_eq!(failed.passed, Some(false));
            assert_eq!(failed.findings.len(), 2, "{:?}", failed.findings);
            assert!(failed.findings[1].starts_with("`identify --method physical`"));
        }
    }
}
