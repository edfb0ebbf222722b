//! What is written and printed of directions that logs say little of, and of the ratios that they leave.

use robot_model::identify::output_error::{Direction, Ratio};
use serde::Serialize;

#[derive(Serialize)]
pub(super) struct DirectionReport<'a> {
    relative_singular_value: f64,
    is_silent: bool,
    is_common_factor: bool,
    moves: Vec<(&'a str, f64)>,
}

#[derive(Serialize)]
pub(super) struct RatioReport<'a> {
    name: &'a str,
    /// What it is divided by.
    reference: &'a str,
    value: f64,
    std: Option<f64>,
}

pub(super) fn direction(direction: &Direction) -> DirectionReport<'_> {
    let moves = direction.moves.iter();
    DirectionReport {
        relative_singular_value: direction.singular,
        is_silent: direction.is_silent(),
        is_common_factor: direction.is_scale(),
        moves: moves.map(|(name, share)| (name.as_str(), *share)).collect(),
    }
}

pub(super) fn ratio(ratio: &Ratio) -> RatioReport<'_> {
    RatioReport {
        name: &ratio.name,
        reference: &ratio.reference,
        value: ratio.value,
        std: ratio.std,
    }
}

/// Parameters that hang on what the model lacks, in a sentence.
pub(super) fn hanging(frail: &Direction) -> String {
    let moves = frail.moves.iter();
    let moves: Vec<String> = moves
        .map(|(name, share)| match frail.moves.len() {
            1 => name.clone(),
            _ => format!("{name} {share:+.2}"),
        })
        .collect();
    let less = if frail.is_silent() {
        "not at all, compared with".to_owned()
    } else {
        format!("{:.0} times less than", 1.0 / frail.singular)
    };
    format!(
        "weakly excited: {}: a relative change of {} value moves positions {less} the same change of the strongest parameter, so model \
         errors accumulate here; the ratios of the other parameters are known better, whatever the standard deviations say",
        moves.join(", "),
        if moves.len() == 1 { "its" } else { "their" },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn how_much_less_is_a_number_or_all() {
        let said = |singular: f64| {
            let moves = vec![("arm.izz".to_owned(), 1.0)];
            hanging(&Direction::new(singular, moves))
        };
        assert!(said(0.02).contains("its value moves positions 50 times less than"));
        for nothing in [0.0, 1e-17] {
            assert!(
                said(nothing).contains("moves positions not at all, compared with the same change")
            );
        }
    }
}
