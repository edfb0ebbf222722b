//! A measured motion, ready for the model: uniform time, filtered position and its derivatives.

use crate::log::Channel;
use crate::signal::resample::cubic;
use crate::signal::{LowPass, MOTION_ORDER, derivative};

/// Position, velocity and acceleration of every joint: `q[joint][sample]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Kinematics {
    /// Positions, rad or m.
    pub q: Vec<Vec<f64>>,
    /// Velocities.
    pub dq: Vec<Vec<f64>>,
    /// Accelerations.
    pub ddq: Vec<Vec<f64>>,
}

/// One log's motion on a uniform time grid, in two bandwidths.
///
/// Rigid-body terms are products of derivatives and want little noise; dry friction changes sign within milliseconds and
/// wants the reversal where it was. Hence two low-pass filters on the same positions: `smooth` for the rigid body and for
/// effects that are smooth in their signals, `wide` for columns that jump or have a kink where a velocity changes sign. Both
/// are zero-phase. The filter that is shared by torque and regressor columns comes after, and makes their bands equal.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion {
    /// Seconds since the start of the log, uniform.
    pub time: Vec<f64>,
    /// For rigid-body terms and smooth effects.
    pub smooth: Kinematics,
    /// For columns that jump with the sign of a velocity.
    pub wide: Kinematics,
    /// The load at the present estimate, as [`Arm::rigid_torque`](crate::columns::Arm::rigid_torque) gives it, `[joint][sample]`; empty until
    /// an estimate exists.
    pub rigid_torque: Vec<Vec<f64>>,
    /// Torque as logged, `[joint][sample]`, for effects that read it; not smoothed except before decimation.
    pub tau: Vec<Vec<f64>>,
    /// Further channels of the log.
    pub extra: Vec<Channel>,
    /// What the transmissions carried, `[joint][sample]`: the logged torque less that of effects at the present estimate, N m
    /// or N; empty until an estimate exists.
    pub transmitted_torque: Vec<Vec<f64>>,
    /// Cutoff of the filter for displacements of links, Hz; 0 where they pass none.
    pub displacement_hz: f64,
    /// Speeds of the wide band below which steps of an encoder hide the direction of a joint, or its dry friction does not act in full, rad/s
    /// or m/s; empty or 0 where the direction is known and all that counts. With `w` for one of them, columns that jump are means over a velocity that is logistic about the measured
    /// one with scale `w / 2`, which makes `tanh(dq / w)` of `sign(dq)`.
    pub turn_speeds: Vec<f64>,
}

