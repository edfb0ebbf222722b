//! Random states and random arms that could be built, from fixed seeds.

use rand::RngExt;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use robot_model::{State as ArmState, Vector};
use robot_model_spec::Model;
use robot_model_spec::model::{Energies, Monomial};
use robot_model_spec::parameter::Status;

/// Where an arm is and how it moves.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct State {
    /// Positions.
    pub q: Vec<f64>,
    /// Velocities.
    pub dq: Vec<f64>,
    /// Accelerations.
    pub ddq: Vec<f64>,
    /// Seconds since the start of the log.
    pub time: f64,
    /// Torques as a log has them.
    pub measured_torque: Vec<f64>,
    /// Further channels of a log, more than any spec here reads.
    pub inputs: Vec<f64>,
    /// Internal states of effects, more than any spec here has.
    pub states: Vec<f64>,
}

/// A state in the types of emitted code; no load.
#[must_use]
pub fn typed<const DOF: usize, const STATES: usize, const INPUTS: usize>(
    state: &State,
) -> ArmState<DOF, STATES, INPUTS> {
    let vector = |values: &[f64]| Vector::<DOF>::from_column_slice(values);
    let motion = ArmState {
        time: state.time,
        // States written by hand say nothing of it.
        measured_torque: Vector::from_fn(|k, _| {
            state.measured_torque.get(k).copied().unwrap_or(0.0)
        }),
        ..ArmState::new(vector(&state.q), vector(&state.dq), vector(&state.ddq))
    };
    motion
        .with_memory(Vector::from_column_slice(&state.states[..STATES]))
        .with_inputs(Vector::from_column_slice(&state.inputs[..INPUTS]))
}

/// Channels and internal states of a [`State`].
const SPARE: usize = 16;

/// The generator of a test: the same numbers on every machine and in every run.
#[must_use]
pub fn generator(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// A state without special values. Its size is not that of the states at which the compiler compares columns: motions are
/// slow or fast, torques small or large, by powers of ten.
pub fn state(random: &mut ChaCha8Rng, dof: usize) -> State {
    let size = 10f64.powf(random.random_range(-3.0..1.0));
    let mut uniform = |limit: f64| -> Vec<f64> {
        (0..dof)
            .map(|_| random.random_range(-limit..limit))
            .collect()
    };
    let (q, dq, ddq) = (uniform(3.0), uniform(2.0 * size), uniform(5.0 * size));
    State {
        q,
        dq,
        ddq,
        time: random.random_range(0.0..10.0),
        measured_torque: (0..dof)
            .map(|_| size * random.random_range(-90.0..90.0))
            .collect(),
        inputs: (0..SPARE)
            .map(|_| random.random_range(10.0..40.0))
            .collect(),
        states: (0..SPARE)
            .map(|_| size * random.random_range(-0.9..0.9))
            .collect(),
    }
}

/// Standard parameters of an arm that could be built: every link is eight point masses, so its ten numbers are those of a
/// body. Unknown constants of energies are positive.
///
/// Effects' parameters are positive. What the spec fixes keeps its value.
pub fn physical(random: &mut ChaCha8Rng, model: &Model) -> Vec<f64> {
    let mut standard = match model.energies() {
        Some(energies) => products(random, energies),
        None => (0..model.joints.len()).flat_map(|_| body(random)).collect(),
    };
    let mut carried = Vec::new();
    for parameter in model.standard_parameters().iter().skip(standard.len()) {
        // Standard effects list the ten numbers of a body in their order.
        let value = if model.is_rigid(parameter) {
            if carried.is_empty() {
                carried = body(random).into_iter().rev().collect();
            }
            carried.pop()
        } else {
            None
        };
        standard.push(value.unwrap_or_else(|| random.random_range(0.1..1.0)));
    }
    keep_fixed(model, &mut standard);
    standard
}

/// Any numbers as standard parameters: linear laws hold for them too. What the spec fixes keeps its value.
pub fn arbitrary(random: &mut ChaCha8Rng, model: &Model) -> Vec<f64> {
    let mut standard: Vec<f64> = model
        .standard_parameters()
        .iter()
        .map(|_| random.random_range(-2.0..2.0))
        .collect();
    keep_fixed(model, &mut standard);
    standard
}

fn keep_fixed(model: &Model, standard: &mut [f64]) {
    for (value, parameter) in standard.iter_mut().zip(model.standard_parameters()) {
        if let Status::Fixed(fixed) = parameter.status {
            *value = fixed;
        }
    }
}

/// Products of positive parameters: inertias, masses and lengths.
fn products(random: &mut ChaCha8Rng, energies: &Energies) -> Vec<f64> {
    let values: Vec<f64> = energies
        .parameters
        .iter()
        .map(|_| random.random_range(0.1..1.0))
        .collect();
    let product = |monomial: &Monomial| -> f64 {
        let factors = monomial.factors.iter();
        factors
            .map(|&(k, exponent)| f64::powi(values[k], exponent))
            .product()
    };
    energies.monomials.iter().map(product).collect()
}

fn body(random: &mut ChaCha8Rng) -> [f64; 10] {
    let mut sum = [0.0; 10];
    for _ in 0..8 {
        let m = random.random_range(0.1..1.0);
        let [x, y, z]: [f64; 3] = std::array::from_fn(|_| random.random_range(-0.3..0.3));
        let part = [
            1.0,
            x,
            y,
            z,
            y * y + z * z,
            -x * y,
            -x * z,
            x * x + z * z,
            -y * z,
            x * x + y * y,
        ];
        for (sum, part) in sum.iter_mut().zip(part) {
            *sum += m * part;
        }
    }
    sum
}
