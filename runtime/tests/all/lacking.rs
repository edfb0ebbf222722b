//! Deviations know of laws of speed that a model lacks, and of half a sample of a torque's time.

use robot_model::columns::{Arm, Columns, Entry, Shape, Unknown};
use robot_model::identify::{Beyond, Estimate, Identify};
use robot_model::log::Log;
use robot_model::motion::Motion;

use super::pendulum::{measure, pendulum};

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

/// The pendulum with a loss in proportion to `v |v|`, but for a ten-thousandth of another law.
struct Stirring {
    arm: super::pendulum::Pendulum,
    unknowns: Vec<Unknown>,
}

impl Stirring {
    fn new() -> Self {
        let arm = pendulum();
        let mut unknowns = arm.unknowns().to_vec();
        unknowns.push(Unknown {
            name: "joint.quadratic_viscous.c".to_owned(),
            nonnegative: true,
        });
        Self { arm, unknowns }
    }

    fn bump(v: f64) -> f64 {
        v.signum() * (-(v / 0.8).powi(2)).exp()
    }

    fn law(v: f64) -> f64 {
        v * v.abs() + 1e-4 * Self::bump(v)
    }
}

impl Columns for Stirring {
    fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }
    fn shapes(&self) -> &[Shape] {
        &[]
    }
    fn uses_rigid_torque(&self) -> bool {
        false
    }
    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let mut entries = self.arm.entries(motion, shapes);
        entries.push(Entry {
            joint: 0,
            column: 3,
            values: motion.wide.dq[0].iter().map(|v| Self::law(*v)).collect(),
        });
        entries
    }
}

impl Arm for Stirring {
    fn dof(&self) -> usize {
        self.arm.dof()
    }
    fn joints(&self) -> &[String] {
        self.arm.joints()
    }
    fn actuator_gain(&self) -> &[f64] {
        self.arm.actuator_gain()
    }
    fn known_torque(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        self.arm.known_torque(motion, shapes)
    }
    fn rigid_torque(&self, motion: &Motion, shapes: &[f64], estimate: &[f64]) -> Vec<Vec<f64>> {
        self.arm.rigid_torque(motion, shapes, estimate)
    }
}

/// Beside its own column the law would be told from next to nothing, with a coefficient of hundreds against the other's.
#[test]
fn a_law_that_the_model_has_is_not_asked_for_again() {
    let mut log = measure(0.0);
    let speeds: Vec<f64> = log.q[0].windows(2).map(|q| (q[1] - q[0]) / 0.002).collect();
    for (tau, v) in log.tau[0].iter_mut().zip(speeds) {
        *tau += 0.3 * Stirring::law(v) + 0.1 * Stirring::bump(v);
    }
    let fit = Identify::default().fit(&Stirring::new(), &[log]);
    let fit = fit.expect("it moves");
    let loss = &fit.parameters[3];
    assert!(
        (loss.value - 0.3).abs() < 0.15,
        "{} {}",
        loss.value,
        loss.std
    );
    assert!(loss.std < 0.3, "{} {}", loss.value, loss.std);
}
