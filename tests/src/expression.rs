//! The value of an effect's expression, straight from its tree: what the language says, with no compiler between.

use robot_model_spec::model::{
    BinaryOp, EffectBinding, EffectExpr, EffectLeaf, Expr, Function, Signal,
};

/// What the names of an expression stand for.
#[derive(Debug, Clone, Copy)]
pub struct Scope<'a> {
    /// Values of the definition's linear parameters.
    pub linear: &'a [f64],
    /// Values of its shape parameters.
    pub shapes: &'a [f64],
    /// Joint of each formal joint.
    pub joints: &'a [usize],
    /// Position, velocity, acceleration, rigid-body torque and measured torque of every joint.
    pub signals: [&'a [f64]; 5],
    /// Values of the definition's inputs.
    pub inputs: &'a [f64],
    /// Values of its states.
    pub states: &'a [f64],
    /// Its bindings, which are looked through.
    pub bindings: &'a [EffectBinding],
    /// Seconds since the start of the log.
    pub time: f64,
}

/// Evaluates an expression.
#[must_use]
pub fn value(expr: &EffectExpr, scope: &Scope<'_>) -> f64 {
    match expr {
        Expr::Number(number) => *number,
        Expr::Leaf(leaf) => leaf_value(*leaf, scope),
        Expr::Neg(x) => -value(x, scope),
        Expr::Binary(op, x, y) => {
            let (x, y) = (value(x, scope), value(y, scope));
            match op {
                BinaryOp::Add => x + y,
                BinaryOp::Sub => x - y,
                BinaryOp::Mul => x * y,
                BinaryOp::Div => x / y,
                BinaryOp::Pow => x.powf(y),
            }
        }
        Expr::Min(x, y) => value(x, scope).min(value(y, scope)),
        Expr::Max(x, y) => value(x, scope).max(value(y, scope)),
        Expr::Choice(choice) if value(&choice.greater, scope) > value(&choice.smaller, scope) => {
            value(&choice.then, scope)
        }
        Expr::Choice(choice) => value(&choice.otherwise, scope),
        Expr::Call(function, x) => {
            let x = value(x, scope);
            match function {
                Function::Sin => x.sin(),
                Function::Cos => x.cos(),
                Function::Exp => x.exp(),
                Function::Sqrt => x.sqrt(),
                Function::Abs => x.abs(),
                Function::Tanh => x.tanh(),
                Function::Sign if x > 0.0 => 1.0,
                Function::Sign if x < 0.0 => -1.0,
                Function::Sign => 0.0,
            }
        }
    }
}

fn leaf_value(leaf: EffectLeaf, scope: &Scope<'_>) -> f64 {
    match leaf {
        EffectLeaf::Linear(k) => scope.linear[k],
        EffectLeaf::Shape(k) => scope.shapes[k],
        EffectLeaf::Time => scope.time,
        EffectLeaf::Input(k) => scope.inputs[k],
        EffectLeaf::State(k) => scope.states[k],
        EffectLeaf::Binding(k) => value(&scope.bindings[k].value, scope),
        EffectLeaf::Signal(signal, formal) => {
            let values = scope.signals[match signal {
                Signal::Position => 0,
                Signal::Velocity => 1,
                Signal::Acceleration => 2,
                Signal::RigidTorque => 3,
                Signal::MeasuredTorque => 4,
            }];
            values[scope.joints[formal]]
        }
    }
}
