//! Every item, and what became of it.

use robot_model::identify::Estimate;
use robot_model::trace::{Outcome, Verdict};

use super::fits::{Installation, SECONDS};
use super::results::{COUPLED, Results};
use super::sensors::CONVERTER;
use super::truth::{CONFIGURATIONS, FASTEST, FREQUENCIES, SINES, TABLE_2};
use super::{applications, device, equation_13, equations, tracing};
use crate::paper::Row;

pub(super) fn rows(results: &Results) -> Vec<Row> {
    let [printed, _] = &results.equations;
    let mut all = equations::rows(printed, &results.traces.equation_4);
    all.extend(equation_13::rows(
        printed,
        &results.filters,
        &results.left_by_13,
        CONFIGURATIONS[COUPLED],
    ));
    all.extend(identified(results));
    all.extend(errors(results));
    all.extend(viscous(results));
    all.extend(super::audit::rows(results));
    all.extend(applications::rows(results));
    all
}

/// What a missing effect leaves, over what is left otherwise, at least.
const SEVERAL: f64 = 3.0;

/// The largest of all installations.
fn largest(results: &Results, of: impl Fn(&Installation) -> f64) -> f64 {
    results.installations.iter().map(of).fold(0.0, f64::max)
}

fn identified(results: &Results) -> Vec<Row> {
    let [dropped, train, validate] = SECONDS;
    let conditions = results
        .installations
        .iter()
        .map(|one| one.estimate.condition);
    let worst = conditions.fold(0.0, f64::max);
    let off = |estimate: fn(&Installation) -> &Estimate| {
        [0..8, 11..14, 8..11]
            .map(|which| largest(results, |one| one.off(estimate(one), which.clone())))
    };
    let [rigid, dry, viscous] = off(|one| &one.estimate);
    let [rigid_with, dry_with, _] = off(|one| &one.with_turns);
    let sigma = largest(results, |one| one.deviations_off(&one.estimate, 8..11));
    let ranks: Vec<String> = results
        .installations
        .iter()
        .map(|one| one.estimate.rank.to_string())
        .collect();
    let unknowns = results.installations[0].estimate.parameters.len();
    let tones = results.motion.frequencies();
    let low = tones.iter().map(|[low, _]| format!("{low:.2}"));
    let low: Vec<String> = low.collect();
    let high = tones.iter().map(|[_, high]| format!("{high:.2}"));
    let high: Vec<String> = high.collect();
    let are_printed = tones.iter().all(|tones| {
        let pairs = tones.iter().zip(FREQUENCIES);
        pairs
            .into_iter()
            .all(|(own, printed)| (own - printed).abs() < 1e-9)
    });
    vec![
        Row::holds(
            "4.3",
            "least squares (12), 1 kHz, halves to identify and to validate",
            "more than 40 s, the first seconds dropped",
            format!(
                "{dropped:.0} s dropped, {train:.0} s and {validate:.0} s; rank of 14 in {}: {}",
                CONFIGURATIONS.join(", "),
                ranks.join(", ")
            ),
            results
                .installations
                .iter()
                .all(|one| one.estimate.rank == 14),
            "the motion does not tell all parameters",
        ),
        Row::holds(
            "4.4",
            "ten sines a joint, 0.11 to 5 rad/s, under a PD controller",
            "at least n/2 sines for n unknowns; condition not given",
            format!(
                "{unknowns} unknowns; lowest {}, highest {} rad/s; condition number with unit columns at most {worst:.1}",
                low.join(", "),
                high.join(", ")
            ),
            worst < 20.0 && are_printed && 2 * SINES >= unknowns,
            "the regressor is badly conditioned, or the tones are others",
        ),
        Row::holds(
            "4.5",
            "rigid and Coulomb parameters of five installations in the loop, rows at turns left out; wanted within 1 %",
            "table 1, from a device",
            format!(
                "within {rigid:.2} % and {dry:.2} %; with the rows at turns {rigid_with:.1} % and {dry_with:.2} %"
            ),
            rigid < 1.0 && dry < 1.0,
            "some are farther off",
        ),
        Row::holds(
            "4.5.viscous",
            "their viscous coefficients, wanted within 1 %",
            "table 1, from a device",
            format!("within {viscous:.1} %, {sigma:.1} deviations"),
            viscous < 1.0,
            &told_by_the_converter(results),
        ),
    ]
}

