//! Every item, and what became of it.

use robot_model::trace::{Outcome, Verdict};

use super::equations;
use super::fits::{Installation, SECONDS};
use super::results::Results;
use super::tracing;
use super::truth::{CONFIGURATIONS, CROSSOVER, LEAST_EIGENVALUE, TABLE_2, WEIGHTS};
use crate::paper::{Error, Row};

pub(super) fn rows(results: &Results) -> Result<Vec<Row>, Error> {
    let mut all = equations::rows(&results.equations[0], &results.motion)?;
    all.extend(identified(results));
    all.extend(errors(results));
    all.extend(audited(results));
    all.extend(uses(results));
    all.extend(controlled(results));
    Ok(all)
}

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
    let standing =
        [0..8, 11..14].map(|which| largest(results, |one| one.off(&one.estimate, which.clone())));
    let turning = [0..8, 11..14, 8..11]
        .map(|which| largest(results, |one| one.off(&one.turning, which.clone())));
    let sigma = largest(results, |one| one.deviations_off(&one.turning, 8..11));
    vec![
        Row::holds(
            "4.3",
            "least squares (12), 1 kHz, halves to identify and to validate",
            "more than 40 s, the first seconds dropped",
            format!(
                "{dropped:.0} s dropped, {train:.0} s and {validate:.0} s; rank 14 in all five"
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
            "condition not given",
            format!("condition number with unit columns at most {worst:.1}"),
            worst < 20.0,
            "the regressor is badly conditioned",
        ),
        Row::holds(
            "4.5",
            "rigid and Coulomb parameters of five installations, joints that turn without standing as (6) has it",
            "within 1 %",
            format!("within {:.2} % and {:.2} %", turning[0], turning[1]),
            turning[0] < 1.0 && turning[1] < 1.0,
            "some are farther off",
        ),
        Row::holds(
            "4.5.viscous",
            "their viscous coefficients",
            "within 1 %",
            format!("within {:.1} %, {sigma:.1} deviations", turning[2]),
            turning[2] < 1.0,
            "the smallest are a few percent of the Coulomb torque beside them at 3.5 rad/s, and the logs tell them no better",
        ),
        Row::holds(
            "4.5.loop",
            "rigid and Coulomb parameters of the device in the loop, whose joints stand at their turns",
            "within 1 %",
            format!("within {:.1} % and {:.2} %", standing[0], standing[1]),
            standing.iter().all(|off| *off < 1.0),
            "while dry friction holds a joint its torque is not that of (6), which costs the small inertias up to 3 %",
        ),
    ]
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
    let p = traces
        .without_friction
        .findings
        .iter()
        .map(|one| one.evidence.p_value);
    let p = p.fold(0.0, f64::max);
    vec![
        Row::holds(
            "4.6",
            "RMS% (15) on the other half, whole model",
            "at most 1 %",
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
            "the printed ones are with friction; without it more is left here, as the motion of ours has less inertial torque",
        ),
        Row::holds(
            "4.7",
            "figure 5: what is left without friction over the velocity",
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
            "figure 7: what is left with friction",
            "other effects",
            tracing::said(&traces.with_friction),
            traces.with_friction.outcome == Outcome::NothingMissing,
            "the tracer finds more",
        ),
    ]
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

fn audited(results: &Results) -> Vec<Row> {
    let audits = &results.audits;
    let count = |all: &[super::audit::Audited], check: &str| -> usize {
        all.iter().map(|one| one.findings(check).len()).sum()
    };
    let least = |all: &[super::audit::Audited]| -> String {
        let all: Vec<String> = all
            .iter()
            .map(|one| format!("{:.2}", 1e3 * one.least_eigenvalue()))
            .collect();
        all.join(", ")
    };
    let negative = count(&audits.printed, "signs");
    let failed = count(&audits.printed, "inertia");
    let stopped = audits.moved.iter().filter(|said| !said.is_empty()).count();
    let below = audits
        .in_room
        .iter()
        .all(|one| one.least_eigenvalue() < LEAST_EIGENVALUE);
    let traces = &results.traces;
    let viscous = traces
        .falling_viscous
        .map(|fv| format!("{:.2}", 1e3 * fv))
        .join(", ");
    let names_it = traces
        .falling
        .findings
        .iter()
        .any(|one| one.kind == "stribeck");
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
            "friction that falls with speed, fitted by (6): viscous coefficients times 1000, and what the tracer says",
            "flagged, and what is missing proposed",
            format!(
                "true 0.40, 0.30, 0.30, fitted {viscous}; {}",
                tracing::said(&traces.falling)
            ),
            names_it && traces.falling_viscous.iter().any(|fv| *fv < 0.0),
            "the tracer does not name it",
        ),
        Row::wrong_in_print(
            "4.definite",
            "inertia over the workspace, table 1",
            format!("positive definite, at least {LEAST_EIGENVALUE:.1e} kg m^2"),
            format!(
                "least eigenvalues times 1000 of {}: {}; where motions here stay: {}; piece-wise {:.2}",
                CONFIGURATIONS.join(", "),
                least(&audits.printed),
                least(&audits.in_room),
                1e3 * audits.piece_wise.least_eigenvalue(),
            ),
            failed == 5 && below && count(&audits.in_room, "inertia") == 0,
            "no installation has a positive definite inertia over the workspace, and none as much as printed in a part of it",
        ),
        Row::wrong_in_print(
            "4.definite.motion",
            "the installations moved through the workspace",
            "five of five",
            format!(
                "{} of 5: the others have no motion that follows from a torque",
                5 - stopped
            ),
            stopped > 0,
            "where the inertia is not positive definite the simulated device cannot go; motions here stay within -26 to 29 degrees of joint 2 and -6 to 37 of joint 3",
        ),
    ]
}

