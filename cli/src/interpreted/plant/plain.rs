//! The equations of arms whose links are where their joints are, under no forces that links alone feel: most arms. What the general
//! equations give is the same, with a matrix of ones for how links move with joints and nothing carried by springs; these are
//! run at every instant of every simulation of a fit, without allocation where they can.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, ParameterSlopes, Slopes};

use super::super::runner::matrix;
use super::InterpretedPlant;
use super::adjust::ParameterRunners;
use super::slopes::MotionSlopes;

impl InterpretedPlant {
    pub(super) fn is_plain(&self) -> bool {
        self.links.is_at_joints() && self.forces.is_none()
    }

    /// The torque of the rigid body is put where effects see it.
    fn with_load<R>(&mut self, at: &Instant<'_>, run: impl FnOnce(&mut Self, &[f64]) -> R) -> R {
        let mut load = std::mem::take(&mut self.load);
        load.clear();
        let rigid = self.rigid.run(at, &[]);
        load.extend((0..self.joints).map(|joint| rigid.output(joint)));
        let found = run(self, &load);
        self.load = load;
        found
    }

    /// `R + E` and `M + d E / d ddq + (d E / d R) M`.
    pub(super) fn plain_torque(
        &mut self,
        at: &Instant<'_>,
        torque: &mut DVector<f64>,
        inertia: &mut DMatrix<f64>,
    ) {
        self.with_load(at, |plant, load| {
            let n = plant.joints;
            let mass = plant.inertia.run(at, &[]);
            let effects = plant.effects.run(at, load);
            for row in 0..n {
                torque[row] = load[row] + effects.output(row);
                for column in 0..n {
                    let entry = row * n + column;
                    let mut sum = mass.output(entry) + effects.output(n + entry);
                    for k in 0..n {
                        let by_load = effects.output(n + n * n + row * n + k);
                        sum += by_load * mass.output(k * n + column);
                    }
                    inertia[(row, column)] = sum;
                }
            }
        });
    }

    pub(super) fn plain_slopes(&mut self, at: &Instant<'_>, slopes: &mut Slopes) {
        self.with_load(at, |plant, load| {
            let (n, p) = (plant.joints, plant.states);
            let by_load = matrix(plant.effects.run(at, load), n + n * n, n, n);
            let rigid = plant.rigid_slopes(at);
            let runners = plant.slope_runners();
            let effects = MotionSlopes::new(runners.effects.run(at, load), n, p);
            for ((torque, own), rigid) in slopes.torque.iter_mut().zip(effects.by).zip(&rigid) {
                *torque = rigid + own;
                torque.gemm(1.0, &by_load, rigid, 1.0);
            }
            slopes.torque[2] = effects.by_state;
            if p == 0 {
                return;
            }
            let rates = runners.rates.run(at, load);
            let rates_by_load = matrix(rates, 3 * p * n, p, n);
            let by = |k: usize| matrix(rates, k * p * n, p, n) + &rates_by_load * &rigid[k];
            slopes.rates = [by(0), by(1), matrix(rates, 4 * p * n, p, p)];
            slopes.rates_by_acceleration = by(2);
        });
    }

