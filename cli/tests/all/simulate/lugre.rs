//! Seed 003: one joint with bristles.

use robot_model::simulate::{Loop, Measured};
use robot_model_cli::interpreted::InterpretedPlant;

use crate::simulate::common::{Law, compiled, plant, still};

/// A block on bristles: 2 N to slide, 3 N to break away, bent by 1 mm when they slide.
const FC: f64 = 2.0;
const RISE: f64 = 0.5;
const VS: f64 = 0.1;
const BENT: f64 = 1e-3;

fn block(bent: f64, damping: f64) -> InterpretedPlant {
    let text = format!(
        "robot Block {{
        coordinates x: m;
        parameters m = 1 kg;
        kinetic = m/2*dot(x)^2;
        potential = 0;
        effects {{ lugre_presliding(d = {bent}, vs = {VS}, rise = {RISE}) on x; viscous_friction on x; }}
    }}"
    );
    plant(compiled(&text), &[("fc", FC), ("s1", damping), ("fv", 0.4)])
}

fn stribeck(v: f64) -> f64 {
    FC * (1.0 + RISE * (-(v / VS).powi(2)).exp()) * v.signum() + 0.4 * v
}

/// A speed loop holds the block at a constant speed: its force is Stribeck's curve.
#[test]
fn at_constant_speed_friction_is_stribecks_curve() {
    for wanted in [0.02, 0.05, 0.1, 0.2, 0.5, 1.0, -0.07, -0.6] {
        let mut sum = 0.0;
        let mut force = 0.0;
        let mut speed = Law(|measured: &Measured<'_>| {
            let error = wanted - measured.dq[0];
            sum += error * measured.period;
            force = 60.0 * error + 900.0 * sum;
            force
        });
        let setting = Loop {
            duration: 4.0,
            ..Loop::default()
        };
        let run = setting.run(block(BENT, 20.0), &mut speed, &still(&[0.0]), &mut |_| {});
        let (record, end) = run.expect("a motion");
        let v = end.dq()[0];
        assert!((v - wanted).abs() < 1e-8, "{v} {wanted}");
        let last = record.tau[0][record.tau[0].len() - 2];
        assert!(
            (last - stribeck(v)).abs() < 1e-9,
            "{v}: {last} {}",
            stribeck(v)
        );
    }
}

/// A slow pull below breakaway, to and fro: the way back is another, it closes, and takes energy.
#[test]
fn below_breakaway_force_and_way_make_a_loop() {
    let period = 20.0;
    let mut pull =
        Law(|measured: &Measured<'_>| 1.6 * (std::f64::consts::TAU * measured.time / period).sin());
    let setting = Loop {
        rate: 200.0,
        log_rate: 200.0,
        duration: 3.0 * period,
        ..Loop::default()
    };
    let run = setting.run(block(BENT, 20.0), &mut pull, &still(&[0.0]), &mut |_| {});
    let (record, _) = run.expect("a motion");
    let (q, tau) = (&record.q[0], &record.tau[0]);
    let sample = |time: f64| {
        record
            .time
            .iter()
            .take_while(|&&t| t < time - 0.0025)
            .count()
    };
    let last = sample(2.0 * period)..sample(3.0 * period);
    let work: f64 = last.clone().map(|k| tau[k] * (q[k + 1] - q[k])).sum();
    let way = |range: std::ops::Range<usize>| {
        let values = range.map(|k| q[k]);
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    };
    let travel = way(last);
    // Bristles bend by less than twice that at which they slide fast, either way.
    assert!(travel > 0.2 * BENT && travel < 20.0 * BENT, "{travel}");
    assert!(work > 1e-5, "{work}");
    // Where the force is zero on the way there and on the way back.
    let (there, back) = (q[sample(2.0 * period)], q[sample(2.5 * period)]);
    assert!(
        (back - there).abs() > 0.1 * travel,
        "{there} {back} of {travel}"
    );
}

/// A spring whose end moves at a constant speed pulls the block: the least and largest speed in the last third.
fn pulled(speed: f64) -> (f64, f64) {
    let mut spring = Law(|measured: &Measured<'_>| 20.0 * (speed * measured.time - measured.q[0]));
    let setting = Loop {
        duration: 40.0,
        log_rate: 200.0,
        ..Loop::default()
    };
    let run = setting.run(block(BENT, 20.0), &mut spring, &still(&[0.0]), &mut |_| {});
    let (record, _) = run.expect("a motion");
    let late = &record.dq[0][2 * record.dq[0].len() / 3..];
    let least = late.iter().copied().fold(f64::MAX, f64::min);
    let most = late.iter().copied().fold(f64::MIN, f64::max);
    (least / speed, most / speed)
}

#[test]
fn it_sticks_and_slips_below_a_critical_speed_only() {
    for slow in [0.01, 0.03] {
        let (least, most) = pulled(slow);
        assert!(least < 0.05 && most > 1.8, "{slow}: {least} {most}");
    }
    for fast in [1.0, 2.0] {
        let (least, most) = pulled(fast);
        assert!(least > 0.95 && most < 1.05, "{fast}: {least} {most}");
    }
}

/// Bristles of 1e5 N/m, hit by reversals at every speed: implicit steps carry them, in numbers that do not grow with the stiffness.
#[test]
fn stiff_bristles_do_not_shorten_steps() {
    let mut counts = Vec::new();
    for stiffness in [1e5, 1e6] {
        let mut shake = Law(|measured: &Measured<'_>| 8.0 * (10.0 * measured.time).sin());
        let setting = Loop {
            duration: 2.0,
            ..Loop::default()
        };
        let arm = block(FC / stiffness, 300.0);
        let run = setting.run(arm, &mut shake, &still(&[0.0]), &mut |_| {});
        let (record, _) = run.expect("a motion");
        let work = record.work;
        counts.push(work.explicit + work.implicit + work.impulses + work.rejected);
        assert!(work.implicit > 0, "{work:?}");
    }
    // 2000 samples, and the reversals.
    assert!(counts.iter().all(|&count| count < 60_000), "{counts:?}");
}
