//! What decides the torque, once a sample.

use super::error::SimulateError;
use super::trajectory::{Desired, check_time};
use crate::control;

/// What a controller knows of the arm.
#[derive(Debug, Clone, Copy)]
pub struct Measured<'a> {
    /// Time, s.
    pub time: f64,
    /// Seconds for which the torque will be held.
    pub period: f64,
    /// Positions as encoders tell them, rad or m.
    pub q: &'a [f64],
    /// Velocities from them.
    pub dq: &'a [f64],
    /// Channels, such as a temperature.
    pub inputs: &'a [f64],
}

/// A sampled controller: its torque is held until the next sample.
pub trait Controller {
    /// Torque of every joint, N m or N.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::{Controller, Desired, Measured};
    ///
    /// /// A spring to the wanted position.
    /// struct Spring(f64);
    /// impl Controller for Spring {
    ///     fn torque(&mut self, measured: &Measured<'_>, desired: &Desired, torque: &mut [f64]) {
    ///         for (joint, torque) in torque.iter_mut().enumerate() {
    ///             *torque = self.0 * (desired.q[joint] - measured.q[joint]);
    ///         }
    ///     }
    /// }
    ///
    /// let measured = Measured { time: 0.0, period: 0.001, q: &[0.1], dq: &[0.0], inputs: &[] };
    /// let desired = Desired { q: vec![0.3], ..Desired::default() };
    /// let mut torque = [0.0];
    /// Spring(50.0).torque(&measured, &desired, &mut torque);
    /// assert!((torque[0] - 10.0).abs() < 1e-12);
    /// ```
    fn torque(&mut self, measured: &Measured<'_>, desired: &Desired, torque: &mut [f64]);
}

/// A controller's own model of the arm, right or wrong.
///
/// # Examples
/// ```
/// use robot_model::simulate::{ComputedTorque, Controller, Desired, Gains, InverseDynamics, Measured};
///
/// /// `tau = m ddq + c dq`
/// struct Block { m: f64, c: f64 }
/// impl InverseDynamics for Block {
///     fn inverse_dynamics(&mut self, _: &Measured<'_>, ddq: &[f64], sliding: &[f64], torque: &mut [f64]) {
///         torque[0] = self.m * ddq[0] + self.c * sliding[0];
///     }
/// }
///
/// // 0.1 m behind, with kp = w^2 = 400 1/s^2; friction is that of the 0.5 m/s that are wanted.
/// let measured = Measured { time: 0.0, period: 0.001, q: &[0.2], dq: &[0.5], inputs: &[] };
/// let desired = Desired { q: vec![0.3], dq: vec![0.5], ddq: vec![1.0] };
/// let mut torque = [0.0];
/// ComputedTorque::new(Gains::new(20.0, 1.0)?, Block { m: 2.0, c: 0.7 }).torque(&measured, &desired, &mut torque);
/// assert!((torque[0] - (2.0 * (1.0 + 40.0) + 0.7 * 0.5)).abs() < 1e-9);
/// # Ok::<(), robot_model::simulate::SimulateError>(())
/// ```
pub trait InverseDynamics {
    /// Torque of the accelerations `ddq` where the arm is; friction is that of the velocities `sliding`.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::{InverseDynamics, Measured};
    ///
    /// /// `tau = m ddq + c dq`
    /// struct Block { m: f64, c: f64 }
    /// impl InverseDynamics for Block {
    ///     fn inverse_dynamics(&mut self, _: &Measured<'_>, ddq: &[f64], sliding: &[f64], torque: &mut [f64]) {
    ///         torque[0] = self.m * ddq[0] + self.c * sliding[0];
    ///     }
    /// }
    ///
    /// let measured = Measured { time: 0.0, period: 0.001, q: &[0.2], dq: &[0.4], inputs: &[] };
    /// let mut torque = [0.0];
    /// Block { m: 2.0, c: 0.7 }.inverse_dynamics(&measured, &[3.0], &[0.5], &mut torque);
    /// assert_eq!(torque, [2.0 * 3.0 + 0.7 * 0.5]);
    /// ```
    fn inverse_dynamics(
        &mut self,
        measured: &Measured<'_>,
        ddq: &[f64],
        sliding: &[f64],
        torque: &mut [f64],
    );
}

/// How every joint comes back: natural frequency and damping of its error, with `kp` and `kd` of [`control::Gains`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains(control::Gains<1>);

impl Gains {
    /// Natural frequency in rad/s, and damping, 1 for critical.
    ///
    /// # Errors
    /// [`SimulateError::Setting`] where one is not positive.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::Gains;
    /// assert!(Gains::new(20.0, 1.0).is_ok());
    /// let error = Gains::new(-3.0, 1.0).unwrap_err();
    /// assert_eq!(error.to_string(), "the natural frequency must be positive, not -3");
    /// ```
    pub fn new(frequency: f64, damping: f64) -> Result<Self, SimulateError> {
        for (what, value) in [
            ("the natural frequency", frequency),
            ("the damping", damping),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SimulateError::Setting {
                    what,
                    range: "positive",
                    value,
                });
            }
        }
        Ok(Self(control::Gains::new(frequency, damping)))
    }

    /// `kp (q_d - q) + kd (dq_d - dq)`
    fn acceleration(self, joint: usize, measured: &Measured<'_>, desired: &Desired) -> f64 {
        let (kp, kd) = (self.0.kp()[0], self.0.kd()[0]);
        kp * (desired.q[joint] - measured.q[joint]) + kd * (desired.dq[joint] - measured.dq[joint])
    }
}

