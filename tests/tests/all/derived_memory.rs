//! Structs that derive `RobotModel` for arms whose effects remember or read channels, against the same robots emitted by the
//! build script; and a control loop with one of them.

use robot_model::effects::{
    CableHysteresis, Dahl, LugrePresliding, TemperatureViscous, TorqueSaturation, ViscousFriction,
};
use robot_model::{FromParameters, Link, Mechanics, Memory, RobotModel, State, Vector};
use robot_model_tests::emitted;
use robot_model_tests::states::{generator, state, typed};

robot_model::effects!("specs/pass/memory.robot");

/// The link of the third seed paper.
#[derive(Debug, Clone, Copy, RobotModel)]
#[robot(file = "specs/pass/lugre_link.robot")]
struct LugreLink {
    m: f64,
    th: (LugrePresliding, ViscousFriction),
}

/// Several effects with states on a joint, channels, measured torque, an effect of its own.
#[derive(Debug, Clone, Copy, RobotModel)]
#[robot(file = "specs/pass/memory.robot")]
struct Rig {
    shoulder: Link<(
        LugrePresliding,
        CableHysteresis,
        TemperatureViscous,
        CopperLoss,
    )>,
    elbow: Link<(
        Dahl,
        TemperatureViscous,
        TorqueSaturation,
        Damper,
        CopperLoss,
    )>,
}

/// A table on bristles, in attributes.
#[derive(Debug, Clone, Copy, RobotModel)]
#[robot(convention = standard_dh, gravity = [0, 0, -9.81], effects = "specs/pass/memory.robot")]
struct Table {
    #[joint(revolute, a = 0, alpha = 0, d = 0)]
    #[effects(lugre_presliding(d = 0.01, vs = 0.1, rise = 0.5))]
    turn: Link<(LugrePresliding, Damper, CopperLoss)>,
}

/// A struct and a page of the same spec are one arm.
fn assert_same<
    A,
    B,
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize,
    const PAGE_SHAPES: usize,
    const STATES: usize,
    const INPUTS: usize,
>(
    arm: &A,
    page: &B,
) where
    A: Memory<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>
        + Mechanics<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
    B: Memory<DOF, STANDARD, BASE, PAGE_SHAPES, STATES, INPUTS>
        + Mechanics<DOF, STANDARD, BASE, PAGE_SHAPES, STATES, INPUTS>,
{
    assert_eq!(A::STATES, B::STATES);
    assert_eq!(A::INPUTS, B::INPUTS);
    let mut random = generator(3);
    for _ in 0..20 {
        let state = typed::<DOF, STATES, INPUTS>(&state(&mut random, DOF));
        let wanted = page.inverse_dynamics_at(&state);
        // The same equations in another order of summation.
        let size = 1e-12 * wanted.norm().max(1.0);
        assert!((arm.inverse_dynamics_at(&state) - wanted).norm() < size);
        assert!((arm.base_regressor_of_at(&state) * arm.beta() - wanted).norm() < size);
        let (after, wanted) = (
            arm.memory_after(&state, 1e-3),
            page.memory_after(&state, 1e-3),
        );
        assert!((after - wanted).norm() < 1e-12 * wanted.norm().max(1.0));
        let wanted = page.inverse_dynamics_at(&State {
            ddq: Vector::zeros(),
            ..state
        });
        let ddq = arm.forward_dynamics_at(&state, &(wanted * 1.5));
        let expected = page.forward_dynamics_at(&state, &(wanted * 1.5));
        let (ddq, expected) = (ddq.expect("inertia"), expected.expect("inertia"));
        assert!((ddq - expected).norm() < 1e-9 * expected.norm().max(1.0));
    }
}

#[test]
fn the_lugre_link_is_that_of_the_page() {
    let arm = LugreLink {
        m: 0.045,
        th: (
            LugrePresliding {
                fc: 0.02,
                s1: 1e-4,
                d: 1e-3,
                vs: 0.05,
                rise: 0.4,
            },
            ViscousFriction { fv: 3e-3 },
        ),
    };
    let page = emitted::lugre_link::LugreLink::from_parameters(&arm.standard(), &arm.shapes());
    assert_same(&arm, &page);
    let again = LugreLink::from_parameters(&arm.standard(), &arm.shapes());
    assert!((again.standard() - arm.standard()).norm() < 1e-15);
}

#[test]
fn an_arm_of_many_memories_is_that_of_the_page() {
    let page =
        emitted::memory::Memory::from_standard(&Vector::from_fn(|k, _| 0.1 + k as f64 / 30.0));
    // The struct holds every shape parameter, those that the spec gives too.
    let shapes = Rig::NOMINAL_SHAPES.into();
    let arm = Rig::from_parameters(&page.standard(), &shapes);
    let arm_beta = Rig::base_parameters(&page.standard());
    assert!((arm_beta - page.beta()).norm() < 1e-12);
    assert_same(&arm, &page);
}

/// Break-away under a slowly rising torque, 1 N m/s: the bristles hold the joint up to `(1 + rise) fc` and then let it go.
#[test]
fn bristles_hold_a_joint_until_it_breaks_away() {
    let (fc, rise) = (2.0, 0.5);
    let friction = LugrePresliding {
        fc,
        s1: 40.0,
        d: 1e-3,
        vs: 0.05,
        rise,
    };
    let body = Link::new(1.0, [0.0; 3], [0.0, 0.0, 0.0, 0.0, 0.0, 0.2]);
    let arm = Table {
        turn: body.with((friction, Damper::default(), CopperLoss::default())),
    };
    assert_eq!(Table::NOMINAL_SHAPES[..3], [0.01, 0.1, 0.5]);
    assert_eq!(Table::STATES, ["turn.lugre_presliding.z", "turn.damper.z"]);
    let h = 1e-4;
    let mut now = State::at_rest(Vector::from([0.0]))
        .with_memory(Vector::zeros())
        .with_inputs(Vector::zeros());
    let mut broke_away = None;
    for k in 0..60_000 {
        let tau = 1e-4 * f64::from(k);
        now.ddq = arm
            .forward_dynamics_at(&now, &Vector::from([tau]))
            .expect("inertia");
        now.memory = arm.memory_after(&now, h);
        now.dq += now.ddq * h;
        now.q += now.dq * h;
        if now.dq[0] > 0.1 && broke_away.is_none() {
            broke_away = Some(tau);
        }
    }
    let found = broke_away.expect("the torque rises to 6 N m");
    let wanted = fc * (1.0 + rise);
    assert!(
        (found - wanted).abs() < 0.05 * wanted,
        "{found} N m, not {wanted}"
    );
}
