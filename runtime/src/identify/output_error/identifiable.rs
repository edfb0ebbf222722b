//! What logs say of parameters, and what they do not.
//!
//! In: a triangular factor `R` of the sensitivities. Out: singular values of `R D^-1`, `D` the lengths of its columns, and the directions of
//! the parameters along which (almost) no output changes.

use nalgebra::{DMatrix, DVector};

use super::equations::triangle;

/// Of the largest singular value: below, outputs do not change at all; below, they change so little that noise decides.
const SILENT: f64 = 1e-5;
const WEAK: f64 = 1e-3;

/// The same of shares of values: below, what a model lacks moves parameters by more than it moves others, however small deviations are.
const FRAIL: f64 = 1.0 / 15.0;

/// Deviations above this share of a value say by themselves that it is hardly known.
pub(super) const KNOWN: f64 = 0.1;

/// Parts of a direction that are smaller are noise of the decomposition.
const LOUD: f64 = 1e-3;

/// All of a parameter, over all of the one that does most, that is nothing but rounding.
const ROUNDING: f64 = 1e-9;

/// Lengths of columns, 0 where all of a parameter does nothing.
pub(super) fn audible(lengths: &[f64], values: &[f64]) -> Vec<f64> {
    let effect = |k: usize| lengths[k] * values[k].abs().max(1e-6);
    let largest = (0..lengths.len()).map(effect).fold(0.0, f64::max);
    let length = |k: usize| {
        if effect(k) > ROUNDING * largest {
            lengths[k]
        } else {
            0.0
        }
    };
    (0..lengths.len()).map(length).collect()
}

/// What logs say of which parameters.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Identifiability {
    /// Singular values of the sensitivities with columns of length 1, over the largest, falling.
    pub singular: Vec<f64>,
    /// How many directions change any output.
    pub rank: usize,
    /// Directions that change it little or not at all, the weakest last.
    pub directions: Vec<Direction>,
    identified: Vec<bool>,
    /// Lengths of the columns, without those of parameters that change nothing.
    lengths: DVector<f64>,
    /// The factor of the sensitivities.
    r: DMatrix<f64>,
}

/// Parameters that may move together while outputs (almost) do not.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Direction {
    /// Singular value over the largest.
    pub singular: f64,
    /// Parameters by name, with the share of their value by which they move, the largest 1.
    pub moves: Vec<(String, f64)>,
}

impl Direction {
    /// Parameters by name with their shares, and the singular value over the largest.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::output_error::Direction;
    /// let direction = Direction::new(1e-9, vec![("m".to_owned(), 1.0)]);
    /// assert_eq!(direction.to_string(), "not identified: m (relative singular value 1.0e-9)");
    /// ```
    #[must_use]
    pub fn new(singular: f64, moves: Vec<(String, f64)>) -> Self {
        Self { singular, moves }
    }

    /// Whether outputs do not change at all.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::output_error::Direction;
    /// let direction = |singular| Direction::new(singular, vec![("m".to_owned(), 1.0)]);
    /// // Hardly seen is not unseen.
    /// assert!(direction(1e-9).is_silent() && !direction(1e-4).is_silent());
    /// ```
    #[must_use]
    pub fn is_silent(&self) -> bool {
        self.singular < SILENT
    }

    /// Whether it scales all of its parameters by the same factor: then their ratios are known.
    ///
    /// # Examples
    /// Masses and friction that only torques would tell from twice as much of all:
    /// ```
    /// use robot_model::identify::output_error::Direction;
    /// let direction = Direction::new(1e-9, vec![("m".to_owned(), 1.0), ("fv".to_owned(), 1.0)]);
    /// assert!(direction.is_silent() && direction.is_scale());
    /// ```
    #[must_use]
    pub fn is_scale(&self) -> bool {
        self.scales_within(0.05)
    }

    /// The same with shares that differ by so much at most. One that is not silent has a little of others in it.
    pub(super) fn scales_within(&self, difference: f64) -> bool {
        let mut shares = self.moves.iter().map(|(_, share)| share);
        self.moves.len() > 1 && shares.all(|share| (share - 1.0).abs() < difference)
    }
}

impl std::fmt::Display for Direction {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let how = if self.is_silent() {
            "not identified"
        } else {
            "hardly identified"
        };
        let names: Vec<&str> = self.moves.iter().map(|(name, _)| name.as_str()).collect();
        if let [name] = names.as_slice() {
            return write!(
                f,
                "{how}: {name} (relative singular value {:.1e})",
                self.singular
            );
        }
        if self.is_scale() {
            return write!(
                f,
                "{how}: a common factor of {}; their ratios are (relative singular value {:.1e})",
                names.join(", "),
                self.singular
            );
        }
        let shares = self.moves.iter();
        let shares: Vec<String> = shares
            .map(|(name, share)| format!("{name} {share:+.2}"))
            .collect();
        write!(
            f,
            "{how}: changing together, relative to their values, {} (relative singular value {:.1e})",
            shares.join(", "),
            self.singular
        )
    }
}

