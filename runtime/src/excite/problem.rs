//! The design as a function of its free variables: criterion, barrier of the limits, slopes.

use faer::Mat;

use super::Request;
use super::basis::Basis;
use super::clearance::Clearance;
use super::criterion::{Criterion, Scaling, Sharpness, Valued};
use super::fourier::{Fourier, Freedom, basis, instants};
use super::function::{Regressor, add};
use super::limits::{Limits, share};
use super::slack::{barrier, each_slack, lesser};
use crate::motion::Kinematics;

/// Everything that is fixed while coefficients are looked for.
pub(super) struct Problem<'a> {
    pub regressor: &'a Regressor,
    pub clearances: &'a [Box<dyn Clearance>],
    pub limits: &'a Limits,
    pub criterion: &'a Criterion,
    /// Whether columns that are zero along a motion do not count, so that any motion has a value: the determinant of the others.
    pub warms_up: bool,
    pub basis: Option<&'a Basis>,
    pub scaling: Scaling,
    /// What a joint's rows are multiplied by: one over the deviation of its torque noise.
    pub weights: &'a [f64],
    pub period: f64,
    pub harmonics: usize,
    /// Shares of the clearances' slack that are kept free on the grid, so that none is missed between its instants.
    pub reserve: Vec<f64>,
    freedoms: Vec<Freedom>,
    /// By order of derivative and joint, `[sample][variable]`, and what is added.
    waves: [Vec<(Mat<f64>, Vec<f64>)>; 3],
    samples: usize,
}

/// A joint's rows: the outputs that are in them, and their weighted values, `[sample][output]`.
type Rows = (Vec<usize>, Mat<f64>);

/// Weight of the barrier and sharpness of smooth stand-ins.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stage {
    pub barrier: f64,
    pub sharpness: Sharpness,
}

/// The value at some variables, with slopes.
pub(super) struct Point {
    /// Of what is minimized without the barrier of linear limits.
    pub smooth: f64,
    pub smooth_slopes: Vec<f64>,
    /// Of the barrier of linear limits.
    pub barrier: f64,
    pub barrier_slopes: Vec<f64>,
    /// Second slopes of that barrier: one block a joint.
    pub barrier_curvature: Vec<Mat<f64>>,
}

impl Point {
    pub(super) fn value(&self) -> f64 {
        self.smooth + self.barrier
    }

    pub(super) fn slopes(&self) -> Vec<f64> {
        let pairs = self.smooth_slopes.iter().zip(&self.barrier_slopes);
        pairs.map(|(x, y)| x + y).collect()
    }
}

impl<'a> Problem<'a> {
    /// `weights` are what joints' rows are multiplied by.
    pub(super) fn new(request: &'a Request, weights: &'a [f64]) -> Self {
        let (harmonics, period) = (request.harmonics, request.period);
        let samples = request.samples();
        let dof = weights.len();
        let freedoms: Vec<Freedom> = (0..dof)
            .map(|joint| Freedom::new(harmonics, period, &request.ends, joint))
            .collect();
        let rows: Vec<[Vec<f64>; 3]> = instants(period, samples)
            .into_iter()
            .map(|t| basis(harmonics, period, t))
            .collect();
        let waves = std::array::from_fn(|order| {
            let of_joint = |freedom: &Freedom| {
                let of_sample = |row: &[Vec<f64>; 3]| freedom.of_variables(&row[order]);
                let table: Vec<Vec<f64>> = rows.iter().map(of_sample).collect();
                let added = rows.iter().map(|row| freedom.constant(&row[order]));
                let wave = Mat::from_fn(samples, freedom.len(), |s, k| table[s][k]);
                (wave, added.collect())
            };
            freedoms.iter().map(of_joint).collect()
        });
        Self {
            regressor: &request.regressor,
            clearances: &request.clearances,
            limits: &request.limits,
            criterion: &request.criterion,
            warms_up: false,
            basis: request.basis.as_ref(),
            scaling: request.scaling,
            reserve: vec![0.0; request.clearances.len()],
            weights,
            period,
            harmonics,
            freedoms,
            waves,
            samples,
        }
    }

    /// Number of free variables.
    pub(super) fn len(&self) -> usize {
        self.freedoms.iter().map(Freedom::len).sum()
    }

