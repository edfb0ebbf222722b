//! All that is computed, once.

use std::thread;

use robot_model::excite::Design;
use robot_model::log::Log;

use super::arm::{CONVENTIONAL, ROKAE};
use super::base::{Base, base};
use super::excitation::{Objectives, designs, objectives, request, violation, wanted};
use super::experiment::{RIPPLE_2, measure, test_motion};
use super::guiding::{Conventional, Guided, Modified, guide, identified};
use super::law::{self, Besides, Speeds};
use super::stacked::Standard;
use super::streaming::{Streamed, stream, sums_of_squares};
use super::table_one::{ours, printed};
use super::table_two::{Fit, WEIGHTS, fit};
use crate::paper::{Audited, Error, interpreted};
use robot_model::excite::{Criterion, Scaling};

/// What comes out.
#[derive(Debug)]
pub struct Results {
    /// Of the law, N m: the largest difference of the compiled one; its jump at `eps` joint by joint, as printed and repaired.
    pub law_difference: f64,
    /// Jumps, `[printed, continuous]`.
    pub jumps: [[Option<[f64; 2]>; 6]; 2],
    /// Speeds from which friction falls and drives, by a scan.
    pub speeds: [Speeds; 6],
    /// What the tracer misses where friction falls at low speeds, with the printed law, and with `stribeck` beside it.
    pub missing_fall: [Vec<String>; 2],
    /// The same where friction depends on the position, and `position_dependent_friction`.
    pub missing_position: [Vec<String>; 2],
    /// Whether friction reads positions: the printed law, and one with `position_dependent_friction` beside it.
    pub reads_position: [bool; 2],
    /// Base parameters.
    pub base: Base,
    /// Motions, by the criteria.
    pub designs: Vec<Design>,
    /// By how much they exceed limits or miss the ends.
    pub violations: Vec<f64>,
    /// Hadamard's objective after several searches and `ln det` there: columns as they are, columns of unit length.
    pub objectives: [Objectives; 2],
    /// Runs that were fitted and tested.
    pub logs: [Log; 2],
    /// Fits with conventional friction, by weights.
    pub conventional: Vec<Fit>,
    /// Fits with the publication's friction, by weights.
    pub modified: Vec<Fit>,
    /// By torque norm, with the publication's friction and what joint 2 has besides.
    pub with_ripple: Fit,
    /// The same four fits as of Table II and its missing one of an arm whose joint 2 has no ripple: conventional friction, then the
    /// publication's, each without weights and with those by torque norm.
    pub without_ripple: [Fit; 4],
    /// Audits of Table I: as printed, with magnitudes.
    pub table_1: [Audited; 2],
    /// Audits of the simulated arm: with the friction of Table I, without square and cube.
    pub ours: [Audited; 2],
    /// Hand guiding by TFLS and MFWLS.
    pub guided: [Guided; 2],
    /// Streaming all 96 columns, and those of base parameters.
    pub streamed: [Streamed; 2],
    /// What equation 29 multiplies, a column.
    pub sums: Vec<f64>,
}

impl Results {
    /// Speed from which on the friction of Table I drives a joint, rad/s: as printed (0), with magnitudes (1).
    #[must_use]
    pub fn drives_from(&self, table: usize, joint: usize) -> Option<f64> {
        self.table_1[table].drives_from(&format!("j{}", joint + 1))
    }
}

/// Each joint's.
fn each<T: Copy + Default>(of: impl Fn(usize) -> Result<T, Error>) -> Result<[T; 6], Error> {
    let mut all = [T::default(); 6];
    for (k, one) in all.iter_mut().enumerate() {
        *one = of(k)?;
    }
    Ok(all)
}

/// Two results at once.
fn both<R: Send>(
    one: impl FnOnce() -> Result<R, Error> + Send,
    other: impl FnOnce() -> Result<R, Error> + Send,
) -> Result<[R; 2], Error> {
    thread::scope(|scope| {
        let later = scope.spawn(other);
        let first = one()?;
        Ok([first, later.join().expect("a simulation does not panic")?])
    })
}

/// Computes everything.
///
/// # Errors
/// Those of the libraries.
pub fn results() -> Result<Results, Error> {
    let arm = interpreted("rokae.robot", ROKAE)?;
    let rokae = arm.compiled();
    let plain = interpreted("conventional.robot", CONVENTIONAL)?;
    let designs = designs(rokae)?;
    let limits = request(rokae, Criterion::Hadamard, Scaling::Raw);
    let of_hadamard = &designs[0].motion;

    let of_design = |t: f64| wanted(of_hadamard, t);
    let [loud, quiet] = [RIPPLE_2[0], 0.0].map(|ripple| {
        both(
            || measure("train", &of_design, ripple, 1),
            || measure("test", &test_motion, ripple, 2),
        )
    });
    let ([train, test], quiet) = (loud?, quiet?);
    let fits = |arm| -> Result<Vec<Fit>, Error> {
        let all = 0..WEIGHTS.len();
        all.map(|weights| fit(arm, [&train, &test], weights))
            .collect()
    };
    let (conventional, modified) = (fits(&plain)?, fits(&arm)?);
    let ripple = format!(
        "motor_inertia on all; torque_ripple(k = {}) on j2;",
        RIPPLE_2[1]
    );
    let rippled = ROKAE.replace("motor_inertia on all;", &ripple);
    let rippled = interpreted("rokae.robot", &rippled)?;
    let with_ripple = fit(&rippled, [&train, &test], 1)?;
    let [train_quiet, test_quiet] = &quiet;
    let of_quiet = |arm, weights| fit(arm, [train_quiet, test_quiet], weights);
    let without_ripple = [
        of_quiet(&plain, 0)?,
        of_quiet(&plain, 1)?,
        of_quiet(&arm, 0)?,
        of_quiet(&arm, 1)?,
    ];
    let tfls: Conventional = identified(&conventional[0].estimate);
    let mfwls: Modified = identified(&modified[1].estimate);

    let audited = |values| Audited::of(rokae, &values);
    Ok(Results {
        law_difference: law::difference()?,
        jumps: [
            each(|k| law::jump(law::PRINTED, k))?,
            each(|k| law::jump(law::CONTINUOUS, k))?,
        ],
        speeds: each(law::scanned)?,
        missing_fall: Besides::Falls.missing()?,
        missing_position: Besides::Position.missing()?,
        reads_position: [
            law::reads_position(law::PRINTED)?,
            law::reads_position(&law::beside("position_dependent_friction on j;"))?,
        ],
        base: base(rokae)?,
        violations: designs
            .iter()
            .map(|design| violation(&limits, &design.motion).max(design.quality.violation))
            .collect(),
        objectives: [
            objectives(rokae, Scaling::Raw)?,
            objectives(rokae, Scaling::UnitLength)?,
        ],
        conventional,
        modified,
        with_ripple,
        without_ripple,
        table_1: [audited(printed(false))?, audited(printed(true))?],
        ours: [audited(ours(true))?, audited(ours(false))?],
        guided: both(|| guide(tfls), || guide(mfwls))?,
        streamed: [
            stream(&Standard::new(rokae), of_hadamard)?,
            stream(&arm, of_hadamard)?,
        ],
        sums: sums_of_squares(&arm, of_hadamard),
        logs: [train, test],
        designs,
    })
}
