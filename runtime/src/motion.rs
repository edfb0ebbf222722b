//! A measured motion, ready for the model: uniform time, filtered position and its derivatives.

/// Position, velocity and acceleration of every joint: `q[joint][sample]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Kinematics {
    /// Positions, rad or m.
    pub q: Vec<Vec<f64>>,
    /// Velocities.
    pub dq: Vec<Vec<f64>>,
    /// Accelerations.
    pub ddq: Vec<Vec<f64>>,
}

/// One log's motion on a uniform time grid, in two bandwidths.
///
/// Rigid-body terms are products of derivatives and want little noise; friction changes sign within milliseconds and wants
/// the reversal where it was. Hence two low-pass filters on the same positions: `smooth` for the rigid body, `wide` for
/// effects. Both are zero-phase. The filter that is shared by torque and regressor columns comes after, and makes their
/// bands equal.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion {
    /// Seconds since the start of the log, uniform.
    pub time: Vec<f64>,
    /// For rigid-body terms.
    pub smooth: Kinematics,
    /// For effects.
    pub wide: Kinematics,
    /// Torque of the rigid body alone at the present estimate, `[joint][sample]`; empty until an estimate exists.
    pub rigid_torque: Vec<Vec<f64>>,
}
