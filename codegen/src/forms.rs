//! Programs of the forms that stand beside the torque: energies, momentum, kinematics, slopes.

use robot_model_spec::parameter::Status;

use crate::block::Block;
use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId};
use crate::interpreter::Program;

impl Compiled {
    /// `T` and `V` of the rigid body, two outputs; reads base parameters as [`Self::inverse_dynamics`] does. `V` is up to a
    /// constant, as what regroups keeps the torque and not the height of its zero.
    #[must_use]
    pub fn energies(&self) -> Program {
        let energies = self.dynamics.energies;
        Program::new(&self.dag, &[energies.kinetic, energies.potential])
    }

    /// Poses of the link frames, sixteen outputs each: the homogeneous matrix row by row. `None` for a robot without links.
    #[must_use]
    pub fn forward_kinematics(&self) -> Option<Program> {
        let mut dag = self.dag.clone();
        let poses = &self.kinematics.as_ref()?.poses;
        let outputs: Vec<ExprId> = poses
            .iter()
            .flat_map(|pose| pose.homogeneous(&mut dag))
            .collect();
        Some(Program::new(&dag, &outputs))
    }

    /// The geometric Jacobian at the tip, row by row. `None` for a robot without links.
    #[must_use]
    pub fn jacobian(&self) -> Option<Program> {
        let jacobian = &self.kinematics.as_ref()?.jacobian;
        Some(Program::new(&self.dag, &jacobian.concat()))
    }

    /// Points of a robot that says its energies, `3 + 3 dof` outputs each: the position in the base frame, m, and its slopes
    /// `d position / dq`, row by row.
    #[must_use]
    pub fn points(&self) -> Program {
        let points = self.points.iter();
        let outputs: Vec<ExprId> = points
            .flat_map(|point| [&point.position[..], &point.jacobian.concat()].concat())
            .collect();
        Program::new(&self.dag, &outputs)
    }

    /// `d tau / dq`, row by row.
    #[must_use]
    pub fn by_position(&self) -> Program {
        Program::new(&self.dag, &self.partials.by_position.concat())
    }

    /// `d tau / d dq`, row by row.
    #[must_use]
    pub fn by_velocity(&self) -> Program {
        Program::new(&self.dag, &self.partials.by_velocity.concat())
    }

    /// `d tau / d ddq`, row by row: the mass matrix and what effects add to it.
    #[must_use]
    pub fn by_acceleration(&self) -> Program {
        Program::new(&self.dag, &self.partials.by_acceleration.concat())
    }

    /// The momentum regressor `Y_p` of the standard parameters; reads `q, dq`.
    #[must_use]
    pub fn momentum_regressor(&self) -> Block {
        self.standard_block(&self.momentum.momentum)
    }

    /// The regressor `Y_h` of what changes the momentum beside the torque, of the standard parameters.
    #[must_use]
    pub fn drift_regressor(&self) -> Block {
        self.standard_block(&self.momentum.drift)
    }

    /// Columns of `Y_p` of the base parameters.
    #[must_use]
    pub fn base_momentum(&self) -> Block {
        self.base_columns(&self.base_momentum.momentum, |_| true)
    }

    /// Columns of `Y_h` of the base parameters that belong to the rigid body.
    #[must_use]
    pub fn rigid_drift(&self) -> Block {
        self.base_columns(&self.base_momentum.drift, |column| self.is_rigid(column))
    }

    /// Columns of `Y_h` of the base parameters that belong to declared effects; may read any signal but accelerations.
    #[must_use]
    pub fn effect_drift(&self) -> Block {
        self.base_columns(&self.base_momentum.drift, |column| !self.is_rigid(column))
    }

    /// Torque of the parameters that the spec fixes, one output a joint.
    #[must_use]
    pub fn known_torque(&self) -> Program {
        self.fixed_part(&self.linear.regressor)
    }

    /// Momentum of the parameters that the spec fixes, one output a joint.
    #[must_use]
    pub fn known_momentum(&self) -> Program {
        self.fixed_part(&self.momentum.momentum)
    }

    /// Drift of the parameters that the spec fixes, one output a joint.
    #[must_use]
    pub fn known_drift(&self) -> Program {
        self.fixed_part(&self.momentum.drift)
    }

    /// The columns of fixed parameters times their values.
    fn fixed_part(&self, regressor: &[Vec<ExprId>]) -> Program {
        let mut dag = self.dag.clone();
        let outputs: Vec<ExprId> = regressor
            .iter()
            .map(|row| {
                let terms: Vec<ExprId> = row
                    .iter()
                    .zip(&self.standard)
                    .filter_map(|(&entry, parameter)| match parameter.status {
                        Status::Fixed(value) => Some(dag.scale(value, entry)),
                        Status::Unknown | Status::Nominal(_) => None,
                    })
                    .collect();
                dag.sum(terms)
            })
            .collect();
        Program::new(&dag, &outputs)
    }

    fn standard_block(&self, regressor: &[Vec<ExprId>]) -> Block {
        let columns: Vec<(usize, usize)> = (0..self.standard.len()).map(|k| (k, k)).collect();
        block(&self.dag, regressor, &columns)
    }

    fn base_columns(&self, regressor: &[Vec<ExprId>], wanted: impl Fn(usize) -> bool) -> Block {
        let columns = self.base.kept.iter().copied().enumerate();
        let columns: Vec<(usize, usize)> = columns.filter(|&(column, _)| wanted(column)).collect();
        block(&self.dag, regressor, &columns)
    }
}

/// Entries that are not zero by structure; `columns` are pairs of a column's number in the block and in the regressor.
fn block(dag: &Dag, regressor: &[Vec<ExprId>], columns: &[(usize, usize)]) -> Block {
    let entries = columns
        .iter()
        .flat_map(|&(column, k)| {
            let rows = regressor.iter().enumerate();
            rows.map(move |(joint, row)| (joint, column, row[k]))
        })
        .filter(|&(_, _, entry)| !dag.is_zero(entry))
        .collect();
    Block::new(dag, entries)
}
