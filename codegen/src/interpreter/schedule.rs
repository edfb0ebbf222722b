//! Which instruction computes a node, in which order, into which register.

use super::{Instruction, Program, Register};
use crate::expr::{Dag, ExprId, Node};

/// What a node is computed from, once constants and negations are absorbed.
#[derive(Clone, Copy)]
enum Step {
    Sub(ExprId, ExprId),
    Offset(ExprId, f64),
    Scale(ExprId, f64),
    Plain,
}

/// Assigns registers: a register is free again after the last use of its value.
pub(super) struct Scheduler<'a> {
    dag: &'a Dag,
    order: Vec<ExprId>,
    /// Uses that are still to come, by expression.
    uses: Vec<usize>,
    register: Vec<Option<Register>>,
    free: Vec<Register>,
    program: Program,
}

impl<'a> Scheduler<'a> {
    pub(super) fn new(dag: &'a Dag, outputs: &[ExprId]) -> Self {
        let order = dag.reachable(outputs);
        let mut uses = vec![0; dag.len()];
        for output in outputs {
            uses[output.index()] += 1;
        }
        // From users to operands: what only an absorbed node would have needed is never scheduled.
        for &x in order.iter().rev() {
            if uses[x.index()] > 0 {
                for operand in operands(dag, x) {
                    uses[operand.index()] += 1;
                }
            }
        }
        let program = Program {
            instructions: Vec::new(),
            symbols: Vec::new(),
            registers: 0,
            outputs: outputs.len(),
        };
        Self {
            dag,
            order,
            uses,
            register: vec![None; dag.len()],
            free: Vec::new(),
            program,
        }
    }

    /// The program of all outputs.
    pub(super) fn schedule(mut self, outputs: &[ExprId]) -> Program {
        for x in std::mem::take(&mut self.order) {
            if self.uses[x.index()] > 0 {
                self.compute(x);
                // An output leaves its register at once, so that outputs do not pile up.
                for output in (0..outputs.len()).filter(|&k| outputs[k] == x) {
                    let register = self.register_of(x);
                    self.program.instructions.push(Instruction::Store {
                        x: register,
                        output,
                    });
                    self.release(x);
                }
            }
        }
        self.program
    }

    fn compute(&mut self, x: ExprId) {
        let target = self.free.pop().unwrap_or_else(|| {
            self.program.registers += 1;
            self.program.registers - 1
        });
        let instruction = match (step(self.dag, x), self.dag.node(x)) {
            (Step::Sub(x, y), _) => Instruction::Sub {
                target,
                x: self.register_of(x),
                y: self.register_of(y),
            },
            (Step::Offset(x, value), _) => Instruction::Offset {
                target,
                x: self.register_of(x),
                value,
            },
            (Step::Scale(x, factor), _) => Instruction::Scale {
                target,
                x: self.register_of(x),
                factor,
            },
            (_, Node::Constant(value)) => Instruction::Constant {
                target,
                value: value.get(),
            },
            (_, Node::Symbol(symbol)) => {
                self.program.symbols.push(symbol);
                Instruction::Load {
                    target,
                    symbol: self.program.symbols.len() - 1,
                }
            }
            (_, Node::Add(x, y)) => Instruction::Add {
                target,
                x: self.register_of(x),
                y: self.register_of(y),
            },
            (_, Node::Mul(x, y)) => Instruction::Mul {
                target,
                x: self.register_of(x),
                y: self.register_of(y),
            },
            (_, Node::Power(x, y)) => Instruction::Power {
                target,
                x: self.register_of(x),
                y: self.register_of(y),
            },
            (_, Node::Call(function, x)) => Instruction::Call {
                target,
                function,
                x: self.register_of(x),
            },
            (_, Node::Select(condition, x, y)) => Instruction::Select {
                target,
                condition: self.register_of(condition),
                x: self.register_of(x),
                y: self.register_of(y),
            },
        };
        self.program.instructions.push(instruction);
        self.register[x.index()] = Some(target);
        for operand in operands(self.dag, x) {
            self.release(operand);
        }
    }

    fn register_of(&self, x: ExprId) -> Register {
        self.register[x.index()].expect("operands come before their users")
    }

    /// Counts one use; after the last the register is free.
    fn release(&mut self, x: ExprId) {
        self.uses[x.index()] -= 1;
        if self.uses[x.index()] == 0 {
            let register = self.register_of(x);
            self.free.push(register);
        }
    }
}

fn step(dag: &Dag, x: ExprId) -> Step {
    match dag.node(x) {
        Node::Add(p, q) => {
            for (here, other) in [(p, q), (q, p)] {
                if let Some(value) = dag.as_constant(here) {
                    return Step::Offset(other, value);
                }
                if let (-1.0, Some(negated)) = dag.coefficient(here)
                    && dag.as_constant(other).is_none()
                {
                    return Step::Sub(other, negated);
                }
            }
            Step::Plain
        }
        Node::Mul(p, q) => dag
            .as_constant(p)
            .map_or(Step::Plain, |factor| Step::Scale(q, factor)),
        _ => Step::Plain,
    }
}

/// The expressions whose registers a node reads.
fn operands(dag: &Dag, x: ExprId) -> Vec<ExprId> {
    match step(dag, x) {
        Step::Sub(x, y) => vec![x, y],
        Step::Offset(x, _) | Step::Scale(x, _) => vec![x],
        Step::Plain => dag.node(x).operands().collect(),
    }
}
