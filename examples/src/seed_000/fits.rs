//! Fits of the three laws to the same data, and Tables 1 and 2.

use robot_model::identify::output_error::{
    Hold, Iterate, OutputError, OutputErrorError, OutputEstimate, Recording,
};

use super::data::Data;
use super::law::{LAWS, Law};
use super::truth::{Line, TABLE_1, TABLE_2};
use crate::paper::{Error, Table, rounded};

/// Iterations at most: the paper's longest search has 14.
pub(super) const ITERATIONS: usize = 20;

/// What came of a law.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The law.
    pub law: Law,
    /// The way of the search.
    pub iterates: Vec<Iterate>,
    /// Where it led; an error where the simulated arm runs away.
    pub found: Result<OutputEstimate, OutputErrorError>,
}

/// `J` of equation (3.1), without the half of the tool's.
#[must_use]
pub fn cost(iterate: &Iterate) -> f64 {
    2.0 * iterate.cost
}

/// `alpha`, `beta` and constants of friction, with the digits of the tables.
#[must_use]
pub fn listed(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| format!("{value:.2}")).collect();
    values.join(", ")
}

/// A cost with three digits.
#[must_use]
pub fn digits(cost: f64) -> String {
    match cost {
        1000.0.. => {
            let unit = 10_f64.powf(cost.log10().floor() - 2.0);
            format!("{:.0}.", rounded(cost, unit))
        }
        100.0.. => format!("{cost:.0}."),
        1.0.. => format!("{cost:.2}"),
        0.01.. => format!("{cost:.3}"),
        _ => format!("{cost:.5}"),
    }
}

impl Fit {
    /// A law from a start, on a recording.
    ///
    /// # Errors
    /// Mistakes of the spec; what stops a search is a result.
    pub fn of(
        law: Law,
        start: &[f64],
        recording: &Recording,
        settings: &OutputError,
    ) -> Result<Self, Error> {
        let names: Vec<String> = law.parameters().iter().map(|&x| x.to_owned()).collect();
        let mut iterates = Vec::new();
        let recordings = std::slice::from_ref(recording);
        let note = &mut |iterate: &Iterate| iterates.push(iterate.clone());
        let found = settings.fit(&law.plant(start)?, &names, start, recordings, note);
        Ok(Self {
            law,
            iterates,
            found,
        })
    }

    /// The three laws on one recording, each from the first line of its table.
    ///
    /// # Errors
    /// As [`Fit::of`].
    pub fn all(
        lines: [&[Line]; 3],
        recording: &Recording,
        settings: &OutputError,
    ) -> Result<Vec<Self>, Error> {
        let laws = LAWS.into_iter().zip(lines);
        let fits = laws.map(|(law, lines)| Self::of(law, lines[0].values, recording, settings));
        fits.collect()
    }

    /// The least cost; infinite where the search has not begun.
    #[must_use]
    pub fn cost(&self) -> f64 {
        self.iterates.last().map_or(f64::INFINITY, cost)
    }

    /// How many iterates it takes to come within twice the last cost.
    #[must_use]
    pub fn steps(&self) -> usize {
        let near = |iterate: &Iterate| cost(iterate) <= 2.0 * self.cost();
        self.iterates.iter().position(near).unwrap_or(usize::MAX)
    }

    /// The last values.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        self.iterates.last().map_or(&[], |last| &last.values)
    }

    /// Printed and own iterates side by side.
    #[must_use]
    pub fn table(&self, title: &str, lines: &[Line]) -> Table {
        let words = self.law.parameters().join(", ");
        let mut table = Table::new(
            format!("{title}, {}: {words}", self.law.name()),
            ["iterate", "printed", "cost", "here", "cost here"],
        );
        let last = self.iterates.len().saturating_sub(1);
        let longest = lines.last().map_or(0, |line| line.iterate as usize);
        for k in 0..=longest.max(last) {
            let line = lines.iter().find(|line| line.iterate as usize == k);
            let own = self.iterates.get(k);
            // The paper leaves out some; so do we, but the last.
            if line.is_none() && (k > longest || lines.len() <= longest) && k != last {
                continue;
            }
            table.push([
                k.to_string(),
                line.map_or(String::new(), |line| listed(line.values)),
                line.map_or(String::new(), |line| digits(line.cost)),
                own.map_or(String::new(), |own| listed(&own.values)),
                own.map_or(String::new(), |own| digits(cost(own))),
            ]);
        }
        table
    }
}

/// Fits of both models.
#[derive(Debug, Clone)]
pub struct Tables {
    /// Model (5.1): the measured voltage drives the arm.
    pub first: Vec<Fit>,
    /// Model (5.2): the commanded voltage does.
    pub second: Vec<Fit>,
    /// Law (6.3) in model (5.2) with the start fitted too.
    pub free: Fit,
    /// Law (6.3) in model (5.1), in windows of a second.
    pub windowed: Fit,
}

/// The settings of the paper: whole stretches from a start that is held, at the measured position and its difference.
#[must_use]
pub fn as_printed(data: &Data, hold: Hold) -> OutputError {
    OutputError {
        hold: Some(hold),
        held_starts: Some(vec![data.start().to_vec()]),
        iterations: Some(ITERATIONS),
        ..OutputError::default()
    }
}

/// The same with the start among the unknowns.
#[must_use]
pub fn with_free_start(hold: Hold) -> OutputError {
    OutputError {
        hold: Some(hold),
        iterations: Some(ITERATIONS),
        ..OutputError::default()
    }
}

impl Tables {
    /// Fits all.
    ///
    /// # Errors
    /// As [`Fit::of`].
    pub fn of(data: &Data) -> Result<Self, Error> {
        let (measured, commanded) = (data.driven_by(&data.u)?, data.driven_by(&data.wave)?);
        let directional = LAWS[2];
        let in_windows = OutputError {
            window: Some(1.0),
            ..with_free_start(Hold::Mean)
        };
        Ok(Self {
            first: Fit::all(TABLE_1, &measured, &as_printed(data, Hold::Mean))?,
            second: Fit::all(TABLE_2, &commanded, &as_printed(data, Hold::Sample))?,
            free: Fit::of(
                directional,
                TABLE_2[2][0].values,
                &commanded,
                &with_free_start(Hold::Sample),
            )?,
            windowed: Fit::of(directional, TABLE_1[2][0].values, &measured, &in_windows)?,
        })
    }

    /// Both tables beside the printed ones.
    #[must_use]
    pub fn beside(&self) -> Vec<Table> {
        let first = self.first.iter().zip(TABLE_1);
        // The upright arm multiplies rounding, which differs from machine to machine.
        let first = first.map(|(fit, lines)| fit.table("Table 1, model (5.1)", lines).rough());
        let second = self.second.iter().zip(TABLE_2);
        let second = second.map(|(fit, lines)| fit.table("Table 2, model (5.2)", lines));
        first.chain(second).collect()
    }
}
