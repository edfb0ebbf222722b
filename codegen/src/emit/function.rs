//! One emitted function, before a language spells it: arguments, schedule, shape of the result, doc comment.

use super::schedule::{Schedule, Temporary};
use super::written::{Binding, Place};
use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Names, Symbol};
use crate::optimize::{Cost, Optimized, optimize};

/// A matrix with more columns is written entry by entry.
const WIDEST_ROW: usize = 8;

/// Arguments that a function has only where it reads them.
const OPTIONAL: [&str; 6] = [
    "rigid_torque",
    "measured_torque",
    "time",
    "inputs",
    "states",
    "shapes",
];

/// What functions are made from.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    pub compiled: &'a Compiled,
    pub names: &'a Names,
    pub binding: &'a Binding<'a>,
    pub dag: &'a Dag,
    /// A paragraph for the doc comments; often none.
    pub note: &'a str,
}

/// The function wanted.
pub struct Task {
    pub name: &'static str,
    /// First paragraph of the doc comment.
    pub doc: &'static str,
    /// Arguments in order, separated by spaces; those of [`OPTIONAL`] are left out where they are not read.
    pub arguments: &'static str,
    /// What the result is called where results have names.
    pub result: &'static str,
    /// Row by row.
    pub outputs: Vec<ExprId>,
    pub returns: Returns,
}

/// Shape of the result.
#[derive(Clone)]
pub enum Returns {
    /// One entry a joint.
    Vector,
    /// Rows of this many columns.
    Matrix(usize),
    /// As many entries as there are outputs.
    List,
    /// A number.
    Scalar,
    /// Homogeneous matrices, one a joint.
    Poses,
    /// Matrices of this many rows and one column a joint.
    Stack(usize),
    /// Outputs are the slope of the torque by the accelerations row by row, then the torque: accelerations where these
    /// equations have a solution.
    Accelerations(Equations),
    /// Outputs are the rates and their slopes, effect by effect: internal states after a step. `[k]` is how many states effect
    /// `k` has.
    Memory(Vec<usize>),
}

/// How accelerations are solved for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Equations {
    /// The slope is a symmetric matrix, positive definite for physical parameters; the torque is that of `ddq = 0`.
    Symmetric,
    /// The slope is any matrix; the torque is that of `ddq = 0`.
    General,
    /// Slope and torque depend on `ddq`.
    Nonlinear,
}

/// A function on the page.
pub struct Function {
    pub name: &'static str,
    /// Paragraphs of the doc comment.
    pub doc: Vec<String>,
    /// The arguments that it has.
    pub arguments: Vec<Argument>,
    pub result: &'static str,
    /// Sizes of the result, from the outermost; a number has none.
    pub sizes: Vec<usize>,
    pub returns: Returns,
    pub schedule: Schedule,
    /// Outputs that are zero whatever the arguments are.
    pub is_zero: Vec<bool>,
}

/// An argument of a function.
pub struct Argument {
    pub name: &'static str,
    /// Its entries; `None` for a number.
    pub length: Option<usize>,
    pub is_read: bool,
}

/// How the entries of a result are set down.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// All of them.
    Full,
    /// Zeros at once, then the others one by one, each as soon as it is known.
    Sparse,
}

/// A statement of a function's body.
pub enum Step<'a> {
    /// A temporary is computed.
    Shared(&'a Temporary),
    /// Entry `[k]` of the result is set down.
    Entry(usize),
}

impl Function {
    /// What it costs.
    pub fn cost(&self) -> Cost {
        self.schedule.cost
    }

    /// Whether it has the argument.
    pub fn takes(&self, argument: &str) -> bool {
        let mut arguments = self.arguments.iter();
        arguments.any(|known| known.name == argument)
    }

    /// Shared terms; in a sparse layout each entry as soon as all that it needs is there, so that this is held no longer.
    pub fn steps(&self) -> Vec<Step<'_>> {
        let ready = self.schedule.ready.iter().copied().enumerate();
        let is_sparse = self.layout() == Layout::Sparse;
        let mut entries: Vec<(usize, usize)> = ready
            .filter(|&(k, _)| is_sparse && !self.is_zero[k])
            .map(|(k, ready)| (ready, k))
            .collect();
        entries.sort_unstable();
        let mut entries = entries.into_iter().peekable();
        let mut steps = Vec::new();
        for count in 0..=self.schedule.shared.len() {
            if let Some(last) = count.checked_sub(1) {
                steps.push(Step::Shared(&self.schedule.shared[last]));
            }
            while let Some((_, k)) = entries.next_if(|&(ready, _)| ready == count) {
                steps.push(Step::Entry(k));
            }
        }
        steps
    }

    /// What stands over the steps.
    pub fn title_of_steps(&self) -> &'static str {
        match self.layout() {
            Layout::Full => "Shared terms.",
            Layout::Sparse => "Shared terms, and entries as soon as they are known.",
        }
    }

    /// Wide matrices are mostly zeros.
    pub fn layout(&self) -> Layout {
        match self.sizes[..] {
            [_, columns] if columns > WIDEST_ROW => Layout::Sparse,
            _ => Layout::Full,
        }
    }
}

