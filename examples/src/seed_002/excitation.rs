//! Motions to identify from: the publication's series, its conditions, its objective, and three others.

use std::sync::Mutex;
use std::thread;

use robot_model::excite::{
    Criterion, Design, Ends, ExciteError, Fourier, Limits, Progress, Regressor, Request, Scaling,
};
use robot_model_cli::interpreted::InterpretedFunction;
use robot_model_codegen::base::shape_values;
use robot_model_codegen::{Compiled, Nominal, RivalColumns};

use super::experiment::Wanted;
use super::truth::{HARMONICS, PERIOD};
use crate::paper::Error;

/// Speeds, rad/s. The publication has none. Its Table II has: the cube of joint 1 explains `sqrt(1.159^2 - 1.123^2)` = 0.29 N m, and the
/// part of `fv3 v^3` that a straight line cannot have is `0.18 fv3 V^3` of a wave with the amplitude `V`, so `V` is 0.7 rad/s.
const VELOCITY: [f64; 6] = [1.0, 1.0, 0.7, 1.3, 1.2, 1.3];
/// rad/s^2
const ACCELERATION: [f64; 6] = [3.0, 3.0, 2.0, 4.0, 4.0, 4.0];

/// Criteria by their names.
pub const CRITERIA: [(&str, Criterion); 4] = [
    ("Hadamard's bound", Criterion::Hadamard),
    ("log det (D)", Criterion::DOptimal),
    ("condition number", Criterion::Condition),
    ("least eigenvalue (E)", Criterion::EOptimal),
];

/// What is designed: equations 24 to 26 with the limits of this arm, at rest in its zero at both ends.
///
/// Least squares of the publication weighs a newton meter alike on all joints, so the noise is the same.
#[must_use]
pub fn request(compiled: &Compiled, criterion: Criterion, scaling: Scaling) -> Request {
    let joints = &compiled.model.joints;
    let nominal = |turn: Vec<f64>| Nominal {
        beta: vec![0.0; compiled.base.kept.len()],
        shapes: shape_values(&compiled.model),
        turn,
    };
    let columns = |turn| compiled.design_columns(&nominal(turn), &RivalColumns::default());
    let function = |programs| InterpretedFunction::new(programs, compiled.dof(), PERIOD);
    let followed = columns(VELOCITY.map(|speed| 0.01 * speed).to_vec());
    let exact = columns(Vec::new());
    let names = followed.columns.iter();
    // The least eigenvalue is another one in the next valley.
    let starts = if criterion == Criterion::EOptimal {
        2
    } else {
        1
    };
    Request {
        joints: joints.iter().map(|joint| joint.name.clone()).collect(),
        regressor: Regressor {
            columns: names.map(|column| column.name(compiled)).collect(),
            entries: followed.entries,
            function: Box::new(function(followed.function)),
            exact: Box::new(function(exact.function)),
        },
        limits: Limits {
            position: joints
                .iter()
                .filter_map(|joint| joint.limits.position)
                .collect(),
            velocity: VELOCITY.to_vec(),
            acceleration: ACCELERATION.to_vec(),
            ..Limits::none(joints.len())
        },
        clearances: Vec::new(),
        criterion,
        basis: None,
        scaling,
        noise: vec![1.0; joints.len()],
        period: PERIOD,
        harmonics: HARMONICS,
        ends: Ends::At(vec![0.0; joints.len()]),
        starts,
        seed: 1,
    }
}

/// One design a criterion, on two cores.
///
/// # Errors
/// Those of [`Request::run`].
pub fn designs(compiled: &Compiled) -> Result<Vec<Design>, Error> {
    let design =
        |criterion: &Criterion| request(compiled, criterion.clone(), Scaling::Raw).run(&|_| true);
    let found: Vec<Result<Design, ExciteError>> = thread::scope(|scope| {
        let running = CRITERIA
            .each_ref()
            .map(|(_, criterion)| scope.spawn(move || design(criterion)));
        let ended = running.map(|one| one.join().expect("a search does not panic"));
        ended.into_iter().collect()
    });
    Ok(found.into_iter().collect::<Result<_, _>>()?)
}

