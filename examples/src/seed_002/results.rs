//! All that is computed, once.

use robot_model::excite::Design;
use robot_model::log::Log;

use super::arm::{CONVENTIONAL, ROKAE, interpreted};
use super::base::{Base, base};
use super::excitation::{Objectives, designs, objectives, request, violation, wanted};
use super::experiment::{RIPPLE_2, measure, test_motion};
use super::guiding::{Conventional, Guided, Modified, guide, identified};
use super::law;
use super::streaming::{Streamed, stream};
use super::table_one::{Audited, ours, printed};
use super::table_two::{Fit, WEIGHTS, fit};
use super::truth::SAMPLES;
use crate::paper::Error;
use robot_model::excite::{Criterion, Scaling};

/// What comes out.
#[derive(Debug)]
pub struct Results {
    /// Of the law, N m: the largest difference of the compiled one; its jump at `eps` joint by joint, as printed and repaired.
    pub law_difference: f64,
    /// Jumps, `[printed, continuous]`.
    pub jumps: [[f64; 6]; 2],
    /// Speeds at which friction begins to fall, rad/s.
    pub peaks: [f64; 6],
    /// What the tracer misses where friction falls at low speeds, with the printed law, and with `stribeck` beside it.
    pub missing: [Vec<String>; 2],
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
    /// Audits of Table I: as printed, with magnitudes.
    pub table_1: [Audited; 2],
    /// Audits of the simulated arm: with the friction of Table I, without square and cube.
    pub ours: [Audited; 2],
    /// Hand guiding by TFLS and MFWLS.
    pub guided: [Guided; 2],
    /// Streaming.
    pub streamed: Streamed,
}

/// Each joint's.
fn each(of: impl Fn(usize) -> Result<f64, Error>) -> Result<[f64; 6], Error> {
    let mut all = [0.0; 6];
    for (k, one) in all.iter_mut().enumerate() {
        *one = of(k)?;
    }
    Ok(all)
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

    let train = |t: f64| wanted(of_hadamard, t);
    let train = measure("train", &train, SAMPLES, 1)?;
    let test = measure("test", &test_motion, SAMPLES, 2)?;
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
    let tfls: Conventional = identified(&conventional[0].estimate);
    let mfwls: Modified = identified(&modified[1].estimate);

    let audited = |values| Audited::of(rokae, &values);
    Ok(Results {
        law_difference: law::difference()?,
        jumps: [
            each(|k| law::jump(law::PRINTED, k))?,
            each(|k| law::jump(law::CONTINUOUS, k))?,
        ],
        peaks: each(law::peak)?,
        missing: [
            law::missing_where_friction_falls(law::PRINTED)?,
            law::missing_where_friction_falls(&law::beside("stribeck on j;"))?,
        ],
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
        table_1: [audited(printed(false))?, audited(printed(true))?],
        ours: [audited(ours(true))?, audited(ours(false))?],
        guided: [guide(tfls)?, guide(mfwls)?],
        streamed: stream(&arm, of_hadamard)?,
        logs: [train, test],
        designs,
    })
}
