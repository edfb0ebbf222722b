//! `identify --payload`: what the arm carries in some of its logs.

use std::path::{Path, PathBuf};

use robot_model::identify::{Carried, Errors, Estimate, Identify, KnownPayload, Method};
use robot_model::log::{Fault, Log};
use serde::Serialize;

use super::fit::{ByAcceleration, Fit, errors_of_all};
use super::noted::told_apart;
use super::page::{Evidence, OnLog};
use super::report::{Parameter, Report, counted, report, shares};
use super::results::Results;
use super::table::table;
use super::{IdentifyArguments, doubts, leftover, twice};
use crate::Error;
use crate::output::Files;
use crate::progress::Progress;

/// What `--json` writes: the keys of all methods for the arm alone, and these.
#[derive(Serialize)]
pub(super) struct PayloadReport<'a> {
    #[serde(flatten)]
    arm: Report<'a>,
    pub payload: Body<'a>,
}

/// The payload as far as the logs tell.
#[derive(Serialize)]
pub(super) struct Body<'a> {
    link: &'a str,
    /// About the origin of the link's frame.
    parameters: Vec<Parameter<'a>>,
    /// kg, and its standard deviation.
    mass: Option<f64>,
    mass_std: Option<f64>,
    /// In the link's frame, m, and its standard deviations.
    center: [Option<f64>; 3],
    center_std: [Option<f64>; 3],
    /// Of logs with it.
    rmse: Vec<Option<f64>>,
    relative_percent: Vec<Option<f64>>,
}

impl Body<'_> {
    /// Puts what is known of the body in the place of what was found.
    pub fn know(&mut self, mass: f64, center: [Option<f64>; 3], center_std: [Option<f64>; 3]) {
        (self.mass, self.center, self.center_std) = (Some(mass), center, center_std);
    }
}

/// Logs of `identify --payload`, and what was found in them.
pub(super) struct Logs {
    pub unloaded: Vec<Log>,
    pub loaded: Vec<Log>,
    pub validate: Option<Log>,
    pub faults: Vec<(String, Fault)>,
}

impl IdentifyArguments {
    /// The arm from the logs, what it carries from those of `--payload`, and the gains of its drives where the payload's mass is known.
    pub(super) fn with_payload(&self, form: &ByAcceleration, method: Method) -> Result<(), Error> {
        let inputs = std::iter::once(&self.spec)
            .chain(&self.logs)
            .chain(&self.payload)
            .chain(&self.validate);
        let mut files = Files::reading(inputs.map(PathBuf::as_path)).and(self.settings_files());
        let results = Results::claim(&mut files, self)?;
        if let Some([loaded, unloaded]) = twice::with_and_without(&self.logs, &self.payload) {
            return Err(Error::Argument(format!(
                "--payload: {} is the same log as {}, which has no payload: give a log of the arm with the payload",
                loaded.display(),
                unloaded.display()
            )));
        }
        let progress = Progress::new();
        let mut faults = Vec::new();
        let mut read = |path: &PathBuf| self.log(path, form, &mut faults, &progress);
        let unloaded = self.logs.iter().map(&mut read).collect::<Result<_, _>>()?;
        let loaded = self.payload.iter().map(&mut read);
        let loaded = loaded.collect::<Result<_, _>>()?;
        let validate = self.validate.as_ref().map(read).transpose()?;
        let logs = Logs {
            unloaded,
            loaded,
            validate,
            faults,
        };
        let identify = self.asked(method);
        progress.step("identifying");
        match self.payload_mass {
            None => self.carried(form, &identify, &logs, results, progress),
            Some(mass) => {
                let center = self.payload_center;
                let known = KnownPayload { mass, center };
                self.drive_gains(form, &identify, logs, &known, results, progress)
            }
        }
    }

    fn carried(
        &self,
        form: &ByAcceleration,
        identify: &Identify,
        logs: &Logs,
        results: Results,
        progress: Progress,
    ) -> Result<(), Error> {
        let link = self.payload_link.as_deref();
        let found = identify.fit_payload(&form.0, &logs.unloaded, &logs.loaded, link)?;
        let judged = self.judged(form, &found, logs, &progress)?;
        if let Some(doubt) = negative(&found) {
            progress.doubts([doubt]);
        }
        let arm = of_arm(&found, &judged.train);
        let printed = format!(
            "{}{}\n{}",
            found.estimate,
            told(&found),
            judged.table(&found.estimate)
        );
        let evidence = Evidence {
            notes: progress.noted(),
            printed: &printed,
            ..judged.evidence(&self.spec, form, &arm, &found, logs)
        };
        results.give(&judged.report(&arm, &found), &evidence, progress)
    }

