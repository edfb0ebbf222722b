//! Emitted code in a program without `std`, allocator and panics: built, linked and run.
//!
//! The program's panic handler calls a function that does not exist. It links only if no path of the code that it calls ends in
//! a panic.

use std::process::Command;

use robot_model_tests::program::Program;
use robot_model_tests::specs;

/// Friction that depends on the load: its accelerations take Newton's method.
const LOADED: &str = "robot Loaded {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint first: revolute { a = 0.4; alpha = 0; d = 0; }
    joint second: prismatic { a = 0; alpha = 0; theta = 0; }
    effects { load_dependent_friction on all; coulomb_friction on all; }
}
";

/// With an arm of links and one whose effects remember. Small: an arm of seven joints has more of the same.
const MAIN: &str = r#"
#![no_std]
#![no_main]

use core::hint::black_box;

use robot_model::control::counterbalance::{Weight, lever, mass, moment};
use robot_model::control::{
    Adaptation, Adaptive, ComputedTorque, ContactForce, ControlError, Dissection, FeedForward, Friction, Gains,
    GravityCompensation, HandGuiding, MomentumObserver, Safety,
};
use robot_model::scalar::{Dual, Lanes4};
use robot_model::{FromParameters, Kinematics, Mechanics, Memory, Scalar, State, Vector};

mod two_link {
    robot_model::include_robot!("two_link");
}
mod loaded {
    robot_model::include_robot!("loaded");
}
mod memory {
    robot_model::include_robot!("memory");
}

#[link(name = "c")]
unsafe extern "C" {
    fn a_path_that_panics() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe { a_path_that_panics() }
}

/// A number that depends on every function of the arm in the scalar `N`; its zeros and ones are opaque to the optimizer.
#[inline(never)]
fn everything<
    R,
    N: Scalar,
    const D: usize,
    const S: usize,
    const B: usize,
    const H: usize,
    const M: usize,
    const I: usize,
>() -> f64
where
    R: FromParameters<D, S, B, H, M, I> + Mechanics<D, S, B, H, M, I>,
{
    let some = |value: f64| N::of(black_box(value));
    let arm = R::from_parameters(&Vector::from_element(black_box(0.3)), &Vector::from_element(black_box(0.2)));
    let state = State {
        q: nalgebra::SVector::from_element(some(0.1)),
        dq: nalgebra::SVector::from_element(some(0.2)),
        ddq: nalgebra::SVector::from_element(some(0.3)),
        rigid_torque: nalgebra::SVector::from_element(some(3.0)),
        measured_torque: nalgebra::SVector::from_element(some(3.0)),
        time: some(1.0),
        memory: nalgebra::SVector::from_element(some(0.1)),
        inputs: nalgebra::SVector::from_element(some(30.0)),
    };
    let (q, dq) = (&state.q, &state.dq);
    let mut sum = arm.inverse_dynamics_at(&state).sum() + arm.mass_matrix(q).sum() + arm.gravity(q).sum();
    sum += arm.coriolis_matrix(q, dq).sum() + arm.bias(q, dq).sum() + arm.kinetic_energy(q, dq) + arm.potential_energy(q);
    sum += arm.regressor_of_at(&state).sum() + arm.base_regressor_of_at(&state).sum();
    sum += arm.inverse_dynamics_by_position_at(&state).sum() + arm.inverse_dynamics_by_velocity_at(&state).sum();
    sum += R::momentum_regressor_at(&state, &arm.shapes()).sum() + R::drift_regressor_at(&state, &arm.shapes()).sum();
    if let Some(ddq) = arm.forward_dynamics_at(&state, dq) {
        sum += ddq.sum();
    }
    sum.most()
}

/// A number that depends on every controller of an arm, on what it says where nothing is read, and on what it refuses.
#[inline(never)]
fn controllers<
    R,
    const D: usize,
    const S: usize,
    const B: usize,
    const H: usize,
    const M: usize,
    const I: usize,
