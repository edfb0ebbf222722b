//! What has to hold for every text that compiles: `tau = Y_b * beta`, and `Y * standard = Y_b * beta` for each parameter by
//! itself, at motions of many sizes.

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::{Block, Compiled};
use robot_model_spec::Model;
use robot_model_spec::parameter::Status;

/// Relative to the largest torque of the parameter. The compiler takes a column for a combination of others at 1e-10; a wrong
/// decision shows in the first digits.
const TOLERANCE: f64 = 1e-6;
/// Relative to the largest entry of all: what small columns beside it keep of their digits.
const ROUNDING: f64 = 1e-14;
const STATES: usize = 24;

/// Where an arm is and what effects read.
struct State {
    signals: Vec<f64>,
    time: f64,
}

/// The spec's values of shape parameters, and one without meaning for every other: at a tilt of zero, which is the middle of its
/// range, columns vanish that do not elsewhere.
fn generic_shapes(model: &Model) -> Vec<f64> {
    const PART: f64 = 0.618;
    let effects = model.effects.iter();
    effects
        .flat_map(|effect| effect.shapes.iter().zip(&effect.definition.shapes))
        .map(|(value, shape)| value.unwrap_or(shape.low + PART * (shape.high - shape.low)))
        .collect()
}

/// What the spec fixes, zero for other parameters.
fn held(compiled: &Compiled) -> Vec<f64> {
    let parameters = compiled.standard.iter();
    parameters
        .map(|parameter| match parameter.status {
            Status::Fixed(value) => value,
            Status::Unknown | Status::Nominal(_) => 0.0,
        })
        .collect()
}

/// What each standard parameter alone makes of the base parameters.
fn maps(compiled: &Compiled) -> Vec<Vec<f64>> {
    let standard = compiled.standard.len();
    (0..standard)
        .map(|k| {
            let mut one = vec![0.0; standard];
            one[k] = 1.0;
            compiled.base.beta(&one)
        })
        .collect()
}

fn most<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> f64 {
    numbers.into_iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// A message where the equations differ, the same for each such text. States at which some entry is no number, or too large to be compared, are left out.
pub fn check(compiled: &Compiled) -> Result<(), &'static str> {
    // A delay or a measured position is between the equations and a log.
    if compiled.check_instantaneous().is_err() {
        return Ok(());
    }
    let dof = compiled.dof();
    let (standard, base) = (compiled.standard.len(), compiled.base.kept.len());
    let (regressor, base_regressor) = (compiled.regressor(), compiled.base_regressor());
    let (rigid, torque) = (compiled.rigid_torque(), compiled.inverse_dynamics());
    let shapes = generic_shapes(&compiled.model);
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let values: Vec<f64> = (0..standard)
        .map(|_| random.random_range(0.1..1.0))
        .collect();
    let beta = compiled.base.beta(&values);
    let parameters = compiled.parameter_values(&beta);
    let known = compiled.known_torque();
    let held = held(compiled);

    let mut own = vec![0.0f64; standard];
    let mut largest = 0.0f64;
    let mut difference = vec![0.0f64; standard];
    let maps = maps(compiled);
    for number in 0..STATES {
        let size = 10f64.powi(i32::try_from(number % 4).unwrap_or_default() - 2);
        let state = State {
            signals: (0..64)
                .map(|_| size * random.random_range(-3.0..3.0))
                .collect(),
            time: random.random_range(0.0..10.0),
        };
        let bind = |load: &[f64], symbol: Symbol| match symbol {
            Symbol::Q(j) => state.signals[j % 64],
            Symbol::Dq(j) => state.signals[(j + 11) % 64],
            Symbol::Ddq(j) => state.signals[(j + 23) % 64],
            Symbol::MeasuredTorque(j) => state.signals[(j + 31) % 64],
            Symbol::Input(k) => state.signals[(k + 41) % 64],
            Symbol::State(k) => state.signals[(k + 53) % 64],
            Symbol::Switch(_) | Symbol::Weight(_) => {
                unreachable!("in equations of simulation and design alone")
            }
            Symbol::RigidTorque(j) => load[j],
            Symbol::Time => state.time,
            Symbol::Parameter(k) => parameters[k],
            Symbol::Shape(k) => shapes[k],
        };
        let load = rigid.eval(&|symbol| bind(&[], symbol));
        let dense = |block: &Block, columns: usize| {
            let mut dense = vec![vec![0.0; columns]; dof];
            for (&(joint, column), value) in block
                .entries
                .iter()
                .zip(block.program.eval(&|symbol| bind(&load, symbol)))
            {
                dense[joint][column] = value;
            }
            dense
        };
        let (full, reduced) = (dense(&regressor, standard), dense(&base_regressor, base));
        let tau = torque.eval(&|symbol| bind(&load, symbol));
        let fixed = known.eval(&|symbol| bind(&load, symbol));
        let numbers = full
            .iter()
            .chain(&reduced)
            .flatten()
            .chain(&tau)
            .chain(&fixed);
        if numbers.into_iter().any(|x| x.is_nan() || x.abs() > 1e100) {
            continue;
        }
        // A huge value may vanish from a joint's torque but for its rounding.
        let rounding = ROUNDING * most(full.iter().flatten()) * most(&held);
        for joint in 0..dof {
            let terms = || reduced[joint].iter().zip(&beta).map(|(y, b)| y * b);
            // What the spec fixes may cancel: its parts count, not their sum.
            let parts = full[joint]
                .iter()
                .zip(&held)
                .map(|(y, held)| (y * held).abs());
            let size = terms().map(f64::abs).sum::<f64>() + parts.sum::<f64>();
            let sum = terms().sum::<f64>() + fixed[joint];
            if (sum - tau[joint]).abs() > TOLERANCE * size + rounding {
                return Err("Y_b * beta is not tau");
            }
            for k in 0..standard {
                let found: f64 = reduced[joint]
                    .iter()
                    .zip(&maps[k])
                    .map(|(y, b)| y * b)
                    .sum();
                own[k] = own[k].max(full[joint][k].abs());
                largest = largest.max(full[joint][k].abs());
                difference[k] = difference[k].max((found - full[joint][k]).abs());
            }
        }
    }
    let is_left_out =
        |k: &usize| compiled.base.fixed.contains(k) || compiled.base.unidentifiable.contains(k);
    for k in (0..standard).filter(|k| !is_left_out(k)) {
        if difference[k] > TOLERANCE * own[k] + ROUNDING * largest {
            return Err("Y * standard is not Y_b * beta");
        }
    }
    Ok(())
}
