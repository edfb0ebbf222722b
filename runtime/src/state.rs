//! What the equations of an arm read at one instant.

use crate::model::Vector;

/// Where an arm is, how it moves, and what its effects read beside: memory, channels of a log.
///
/// `STATES` counts the internal states of the declared effects and `INPUTS` the channels that they read; most arms have none.
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
pub struct State<const DOF: usize, const STATES: usize = 0, const INPUTS: usize = 0> {
    /// Joint positions, rad or m.
    pub q: Vector<DOF>,
    /// Joint velocities, rad/s or m/s.
    pub dq: Vector<DOF>,
    /// Joint accelerations, rad/s^2 or m/s^2.
    pub ddq: Vector<DOF>,
    /// Torque of the rigid body alone, N m or N: the load of load-dependent effects in a regressor. Others ignore it.
    pub rigid_torque: Vector<DOF>,
    /// Torque as the log or the drive has it, N m or N: for effects such as saturation. Others ignore it.
    pub measured_torque: Vector<DOF>,
    /// Seconds since the start of the log; for effects that depend on time.
    pub time: f64,
    /// Internal states of effects, in the order of [`Memory::STATES`](crate::Memory::STATES); 0 at the start of a log.
    pub memory: Vector<STATES>,
    /// Channels that effects read, such as a temperature, in the order of [`RobotModel::INPUTS`](crate::RobotModel::INPUTS).
    pub inputs: Vector<INPUTS>,
}

impl<const DOF: usize> State<DOF> {
    /// A motion, with no load, no measured torque and time zero.
    #[must_use]
    pub fn new(q: Vector<DOF>, dq: Vector<DOF>, ddq: Vector<DOF>) -> Self {
        Self {
            q,
            dq,
            ddq,
            rigid_torque: Vector::zeros(),
            measured_torque: Vector::zeros(),
            time: 0.0,
            memory: Vector::zeros(),
            inputs: Vector::zeros(),
        }
    }

    /// A position at rest.
    #[must_use]
    pub fn at_rest(q: Vector<DOF>) -> Self {
        Self::new(q, Vector::zeros(), Vector::zeros())
    }
}

impl<const DOF: usize, const STATES: usize, const INPUTS: usize> State<DOF, STATES, INPUTS> {
    /// The same instant with these internal states of effects.
    #[must_use]
    pub fn with_memory<const N: usize>(self, memory: Vector<N>) -> State<DOF, N, INPUTS> {
        self.with(memory, self.inputs)
    }

    /// The same instant with these channels.
    #[must_use]
    pub fn with_inputs<const N: usize>(self, inputs: Vector<N>) -> State<DOF, STATES, N> {
        self.with(self.memory, inputs)
    }

    fn with<const S: usize, const I: usize>(
        self,
        memory: Vector<S>,
        inputs: Vector<I>,
    ) -> State<DOF, S, I> {
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
