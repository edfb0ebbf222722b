//! The derive route: a struct whose fields hold the unknowns of an arm. Its value is the parameter set.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use robot_model::effects::{CoulombFriction, ViscousFriction};
use robot_model::{FromParameters, Inertial, Link, RobotModel, Vector};

/// A shoulder that turns and a slide on its arm, in a vertical plane.
#[derive(Debug, Clone, RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
pub struct Reach {
    /// Turns about a horizontal axis.
    #[joint(revolute, a = 0, alpha = 90 deg, d = 0)]
    pub shoulder: Link<(ViscousFriction, CoulombFriction)>,
    /// Slides along the arm.
    #[joint(prismatic, a = 0, alpha = 0, theta = 0)]
    pub slide: Link<ViscousFriction>,
}

/// The same arm with its description in a file, `reach.robot`.
#[derive(Debug, Clone, RobotModel)]
#[robot(file = "reach.robot")]
pub struct FromFile {
    /// The link that the shoulder moves.
    pub shoulder: Link<(ViscousFriction, CoulombFriction)>,
    /// The link that slides.
    pub slide: Link<ViscousFriction>,
}

/// Prints M, C and G, checks that the torque is linear in the parameters, and goes from base parameters back to an arm.
pub fn main() {
    let arm = Reach {
        // 5 kg in the axis with 2 kg m^2 about it; friction.
        shoulder: Link::new(5.0, [0.0; 3], [0.0, 0.0, 0.0, 2.0, 0.0, 0.0])
            .with((ViscousFriction { fv: 0.8 }, CoulombFriction { fc: 1.2 })),
        // A point of 1.5 kg, a little in front of the slide.
        slide: Link::from(Inertial::about_com(1.5, [0.0, 0.0, 0.07], [0.0; 6]))
            .with(ViscousFriction { fv: 30.0 }),
    };
    let (q, dq, ddq) = (
        Vector::from([0.4, 0.7]),
        Vector::from([0.9, -0.3]),
        Vector::from([1.5, 2.0]),
    );

    let mass_matrix = arm.mass_matrix(&q);
    println!("M = {mass_matrix:.4}");
    println!("C = {:.4}", arm.coriolis_matrix(&q, &dq));
    println!("G = {:.4}", arm.gravity(&q));
    // The slide carries 1.5 kg and nothing else.
    assert!((mass_matrix[(1, 1)] - 1.5).abs() < 1e-12);

    let tau = arm.inverse_dynamics(&q, &dq, &ddq);
    let standard_form = Reach::regressor(&q, &dq, &ddq) * arm.standard();
    let base_form = Reach::base_regressor(&q, &dq, &ddq) * arm.beta();
    println!("tau = {tau:.4}");
    assert!((tau - standard_form).norm() < 1e-12 * tau.norm());
    assert!((tau - base_form).norm() < 1e-12 * tau.norm());
    println!(
        "tau = Y * standard = Y_b * beta: {} and {} parameters",
        Reach::STANDARD_PARAMETERS.len(),
        Reach::BASE_PARAMETERS.len()
    );

    // What identification gives are base parameters: an arm again, with the same torque.
    let estimated = Reach::from_base(&arm.beta());
    println!("from base parameters: {:.3?}", estimated.slide);
    assert!((tau - estimated.inverse_dynamics(&q, &dq, &ddq)).norm() < 1e-12 * tau.norm());

    // The description may stand in a file as well.
    let Reach { shoulder, slide } = arm;
    let from_file = FromFile { shoulder, slide };
    assert!((tau - from_file.inverse_dynamics(&q, &dq, &ddq)).norm() < 1e-12 * tau.norm());
}
