//! Bristles from pre-sliding: how far a joint gives before it slides.
//!
//! While the torque rises in one direction from rest the bristles' deflection is `dz = (1 - f / F_s) dq` with the friction torque `f`
//! (`LuGre` at speeds far below Stribeck's), and `f = s0 z + s1 dz/dt`. The deflection is summed from differences of the positions with
//! their sign, so that noise of the encoder cancels from sample to sample instead of piling up as it does in `|dq|`.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::rows::{Measured, standing};
use super::stretch::{encoder_step, ends};
use super::{Curve, FrictionError, Law, Value};
use crate::identify::long_run_sum;
use crate::log::Log;
use crate::motion::Motion;
use crate::signal::resample::whole_steps;
use crate::signal::{Bands, LowPass, MOTION_ORDER, derivative, prepare};

/// Shares of the breakaway torque between which the bristles are looked at: nearer to it `1 - f / F_s` is mostly the error of `F_s`.
const FROM: f64 = 0.1;
const TO: f64 = 0.8;

/// The least share that the friction torque has to reach.
const REACHED: f64 = 0.5;

/// A joint slides that is faster than this share of the least speed of the curve.
const SLIDES: f64 = 0.5;

/// Over which time, s, and beyond so many steps of the encoder.
const WINDOW_S: f64 = 0.1;
const STILL_STEPS: f64 = 2.0;

/// Samples that a fit has at least.
const LEAST_SAMPLES: usize = 20;

/// Other joints stand where they did, rad or m.
const POSE: f64 = 0.02;

/// Deviations by which a damping is told from none.
const TOLD: f64 = 5.0;

/// Steps of the encoder that the deflection at sliding has to be.
const LEAST_STEPS: f64 = 5.0;

/// What surfaces in contact give by at most before they slide, rad or m: some hundred times what is published of joints.
const MOST_DEFLECTION: f64 = 0.1;

/// Bristles of a joint: stiffness and, where the log tells it, damping of the `LuGre` model.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Bristles {
    /// `s0`, N m/rad or N/m.
    pub stiffness: Value,
    /// `s1`, N m s/rad or N s/m; `None` where the rate of the deflection varies too little to tell it.
    pub damping: Option<Value>,
    /// Friction torque at which the joint broke away in the log, or its largest there, N m or N.
    pub reached: f64,
    /// Deflection at which the bristles slide, `F_c / s0`, rad or m.
    pub deflection: Value,
    /// Step of the encoder, rad or m: the smallest difference of two positions.
    pub encoder_step: f64,
    /// Seconds of the log that were looked at, from its start.
    pub seconds: Range<f64>,
}

/// Pre-sliding in one direction, positive ways.
struct Loading {
    /// Friction torque.
    torque: Vec<f64>,
    /// Position since the first sample.
    way: Vec<f64>,
    step: f64,
}

/// Coefficients of a fit with their deviations.
struct Line {
    values: Vec<Value>,
}

impl Bristles {
    /// Whether the encoder tells the deflection: five of its steps or more until the bristles slide.
    ///
    /// # Examples
    /// ```
    /// # mod motor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/motor.rs")); }
    /// let bristles = motor::bristles()?; // of 100 N m/rad, with 0.5 N m of sliding friction
    /// // 5 mrad are many steps of this encoder.
    /// assert!(bristles.is_resolved() && bristles.encoder_step < 1e-4);
    /// # Ok::<(), robot_model::friction_curve::FrictionError>(())
    /// ```
    #[must_use]
    pub fn is_resolved(&self) -> bool {
        self.deflection.value >= LEAST_STEPS * self.encoder_step
    }

    /// Whether the deflection at sliding is one that surfaces in contact have, up to 0.1 rad or m. What gives by more is a spring, a gear's
    /// play, or torques in another unit than positions.
    ///
    /// # Examples
    /// ```
    /// # mod motor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/motor.rs")); }
    /// let bristles = motor::bristles()?; // of 100 N m/rad, with 0.5 N m of sliding friction
    /// assert!(bristles.is_of_contact() && (bristles.deflection.value - 0.005).abs() < 2e-4);
    /// # Ok::<(), robot_model::friction_curve::FrictionError>(())
    /// ```
    #[must_use]
    pub fn is_of_contact(&self) -> bool {
        self.deflection.value <= MOST_DEFLECTION
    }

    /// The largest stiffness that the encoder would tell, N m/rad or N/m; infinite where it has no steps.
    ///
    /// # Examples
    /// ```
    /// # mod motor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/motor.rs")); }
    /// let bristles = motor::bristles()?; // of 100 N m/rad, with 0.5 N m of sliding friction
    /// // 0.5 N m over five steps of the encoder
    /// let least = 5.0 * bristles.encoder_step;
    /// assert!((bristles.most_stiffness() * least - 0.5).abs() < 1e-3);
    /// # Ok::<(), robot_model::friction_curve::FrictionError>(())
    /// ```
    #[must_use]
    pub fn most_stiffness(&self) -> f64 {
        let sliding = self.deflection.value * self.stiffness.value;
        sliding / (LEAST_STEPS * self.encoder_step)
    }
}

