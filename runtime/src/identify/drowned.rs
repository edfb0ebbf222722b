//! Sums of parameters of which logs have noise of positions alone.
//!
//! A motion that does not tell two parameters apart, as one with `q3 = -q2` those of a link that keeps its attitude, leaves columns that are
//! the same but for the noise of the encoders. Their difference is small, and all of it is noise: least squares takes it for a motion, and
//! has a value for it with a tight deviation. How much of each sum of columns is noise is seen with more of it: with `N` what the columns
//! change by where positions have as much noise again, the directions of `x` in which `|N x|^2 / |W x|^2` is most of 1 are told by nothing else.
//! They are taken out of the rank, as those in which `W x` is zero are.
//!
//! The density of that noise is what velocities have between the motion's bands, see [`acceleration_noise`](crate::signal::acceleration_noise).

use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Mat, Par};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::least_squares::{Excited, Solution};
use super::stack::{Stack, whole_torque};
use super::{AtTurns, Beyond, Identify, IdentifyError, Method, logs::update_load};
use crate::columns::Arm;
use crate::log::Log;
use crate::signal::{Bands, Prepared, position_noise, prepare};

/// Share of a direction's power from where on it is noise: of directions that are nothing else 0.45 to 0.95 is seen, as noise is drawn and its
/// density is an estimate; real motions of slow arms have up to 0.3.
pub(super) const MOST: f64 = 0.4;

impl Identify {
    /// A solution without what is told by noise of positions alone. `prepare` is how logs were prepared for it.
    pub(super) fn without_drowned(
        &self,
        arm: &dyn Arm,
        (logs, prepared, bands): (&[Log], &[Prepared], &Bands),
        prepare: impl Fn(&[Log]) -> Result<Vec<Prepared>, IdentifyError>,
        (solution, shapes, mut stack): (Solution, Vec<f64>, Stack),
    ) -> Result<(Solution, Vec<f64>, Stack), IdentifyError> {
        // Instruments have no noise, and say themselves what they part.
        if self.beyond < Beyond::Deviations || self.method == Method::Instrumental {
            return Ok((solution, shapes, stack));
        }
        let pairs = logs.iter().zip(prepared).enumerate();
        let noisy: Option<Vec<Log>> = pairs
            .map(|(seed, (log, prepared))| noisier(log, prepared, bands, seed as u64))
            .collect();
        let Some(noisy) = noisy else {
            return Ok((solution, shapes, stack));
        };
        let mut noisy = prepare(&noisy)?;
        for (noisy, prepared) in noisy.iter_mut().zip(prepared) {
            noisy
                .motion
                .turn_speeds
                .clone_from(&prepared.motion.turn_speeds);
        }
        if arm.uses_rigid_torque() {
            update_load(arm, &mut noisy, &shapes, &solution.estimate);
        }
        // At turns other rows might be left out.
        let all = Self {
            at_turns: AtTurns::Kept,
            ..self.clone()
        };
        let other = all.rows(arm, &noisy, &shapes);
        drop(noisy);
        stack.noise = if self.leaves_out_turns() {
            changes(&all.rows(arm, prepared, &shapes), &other)
        } else {
            changes(&stack, &other)
        };
        let again = self.solve_stack(&stack)?;
        Ok((again, shapes, stack))
    }
}

/// What noise of the positions makes of a joint's torque, mean squares, N^2 m^2 or N^2.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct TorqueOfNoise {
    /// Of raw samples.
    pub(crate) raw: f64,
    /// Of rows of the fit.
    pub(crate) filtered: f64,
}

