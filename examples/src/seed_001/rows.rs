//! Item by item: what was to come out, and what did.

use robot_model::identify::output_error::OutputEstimate;

use super::audit::{self, Rest, Told};
use super::equations::Differences;
use super::findings::bounds_of_text;
use super::model::{Arm, Model};
use super::releases::BoxPlot;
use super::search::Found;
use super::truth::{CAD, ESTIMATED, HEIGHTS, STEP};
use super::validation::Validation;
use crate::paper::{Error, Row};

/// Differences of some hundred roundings.
const ROUNDING: f64 = 1e-13;

/// All that the program found.
pub struct Results {
    /// The arm of the paper.
    pub model: Model,
    /// By its constants.
    pub arm: Arm,
    /// Equations beside those of the paper.
    pub differences: Differences,
    /// Searches.
    pub found: Found,
    /// Models beside releases.
    pub validations: Vec<Validation>,
    /// What releases tell.
    pub told: Told,
    /// Where arms stand in the end.
    pub rests: Vec<Rest>,
}

impl Results {
    /// Every item.
    ///
    /// # Errors
    /// Those of the library, of which none are expected.
    pub fn rows(&self) -> Result<Vec<Row>, Error> {
        Ok(vec![
            self.equations(),
            self.cad(),
            self.friction_names()?,
            self.truth(),
            self.bounds(),
            bounds_of_text(),
            self.data(),
            self.search(),
            self.metrics(),
            self.metrics_of_text(),
            self.link(0),
            self.link(1),
            self.rank(),
            self.cost_of_text()?,
            self.friction(),
            self.rest(),
        ])
    }

    fn last(&self) -> &OutputEstimate {
        &self.found.means[HEIGHTS.len() - 1]
    }

    fn equations(&self) -> Row {
        let own = &self.differences;
        let lumps = ["I1r", "I2r", "m1*c1r", "m2*c2", "m2*l1*c2"];
        Row::holds(
            "1.1",
            "equations (3), (4) from energies and from DH frames, at 1000 states with Tables 2 and 6",
            "M, C, G",
            format!(
                "largest difference {:.0e} and {:.0e} of the largest torque; five base parameters: {}",
                own.energies,
                own.chain,
                own.base.join(", ")
            ),
            own.energies < ROUNDING && own.chain < ROUNDING && own.base == lumps,
            "the equations differ",
        )
    }

    fn cad(&self) -> Row {
        let nominal = self.model.constants.nominal();
        let of_spec: Vec<f64> = nominal.iter().copied().flatten().collect();
        let starts = self.found.means.iter().chain([&self.found.exact]);
        let from_cad = |estimate: &OutputEstimate| {
            let first = estimate.iterates.first();
            first.is_some_and(|first| first.values == CAD.values())
        };
        Row::holds(
            "1.2",
            "Table 2 is where searches start",
            "11 values",
            format!(
                "all five searches start there; {} are nominal values of the spec",
                of_spec.len()
            ),
            of_spec == CAD.values()[..7] && starts.into_iter().all(from_cad),
            "a search starts elsewhere",
        )
    }

    fn friction_names(&self) -> Result<Row, Error> {
        let right = audit::fit_of(&self.arm, &ESTIMATED)?;
        let exchanged = audit::fit_of(&self.arm, &audit::exchanged())?;
        Ok(Row::holds(
            "1.fc",
            "f_c is viscous and f_d dry friction: fit of Table 6 to its own releases so, and the other way round",
            "units of Table 2",
            format!(
                "{:.1} and {:.1} %; exchanged {:.1} and {:.1} %",
                right[0], right[1], exchanged[0], exchanged[1]
            ),
            right.iter().all(|fit| *fit > 99.9) && exchanged.iter().any(|fit| *fit < 90.0),
            "both readings move alike",
        ))
    }

    fn truth(&self) -> Row {
        let apart = self.validations.iter().map(|own| own.apart);
        let apart = apart.fold(0.0, f64::max);
        Row::holds(
            "1.3",
            "Table 6 as the arm that is let go: equations by hand beside the simulation of the spec, 8 releases",
            "11 values",
            format!("at most {apart:.0e} degrees apart"),
            apart < 1e-4,
            "the simulations differ",
        )
    }