    /// Errors of an arm and its payload; that the arm's parameters are told.
    pub(super) fn judged(
        &self,
        form: &ByAcceleration,
        found: &Carried,
        logs: &Logs,
        progress: &Progress,
    ) -> Result<Judged, Error> {
        let own: Vec<&str> = found.payload().iter().map(|p| p.name.as_str()).collect();
        // What no motion tells of a payload is no fault of the logs.
        let is_of_arm = |name: &String| !own.contains(&name.as_str());
        if !self.partial && found.estimate.unexcited.iter().any(is_of_arm) {
            told_apart(&found.estimate)?;
        }
        let all = [logs.unloaded.as_slice(), &logs.loaded].concat();
        let doubts = [
            doubts::negative(&found.estimate, form.unknowns()),
            doubts::hardly_apart(&found.estimate, form.model(), &all),
        ];
        let mut explained = doubts::explained(&found.estimate, None);
        if explained.is_empty() {
            explained.extend(leftover::doubt(&found.estimate));
        }
        explained.extend(doubts::at_ends(&found.estimate.shapes, form.shapes()));
        let fitted = [self.logs.as_slice(), &self.payload].concat();
        let same = twice::doubts(&fitted, self.validate.as_deref());
        let same = same.into_iter();
        progress.doubts(same.chain(doubts.into_iter().flatten()).chain(explained));
        let validation = logs.validate.as_ref();
        let validation = validation.map(|log| form.errors(&found.loaded, log));
        let mut faults = logs.faults.clone();
        faults.extend(self.late_channels(&found.estimate, progress));
        Ok(Judged {
            faults,
            train: errors_of_all(&found.estimate, form, &logs.unloaded)?,
            carrying: errors_of_all(&found.loaded, form, &logs.loaded)?,
            validation: validation.transpose()?,
        })
    }
}

/// Errors of an arm without and with its payload.
pub(super) struct Judged {
    pub train: Errors,
    carrying: Errors,
    validation: Option<Errors>,
    /// Of the logs, late torques among them.
    faults: Vec<(String, Fault)>,
}

impl Judged {
    /// What `--json` writes; `arm` is [`of_arm`].
    pub(super) fn report<'a>(&'a self, arm: &'a Estimate, found: &'a Carried) -> PayloadReport<'a> {
        let (mass, center) = found.mass_and_center();
        PayloadReport {
            arm: report(
                arm,
                Some(&self.train),
                self.validation.as_ref(),
                &self.faults,
            ),
            payload: Body {
                link: &found.link,
                parameters: parameters(found),
                mass: mass.map(|[mass, _]| mass),
                mass_std: mass.map(|[_, std]| std),
                center: center.map(|place| place.map(|[place, _]| place)),
                center_std: center.map(|place| place.map(|[_, std]| std)),
                rmse: counted(&self.carrying, &self.carrying.rmse),
                relative_percent: shares(&self.carrying.relative_percent),
            },
        }
    }

    /// What a page shows of it; not what is noted or printed.
    pub(super) fn evidence<'a>(
        &'a self,
        spec: &'a Path,
        form: &'a ByAcceleration,
        arm: &'a Estimate,
        found: &'a Carried,
        logs: &'a Logs,
    ) -> Evidence<'a> {
        let drawn = match &logs.validate {
            Some(_) => &found.loaded,
            None => arm,
        };
        let mut evidence = Evidence::of(spec, form.compiled(), arm, &self.train, None);
        evidence.parameters.extend(parameters(found));
        evidence.errors = self.errors();
        evidence.drawn = OnLog::of(&form.0, drawn, &logs.unloaded, logs.validate.as_ref());
        evidence.faults = &self.faults;
        evidence
    }

    fn errors(&self) -> Vec<(&'static str, &Errors)> {
        let both = [
            ("without payload", &self.train),
            ("with payload", &self.carrying),
        ];
        let validation = self.validation.as_ref();
        let validation = validation.map(|errors| ("validation, with the payload", errors));
        both.into_iter().chain(validation).collect()
    }

    /// Errors side by side.
    pub(super) fn table(&self, estimate: &Estimate) -> String {
        table(estimate, &self.errors())
    }
}

/// The estimate of the arm alone.
pub(super) fn of_arm(found: &Carried, errors: &Errors) -> Estimate {
    let mut arm = found.estimate.clone();
    arm.relative_percent.clone_from(&errors.relative_percent);
    arm.parameters.truncate(found.loaded.parameters.len());
    let is_own = |name: &String| found.payload().iter().any(|p| p.name == *name);
    arm.unexcited.retain(|name| !is_own(name));
    arm.rank = arm.parameters.len() - arm.unexcited.len();
    arm
}

/// What the logs tell of the payload.
fn parameters(found: &Carried) -> Vec<Parameter<'_>> {
    let own = found.payload().iter().map(|parameter| {
        let is_told = found.estimate.is_separated(&parameter.name);
        Parameter {
            name: &parameter.name,
            value: is_told.then_some(parameter.value),
            std: is_told.then_some(parameter.std),
            interval: None,
        }
    });
    own.collect()
}

/// The body in a sentence.
fn told(found: &Carried) -> String {
    let (mass, center) = found.mass_and_center();
    let Some([mass, std]) = mass else {
        return format!("payload on {}: its mass is not identified\n", found.link);
    };
    let axes = ["x", "y", "z"].into_iter().zip(center);
    let places = axes.map(|(axis, place)| match place {
        Some([place, std]) => format!("{axis} {place:.4} m +- {std:.1e}"),
        None => format!("{axis} not identified"),
    });
    let places: Vec<String> = places.collect();
    format!(
        "payload on {}: {mass:.4} kg +- {std:.2e}, its center of mass in the link's frame: {}\n",
        found.link,
        places.join(", ")
    )
}

/// A payload below nothing.
fn negative(found: &Carried) -> Option<String> {
    let [mass, std] = found.mass_and_center().0?;
    (mass < -3.0 * std).then(|| {
        format!(
            "the payload on {} is {mass:.4} kg: are the logs with and without it swapped?",
            found.link
        )
    })
}
