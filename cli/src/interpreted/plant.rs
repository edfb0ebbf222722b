//! A compiled spec as a plant to be simulated, and as the model of a controller.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, InverseDynamics, Jumps, Measured, Plant, Slopes};
use robot_model_codegen::Compiled;
use robot_model_codegen::PlantSlopes;

use super::runner::{Numbers, Runner, matrix};
use super::transmission::Transmissions;
use crate::Error;

/// A compiled spec with numbers for all parameters, as a [`Plant`].
///
/// The torque that a spec's effects call measured is that of the motors. Where links hang behind springs or gaps, effects are on the
/// motors' side, as in the spec's equations; links are further degrees of freedom behind those of the joints.
#[derive(Debug, Clone)]
pub struct InterpretedPlant {
    compiled: Compiled,
    numbers: Numbers,
    joints: usize,
    transmissions: Transmissions,
    states: usize,
    switches: usize,
    is_affine: bool,
    is_timed: bool,
    rigid: Runner,
    inertia: Runner,
    effects: Runner,
    rates: Runner,
    arguments: Runner,
    jumps: Runner,
    energies: Runner,
    /// Made when the first implicit step asks for them.
    slopes: Option<Box<SlopeRunners>>,
    load: Vec<f64>,
}

#[derive(Debug, Clone)]
struct SlopeRunners {
    rigid_by_position: Runner,
    coriolis: Runner,
    effects: Runner,
    rates: Runner,
}

impl InterpretedPlant {
    /// The arm with base parameters `beta` and shape parameters `shapes`, each in their order.
    ///
    /// # Errors
    /// [`Error`] where links are not where their encoders say, by other things than springs and gaps; where a motor with one has no
    /// inertia; where base parameters are those of motors and links together, see [`Compiled::ungrouped`].
    pub fn new(compiled: Compiled, beta: &[f64], shapes: &[f64]) -> Result<Self, Error> {
        let numbers = Numbers {
            parameters: compiled.parameter_values(beta),
            shapes: shapes.to_vec(),
        };
        let transmissions = Transmissions::new(&compiled, shapes)?;
        let plant = compiled.plant();
        let runner = |program| Runner::new(program, &numbers);
        let mut found = Self {
            joints: plant.dof,
            transmissions,
            states: plant.states,
            switches: plant.switches,
            is_affine: plant.is_affine,
            is_timed: plant.is_timed,
            rigid: runner(plant.rigid_torque),
            inertia: runner(plant.mass_matrix),
            effects: runner(plant.effects),
            rates: runner(plant.rates),
            arguments: runner(plant.arguments),
            jumps: runner(plant.jumps),
            energies: runner(compiled.energies()),
            slopes: None,
            load: vec![0.0; plant.dof],
            numbers,
            compiled,
        };
        found.check_motors()?;
        Ok(found)
    }

    /// Motors that are parted from their links have an inertia of their own.
    fn check_motors(&mut self) -> Result<(), Error> {
        let joints: Vec<usize> = self.transmissions.joints().collect();
        if joints.is_empty() {
            return Ok(());
        }
        let q = vec![0.0; self.dof()];
        let inertia = self.inertia_at(&q, &vec![0.0; self.compiled.model.inputs().len()]);
        let bare = joints
            .into_iter()
            .find(|&joint| inertia[(joint, joint)] <= 0.0);
        match bare {
            None => Ok(()),
            Some(joint) => {
                let model = &self.compiled.model;
                Err(Error::Argument(format!(
                    "{}: the motor of joint {name} is parted from its link and has no inertia; declare `motor_inertia on {name}` with \
                     `ia` above 0",
                    model.source,
                    name = model.joints[joint].name
                )))
            }
        }
    }

