//! An effect of one's own: a hose along the forearm pulls the elbow as a spring does that hardens, with a law that no standard effect has.
//!
//! The definition stands in the spec, in front of the robot. Where it is declared it is identified with all else; where it is defined and
//! not declared the tracer takes it for a candidate like the standard ones.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

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

const HOSE: &str = "
/// A hose that is bent: its torque grows as the position's cube.
effect hose(j) {
    /// Torque at 1 rad, N m.
    linear k >= 0;
    torque(j) = k * q(j)^3;
}
";

const ARM: &str = "
robot Arm {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint shoulder: revolute { a = 0.5 m; alpha = 0; d = 0; }
    joint elbow: revolute { a = 0.4 m; alpha = 0; d = 0; }
    effects { viscous_friction on all; EFFECTS }
}
";

/// Of the machine: base parameters of the links, friction of both joints, N m s/rad, and the hose, N m.
const MACHINE: [(&str, f64); 9] = [
    ("shoulder.mxr", 1.0),
    ("shoulder.my", 0.02),
    ("shoulder.izzr", -0.6),
    ("elbow.mxr", 0.2),
    ("elbow.my", 0.01),
    ("elbow.izzr", -0.1),
    ("shoulder.viscous_friction.fv", 1.2),
    ("elbow.viscous_friction.fv", 0.6),
    ("elbow.hose.k", 0.8),
];

/// Identifies with the effect declared, and finds it where it is not.
///
/// # Errors
/// None are expected; those of the libraries are passed on.
pub fn main() -> Result<(), Box<dyn Error>> {
    let declared = compile("hose on elbow;")?;
    let log = measure(&declared)?;

    let found = Identify::default().fit(&declared, std::slice::from_ref(&log))?;
    println!("Declared:\n{found}");
    let hose = found.parameters.iter().find(|p| p.name == "elbow.hose.k");
    let hose = hose.ok_or("the effect has a parameter")?;
    assert!((hose.value - 0.8).abs() < 0.01, "{hose:?}");

    let plain = compile("")?;
    let undeclared = plain.undeclared();
    let trace = Trace::new(undeclared.candidates());
    let verdict = trace.run(&plain, &[log], &mut |_| ())?;
    assert_eq!(verdict.outcome, Outcome::Explained);
    let finding = &verdict.findings[0];
    println!(
        "Not declared: {} on {}",
        finding.effect,
        plain.joints()[finding.joints[0]]
    );
    assert_eq!(
        (finding.effect.as_str(), finding.joints.as_slice()),
        ("hose", &[1][..])
    );
    Ok(())
}

/// The arm with the definition of the hose in its spec, and these effects declared.
fn compile(effects: &str) -> Result<InterpretedArm, Box<dyn Error>> {
    let text = HOSE.to_owned() + &ARM.replace("EFFECTS", effects);
    let model = robot_model_spec::load("arm.robot", &text)?;
    Ok(InterpretedArm::new(compile_model(&model)))
}

/// Twenty seconds of the machine's motion, with noise of 20 mN m.
fn measure(machine: &InterpretedArm) -> Result<Log, Box<dyn Error>> {
    let value = |name: &str| {
        let known = MACHINE.iter().find(|(known, _)| *known == name);
        known
            .map(|(_, value)| *value)
            .ok_or_else(|| format!("no value for {name}"))
    };
    let names = machine.unknowns().iter();
    let beta: Vec<f64> = names
        .map(|unknown| value(&unknown.name))
        .collect::<Result<_, _>>()?;
    let time: Vec<f64> = (0..10_000).map(|k| f64::from(k) * 2e-3).collect();
    let mut exact = Kinematics::default();
    for waves in [[(0.2, 0.8), (0.7, 0.3)], [(0.3, 1.0), (0.9, 0.2)]] {
        let series = |shift: f64, power: i32| -> Vec<f64> {
            let wave = |t: f64, (hz, size): (f64, f64)| {
                size * (TAU * hz).powi(power) * (TAU * hz * t + shift).sin()
            };
            let at = |t: &f64| waves.iter().map(|&one| wave(*t, one)).sum();
            time.iter().map(at).collect()
        };
        exact.q.push(series(0.0, 0));
        exact.dq.push(series(0.25 * TAU, 1));
        exact.ddq.push(series(0.5 * TAU, 2));
    }
    let motion = Motion {
        time,
        smooth: exact.clone(),
        wide: exact,
        ..Motion::default()
    };
    let mut tau = torque_of(machine, &motion, &[], &beta, machine.dof());
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for value in tau.iter_mut().flatten() {
        let noise: f64 = StandardNormal.sample(&mut random);
        *value += 0.02 * noise;
    }
    Ok(Log::from_samples(
        "machine".to_owned(),
        motion.time,
        motion.smooth.q,
        tau,
    )?)
}
