//! The controller of the experiment takes part in the simulation.

use super::*;

/// It holds the block on its way, so that even a wrong start is near.
#[test]
fn the_controller_of_the_experiment_takes_part() {
    let reference = |t: f64| 0.3 * (2.0 * t).sin() + 0.1 * (5.0 * t).cos();
    let law = JointLaw {
        position: vec![-1400.0, 0.0, 1000.0],
        torque: vec![0.2],
        channels: vec![
            Tap {
                channel: "wish".to_owned(),
                weights: vec![400.0],
                is_optional: false,
            },
            Tap {
                channel: "pulse".to_owned(),
                weights: vec![3.0],
                is_optional: true,
            },
        ],
        limit: Some(6.0),
    };
    let mut block =
        Integrator::new(Block(TRUTH), &[0.1], &[0.6], Tolerances::default()).expect("sound");
    let mut log = log(0.2);
    (log.time, log.q[0], log.tau[0]) = (Vec::new(), Vec::new(), Vec::new());
    let mut wish = Vec::new();
    let mut cut = 0;
    for k in 0..300_u32 {
        let t = STEP * f64::from(k);
        log.time.push(t);
        log.q[0].push(block.q()[0]);
        wish.push(reference(t));
        let at = |back: usize| log.q[0][log.q[0].len().saturating_sub(1 + back)];
        let before = log.tau[0].last().copied().unwrap_or(0.0);
        let torque = -1400.0 * at(0) + 1000.0 * at(2) + 0.2 * before + 400.0 * reference(t);
        cut += u32::from(torque.abs() > 6.0);
        log.tau[0].push(torque.clamp(-6.0, 6.0));
        block.drive(Drive {
            torque: vec![torque.clamp(-6.0, 6.0)],
            ..Drive::default()
        });
        block.advance(t + STEP).expect("a motion");
    }
    assert!(cut > 5 && cut < 250, "{cut} of 300 samples at the limit");
    log.extra = vec![Channel {
        name: "wish".to_owned(),
        values: wish,
    }];
    let settings = OutputError {
        law: Some(Law { joints: vec![law] }),
        ..HELD
    };
    let found = fit(&settings, &log);
    for k in 0..3 {
        let (value, truth) = (found.values[k], TRUTH[k]);
        assert!((value - truth).abs() < 1e-4 * truth, "{value} {truth}");
    }
    let torque = found.fit.torque.as_ref().expect("a controller made it")[0];
    assert!(
        torque.relative_percent.is_some_and(|share| share < 0.01),
        "{torque:?}"
    );
    // A log without what the controller reads is refused by name.
    log.extra.clear();
    let recording = Recording::new(&log, &[1.0], 0.0, Vec::new());
    let refusal = settings.compare(&Block(TRUTH), &TRUTH, &[recording]);
    assert_eq!(
        refusal,
        Err(OutputErrorError::NoChannel {
            log: "block.csv".to_owned(),
            channel: "wish".to_owned()
        })
    );
}
