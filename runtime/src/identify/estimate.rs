//! What an identification found, and how well it predicts.

use crate::columns::Arm;
use crate::log::Log;
use crate::signal::resample::whole_steps;
use crate::signal::{Bands, Prepared, prepare};

use super::errors::Errors;
use super::fitted::Fitted;
use super::instruments::Hausman;
use super::late::Delay;
use super::least_squares::Solution;
use super::possible::Possible;
use super::stack::{norm, percent, rows_at, torque_of};
use super::{Bootstrap, Combination, Essential, IdentifyError, Method, Shared, load_motion};

/// Cut from either end of a log before errors are computed on raw samples, s.
const ERROR_BORDER_S: f64 = 1.0;

/// Which equations the parameters were identified with; both have the same parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
    /// `tau = Y_b(q, dq, ddq) * beta`
    Acceleration,
    /// `L{tau} = Y_L(q, dq) * beta`, without accelerations.
    Filtered {
        /// `w` of `L(s) = w / (s + w)`, rad/s.
        corner: f64,
    },
}

impl Form {
    /// Name on the command line and in JSON.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::Form;
    /// assert_eq!(Form::Filtered { corner: 30.0 }.name(), "filtered");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Acceleration => "acceleration",
            Self::Filtered { .. } => "filtered",
        }
    }
}

/// One identified parameter.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Identified {
    /// Base parameter or `JOINT.EFFECT.PARAMETER`.
    pub name: String,
    /// Estimate, SI.
    pub value: f64,
    /// Standard deviation of the estimate.
    pub std: f64,
}

/// What an identification found.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Estimate {
    /// How joints were weighed.
    pub method: Method,
    /// Which equations were used.
    pub form: Form,
    /// Bands of the filters of the fit.
    pub bands: Bands,
    /// Bands of the motion whose torque is predicted, and compared with raw samples: those of the fit, or of
    /// [`Self::with_best_motion`].
    pub motion_bands: Bands,
    /// The identified parameters, in the arm's order.
    pub parameters: Vec<Identified>,
    /// Identified shape parameters: name and value.
    pub shapes: Vec<(String, f64)>,
    /// Their standard deviations, of least squares linearized about the estimate; none where a method or the logs do not tell.
    pub shape_std: Vec<Option<f64>>,
    /// Names of the parameters that the logs do not excite; their value is given as 0, by [`Method::Physical`] as that of the arm it found.
    pub unexcited: Vec<String>,
    /// What the logs tell of parameters that they do not tell apart. The first term of each has no value of its own; in
    /// `parameters` it has that which makes the sum.
    pub combinations: Vec<Combination>,
    /// Condition number of the weighted regressor with columns of unit norm.
    pub condition: f64,
    /// Numerical rank of the regressor.
    pub rank: usize,
    /// `100 || residual || / || tau ||` per joint on the identification logs, filtered.
    pub relative_percent: Vec<f64>,
    /// Samples per joint after decimation.
    pub samples: usize,
    /// Names of the joints.
    pub joints: Vec<String>,
    /// The arm that was found where only possible ones were looked at: [`Method::Physical`].
    pub possible: Option<Possible>,
    /// Samples per joint whose residual is far beyond the others, where such samples count less: [`Method::Robust`].
    pub outliers: Option<Vec<usize>>,
    /// The comparison with least squares where instruments were taken: [`Method::Instrumental`].
    pub hausman: Option<Hausman>,
    /// Rows per joint where it turns, see [`Arm::dry_joints`]; whether they are fitted says [`Self::is_without_turns`].
    pub turns: Vec<usize>,
    /// Whether these rows are left out: because of [`Identify::leave_out_turns`](super::Identify::leave_out_turns), or because the arm has
    /// [`Arm::dry_shapes`] that other rows tell.
    pub is_without_turns: bool,
    /// Rows per joint that are left out because dry friction holds it nearly all the time.
    pub held: Vec<usize>,
    /// Rows per joint that are left out because its torque stands at a [limit](Log::clipped).
    pub clipped: Vec<usize>,
    /// Independent samples per joint that say as much as those of its errors, whose neighbors are alike; none where samples are not
    /// at hand.
    pub effective_samples: Option<Vec<f64>>,
    /// Blocks of the logs from which deviations are, of a [`Factor`](super::Factor).
    pub blocks: Option<usize>,
    /// Intervals from blocks that were drawn, where [`Identify::bootstrap`](super::Identify::bootstrap) asks for them.
    pub bootstrap: Option<Bootstrap>,
    /// The parameters that are essential, where [`Identify::essential`](super::Identify::essential) asks for them.
    pub essential: Option<Essential>,
    /// Torques that are late or early against positions, or the position that is instead, in logs without a payload; none of a [`Factor`](super::Factor).
    pub delays: Vec<Delay>,
}

