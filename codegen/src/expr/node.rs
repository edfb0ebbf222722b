//! What expressions are made of: numbers, symbols, operations.

use super::ExprId;

/// A quantity that gets its value when an expression is evaluated. Joints count from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symbol {
    /// Position of a joint, rad or m.
    Q(usize),
    /// Velocity of a joint.
    Dq(usize),
    /// Acceleration of a joint.
    Ddq(usize),
    /// Torque of the rigid body alone on a joint, where it comes from outside, N m or N.
    RigidTorque(usize),
    /// Time since the start of the log, s.
    Time,
    /// A standard parameter, by its index.
    Parameter(usize),
    /// A shape parameter, by its index over all shape parameters of the declared effects.
    Shape(usize),
    /// Torque of a joint as the log has it, N m or N.
    MeasuredTorque(usize),
    /// A further channel of the log, by its index over the channels that the effects read.
    Input(usize),
    /// An internal state, by its index over all states of the declared effects.
    State(usize),
    /// Where a jump stands: 1 on the one side, -1 on the other, between them where a motion is held on the jump, as that of a
    /// joint that sticks. By its index over the jumps that [`Dag::switched`](super::Dag::switched) has found; only in equations
    /// of simulation.
    Switch(usize),
    /// Weight of an output, where a weighted sum of outputs is differentiated.
    Weight(usize),
}

/// Functions of one argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// `sin`
    Sin,
    /// `cos`
    Cos,
    /// `exp`
    Exp,
    /// Natural logarithm; arises from derivatives of powers.
    Ln,
    /// `sqrt`
    Sqrt,
    /// `abs`
    Abs,
    /// `sign`: -1, 0 or 1
    Sign,
    /// `tanh`
    Tanh,
    /// `1 / x`
    Recip,
}

impl Function {
    /// Its value.
    #[must_use]
    pub fn apply(self, x: f64) -> f64 {
        match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Sqrt => x.sqrt(),
            Self::Abs => x.abs(),
            // `f64::signum` is 1 at 0.
            Self::Sign if x == 0.0 => 0.0,
            Self::Sign => x.signum(),
            Self::Tanh => x.tanh(),
            Self::Recip => x.recip(),
        }
    }

    /// Name in text and in `robot_model::math`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Sqrt => "sqrt",
            Self::Abs => "abs",
            Self::Sign => "sign",
            Self::Tanh => "tanh",
            Self::Recip => "recip",
        }
    }
}

/// A finite number that can be compared and hashed: one zero, no NaN.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Real(u64);

impl Real {
    pub(super) fn new(value: f64) -> Self {
        // `-0.0 + 0.0` is `0.0`: the two zeros become one.
        Self((value + 0.0).to_bits())
    }

    /// The number.
    #[must_use]
    pub const fn get(self) -> f64 {
        f64::from_bits(self.0)
    }
}

/// One node of the dag.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number.
    Constant(Real),
    /// A quantity bound at evaluation.
    Symbol(Symbol),
    /// `x + y`
    Add(ExprId, ExprId),
    /// `x * y`; a numeric factor comes first.
    Mul(ExprId, ExprId),
    /// `x ^ y` where `y` is not an integer constant.
    Power(ExprId, ExprId),
    /// `f(x)`
    Call(Function, ExprId),
    /// The second where the first is positive, else the third. Only the one that holds counts: the other may be no number.
    Select(ExprId, ExprId, ExprId),
}

impl Node {
    /// The operands, none to three.
    pub fn operands(self) -> impl Iterator<Item = ExprId> {
        let operands = match self {
            Self::Constant(_) | Self::Symbol(_) => [None; 3],
            Self::Call(_, x) => [Some(x), None, None],
            Self::Add(x, y) | Self::Mul(x, y) | Self::Power(x, y) => [Some(x), Some(y), None],
            Self::Select(condition, x, y) => [Some(condition), Some(x), Some(y)],
        };
        operands.into_iter().flatten()
    }
}