/// What as much noise again on the positions makes of a model's torque, joint by joint: about what the noise that they have makes. Zero where
/// that is not known. The noise is that of logs as they are prepared for rows, the torque that along `motions`, whose bands may be others.
pub(crate) fn torque_of_noise(
    arm: &dyn Arm,
    (logs, prepared, bands): (&[Log], &[Prepared], &Bands),
    (motions, along): (&[Prepared], &Bands),
    (shapes, estimate): (&[f64], &[f64]),
) -> Result<Vec<TorqueOfNoise>, IdentifyError> {
    let dof = arm.dof();
    let mut made = vec![TorqueOfNoise::default(); dof];
    let (mut samples, mut rows) = (0, 0);
    let squares = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
    let pairs = logs.iter().zip(prepared).zip(motions);
    for (seed, ((log, prepared), own)) in pairs.enumerate() {
        let Some(noisy) = noisier(log, prepared, bands, seed as u64) else {
            return Ok(vec![TorqueOfNoise::default(); dof]);
        };
        let own = &own.motion;
        let mut noisy = prepare(&noisy, along)?.motion;
        noisy.turn_speeds.clone_from(&own.turn_speeds);
        noisy.rigid_torque.clone_from(&own.rigid_torque);
        // What is known of the arm reads the same positions.
        let [with, without] =
            [&noisy, own].map(|motion| whole_torque(arm, motion, shapes, estimate));
        let border = prepared.shared.border();
        let inner = border..prepared.motion.time.len().saturating_sub(border);
        samples += inner.len();
        let mut filtered = Vec::new();
        for (joint, made) in made.iter_mut().enumerate() {
            let pairs = with[joint].iter().zip(&without[joint]);
            let differences: Vec<f64> = pairs.map(|(with, without)| with - without).collect();
            let inner = differences.get(inner.clone()).unwrap_or_default();
            made.raw += squares(inner);
            prepared.shared.apply(&differences, &mut filtered);
            made.filtered += squares(&filtered);
        }
        rows += filtered.len();
    }
    let mean = |made: TorqueOfNoise| TorqueOfNoise {
        raw: made.raw / samples.max(1) as f64,
        filtered: made.filtered / rows.max(1) as f64,
    };
    Ok(made.into_iter().map(mean).collect())
}

/// A log with as much noise again on its positions as they have; none where that is not known.
fn noisier(log: &Log, prepared: &Prepared, bands: &Bands, seed: u64) -> Option<Log> {
    let densities = position_noise(prepared, bands)?;
    let mut log = log.clone();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let half_rate = 0.5 * log.rate_hz();
    for (q, density) in log.q.iter_mut().zip(densities) {
        let deviation = (density * half_rate).sqrt();
        for q in q {
            let fresh: f64 = StandardNormal.sample(&mut random);
            *q += deviation * fresh;
        }
    }
    Some(log)
}

/// What noise of positions makes of a joint's columns: a triangular factor, see [`Stack::noise`].
#[derive(Debug, Clone, PartialEq)]
pub struct PositionNoise(pub(super) Mat<f64>);

/// Triangular factors of what the columns of each joint change by.
fn changes(stack: &Stack, other: &Stack) -> Vec<PositionNoise> {
    let unknowns = stack.unknowns.len();
    let joints = stack.joints.iter().zip(&other.joints);
    let joints = joints.map(|(one, other)| {
        let rows = 0..one.target.len();
        let both: Vec<usize> = rows
            .filter(|&row| one.is_there(row) && other.is_there(row))
            .collect();
        let mut changes = Mat::zeros(both.len(), unknowns);
        for (columns, sign) in [(&one.columns, -1.0), (&other.columns, 1.0)] {
            for (column, values) in columns {
                for (row, &k) in both.iter().enumerate() {
                    changes[(row, *column)] += sign * values[k];
                }
            }
        }
        if both.is_empty() {
            return PositionNoise(changes);
        }
        PositionNoise(changes.qr().thin_R().to_owned())
    });
    joints.collect()
}

/// Of the columns that `found` keeps those that are told by more than noise; `noise` is the factor of what all columns change by.
pub(super) fn told(found: Excited, noise: &Mat<f64>) -> Excited {
    let count = found.columns.len();
    if count == 0 || noise.nrows() == 0 {
        return found;
    }
    let factors = found.kept.qr();
    // `N R^-1`, whose singular values are roots of shares, transposed.
    let mut shares = Mat::from_fn(count, noise.nrows(), |k, row| {
        let column = found.columns[k];
        noise[(row, column)] / found.norms[column]
    });
    solve_lower_triangular_in_place(factors.thin_R().transpose(), shares.as_mut(), Par::Seq);
    let Ok(svd) = shares.svd() else {
        return found;
    };
    let sizes = svd.S().column_vector().iter();
    let sunk = sizes.filter(|size| size.powi(2) > MOST).count();
    if sunk == 0 {
        return found;
    }
    let directions = svd.U().subcols(sunk, count - sunk);
    let clean = factors.compute_thin_Q() * directions;
    found.along(clean)
}
