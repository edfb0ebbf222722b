//! What a payload adds to an arm's base parameters.

use super::{FIRST_MOMENTS, KnownPayload};
use crate::columns::{Arm, Entry, Unknown};
use crate::identify::least_squares::Solution;
use crate::identify::{Identify, IdentifyError, Stack};

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

    /// Standard deviations of the center of mass `c = h / m` of a solution, m; none where the mass or a moment is not looked for, or is not
    /// told. With `h = c m + d` and what was found for `c` the column of the mass is that of a body there, and `d`, which is zero, is off by
    /// what `h` and `m` together are off.
    pub fn center_std(
        &self,
        identify: &Identify,
        stack: &Stack,
        solution: &Solution,
    ) -> [Option<f64>; 3] {
        let place = |own: &str| {
            let mut names = self.unknowns.iter().map(|unknown| &unknown.name);
            let payload = names.position(|name| name.rsplit('.').next() == Some(own))?;
            let place = self.coefficients.len() + payload;
            solution.is_told(place).then_some(place)
        };
        let Some(mass) = place("m").filter(|mass| solution.estimate[*mass] > 0.0) else {
            return [None; 3];
        };
        let moments = FIRST_MOMENTS.map(place);
        let (mut stack, mut solution) = (stack.clone(), solution.clone());
        let value = solution.estimate[mass];
        for place in moments.into_iter().flatten() {
            let center = solution.estimate[place] / value;
            add_column(&mut stack, mass, center, place);
            solution.estimate[place] = 0.0;
        }
        let std = identify.deviations(&stack, &solution);
        moments.map(|place| Some(std[place?] / value))
    }

    /// Columns of the payload, which is there from row `start` on.
    pub fn columns(&self, stack: &Stack, start: usize) -> Vec<Entry> {
        let factor = |unknown: usize, column: usize| self.coefficients[unknown][column];
        columns(stack, start, self.unknowns.len(), factor)
    }
}

/// Adds a column, times a factor, to one of another unknown.
fn add_column(stack: &mut Stack, to: usize, factor: f64, from: usize) {
    for rows in &mut stack.joints {
        let find = |unknown: usize| rows.columns.iter().find(|(column, _)| *column == unknown);
        let Some((_, own)) = find(from) else { continue };
        let mut sum: Vec<f64> = own.iter().map(|value| factor * value).collect();
        if let Some((_, own)) = find(to) {
            sum.iter_mut()
                .zip(own)
                .for_each(|(sum, value)| *sum += value);
        }
        rows.columns.retain(|(column, _)| *column != to);
        rows.columns.push((to, sum));
        rows.columns.sort_by_key(|(column, _)| *column);
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
