//! What model (5.2) tells of its parameters: their ratios, and hardly their common factor; and what measured velocities in its input do.

use robot_model::identify::output_error::{Direction, Hold, OutputEstimate};

use super::data::{Data, synthesized};
use super::fits::{Fit, as_printed, with_free_start};
use super::law::Law;
use super::plant::{Experiment, VOLTS};
use super::truth::{ARM, BACK_EMF, TABLE_2};
use crate::paper::{Error, Table};

/// Where the voltage of short swings is switched, rad.
const SHORT_TURN: f64 = 0.2;

/// A fit of law (6.3), and what the tool says of its parameters.
#[derive(Debug, Clone)]
pub struct Told {
    /// What drives the simulated arm.
    pub input: &'static str,
    /// The fit.
    pub fit: Fit,
    /// What it found.
    pub found: OutputEstimate,
}

impl Told {
    fn new(input: &'static str, fit: Fit) -> Result<Self, Error> {
        let found = fit.found.clone()?;
        Ok(Self { input, fit, found })
    }

    /// `beta` over the arm's.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.found.values[1] / ARM[1]
    }

    /// `alpha` and `beta` over the mean of `c1` and `c2`, over the same of the arm.
    #[must_use]
    pub fn ratios(&self) -> [f64; 2] {
        let over = |x: &[f64], k: usize| 2.0 * x[k] / (x[2] + x[3]);
        [0, 1].map(|k| over(&self.found.values, k) / over(&ARM, k))
    }

    /// The direction that the tool says is told by little of the motion, where all four parameters are in it with one sign.
    #[must_use]
    pub fn common_factor(&self) -> Option<&Direction> {
        let frail = self.found.frail.as_ref()?;
        let is_common = frail.moves.len() == 4 && frail.moves.iter().all(|(_, share)| *share > 0.8);
        is_common.then_some(frail)
    }

    /// Condition of the sensitivities in shares of values, where that is of a common factor.
    #[must_use]
    pub fn condition(&self) -> Option<f64> {
        self.common_factor().map(|frail| 1.0 / frail.singular)
    }

    /// Condition of the sensitivities with columns of length 1, as `identify` prints it.
    #[must_use]
    pub fn condition_of_units(&self) -> f64 {
        let weakest = self.found.identifiability.singular.last();
        weakest.map_or(f64::NAN, |weakest| 1.0 / weakest)
    }
}

/// Fits of law (6.3) to the same positions, driven by the square wave held and as straight lines, and by the synthesized voltage; and to
/// those of an arm that swings to and fro about the upright. All of these have the start among their unknowns; `held_start` is the fit of
/// Table 2, whose start is held as in the paper.
///
/// # Errors
/// Where a search stops.
pub fn told(data: &Data, held_start: &Fit) -> Result<Vec<Told>, Error> {
    let start = TABLE_2[2][0].values;
    let fit = |data: &Data, drive: &[f64], hold: Hold| -> Result<Fit, Error> {
        let recording = data.driven_by(drive)?;
        Fit::of(Law::Directional, start, &recording, &with_free_start(hold))
    };
    // To and fro about the upright: in swings as short as that the inertia shows.
    let mut v = VOLTS;
    let quick = Experiment::under(2, |_, angle| {
        if angle.abs() > SHORT_TURN {
            v = -VOLTS * angle.signum();
        }
        v
    });
    let of_quick = Data {
        y: quick.y.clone(),
        ..data.clone()
    };
    Ok(vec![
        Told::new("square wave, held", fit(data, &data.wave, Hold::Sample)?)?,
        Told::new(
            "square wave, straight lines",
            fit(data, &data.wave, Hold::Mean)?,
        )?,
        Told::new(
            "u + 1.5 differences, held",
            fit(data, &data.synthesized, Hold::Sample)?,
        )?,
        Told::new(
            "square wave of short swings, held",
            fit(&of_quick, &quick.command, Hold::Sample)?,
        )?,
        Told::new("square wave, held; start held", held_start.clone())?,
    ])
}

/// The table of these fits.
#[must_use]
pub fn table(told: &[Told]) -> Table {
    let mut table = Table::new(
        format!(
            "Law (6.3) in model (5.2), start fitted but in the last line: alpha, beta, c1, c2 of the arm are {}",
            super::fits::listed(&ARM)
        ),
        [
            "input",
            "alpha, beta, c1, c2",
            "deviation of beta",
            "cost",
            "beta / true",
            "alpha/c, beta/c over true",
            "condition",
            "with unit columns",
        ],
    );
    for told in told {
        let [by_alpha, by_beta] = told.ratios();
        table.push([
            told.input.to_owned(),
            super::fits::listed(&told.found.values),
            told.found.std[1].map_or("none".to_owned(), |std| format!("{std:.2}")),
            super::fits::digits(told.fit.cost()),
            format!("{:.2}", told.factor()),
            format!("{by_alpha:.3}, {by_beta:.3}"),
            told.condition()
                .map_or("no common factor".to_owned(), |condition| {
                    format!("{condition:.0}")
                }),
            format!("{:.0}", told.condition_of_units()),
        ]);
    }
    table
}

/// Factors `k` that are tried for the velocity in the input, V s/rad.
pub const FACTORS: [f64; 4] = [1.5, 3.0, 6.0, 12.0];

/// Friction of law (6.1) that lies between that of both directions, 1/s.
fn mean_friction() -> f64 {
    0.5 * (ARM[2] + ARM[3]) - BACK_EMF * ARM[1]
}

/// Costs of the wrong law (6.1), none of whose parameters is fitted, with `v = u + k dy/dt` of measured positions.
///
/// # Errors
/// Where the simulated arm runs away.
pub fn costs_by_factor(data: &Data) -> Result<Vec<(f64, f64)>, Error> {
    let settings = as_printed(data, Hold::Sample);
    let costs = FACTORS.iter().map(|&k| {
        let recording = data.driven_by(&synthesized(&data.u, &data.velocity, k))?;
        let [alpha, beta] = [ARM[0], ARM[1]];
        let values = [alpha, beta, mean_friction() + beta * k];
        let plant = Law::Linear.plant(&values)?;
        let compared = settings.compare(&plant, &values, &[recording])?;
        let rmse = compared.position[0].rmse;
        Ok((k, rmse * rmse * data.window.len() as f64))
    });
    costs.collect()
}
