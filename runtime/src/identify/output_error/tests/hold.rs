//! How torque goes between samples, which errors say.

use super::*;

#[test]
fn errors_say_how_torque_goes_between_samples_where_it_hardly_changes() {
    // By 0.8 % from sample to sample.
    let slow = pushed_by(12.0, |t| 6.0 * (0.8 * t).sin());
    let settings = OutputError { hold: None, ..HELD };
    let found = fit(&settings, &slow);
    assert_eq!(found.hold, Some(Hold::Sample));
    for (value, truth) in found.values.iter().zip(TRUTH).take(3) {
        assert!((value - truth).abs() < 1e-4 * truth, "{:?}", found.values);
    }
    let rival = found.rival_hold.expect("the other way was tried");
    assert_eq!(rival.hold, Hold::Mean);
    assert!(rival.worse > 1.0, "{}", rival.worse);
}