impl Motion {
    /// The smooth band with links that stand elsewhere than their joints say: `displacements` are pairs of a joint and what is
    /// added to its position at every sample, rad or m. They pass a zero-phase low-pass at [`Self::displacement_hz`], and are
    /// differentiated as positions are.
    ///
    /// # Examples
    /// ```
    /// use robot_model::motion::Motion;
    ///
    /// let time: Vec<f64> = (0..9).map(|k| 0.1 * f64::from(k)).collect();
    /// let mut motion = Motion { time: time.clone(), ..Motion::default() };
    /// motion.smooth.q = vec![vec![1.0; 9]];
    /// motion.smooth.dq = vec![vec![0.0; 9]];
    /// motion.smooth.ddq = vec![vec![0.0; 9]];
    /// let bent = motion.displaced(&[(0, time.iter().map(|t| t * t).collect())]);
    /// assert!((bent.q[0][4] - 1.16).abs() < 1e-12);
    /// assert!((bent.dq[0][4] - 0.8).abs() < 1e-12 && (bent.ddq[0][4] - 2.0).abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn displaced(&self, displacements: &[(usize, Vec<f64>)]) -> Kinematics {
        let mut kinematics = self.smooth.clone();
        let &[first, second, ..] = self.time.as_slice() else {
            return kinematics;
        };
        let step = second - first;
        let filter = LowPass::butterworth(MOTION_ORDER, self.displacement_hz, 1.0 / step).ok();
        let (mut q, mut dq, mut ddq) = (Vec::new(), Vec::new(), Vec::new());
        for (joint, values) in displacements {
            match &filter {
                Some(filter) => filter.apply(values, &mut q),
                None => q.clone_from(values),
            }
            derivative(&q, step, &mut dq);
            derivative(&dq, step, &mut ddq);
            add(&mut kinematics.q[*joint], &q);
            add(&mut kinematics.dq[*joint], &dq);
            // A motion that was prepared without accelerations has no channels of them.
            if let Some(column) = kinematics.ddq.get_mut(*joint) {
                add(column, &ddq);
            }
        }
        kinematics
    }

    /// What `values`, one a sample, were `seconds` before; before the first sample they are held.
    ///
    /// # Examples
    /// ```
    /// use robot_model::motion::Motion;
    ///
    /// let time: Vec<f64> = (0..9).map(|k| 0.1 * f64::from(k)).collect();
    /// let motion = Motion { time: time.clone(), ..Motion::default() };
    /// let late = motion.late(&time, 0.05);
    /// assert!((late[4] - 0.35).abs() < 1e-12 && late[0] == 0.0);
    /// ```
    #[must_use]
    pub fn late(&self, values: &[f64], seconds: f64) -> Vec<f64> {
        let (Some(first), Some(last), true) =
            (self.time.first(), self.time.last(), self.time.len() > 2)
        else {
            return values.to_vec();
        };
        let before = self.time.iter().map(|t| (t - seconds).clamp(*first, *last));
        let before: Vec<f64> = before.collect();
        cubic(&self.time, values, &before)
    }

    /// The speed below which the direction of a joint is not known, rad/s or m/s.
    ///
    /// # Examples
    /// ```
    /// use robot_model::motion::Motion;
    /// // Steps of the second joint's encoder hide its direction below 0.02 rad/s.
    /// let motion = Motion { turn_speeds: vec![0.0, 0.02], ..Motion::default() };
    /// assert_eq!((motion.turn_speed(1), Motion::default().turn_speed(1)), (0.02, 0.0));
    /// ```
    #[must_use]
    pub fn turn_speed(&self, joint: usize) -> f64 {
        self.turn_speeds.get(joint).copied().unwrap_or(0.0)
    }

    /// A further channel of the log, where it has one of that name.
    ///
    /// # Examples
    /// ```
    /// use robot_model::{log::Channel, motion::Motion};
    /// let oil = Channel { name: "oil".to_owned(), values: vec![20.0, 21.0] };
    /// let motion = Motion { extra: vec![oil], ..Motion::default() };
    /// assert_eq!(motion.channel("oil"), Some([20.0, 21.0].as_slice()));
    /// assert_eq!(motion.channel("air"), None);
    /// ```
    #[must_use]
    pub fn channel(&self, name: &str) -> Option<&[f64]> {
        let found = self.extra.iter().find(|channel| channel.name == name);
        found.map(|channel| channel.values.as_slice())
    }
}

/// `sum += values`
fn add(sum: &mut [f64], values: &[f64]) {
    sum.iter_mut().zip(values).for_each(|(s, v)| *s += v);
}

/// `values` at some samples, a part of a sample later (`-1 ..= 1`), linearly between samples; the last (or first) sample is held.
///
/// # Examples
/// ```
/// use robot_model::motion::between;
/// // A quarter of a sample after sample 1, and before it.
/// assert_eq!(between(&[0.0, 4.0, 8.0], 0.25, &[1]), [5.0]);
/// assert_eq!(between(&[0.0, 4.0, 8.0], -0.25, &[1]), [3.0]);
/// ```
#[must_use]
pub fn between(values: &[f64], part: f64, samples: &[usize]) -> Vec<f64> {
    let last = values.len().saturating_sub(1);
    let at = |&k: &usize| {
        let neighbor = if part < 0.0 {
            k.saturating_sub(1)
        } else {
            (k + 1).min(last)
        };
        values[k] + part.abs() * (values[neighbor] - values[k])
    };
    samples.iter().map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_within_a_sample_averages_to_its_share() {
        // The velocity crosses zero a quarter of a sample after sample 1.
        let velocity = [-5.0, -1.0, 3.0];
        let parts = [-0.375, -0.125, 0.125, 0.375];
        let signs = parts.map(|part| between(&velocity, part, &[1])[0].signum());
        let mean = signs.iter().sum::<f64>() / 4.0;
        assert!((mean - (-0.5)).abs() < 1e-12, "{mean}");
        assert_eq!(between(&velocity, 0.25, &[0, 2]), [-4.0, 3.0]);
    }
}
