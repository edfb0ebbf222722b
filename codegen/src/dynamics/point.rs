//! Points of a robot that says its energies: positions as the spec gives them, and their slopes.

use robot_model_spec::model::{Energies, Model};

use super::changes::Changes;
use super::energy::positions;
use super::lagrange::placed;
use crate::expr::{Dag, ExprId, Symbol};

/// A named point as expressions of `q`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Point {
    /// Its name in the spec.
    pub name: String,
    /// Coordinates in the base frame, m.
    pub position: [ExprId; 3],
    /// `[row][joint]`: the slope of the position.
    pub jacobian: [Vec<ExprId>; 3],
}

/// The points of a spec.
pub fn points(dag: &mut Dag, model: &Model, energies: &Energies) -> Vec<Point> {
    let dof = model.joints.len();
    let changes = Changes::of(dag, model);
    let positions = positions(dag, energies, dof);
    let points = energies.points.iter().zip(positions);
    points
        .map(|(point, position)| {
            let position = placed(dag, &position, &changes.positions);
            let position = [position[0], position[1], position[2]];
            let jacobian = position.map(|x| {
                let joints = 0..dof;
                joints
                    .map(|joint| dag.derivative(x, Symbol::Q(joint)))
                    .collect()
            });
            Point {
                name: point.name.clone(),
                position,
                jacobian,
            }
        })
        .collect()
}
