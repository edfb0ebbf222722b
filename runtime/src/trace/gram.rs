//! Sums of products of columns, by joint and fold: everything a fit or a held-out error needs, in matrices of the size of the
//! unknowns.
//!
//! With `G_j = [W_j z_j t_j]' [W_j z_j t_j]` over any set of rows, weighted least squares on those rows solves
//! `sum_j G_j / sigma_j^2`, and the squared error of an estimate on them is a quadratic form of `G_j`.

use faer::Mat;

use crate::columns::Entry;
use crate::identify::{JointRows, Stack};

use super::folds::Fold;
use super::normal::{Normal, Smooth};

/// Products of one joint's columns, in the order unknowns then target, over one set of rows.
pub(super) type Products = Mat<f64>;

/// A set of rows with the products of every joint over it.
#[derive(Debug, Clone)]
struct Part {
    rows: Vec<usize>,
    joints: Vec<Products>,
}

/// Products over all rows, and over the training and test rows of every fold.
#[derive(Debug, Clone)]
pub(super) struct Gram {
    unknowns: usize,
    all: Part,
    train: Vec<Part>,
    test: Vec<Part>,
}

impl Gram {
    pub(super) fn new(stack: &Stack, folds: &[Fold]) -> Self {
        let unknowns = stack.unknowns.len();
        let over = |rows: Vec<usize>| Part {
            joints: stack
                .joints
                .iter()
                .map(|joint| products(joint, &rows, unknowns))
                .collect(),
            rows,
        };
        Self {
            unknowns,
            all: over((0..stack.samples()).collect()),
            train: folds.iter().map(|fold| over(fold.train.clone())).collect(),
            test: folds.iter().map(|fold| over(fold.test.clone())).collect(),
        }
    }

    /// The same with `count` more columns behind the unknowns; only their products are computed.
    pub(super) fn extended(&self, stack: &Stack, entries: &[Entry], count: usize) -> Self {
        let extend = |part: &Part| Part {
            joints: part
                .joints
                .iter()
                .enumerate()
                .map(|(j, products)| {
                    border(products, &part.rows, &stack.joints[j], j, entries, count)
                })
                .collect(),
            rows: part.rows.clone(),
        };
        Self {
            unknowns: self.unknowns + count,
            all: extend(&self.all),
            train: self.train.iter().map(extend).collect(),
            test: self.test.iter().map(extend).collect(),
        }
    }

    /// Columns before the target.
    pub(super) fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Normal equations of all rows.
    pub(super) fn normal(&self, sigma: &[f64]) -> Normal {
        Normal::new(&self.all.joints, sigma, &self.squares(sigma))
    }

    /// Weighted sum of squares of every column over all rows.
    fn squares(&self, sigma: &[f64]) -> Vec<f64> {
        let of = |c: usize| {
            self.all
                .joints
                .iter()
                .zip(sigma)
                .map(|(g, s)| g[(c, c)] / (s * s))
                .sum()
        };
        (0..self.unknowns).map(of).collect()
    }

    /// Held-out mean squared error per fold and joint, each fold fitted on its training rows.
    pub(super) fn held_out(&self, sigma: &[f64]) -> HeldOut {
        let squares = self.squares(sigma);
        self.held_out_by(|train| Normal::new(&train.joints, sigma, &squares))
    }

    /// The same with a curve's columns that bend little.
    pub(super) fn held_out_smooth(&self, sigma: &[f64], smooth: &Smooth<'_>) -> HeldOut {
        let squares = self.squares(sigma);
        self.held_out_by(|train| Normal::smooth(&train.joints, sigma, &squares, smooth))
    }

    fn held_out_by(&self, normal: impl Fn(&Part) -> Normal) -> HeldOut {
        let estimates = self.train.iter().map(|train| normal(train).solve());
        let estimates: Vec<Vec<f64>> = estimates.collect();
        let errors = estimates
            .iter()
            .zip(&self.test)
            .map(|(estimate, test)| {
                let rows = test.rows.len().max(1) as f64;
                test.joints
                    .iter()
                    .map(|g| squared_error(g, estimate) / rows)
                    .collect()
            })
            .collect();
        HeldOut {
            estimates,
            errors,
            rows: self.test.iter().map(|test| test.rows.len()).collect(),
        }
    }
}

/// Products with `count` more columns between the unknowns and the target.
fn border(
    products: &Products,
    rows: &[usize],
    joint: &JointRows,
    number: usize,
    entries: &[Entry],
    count: usize,
) -> Products {
    let old = products.nrows() - 1;
    let place = |c: usize| if c < old { c } else { c + count };
    let mut all = Mat::zeros(old + count + 1, old + count + 1);
    for b in 0..=old {
        for a in 0..=old {
            all[(place(a), place(b))] = products[(a, b)];
        }
    }
    let over = |a: &[f64], b: &[f64]| rows.iter().map(|k| a[*k] * b[*k]).sum::<f64>();
    for entry in entries.iter().filter(|entry| entry.joint == number) {
        let at = old + entry.column;
        let mut put = |other: usize, value: f64| {
            all[(at, other)] += value;
            if other != at {
                all[(other, at)] += value;
            }
        };
        for (column, values) in &joint.columns {
            put(*column, over(&entry.values, values));
        }
        put(old + count, over(&entry.values, &joint.target));
        for other in entries
            .iter()
            .filter(|other| other.joint == number && other.column <= entry.column)
        {
            put(old + other.column, over(&entry.values, &other.values));
        }
    }
    all
}