impl Context<'_> {
    pub fn function(&self, task: &Task) -> Function {
        let Optimized { dag, outputs } = optimize(self.dag, &task.outputs);
        let schedule = Schedule::new(&dag, self.names, self.binding, &outputs);
        let reads = |argument: &str| {
            let is_read_outside = match task.returns {
                Returns::Accelerations(_) => argument == "tau",
                Returns::Memory(_) => matches!(argument, "states" | "seconds"),
                _ => false,
            };
            is_read_outside || schedule.reads.contains(argument)
        };
        let arguments = task
            .arguments
            .split(' ')
            .filter(|argument| !OPTIONAL.contains(argument) || reads(argument))
            .filter(|&argument| argument != "beta" || self.compiled.baked.is_none())
            .map(|name| Argument {
                name,
                length: self.length(name),
                is_read: reads(name),
            })
            .collect();
        let note = (!self.note.is_empty()).then(|| self.note.to_owned());
        let besides = match &task.returns {
            Returns::Accelerations(_) => ", besides the solution for the accelerations",
            Returns::Memory(_) => ", besides the steps of the states",
            _ => "",
        };
        let cost = format!("Cost: {}{besides}.", schedule.cost);
        Function {
            name: task.name,
            doc: [Some(task.doc.to_owned()), note, Some(cost)]
                .into_iter()
                .flatten()
                .collect(),
            arguments,
            result: task.result,
            sizes: self.sizes(&task.returns, outputs.len()),
            returns: task.returns.clone(),
            schedule,
            is_zero: task.outputs.iter().map(|&x| self.dag.is_zero(x)).collect(),
        }
    }

    /// Entries of an argument; `None` for a number.
    fn length(&self, argument: &str) -> Option<usize> {
        match argument {
            "time" | "seconds" => None,
            "beta" => Some(self.compiled.base.kept.len()),
            "standard" => Some(self.compiled.standard.len()),
            "shapes" => Some(self.compiled.free_shapes().len()),
            "inputs" => Some(self.compiled.model.inputs().len()),
            "states" => Some(self.compiled.model.states().len()),
            _ => Some(self.compiled.dof()),
        }
    }

    fn sizes(&self, returns: &Returns, outputs: usize) -> Vec<usize> {
        let dof = self.compiled.dof();
        match returns {
            Returns::Vector | Returns::Accelerations(_) => vec![dof],
            // Without columns there are rows all the same.
            Returns::Matrix(0) => vec![dof, 0],
            Returns::Matrix(columns) => vec![outputs / columns, *columns],
            Returns::List => vec![outputs],
            Returns::Scalar => Vec::new(),
            Returns::Poses => vec![outputs / 16, 4, 4],
            Returns::Stack(rows) => vec![outputs / (rows * dof).max(1), *rows, dof],
            Returns::Memory(counts) => vec![counts.iter().sum()],
        }
    }
}

/// Where a symbol is; `parameters` is the argument that has the parameters, at these places.
pub fn place(
    symbol: Symbol,
    parameter: &dyn Fn(usize) -> Place,
    shape: &dyn Fn(usize) -> Place,
) -> Place {
    match symbol {
        Symbol::Q(j) => Place::Entry("q", j),
        Symbol::Dq(j) => Place::Entry("dq", j),
        Symbol::Ddq(j) => Place::Entry("ddq", j),
        Symbol::RigidTorque(j) => Place::Entry("rigid_torque", j),
        Symbol::MeasuredTorque(j) => Place::Entry("measured_torque", j),
        Symbol::Input(k) => Place::Entry("inputs", k),
        Symbol::State(k) => Place::Entry("states", k),
        Symbol::Time => Place::Argument("time"),
        Symbol::Parameter(k) => parameter(k),
        Symbol::Shape(k) => shape(k),
        Symbol::Switch(_) | Symbol::Weight(_) => {
            unreachable!("in equations of simulation and design alone")
        }
    }
}
