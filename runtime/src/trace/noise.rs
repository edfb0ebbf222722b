//! Laws that read the logged torque: do they explain more than its noise?
//!
//! The noise of a torque is in the residual and in a column that is made of that torque, so the column explains it, on samples that were not
//! fitted as well. The model's own torque along the same motion has none of it, and is the same but for what is missing, as an instrument
//! is (Young 2011, Recursive Estimation and Time-Series Analysis). It need not explain as much: a spring swings, too, where its load
//! does not follow from the motion. And the noise of one joint's torque is in the residual of no other joint.

use crate::columns::Change;
use crate::signal::Prepared;

use super::floor::STEPS_OVER_NOISE;
use super::gate::{Baseline, Judged, MATERIAL_PERCENT};
use super::raw::mean_square;
use super::search::{Search, State};
use super::sure::takes_most;
use super::trial::Trial;
use super::verdict::{Evidence, Refusal};

/// Noise that explains itself takes less than this off a joint's error of raw samples: it was 11 % of an arm that lacked nothing.
const MORE_THAN_NOISE_PERCENT: f64 = 20.0;

/// Of a joint's structure a law that is no noise leaves at most this share.
const MOST_LEFT: f64 = 0.5;

impl Search<'_> {
    /// Whether a change of the arm that reads the torque explains more than noise of the positions, and either takes most of an error, or
    /// structure off, or lowers the error of another joint than that whose torque it reads by as much as matters, or its first order lowers
    /// an error so where it reads the torque of the model, on a joint where the change itself does.
    pub(super) fn is_more_than_noise(
        &self,
        state: &State,
        baseline: &Baseline,
        judged: &Judged,
        change: &dyn Change,
    ) -> bool {
        if !self.is_more_than_encoders(state, judged) {
            return false;
        }
        let own = judged.trial.candidate.joints();
        // The second derivative of noise that is flat explains a third of it, held out; of simulated arms that lacked nothing at most half.
        let evidence = &judged.evidence;
        if takes_most(evidence, false)
            || self.takes_structure(state, judged)
            || helps_another_joint(own, evidence)
        {
            return true;
        }
        let Ok(entries) = self.first_order(state, change, self.without_noise(state)) else {
            return false;
        };
        let trial = Trial::first_order(judged.trial.candidate, entries);
        let Some(projected) = trial.project(&baseline.present) else {
            return false;
        };
        let without_noise = baseline.judge(trial, &projected);
        let refused = |refusal| without_noise.refusals.contains(&refusal);
        let pairs = without_noise.evidence.held_out_percent.iter();
        let mut pairs = pairs.zip(&judged.evidence.raw_percent);
        !(refused(Refusal::Chance) || refused(Refusal::HeldOut))
            && pairs.any(|(clean, raw)| clean.min(*raw) >= MATERIAL_PERCENT)
    }

    /// Whether it takes more off the squared error of some joint, where it matters, than noise of the positions may make of it. The torque of the
    /// model has that noise as the logged one has its own, in accelerations, and what differentiates the torque twice more explains it.
    fn is_more_than_encoders(&self, state: &State, judged: &Judged) -> bool {
        let falls = judged.evidence.held_out_percent.iter();
        let mut joints = falls.zip(&state.residuals).zip(&self.position_noise);
        joints.any(|((percent, residual), noise)| {
            outweighs(*percent, mean_square(residual), noise.filtered)
        })
    }

    /// Whether it takes most of the structure off a joint, and more of its error than noise that explains itself does.
    fn takes_structure(&self, state: &State, judged: &Judged) -> bool {
        let before = self.structure_without_steps(state);
        let after = judged.changed.iter().flat_map(|changed| &changed.structure);
        let mut joints = before.iter().zip(after).zip(&judged.evidence.raw_percent);
        joints.any(|((before, after), raw)| {
            before.is_material()
                && after.power < MOST_LEFT * before.power
                && *raw >= MORE_THAN_NOISE_PERCENT
        })
    }

    /// The logs with the torque of the present model in place of what effects read of the logged one.
    fn without_noise(&self, state: &State) -> Vec<Prepared> {
        let mut logs = self.prepared.clone();
        for log in &mut logs {
            log.motion.tau = self.torque(state, log);
            let gains = self.arm.actuator_gain();
            for (torques, gain) in log.motion.tau.iter_mut().zip(gains) {
                for tau in torques {
                    *tau /= gain;
                }
            }
        }
        logs
    }
}

/// Whether a fall of a joint's error by `percent`, of a residual of this power, matters and is more than noise of positions of that power makes.
fn outweighs(percent: f64, residual: f64, noise: f64) -> bool {
    let taken = (1.0 - (1.0 - percent / 100.0).powi(2)) * residual;
    percent >= MATERIAL_PERCENT && taken > STEPS_OVER_NOISE * noise
}

/// Whether a law of these joints lowers the error of another one, whose torque it does not read.
fn helps_another_joint(own: &[usize], evidence: &Evidence) -> bool {
    let pairs = evidence.held_out_percent.iter().zip(&evidence.raw_percent);
    let mut others = pairs.enumerate().filter(|(joint, _)| !own.contains(joint));
    !own.is_empty() && others.any(|(_, (held_out, raw))| held_out.min(*raw) >= MATERIAL_PERCENT)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fall of the error by 28 % takes 48 % off its square.
    #[test]
    fn what_encoders_make_is_no_change_of_the_arm() {
        assert!(!outweighs(28.0, 1.0, 0.25));
        assert!(outweighs(28.0, 1.0, 0.23));
        // Exact positions explain nothing, and what is worse or hardly better is none either.
        assert!(outweighs(28.0, 1.0, 0.0));
        assert!(!outweighs(4.0, 1.0, 0.0) && !outweighs(-28.0, 1.0, 0.0));
    }

    #[test]
    fn noise_of_a_joint_is_in_the_residual_of_no_other() {
        let on = |held_out: [f64; 3], raw: [f64; 3]| Evidence::certain(&held_out, &raw);
        let of_its_own = on([0.0, 70.0, 1.0], [0.0, 40.0, 1.0]);
        let of_another = on([0.0, 70.0, 20.0], [0.0, 40.0, 6.0]);
        assert!(!helps_another_joint(&[1], &of_its_own));
        assert!(helps_another_joint(&[1], &of_another));
        // What is better on the raw samples or held out alone is neither.
        let half = on([0.0, 70.0, 20.0], [0.0, 40.0, 4.0]);
        assert!(!helps_another_joint(&[1], &half));
        // A change of the arm as a whole reads all torques.
        assert!(!helps_another_joint(&[], &of_another));
    }
}
