//! Function bodies: which expressions get a name, in which order they are computed, and what that costs.

use std::collections::BTreeSet;

use super::names::Namer;
use super::written::{Binding, Writer, Written};
use crate::expr::{Dag, ExprId, Function, Names, Node, Symbol};
use crate::optimize::{Cost, operations};

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
            cost: operations(dag, outputs),
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
    let uses = dag.uses(order, outputs);
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
        // A product divides by what only it has the reciprocal of.
        let divides = matches!(dag.node(x), Node::Call(Function::Recip, _)) && uses[x.index()] == 1;
        if atom || divides || dag.is_negation(x) {
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

#[cfg(test)]
mod tests {
    use super::super::written::{Operator, Place, Written};
    use super::Schedule;
    use crate::expr::{Dag, Names, Symbol};
    use crate::optimize::Cost;

    /// Counts what is written down.
    fn count(written: &Written, cost: &mut Cost) {
        match written {
            Written::Number(_) | Written::Place(_) | Written::Name(_) => {}
            Written::Parentheses(x) | Written::Negative(x) => count(x, cost),
            Written::Binary(operator, both) => {
                match operator {
                    Operator::Plus | Operator::Minus => cost.add += 1,
                    Operator::Times => cost.mul += 1,
                    Operator::Over => cost.div += 1,
                }
                both.iter().for_each(|x| count(x, cost));
            }
            Written::Call(..) | Written::Power(_) | Written::Choice(_) => {
                unreachable!("quotients have none")
            }
        }
    }

    /// Reciprocals that one product uses, that several use, that are subtracted and that are made before the other factor.
    #[test]
    fn the_page_has_the_operations_that_it_says() {
        let mut dag = Dag::new();
        let [x, y, a] = [0, 1, 2].map(|k| dag.symbol(Symbol::Q(k)));
        let (over_x, sum) = (dag.call(crate::expr::Function::Recip, x), dag.add(y, a));
        let behind = dag.mul(over_x, sum);
        let half = dag.scale(2.0, over_x);
        let subtracted = dag.sub(y, half);
        let [first, second, third] = [y, a, sum].map(|other| dag.mul(over_x, other));
        let outputs = [
            vec![behind],
            vec![subtracted],
            vec![first, second, third],
            vec![over_x],
        ];
        for (outputs, wanted) in outputs
            .iter()
            .zip([(0, 1, 1), (0, 1, 1), (3, 1, 1), (0, 0, 1)])
        {
            let names = Names::default();
            let place = |_| Place::Entry("q", 0);
            let schedule = Schedule::new(&dag, &names, &place, outputs);
            let mut found = Cost::default();
            let shared = schedule.shared.iter().chain(&schedule.sums);
            let written = shared.map(|temporary| &temporary.value);
            written
                .chain(&schedule.outputs)
                .for_each(|x| count(x, &mut found));
            assert_eq!(found, schedule.cost);
            assert_eq!((found.mul, found.add, found.div), wanted);
        }
    }
}
