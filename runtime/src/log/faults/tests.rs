//! Faults that are put into a clean log are found, and none is found in it without.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;

mod away;
mod clipped;
mod slow;

const RATE: f64 = 500.0;

/// Ten seconds of one joint with dry friction, noise of the torque and an encoder of finite steps, that rests for a second in the middle.
fn clean(seed: u64) -> Log {
    resting(seed, 1.0).0
}

/// That, of a joint that rests for so long, and at which samples it does.
fn resting(seed: u64, seconds: f64) -> (Log, Range<usize>) {
    let end = 4.5 + seconds;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
    let time: Vec<f64> = (0..5000).map(|k| f64::from(k) / RATE).collect();
    // What moves is time itself, which stands still in the middle.
    let clock = |t: f64| if t < 4.5 { t } else { 4.5 + (t - end).max(0.0) };
    let motion = |t: f64| 0.8 * (1.3 * clock(t)).sin() + 0.2 * (5.1 * clock(t)).cos();
    let rests = |t: f64| (4.5..end).contains(&t);
    let speed = |t: f64| 0.8 * 1.3 * (1.3 * clock(t)).cos() - 0.2 * 5.1 * (5.1 * clock(t)).sin();
    let q = time
        .iter()
        .map(|&t| (motion(t) / 1e-4).round() * 1e-4)
        .collect();
    let tau = time
        .iter()
        .map(|&t| 9.0 * motion(t).sin() + 2.0 * speed(t).signum() + 0.1 * normal())
        .collect();
    let mut log = Log::from_samples("a plant", time.clone(), vec![q], vec![tau]).expect("sound");
    let logged = |&t: &f64| if rests(t) { 0.0 } else { speed(t) };
    log.dq = vec![time.iter().map(logged).collect()];
    let before = |t: f64| time.partition_point(|time| *time < t - 1e-9);
    (log, before(4.5)..before(end))
}

#[test]
fn a_clean_log_has_no_faults_and_stays_as_it_is() {
    for seed in 0..20 {
        let log = clean(seed);
        let mended = log.clone().mended();
        assert_eq!(mended.faults, []);
        // Limits were looked for, and there are none.
        let looked_at = Log {
            clipped: vec![Vec::new(); log.dof()],
            ..log
        };
        assert!(mended.log == looked_at, "seed {seed}");
    }
}

#[test]
fn spikes_are_replaced_and_counted() {
    let log = clean(1);
    let mut worn = log.clone();
    for (k, size) in [(700, 30.0), (701, 25.0), (1900, -40.0), (3111, 15.0)] {
        worn.tau[0][k] += size;
    }
    worn.q[0][1234] = 0.0;
    let mended = worn.mended();
    let found: Vec<(&str, usize)> = mended
        .faults
        .iter()
        .filter_map(|fault| match fault {
            Fault::Spikes {
                channel, samples, ..
            } => Some((channel.as_str(), *samples)),
            _ => None,
        })
        .collect();
    assert_eq!(found, [("q1", 1), ("tau1", 4)]);
    let piece = &mended.log;
    assert!(piece.holes.is_empty());
    for k in [700, 701, 1900, 3111] {
        assert!((piece.tau[0][k] - log.tau[0][k]).abs() < 1.0, "{k}");
    }
    assert!((piece.q[0][1234] - log.q[0][1234]).abs() < 1e-3);
}

#[test]
fn holds_are_bridged_and_long_ones_cut_out() {
    let log = clean(2);
    let mut worn = log.clone();
    for (first, count) in [(460, 5), (3700, 60)] {
        for channel in [&mut worn.q[0], &mut worn.tau[0]] {
            let value = channel[first];
            channel[first..first + count].fill(value);
        }
    }
    let mended = worn.mended();
    let held: Vec<(&str, usize, usize)> = mended
        .faults
        .iter()
        .filter_map(|fault| match fault {
            Fault::Held { channel, at } => Some((channel.as_str(), at.times, at.samples)),
            _ => None,
        })
        .collect();
    assert!(held.contains(&("q1", 2, 63)), "{:?}", mended.faults);
    let hole = &mended.log.holes[0];
    assert!((hole.start - 3701.0 / RATE).abs() < 1e-9);
    assert!((hole.end - 3760.0 / RATE).abs() < 1e-9);
}

/// A joint that others push by some microradians does not move: its velocity is in step with nothing.
#[test]
fn velocities_of_a_joint_that_is_held_are_not_late() {
    let time: Vec<f64> = (0..6000).map(|k| 0.002 * f64::from(k)).collect();
    let wave = |size: f64, f: &dyn Fn(f64) -> f64| -> Vec<f64> {
        time.iter().map(|t| size * f(*t)).collect()
    };
    for (size, is_told) in [(9e-6, false), (0.1, true)] {
        let q = vec![wave(size, &|t| (6.0 * t).sin())];
        let tau = vec![wave(1.0, &|t| (3.0 * t).cos())];
        let mut log = Log::from_samples("a held joint", time.clone(), q, tau).expect("a log");
        log.dq = vec![wave(6.0 * size, &|t| (6.0 * (t - 0.03)).cos())];
        let faults = log.mended().faults;
        let is_late = |fault: &Fault| matches!(fault, Fault::VelocityLate { .. });
        assert_eq!(faults.iter().any(is_late), is_told, "{size}: {faults:?}");
    }
}

