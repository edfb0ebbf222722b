//! The static law through a friction curve.
//!
//! `f(v) = sign(v) (F_c + (F_s - F_c) exp(-(v/v_s)^2)) + s2 v + t0` is linear in all but `v_s`: that is looked for over a grid and then
//! between its neighbors, with the others solved for at every value (variable projection: Golub, Pereyra 1973). Whether there is a
//! fall at all is asked of chance: under the law without one `v_s` means nothing, so the F-statistic has no F-distribution, and is
//! compared with that of drawn noise, each draw with the best `v_s` of its own (Davies 1987).

mod columns;
mod fall;

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::stretch::SAME;
use super::{Curve, FrictionError, Point, Value};
use crate::identify::{golden, neighbors};

use columns::{left_inverse, orthonormal, with_column};

pub use fall::Fall;

/// Speeds that a law takes, and those that one with a fall takes.
const LEAST_SPEEDS: usize = 4;
const FALL_SPEEDS: usize = 5;

/// Values of `v_s` that are tried first, from half of the least speed to the largest.
const GRID: i32 = 40;

/// Draws of noise, and how rare a fall has to be among them.
const DRAWS: u32 = 9999;
const RARE: f64 = 1e-3;

/// A point counts for no more than one with this share of the median deviation.
const LEAST_STD: f64 = 0.3;

/// The static law of a joint's friction. Example: [`super::Measured`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Law {
    /// `F_c`, N m or N.
    pub coulomb: Value,
    /// `s2`, N m s/rad or N s/m.
    pub viscous: Value,
    /// `t0`, where both directions were measured: what is the same in both.
    pub offset: Option<Value>,
    /// The fall from `F_s` to `F_c`, where it is more than chance.
    pub fall: Option<Fall>,
    /// How probable a fall like the best one is by chance; none where there are too few speeds to ask.
    pub probability: Option<f64>,
    /// Largest and root mean square distance of the points, N m or N.
    pub distance: (f64, f64),
    /// How many of their deviations points are off, root mean square over the degrees of freedom: 1 where the law is theirs.
    pub misfit: f64,
    /// `F_s`, the torque at which the joint breaks away, as far as the law goes: `F_c` where there is no fall, N m or N.
    pub breakaway: Value,
    /// `F_s / F_c - 1`, 0 where there is no fall.
    pub rise: Value,
}

/// Points over their deviations.
struct Weighed {
    speeds: Vec<f64>,
    /// One over the deviation.
    weights: Vec<f64>,
    torque: DVector<f64>,
    /// Orthonormal columns of the law without a fall.
    plain: DMatrix<f64>,
    design: DMatrix<f64>,
}

impl Law {
    /// The law through a curve, with a fall where that is rarer by chance than one in a thousand.
    ///
    /// Deviations are those of the curve, larger where the points scatter more than these say.
    ///
    /// # Errors
    /// [`FrictionError::TooFewSpeeds`] of fewer than four speeds, [`FrictionError::SpeedsAlike`] where they do not tell the
    /// parameters apart.
    ///
    /// # Examples
    /// ```
    /// # mod motor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/motor.rs")); }
    /// use robot_model::friction_curve::Law;
    /// let motor = motor::motor();
    /// let law = Law::fit(&motor::measured(&motor).curve(&[motor::runs()])?)?;
    /// // 0.5 + 0.1 v, with no fall at low speeds.
    /// assert!((law.coulomb.value - 0.5).abs() < 1e-3 && law.fall.is_none());
    /// assert!((law.torque(2.0) - 0.7).abs() < 1e-3 && (law.torque(-2.0) + 0.7).abs() < 1e-3);
    /// # Ok::<(), robot_model::friction_curve::FrictionError>(())
    /// ```
    pub fn fit(curve: &Curve) -> Result<Self, FrictionError> {
        let found = speeds(&curve.points);
        let has_both = curve.points.iter().any(|point| point.speed < 0.0)
            && curve.points.iter().any(|point| point.speed > 0.0);
        if found < LEAST_SPEEDS {
            return Err(FrictionError::TooFewSpeeds {
                found,
                least: LEAST_SPEEDS,
            });
        }
        let weighed = Weighed::new(&curve.points, has_both)?;
        let unknowns = weighed.design.ncols() + 2;
        let mut speed = None;
        let mut probability = None;
        if found >= FALL_SPEEDS && curve.points.len() > unknowns {
            let best = weighed.best();
            let chance = weighed.chance(weighed.gain(best, &weighed.rest()));
            probability = Some(chance);
            speed = (chance <= RARE).then_some(best);
        }
        weighed.law(curve, speed, has_both, probability)
    }

