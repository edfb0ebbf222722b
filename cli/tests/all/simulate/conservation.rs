//! Energy of arms without friction and torque.

use robot_model::simulate::Integrator;
use robot_model_cli::interpreted::InterpretedPlant;

use crate::simulate::common::{pendulum, plant, released, spec};

/// Largest change of the energy over ten seconds, relative to the largest kinetic energy.
fn drift(mut arm: Integrator<InterpretedPlant>) -> f64 {
    let energies = |arm: &mut Integrator<InterpretedPlant>| {
        let (q, dq) = (arm.q().to_vec(), arm.dq().to_vec());
        arm.plant_mut().energies(&q, &dq)
    };
    let [kinetic, potential] = energies(&mut arm);
    let start = kinetic + potential;
    let (mut largest, mut changed) = (kinetic, 0.0_f64);
    for tenth in 1..=100 {
        arm.advance(0.1 * f64::from(tenth)).expect("a motion");
        let [kinetic, potential] = energies(&mut arm);
        largest = largest.max(kinetic);
        changed = changed.max((kinetic + potential - start).abs());
    }
    let work = arm.work();
    assert_eq!((work.events, work.impulses), (0, 0), "{work:?}");
    changed / largest
}

#[test]
fn a_double_pendulum_that_tumbles_keeps_its_energy() {
    let arm = released(plant(pendulum(""), &[]), &[1.3, 0.8], &[0.0, 0.0]);
    let drift = drift(arm);
    assert!(drift < 1e-8, "{drift:e}");
}

#[test]
fn a_puma_that_falls_keeps_its_energy() {
    let arm = plant(spec("puma560", false), &[]);
    let q = [0.3, 0.5, -0.4, 0.2, 0.7, -0.1];
    let drift = drift(released(arm, &q, &[0.2, -0.1, 0.3, 0.1, -0.2, 0.1]));
    assert!(drift < 1e-8, "{drift:e}");
}

#[test]
fn a_panda_that_falls_keeps_its_energy() {
    let arm = plant(spec("panda", false), &[]);
    let q = [0.1, -0.6, 0.2, -2.0, 0.3, 1.6, 0.5];
    let drift = drift(released(arm, &q, &[0.0; 7]));
    assert!(drift < 1e-8, "{drift:e}");
}
