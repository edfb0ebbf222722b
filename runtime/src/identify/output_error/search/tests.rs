use super::*;

/// Asks a control after a step with a ratio and a length.
fn assert_next(search: Search, now: f64, (ratio, length): (f64, f64), wanted: f64) {
    let next = next_control(search, now, ratio, length);
    assert!(
        (next - wanted).abs() < 1e-12,
        "{search:?} {ratio} {length}: {next}"
    );
}

/// Seed 001, Algorithm 1: the radius doubles above three quarters of what was foretold, stays between a quarter and that, and is a quarter
/// of the step below.
#[test]
fn the_trust_region_changes_as_algorithm_1_has_it() {
    let next = |at, wanted| assert_next(Search::TrustRegion, 4.0, at, wanted);
    for (ratio, radius) in [
        (0.9, 8.0),
        (0.76, 8.0),
        (0.75, 4.0),
        (0.5, 4.0),
        (0.25, 4.0),
    ] {
        next((ratio, 4.0), radius);
    }
    for ratio in [0.24, 0.1, 0.0, -3.0, f64::NAN] {
        next((ratio, 4.0), 1.0);
        // A step longer than the radius, or none, leaves half of that.
        next((ratio, 40.0), 2.0);
        next((ratio, 0.0), 2.0);
    }
}

#[test]
fn damping_falls_after_good_steps_and_grows_after_bad_ones() {
    for (ratio, damping) in [
        (0.9, 0.1),
        (0.5, 1.0),
        (0.1, 4.0),
        (-1.0, 10.0),
        (f64::NAN, 10.0),
    ] {
        assert_next(Search::LevenbergMarquardt, 1.0, (ratio, 1.0), damping);
    }
}
