//! Structs that derive `RobotModel` against the same robots emitted by the build script: chains and energies, described in
//! attributes and in files. Agreement is to 1e-12 of the torque: the same equations in another order of summation.

use nalgebra::SVector;
use rand::RngExt as _;
use robot_model::effects::{
    AsymmetricCoulomb, CoulombFriction, GearCoupling, LoadDependentFriction, Stribeck,
    ViscousFriction,
};
use robot_model::{FromParameters, Inertial, Link, RobotModel, State, Vector};
use robot_model_tests::emitted::{phantom, pneumatic_arm, slider, two_link};
use robot_model_tests::states::generator;

robot_model::effects!("specs/pass/slider.robot");

/// `tests/specs/pass/two_link.robot` in attributes.
#[derive(Debug, Clone, Copy, PartialEq, RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
struct TwoLink {
    #[joint(revolute, a = 0.5, alpha = 0, d = 0, position = -170 deg .. 170 deg, velocity = 3, torque = 60)]
    shoulder: Link<(ViscousFriction, CoulombFriction)>,
    #[joint(revolute, a = 0.4, alpha = 0, d = 0)]
    elbow: Link<(ViscousFriction, CoulombFriction)>,
}

#[derive(Debug, Clone, Copy, PartialEq, RobotModel)]
#[robot(file = "specs/pass/slider.robot")]
struct Slider {
    rail: (
        ViscousFriction,
        CoulombFriction,
        AsymmetricCoulomb,
        Stribeck,
        CableDrag,
    ),
    pivot: Link<ViscousFriction>,
}

/// A fixed link, a link with a name, an effect of two joints, load, own effects and shapes, all in attributes.
#[derive(Debug, Clone, RobotModel)]
#[robot(convention = modified_dh, gravity = [0, 0, -9.81], effects = "specs/pass/slider.robot")]
struct Coupled {
    #[joint(revolute, alpha = 0, a = 0, d = 0.4, link = column)]
    #[inertial(fixed, mass = 12 kg, com = [0, 0, 0.1], inertia = [0.2, 0, 0, 0.2, 0, 0.1])]
    #[effects(stribeck(vs = 0.2), cable_drag(q0 = 0.3))]
    turntable: (Stribeck, CableDrag),
    #[joint(revolute, alpha = 90 deg, a = 0.1, d = 0)]
    #[inertial(nominal, mass = 2, com = [0.1, 0, 0], inertia = [0, 0, 0, 0.01, 0, 0.01])]
    shoulder: Link<LoadDependentFriction>,
    #[on(turntable, shoulder)]
    coupling: GearCoupling,
}

/// A robot of energies that are linear in its unknowns.
#[derive(Debug, Clone, RobotModel)]
#[robot(file = "specs/pass/phantom.robot")]
struct Phantom {
    ibase_yy: f64,
    ibe_xx: f64,
    ibe_yy: f64,
    ibe_zz: f64,
    ic_xx: f64,
    ic_yy: f64,
    ic_zz: f64,
    ia_xx: f64,
    ia_yy: f64,
    ia_zz: f64,
    idf_xx: f64,
    idf_yy: f64,
    idf_zz: f64,
    m_a: f64,
    m_c: f64,
    m_be: f64,
    m_df: f64,
    th1: (ViscousFriction, CoulombFriction),
    th2: (ViscousFriction, CoulombFriction),
    th3: (ViscousFriction, CoulombFriction),
}

/// A robot whose standard parameters are products of its unknowns.
#[derive(Debug, Clone, RobotModel)]
#[robot(file = "specs/pass/pneumatic_arm.robot")]
struct PneumaticArm {
    i1: f64,
    i2: f64,
    m1: f64,
    m2: f64,
    l1: f64,
    c1: f64,
    c2: f64,
    q1: (ViscousFriction, CoulombFriction),
    q2: (ViscousFriction, CoulombFriction),
}

/// Random motion.
fn motion<const DOF: usize>(seed: u64) -> State<DOF> {
    let mut random = generator(seed);
    let mut vector = || SVector::from_fn(|_, _| random.random_range(-2.0..2.0));
    let (q, dq, ddq) = (vector(), vector(), vector());
    State::new(q, dq, ddq)
}

fn numbers<const N: usize>(seed: u64) -> Vector<N> {
    let mut random = generator(seed);
    SVector::from_fn(|_, _| random.random_range(0.1..1.0))
}

