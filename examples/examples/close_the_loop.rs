//! The loop, in library calls: identify, trace what is left, amend the spec's text, compile that text, identify again.
//!
//! The machine has dry friction in its elbow, and `arm.robot` does not say so.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::collections::BTreeMap;
use std::error::Error;
use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use robot_model::columns::{Arm, Columns};
use robot_model::identify::{Identify, torque_of};
use robot_model::log::Log;
use robot_model::motion::{Kinematics, Motion};
use robot_model::trace::{Outcome, Trace};
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::compile_model;
use robot_model_spec::amend::{Amendment, amend};

const SPEC: &str = include_str!("../embedded/arm.robot");

/// Standard parameters of the machine by name, but for its dry friction.
const VALUES: &str = include_str!("../embedded/arm.json");

/// Dry friction of the machine's elbow, N m.
const FC: f64 = 1.5;

/// Runs the loop on a simulated machine and prints what each step finds.
///
/// # Errors
/// None are expected; those of the libraries are passed on.
pub fn main() -> Result<(), Box<dyn Error>> {
    let machine = amend("machine", SPEC, &[dry_friction_of("elbow")])?;
    let (monday, tuesday) = (measure(&machine, 1)?, measure(&machine, 2)?);
    let logs = [monday];

    let arm = compile(SPEC)?;
    let before = Identify::default().fit(&arm, &logs)?;
    println!("As the spec says:\n{before}");

    let undeclared = arm.undeclared();
    let trace = Trace::new(undeclared.candidates());
    let verdict = trace.run(&arm, &logs, &mut |_| ())?;
    assert_eq!(verdict.outcome, Outcome::Explained);

    let mut amendments = Vec::new();
    for finding in &verdict.findings {
        let joints: Vec<String> = finding
            .joints
            .iter()
            .map(|&j| arm.joints()[j].clone())
            .collect();
        println!(
            "Traced: {} on {}, score {:.1e}\n",
            finding.kind,
            joints.join(", "),
            finding.evidence.score
        );
        let shapes = finding
            .parameters
            .iter()
            .filter(|parameter| parameter.shape);
        amendments.push(Amendment {
            effect: finding.effect.clone(),
            joints,
            shapes: shapes
                .map(|shape| (shape.name.clone(), shape.value))
                .collect(),
        });
    }
    assert_eq!(amendments, [dry_friction_of("elbow")]);

    let amended = compile(&amend("arm.robot", SPEC, &amendments)?)?;
    let same_bands = Identify {
        bands: Some(before.bands),
        ..Identify::default()
    };
    let after = same_bands.fit(&amended, &logs)?;
    println!("With the effect declared:\n{after}");
    let fc = after
        .parameters
        .iter()
        .find(|p| p.name == "elbow.coulomb_friction.fc");
    assert!(
        fc.is_some_and(|fc| (fc.value - FC).abs() < 0.05 * FC),
        "{fc:?}"
    );

    // Tuesday was not fitted.
    let (old, new) = (
        before.errors(&arm, &tuesday)?,
        after.errors(&amended, &tuesday)?,
    );
    println!("Relative error on another day's log:");
    for (joint, name) in arm.joints().iter().enumerate() {
        let (old, new) = (old.relative_percent[joint], new.relative_percent[joint]);
        println!("  {name:10} {old:6.2} % -> {new:5.2} %");
    }
    assert!(new.relative_percent[1] < 0.2 * old.relative_percent[1]);
    Ok(())
}

fn dry_friction_of(joint: &str) -> Amendment {
    Amendment {
        effect: "coulomb_friction".to_owned(),
        joints: vec![joint.to_owned()],
        shapes: Vec::new(),
    }
}

/// A spec behind the traits of the runtime, without a Rust toolchain.
fn compile(text: &str) -> Result<InterpretedArm, Box<dyn Error>> {
    Ok(InterpretedArm::new(compile_model(&robot_model_spec::load(
        "arm.robot",
        text,
    )?)))
}

/// Half a minute of the machine's motion: exact torque of its spec, and noise of 20 mN m.
fn measure(spec: &str, day: u64) -> Result<Log, Box<dyn Error>> {
    let machine = compile(spec)?;
    let known: BTreeMap<String, f64> = serde_json::from_str(VALUES)?;
    let value = |name: &str| match name {
        "elbow.coulomb_friction.fc" => FC,
        // What no torque of an arm in a plane depends on.
        _ => known.get(name).copied().unwrap_or_default(),
    };
    let standard: Vec<f64> = machine
        .compiled()
        .standard
        .iter()
        .map(|p| value(&p.name))
        .collect();
    let beta = machine.compiled().base.beta(&standard);

    let time: Vec<f64> = (0..15_000).map(|k| f64::from(k) * 2e-3).collect();
    let harmonics = [(0.1, 0.7), (0.3, 0.35), (0.7, 0.15), (1.1, 0.06)];
    let mut exact = Kinematics::default();
    for joint in 0..machine.dof() {
        // Other phases for every joint, day and harmonic.
        let sum = |shift: f64, power: i32| -> Vec<f64> {
            let term = |t: f64, (hz, size): (f64, f64)| {
                let phase = (1.0 + joint as f64) * (3.0 * hz + day as f64);
                size * (TAU * hz).powi(power) * (TAU * hz * t + phase + shift).sin()
            };
            time.iter()
                .map(|&t| harmonics.iter().map(|&h| term(t, h)).sum())
                .collect()
        };
        exact.q.push(sum(0.0, 0));
        exact.dq.push(sum(0.25 * TAU, 1));
        exact.ddq.push(sum(0.5 * TAU, 2));
    }
    let motion = Motion {
        time,
        smooth: exact.clone(),
        wide: exact,
        ..Motion::default()
    };
    let mut tau = torque_of(&machine, &motion, &[], &beta, machine.dof());
    let mut random = ChaCha8Rng::seed_from_u64(day);
    for value in tau.iter_mut().flatten() {
        let noise: f64 = StandardNormal.sample(&mut random);
        *value += 0.02 * noise;
    }
    assert!(machine.shapes().is_empty());
    Ok(Log::from_samples(
        format!("day {day}"),
        motion.time,
        motion.smooth.q,
        tau,
    )?)
}
