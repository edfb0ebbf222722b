//! The arms of five papers: their printed equations, where these are right, come out of the compiler.

mod phantom;

use nalgebra::DMatrix;
use robot_model_spec::parameter::Owner;
use robot_model_tests::evaluate::{Interpreter, relative_difference};
use robot_model_tests::specs;
use robot_model_tests::states::{self, State};

/// Some hundred roundings in forms that are written differently.
const ROUNDING: f64 = 1e-13;

fn interpreter(name: &str) -> Interpreter {
    Interpreter::new(specs::named(&format!("pass/{name}")).compiled())
}

/// Values of the standard parameters of energies from those of the robot's own parameters; effects' are zero.
fn standard(interpreter: &Interpreter, value: impl Fn(&str) -> f64) -> Vec<f64> {
    let compiled = &interpreter.compiled;
    let energies = compiled.model.energies().expect("it says its energies");
    let values: Vec<f64> = energies.parameters.iter().map(|p| value(&p.name)).collect();
    let of = |owner: Owner| match owner {
        Owner::Monomial(k) => energies.monomials[k]
            .factors
            .iter()
            .map(|&(k, exponent)| f64::powi(values[k], exponent))
            .product(),
        _ => 0.0,
    };
    compiled.standard.iter().map(|p| of(p.owner)).collect()
}

fn column(values: &[f64]) -> DMatrix<f64> {
    DMatrix::from_column_slice(values.len(), 1, values)
}

fn assert_close(what: &str, found: &DMatrix<f64>, wanted: &DMatrix<f64>) {
    let difference = relative_difference(found, wanted);
    assert!(
        difference < ROUNDING,
        "{what}: {difference:.1e}\n{found}{wanted}"
    );
}

/// Some values for the pneumatic arm.
fn pneumatic(name: &str) -> f64 {
    match name {
        "m1" => 6.813,
        "m2" => 3.361,
        "l1" => 0.552,
        "c1" => 0.346,
        "c2" => 0.212,
        "I1" => 0.264,
        "I2" => 0.012,
        other => panic!("{other}"),
    }
}

/// Equations (3) and (4) of the paper on the pneumatic arm, as printed. `examples/tests/all/seed_001.rs` has its chain, too.
fn printed_pneumatic(state: &State) -> DMatrix<f64> {
    let [m1, m2, l1, c1, c2, i1, i2] = ["m1", "m2", "l1", "c1", "c2", "I1", "I2"].map(pneumatic);
    let g = 9.81;
    let (q1, q2) = (state.q[0], state.q[1]);
    let (v1, v2) = (state.dq[0], state.dq[1]);
    let (a1, a2) = (state.ddq[0], state.ddq[1]);
    let tau1 =
        (m1 * c1 * c1 + m2 * c2 * c2 + m2 * l1 * l1 + 2.0 * m2 * c2 * l1 * q2.cos() + i1 + i2) * a1
            + (m2 * c2 * c2 + m2 * c2 * l1 * q2.cos() + i2) * a2
            - 2.0 * m2 * c2 * l1 * q2.sin() * v1 * v2
            - m2 * c2 * l1 * q2.sin() * v2 * v2
            + m2 * g * c2 * (q1 + q2).sin()
            + (m1 * c1 + m2 * l1) * g * q1.sin();
    let tau2 = (m2 * c2 * c2 + m2 * c2 * l1 * q2.cos() + i2) * a1
        + (m2 * c2 * c2 + i2) * a2
        + m2 * c2 * l1 * q2.sin() * v1 * v1
        + m2 * g * c2 * (q1 + q2).sin();
    column(&[tau1, tau2])
}

#[test]
fn pneumatic_arm_has_the_equations_of_the_paper() {
    let arm = interpreter("pneumatic_arm");
    let standard = standard(&arm, pneumatic);
    let mut random = states::generator(1);
    for _ in 0..20 {
        let state = states::state(&mut random, 2);
        let found = arm.rigid_torque(&standard, &state);
        assert_close("(3), (4)", &found, &printed_pneumatic(&state));
    }
    let base: Vec<&str> = arm.compiled.base.names.iter().map(String::as_str).collect();
    assert_eq!(base[..5], ["I1r", "I2r", "m1*c1r", "m2*c2", "m2*l1*c2"]);
}

