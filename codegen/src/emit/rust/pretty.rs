//! Tokens to a page: comments and blank lines that `quote!` cannot carry.

use proc_macro2::TokenStream;

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