impl Estimate {
    pub(super) fn new(
        arm: &dyn Arm,
        method: Method,
        form: Form,
        bands: Bands,
        solution: &Solution,
        shapes: Vec<f64>,
        fitted: Fitted,
    ) -> Self {
        let name = |c: &usize| fitted.names[*c].clone();
        let combination = |shared: &Shared| {
            let others = shared.others.iter();
            let others = others.map(|(c, factor)| (name(c), *factor));
            // Parts that the logs do not tell are 0, or what a method has found for them elsewhere.
            let parts = shared.others.iter();
            let parts = parts.map(|(c, factor)| factor * solution.estimate[*c]);
            Combination {
                terms: std::iter::once((name(&shared.lead), 1.0))
                    .chain(others)
                    .collect(),
                value: solution.estimate[shared.lead] + parts.sum::<f64>(),
                std: solution.std[shared.lead],
            }
        };
        let parameters = fitted
            .names
            .iter()
            .zip(solution.estimate.iter().zip(&solution.std))
            .map(|(name, (value, std))| Identified {
                name: name.clone(),
                value: *value,
                std: *std,
            })
            .collect();
        Self {
            method,
            form,
            bands,
            motion_bands: bands,
            parameters,
            shapes: arm
                .shapes()
                .iter()
                .zip(shapes)
                .map(|(shape, value)| (shape.name.clone(), value))
                .collect(),
            shape_std: vec![None; arm.shapes().len()],
            unexcited: solution.unexcited.iter().map(name).collect(),
            combinations: solution.shared.iter().map(combination).collect(),
            condition: solution.condition,
            rank: solution.estimate.len() - solution.unexcited.len(),
            relative_percent: fitted.relative_percent,
            samples: fitted.samples,
            joints: arm.joints().to_vec(),
            possible: None,
            outliers: None,
            hausman: None,
            turns: fitted.turns,
            is_without_turns: false,
            blocks: None,
            clipped: fitted.clipped,
            held: fitted.held,
            effective_samples: fitted.effective_samples,
            bootstrap: None,
            essential: None,
            delays: Vec::new(),
        }
    }

