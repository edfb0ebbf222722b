//! One function in Rust: signature, doc comment with its cost, statements, outputs last.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::super::function::{Equations, Function, Layout, Returns, Step};
use super::super::schedule::{Schedule, Temporary};
use super::expression::Printer;

/// The function.
pub fn item(function: &Function) -> TokenStream {
    let printer = Printer::of_scalars();
    let outputs = function.schedule.outputs.iter();
    let outputs: Vec<TokenStream> = outputs.map(|output| printer.tokens(output)).collect();
    let mut statements = statements(&printer, function, &outputs);
    let (kind, mut result) = result(function, &outputs);
    if function.layout() == Layout::Sparse && !statements.is_empty() {
        statements = quote!(let mut y = #result; __blank!(); #statements);
        result = quote!(y);
    }
    if let Returns::Accelerations(Equations::Nonlinear) = function.returns {
        let dof = count(function.sizes[0]);
        result = quote!(::robot_model::solve::newton(|ddq: &[S; #dof]| { #statements #result }));
        statements = quote!();
    }
    let parameters = function.arguments.iter().map(|argument| {
        let name = if argument.is_read {
            argument.name.to_owned()
        } else {
            format!("_{}", argument.name)
        };
        let name = Ident::new(&name, Span::call_site());
        if let Some(length) = argument.length {
            let length = count(length);
            quote!(#name: &[S; #length])
        } else if argument.name == "seconds" {
            // Seconds are those of a clock, whatever the arm computes with.
            quote!(#name: f64)
        } else {
            quote!(#name: S)
        }
    });
    let name = Ident::new(function.name, Span::call_site());
    let doc = function.doc.iter().enumerate().map(|(k, paragraph)| {
        let before = (k > 0).then(|| quote!(#[doc = ""]));
        let paragraph = format!(" {}", paragraph.replace("{none}", "`None`"));
        quote!(#before #[doc = #paragraph])
    });
    // Clippy counts to seven; what a torque depends on is not fewer things for that.
    let many = (function.arguments.len() > 7).then(
        || quote!(#[allow(clippy::too_many_arguments, reason = "all that the equations read")]),
    );
    // The sine of 45 degrees is not what somebody meant by `FRAC_1_SQRT_2`.
    let exact = printer
        .has_famous_numbers()
        .then(|| quote!(#[allow(clippy::approx_constant, reason = "the spec's numbers")]));
    quote! {
        #(#doc)*
        #many
        #exact
        #[must_use]
        pub fn #name<S: ::robot_model::Scalar>(#(#parameters),*) -> #kind {
            #statements
            #result
        }
    }
}

fn count(n: usize) -> Literal {
    Literal::usize_unsuffixed(n)
}

/// Statements under their section comments.
fn statements(printer: &Printer, function: &Function, outputs: &[TokenStream]) -> TokenStream {
    let temporary = |temporary: &Temporary| {
        let name = Ident::new(&temporary.name, Span::call_site());
        let value = printer.tokens(&temporary.value);
        quote!(let #name = #value;)
    };
    let section = |title: &str, statements: TokenStream| {
        if statements.is_empty() {
            quote!()
        } else {
            quote!(__comment!(#title); #statements __blank!();)
        }
    };
    let mut trigonometry: TokenStream = function.schedule.sums.iter().map(temporary).collect();
    trigonometry.extend(sines_cosines(printer, &function.schedule));
    let trigonometry = section("Trigonometry.", trigonometry);
    let steps = function.steps().into_iter().map(|step| match step {
        Step::Shared(shared) => temporary(shared),
        Step::Entry(k) => {
            let columns = function.sizes[1];
            let (row, column) = (count(k / columns), count(k % columns));
            let entry = &outputs[k];
            quote!(y[#row][#column] = #entry;)
        }
    });
    let steps = section(function.title_of_steps(), steps.collect());
    quote!(#trigonometry #steps)
}

/// `let [sines, cosines] = S::sines_cosines([q[0], q[1]]); let [sin_q1, sin_q2] = sines; let [cos_q1, _] = cosines;`
fn sines_cosines(printer: &Printer, schedule: &Schedule) -> Option<TokenStream> {
    let angles = &schedule.angles;
    if angles.is_empty() {
        return None;
    }
    let (mut rows, mut entries) = (Vec::new(), TokenStream::new());
    let sines: Vec<_> = angles.iter().map(|angle| angle.sine.as_ref()).collect();
    let cosines: Vec<_> = angles.iter().map(|angle| angle.cosine.as_ref()).collect();
    for (row, names) in [("sines", sines), ("cosines", cosines)] {
        if names.iter().all(Option::is_none) {
            rows.push(quote!(_));
            continue;
        }
        let row = Ident::new(row, Span::call_site());
        let names = names.into_iter().map(|name| {
            name.map_or_else(
                || quote!(_),
                |name| {
                    let name = Ident::new(name, Span::call_site());
                    quote!(#name)
                },
            )
        });
        entries.extend(quote!(let [#(#names),*] = #row;));
        rows.push(quote!(#row));
    }
    let values = angles.iter().map(|angle| printer.tokens(&angle.value));
    Some(quote!(let [#(#rows),*] = S::sines_cosines([#(#values),*]); #entries))
}

/// The return type and the expression that makes the result.
fn result(function: &Function, outputs: &[TokenStream]) -> (TokenStream, TokenStream) {
    let kind = function.sizes.iter().rev().fold(quote!(S), |kind, &size| {
        let size = count(size);
        quote!([#kind; #size])
    });
    match &function.returns {
        Returns::Memory(counts) => (kind, after_step(counts, outputs)),
        Returns::Accelerations(equations) => {
            let result = accelerations(function, *equations, outputs);
            (quote!(::core::option::Option<#kind>), result)
        }
        Returns::Matrix(0) => {
            let rows = count(function.sizes[0]);
            (kind, quote!([[]; #rows]))
        }
        _ if function.layout() == Layout::Sparse => {
            let (height, width) = (count(function.sizes[0]), count(function.sizes[1]));
            (kind, quote!([[S::of(0.0); #width]; #height]))
        }
        _ => (kind, nested(&function.sizes, outputs)),
    }
}

/// `[[a, b], [c, d]]`
fn nested(sizes: &[usize], outputs: &[TokenStream]) -> TokenStream {
    let [size, inner @ ..] = sizes else {
        return quote!(#(#outputs)*);
    };
    let parts = outputs.chunks((outputs.len() / size.max(&1)).max(1));
    let parts = parts.map(|part| nested(inner, part));
    quote!([#(#parts),*])
}

/// The equations solved for accelerations.
fn accelerations(
    function: &Function,
    equations: Equations,
    outputs: &[TokenStream],
) -> TokenStream {
    let dof = function.sizes[0];
    let (slope, torque) = outputs.split_at(dof * dof);
    let slope = nested(&[dof, dof], slope);
    let rest = torque.iter().enumerate().map(|(joint, torque)| {
        let k = count(joint);
        if function.is_zero[dof * dof + joint] {
            quote!(tau[#k])
        } else {
            quote!(tau[#k] - (#torque))
        }
    });
    let rest = quote!([#(#rest),*]);
    match equations {
        Equations::Symmetric => quote!(::robot_model::solve::positive_definite(&#slope, &#rest)),
        Equations::General => quote!(::robot_model::solve::general(&#slope, &#rest)),
        Equations::Nonlinear => quote!((#slope, #rest)),
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
