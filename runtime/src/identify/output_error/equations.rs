//! Equations of windows, reduced by orthogonal factors, with and without the starts that follow the parameters.

use nalgebra::{DMatrix, DVector};

use super::window::Rows;

/// How the start of a window follows the parameters: `R11 s + R12 d + z1 = 0`.
#[derive(Debug, Clone)]
pub(super) struct Start {
    /// Columns of the start that move anything.
    moving: Vec<usize>,
    count: usize,
    r11: DMatrix<f64>,
    r12: DMatrix<f64>,
    z1: DVector<f64>,
}

impl Start {
    /// How many of its entries move anything.
    pub fn moving(&self) -> usize {
        self.moving.len()
    }

    fn solve(&self, right: DMatrix<f64>) -> DMatrix<f64> {
        let svd = self.r11.clone().svd(true, true);
        let least = 1e-12 * svd.singular_values.max();
        svd.solve(&right, least).unwrap_or(right * 0.0)
    }

    /// Slope of the start by the parameters; none where nothing of it moves.
    pub fn follow(&self) -> Option<DMatrix<f64>> {
        (!self.moving.is_empty()).then(|| self.spread(&self.solve(-&self.r12)))
    }

    /// Directions that it takes of errors, from their slopes by it: orthogonal and of length 1; none where nothing of it moves.
    pub fn directions(&self, by_start: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let columns = by_start.select_columns(&self.moving);
        (!self.moving.is_empty()).then(|| columns.qr().q())
    }

    /// Rows of what moves, in the places of the whole start.
    fn spread(&self, moving: &DMatrix<f64>) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(self.count, moving.ncols());
        for (row, &k) in self.moving.iter().enumerate() {
            all.set_row(k, &moving.row(row));
        }
        all
    }

    /// Its step for one of the parameters, as far as it moves anything.
    pub fn step(&self, step: &DVector<f64>) -> DVector<f64> {
        if self.moving.is_empty() {
            return DVector::zeros(0);
        }
        let right = -(&self.z1 + &self.r12 * step);
        let right = DMatrix::from_column_slice(right.len(), 1, right.as_slice());
        self.solve(right).column(0).into_owned()
    }
}

/// Equations of a window, reduced to a triangle: columns of what moves of its start, of the parameters, and of the errors.
#[derive(Debug, Clone)]
pub(super) struct Triangle {
    pub moving: Vec<usize>,
    count: usize,
    rows: DMatrix<f64>,
}

/// Equations of all windows.
#[derive(Debug, Clone)]
pub(super) struct Equations {
    unknowns: usize,
    pub windows: Vec<Triangle>,
}

/// The same without their starts, `|z + R d|^2`.
#[derive(Debug, Clone)]
pub(super) struct Reduced {
    pub r: DMatrix<f64>,
    pub z: DVector<f64>,
    pub starts: Vec<Start>,
    /// `R_w' z_w` of each window.
    scores: Vec<DVector<f64>>,
}

/// Fewer windows do not say how errors are alike.
const ENOUGH: usize = 8;

impl Reduced {
    /// How many samples are worth one where white ones have this root of mean square: what scores of windows are beside those of white errors,
    /// `sum_w |R^-T s_w|^2 / (p sigma^2)`, one at least. Errors of simulations are slow.
    pub fn worth(&self, sigma: f64) -> f64 {
        let unknowns = self.r.ncols();
        if self.scores.len() < ENOUGH || unknowns == 0 {
            return 1.0;
        }
        let upper = self.r.transpose();
        let mut sum = 0.0;
        for score in &self.scores {
            match upper.solve_lower_triangular(score) {
                Some(white) => sum += white.norm_squared(),
                None => return 1.0,
            }
        }
        let worth = sum / (unknowns as f64 * sigma.powi(2));
        if worth.is_finite() {
            worth.max(1.0)
        } else {
            1.0
        }
    }
}