/// Values of Hadamard's objective at the ends of searches from two random motions, and `ln det` of what they end at; none where the
/// search refuses that, as it tells no parameters from each other.
#[derive(Debug, Clone, Default)]
pub struct Objectives {
    /// The objective.
    pub values: Vec<f64>,
    /// What motions are worth.
    pub log_det: Vec<Option<f64>>,
}

/// Searches with columns as they are, or of unit length.
///
/// # Errors
/// Those of [`Request::run`], but for a motion that tells no parameters from each other.
pub fn objectives(compiled: &Compiled, scaling: Scaling) -> Result<Objectives, Error> {
    let mut found = Objectives::default();
    for seed in 1..=2 {
        let mut request = request(compiled, Criterion::Hadamard, scaling);
        request.seed = seed;
        // The value of the first start is told when the second one is offered, and that is refused.
        request.starts = 2;
        let told = Mutex::new(None);
        let watch = |progress: Progress| {
            if let Some(best) = progress.best {
                *told.lock().expect("no panic") = Some(best);
            }
            progress.start < 2
        };
        let design = match request.run(&watch) {
            Ok(design) => Some(design.quality.log_det),
            Err(ExciteError::NotExcited(_)) => None,
            Err(other) => return Err(other.into()),
        };
        found.values.extend(told.into_inner().expect("no panic"));
        found.log_det.push(design);
    }
    Ok(found)
}

/// What the motion wants of each joint.
#[must_use]
pub fn wanted(motion: &Fourier, t: f64) -> Wanted {
    std::array::from_fn(|joint| motion.at(joint, t))
}

/// Largest difference of velocities and accelerations from differences of the eighth order of the positions, over the largest of each.
#[must_use]
pub fn against_differences(motion: &Fourier) -> f64 {
    const FIRST: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    const SECOND: [f64; 4] = [8.0 / 5.0, -1.0 / 5.0, 8.0 / 315.0, -1.0 / 560.0];
    let h = 0.02;
    let mut worst: f64 = 0.0;
    for joint in 0..motion.coefficients.len() {
        let (mut off, mut most) = ([0.0_f64; 2], [0.0_f64; 2]);
        for k in 0..400 {
            let t = 0.05 * f64::from(k);
            let at = |steps: f64| motion.at(joint, t + steps * h)[0];
            let [q, dq, ddq] = motion.at(joint, t);
            let (mut first, mut second) = (0.0, -205.0 / 72.0 * q);
            for (n, (one, two)) in (1..=4).map(f64::from).zip(FIRST.iter().zip(&SECOND)) {
                first += one * (at(n) - at(-n));
                second += two * (at(n) + at(-n));
            }
            let pairs = [(first / h, dq), (second / (h * h), ddq)];
            for (order, (numeric, exact)) in pairs.into_iter().enumerate() {
                off[order] = off[order].max((numeric - exact).abs());
                most[order] = most[order].max(exact.abs());
            }
        }
        worst = worst.max(off[0] / most[0]).max(off[1] / most[1]);
    }
    worst
}

/// By how much a motion exceeds the limits, as a share of each, or misses the ends, on a grid ten times as fine as that of the design.
#[must_use]
pub fn violation(request: &Request, motion: &Fourier) -> f64 {
    let instants = 400 * HARMONICS;
    let mut worst: f64 = 0.0;
    for joint in 0..motion.coefficients.len() {
        let (low, high) = request.limits.position[joint];
        for k in 0..=instants {
            let [q, dq, ddq] = motion.at(joint, PERIOD * k as f64 / instants as f64);
            let over = [
                (low - q) / (high - low),
                (q - high) / (high - low),
                dq.abs() / VELOCITY[joint] - 1.0,
                ddq.abs() / ACCELERATION[joint] - 1.0,
            ];
            worst = over.into_iter().fold(worst, f64::max);
        }
        for t in [0.0, PERIOD] {
            let ends = motion.at(joint, t).map(f64::abs);
            // Rounding of a sum of ten terms.
            let missed = ends.into_iter().fold(0.0, f64::max);
            worst = worst.max(if missed < 1e-12 { 0.0 } else { missed });
        }
    }
    worst
}