    fn bounds(&self) -> Row {
        let searches = || self.found.means.iter().chain([&self.found.exact]);
        let steps: usize = searches().map(|estimate| estimate.iterates.len()).sum();
        let held = searches().map(|estimate| estimate.bound.len());
        Row::holds(
            "1.4",
            "the trust region stays within the bounds of Table 5",
            "11 bounds",
            format!(
                "all {steps} places of 5 searches; {} parameters end on a bound",
                held.sum::<usize>()
            ),
            searches().all(audit::stays_within),
            "a step leaves them",
        )
    }

    fn data(&self) -> Row {
        let batches = self.found.batches.iter().zip(&HEIGHTS);
        let same = |one: f64, other: f64| (one - other).abs() < 1e-9;
        let is_as_printed = batches.clone().all(|(batches, height)| {
            let links = batches.iter().zip(&height.starts);
            links.into_iter().all(|(batch, printed)| {
                let own = BoxPlot::new(&batch.starts);
                same(own.least, printed.least)
                    && same(own.most, printed.most)
                    && same(own.mode, printed.mode)
                    && batch.mean.len() == height.samples
            })
        });
        let widest = |link: usize| -> Vec<String> {
            let batches = batches.clone().map(|(batches, _)| {
                let band = batches[link].deviation.iter().map(|std| std[link]);
                format!("{:.2}", band.fold(0.0, f64::max).to_degrees())
            });
            batches.collect()
        };
        Row::holds(
            "1.5",
            "20 releases a height and link, mean and band; least, largest and most frequent initial angle",
            "K = 2100, 3182, 4546, 5028 at 5 ms",
            format!(
                "K as printed at {} ms; the band is at most {} degrees (link 1), {} degrees (link 2) wide to a side",
                1e3 * STEP,
                widest(0).join(", "),
                widest(1).join(", ")
            ),
            is_as_printed,
            "initial angles are others",
        )
    }

    fn search(&self) -> Row {
        let searches = || self.found.means.iter().chain([&self.found.exact]);
        let own = self.last();
        let parts = own.iterates.last().map_or(0, |last| last.stage + 1);
        Row::holds(
            "1.6",
            "trust region of Algorithm 1: the cost falls from step to step, and parameters are traced (figures 31, 32)",
            "0, 2, 0.25, 0.25, 0.5",
            format!(
                "it falls in all parts of 5 searches; that of 40 degrees has {} places in {parts} parts",
                own.iterates.len()
            ),
            searches().all(audit::falls) && own.iterates.len() > 2,
            "the cost rises",
        )
    }

    fn metrics(&self) -> Row {
        let own = self.validations.iter();
        let is_less =
            |own: &Validation| own.after.mae < own.before.mae && own.after.nrmse > own.before.nrmse;
        Row::holds(
            "1.7",
            "MAE (7) in degrees and NRMSE (8) in percent, by the library's distances",
            "both, each link and height",
            "both better after estimation in all eight cases",
            own.clone().count() == 8 && own.clone().all(is_less),
            "an error grows",
        )
    }

    fn link(&self, link: usize) -> Row {
        let own = self.validations.iter().filter(|own| own.link == link);
        let list = |value: fn(&Validation) -> f64, digits: usize| -> String {
            let values = own.clone().map(|own| format!("{:.digits$}", value(own)));
            values.collect::<Vec<_>>().join(", ")
        };
        let heights = HEIGHTS.iter();
        let printed = heights
            .map(|height| format!("{}", height.after[link].nrmse))
            .collect::<Vec<_>>();
        let is_found = own.clone().all(|own| own.exact_after >= 99.0);
        let is_cad = |own: &Validation| (54.0..=56.0).contains(&own.exact_before[1]);
        Row::holds(
            ["1.8", "1.9"][link],
            format!(
                "link {}: NRMSE before and after, start at Table 2, Table 6 is measured",
                link + 1
            ),
            format!("after {} %", printed.join(", ")),
            format!(
                "means of 20: before {}, after {}; without noise: before {} (first 5 s {}), after {} %",
                list(|own| own.before.nrmse, 1),
                list(|own| own.after.nrmse, 1),
                list(|own| own.exact_before[0], 1),
                list(|own| own.exact_before[1], 1),
                list(|own| own.exact_after, 2)
            ),
            is_found && (link > 0 || own.clone().all(is_cad)),
            "the search does not find the arm",
        )
    }
}
