//! What pushes the arm from outside, from its momentum: no acceleration, no force sensor.

use super::command::{Reason, Status};
use super::error::{ControlError, POSITIVE, is_positive, number};
use super::guard::{Guard, flaw, still};
use crate::math;
use crate::model::{RobotModel, Vector};
use crate::state::State;

/// Torque that acts on the joints from outside: `M ddq + C dq + G + effects = tau + tau_ext`.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::{MomentumObserver, Status};
/// use robot_model::{State, Vector};
///
/// let mut observer = MomentumObserver::new(arms::two_link(), 50.0, 1e-3)?;
/// let lost = State::at_rest(Vector::from([f64::NAN, 0.0]));
/// let found = observer.update(&lost, &Vector::zeros());
/// assert!(matches!(found.status, Status::Held(_)) && found.torque == Vector::from([0.0, 0.0]));
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
#[non_exhaustive]
pub struct ExternalTorque<const D: usize> {
    /// The estimate, N m or N.
    pub torque: Vector<D>,
    /// [`Status::Held`] where it is that of an earlier cycle.
    pub status: Status,
}

/// The momentum observer: the residual of the generalized momentum `p`, which follows `tau_ext` with a pole at `K`.
///
/// ```text
/// r = K (p - integral(tau + C^T dq - G - tau_f + r) dt),   so that   dr/dt = K (tau_ext - r)
/// ```
///
/// `p = A dq`, with what effects add to the mass matrix, such as rotors; `C^T dq - G - tau_f` is computed as
/// `(C + C^T) dq - inverse_dynamics(q, dq, 0)`, which has all declared effects in it. In discrete time, with the torque of an
/// interval constant and the rest of the rate by the trapezoidal rule,
///
/// ```text
/// r[k+1] = a r[k] + (1 - a) ((p[k+1] - p[k]) / h - tau[k] - (d[k] + d[k+1]) / 2),   a = exp(-K h)
/// ```
///
/// Its pole is exact for any `K h`. After a time of `n h` it shows `1 - a^n` of a constant external torque, from the
/// first bit of momentum on; a motion adds an error of the order of `h^2`.
///
/// Dry friction at rest takes any value up to its limit, which is then part of the residual. Effects that depend on the load see
/// the load without its inertia.
///
/// Source: De Luca & Mattone 2005; Haddadin, De Luca & Albu-Schaeffer 2017.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::MomentumObserver;
/// use robot_model::{RobotModel, State, Vector};
///
/// let arm = arms::two_link();
/// let mut observer = MomentumObserver::new(arm, 50.0, 1e-3)?;
/// // At rest, with 3 N m less than gravity at the shoulder: something carries them.
/// let state = State::at_rest(Vector::from([0.4, 0.1]));
/// let tau = arm.gravity(&state.q) - Vector::from([3.0, 0.0]);
/// let mut found = observer.update(&state, &tau);
/// for _cycle in 0..20 {
///     found = observer.update(&state, &tau);
/// }
/// // One time constant.
/// assert!((found.torque[0] - 3.0 * (1.0 - (-1.0_f64).exp())).abs() < 1e-9);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MomentumObserver<A, const D: usize> {
    arm: A,
    seconds: f64,
    /// `a`
    decay: f64,
    guard: Guard<D>,
    residual: Vector<D>,
    /// Momentum and rate of the last cycle; none at the start and after a cycle without readings.
    last: Option<[Vector<D>; 2]>,
}

