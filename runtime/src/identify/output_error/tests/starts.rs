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
