//! Every line of the derive that says a mistake has a golden: a struct of `derive/tests/ui/fail` that makes it speak.
//!
//! What `#[..]` attributes say in the language is checked by the language, which has goldens of its own; the words of `syn`
//! itself ("expected identifier") come from no line of ours.

use std::fs;
use std::path::{Path, PathBuf};

use quote::ToTokens as _;
use robot_model_goldens::{Silent, Source, Speakers, assert_complete, spoken};
use syn::{Attribute, Item};

use super::{ReadFile, implementation, types};

const SPEAKERS: Speakers = Speakers {
    // As a function, and as a method of `Errors`.
    calls: &[("", "mistake"), (".", "mistake")],
    inside: &[],
    types: &[],
    homes: &[
        "derive_input/mistake.rs",
        "derive_input/goldens.rs",
        "derive_input/tests.rs",
    ],
};

const SILENT: [Silent; 2] = [
    Silent {
        file: "derive_input/source.rs",
        words: "the spec has mistakes",
        reason: "a refusal has mistakes; the line stands in for a panic",
    },
    Silent {
        file: "derive_input/source.rs",
        words: "\"`{}`: {error}\"",
        reason: "the text was read before, by another lexer than the compiler's; the line stands in for a panic",
    },
];

/// The folder of the goldens.
fn ui() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../derive/tests/ui")
}

/// What the derive and its macros say of a file.
fn mistakes(file: &str, read: ReadFile<'_>) -> Vec<String> {
    let file = syn::parse_file(file).expect("goldens are Rust");
    let results = file.items.into_iter().filter_map(|mut item| {
        let attributes = match &mut item {
            Item::Macro(call) if call.mac.path.segments.last()?.ident == "effects" => {
                return Some(types::tokens_of_file(call.mac.tokens.clone(), read));
            }
            Item::Struct(item) => &mut item.attrs,
            Item::Enum(item) => &mut item.attrs,
            Item::Union(item) => &mut item.attrs,
            _ => return None,
        };
        // As rustc hands an item to its derives.
        let is_derive = |attribute: &Attribute| attribute.path().is_ident("derive");
        let derives = attributes.iter().find(|one| is_derive(one))?;
        let derives = derives.to_token_stream().to_string();
        attributes.retain(|one| !is_derive(one));
        let input = syn::parse2(item.into_token_stream()).expect("an item that derives");
        derives
            .contains("RobotModel")
            .then(|| implementation(&input, read))
    });
    results
        .filter_map(Result::err)
        .flatten()
        .map(|error| error.to_string())
        .collect()
}

#[test]
fn every_line_that_says_a_mistake_has_a_golden() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let source = Source::read(&src, "derive_input", &SPEAKERS);
    let read = |name: &str| fs::read_to_string(ui().join(name));
    let spoken = fs::read_dir(ui().join("fail"))
        .expect("the goldens")
        .map(|entry| entry.expect("a readable folder").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .flat_map(|path| {
            let text = fs::read_to_string(path).expect("a readable golden");
            spoken(|| mistakes(&text, &read))
        })
        .collect();
    assert_complete(&source, &SPEAKERS, &spoken, &SILENT);
}
