//! Samples that nearly coincide in time.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;

/// A torque of 20 N m with noise of 0.3, at 500 Hz, at stamps that are off the grid by so much.
fn noisy(off: impl Fn(u32) -> f64) -> Log {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let row = |k: u32| {
        let noise: f64 = StandardNormal.sample(&mut random);
        let t = 0.002 * f64::from(k) + off(k);
        format!(
            "{t:.7},{:.9},{:.9}",
            (2.0 * t).sin(),
            torque(t) + 0.3 * noise
        )
    };
    let rows: Vec<String> = (0..3000).map(row).collect();
    read(&text("time,q1,tau1", &rows), 1).expect("stamps rise")
}

fn torque(time: f64) -> f64 {
    20.0 * (3.0 * time).cos()
}

/// A late sample and the next one, as messages in a queue have it: noise stays what it is, and is no spike.
#[test]
fn no_curve_goes_through_samples_that_coincide() {
    for apart in [1e-6, 20e-6, 200e-6, 500e-6] {
        let late = |k: u32| if k % 50 == 48 { 0.002 - apart } else { 0.0 };
        let log = noisy(late);
        let first = &log.report[0];
        assert!(
            matches!(first, Note::Coincident { samples: 60, .. }),
            "{apart}: {first}"
        );
        assert!(
            first.to_string().contains("the first at 0.098 s"),
            "{first}"
        );
        let errors = log
            .time
            .iter()
            .zip(&log.tau[0])
            .map(|(t, tau)| tau - torque(*t));
        let worst = errors.clone().fold(0.0, |worst: f64, e| worst.max(e.abs()));
        let mean = errors.map(|e| e * e).sum::<f64>() / log.time.len() as f64;
        assert!(
            worst < 1.3 && (mean.sqrt() - 0.3).abs() < 0.02,
            "{apart}: {worst} {mean}"
        );
        let faults = log.mended().faults;
        assert!(
            faults.iter().all(Fault::is_in_report),
            "{apart}: {faults:?}"
        );
    }
}

/// Stamps that jitter by a fifth of a step, at times by nearly all of it, make no spikes.
#[test]
fn jitter_makes_no_spikes() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    let jitter: Vec<f64> = (0..3000)
        .map(|_| {
            let normal: f64 = StandardNormal.sample(&mut random);
            (4e-4 * normal).clamp(-9.5e-4, 9.5e-4)
        })
        .collect();
    let log = noisy(|k| jitter[k as usize]);
    assert!(
        log.report
            .iter()
            .any(|note| matches!(note, Note::Resampled { .. }))
    );
    let faults = log.mended().faults;
    assert!(faults.iter().all(Fault::is_in_report), "{faults:?}");
}

/// As recorders write it that merge two sources. Another value at the same time is a mistake of the file.
#[test]
fn a_row_that_is_there_twice_counts_once() {
    let mut rows: Vec<String> = (0..200)
        .map(|k| format!("{:.3},0.5,{k}", 0.002 * f64::from(k)))
        .collect();
    let once = read(&text("time,q1,tau1", &rows), 1).expect("it is sound");
    rows.insert(50, rows[49].clone());
    rows.insert(120, rows[119].clone());
    let twice = read(&text("time,q1,tau1", &rows), 1).expect("the same is there twice");
    assert_eq!((&twice.time, &twice.tau), (&once.time, &once.tau));
    assert!(
        matches!(twice.report[..], [Note::Coincident { samples: 2, .. }]),
        "{:?}",
        twice.report
    );
    let all: Vec<String> = rows
        .iter()
        .flat_map(|row| [row.clone(), row.clone()])
        .collect();
    let all = read(&text("time,q1,tau1", &all), 1).expect("each is there twice");
    assert_eq!((&all.time, &all.tau), (&once.time, &once.tau));
    rows[50] = "0.098,0.5,7".to_owned();
    let error = read(&text("time,q1,tau1", &rows), 1).expect_err("which of them is it?");
    assert!(
        error.to_string().contains(":52: time does not increase"),
        "{error}"
    );
}