#[test]
fn velocities_late_in_degrees_or_backwards_are_told() {
    let log = clean(3);
    let count = log.time.len();
    let mut late = log.clone();
    late.dq[0] = (0..count)
        .map(|k| log.dq[0][k.saturating_sub(45)])
        .collect();
    let faults = late.mended().faults;
    let delay = faults.iter().find_map(|fault| match fault {
        Fault::VelocityLate { delay, .. } => Some(*delay),
        _ => None,
    });
    assert!((delay.expect("a delay") - 0.09).abs() < 2e-3, "{faults:?}");
    for (factor, word) in [
        (57.29578, "as degrees are to radians"),
        (9.5493, "as rpm are to rad/s"),
        (-1.0, "with the opposite sign"),
    ] {
        let mut wrong = log.clone();
        wrong.dq[0].iter_mut().for_each(|dq| *dq *= factor);
        let faults = wrong.mended().faults;
        assert!(
            faults.iter().any(|fault| fault.to_string().contains(word)),
            "{faults:?}"
        );
    }
}

#[test]
fn a_drive_at_its_limit_is_told() {
    let mut log = clean(4);
    log.dq.clear();
    log.tau[0]
        .iter_mut()
        .for_each(|tau| *tau = tau.clamp(-7.0, 7.0));
    let tau = log.tau[0].clone();
    let Mended { log, faults } = log.mended();
    assert!(
        matches!(faults[..], [Fault::Clipped { share, .. }] if share > 0.05),
        "{faults:?}"
    );
    let spans = &log.clipped[0];
    for (k, tau) in tau.iter().enumerate() {
        let time = k as f64 / RATE;
        let mut near = spans.iter();
        let is_within = near.any(|span| (span.start - 1e-9..=span.end + 1e-9).contains(&time));
        assert_eq!(is_within, tau.abs() > 7.0 - 1e-9, "{time} s");
    }
    assert!(clean(4).mended().log.clipped.iter().all(Vec::is_empty));
}

#[test]
fn what_never_changes_is_told() {
    let mut log = clean(5);
    log.dq.clear();
    log.q[0].fill(0.3);
    log.tau[0].fill(0.0);
    let faults = log.mended().faults;
    assert!(
        matches!(faults[..], [Fault::Still { .. }, Fault::Constant { .. }]),
        "{faults:?}"
    );
}

#[test]
fn what_stands_but_for_noise_is_told_and_stands_then() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    let mut log = clean(6);
    log.dq.clear();
    let noise = |q: &mut f64| {
        let white: f64 = StandardNormal.sample(&mut random);
        *q = 0.3 + 1e-4 * white;
    };
    log.q[0].iter_mut().for_each(noise);
    let mended = log.mended();
    let Some(Fault::AtRest { channel, rms }) = mended.faults.first() else {
        panic!("{:?}", mended.faults);
    };
    assert!(channel == "q1" && (rms / 1e-4 - 1.0).abs() < 0.05, "{rms}");
    let q = &mended.log.q[0];
    assert!(q.iter().all(|value| (value - q[0]).abs() == 0.0) && (q[0] - 0.3).abs() < 1e-5);
}

#[test]
fn coarse_torque_is_neither_held_nor_clipped() {
    for (seed, share) in [(1, 0.002), (2, 0.01), (3, 0.05)] {
        let mut log = clean(seed);
        log.dq.clear();
        let step = 20.0 * share;
        for tau in &mut log.tau[0] {
            *tau = (*tau / step).round() * step;
        }
        assert_eq!(log.mended().faults, [], "{share}");
    }
    // A square wave that somebody computed, so that its two values differ in their last digits.
    let mut computed = clean(5);
    computed.dq.clear();
    for (k, tau) in computed.tau[0].iter_mut().enumerate() {
        let last_digits = 1.0 + 1e-14 * (k % 7) as f64;
        *tau = 1.8 * (3.0 * k as f64 / RATE).sin().signum() * last_digits;
    }
    assert_eq!(computed.mended().faults, []);
    // Without noise each wave has a flat top.
    let mut smooth = clean(4);
    smooth.dq.clear();
    let rate = RATE;
    for (k, tau) in smooth.tau[0].iter_mut().enumerate() {
        *tau = (10.0 * (3.0 * k as f64 / rate).sin() / 0.1).round() * 0.1;
    }
    assert_eq!(smooth.mended().faults, []);
}

