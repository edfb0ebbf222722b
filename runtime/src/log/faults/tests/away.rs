//! Values that jump away and come back.

use std::f64::consts::TAU;

use super::*;

fn dropouts(faults: &[Fault]) -> Vec<(&str, usize, usize)> {
    let told = faults.iter().filter_map(|fault| match fault {
        Fault::Dropouts { channel, at } => Some((channel.as_str(), at.times, at.samples)),
        _ => None,
    });
    told.collect()
}

fn is_in(ranges: &[Range<usize>], sample: usize) -> bool {
    ranges.iter().any(|range| range.contains(&sample))
}

/// What is mended is near what was there, and nothing but the lost samples is changed.
fn assert_mended(mended: &[f64], clean: &[f64], is_lost: impl Fn(usize) -> bool, within: f64) {
    for (k, (mended, clean)) in mended.iter().zip(clean).enumerate() {
        if is_lost(k) {
            assert!((mended - clean).abs() < within, "{k}: {mended} {clean}");
        } else {
            assert!((mended - clean).abs() == 0.0, "{k}");
        }
    }
}

#[test]
fn dropouts_of_any_length_are_lines_between_sound_samples() {
    for count in [1, 2, 3, 4, 5, 6, 10, 40, 200] {
        let log = clean(11);
        let mut worn = log.clone();
        worn.dq.clear();
        let lost = 900..900 + count;
        worn.q[0][lost.clone()].fill(0.0);
        let Mended { log: piece, faults } = worn.mended();
        if count < 4 {
            assert!(
                matches!(&faults[..], [Fault::Spikes { samples, .. }] if *samples == count),
                "{count}: {faults:?}"
            );
        } else {
            assert_eq!(dropouts(&faults), [("q1", 1, count)], "{faults:?}");
            assert_eq!(faults.len(), 1, "{faults:?}");
        }
        let within = if count < 41 { 0.02 } else { 0.3 };
        assert_mended(&piece.q[0], &log.q[0], |k| lost.contains(&k), within);
        // Those of more than 10 ms are no samples to be fitted.
        assert_eq!(piece.holes.len(), usize::from(count > 5), "{count}");
    }
}

/// Joint at rest and in motion, values that are the largest of all, and torques.
#[test]
fn dropouts_are_found_at_rest_and_at_the_ends_of_what_is_measured() {
    let log = clean(12);
    let mut worn = log.clone();
    worn.dq.clear();
    let lost = [600..612, 2400..2412, 4300..4307];
    for range in &lost {
        worn.q[0][range.clone()].fill(-5.0);
        worn.tau[0][range.clone()].fill(0.0);
    }
    let Mended { log: piece, faults } = worn.mended();
    assert_eq!(
        dropouts(&faults),
        [("q1", 3, 31), ("tau1", 3, 31)],
        "{faults:?}"
    );
    assert_mended(&piece.q[0], &log.q[0], |k| is_in(&lost, k), 0.02);
    assert_mended(&piece.tau[0], &log.tau[0], |k| is_in(&lost, k), 1.0);
}

/// A drive that is switched off between moves, a brake in its place, and torques that a recorder loses while the joint moves on.
#[test]
fn a_drive_that_is_switched_off_has_no_dropout() {
    for seconds in [0.2, 0.4, 0.6, 2.0] {
        let (log, rest) = resting(21, seconds);
        let mut worn = log.clone();
        worn.tau[0][rest.clone()].fill(0.0);
        let clean = worn.clone();
        let Mended { log: piece, faults } = worn.mended();
        assert_eq!(faults, [], "{seconds} s");
        assert_eq!(piece.tau, clean.tau);
        assert_eq!(piece.holes, []);
    }
    for (start, count) in [(700, 10), (700, 60), (1500, 300), (400, 400)] {
        let log = clean(22);
        let mut worn = log.clone();
        worn.dq.clear();
        worn.tau[0][start..start + count].fill(0.0);
        let faults = worn.mended().faults;
        assert_eq!(dropouts(&faults), [("tau1", 1, count)], "{faults:?}");
        assert_eq!(faults.len(), 1, "{faults:?}");
    }
}

fn bursts(faults: &[Fault]) -> Vec<(&str, usize, usize)> {
    let told = faults.iter().filter_map(|fault| match fault {
        Fault::Bursts { channel, at } => Some((channel.as_str(), at.times, at.samples)),
        _ => None,
    });
    told.collect()
}

#[test]
fn bursts_are_replaced_and_counted() {
    for count in [4, 5, 8, 12, 20] {
        let log = clean(16);
        let mut worn = log.clone();
        worn.dq.clear();
        let lost: Vec<Range<usize>> = [400, 1500, 2500, 3900].map(|k| k..k + count).into();
        for (range, size) in lost.iter().zip([25.0, -20.0, 25.0, 15.0]) {
            for k in range.clone() {
                worn.tau[0][k] += size;
            }
        }
        worn.q[0][3200..3200 + count]
            .iter_mut()
            .for_each(|q| *q += 0.4);
        let Mended { log: piece, faults } = worn.mended();
        assert_eq!(
            bursts(&faults),
            [("q1", 1, count), ("tau1", 4, 4 * count)],
            "{faults:?}"
        );
        assert_mended(&piece.tau[0], &log.tau[0], |k| is_in(&lost, k), 1.5);
        assert_mended(
            &piece.q[0],
            &log.q[0],
            |k| (3200..3200 + count).contains(&k),
            0.02,
        );
        assert_eq!(piece.holes.len(), if count > 5 { 5 } else { 0 });
    }
}

