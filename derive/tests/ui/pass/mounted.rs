use robot_model::effects::{BaseTilt, EncoderOffset, Payload, TimeDelay, ViscousFriction};
use robot_model::{Kinematics, Link, Mechanics, RobotModel, Vector};

/// Effects that change what the torque is made of, and effects on the arm as a whole.
#[derive(Debug, Clone, Copy, RobotModel)]
#[robot(convention = standard_dh, gravity = [0, 0, -9.81])]
struct Mounted {
    #[joint(revolute, a = 0, alpha = 90 deg, d = 0.4)]
    turn: Link<ViscousFriction>,
    #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
    #[inertial(fixed, mass = 2, com = [-0.25, 0, 0], inertia = [0, 0, 0, 0.1, 0, 0.1])]
    lift: (EncoderOffset, Payload),
    #[on()]
    base: BaseTilt,
    #[on()]
    log: TimeDelay,
}

fn main() {
    let level = Mounted {
        turn: Link::new(1.0, [0.0; 3], [0.0; 6]).with(ViscousFriction { fv: 0.0 }),
        lift: (EncoderOffset { offset: 0.1 }, Payload { m: 3.0, ..Payload::default() }),
        base: BaseTilt::default(),
        log: TimeDelay::default(),
    };
    // 2 kg in the middle of the link and 3 kg at its end; the link stands 0.1 rad below its encoder.
    let q = Vector::from([0.3, 0.7]);
    let wanted = 9.81 * (2.0 * 0.25 + 3.0 * 0.5) * 0.6_f64.cos();
    assert!((level.gravity(&q)[1] - wanted).abs() < 1e-12, "{}", level.gravity(&q));
    assert!((level.forward_kinematics(&q)[1][(2, 3)] - (0.4 + 0.5 * 0.6_f64.sin())).abs() < 1e-12);
    // On a base that leans the first joint feels gravity, too.
    let leaning = Mounted { base: BaseTilt { first: 0.2, second: 0.0 }, ..level };
    assert!(level.gravity(&q)[0].abs() < 1e-12);
    assert!(leaning.gravity(&q)[0].abs() > 1.0);
    let _ = leaning.potential_energy(&q);
}
