//! Columns of a factor that are told apart from the others.

use faer::Mat;

/// A column is called not excited when its pivot, after every column was scaled to unit norm, is below this: its estimate
/// would amplify errors a hundred thousand times, which the digits of no log bear.
pub const RANK_TOLERANCE: f64 = 1e-5;

/// The columns of a factor that can be told from each other.
pub(in crate::identify) struct Excited {
    /// Which, ascending.
    pub columns: Vec<usize>,
    /// Lengths of all columns.
    pub norms: Vec<f64>,
    /// Those columns over their lengths.
    pub kept: Mat<f64>,
    /// Directions of rows that count, orthogonal and of length 1, where others are noise.
    pub clean: Option<Mat<f64>>,
}

impl Excited {
    /// Among the first `n` columns of a factor.
    pub fn new(r: &Mat<f64>, n: usize) -> Self {
        Self::chosen(r, n, &|pivots| {
            pivots.take_while(|pivot| *pivot > RANK_TOLERANCE).count()
        })
    }

    /// So many of them, those that are told apart best.
    pub fn of_rank(r: &Mat<f64>, n: usize, rank: usize) -> Self {
        Self::chosen(r, n, &|pivots| pivots.take(rank).count())
    }

    /// Those that are given, ascending.
    pub fn of(r: &Mat<f64>, n: usize, columns: Vec<usize>) -> Self {
        let norms: Vec<f64> = (0..n).map(|c| column_norm(r, c)).collect();
        let kept = Mat::from_fn(r.nrows(), columns.len(), |row, k| {
            let c = columns[k];
            r[(row, c)] / norms[c].max(f64::MIN_POSITIVE)
        });
        Self {
            columns,
            norms,
            kept,
            clean: None,
        }
    }

    /// Those of these that are told apart best where fewer directions of their rows count, as many as these are.
    pub fn along(self, clean: Mat<f64>) -> Self {
        let pivoted = (clean.transpose() * &self.kept).col_piv_qr();
        let mut places = pivoted.P().arrays().0[..clean.ncols()].to_vec();
        places.sort_unstable();
        let columns = places.iter().map(|&place| self.columns[place]).collect();
        let kept = Mat::from_fn(self.kept.nrows(), places.len(), |row, k| {
            self.kept[(row, places[k])]
        });
        Self {
            columns,
            norms: self.norms,
            kept,
            clean: Some(clean),
        }
    }

    /// `rank` says how many, of pivots that fall.
    fn chosen(
        r: &Mat<f64>,
        n: usize,
        rank: &dyn Fn(&mut dyn Iterator<Item = f64>) -> usize,
    ) -> Self {
        let norms: Vec<f64> = (0..n).map(|c| column_norm(r, c)).collect();
        let scaled = Mat::from_fn(r.nrows(), n, |row, c| {
            if norms[c] > 0.0 {
                r[(row, c)] / norms[c]
            } else {
                0.0
            }
        });
        let pivoted = scaled.col_piv_qr();
        let diagonal = pivoted.thin_R();
        let order = pivoted.P().arrays().0;
        let mut pivots = (0..n.min(diagonal.nrows())).map(|k| diagonal[(k, k)].abs());
        let rank = rank(&mut pivots);
        let mut columns: Vec<usize> = order[..rank].to_vec();
        columns.sort_unstable();
        let kept = Mat::from_fn(r.nrows(), rank, |row, k| scaled[(row, columns[k])]);
        Self {
            columns,
            norms,
            kept,
            clean: None,
        }
    }
}

fn column_norm(matrix: &Mat<f64>, column: usize) -> f64 {
    (0..matrix.nrows())
        .map(|row| matrix[(row, column)].powi(2))
        .sum::<f64>()
        .sqrt()
}
