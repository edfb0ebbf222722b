//! What an identification found.

use crate::columns::Arm;
use crate::signal::Bands;

use super::fitted::Fitted;
use super::instruments::Hausman;
use super::late::{Delay, Late};
use super::least_squares::Solution;
use super::possible::Possible;
use super::{AtTurns, Bootstrap, Combination, Essential, HiddenDelay, Method, OtherFriction};

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
    /// Condition number of the weighted regressor with columns of unit norm; of [`Method::Ridge`] of logs and nominal values together, as the rank.
    pub condition: f64,
    /// Directions of the columns that count as silent since all that is seen of them is noise of the positions.
    pub drowned: usize,
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
    /// Whether these rows are left out, see [`AtTurns`](super::AtTurns). Errors on other logs are of all rows but those of [`Self::held`] joints.
    pub is_without_turns: bool,
    /// Names of the parameters that no rows but those at turns of one joint tell: it stands there longer than its law says, and they
    /// may be off by many of their deviations. None of a [`Factor`](super::Factor).
    pub told_at_turns: Vec<String>,
    /// Rows per joint that are left out because dry friction holds it nearly all the time.
    pub held: Vec<usize>,
    /// Rows per joint that are left out because its torque stands at a [limit](crate::log::Log::clipped).
    pub clipped: Vec<usize>,
    /// Independent samples per joint that say as much as those of its errors, whose neighbors are alike; none where samples are not
    /// at hand.
    pub effective_samples: Option<Vec<f64>>,
    /// Blocks of the logs from which deviations are, of a [`Factor`](super::Factor).
    pub blocks: Option<usize>,
    /// Parameters whose deviations rest on a single one of these blocks: what it alone tells has the deviation of white noise, times what
    /// that is too small by for the others.
    pub of_one_block: Vec<String>,
    /// Intervals from blocks that were drawn, where [`Identify::bootstrap`](super::Identify::bootstrap) asks for them.
    pub bootstrap: Option<Bootstrap>,
    /// The parameters that are essential, where [`Identify::essential`](super::Identify::essential) asks for them.
    pub essential: Option<Essential>,
    /// Torques that are late or early against positions, or the position that is instead, in logs without a payload; none of a [`Factor`](super::Factor).
    pub delays: Vec<Delay>,
    /// Torques that are early by about half of a sample, and explained far better without: set at a sample and held until the next one, which
    /// is how a drive works and bends values where samples are slow beside the motion. Empty where there are [`Self::delays`].
    pub held_torques: Vec<Delay>,
    /// Joints whose torque follows their speed in another way than the friction of the spec; deviations have what that moves values by.
    pub other_friction: Vec<OtherFriction>,
    /// A delay of all torques that noise hides from [`Self::delays`]; deviations have what it moves values by. None where there are others.
    pub hidden_delay: Option<HiddenDelay>,
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
            combinations: Combination::all(solution, &fitted.names),
            condition: solution.condition,
            drowned: solution.drowned,
            rank: solution.estimate.len() - solution.unexcited.len(),
            relative_percent: fitted.relative_percent,
            samples: fitted.samples,
            joints: arm.joints().to_vec(),
            possible: None,
            outliers: None,
            hausman: None,
            turns: fitted.turns,
            is_without_turns: false,
            told_at_turns: Vec::new(),
            blocks: None,
            of_one_block: Vec::new(),
            clipped: fitted.clipped,
            held: fitted.held,
            effective_samples: fitted.effective_samples,
            bootstrap: None,
            essential: None,
            delays: Vec::new(),
            held_torques: Vec::new(),
            other_friction: Vec::new(),
            hidden_delay: None,
        }
    }

    pub(super) fn with_late(self, late: Late) -> Self {
        Self {
            hidden_delay: self.hidden_delay.filter(|_| late.told.is_empty()),
            delays: late.told,
            held_torques: late.held,
            ..self
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

    /// What a further fit asks for that is to have the rows of this one.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::{AtTurns, Identify};
    /// let estimate = Identify::default().fit(&pendulum(), &[measure(0.0)])?;
    /// assert_eq!(estimate.at_turns(), AtTurns::Kept); // it has no dry friction
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub const fn at_turns(&self) -> AtTurns {
        if self.is_without_turns {
            AtTurns::LeftOut
        } else {
            AtTurns::Kept
        }
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
}
