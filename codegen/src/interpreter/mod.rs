//! Expressions run over many samples a call.
//!
//! In: a [`Dag`] and the outputs wanted. Out: a [`Program`], a flat schedule over reused registers. Each instruction works
//! on a block of samples at a time, so that its cost is shared and the compiler vectorizes it.

mod schedule;

use crate::expr::{Dag, ExprId, Function, Symbol};
use crate::optimize::{Optimized, optimize};
use schedule::Scheduler;

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
    Select {
        target: Register,
        condition: Register,
        x: Register,
        y: Register,
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

/// Registers and outputs of a program that runs one sample at a time.
#[derive(Debug, Clone)]
pub struct Scratch {
    operands: Vec<Operand<'static>>,
    registers: Vec<[f64; 1]>,
    out: Vec<Vec<f64>>,
}

impl Scratch {
    /// Output `k` of the last run.
    #[must_use]
    pub fn output(&self, k: usize) -> f64 {
        self.out[k][0]
    }
}

impl Program {
    /// Schedules `outputs` with as few operations as the emitted code has.
    #[must_use]
    pub fn new(dag: &Dag, outputs: &[ExprId]) -> Self {
        let Optimized { dag, outputs } = optimize(dag, outputs);
        Scheduler::new(&dag, &outputs).schedule(&outputs)
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

    /// Room for [`Self::eval_in`].
    #[must_use]
    pub fn scratch(&self) -> Scratch {
        Scratch {
            operands: vec![Operand::Constant(0.0); self.symbols.len()],
            registers: vec![[0.0; 1]; self.registers],
            out: vec![vec![0.0]; self.outputs],
        }
    }

    /// Evaluates one sample without allocation; `values` has one number per [`Self::symbols`].
    pub fn eval_in(&self, values: &[f64], scratch: &mut Scratch) {
        for (operand, &value) in scratch.operands.iter_mut().zip(values) {
            *operand = Operand::Constant(value);
        }
        let Scratch {
            operands,
            registers,
            out,
        } = scratch;
        self.run_block(operands, 0..1, registers, out);
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
                Instruction::Select {
                    target,
                    condition,
                    x,
                    y,
                } => {
                    // Copies: any two of the operands may be one register.
                    let (condition, x, y) = (registers[condition], registers[x], registers[y]);
                    registers[target] = std::array::from_fn(|lane| {
                        if condition[lane] > 0.0 {
                            x[lane]
                        } else {
                            y[lane]
                        }
                    });
                }
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
