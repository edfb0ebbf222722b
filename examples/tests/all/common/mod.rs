//! What the tests of all papers ask of their pages.

use std::path::Path;

use robot_model_examples::Paper;
use robot_model_examples::paper::{lacking, listed_otherwise};

const LIST: &str = include_str!("../../../../docs/papers/README.md");

/// The page and the list of papers say what the program says; `outcomes` are the items that are not reached, and those that are impossible
/// as printed. Every series of every figure is drawn, colors do not tell them apart alone, and the page's own figures are the program's.
pub fn agrees(paper: &Paper, name: &str, page: &str, outcomes: [&[&str]; 2]) {
    assert_eq!(paper.differences(page), [""; 0]);
    assert_eq!(paper.counted_otherwise(LIST, name), None);
    assert_eq!(listed_otherwise(LIST, name, page), [""; 0]);
    let number = name.chars().last().expect("a number");
    assert_eq!(lacking(paper, number), [""; 0]);
    let [not_reached, impossible] = paper.failing();
    assert_eq!(not_reached, outcomes[0], "{paper}");
    assert_eq!(impossible, outcomes[1], "{paper}");
    for line in paper.to_string().lines() {
        assert!(line.chars().count() <= 110, "{line}");
    }
    for figure in &paper.figures {
        assert_eq!(figure.look_alike(), [""; 0], "{}", figure.name);
        let svg = figure.svg();
        for (place, series) in figure.series.iter().enumerate() {
            let parts = figure.parts_of(&svg, place);
            assert!(parts > 0, "{}: {}", figure.name, series.name);
        }
    }
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/papers");
    let read = |file: &str| std::fs::read_to_string(beside.join(file)).ok();
    assert_eq!(paper.drawn_otherwise(page, name, read), [""; 0]);
}
