//! Function bodies: which expressions get a name, in which order they are computed, and what that costs.

use std::collections::BTreeSet;

use super::names::Namer;
use super::written::{Binding, Writer, Written};
use crate::expr::{Dag, ExprId, Function, Names, Node, Symbol};
use crate::optimize::Cost;

/// An expression with more operations than this is broken up by a named part.
const LONGEST_EXPRESSION: usize = 12;

/// What a function computes, in order.
#[derive(Debug)]
pub struct Schedule {
    /// Angles that are sums of positions.
    pub sums: Vec<Temporary>,
    /// Angles whose sines and cosines are computed at once.
    pub angles: Vec<Angle>,
    /// What is used more than once, and parts of long expressions.
    pub shared: Vec<Temporary>,
    /// One expression per output.
    pub outputs: Vec<Written>,
    /// How many of `shared` each output needs: it may be set down behind them, so that what it is made of is held no longer.
    pub ready: Vec<usize>,
    /// What all of it costs.
    pub cost: Cost,
    /// The arguments that are read.
    pub reads: BTreeSet<&'static str>,
}

/// A value with a name.
#[derive(Debug)]
pub struct Temporary {
    pub name: String,
    pub value: Written,
}

/// An angle, with names for its sine and cosine where they are used.
#[derive(Debug)]
pub struct Angle {
    pub value: Written,
    pub sine: Option<String>,
    pub cosine: Option<String>,
}

impl Schedule {
    /// Outputs that are written out, and cost nothing to speak of.
    pub fn of_outputs(outputs: Vec<Written>) -> Self {
        Self {
            sums: Vec::new(),
            angles: Vec::new(),
            shared: Vec::new(),
            ready: vec![0; outputs.len()],
            outputs,
            cost: Cost::default(),
            reads: BTreeSet::new(),
        }
    }

    /// Schedules the outputs of one function.
    pub fn new(dag: &Dag, names: &Names, binding: &Binding<'_>, outputs: &[ExprId]) -> Self {
        let order = dag.reachable(outputs);
        let named = named_expressions(dag, &order, outputs);
        let mut namer = Namer::new(dag, names);
        let mut writer = Writer::new(dag, binding);
        let (mut sums, mut shared) = (Vec::new(), Vec::new());
        let (mut angles, mut known) = (Vec::<Angle>::new(), Vec::new());
        // How many of `shared` an expression needs.
        let mut needs = vec![0; dag.len()];
        for &x in &order {
            let operands = dag.node(x).operands();
            needs[x.index()] = operands.map(|x| needs[x.index()]).max().unwrap_or(0);
            if !named[x.index()] {
                continue;
            }
            let name = namer.name(x);
            writer.set_name(x, name.clone());
            match dag.node(x) {
                Node::Call(function @ (Function::Sin | Function::Cos), angle)
                    if is_sum_of_positions(dag, angle) =>
                {
                    writer.count_trig();
                    let place = known.iter().position(|&one| one == angle);
                    let place = place.unwrap_or_else(|| {
                        known.push(angle);
                        angles.push(Angle {
                            value: writer.value(angle),
                            sine: None,
                            cosine: None,
                        });
                        known.len() - 1
                    });
                    if function == Function::Sin {
                        angles[place].sine = Some(name);
                    } else {
                        angles[place].cosine = Some(name);
                    }
                }
                _ => {
                    let value = writer.definition(x);
                    if is_sum_of_positions(dag, x) {
                        sums.push(Temporary { name, value });
                        continue;
                    }
                    shared.push(Temporary { name, value });
                    needs[x.index()] = shared.len();
                }
            }
        }
        let symbols = dag.symbols(&order);
        Self {
            sums,
            angles,
            shared,
            ready: outputs.iter().map(|x| needs[x.index()]).collect(),
            outputs: outputs.iter().map(|&x| writer.value(x)).collect(),
            cost: writer.cost(),
            reads: symbols.into_iter().map(|x| binding(x).argument()).collect(),
        }
    }
}

/// Sines and cosines of sums of multiples of positions can be computed first, and so can these sums.
fn is_sum_of_positions(dag: &Dag, x: ExprId) -> bool {
    match dag.node(x) {
        Node::Constant(_) | Node::Symbol(Symbol::Q(_)) => true,
        Node::Add(p, q) => is_sum_of_positions(dag, p) && is_sum_of_positions(dag, q),
        Node::Mul(factor, rest) => {
            dag.as_constant(factor).is_some() && is_sum_of_positions(dag, rest)
        }
        _ => false,
    }
}

/// Which expressions become temporaries: those used more than once, function calls, and parts of long expressions.
pub fn named_expressions(dag: &Dag, order: &[ExprId], outputs: &[ExprId]) -> Vec<bool> {
    let mut uses = vec![0usize; dag.len()];
    for &output in outputs {
        uses[through_sign(dag, output).index()] += 1;
    }
    for &x in order.iter().rev().filter(|&&x| !is_negation(dag, x)) {
        // What only hung on a negation was counted for its operand.
        if uses[x.index()] > 0 {
            for operand in dag.node(x).operands() {
                uses[through_sign(dag, operand).index()] += 1;
            }
        }
    }
    let mut named = vec![false; dag.len()];
    // Operations in the expression if it is written out where it is used.
    let mut size = vec![0usize; dag.len()];
    for &x in order {
        let inline: usize = dag
            .node(x)
            .operands()
            .map(|operand| size[operand.index()])
            .sum();
        let (atom, call) = match dag.node(x) {
            Node::Constant(_) | Node::Symbol(_) => (true, false),
            Node::Call(function, _) => (false, function != Function::Recip),
            Node::Select(..) => (false, true),
            _ => (false, false),
        };
        if atom || is_negation(dag, x) {
            size[x.index()] = inline;
        } else if call || uses[x.index()] > 1 || inline + 1 > LONGEST_EXPRESSION {
            named[x.index()] = uses[x.index()] > 0;
        } else {
            size[x.index()] = inline + 1;
        }
    }
    // A result on its own is written where it is returned.
    if let [only] = outputs {
        named[only.index()] = false;
    }
    named
}

/// `-x` costs nothing where it is added or multiplied; it is never a temporary.
pub fn is_negation(dag: &Dag, x: ExprId) -> bool {
    matches!(dag.node(x), Node::Mul(..)) && dag.coefficient(x).0.to_bits() == (-1.0f64).to_bits()
}

fn through_sign(dag: &Dag, x: ExprId) -> ExprId {
    match (is_negation(dag, x), dag.coefficient(x).1) {
        (true, Some(positive)) => positive,
        _ => x,
    }
}
