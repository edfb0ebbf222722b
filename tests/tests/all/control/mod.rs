//! Laws of the controllers, on arms of the specs.

mod adaptive;
mod contact;
mod counterbalance;
mod laws;
mod safety;
mod shares;

use robot_model::{FromParameters, Mechanics, RobotModel, State, Vector};
use robot_model_tests::emitted::puma560::Puma560;
use robot_model_tests::specs;
use robot_model_tests::states::{self, generator, typed};

/// Sums of some thousand roundings.
const ROUNDING: f64 = 1e-11;

/// An arm of a spec that could be built, and a state of it.
fn arm_and_state<
    R,
    const D: usize,
    const S: usize,
    const B: usize,
    const H: usize,
    const M: usize,
    const I: usize,
>(
    spec: &str,
    seed: u64,
) -> (R, State<D, M, I>)
where
    R: FromParameters<D, S, B, H, M, I>,
{
    let model = specs::named(&format!("pass/{spec}")).model();
    let mut random = generator(seed);
    let mut standard = states::physical(&mut random, &model);
    for (value, parameter) in standard.iter_mut().zip(model.standard_parameters()) {
        // A coupling of rotors is weaker than they are, or nothing could move them.
        if parameter.name.ends_with("gear_coupling.ia") {
            *value *= 0.1;
        }
    }
    let state = states::state(&mut random, D);
    (
        R::from_standard(&Vector::from_column_slice(&standard)),
        typed(&state),
    )
}

#[track_caller]
fn close<const N: usize>(found: &Vector<N>, wanted: &Vector<N>, tolerance: f64) {
    let size = wanted.amax().max(1e-300);
    let difference = (found - wanted).amax() / size;
    assert!(
        difference < tolerance,
        "{difference:.1e}\nfound {found}wanted {wanted}"
    );
}

/// A plant by the classical method of Runge and Kutta; torque and external torque are constant over the step.
fn moved<R, const D: usize, const S: usize, const B: usize>(
    arm: &R,
    state: &State<D>,
    tau: &Vector<D>,
    h: f64,
) -> State<D>
where
    R: Mechanics<D, S, B>,
{
    let slope = |q: Vector<D>, dq: Vector<D>| {
        (
            dq,
            arm.forward_dynamics(&q, &dq, tau)
                .expect("an arm that could be built"),
        )
    };
    let (q, dq) = (state.q, state.dq);
    let (v1, a1) = slope(q, dq);
    let (v2, a2) = slope(q + v1 * (h / 2.0), dq + a1 * (h / 2.0));
    let (v3, a3) = slope(q + v2 * (h / 2.0), dq + a2 * (h / 2.0));
    let (v4, a4) = slope(q + v3 * h, dq + a3 * h);
    State::new(
        q + (v1 + (v2 + v3) * 2.0 + v4) * (h / 6.0),
        dq + (a1 + (a2 + a3) * 2.0 + a4) * (h / 6.0),
        Vector::zeros(),
    )
}

/// PUMA 560 with its CAD values and a friction that does not jump, so that a step is a step.
fn puma() -> Puma560 {
    let mut standard = Vector::from(Puma560::NOMINAL);
    for (name, value) in Puma560::STANDARD_PARAMETERS.iter().zip(&mut standard) {
        if name.ends_with("viscous_friction.fv") {
            *value = 2.0;
        } else if name.ends_with("motor_inertia.ia") {
            *value = 0.3;
        }
    }
    Puma560::from_standard(&standard)
}
