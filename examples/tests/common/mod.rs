//! What the tests of all papers ask of their pages.

use robot_model_examples::Paper;
use robot_model_examples::paper::Mark;

const LIST: &str = include_str!("../../../docs/papers/README.md");

/// The page and the list of papers say what the program says; `outcomes` are the items that are not reached, and those that are impossible
/// as printed. Every figure is drawn.
pub fn agrees(paper: &Paper, name: &str, page: &str, outcomes: [&[&str]; 2]) {
    assert_eq!(paper.differences(page), [""; 0]);
    assert_eq!(paper.counted_otherwise(LIST, name), None);
    let [not_reached, impossible] = paper.failing();
    assert_eq!(not_reached, outcomes[0], "{paper}");
    assert_eq!(impossible, outcomes[1], "{paper}");
    for line in paper.to_string().lines() {
        assert!(line.chars().count() <= 110, "{line}");
    }
    for figure in &paper.figures {
        let svg = figure.svg();
        for series in &figure.series {
            let drawn = match series.mark {
                Mark::Line | Mark::Broad | Mark::Boxes => "<polyline",
                Mark::Dots => "<circle",
                Mark::Bars => "<rect",
                Mark::Band => "<polygon",
            };
            assert!(svg.contains(drawn), "{}: {}", figure.name, series.name);
        }
    }
}
