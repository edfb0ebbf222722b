//! Function bodies: which expressions get a name, in which order they are computed, and what that costs.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::names::Namer;
use super::render::{Binding, Renderer};
use crate::expr::{Dag, ExprId, Function, Names, Node, Symbol};
pub use crate::optimize::Cost;

/// An expression with more operations than this is broken up by a named part.
const LONGEST_EXPRESSION: usize = 12;

/// The statements of a function before its outputs are written.
pub struct Body {
    /// `let` statements under their section comments.
    pub statements: TokenStream,
    /// One expression per output.
    pub outputs: Vec<TokenStream>,
    /// What all of it costs.
    pub cost: Cost,
    /// Symbols that are read.
    pub symbols: Vec<Symbol>,
    /// Whether clippy would take a number for an approximation of another.
    pub has_famous_numbers: bool,
}

/// Schedules the outputs of one function.
pub fn body(dag: &Dag, names: &Names, binding: &Binding<'_>, outputs: &[ExprId]) -> Body {
    let order = dag.reachable(outputs);
    let named = named_expressions(dag, &order, outputs);
    let mut namer = Namer::new(dag, names);
    let mut renderer = Renderer::new(dag, binding);
    let (mut trigonometry, mut shared) = (Vec::new(), Vec::new());
    let mut angles = Angles::default();
    for &x in order.iter().filter(|x| named[x.index()]) {
        let value = renderer.definition(x);
        let name = Ident::new(&namer.name(x), Span::call_site());
        match dag.node(x) {
            Node::Call(function @ (Function::Sin | Function::Cos), angle)
                if is_sum_of_positions(dag, angle) =>
            {
                angles.add(function, angle, renderer.value(angle), name.clone());
            }
            _ if is_sum_of_positions(dag, x) => trigonometry.push(quote!(let #name = #value;)),
            _ => shared.push(quote!(let #name = #value;)),
        }
        renderer.set_name(x, name);
    }
    trigonometry.extend(angles.statement());
    let outputs: Vec<TokenStream> = outputs.iter().map(|&x| renderer.value(x)).collect();
    let section = |title: &str, statements: &[TokenStream]| {
        let title = Literal::string(title);
        if statements.is_empty() {
            quote!()
        } else {
            quote!(__comment!(#title); #(#statements)* __blank!();)
        }
    };
    let trigonometry = section("Trigonometry.", &trigonometry);
    let shared = section("Shared terms.", &shared);
    Body {
        statements: quote!(#trigonometry #shared),
        outputs,
        cost: renderer.cost(),
        has_famous_numbers: renderer.has_famous_numbers(),
        symbols: dag.symbols(&order),
    }
}

/// Angles whose sines and cosines are computed at once.
#[derive(Default)]
struct Angles {
    of: Vec<ExprId>,
    written: Vec<TokenStream>,
    /// Names of the sines, and of the cosines; nothing where one is not used.
    names: [Vec<Option<Ident>>; 2],
}

impl Angles {
    fn add(&mut self, function: Function, angle: ExprId, written: TokenStream, name: Ident) {
        let place = self.of.iter().position(|&known| known == angle);
        let place = place.unwrap_or_else(|| {
            self.of.push(angle);
            self.written.push(written);
            for names in &mut self.names {
                names.push(None);
            }
            self.of.len() - 1
        });
        let row = usize::from(function == Function::Cos);
        self.names[row][place] = Some(name);
    }

    /// `let [sines, cosines] = S::sines_cosines([q[0], q[1]]); let [sin_q1, sin_q2] = sines; let [cos_q1, _] = cosines;`
    fn statement(&self) -> Option<TokenStream> {
        let angles = &self.written;
        if angles.is_empty() {
            return None;
        }
        let (mut rows, mut entries) = (Vec::new(), TokenStream::new());
        for (row, names) in ["sines", "cosines"].iter().zip(&self.names) {
            if names.iter().all(Option::is_none) {
                rows.push(quote!(_));
                continue;
            }
            let row = Ident::new(row, Span::call_site());
            let names = names.iter().map(|name| {
                name.as_ref()
                    .map_or_else(|| quote!(_), |name| quote!(#name))
            });
            entries.extend(quote!(let [#(#names),*] = #row;));
            rows.push(quote!(#row));
        }
        Some(quote!(let [#(#rows),*] = S::sines_cosines([#(#angles),*]); #entries))
    }
}

/// Sines and cosines of sums of multiples of positions can be computed first, and so can these sums.
fn is_sum_of_positions(dag: &Dag, x: ExprId) -> bool {
    dag.reachable(&[x])
        .iter()
        .all(|&part| match dag.node(part) {
            Node::Constant(_) | Node::Symbol(Symbol::Q(_)) | Node::Add(..) => true,
            Node::Mul(factor, _) => dag.as_constant(factor).is_some(),
            _ => false,
        })
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
