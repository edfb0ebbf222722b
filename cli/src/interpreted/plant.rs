//! A compiled spec as a plant to be simulated, and as the model of a controller.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, InverseDynamics, Jumps, Measured, Plant, Slopes};
use robot_model_codegen::Compiled;
use robot_model_codegen::PlantSlopes;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Program, Scratch};

/// A program with its constants in place, run one instant at a time.
#[derive(Debug, Clone)]
struct Runner {
    program: Program,
    scratch: Scratch,
    values: Vec<f64>,
}

/// Numbers for the parameters of an arm.
#[derive(Debug, Clone)]
struct Numbers {
    /// As [`Compiled::parameter_values`] gives them.
    parameters: Vec<f64>,
    shapes: Vec<f64>,
}

impl Runner {
    fn new(program: Program, numbers: &Numbers) -> Self {
        let constant = |symbol: &Symbol| match *symbol {
            Symbol::Parameter(k) => numbers.parameters[k],
            Symbol::Shape(k) => numbers.shapes[k],
            _ => 0.0,
        };
        Self {
            scratch: program.scratch(),
            values: program.symbols().iter().map(constant).collect(),
            program,
        }
    }

    /// `load` is the torque of the rigid body, where the program reads it.
    fn run(&mut self, at: &Instant<'_>, load: &[f64]) -> &Scratch {
        for (value, symbol) in self.values.iter_mut().zip(self.program.symbols()) {
            *value = match *symbol {
                Symbol::Q(joint) => at.q[joint],
                Symbol::Dq(joint) => at.dq[joint],
                Symbol::Ddq(joint) => at.ddq[joint],
                Symbol::RigidTorque(joint) => load[joint],
                Symbol::MeasuredTorque(joint) => at.torque[joint],
                Symbol::Time => at.time,
                Symbol::Input(k) => at.inputs[k],
                Symbol::State(k) => at.memory[k],
                Symbol::Switch(k) => at.switches[k],
                Symbol::Parameter(_) | Symbol::Shape(_) => continue,
                Symbol::Weight(_) => unreachable!("a plant has no weights"),
            };
        }
        self.program.eval_in(&self.values, &mut self.scratch);
        &self.scratch
    }
}

/// The outputs from `first` on, row by row.
fn matrix(scratch: &Scratch, first: usize, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |row, column| {
        scratch.output(first + row * columns + column)
    })
}

/// A compiled spec with numbers for all parameters, as a [`Plant`].
///
/// The torque that a spec's effects call measured is that of the motors.
#[derive(Debug, Clone)]
pub struct InterpretedPlant {
    compiled: Compiled,
    numbers: Numbers,
    dof: usize,
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
    mass: DMatrix<f64>,
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
    #[must_use]
    pub fn new(compiled: Compiled, beta: &[f64], shapes: &[f64]) -> Self {
        let numbers = Numbers {
            parameters: compiled.parameter_values(beta),
            shapes: shapes.to_vec(),
        };
        let plant = compiled.plant();
        let runner = |program| Runner::new(program, &numbers);
        Self {
            dof: plant.dof,
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
            mass: DMatrix::zeros(plant.dof, plant.dof),
            numbers,
            compiled,
        }
    }

    /// Kinetic and potential energy of the rigid body, J; the latter up to a constant.
    pub fn energies(&mut self, q: &[f64], dq: &[f64]) -> [f64; 2] {
        let at = Instant {
            time: 0.0,
            q,
            dq,
            ddq: &[],
            memory: &[],
            switches: &[],
            torque: &[],
            inputs: &[],
        };
        let found = self.energies.run(&at, &[]);
        [found.output(0), found.output(1)]
    }

    /// Inertia that each joint moves alone at a position, with what effects add to it: the diagonal of `d tau / d ddq`.
    #[must_use]
    pub fn own_inertia(&mut self, q: &[f64], inputs: &[f64]) -> Vec<f64> {
        let (still, memory) = (vec![0.0; self.dof], vec![0.0; self.states]);
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
        let mut torque = DVector::zeros(self.dof);
        let mut inertia = DMatrix::zeros(self.dof, self.dof);
        self.torque(&at, &mut torque, &mut inertia);
        inertia.diagonal().as_slice().to_vec()
    }

    fn carry(&mut self, at: &Instant<'_>) {
        let rigid = self.rigid.run(at, &[]);
        for (joint, load) in self.load.iter_mut().enumerate() {
            *load = rigid.output(joint);
        }
    }
}

impl Plant for InterpretedPlant {
    fn dof(&self) -> usize {
        self.dof
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

    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        let dof = self.dof;
        self.carry(at);
        self.mass = matrix(self.inertia.run(at, &[]), 0, dof, dof);
        let effects = self.effects.run(at, &self.load);
        for joint in 0..dof {
            torque[joint] = self.load[joint] + effects.output(joint);
        }
        let by_acceleration = matrix(effects, dof, dof, dof);
        let by_load = matrix(effects, dof + dof * dof, dof, dof);
        inertia.copy_from(&self.mass);
        *inertia += by_acceleration;
        inertia.gemm(1.0, &by_load, &self.mass, 1.0);
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
        let (n, m) = (self.dof, self.switches);
        self.carry(at);
        let found = self.jumps.run(at, &self.load);
        jumps.halves = matrix(found, 0, n, m);
        jumps.directions = matrix(found, n * m, m, n);
        jumps.drifts = DVector::from_fn(m, |k, _| found.output(2 * n * m + k));
    }

    fn slopes(&mut self, at: &Instant<'_>, slopes: &mut Slopes) {
        let (n, p) = (self.dof, self.states);
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
        self.mass = matrix(self.inertia.run(at, &[]), 0, n, n);
        let by_load = matrix(self.effects.run(at, &self.load), n + n * n, n, n);
        let rigid = [
            matrix(runners.rigid_by_position.run(at, &[]), 0, n, n),
            // The velocity torque `C dq` is quadratic, with `C` half its slope.
            matrix(runners.coriolis.run(at, &[]), 0, n, n) * 2.0,
        ];
        let effects = runners.effects.run(at, &self.load);
        for (k, rigid) in rigid.iter().enumerate() {
            slopes.torque[k] = matrix(effects, k * n * n, n, n) + rigid + &by_load * rigid;
        }
        slopes.torque[2] = matrix(effects, 2 * n * n, n, p);
        let rates = runners.rates.run(at, &self.load);
        let by_load = matrix(rates, 3 * p * n, p, n);
        for (k, rigid) in rigid.iter().enumerate() {
            slopes.rates[k] = matrix(rates, k * p * n, p, n) + &by_load * rigid;
        }
        slopes.rates_by_acceleration = matrix(rates, 2 * p * n, p, n) + by_load * &self.mass;
        slopes.rates[2] = matrix(rates, 4 * p * n, p, p);
        self.slopes = Some(runners);
    }
}

/// What a controller believes of the arm: effects' states are at rest in it.
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
        let still = vec![0.0; self.dof];
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
        self.carry(&at);
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
        let effects = self.effects.run(&at, &self.load);
        for (joint, torque) in torque.iter_mut().enumerate() {
            *torque = self.load[joint] + effects.output(joint);
        }
    }
}