/// A joint of inertia 0.5 kg m^2 that is pushed for as long moves, and its torque is what it was.
#[test]
fn pushes_are_no_bursts() {
    for (count, times) in [(5, 1), (5, 12), (12, 1), (20, 1), (20, 12)] {
        let mut log = clean(17);
        log.dq.clear();
        let mut push = vec![0.0; log.time.len()];
        for k in 0..times {
            let start = 300 + 370 * k;
            push[start..start + count].fill(20.0);
        }
        let (mut speed, mut way) = (0.0, 0.0);
        for (k, push) in push.iter().enumerate() {
            log.tau[0][k] += push;
            log.q[0][k] += (way / 1e-4_f64).round() * 1e-4;
            speed += (push / 0.5 - 3.0 * speed) / RATE;
            way += speed / RATE;
        }
        assert_eq!(bursts(&log.mended().faults), [], "{count} {times}");
    }
}

/// Torques that jump by themselves: square waves, clean, noisy and coarse; a channel that is slower than the log; a drive at its limit.
#[test]
fn torques_that_jump_are_sound() {
    let wave = |k: usize, half: usize| {
        if (k / half).is_multiple_of(2) {
            6.0
        } else {
            -6.0
        }
    };
    for half in [5, 12, 50, 250] {
        for (noise, step) in [(0.0, 1e-9), (1.0, 1e-9), (0.0, 0.5), (1.0, 0.05)] {
            let mut log = clean(13);
            log.dq.clear();
            for (k, tau) in log.tau[0].iter_mut().enumerate() {
                let value = wave(k, half) + noise * 0.1 * *tau;
                *tau = (value / step).round() * step;
            }
            let faults = log.mended().faults;
            let is_sound = |fault: &Fault| matches!(fault, Fault::Clipped { .. });
            assert!(
                faults.iter().all(is_sound),
                "{half} {noise} {step}: {faults:?}"
            );
        }
    }
    for every in [2, 3, 4, 5, 6, 7, 10] {
        let mut log = clean(14);
        log.dq.clear();
        let tau = log.tau[0].clone();
        for (k, value) in log.tau[0].iter_mut().enumerate() {
            *value = tau[k / every * every];
        }
        assert_eq!(dropouts(&log.mended().faults), [], "{every}");
    }
    let mut log = clean(15);
    log.dq.clear();
    for k in [400, 1300, 2900] {
        log.tau[0][k..k + 9].fill(40.0);
    }
    assert_eq!(dropouts(&log.mended().faults), []);
}

/// An encoder that slips is told, wherever it does so; what follows is moved back, with a hole between.
#[test]
fn a_position_that_jumps_and_stays_is_told() {
    for (at, size) in [(1200, 0.05), (2900, -0.05), (3000, 0.5), (4100, -2.5)] {
        let mut log = clean(18);
        log.dq.clear();
        let q = log.q[0].clone();
        log.q[0][at..].iter_mut().for_each(|q| *q += size);
        let Mended { log: piece, faults } = log.mended();
        let [
            Fault::Slips {
                times: 1,
                first,
                largest,
                ..
            },
        ] = &faults[..]
        else {
            panic!("{at}: {faults:?}");
        };
        assert!(
            (first - at as f64 / RATE).abs() < 1e-9 && (largest - size).abs() < 1e-3,
            "{first} {largest}"
        );
        let mut pairs = piece.q[0].iter().zip(&q);
        assert!(pairs.all(|(mended, q)| (mended - q).abs() < 1e-3));
        let hole = &piece.holes[0];
        assert!(piece.holes.len() == 1 && hole.start < *first && *first <= hole.end + 1e-9);
    }
}

/// An angle between -pi and pi is the angle itself again, without a hole.
#[test]
fn whole_turns_are_taken_out() {
    let turned = |size: f64| {
        let mut log = clean(18);
        log.dq.clear();
        log.q[0].iter_mut().for_each(|q| *q *= size);
        log
    };
    // So large that it crosses the end of its turn several times, and so small that it does not.
    for (size, crosses) in [(9.0, true), (1.0, false)] {
        let log = turned(size);
        let whole = log.q[0].clone();
        let mut wrapped = log;
        for q in &mut wrapped.q[0] {
            *q -= TAU * (*q / TAU).round();
        }
        let Mended { log, faults } = wrapped.mended();
        let times = match &faults[..] {
            [Fault::Wrapped { times, .. }] => *times,
            [] => 0,
            other => panic!("{other:?}"),
        };
        assert_eq!(times > 1, crosses, "{times}");
        assert!(log.holes.is_empty());
        let turns = ((whole[0] - log.q[0][0]) / TAU).round() * TAU;
        let mut pairs = log.q[0].iter().zip(&whole);
        assert!(pairs.all(|(mended, q)| (mended + turns - q).abs() < 1e-9));
    }
}

/// A joint that rests most of the time and then moves as fast as it can, at once, at a low rate, too.
#[test]
fn fast_moves_are_no_slips() {
    for stride in [1, 5, 20] {
        for lasts in [0.1, 0.3] {
            let mut log = clean(19);
            log.dq.clear();
            let way = |t: f64| {
                0.5 * (((t % 2.0) - 1.0) / lasts).clamp(0.0, 1.0) + 0.5 * (t / 2.0).floor()
            };
            log.q[0] = log
                .time
                .iter()
                .map(|t| (way(*t) / 1e-4).round() * 1e-4)
                .collect();
            let every = |values: &[f64]| values.iter().copied().step_by(stride).collect();
            let (time, q, tau) = (every(&log.time), every(&log.q[0]), every(&log.tau[0]));
            let log = Log::from_samples("a plant", time, vec![q], vec![tau]).expect("sound");
            let faults = log.mended().faults;
            let is_slip = |fault: &Fault| matches!(fault, Fault::Slips { .. });
            assert!(!faults.iter().any(is_slip), "{stride} {lasts}: {faults:?}");
        }
    }
}
