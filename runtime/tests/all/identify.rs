//! Identification on a plant whose parameters are known.

use super::plant::{Pendulums, Plant, TRUTH};
use robot_model::columns::Arm as _;
use robot_model::identify::{Identify, IdentifyError, Method};

#[test]
fn truth_is_within_four_deviations() {
    let arm = Pendulums::new();
    for seed in 1..6 {
        let log = Plant {
            seed,
            colored: 0.05,
            ..Plant::default()
        }
        .log();
        let estimate = Identify::default()
            .fit(&arm, &[log])
            .expect("the log is sound");
        for (found, truth) in estimate.parameters.iter().zip(TRUTH) {
            let error = (found.value - truth).abs();
            // The dry friction's sign is known to a sample only: 0.3 % of it beside the deviation of the noise.
            assert!(
                error < 4.0 * found.std + 3e-3 * truth,
                "seed {seed}: {found:?}, true {truth}"
            );
            assert!(
                found.std < 0.05 * truth,
                "a deviation that says nothing: {found:?}"
            );
        }
        assert_eq!((estimate.rank, estimate.unexcited.len()), (8, 0));
    }
}

#[test]
fn deviations_are_those_of_repeated_experiments() {
    let arm = Pendulums::new();
    let identify = Identify {
        method: Method::Wls,
        bands: Some(robot_model::signal::Bands::DEFAULT),
        ..Identify::default()
    };
    let mut values = Vec::new();
    let mut claimed = 0.0;
    for seed in 0..24 {
        // The motion's seed is part of the log's; only the noise may differ between experiments.
        let mut log = Plant {
            white: 0.0,
            ..Plant::default()
        }
        .log();
        let noisy = Plant {
            seed,
            white: 0.0,
            colored: 0.2,
            ..Plant::default()
        }
        .log();
        let quiet = Plant {
            seed,
            white: 0.0,
            ..Plant::default()
        }
        .log();
        for j in 0..2 {
            for k in 0..log.tau[j].len() {
                log.tau[j][k] += noisy.tau[j][k] - quiet.tau[j][k];
            }
        }
        let estimate = identify.fit(&arm, &[log]).expect("the log is sound");
        values.push(estimate.parameters[2].value);
        claimed += estimate.parameters[2].std / 24.0;
    }
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let spread =
        (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (values.len() - 1) as f64).sqrt();
    // 24 experiments know a deviation to about 15 %; white-noise formulas would be wrong by the correlation, a factor of 2.
    assert!(
        (0.6..1.6).contains(&(claimed / spread)),
        "claimed {claimed}, seen {spread}"
    );
}

#[test]
fn a_joint_that_does_not_move_is_named() {
    let arm = Pendulums::new();
    let mut log = Plant::default().log();
    log.q[1].fill(0.3);
    let estimate = Identify::default()
        .fit(&arm, &[log])
        .expect("the first joint moves");
    assert!(estimate.rank < 8);
    // Friction may hold its weight, so that its torque does not tell it.
    let still = [
        "joint2.izz",
        "joint2.mx",
        "joint2.viscous_friction.fv",
        "joint2.coulomb_friction.fc",
    ];
    assert_eq!(estimate.unexcited, still);
    assert!(estimate.to_string().contains("not separable"));
}

#[test]
fn errors_are_those_of_the_noise() {
    let arm = Pendulums::new();
    let log = Plant::default().log();
    let estimate = Identify::default()
        .fit(&arm, std::slice::from_ref(&log))
        .expect("the log is sound");
    let errors = estimate.errors(&arm, &log).expect("the log is sound");
    // White noise of 0.05 N m, and dry friction that is wrong for the sample in which its sign changes.
    assert!(
        errors.rmse.iter().all(|rmse| (0.05..0.4).contains(rmse)),
        "{errors:?}"
    );
    assert!(
        errors.relative_percent.iter().all(|percent| *percent < 1.5),
        "{errors:?}"
    );
}

/// Torque that is off by 0.7 and -0.1 in turns: in the mean by 0.3, and by 0.4 about that.
#[test]
fn errors_with_an_offset_are_those_of_their_definitions() {
    let arm = Pendulums::new();
    let mut log = Plant::default().log();
    let estimate = Identify::default()
        .fit(&arm, std::slice::from_ref(&log))
        .expect("the log is sound");
    log.tau = estimate.predict(&arm, &log).expect("the log is sound");
    for tau in &mut log.tau {
        for (k, tau) in tau.iter_mut().enumerate() {
            *tau += if k % 2 == 0 { 0.7 } else { -0.1 };
        }
    }
    let errors = estimate.errors(&arm, &log).expect("the log is sound");
    let fits = errors.nrmse_fit();
    for (joint, tau) in log.tau.iter().enumerate() {
        assert!((errors.mae[joint] - 0.4).abs() < 1e-3, "{errors:?}");
        assert!((errors.rmse[joint] - 0.5).abs() < 1e-3, "{errors:?}");
        // First and last second cut.
        let inner = log.time.iter().zip(tau);
        let (start, end) = (log.time[0], log.time[log.time.len() - 1]);
        let inner = inner.filter(|(t, _)| **t >= start + 1.0 && **t < end - 1.0);
        let inner: Vec<f64> = inner.map(|(_, tau)| *tau).collect();
        let count = f64::from(u32::try_from(inner.len()).expect("samples"));
        let mean = inner.iter().sum::<f64>() / count;
        let spread = inner.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / count;
        let wanted = 100.0 * (1.0 - 0.5 / spread.sqrt());
        let fit = fits[joint].expect("the torque changes");
        assert!((fit - wanted).abs() < 0.02, "{fit}, not {wanted}");
    }
}

#[test]
fn refusals_say_what_is_wrong() {
    let arm = Pendulums::new();
    assert_eq!(
        Identify::default().fit(&arm, &[]),
        Err(IdentifyError::NoLog)
    );
    let mut log = Plant::default().log();
    log.q.truncate(1);
    log.tau.truncate(1);
    let refusal = Identify::default()
        .fit(&arm, &[log])
        .expect_err("another arm's log");
    assert_eq!(
        refusal.to_string(),
        "a simulated log: the log has 1 joints, the spec 2"
    );
    assert_eq!(arm.joints().len(), 2);
}

/// Bodies near CAD, priors and instruments are of one arm, not of one with and without a payload.
#[test]
fn a_payload_is_refused_to_methods_that_do_not_know_it() {
    let logs = [Plant::default().log()];
    let identify = Identify {
        method: Method::Physical,
        ..Identify::default()
    };
    let refused = identify.fit_payload(&Pendulums::new(), &logs, &logs, None);
    let method = "physical";
    assert_eq!(refused.err(), Some(IdentifyError::PayloadMethod { method }));
}
