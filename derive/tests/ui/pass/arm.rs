use robot_model::effects::{GearCoupling, Stribeck, ViscousFriction};
use robot_model::{FromParameters, Link, RobotModel, Vector};

robot_model::effects!("specs/drag.robot");

/// Everything that attributes can say of a chain.
#[derive(Debug, Clone, Copy, PartialEq, RobotModel)]
#[robot(convention = modified_dh, gravity = [0, 0, -9.81], effects = "specs/drag.robot")]
pub struct Arm {
    #[joint(revolute, alpha = 0, a = 0, d = 400 mm, offset = 10 deg, position = -170 deg .. 170 deg, link = column)]
    #[inertial(nominal, mass = 12 kg, com = [0, 0, 0.1], inertia = [0.2, 0, 0, 0.2, 0, 0.1])]
    #[effects(stribeck(vs = 0.1), drag(w = 2))]
    pub swing: Link<(ViscousFriction, Stribeck, Drag)>,
    #[joint(prismatic, alpha = 90 deg, a = 0.1, theta = 0, velocity = 0.5, torque = 2 kN, actuator_gain = 12.5)]
    #[inertial(fixed, mass = 3.5, com = [0, 0, 0.4], inertia = [0.1, 0, 0, 0.1, 0, 0.01])]
    pub boom: ViscousFriction,
    #[joint(revolute, alpha = 0, a = 0.1, d = 0)]
    pub wrist: Link,
    #[joint(revolute, alpha = 0, a = 0.1, d = 0)]
    #[inertial(fixed, mass = 1, com = [0, 0, 0], inertia = [0, 0, 0, 0, 0, 0.01])]
    pub hand: (),
    #[on(wrist, hand)]
    pub coupling: GearCoupling,
}

/// Sizes come from the arm.
fn torque_at_rest<R, const N: usize, const S: usize, const B: usize, const P: usize>(arm: &R) -> Vector<N>
where
    R: RobotModel<N, S, B, P>,
{
    arm.gravity(&Vector::zeros())
}

fn main() {
    let arm = Arm::from_standard(&Arm::NOMINAL.into());
    assert_eq!(arm.swing.inertial.mass, 12.0);
    assert_eq!(arm.swing.effects.2, Drag { c: 0.0, w: 2.0 });
    // The boom slides horizontally: nothing falls along it.
    assert!(torque_at_rest(&arm)[1].abs() < 1e-12);
}
