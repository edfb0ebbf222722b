//! Laws of emitted energies, momentum, slopes, forward dynamics and kinematics, for every spec.

use nalgebra::{DMatrix, Matrix3, Vector3};
use robot_model::{FromParameters, Kinematics, Points, RobotModel as _, Vector};
use robot_model_tests::emitted::{self, Robot};
use robot_model_tests::evaluate::{Interpreter, relative_difference};
use robot_model_tests::mechanics;
use robot_model_tests::oracle::{Frames, Oracle};
use robot_model_tests::specs;
use robot_model_tests::states::{self, State};

/// Two orders of summation of some thousand roundings; a wrong sign or a lost term is off by a part in ten.
const ROUNDING: f64 = 1e-11;

/// A central difference with step `h = 1e-5`, as in `laws.rs`.
const DIFFERENCE: f64 = 1e-7;
const STEP: f64 = 1e-5;

/// Random states an arm is tested in.
const STATES: usize = 4;

struct Case<'a> {
    robot: &'a Robot,
    interpreter: &'a Interpreter,
    standard: Vec<f64>,
    state: State,
}

fn for_all(law: impl Fn(&Case<'_>)) {
    for spec in [specs::folder("pass"), specs::folder("run")].concat() {
        let interpreter = Interpreter::new(spec.compiled());
        let robot = emitted::ROBOTS
            .iter()
            .find(|robot| robot.spec == spec.name)
            .unwrap_or_else(|| panic!("list `{}` in emitted.rs", spec.name));
        let model = interpreter.compiled.model.clone();
        let mut random = states::generator(31);
        for _ in 0..STATES {
            law(&Case {
                robot,
                interpreter: &interpreter,
                standard: states::physical(&mut random, &model),
                state: states::state(&mut random, model.joints.len()),
            });
        }
    }
}

fn column(values: &[f64]) -> DMatrix<f64> {
    DMatrix::from_column_slice(values.len(), 1, values)
}

#[track_caller]
fn assert_close(what: &str, found: &DMatrix<f64>, wanted: &DMatrix<f64>, tolerance: f64) {
    // An arm without gravity, say, has zeros in both.
    if found.amax() > 0.0 || wanted.amax() > 0.0 {
        let difference = relative_difference(found, wanted);
        assert!(
            difference < tolerance,
            "{what}: {difference:.1e}\nfound {found}wanted {wanted}"
        );
    }
}

#[test]
fn emitted_code_agrees_with_the_interpreter() {
    for_all(|case| {
        let name = case.robot.spec;
        let wanted = mechanics::interpreted(case.interpreter, &case.standard, &case.state);
        let found = (case.robot.mechanics)(&case.standard, &case.state);
        let number = |x| column(&[x]);
        for (what, found, wanted) in [
            (
                "T",
                &number(found.kinetic_energy),
                &number(wanted.kinetic_energy),
            ),
            (
                "V",
                &number(found.potential_energy),
                &number(wanted.potential_energy),
            ),
            ("dtau/dq", &found.by_position, &wanted.by_position),
            ("dtau/ddq", &found.by_velocity, &wanted.by_velocity),
            ("Y_p", &found.standard[0], &wanted.standard[0]),
            ("Y_h", &found.standard[1], &wanted.standard[1]),
            ("Y_p of beta", &found.base[0], &wanted.base[0]),
            ("Y_h of beta", &found.base[1], &wanted.base[1]),
        ] {
            assert_close(&format!("{name}, {what}"), found, wanted, ROUNDING);
        }
    });
}

/// `Y_p * standard` is `M dq` and `Y_h * standard` is `C^T dq - G` where effects are zero, for standard and base parameters.
#[test]
fn momentum_and_drift_are_those_of_the_matrices() {
    for_all(|case| {
        let name = case.robot.spec;
        let compiled = &case.interpreter.compiled;
        let mut standard = case.standard.clone();
        standard[compiled.model.rigid_parameters()..].fill(0.0);
        let forms = (case.robot.forms)(&standard, &case.state);
        let more = (case.robot.mechanics)(&standard, &case.state);
        let dq = column(&case.state.dq);
        let momentum = &forms.mass_matrix * &dq;
        let drift = forms.coriolis_matrix.transpose() * &dq - &forms.gravity;
        let [p, h] = more.standard.map(|regressor| regressor * column(&standard));
        assert_close(&format!("{name}, p"), &p, &momentum, ROUNDING);
        assert_close(&format!("{name}, h"), &h, &drift, ROUNDING);
        let kinetic = 0.5 * (dq.transpose() * &momentum)[(0, 0)];
        let difference = (more.kinetic_energy - kinetic).abs();
        assert!(difference <= ROUNDING * kinetic, "{name}: {difference:.1e}");
        let fixed = !compiled.base.fixed.is_empty();
        if !fixed {
            let beta = column(&compiled.base.beta(&standard));
            let [p, h] = more.base.map(|regressor| regressor * &beta);
            assert_close(&format!("{name}, p of beta"), &p, &momentum, ROUNDING);
            assert_close(&format!("{name}, h of beta"), &h, &drift, ROUNDING);
        }
    });
}

#[test]
fn power_is_the_rate_of_the_emitted_energies() {
    for_all(|case| {
        let name = case.robot.spec;
        let rigid = case.interpreter.compiled.model.rigid_parameters();
        let mut standard = case.standard.clone();
        standard[rigid..].fill(0.0);
        let energy = |t: f64| {
            let moved = |x: &[f64], dx: &[f64], ddx: f64| -> Vec<f64> {
                let pairs = x.iter().zip(dx).zip(&case.state.ddq);
                pairs
                    .map(|((x, dx), a)| x + t * dx + 0.5 * ddx * t * t * a)
                    .collect()
            };
            let state = State {
                q: moved(&case.state.q, &case.state.dq, 1.0),
                dq: moved(&case.state.dq, &case.state.ddq, 0.0),
                ..case.state.clone()
            };
            let forms = (case.robot.mechanics)(&standard, &state);
            forms.kinetic_energy + forms.potential_energy
        };
        let rate = (energy(STEP) - energy(-STEP)) / (2.0 * STEP);
        let torque = (case.robot.forms)(&standard, &case.state).inverse_dynamics;
        let power = (column(&case.state.dq).transpose() * torque)[(0, 0)];
        let scale = energy(0.0).abs().max(rate.abs());
        let difference = (rate - power).abs();
        assert!(
            difference < DIFFERENCE * scale,
            "{name}: {rate} and {power}"
        );
    });
}

/// Torque to accelerations and back, effects included, at loads that friction depends on.
#[test]
fn forward_dynamics_undoes_inverse_dynamics() {
    for_all(|case| {
        let mut standard = case.standard.clone();
        // A motor that turns with two joints has the least inertia on each: more than that on both at once is no motor.
        for (value, name) in standard.iter_mut().zip(case.robot.standard_parameters) {
            if name.ends_with("gear_coupling.ia") {
                *value = 0.05;
            }
        }
        let tau = (case.robot.forms)(&standard, &case.state).inverse_dynamics;
        let accelerations = case.robot.accelerations;
        let found = accelerations(&standard, &case.state, tau.as_slice())
            .unwrap_or_else(|| panic!("{}: no accelerations", case.robot.spec));
        // Condition numbers of mass matrices of such arms reach some thousands.
        let wanted = column(&case.state.ddq);
        assert_close(case.robot.spec, &column(&found), &wanted, 1e-8);
    });
}

/// Pinocchio's torques give Pinocchio's accelerations. Effects' parameters are zero, which leaves no effect torque.
#[test]
fn forward_dynamics_is_that_of_the_oracle() {
    for name in ["puma560", "ur10", "panda"] {
        let Some(oracle) = Oracle::read(name) else {
            continue;
        };
        let frames = match name {
            "puma560" => Frames::StandardDh,
            _ => Frames::Joint,
        };
        let robot = emitted::ROBOTS.iter().find(|robot| robot.spec == name);
        let robot = robot.expect("a spec of this repository");
        let mut standard = oracle.standard(frames);
        standard.resize(robot.standard_parameters.len(), 0.0);
        for reference in oracle.references(frames) {
            let tau = reference.torque.as_slice();
            let found = (robot.accelerations)(&standard, &reference.state, tau);
            let found = found.unwrap_or_else(|| panic!("{name}: no accelerations"));
            // The wrist of the PUMA without rotors: condition numbers of some ten thousands.
            assert_close(name, &column(&found), &column(&reference.state.ddq), 1e-8);
        }
    }
}

/// No arm has negative masses: a status, not numbers.
#[test]
fn parameters_of_no_arm_have_no_accelerations() {
    let robot = emitted::ROBOTS.iter().find(|robot| robot.spec == "puma560");
    let robot = robot.expect("a spec of this repository");
    let count = robot.standard_parameters.len();
    let state = State {
        q: vec![0.3; 6],
        dq: vec![0.1; 6],
        ddq: vec![0.0; 6],
        ..State::default()
    };
    for standard in [vec![0.0; count], vec![-1.0; count], vec![f64::NAN; count]] {
        assert_eq!((robot.accelerations)(&standard, &state, &[1.0; 6]), None);
    }
}

/// `inverse_dynamics = Y * standard = Y_b * beta` with the arm's own load and shapes, which the associated functions do not
/// know.
#[test]
fn an_arms_regressor_has_its_load_and_its_shapes() {
    type Arm = emitted::every_effect::EveryEffect;
    assert_regressor_of::<Arm, _, _, _, _>(|arm| {
        let shapes = arm.shapes();
        Arm::from_parameters(&arm.standard(), &(shapes * 1.1))
    });
}

fn assert_regressor_of<
    R,
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize,
>(
    other_shapes: impl Fn(&R) -> R,
) where
    R: FromParameters<DOF, STANDARD, BASE, SHAPES>,
{
    let mut random = states::generator(11);
    let state = states::state(&mut random, DOF);
    let vector = |values: &[f64]| Vector::<DOF>::from_column_slice(values);
    let (q, dq, ddq) = (vector(&state.q), vector(&state.dq), vector(&state.ddq));
    let standard =
        Vector::<STANDARD>::from_fn(|k, _| 0.5 + 0.01 * f64::from(u32::try_from(k).unwrap_or(0)));
    let arm = other_shapes(&R::from_standard(&standard));
    let torque = arm.inverse_dynamics(&q, &dq, &ddq);
    let scale = torque.amax();
    let own = arm.regressor_of(&q, &dq, &ddq) * arm.standard();
    assert!((torque - own).amax() < ROUNDING * scale, "{torque} {own}");
    // Sums over columns that are regrouped, some with large coefficients.
    let base = arm.base_regressor_of(&q, &dq, &ddq) * arm.beta();
    assert!((torque - base).amax() < 1e-9 * scale, "{torque} {base}");
    let plain = R::regressor(&q, &dq, &ddq) * arm.standard();
    assert!(
        (torque - plain).amax() > 1e-3 * scale,
        "the load and the shapes count"
    );
}

/// `jacobian * dq` is what differences of the poses are, and rotations are rotations.
fn assert_jacobian_is_the_rate_of_the_pose<const DOF: usize>(
    arm: &impl Kinematics<DOF>,
    name: &str,
) {
    let mut random = states::generator(5);
    for _ in 0..STATES {
        let state = states::state(&mut random, DOF);
        let (q, dq) = (
            Vector::<DOF>::from_column_slice(&state.q),
            Vector::<DOF>::from_column_slice(&state.dq),
        );
        let pose = |t: f64| arm.forward_kinematics(&(q + t * dq))[DOF - 1];
        let (before, here, after) = (pose(-STEP), pose(0.0), pose(STEP));
        let rate = (after - before) / (2.0 * STEP);
        let rotation: Matrix3<f64> = here.fixed_view::<3, 3>(0, 0).into();
        assert!((rotation.determinant() - 1.0).abs() < ROUNDING, "{name}");
        let spin = rate.fixed_view::<3, 3>(0, 0) * rotation.transpose();
        let velocity: Vector3<f64> = rate.fixed_view::<3, 1>(0, 3).into();
        let wanted = [
            velocity.x,
            velocity.y,
            velocity.z,
            spin[(2, 1)],
            spin[(0, 2)],
            spin[(1, 0)],
        ];
        let found = arm.jacobian(&q) * dq;
        for (found, wanted) in found.iter().zip(wanted) {
            assert!(
                (found - wanted).abs() < DIFFERENCE * dq.norm(),
                "{name}: {found} and {wanted}"
            );
        }
    }
}

#[test]
fn the_jacobian_is_the_rate_of_the_pose() {
    assert_jacobian_is_the_rate_of_the_pose(
        &emitted::two_link::TwoLink::from_base(&Vector::zeros()),
        "two_link",
    );
    assert_jacobian_is_the_rate_of_the_pose(
        &emitted::puma560::Puma560::from_base(&Vector::zeros()),
        "puma560",
    );
    assert_jacobian_is_the_rate_of_the_pose(
        &emitted::panda::Panda::from_base(&Vector::zeros()),
        "panda",
    );
    assert_jacobian_is_the_rate_of_the_pose(
        &emitted::stanford::Stanford::from_base(&Vector::zeros()),
        "stanford",
    );
    assert_jacobian_is_the_rate_of_the_pose(
        &emitted::mounted_arm::MountedArm::from_base(&Vector::zeros()),
        "mounted_arm",
    );
    assert_jacobian_is_the_rate_of_the_pose(
        &emitted::skew::Skew::from_base(&Vector::zeros()),
        "skew",
    );
}

/// A planar arm of 0.5 m and 0.4 m, the second offset by a quarter turn: where its links end, by hand.
#[test]
fn poses_are_those_of_the_drawing() {
    let q = Vector::from([0.3, 0.5]);
    let [elbow, tip] =
        emitted::two_link::TwoLink::from_base(&Vector::zeros()).forward_kinematics(&q);
    let second = 0.3 + 0.5 + specs_offset();
    let wanted = [0.5 * 0.3_f64.cos(), 0.5 * 0.3_f64.sin()];
    assert!((elbow[(0, 3)] - wanted[0]).abs() < 1e-15 && (elbow[(1, 3)] - wanted[1]).abs() < 1e-15);
    let wanted = [
        wanted[0] + 0.4 * second.cos(),
        wanted[1] + 0.4 * second.sin(),
    ];
    assert!((tip[(0, 3)] - wanted[0]).abs() < 1e-15 && (tip[(1, 3)] - wanted[1]).abs() < 1e-15);
    assert!(
        (tip[(0, 0)] - second.cos()).abs() < 1e-15 && (tip[(1, 0)] - second.sin()).abs() < 1e-15
    );
}

/// Offset of the second joint in the spec, rad.
fn specs_offset() -> f64 {
    let model = specs::named("pass/two_link").model();
    model.chain().expect("a chain").links[1].placement.offset
}

/// The PHANTOM's tip and its Jacobian, equation (21) of Taati, Tahmasebi and Hashtrudi-Zaad turned into the base frame's axes.
#[test]
fn the_tip_of_the_phantom_moves_as_its_jacobian_says() {
    let phantom = emitted::phantom::Phantom::from_base(&Vector::zeros());
    let (q, dq) = (
        Vector::from([0.4, 0.2, -0.3]),
        Vector::from([1.1, -0.7, 0.5]),
    );
    let [rate] = [
        (phantom.points(&(q + STEP * dq))[0] - phantom.points(&(q - STEP * dq))[0]) / (2.0 * STEP),
    ];
    let velocity = phantom.point_jacobians(&q)[0] * dq;
    assert!((velocity - rate).norm() < DIFFERENCE, "{velocity} {rate}");
    assert_eq!(emitted::phantom::Phantom::POINTS, ["tip"]);
    // Across the arm's plane only the first joint moves the tip, at its distance from the axis.
    let across = phantom.point_jacobians(&q)[0].column(0).norm();
    let (l1, l2) = (0.215, 0.170);
    assert!((across - (l1 * q[1].cos() + l2 * q[2].sin()).abs()).abs() < 1e-14);
}