fn uses(results: &Results) -> Vec<Row> {
    let off = results.shares.iter().map(|one| one.off).fold(0.0, f64::max);
    let ur = &results.shares[0];
    let crossover = super::shares::crossover();
    let [printed, repaired] = &results.balances;
    let triple = |all: [f64; 3], digits: usize| all.map(|x| format!("{x:.digits$}")).join(", ");
    vec![
        Row::holds(
            "4.8",
            "shares of the torque up to 3.5 rad/s; they sum to it",
            "joint 1 of UR: friction first; joint 3: gravity first",
            format!(
                "UR joint 1: inertia {:.0}, Coulomb {:.0} mN m; joint 3: gravity {:.0}, of {:.0}; sum within {off:.0e} N m",
                1e3 * ur.rms[0][0],
                1e3 * ur.rms[4][0],
                1e3 * ur.rms[2][2],
                1e3 * ur.torque[2],
            ),
            off < 1e-12
                && ur.rms[4][0] > ur.rms[0][0]
                && (0..5).all(|k| ur.rms[k][2] <= ur.rms[2][2]),
            "shares are otherwise",
        ),
        Row::holds(
            "4.9",
            "fc / fv of UR, deg/s",
            triple(CROSSOVER, 0),
            triple(crossover, 0),
            crossover
                .iter()
                .zip(CROSSOVER)
                .all(|(x, y)| (x / y - 1.0).abs() < 0.02),
            "more than rounding of table 1 apart",
        ),
        Row::wrong_in_print(
            "4.10",
            "counterweights: pi7', pi8' in N m, masses in kg, with the lever 0.075 m",
            format!("{:?}, {:?}", WEIGHTS.moments, WEIGHTS.recommended),
            format!(
                "{:.4}, {:.4}; {:.3}, {:.3}; with {:.4} m {:.4}; {:.3}, {:.3}",
                printed.moments[0],
                printed.moments[1],
                printed.masses[0],
                printed.masses[1],
                results.lever,
                repaired.moments[0],
                repaired.masses[0],
                repaired.masses[1],
            ),
            (printed.moments[0] - WEIGHTS.moments[0]).abs() > 5e-3
                && (repaired.masses[0] - WEIGHTS.recommended[0]).abs() < 1e-3
                && (repaired.masses[1] - WEIGHTS.recommended[1]).abs() < 1.5e-3,
            "the printed lever is rounded: its figures come from 0.0704 m",
        ),
    ]
}

fn controlled(results: &Results) -> Vec<Row> {
    let [ours, other] = &results.controlled[0].squares;
    let lower = results.controlled.iter().all(|one| {
        let [ours, other] = &one.squares;
        ours.rms < other.rms && ours.steady_percent < other.steady_percent
    });
    let [largest, largest_other] = results.largest_gains;
    let felt = &results.felt;
    vec![
        Row::holds(
            "4.11",
            "inverse dynamics with half of the friction: error of joint 3, identified against piece-wise",
            "steady state 20 % and 25 %, UR, K_P 625",
            format!(
                "{:.1} % and {:.1} %; lower in all three settings",
                ours.steady_percent, other.steady_percent
            ),
            lower,
            "identified parameters are not better",
        ),
        Row::holds(
            "4.11.gain",
            "largest K_P of UR in the loop of ours, with 8 ms of delay",
            "larger with identified parameters",
            format!("{largest:.0} and {largest_other:.0}"),
            largest > largest_other,
            "not larger",
        ),
        Row::holds(
            "4.12",
            "force at the end point, FS: RMS error against the registered sensor, with the model and without",
            "with the model slightly better",
            format!(
                "{:.3} and {:.3} N; frame registered within {:.3}",
                felt.rms[0], felt.rms[1], felt.frame_off
            ),
            felt.rms[0] < felt.rms[1] && felt.frame_off < 0.05,
            "not better",
        ),
        Row::holds(
            "4.12.J",
            "Jacobian (21), in the frame of the end point",
            "(21)",
            format!(
                "J^T J is that of the spec's point within {:.0e} m^2",
                results.jacobian_off
            ),
            results.jacobian_off < 1e-12,
            "it is another one",
        ),
        Row::holds(
            "4.13",
            "torque command per torque, in the spec",
            "2.7",
            format!(
                "a log of commands has the same parameters within {:.0e}",
                results.scaled_off
            ),
            results.scaled_off < 1e-9,
            "it has others",
        ),
    ]
}
