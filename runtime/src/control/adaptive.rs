//! Adaptive control: parameters that change until the motion is followed.

use super::command::{Command, Status};
use super::error::{
    ControlError, NOT_NEGATIVE, POSITIVE, each_joint, is_not_negative, is_positive, number,
};
use super::guard::Guard;
use super::reference::{Reference, ReferenceRegressor};
use super::safety::Safety;
use crate::mechanics::Mechanics;
use crate::model::{RobotModel, Vector};
use crate::scalar::Scalar;
use crate::state::State;

/// Gains of [`Adaptive`].
///
/// # Examples
/// ```
/// use robot_model::control::Adaptation;
/// // Seven parameters, of which the last is known.
/// let mut gains = Adaptation::<2, 7>::new(10.0, 5.0, 0.1);
/// gains.rates[6] = 0.0;
/// assert_eq!((gains.rates[5], gains.rates[6], gains.bandwidth[1]), (0.1, 0.0, 10.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adaptation<const D: usize, const B: usize> {
    /// `Lambda`, 1/s a joint: how fast an error goes once the arm is on the sliding surface.
    pub bandwidth: Vector<D>,
    /// `K_d`, N m s/rad or N s/m a joint.
    pub damping: Vector<D>,
    /// `Gamma`, a base parameter each, in its unit squared per J: how fast it changes; 0 for one that is known.
    pub rates: Vector<B>,
}

impl<const D: usize, const B: usize> Adaptation<D, B> {
    /// The same gains for all joints and parameters.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::control::Adaptation;
    /// assert_eq!(Adaptation::<2, 3>::new(10.0, 5.0, 0.1).damping[1], 5.0);
    /// ```
    #[must_use]
    pub fn new(bandwidth: f64, damping: f64, rate: f64) -> Self {
        Self {
            bandwidth: Vector::repeat(bandwidth),
            damping: Vector::repeat(damping),
            rates: Vector::repeat(rate),
        }
    }
}

/// Slotine and Li's adaptive control on the base regressor:
///
/// ```text
/// dq_r = dq_d + Lambda (q_d - q),   ddq_r = ddq_d + Lambda (dq_d - dq),   s = dq - dq_r
/// tau = Y_r(q, dq, dq_r, ddq_r) theta - K_d s
/// d theta/dt = -Gamma Y_r^T s
/// ```
///
/// On an arm with the true parameters `beta`, `V = 1/2 s^T M s + 1/2 (theta - beta)^T Gamma^-1 (theta - beta)` falls by
/// `s^T K_d s`, so `s` goes to zero, and the error of the motion with it. Parameters go where the motion tells them.
///
/// In discrete time the parameters make one step of Euler a cycle, after its torque. They stay while a torque is cut or held, as then
/// `s` says nothing of them, and inside of their ranges ([`Self::with_bounds`]).
///
/// Source: Slotine & Li 1987, On the adaptive control of robot manipulators.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::{Adaptation, Adaptive};
/// use robot_model::{FromParameters, Mechanics, RobotModel, State, Vector};
///
/// let arm = arms::two_link();
/// // The controller begins with half of all parameters.
/// let guess = arms::TwoLink::from_base(&(arm.beta() * 0.5));
/// let mut control = Adaptive::new(guess, Adaptation::new(10.0, 5.0, 0.5), 1e-3)?;
/// let mut state = State::at_rest(Vector::zeros());
/// let desired = State::at_rest(Vector::from([0.5, -0.5]));
/// for _cycle in 0..5000 {
///     let tau = control.torque(&state, &desired).torque;
///     let ddq = arm.forward_dynamics(&state.q, &state.dq, &tau).expect("an arm that could be built");
///     state.dq += ddq * 1e-3;
///     state.q += state.dq * 1e-3;
/// }
/// assert!((state.q - desired.q).norm() < 0.01);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adaptive<A, const D: usize, const B: usize> {
    arm: A,
    gains: Adaptation<D, B>,
    seconds: f64,
    lower: Vector<B>,
    upper: Vector<B>,
    regressor: ReferenceRegressor<B>,
    /// `beta` of the arm: what its own torque is made of.
    nominal: Vector<B>,
    estimate: Vector<B>,
    guard: Guard<D>,
}

impl<A, const D: usize, const B: usize> Adaptive<A, D, B> {
    /// From an arm with the parameters to begin with; `seconds` is the time from cycle to cycle.
    ///
    /// # Errors
    /// [`ControlError::Joint`], [`ControlError::Number`], where a bandwidth or the time is not positive, a damping or a rate negative.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{Adaptation, Adaptive};
    ///
    /// let refused = Adaptive::new(arms::two_link(), Adaptation::new(10.0, 5.0, -0.5), 1e-3).unwrap_err();
    /// assert_eq!(
    ///     refused.to_string(),
    ///     "rate of a parameter is -0.5; give a finite number that is not negative"
    /// );
    /// ```
    pub fn new<const S: usize, const H: usize, const M: usize, const I: usize>(
        arm: A,
        gains: Adaptation<D, B>,
        seconds: f64,
    ) -> Result<Self, ControlError>
    where
        A: Mechanics<D, S, B, H, M, I>,
    {
        let what = ("bandwidth", " 1/s", POSITIVE);
        each_joint(&A::JOINTS, gains.bandwidth.as_slice(), what, is_positive)?;
        let what = ("damping", " N m s/rad or N s/m", NOT_NEGATIVE);
        each_joint(&A::JOINTS, gains.damping.as_slice(), what, is_not_negative)?;
        for rate in &gains.rates {
            let what = ("rate of a parameter", "", NOT_NEGATIVE);
            number(*rate, what, is_not_negative(*rate))?;
        }
        let what = ("time from cycle to cycle", " s", POSITIVE);
        number(seconds, what, is_positive(seconds))?;
        let nominal = arm.beta();
        Ok(Self {
            regressor: ReferenceRegressor::new(&arm),
            arm,
            gains,
            seconds,
            lower: Vector::repeat(f64::NEG_INFINITY),
            upper: Vector::repeat(f64::INFINITY),
            nominal,
            estimate: nominal,
            guard: Guard::new(&A::JOINTS),
        })
    }

