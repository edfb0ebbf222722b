//! What logs tell of unknowns that they do not tell apart.
//!
//! Columns `W_u` that the others already span, `W_u = W_e K`, add nothing to what those explain: the torque is `W_e (beta_e + K beta_u)`,
//! and only the combinations `beta_e + K beta_u` can be found.

use std::fmt;

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;

use super::least_squares::{Excited, Solution};
use super::{Estimate, IdentifyError, Method, drowned};

/// Shares of a column in another, both of one length, below this are rounding, filters or noise.
const SHARE: f64 = 1e-4;

/// The same where some of the rows' directions are noise, of which others have a little.
const NOISY_SHARE: f64 = 1e-2;

/// An unknown that cannot be told from others, and its place in what can be found: `unknowns[lead] + sum factor * unknowns[other]`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Shared {
    /// The unknown with factor 1, whose place in the estimate holds the value of the combination.
    pub lead: usize,
    /// Unknowns that the logs do not excite beside the others, with their factors; not empty.
    pub others: Vec<(usize, f64)>,
}

/// A combination of parameters that the logs tell, where they do not tell its parts.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Combination {
    /// Names and factors; the first has factor 1.
    pub terms: Vec<(String, f64)>,
    /// Estimate, SI.
    pub value: f64,
    /// Its standard deviation.
    pub std: f64,
}

impl Combination {
    /// Those of a solution; parts that the logs do not tell are 0, or what a method has found for them elsewhere.
    pub(super) fn all(solution: &Solution, names: &[String]) -> Vec<Self> {
        let shared = solution.shared.iter();
        let of = |shared: &Shared| {
            Self::of(shared, &solution.estimate, names, solution.std[shared.lead])
        };
        shared.map(of).collect()
    }

    /// One of unknowns with values and names.
    pub(super) fn of(shared: &Shared, values: &[f64], names: &[String], std: f64) -> Self {
        let others = shared.others.iter().copied();
        let terms: Vec<(usize, f64)> = std::iter::once((shared.lead, 1.0)).chain(others).collect();
        Self {
            value: terms.iter().map(|&(k, factor)| factor * values[k]).sum(),
            terms: terms
                .into_iter()
                .map(|(k, factor)| (names[k].clone(), factor))
                .collect(),
            std,
        }
    }
}

impl fmt::Display for Combination {
    /// `a + 0.5 b - 2 c`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, (name, factor)) in self.terms.iter().enumerate() {
            let sign = if *factor < 0.0 { "-" } else { "+" };
            match (k, *factor) {
                (0, _) => write!(f, "{name}")?,
                (_, factor) if (factor.abs() - 1.0).abs() < 1e-6 => write!(f, " {sign} {name}")?,
                (_, factor) => write!(f, " {sign} {} {name}", short(factor.abs()))?,
            }
        }
        Ok(())
    }
}

/// Four digits of a positive number.
fn short(number: f64) -> String {
    if (1e-3..1e5).contains(&number) {
        format!("{number:.4}")
    } else {
        format!("{number:.3e}")
    }
}

/// Which excited unknowns stand for combinations, of the first `n` columns of a factor.
pub(super) fn shared(factor: &Mat<f64>, excited: &Excited, unexcited: &[usize]) -> Vec<Shared> {
    let Excited {
        columns,
        norms,
        kept,
        clean,
    } = excited;
    let of_columns = |columns: &[usize]| {
        let all = Mat::from_fn(factor.nrows(), columns.len(), |row, k| {
            factor[(row, columns[k])] / norms[columns[k]]
        });
        match clean {
            Some(clean) => clean.transpose() * all,
            None => all,
        }
    };
    let (kept, least) = match clean {
        Some(clean) => (&(clean.transpose() * kept), NOISY_SHARE),
        None => (kept, SHARE),
    };
    let spanned = unexcited.iter().copied();
    let spanned = spanned.filter(|&c| norms[c] > 0.0);
    // A column that is noise itself is in no sum.
    let spanned = spanned.filter(|&c| of_columns(&[c]).squared_norm_l2() > 1.0 - drowned::MOST);
    let spanned: Vec<usize> = spanned.collect();
    if spanned.is_empty() || columns.is_empty() {
        return Vec::new();
    }
    let shares = kept.qr().solve_lstsq(of_columns(&spanned));
    let of = |(row, &lead): (usize, &usize)| {
        let others = spanned.iter().enumerate();
        let others = others.filter(|&(k, _)| shares[(row, k)].abs() > least);
        let others = others.map(|(k, &c)| (c, shares[(row, k)] * norms[c] / norms[lead]));
        let others: Vec<(usize, f64)> = others.collect();
        (!others.is_empty()).then_some(Shared { lead, others })
    };
    columns.iter().enumerate().filter_map(of).collect()
}