    /// Whether [`Method::Physical`] holds a parameter where no arm has it: its deviation, of the logs alone, says nothing of such a value.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure_with, pendulum};
    /// # use robot_model::identify::{Identify, Method};
    /// // A log by which friction would drive the joint.
    /// let log = measure_with([2.0, 9.0, -0.5], 0.0);
    /// let identify = Identify { method: Method::Physical, ..Identify::default() };
    /// let estimate = identify.fit(&pendulum(), &[log])?;
    /// assert!(estimate.is_held("joint.viscous_friction.fv") && !estimate.is_held("link.izz"));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn is_held(&self, name: &str) -> bool {
        let border = self.possible.iter().flat_map(|possible| &possible.border);
        border
            .into_iter()
            .any(|held| held.trim_matches('`') == name)
    }

    /// Values of the unknowns, in the arm's order.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let estimate = Identify::default().fit(&pendulum(), &[measure(0.0)])?;
    /// let [izz, mx, fv] = estimate.values()[..] else { panic!("three unknowns") };
    /// assert!((izz - 2.0).abs() < 0.02 && (mx - 9.0).abs() < 0.09 && (fv - 1.0).abs() < 0.01);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.value).collect()
    }

    /// Torque that the model predicts at every time stamp of a log, `[joint][sample]`, N m or N.
    ///
    /// The motion is filtered by [`Self::motion_bands`]; nothing is fitted on the log.
    ///
    /// # Errors
    /// [`IdentifyError`] where the log is of another arm or cannot be filtered.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let (arm, log) = (pendulum(), measure(0.0));
    /// let estimate = Identify::default().fit(&arm, std::slice::from_ref(&log))?;
    /// let torque = estimate.predict(&arm, &log)?;
    /// assert_eq!(torque[0].len(), log.time.len());
    /// assert!((torque[0][5000] - log.tau[0][5000]).abs() < 0.1);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn predict(&self, arm: &dyn Arm, log: &Log) -> Result<Vec<Vec<f64>>, IdentifyError> {
        super::check_logs(arm, std::slice::from_ref(log))?;
        let prepared = prepare(log, &self.motion_bands)?;
        let torque = self.torque(arm, &prepared);
        let stride = prepared.stride;
        Ok(torque
            .iter()
            .map(|values| spread(values, stride, log.time.len()))
            .collect())
    }

    /// Errors on a log, which was or was not fitted.
    ///
    /// # Errors
    /// Those of [`Self::predict`].
    ///
    /// # Examples
    /// What the model lacks, dry friction of 0.7 N m, shows in the error.
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let arm = pendulum();
    /// let estimate = Identify::default().fit(&arm, &[measure(0.0)])?;
    /// let (same, worn) = (estimate.errors(&arm, &measure(0.0))?, estimate.errors(&arm, &measure(0.7))?);
    /// assert!(same.rmse[0] < 0.05);
    /// assert!((worn.rmse[0] - 0.7).abs() < 0.05);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn errors(&self, arm: &dyn Arm, log: &Log) -> Result<Errors, IdentifyError> {
        let raw = self.raw_errors(arm, log)?;
        if self.motion_bands == self.bands {
            return Ok(raw);
        }
        let prepared = prepare(log, &self.bands)?;
        Ok(Errors {
            relative_percent: self
                .errors_of(arm, &prepared, &log.tau, prepared.stride)
                .relative_percent,
            ..raw
        })
    }

    /// Errors of raw samples; relative ones are of the bands of the motion.
    pub(super) fn raw_errors(&self, arm: &dyn Arm, log: &Log) -> Result<Errors, IdentifyError> {
        super::check_logs(arm, std::slice::from_ref(log))?;
        let prepared = prepare(log, &self.motion_bands)?;
        Ok(self.errors_of(arm, &prepared, &log.tau, prepared.stride))
    }

    /// `measured` has `stride` samples for one of the prepared motion.
    pub(super) fn errors_of(
        &self,
        arm: &dyn Arm,
        prepared: &Prepared,
        measured: &[Vec<f64>],
        stride: usize,
    ) -> Errors {
        let torque = self.torque(arm, prepared);
        let count = measured.first().map_or(0, Vec::len);
        let border = whole_steps(ERROR_BORDER_S * prepared.rate_hz) * stride;
        let inner = border.min(count / 4)..count - border.min(count / 4);
        let sound: Vec<usize> = inner
            .filter(|k| !prepared.is_in_hole(*k as f64 / stride as f64))
            .collect();
        let mut errors = Errors {
            rmse: Vec::new(),
            relative_percent: Vec::new(),
            mae: Vec::new(),
            level: Vec::new(),
            spread: Vec::new(),
            samples: Vec::new(),
        };
        let (mut filtered, mut tau) = (Vec::new(), Vec::new());
        for (joint, values) in torque.iter().enumerate() {
            let gain = arm.actuator_gain()[joint];
            let predicted = spread(values, stride, count);
            // A torque at its limit is not that of the model, unless the model says so.
            let reach = |reach: usize| {
                if arm.saturated_joints().contains(&joint) {
                    vec![false; values.len()]
                } else {
                    prepared.is_clipped(joint, reach)
                }
            };
            let (near, far) = (reach(0), reach(prepared.shared.border()));
            let inner: Vec<usize> = sound
                .iter()
                .copied()
                .filter(|k| !near[k / stride])
                .collect();
            let mean = |value: &dyn Fn(usize) -> f64| {
                inner.iter().copied().map(value).sum::<f64>() / inner.len().max(1) as f64
            };
            let rest = |k: usize| gain * measured[joint][k] - predicted[k];
            let level = mean(&|k| gain * measured[joint][k]);
            errors.rmse.push(mean(&|k| rest(k).powi(2)).sqrt());
            errors.mae.push(mean(&|k| rest(k).abs()));
            errors.level.push(level);
            errors.samples.push(inner.len());
            let spread = mean(&|k| (gain * measured[joint][k] - level).powi(2));
            errors.spread.push(spread.sqrt());
            let rest: Vec<f64> = prepared.tau[joint]
                .iter()
                .zip(values)
                .map(|(tau, t)| gain * tau - t)
                .collect();
            let scaled: Vec<f64> = prepared.tau[joint].iter().map(|tau| gain * tau).collect();
            prepared.shared.apply(&rest, &mut filtered);
            prepared.shared.apply(&scaled, &mut tau);
            for row in rows_at(0, prepared, &far) {
                (filtered[row], tau[row]) = (0.0, 0.0);
            }
            errors
                .relative_percent
                .push(percent(norm(&filtered), norm(&tau)));
        }
        errors
    }

    /// Predicted torque on a prepared motion's grid.
    fn torque(&self, arm: &dyn Arm, prepared: &Prepared) -> Vec<Vec<f64>> {
        let values = self.values();
        let shapes: Vec<f64> = self.shapes.iter().map(|(_, value)| *value).collect();
        let mut motion = prepared.motion.clone();
        if arm.uses_rigid_torque() {
            load_motion(arm, &mut motion, &shapes, &values);
        }
        let mut torque = torque_of(arm, &motion, &shapes, &values, arm.dof());
        for (sum, known) in torque.iter_mut().zip(arm.known_torque(&motion, &shapes)) {
            for (s, k) in sum.iter_mut().zip(known) {
                *s += k;
            }
        }
        torque
    }
}

/// Values on every `stride`-th sample, linearly between them, on `count` samples.
fn spread(values: &[f64], stride: usize, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| {
            let (at, part) = (k / stride, (k % stride) as f64 / stride as f64);
            let next = values[(at + 1).min(values.len() - 1)];
            values[at] + part * (next - values[at])
        })
        .collect()
}
