//! Positions that are updated slower than the log, and long logs.

use super::*;

/// A position at 80 to 500 Hz in a log of 1 kHz: held, but it never jumps and stays.
#[test]
fn positions_that_are_updated_slower_than_the_log_have_no_slips() {
    let rate = 1000.0;
    let time: Vec<f64> = (0..20_000).map(|k| f64::from(k) / rate).collect();
    let tau: Vec<f64> = time.iter().map(|t| 5.0 * (3.0 * t).sin()).collect();
    // The encoder of a joint that rests most of the time goes to and fro by a step.
    let rests = |t: f64| {
        let part = (((t % 10.0) - 1.0) / 0.2).clamp(0.0, 1.0);
        let flicker = if (t * 90.0).sin() > 0.5 { 1e-4 } else { 0.0 };
        (t / 10.0).floor() + part * part * (3.0 - 2.0 * part) + flicker
    };
    let motions: [&dyn Fn(f64) -> f64; 3] = [
        &|t| (2.0 * t).sin(),
        &|t| 0.8 * (1.3 * t).sin() + 0.2 * (15.1 * t).cos(),
        &rests,
    ];
    for (which, motion) in motions.into_iter().enumerate() {
        let fast: Vec<f64> = time
            .iter()
            .map(|t| (motion(*t) / 1e-4).round() * 1e-4)
            .collect();
        for every in [2, 4, 5, 8, 10, 12] {
            let q = (0..fast.len()).map(|k| fast[k / every * every]).collect();
            let log = Log::from_samples("a plant", time.clone(), vec![q], vec![tau.clone()]);
            let faults = log.expect("sound").mended().faults;
            let is_held = |fault: &Fault| matches!(fault, Fault::Held { .. });
            assert!(faults.iter().all(is_held), "{which} {every}: {faults:?}");
            assert!(every != 10 || faults.len() == 1, "{which}: {faults:?}");
        }
    }
}

/// Ten minutes of pulses and of a position in steps: what is found a thousand times takes no look at all samples each time.
#[test]
fn long_logs_full_of_what_is_looked_for_are_read_once() {
    const COUNT: usize = 300_000;
    const EVERY: usize = 60;
    let base = clean(23);
    let again = |values: &[f64]| -> Vec<f64> {
        // Forth and back, so that nothing jumps where it begins again.
        let both = values.iter().chain(values.iter().rev());
        both.cycle().take(COUNT).copied().collect()
    };
    let time: Vec<f64> = (0..COUNT).map(|k| k as f64 / RATE).collect();
    let q = again(&base.q[0]);
    let mut tau = again(&base.tau[0]);
    let pulses = (1..COUNT / EVERY - 1).map(|k| k * EVERY..k * EVERY + 5 + k % 4);
    let (mut times, mut samples) = (0, 0);
    for pulse in pulses {
        times += 1;
        samples += pulse.len();
        tau[pulse].iter_mut().for_each(|tau| *tau += 40.0);
    }
    let steps: Vec<f64> = (0..COUNT).map(|k| q[k / 10 * 10]).collect();
    let stairs: Vec<f64> = (0..COUNT).map(|k| tau[k / 5 * 5]).collect();
    let log = Log::from_samples("a plant", time, vec![q, steps], vec![tau, stairs]);
    let Mended { log, faults } = log.expect("sound").mended();
    let [
        Fault::Bursts { channel, at },
        Fault::Held {
            channel: stairs,
            at: held,
        },
    ] = &faults[..]
    else {
        panic!("{faults:?}");
    };
    // But for those where the motion turns back at once, as if it were pushed.
    assert!(channel == "tau1" && at.times <= times && 25 * at.times >= 24 * times);
    assert!(at.samples <= samples && 25 * at.samples >= 24 * samples);
    assert!(stairs == "q2" && held.times > 10_000, "{held:?}");
    let left = log.tau[0].iter().filter(|tau| tau.abs() > 15.0).count();
    assert!(25 * left < samples, "{left}");
}