/// Every joint by itself: `tau = m (kp e + kd de/dt)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Pd {
    gains: Gains,
    inertia: Vec<f64>,
}

impl Pd {
    /// `inertia` is that of each joint for which the frequency holds, kg m^2 or kg.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::{Controller, Desired, Gains, Measured, Pd};
    /// // kp = w^2 = 400 1/s^2, of 0.5 kg m^2.
    /// let mut controller = Pd::new(Gains::new(20.0, 1.0)?, vec![0.5]);
    /// let measured = Measured { time: 0.0, period: 0.001, q: &[0.9], dq: &[0.0], inputs: &[] };
    /// let desired = Desired { q: vec![1.0], dq: vec![0.0], ddq: vec![0.0] };
    /// let mut torque = [0.0];
    /// controller.torque(&measured, &desired, &mut torque);
    /// assert!((torque[0] - 0.5 * 400.0 * 0.1).abs() < 1e-12);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn new(gains: Gains, inertia: Vec<f64>) -> Self {
        Self { gains, inertia }
    }
}

impl Controller for Pd {
    fn torque(&mut self, measured: &Measured<'_>, desired: &Desired, torque: &mut [f64]) {
        for (joint, torque) in torque.iter_mut().enumerate() {
            *torque = self.inertia[joint] * self.gains.acceleration(joint, measured, desired);
        }
    }
}

/// `tau = R(q, dq, ddq_d + kp e + kd de/dt)` with the torque `R` of a model, and its friction at the wanted velocity, which
/// does not chatter.
#[derive(Debug, Clone, PartialEq)]
pub struct ComputedTorque<M> {
    gains: Gains,
    model: M,
    accelerations: Vec<f64>,
}

impl<M: InverseDynamics> ComputedTorque<M> {
    /// With a model of the arm.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::{ComputedTorque, Controller, Desired, Gains, InverseDynamics, Measured};
    ///
    /// /// A model that knows nothing but a mass of 2 kg.
    /// struct Mass;
    /// impl InverseDynamics for Mass {
    ///     fn inverse_dynamics(&mut self, _: &Measured<'_>, ddq: &[f64], _: &[f64], torque: &mut [f64]) {
    ///         torque[0] = 2.0 * ddq[0];
    ///     }
    /// }
    ///
    /// let mut controller = ComputedTorque::new(Gains::new(20.0, 1.0)?, Mass);
    /// let measured = Measured { time: 0.0, period: 0.001, q: &[0.0], dq: &[0.0], inputs: &[] };
    /// let desired = Desired { q: vec![0.01], dq: vec![0.0], ddq: vec![0.0] };
    /// let mut torque = [0.0];
    /// controller.torque(&measured, &desired, &mut torque);
    /// assert!((torque[0] - 2.0 * 400.0 * 0.01).abs() < 1e-12);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn new(gains: Gains, model: M) -> Self {
        Self {
            gains,
            model,
            accelerations: Vec::new(),
        }
    }
}

impl<M: InverseDynamics> Controller for ComputedTorque<M> {
    fn torque(&mut self, measured: &Measured<'_>, desired: &Desired, torque: &mut [f64]) {
        let gains = self.gains;
        let accelerations = desired.ddq.iter().enumerate();
        self.accelerations.clear();
        self.accelerations.extend(
            accelerations.map(|(joint, ddq)| ddq + gains.acceleration(joint, measured, desired)),
        );
        self.model
            .inverse_dynamics(measured, &self.accelerations, &desired.dq, torque);
    }
}

/// Torques that are given, whatever the arm does: linear between samples, as in the middle of each period. Time counts from the first of
/// them, and the last one is held.
#[derive(Debug, Clone, PartialEq)]
pub struct Torques {
    time: Vec<f64>,
    torque: Vec<Vec<f64>>,
}

impl Torques {
    /// `torque[joint][sample]` at rising times, s.
    ///
    /// # Errors
    /// [`SimulateError::Size`] where columns differ in length, [`SimulateError::Setting`] where time does not rise or is empty.
    ///
    /// # Examples
    /// ```
    /// use robot_model::simulate::{SimulateError, Torques};
    /// assert!(Torques::new(vec![0.0, 0.1], vec![vec![1.0, 2.0]]).is_ok());
    /// // One joint whose column is short.
    /// let error = Torques::new(vec![0.0, 0.1], vec![vec![1.0]]);
    /// assert!(matches!(error, Err(SimulateError::Size { found: 1, expected: 2, .. })));
    /// ```
    pub fn new(time: Vec<f64>, torque: Vec<Vec<f64>>) -> Result<Self, SimulateError> {
        if time.is_empty() {
            return Err(SimulateError::Setting {
                what: "the number of torque samples",
                range: "1 or more",
                value: 0.0,
            });
        }
        check_time("the time of each torque sample", &time)?;
        if let Some(column) = torque.iter().find(|column| column.len() != time.len()) {
            return Err(SimulateError::Size {
                what: "a column of torques",
                found: column.len(),
                expected: time.len(),
            });
        }
        Ok(Self { time, torque })
    }
}

impl Controller for Torques {
    fn torque(&mut self, measured: &Measured<'_>, _: &Desired, torque: &mut [f64]) {
        let time = self.time[0] + measured.time + 0.5 * measured.period;
        let after = self.time.partition_point(|&sample| sample <= time);
        for (torque, column) in torque.iter_mut().zip(&self.torque) {
            // Not before the first one.
            let k = after.saturating_sub(1);
            *torque = column.get(after).map_or(column[k], |next| {
                let share = (time - self.time[k]) / (self.time[after] - self.time[k]);
                column[k] + share * (next - column[k])
            });
        }
    }
}
