//! Tokens to a page: comments and blank lines that `quote!` cannot carry.

use proc_macro2::{Group, TokenStream, TokenTree};

/// Formats items one by one with a blank line between them. Statements `__comment!("..")` become `// ..`, statements
/// `__blank!()` an empty line.
pub fn page(header: &str, items: &[TokenStream]) -> String {
    let mut page = header.to_owned();
    for item in items {
        let file: syn::File = syn::parse2(item.clone()).expect("emitted tokens are items");
        page.push('\n');
        for line in prettyplease::unparse(&file).lines() {
            page.push_str(&unmark(line));
            page.push('\n');
        }
    }
    // The page must still be Rust once the markers are gone.
    syn::parse_file(&page).expect("emitted page is Rust");
    page
}

fn unmark(line: &str) -> String {
    let text = line.trim_start();
    let indent = &line[..line.len() - text.len()];
    if text == "__blank!();" {
        return String::new();
    }
    match text
        .strip_prefix("__comment!(\"")
        .and_then(|rest| rest.strip_suffix("\");"))
    {
        Some(comment) => format!("{indent}// {comment}"),
        None => line.to_owned(),
    }
}

/// The tokens without `__comment!` and `__blank!` statements, for code that is never printed.
pub fn without_markers(tokens: TokenStream) -> TokenStream {
    let mut kept = TokenStream::new();
    let mut tokens = tokens.into_iter();
    while let Some(token) = tokens.next() {
        match token {
            // The marker's `!`, its parentheses and the semicolon go with it.
            TokenTree::Ident(ident) if ident == "__comment" || ident == "__blank" => {
                tokens.by_ref().take(3).for_each(drop);
            }
            TokenTree::Group(group) => {
                let inside = without_markers(group.stream());
                let mut clean = Group::new(group.delimiter(), inside);
                clean.set_span(group.span());
                kept.extend([TokenTree::Group(clean)]);
            }
            other => kept.extend([other]),
        }
    }
    kept
}