impl Measured<'_> {
    /// The bristles, from a log in which the torque rises slowly from rest until the joint breaks away. `curve` and `law` are of the same
    /// joint.
    ///
    /// # Errors
    /// [`FrictionError`]: no rest at the start, a torque that does not rise far enough, positions that do not follow it, other joints
    /// that stand elsewhere.
    ///
    /// # Examples
    /// ```
    /// # mod motor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/motor.rs")); }
    /// use robot_model::friction_curve::Law;
    /// let motor = motor::motor();
    /// let measured = motor::measured(&motor);
    /// let curve = measured.curve(&[motor::runs()])?;
    /// let bristles = measured.bristles(&curve, &Law::fit(&curve)?, &motor::loading())?;
    /// assert!((bristles.stiffness.value - 100.0).abs() < 3.0); // N m/rad
    /// # Ok::<(), robot_model::friction_curve::FrictionError>(())
    /// ```
    pub fn bristles(&self, curve: &Curve, law: &Law, log: &Log) -> Result<Bristles, FrictionError> {
        let source_name = || log.source.clone();
        let bands = Bands::for_log(log);
        let prepared = prepare(log, &bands)?;
        let motion = standing(&prepared, 0..prepared.motion.time.len(), self.joint);
        if self.known.is_none() {
            self.check_pose(curve, log)?;
        }
        let friction = self.friction(&motion, curve, law);
        let filter = LowPass::butterworth(MOTION_ORDER, bands.smooth_hz, prepared.rate_hz)?;
        let mut torque = Vec::new();
        filter.apply(&friction, &mut torque);

        let slow = curve.points.iter().map(|point| point.speed.abs());
        let slides = SLIDES * slow.fold(f64::INFINITY, f64::min);
        let q = &motion.smooth.q[self.joint];
        let encoder_step = encoder_step(&log.q[self.joint]);
        // A step of the encoder alone is no motion.
        let window = whole_steps((WINDOW_S * prepared.rate_hz).ceil());
        let far = slides * WINDOW_S + STILL_STEPS * encoder_step;
        let later = q.iter().zip(q.iter().skip(window));
        let slide = later
            .enumerate()
            .find(|(_, (q, later))| (*later - *q).abs() > far)
            .map(|(k, _)| k);
        let rest = &torque[..slide.unwrap_or(torque.len())];
        if rest.len() < LEAST_SAMPLES {
            return Err(FrictionError::NoRest {
                source_name: source_name(),
            });
        }
        let (least, most) = ends(rest);
        let way = if most >= -least { 1.0 } else { -1.0 };
        let reached = most.max(-least);
        let breakaway = law.breakaway;
        let part = loading(rest, way, breakaway.value);
        let Some(part) =
            part.filter(|part| reached >= REACHED * breakaway.value && part.len() >= LEAST_SAMPLES)
        else {
            return Err(FrictionError::NoRise {
                source_name: source_name(),
                reached,
                breakaway: breakaway.value,
            });
        };
        let loading = Loading {
            torque: torque[part.clone()].iter().map(|f| way * f).collect(),
            way: q[part.clone()]
                .iter()
                .map(|x| way * (x - q[part.start]))
                .collect(),
            step: 1.0 / prepared.rate_hz,
        };
        let found = loading.bristles(breakaway);
        let (stiffness, damping) = found.ok_or_else(|| FrictionError::NoDeflection {
            source_name: source_name(),
            step: encoder_step,
        })?;
        let deflection = law.coulomb.value / stiffness.value;
        let shares = [
            law.coulomb.std / law.coulomb.value,
            stiffness.std / stiffness.value,
        ];
        Ok(Bristles {
            stiffness,
            damping,
            reached,
            deflection: Value {
                value: deflection,
                std: deflection.abs() * shares[0].hypot(shares[1]),
            },
            encoder_step,
            seconds: motion.time[part.start]..motion.time[part.end - 1],
        })
    }

    /// Friction torque of a motion that is as good as rest: what gravity and the offset leave.
    fn friction(&self, motion: &Motion, curve: &Curve, law: &Law) -> Vec<f64> {
        let mut resting = motion.clone();
        for band in [&mut resting.smooth, &mut resting.wide] {
            band.dq[self.joint].fill(0.0);
            band.ddq[self.joint].fill(0.0);
        }
        let along = self.along(&resting);
        let mut friction = along.torque;
        for &(column, value) in &curve.beside {
            let Ok(place) = self.columns.binary_search(&column) else {
                continue;
            };
            let pairs = friction.iter_mut().zip(&along.columns[place]);
            pairs.for_each(|(f, x)| *f -= value * x);
        }
        let offset = law.constant();
        friction.into_iter().map(|f| f - offset).collect()
    }

    /// Whether joints stand where gravity is known from the curve.
    fn check_pose(&self, curve: &Curve, log: &Log) -> Result<(), FrictionError> {
        for (joint, &(low, high)) in curve.range.iter().enumerate() {
            let (least, most) = ends(&log.q[joint]);
            let is_there = least > low - POSE && most < high + POSE;
            // A constant of gravity is that of where the joint was.
            let matters = joint != self.joint || curve.has_constant;
            if matters && !is_there {
                return Err(FrictionError::OtherPose {
                    source_name: log.source.clone(),
                    joint: self.arm.joints()[joint].clone(),
                });
            }
        }
        Ok(())
    }
}