    /// `f(v)`, N m or N; at rest `t0`.
    ///
    /// # Examples
    /// ```
    /// # mod motor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/motor.rs")); }
    /// let motor = motor::motor();
    /// let law = robot_model::friction_curve::Law::fit(&motor::measured(&motor).curve(&[motor::runs()])?)?;
    /// // 0.5 N m and 0.1 N m s/rad
    /// assert!((law.torque(4.0) - 0.9).abs() < 1e-3 && law.torque(0.0) == 0.0);
    /// # Ok::<(), robot_model::friction_curve::FrictionError>(())
    /// ```
    #[must_use]
    pub fn torque(&self, v: f64) -> f64 {
        let way = if v == 0.0 { 0.0 } else { v.signum() };
        let fall = self.fall.map_or(0.0, |fall| {
            fall.torque.value * (-(v / fall.speed.value).powi(2)).exp()
        });
        way * (self.coulomb.value + fall) + self.viscous.value * v + self.constant()
    }

    /// Whether velocities from differences of neighboring samples would tell the fall: a step of the encoder is below the Stribeck speed. True
    /// where there is no fall.
    ///
    /// # Examples
    /// ```
    /// # mod motor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/motor.rs")); }
    /// use robot_model::friction_curve::{Fall, Law, Value};
    /// let motor = motor::motor();
    /// let curve = motor::measured(&motor).curve(&[motor::runs()])?;
    /// let mut law = Law::fit(&curve)?;
    /// assert!(law.is_told_by_differences(&curve)); // there is no fall
    /// // One at speeds that are less than a step of the encoder from sample to sample.
    /// let told = |value| Value { value, std: 0.0 };
    /// law.fall = Some(Fall { torque: told(0.2), speed: told(0.5 * curve.speed_step) });
    /// assert!(!law.is_told_by_differences(&curve));
    /// # Ok::<(), robot_model::friction_curve::FrictionError>(())
    /// ```
    #[must_use]
    pub fn is_told_by_differences(&self, curve: &Curve) -> bool {
        self.fall
            .is_none_or(|fall| curve.speed_step < fall.speed.value)
    }

    /// `t0`; 0 where it is not told.
    pub(super) fn constant(&self) -> f64 {
        self.offset.map_or(0.0, |offset| offset.value)
    }
}

/// How many speeds there are, those of both directions counted once.
fn speeds(points: &[Point]) -> usize {
    let mut speeds: Vec<f64> = points.iter().map(|point| point.speed.abs()).collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup_by(|next, first| *next <= (1.0 + SAME) * *first);
    speeds.len()
}

/// `sign(v) exp(-(v/v_s)^2)`
fn falling(v: f64, speed: f64) -> f64 {
    v.signum() * (-(v / speed).powi(2)).exp()
}

impl Weighed {
    fn new(points: &[Point], has_both: bool) -> Result<Self, FrictionError> {
        let mut std: Vec<f64> = points.iter().map(|point| point.torque.std).collect();
        std.sort_by(f64::total_cmp);
        let most = points.iter().map(|point| point.torque.value.abs());
        let rounding = 1e-9 * most.fold(f64::MIN_POSITIVE, f64::max);
        let least = (LEAST_STD * std[std.len() / 2]).max(rounding);
        let weights = points.iter().map(|point| 1.0 / point.torque.std.max(least));
        let weights: Vec<f64> = weights.collect();
        let count = if has_both { 3 } else { 2 };
        let design = DMatrix::from_fn(points.len(), count, |row, column| {
            let v = points[row].speed;
            weights[row] * [v.signum(), v, 1.0][column]
        });
        let torque = DVector::from_fn(points.len(), |row, _| {
            weights[row] * points[row].torque.value
        });
        Ok(Self {
            speeds: points.iter().map(|point| point.speed).collect(),
            weights,
            torque,
            plain: orthonormal(&design).ok_or(FrictionError::SpeedsAlike)?,
            design,
        })
    }

    /// What the law without a fall leaves of values.
    fn without(&self, values: DVector<f64>) -> DVector<f64> {
        let fitted = &self.plain * (self.plain.transpose() * &values);
        values - fitted
    }

    fn rest(&self) -> DVector<f64> {
        self.without(self.torque.clone())
    }

    /// The column of a fall at a Stribeck speed beside the law without one, of unit length; `None` where nothing is left of it.
    fn column(&self, speed: f64) -> Option<DVector<f64>> {
        let column = self.speeds.iter().zip(&self.weights);
        let column = column.map(|(v, weight)| weight * falling(*v, speed));
        let column = DVector::from_vec(column.collect());
        let length = column.norm();
        let rest = self.without(column);
        let left = rest.norm();
        (left > columns::APART * length).then(|| rest / left)
    }

    /// By which share a fall at a Stribeck speed makes the sum of squares of `rest` less; a rise is none.
    fn gain(&self, speed: f64, rest: &DVector<f64>) -> f64 {
        let along = self.column(speed).map_or(0.0, |column| column.dot(rest));
        (along.max(0.0) / rest.norm().max(f64::MIN_POSITIVE)).powi(2)
    }

