//! What logs are looked through for before anything is asked of the arm, and what each look found.

use robot_model::identify::{Delay, Estimate};
use robot_model::log::{Fault, Mended};
use robot_model::signal::encoder_step;

use crate::data_gate::DataFault;
use crate::interpreted::InterpretedArm;
use crate::output::significant;
use crate::units::Units;

/// One look.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Check {
    /// What was looked for.
    pub of: &'static str,
    /// What was found; `none found` is the only one where that is nothing.
    pub found: Vec<String>,
}

impl Check {
    fn new(of: &'static str, found: Vec<String>, otherwise: &str) -> Self {
        let found = if found.is_empty() {
            vec![otherwise.to_owned()]
        } else {
            found
        };
        Self { of, found }
    }
}

const NONE: &str = "none found";

/// The look that only logs with velocities allow.
const VELOCITIES: &str = "logged velocities compared with positions: delay, unit, sign";

/// Kinds of faults that mending finds, as they are looked for together.
const MENDED: [(&str, &[&str]); 7] = [
    (
        "time stamps: jitter, gaps, samples that coincide",
        &["jitter", "gaps", "coincident"],
    ),
    ("spikes and bursts", &["spikes", "bursts"]),
    ("dropouts and held values", &["dropouts", "held"]),
    (
        "positions that jump and stay, or wrap around",
        &["slips", "wrapped"],
    ),
    ("torques at a limit", &["clipped"]),
    (VELOCITIES, &["velocity-late", "velocity-scale"]),
    (
        "channels that are constant",
        &["still", "at-rest", "constant"],
    ),
];

/// All of them, of logs, what was identified from them, and the faults that matter.
pub(crate) fn checks(
    arm: &InterpretedArm,
    mended: &[Mended],
    estimate: &Estimate,
    faults: &[DataFault],
) -> Vec<Check> {
    let of = |log: &Mended, told: String| {
        if mended.len() > 1 {
            format!("{}: {told}", log.log.source)
        } else {
            told
        }
    };
    let found = |counts: &dyn Fn(&Fault) -> bool| -> Vec<String> {
        let all = mended.iter().flat_map(|log| {
            let own = log.faults.iter().filter(|fault| counts(fault));
            own.map(|fault| of(log, fault.to_string()))
        });
        all.collect()
    };
    let rates = mended.iter().map(|log| {
        let rate = significant(log.log.rate_hz(), 4);
        of(log, format!("{rate} Hz"))
    });
    let rates: Vec<String> = rates.collect();
    let mut all: Vec<Check> = MENDED
        .iter()
        .enumerate()
        .map(|(k, (name, kinds))| {
            let otherwise = if k == 0 {
                format!("{NONE}: {}", rates.join(", "))
            } else if *name == VELOCITIES && mended.iter().all(|log| log.log.dq.is_empty()) {
                "not checked: no log has velocities".to_owned()
            } else {
                NONE.to_owned()
            };
            Check::new(
                name,
                found(&|fault| kinds.contains(&fault.kind())),
                &otherwise,
            )
        })
        .collect();
    let others = found(&|fault| {
        !MENDED
            .iter()
            .any(|(_, kinds)| kinds.contains(&fault.kind()))
    });
    if !others.is_empty() {
        all.push(Check::new("other faults", others, NONE));
    }
    let model = &arm.compiled().model;
    let steps = mended.iter().flat_map(|log| {
        let joints = log.log.q.iter().zip(&model.joints).enumerate();
        joints.filter_map(move |(joint, (q, declared))| {
            let unit = Units::of(declared.kind).position;
            let step = significant(encoder_step(q)?, 3);
            Some(of(log, format!("q{} in steps of {step} {unit}", joint + 1)))
        })
    });
    all.push(Check::new(
        "steps of encoders (quantization)",
        steps.collect(),
        NONE,
    ));
    let late = estimate.delays.iter().map(late);
    let held = estimate.held_torques.iter().map(|held| {
        let channel = held.channel.column(held.joint);
        format!("{channel} is set at a sample and held until the next one, which is not a delay")
    });
    all.push(Check::new(
        "delays between channels",
        late.chain(held).collect(),
        NONE,
    ));
    let smoothed = faults.iter().filter(|fault| fault.is_smoothed());
    all.push(Check::new(
        "torques that were filtered while positions were not",
        smoothed.map(|fault| fault.told.clone()).collect(),
        NONE,
    ));
    all
}

fn late(delay: &Delay) -> String {
    let (ms, std) = (1e3 * delay.seconds, 1e3 * delay.std);
    format!(
        "{} is {:.2} +- {std:.2} ms {}; without this delay its joint's error is {:.0} % smaller",
        delay.channel.column(delay.joint),
        ms.abs(),
        if ms > 0.0 { "late" } else { "early" },
        100.0 * delay.gain
    )
}
