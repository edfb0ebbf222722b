//! Checked expressions, generic over what their names may mean.

/// A checked expression over leaves that its place allows.
#[derive(Debug, Clone, PartialEq)]
pub enum Expr<Leaf> {
    /// A number in SI units.
    Number(f64),
    /// A name with a meaning.
    Leaf(Leaf),
    /// `-x`
    Neg(Box<Self>),
    /// `x op y`
    Binary(BinaryOp, Box<Self>, Box<Self>),
    /// `f(x)`
    Call(Function, Box<Self>),
    /// `min(x, y)`
    Min(Box<Self>, Box<Self>),
    /// `max(x, y)`
    Max(Box<Self>, Box<Self>),
    /// `if greater > smaller { then } else { otherwise }`
    Choice(Box<Choice<Leaf>>),
}

/// One of two values. Only the one that holds counts: the other may be no number.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice<Leaf> {
    /// What has to be larger for the first value.
    pub greater: Expr<Leaf>,
    /// Than this.
    pub smaller: Expr<Leaf>,
    /// The value where it is larger.
    pub then: Expr<Leaf>,
    /// The value where it is not.
    pub otherwise: Expr<Leaf>,
}

impl<Leaf> Expr<Leaf> {
    /// The value, where it is made of numbers alone; `known` gives those of leaves that are numbers.
    pub fn number(&self, known: &dyn Fn(&Leaf) -> Option<f64>) -> Option<f64> {
        match self {
            Self::Number(value) => Some(*value),
            Self::Leaf(leaf) => known(leaf),
            Self::Neg(x) => Some(-x.number(known)?),
            Self::Binary(op, x, y) => Some(op.apply(x.number(known)?, y.number(known)?)),
            Self::Call(function, x) => Some(function.apply(x.number(known)?)),
            Self::Min(x, y) => Some(x.number(known)?.min(y.number(known)?)),
            Self::Max(x, y) => Some(x.number(known)?.max(y.number(known)?)),
            Self::Choice(_) => None,
        }
    }

    /// Whether `wanted` holds for some part of the expression.
    pub fn contains(&self, wanted: &dyn Fn(&Self) -> bool) -> bool {
        wanted(self)
            || match self {
                Self::Number(_) | Self::Leaf(_) => false,
                Self::Neg(x) | Self::Call(_, x) => x.contains(wanted),
                Self::Binary(_, x, y) | Self::Min(x, y) | Self::Max(x, y) => {
                    x.contains(wanted) || y.contains(wanted)
                }
                Self::Choice(choice) => [
                    &choice.greater,
                    &choice.smaller,
                    &choice.then,
                    &choice.otherwise,
                ]
                .iter()
                .any(|part| part.contains(wanted)),
            }
    }
}

/// Arithmetic of the language, by rising precedence; `^` binds tightest and to the right.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BinaryOp {
    /// `+`
    Add,
    /// `-`
    Sub,
    /// `*`
    Mul,
    /// `/`
    Div,
    /// `^`
    Pow,
}

impl BinaryOp {
    /// Its value.
    #[must_use]
    pub fn apply(self, x: f64, y: f64) -> f64 {
        match self {
            Self::Add => x + y,
            Self::Sub => x - y,
            Self::Mul => x * y,
            Self::Div => x / y,
            Self::Pow => x.powf(y),
        }
    }
}

impl Function {
    /// Its value.
    #[must_use]
    pub fn apply(self, x: f64) -> f64 {
        match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Exp => x.exp(),
            Self::Sqrt => x.sqrt(),
            Self::Abs => x.abs(),
            // `f64::signum` is 1 at 0.
            Self::Sign if x == 0.0 => 0.0,
            Self::Sign => x.signum(),
            Self::Tanh => x.tanh(),
        }
    }
}

/// Functions of one argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Function {
    /// `sin`
    Sin,
    /// `cos`
    Cos,
    /// `exp`
    Exp,
    /// `sqrt`
    Sqrt,
    /// `abs`
    Abs,
    /// `sign`: -1, 0 or 1
    Sign,
    /// `tanh`
    Tanh,
}