/// What cross-validation found.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HeldOut {
    /// Estimate of every fold.
    pub(super) estimates: Vec<Vec<f64>>,
    /// Mean squared error, `[fold][joint]`.
    pub(super) errors: Vec<Vec<f64>>,
    rows: Vec<usize>,
}

impl HeldOut {
    /// Mean squared error of one joint over all folds.
    pub(super) fn mean(&self, joint: usize) -> f64 {
        let total: usize = self.rows.iter().sum();
        self.errors
            .iter()
            .zip(&self.rows)
            .map(|(errors, rows)| errors[joint] * *rows as f64)
            .sum::<f64>()
            / total.max(1) as f64
    }
}

fn products(joint: &JointRows, rows: &[usize], unknowns: usize) -> Products {
    let active = joint.columns.len();
    let block = Mat::from_fn(rows.len(), active + 1, |k, c| {
        if c < active {
            joint.columns[c].1[rows[k]]
        } else {
            joint.target[rows[k]]
        }
    });
    let small = block.transpose() * &block;
    let place = |c: usize| {
        if c < active {
            joint.columns[c].0
        } else {
            unknowns
        }
    };
    let mut all = Mat::zeros(unknowns + 1, unknowns + 1);
    for a in 0..=active {
        for b in 0..=active {
            all[(place(a), place(b))] = small[(a, b)];
        }
    }
    all
}

/// `|| target - columns * estimate ||^2` from products.
fn squared_error(g: &Products, estimate: &[f64]) -> f64 {
    let n = estimate.len();
    let value = |c: usize| if c < n { -estimate[c] } else { 1.0 };
    let mut sum = 0.0;
    for a in 0..=n {
        let row: f64 = (0..=n).map(|b| g[(a, b)] * value(b)).sum();
        sum += value(a) * row;
    }
    sum.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::Unknown;
    use crate::identify::{Factors, Segment};

    /// Two joints, three unknowns, the third on both joints; a row pattern without special values.
    fn stack() -> Stack {
        let wave = |a: f64, b: f64| {
            (0..200)
                .map(|k| (a * f64::from(k) + b).sin())
                .collect::<Vec<f64>>()
        };
        let rows = |first: usize, shift: f64| {
            let columns = vec![(first, wave(0.37, shift)), (2, wave(0.11, 2.0 * shift))];
            let noise = wave(2.9, shift);
            let target = (0..200)
                .map(|k| 1.5 * columns[0].1[k] - 0.7 * columns[1].1[k] + 0.1 * noise[k])
                .collect();
            JointRows {
                tau: Vec::new(),
                target,
                columns,
            }
        };
        let unknown = |name: &str| Unknown {
            name: name.to_owned(),
            nonnegative: false,
        };
        Stack {
            unknowns: vec![unknown("a"), unknown("b"), unknown("c")],
            joints: vec![rows(0, 0.3), rows(1, 1.1)],
            segments: vec![Segment {
                start: 0,
                time: (0..200).map(f64::from).collect(),
            }],
            ..Stack::default()
        }
    }

    #[test]
    fn normal_equations_agree_with_qr() {
        let stack = stack();
        let sigma = [0.5, 2.0];
        let found = Gram::new(&stack, &[]).normal(&sigma).solve();
        let weighted = Stack {
            joints: stack
                .joints
                .iter()
                .zip(sigma)
                .map(|(rows, s)| JointRows {
                    tau: Vec::new(),
                    target: rows.target.iter().map(|t| t / s).collect(),
                    columns: rows
                        .columns
                        .iter()
                        .map(|(c, v)| (*c, v.iter().map(|v| v / s).collect()))
                        .collect(),
                })
                .collect(),
            ..stack.clone()
        };
        let qr = Factors::new(&weighted).ordinary(&[1.0, 1.0]).estimate;
        for (a, b) in found.iter().zip(&qr) {
            assert!((a - b).abs() < 1e-8, "{found:?} {qr:?}");
        }
    }

    #[test]
    fn held_out_errors_are_those_of_residuals() {
        let stack = stack();
        let fold = Fold {
            test: (0..60).collect(),
            train: (80..200).collect(),
        };
        let held_out = Gram::new(&stack, &[fold]).held_out(&[1.0, 1.0]);
        let residuals = stack.residuals(&held_out.estimates[0]);
        for joint in 0..2 {
            let direct = residuals[joint][..60].iter().map(|r| r * r).sum::<f64>() / 60.0;
            assert!((held_out.mean(joint) / direct - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_bordered_gram_is_that_of_the_longer_stack() {
        let stack = stack();
        let values: Vec<f64> = (0..200).map(|k| (0.05 * f64::from(k)).cos()).collect();
        let entries = [
            Entry {
                joint: 1,
                column: 0,
                values: values.clone(),
            },
            Entry {
                joint: 1,
                column: 1,
                values: values.iter().map(|v| v * v).collect(),
            },
        ];
        let fold = Fold {
            test: (0..60).collect(),
            train: (80..200).collect(),
        };
        let bordered = Gram::new(&stack, std::slice::from_ref(&fold)).extended(&stack, &entries, 2);
        let mut longer = stack.clone();
        let unknown = |name: &str| Unknown {
            name: name.to_owned(),
            nonnegative: false,
        };
        longer.append(&[unknown("d"), unknown("e")], &entries);
        let (one, other) = (
            bordered.held_out(&[1.0, 2.0]),
            Gram::new(&longer, &[fold]).held_out(&[1.0, 2.0]),
        );
        for (a, b) in one.estimates[0].iter().zip(&other.estimates[0]) {
            assert!((a - b).abs() < 1e-9);
        }
    }
}
