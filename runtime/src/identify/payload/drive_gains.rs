//! Drive gains from a payload that is known.
//!
//! A drive logs `v_j = tau_j / g_j`, and of its gain `g_j` a data sheet says little. Logs of one arm tell only ratios of gains, and its
//! parameters times a factor; a payload whose mass is known, in some of the logs, tells the factor. With `f = W beta` without it and
//! `f = W (beta + K pi)` with it, of which a part `k` is known,
//!
//! `minimize sum_j || v_j - f_j(beta, pi) / g_j ||^2 / sigma_j^2`
//!
//! by Gauss and Newton's steps: each is the least squares of an [`Identify`], weights and deviations with it. Errors stand with what the
//! drives logged, so noise makes no gain smaller. They start from the solution of `g_j v_j = f_j` with each `v_j` replaced by its fit with
//! that joint's own columns, which is exact without noise; a gain that this does not tell is not told.
//!
//! Source: Gautier, Briot 2014, Global identification of joint drive gains and dynamic parameters of robots, who solve `g_j v_j = f_j` for
//! all joints at once by total least squares.

use super::gain_rows::Rows;
use super::{Both, Carried, Shares};
use crate::columns::Arm;
use crate::identify::{
    Estimate, Identify, IdentifyError, Solution, Stack, check_logs, shapes, slowest_bands,
};
use crate::log::Log;
use crate::signal::Bands;

/// Most steps of a search, and the relative change of a gain at which it has settled.
const STEPS: usize = 40;
const SETTLED: f64 = 1e-9;

/// Most times that filters, shapes and the load follow the gains, and the share of a deviation at which they have settled.
const ROUNDS: usize = 8;
const SETTLED_STD: f64 = 1e-2;

/// What a scale and a ruler say of a payload.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownPayload {
    /// kg.
    pub mass: f64,
    /// Center of mass in the frame of the link that carries it, m.
    pub center: Option<[f64; 3]>,
}

/// Torque per unit of what a drive logs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct DriveGain {
    /// N m or N per unit of the log's channel: the `actuator_gain` of the spec.
    pub value: f64,
    /// Its standard deviation; the payload is taken as exact.
    pub std: f64,
}

/// Gains of the drives, and the arm and its payload with them.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Driven {
    /// One a joint; none where the logs do not tell it.
    pub gains: Vec<Option<DriveGain>>,
    /// Of torques with these gains, and where there is none of the arm's own. The payload's parameters are those that were not known.
    pub carried: Carried,
    /// By what each joint's torques of the spec's gains are to be multiplied.
    factors: Vec<f64>,
}

impl Driven {
    /// A log whose torques are those of the gains, for [`Estimate::errors`] with the same arm.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure_with, pendulum};
    /// # use robot_model::identify::{Identify, KnownPayload};
    /// // A drive that logs half of each N m, and a payload of 1 kg in a distance of 1 m (where `g` is 1).
    /// let half = |parameters| {
    ///     let mut log = measure_with(parameters, 0.0);
    ///     log.tau[0].iter_mut().for_each(|tau| *tau *= 0.5);
    ///     log
    /// };
    /// let (alone, loaded) = (half([2.0, 9.0, 1.0]), half([3.0, 10.0, 1.0]));
    /// let known = KnownPayload { mass: 1.0, center: Some([1.0, 0.0, 0.0]) };
    /// let driven = Identify::default().fit_drive_gains(&pendulum(), &[alone.clone()], &[loaded], None, &known)?;
    /// let torque = measure_with([2.0, 9.0, 1.0], 0.0).tau[0][500];
    /// assert!((driven.rescaled(&alone).tau[0][500] / torque - 1.0).abs() < 0.03);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn rescaled(&self, log: &Log) -> Log {
        rescaled(log, &self.factors)
    }
}

fn rescaled(log: &Log, factors: &[f64]) -> Log {
    let mut log = log.clone();
    for (values, factor) in log.tau.iter_mut().zip(factors) {
        for value in values {
            *value *= factor;
        }
    }
    log
}

/// A fit for given shapes and bands, its gains relative to those of the logs.
struct Round {
    gains: Vec<Option<DriveGain>>,
    solution: Solution,
    linear: Stack,
}

