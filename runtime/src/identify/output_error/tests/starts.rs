//! Where windows begin.

use super::*;

#[test]
fn starts_are_fitted_unless_they_are_held() {
    let noisy = noisy(log(4.0), 1e-3, 7);
    let free = fit(&HELD, &noisy);
    let start = |values: &[f64]| OutputError {
        held_starts: Some(vec![values.to_vec()]),
        ..HELD
    };
    // Where they are held as they would be fitted nothing else changes.
    let held = fit(&start(&free.starts[0]), &noisy);
    assert_eq!(held.starts, free.starts);
    for (one, other) in held.values.iter().zip(&free.values) {
        assert!((one - other).abs() < 1e-6 * other, "{one} {other}");
    }
    let off = fit(
        &start(&[free.starts[0][0] + 0.05, free.starts[0][1]]),
        &noisy,
    );
    assert!(off.fit.position[0].rmse > 2.0 * free.fit.position[0].rmse);
    let recordings = [Recording::new(&noisy, &[1.0], 0.0, Vec::new())];
    let refused = |settings: &OutputError| {
        settings
            .compare(&Block(TRUTH), &TRUTH, &recordings)
            .unwrap_err()
    };
    let windowed = OutputError {
        window: Some(0.5),
        ..start(&[0.0, 0.0])
    };
    assert_eq!(refused(&windowed), OutputErrorError::WindowedStarts);
    assert!(matches!(
        refused(&start(&[0.0])),
        OutputErrorError::Size { found: 1, .. }
    ));
}

/// Where the logs would have parameters beyond their bounds all the same there is an answer, and it says so.
#[test]
fn all_parameters_may_be_on_bounds() {
    let settings = OutputError {
        bounds: vec![[1.0, 1.5], [0.7, 0.7], [1.5, 1.5], [1.0, 1.0]],
        ..HELD
    };
    let recording = Recording::new(&log(4.0), &[1.0], 0.0, Vec::new());
    let start = [1.2, 0.7, 1.5, 1.0];
    let found = settings
        .fit(&Block(start), &names(), &start, &[recording], &mut |_| ())
        .expect("an answer");
    assert!((found.values[0] - 1.5).abs() < 1e-12, "{:?}", found.values);
    assert_eq!(found.bound, [0, 1, 2, 3]);
    assert!(found.std.iter().all(Option::is_none));
}

#[test]
fn a_comparison_wants_what_a_search_does() {
    let recordings = [Recording::new(&log(4.0), &[1.0], 0.0, Vec::new())];
    let compare = |settings: &OutputError, values: &[f64]| {
        let compared = settings.compare(&Block(TRUTH), values, &recordings);
        compared.expect_err("it is refused").to_string()
    };
    assert!(compare(&HELD, &TRUTH[..2]).contains("values of parameters"));
    let law = Law { joints: Vec::new() };
    let settings = OutputError {
        law: Some(law),
        ..HELD
    };
    assert!(compare(&settings, &TRUTH).contains("joints of the controller"));
}
