//! What motors, links and joints have to accelerate.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, Plant};

use super::super::links::LinkSlopes;
use super::{InterpretedPlant, of_links};
use crate::Error;

impl InterpretedPlant {
    /// Motors that are parted from their links have an inertia of their own.
    pub(super) fn check_motors(&self, inertia: &[f64]) -> Result<(), Error> {
        let mut joints = self.links.sprung().iter();
        match joints.find(|&&joint| inertia[joint].is_nan() || inertia[joint] <= 0.0) {
            None => Ok(()),
            Some(&joint) => {
                let model = &self.compiled.model;
                Err(Error::Argument(format!(
                    "{}: a spring separates the motor of joint {name} from its link, but the motor has no inertia; declare `motor_inertia \
                     on {name}` with `ia` above 0",
                    model.source,
                    name = model.joints[joint].name
                )))
            }
        }
    }

    /// What each degree of freedom has to accelerate by itself at the position zero, as if springs carried nothing.
    pub(super) fn parted_inertia(&mut self) -> Vec<f64> {
        let dof = self.dof();
        let (still, memory) = (vec![0.0; dof], vec![0.0; self.states]);
        let (switches, inputs) = (
            vec![0.0; self.switches()],
            vec![0.0; self.compiled.model.inputs().len()],
        );
        let at = Instant {
            time: 0.0,
            q: &still,
            dq: &still,
            ddq: &still,
            memory: &memory,
            switches: &switches,
            torque: &still,
            inputs: &inputs,
        };
        let links = self.links.motion(&at);
        let there = of_links(&at, &links);
        let load = self.rigid_torque(&there);
        let LinkSlopes { position, .. } = self.links.slopes(&at);
        let rigid = self.mass_matrix(&there) * position;
        let springs = DMatrix::zeros(self.links.sprung().len(), dof);
        let effects = self.effects.torque(&at, &load);
        let inertia = self
            .load_slopes(&rigid, None, &springs)
            .with_effects(effects.by_acceleration, &effects.by_load);
        inertia.diagonal().iter().copied().collect()
    }

    /// `d tau / d ddq` where nothing moves, by all degrees of freedom.
    fn inertia_at(&mut self, q: &[f64], inputs: &[f64]) -> DMatrix<f64> {
        let dof = self.dof();
        let (still, memory) = (vec![0.0; dof], vec![0.0; self.states]);
        let switches = vec![0.0; self.switches()];
        let at = Instant {
            time: 0.0,
            q,
            dq: &still,
            ddq: &still,
            memory: &memory,
            switches: &switches,
            torque: &still,
            inputs,
        };
        let mut torque = DVector::zeros(dof);
        let mut inertia = DMatrix::zeros(dof, dof);
        self.torque(&at, &mut torque, &mut inertia);
        inertia
    }

    /// Inertia that each joint moves at a position while all others are free, `1 / (A^-1)_jj`, with what effects add to it; infinite
    /// where that is none.
    #[must_use]
    pub fn free_inertia(&mut self, q: &[f64], inputs: &[f64]) -> Vec<f64> {
        let (still, memory) = (vec![0.0; q.len()], vec![0.0; self.states]);
        let motors = Instant {
            time: 0.0,
            q,
            dq: &still,
            ddq: &still,
            memory: &memory,
            switches: &[],
            torque: &still,
            inputs,
        };
        let nothing = vec![0.0; q.len()];
        let q = self
            .links
            .hang(&motors, |_| [nothing.clone(), nothing.clone()]);
        let inertia = self.inertia_at(&q, inputs);
        let inverse = self.links.of_joints(&inertia).try_inverse();
        let free = |joint: usize| {
            let inverse = inverse
                .as_ref()
                .map_or(0.0, |inverse| inverse[(joint, joint)]);
            if inverse > 0.0 {
                1.0 / inverse
            } else {
                f64::INFINITY
            }
        };
        (0..self.joints).map(free).collect()
    }
}