/// What is looked for, and where.
struct Search<'a> {
    identify: &'a Identify,
    arm: &'a dyn Arm,
    shares: Shares,
    /// What is known of the payload, in base parameters.
    base: Vec<f64>,
}

impl Identify {
    /// Identifies the gains of an arm's drives, its parameters and what is not known of a payload, from logs without and with the
    /// payload on `link`, without a name the last one. Without a center of mass the mass alone has to show in torques.
    ///
    /// # Errors
    /// Those of [`Self::fit_payload`]; [`IdentifyError::PayloadMass`], [`IdentifyError::PayloadHidden`] where no gain is told,
    /// [`IdentifyError::PayloadLost`].
    ///
    /// # Examples
    /// A drive that logs a current, 0.4 of each N m, and a payload of 1 kg in a distance of 1 m (where `g` is 1):
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure_with, pendulum};
    /// # use robot_model::identify::{Identify, KnownPayload};
    /// let current = |parameters: [f64; 3]| {
    ///     let mut log = measure_with(parameters, 0.0);
    ///     log.tau[0].iter_mut().for_each(|tau| *tau *= 0.4);
    ///     log
    /// };
    /// let (alone, loaded) = (current([2.0, 9.0, 1.0]), current([3.0, 10.0, 1.0]));
    /// let known = KnownPayload { mass: 1.0, center: Some([1.0, 0.0, 0.0]) };
    /// let arm = pendulum();
    /// let driven = Identify::default().fit_drive_gains(&arm, &[alone.clone()], &[loaded], None, &known)?;
    /// let gain = driven.gains[0].expect("the payload is seen").value;
    /// assert!((gain - 1.0 / 0.4).abs() < 0.05);
    /// let torque = driven.rescaled(&alone).tau[0][500];
    /// assert!((torque - gain * alone.tau[0][500]).abs() < 1e-9);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn fit_drive_gains(
        &self,
        arm: &dyn Arm,
        unloaded: &[Log],
        loaded: &[Log],
        link: Option<&str>,
        known: &KnownPayload,
    ) -> Result<Driven, IdentifyError> {
        self.check_method()?;
        check_logs(arm, unloaded)?;
        check_logs(arm, loaded)?;
        if !(known.mass > 0.0 && known.mass.is_finite()) {
            return Err(IdentifyError::PayloadMass { mass: known.mass });
        }
        let mut shares = Shares::of(arm, link)?;
        let base = shares.take_known(known);
        let search = Search {
            identify: self,
            arm,
            shares,
            base,
        };
        search.run(unloaded, loaded)
    }
}

