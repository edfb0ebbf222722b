//! Deviations know of laws of speed that a model lacks, and of half a sample of a torque's time.

use robot_model::identify::{Beyond, Estimate, Identify};
use robot_model::log::Log;

#[path = "doc/pendulum.rs"]
#[expect(dead_code, reason = "it is the arm of the documentation's examples")]
mod pendulum;

use pendulum::{measure, pendulum};

const TRUTH: [f64; 3] = [2.0, 9.0, 1.0];

/// A fit, and one whose deviations are those of noise alone.
fn fits(log: &Log) -> [Estimate; 2] {
    [Beyond::Delays, Beyond::Deviations].map(|beyond| {
        let identify = Identify {
            beyond,
            ..Identify::default()
        };
        let found = identify.fit(&pendulum(), std::slice::from_ref(log));
        found.expect("it moves")
    })
}

/// Deviations by which each value is off.
fn off(estimate: &Estimate) -> Vec<f64> {
    let pairs = estimate.parameters.iter().zip(TRUTH);
    pairs
        .map(|(found, truth)| ((found.value - truth) / found.std).abs())
        .collect()
}

#[test]
fn friction_that_a_model_lacks_is_in_the_deviations_of_what_makes_up_for_it() {
    let [known, noise] = fits(&measure(0.7));
    assert_eq!(known.values(), noise.values());
    // Viscous friction makes up for dry friction.
    assert!(off(&noise)[2] > 10.0, "{:?}", off(&noise));
    assert!(
        off(&known).iter().all(|off| *off < 2.1),
        "{:?}",
        off(&known)
    );
    let [found] = known.other_friction[..] else {
        panic!("{:?}", known.other_friction)
    };
    assert!(found.joint == 0 && (1.0..20.0).contains(&found.percent));
    assert!(noise.other_friction.is_empty());
}

#[test]
fn a_model_that_lacks_nothing_has_the_deviations_of_noise() {
    let [known, noise] = fits(&measure(0.0));
    assert!(known.other_friction.is_empty());
    for (known, noise) in known.parameters.iter().zip(&noise.parameters) {
        let wider = known.std / noise.std;
        assert!((1.0..1.5).contains(&wider), "{}: {wider}", known.name);
    }
    assert!(
        off(&known).iter().all(|off| *off < 2.1),
        "{:?}",
        off(&known)
    );
}

#[test]
fn torque_that_is_held_for_a_sample_moves_values_within_their_deviations() {
    let fine = measure(0.0);
    // Every tenth sample, 20 ms apart; the torque is the mean of the interval behind, which is that of 10 ms later.
    let few = |values: &[f64]| values.iter().step_by(10).copied().collect::<Vec<f64>>();
    let time = few(&fine.time);
    let mut tau = few(&fine.tau[0]);
    for k in 0..tau.len() - 1 {
        tau[k] = 0.5 * (tau[k] + tau[k + 1]);
    }
    let log = Log::from_samples("held", time, vec![few(&fine.q[0])], vec![tau]).expect("finite");
    let [known, noise] = fits(&log);
    assert!(off(&noise)[2] > 2.5, "{:?}", off(&noise));
    assert!(
        off(&known).iter().all(|off| *off < 2.1),
        "{:?}",
        off(&known)
    );
}

/// Noise of 5 % of the torque that is alike over 20 ms, as a fixed series.
fn noisy(log: &Log, late: usize) -> Log {
    let mut log = log.clone();
    log.tau[0].rotate_right(late);
    let squares: f64 = log.tau[0].iter().map(|tau| tau * tau).sum();
    let size = 0.05 * (squares / log.tau[0].len() as f64).sqrt();
    let (mut state, mut seed) = (0.0, 1_u32);
    for tau in &mut log.tau[0] {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let white = (f64::from(seed >> 8) / f64::from(1 << 24) - 0.5) * 12_f64.sqrt();
        state = 0.905 * state + (1.0 - 0.905_f64.powi(2)).sqrt() * white;
        *tau += size * state;
    }
    log
}

#[test]
fn a_delay_that_noise_hides_is_in_the_deviations() {
    let [known, noise] = fits(&noisy(&measure(0.0), 5));
    assert!(known.delays.is_empty(), "{:?}", known.delays);
    let hidden = known.hidden_delay.expect("10 ms");
    // A noisy torque has a noisy slope.
    assert!((0.004..0.012).contains(&hidden.seconds), "{hidden:?}");
    let (known, noise) = (off(&known), off(&noise));
    assert!(noise[2] > 3.0, "{noise:?}");
    assert!(known[2] < 0.7 * noise[2], "{known:?} {noise:?}");
    assert!(known.iter().all(|off| *off < 2.5), "{known:?}");
    let [on_time, _] = fits(&noisy(&measure(0.0), 0));
    assert_eq!(on_time.hidden_delay, None);
}
