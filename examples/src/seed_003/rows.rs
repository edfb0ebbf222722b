//! The list of what a reproduction has to show, item by item.

use super::audit::off;
use super::encoder::{BITS, stiffest};
use super::plant::PRINTED;
use super::results::{PULLED, Results, is_even, sticks};
use super::{rig, truth};
use crate::paper::Row;

/// The static four, and the dynamic two, are found that are off by less.
pub const STATIC: f64 = 0.02;
/// A share.
pub const DYNAMIC: f64 = 0.1;

/// Settled bristles are off the curve by less, N m.
const SETTLED: f64 = 1e-9;

/// Forms of one equation differ by rounding.
const ROUNDING: f64 = 1e-12;

/// Motions by hand and by the runtime, rad.
const SAME: f64 = 1e-3;

/// All rows.
#[must_use]
pub fn rows(results: &Results) -> Vec<Row> {
    [
        body(results),
        friction(results),
        dynamic(results),
        shown(results),
        rig(results),
    ]
    .concat()
}

fn share(found: f64, truth: f64) -> String {
    format!("{:+.1} %", 100.0 * (found / truth - 1.0))
}

fn body(results: &Results) -> Vec<Row> {
    let body = &results.body;
    let more = 100.0 * (body.share / truth::PRINTED_THIRD - 1.0);
    vec![
        Row::holds(
            "3.1",
            "equations (2) to (7): the chain of a uniform rod",
            "[0.3 l^2 m - a l m + a^2 m]",
            format!(
                "{:.6} l^2 m where a = l; off (7) repaired by {:.0e}",
                body.share, body.off
            ),
            (body.share - 1.0 / 3.0).abs() < ROUNDING && body.off < ROUNDING,
            "the chain has another inertia or another gravity",
        ),
        Row::wrong_in_print(
            "3.third",
            "the rod's share in (7)",
            "0.3",
            format!("the compiled chain has {:.4}, {more:.1} % more", body.share),
            (body.share - truth::PRINTED_THIRD).abs() > 0.03,
            "it is a third",
        ),
        Row::wrong_in_print(
            "3.gravity",
            "gravity in (7), by the dimensions of a spec",
            "9.8 m l a cos - 4.9 m l cos",
            results.findings.gravity.text(),
            results.findings.gravity.is_told(),
            "one length too many; m g (a - l/2) cos passes and is the chain's",
        ),
    ]
}

fn friction(results: &Results) -> Vec<Row> {
    let (found, findings) = (&results.found, &results.findings);
    let law = &found.law;
    let speed = law.fall.map_or(f64::NAN, |fall| fall.speed.value);
    let dynamic = found.dynamic;
    let stiffness = (dynamic.stiffness.value / truth::STIFFNESS - 1.0).abs();
    let damping = (dynamic.damping.value / truth::DAMPING - 1.0).abs();
    let [_, over, _, stiff, _] = &results.protocols[..] else {
        return Vec::new();
    };
    vec![
        Row::holds(
            "3.2",
            "equations (8) to (10): settled bristles are the Stribeck curve, and take energy there and back",
            "steady state of (9)",
            format!(
                "off by {:.0e} N m by hand, {:.0e} N m in the spec; `friction` of `audit` finds {}",
                results.settled[0],
                results.settled[1],
                findings.friction.text()
            ),
            results.settled.iter().all(|off| *off < SETTLED) && findings.friction.printed.is_none(),
            "settled bristles are off the curve",
        ),
        Row::wrong_in_print(
            "3.passive",
            "whether the printed friction takes energy",
            "s2 0.1328, s1 1.34",
            findings.memory.text(),
            findings.memory.is_told(),
            "it gives energy: s1 (F_s - F_c) / F_c is 24 times s2; with s1 0.05 it takes energy",
        ),
        Row::holds(
            "3.3",
            "F_c, F_s (printed as a second F_c), s2, Stribeck speed; s0, s1",
            format!(
                "{}, {}, {}, {}; {}, {}",
                truth::COULOMB,
                truth::BREAKAWAY,
                truth::VISCOUS,
                truth::STRIBECK,
                truth::STIFFNESS,
                truth::DAMPING
            ),
            format!(
                "{:.4}, {:.4}, {:.4}, {speed:.4}; {:.3}, {:.3}",
                law.coulomb.value,
                law.breakaway.value,
                law.viscous.value,
                dynamic.stiffness.value,
                dynamic.damping.value
            ),
            off(law, &PRINTED) < STATIC && stiffness.max(damping) < DYNAMIC,
            "one is off by more than 2 % or 10 %",
        ),
        Row::wrong_in_print(
            "3.4",
            "twenty speeds in one direction over 30 to 310 degrees",
            "F_s 2.002",
            format!(
                "F_s {:.3} of printed bristles, {:.3} of bristles of 1001 N m/rad",
                over.law.breakaway.value, stiff.law.breakaway.value
            ),
            off(&over.law, &PRINTED) > 5.0 * STATIC && off(&stiff.law, &PRINTED) < STATIC,
            "printed bristles slide on for 4 rad before they have settled, and the range has 4.9; on stiff ones the protocol gives all four",
        ),
    ]
}

