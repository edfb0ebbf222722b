//! Items of what bristles and sensors show.

use super::{CHAIN, SAME, STATIC};
use crate::paper::Row;
use crate::seed_003::audit::{self, off};
use crate::seed_003::encoder::{BITS, stiffest};
use crate::seed_003::phenomena::Late;
use crate::seed_003::results::{Chain, Results, Shown};
use crate::seed_003::{rig, truth};

fn list(speeds: &[f64]) -> String {
    if speeds.is_empty() {
        return "none".to_owned();
    }
    let speeds: Vec<String> = speeds.iter().map(f64::to_string).collect();
    speeds.join(", ")
}

pub(super) fn shown(results: &Results) -> Vec<Row> {
    let [_, printed, stiff, _] = &results.shown[..] else {
        return Vec::new();
    };
    let said = |shown: &Shown| {
        let (work, width) = shown.to_and_fro.0.last_loop();
        format!(
            "loop of {work:.1e} J, {width:.1e} rad wide; sticks and slips at {} rad/s, even at {}; the runtime is off by {:.0e} rad at most",
            list(&shown.speeds(Late::sticks)),
            list(&shown.speeds(Late::is_even)),
            shown.to_and_fro.1.max(shown.slip.1)
        )
    };
    let holds = |shown: &Shown| {
        let (work, width) = shown.to_and_fro.0.last_loop();
        let off = shown.to_and_fro.1.max(shown.slip.1);
        work > 0.0 && width > 0.0 && off < SAME && shown.sticks_below_a_speed_only()
    };
    let [_, _, _, curve, _] = &results.protocols[..] else {
        return Vec::new();
    };
    vec![
        Row::holds(
            "3.8",
            "Stribeck curve, loop before sliding, stick-slip below a critical speed only: bristles of 1001 N m/rad",
            "figures 8, 9",
            format!(
                "the curve off by {:.1} %; {}",
                100.0 * off(&curve.law, &audit::stiff()),
                said(stiff)
            ),
            off(&curve.law, &audit::stiff()) < STATIC && holds(stiff),
            "a phenomenon is missing, or the runtime moves otherwise",
        ),
        Row::holds(
            "3.8.printed",
            format!(
                "the same with the printed bristles, pulled by a spring of {} N m/rad",
                printed.spring.stiffness
            ),
            "figures 8, 9",
            said(printed),
            holds(printed),
            "a phenomenon is missing, or the runtime moves otherwise",
        ),
    ]
}

pub(super) fn rig(results: &Results) -> Vec<Row> {
    let findings = &results.findings;
    let stall = truth::STALL_KGF_CM * truth::KGF_CM;
    let told = BITS.map(|bits| format!("{bits} bits {:.0}", stiffest(&results.encoders, bits)));
    let Chain {
        law,
        without,
        volts,
    } = &results.in_kgf_cm;
    let [exact, chained] = [without, law].map(|law| off(law, &audit::in_kgf_cm()));
    let ampere = |volts: f64| volts / rig::VOLTS_PER_AMPERE;
    let kept = results.found.runs.iter().map(|run| run.after(1.0).volts());
    let printed_volts = kept.fold(0.0, f64::max);
    let agrees = results
        .encoders
        .iter()
        .all(|trial| !trial.is_resolved || trial.is_close());
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
        Row::remark(
            "3.bits",
            "the encoder's step: that which `friction` finds in logs beside the printed one",
            format!("12 bits, {} degrees", truth::PRINTED_STEP_DEG),
            findings.encoder.text(),
            findings.encoder.is_told(),
            "12 bits are a turn of 4096 steps, which is what is found",
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
            "current to torque: LA 25-NP at 5/1000, 670 ohm, 24 bits over 5 V either way",
            format!("{} A at most", truth::LARGEST_CURRENT),
            format!(
                "{:.2} V/A; torques in kgf cm: {:.2} A, {volts:.2} V at most, the static four off by {:.1} %, and {:.1} % with currents as they are; in N m it would be {:.2} A, {printed_volts:.2} V",
                rig::VOLTS_PER_AMPERE,
                ampere(*volts),
                100.0 * chained,
                100.0 * exact,
                ampere(printed_volts)
            ),
            (chained - exact).abs() < CHAIN
                && *volts < truth::CONVERTER_VOLTS
                && ampere(*volts) < truth::LARGEST_CURRENT,
            "the chain moves the static four, or its range ends",
        ),
    ]
}
