//! A search says how much of it is behind it.

use super::*;

/// What each iterate says, and that no part of the search takes anything back.
fn told(settings: &OutputError) -> Vec<f64> {
    let log = noisy(log(4.0), 1e-3, 7);
    let recording = Recording::new(&log, &[1.0], 0.0, Vec::new());
    let start = [2.6, 0.4, 1.1, 1.0];
    let mut told = Vec::new();
    let mut progress = |iterate: &Iterate| told.push(iterate.done);
    let found = settings.fit(&Block(start), &names(), &start, &[recording], &mut progress);
    assert_eq!(found.expect("a motion").ending, Ending::Converged);
    assert!(told[0].abs() < 1e-12, "{told:?}");
    assert!(told.is_sorted(), "{told:?}");
    assert!(told.iter().all(|done| *done <= 1.0), "{told:?}");
    told
}

#[test]
fn a_search_tells_how_much_of_it_is_behind_it() {
    let of_one = told(&HELD);
    let last = *of_one.last().expect("iterates");
    assert!((last - 0.9).abs() < 1e-12, "{of_one:?}");
    // Each step is one.
    assert!(
        of_one.windows(2).all(|pair| pair[0] < pair[1]),
        "{of_one:?}"
    );
    // Short windows are one part of two.
    let window = Some(2.0);
    let of_two = told(&OutputError { window, ..HELD });
    assert!(
        of_two.iter().any(|done| (done - 0.5).abs() < 1e-12),
        "{of_two:?}"
    );
    let last = *of_two.last().expect("iterates");
    assert!((last - 0.95).abs() < 1e-12, "{of_two:?}");
    // And of three where torque may be held between samples or not.
    let of_three = told(&OutputError {
        window,
        ..OutputError::default()
    });
    assert!(of_three.iter().any(|done| *done > 0.6), "{of_three:?}");
}
