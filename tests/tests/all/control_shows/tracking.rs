//! Following a motion by computed torque.

use nalgebra::SMatrix;
use robot_model::{RobotModel as _, Vector};

use super::knowledge::{IDENTIFIED, Knowledge};
use super::puma::{BITS, DRY, POSE, Puma560, plant, root_mean_square, run, setting, waves};

/// Another motion than the one to identify from.
const TONES: &[(f64, f64)] = &[(0.4, 0.17), (0.25, 0.41), (0.1, 0.83)];

/// Natural frequency of the errors, rad/s, where gains are equal.
const FREQUENCY: f64 = 20.0;

/// Seconds that a motion has to settle.
const SETTLED: f64 = 0.4;

/// Position error of all joints once the motion has settled, mrad, root mean square. `None` where the simulation has no
/// continuation.
fn error(known: &Knowledge, frequency: f64, seconds: f64) -> Option<f64> {
    let motion = waves(TONES, 2.0, seconds);
    let mut control = known.computed_torque(frequency);
    let setting = setting(seconds, BITS, 5);
    let record = run(plant(DRY), &setting, &motion, |now, wanted| {
        control.torque(now, wanted).torque
    });
    let record = record.ok()?;
    let times = record.time.iter().enumerate();
    let settled = times.filter(|(_, time)| **time >= SETTLED);
    let errors = settled.flat_map(|(k, &time)| {
        let wanted = motion.at(time).q;
        let joints = wanted.into_iter().zip(&record.q);
        joints.map(move |(wanted, q)| wanted - q[k])
    });
    Some(1e3 * root_mean_square(errors))
}

/// With all parameters right what remains is of the delay, and of the filter that velocities pass.
#[test]
fn identified_parameters_follow_a_motion_more_closely() {
    let tracking = |known: &Knowledge| error(known, FREQUENCY, 4.0).expect("a motion");
    let exact = tracking(&Knowledge::exact());
    let identified = tracking(&IDENTIFIED);
    eprintln!("tracking: exact {exact:.2} mrad, identified {identified:.2} mrad");
    assert!(identified < 1.1 * exact, "{identified} {exact}");
    for seed in 1..=3 {
        let cad = tracking(&Knowledge::mixed_cad(seed));
        eprintln!("tracking: CAD {cad:.2} mrad");
        assert!(identified < 0.5 * cad, "{identified} {cad}");
    }
}

/// Whether the arm does not swing about its motion.
///
/// At these frequencies errors of parameters hardly show, and the arm follows to within 0.2 mrad. Beyond the limit joints swing
/// by a milliradian and more, as far as friction and the largest torques let them.
fn is_stable(known: &Knowledge, frequency: f64) -> bool {
    error(known, frequency, 0.9).is_some_and(|error| error < 0.25)
}

/// The largest natural frequency at which the loop is stable, rad/s, to 2 %.
fn largest_frequency(known: &Knowledge) -> f64 {
    let (mut low, mut high) = (120.0_f64, 300.0_f64);
    assert!(is_stable(known, low) && !is_stable(known, high));
    while high > 1.02 * low {
        let middle = (low * high).sqrt();
        if is_stable(known, middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// `d tau / d ddq` of what is known.
fn inertia(arm: &Puma560, q: &Vector<6>) -> SMatrix<f64, 6, 6> {
    let still = Vector::zeros();
    let rest = arm.inverse_dynamics(q, &still, &still);
    let columns = SMatrix::<f64, 6, 6>::identity();
    let columns: [Vector<6>; 6] = std::array::from_fn(|k| {
        let ddq = columns.column(k).into_owned();
        arm.inverse_dynamics(q, &still, &ddq) - rest
    });
    SMatrix::from_columns(&columns)
}

/// How much more the arm accelerates at most than its controller means: the largest eigenvalue of `M^-1 M_known`.
fn gain(known: &Knowledge) -> f64 {
    let q = Vector::from(POSE);
    let own = inertia(&Knowledge::exact().arm(), &q);
    let lower = own.cholesky().expect("inertias are positive").l();
    let half = lower.solve_lower_triangular(&inertia(&known.arm(), &q));
    let half = half.expect("as above").transpose();
    let ratio = lower.solve_lower_triangular(&half).expect("as above");
    ratio.symmetric_eigenvalues().max()
}

/// What ends the gains is the delay, at a gain that the arm has and not the controller's numbers. So parameters that are too
/// large, on one joint at least, cost gain. Parameters that are all too small allow larger numbers, which stand for the same
/// gains: identification does not win there, it only says what the numbers mean.
#[test]
fn identified_parameters_allow_larger_gains_unless_all_others_are_too_small() {
    let identified = largest_frequency(&IDENTIFIED);
    let told = |name: &str, frequency: f64, known: &Knowledge| {
        eprintln!(
            "gains: {name} {frequency:.0} rad/s, factor {:.2}",
            gain(known)
        );
    };
    told("identified", identified, &IDENTIFIED);
    for seed in 1..=3 {
        let known = Knowledge::mixed_cad(seed);
        let cad = largest_frequency(&known);
        told("CAD", cad, &known);
        assert!(gain(&known) > 1.1);
        assert!(identified > cad, "{identified} {cad}");
    }
    let light = Knowledge::cad(|| false);
    let cad = largest_frequency(&light);
    told("CAD, all too small,", cad, &light);
    assert!(gain(&light) < 0.9);
    assert!(identified < cad, "{identified} {cad}");
}
