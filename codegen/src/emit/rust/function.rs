//! One emitted function: signature, doc comment with its cost, statements, outputs last.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::body::{self, Cost};
use super::render::Binding;
use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Names, Symbol};

/// A matrix with more columns is written entry by entry.
const WIDEST_ROW: usize = 8;

/// What functions are made from.
pub struct Context<'a> {
    pub compiled: &'a Compiled,
    pub names: &'a Names,
    pub binding: &'a Binding<'a>,
    pub dag: &'a Dag,
}

/// The function wanted.
pub struct Task {
    pub name: &'static str,
    /// First paragraph of the doc comment.
    pub doc: &'static str,
    /// Arguments in order, separated by spaces; `rigid_torque`, `time` and `shapes` are left out where they are not read.
    pub arguments: &'static str,
    /// Row by row.
    pub outputs: Vec<ExprId>,
    pub returns: Returns,
}

/// Shape of the result.
#[derive(Clone, Copy)]
pub enum Returns {
    /// One entry a joint.
    Vector,
    /// One row a joint, this many columns.
    Matrix(usize),
    /// One entry a base parameter.
    Base,
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
        let body = body::body(self.dag, self.names, self.binding, &task.outputs);
        let reads = |argument: &str| {
            body.symbols
                .iter()
                .any(|&symbol| argument_of(symbol, task) == argument)
        };
        let optional = |argument: &str| matches!(argument, "rigid_torque" | "time" | "shapes");
        let arguments: Vec<&'static str> = task
            .arguments
            .split(' ')
            .filter(|argument| !optional(argument) || reads(argument))
            .collect();
        let parameters = arguments.iter().map(|&argument| {
            let name = if reads(argument) {
                argument.to_owned()
            } else {
                format!("_{argument}")
            };
            let name = Ident::new(&name, Span::call_site());
            if let Some(length) = self.length(argument) {
                quote!(#name: &[f64; #length])
            } else {
                quote!(#name: f64)
            }
        });
        let name = Ident::new(task.name, Span::call_site());
        let doc = format!(" {}", task.doc);
        let cost = format!(" Cost: {}.", body.cost);
        let statements = &body.statements;
        let (kind, result) = self.result(task, &body.outputs);
        let item = quote! {
            #[doc = #doc]
            #[doc = ""]
            #[doc = #cost]
            #[must_use]
            pub fn #name(#(#parameters),*) -> #kind {
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
            "time" => return None,
            "beta" => self.compiled.base.kept.len(),
            "standard" => self.compiled.standard.len(),
            "shapes" => self.compiled.free_shapes().len(),
            _ => self.compiled.dof(),
        };
        Some(Literal::usize_unsuffixed(length))
    }

    /// The return type and the expression that makes the result.
    fn result(&self, task: &Task, outputs: &[TokenStream]) -> (TokenStream, TokenStream) {
        let rows = Literal::usize_unsuffixed(self.compiled.dof());
        match task.returns {
            Returns::Vector => (quote!([f64; #rows]), quote!([#(#outputs),*])),
            Returns::Base => {
                let length = Literal::usize_unsuffixed(outputs.len());
                (quote!([f64; #length]), quote!([#(#outputs),*]))
            }
            Returns::Matrix(columns) if columns <= WIDEST_ROW => {
                let width = Literal::usize_unsuffixed(columns);
                let rows_of_entries = outputs
                    .chunks(columns.max(1))
                    .map(|row| quote!([#(#row),*]));
                (
                    quote!([[f64; #width]; #rows]),
                    quote!([#(#rows_of_entries),*]),
                )
            }
            Returns::Matrix(columns) => {
                let width = Literal::usize_unsuffixed(columns);
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
                (
                    quote!([[f64; #width]; #rows]),
                    quote!(let mut y = [[0.0; #width]; #rows]; #(#entries)* y),
                )
            }
        }
    }
}

/// The argument that a symbol is read from.
fn argument_of(symbol: Symbol, task: &Task) -> &'static str {
    match symbol {
        Symbol::Q(_) => "q",
        Symbol::Dq(_) => "dq",
        Symbol::Ddq(_) => "ddq",
        Symbol::RigidTorque(_) => "rigid_torque",
        Symbol::Time => "time",
        Symbol::Parameter(_) if task.arguments.contains("standard") => "standard",
        Symbol::Parameter(_) => "beta",
        Symbol::Shape(_) => "shapes",
    }
}
