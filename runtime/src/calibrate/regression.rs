//! Least squares with a few columns, and how sure it is.

use faer::Mat;
use faer::linalg::solvers::Solve;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::{CONFIDENCE, Measured};
use crate::identify::{RANK_TOLERANCE, long_run_sum};

/// What is below this share of the target is rounding.
const ROUNDING: f64 = 1e-12;

/// `target = sum_c values_c columns_c + residuals`.
pub(super) struct Regression {
    pub values: Vec<f64>,
    pub residuals: Vec<f64>,
    /// `[unknown][sample]`: by how much an unknown follows a sample of the target.
    gains: Vec<Vec<f64>>,
    /// Samples that are more than the unknowns.
    pub freedom: f64,
    /// Errors that rounding may have.
    rounding: f64,
}

impl Regression {
    /// `None` where the columns are not independent, or as many as the samples.
    pub fn new(columns: &[&[f64]], target: &[f64]) -> Option<Self> {
        let (samples, count) = (target.len(), columns.len());
        if samples <= count {
            return None;
        }
        let squares = |column: &[f64]| column.iter().map(|x| x * x).sum::<f64>();
        let length: Vec<f64> = columns.iter().map(|c| squares(c).sqrt()).collect();
        if length.contains(&0.0) {
            return None;
        }
        let scaled = Mat::from_fn(samples, count, |k, c| columns[c][k] / length[c]);
        let factors = scaled.qr();
        let r = factors.thin_R().to_owned();
        if (0..count).any(|c| r[(c, c)].abs() < RANK_TOLERANCE) {
            return None;
        }
        let q = factors.compute_thin_Q();
        let gains = r.partial_piv_lu().solve(q.transpose().to_owned());
        let gains: Vec<Vec<f64>> = (0..count)
            .map(|c| (0..samples).map(|k| gains[(c, k)] / length[c]).collect())
            .collect();
        let values: Vec<f64> = gains.iter().map(|gain| dot(gain, target)).collect();
        let left = |k: usize| {
            let terms = columns.iter().zip(&values);
            target[k] - terms.map(|(column, value)| column[k] * value).sum::<f64>()
        };
        let residuals: Vec<f64> = (0..samples).map(left).collect();
        Some(Self {
            rounding: ROUNDING * (squares(target) / samples as f64).sqrt(),
            values,
            residuals,
            gains,
            freedom: (samples - count) as f64,
        })
    }

    /// Standard deviation of the errors.
    pub fn residual_std(&self) -> f64 {
        (dot(&self.residuals, &self.residuals) / self.freedom).sqrt()
    }

    /// An unknown where errors do not know of each other.
    pub fn of_white_errors(&self, unknown: usize) -> Measured {
        let gain = &self.gains[unknown];
        let std = self.residual_std() * dot(gain, gain).sqrt();
        Measured::new(self.values[unknown], std, self.freedom)
    }

    /// An unknown where errors are alike from sample to sample.
    pub fn of_correlated_errors(&self, unknown: usize) -> Measured {
        let pairs = self.gains[unknown].iter().zip(&self.residuals);
        let series: Vec<f64> = pairs.map(|(gain, residual)| gain * residual).collect();
        // The unknowns have taken their share of the residuals.
        let correction = series.len() as f64 / self.freedom;
        let std = (correction * long_run_sum(&series)).max(0.0).sqrt();
        Measured::new(self.values[unknown], std, self.freedom)
    }

    /// How probable a value as far from zero is by chance, where it is zero.
    pub fn p_value(&self, unknown: usize) -> f64 {
        let gain = &self.gains[unknown];
        let std = self.residual_std().max(self.rounding) * dot(gain, gain).sqrt();
        if std == 0.0 {
            return 1.0;
        }
        let t = self.values[unknown].abs() / std;
        student(self.freedom).map_or(1.0, |student| 2.0 * student.sf(t))
    }
}

/// How many standard deviations a value is in its interval.
pub(crate) fn quantile(freedom: f64) -> f64 {
    student(freedom).map_or(f64::INFINITY, |student| {
        student.inverse_cdf(0.5 + 0.5 * CONFIDENCE)
    })
}

fn student(freedom: f64) -> Option<StudentsT> {
    StudentsT::new(0.0, 1.0, freedom).ok()
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles of tables.
    #[test]
    fn intervals_are_students() {
        for (freedom, table) in [
            (1.0, 12.7062),
            (3.0, 3.1824),
            (10.0, 2.2281),
            (100.0, 1.98397),
            (60_000.0, 1.96),
        ] {
            let found = quantile(freedom);
            assert!((found - table).abs() < 1e-4, "{freedom}: {found}");
        }
    }

    /// Numbers that are small enough for a pencil: `y = 3/2 x + 1/6` with residuals `-1/6, 1/3, -1/6`.
    #[test]
    fn a_line_through_three_points() {
        let ones = [1.0; 3];
        let fit = Regression::new(&[&[0.0, 1.0, 2.0], &ones], &[0.0, 2.0, 3.0]).expect("a line");
        assert!((fit.values[0] - 1.5).abs() < 1e-12);
        assert!((fit.values[1] - 1.0 / 6.0).abs() < 1e-12);
        assert!((fit.residual_std() - 6.0_f64.sqrt() / 6.0).abs() < 1e-12);
        let slope = fit.of_white_errors(0);
        assert!(
            (slope.std - 12.0_f64.sqrt() / 12.0).abs() < 1e-12,
            "{slope:?}"
        );
        // t = 3 sqrt(3) with one degree: 2 (1/2 - atan(t) / pi).
        let p = 1.0 - 2.0 * (3.0 * 3.0_f64.sqrt()).atan() / std::f64::consts::PI;
        assert!((fit.p_value(0) - p).abs() < 1e-9);
    }

    #[test]
    fn columns_that_depend_have_no_solution() {
        let ones = [1.0; 4];
        let twos = [2.0; 4];
        assert!(Regression::new(&[&ones, &twos], &ones).is_none());
        assert!(Regression::new(&[&[0.0; 4]], &ones).is_none());
        assert!(Regression::new(&[&[1.0, 2.0], &[1.0, 1.0]], &[1.0, 2.0]).is_none());
    }
}