    /// Variables of each joint, as ranges.
    pub(super) fn parts(&self) -> impl Iterator<Item = (usize, std::ops::Range<usize>)> + '_ {
        let mut start = 0;
        self.freedoms
            .iter()
            .enumerate()
            .map(move |(joint, freedom)| {
                let range = start..start + freedom.len();
                start = range.end;
                (joint, range)
            })
    }

    pub(super) fn fourier(&self, z: &[f64]) -> Fourier {
        let parts = self.parts();
        Fourier {
            period: self.period,
            coefficients: parts
                .map(|(joint, range)| self.freedoms[joint].coefficients(&z[range]))
                .collect(),
        }
    }

    pub(super) fn motion(&self, z: &[f64]) -> Kinematics {
        let [q, dq, ddq] = std::array::from_fn(|order| {
            let parts = self.parts();
            parts
                .map(|(joint, range)| {
                    let (wave, added) = &self.waves[order][joint];
                    let mut values = added.clone();
                    for (k, z) in z[range].iter().enumerate() {
                        for (value, wave) in values.iter_mut().zip(wave.col(k).iter()) {
                            *value += wave * z;
                        }
                    }
                    values
                })
                .collect()
        });
        Kinematics { q, dq, ddq }
    }

    /// Middle and half width of a linear limit on the grid; infinite where there is none.
    fn bounds(&self, joint: usize) -> [(f64, f64); 3] {
        let share = share(self.harmonics, self.samples);
        let (middle, half) = self.limits.range(joint);
        [
            (middle, half * share),
            (0.0, self.limits.velocity[joint] * share),
            (0.0, self.limits.acceleration[joint] * share),
        ]
    }

    /// Least slack of all limits, as a share of what is allowed: negative where one is not kept.
    pub(super) fn least_slack(&self, motion: &Kinematics) -> f64 {
        let mut least = f64::INFINITY;
        for joint in 0..self.weights.len() {
            let signals = [&motion.q[joint], &motion.dq[joint], &motion.ddq[joint]];
            for (signal, (middle, bound)) in signals.into_iter().zip(self.bounds(joint)) {
                let most = signal
                    .iter()
                    .map(|x| (x - middle).abs())
                    .fold(0.0, f64::max);
                least = lesser(least, 1.0 - most / bound);
            }
        }
        for (clearance, reserve) in self.clearances.iter().zip(&self.reserve) {
            each_slack(
                &**clearance,
                clearance.function(),
                motion,
                &mut |_, slack| {
                    least = lesser(least, slack - reserve);
                },
            );
        }
        least
    }

    /// The longest part of `step`, at most all of it, that linear limits allow.
    pub(super) fn room(&self, motion: &Kinematics, step: &Kinematics) -> f64 {
        let mut room = f64::INFINITY;
        for joint in 0..self.weights.len() {
            let signals = [
                (&motion.q[joint], &step.q[joint]),
                (&motion.dq[joint], &step.dq[joint]),
                (&motion.ddq[joint], &step.ddq[joint]),
            ];
            for ((now, step), (middle, bound)) in signals.into_iter().zip(self.bounds(joint)) {
                for (x, d) in now.iter().zip(step) {
                    let left = bound - (x - middle) * d.signum();
                    if *d != 0.0 {
                        room = room.min(left / d.abs());
                    }
                }
            }
        }
        room
    }

    /// The information matrix, and the rows of each joint.
    fn information(&self, values: &[Vec<f64>]) -> (Mat<f64>, Vec<Rows>) {
        let n = self.regressor.columns.len();
        let scale = 1.0 / (self.samples as f64).sqrt();
        let mut a = Mat::zeros(n, n);
        let mut rows = Vec::new();
        for joint in 0..self.weights.len() {
            let outputs: Vec<usize> = (0..values.len())
                .filter(|&k| self.regressor.entries[k].0 == joint)
                .collect();
            let weight = self.weights[joint] * scale;
            let block = Mat::from_fn(self.samples, outputs.len(), |s, k| {
                weight * values[outputs[k]][s]
            });
            let gram = block.transpose() * &block;
            let columns: Vec<usize> = outputs
                .iter()
                .map(|&k| self.regressor.entries[k].1)
                .collect();
            for (i, &p) in columns.iter().enumerate() {
                for (k, &q) in columns.iter().enumerate() {
                    a[(p, q)] += gram[(i, k)];
                }
            }
            rows.push((outputs, block));
        }
        (a, rows)
    }

    /// The information matrix of a motion, with friction that jumps.
    pub(super) fn information_of(&self, motion: &Kinematics) -> Mat<f64> {
        let values = self.regressor.exact.values(motion);
        self.information(&values).0
    }

    /// Whether the criterion has a value at some variables.
    pub(super) fn has_a_value(&self, z: &[f64]) -> bool {
        let values = self.regressor.function.values(&self.motion(z));
        let (a, _) = self.information(&values);
        let counted = self.basis.map(|basis| basis.information(&a));
        let counted = counted.as_ref().unwrap_or(&a);
        let valued = self
            .criterion
            .evaluate(counted, self.scaling, Sharpness(1.0));
        valued.is_some_and(|valued| valued.value.is_finite())
    }

    /// Value and slopes; `None` beyond a limit, and where the motion excites too little for a value.
    pub(super) fn evaluate(&self, z: &[f64], stage: Stage) -> Option<Point> {
        let motion = self.motion(z);
        let mut point = self.linear_barrier(z, &motion, stage.barrier)?;
        let values = self.regressor.function.values(&motion);
        let (a, rows) = self.information(&values);
        let valued = match self.basis {
            _ if self.warms_up => of_seen_columns(&a, stage.sharpness)?,
            None => self.criterion.evaluate(&a, self.scaling, stage.sharpness)?,
            Some(basis) => {
                let counted = basis.information(&a);
                let valued = self
                    .criterion
                    .evaluate(&counted, self.scaling, stage.sharpness)?;
                Valued {
                    slopes: basis.pullback(&valued.slopes),
                    ..valued
                }
            }
        };
        // d value = tr(slopes dA) = 2 sum over rows of (Y slopes) . dY
        let mut weights = vec![Vec::new(); values.len()];
        let scale = 1.0 / (self.samples as f64).sqrt();
        for (joint, (outputs, block)) in rows.iter().enumerate() {
            let column = |k: usize| self.regressor.entries[outputs[k]].1;
            let part = Mat::from_fn(outputs.len(), outputs.len(), |i, k| {
                valued.slopes[(column(i), column(k))]
            });
            let product = block * part;
            let weight = 2.0 * self.weights[joint] * scale;
            for (k, &output) in outputs.iter().enumerate() {
                weights[output] = product.col(k).iter().map(|x| weight * x).collect();
            }
        }
        let mut slopes = self.regressor.function.pullback(&motion, &weights);
        point.smooth = valued.value;
        for (clearance, reserve) in self.clearances.iter().zip(&self.reserve) {
            let barrier = barrier(
                &**clearance,
                *reserve,
                &motion,
                stage.barrier / self.samples as f64,
            )?;
            point.smooth += barrier.0;
            add(&mut slopes, &barrier.1);
        }
        point.smooth_slopes = self.by_variables(&slopes);
        Some(point)
    }

    /// Slopes by the variables, of slopes by the motion.
    fn by_variables(&self, slopes: &Kinematics) -> Vec<f64> {
        let orders = [&slopes.q, &slopes.dq, &slopes.ddq];
        let mut by = vec![0.0; self.len()];
        for (joint, range) in self.parts() {
            for (order, slopes) in orders.iter().enumerate() {
                let wave = &self.waves[order][joint].0;
                for (k, by) in by[range.clone()].iter_mut().enumerate() {
                    let column = wave.col(k).iter().zip(&slopes[joint]);
                    *by += column.map(|(wave, slope)| wave * slope).sum::<f64>();
                }
            }
        }
        by
    }

    /// `-barrier * mean of ln(slack)` over the instants and linear limits.
    fn linear_barrier(&self, z: &[f64], motion: &Kinematics, barrier: f64) -> Option<Point> {
        let mut point = Point {
            smooth: 0.0,
            smooth_slopes: Vec::new(),
            barrier: 0.0,
            barrier_slopes: vec![0.0; z.len()],
            barrier_curvature: Vec::new(),
        };
        let weight = barrier / self.samples as f64;
        for (joint, range) in self.parts() {
            let count = range.len();
            let mut curvature = Mat::zeros(count, count);
            let signals = [&motion.q[joint], &motion.dq[joint], &motion.ddq[joint]];
            for (order, (middle, bound)) in self.bounds(joint).into_iter().enumerate() {
                if bound.is_infinite() {
                    continue;
                }
                let wave = &self.waves[order][joint].0;
                let mut bent = Mat::zeros(self.samples, count);
                for (s, x) in signals[order].iter().enumerate() {
                    let x = (x - middle) / bound;
                    let slack = 1.0 - x * x;
                    if slack.is_nan() || slack <= 0.0 {
                        return None;
                    }
                    point.barrier -= weight * slack.ln();
                    // d -ln(1 - x^2) = 2 x / (1 - x^2), d^2 = 2 (1 + x^2) / (1 - x^2)^2
                    let slope = weight * 2.0 * x / (slack * bound);
                    let root = (weight * 2.0 * (1.0 + x * x)).sqrt() / (slack * bound);
                    for k in 0..count {
                        let wave = wave[(s, k)];
                        point.barrier_slopes[range.start + k] += slope * wave;
                        bent[(s, k)] = root * wave;
                    }
                }
                curvature += bent.transpose() * &bent;
            }
            point.barrier_curvature.push(curvature);
        }
        Some(point)
    }
}

/// The determinant of the columns that a motion sees.
fn of_seen_columns(a: &Mat<f64>, sharpness: Sharpness) -> Option<Valued> {
    let n = a.nrows();
    let seen: Vec<usize> = (0..n).filter(|&k| a[(k, k)] > 0.0).collect();
    let part = Mat::from_fn(seen.len(), seen.len(), |i, k| a[(seen[i], seen[k])]);
    let Valued { value, slopes } = Criterion::DOptimal.evaluate(&part, Scaling::Raw, sharpness)?;
    let mut all = Mat::zeros(n, n);
    for (i, &p) in seen.iter().enumerate() {
        for (k, &q) in seen.iter().enumerate() {
            all[(p, q)] = slopes[(i, k)];
        }
    }
    Some(Valued { value, slopes: all })
}