/// Why a viscous coefficient is no better known: what the worst one is in torque, beside a step of the converter.
fn told_by_the_converter(results: &Results) -> String {
    let off = |one: &Installation| {
        let found = device::values(&one.estimate);
        (8..11)
            .map(|k| (found[k] - one.truth[k]).abs())
            .fold(0.0, f64::max)
    };
    let worst = FASTEST * largest(results, off);
    let known = largest(results, |one| {
        let std = device::deviations(&one.estimate);
        let share = |k: usize| 100.0 * (std[k] / one.truth[k]).abs();
        (8..11).map(share).fold(0.0, f64::max)
    });
    format!(
        "the fits of {:.0} s give deviations of up to {known:.1} % themselves: at {FASTEST} rad/s no torque of theirs is off by more than {:.0} uN m, \
         and a step of the converter has {:.0}",
        SECONDS[1],
        1e6 * worst,
        1e6 * CONVERTER
    )
}

fn errors(results: &Results) -> Vec<Row> {
    let whole = largest(results, |one| one.rms.iter().copied().fold(0.0, f64::max));
    let least = results
        .installations
        .iter()
        .flat_map(|one| one.rms_without_friction);
    let least = least.fold(f64::INFINITY, f64::min);
    let most = largest(results, |one| {
        one.rms_without_friction.iter().copied().fold(0.0, f64::max)
    });
    let printed = TABLE_2.iter().flatten();
    let (low, high) = printed.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), x| {
        (low.min(*x), high.max(*x))
    });
    let traces = &results.traces;
    let upright = results.installations[0].rms;
    let p = traces
        .without_friction
        .findings
        .iter()
        .map(|one| one.evidence.p_value);
    let p = p.fold(0.0, f64::max);
    vec![
        Row::holds(
            "4.6",
            "RMS% (15) on the other half, whole model, wanted at most 1 % on a device that is as the model",
            format!("table 2, of a real device: {low} to {high} %"),
            format!("at most {whole:.2} %"),
            whole <= 1.0,
            "more is left",
        ),
        Row::holds(
            "4.6.dropped",
            "RMS% without friction, against table 2",
            format!("{low} to {high} %"),
            format!("{least:.0} to {most:.0} %"),
            least >= low && most <= high,
            &dry_share(results),
        ),
        Row::holds(
            "4.6.unmodelled",
            "RMS% of the whole model on UR whose dry friction falls with speed, which the model lacks; wanted several times what it leaves otherwise",
            format!(
                "UR {} %",
                TABLE_2.map(|joint| joint[0].to_string()).join(", ")
            ),
            format!(
                "{} %, where it leaves {} % otherwise",
                traces.falling_rms.map(|x| format!("{x:.1}")).join(", "),
                upright.map(|x| format!("{x:.1}")).join(", ")
            ),
            traces
                .falling_rms
                .iter()
                .zip(upright)
                .all(|(with, without)| *with > SEVERAL * without),
            "an effect of that size leaves another error",
        ),
        Row::holds(
            "4.7",
            "figure 5: what is left of UR without friction over the velocity",
            "friction, most on joint 1",
            format!(
                "{}; p at most {p:.0e}",
                tracing::said(&traces.without_friction)
            ),
            is_coulomb(&traces.without_friction) && p < 1e-6,
            "the tracer does not name it on all joints",
        ),
        Row::holds(
            "4.7.after",
            "figure 7: what is left of UR with friction",
            "other effects",
            tracing::said(&traces.with_friction),
            traces.with_friction.outcome == Outcome::NothingMissing,
            "the tracer finds more",
        ),
    ]
}