>() -> Result<f64, ControlError>
where
    R: FromParameters<D, S, B, H, M, I> + Mechanics<D, S, B, H, M, I> + Kinematics<D> + Clone,
{
    let some = black_box;
    let arm = R::from_parameters(&Vector::from_element(some(0.3)), &Vector::from_element(some(0.2)));
    let desired = State::new(Vector::from_element(some(0.1)), Vector::from_element(some(0.2)), Vector::from_element(some(0.3)));
    let state = desired.with_memory(Vector::from_element(some(0.1))).with_inputs(Vector::from_element(some(0.1)));
    let mut lost = state;
    lost.q = Vector::from_element(some(f64::NAN));
    let safety = Safety::new().torque([some(9.0); D]).velocity([some(2.0); D]).position([some(-2.0); D], [some(2.0); D]);
    let mut computed = ComputedTorque::new(arm.clone(), Gains::new(some(25.0), some(0.7)))?
        .with_friction(Friction::part(some(0.5)).at_measured_velocity())?
        .with_safety(safety.brake(some(3.0)))?;
    let mut gravity = GravityCompensation::new(arm.clone()).with_safety(safety)?;
    let mut guiding = HandGuiding::new(arm.clone(), [some(1.0); D])?.with_friction(some(0.8))?.with_safety(safety)?;
    let mut ahead = FeedForward::new(arm.clone(), [some(9.0); D], [some(1.0); D])?.with_safety(safety)?;
    let mut adaptive = Adaptive::new(arm.clone(), Adaptation::new(some(5.0), some(2.0), some(0.1)), some(1e-3))?
        .with_bounds(&Vector::from_element(some(-1e9)), &Vector::from_element(some(1e9)))?
        .with_safety(safety)?;
    let mut observer = MomentumObserver::new(arm.clone(), some(50.0), some(1e-3))?;
    let contact = ContactForce::new(arm.clone(), some(0.02))?.with_length(some(0.1))?;
    let mut sum = 0.0;
    for measured in [state, lost, state] {
        let command = computed.torque(&measured, &desired);
        sum += command.torque.sum() + ahead.torque(&measured, &desired).torque.sum();
        sum += gravity.torque(&measured).torque.sum() + guiding.torque(&measured).torque.sum();
        sum += adaptive.torque(&measured, &desired).torque.sum() + adaptive.estimate().sum();
        let external = observer.update(&measured, &command.torque).torque;
        sum += contact.at_tip(&state.q, &external).force.sum();
        let felt = contact.of_arm(&measured, &external);
        sum += felt.force.sum() + felt.unseen().count() as f64;
    }
    let shares = Dissection::new(&arm, &state);
    sum += shares.sum().sum() + shares.effects().count() as f64;
    let weight = moment(some(0.1), some(9.81), &[Weight { mass: some(0.09), lever: some(0.2) }]);
    Ok(sum + mass(weight, some(9.81), some(0.07))? + lever(weight, some(9.81), some(0.2))?)
}

#[unsafe(no_mangle)]
pub extern "C" fn main() -> i32 {
    let mut sum = everything::<two_link::TwoLink, f64, _, _, _, _, _, _>();
    sum += everything::<two_link::TwoLink, Lanes4, _, _, _, _, _, _>();
    sum += everything::<loaded::Loaded, f64, _, _, _, _, _, _>();
    sum += everything::<loaded::Loaded, f32, _, _, _, _, _, _>();
    sum += everything::<memory::Memory, f64, _, _, _, _, _, _>();
    sum += everything::<memory::Memory, Dual, _, _, _, _, _, _>();
    let some = Vector::from_element(black_box(0.1));
    let arm = two_link::TwoLink::from_standard(&Vector::from_element(black_box(0.3)));
    sum += arm.jacobian(&some).sum() + arm.forward_kinematics(&some)[1].sum();
    let arm = memory::Memory::from_standard(&Vector::from_element(black_box(0.3)));
    let some = Vector::from_element(black_box(0.1));
    let state = State::new(some, some, some)
        .with_memory(Vector::from_element(black_box(0.1)))
        .with_inputs(Vector::from_element(black_box(0.1)));
    sum += arm.memory_after(&state, black_box(1e-3)).sum();
    let controlled = controllers::<two_link::TwoLink, _, _, _, _, _, _>();
    let (Ok(first), Ok(second)) = (controlled, controllers::<memory::Memory, _, _, _, _, _, _>()) else {
        return 2;
    };
    sum += first + second;
    if sum.is_finite() { 0 } else { 1 }
}
"#;

#[test]
fn a_program_without_std_links_without_a_panic() {
    let [two_link, memory] =
        ["two_link", "memory"].map(|name| specs::named(&format!("pass/{name}")).text);
    let program = Program::new(
        "firmware",
        &[
            ("two_link", &two_link),
            ("loaded", LOADED),
            ("memory", &memory),
        ],
    );
    let run = |main: &str| {
        let output = program.build(main);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        if !output.status.success() {
            return Err(errors);
        }
        let status = Command::new(program.executable()).status();
        Ok(status.expect("the program starts").code())
    };
    assert_eq!(run(MAIN), Ok(Some(0)));

    // The test can fail: an index that is not known to be in range.
    let main = MAIN.replace(
        "    if sum.is_finite()",
        "    sum += [1.0, 2.0][black_box(1_usize)];\n    if sum.is_finite()",
    );
    let errors = run(&main).expect_err("a panic is in it");
    assert!(errors.contains("a_path_that_panics"), "{errors}");
}
