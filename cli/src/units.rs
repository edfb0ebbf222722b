//! Units of a joint's quantities.

use robot_model_spec::model::JointKind;

/// Names of the SI units of a joint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Units {
    pub position: &'static str,
    pub velocity: &'static str,
    /// Of a force, where it slides.
    pub torque: &'static str,
}

impl Units {
    pub(crate) const fn of(kind: JointKind) -> Self {
        match kind {
            JointKind::Revolute => Self {
                position: "rad",
                velocity: "rad/s",
                torque: "N m",
            },
            JointKind::Prismatic => Self {
                position: "m",
                velocity: "m/s",
                torque: "N",
            },
        }
    }
}
