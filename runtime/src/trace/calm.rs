//! A calm motion: raw errors of models whose accelerations are mostly noise.
//!
//! Columns of rows are formed in wide bands and filtered afterwards, so that noise of positions beyond the shared band does not matter there.
//! Raw errors are not filtered: each hertz of the motion's bands adds noise of accelerations to the model's torque, until it is most of the
//! error, and no effect takes a share of it that matters, or one that does makes it worse. Where accelerations are that noisy raw errors are
//! asked along a motion of the shared band, too, and each joint has those of the motion that leaves less of its torque.

use crate::identify::IdentifyError;
use crate::log::Log;
use crate::signal::{Bands, Prepared, prepare, raw_acceleration_noise};

use super::raw::mean_square;
use super::search::Search;

/// Accelerations are noisy where noise makes this share of their power, on some joint of some log.
const NOISY: f64 = 0.05;

/// Raw residuals, each joint's along the motion that leaves it least.
pub(super) struct Calmest {
    /// `[log][joint][sample]`
    pub(super) residuals: Vec<Vec<Vec<f64>>>,
    /// Which motion that is, per joint.
    motion: Vec<usize>,
}

/// The bands of a calm motion.
pub(super) fn bands(of_rows: &Bands) -> Bands {
    Bands {
        smooth_hz: of_rows.shared_hz,
        ..*of_rows
    }
}

/// The logs with a calm motion where accelerations are noisy, sample by sample beside those of the rows; else none.
pub(super) fn logs(
    logs: &[Log],
    prepared: &[Prepared],
    of_rows: &Bands,
) -> Result<Vec<Prepared>, IdentifyError> {
    let is_noisy = |log: &Prepared| {
        let shares = raw_acceleration_noise(log, of_rows).unwrap_or_default();
        shares.iter().any(|share| *share > NOISY)
    };
    if !prepared.iter().any(is_noisy) {
        return Ok(Vec::new());
    }
    let pairs = logs.iter().zip(prepared);
    let calm = pairs.map(|(log, prepared)| {
        let mut calm = prepare(log, &bands(of_rows))?;
        calm.motion
            .turn_speeds
            .clone_from(&prepared.motion.turn_speeds);
        calm.motion
            .rigid_torque
            .clone_from(&prepared.motion.rigid_torque);
        calm.motion
            .transmitted_torque
            .clone_from(&prepared.motion.transmitted_torque);
        Ok(calm)
    });
    calm.collect()
}

/// Of raw residuals along several motions, `[log][joint][sample]` each, those that are least.
pub(super) fn calmest(mut motions: impl Iterator<Item = Vec<Vec<Vec<f64>>>>) -> Calmest {
    let mut residuals = motions.next().unwrap_or_default();
    let joints = residuals.first().map_or(0, Vec::len);
    let mut motion = vec![0; joints];
    for (number, mut others) in motions.enumerate() {
        for joint in 0..joints {
            let power =
                |logs: &[Vec<Vec<f64>>]| mean_square(logs.iter().flat_map(|log| &log[joint]));
            if power(&others) < power(&residuals) {
                for (log, other) in residuals.iter_mut().zip(&mut others) {
                    std::mem::swap(&mut log[joint], &mut other[joint]);
                }
                motion[joint] = number + 1;
            }
        }
    }
    Calmest { residuals, motion }
}

impl Search<'_> {
    /// The logs in every motion along which raw errors are asked.
    pub(super) fn motions(&self) -> impl Iterator<Item = &[Prepared]> {
        let all = [self.prepared.as_slice(), self.calm.as_slice()];
        all.into_iter().filter(|logs| !logs.is_empty())
    }

    /// What noise of positions makes of a joint's raw residuals, mean square.
    pub(super) fn raw_noise(&self, of: &Calmest, joint: usize) -> f64 {
        [&self.position_noise, &self.calm_noise][of.motion[joint]][joint].raw
    }
}
