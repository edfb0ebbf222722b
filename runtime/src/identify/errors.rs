//! How far a model is from what was measured.

/// Of its mean: a torque that varies by less is constant.
const ROUNDING: f64 = 1e-12;

/// Errors of a model on a log.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Errors {
    /// Root mean square of measured minus predicted torque per joint, raw samples, first and last second cut, of less than four
    /// seconds a quarter at either end; N m or N.
    pub rmse: Vec<f64>,
    /// `100 || tau - prediction || / || tau ||` per joint, both filtered by the shared low-pass and decimated: RMS% of Taati,
    /// Tahmasebi, Hashtrudi-Zaad (equation 15). Without long rests of joints with dry friction, as where it is fitted: that holds them with a torque that no
    /// model knows.
    pub relative_percent: Vec<f64>,
    /// Mean of `|tau - prediction|` per joint, raw samples as for `rmse`; N m or N.
    pub mae: Vec<f64>,
    /// Mean of the measured torque, of the same samples.
    pub level: Vec<f64>,
    /// Root mean square of the measured torque about its mean, of the same samples.
    pub spread: Vec<f64>,
    /// How many samples these are; of none all errors are 0.
    pub samples: Vec<usize>,
}

impl Errors {
    /// Errors over several logs of one arm, or pieces of one: those of all their samples together. Of `relative_percent` parts count by
    /// the power of their torque, as of raw samples.
    ///
    /// # Examples
    /// A tenth of a second that is predicted seven times worse than another one:
    /// ```
    /// use robot_model::identify::Errors;
    /// let piece = |rmse: f64| {
    ///     let mut piece = Errors::default();
    ///     (piece.rmse, piece.mae, piece.relative_percent) = (vec![rmse], vec![rmse], vec![10.0]);
    ///     (piece.level, piece.spread, piece.samples) = (vec![0.0], vec![10.0], vec![100]);
    ///     piece
    /// };
    /// let all = Errors::of_all(&[piece(1.0), piece(7.0)]);
    /// // The squares have the mean 25.
    /// assert_eq!((all.rmse[0], all.mae[0], all.samples[0]), (5.0, 4.0, 200));
    /// ```
    #[must_use]
    pub fn of_all(parts: &[Self]) -> Self {
        let joints = 0..parts.first().map_or(0, |part| part.samples.len());
        let samples = |j: usize| parts.iter().map(|part| part.samples[j]).sum::<usize>();
        let mean = |j: usize, value: &dyn Fn(&Self) -> f64| {
            let terms = parts
                .iter()
                .map(|part| part.samples[j] as f64 * value(part));
            terms.sum::<f64>() / samples(j).max(1) as f64
        };
        let each = |of: &dyn Fn(usize) -> f64| joints.clone().map(of).collect();
        Self {
            rmse: each(&|j| mean(j, &|part| part.rmse[j].powi(2)).sqrt()),
            relative_percent: each(&|j| {
                let power = |part: &Self| part.spread[j].powi(2) + part.level[j].powi(2);
                let left = mean(j, &|part| power(part) * part.relative_percent[j].powi(2));
                let all = mean(j, &power);
                if all > 0.0 { (left / all).sqrt() } else { 0.0 }
            }),
            mae: each(&|j| mean(j, &|part| part.mae[j])),
            level: each(&|j| mean(j, &|part| part.level[j])),
            spread: each(&|j| {
                let level = mean(j, &|part| part.level[j]);
                let square = |part: &Self| part.spread[j].powi(2) + (part.level[j] - level).powi(2);
                mean(j, &square).sqrt()
            }),
            samples: joints.clone().map(samples).collect(),
        }
    }

    /// `100 (1 - || tau - prediction || / || tau - mean(tau) ||)` per joint, the NRMSE fit: 100 where nothing is left, 0 where the
    /// prediction is no better than a constant; none where the torque is constant.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let arm = pendulum();
    /// let estimate = Identify::default().fit(&arm, &[measure(0.0)])?;
    /// let mut errors = estimate.errors(&arm, &measure(0.0))?;
    /// assert!(errors.nrmse_fit()[0].is_some_and(|fit| fit > 99.0 && fit < 100.0));
    /// // A prediction that is off by a quarter of what there is to be predicted:
    /// errors.rmse[0] = 0.25 * errors.spread[0];
    /// assert_eq!(errors.nrmse_fit(), [Some(75.0)]);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn nrmse_fit(&self) -> Vec<Option<f64>> {
        let pairs = self.rmse.iter().zip(&self.spread);
        pairs
            .zip(&self.level)
            .map(|((rmse, spread), level)| {
                // What rounding makes of a constant is no spread.
                let is_constant = *spread <= ROUNDING * level.abs();
                (!is_constant).then(|| 100.0 * (1.0 - rmse / spread))
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(rmse: f64, level: f64, samples: usize) -> Errors {
        Errors {
            rmse: vec![rmse],
            relative_percent: vec![rmse],
            mae: vec![rmse],
            level: vec![level],
            spread: vec![1.0],
            samples: vec![samples],
        }
    }

    #[test]
    fn parts_count_by_their_samples() {
        let all = Errors::of_all(&[part(1.0, 3.0, 30), part(2.0, -1.0, 10), part(0.0, 0.0, 0)]);
        assert_eq!(all.samples, [40]);
        assert!((all.rmse[0] - 1.75_f64.sqrt()).abs() < 1e-12);
        assert!((all.mae[0] - 1.25).abs() < 1e-12 && (all.level[0] - 2.0).abs() < 1e-12);
        // Torque powers 10 of 30 samples and 2 of 10.
        let share: f64 = (30.0 * 10.0 * 1.0 + 10.0 * 2.0 * 4.0) / (30.0 * 10.0 + 10.0 * 2.0);
        assert!((all.relative_percent[0] - share.sqrt()).abs() < 1e-12);
        // 1 within the parts, 3 between them.
        assert!((all.spread[0] - 2.0).abs() < 1e-12);
    }

    #[test]
    fn parts_without_samples_have_no_errors() {
        let none = Errors::of_all(&[part(0.0, 0.0, 0)]);
        assert_eq!((none.rmse, none.samples), (vec![0.0], vec![0]));
        assert!(Errors::of_all(&[]).rmse.is_empty());
    }
}
