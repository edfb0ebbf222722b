//! Expressions run over many samples a call.
//!
//! In: a [`Dag`] and the outputs wanted. Out: a [`Program`], a flat schedule over reused registers. Each instruction works
//! on a block of samples at a time, so that its cost is shared and the compiler vectorizes it.

use crate::expr::{Dag, ExprId, Function, Node, Symbol};

/// Samples an instruction works on at a time.
const LANES: usize = 64;

/// Where a symbol's values come from.
#[derive(Debug, Clone, Copy)]
pub enum Operand<'a> {
    /// One value a sample.
    Column(&'a [f64]),
    /// The same value for all samples.
    Constant(f64),
}

type Register = usize;

/// `target` is never one of the operands.
#[derive(Debug, Clone, Copy)]
enum Instruction {
    Constant {
        target: Register,
        value: f64,
    },
    Load {
        target: Register,
        symbol: usize,
    },
    Add {
        target: Register,
        x: Register,
        y: Register,
    },
    Sub {
        target: Register,
        x: Register,
        y: Register,
    },
    Mul {
        target: Register,
        x: Register,
        y: Register,
    },
    Offset {
        target: Register,
        x: Register,
        value: f64,
    },
    Scale {
        target: Register,
        x: Register,
        factor: f64,
    },
    Power {
        target: Register,
        x: Register,
        y: Register,
    },
    Call {
        target: Register,
        function: Function,
        x: Register,
    },
    Store {
        x: Register,
        output: usize,
    },
}

/// A schedule that evaluates a list of expressions.
#[derive(Debug, Clone)]
pub struct Program {
    instructions: Vec<Instruction>,
    symbols: Vec<Symbol>,
    registers: usize,
    outputs: usize,
}

impl Program {
    /// Schedules `outputs` in the order of their construction.
    #[must_use]
    pub fn new(dag: &Dag, outputs: &[ExprId]) -> Self {
        Scheduler::new(dag, outputs).schedule(outputs)
    }

    /// The symbols that the program reads.
    #[must_use]
    pub fn symbols(&self) -> &[Symbol] {
        &self.symbols
    }

    /// Number of instructions.
    #[must_use]
    pub fn size(&self) -> usize {
        self.instructions.len()
    }

    /// Number of outputs.
    #[must_use]
    pub fn outputs(&self) -> usize {
        self.outputs
    }

    /// Evaluates `len` samples: `out[k][sample]` is output `k`. The vectors of `out` are resized to `len`.
    ///
    /// Every column that `bind` gives has at least `len` values, and `out` one vector per output.
    pub fn eval_batch<'a>(
        &self,
        len: usize,
        bind: &dyn Fn(Symbol) -> Operand<'a>,
        out: &mut [Vec<f64>],
    ) {
        assert_eq!(out.len(), self.outputs, "one vector per output");
        let operands: Vec<Operand<'a>> = self.symbols.iter().map(|&symbol| bind(symbol)).collect();
        for column in out.iter_mut() {
            column.clear();
            column.resize(len, 0.0);
        }
        let mut registers = vec![[0.0; LANES]; self.registers];
        for start in (0..len).step_by(LANES) {
            self.run_block(
                &operands,
                start..len.min(start + LANES),
                &mut registers,
                out,
            );
        }
    }

    /// Evaluates one sample.
    #[must_use]
    pub fn eval(&self, bind: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
        let operands: Vec<Operand<'_>> = self
            .symbols
            .iter()
            .map(|&symbol| Operand::Constant(bind(symbol)))
            .collect();
        let mut registers = vec![[0.0; 1]; self.registers];
        let mut out = vec![vec![0.0]; self.outputs];
        self.run_block(&operands, 0..1, &mut registers, &mut out);
        out.into_iter().flatten().collect()
    }

    /// Runs all instructions on the samples of `range`, at most `N`.
    fn run_block<const N: usize>(
        &self,
        operands: &[Operand<'_>],
        range: std::ops::Range<usize>,
        registers: &mut [[f64; N]],
        out: &mut [Vec<f64>],
    ) {
        for &instruction in &self.instructions {
            match instruction {
                Instruction::Constant { target, value } => registers[target] = [value; N],
                Instruction::Load { target, symbol } => match operands[symbol] {
                    Operand::Constant(value) => registers[target] = [value; N],
                    Operand::Column(values) => {
                        registers[target][..range.len()].copy_from_slice(&values[range.clone()]);
                    }
                },
                Instruction::Add { target, x, y } => binary(registers, target, x, y, |x, y| x + y),
                Instruction::Sub { target, x, y } => binary(registers, target, x, y, |x, y| x - y),
                Instruction::Mul { target, x, y } => binary(registers, target, x, y, |x, y| x * y),
                Instruction::Power { target, x, y } => binary(registers, target, x, y, f64::powf),
                Instruction::Offset { target, x, value } => {
                    unary(registers, target, x, |x| x + value);
                }
                Instruction::Scale { target, x, factor } => {
                    unary(registers, target, x, |x| x * factor);
                }
                Instruction::Call {
                    target,
                    function,
                    x,
                } => match function {
                    Function::Sin => unary(registers, target, x, f64::sin),
                    Function::Cos => unary(registers, target, x, f64::cos),
                    Function::Abs => unary(registers, target, x, f64::abs),
                    Function::Recip => unary(registers, target, x, f64::recip),
                    Function::Sqrt => unary(registers, target, x, f64::sqrt),
                    _ => unary(registers, target, x, |x| function.apply(x)),
                },
                Instruction::Store { x, output } => {
                    out[output][range.clone()].copy_from_slice(&registers[x][..range.len()]);
                }
            }
        }
    }
}

#[inline]
fn unary<const N: usize>(
    registers: &mut [[f64; N]],
    target: usize,
    x: usize,
    f: impl Fn(f64) -> f64,
) {
    let [target, x] = registers
        .get_disjoint_mut([target, x])
        .expect("a target is no operand");
    for (target, x) in target.iter_mut().zip(x) {
        *target = f(*x);
    }
}

#[inline]
fn binary<const N: usize>(
    registers: &mut [[f64; N]],
    target: usize,
    x: usize,
    y: usize,
    f: impl Fn(f64, f64) -> f64,
) {
    if x == y {
        return unary(registers, target, x, |x| f(x, x));
    }
    let [target, x, y] = registers
        .get_disjoint_mut([target, x, y])
        .expect("a target is no operand");
    for ((target, x), y) in target.iter_mut().zip(x).zip(y) {
        *target = f(*x, *y);
    }
}

/// What a node is computed from, once constants and negations are absorbed.
#[derive(Clone, Copy)]
enum Step {
    Sub(ExprId, ExprId),
    Offset(ExprId, f64),
    Scale(ExprId, f64),
    Plain,
}

/// Assigns registers: a register is free again after the last use of its value.
struct Scheduler<'a> {
    dag: &'a Dag,
    order: Vec<ExprId>,
    /// Uses that are still to come, by expression.
    uses: Vec<usize>,
    register: Vec<Option<Register>>,
    free: Vec<Register>,
    program: Program,
}

impl<'a> Scheduler<'a> {
    fn new(dag: &'a Dag, outputs: &[ExprId]) -> Self {
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

    fn schedule(mut self, outputs: &[ExprId]) -> Program {
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