    pub(super) fn plain_parameter_slopes(
        &mut self,
        parametric: &mut ParameterRunners,
        at: &Instant<'_>,
        slopes: &mut ParameterSlopes,
    ) {
        self.with_load(at, |plant, load| {
            let (n, p, m) = (plant.joints, plant.states, plant.effects.switches);
            let u = slopes.torque.ncols();
            let rigid = matrix(parametric.rigid.run(at, &[]), 0, n, u);
            let by_load = matrix(plant.effects.run(at, load), n + n * n, n, n);
            slopes.torque = matrix(parametric.effects.run(at, load), 0, n, u) + &rigid;
            slopes.torque.gemm(1.0, &by_load, &rigid, 1.0);
            slopes.arguments = matrix(parametric.arguments.run(at, &[]), 0, m, u);
            if p > 0 {
                let own = plant.slope_runners().rates.run(at, load);
                let by_load = matrix(own, 3 * p * n, p, n);
                slopes.rates = matrix(parametric.rates.run(at, load), 0, p, u) + by_load * rigid;
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use robot_model::simulate::{Adjustable, Plant};
    use robot_model_codegen::compile_model;

    use super::*;

    const TEXT: &str = "
        effect heavy(j) { linear k; torque(j) = k * abs(rigid_torque(j)) * tanh(dq(j)); }
        effect slow(j) { linear k; state z; dot(z) = (rigid_torque(j) * dq(j) - z) / 0.3; torque(j) = k * z; }
        robot Table {
            convention = standard_dh;
            gravity = [0, -9.81, 0];
            joint base: revolute { a = 0.4 m; alpha = 0; d = 0; }
            joint tool: revolute { a = 0.3 m; alpha = 0; d = 0; }
            effects { coulomb_friction on all; stribeck on tool; motor_inertia on base; heavy on all; slow on tool; }
        }";

    fn plant() -> InterpretedPlant {
        let model = robot_model_spec::load("table.robot", TEXT);
        let compiled = compile_model(&model.unwrap_or_else(|error| panic!("{error}")));
        let beta: Vec<f64> = (0..compiled.base.kept.len())
            .map(|k| 0.7 + 0.1 * k as f64)
            .collect();
        let shapes = robot_model_codegen::base::shape_values(&compiled.model);
        InterpretedPlant::new(compiled, &beta, &shapes).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn plain_equations_are_the_general_ones() {
        let mut plant = plant();
        assert!(plant.is_plain());
        plant.prepare();
        for k in 0..20_u32 {
            let at = |scale: f64, phase: f64| -> [f64; 2] {
                [0_u32, 1].map(|joint| scale * (phase + f64::from(3 * k + joint)).sin())
            };
            let (q, dq, ddq) = (at(1.0, 0.1), at(2.0, 0.7), at(9.0, 1.9));
            let signs: Vec<f64> = (k..)
                .take(plant.switches())
                .map(|switch| if switch.is_multiple_of(2) { 1.0 } else { -1.0 })
                .collect();
            let at = Instant {
                time: 0.1,
                q: &q,
                dq: &dq,
                ddq: &ddq,
                memory: &[0.3],
                switches: &signs,
                torque: &[1.0, 2.0],
                inputs: &[],
            };
            let torque = |run: &mut dyn FnMut(&mut DVector<f64>, &mut DMatrix<f64>)| {
                let (mut torque, mut inertia) = (DVector::zeros(2), DMatrix::zeros(2, 2));
                run(&mut torque, &mut inertia);
                (torque, inertia)
            };
            let plain = torque(&mut |torque, inertia| plant.plain_torque(&at, torque, inertia));
            let parted = torque(&mut |torque, inertia| plant.parted_torque(&at, torque, inertia));
            assert!((&plain.0 - &parted.0).amax() < 1e-12 * parted.0.amax());
            assert!((&plain.1 - &parted.1).amax() < 1e-12 * parted.1.amax());
            let [mut plain, mut parted] = [Slopes::zeros(&plant), Slopes::zeros(&plant)];
            plant.plain_slopes(&at, &mut plain);
            plant.parted_slopes(&at, &mut parted);
            let all = |slopes: Slopes| {
                let rates = slopes
                    .rates
                    .into_iter()
                    .chain([slopes.rates_by_acceleration]);
                slopes.torque.into_iter().chain(rates).collect::<Vec<_>>()
            };
            for (plain, parted) in all(plain).iter().zip(all(parted)) {
                assert!(
                    (plain - &parted).amax() <= 1e-12 * parted.amax(),
                    "{plain}{parted}"
                );
            }
            let zeros = ParameterSlopes::zeros(&plant);
            let [mut plain, mut parted] = [zeros.clone(), zeros];
            let mut parametric = plant.parametric.take().expect("prepared");
            plant.plain_parameter_slopes(&mut parametric, &at, &mut plain);
            plant.parted_parameter_slopes(&mut parametric, &at, &mut parted);
            plant.parametric = Some(parametric);
            let all = |slopes: ParameterSlopes| [slopes.torque, slopes.rates, slopes.arguments];
            for (plain, parted) in all(plain).iter().zip(all(parted)) {
                assert!(
                    (plain - &parted).amax() <= 1e-12 * parted.amax(),
                    "{plain}{parted}"
                );
            }
        }
    }
}
