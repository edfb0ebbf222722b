//! Checked expressions of the language to expressions of the dag.

use robot_model_spec::model::{BinaryOp, Expr, Function as SpecFunction};

use crate::expr::{Dag, ExprId, Function};

/// Lowers an expression whose leaves stand for what `leaf` says.
pub fn lower_with<Leaf: Copy>(
    dag: &mut Dag,
    expr: &Expr<Leaf>,
    leaf: &mut dyn FnMut(&mut Dag, Leaf) -> ExprId,
) -> ExprId {
    match expr {
        Expr::Number(value) => dag.constant(*value),
        Expr::Leaf(x) => leaf(dag, *x),
        Expr::Neg(x) => {
            let x = lower_with(dag, x, leaf);
            dag.neg(x)
        }
        Expr::Binary(op, x, y) => {
            let (x, y) = (lower_with(dag, x, leaf), lower_with(dag, y, leaf));
            match op {
                BinaryOp::Add => dag.add(x, y),
                BinaryOp::Sub => dag.sub(x, y),
                BinaryOp::Mul => dag.mul(x, y),
                BinaryOp::Div => dag.div(x, y),
                BinaryOp::Pow => dag.power(x, y),
            }
        }
        Expr::Call(function, x) => {
            let x = lower_with(dag, x, leaf);
            dag.call(expression_function(*function), x)
        }
        Expr::Min(x, y) => {
            let (x, y) = (lower_with(dag, x, leaf), lower_with(dag, y, leaf));
            dag.min(x, y)
        }
        Expr::Max(x, y) => {
            let (x, y) = (lower_with(dag, x, leaf), lower_with(dag, y, leaf));
            dag.max(x, y)
        }
        Expr::Choice(choice) => {
            let greater = lower_with(dag, &choice.greater, leaf);
            let smaller = lower_with(dag, &choice.smaller, leaf);
            let then = lower_with(dag, &choice.then, leaf);
            let otherwise = lower_with(dag, &choice.otherwise, leaf);
            let difference = dag.sub(greater, smaller);
            dag.select(difference, then, otherwise)
        }
    }
}

/// The dag's function for one of the language.
pub const fn expression_function(function: SpecFunction) -> Function {
    match function {
        SpecFunction::Sin => Function::Sin,
        SpecFunction::Cos => Function::Cos,
        SpecFunction::Exp => Function::Exp,
        SpecFunction::Sqrt => Function::Sqrt,
        SpecFunction::Abs => Function::Abs,
        SpecFunction::Sign => Function::Sign,
        SpecFunction::Tanh => Function::Tanh,
    }
}
