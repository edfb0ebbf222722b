//! `identify --report`: what was found, as a page with figures.

use std::path::{Path, PathBuf};

use robot_model::columns::Arm;
use robot_model::identify::{Combination, Errors, Estimate};
use robot_model::log::{Fault, Log};
use robot_model_codegen::Compiled;

use super::doubts;
use super::report::{Parameter, counted, identified, shares};
use crate::Error;
use crate::output::{WARNING, sentence, significant, unmarked};
use crate::report::{
    Bars, Drawn, Ink, Page, Shown, again, as_read, base_parameters, figures, parameters,
};

/// Joints whose figures are open from the start.
const OPEN: usize = 2;

/// What methods of identification have in common for those who look.
pub(super) struct Evidence<'a> {
    pub spec: &'a Path,
    pub compiled: &'a Compiled,
    pub parameters: Vec<Parameter<'a>>,
    pub combinations: &'a [Combination],
    /// Of torques, with what they are of; the last are of a log that was not fitted, if there is one.
    pub errors: Vec<(&'static str, &'a Errors)>,
    /// Torques and what they are set against.
    pub drawn: Option<OnLog<'a>>,
    /// What was noted of logs and of what was found.
    pub notes: Vec<String>,
    pub faults: &'a [(String, Fault)],
    /// What the program prints.
    pub printed: &'a str,
}

/// A model on a log.
pub(super) struct OnLog<'a> {
    pub arm: &'a dyn Arm,
    pub estimate: &'a Estimate,
    pub log: &'a Log,
    /// Which log this is.
    pub which: &'static str,
}

impl<'a> OnLog<'a> {
    /// On the validation log, if there is one, or else on the first of those that were.
    pub fn of(
        arm: &'a dyn Arm,
        estimate: &'a Estimate,
        fitted: &'a [Log],
        unseen: Option<&'a Log>,
    ) -> Option<Self> {
        let (log, which) = match unseen {
            Some(log) => (log, "the validation log"),
            None => (fitted.first()?, "the first fitted log"),
        };
        Some(Self {
            arm,
            estimate,
            log,
            which,
        })
    }
}

impl<'a> Evidence<'a> {
    /// What equations tell; not what it is drawn on, noted of it, or printed.
    pub fn of(
        spec: &'a Path,
        compiled: &'a Compiled,
        estimate: &'a Estimate,
        fitted: &'a Errors,
        unseen: Option<&'a Errors>,
    ) -> Self {
        let errors = std::iter::once(("fitted", fitted));
        Self {
            spec,
            compiled,
            parameters: identified(estimate),
            combinations: &estimate.combinations,
            errors: errors
                .chain(unseen.map(|errors| ("validation", errors)))
                .collect(),
            drawn: None,
            notes: Vec::new(),
            faults: &[],
            printed: "",
        }
    }

    /// The page, of files that were read, with the command that comes next.
    pub fn page(&self, inputs: &[PathBuf], next: Option<&str>) -> Result<String, Error> {
        let mut page = Page::new(
            &format!("Identification of {}", self.compiled.model.name),
            &format!(
                "Identification of the arm that {} describes.",
                self.spec.display()
            ),
        );
        page.section("Verdict");
        let (of_logs, of_result) = self.sorted_notes(inputs);
        self.verdict(&mut page, (&of_logs, &of_result), next);
        page.section("Errors");
        self.errors(&mut page);
        page.section("Torques and residuals");
        self.figures(&mut page)?;
        page.section("Parameters");
        parameters(&mut page, self.compiled, &self.parameters);
        self.combinations(&mut page);
        page.section("Base parameters");
        base_parameters(&mut page, self.compiled);
        page.section("Data");
        self.data(&mut page, &of_logs);
        page.section("Terminal output");
        page.preformatted(self.printed);
        again(&mut page, inputs)?;
        Ok(page.finish())
    }

    /// What is said of single files, and of what was found, which wants an answer first.
    fn sorted_notes(&self, inputs: &[PathBuf]) -> (Vec<String>, Vec<String>) {
        let plain = |note: &String| unmarked(note).to_owned();
        // What puts all in doubt is in the verdict itself.
        let notes = self.notes.iter();
        let (of_logs, of_result): (Vec<&String>, Vec<&String>) = notes
            .filter(|note| !note.starts_with(WARNING))
            .partition(|note| is_of_a_file(note, inputs) && !self.is_of_late_channels(note));
        // Of what is said of the model that said last puts most in doubt, and a page is read from its beginning.
        let (late, of_model): (Vec<&String>, Vec<&String>) = of_result
            .into_iter()
            .partition(|note| self.is_of_late_channels(note));
        let of_logs = of_logs.into_iter().map(plain).collect();
        let of_result = of_model.into_iter().rev().chain(late).map(plain).collect();
        (of_logs, of_result)
    }

