//! The table that a paper would print of an estimate.

use std::fmt;

use super::{Combination, Estimate};

/// Outliers are many from one sample in so many on.
const MANY: usize = 10;

impl fmt::Display for Estimate {
    /// The table that a paper would print.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = self.parameters.iter().map(|p| p.name.len());
        let width = names.max().unwrap_or(0).max("parameter".len());
        self.tell_parameters(f, width)?;
        self.tell_shapes(f, width)?;
        writeln!(
            f,
            "rank {} of {}, condition {:.1}, {} samples a joint below {:.0} Hz, {}",
            self.rank,
            self.parameters.len(),
            self.condition,
            self.samples,
            self.bands.shared_hz,
            self.method.name()
        )?;
        let a_joint = |counts: &[String]| {
            let joints = self.joints.iter().zip(counts);
            let told: Vec<String> = joints.map(|(name, n)| format!("{name} {n}")).collect();
            told.join(", ")
        };
        if self.turns.iter().any(|count| *count > 0) {
            let counts: Vec<String> = self.turns.iter().map(usize::to_string).collect();
            let counts = a_joint(&counts);
            if self.is_without_turns {
                writeln!(f, "left out, near velocity reversals: {counts}")?;
            } else {
                writeln!(f, "of these near velocity reversals: {counts}")?;
            }
        }
        if self.held.iter().any(|count| *count > 0) {
            let counts: Vec<String> = self.held.iter().map(usize::to_string).collect();
            let counts = a_joint(&counts);
            writeln!(f, "left out, at long rests held by dry friction: {counts}")?;
        }
        if self.clipped.iter().any(|count| *count > 0) {
            let counts: Vec<String> = self.clipped.iter().map(usize::to_string).collect();
            let counts = a_joint(&counts);
            writeln!(f, "left out, torque at its limit: {counts}")?;
        }
        if let Some(effective) = &self.effective_samples {
            let counts: Vec<String> = effective.iter().map(|n| format!("{n:.0}")).collect();
            writeln!(f, "independent samples: {}", a_joint(&counts))?;
        }
        if let Some(bootstrap) = &self.bootstrap {
            writeln!(
                f,
                "95 % confidence intervals from {} draws of {} blocks of the logs",
                bootstrap.draws, bootstrap.blocks
            )?;
        }
        self.tell_possible(f)?;
        self.tell_outliers(f)?;
        if let Some(hausman) = &self.hausman {
            hausman.tell(f, &self.parameters)?;
        }
        self.tell_combinations(f)?;
        self.tell_essential(f)
    }
}

/// Deviations above so many percent of their value are not told in digits, nor where a value is so small a share of its deviation.
const MOST: f64 = 999.0;
const LEAST: f64 = 1e-3;

/// Whether logs tell a shape: its standard deviation is at most half of its value. With a larger one it may be anywhere.
///
/// # Examples
/// ```
/// use robot_model::identify::is_shape_told;
/// assert!(is_shape_told(0.4, 0.05) && !is_shape_told(0.0072, 0.0072));
/// ```
#[must_use]
pub fn is_shape_told(value: f64, std: f64) -> bool {
    const ANYWHERE: f64 = 0.5;
    std <= ANYWHERE * value.abs()
}

/// A deviation in percent of its value, as tables have it: beyond 999 % the number says no more, and beside a value that is nothing
/// there is none.
///
/// # Examples
/// ```
/// use robot_model::identify::relative_deviation;
///
/// assert_eq!(relative_deviation(-2.0, 0.1), "5.00");
/// assert_eq!(relative_deviation(0.002, 0.1), ">999");
/// assert_eq!(relative_deviation(1e-9, 0.1), "-");
/// ```
#[must_use]
pub fn relative_deviation(value: f64, std: f64) -> String {
    let percent = 100.0 * (std / value).abs();
    if value == 0.0 || value.abs() < LEAST * std {
        "-".to_owned()
    } else if percent > MOST {
        format!(">{MOST:.0}")
    } else {
        format!("{percent:.2}")
    }
}

/// A value, as tables have it: five decimals, or four behind the first digit of one that these would hide.
///
/// # Examples
/// ```
/// use robot_model::identify::table_value;
///
/// assert_eq!(table_value(-2.0), "-2.00000");
/// assert_eq!(table_value(0.000_037_2), "3.7200e-5");
/// assert_eq!(table_value(0.0), "0.00000");
/// ```
#[must_use]
pub fn table_value(value: f64) -> String {
    const SMALL: f64 = 1e-3;
    if value != 0.0 && value.abs() < SMALL {
        format!("{value:.4e}")
    } else {
        format!("{value:.5}")
    }
}

