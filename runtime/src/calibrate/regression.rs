//! Least squares with a few columns, and how sure it is.

use faer::Mat;
use faer::linalg::solvers::Solve;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::{CONFIDENCE, Measured};
use crate::identify::{RANK_TOLERANCE, long_run_sum};

/// Standard deviations of a normal distribution that hold 95 % of it, and the freedom from which on Student's has the same: a search for
/// its quantile does not end there.
pub(crate) const NORMAL: f64 = 1.959_963_984_540_054;
const MUCH: f64 = 1e6;

/// What is below this share of the target is rounding.
const ROUNDING: f64 = 1e-12;

/// Deviations of a difference from which on it is one.
const FAR: f64 = 3.0;

/// `target = sum_c values_c columns_c + residuals`.
#[derive(Clone)]
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
        let norm = norms(columns);
        if norm.contains(&0.0) {
            return None;
        }
        let scaled = Mat::from_fn(samples, count, |k, c| columns[c][k] / norm[c]);
        let factors = scaled.qr();
        let r = factors.thin_R().to_owned();
        if (0..count).any(|c| r[(c, c)].abs() < RANK_TOLERANCE) {
            return None;
        }
        let q = factors.compute_thin_Q();
        let gains = r.partial_piv_lu().solve(q.transpose().to_owned());
        Some(Self::of_gains(&gains, &norm, columns, target))
    }

    /// `sum_k instruments_ak (target_k - sum_c values_c columns_ck) = 0` for each instrument `a`, one a column: errors of the columns that
    /// the instruments do not know of leave the values as they are (Söderström & Stoica 1983). `None` as above.
    pub fn by_instruments(
        columns: &[&[f64]],
        instruments: &[&[f64]],
        target: &[f64],
    ) -> Option<Self> {
        let (samples, count) = (target.len(), columns.len());
        if samples <= count {
            return None;
        }
        // What the instruments tell of the columns stands for these in the gains; residuals are those of the columns.
        let (norm, of_instruments) = (norms(columns), norms(instruments));
        if norm.contains(&0.0) || of_instruments.contains(&0.0) {
            return None;
        }
        let products = Mat::from_fn(count, count, |a, c| {
            dot(instruments[a], columns[c]) / (of_instruments[a] * norm[c])
        });
        let singular = products.singular_values().ok()?;
        if singular.last().is_none_or(|last| *last < RANK_TOLERANCE) {
            return None;
        }
        let scaled = Mat::from_fn(count, samples, |a, k| instruments[a][k] / of_instruments[a]);
        let gains = products.partial_piv_lu().solve(scaled);
        Some(Self::of_gains(&gains, &norm, columns, target))
    }

    /// From gains of columns of length 1.
    fn of_gains(gains: &Mat<f64>, norm: &[f64], columns: &[&[f64]], target: &[f64]) -> Self {
        let (samples, count) = (target.len(), columns.len());
        let gain = |c: usize| (0..samples).map(|k| gains[(c, k)] / norm[c]).collect();
        let gains: Vec<Vec<f64>> = (0..count).map(gain).collect();
        let values: Vec<f64> = gains.iter().map(|gain| dot(gain, target)).collect();
        let left = |k: usize| {
            let terms = columns.iter().zip(&values);
            target[k] - terms.map(|(column, value)| column[k] * value).sum::<f64>()
        };
        Self {
            residuals: (0..samples).map(left).collect(),
            rounding: ROUNDING * (dot(target, target) / samples as f64).sqrt(),
            values,
            gains,
            freedom: (samples - count) as f64,
        }
    }

    /// Whether an unknown is another than that of `self` by more than errors of the target, alike from sample to sample, would make it
    /// in 99.7 % of logs (Hausman 1978).
    pub fn is_another(&self, unknown: usize, other: &Self) -> bool {
        let pairs = self.gains[unknown].iter().zip(&other.gains[unknown]);
        let pairs = pairs.zip(&self.residuals);
        let mut series: Vec<f64> = pairs.map(|((one, other), e)| (one - other) * e).collect();
        // Residuals of `self` that the other's gains know make a mean, which is the difference itself.
        let mean = series.iter().sum::<f64>() / series.len() as f64;
        for x in &mut series {
            *x -= mean;
        }
        let std = self.of_sum(&series);
        let length: f64 = dot(&self.gains[unknown], &self.gains[unknown]).sqrt();
        let difference = (self.values[unknown] - other.values[unknown]).abs();
        difference > FAR * std.max(self.rounding * length)
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
        Measured::new(self.values[unknown], self.of_sum(&series), self.freedom)
    }

    /// Deviation of the sum of a series of moved residuals, of which the unknowns have taken their share.
    fn of_sum(&self, series: &[f64]) -> f64 {
        let correction = series.len() as f64 / self.freedom;
        (correction * long_run_sum(series)).max(0.0).sqrt()
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
    if freedom > MUCH {
        return NORMAL;
    }
    student(freedom).map_or(f64::INFINITY, |student| {
        student.inverse_cdf(0.5 + 0.5 * CONFIDENCE)
    })
}

fn student(freedom: f64) -> Option<StudentsT> {
    StudentsT::new(0.0, 1.0, freedom).ok()
}

fn norms(columns: &[&[f64]]) -> Vec<f64> {
    columns.iter().map(|c| dot(c, c).sqrt()).collect()
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
            (999_999.0, 1.959_97),
            (4e9, 1.959_96),
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

    /// `sum z y / sum z x = 8 / 6` in place of `sum x y / sum x x = 13 / 9`.
    #[test]
    fn instruments_stand_for_columns_in_the_equations() {
        let (x, z, y) = ([1.0, 2.0, 2.0], [2.0, 1.0, 1.0], [1.0, 3.0, 3.0]);
        let least_squares = Regression::new(&[&x], &y).expect("a slope");
        assert!((least_squares.values[0] - 13.0 / 9.0).abs() < 1e-12);
        let found = Regression::by_instruments(&[&x], &[&z], &y).expect("a slope");
        assert!((found.values[0] - 8.0 / 6.0).abs() < 1e-12);
        let left = [-1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0];
        for (residual, left) in found.residuals.iter().zip(left) {
            assert!((residual - left).abs() < 1e-12);
        }
        // What is at right angles to the column tells nothing of it.
        assert!(Regression::by_instruments(&[&x], &[&[0.0, 1.0, -1.0]], &y).is_none());
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
