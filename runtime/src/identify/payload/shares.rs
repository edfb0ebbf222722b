//! What a payload adds to an arm's base parameters.

use super::KnownPayload;
use crate::columns::{Arm, Entry, Unknown};
use crate::identify::{IdentifyError, Stack};

/// What a payload's parameters add to an arm's unknowns.
pub(super) struct Shares {
    /// The link that carries it.
    pub link: String,
    /// The payload's parameters that are looked for.
    pub unknowns: Vec<Unknown>,
    /// Per unknown of the arm what each of them adds to it.
    pub coefficients: Vec<Vec<f64>>,
}

impl Shares {
    pub fn of(arm: &dyn Arm, link: Option<&str>) -> Result<Self, IdentifyError> {
        let arms = arm.possible_arms().ok_or(IdentifyError::NoBodies)?;
        // Bodies of effects have names with a dot.
        let links = arms.links.iter().filter(|link| !link.name.contains('.'));
        let links: Vec<_> = links.collect();
        let mut last = arms
            .names
            .iter()
            .filter_map(|name| name.strip_suffix(".izz"));
        let last = last.rfind(|name| !name.contains('.'));
        let wanted = link.or(last).unwrap_or_default();
        let Some(found) = links.iter().find(|link| link.name == wanted) else {
            if arms
                .names
                .iter()
                .any(|name| *name == format!("{wanted}.izz"))
            {
                return Err(IdentifyError::FixedLink {
                    link: wanted.to_owned(),
                });
            }
            return Err(IdentifyError::NoLink {
                links: links.iter().map(|link| link.name.clone()).collect(),
            });
        };
        let factor = |terms: &[(usize, f64)], place: usize| -> f64 {
            let own = terms.iter().filter(|(standard, _)| *standard == place);
            own.map(|(_, factor)| factor).sum()
        };
        // Of those that any torque depends on.
        let places = found.parameters.iter().copied();
        let places = places.filter(|&place| {
            let all = arms.combinations.iter();
            all.into_iter().any(|terms| factor(terms, place) != 0.0)
        });
        let places: Vec<usize> = places.collect();
        let unknown = |&place: &usize| {
            let name = &arms.names[place];
            let own = name.rsplit('.').next().unwrap_or(name);
            Unknown {
                name: format!("{}.payload.{own}", found.name),
                nonnegative: own == "m",
            }
        };
        let coefficients = arms.combinations.iter().map(|terms| {
            let places = places.iter();
            places.map(|&place| factor(terms, place)).collect()
        });
        Ok(Self {
            link: found.name.clone(),
            unknowns: places.iter().map(unknown).collect(),
            coefficients: coefficients.collect(),
        })
    }

    /// The unknowns with the payload in them.
    pub fn loaded(&self, values: &[f64]) -> Vec<f64> {
        let (arm, payload) = values.split_at(self.coefficients.len());
        let pairs = arm.iter().zip(&self.coefficients);
        pairs
            .map(|(value, factors)| {
                let terms = factors.iter().zip(payload);
                value + terms.map(|(factor, own)| factor * own).sum::<f64>()
            })
            .collect()
    }

    /// Takes out what is known of the payload; what it adds to each of the arm's unknowns.
    pub fn take_known(&mut self, known: &KnownPayload) -> Vec<f64> {
        let mut base = vec![0.0; self.coefficients.len()];
        let value = |unknown: &Unknown| match (unknown.name.rsplit('.').next()?, known.center) {
            ("m", _) => Some(known.mass),
            ("mx", Some([x, _, _])) => Some(known.mass * x),
            ("my", Some([_, y, _])) => Some(known.mass * y),
            ("mz", Some([_, _, z])) => Some(known.mass * z),
            _ => None,
        };
        let values: Vec<Option<f64>> = self.unknowns.iter().map(value).collect();
        for (sum, factors) in base.iter_mut().zip(&mut self.coefficients) {
            let pairs = factors.iter().zip(&values);
            *sum = pairs
                .map(|(factor, value)| factor * value.unwrap_or(0.0))
                .sum();
            let mut open = values.iter().map(Option::is_none);
            factors.retain(|_| open.next() == Some(true));
        }
        let mut open = values.iter().map(Option::is_none);
        self.unknowns.retain(|_| open.next() == Some(true));
        base
    }

    /// Columns of the payload, which is there from row `start` on.
    pub fn columns(&self, stack: &Stack, start: usize) -> Vec<Entry> {
        let factor = |unknown: usize, column: usize| self.coefficients[unknown][column];
        columns(stack, start, self.unknowns.len(), factor)
    }
}

/// Sums of a stack's columns from row `start` on, `count` on each joint; `factor` is of an unknown of the stack and a column.
pub(super) fn columns(
    stack: &Stack,
    start: usize,
    count: usize,
    factor: impl Fn(usize, usize) -> f64,
) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (joint, rows) in stack.joints.iter().enumerate() {
        for column in 0..count {
            let mut values = vec![0.0; rows.target.len()];
            for (unknown, own) in &rows.columns {
                let factor = factor(*unknown, column);
                if factor != 0.0 {
                    let pairs = values[start..].iter_mut().zip(&own[start..]);
                    pairs.for_each(|(sum, value)| *sum += factor * value);
                }
            }
            entries.push(Entry {
                joint,
                column,
                values,
            });
        }
    }
    entries
}
