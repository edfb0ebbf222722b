//! The arms of the study: kinematics and links as specs, and what their joints' motors and friction are.

/// An arm.
#[derive(Debug)]
pub struct Arm {
    /// What it is called.
    pub name: &'static str,
    /// Frames and links, without effects.
    pub text: &'static str,
    /// Inertia of the motor in kg m^2, viscous friction in N m s/rad and dry friction in N m, for each joint.
    pub joints: &'static [[f64; 3]],
}

/// What each joint declares, in the order of [`Arm::joints`]: effect and parameter.
pub const DECLARED: [(&str, &str); 3] = [
    ("motor_inertia", "ia"),
    ("viscous_friction", "fv"),
    ("coulomb_friction", "fc"),
];

/// All of them.
pub static ARMS: &[Arm] = &[
    Arm {
        name: "two-link",
        text: include_str!("two_link.robot"),
        joints: &[[0.4, 3.0, 2.5], [0.15, 1.2, 1.0]],
    },
    Arm {
        name: "elbow",
        text: include_str!("elbow_arm.robot"),
        joints: &[[0.9, 6.0, 7.0], [1.1, 8.0, 9.0], [0.35, 2.4, 3.0]],
    },
    Arm {
        name: "six-axes",
        text: include_str!("six_axes.robot"),
        joints: &[
            [1.2, 9.0, 8.0],
            [1.2, 10.0, 9.0],
            [0.6, 5.0, 5.0],
            [0.15, 1.0, 1.2],
            [0.12, 0.9, 1.0],
            [0.06, 0.4, 0.5],
        ],
    },
];

impl Arm {
    /// The spec's text; with `is_known` its links are given, not to be found.
    pub fn text(&self, is_known: bool) -> String {
        if !is_known {
            return self.text.to_owned();
        }
        let known = |line: &str| match line.trim_start().strip_prefix("link ") {
            Some(rest) => {
                let (name, body) = rest.split_once('{').expect("a link has a body");
                format!("    link {}: fixed {{{body}", name.trim())
            }
            None => line.to_owned(),
        };
        self.text.lines().map(known).collect::<Vec<_>>().join("\n")
    }
}
