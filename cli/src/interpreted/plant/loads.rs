//! What links and joints carry, and its slopes.

use nalgebra::DMatrix;
use robot_model::simulate::Instant;

use super::super::springs::Carried;
use super::InterpretedPlant;
use super::share::SharedTorque;

/// What is carried where, N m or N.
pub(super) struct Loads {
    /// By links, without forces of the world.
    pub body: Vec<f64>,
    /// By joints, as effects see it: by springs where there are, or as `body`.
    pub seen: Vec<f64>,
    /// By joints, with forces of the world.
    pub carried: Vec<f64>,
    /// What is missing at each link behind a spring.
    pub rests: Vec<f64>,
    /// Forces of the world on links.
    pub forces: Option<SharedTorque>,
    /// By springs.
    pub springs: Vec<Carried>,
}

/// Slopes of the loads by a quantity, such as the positions of all degrees of freedom.
pub(super) struct LoadSlopes {
    /// Of [`Loads::seen`], one row a joint.
    pub seen: DMatrix<f64>,
    /// Of [`Loads::carried`] and then [`Loads::rests`], one row a degree of freedom.
    pub sides: DMatrix<f64>,
}

impl InterpretedPlant {
    pub(super) fn loads(&mut self, at: &Instant<'_>, there: &Instant<'_>) -> Loads {
        let body = self.rigid_torque(there);
        let forces = self.forces.as_mut();
        let forces = forces.map(|forces| forces.torque(there, &body));
        let mut carried = body.clone();
        if let Some(forces) = &forces {
            for (carried, force) in carried.iter_mut().zip(&forces.torque) {
                *carried += force;
            }
        }
        let springs = self.links.carried(at, &body);
        let rests = self.links.carry(&springs, &mut carried);
        let mut seen = body.clone();
        for &joint in self.links.sprung() {
            seen[joint] = carried[joint];
        }
        Loads {
            body,
            seen,
            carried,
            rests,
            forces,
            springs,
        }
    }

    /// Slopes of the loads by a quantity, from those of the rigid body and of forces, one row a joint, and of springs.
    pub(super) fn load_slopes(
        &self,
        rigid: &DMatrix<f64>,
        forces: Option<DMatrix<f64>>,
        springs: &DMatrix<f64>,
    ) -> LoadSlopes {
        let sides = self.links.sides(rigid, springs);
        let seen = sides.rows(0, self.joints).into_owned();
        let sides = match forces {
            None => sides,
            Some(forces) => self.links.sides(&(rigid + forces), springs),
        };
        LoadSlopes { seen, sides }
    }
}

impl Loads {
    /// Slopes of forces by a quantity of the links, by which their own are `by` and those of the rigid body `rigid`.
    pub fn force_slopes(&self, by: &DMatrix<f64>, rigid: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let forces = self.forces.as_ref()?;
        Some(by + &forces.by_load * rigid)
    }
}

impl LoadSlopes {
    /// With those of effects, by the joints' quantity and by the load.
    pub fn with_effects(self, by: DMatrix<f64>, by_load: &DMatrix<f64>) -> DMatrix<f64> {
        let joints = by.nrows();
        let mut slopes = self.sides;
        let mut top = slopes.rows_mut(0, joints);
        top.gemm(1.0, by_load, &self.seen, 1.0);
        let mut own = top.columns_mut(0, by.ncols());
        own += by;
        slopes
    }
}