/// `J ddth - m g r sin(th) + f(dth) = u` and its three laws of friction.
#[test]
fn puma_shoulder_has_two_rigid_parameters_and_the_frictions_of_the_paper() {
    let shoulder = interpreter("puma_shoulder");
    let names: Vec<&str> = shoulder
        .compiled
        .base
        .names
        .iter()
        .map(String::as_str)
        .collect();
    assert_eq!(
        names,
        [
            "J",
            "mr",
            "th.viscous_friction.fv",
            "th.asymmetric_viscous.delta",
            "th.quadratic_viscous.c"
        ]
    );
    let (j, mr, fv, delta, c) = (2.0, 3.0, 0.7, 0.2, 0.1);
    let state = State {
        q: vec![0.4],
        dq: vec![-1.3],
        ddq: vec![2.1],
        ..State::default()
    };
    let x = state.dq[0];
    let tau = j * 2.1 - mr * 9.81 * 0.4_f64.sin() + fv * x + delta * x.abs() + c * x * x.abs();
    let found = shoulder
        .forms(&[j, mr, fv, delta, c], &state)
        .inverse_dynamics;
    assert_close("(2.3), (6.1) to (6.3)", &found, &column(&[tau]));
}

/// 16 parameters a joint; 36 base parameters of the rigid body, four of six rotors, five of friction a joint.
#[test]
fn six_joints_with_rotors_and_the_friction_law_have_70_of_96_parameters() {
    let arm = interpreter("rokae_like");
    let base = &arm.compiled.base;
    assert_eq!((arm.compiled.standard.len(), base.kept.len()), (96, 70));
    let of = |what: &str| base.names.iter().filter(|name| name.contains(what)).count();
    assert_eq!((of(".rokae."), of(".motor_inertia.")), (30, 4));
    for absorbed in ["j1.motor_inertia.ia", "j2.motor_inertia.ia"] {
        let regrouped = base.combinations.iter().any(|combination| {
            combination.len() > 1
                && combination
                    .iter()
                    .any(|&(k, _)| arm.compiled.standard[k].name == absorbed)
        });
        assert!(regrouped, "{absorbed} belongs to its link");
    }
}

/// Equation (7) without its two slips: the uniform rod has a third, not 0.3, and gravity one length, not two. As energies and
/// as a chain.
#[test]
fn lugre_link_is_a_uniform_rod() {
    let (m, l, a, g) = (0.045, 0.21, 0.005, 9.81);
    let rod = interpreter("lugre_link");
    let chain = "robot Rod {
        gravity = [0, -9.81, 0];
        convention = standard_dh;
        joint th: revolute { a = 0.21; alpha = 0; d = 0; }
    }";
    let chain = robot_model_spec::load("rod.robot", chain).unwrap();
    let chain = Interpreter::new(robot_model_codegen::compile_model(&chain));
    // The chain's frame lies at `l` on the rod's line, where its center of mass is at `a - l/2 - l`.
    let x = a - l / 2.0 - l;
    let of_chain: Vec<f64> = chain
        .compiled
        .standard
        .iter()
        .map(|parameter| match parameter.name.as_str() {
            "th.m" => m,
            "th.mx" => m * x,
            "th.izz" => m * l * l / 12.0 + m * x * x,
            _ => 0.0,
        })
        .collect();
    let of_energies = standard(&rod, |_| m);
    let mut random = states::generator(6);
    for _ in 0..20 {
        let state = states::state(&mut random, 1);
        let wanted = m * (l * l / 3.0 - a * l + a * a) * state.ddq[0]
            + m * g * (a - l / 2.0) * state.q[0].cos();
        let wanted = column(&[wanted]);
        assert_close("energies", &rod.rigid_torque(&of_energies, &state), &wanted);
        assert_close("chain", &chain.rigid_torque(&of_chain, &state), &wanted);
    }
}
