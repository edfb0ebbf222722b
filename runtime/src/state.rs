//! What the equations of an arm read at one instant.

use nalgebra::SVector;

use crate::scalar::{Lanes4, Lanes8, Scalar};

/// Where an arm is, how it moves, and what its effects read beside: memory, channels of a log.
///
/// `STATES` counts the internal states of the declared effects and `INPUTS` the channels that they read; most arms have none. `S` is the
/// scalar of the numbers.
///
/// # Examples
/// ```
/// use robot_model::{State, Vector};
/// let motion = State::new(Vector::from([0.1]), Vector::from([2.0]), Vector::zeros());
/// assert_eq!((motion.dq[0], motion.time), (2.0, 0.0));
/// assert_eq!(State::at_rest(motion.q), State { dq: Vector::zeros(), ..motion });
/// // A bent bristle, and a motor of 35 degrees.
/// let state = motion.with_memory(Vector::from([1e-3])).with_inputs(Vector::from([35.0]));
/// assert_eq!((state.memory[0], state.inputs[0], state.q), (1e-3, 35.0, motion.q));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<const DOF: usize, const STATES: usize = 0, const INPUTS: usize = 0, S = f64> {
    /// Joint positions, rad or m.
    pub q: SVector<S, DOF>,
    /// Joint velocities, rad/s or m/s.
    pub dq: SVector<S, DOF>,
    /// Joint accelerations, rad/s^2 or m/s^2.
    pub ddq: SVector<S, DOF>,
    /// The load of load-dependent effects in a regressor, N m or N: torque of the rigid body alone, as
    /// [`RobotModel::loaded`](crate::RobotModel::loaded) has it. Others ignore it.
    pub rigid_torque: SVector<S, DOF>,
    /// Torque as the log or the drive has it, N m or N: for effects such as saturation. Others ignore it.
    pub measured_torque: SVector<S, DOF>,
    /// Seconds since the start of the log; for effects that depend on time.
    pub time: S,
    /// Internal states of effects, in the order of [`Memory::STATES`](crate::Memory::STATES); 0 at the start of a log.
    pub memory: SVector<S, STATES>,
    /// Channels that effects read, such as a temperature, in the order of [`RobotModel::INPUTS`](crate::RobotModel::INPUTS).
    pub inputs: SVector<S, INPUTS>,
}

impl<const DOF: usize, S: Scalar> State<DOF, 0, 0, S> {
    /// A motion, with no load, no measured torque and time zero.
    ///
    /// # Examples
    /// ```
    /// use robot_model::{State, Vector};
    /// let state = State::new(Vector::from([0.1]), Vector::from([2.0]), Vector::from([-3.0]));
    /// assert_eq!((state.dq[0], state.ddq[0], state.time, state.rigid_torque[0]), (2.0, -3.0, 0.0, 0.0));
    /// ```
    #[must_use]
    pub fn new(q: SVector<S, DOF>, dq: SVector<S, DOF>, ddq: SVector<S, DOF>) -> Self {
        Self {
            q,
            dq,
            ddq,
            rigid_torque: SVector::zeros(),
            measured_torque: SVector::zeros(),
            time: S::zero(),
            memory: SVector::zeros(),
            inputs: SVector::zeros(),
        }
    }

    /// A position at rest.
    ///
    /// # Examples
    /// ```
    /// use robot_model::{State, Vector};
    /// let state = State::at_rest(Vector::from([0.3, 0.1]));
    /// assert_eq!((state.q[1], state.dq[1], state.ddq[0], state.time), (0.1, 0.0, 0.0, 0.0));
    /// ```
    #[must_use]
    pub fn at_rest(q: SVector<S, DOF>) -> Self {
        Self::new(q, SVector::zeros(), SVector::zeros())
    }
}

