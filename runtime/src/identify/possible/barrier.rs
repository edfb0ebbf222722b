//! Least squares over matrices that stay positive definite: Newton's method on a barrier that fades.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

/// Weight of a barrier in the end, in units of half a squared residual over its variance: far less than a deviation.
pub(super) const LAST_WEIGHT: f64 = 1e-3;

/// How the barrier fades from round to round.
const FADE: f64 = 0.2;

/// Steps in all, and the squared Newton decrement over the barrier's weight at which a round ends.
const MOST_STEPS: usize = 1000;
const SETTLED: f64 = 1e-7;

/// What the diagonal is raised by where a factor fails, as a share of it, and how often that grows a hundredfold.
const RIDGE: f64 = 1e-14;
const RIDGES: i32 = 5;

/// Rounding of a sum of squares, relative.
const ROUNDING: f64 = 1e-11;

/// A barrier below this share of the residual is as good as none.
const SMALL: f64 = 1e-4;

/// Part of the promised descent that a step must keep.
const KEPT: f64 = 0.1;

/// A matrix that is linear in standard parameters and stays positive definite.
pub(super) struct Cone {
    terms: Vec<(usize, Mat<f64>)>,
    nominal: Mat<f64>,
    /// Of the nominal matrix.
    inverse: Mat<f64>,
    /// Its weight does not fade below this.
    least: f64,
}

impl Cone {
    /// `nominal` is positive definite; `least` is what it weighs in the end, no less than [`LAST_WEIGHT`].
    pub(super) fn new(terms: Vec<(usize, Mat<f64>)>, nominal: Mat<f64>, least: f64) -> Self {
        let size = nominal.nrows();
        let identity = Mat::<f64>::identity(size, size);
        let inverse = match nominal.llt(Side::Lower) {
            Ok(factor) => factor.solve(&identity),
            Err(_) => identity,
        };
        Self {
            terms,
            nominal,
            inverse,
            least,
        }
    }

    /// Its weight while those that fade have this one.
    fn weight(&self, fading: f64) -> f64 {
        fading.max(self.least)
    }

    /// Whether a standard parameter is in the matrix.
    pub(super) fn holds(&self, standard: usize) -> bool {
        self.terms
            .iter()
            .any(|(parameter, _)| *parameter == standard)
    }

    fn size(&self) -> usize {
        self.nominal.nrows()
    }

    /// Sets the parameters so that the matrix is the nominal one.
    pub(super) fn start(&self, standard: &mut [f64]) {
        // Terms are independent: least squares on the entries.
        let size = self.size();
        let entries = Mat::from_fn(size * size, self.terms.len(), |row, k| {
            self.terms[k].1[(row / size, row % size)]
        });
        let right = Mat::from_fn(size * size, 1, |row, _| {
            self.nominal[(row / size, row % size)]
        });
        let gram = entries.transpose() * &entries;
        let solution = gram.partial_piv_lu().solve(entries.transpose() * right);
        for (k, (parameter, _)) in self.terms.iter().enumerate() {
            standard[*parameter] = solution[(k, 0)];
        }
    }

    fn at(&self, standard: &[f64]) -> Mat<f64> {
        let mut sum = Mat::zeros(self.size(), self.size());
        for (parameter, matrix) in &self.terms {
            sum += faer::Scale(standard[*parameter]) * matrix;
        }
        sum
    }

    /// `tr(P0^-1 P)`
    fn pull(&self, standard: &[f64]) -> f64 {
        trace_of_product(&self.inverse, &self.at(standard))
    }

    /// `tr(P0^-1 P) - ln det P`; `None` where `P` is not positive definite.
    fn value(&self, standard: &[f64]) -> Option<f64> {
        let matrix = self.at(standard);
        let factor = matrix.llt(Side::Lower).ok()?;
        let lower = factor.L();
        let log_det: f64 = (0..self.size()).map(|k| 2.0 * lower[(k, k)].ln()).sum();
        let value = trace_of_product(&self.inverse, &matrix) - log_det;
        value.is_finite().then_some(value)
    }

