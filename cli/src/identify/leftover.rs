//! Torque that is left and follows something.

use robot_model::identify::Estimate;

use super::doubts::left;

/// What is left of a joint's torque, percent, from where on it is asked what it follows.
const MUCH: f64 = 15.0;

/// Share of rows that say as much as all of them, below which errors go on from row to row: of white noise in the band of the fit it is about a
/// half, of noise that is alike over 50 ms a fifth, of a missing effect a tenth and less.
const ALIKE: f64 = 0.12;

/// Joints of which much is left that is no noise from row to row.
pub(super) fn doubt(estimate: &Estimate) -> Option<String> {
    let independent = estimate.effective_samples.as_ref()?;
    let of = |rows: &[usize], joint: usize| rows.get(joint).copied().unwrap_or(0);
    // Rows that are left out are no samples.
    let counted = (0..estimate.joints.len()).map(|joint| {
        let turns = if estimate.is_without_turns {
            of(&estimate.turns, joint)
        } else {
            0
        };
        let out = turns + of(&estimate.held, joint) + of(&estimate.clipped, joint);
        estimate.samples.saturating_sub(out)
    });
    let counted: Vec<usize> = counted.collect();
    said(left(estimate), independent, &counted, &estimate.joints)
}

fn said(
    percents: &[f64],
    independent: &[f64],
    samples: &[usize],
    joints: &[String],
) -> Option<String> {
    let all = percents.iter().zip(independent).zip(samples).zip(joints);
    let alike = all.filter(|(((percent, independent), samples), _)| {
        **percent > MUCH && **independent < ALIKE * **samples as f64
    });
    let told: Vec<String> = alike
        .map(|(((percent, _), _), joint)| format!("`{joint}` {percent:.0} %"))
        .collect();
    (!told.is_empty()).then(|| {
        format!(
            "the residual is correlated from row to row, unlike noise: {}; the spec lacks an effect, which biases the values: `trace` looks for it",
            told.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    #[test]
    fn much_that_goes_on_from_row_to_row_is_told() {
        let joints = ["one", "two"].map(str::to_owned);
        let said = |percents, independent| super::said(percents, independent, &[400, 200], &joints);
        let told = said(&[3.0, 32.0], &[40.0, 20.0]).expect("a contact");
        assert!(
            told.contains("`two` 32 %") && !told.contains("`one`"),
            "{told}"
        );
        // Noise, and a small error.
        assert_eq!(said(&[32.0, 32.0], &[190.0, 40.0]), None);
        assert_eq!(said(&[12.0, 4.0], &[40.0, 20.0]), None);
    }
}