impl<const DOF: usize, const STATES: usize, const INPUTS: usize, S: Scalar>
    State<DOF, STATES, INPUTS, S>
{
    /// The same instant with these internal states of effects.
    ///
    /// # Examples
    /// ```
    /// use robot_model::{State, Vector};
    /// // A deflection of bristles, and the temperature of the oil.
    /// let state = State::at_rest(Vector::from([0.3, 0.1]));
    /// let state = state.with_memory(Vector::from([1e-4])).with_inputs(Vector::from([42.0]));
    /// assert_eq!((state.q[0], state.memory[0], state.inputs[0]), (0.3, 1e-4, 42.0));
    /// ```
    #[must_use]
    pub fn with_memory<const N: usize>(self, memory: SVector<S, N>) -> State<DOF, N, INPUTS, S> {
        self.with(memory, self.inputs)
    }

    /// The same instant with these channels.
    ///
    /// # Examples
    /// ```
    /// use robot_model::{State, Vector};
    /// let state = State::at_rest(Vector::from([0.3])).with_memory(Vector::from([1e-4]));
    /// let warm = state.with_inputs(Vector::from([42.0]));
    /// assert_eq!((warm.inputs[0], warm.memory[0], warm.q[0]), (42.0, 1e-4, 0.3));
    /// ```
    #[must_use]
    pub fn with_inputs<const N: usize>(self, inputs: SVector<S, N>) -> State<DOF, STATES, N, S> {
        self.with(self.memory, inputs)
    }

    /// The same instant in another scalar, number by number.
    ///
    /// # Examples
    /// ```
    /// use robot_model::{State, Vector, scalar::Dual};
    /// let state = State::at_rest(Vector::from([0.3, 0.1]));
    /// // Slopes by the second position.
    /// let mut moving = state.map(Dual::constant);
    /// moving.q[1].slope = 1.0;
    /// assert_eq!((moving.q[0].value, moving.q[0].slope, moving.q[1].slope), (0.3, 0.0, 1.0));
    /// ```
    #[must_use]
    pub fn map<T: Scalar>(&self, f: impl Fn(S) -> T) -> State<DOF, STATES, INPUTS, T> {
        State {
            q: self.q.map(&f),
            dq: self.dq.map(&f),
            ddq: self.ddq.map(&f),
            rigid_torque: self.rigid_torque.map(&f),
            measured_torque: self.measured_torque.map(&f),
            time: f(self.time),
            memory: self.memory.map(&f),
            inputs: self.inputs.map(&f),
        }
    }

    fn with<const M: usize, const N: usize>(
        self,
        memory: SVector<S, M>,
        inputs: SVector<S, N>,
    ) -> State<DOF, M, N, S> {
        State {
            q: self.q,
            dq: self.dq,
            ddq: self.ddq,
            rigid_torque: self.rigid_torque,
            measured_torque: self.measured_torque,
            time: self.time,
            memory,
            inputs,
        }
    }
}

macro_rules! from_states {
    ($lanes:ident) => {
        impl<const DOF: usize, const STATES: usize, const INPUTS: usize>
            From<[State<DOF, STATES, INPUTS>; $lanes::COUNT]>
            for State<DOF, STATES, INPUTS, $lanes>
        {
            /// As many instants side by side.
            fn from(states: [State<DOF, STATES, INPUTS>; $lanes::COUNT]) -> Self {
                let lanes = |of: &dyn Fn(&State<DOF, STATES, INPUTS>) -> f64| {
                    $lanes::from(states.each_ref().map(of))
                };
                State {
                    q: SVector::from_fn(|k, _| lanes(&|state| state.q[k])),
                    dq: SVector::from_fn(|k, _| lanes(&|state| state.dq[k])),
                    ddq: SVector::from_fn(|k, _| lanes(&|state| state.ddq[k])),
                    rigid_torque: SVector::from_fn(|k, _| lanes(&|state| state.rigid_torque[k])),
                    measured_torque: SVector::from_fn(|k, _| {
                        lanes(&|state| state.measured_torque[k])
                    }),
                    time: lanes(&|state| state.time),
                    memory: SVector::from_fn(|k, _| lanes(&|state| state.memory[k])),
                    inputs: SVector::from_fn(|k, _| lanes(&|state| state.inputs[k])),
                }
            }
        }
    };
}

from_states!(Lanes4);
from_states!(Lanes8);
