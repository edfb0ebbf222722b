//! Base parameters both ways: the compiler's, and of rows along random motions.

use std::f64::consts::TAU;

use nalgebra::DMatrix;
use rand::{RngExt as _, SeedableRng};
use rand_chacha::ChaCha8Rng;
use robot_model::identify::{Identify, Method};
use robot_model::motion::{Kinematics, Motion};
use robot_model_codegen::Compiled;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::Operand;

use super::regrouping::Regrouping;
use super::stacked::{Standard, stack};
use crate::paper::Error;

/// Rows of a column whose part outside of the others is below this share of it are sums of the others.
const DEPENDENT: f64 = 1e-9;

/// Instants of the random motion.
const INSTANTS: usize = 400;

/// What both ways give.
#[derive(Debug, Clone)]
pub struct Base {
    /// Standard parameters.
    pub standard: usize,
    /// The compiler's base parameters.
    pub symbolic: usize,
    /// Of these, those that are no links'.
    pub friction: usize,
    /// Rotors that the compiler keeps by themselves.
    pub rotors: Vec<String>,
    /// Rank by the identification of all parameters from the random motion.
    pub identified: usize,
    /// Rank by QR of the normalized regressor, in the publication's order of columns.
    pub numeric: usize,
    /// Least part of a kept column outside of those before it, and largest of a dropped one, in the compiler's order.
    pub kept_apart: f64,
    /// The same of dropped ones.
    pub dropped_apart: f64,
    /// Largest difference of `D1^-1 R1^-1 R2 D2` from the compiler's coefficients.
    pub k: f64,
    /// `|| W2 - W1 k ||` over `|| W2 ||` with that `k`, and with the `k` of normalized columns as it is.
    pub regrouped: [f64; 2],
    /// Columns and rows of the matrices as printed, `R2 R1^-1`.
    pub printed: [usize; 2],
    /// What the audit says of base parameters that are made with (15).
    pub regrouping: Regrouping,
}

/// Six sines a joint, with phases and sizes by chance.
fn six_sines(dof: usize, random: &mut ChaCha8Rng) -> Motion {
    let waves: Vec<[[f64; 3]; 6]> = (0..dof)
        .map(|_| {
            std::array::from_fn(|l| {
                let w = 0.7 * (l + 1) as f64 * random.random_range(0.8..1.2);
                [
                    random.random_range(0.2..0.6),
                    w,
                    random.random_range(0.0..TAU),
                ]
            })
        })
        .collect();
    let time: Vec<f64> = (0..INSTANTS).map(|k| 0.05 * k as f64).collect();
    let along = |order: i32| -> Vec<Vec<f64>> {
        let turn = f64::from(order) * TAU / 4.0;
        let at = |waves: &[[f64; 3]; 6], t: f64| -> f64 {
            let terms = waves.iter();
            terms
                .map(|[size, w, phase]| size * w.powi(order) * (w * t + phase + turn).sin())
                .sum()
        };
        let joints = waves.iter();
        joints
            .map(|waves| time.iter().map(|&t| at(waves, t)).collect())
            .collect()
    };
    let kinematics = Kinematics {
        q: along(0),
        dq: along(1),
        ddq: along(2),
    };
    Motion {
        time,
        wide: kinematics.clone(),
        smooth: kinematics,
        ..Motion::default()
    }
}

/// The regressor of standard parameters along a motion, rows joint by joint.
fn regressor(compiled: &Compiled, motion: &Motion) -> DMatrix<f64> {
    let block = compiled.regressor();
    let shapes = robot_model_codegen::base::shape_values(&compiled.model);
    let samples = motion.time.len();
    let mut out = vec![Vec::new(); block.entries.len()];
    let bind = |symbol| match symbol {
        Symbol::Q(k) => Operand::Column(&motion.smooth.q[k]),
        Symbol::Dq(k) => Operand::Column(&motion.smooth.dq[k]),
        Symbol::Ddq(k) => Operand::Column(&motion.smooth.ddq[k]),
        Symbol::Shape(k) => Operand::Constant(shapes[k]),
        _ => Operand::Constant(0.0),
    };
    block.program.eval_batch(samples, &bind, &mut out);
    let mut matrix = DMatrix::zeros(samples * compiled.dof(), compiled.standard.len());
    for (&(joint, column), values) in block.entries.iter().zip(&out) {
        for (sample, value) in values.iter().enumerate() {
            matrix[(joint * samples + sample, column)] = *value;
        }
    }
    matrix
}

