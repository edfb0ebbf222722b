//! `log { q = "pos_a": deg, "pos_b": deg; .. }`

use syn::parse::{Parse, ParseStream};
use syn::{Ident, LitStr, Token};

use super::{Sink, block, doc_comment, found, semicolon, statements, word};
use crate::ast::{LogBlock, LogChannel, LogColumn};
use crate::diagnostic::syn_error;

/// Behind the word `log`.
pub(super) fn log(input: ParseStream, keyword: &Ident, errors: &mut Sink) -> syn::Result<LogBlock> {
    let (content, _) = block(input, "`{` and columns of logs")?;
    let mut channels = Vec::new();
    statements(&content, errors, |input, _| {
        doc_comment(input)?;
        channels.push(input.parse()?);
        semicolon(input)
    });
    Ok(LogBlock {
        keyword: keyword.span(),
        channels,
    })
}

impl Parse for LogChannel {
    /// `key = column, column`
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let name = word(
            input,
            "`time`, `q`, `dq`, `tau`, `topic` or the name of an input",
        )?;
        input.parse::<Token![=]>()?;
        let mut columns = vec![input.parse()?];
        while input.peek(Token![,]) {
            input.parse::<Token![,]>()?;
            columns.push(input.parse()?);
        }
        Ok(Self {
            key: name.to_string(),
            span: name.span(),
            columns,
        })
    }
}

impl Parse for LogColumn {
    /// `"name": unit`, or without a unit
    fn parse(input: ParseStream) -> syn::Result<Self> {
        if !input.peek(LitStr) {
            return Err(syn_error(
                input.span(),
                &format!("expected the name of a column in quotes{}", found(input)),
                Some(
                    "write it as in the log's header, such as `q = \"pos 1\": deg, \"pos 2\": deg;`",
                ),
            ));
        }
        let name: LitStr = input.parse()?;
        if !name.suffix().is_empty() {
            return Err(syn_error(
                name.span(),
                &format!(
                    "expected `:` between a column and its unit `{}`",
                    name.suffix()
                ),
                Some(&format!("write `{:?}: {}`", name.value(), name.suffix())),
            ));
        }
        let unit = if input.peek(Token![:]) {
            input.parse::<Token![:]>()?;
            Some(input.parse()?)
        } else {
            None
        };
        Ok(Self { name, unit })
    }
}
