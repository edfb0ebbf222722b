//! Programs of slopes, made when the first implicit step asks for them.

use nalgebra::DMatrix;
use robot_model::simulate::Instant;
use robot_model_codegen::PlantSlopes;
use robot_model_codegen::interpreter::Scratch;

use super::super::runner::{Numbers, Runner, matrix};
use super::InterpretedPlant;
use super::loads::Loads;

#[derive(Debug, Clone)]
pub(super) struct SlopeRunners {
    pub rigid_by_position: Runner,
    pub coriolis: Runner,
    pub effects: Runner,
    pub forces: Option<Runner>,
    pub rates: Runner,
}

impl SlopeRunners {
    pub fn new(slopes: PlantSlopes, numbers: &Numbers) -> Self {
        let runner = |program| Runner::new(program, numbers);
        Self {
            rigid_by_position: runner(slopes.rigid_by_position),
            coriolis: runner(slopes.coriolis_matrix),
            effects: runner(slopes.effects),
            forces: slopes.forces.map(runner),
            rates: runner(slopes.rates),
        }
    }

    pub fn runners(&mut self) -> impl Iterator<Item = &mut Runner> {
        let always = [
            &mut self.rigid_by_position,
            &mut self.coriolis,
            &mut self.effects,
            &mut self.rates,
        ];
        always.into_iter().chain(&mut self.forces)
    }
}

impl InterpretedPlant {
    pub(super) fn slope_runners(&mut self) -> &mut SlopeRunners {
        let (compiled, numbers) = (&self.compiled, &self.numbers);
        self.slopes
            .get_or_insert_with(|| Box::new(SlopeRunners::new(compiled.plant_slopes(), numbers)))
    }

    /// Slopes of the rigid body's torque by the motion of links: by `q`, `dq` and `ddq`.
    pub(super) fn rigid_slopes(&mut self, there: &Instant<'_>) -> [DMatrix<f64>; 3] {
        let (n, mass) = (self.joints, self.mass_matrix(there));
        let runners = self.slope_runners();
        [
            matrix(runners.rigid_by_position.run(there, &[]), 0, n, n),
            // The velocity torque `C dq` is quadratic, with `C` half its slope.
            matrix(runners.coriolis.run(there, &[]), 0, n, n) * 2.0,
            mass,
        ]
    }

    /// Slopes of forces of the world where they are apart.
    pub(super) fn shared_slopes(
        &mut self,
        there: &Instant<'_>,
        loads: &Loads,
    ) -> Option<MotionSlopes> {
        let (n, p) = (self.joints, self.states);
        let forces = self.slope_runners().forces.as_mut()?;
        Some(MotionSlopes::new(forces.run(there, &loads.body), n, p))
    }
}

/// Slopes of a share of the torque, all else held.
pub(super) struct MotionSlopes {
    /// By position and by velocity, `n` by `n`.
    pub by: [DMatrix<f64>; 2],
    /// By internal states, `n` by `p`.
    pub by_state: DMatrix<f64>,
}

impl MotionSlopes {
    pub fn new(found: &Scratch, n: usize, p: usize) -> Self {
        Self {
            by: [0, 1].map(|k| matrix(found, k * n * n, n, n)),
            by_state: matrix(found, 2 * n * n, n, p),
        }
    }
}
