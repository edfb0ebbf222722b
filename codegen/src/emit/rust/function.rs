//! One emitted function: signature, doc comment with its cost, statements, outputs last.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::body::{self, Cost};
use super::render::Binding;
use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Names, Symbol};
use crate::optimize::{Optimized, optimize};

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
    pub item: TokenStream,
    pub cost: Cost,
    /// The arguments that it has.
    pub arguments: Vec<&'static str>,
}

impl Context<'_> {
    pub fn function(&self, task: &Task) -> Function {
        let Optimized { dag, outputs } = optimize(self.dag, &task.outputs);
        let body = body::body(&dag, self.names, self.binding, &outputs);
        let reads = |argument: &str| {
            let mut symbols = body.symbols.iter();
            let is_read_outside = match task.returns {
                Returns::Accelerations(_) => argument == "tau",
                Returns::Memory(_) => matches!(argument, "states" | "seconds"),
                _ => false,
            };
            is_read_outside || symbols.any(|&symbol| argument_of(symbol, task) == argument)
        };
        let optional = |argument: &str| OPTIONAL.contains(&argument);
        let arguments: Vec<&'static str> = task
            .arguments
            .split(' ')
            .filter(|argument| !optional(argument) || reads(argument))
            .filter(|&argument| argument != "beta" || self.compiled.baked.is_none())
            .collect();
        let parameters = arguments.iter().map(|&argument| {
            let name = if reads(argument) {
                argument.to_owned()
            } else {
                format!("_{argument}")
            };
            let name = Ident::new(&name, Span::call_site());
            if let Some(length) = self.length(argument) {
                quote!(#name: &[S; #length])
            } else {
                // Seconds are those of a clock, whatever the arm computes with.
                let kind = if argument == "seconds" {
                    quote!(f64)
                } else {
                    quote!(S)
                };
                quote!(#name: #kind)
            }
        });
        let name = Ident::new(task.name, Span::call_site());
        let doc = format!(" {}", task.doc);
        let note = (!self.note.is_empty()).then(|| {
            let note = format!(" {}", self.note);
            quote!(#[doc = #note] #[doc = ""])
        });
        let cost = format!(" Cost: {}.", body.cost);
        let statements = &body.statements;
        let (kind, result) = self.result(task, &body.outputs);
        let (statements, result) = match &task.returns {
            Returns::Accelerations(Equations::Nonlinear) => {
                let length = self.length("ddq");
                let inside = quote!(::robot_model::solve::newton(|ddq: &[S; #length]| { #statements #result }));
                (quote!(), inside)
            }
            _ => (quote!(#statements), result),
        };
        // Clippy counts to seven; what a torque depends on is not fewer things for that.
        let many = (arguments.len() > 7).then(
            || quote!(#[allow(clippy::too_many_arguments, reason = "all that the equations read")]),
        );
        // The sine of 45 degrees is not what somebody meant by `FRAC_1_SQRT_2`.
        let exact = body
            .has_famous_numbers
            .then(|| quote!(#[allow(clippy::approx_constant, reason = "the spec's numbers")]));
        let item = quote! {
            #[doc = #doc]
            #[doc = ""]
            #note
            #[doc = #cost]
            #many
            #exact
            #[must_use]
            pub fn #name<S: ::robot_model::Scalar>(#(#parameters),*) -> #kind {
                #statements
                #result
            }
        };
        Function {
            name: task.name,
            item,
            cost: body.cost,
            arguments,
        }
    }

    /// Entries of an argument; `None` for a scalar.
    fn length(&self, argument: &str) -> Option<Literal> {
        let length = match argument {
            "time" | "seconds" => return None,
            "beta" => self.compiled.base.kept.len(),
            "standard" => self.compiled.standard.len(),
            "shapes" => self.compiled.free_shapes().len(),
            "inputs" => self.compiled.model.inputs().len(),
            "states" => self.compiled.model.states().len(),
            _ => self.compiled.dof(),
        };
        Some(Literal::usize_unsuffixed(length))
    }

    /// The return type and the expression that makes the result.
    fn result(&self, task: &Task, outputs: &[TokenStream]) -> (TokenStream, TokenStream) {
        let dof = self.compiled.dof();
        let rows = match &task.returns {
            // Without columns there are rows all the same.
            Returns::Matrix(0) => dof,
            Returns::Matrix(columns) => outputs.len() / columns,
            Returns::Memory(counts) => counts.iter().sum(),
            _ => dof,
        };
        let rows = Literal::usize_unsuffixed(rows);
        match &task.returns {
            Returns::Memory(counts) => (quote!([S; #rows]), after_step(counts, outputs)),
            Returns::Scalar => (quote!(S), quote!(#(#outputs)*)),
            Returns::Poses => stack(outputs, 4, 4),
            Returns::Stack(rows) => stack(outputs, *rows, dof),
            Returns::Accelerations(equations) => {
                let (slope, torque) = outputs.split_at(dof * dof);
                let slope = slope.chunks(dof.max(1)).map(|row| quote!([#(#row),*]));
                let rest = torque.iter().enumerate().map(|(joint, torque)| {
                    let k = Literal::usize_unsuffixed(joint);
                    if self.dag.is_zero(task.outputs[dof * dof + joint]) {
                        quote!(tau[#k])
                    } else {
                        quote!(tau[#k] - (#torque))
                    }
                });
                let (slope, rest) = (quote!([#(#slope),*]), quote!([#(#rest),*]));
                let result = match equations {
                    Equations::Symmetric => {
                        quote!(::robot_model::solve::positive_definite(&#slope, &#rest))
                    }
                    Equations::General => quote!(::robot_model::solve::general(&#slope, &#rest)),
                    Equations::Nonlinear => quote!((#slope, #rest)),
                };
                (quote!(Option<[S; #rows]>), result)
            }
            Returns::Vector => (quote!([S; #rows]), quote!([#(#outputs),*])),
            Returns::List => {
                let length = Literal::usize_unsuffixed(outputs.len());
                (quote!([S; #length]), quote!([#(#outputs),*]))
            }
            Returns::Matrix(0) => (quote!([[S; 0]; #rows]), quote!([[]; #rows])),
            Returns::Matrix(columns) if *columns <= WIDEST_ROW => {
                let width = Literal::usize_unsuffixed(*columns);
                let rows_of_entries = outputs.chunks(*columns).map(|row| quote!([#(#row),*]));
                (
                    quote!([[S; #width]; #rows]),
                    quote!([#(#rows_of_entries),*]),
                )
            }
            Returns::Matrix(columns) => {
                let width = Literal::usize_unsuffixed(*columns);
                let entries = (0..)
                    .zip(outputs)
                    .filter(|&(k, _)| !self.dag.is_zero(task.outputs[k]))
                    .map(|(k, entry)| {
                        let (row, column) = (k / columns, k % columns);
                        let (row, column) = (
                            Literal::usize_unsuffixed(row),
                            Literal::usize_unsuffixed(column),
                        );
                        quote!(y[#row][#column] = #entry;)
                    });
                if outputs
                    .iter()
                    .zip(&task.outputs)
                    .all(|(_, &entry)| self.dag.is_zero(entry))
                {
                    return (
                        quote!([[S; #width]; #rows]),
                        quote!([[S::of(0.0); #width]; #rows]),
                    );
                }
                (
                    quote!([[S; #width]; #rows]),
                    quote!(let mut y = [[S::of(0.0); #width]; #rows]; #(#entries)* y),
                )
            }
        }
    }
}

/// `let [next0] = ::robot_model::memory::after(&[states[0]], seconds, &[rate], &[[slope]]); ..; [next0, ..]`
fn after_step(counts: &[usize], outputs: &[TokenStream]) -> TokenStream {
    let (mut first, mut outputs) = (0, outputs);
    let mut steps = TokenStream::new();
    let mut all = Vec::new();
    for &count in counts.iter().filter(|&&count| count > 0) {
        let (rates, rest) = outputs.split_at(count);
        let (slopes, rest) = rest.split_at(count * count);
        let slopes = slopes.chunks(count).map(|row| quote!([#(#row),*]));
        let numbers = first..first + count;
        let next: Vec<Ident> = numbers.clone().map(|k| format_ident!("next{k}")).collect();
        let now = numbers.map(|k| {
            let k = Literal::usize_unsuffixed(k);
            quote!(states[#k])
        });
        steps.extend(quote! {
            let [#(#next),*] = ::robot_model::memory::after(&[#(#now),*], seconds, &[#(#rates),*], &[#(#slopes),*]);
        });
        all.extend(next);
        (first, outputs) = (first + count, rest);
    }
    quote!(#steps [#(#all),*])
}

/// Matrices of the same size: their type, and their entries.
fn stack(outputs: &[TokenStream], rows: usize, columns: usize) -> (TokenStream, TokenStream) {
    let count = |n: usize| Literal::usize_unsuffixed(n);
    let matrices = outputs.chunks((rows * columns).max(1)).map(|matrix| {
        let rows = matrix.chunks(columns.max(1)).map(|row| quote!([#(#row),*]));
        quote!([#(#rows),*])
    });
    let number = count(matrices.len());
    let (rows, columns) = (count(rows), count(columns));
    (
        quote!([[[S; #columns]; #rows]; #number]),
        quote!([#(#matrices),*]),
    )
}

/// The argument that a symbol is read from.
fn argument_of(symbol: Symbol, task: &Task) -> &'static str {
    match symbol {
        Symbol::Q(_) => "q",
        Symbol::Dq(_) => "dq",
        Symbol::Ddq(_) => "ddq",
        Symbol::RigidTorque(_) => "rigid_torque",
        Symbol::MeasuredTorque(_) => "measured_torque",
        Symbol::Input(_) => "inputs",
        Symbol::State(_) => "states",
        Symbol::Time => "time",
        Symbol::Parameter(_) if task.arguments.contains("standard") => "standard",
        Symbol::Parameter(_) => "beta",
        Symbol::Shape(_) => "shapes",
    }
}