    /// The same with ranges of the base parameters, in the order of `BASE_PARAMETERS`.
    ///
    /// # Errors
    /// [`ControlError::Outside`], where one of the parameters to begin with is not in its range.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{Adaptation, Adaptive};
    /// use robot_model::{RobotModel, Vector};
    ///
    /// let control = Adaptive::new(arms::two_link(), Adaptation::new(10.0, 5.0, 0.5), 1e-3)?;
    /// let beta = arms::two_link().beta();
    /// let around = |width: f64| (beta - Vector::repeat(width), beta + Vector::repeat(width));
    /// let (lower, upper) = around(0.2);
    /// assert!(control.with_bounds(&lower, &upper).is_ok() && control.with_bounds(&upper, &lower).is_err());
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn with_bounds<const S: usize, const H: usize, const M: usize, const I: usize>(
        self,
        lower: &Vector<B>,
        upper: &Vector<B>,
    ) -> Result<Self, ControlError>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let ranges = lower.iter().zip(upper.iter());
        let entries = A::BASE_PARAMETERS
            .iter()
            .zip(self.nominal.iter())
            .zip(ranges);
        for ((&parameter, &value), (&lower, &upper)) in entries {
            // Also where one of them is no number.
            if !(lower <= value && value <= upper) {
                return Err(ControlError::Outside {
                    parameter,
                    value,
                    lower,
                    upper,
                });
            }
        }
        Ok(Self {
            lower: *lower,
            upper: *upper,
            ..self
        })
    }

    /// The same within limits.
    ///
    /// # Errors
    /// Those of [`Safety`], where a limit makes no sense.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{Adaptation, Adaptive, Safety};
    /// use robot_model::{State, Vector};
    ///
    /// let control = Adaptive::new(arms::two_link(), Adaptation::new(10.0, 5.0, 0.5), 1e-3)?;
    /// let mut control = control.with_safety(Safety::new().torque([20.0, 25.0]))?;
    /// // Stretched, the arm weighs 27 N m on the shoulder: cut at 20.
    /// let still = State::at_rest(Vector::from([0.0, 0.0]));
    /// assert_eq!(control.torque(&still, &still).torque[0], 20.0);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn with_safety(self, safety: Safety<D>) -> Result<Self, ControlError> {
        Ok(Self {
            guard: self.guard.within(safety)?,
            ..self
        })
    }

    /// The parameters as they are now, `theta`.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::RobotModel;
    /// use robot_model::control::{Adaptation, Adaptive};
    ///
    /// let control = Adaptive::new(arms::two_link(), Adaptation::new(10.0, 5.0, 0.5), 1e-3)?;
    /// assert_eq!(*control.estimate(), arms::two_link().beta());
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub const fn estimate(&self) -> &Vector<B> {
        &self.estimate
    }

    /// One cycle.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{Adaptation, Adaptive};
    /// use robot_model::{RobotModel, State, Vector};
    ///
    /// let arm = arms::two_link();
    /// let mut control = Adaptive::new(arm, Adaptation::new(10.0, 5.0, 0.5), 1e-3)?;
    /// // Where it should be, with its own parameters, an arm is held and learns nothing.
    /// let still = State::at_rest(Vector::from([0.3, -0.8]));
    /// assert!((control.torque(&still, &still).torque - arm.gravity(&still.q)).norm() < 1e-12);
    /// assert_eq!(*control.estimate(), arm.beta());
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn torque<const S: usize, const H: usize, const M: usize, const I: usize>(
        &mut self,
        measured: &State<D, M, I>,
        desired: &State<D>,
    ) -> Command<D>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let Self { arm, gains, .. } = self;
        let error = desired.q - measured.q;
        let reference = Reference {
            dq: desired.dq + gains.bandwidth.component_mul(&error),
            ddq: desired.ddq + gains.bandwidth.component_mul(&(desired.dq - measured.dq)),
        };
        let sliding = measured.dq - reference.dq;
        let regressor = self.regressor.at(arm, measured, &reference);
        let command = self.guard.cycle(arm, measured, Some(desired), || {
            let own = ReferenceRegressor::<B>::torque(arm, measured, &reference);
            let learnt = regressor * (self.estimate - self.nominal);
            own + learnt - gains.damping.component_mul(&sliding)
        });
        if command.status == Status::Normal {
            let slope = regressor.tr_mul(&sliding);
            for (k, estimate) in self.estimate.iter_mut().enumerate() {
                let moved = *estimate - self.seconds * gains.rates[k] * slope[k];
                *estimate = moved
                    .finite_or(*estimate)
                    .max(self.lower[k])
                    .min(self.upper[k]);
            }
        }
        command
    }
}