    /// Adds slope and curvature of `weight * value` by the standard parameters.
    fn add(
        &self,
        standard: &[f64],
        weight: f64,
        slope: &mut [f64],
        curvature: &mut Mat<f64>,
    ) -> Option<()> {
        let factor = self.at(standard).llt(Side::Lower).ok()?;
        let inverse = factor.solve(Mat::<f64>::identity(self.size(), self.size()));
        let images: Vec<Mat<f64>> = self.terms.iter().map(|term| &inverse * &term.1).collect();
        for ((k, matrix), image) in self.terms.iter().zip(&images) {
            slope[*k] += weight * (trace_of_product(&self.inverse, matrix) - trace(image));
            for ((l, _), other) in self.terms.iter().zip(&images) {
                curvature[(*k, *l)] += weight * trace_of_product(image, other);
            }
        }
        Some(())
    }
}

fn trace(matrix: &Mat<f64>) -> f64 {
    (0..matrix.nrows()).map(|k| matrix[(k, k)]).sum()
}

/// `tr(A B)`
fn trace_of_product(a: &Mat<f64>, b: &Mat<f64>) -> f64 {
    let size = a.nrows();
    let entries = (0..size).flat_map(|i| (0..size).map(move |k| (i, k)));
    entries.map(|(i, k)| a[(i, k)] * b[(k, i)]).sum()
}

/// `|| R x - r ||^2 / 2` for the first variables `x`, and a barrier of standard parameters that are linear in all variables, or fixed.
pub(super) struct Barrier<'a> {
    /// `[R | r]`, in units of the residuals' deviation.
    pub factor: &'a Mat<f64>,
    /// How many variables are in the residual.
    pub unknowns: usize,
    /// Standard parameters by variables.
    pub by_variable: &'a Mat<f64>,
    /// Those that are fixed; zero of the others.
    pub fixed: &'a [f64],
    pub cones: &'a [Cone],
    /// Variables that neither the residual nor a matrix holds: a square does.
    pub loose: Vec<usize>,
}

/// Where the search ended.
pub(super) struct Found {
    pub variables: Vec<f64>,
    pub steps: usize,
    /// Half the sum of squares.
    pub cost: f64,
    /// By about how much the sum of squares may exceed the least one, as a share of it, where all barriers have faded.
    pub gap: f64,
}

/// How a step went.
#[derive(PartialEq)]
enum Step {
    Taken,
    /// Nothing is left to be gained.
    Settled,
    /// No step goes down: rounding is larger than what is left.
    Stuck,
}

