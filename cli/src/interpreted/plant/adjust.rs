//! Parameters of a plant that can be moved, and slopes by them.

use robot_model::simulate::{Adjustable, Instant, ParameterSlopes};
use robot_model_codegen::PlantParameters;

use super::super::runner::{Numbers, Runner, matrix};
use super::share::ShareRunner;
use super::{InterpretedPlant, of_links};

/// Programs of slopes by what is unknown, made when they are first asked for.
#[derive(Debug, Clone)]
pub(super) struct ParameterRunners {
    pub rigid: Runner,
    pub effects: Runner,
    pub forces: Option<Runner>,
    pub rates: Runner,
    pub arguments: Runner,
    pub force_arguments: Option<Runner>,
    pub give: Runner,
    pub place: Runner,
}

impl ParameterRunners {
    fn new(slopes: PlantParameters, numbers: &Numbers) -> Self {
        let runner = |program| Runner::new(program, numbers);
        Self {
            rigid: runner(slopes.rigid),
            effects: runner(slopes.effects),
            forces: slopes.forces.map(runner),
            rates: runner(slopes.rates),
            arguments: runner(slopes.arguments),
            force_arguments: slopes.force_arguments.map(runner),
            give: runner(slopes.give),
            place: runner(slopes.place),
        }
    }

    fn runners(&mut self) -> impl Iterator<Item = &mut Runner> {
        let always = [
            &mut self.rigid,
            &mut self.effects,
            &mut self.rates,
            &mut self.arguments,
            &mut self.give,
            &mut self.place,
        ];
        always
            .into_iter()
            .chain(&mut self.forces)
            .chain(&mut self.force_arguments)
    }
}

impl Adjustable for InterpretedPlant {
    fn parameters(&self) -> usize {
        self.compiled.base.kept.len() + self.compiled.free_shapes().len()
    }

    /// Base parameters, then the shapes that the spec leaves open.
    fn values(&self) -> Vec<f64> {
        let kept = self.compiled.base.kept.iter();
        let base = kept.map(|&k| self.numbers.parameters[k]);
        let free = self.compiled.free_shapes().into_iter();
        base.chain(free.map(|k| self.numbers.shapes[k])).collect()
    }

    fn prepare(&mut self) {
        self.slope_runners();
        if self.parametric.is_none() {
            let slopes = self.compiled.plant_parameters();
            self.parametric = Some(Box::new(ParameterRunners::new(slopes, &self.numbers)));
        }
    }

    fn adjust(&mut self, values: &[f64]) {
        let (beta, shapes) = values.split_at(self.compiled.base.kept.len());
        self.numbers.parameters = self.compiled.parameter_values(beta);
        for (k, shape) in self.compiled.free_shapes().into_iter().zip(shapes) {
            self.numbers.shapes[k] = *shape;
        }
        let numbers = &self.numbers;
        let own = [
            &mut self.rigid,
            &mut self.inertia,
            &mut self.rates,
            &mut self.energies,
        ];
        let shares = std::iter::once(&mut self.effects).chain(&mut self.forces);
        let slopes = self.slopes.iter_mut().flat_map(|slopes| slopes.runners());
        let parametric = self
            .parametric
            .iter_mut()
            .flat_map(|slopes| slopes.runners());
        own.into_iter()
            .chain(shares.flat_map(ShareRunner::runners))
            .chain(slopes)
            .chain(parametric)
            .chain(self.links.runners())
            .for_each(|runner| runner.set(numbers));
    }

    fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes) {
        self.prepare();
        let Some(mut parametric) = self.parametric.take() else {
            unreachable!("prepared above");
        };
        if self.is_plain() {
            self.plain_parameter_slopes(&mut parametric, at, slopes);
        } else {
            self.parted_parameter_slopes(&mut parametric, at, slopes);
        }
        self.parametric = Some(parametric);
    }
}

impl InterpretedPlant {
    pub(super) fn parted_parameter_slopes(
        &mut self,
        parametric: &mut ParameterRunners,
        at: &Instant<'_>,
        slopes: &mut ParameterSlopes,
    ) {
        let (n, p, u) = (self.joints, self.states, slopes.torque.ncols());
        let links = self.links.motion(at);
        let there = of_links(at, &links);
        let loads = self.loads(at, &there);
        let mut rigid = matrix(parametric.rigid.run(&there, &[]), 0, n, u);
        let forces = parametric.forces.as_mut();
        let mut forces = forces.map(|forces| matrix(forces.run(&there, &loads.body), 0, n, u));
        // Links that unknown displacements place move with them.
        let place = matrix(
            parametric.place.run(at, &[]),
            0,
            3 * self.links.placed().len(),
            u,
        );
        if let Some(moved) = self.links.placed_slopes(&place) {
            let by_motion = self.rigid_slopes(&there);
            for (by, moved) in by_motion.iter().zip(&moved) {
                rigid += by * moved;
            }
            let shared = self.shared_slopes(&there, &loads);
            let by_motion = shared.zip(loads.forces.as_ref()).map(|(shared, own)| {
                let [q, dq] = shared.by;
                [q, dq, own.by_acceleration.clone()]
            });
            if let (Some(forces), Some(by_motion)) = (&mut forces, by_motion) {
                for (by, moved) in by_motion.iter().zip(&moved) {
                    *forces += by * moved;
                }
            }
        }
        let forces = forces.and_then(|forces| loads.force_slopes(&forces, &rigid));
        let give = parametric.give.run(at, &loads.seen);
        let give = matrix(give, 0, loads.springs.len(), u);
        let springs = self.links.carried_slopes(at, &loads.springs, &loads.body);
        let springs = springs.through(&give) + &springs.by_load * &rigid;
        let by_load = self.effects.torque(at, &loads.seen).by_load;
        let load = self.load_slopes(&rigid, forces, &springs);
        slopes.rates = matrix(parametric.rates.run(at, &loads.seen), 0, p, u);
        if p > 0 {
            let own = self.slope_runners().rates.run(at, &loads.seen);
            slopes.rates += matrix(own, 3 * p * n, p, n) * &load.seen;
        }
        let effects = matrix(parametric.effects.run(at, &loads.seen), 0, n, u);
        slopes.torque = load.with_effects(effects, &by_load);
        let (m, all) = (self.effects.switches, slopes.arguments.nrows());
        slopes.arguments.fill(0.0);
        let own = matrix(parametric.arguments.run(at, &[]), 0, m, u);
        slopes.arguments.rows_mut(0, m).copy_from(&own);
        if let Some(forces) = &mut parametric.force_arguments {
            let own = matrix(forces.run(&there, &[]), 0, all - m, u);
            slopes.arguments.rows_mut(m, all - m).copy_from(&own);
        }
    }
}
