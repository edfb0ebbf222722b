//! Item by item: what was to come out, and what did.

use robot_model::identify::output_error::OutputEstimate;

use super::audit::{self, Rest, Told};
use super::equations::{Differences, LENGTHS};
use super::findings::bounds_of_text;
use super::model::{Arm, Model};
use super::search::Found;
use super::symbols;
use super::truth::{CAD, ESTIMATED, HEIGHTS, Height, Printed, RELEASES, STEP};
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
            self.cost_of_text(),
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
            "equations (3), (4) from energies and from DH frames, in symbols, and by numbers at 1000 states with Tables 2 and 6",
            "M, C, G",
            format!(
                "of {} printed terms less those of the compiler from energies {} are left, and {} from frames with the paper's constants in the \
                 place of standard parameters, at each of {} lengths l1, which settle what is of the second degree in it; largest difference {:.0e} \
                 and {:.0e} of the largest torque; {} base parameters: {}",
                symbols::PRINTED
                    .iter()
                    .map(|terms| terms.len())
                    .sum::<usize>(),
                own.left.iter().map(Vec::len).sum::<usize>(),
                own.left_of_chain.iter().map(Vec::len).sum::<usize>(),
                LENGTHS.len(),
                own.energies,
                own.chain,
                own.base.len(),
                own.base.join(", ")
            ),
            own.left.iter().chain(&own.left_of_chain).all(Vec::is_empty)
                && own.energies < ROUNDING
                && own.chain < ROUNDING
                && own.base == lumps,
            "the equations differ",
        )
    }

    fn cad(&self) -> Row {
        let nominal = self.model.constants.nominal();
        let of_spec: Vec<f64> = nominal.iter().copied().flatten().collect();
        let searches = self.found.means.iter().chain([&self.found.exact]);
        let searches: Vec<&OutputEstimate> = searches.collect();
        let from_cad = |estimate: &OutputEstimate| {
            let first = estimate.iterates.first();
            first.is_some_and(|first| first.values == CAD.values())
        };
        let there = searches.iter().filter(|one| from_cad(one)).count();
        Row::holds(
            "1.2",
            "Table 2 is where searches start",
            "11 values",
            format!(
                "{there} of {} searches start there; {} are nominal values of the spec",
                searches.len(),
                of_spec.len()
            ),
            of_spec == CAD.values()[..7] && there == searches.len(),
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
        let within = searches().filter(|one| audit::stays_within(one)).count();
        Row::holds(
            "1.4",
            "the trust region stays within the bounds of Table 5",
            "11 bounds",
            format!(
                "{within} of {} searches, with {steps} places in all, stay within; {} parameters end exactly on a bound",
                searches().count(),
                held.sum::<usize>()
            ),
            within == searches().count(),
            "a step leaves them",
        )
    }

    fn data(&self) -> Row {
        let pairs = self.found.batches.iter().zip(&HEIGHTS);
        let ends = pairs
            .clone()
            .flat_map(|(both, _)| both.iter().flat_map(|batch| &batch.ends));
        let releases = ends.clone().count();
        let moving = ends.filter(|stands| !**stands).count();
        let widest = |link: usize| -> Vec<String> {
            let batches = pairs.clone().map(|(batches, _)| {
                let band = batches[link].deviation.iter().map(|std| std[link]);
                format!("{:.2}", band.fold(0.0, f64::max).to_degrees())
            });
            batches.collect()
        };
        let itself = self.validations.iter().map(|own| own.itself);
        let itself = itself.fold(f64::INFINITY, f64::min);
        let samples: Vec<String> = HEIGHTS.map(|height| height.samples.to_string()).to_vec();
        Row::holds(
            "1.5",
            "20 releases a height and link, mean and band, box plots of initial angles (which are inputs of the simulation)",
            format!("K = {} at {} ms", samples.join(", "), 1e3 * STEP),
            format!(
                "the band is at most {} degrees (link 1), {} degrees (link 2) wide to a side; the arm let go where a mean starts fits it by \
                 {itself:.1} % or more; {moving} of {releases} arms have not quite come to rest after K samples",
                widest(0).join(", "),
                widest(1).join(", ")
            ),
            releases == 2 * HEIGHTS.len() * RELEASES && itself > 90.0,
            "the mean is not that of the arm",
        )
    }

    fn search(&self) -> Row {
        let searches = || self.found.means.iter().chain([&self.found.exact]);
        let own = self.last();
        let falling = searches().filter(|one| audit::falls(one)).count();
        let parts = own.iterates.last().map_or(0, |last| last.stage + 1);
        Row::holds(
            "1.6",
            "trust region of Algorithm 1: the cost falls from step to step, and parameters are traced (figures 31, 32)",
            "0, 2, 0.25, 0.25, 0.5",
            format!(
                "it falls in {falling} of {} searches; that of {} degrees has {} places in {parts} parts",
                searches().count(),
                HEIGHTS[HEIGHTS.len() - 1].angle,
                own.iterates.len()
            ),
            falling == searches().count() && own.iterates.len() > 2,
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
            format!(
                "both better after estimation in {} of {} cases",
                own.clone().filter(|own| is_less(own)).count(),
                own.len()
            ),
            own.len() == 8 && own.clone().all(is_less),
            "an error grows",
        )
    }

    fn link(&self, link: usize) -> Row {
        let own = self.validations.iter().filter(|own| own.link == link);
        let list = |value: fn(&Validation) -> f64, digits: usize| -> String {
            let values = own.clone().map(|own| format!("{:.digits$}", value(own)));
            values.collect::<Vec<_>>().join(", ")
        };
        let printed = |of: fn(&Height) -> &[Printed; 2]| {
            let fits = HEIGHTS
                .each_ref()
                .map(|height| of(height)[link].nrmse.to_string());
            fits.join(", ")
        };
        let is_found = own.clone().all(|own| own.exact_after >= 99.0);
        let is_cad = |own: &Validation| (54.0..=56.0).contains(&own.exact_before[1]);
        let worst = own
            .clone()
            .min_by(|one, other| one.before.nrmse.total_cmp(&other.before.nrmse));
        let worst = worst.map_or(String::new(), |own| {
            let [mean, cad] = own.ends();
            format!(
                "; furthest before from {} degrees, where the mean ends at {mean:.2} degrees and Table 2 stands at {cad:.2}, and with the dry \
                 friction of Table 6 in Table 2 the fit is {:.1} %",
                HEIGHTS[own.height].angle, own.before_by_dry
            )
        });
        Row::holds(
            ["1.8", "1.9"][link],
            format!(
                "link {}: NRMSE before and after, start at Table 2, Table 6 is measured",
                link + 1
            ),
            format!(
                "before {}, after {} %",
                printed(|height| &height.before),
                printed(|height| &height.after)
            ),
            format!(
                "means of 20: before {}, after {}; without noise: before {} of all and {} of the first 5 s, after {} %{}",
                list(|own| own.before.nrmse, 1),
                list(|own| own.after.nrmse, 1),
                list(|own| own.exact_before[0], 1),
                list(|own| own.exact_before[1], 1),
                list(|own| own.exact_after, 2),
                if link == 1 { worst } else { String::new() }
            ),
            is_found && (link > 0 || own.clone().all(is_cad)),
            "the search does not find the arm",
        )
    }
}