#[test]
fn torque_that_stands_amid_its_noise_is_found_wherever_it_is_behind() {
    for samples in [12, 20, 30] {
        let mut log = clean(8);
        log.dq.clear();
        // No jump at its end says that it stood: the arm has moved on, and noise goes on where it was.
        let (q, tau) = (&log.q[0], &log.tau[0]);
        let is_hidden = |k: &usize| {
            let behind = k + samples;
            (q[behind] - q[*k]).abs() > 0.01 && (tau[behind] - tau[k - 1]).abs() < 0.2
        };
        let from = (300..2000)
            .find(is_hidden)
            .expect("it comes by there again");
        let value = tau[from - 1];
        log.tau[0][from..from + samples].fill(value);
        let faults = log.mended().faults;
        let [Fault::Held { channel, at } | Fault::Dropouts { channel, at }] = &faults[..] else {
            panic!("{samples}: {faults:?}");
        };
        assert_eq!((channel.as_str(), at.times), ("tau1", 1), "{samples}");
    }
}

#[test]
fn many_spikes_are_found_as_few_are() {
    for every in [400, 100, 40, 20, 11] {
        let mut log = clean(6);
        let mut count = 0;
        for (k, tau) in log.tau[0].iter_mut().enumerate() {
            if k % every == every / 2 {
                *tau += if k % 2 == 0 { 60.0 } else { -60.0 };
                count += 1;
            }
        }
        let found = log
            .mended()
            .faults
            .into_iter()
            .find_map(|fault| match fault {
                Fault::Spikes { samples, .. } => Some(samples),
                _ => None,
            });
        let found = found.expect("spikes");
        assert!(
            // Where this arm stops and starts at once it looks as if it were pushed.
            found <= count && 25 * found >= 24 * count,
            "one in {every}: {found} {count}"
        );
    }
}

/// Waves come back after a period, and backwards after half of one.
#[test]
fn velocities_of_waves_are_told_by_the_nearest_delay() {
    for hz in [0.5, 1.0, 2.0, 3.0] {
        let w = std::f64::consts::TAU * hz;
        let time: Vec<f64> = (0..5000).map(|k| f64::from(k) / RATE).collect();
        let wave = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { time.iter().map(|&t| f(t)).collect() };
        let q = wave(&|t| ((w * t).sin() / 1e-4).round() * 1e-4);
        let tau = wave(&|t| 5.0 * (w * t).cos());
        let log = Log::from_samples("a plant", time.clone(), vec![q], vec![tau]).expect("sound");
        for (late, factor) in [(0.0, 1.0), (0.05, 1.0), (0.0, -1.0), (0.0, 57.29578)] {
            let mut log = log.clone();
            log.dq = vec![wave(&|t| factor * w * (w * (t - late)).cos())];
            let faults = log.mended().faults;
            match faults[..] {
                [] => assert!(
                    late == 0.0 && (factor - 1.0).abs() < 1e-9,
                    "{hz} {late} {factor}"
                ),
                [Fault::VelocityLate { delay, .. }] => {
                    assert!(
                        (delay - late).abs() < 2e-3 && factor > 0.0 && late > 0.0,
                        "{hz}: {delay}"
                    );
                }
                [Fault::VelocityScale { factor: found, .. }] => {
                    assert!((found / factor - 1.0).abs() < 0.01, "{hz}: {found}");
                }
                _ => panic!("{hz} {late} {factor}: {faults:?}"),
            }
        }
    }
}

#[test]
fn slow_drift_and_joints_that_hardly_move_have_no_delay() {
    let time: Vec<f64> = (0..5000).map(|k| f64::from(k) / RATE).collect();
    let drift: Vec<f64> = time.iter().map(|t| 0.1 * t).collect();
    let tau: Vec<f64> = time.iter().map(|t| (3.0 * t).sin()).collect();
    let mut log =
        Log::from_samples("a plant", time.clone(), vec![drift], vec![tau]).expect("sound");
    log.dq = vec![vec![0.1; 5000]];
    assert_eq!(log.clone().mended().faults, []);
    // A step of the encoder to and fro.
    log.q = vec![
        time.iter()
            .map(|t| ((2.0 * t).sin() * 0.8).round() * 1e-4)
            .collect(),
    ];
    log.dq = vec![time.iter().map(|t| 1e-4 * (2.0 * t).cos()).collect()];
    let faults = log.mended().faults;
    assert!(matches!(faults[..], [Fault::AtRest { .. }]), "{faults:?}");
}

/// Of a position that is smooth between its steps most samples are the median of those around them.
#[test]
fn a_handful_of_spikes_of_a_position_is_found_as_one_is() {
    for every in [5000, 1000, 400, 300, 100] {
        let clean = clean(7);
        let mut log = clean.clone();
        log.dq.clear();
        let mut count = 0;
        for (k, q) in log.q[0].iter_mut().enumerate() {
            if k % every == every / 3 {
                *q += if k % 2 == 0 { 0.3 } else { -0.3 };
                count += 1;
            }
        }
        let mended = log.mended();
        let found = mended.faults.iter().find_map(|fault| match fault {
            Fault::Spikes {
                channel, samples, ..
            } if channel == "q1" => Some(*samples),
            _ => None,
        });
        assert_eq!(found, Some(count), "one in {every}: {:?}", mended.faults);
        for (mended, clean) in mended.log.q[0].iter().zip(&clean.q[0]) {
            assert!((mended - clean).abs() < 1e-3, "one in {every}");
        }
    }
}
