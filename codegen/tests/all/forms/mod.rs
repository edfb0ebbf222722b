//! Laws of energies, momentum and kinematics: every form is tested against another derivation.

mod momentum;

use std::fmt::Write;

use robot_model_codegen::dynamics::{Energies, Value, energies};
use robot_model_codegen::expr::{Dag, ExprId, Symbol};
use robot_model_codegen::{Compiled, compile_model};

const ROBOTS: [&str; 10] = [
    "two_link",
    "slider",
    "skew",
    "stanford",
    "puma560",
    "panda",
    "every_effect",
    "phantom",
    "pneumatic_arm",
    "puma_shoulder",
];

/// Sums of some hundred products of numbers of order one, two derivations with different order.
const ROUNDING: f64 = 1e-11;

fn compiled(robot: &str) -> Compiled {
    let specs = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/specs");
    let text = ["pass", "run"]
        .iter()
        .find_map(|fate| std::fs::read_to_string(format!("{specs}/{fate}/{robot}.robot")).ok());
    from_text(&text.expect("the spec is in the repository"))
}

fn from_text(text: &str) -> Compiled {
    let model =
        robot_model_spec::load("arm.robot", text).unwrap_or_else(|errors| panic!("{errors}"));
    compile_model(&model)
}

/// Numbers without meaning, the same in every run: linear laws hold for all.
fn value(symbol: Symbol) -> f64 {
    let (kind, k) = match symbol {
        Symbol::Q(k) => (0.3, k),
        Symbol::Dq(k) => (1.1, k),
        Symbol::Ddq(k) => (2.3, k),
        Symbol::Parameter(k) => (3.7, k),
        Symbol::RigidTorque(k) => (4.9, k),
        Symbol::Shape(_) => return 0.1,
        Symbol::Time => return 0.7,
        Symbol::MeasuredTorque(k)
        | Symbol::Input(k)
        | Symbol::State(k)
        | Symbol::Switch(k)
        | Symbol::Weight(k) => (5.3, k),
    };
    1.3 * (kind + 1.7 * k as f64).sin()
}

#[track_caller]
fn assert_close(what: &str, found: f64, wanted: f64, scale: f64) {
    assert!(
        (found - wanted).abs() <= ROUNDING * (1.0 + scale.abs()),
        "{what}: {found} and {wanted}"
    );
}

/// `dx/dt` along a motion.
fn rate(dag: &mut Dag, x: ExprId, dof: usize) -> ExprId {
    let mut sum = dag.derivative(x, Symbol::Time);
    for joint in 0..dof {
        for (of, symbol) in [
            (Symbol::Q(joint), Symbol::Dq(joint)),
            (Symbol::Dq(joint), Symbol::Ddq(joint)),
        ] {
            let slope = dag.derivative(x, of);
            let speed = dag.symbol(symbol);
            let part = dag.mul(slope, speed);
            sum = dag.add(sum, part);
        }
    }
    sum
}

/// `d/dt dT/d dq - d(T - V)/dq`
fn euler_lagrange(dag: &mut Dag, energies: Energies, dof: usize) -> Vec<ExprId> {
    let lagrangian = dag.sub(energies.kinetic, energies.potential);
    (0..dof)
        .map(|joint| {
            let momentum = dag.derivative(energies.kinetic, Symbol::Dq(joint));
            let rate = rate(dag, momentum, dof);
            let force = dag.derivative(lagrangian, Symbol::Q(joint));
            dag.sub(rate, force)
        })
        .collect()
}

fn assert_energies_give_the_torque(name: &str, arm: &Compiled) {
    let mut dag = arm.dag.clone();
    let torque = euler_lagrange(&mut dag, arm.dynamics.energies, arm.dof());
    for joint in 0..arm.dof() {
        let found = dag.evaluate(torque[joint], &value);
        let wanted = dag.evaluate(arm.dynamics.rigid_torque[joint], &value);
        assert_close(&format!("{name}, joint {joint}"), found, wanted, wanted);
    }
}