/// The upper triangle of a QR factorization, with rows of zeros where there were too few.
pub(super) fn triangle(rows: DMatrix<f64>) -> DMatrix<f64> {
    let columns = rows.ncols();
    if rows.nrows() == 0 {
        return DMatrix::zeros(columns, columns);
    }
    rows.qr().r().resize_vertically(columns, 0.0)
}

impl Equations {
    pub fn new(rows: &[Rows]) -> Self {
        let unknowns = rows.first().map_or(0, |rows| rows.by_parameters.ncols());
        let windows = rows.iter().map(|rows| {
            let count = rows.by_start.ncols();
            let sizes: Vec<f64> = rows.by_start.column_iter().map(|x| x.norm()).collect();
            let largest = sizes.iter().copied().fold(0.0, f64::max);
            let moving: Vec<usize> = (0..count).filter(|&k| sizes[k] > 1e-12 * largest).collect();
            let s = moving.len();
            let mut all = DMatrix::zeros(rows.errors.len(), s + unknowns + 1);
            for (place, &k) in moving.iter().enumerate() {
                all.set_column(place, &rows.by_start.column(k));
            }
            all.columns_mut(s, unknowns).copy_from(&rows.by_parameters);
            all.set_column(s + unknowns, &rows.errors);
            Triangle {
                moving,
                count,
                rows: triangle(all),
            }
        });
        Self {
            windows: windows.collect(),
            unknowns,
        }
    }

    /// Without the starts, whose steps are damped by `lambda` in units of their columns.
    pub fn reduced(&self, lambda: f64) -> Reduced {
        let unknowns = self.unknowns;
        let mut stacked = DMatrix::zeros(0, unknowns + 1);
        let mut starts = Vec::new();
        let mut scores = Vec::new();
        for window in &self.windows {
            let s = window.moving.len();
            let size = window.rows.nrows();
            let mut all = window.rows.clone().resize_vertically(size + s, 0.0);
            for k in 0..s {
                all[(size + k, k)] = lambda.sqrt() * window.rows.column(k).norm();
            }
            let all = triangle(all);
            starts.push(Start {
                count: window.count,
                r11: all.view((0, 0), (s, s)).into_owned(),
                r12: all.view((0, s), (s, unknowns)).into_owned(),
                z1: all.view((0, s + unknowns), (s, 1)).column(0).into_owned(),
                moving: window.moving.clone(),
            });
            let own = all.view((s, s), (unknowns + 1, unknowns + 1));
            let (r, z) = (own.columns(0, unknowns), own.column(unknowns));
            scores.push(r.rows(0, unknowns).tr_mul(&z.rows(0, unknowns)));
            let before = stacked.nrows();
            stacked = stacked.resize_vertically(before + unknowns + 1, 0.0);
            stacked.rows_mut(before, unknowns + 1).copy_from(&own);
            stacked = triangle(stacked);
        }
        let stacked = stacked.resize_vertically(unknowns + 1, 0.0);
        Reduced {
            r: stacked.view((0, 0), (unknowns, unknowns)).into_owned(),
            z: stacked
                .view((0, unknowns), (unknowns, 1))
                .column(0)
                .into_owned(),
            starts,
            scores,
        }
    }

    /// By how much steps of parameters and starts are foretold to lower the cost, and how long they are in units of columns.
    pub fn foretold(&self, step: &DVector<f64>, starts: &[DVector<f64>]) -> (f64, f64) {
        let (mut gain, mut length) = (0.0, 0.0);
        for (window, start) in self.windows.iter().zip(starts) {
            let all = DVector::from_iterator(
                start.len() + step.len() + 1,
                start.iter().chain(step.iter()).copied().chain([1.0]),
            );
            let before = window.rows.column(all.len() - 1).norm_squared();
            gain += 0.5 * (before - (&window.rows * all).norm_squared());
            for (k, start) in start.iter().enumerate() {
                length += (window.rows.column(k).norm() * start).powi(2);
            }
        }
        (gain, length)
    }
}