#[track_caller]
fn assert_close<const N: usize>(found: Vector<N>, wanted: Vector<N>) {
    let difference = (found - wanted).norm();
    assert!(
        difference <= 1e-12 * wanted.norm().max(1.0),
        "{found} is not {wanted}"
    );
}

#[test]
fn a_struct_and_a_page_are_one_arm() {
    let page = two_link::TwoLink::from_standard(&numbers(1));
    // Only the order in which effects are declared differs: by joint in the struct, by effect in the file.
    let by_name = TwoLink::STANDARD_PARAMETERS.map(|name| {
        let names = two_link::TwoLink::STANDARD_PARAMETERS;
        let place = names.iter().position(|own| *own == name);
        numbers::<24>(1)[place.expect("the names are the same")]
    });
    let arm = TwoLink::from_standard(&by_name.into());
    for seed in 0..5 {
        let State { q, dq, ddq, .. } = motion::<2>(seed);
        assert_close(
            arm.inverse_dynamics(&q, &dq, &ddq),
            page.inverse_dynamics(&q, &dq, &ddq),
        );
        assert_close(arm.gravity(&q), page.gravity(&q));
        assert_close(arm.bias(&q, &dq), page.bias(&q, &dq));
        assert!((arm.mass_matrix(&q) - page.mass_matrix(&q)).norm() < 1e-12);
        let coriolis = arm.coriolis_matrix(&q, &dq) - page.coriolis_matrix(&q, &dq);
        assert!(coriolis.norm() < 1e-12);
    }
}

#[test]
fn fields_are_the_standard_parameters() {
    let arm = TwoLink {
        shoulder: Link::from(Inertial::from(std::array::from_fn(|k| k as f64)))
            .with((ViscousFriction { fv: 20.0 }, CoulombFriction { fc: 21.0 })),
        elbow: Link::from(Inertial::from(std::array::from_fn(|k| 10.0 + k as f64)))
            .with((ViscousFriction { fv: 22.0 }, CoulombFriction { fc: 23.0 })),
    };
    let standard = arm.standard();
    assert_eq!(standard, Vector::<24>::from_fn(|k, _| k as f64));
    assert_eq!(TwoLink::from_standard(&standard), arm);
    assert_eq!(
        TwoLink::STANDARD_PARAMETERS[21],
        "shoulder.coulomb_friction.fc"
    );
}

#[test]
fn base_parameters_make_an_arm_with_the_same_torque() {
    let arm = TwoLink::from_standard(&numbers(2));
    let estimated = TwoLink::from_base(&arm.beta());
    assert_close(estimated.beta(), arm.beta());
    // What is regrouped is gone.
    assert_eq!(estimated.shoulder.inertial.mass.to_bits(), 0);
    let State { q, dq, ddq, .. } = motion::<2>(9);
    let tau = arm.inverse_dynamics(&q, &dq, &ddq);
    assert_close(estimated.inverse_dynamics(&q, &dq, &ddq), tau);
    assert_close(TwoLink::regressor(&q, &dq, &ddq) * arm.standard(), tau);
    assert_close(TwoLink::base_regressor(&q, &dq, &ddq) * arm.beta(), tau);
}

#[test]
fn a_file_with_own_effects_is_an_arm() {
    let page = slider::Slider::from_standard(&numbers(3));
    let arm = Slider::from_standard(&page.standard());
    assert_eq!(arm.shapes(), Vector::from([0.02, -0.1]));
    for seed in 0..5 {
        let State { q, dq, ddq, .. } = motion::<2>(seed);
        assert_close(
            arm.inverse_dynamics(&q, &dq, &ddq),
            page.inverse_dynamics(&q, &dq, &ddq),
        );
    }
    // The cart is known: its mass is no field, but it is in the mass matrix.
    assert_eq!(Slider::NOMINAL[0].to_bits(), 4.2_f64.to_bits());
    assert!((arm.mass_matrix(&Vector::zeros())[(0, 0)] - page.standard()[10] - 4.2).abs() < 1e-12);
}

