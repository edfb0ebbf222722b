//! At how many samples simulations are looked at.

use super::super::run::Asked;
use super::*;

/// At 1 kHz, with a torque that trembles between coarse stations.
fn fast() -> Log {
    sampled(0.001, 4.0, |t| {
        4.0 * (2.3 * t).sin() + 2.5 * (5.1 * t + 0.4).cos() + (400.0 * t).sin()
    })
}

fn windows(recording: &Recording, pace: Pace) -> Vec<Window<'_>> {
    Window::cut(recording, Some(1.0), None, pace).expect("windows")
}

#[test]
fn coarse_stations_are_a_hundredth_of_a_second_apart_and_end_with_the_window() {
    let recording = Recording::new(&fast(), &[1.0], 0.0, Vec::new());
    let cut = windows(&recording, Pace::Coarse);
    assert_eq!(cut.len(), 4);
    for window in &cut {
        let stations = &window.stations;
        assert!(
            stations
                .windows(2)
                .rev()
                .skip(1)
                .all(|pair| pair[1] - pair[0] == 10)
        );
        assert_eq!(stations[0], 0);
        assert_eq!(stations.last(), Some(&(window.samples.len() - 1)));
        assert_eq!(window.counted(), stations.len());
    }
    let all = windows(&recording, Pace::Sample);
    assert!(
        all.iter()
            .all(|window| window.counted() == window.samples.len())
    );
    // A log of 100 Hz is not thinned, and short windows keep enough.
    let slow = Recording::new(&log(4.0), &[1.0], 0.0, Vec::new());
    assert!(
        windows(&slow, Pace::Coarse)
            .iter()
            .all(|window| !window.is_coarse())
    );
    let short = Window::cut(&recording, Some(0.1), None, Pace::Coarse).expect("windows");
    assert!(short.iter().all(|window| window.counted() >= 20));
}

#[test]
fn a_coarse_motion_has_the_impulse_of_the_logged_torque() {
    let recording = Recording::new(&fast(), &[1.0], 0.0, Vec::new());
    for hold in [Hold::Sample, Hold::Mean] {
        let ends = [Pace::Coarse, Pace::Sample].map(|pace| {
            let window = &windows(&recording, pace)[0];
            let start = DVector::from_vec(vec![0.2, 0.5]);
            let run = window.run(&Block(TRUTH), &start, None, hold, Asked::Motion);
            *run.expect("a motion").q[0].last().expect("stations")
        });
        let moved = (ends[1] - 0.2).abs();
        let off = (ends[0] - ends[1]).abs();
        assert!(
            off > 0.0 && off < 2e-3 * moved,
            "{hold:?}: {off} of {moved}"
        );
    }
}

#[test]
fn what_is_found_is_that_of_all_samples() {
    let log = fast();
    let settings = OutputError {
        window: Some(1.0),
        ..HELD
    };
    let found = fit(&settings, &log);
    for (value, truth) in found.values.iter().zip(TRUTH).take(3) {
        assert!((value - truth).abs() < 1e-5 * truth, "{:?}", found.values);
    }
    assert_eq!(found.samples, log.time.len());
    // Short windows, coarse ones, all samples.
    let last = found.iterates.last().expect("iterates");
    assert_eq!(last.stage, 2);
}
