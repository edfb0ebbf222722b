//! The list of what a reproduction has to show, item by item.

mod rig;

use super::audit::{self, off};
use super::plant::PRINTED;
use super::refine::Mixed;
use super::results::Results;
use super::truth;
use crate::paper::Row;

/// The static four, and the dynamic two, are found that are off by less.
pub const STATIC: f64 = 0.02;
/// A share.
pub const DYNAMIC: f64 = 0.1;

/// The chain from current to log may move them by this share.
pub const CHAIN: f64 = 0.01;

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
        rig::shown(results),
        rig::rig(results),
    ]
    .concat()
}

fn share(found: f64, truth: f64) -> String {
    format!("{:+.1} %", 100.0 * (found / truth - 1.0))
}

fn body(results: &Results) -> Vec<Row> {
    let body = &results.body;
    let third = &results.findings.third;
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
            format!("{}; the chain has {:.4}", third.text(), body.share),
            third.is_told(),
            "it is a third, which leaves nothing",
        ),
        Row::wrong_in_print(
            "3.gravity",
            "gravity in (7), by the dimensions of a spec",
            "9.8 m l a cos - 4.9 m l cos",
            results.findings.gravity.text(),
            results.findings.gravity.is_told(),
            "one length too many; m g (a - l/2) cos passes",
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
    let [_, from_rest, held, _, stiff_held] = &results.protocols[..] else {
        return Vec::new();
    };
    let excess = audit::excess_of_damping(&PRINTED);
    let slope = 2_f64.sqrt() * (-0.5_f64).exp() * (PRINTED.breakaway - PRINTED.coulomb)
        / PRINTED.stribeck
        - PRINTED.viscous;
    let worst =
        |law: &robot_model::friction_curve::Law| format!("{:.1} %", 100.0 * off(law, &PRINTED));
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
            &format!(
                "it gives energy: s1 (F_s - F_c) / F_c is {excess:.0} times s2; with s1 {} it takes energy",
                audit::PASSIVE.damping
            ),
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
        Row::holds(
            "3.4",
            "twenty speeds in one direction over 30 to 310 degrees",
            "stretches of acceleration left out",
            format!(
                "{} speeds, the four off by {} at most; from rest, F_s {:.3}, by {}",
                found.curve.points.len(),
                worst(law),
                from_rest.law.breakaway.value,
                worst(&from_rest.law)
            ),
            off(law, &PRINTED) < STATIC && found.curve.points.len() == truth::SPEEDS,
            "bristles have not settled in the range",
        ),
        Row::holds(
            "3.4.gains",
            "the speeds held by the printed gains",
            format!("{:?}", truth::PID),
            format!(
                "{} stretches of printed bristles, {} of 1001 N m/rad, of {} speeds",
                held.points,
                stiff_held.points,
                truth::SPEEDS
            ),
            held.points == truth::SPEEDS && off(&held.law, &PRINTED) < STATIC,
            &format!(
                "they have no units; as torque on the distance, its integral and its rate the link sticks and slips where friction falls, by up to {slope:.1} N m s/rad; on the error of the speed, its integral and its rate {} of {} runs arrive at a speed, the others run away: the bristles answer a torque within half a sample",
                results.on_speed,
                truth::SPEEDS
            ),
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
        mixed(&found.mixed),
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
            &format!(
                "bristles that break away after {} rad have {} N m/rad, and pass",
                truth::RESOLUTION,
                audit::stiff().stiffness
            ),
        ),
    ]
}

fn mixed(mixed: &Mixed) -> Row {
    let Mixed {
        of_squares,
        found,
        from_first,
        ..
    } = mixed;
    let is_same = (found.stiffness / from_first.stiffness - 1.0).abs() < AGREE
        && (found.damping / from_first.damping - 1.0).abs() < AGREE;
    let is_close = (found.stiffness / truth::STIFFNESS - 1.0).abs() < DYNAMIC
        && (found.damping / truth::DAMPING - 1.0).abs() < DYNAMIC;
    let is_there = mixed.cost(found) < mixed.cost(of_squares)
        && found.largest < of_squares.largest
        && is_same
        && is_close;
    Row::holds(
        "3.7",
        "cost (23), q1 sum e^2 + q2 max |e|: by a search of the program over the tool's simulations; its own output error has squares alone, for \
         which it has exact slopes, and the largest error has none where two samples share it, which is where (23) is least",
        "q1, q2 without values",
        format!(
            "both terms 1 where squares are least: cost {:.3} for 2, max |e| {:.2} for {:.2} mrad; s0 {:.3}, s1 {:.3}",
            mixed.cost(found),
            1e3 * found.largest,
            1e3 * of_squares.largest,
            found.stiffness,
            found.damping
        ),
        is_there,
        "searches from two starts end apart, or no lower than squares, or off by more than 10 %",
    )
}

/// Searches from two starts end within this share of each other.
const AGREE: f64 = 1e-2;
