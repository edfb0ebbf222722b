//! The equations where links may be parted from their joints: behind springs and gaps, or placed elsewhere.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, Plant, Slopes};
use robot_model_codegen::Driven;

use super::super::links::LinkSlopes;
use super::super::runner::matrix;
use super::slopes::MotionSlopes;
use super::{InterpretedPlant, of_links};

impl InterpretedPlant {
    pub(super) fn parted_torque(
        &mut self,
        at: &Instant<'_>,
        torque: &mut DVector<f64>,
        inertia: &mut DMatrix<f64>,
    ) {
        let links = self.links.motion(at);
        let there = of_links(at, &links);
        let loads = self.loads(at, &there);
        let mass = self.mass_matrix(&there);
        let effects = self.effects.torque(at, &loads.seen);
        let carried = loads.carried.iter().chain(&loads.rests);
        for (torque, carried) in torque.iter_mut().zip(carried) {
            *torque = *carried;
        }
        let mut joints = torque.rows_mut(0, self.joints);
        joints += &effects.torque;
        let LinkSlopes { position, .. } = self.links.slopes(at);
        let forces = loads.forces.as_ref();
        let forces = forces.and_then(|forces| loads.force_slopes(&forces.by_acceleration, &mass));
        let rigid = mass * &position;
        let springs = match self.links.driven() {
            Driven::Not => DMatrix::zeros(loads.springs.len(), self.dof()),
            Driven::Affinely | Driven::Otherwise => {
                let slopes = self.links.carried_slopes(at, &loads.springs, &loads.body);
                slopes.along(2, &rigid)
            }
        };
        *inertia = self
            .load_slopes(&rigid, forces.map(|forces| forces * &position), &springs)
            .with_effects(effects.by_acceleration, &effects.by_load);
    }

    pub(super) fn parted_slopes(&mut self, at: &Instant<'_>, slopes: &mut Slopes) {
        let (n, p, dof) = (self.joints, self.states, self.dof());
        let links = self.links.motion(at);
        let there = of_links(at, &links);
        let loads = self.loads(at, &there);
        let by_load = self.effects.torque(at, &loads.seen).by_load;
        let motion = self.links.slopes(at);
        let springs = self.links.carried_slopes(at, &loads.springs, &loads.body);
        let rigid = self.rigid_slopes(&there);
        let shared = self.shared_slopes(&there, &loads);
        let forces = shared.as_ref().zip(loads.forces.as_ref());
        let forces = forces.map(|(shared, forces)| {
            let by = [&shared.by[0], &shared.by[1], &forces.by_acceleration];
            let by = [0, 1, 2].map(|k| by[k] + &forces.by_load * &rigid[k]);
            motion.onto(&by)
        });
        let rigid = motion.onto(&rigid);
        let runners = self.slope_runners();
        let effects = MotionSlopes::new(runners.effects.run(at, &loads.seen), n, p);
        let rates = runners.rates.run(at, &loads.seen);
        let own_rates = [0, 1, 2].map(|k| matrix(rates, k * p * n, p, n));
        let rates_by_load = matrix(rates, 3 * p * n, p, n);
        let rates_by_state = matrix(rates, 4 * p * n, p, p);
        let rates_by = |k: usize, seen: &DMatrix<f64>| {
            let own = own_rates[k].clone().resize_horizontally(dof, 0.0);
            own + &rates_by_load * seen
        };
        for k in [0, 1] {
            let forces = forces.as_ref().map(|forces| forces[k].clone());
            let load = self.load_slopes(&rigid[k], forces, &springs.along(k, &rigid[k]));
            slopes.rates[k] = rates_by(k, &load.seen);
            slopes.torque[k] = load.with_effects(effects.by[k].clone(), &by_load);
        }
        let load = self.load_slopes(&rigid[2], None, &springs.along(2, &rigid[2]));
        slopes.rates_by_acceleration = rates_by(2, &load.seen);
        let still = DMatrix::zeros(n, p);
        let by_state = shared.map(|shared| shared.by_state);
        let load = self.load_slopes(&still, by_state, &springs.by_state);
        slopes.rates[2] = rates_by_state + &rates_by_load * &load.seen;
        slopes.torque[2] = load.with_effects(effects.by_state, &by_load);
    }
}