/// The direction, in shares of the values of parameters that seem to be known, along which outputs change least: where an equal share of
/// the best known direction changes them fifteen times as much. An arm that moves slowly beside its friction has its inertia there.
pub(super) fn frail(
    r: &DMatrix<f64>,
    values: &[f64],
    std: &[Option<f64>],
    names: &[String],
) -> Option<Direction> {
    let pairs = values.iter().zip(std).enumerate();
    let known = pairs.filter(|(_, (value, std))| std.is_some_and(|std| std < KNOWN * value.abs()));
    let known: Vec<usize> = known.map(|(k, _)| k).collect();
    let mut all = r.clone();
    for (mut column, value) in all.column_iter_mut().zip(values) {
        column *= *value;
    }
    if known.is_empty() || names.len() < 2 || !all.iter().all(|x| x.is_finite()) {
        return None;
    }
    let most = all.singular_values().max();
    // What is hardly known by itself follows.
    let unknown: Vec<usize> = (0..names.len()).filter(|k| !known.contains(k)).collect();
    let order = [unknown.as_slice(), known.as_slice()].concat();
    let (first, count) = (unknown.len(), known.len());
    let all = triangle(all.select_columns(&order));
    let shares = all.view((first, first), (count, count)).into_owned();
    let svd = shares.svd(false, true);
    let (singular, v) = (svd.singular_values, svd.v_t?);
    let last = singular.len() - 1;
    let ratio = singular[last] / most;
    let moves = v.row(last);
    let largest = moves
        .iter()
        .copied()
        .max_by(|x, y| x.abs().total_cmp(&y.abs()))?;
    let moves = known.iter().zip(moves.iter());
    let moves = moves.map(|(&k, x)| (names[k].clone(), x / largest));
    (ratio < FRAIL).then(|| Direction {
        singular: ratio,
        moves: moves.filter(|(_, share)| share.abs() > 0.1).collect(),
    })
}

impl Identifiability {
    pub(super) fn new(r: &DMatrix<f64>, values: &[f64], names: &[String]) -> Self {
        let unknowns = r.ncols();
        let lengths: Vec<f64> = r.column_iter().map(|x| x.norm()).collect();
        let lengths = DVector::from_vec(audible(&lengths, values));
        let Some((singular, v)) = decomposed(r, &lengths) else {
            return Self {
                singular: Vec::new(),
                rank: 0,
                directions: Vec::new(),
                identified: Vec::new(),
                lengths,
                r: r.clone(),
            };
        };
        let largest = singular.max();
        let share = |x: f64| if largest > 0.0 { x / largest } else { 0.0 };
        let singular: Vec<f64> = singular.iter().map(|&x| share(x)).collect();
        // Steps of parameters along a direction, in shares of their values; one that is zero has no other measure than its step.
        let shares = |k: usize| -> Vec<(usize, f64)> {
            let steps = (0..unknowns).map(|p| {
                let step = match lengths[p] {
                    length if length > 0.0 => v[(k, p)] / length,
                    _ => v[(k, p)],
                };
                let value = if lengths[p] > 0.0 { values[p] } else { 0.0 };
                if value == 0.0 { step } else { step / value }
            });
            let steps: Vec<f64> = steps.collect();
            let valued = (0..unknowns).filter(|&p| values[p] != 0.0);
            let largest =
                valued.map(|p| steps[p]).fold(
                    0.0,
                    |most: f64, x| if x.abs() > most.abs() { x } else { most },
                );
            let largest = if largest == 0.0 { 1.0 } else { largest };
            let loud = (0..unknowns).filter(|&p| {
                let is_part = values[p] != 0.0 && (steps[p] / largest).abs() > LOUD;
                is_part || v[(k, p)].abs() > LOUD
            });
            loud.map(|p| (p, steps[p] / largest)).collect()
        };
        let directions = (0..unknowns).filter(|&k| singular[k] < WEAK);
        let directions = directions.map(|k| Direction {
            singular: singular[k],
            moves: shares(k)
                .into_iter()
                .map(|(p, share)| (names[p].clone(), share))
                .collect(),
        });
        let directions: Vec<Direction> = directions.collect();
        let rank = singular.iter().filter(|x| **x >= SILENT).count();
        // What a silent direction moves by a part of itself is not known by itself.
        let mut identified: Vec<bool> = lengths.iter().map(|length| *length > 0.0).collect();
        for k in rank..unknowns {
            for (p, _) in shares(k) {
                identified[p] = false;
            }
        }
        Self {
            singular,
            rank,
            directions,
            identified,
            lengths,
            r: r.clone(),
        }
    }

