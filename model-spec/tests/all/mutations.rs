//! Damaged specs: whatever the text, the answer is a model or a message, never a panic.
use std::fs;
use std::panic::catch_unwind;

use robot_model_spec::load;

/// A linear congruential generator (Knuth's MMIX constants): the same damage on every run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % n
    }
}

fn specs() -> Vec<String> {
    ["pass", "fail"]
        .iter()
        .flat_map(|fate| {
            fs::read_dir(format!(
                "{}/../tests/specs/{fate}",
                env!("CARGO_MANIFEST_DIR")
            ))
            .unwrap()
        })
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "robot")
        })
        .map(|path| fs::read_to_string(path).unwrap())
        .collect()
}

/// Words, numbers and single signs, each with the white space behind it.
fn pieces(text: &str) -> Vec<&str> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut pieces = Vec::new();
    let mut start = 0;
    let mut before = ' ';
    for (at, c) in text.char_indices() {
        if at > start && !(is_word(before) && is_word(c)) && !c.is_whitespace() {
            pieces.push(&text[start..at]);
            start = at;
        }
        before = c;
    }
    pieces.push(&text[start..]);
    pieces
}

fn survives(text: &str) -> bool {
    let copy = text.to_owned();
    let rendered = catch_unwind(move || {
        load("damaged.robot", &copy)
            .err()
            .map(|errors| (errors.len(), errors.render(true)))
    });
    assert!(rendered.is_ok(), "panicked on:\n{text}");
    rendered.unwrap().is_some_and(|(count, message)| {
        assert!(count > 0 && !message.is_empty());
        true
    })
}

#[test]
fn no_damage_to_a_spec_makes_the_parser_panic() {
    let mut dice = Dice(7);
    let mut refused = 0;
    let specs = specs();
    for text in &specs {
        let original = pieces(text);
        for _ in 0..40 {
            let mut damaged = original.clone();
            for _ in 0..=dice.below(3) {
                let at = dice.below(damaged.len());
                match dice.below(4) {
                    0 => drop(damaged.remove(at)),
                    1 => damaged.insert(at, damaged[at]),
                    2 => damaged.swap(at, 0),
                    _ => damaged[at] = original[dice.below(original.len())],
                }
                if damaged.is_empty() {
                    damaged.push(";");
                }
            }
            refused += usize::from(survives(&damaged.concat()));
        }
    }
    assert!(
        refused > 20 * specs.len(),
        "{refused} refusals: is anything damaged at all?"
    );
}

#[test]
fn a_spec_cut_off_anywhere_is_refused() {
    let text = fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../tests/specs/pass/slider.robot"
    ))
    .unwrap();
    let robot_ends = text.find("\n}").unwrap();
    let cuts = text
        .char_indices()
        .map(|(at, _)| at)
        .filter(|at| *at < robot_ends);
    for at in cuts {
        assert!(survives(&text[..at]), "loads:\n{}", &text[..at]);
    }
}

#[test]
fn deep_and_long_expressions_are_refused() {
    let with = |value: &str| format!("robot R {{ gravity = [0, 0, {value}]; }}");
    for value in [
        "(".repeat(50_000) + "1" + &")".repeat(50_000),
        "-".repeat(50_000) + "1",
        "1+".repeat(50_000) + "1",
        "2^".repeat(50_000) + "1",
        "sin(".repeat(300) + "1" + &")".repeat(300),
        "(".repeat(50_000),
        "1e999".to_owned(),
        "((((9e99 m)^6)^6)^6)^6".to_owned(),
        "0x10 1_000 'a' \"text\" r#type true".to_owned(),
    ] {
        assert!(survives(&with(&value)));
    }
    for text in [
        "",
        "\u{feff}",
        "é",
        "robot",
        "robot é {",
        "effect",
        "}",
        "#[doc] robot R {}",
        "/// x",
        "//! x",
    ] {
        assert!(survives(text), "{text}");
    }
}