    fn grid(&self) -> Vec<f64> {
        let speeds = self.speeds.iter().map(|v| v.abs());
        let (least, most) = speeds.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), v| {
            (least.min(v), most.max(v))
        });
        let least = 0.5 * least;
        let share = |k| f64::from(k) / f64::from(GRID - 1);
        (0..GRID)
            .map(|k| least * (most / least).powf(share(k)))
            .collect()
    }

    /// The best Stribeck speed.
    fn best(&self) -> f64 {
        let rest = self.rest();
        let mut cost = |speed: f64| Ok::<_, std::convert::Infallible>(-self.gain(speed, &rest));
        let grid = self.grid();
        let best = grid
            .iter()
            .copied()
            .map(|speed| (self.gain(speed, &rest), speed));
        let best = best.fold(
            (-1.0, grid[0]),
            |best, next| {
                if next.0 > best.0 { next } else { best }
            },
        );
        let (mut low, mut high) = neighbors(&grid, best.1);
        let mut found = best.1;
        // Each pass narrows the interval a hundred times.
        for _ in 0..2 {
            let Ok(speed) = golden(low, high, &mut cost);
            found = speed;
            let width = 0.02 * (high - low);
            (low, high) = ((speed - width).max(low), (speed + width).min(high));
        }
        if self.gain(found, &rest) > best.0 {
            found
        } else {
            best.1
        }
    }

    /// How often drawn noise gains as much.
    fn chance(&self, gain: f64) -> f64 {
        let columns = self
            .grid()
            .into_iter()
            .filter_map(|speed| self.column(speed));
        let columns: Vec<DVector<f64>> = columns.collect();
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut as_good = 0_u32;
        for _ in 0..DRAWS {
            let noise =
                DVector::from_fn(self.speeds.len(), |_, _| StandardNormal.sample(&mut random));
            let rest = self.without(noise);
            let along = columns.iter().map(|column| column.dot(&rest));
            let most = along.fold(0.0, f64::max);
            as_good += u32::from(most * most >= gain * rest.norm_squared());
        }
        f64::from(as_good + 1) / f64::from(DRAWS + 1)
    }

    /// The law with a fall at a Stribeck speed, or without one.
    fn law(
        &self,
        curve: &Curve,
        speed: Option<f64>,
        has_both: bool,
        probability: Option<f64>,
    ) -> Result<Law, FrictionError> {
        let n = self.speeds.len();
        let mut design = self.design.clone();
        if let Some(speed) = speed {
            let column = |row: usize| self.weights[row] * falling(self.speeds[row], speed);
            design = with_column(design, column);
        }
        let map = left_inverse(&design).ok_or(FrictionError::SpeedsAlike)?;
        let values = &map * &self.torque;
        let rest = &self.torque - &design * &values;
        let fall = speed.map(|speed| (values[values.len() - 1], speed));
        if let Some((fall, speed)) = fall {
            // Slopes by the Stribeck speed.
            let slope = |row: usize| {
                let v = self.speeds[row];
                self.weights[row] * fall * falling(v, speed) * 2.0 * v * v / speed.powi(3)
            };
            design = with_column(design, slope);
        }
        let map = left_inverse(&design).ok_or(FrictionError::SpeedsAlike)?;
        let freedom = n.saturating_sub(design.ncols()).max(1) as f64;
        let misfit = (rest.norm_squared() / freedom).sqrt();
        // Of a sum of the parameters, from the points themselves.
        let std = |parts: &[(usize, f64)]| {
            let moved = |k: usize| {
                let parts = parts.iter();
                let sum: f64 = parts.map(|&(row, part)| part * map[(row, k)]).sum();
                sum * self.weights[k]
            };
            misfit.max(1.0) * curve.deviation(moved)
        };
        let value = |k: usize, value: f64| Value {
            value,
            std: std(&[(k, 1.0)]),
        };
        let last = design.ncols() - 1;
        let coulomb = value(0, values[0]);
        let nothing = Value {
            value: 0.0,
            std: 0.0,
        };
        let (breakaway, rise) = match fall {
            None => (coulomb, nothing),
            Some((fall, _)) => {
                let above = last - 1;
                let slopes = [(0, -fall / values[0].powi(2)), (above, 1.0 / values[0])];
                let breakaway = Value {
                    value: values[0] + fall,
                    std: std(&[(0, 1.0), (above, 1.0)]),
                };
                let rise = Value {
                    value: fall / values[0],
                    std: std(&slopes),
                };
                (breakaway, rise)
            }
        };
        let distances = rest.iter().zip(&self.weights).map(|(r, w)| (r / w).abs());
        let distances = DVector::from_vec(distances.collect());
        Ok(Law {
            coulomb,
            viscous: value(1, values[1]),
            offset: has_both.then(|| value(2, values[2])),
            fall: fall.map(|(torque, speed)| Fall {
                torque: value(last - 1, torque),
                speed: value(last, speed),
            }),
            breakaway,
            rise,
            probability,
            distance: (distances.max(), distances.norm() / (n as f64).sqrt()),
            misfit,
        })
    }
}

#[cfg(test)]
mod tests;
