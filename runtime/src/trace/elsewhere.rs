//! What a law is worth where the logs were not.
//!
//! Along one motion the parameters of gravity take most of a spring in, and it lowers the error there by next to nothing, but not that of the
//! next motion. So the model with it and the one without are asked about the same motion elsewhere: every joint's positions moved up or down
//! by a part of the range that the logs have of it.

use crate::columns::Entry;
use crate::identify::{filtered_columns, load_motion};
use crate::signal::Prepared;

use super::gate::{Judged, MATERIAL_PERCENT};
use super::projected::Projected;
use super::search::{Search, State};

/// Part of a joint's range by which its positions are moved.
const PART_OF_RANGE: f64 = 0.25;

/// Up or down for joints of even and of odd numbers.
const SIDES: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];

/// A law that lowers the filtered error of its joint by as much as matters, and in all folds, matters if it lowers the raw one by this much
/// elsewhere, percent. Of clean arms, and those whose laws were too small to matter, it was 5 % at most.
const MATERIAL_PERCENT_ELSEWHERE: f64 = 10.0;

impl Search<'_> {
    /// Whether a law that lowers raw errors by little along the logs would matter along other motions. What is there for a while, or follows
    /// the logged torque, has no elsewhere.
    pub(super) fn is_large_elsewhere(
        &self,
        state: &State,
        judged: &Judged,
        projected: &Projected,
    ) -> bool {
        let candidate = judged.trial.candidate;
        let (improved, folds) = judged.evidence.folds;
        if candidate.is_of_time() || candidate.follows_torque() || improved < folds {
            return false;
        }
        let elsewhere = self.percent_elsewhere(state, judged, projected);
        let mut pairs = elsewhere.iter().zip(&judged.evidence.held_out_percent);
        pairs.any(|(elsewhere, held_out)| {
            *elsewhere >= MATERIAL_PERCENT_ELSEWHERE && *held_out >= MATERIAL_PERCENT
        })
    }

    /// How much less the error would be with a law elsewhere, percent per joint: `100 (1 - sqrt(P / (P + D)))` with its raw error's power `P`
    /// and the mean square `D` of what the two models differ by there, less two deviations of the law's amplitude.
    fn percent_elsewhere(&self, state: &State, judged: &Judged, projected: &Projected) -> Vec<f64> {
        let mut power = vec![0.0; self.arm.dof()];
        let change = projected.change();
        let mut count = 0;
        for sides in SIDES {
            let logs = self.moved(state, sides);
            let mut stack = self.identify.rows(self.arm, &logs, &self.shapes);
            for effect in &state.accepted {
                let trial = &effect.trial;
                let entries = filtered_columns(trial.candidate, &logs, &trial.shapes);
                stack.append(trial.candidate.unknowns(), &entries);
            }
            let mut differ = vec![vec![0.0; stack.samples()]; self.arm.dof()];
            let mut add = |joint: usize, values: &[f64], factor: f64| {
                let sums = differ[joint].iter_mut().zip(values);
                sums.for_each(|(sum, value)| *sum += factor * value);
            };
            let trial = &judged.trial;
            for Entry {
                joint,
                column,
                values,
            } in filtered_columns(trial.candidate, &logs, &trial.shapes)
            {
                add(joint, &values, projected.gain[column]);
            }
            for (joint, rows) in stack.joints.iter().enumerate() {
                for (column, values) in &rows.columns {
                    add(joint, values, change[*column]);
                }
            }
            count += stack.samples();
            for (power, differ) in power.iter_mut().zip(&differ) {
                *power += differ.iter().map(|d| d * d).sum::<f64>();
            }
        }
        let sure = (1.0 - 2.0 / judged.evidence.score.max(4.0).sqrt()).powi(2);
        let pairs = power.iter().zip(&judged.raw_power);
        pairs
            .map(|(power, error)| {
                let differ = sure * power / f64::max(count as f64, 1.0);
                100.0 * (1.0 - (error / (error + differ).max(f64::MIN_POSITIVE)).sqrt())
            })
            .collect()
    }

    /// The logs' motions with joints moved to these sides.
    fn moved(&self, state: &State, sides: [f64; 2]) -> Vec<Prepared> {
        let own = self.arm.unknowns().len();
        let estimate = &state.solution.estimate[..own];
        let mut logs = self.prepared.clone();
        for joint in 0..self.arm.dof() {
            let of_logs = logs.iter().flat_map(|log| &log.motion.smooth.q[joint]);
            let (low, high) = of_logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), q| {
                (low.min(*q), high.max(*q))
            });
            let by = sides[joint % 2] * PART_OF_RANGE * (high - low);
            for log in &mut logs {
                let Prepared { motion, .. } = log;
                for kinematics in [&mut motion.smooth, &mut motion.wide] {
                    kinematics.q[joint].iter_mut().for_each(|q| *q += by);
                }
            }
        }
        for log in &mut logs {
            load_motion(self.arm, &mut log.motion, &self.shapes, estimate);
        }
        logs
    }
}