fn dynamic(results: &Results) -> Vec<Row> {
    let (found, findings) = (&results.found, &results.findings);
    let (deflection, [printed, repaired]) = &findings.deflection;
    let by_18 = found.bristles.stiffness.value;
    vec![
        Row::holds(
            "3.5",
            "s0 of a slow ramp, equations (16) and (18)",
            format!("{} before the fit", truth::FIRST[0]),
            format!("{by_18:.3} N m/rad, {}", share(by_18, truth::STIFFNESS)),
            (by_18 / truth::STIFFNESS - 1.0).abs() < DYNAMIC,
            "it is off by more than 10 %",
        ),
        Row::wrong_in_print(
            "3.deflection",
            "equation (17)",
            "z = th - th0 + k/(2 F_s) (th t + int th)",
            format!(
                "{}; its dimensions are right. Repaired: {repaired:.3}",
                deflection.text()
            ),
            deflection.is_told()
                && (printed / truth::STIFFNESS - 1.0).abs() > 0.5
                && (repaired / truth::STIFFNESS - 1.0).abs() < DYNAMIC,
            "the integral of (16) is th - th0 - k/F_s (th t - int th)",
        ),
        Row::holds(
            "3.6",
            "s1 of the second order, equations (20) to (22) repaired",
            format!("{} before the fit", truth::FIRST[1]),
            format!(
                "{:.3} N m s/rad, {}",
                found.first[1],
                share(found.first[1], truth::DAMPING)
            ),
            (found.first[1] / truth::DAMPING - 1.0).abs() < DYNAMIC,
            "it is off by more than 10 %",
        ),
        Row::wrong_in_print(
            "3.damping",
            "equation (22), by the dimensions of a spec",
            "2 xi m sqrt(s0/m - s2)",
            findings.damping.text(),
            findings.damping.is_told(),
            "2 xi sqrt(s0 m) - s2 passes",
        ),
        Row::holds(
            "3.7",
            "cost (23), q1 sum e^2 + q2 max |e|",
            "q1, q2 without values",
            format!("q2 = 0: {:.1e} rad rms", found.dynamic.rmse),
            false,
            "output error of the tool minimizes squares; the largest error is no part of its cost",
        ),
        Row::wrong_in_print(
            "3.unit",
            "the unit of s0, by the dimensions of a spec with (8)",
            "N m s/rad",
            findings.unit.text(),
            findings.unit.is_told(),
            "N m/rad passes",
        ),
        Row::wrong_in_print(
            "3.soft",
            "s0 beside a resolution of 0.002 rad",
            "2.15",
            findings.softness.text(),
            findings.softness.is_told(),
            "bristles that break away after 0.002 rad have 1001 N m/rad, and pass",
        ),
    ]
}

