//! Emitted functions, and the same functions with their sines and cosines given: what is left is arithmetic.
//!
//! In: an emitted page. Out: for each wanted function `f` also `f_given`, whose last argument stands in place of the call of
//! `S::sines_cosines`, and `f_angles`, which returns the angles of that call.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::{Expr, FnArg, Item, ItemFn, Local, Pat, Stmt};

use crate::Error;

/// Functions of one form of an arm.
#[derive(Debug)]
pub struct Page {
    /// Their source.
    pub text: String,
    /// Names and arguments of those that are wanted, in the order of the page.
    pub functions: Vec<(String, Vec<String>)>,
}

/// The functions that are wanted, each with its two companions; all else on the page is left out.
pub fn functions(page: &str, wanted: &[&str]) -> Result<Page, Error> {
    let file = syn::parse_file(page)
        .map_err(|error| Error::new(format!("an emitted page does not parse: {error}")))?;
    let (mut items, mut functions) = (TokenStream::new(), Vec::<(String, _)>::new());
    for item in file.items {
        let Item::Fn(mut function) = item else {
            continue;
        };
        if wanted.iter().any(|name| function.sig.ident == name) {
            function
                .attrs
                .retain(|attribute| attribute.path().is_ident("allow"));
            let companions = companions(&function)?;
            items.extend(quote!(#function #companions));
            functions.push((function.sig.ident.to_string(), arguments(&function)));
        }
    }
    let is_there = |name: &&str| functions.iter().any(|(function, _)| function == name);
    if let Some(name) = wanted.iter().find(|name| !is_there(name)) {
        return Err(Error::new(format!(
            "an emitted page has no function `{name}`"
        )));
    }
    let file = syn::parse2(items)
        .map_err(|error| Error::new(format!("rewritten functions do not parse: {error}")))?;
    let text = prettyplease::unparse(&file);
    Ok(Page { text, functions })
}

/// Names of the arguments, also of those that are not read.
fn arguments(function: &ItemFn) -> Vec<String> {
    let names = function.sig.inputs.iter().filter_map(|input| match input {
        FnArg::Typed(argument) => match &*argument.pat {
            Pat::Ident(name) => Some(name.ident.to_string().trim_start_matches('_').to_owned()),
            _ => None,
        },
        FnArg::Receiver(_) => None,
    });
    names.collect()
}

fn companions(function: &ItemFn) -> Result<TokenStream, Error> {
    let name = &function.sig.ident;
    let statements = &function.block.stmts;
    let mut calls = statements.iter().enumerate();
    let Some((call, angles)) = calls.find_map(|(k, it)| Some((k, angles(it)?))) else {
        return Err(Error::new(format!(
            "`{name}` has no `let .. = S::sines_cosines([..])`: teach `benches/src/given.rs` how emitted code calls it"
        )));
    };
    let count = proc_macro2::Literal::usize_unsuffixed(angles.elems.len());
    let before = &statements[..call];

    let mut given = function.clone();
    given.sig.ident = format_ident!("{name}_given");
    given
        .sig
        .inputs
        .push(syn::parse_quote!(given: &[[S; #count]; 2]));
    if let Stmt::Local(Local {
        init: Some(init), ..
    }) = &mut given.block.stmts[call]
    {
        *init.expr = syn::parse_quote!(*given);
    }

    let mut list = function.clone();
    list.sig.ident = format_ident!("{name}_angles");
    list.sig.output = syn::parse_quote!(-> [S; #count]);
    *list.block = syn::parse_quote!({ #(#before)* #angles });
    Ok(quote!(#given #list))
}

/// `[..]` of `let .. = S::sines_cosines([..]);`
fn angles(statement: &Stmt) -> Option<&syn::ExprArray> {
    let Stmt::Local(Local {
        init: Some(init), ..
    }) = statement
    else {
        return None;
    };
    let Expr::Call(call) = &*init.expr else {
        return None;
    };
    match (&*call.func, call.args.first()) {
        (Expr::Path(path), Some(Expr::Array(angles)))
            if path.path.segments.last()?.ident == "sines_cosines" =>
        {
            Some(angles)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::functions;

    const PAGE: &str = "
        /// A torque.
        #[must_use]
        pub fn gravity<S: Scalar>(q: &[S; 2]) -> [S; 1] {
            let q1_q2 = q[0] + q[1];
            let [sines, cosines] = S::sines_cosines([q[0], q1_q2]);
            let [_, sin] = sines;
            [sin * cosines[0]]
        }
        pub fn bias<S: Scalar>(q: &[S; 2]) -> [S; 1] { [q[0]] }
        struct Arm;
    ";

    #[test]
    fn a_function_takes_what_it_would_have_computed() {
        let page = functions(PAGE, &["gravity"]).expect("it calls `sines_cosines`");
        assert_eq!(
            page.functions,
            [("gravity".to_owned(), vec!["q".to_owned()])]
        );
        let text = page.text;
        assert!(
            text.contains("pub fn gravity<S: Scalar>(q: &[S; 2]) -> [S; 1]"),
            "{text}"
        );
        assert!(
            text.contains("given: &[[S; 2]; 2]") && text.contains("= *given;"),
            "{text}"
        );
        assert!(
            text.contains("gravity_angles<S: Scalar>(q: &[S; 2]) -> [S; 2]"),
            "{text}"
        );
        assert_eq!(text.matches("S::sines_cosines").count(), 1, "{text}");
        assert!(!text.contains("bias") && !text.contains("Arm"), "{text}");
    }

    #[test]
    fn a_function_that_the_page_has_not_is_told() {
        let error = functions(PAGE, &["gravity", "mass_matrix"]).expect_err("none");
        assert!(error.to_string().contains("`mass_matrix`"), "{error}");
    }

    #[test]
    fn a_function_without_the_call_is_told() {
        let error = functions(PAGE, &["bias"]).expect_err("no call");
        assert!(error.to_string().contains("`bias`"), "{error}");
    }
}