#[test]
fn shape_parameters_are_part_of_the_value() {
    let mut arm = Slider::from_standard(&numbers(4));
    let state = State {
        dq: Vector::from([0.05, 0.0]),
        ..motion::<2>(4)
    };
    let slow = arm.inverse_dynamics_at(&state);
    let regressor = Slider::regressor_at(&state, &arm.shapes());
    assert_close(regressor * arm.standard(), slow);
    let Stribeck { fs, vs } = arm.rail.3;
    arm.rail.3.vs = 2.0 * vs;
    // fs exp(-(dq / vs)^2), the law by hand.
    let law = |vs: f64| fs * f64::exp(-(state.dq[0] / vs).powi(2));
    let change = arm.inverse_dynamics_at(&state) - slow;
    assert!((change[0] - (law(2.0 * vs) - law(vs))).abs() < 1e-12);
    assert_close(
        Slider::regressor_at(&state, &arm.shapes()) * arm.standard(),
        arm.inverse_dynamics_at(&state),
    );
}

#[test]
fn effects_of_two_joints_and_of_load_have_their_fields() {
    let arm = Coupled::from_parameters(&Coupled::NOMINAL.into(), &Vector::from([0.2, 0.3]));
    assert_eq!(arm.turntable.0.vs.to_bits(), 0.2_f64.to_bits());
    assert_eq!(arm.shapes(), Vector::from(Coupled::NOMINAL_SHAPES));
    assert_eq!(arm.shoulder.inertial.mass.to_bits(), 2.0_f64.to_bits());
    let arm = Coupled {
        coupling: GearCoupling {
            ..Coupled::from_standard(&numbers(5)).coupling
        },
        ..Coupled::from_standard(&numbers(6))
    };
    let mut state = motion::<2>(6);
    state.rigid_torque = arm.mass_matrix(&state.q) * state.ddq + arm.bias(&state.q, &state.dq);
    let tau = arm.inverse_dynamics(&state.q, &state.dq, &state.ddq);
    assert_close(
        Coupled::regressor_at(&state, &arm.shapes()) * arm.standard(),
        tau,
    );
}

#[test]
fn a_robot_of_energies_holds_its_unknowns() {
    let page = phantom::Phantom::from_standard(&numbers(7));
    let by_name = Phantom::STANDARD_PARAMETERS.map(|name| {
        let names = phantom::Phantom::STANDARD_PARAMETERS;
        let place = names.iter().position(|own| *own == name);
        numbers::<23>(7)[place.expect("the names are the same")]
    });
    let arm = Phantom::from_standard(&by_name.into());
    assert_eq!(arm.standard(), Vector::from(by_name));
    let State { q, dq, ddq, .. } = motion::<3>(7);
    let tau = page.inverse_dynamics(&q, &dq, &ddq);
    assert_close(arm.inverse_dynamics(&q, &dq, &ddq), tau);
    // Eight lumps of seventeen constants: an estimate is an arm all the same.
    let estimated = Phantom::from_base(&arm.beta());
    assert_close(estimated.inverse_dynamics(&q, &dq, &ddq), tau);
}

#[test]
fn products_of_unknowns_are_multiplied_out() {
    let friction = (ViscousFriction { fv: 0.3 }, CoulombFriction { fc: 0.2 });
    let arm = PneumaticArm {
        i1: 0.357,
        i2: 0.013,
        m1: 5.914,
        m2: 3.437,
        l1: 0.615,
        c1: 0.293,
        c2: 0.19,
        q1: friction,
        q2: friction,
    };
    let standard = arm.standard();
    let m2_l1_c2 = PneumaticArm::STANDARD_PARAMETERS
        .iter()
        .position(|name| *name == "m2*l1*c2")
        .expect("a product of three unknowns");
    assert!((standard[m2_l1_c2] - 3.437 * 0.615 * 0.19).abs() < 1e-15);
    // The spec has the same values.
    let rigid = PneumaticArm::NOMINAL.len() - 4;
    let nominal = Vector::from(PneumaticArm::NOMINAL);
    assert!((standard.rows(0, rigid) - nominal.rows(0, rigid)).norm() < 1e-12);
    let page = pneumatic_arm::PneumaticArm::from_standard(&standard);
    let State { q, dq, ddq, .. } = motion::<2>(8);
    let tau = arm.inverse_dynamics(&q, &dq, &ddq);
    assert_close(page.inverse_dynamics(&q, &dq, &ddq), tau);
    assert_close(PneumaticArm::regressor(&q, &dq, &ddq) * standard, tau);
}