/// Columns of unit length, and their lengths; a column of zeros stays.
fn normalized(matrix: &DMatrix<f64>) -> (DMatrix<f64>, Vec<f64>) {
    let length = |column: nalgebra::DVectorView<'_, f64>| match column.norm() {
        0.0 => 1.0,
        norm => norm,
    };
    let lengths: Vec<f64> = matrix.column_iter().map(length).collect();
    let mut unit = matrix.clone();
    for (mut column, length) in unit.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    (unit, lengths)
}

/// Rank of the columns of all parameters by the runtime's own least squares.
fn identified(compiled: &Compiled, motion: &Motion) -> Result<usize, Error> {
    let stack = stack(&Standard::new(compiled), motion, &|_| 1.0);
    let identify = Identify {
        method: Method::Ls,
        ..Identify::default()
    };
    let solution = identify.solve_stack(&stack)?;
    Ok(stack.unknowns.len() - solution.unexcited.len())
}

/// Both ways.
///
/// # Errors
/// Those of the libraries.
///
/// # Panics
/// If kept columns are not independent along the random motion.
pub fn base(compiled: &Compiled) -> Result<Base, Error> {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    let motion = six_sines(compiled.dof(), &mut random);
    let (unit, lengths) = normalized(&regressor(compiled, &motion));
    let apart = |matrix: &DMatrix<f64>| -> Vec<f64> {
        let r = matrix.clone().qr().r();
        r.diagonal().iter().map(|x| x.abs()).collect()
    };
    let numeric = apart(&unit).iter().filter(|x| **x > DEPENDENT).count();

    let form = &compiled.base;
    let standard = compiled.standard.len();
    let dropped: Vec<usize> = (0..standard).filter(|k| !form.kept.contains(k)).collect();
    let n = form.kept.len();
    let order: Vec<usize> = form.kept.iter().chain(&dropped).copied().collect();
    let sorted = unit.select_columns(&order);
    let r = sorted.clone().qr().r();
    let apart = |k: usize| r[(k, k)].abs();
    let (r1, r2) = (
        r.view((0, 0), (n, n)).clone_owned(),
        r.view((0, n), (n, dropped.len())).clone_owned(),
    );
    let inverse = r1.try_inverse().expect("kept columns are independent");
    let of_unit = &inverse * &r2;
    let measured = |of_unit: &DMatrix<f64>| {
        DMatrix::from_fn(n, dropped.len(), |i, j| {
            of_unit[(i, j)] * lengths[dropped[j]] / lengths[form.kept[i]]
        })
    };
    let k = measured(&of_unit);
    let in_printed_order = measured(&(r2.transpose() * &inverse).transpose());
    let symbolic = DMatrix::from_fn(n, dropped.len(), |i, j| {
        let mut parts = form.combinations[i].iter();
        parts
            .find(|part| part.0 == dropped[j])
            .map_or(0.0, |part| part.1)
    });
    let scaled = |columns: &[usize]| {
        let mut raw = unit.select_columns(columns);
        for (mut column, k) in raw.column_iter_mut().zip(columns) {
            column *= lengths[*k];
        }
        raw
    };
    let (w1, w2) = (scaled(&form.kept), scaled(&dropped));
    let left = |k: &DMatrix<f64>| (&w2 - &w1 * k).norm() / w2.norm();
    let kept_names = form
        .kept
        .iter()
        .map(|&k| compiled.standard[k].name.as_str());
    let is_effect = |name: &&str| name.matches('.').count() > 1;
    Ok(Base {
        standard,
        symbolic: n,
        friction: kept_names
            .clone()
            .filter(|name| name.contains(".rokae."))
            .count(),
        rotors: kept_names
            .filter(is_effect)
            .filter(|name| name.ends_with("motor_inertia.ia"))
            .map(|name| name.chars().take_while(|c| *c != '.').collect())
            .collect(),
        identified: identified(compiled, &motion)?,
        numeric,
        kept_apart: (0..n).map(apart).fold(f64::INFINITY, f64::min),
        dropped_apart: (n..standard).map(apart).fold(0.0, f64::max),
        k: (&k - &symbolic).amax(),
        regrouped: [left(&k), left(&of_unit)],
        printed: [r2.ncols(), inverse.nrows()],
        regrouping: Regrouping::of(
            compiled,
            [&form.kept, &dropped],
            [&in_printed_order, &of_unit, &k],
        )?,
    })
}