impl Estimate {
    fn tell_parameters(&self, f: &mut fmt::Formatter<'_>, width: usize) -> fmt::Result {
        let interval = self
            .bootstrap
            .as_ref()
            .map_or("", |_| "             interval");
        writeln!(
            f,
            "{:width$}  {:>12}  {:>10}  {:>7}{interval}",
            "parameter", "value", "std", "std %"
        )?;
        for (k, p) in self.parameters.iter().enumerate() {
            if !self.is_separated(&p.name) {
                writeln!(f, "{:width$}  {:>12}", p.name, "not separable")?;
                continue;
            }
            if self.is_held(&p.name) {
                write!(
                    f,
                    "{:width$}  {:>12}  {:>10}  {:>7}",
                    p.name,
                    table_value(p.value),
                    "-",
                    "-"
                )?;
            } else {
                let relative = relative_deviation(p.value, p.std);
                write!(
                    f,
                    "{:width$}  {:>12}  {:>10.2e}  {relative:>7}",
                    p.name,
                    table_value(p.value),
                    p.std
                )?;
            }
            let intervals = self.bootstrap.as_ref().map(|found| &found.intervals);
            match intervals.and_then(|intervals| intervals[k]) {
                Some([low, high]) => {
                    let [low, high] = [low, high].map(table_value);
                    writeln!(f, "  {low:>10} .. {high:<10}")?;
                }
                None => writeln!(f)?,
            }
        }
        Ok(())
    }

    fn tell_shapes(&self, f: &mut fmt::Formatter<'_>, width: usize) -> fmt::Result {
        for ((name, value), std) in self.shapes.iter().zip(&self.shape_std) {
            let said = table_value(*value);
            match std {
                Some(std) => {
                    let relative = relative_deviation(*value, *std);
                    writeln!(
                        f,
                        "{name:width$}  {said:>12}  {std:>10.2e}  {relative:>7}  (shape)"
                    )?;
                }
                None => writeln!(f, "{name:width$}  {said:>12}  (shape)")?,
            }
        }
        Ok(())
    }

    fn tell_possible(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(possible) = &self.possible else {
            return Ok(());
        };
        write!(f, "{possible}")?;
        let percents = self.relative_percent.iter();
        let percents = percents.zip(&possible.unconstrained_percent);
        let joints = self.joints.iter().zip(percents);
        let told: Vec<String> = joints
            .map(|(name, (with, without))| both_told(name, *with, *without))
            .collect();
        writeln!(
            f,
            "relative error of the possible arm (without the constraint): {}",
            told.join(", ")
        )
    }

    fn tell_outliers(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(outliers) = &self.outliers else {
            return Ok(());
        };
        let joints = self.joints.iter().zip(outliers);
        let told: Vec<String> = joints
            .map(|(name, count)| format!("{name} {count}"))
            .collect();
        writeln!(f, "outliers: {}", told.join(", "))?;
        if outliers.iter().any(|count| MANY * count > self.samples) {
            writeln!(
                f,
                "that is many, and they hardly affect the parameters; check them before you trust the rest"
            )?;
        }
        Ok(())
    }

    fn tell_combinations(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.unexcited.is_empty() {
            return Ok(());
        }
        if self.combinations.is_empty() {
            writeln!(
                f,
                "not separable: the logs do not excite these; the others are not affected"
            )?;
        } else {
            writeln!(
                f,
                "not separable: the logs determine these only in sums with others"
            )?;
        }
        tell_sums(f, &self.combinations)?;
        if self.possible.is_some() {
            writeln!(
                f,
                "for these the possible arm uses the values nearest to the nominal ones: `possible.standard` of `--json`"
            )?;
        }
        Ok(())
    }

    fn tell_essential(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(essential) = &self.essential else {
            return Ok(());
        };
        let (count, sums) = (essential.parameters.len(), essential.combinations.len());
        let of = self.parameters.len();
        let sums = match sums {
            0 => String::new(),
            1 => " and 1 sum of them".to_owned(),
            more => format!(" and {more} sums of them"),
        };
        writeln!(
            f,
            "essential: {count} of {of} parameters{sums}, significantly nonzero without all others"
        )?;
        let names = essential.parameters.iter().map(|p| p.name.len());
        let width = names.max().unwrap_or(0);
        for p in &essential.parameters {
            let relative = relative_deviation(p.value, p.std);
            writeln!(
                f,
                "  {:width$}  {:>12}  {:>10.2e}  {relative:>7}",
                p.name,
                table_value(p.value),
                p.std
            )?;
        }
        tell_sums(f, &essential.combinations)?;
        let joints = self.joints.iter().zip(&essential.relative_percent);
        let joints = joints.zip(&self.relative_percent);
        let told: Vec<String> = joints
            .map(|((name, alone), all)| both_told(name, *alone, *all))
            .collect();
        writeln!(
            f,
            "relative error with these alone (with all): {}",
            told.join(", ")
        )
    }
}

/// Two relative errors of a joint; one without rows has none.
fn both_told(joint: &str, one: f64, other: f64) -> String {
    if one > 0.0 || other > 0.0 {
        format!("{joint} {one:.2} ({other:.2}) %")
    } else {
        format!("{joint} -")
    }
}

fn tell_sums(f: &mut fmt::Formatter<'_>, sums: &[Combination]) -> fmt::Result {
    for sum in sums {
        let (value, std) = (table_value(sum.value), sum.std);
        writeln!(f, "  {sum} = {value} +- {std:.2e}")?;
    }
    Ok(())
}