    fn verdict(
        &self,
        page: &mut Page,
        (of_logs, of_result): (&[String], &[String]),
        next: Option<&str>,
    ) {
        let untold = self.parameters.iter().filter(|one| one.value.is_none());
        let untold = untold.count();
        let count = self.parameters.len();
        let is_ill = self.errors.iter().any(|(_, errors)| {
            let mut left = errors.relative_percent.iter();
            left.any(|percent| *percent > doubts::MUCH)
        });
        let warnings = self.notes.iter();
        let warnings = warnings.filter(|note| note.starts_with(WARNING));
        let warnings: Vec<String> = warnings.map(|note| sentence(unmarked(note))).collect();
        let is_as_meant = warnings.is_empty();
        let (class, word) = match (is_ill, untold, self.notes.is_empty()) {
            _ if !is_as_meant => ("open", "Units, signs and columns first"),
            (true, ..) => ("open", "The model does not fit"),
            (_, 0, true) => ("good", "Identified"),
            (_, 0, false) => ("known", "Identified, with notes"),
            _ => ("open", "Identified in part"),
        };
        let told = match untold {
            0 => format!("All {count} parameters are identified."),
            _ => format!("{untold} of {count} parameters are not identified."),
        };
        let left = self.errors.iter().filter_map(|(of, errors)| {
            let joint = worst(errors)?;
            let name = &self.compiled.model.joints[joint].name;
            let percent = errors.relative_percent[joint];
            Some(match errors.relative_percent.len() {
                1 => format!("Residual: {percent:.2} % of the torque of `{name}` ({of})."),
                _ => format!("Largest residual: {percent:.2} % of the torque of `{name}` ({of})."),
            })
        });
        let elsewhere = (!of_logs.is_empty())
            .then(|| "Notes on how files were read are under Data.".to_owned());
        let sentences = std::iter::once(told).chain(left).chain(elsewhere);
        let sentences: Vec<String> = warnings.into_iter().chain(sentences).collect();
        page.verdict(class, word, &sentences.join(" "));
        if !of_result.is_empty() {
            page.part("What to check");
            page.list(of_result);
        }
        if let Some(next) = next.filter(|_| is_as_meant) {
            page.part("Next");
            page.text(
                "Is the residual noise, or does the spec lack an effect? This command finds out:",
            );
            page.commands(next);
        }
    }

    /// Whether a note is of channels that are late, which only another log or spec mends.
    fn is_of_late_channels(&self, note: &str) -> bool {
        let late = self.faults.iter();
        let mut late = late.filter(|(_, fault)| matches!(fault, Fault::Late { .. }));
        late.any(|(log, fault)| note == format!("note: {log}: {fault}"))
    }

    fn errors(&self, page: &mut Page) {
        if self.errors.is_empty() {
            page.text("Torques from equations are missing: least squares finds no filters for these logs.");
            return;
        }
        self.bars(page);
        let heads = self.errors.iter().flat_map(|(of, _)| {
            ["RMSE", "MAE", "RMS%", "NRMSE fit"].map(|what| format!("{what}, {of}"))
        });
        let heads: Vec<String> = std::iter::once("joint".to_owned()).chain(heads).collect();
        let joints = self.compiled.model.joints.iter().enumerate();
        let rows = joints.map(|(j, joint)| {
            let told = |value: Option<f64>| value.map_or("-".to_owned(), |x| significant(x, 4));
            let percent =
                |value: Option<f64>| value.map_or("-".to_owned(), |x| format!("{x:.2} %"));
            let cells = self.errors.iter().flat_map(|(_, errors)| {
                [
                    told(counted(errors, &errors.rmse)[j]),
                    told(counted(errors, &errors.mae)[j]),
                    percent(shares(&errors.relative_percent)[j]),
                    percent(errors.nrmse_fit()[j]),
                ]
            });
            std::iter::once(joint.name.clone()).chain(cells).collect()
        });
        page.cards(
            "RMSE and MAE: root mean square and mean absolute error of the computed torque, in N m (prismatic joints: N). RMS%: residual \
             relative to the joint's torque, below the filters' cutoff. NRMSE fit: 100 % is exact, 0 % is no better than a constant. The \
             first and the last second do not count.",
            &heads.iter().map(String::as_str).collect::<Vec<_>>(),
            &rows.collect::<Vec<Vec<String>>>(),
        );
        if self.errors.len() == 1 {
            page.text("Give a validation log with --validate.");
        }
    }

