//! Motions from logs.

use super::*;

/// A log of one joint at `rate_hz` with `q = f(t)` and `tau = g(t)`.
fn log(rate_hz: f64, seconds: f64, q: impl Fn(f64) -> f64, tau: impl Fn(f64) -> f64) -> Log {
    let time = resample::grid(5.0, 1.0 / rate_hz, resample::whole_steps(seconds * rate_hz));
    let channel = |f: &dyn Fn(f64) -> f64| vec![time.iter().map(|t| f(*t)).collect()];
    let (q, tau) = (channel(&q), channel(&tau));
    Log::from_samples("a test", time, q, tau).expect("samples are in order")
}

#[test]
fn rates_come_down_to_five_hundred() {
    for (rate, stride) in [
        (200.0, 1),
        (500.0, 1),
        (999.999, 2),
        (1000.0, 2),
        (1600.0, 3),
        (5000.0, 10),
    ] {
        let log = log(rate, 2.0, f64::sin, f64::cos);
        let prepared = prepare(&log, &Bands::for_log(&log)).expect("bands of the log");
        assert_eq!(prepared.stride, stride, "{rate} Hz");
        assert!((prepared.rate_hz - rate / stride as f64).abs() < 1e-6);
        let count = log.time.len().div_ceil(stride);
        assert_eq!(
            (
                prepared.motion.time.len(),
                prepared.tau[0].len(),
                prepared.motion.wide.ddq[0].len()
            ),
            (count, count, count)
        );
        assert!(
            prepared.motion.time[0].abs() < 1e-15,
            "motions start at zero"
        );
    }
}

#[test]
fn derivatives_are_those_of_the_motion_at_every_rate() {
    for rate in [200.0, 500.0, 1000.0, 5000.0] {
        let w = 12.0;
        let log = log(rate, 4.0, |t| (w * t).sin(), |_| 0.0);
        let prepared = prepare(&log, &Bands::for_log(&log)).expect("bands of the log");
        let Motion {
            time, smooth, wide, ..
        } = &prepared.motion;
        for k in prepared.shared.kept(time.len()) {
            let phase = w * (time[k] + 5.0);
            for kinematics in [smooth, wide] {
                assert!(
                    (kinematics.q[0][k] - phase.sin()).abs() < 1e-5,
                    "{rate} Hz, sample {k}"
                );
                assert!(
                    (kinematics.dq[0][k] / w - phase.cos()).abs() < 1e-4,
                    "{rate} Hz, sample {k}"
                );
                assert!(
                    (kinematics.ddq[0][k] / (w * w) + phase.sin()).abs() < 1e-3,
                    "{rate} Hz, sample {k}"
                );
            }
        }
    }
}

#[test]
fn torque_keeps_its_band_and_loses_what_would_fold() {
    let tone = |hz: f64| move |t: f64| (2.0 * std::f64::consts::PI * hz * t).sin();
    let rms = |hz: f64| {
        let log = log(5000.0, 4.0, f64::sin, tone(hz));
        let prepared = prepare(&log, &Bands::DEFAULT).expect("bands of the log");
        let inside = &prepared.tau[0][200..1800];
        (2.0 * inside.iter().map(|v| v * v).sum::<f64>() / inside.len() as f64).sqrt()
    };
    assert!((rms(10.0) - 1.0).abs() < 1e-3);
    // 490 Hz would appear as 10 Hz.
    assert!(rms(490.0) < 1e-3, "{}", rms(490.0));
    let beyond = |hz: f64| {
        let log = log(5000.0, 4.0, f64::sin, tone(hz));
        prepare(&log, &Bands::DEFAULT)
            .expect("bands of the log")
            .tau_beyond[0]
    };
    assert!(beyond(10.0) < 1e-6 && (beyond(490.0) - 0.5).abs() < 1e-3);
}

#[test]
fn refusals_carry_their_numbers() {
    let fast = log(1000.0, 4.0, f64::sin, f64::cos);
    let log = log(100.0, 0.18, f64::sin, f64::cos);
    let text = |bands: &Bands| {
        prepare(&log, bands)
            .expect_err("must be refused")
            .to_string()
    };
    assert_eq!(
        text(&Bands {
            smooth_hz: 5.0,
            ..Bands::for_log(&log)
        }),
        "bands of 10 Hz (shared), 5 Hz (smooth) and 36 Hz (wide): each must be at least the one before it"
    );
    assert_eq!(
        text(&Bands::DEFAULT),
        "a low-pass at 90 Hz on samples at 100 Hz: the cutoff must lie between 0 and 50 Hz"
    );
    let beyond = prepare(
        &fast,
        &Bands {
            wide_hz: 480.0,
            ..Bands::DEFAULT
        },
    );
    assert_eq!(
        beyond.expect_err("must be refused").to_string(),
        "a wide band of 480 Hz: a log of 1000 Hz is brought down to 500 Hz before columns are formed, so all bands must lie below 250 Hz"
    );
    assert_eq!(
        text(&Bands::for_log(&log)),
        "a test: a log of 0.170 s is too short for a low-pass at 10 Hz; at least 0.220 s are needed; record a longer motion, or give wider bands, as `--bands` does"
    );
    assert!(
        prepare(
            &log,
            &Bands {
                shared_hz: f64::NAN,
                ..Bands::DEFAULT
            }
        )
        .is_err()
    );
}