    /// `d tau / d ddq` where nothing moves, by all degrees of freedom.
    fn inertia_at(&mut self, q: &[f64], inputs: &[f64]) -> DMatrix<f64> {
        let dof = self.dof();
        let (still, memory) = (vec![0.0; dof], vec![0.0; self.states]);
        let switches = vec![0.0; self.switches];
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

    /// Kinetic and potential energy of the rigid body, J; the latter up to a constant. Motors and springs have theirs besides.
    pub fn energies(&mut self, q: &[f64], dq: &[f64]) -> [f64; 2] {
        let [q, dq] = [q, dq].map(|values| self.transmissions.of_links(values));
        let at = Instant {
            time: 0.0,
            q: &q,
            dq: &dq,
            ddq: &[],
            memory: &[],
            switches: &[],
            torque: &[],
            inputs: &[],
        };
        let found = self.energies.run(&at, &[]);
        [found.output(0), found.output(1)]
    }

    /// Inertia that each joint moves at a position while all others are free, `1 / (A^-1)_jj`, with what effects add to it; infinite
    /// where that is none.
    #[must_use]
    pub fn free_inertia(&mut self, q: &[f64], inputs: &[f64]) -> Vec<f64> {
        let q = self.transmissions.hang(q, |_| vec![0.0; q.len()]);
        let inertia = self.inertia_at(&q, inputs);
        let inverse = self.transmissions.of_joints(&inertia).try_inverse();
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

    /// Torque of the rigid body where its links are, `n`.
    fn rigid_torque(&mut self, at: &Instant<'_>) -> Vec<f64> {
        let links = [at.q, at.dq, at.ddq].map(|values| self.transmissions.of_links(values));
        let rigid = self.rigid.run(&of_links(at, &links), &[]);
        (0..self.joints).map(|joint| rigid.output(joint)).collect()
    }

    fn mass_matrix(&mut self, at: &Instant<'_>) -> DMatrix<f64> {
        let links = [at.q, at.dq, at.ddq].map(|values| self.transmissions.of_links(values));
        matrix(
            self.inertia.run(&of_links(at, &links), &[]),
            0,
            self.joints,
            self.joints,
        )
    }

    /// What joints carry, as effects see it; what is then missing at links behind transmissions.
    fn carry(&mut self, at: &Instant<'_>) -> Vec<f64> {
        self.load = self.rigid_torque(at);
        self.transmissions.carry(at.q, &mut self.load)
    }

    /// Slopes that rows for the joints and for links behind transmissions have, from those of effects by the joints' quantity and by
    /// the load: `by + by_load * load`, and the rests below.
    fn with_effects(
        &self,
        by: DMatrix<f64>,
        by_load: &DMatrix<f64>,
        sides: DMatrix<f64>,
    ) -> DMatrix<f64> {
        let load = sides.rows(0, self.joints).into_owned();
        let mut slopes = sides;
        let mut top = slopes.rows_mut(0, self.joints);
        top.gemm(1.0, by_load, &load, 1.0);
        let mut own = top.columns_mut(0, self.joints);
        own += by;
        slopes
    }
}

/// The instant as links have it.
fn of_links<'a>(at: &Instant<'a>, links: &'a [Vec<f64>; 3]) -> Instant<'a> {
    let [q, dq, ddq] = links;
    Instant { q, dq, ddq, ..*at }
}

impl Plant for InterpretedPlant {
    fn dof(&self) -> usize {
        self.transmissions.dof()
    }

    fn joints(&self) -> usize {
        self.joints
    }

    fn joint(&self, coordinate: usize) -> usize {
        self.transmissions.joint(coordinate)
    }

    fn states(&self) -> usize {
        self.states
    }

    fn switches(&self) -> usize {
        self.switches
    }

    fn is_affine(&self) -> bool {
        self.is_affine
    }

    fn is_timed(&self) -> bool {
        self.is_timed
    }

    fn start(&mut self, joints: &Instant<'_>) -> Vec<f64> {
        self.transmissions.hang(joints.q, |q| {
            let rigid = self.rigid.run(&Instant { q, ..*joints }, &[]);
            (0..self.joints).map(|joint| rigid.output(joint)).collect()
        })
    }

    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        let n = self.joints;
        let rests = self.carry(at);
        let mass = self.mass_matrix(at);
        let effects = self.effects.run(at, &self.load);
        for joint in 0..n {
            torque[joint] = self.load[joint] + effects.output(joint);
        }
        torque.as_mut_slice()[n..].copy_from_slice(&rests);
        let (by_acceleration, by_load) =
            (matrix(effects, n, n, n), matrix(effects, n + n * n, n, n));
        let sides = self.transmissions.slopes(&mass, at.q, false);
        *inertia = self.with_effects(by_acceleration, &by_load, sides);
    }

    fn rates(&mut self, at: &Instant<'_>, rates: &mut [f64]) {
        self.carry(at);
        let found = self.rates.run(at, &self.load);
        for (state, rate) in rates.iter_mut().enumerate() {
            *rate = found.output(state);
        }
    }

    fn arguments(&mut self, at: &Instant<'_>, arguments: &mut [f64]) {
        let found = self.arguments.run(at, &[]);
        for (k, argument) in arguments.iter_mut().enumerate() {
            *argument = found.output(k);
        }
    }

    fn jumps(&mut self, at: &Instant<'_>, jumps: &mut Jumps) {
        let (n, m, dof) = (self.joints, self.switches, self.dof());
        self.carry(at);
        let found = self.jumps.run(at, &self.load);
        jumps.halves = matrix(found, 0, n, m).resize_vertically(dof, 0.0);
        jumps.directions = matrix(found, n * m, m, n).resize_horizontally(dof, 0.0);
        jumps.drifts = DVector::from_fn(m, |k, _| found.output(2 * n * m + k));
    }

    fn slopes(&mut self, at: &Instant<'_>, slopes: &mut Slopes) {
        let (n, p, dof) = (self.joints, self.states, self.dof());
        let mut runners = self.slopes.take().unwrap_or_else(|| {
            let PlantSlopes {
                rigid_by_position,
                coriolis_matrix,
                effects,
                rates,
            } = self.compiled.plant_slopes();
            let runner = |program| Runner::new(program, &self.numbers);
            Box::new(SlopeRunners {
                rigid_by_position: runner(rigid_by_position),
                coriolis: runner(coriolis_matrix),
                effects: runner(effects),
                rates: runner(rates),
            })
        });
        self.carry(at);
        let by_load = matrix(self.effects.run(at, &self.load), n + n * n, n, n);
        let links = [at.q, at.dq, at.ddq].map(|values| self.transmissions.of_links(values));
        let there = of_links(at, &links);
        let rigid = [
            matrix(runners.rigid_by_position.run(&there, &[]), 0, n, n),
            // The velocity torque `C dq` is quadratic, with `C` half its slope.
            matrix(runners.coriolis.run(&there, &[]), 0, n, n) * 2.0,
            self.mass_matrix(at),
        ];
        let sides = [true, false, false].into_iter().zip(&rigid);
        let sides: Vec<DMatrix<f64>> = sides
            .map(|(is_position, rigid)| self.transmissions.slopes(rigid, at.q, is_position))
            .collect();
        let loads: Vec<DMatrix<f64>> = sides
            .iter()
            .map(|sides| sides.rows(0, n).into_owned())
            .collect();
        let effects = runners.effects.run(at, &self.load);
        let rates = runners.rates.run(at, &self.load);
        let rates_by_load = matrix(rates, 3 * p * n, p, n);
        let rates_by = |k: usize| {
            let own = matrix(rates, k * p * n, p, n).resize_horizontally(dof, 0.0);
            own + &rates_by_load * &loads[k]
        };
        for (k, sides) in sides.into_iter().take(2).enumerate() {
            slopes.torque[k] = self.with_effects(matrix(effects, k * n * n, n, n), &by_load, sides);
            slopes.rates[k] = rates_by(k);
        }
        slopes.torque[2] = matrix(effects, 2 * n * n, n, p).resize_vertically(dof, 0.0);
        slopes.rates_by_acceleration = rates_by(2);
        slopes.rates[2] = matrix(rates, 4 * p * n, p, p);
        self.slopes = Some(runners);
    }
}

/// What a controller believes of the arm: effects' states are at rest in it, and links where their motors are.
impl InverseDynamics for InterpretedPlant {
    fn inverse_dynamics(
        &mut self,
        measured: &Measured<'_>,
        ddq: &[f64],
        sliding: &[f64],
        torque: &mut [f64],
    ) {
        let memory = vec![0.0; self.states];
        let mut switches = vec![0.0; self.switches];
        let still = vec![0.0; self.joints];
        let mut at = Instant {
            time: measured.time,
            q: measured.q,
            dq: measured.dq,
            ddq,
            memory: &memory,
            switches: &[],
            torque: &still,
            inputs: measured.inputs,
        };
        let rigid = self.rigid.run(&at, &[]);
        let load: Vec<f64> = (0..self.joints).map(|joint| rigid.output(joint)).collect();
        at.dq = sliding;
        let arguments = self.arguments.run(&at, &[]);
        for (k, switch) in switches.iter_mut().enumerate() {
            let argument: f64 = arguments.output(k);
            *switch = if argument == 0.0 {
                0.0
            } else {
                argument.signum()
            };
        }
        at.switches = &switches;
        let effects = self.effects.run(&at, &load);
        for (joint, torque) in torque.iter_mut().enumerate() {
            *torque = load[joint] + effects.output(joint);
        }
    }
}