    /// What the same logs say of other parameters, of which these are functions: `slopes` has a row for each of these and a column for each of
    /// the others.
    ///
    /// # Panics
    /// Where `slopes` has another number of rows than there are parameters here, or of columns than there are `values` and `names`.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// # use block::{Block, measure};
    /// use nalgebra::DMatrix;
    /// use robot_model::identify::output_error::{Hold, OutputError, Recording};
    /// let recording = Recording::new(&measure(), &[1.0], 0.0, Vec::new());
    /// let settings = OutputError { hold: Some(Hold::Sample), ..OutputError::default() };
    /// let names = ["m", "c"].map(str::to_owned);
    /// let found = settings.fit(&Block([3.0, 0.2]), &names, &[3.0, 0.2], &[recording], &mut |_| ())?;
    /// // Of a mass that is a block's and a load's neither is told, friction is.
    /// let [m, c] = [found.values[0], found.values[1]];
    /// let names = ["own", "load", "c"].map(str::to_owned);
    /// let slopes = DMatrix::from_row_slice(2, 3, &[1.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    /// let parts = found.identifiability.through(&slopes, &[m - 0.5, 0.5, c], &names);
    /// assert_eq!((parts.rank, parts.directions.len()), (2, 1));
    /// assert_eq!([0, 1, 2].map(|k| parts.is_identified(k)), [false, false, true]);
    /// # Ok::<(), robot_model::identify::output_error::OutputErrorError>(())
    /// ```
    #[must_use]
    pub fn through(&self, slopes: &DMatrix<f64>, values: &[f64], names: &[String]) -> Self {
        assert_eq!(
            (slopes.nrows(), slopes.ncols(), slopes.ncols()),
            (self.r.ncols(), values.len(), names.len()),
            "a slope for each pair of parameters"
        );
        let sensitivities = &self.r * slopes;
        // As many singular values as parameters.
        let rows = sensitivities.nrows().max(values.len());
        Self::new(&sensitivities.resize_vertically(rows, 0.0), values, names)
    }

    /// Whether logs say anything of a parameter by itself.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// # use block::{Block, measure};
    /// use robot_model::identify::output_error::{Hold, OutputError, Recording};
    /// let recording = Recording::new(&measure(), &[1.0], 0.0, Vec::new());
    /// let settings = OutputError { hold: Some(Hold::Sample), ..OutputError::default() };
    /// let names = ["m", "c"].map(str::to_owned);
    /// let found = settings.fit(&Block([3.0, 0.2]), &names, &[3.0, 0.2], &[recording], &mut |_| ())?;
    /// // Pushed by known forces, a block shows its mass and its friction.
    /// assert!(found.identifiability.is_identified(0) && found.identifiability.is_identified(1));
    /// # Ok::<(), robot_model::identify::output_error::OutputErrorError>(())
    /// ```
    #[must_use]
    pub fn is_identified(&self, parameter: usize) -> bool {
        self.identified.get(parameter).copied().unwrap_or(false)
    }

    /// Whether outputs change with a parameter at all.
    pub(super) fn is_audible(&self, parameter: usize) -> bool {
        self.lengths[parameter] > 0.0
    }

    /// `(R'R)^-1`, without directions that change nothing.
    pub(super) fn inverse(&self, r: &DMatrix<f64>) -> DMatrix<f64> {
        let unknowns = r.ncols();
        let mut inverse = DMatrix::zeros(unknowns, unknowns);
        let Some((singular, v)) = decomposed(r, &self.lengths) else {
            return inverse;
        };
        for k in 0..self.rank {
            let vector = v.row(k).transpose();
            inverse += &vector * vector.transpose() / singular[k].powi(2);
        }
        let over = |x: f64| if x > 0.0 { 1.0 / x } else { 0.0 };
        let lengths = self.lengths.map(over);
        DMatrix::from_fn(unknowns, unknowns, |i, j| {
            inverse[(i, j)] * lengths[i] * lengths[j]
        })
    }
}

/// Singular values of `R D^-1`, falling, and its right singular vectors, one a row.
fn decomposed(r: &DMatrix<f64>, lengths: &DVector<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let mut scaled = r.clone();
    for (mut column, &length) in scaled.column_iter_mut().zip(lengths.iter()) {
        if length > 0.0 {
            column /= length;
        } else {
            column.fill(0.0);
        }
    }
    // Where all parameters are on bounds there is nothing to decompose; what is no number would be turned for ever.
    if scaled.is_empty() || !scaled.iter().all(|x| x.is_finite()) {
        return None;
    }
    let svd = scaled.svd(false, true);
    Some((svd.singular_values, svd.v_t?))
}
