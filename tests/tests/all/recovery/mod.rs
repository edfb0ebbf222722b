//! Every standard effect of the torque is found again in the log of a machine that has it.
//!
//! The machines are written out by hand in the constants of physics (`plant.rs`, `cases.rs`), so that an effect's file is
//! compared with its law and not with itself. Noise and encoders are those of a fair drive.

mod cases;
mod plant;
mod saturation;

use cases::{CASES, Case, PENDULUM};
use plant::Machine;
use robot_model::identify::{Estimate, Identify};
use robot_model::log::Log;
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::compile_model;

const SECONDS: u32 = 40;

/// An estimate may be off by so many standard deviations.
const DEVIATIONS: f64 = 4.0;

/// And by this share of its value: the motion's filters round off reversals.
const ROUNDING_OFF: f64 = 0.005;

/// The spec of a machine.
fn arm(joints: usize, effects: &str) -> InterpretedArm {
    let second = "joint k: revolute { a = 0.5; alpha = 0; d = 0; }";
    let second = if joints > 1 { second } else { "" };
    let text = format!(
        "robot Machine {{ gravity = [0, -9.81, 0]; convention = modified_dh; \
         joint j: revolute {{ a = 0; alpha = 0; d = 0; }} {second} effects {{ {effects} }} }}"
    );
    let model = robot_model_spec::load("machine.robot", &text).unwrap_or_else(|e| panic!("{e}"));
    InterpretedArm::new(compile_model(&model))
}

fn fit(arm: &InterpretedArm, log: Log) -> Estimate {
    let estimate = Identify::default().fit(arm, &[log]);
    estimate.unwrap_or_else(|error| panic!("{error}"))
}

/// A parameter's value and its standard deviation, which shape parameters do not have.
fn value(estimate: &Estimate, name: &str) -> (f64, f64) {
    let linear = estimate
        .parameters
        .iter()
        .map(|p| (&p.name, p.value, p.std));
    let shapes = estimate
        .shapes
        .iter()
        .map(|(name, value)| (name, *value, 0.0));
    let found = linear.chain(shapes).find(|(found, ..)| *found == name);
    let (_, value, std) = found.unwrap_or_else(|| panic!("no `{name}` in\n{estimate}"));
    (value, std)
}

/// What is wrong, one line a parameter.
fn check(case: &Case) -> Vec<String> {
    let machine = Machine {
        body: case.body,
        law: case.law,
        constants: case.constants,
        noise: case.noise,
    };
    let arm = arm(case.tones.len(), case.effects);
    let estimate = fit(&arm, machine.log("machine", case.tones, SECONDS, 1));
    let wanted = (case.found)(case.body, case.constants);
    let least = machine.least_deviations(case.tones, SECONDS, |parameters| {
        let (body, constants) = parameters.split_at(case.body.len());
        let found = (case.found)(body, constants).into_iter();
        found.map(|(_, value)| value).collect()
    });
    let mut wrong = Vec::new();
    for ((name, wanted), least) in wanted.into_iter().zip(least) {
        let (found, std) = value(&estimate, name);
        let tolerance = DEVIATIONS * least.max(std) + ROUNDING_OFF * wanted.abs();
        if (found - wanted).abs() > tolerance {
            wrong.push(format!("{name}: {found} is not {wanted} +- {tolerance}"));
        }
    }
    let other = machine.log("other", case.other, SECONDS, 2);
    let errors = estimate.errors(&arm, &other);
    let errors = errors.unwrap_or_else(|error| panic!("{error}"));
    for (joint, rmse) in errors.rmse.iter().enumerate() {
        let jump = machine.jump(joint, case.other, SECONDS);
        // A prediction that jumps up to a sample early or late misses by a part of the jump, in the mean square by a third.
        let most = 1.05 * (case.noise.powi(2) + jump.powi(2) / 3.0).sqrt();
        if *rmse > most {
            wrong.push(format!("held out: {rmse} N m, {most} were expected"));
        }
    }
    wrong
}

#[test]
fn what_a_machine_has_is_found_in_its_log() {
    let mut wrong = Vec::new();
    for case in CASES {
        let effects = case.effects;
        wrong.extend(
            check(case)
                .into_iter()
                .map(|line| format!("{effects} {line}")),
        );
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The share of the excess that is not delivered is all of it.
#[test]
fn a_saturated_motor_is_found_in_its_commands() {
    let (limit, v0) = (saturation::LIMIT, saturation::NO_LOAD);
    let effects = format!(
        "coulomb_friction on j; viscous_friction on j; torque_saturation(limit = {limit}, v0 = {v0}) on j;"
    );
    let arm = arm(1, &effects);
    let log = saturation::log("machine", saturation::TONES, 1);
    let saturated = log.tau[0].iter().filter(|tau| tau.abs() > limit).count();
    assert!(saturated > log.tau[0].len() / 50, "{saturated} samples");
    let estimate = fit(&arm, log);
    for (name, wanted) in [
        ("j.izz", PENDULUM[0]),
        ("j.coulomb_friction.fc", saturation::FRICTION[0]),
        ("j.viscous_friction.fv", saturation::FRICTION[1]),
        ("j.torque_saturation.share", 1.0),
    ] {
        let (found, std) = value(&estimate, name);
        let tolerance = DEVIATIONS * std + ROUNDING_OFF * wanted;
        assert!(
            (found - wanted).abs() < tolerance,
            "{name}: {found} is not {wanted} +- {tolerance}"
        );
    }
    let other = saturation::log("other", saturation::OTHER_TONES, 2);
    let errors = estimate.errors(&arm, &other);
    let errors = errors.unwrap_or_else(|error| panic!("{error}"));
    // Beside the noise there are the reversals of dry friction, and the noise of the command in what is not delivered.
    assert!(errors.rmse[0] < 1.5 * saturation::NOISE, "{errors:?}");
}