impl Barrier<'_> {
    pub(super) fn standard(&self, variables: &[f64]) -> Vec<f64> {
        let product = self.by_variable * column(variables);
        let free = product.col(0).iter().zip(self.fixed);
        free.map(|(free, fixed)| free + fixed).collect()
    }

    /// Residuals of the rows.
    fn residual(&self, variables: &[f64]) -> Mat<f64> {
        let n = self.unknowns;
        let rows = self.factor.nrows();
        Mat::from_fn(rows, 1, |row, _| {
            let fitted: f64 = (0..n).map(|k| self.factor[(row, k)] * variables[k]).sum();
            fitted - self.factor[(row, n)]
        })
    }

    fn cost(&self, variables: &[f64]) -> f64 {
        0.5 * self.residual(variables).squared_norm_l2()
    }

    fn value(&self, variables: &[f64], weight: f64) -> Option<f64> {
        let standard = self.standard(variables);
        let loose: f64 = self.loose.iter().map(|&k| variables[k].powi(2)).sum();
        let mut sum = self.cost(variables) + 0.5 * weight * loose;
        for cone in self.cones {
            sum += cone.weight(weight) * cone.value(&standard)?;
        }
        Some(sum)
    }

    /// From variables with which every matrix is positive definite; `None` where the search does not come to an end.
    pub(super) fn minimize(&self, mut variables: Vec<f64>) -> Option<Found> {
        let degree: usize = self.cones.iter().map(Cone::size).sum();
        let degree = degree.max(1) as f64;
        let mut weight = (self.cost(&variables) / degree).max(1.0);
        let mut steps = 0;
        loop {
            let mut last = Step::Taken;
            while last == Step::Taken {
                steps += 1;
                if steps > MOST_STEPS {
                    return None;
                }
                last = self.step(&mut variables, weight);
            }
            let cost = self.cost(&variables);
            // Where a barrier that is small beside the residual cannot be told from rounding, there is no better end.
            let is_small = weight * degree < SMALL * cost;
            if last == Step::Stuck && !is_small {
                return None;
            }
            if weight <= LAST_WEIGHT || last == Step::Stuck {
                // The barrier's rate of exchange times its degree bounds what `-ln det` costs, as the problem is convex. The pull costs what
                // it is less by than at the least sum of squares, which is of the size that it has where little of it is left.
                let standard = self.standard(&variables);
                let cones = self.cones.iter();
                let excess: f64 = cones
                    .map(|cone| cone.weight(weight) * (cone.size() as f64 + cone.pull(&standard)))
                    .sum();
                return Some(Found {
                    variables,
                    steps,
                    cost,
                    gap: excess / cost.max(f64::MIN_POSITIVE),
                });
            }
            weight = (FADE * weight).max(LAST_WEIGHT);
        }
    }

    /// One damped Newton step.
    fn step(&self, variables: &mut Vec<f64>, weight: f64) -> Step {
        let Some((slope, curvature)) = self.derivatives(variables, weight) else {
            return Step::Stuck;
        };
        let Some(step) = newton(&slope, &curvature) else {
            return Step::Stuck;
        };
        let promised: f64 = step.iter().zip(&slope).map(|(s, g)| s * g).sum();
        if -promised <= SETTLED * weight {
            return Step::Settled;
        }
        let Some(now) = self.value(variables, weight) else {
            return Step::Stuck;
        };
        let mut length = 1.0;
        while length > 1e-10 {
            let pairs = variables.iter().zip(&step);
            let trial: Vec<f64> = pairs.map(|(x, s)| x + length * s).collect();
            let value = self.value(&trial, weight);
            if value.is_some_and(|value| value <= now + KEPT * length * promised) {
                *variables = trial;
                return Step::Taken;
            }
            length *= 0.5;
        }
        // What is promised is below the rounding of the value.
        if -promised <= ROUNDING * now.abs() {
            Step::Settled
        } else {
            Step::Stuck
        }
    }

    fn derivatives(&self, variables: &[f64], weight: f64) -> Option<(Vec<f64>, Mat<f64>)> {
        let n = self.unknowns;
        let standard = self.standard(variables);
        let mut slope = vec![0.0; standard.len()];
        let mut curvature = Mat::zeros(standard.len(), standard.len());
        for cone in self.cones {
            cone.add(&standard, cone.weight(weight), &mut slope, &mut curvature)?;
        }
        let back = self.by_variable.transpose();
        let slope = back * column(&slope);
        let mut slope: Vec<f64> = slope.col(0).iter().copied().collect();
        let mut curvature = back * curvature * self.by_variable;
        let rows = self.factor.nrows();
        let regressor = self.factor.submatrix(0, 0, rows, n);
        let gram = regressor.transpose() * regressor;
        let pulled = regressor.transpose() * self.residual(variables);
        for i in 0..n {
            slope[i] += pulled[(i, 0)];
            for k in 0..n {
                curvature[(i, k)] += gram[(i, k)];
            }
        }
        for &k in &self.loose {
            slope[k] += weight * variables[k];
            curvature[(k, k)] += weight;
        }
        Some((slope, curvature))
    }
}

/// Newton's step; none where the curvature is not positive definite, rounding aside.
fn newton(slope: &[f64], curvature: &Mat<f64>) -> Option<Vec<f64>> {
    let count = slope.len();
    // Units are far apart: scaled, so that the factor's pivots are not.
    let scale: Vec<f64> = (0..count)
        .map(|k| curvature[(k, k)].max(f64::MIN_POSITIVE).sqrt().recip())
        .collect();
    let right = Mat::from_fn(count, 1, |k, _| -scale[k] * slope[k]);
    (0..=RIDGES).find_map(|attempt| {
        let ridge = if attempt == 0 {
            0.0
        } else {
            RIDGE * 100f64.powi(attempt - 1)
        };
        let scaled = Mat::from_fn(count, count, |i, k| {
            let raised = if i == k { ridge } else { 0.0 };
            scale[i] * curvature[(i, k)] * scale[k] + raised
        });
        let factor = scaled.llt(Side::Lower).ok()?;
        let solution = factor.solve(&right);
        let step: Vec<f64> = (0..count).map(|k| scale[k] * solution[(k, 0)]).collect();
        let goes_down = step.iter().zip(slope).map(|(s, g)| s * g).sum::<f64>() <= 0.0;
        goes_down.then_some(step)
    })
}

fn column(values: &[f64]) -> Mat<f64> {
    Mat::from_fn(values.len(), 1, |k, _| values[k])
}
