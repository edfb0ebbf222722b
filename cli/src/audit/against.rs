//! Parameters of two sources, two papers, two days or a paper and an identification: whether they are of one arm.

use robot_model_codegen::Compiled;

use super::{Check, Finding, Quantity};
use crate::output::{counted, rounded};
use crate::parameters::{Sureness, Values};

/// Share by which the rounding of a source moves values: three digits of the parts that they are made of, as in [`super::base`].
const DIGITS: f64 = 5e-3;

/// How many deviations apart values are no longer one: of a hundred parameters that are, one is so far off in one case of 150.
const BEYOND: f64 = 4.0;

/// Values of an arm, and how sure they are, as far as their file says so.
pub(super) struct Source {
    pub(super) values: Values,
    pub(super) sureness: Sureness,
}

/// A parameter of both sources.
struct Pair<'a> {
    name: &'a str,
    values: [f64; 2],
    /// Of the difference; 0 where there is none.
    std: f64,
    /// Of the parts that it is a sum of in each source, which were rounded each.
    sizes: [f64; 2],
    is_shape: bool,
}

/// What torques tell of an arm beside the same of another source: base parameters `b` and `b'` are one where
/// `|b - b'| <= 0.005 (size + size') + 4 sqrt(s^2 + s'^2)`; `s` are deviations, and the size is `sum |k p|` of what `b = sum k p` is made of.
/// Shapes likewise. What no log told a source is compared with nothing.
pub(super) fn check(compiled: &Compiled, sources: &[Source; 2]) -> Check {
    let pair = |name, is_shape: bool, of: &dyn Fn(&Values) -> [f64; 2]| {
        let [one, other] = sources.each_ref().map(|source| of(&source.values));
        let stds = sources.iter();
        let stds = stds.filter_map(|source| source.sureness.deviations.get(name));
        Pair {
            name,
            values: [one[0], other[0]],
            std: stds.map(|std| std * std).sum::<f64>().sqrt(),
            sizes: [one[1], other[1]],
            is_shape,
        }
    };
    let base = compiled.base.names.iter().enumerate();
    let base = base.map(|(place, name)| {
        pair(name.as_str(), false, &|values| {
            [values.beta[place], size(compiled, values, place)]
        })
    });
    let names = compiled.shape_names();
    let shapes = names.iter().enumerate().map(|(place, name)| {
        pair(name.as_str(), true, &|values| {
            [values.shapes[place], values.shapes[place].abs()]
        })
    });
    let is_untold =
        |pair: &Pair<'_>| (sources.iter()).any(|source| source.sureness.untold.contains(pair.name));
    let (untold, pairs): (Vec<Pair<'_>>, Vec<Pair<'_>>) = base.chain(shapes).partition(is_untold);
    let findings = pairs.iter().filter(|pair| pair.is_apart());
    let mut scope = format!(
        "{} compared between both sources",
        counted(pairs.len(), "parameter")
    );
    if !untold.is_empty() {
        scope = format!("{scope}, without {} not identified", untold.len());
    }
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
        self.apart().abs() > DIGITS * self.sizes.iter().sum::<f64>() + BEYOND * self.std
    }

    fn finding(&self) -> Finding {
        let [one, other] = self.values.map(rounded);
        let apart = self.apart();
        let far = if self.std > 0.0 {
            format!("{:.1} standard deviations apart", apart.abs() / self.std)
        } else {
            let size = self.sizes[0].max(self.sizes[1]);
            let of = if self.is_shape { "it" } else { "its parts" };
            format!("{:.1} % of {of}", 100.0 * apart.abs() / size)
        };
        let name = self.name;
        let sentence = format!("`{name}` is {one}, in the other source {other}: {far}");
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
