//! What pushes the wrist, from the torques of the motors.

use robot_model::control::ContactForce;
use robot_model::log::Log;
use robot_model::signal::{Bands, LowPass, Prepared, prepare};
use robot_model::{State, Vector};

use super::knowledge::{IDENTIFIED, Knowledge};
use super::puma::{BITS, PUSH, PUSHED, log, plant, root_mean_square, run, setting, waves};

/// Small, so that no pose is singular.
const TONES: &[(f64, f64)] = &[(0.15, 0.23), (0.05, 0.7)];

/// What counts as contact, s: the push less what the filters smear at its ends.
const CONTACT: std::ops::Range<f64> = 1.3..3.7;

/// The force at the wrist less what it should be, N, root mean square.
fn error(prepared: &Prepared, force: impl Fn(&State<6>, &Vector<6>) -> Vector<6>) -> f64 {
    let motion = &prepared.motion;
    let smooth = &motion.smooth;
    let at = |columns: &[Vec<f64>], k: usize| Vector::<6>::from_fn(|joint, _| columns[joint][k]);
    let mut forces = vec![Vec::new(); 3];
    for k in 0..motion.time.len() {
        let state = State::new(at(&smooth.q, k), at(&smooth.dq, k), at(&smooth.ddq, k));
        // What acts on the arm is the opposite of what it exerts.
        let found = -force(&state, &at(&prepared.tau, k));
        for (axis, forces) in forces.iter_mut().enumerate() {
            forces.push(found[axis]);
        }
    }
    let filter = LowPass::butterworth(4, 10.0, prepared.rate_hz).expect("a low-pass");
    let mut filtered = Vec::new();
    let squares = forces.iter().zip(PUSH).map(|(forces, push)| {
        filter.apply(forces, &mut filtered);
        let times = motion.time.iter().zip(&filtered);
        let inside = times.filter(|(time, _)| CONTACT.contains(*time));
        root_mean_square(inside.map(|(_, force)| force - push)).powi(2)
    });
    squares.sum::<f64>().sqrt()
}

fn pushed() -> Log {
    let motion = waves(TONES, 1.0, 5.0);
    let mut control = IDENTIFIED.computed_torque(20.0);
    let record = run(
        plant(PUSHED),
        &setting(5.0, BITS, 7),
        &motion,
        |now, wanted| control.torque(now, wanted).torque,
    );
    log(record.expect("a motion"))
}

#[test]
fn contact_forces_want_the_model() {
    let log = pushed();
    let prepared = prepare(&log, &Bands::for_log(&log)).expect("a log of 5 s");
    let contact = |known: &Knowledge| ContactForce::new(known.arm(), 0.02).expect("a threshold");
    let with = |known: &Knowledge| {
        let contact = contact(known);
        error(&prepared, |state, tau| contact.of_arm(state, tau).force)
    };
    let identified = with(&IDENTIFIED);
    let bare = contact(&IDENTIFIED);
    let without = error(&prepared, |state, tau| bare.at_tip(&state.q, tau).force);
    eprintln!("contact: identified {identified:.2} N, without a model {without:.2} N");
    assert!(identified < 0.1 * without, "{identified} {without}");
    for seed in 1..=3 {
        let cad = with(&Knowledge::mixed_cad(seed));
        eprintln!("contact: CAD {cad:.2} N");
        assert!(identified < 0.5 * cad, "{identified} {cad}");
        assert!(cad < 0.5 * without, "{cad} {without}");
    }
}
