//! Parameters of two sources, two papers, two days or a paper and an identification: whether they are of one arm.

use robot_model_codegen::Compiled;

use super::{Check, Finding, Quantity};
use crate::output::{counted, rounded};
use crate::parameters::Values;

/// Share by which values may be apart beside their deviations: what rounding to three digits leaves, as in [`super::base`].
const DIGITS: f64 = 5e-3;

/// How many deviations apart values are no longer one: of a hundred parameters that are, one is so far off in one case of 150.
const BEYOND: f64 = 4.0;

/// Values of an arm, and standard deviations of its base parameters, as far as there are some.
pub(super) struct Source {
    pub(super) values: Values,
    pub(super) deviations: Vec<Option<f64>>,
}

/// A parameter of both sources.
struct Pair<'a> {
    name: &'a str,
    values: [f64; 2],
    /// Of the difference; 0 where there is none.
    std: f64,
    /// Of the parts that it is a sum of, which were rounded each.
    size: f64,
}

/// What torques tell of an arm beside the same of another source: base parameters `b` and `b'` are one where
/// `|b - b'| <= 0.005 size + 4 sqrt(s^2 + s'^2)`; `s` are deviations, and the size is `sum |k p|` of what `b = sum k p` is made of. Shapes
/// likewise, without deviations.
pub(super) fn check(compiled: &Compiled, sources: &[Source; 2]) -> Check {
    let base = compiled.base.names.iter().enumerate();
    let base = base.map(|(place, name)| {
        let stds = sources.iter().filter_map(|one| one.deviations[place]);
        let sizes = sources.iter().map(|one| size(compiled, &one.values, place));
        Pair {
            name,
            values: [0, 1].map(|side: usize| sources[side].values.beta[place]),
            std: stds.map(|std| std * std).sum::<f64>().sqrt(),
            size: sizes.fold(0.0, f64::max),
        }
    });
    let names = compiled.shape_names();
    let shapes = names.iter().enumerate().map(|(place, name)| {
        let values = [0, 1].map(|side: usize| sources[side].values.shapes[place]);
        Pair {
            name,
            values,
            std: 0.0,
            size: values[0].abs().max(values[1].abs()),
        }
    });
    let pairs: Vec<Pair<'_>> = base.chain(shapes).collect();
    let findings = pairs.iter().filter(|pair| pair.is_apart());
    let scope = format!(
        "{} of the one source beside those of the other",
        counted(pairs.len(), "parameter")
    );
    Check::new("against", scope, findings.map(Pair::finding).collect())
}

/// Of the parts of a base parameter, where the source has them, or of itself.
fn size(compiled: &Compiled, values: &Values, place: usize) -> f64 {
    let parts = values.standard.as_ref().map(|standard| {
        let parts = compiled.base.combinations[place].iter();
        let parts = parts.map(|&(k, factor)| (factor * standard[k].unwrap_or(0.0)).abs());
        parts.sum::<f64>()
    });
    parts.unwrap_or(0.0).max(values.beta[place].abs())
}

impl Pair<'_> {
    fn apart(&self) -> f64 {
        self.values[0] - self.values[1]
    }

    fn is_apart(&self) -> bool {
        self.apart().abs() > DIGITS * self.size + BEYOND * self.std
    }

    fn finding(&self) -> Finding {
        let [one, other] = self.values.map(rounded);
        let apart = self.apart();
        let far = if self.std > 0.0 {
            format!("{:.1} deviations apart", apart.abs() / self.std)
        } else {
            format!("{:.1} % of its parts", 100.0 * apart.abs() / self.size)
        };
        let name = self.name;
        let sentence = format!("`{name}` is {one}, and {other} there: {far}");
        let numbers = [
            ("value", self.values[0]),
            ("other", self.values[1]),
            ("apart", apart),
        ];
        let mut numbers =
            Vec::from(numbers.map(|(what, value)| Quantity::of(what, name, value, "")));
        if self.std > 0.0 {
            numbers.push(Quantity::of("std", name, self.std, ""));
        }
        (sentence, numbers)
    }
}