impl<A, const D: usize> MomentumObserver<A, D> {
    /// Of an arm with its parameters; `pole` is `K` in 1/s, `seconds` the time from cycle to cycle.
    ///
    /// # Errors
    /// [`ControlError::Number`], where one of them is not positive.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::MomentumObserver;
    ///
    /// let refused = MomentumObserver::new(arms::two_link(), 50.0, 0.0).unwrap_err();
    /// assert_eq!(refused.to_string(), "time from cycle to cycle is 0 s; give a positive, finite number");
    /// ```
    pub fn new<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        arm: A,
        pole: f64,
        seconds: f64,
    ) -> Result<Self, ControlError>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        number(pole, ("pole", " 1/s", POSITIVE), is_positive(pole))?;
        let what = ("time from cycle to cycle", " s", POSITIVE);
        number(seconds, what, is_positive(seconds))?;
        Ok(Self {
            arm,
            seconds,
            decay: math::exp(-pole * seconds),
            guard: Guard::new(&A::JOINTS),
            residual: Vector::zeros(),
            last: None,
        })
    }

    /// One cycle: `measured` is now, `torque` what acted since the call before, N m or N.
    ///
    /// The first call begins; after a cycle without readings the estimate stays, and the next sound one begins again from it.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::MomentumObserver;
    /// use robot_model::{RobotModel, State, Vector};
    ///
    /// // At rest, with the torque that gravity takes: nothing acts from outside.
    /// let mut observer = MomentumObserver::new(arms::two_link(), 50.0, 1e-3)?;
    /// let state = State::at_rest(Vector::from([0.4, 0.1]));
    /// let tau = arms::two_link().gravity(&state.q);
    /// let _ = observer.update(&state, &tau);
    /// assert!(observer.update(&state, &tau).torque.norm() < 1e-12);
    /// // 2 N m more at the elbow: after a cycle the share 1 - exp(-K h) of what holds them back.
    /// let found = observer.update(&state, &(tau + Vector::from([0.0, 2.0])));
    /// assert!((found.torque[1] + 2.0 * (1.0 - (-0.05_f64).exp())).abs() < 1e-12);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn update<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        &mut self,
        measured: &State<D, M, I>,
        torque: &Vector<D>,
    ) -> ExternalTorque<D>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let no_torque = || {
            flaw(torque.as_slice()).map(|index| Reason::NoNumber {
                signal: super::Signal::Torque,
                index,
            })
        };
        if let Some(reason) = self.guard.fault(measured, None).or_else(no_torque) {
            return self.held(reason);
        }
        let [momentum, drift] = momentum_and_drift(&self.arm, measured);
        if let Some(index) = flaw(momentum.as_slice()).or_else(|| flaw(drift.as_slice())) {
            return self.held(Reason::NoTorque { index });
        }
        if let Some([momentum_before, drift_before]) = self.last {
            let rate = (momentum - momentum_before) / self.seconds;
            let seen = rate - torque - (drift + drift_before) * 0.5;
            self.residual = self.residual * self.decay + seen * (1.0 - self.decay);
        }
        self.last = Some([momentum, drift]);
        ExternalTorque {
            torque: self.residual,
            status: Status::Normal,
        }
    }

    fn held(&mut self, reason: Reason) -> ExternalTorque<D> {
        self.last = None;
        ExternalTorque {
            torque: self.residual,
            status: Status::Held(reason),
        }
    }
}

/// `p` and `C^T dq - G - tau_f`.
fn momentum_and_drift<
    A,
    const D: usize,
    const S: usize,
    const B: usize,
    const H: usize,
    const M: usize,
    const I: usize,
>(
    arm: &A,
    measured: &State<D, M, I>,
) -> [Vector<D>; 2]
where
    A: RobotModel<D, S, B, H, M, I>,
{
    let (q, dq) = (&measured.q, &measured.dq);
    let pushed = State {
        dq: Vector::zeros(),
        ddq: *dq,
        memory: Vector::zeros(),
        measured_torque: Vector::zeros(),
        ..*measured
    };
    let momentum = arm.inverse_dynamics_at(&pushed) - still(arm, measured);
    let coasting = State {
        ddq: Vector::zeros(),
        ..*measured
    };
    let coriolis = arm.coriolis_matrix(q, dq);
    // The rate of the mass matrix is `C + C^T`.
    let drift = coriolis * dq + coriolis.tr_mul(dq) - arm.inverse_dynamics_at(&coasting);
    [momentum, drift]
}
