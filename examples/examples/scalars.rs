//! One emission, several scalars: four states at once in lanes, slopes with dual numbers. README.md shows lines of it.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use robot_model::scalar::{Dual, Lanes4};
use robot_model::{RobotModel, State, Vector};
use robot_model_embedded::{TwoLinkArm, page as arm};

/// Prints torques of four states and how gravity's torques change with the shoulder's position.
pub fn main() {
    let states = [0.1, 0.2, 0.3, 0.4].map(|q1| State::at_rest(Vector::from([q1, -0.8])));
    let ([first, second, third, fourth], arm) = (states, TwoLinkArm);

    let four: State<2, 0, 0, Lanes4> = State::from([first, second, third, fourth]);
    let tau = arm.inverse_dynamics_at(&four);
    let of_the_shoulder = tau[0].to_array(); // at the first state, the second, ..

    // A page from a file also has functions on arrays, `f(&q, ..)`, with a last argument `&beta` unless it has numbers.
    let q = [Dual::variable(0.3), Dual::constant(-0.8)]; // derivatives by the shoulder's position
    let still = [Dual::constant(0.0); 2];
    let tau = arm::inverse_dynamics(&q, &still, &still);
    let stiffness = [tau[0].slope, tau[1].slope]; // d tau / d q1; `tau[0].value` is the torque

    println!("{of_the_shoulder:.3?} N m; slopes {stiffness:.3?} N m/rad");
    for (lane, state) in states.iter().enumerate() {
        let alone = arm.inverse_dynamics_at(state)[0];
        assert!((of_the_shoulder[lane] - alone).abs() < 1e-12);
    }
    // The third state is the one of the slopes; the others are 0.1 rad beside it.
    assert!((tau[0].value - of_the_shoulder[2]).abs() < 1e-12);
    let difference = (of_the_shoulder[3] - of_the_shoulder[1]) / 0.2;
    assert!((stiffness[0] - difference).abs() < 0.01 * difference.abs());
}