/// Why a model without friction does not leave what table 2 has: that is of a model with friction.
fn dry_share(results: &Results) -> String {
    let shares = results
        .shares
        .iter()
        .flat_map(|one| (0..3).map(|j| 100.0 * one.rms[4][j] / one.torque[j]));
    let (low, high) = shares.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), x| {
        (low.min(x), high.max(x))
    });
    let left = results
        .installations
        .iter()
        .enumerate()
        .flat_map(|(k, one)| {
            let joints = one.rms_without_friction.into_iter().zip(TABLE_2);
            joints.map(move |(left, printed)| left > printed[k])
        });
    let more = left.filter(|is_more| *is_more).count();
    format!(
        "table 2 is of models with friction; dry friction alone is {low:.0} to {high:.0} % of the torque by table 1, and without it {more} of 15 entries are above those of table 2"
    )
}

/// Whether dry friction is named on all three joints, and nothing else.
fn is_coulomb(verdict: &Verdict) -> bool {
    let findings = &verdict.findings;
    let mut joints: Vec<usize> = findings.iter().flat_map(|one| one.joints.clone()).collect();
    joints.sort_unstable();
    verdict.outcome == Outcome::Explained
        && joints == [0, 1, 2]
        && findings.iter().all(|one| one.kind == "coulomb-friction")
}

/// Findings of a check of the audit in all installations.
pub(super) fn count(all: &[crate::paper::Audited], check: &str) -> usize {
    all.iter().map(|one| one.findings(check).len()).sum()
}

/// Viscous coefficients of table 1, and friction that makes such ones.
fn viscous(results: &Results) -> Vec<Row> {
    let audits = &results.audits;
    let negative = count(&audits.printed, "signs");
    let traces = &results.traces;
    let fitted = traces
        .falling_viscous
        .map(|fv| format!("{:.2}", 1e3 * fv))
        .join(", ");
    let truth = traces
        .true_viscous
        .map(|fv| format!("{:.2}", 1e3 * fv))
        .join(", ");
    let named = |verdict: &Verdict| -> usize {
        let findings = verdict.findings.iter();
        let own = findings.filter(|one| one.kind == "stribeck");
        let mut joints: Vec<usize> = own.flat_map(|one| one.joints.clone()).collect();
        joints.sort_unstable();
        joints.dedup();
        joints.len()
    };
    let [free, held] = [&traces.falling, &traces.falling_held].map(named);
    let turned = traces
        .falling_viscous
        .iter()
        .filter(|fv| **fv < 0.0)
        .count();
    vec![
        Row::wrong_in_print(
            "4.viscous",
            "viscous coefficients of table 1",
            "friction",
            format!(
                "`signs` finds {negative} of 15 below zero, {} as magnitudes",
                count(&audits.positive, "signs")
            ),
            negative == 9 && count(&audits.positive, "signs") == 0,
            "friction that pushes: the law (6) stands for something else, such as friction that falls with speed",
        ),
        Row::holds(
            "4.viscous.trace",
            format!(
                "friction that falls with speed on three joints ({} times dry friction at rest, gone beyond {} rad/s), fitted by (6): viscous \
                 coefficients times 1000, what `signs` says, and what the tracer says of the whole model and of one without the coefficients that are flagged",
                1.0 + tracing::FALLING[0],
                tracing::FALLING[1]
            ),
            "-",
            format!(
                "true {truth}, fitted {fitted}; `signs` finds {}; the whole model: {}; without them: {}",
                traces.falling_signs,
                tracing::said(&traces.falling),
                tracing::said(&traces.falling_held)
            ),
            traces.falling_signs == turned && turned > 0 && held == 3,
            &format!(
                "{} are flagged, and the tracer proposes it on {free} of 3 joints, where on the others the negative coefficient takes it up, and on {held} \
                 without it",
                traces.falling_signs,
            ),
        ),
    ]
}