/// The samples in which the torque rises, from its last small value to where it is near breakaway, or to its largest.
fn loading(torque: &[f64], way: f64, breakaway: f64) -> Option<Range<usize>> {
    let forward = |f: &f64| way * f;
    let high = torque.iter().position(|f| forward(f) >= TO * breakaway);
    let largest = torque
        .iter()
        .enumerate()
        .max_by(|one, other| forward(one.1).total_cmp(&forward(other.1)));
    let end = high.or(largest.map(|(k, _)| k))?;
    let low = torque[..end]
        .iter()
        .rposition(|f| forward(f) <= FROM * breakaway);
    Some(low.map_or(0, |low| low + 1)..end + 1)
}

impl Loading {
    /// Deflection of the bristles since the first sample.
    fn deflection(&self, breakaway: f64) -> Vec<f64> {
        let mut z = vec![0.0];
        let pairs = self.torque.windows(2).zip(self.way.windows(2));
        for (k, (f, x)) in pairs.enumerate() {
            let share = 1.0 - 0.5 * (f[0] + f[1]) / breakaway;
            z.push(z[k] + share * (x[1] - x[0]));
        }
        z
    }

    /// Stiffness and damping; `None` where torque and deflection do not rise together.
    fn bristles(&self, breakaway: Value) -> Option<(Value, Option<Value>)> {
        let z = self.deflection(breakaway.value);
        let stiffness = Line::fit(&self.torque, &[&z])?.values[0];
        let other = self.deflection(breakaway.value + breakaway.std);
        let moved = Line::fit(&self.torque, &[&other])?.values[0].value - stiffness.value;
        let stiffness = Value {
            std: stiffness.std.hypot(moved),
            ..stiffness
        };
        if stiffness.value.is_nan() || stiffness.value <= 2.0 * stiffness.std {
            return None;
        }
        let (mut rate, mut speed, mut acceleration) = (Vec::new(), Vec::new(), Vec::new());
        derivative(&z, self.step, &mut rate);
        derivative(&self.way, self.step, &mut speed);
        derivative(&speed, self.step, &mut acceleration);
        // Inertia is in the torque too, and no parameter of it is known here.
        let both = Line::fit(&self.torque, &[&z, &rate, &acceleration]);
        let damping = both.map(|both| both.values[1]);
        let damping = damping.filter(|damping| damping.value > TOLD * damping.std);
        Some((stiffness, damping))
    }
}

impl Line {
    /// `target = sum value column + constant` by least squares, with deviations of correlated errors.
    fn fit(target: &[f64], columns: &[&Vec<f64>]) -> Option<Self> {
        let (n, count) = (target.len(), columns.len());
        let centered = |values: &[f64]| {
            let mean = values.iter().sum::<f64>() / n as f64;
            DVector::from_iterator(n, values.iter().map(|x| x - mean))
        };
        let design: Vec<DVector<f64>> = columns.iter().map(|column| centered(column)).collect();
        let lengths: Vec<f64> = design.iter().map(DVector::norm).collect();
        if lengths.contains(&0.0) {
            return None;
        }
        let design = DMatrix::from_fn(n, count, |row, c| design[c][row] / lengths[c]);
        let inverse = (design.transpose() * &design).try_inverse()?;
        let map = &design * inverse;
        let target = centered(target);
        let found = map.transpose() * &target;
        let rest = &target - &design * &found;
        let value = |c: usize| {
            let series: Vec<f64> = (0..n).map(|row| map[(row, c)] * rest[row]).collect();
            Value {
                value: found[c] / lengths[c],
                std: long_run_sum(&series).max(0.0).sqrt() / lengths[c],
            }
        };
        Some(Self {
            values: (0..count).map(value).collect(),
        })
    }
}

#[cfg(test)]
mod tests;
