//! The derive route: a struct whose fields are the joints.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use robot_model::{RobotModel, State, Vector};

/// A shoulder that turns and a slide on its arm, in a vertical plane.
#[derive(RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
pub struct Reach {
    /// Turns about a horizontal axis.
    #[joint(revolute, a = 0, alpha = 90 deg, d = 0)]
    #[effects(viscous_friction, coulomb_friction)]
    pub shoulder: (),
    /// Slides along the arm.
    #[joint(prismatic, a = 0, alpha = 0, theta = 0)]
    #[effects(viscous_friction)]
    pub slide: (),
}

/// Prints M, C and G, and checks that the torque is linear in the standard parameters.
pub fn main() {
    // 2 kg m^2 and 5 kg on the shoulder, 1.5 kg on the slide; friction.
    let standard = Reach::STANDARD_PARAMETERS.map(|name| match name {
        "shoulder.m" => 5.0,
        "shoulder.iyy" => 2.0,
        "slide.m" => 1.5,
        "slide.mz" => 0.1,
        "shoulder.viscous_friction.fv" => 0.8,
        "shoulder.coulomb_friction.fc" => 1.2,
        "slide.viscous_friction.fv" => 30.0,
        _ => 0.0,
    });
    let standard = Vector::from(standard);
    let beta = Reach::base_parameters(&standard);
    let state = State::new(
        Vector::from([0.4, 0.7]),
        Vector::from([0.9, -0.3]),
        Vector::from([1.5, 2.0]),
    );

    let mass_matrix = Reach::mass_matrix(&state, &beta);
    println!("M = {mass_matrix:.4}");
    println!("C = {:.4}", Reach::coriolis_matrix(&state, &beta));
    println!("G = {:.4}", Reach::gravity(&state, &beta));
    // The slide carries 1.5 kg and nothing else.
    assert!((mass_matrix[(1, 1)] - 1.5).abs() < 1e-12);

    let tau = Reach::inverse_dynamics(&state, &beta);
    let standard_form = Reach::regressor(&state) * standard;
    let base_form = Reach::base_regressor(&state) * beta;
    println!("tau = {tau:.4}");
    assert!((tau - standard_form).norm() < 1e-12 * tau.norm());
    assert!((tau - base_form).norm() < 1e-12 * tau.norm());
    println!(
        "tau = Y * standard = Y_b * beta: {} and {} parameters",
        standard.len(),
        beta.len()
    );
}