impl Estimate {
    /// Whether a parameter has a value of its own: the logs excite it, and not only in a combination with others.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let mut estimate = Identify::default().fit(&pendulum(), &[measure(0.0)])?;
    /// assert!(estimate.is_separated("link.izz"));
    /// // What a log without acceleration would leave:
    /// estimate.unexcited = vec!["link.izz".to_owned()];
    /// assert!(!estimate.is_separated("link.izz") && estimate.is_separated("link.mx"));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn is_separated(&self, name: &str) -> bool {
        let in_combination = |combination: &Combination| combination.terms[0].0 == name;
        !self.unexcited.iter().any(|unexcited| unexcited == name)
            && !self.combinations.iter().any(in_combination)
    }

    /// That all parameters have values of their own. [`Method::Physical`] and [`Method::Ridge`] are asked where they have not: the former
    /// has the nearest arm beside what logs tell, the latter takes nominal values for measurements. Both name what stays untold.
    ///
    /// # Errors
    /// [`IdentifyError::NotSeparated`] with what the logs tell instead.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let mut estimate = Identify::default().fit(&pendulum(), &[measure(0.0)])?;
    /// estimate.separated()?; // before one takes its values for those of the parameters
    /// // What a log without acceleration would leave:
    /// estimate.unexcited = vec!["link.izz".to_owned()];
    /// let error = estimate.separated().unwrap_err();
    /// assert!(error.to_string().contains("the logs say nothing about `link.izz`"));
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn separated(&self) -> Result<(), IdentifyError> {
        if self.unexcited.is_empty() || matches!(self.method, Method::Physical | Method::Ridge) {
            return Ok(());
        }
        let in_any = |name: &&String| {
            let terms = self.combinations.iter().flat_map(|found| &found.terms);
            terms.map(|(name, _)| name).any(|term| term == *name)
        };
        let (mixed, silent): (Vec<&String>, Vec<&String>) = self.unexcited.iter().partition(in_any);
        let mut why = Vec::new();
        if !silent.is_empty() {
            why.push(format!("the logs say nothing about {}", list(&silent)));
        }
        if !mixed.is_empty() {
            let combinations: Vec<String> =
                self.combinations.iter().map(|x| format!("`{x}`")).collect();
            // So many are read one a line.
            let [before, between] = if combinations.len() > IN_A_LINE {
                ["\n  ", "\n  "]
            } else {
                [" ", ", "]
            };
            why.push(format!(
                "{} cannot be separated from others, only{before}{}",
                list(&mixed),
                combinations.join(between)
            ));
        }
        let between = if self.combinations.len() > IN_A_LINE {
            "\n"
        } else {
            "; "
        };
        Err(IdentifyError::NotSeparated {
            rank: self.rank,
            unknowns: self.parameters.len(),
            why: why.join(between),
        })
    }
}

/// Combinations that are told in one line.
const IN_A_LINE: usize = 2;

fn list(names: &[&String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::Unknown;
    use crate::identify::Factors;
    use crate::identify::stack::{JointRows, Stack};

    /// Rows of one joint for columns as given.
    fn stack(columns: &[&dyn Fn(f64) -> f64], truth: &[f64]) -> Stack {
        let time: Vec<f64> = (0..200).map(|k| 0.05 * f64::from(k)).collect();
        let columns: Vec<(usize, Vec<f64>)> = columns
            .iter()
            .map(|column| time.iter().map(|t| column(*t)).collect())
            .enumerate()
            .collect();
        let target: Vec<f64> = (0..time.len())
            .map(|k| {
                columns
                    .iter()
                    .map(|(c, values)| truth[*c] * values[k])
                    .sum()
            })
            .collect();
        let unknown = |c: usize| Unknown {
            name: format!("p{c}"),
            nonnegative: false,
        };
        Stack {
            unknowns: (0..truth.len()).map(unknown).collect(),
            joints: vec![JointRows {
                tau: target.clone(),
                target,
                columns,
            }],
            ..Stack::default()
        }
    }

    #[test]
    fn what_is_found_is_the_combination_that_is_told() {
        // Column 2 is three times column 0 less column 1, column 3 is dead, column 4 stands by itself.
        let (a, b, c) = (f64::sin, |t: f64| (2.3 * t).cos(), |t: f64| (0.7 * t).sin());
        let mixed = |t: f64| 3.0 * a(t) - b(t);
        let truth = [1.0, 2.0, 0.5, 7.0, -1.0];
        let stack = stack(&[&a, &b, &mixed, &|_| 0.0, &c], &truth);
        let found = Factors::new(&stack).ordinary(&[1.0]);
        assert_eq!(found.unexcited.len(), 2);
        assert!(found.unexcited.contains(&3));
        assert_eq!(found.shared.len(), 2);
        for Shared { lead, others } in &found.shared {
            assert!(*lead != 4 && others.len() == 1);
            let sum = truth[*lead] + others[0].1 * truth[others[0].0];
            assert!((found.estimate[*lead] - sum).abs() < 1e-9, "{found:?}");
        }
        assert!((found.estimate[4] + 1.0).abs() < 1e-9);
    }

    #[test]
    fn columns_that_are_apart_have_no_combinations() {
        let stack = stack(&[&f64::sin, &f64::cos], &[1.0, 2.0]);
        let found = Factors::new(&stack).ordinary(&[1.0]);
        assert!(found.shared.is_empty() && found.unexcited.is_empty());
    }

    #[test]
    fn combinations_read_as_sums() {
        let combination = Combination {
            terms: vec![
                ("a.m".to_owned(), 1.0),
                ("b.m".to_owned(), -1.0),
                ("c.m".to_owned(), 0.25),
            ],
            value: 1.0,
            std: 0.1,
        };
        assert_eq!(combination.to_string(), "a.m - b.m + 0.2500 c.m");
    }
}
