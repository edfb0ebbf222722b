//! What a program's symbols are along a motion.

use robot_model::motion::{Kinematics, Motion};
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::Operand;

/// Signals of a motion that do not depend on a band, and values of shape parameters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Signals<'a> {
    pub(super) motion: &'a Motion,
    /// Values of shape parameters, by their symbols.
    pub(super) shapes: &'a [f64],
    pub(super) own: &'a Own,
}

/// Signals that effects read and a motion does not hold as such.
#[derive(Debug, Clone, Default)]
pub(super) struct Own {
    /// Measured torque in N m or N, `[joint][sample]`; empty where no program reads it.
    pub(super) measured_torque: Vec<Vec<f64>>,
    /// Names of the channels, by their symbols.
    pub(super) inputs: Vec<String>,
    /// Internal states, by their symbols, `[state][sample]`.
    pub(super) states: Vec<Vec<f64>>,
}

impl<'a> Signals<'a> {
    /// The values of a symbol, joints' positions and rates from `kinematics`.
    pub(super) fn bind(&self, kinematics: &'a Kinematics, symbol: Symbol) -> Operand<'a> {
        let column = |columns: &'a [Vec<f64>], k: usize| {
            let values = columns.get(k);
            values.map_or(Operand::Constant(0.0), |values| Operand::Column(values))
        };
        match symbol {
            Symbol::Q(joint) => Operand::Column(&kinematics.q[joint]),
            Symbol::Dq(joint) => Operand::Column(&kinematics.dq[joint]),
            Symbol::Ddq(joint) => Operand::Column(&kinematics.ddq[joint]),
            Symbol::Time => Operand::Column(&self.motion.time),
            Symbol::Shape(k) => Operand::Constant(self.shapes[k]),
            // No load is known before the first estimate.
            Symbol::RigidTorque(joint) => column(&self.motion.rigid_torque, joint),
            Symbol::MeasuredTorque(joint) => column(&self.own.measured_torque, joint),
            Symbol::State(k) => column(&self.own.states, k),
            // Logs without the channel are refused before.
            Symbol::Input(k) => {
                let channel = self.motion.channel(&self.own.inputs[k]);
                channel.map_or(Operand::Constant(0.0), Operand::Column)
            }
            Symbol::Parameter(_) => unreachable!("columns are free of parameters"),
            Symbol::Switch(_) | Symbol::Weight(_) => {
                unreachable!("in equations of simulation and design alone")
            }
        }
    }
}