#[test]
fn euler_lagrange_of_the_energies_is_the_torque() {
    for robot in ROBOTS {
        assert_energies_give_the_torque(robot, &compiled(robot));
    }
}

/// A chain of `dof` joints with frames in no special pose.
fn random_chain(dof: usize, seed: f64) -> String {
    let mut text = String::from("robot Random { gravity = [1.2, -3.4, -9.1]; convention = origin;");
    let mut state = seed;
    let mut next = || {
        state = (state * 1.618 + 0.577).fract();
        2.0 * state - 1.0
    };
    for joint in 0..dof {
        let kind = if joint % 3 == 2 {
            "prismatic"
        } else {
            "revolute"
        };
        let mut vector = || [next(), next(), next()];
        let (xyz, rpy, axis) = (vector(), vector(), vector());
        write!(
            text,
            "joint j{joint}: {kind} {{ xyz = {xyz:?}; rpy = {rpy:?}; axis = {axis:?}; offset = 0.3; }}"
        )
        .expect("text takes any length");
    }
    text + "}"
}

#[test]
fn so_it_is_for_large_arms_in_no_special_pose() {
    for (dof, seed) in [(3, 0.1), (5, 0.7), (8, 0.4)] {
        let arm = from_text(&random_chain(dof, seed));
        assert_energies_give_the_torque(&format!("{dof} joints"), &arm);
    }
}

/// Both derivations of a 2R arm multiply out to the same sum of products: their difference has no terms left.
#[test]
fn both_derivations_of_a_planar_arm_are_the_same_expression() {
    let arm = from_text(
        "robot Arm { gravity = [0, -9.81, 0]; convention = modified_dh;
            joint one: revolute { a = 0; alpha = 0; d = 0; }
            joint two: revolute { a = 0.5; alpha = 0; d = 0; } }",
    );
    let mut dag = arm.dag.clone();
    let lagrange = euler_lagrange(&mut dag, arm.dynamics.energies, 2);
    for (lagrange, newton) in lagrange.into_iter().zip(&arm.dynamics.rigid_torque) {
        let difference = dag.sub(lagrange, *newton);
        let expanded =
            robot_model_codegen::show::polynomial::expand(&mut dag, difference, &arm.names())
                .expect("a small arm");
        assert_eq!(
            expanded,
            robot_model_codegen::show::polynomial::Polynomial::default()
        );
    }
}

/// An arm with an effect of its own on its second joint.
fn with_effect(torque: &str) -> Compiled {
    from_text(&format!(
        "effect own(j) {{ linear c; torque(j) = {torque}; }}
        robot Arm {{ gravity = [0, -9.81, 0]; convention = standard_dh;
            joint one: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint two: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            effects {{ own on two; }} }}"
    ))
}

/// `V` of the standard parameters against the height of the masses: PUMA's upper arm alone, 0.4318 m long.
#[test]
fn potential_energy_is_mass_times_gravity_times_height() {
    let arm = compiled("puma560");
    let mut dag = arm.dag.clone();
    let values = vec![Value::Symbol; arm.standard.len()];
    let potential = energies(&mut dag, &arm.model, None, &values).potential;
    let mass = arm
        .standard
        .iter()
        .position(|parameter| parameter.name == "shoulder.m");
    let mass = mass.expect("the link of the second joint");
    let pose = arm.kinematics.as_ref().expect("a chain").poses[mass / 10];
    let bind = |symbol| match symbol {
        Symbol::Parameter(k) => f64::from(u8::from(k == mass)),
        other => value(other),
    };
    let gravity = arm.model.chain().expect("a chain").gravity;
    let height: f64 = (0..3)
        .map(|k| -gravity[k] * dag.evaluate(pose.translation[k], &bind))
        .sum();
    assert!(height.abs() > 0.1, "{height}");
    assert_close("V", dag.evaluate(potential, &bind), height, height);
}