impl Search<'_> {
    fn run(self, unloaded: &[Log], loaded: &[Log]) -> Result<Driven, IdentifyError> {
        let all = [unloaded, loaded].concat();
        let mut factors = vec![1.0; self.arm.dof()];
        let wide = Bands {
            smooth_hz: slowest_bands(&all).wide_hz,
            ..slowest_bands(&all)
        };
        let bands = self.identify.bands.unwrap_or(wide);
        let first = self.round(unloaded, loaded, &bands, &shapes::middle(self.arm))?;
        follow(&mut factors, &first.gains);
        for _ in 0..ROUNDS {
            // With gains that fit together, logs show what filters and shapes they want.
            let scale = |logs: &[Log]| -> Vec<Log> {
                let logs = logs.iter();
                logs.map(|log| rescaled(log, &factors)).collect()
            };
            let (without, with) = (scale(unloaded), scale(loaded));
            let bands = self.identify.bands_of_both(self.arm, &without, &with)?;
            let own = Identify {
                bands: Some(bands),
                bootstrap: 0,
                essential: false,
                ..self.identify.clone()
            };
            let alone = own.fit(self.arm, &without)?;
            let shapes: Vec<f64> = alone.shapes.iter().map(|(_, value)| *value).collect();
            let round = self.round(&without, &with, &bands, &shapes)?;
            let settled = round
                .gains
                .iter()
                .flatten()
                .all(|gain| (gain.value - 1.0).abs() <= (SETTLED_STD * gain.std).max(SETTLED));
            if settled {
                return Ok(self.driven(alone, &round, factors));
            }
            follow(&mut factors, &round.gains);
        }
        Err(IdentifyError::PayloadLost)
    }

    /// What the last round found; `alone` is the arm's estimate of its bands and shapes.
    fn driven(self, alone: Estimate, round: &Round, mut factors: Vec<f64>) -> Driven {
        let own = self.arm.actuator_gain();
        let pairs = round.gains.iter().zip(own.iter().zip(&factors));
        let gains = pairs.map(|(gain, (own, factor))| {
            gain.map(|gain| DriveGain {
                value: own * factor * gain.value,
                std: (own * factor).abs() * gain.std,
            })
        });
        let gains = gains.collect();
        follow(&mut factors, &round.gains);
        Driven {
            gains,
            carried: Carried::of(
                self.identify,
                self.arm,
                &self.shares,
                &round.linear,
                &round.solution,
                alone,
                self.loaded(&round.solution.estimate[..self.unknowns()]),
            ),
            factors,
        }
    }

    /// The arm's unknowns and the payload's.
    fn unknowns(&self) -> usize {
        self.shares.coefficients.len() + self.shares.unknowns.len()
    }

    /// The arm's unknowns with the payload in them.
    fn loaded(&self, values: &[f64]) -> Vec<f64> {
        let found = self.shares.loaded(values);
        found.iter().zip(&self.base).map(|(x, k)| x + k).collect()
    }

    /// Gains, arm and payload from logs, for given filters and shapes.
    fn round(
        &self,
        unloaded: &[Log],
        loaded: &[Log],
        bands: &Bands,
        shapes: &[f64],
    ) -> Result<Round, IdentifyError> {
        let mut logs = Both::new(unloaded, loaded, bands)?;
        let mut rows = self.rows(&logs, shapes);
        let (mut values, mut gains) = rows.start()?;
        for _ in 0..STEPS {
            if self.arm.uses_rigid_torque() {
                let alone = &values[..self.shares.coefficients.len()];
                logs.update(self.arm, shapes, alone, &self.loaded(&values));
                rows = self.rows(&logs, shapes);
            }
            let told: Vec<usize> = (0..gains.len()).filter(|&j| gains[j].is_some()).collect();
            let linear = rows.linear(&values, &gains, self.arm.joints());
            let mut solution = self.identify.solve_stack(&linear)?;
            let (arm, found) = solution.estimate.split_at(self.unknowns());
            values = arm.to_vec();
            if !found.iter().all(|gain| gain.is_finite()) {
                break;
            }
            let mut change = 0.0_f64;
            for (k, &joint) in told.iter().enumerate() {
                let is_told = solution.is_told(self.unknowns() + k);
                let last = gains[joint].replace(found[k]);
                change = change.max(last.map_or(0.0, |last| (found[k] / last - 1.0).abs()));
                if !is_told {
                    gains[joint] = None;
                    change = f64::INFINITY;
                }
            }
            if !(change.is_finite() || gains.iter().any(Option::is_some)) {
                return Err(IdentifyError::PayloadHidden);
            }
            if change <= SETTLED {
                solution.std = self.identify.deviations(&linear, &solution);
                let of = |(k, &joint): (usize, &usize)| {
                    let std = solution.std[self.unknowns() + k];
                    let value = found[k];
                    (joint, DriveGain { value, std })
                };
                let mut with_std = vec![None; gains.len()];
                for (joint, gain) in told.iter().enumerate().map(of) {
                    with_std[joint] = Some(gain);
                }
                return Ok(Round {
                    gains: with_std,
                    solution,
                    linear,
                });
            }
        }
        Err(IdentifyError::PayloadLost)
    }

    fn rows(&self, logs: &Both, shapes: &[f64]) -> Rows {
        let (stack, start) = logs.stack(self.identify, self.arm, shapes);
        Rows::new(stack, start, &self.shares, &self.base)
    }
}

/// Gains of logs that were multiplied by those of a round.
fn follow(factors: &mut [f64], gains: &[Option<DriveGain>]) {
    for (factor, gain) in factors.iter_mut().zip(gains) {
        // What is not told any more is the spec's.
        *factor = gain.map_or(1.0, |gain| *factor * gain.value);
    }
}