    /// What is left of the torque of every joint.
    fn bars(&self, page: &mut Page) {
        // The model of the spec is in the same color as on a page of `trace`.
        const INKS: [(Ink, &str); 3] = [
            (Ink::Before, "before"),
            (Ink::Measured, "measured"),
            (Ink::After, "after"),
        ];
        let drawn = || self.errors.iter().zip(INKS);
        // Of a joint that stands nothing is known, and no bar is no error of zero.
        let is_known = |joint: &usize| {
            let mut all = drawn().map(|((_, errors), _)| errors.relative_percent[*joint]);
            all.any(|percent| percent > 0.0)
        };
        let joints = &self.compiled.model.joints;
        let known: Vec<usize> = (0..joints.len()).filter(is_known).collect();
        let joints: Vec<String> = known
            .iter()
            .map(|&joint| joints[joint].name.clone())
            .collect();
        let bars = Bars {
            label: "relative errors of every joint",
            x: "relative error, %",
            joints: &joints,
            models: drawn()
                .map(|((_, errors), (ink, _))| {
                    let percent = known.iter().map(|&joint| errors.relative_percent[joint]);
                    (ink, percent.collect())
                })
                .collect(),
        };
        let legend = drawn().map(|((of, _), (_, color))| (color, *of));
        page.figures(
            &[bars.svg()],
            &legend.collect::<Vec<_>>(),
            "Residual relative to the joint's torque, below the cutoff of the filters (RMS% of the table).",
        );
    }

    fn figures(&self, page: &mut Page) -> Result<(), Error> {
        let Some(OnLog {
            arm,
            estimate,
            log,
            which,
        }) = self.drawn
        else {
            page.text("No log to draw: the fitted logs were read piece by piece. Give --validate.");
            return Ok(());
        };
        page.text(&format!("On {which}, {}.", log.source));
        let shown = Shown {
            color: Ink::Before,
            arm,
            estimate,
        };
        let drawn = Drawn::new(&self.compiled.model, &[shown], log)?;
        // Those of which most is left.
        let left = &estimate.relative_percent;
        let mut worst: Vec<usize> = (0..arm.dof()).collect();
        worst.sort_by(|a, b| left[*b].total_cmp(&left[*a]));
        worst.truncate(OPEN);
        figures(
            page,
            arm.joints(),
            &drawn,
            &[("before", "model")],
            &|joint| worst.contains(&joint),
        );
        Ok(())
    }

    fn combinations(&self, page: &mut Page) {
        if self.combinations.is_empty() {
            return;
        }
        let rows = self.combinations.iter().map(|sum| {
            vec![
                sum.to_string(),
                significant(sum.value, 5),
                significant(sum.std, 3),
            ]
        });
        page.table(
            "Parameters that are not identified alone",
            &["sum", "value", "deviation"],
            &rows.collect::<Vec<_>>(),
        );
    }

    fn data(&self, page: &mut Page, of_logs: &[String]) {
        as_read(page, of_logs);
        if self.faults.is_empty() {
            page.text("No fault was found in the logs.");
            return;
        }
        let rows = self.faults.iter().map(|(log, fault)| {
            vec![
                log.clone(),
                fault.kind().to_owned(),
                fault.channel().to_owned(),
                fault.to_string(),
            ]
        });
        page.table(
            "Faults of the logs, repaired if possible",
            &["log", "kind", "channel", "what was found"],
            &rows.collect::<Vec<_>>(),
        );
    }
}

/// The joint of which most is left; none where nothing is told of any.
fn worst(errors: &Errors) -> Option<usize> {
    let told = |joint: &usize| errors.relative_percent[*joint] > 0.0;
    let joints = (0..errors.relative_percent.len()).filter(told);
    joints.max_by(|&a, &b| errors.relative_percent[a].total_cmp(&errors.relative_percent[b]))
}

/// Whether a note is of one file: it begins with its name.
fn is_of_a_file(note: &str, files: &[PathBuf]) -> bool {
    let note = unmarked(note);
    let mut names = files.iter().map(|path| path.display().to_string());
    names.any(|name| {
        note.strip_prefix(&name)
            .is_some_and(|rest| rest.starts_with([':', ' ']))
    })
}