fn shown(results: &Results) -> Vec<Row> {
    let (motion, distance) = &results.to_and_fro;
    let (work, width) = motion.last_loop();
    let printed = &results.shown[0].spread;
    let at = |wanted: fn([f64; 2]) -> bool| {
        let there = PULLED
            .iter()
            .zip(printed)
            .filter(|(_, spread)| wanted(**spread));
        there.map(|(speed, _)| *speed).collect::<Vec<f64>>()
    };
    let (slips, even) = (at(sticks), at(is_even));
    let fastest = slips.iter().copied().fold(0.0, f64::max);
    let above = PULLED.iter().filter(|speed| **speed > 1.5 * fastest);
    let ends = !slips.is_empty()
        && above.clone().count() > 0
        && above.into_iter().all(|speed| even.contains(speed));
    let list = |speeds: &[f64]| {
        let speeds: Vec<String> = speeds.iter().map(f64::to_string).collect();
        speeds.join(", ")
    };
    vec![Row::holds(
        "3.8",
        "Stribeck curve, loop before sliding, stick-slip below a critical speed only",
        "figures 8, 9",
        format!(
            "loop of {work:.2} J, {width:.2} rad wide; sticks and slips at {} rad/s, even at {}; the runtime is off by {:.0e} rad at most",
            list(&slips),
            list(&even),
            distance.max(results.slip.1)
        ),
        work > 0.0 && width > 0.0 && ends && distance.max(results.slip.1) < SAME,
        "a phenomenon is missing, or the runtime moves otherwise",
    )]
}

fn rig(results: &Results) -> Vec<Row> {
    let findings = &results.findings;
    let stall = truth::STALL_KGF_CM * truth::KGF_CM;
    let step = rig::encoder_step(truth::BITS);
    let told = BITS.map(|bits| format!("{bits} bits {:.0}", stiffest(&results.encoders, bits)));
    let volts = truth::TURNS * truth::RESISTOR;
    let agrees = results
        .encoders
        .iter()
        .all(|trial| !trial.is_resolved || trial.is_close());
    let measured_step = results.found.curve.speed_step / truth::LOOP_HZ;
    vec![
        Row::wrong_in_print(
            "3.stall",
            "breakaway beside the motor's largest torque",
            format!("F_s 2.002, {} kgf cm = {stall:.3} N m", truth::STALL_KGF_CM),
            findings.drives.text(),
            findings.drives.is_told(),
            "torques cannot be in N m; in kgf cm they pass",
        ),
        Row::wrong_in_print(
            "3.speed",
            "speeds from differences of positions over 1 ms",
            "Stribeck speed 0.8379",
            findings.differences.text(),
            findings.differences.is_told(),
            "slopes over stretches tell it; differences do with 20 bits",
        ),
        Row::wrong_in_print(
            "3.bits",
            "the encoder's step, from its log",
            format!("12 bits, {} degrees", truth::PRINTED_STEP_DEG),
            format!("{:.4} degrees", measured_step.to_degrees()),
            (measured_step / step - 1.0).abs() < 1e-6
                && measured_step.to_degrees() > 10.0 * truth::PRINTED_STEP_DEG,
            "a turn of 4096 steps",
        ),
        Row::holds(
            "3.encoder",
            "which bristles an encoder tells",
            "better than 14 bits",
            format!(
                "stiffest within 10 %, N m/rad: {}; said to be told: {:.0} with 12 bits",
                told.join(", "),
                results
                    .encoders
                    .iter()
                    .find(|trial| trial.bits == truth::BITS)
                    .map_or(f64::NAN, |trial| trial.most)
            ),
            agrees
                && BITS.windows(2).all(|bits| {
                    stiffest(&results.encoders, bits[0]) <= stiffest(&results.encoders, bits[1])
                }),
            "a stiffness that is said to be told is off by more than 10 %",
        ),
        Row::holds(
            "3.9",
            "current to torque: LA 25-NP at 5/1000, 670 ohm",
            format!("{} A at most", truth::LARGEST_CURRENT),
            format!(
                "{volts:.2} V/A; the static four are from currents, of which F_s takes {:.2} A",
                truth::BREAKAWAY / truth::TORQUE_CONSTANT
            ),
            off(&results.found.law, &PRINTED) < STATIC,
            "the static four do not come back through the current",
        ),
    ]
}