/// Column `j` of the Jacobian is the slope of the tip's pose: of its origin, and of its rotation by `dR/dq R^T = [w]x`.
#[test]
fn the_jacobian_is_the_slope_of_the_pose() {
    for robot in ROBOTS {
        let arm = compiled(robot);
        let mut dag = arm.dag.clone();
        // Robots that say their energies have no links.
        let Some(kinematics) = arm.kinematics.clone() else {
            continue;
        };
        let tip = kinematics.poses[arm.dof() - 1];
        let rotation = nalgebra::Matrix3::from_fn(|i, j| dag.evaluate(tip.rotation[i][j], &value));
        let eye = (rotation * rotation.transpose() - nalgebra::Matrix3::identity()).amax();
        assert!(eye < ROUNDING, "{robot}: {eye:.1e}");
        for joint in 0..arm.dof() {
            let column: Vec<f64> = (0..6)
                .map(|row| dag.evaluate(kinematics.jacobian[row][joint], &value))
                .collect();
            for axis in 0..3 {
                let slope = dag.derivative(tip.translation[axis], Symbol::Q(joint));
                let slope = dag.evaluate(slope, &value);
                assert_close(&format!("{robot} v"), column[axis], slope, slope);
            }
            let turned = tip.rotation.map(|row| {
                row.map(|entry| {
                    let slope = dag.derivative(entry, Symbol::Q(joint));
                    dag.evaluate(slope, &value)
                })
            });
            let spin = nalgebra::Matrix3::from_fn(|i, j| turned[i][j]) * rotation.transpose();
            let w = [spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]];
            for axis in 0..3 {
                assert_close(&format!("{robot} w"), column[3 + axis], w[axis], 1.0);
            }
        }
    }
}

/// Slopes are exact derivatives, so differences of the torque are what they can be tested against; sign and abs of the load
/// and of velocities are away from their jumps here.
#[test]
fn slopes_are_what_differences_of_the_torque_are() {
    /// Truncation `h^2 / 6` times a third derivative of some hundreds, rounding `1e-16 / h` times a torque of some hundreds.
    const DIFFERENCE: f64 = 1e-6;
    /// Of a joint.
    type Coordinate = fn(usize) -> Symbol;
    let h = 1e-5;
    for robot in ROBOTS {
        let arm = compiled(robot);
        let torque = arm.inverse_dynamics();
        let scale = torque
            .eval(&value)
            .iter()
            .fold(1.0, |most: f64, t| most.max(t.abs()));
        let slopes: [(&str, Coordinate, Vec<f64>); 3] = [
            ("q", Symbol::Q, arm.by_position().eval(&value)),
            ("dq", Symbol::Dq, arm.by_velocity().eval(&value)),
            ("ddq", Symbol::Ddq, arm.by_acceleration().eval(&value)),
        ];
        for (what, coordinate, slopes) in slopes {
            for joint in 0..arm.dof() {
                let moved = |step: f64| {
                    torque.eval(&|symbol| {
                        value(symbol)
                            + if symbol == coordinate(joint) {
                                step
                            } else {
                                0.0
                            }
                    })
                };
                for (row, (more, less)) in moved(h).iter().zip(moved(-h)).enumerate() {
                    let found = slopes[row * arm.dof() + joint];
                    let wanted = (more - less) / (2.0 * h);
                    assert!(
                        (found - wanted).abs() < DIFFERENCE * scale,
                        "{robot}: tau{row} by {what}{joint}: {found} and {wanted}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_torque_is_affine_in_accelerations_but_for_loads_and_jumps() {
    for (torque, affine, symmetric) in [
        ("c * ddq(j)", true, true),
        ("c * abs(rigid_torque(j)) * sign(dq(j))", false, false),
        // Level on both sides of a jump: no slope tells of it.
        ("c * sign(ddq(j))", false, true),
        ("c * if rigid_torque(j) > 1 { 1 } else { 0 }", false, true),
    ] {
        let arm = with_effect(torque);
        assert_eq!(arm.partials.is_affine, affine, "{torque}");
        assert_eq!(arm.partials.is_symmetric(), symmetric, "{torque}");
    }
}
