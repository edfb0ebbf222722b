// The arm of the documentation's examples of control, which include this file.

use robot_model::effects::{CoulombFriction, ViscousFriction};
use robot_model::{Link, RobotModel};

/// Two links in a vertical plane.
#[derive(Debug, Clone, Copy, PartialEq, RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
pub struct TwoLink {
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    pub shoulder: Link<(ViscousFriction, CoulombFriction)>,
    #[joint(revolute, a = 0.4, alpha = 0, d = 0)]
    pub elbow: Link<(ViscousFriction, CoulombFriction)>,
}

/// One that could be built.
pub fn two_link() -> TwoLink {
    let rod = |mass: f64, com: f64, izz: f64| Link::new(mass, [com, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, izz]);
    TwoLink {
        shoulder: rod(4.0, -0.25, 0.09).with((ViscousFriction { fv: 1.5 }, CoulombFriction { fc: 2.0 })),
        elbow: rod(2.5, -0.2, 0.04).with((ViscousFriction { fv: 0.6 }, CoulombFriction { fc: 0.8 })),
    }
}
