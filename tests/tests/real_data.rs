//! Measured logs of real machines against what their owners published, and what the trace finds on them.

use std::path::PathBuf;

use robot_model::columns::Candidate;
use robot_model::identify::{Errors, Estimate, Identify};
use robot_model::log::Log;
use robot_model::trace::{Finding, Outcome, Trace, Verdict};
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::compile_model;
use robot_model_tests::{shared, specs};

/// A machine: its spec's text, and its logs.
struct Machine {
    name: &'static str,
    text: String,
    dof: usize,
    folder: PathBuf,
}

/// An arm and what was identified with it.
struct Fit {
    arm: InterpretedArm,
    estimate: Estimate,
}

impl Machine {
    fn find(name: &'static str) -> Option<Self> {
        let folder = shared::find(
            &format!("data/{name}"),
            &format!("identification and trace on {name}"),
        )?;
        let spec = specs::named(&format!("run/{name}"));
        Some(Self {
            name,
            dof: spec.model().joints.len(),
            text: spec.text,
            folder,
        })
    }

    fn log(&self, file: &str) -> Log {
        Log::read(self.folder.join(file), self.dof).unwrap_or_else(|error| panic!("{error}"))
    }

    fn arm(&self, more: &str) -> InterpretedArm {
        let effects = "effects {\n";
        let text = self
            .text
            .replace(effects, &format!("{effects}        {more}\n"));
        let model = robot_model_spec::load(&format!("{}.robot", self.name), &text)
            .unwrap_or_else(|errors| panic!("{errors}"));
        InterpretedArm::new(compile_model(&model))
    }

    /// Identifies with `more` declared beside what the spec declares.
    fn fit(&self, more: &str) -> Fit {
        let arm = self.arm(more);
        let estimate = Identify::default()
            .fit(&arm, &[self.log("identification.csv")])
            .unwrap_or_else(|error| panic!("{error}"));
        Fit { arm, estimate }
    }

    fn trace(&self) -> Verdict {
        let arm = self.arm("");
        let candidates = arm.candidates();
        let candidates: Vec<&dyn Candidate> =
            candidates.iter().map(|c| c as &dyn Candidate).collect();
        Trace::new(candidates)
            .run(&arm, &[self.log("identification.csv")], &mut |_| ())
            .unwrap_or_else(|error| panic!("{error}"))
    }
}

impl Fit {
    fn value(&self, name: &str) -> f64 {
        let mut all = self.estimate.parameters.iter();
        let Some(found) = all.find(|parameter| parameter.name == name) else {
            panic!("no `{name}` in\n{}", self.estimate);
        };
        found.value
    }

    fn errors(&self, log: &Log) -> Errors {
        self.estimate
            .errors(&self.arm, log)
            .unwrap_or_else(|error| panic!("{error}"))
    }
}

#[track_caller]
fn assert_within_percent(what: &str, found: f64, published: f64, percent: f64) {
    let off = 100.0 * (found / published - 1.0);
    assert!(
        off.abs() <= percent,
        "{what}: {found}, published {published}: {off:+.2} %"
    );
}

#[track_caller]
fn assert_within(what: &str, found: f64, published: f64, tolerance: f64) {
    assert!(
        (found - published).abs() <= tolerance,
        "{what}: {found}, published {published}"
    );
}

/// The findings of a verdict, also where structure is left and they are only leads.
fn named(verdict: &Verdict) -> &[Finding] {
    if verdict.outcome == Outcome::Explained {
        &verdict.findings
    } else {
        &verdict.leads
    }
}

/// Published: M = 95.109 kg, Fv = 203.50 N s/m, Fc = 20.394 N, offset = -3.165 N with standard deviations of 0.11, 0.56, 0.50
/// and 1.40 %; relative error 4.08 %, on the pulses 5.98 %. Tolerances are about twice the larger deviations: filters and bands
/// differ, while an unmodeled tenth of any of the four would show.
#[test]
fn emps_is_identified_as_published() {
    let Some(emps) = Machine::find("emps") else {
        return;
    };
    let fit = emps.fit("");
    assert_within_percent("M", fit.value("load.m"), 95.109, 1.0);
    assert_within_percent("Fv", fit.value("carriage.viscous_friction.fv"), 203.50, 1.0);
    assert_within_percent("Fc", fit.value("carriage.coulomb_friction.fc"), 20.394, 1.0);
    assert_within_percent(
        "offset",
        fit.value("carriage.torque_offset.offset"),
        -3.165,
        3.0,
    );
    // Another decimation filter alone moves the error by 0.03 points.
    assert_within("error, %", fit.estimate.relative_percent[0], 4.08, 0.15);
    let pulses = fit.errors(&emps.log("validation_pulses.csv"));
    assert_within("error on pulses, %", pulses.relative_percent[0], 5.98, 0.15);
}

/// The authors of the data describe the asymmetry. With it, an independent fit has 3.2 % and 5.4 %.
#[test]
fn emps_lacks_a_friction_that_differs_between_directions() {
    let Some(emps) = Machine::find("emps") else {
        return;
    };
    let verdict = emps.trace();
    let found = named(&verdict);
    let first = found
        .first()
        .unwrap_or_else(|| panic!("nothing found: {verdict:?}"));
    assert!(
        ["asymmetric-viscous", "asymmetric-coulomb"].contains(&first.kind.as_str()),
        "{verdict:?}"
    );
    let fit = emps.fit(&format!("{} on carriage;", first.kind.replace('-', "_")));
    // The published model has four parameters for two directions, this one has two of them in common: 0.25 points for it.
    assert_within("error, %", fit.estimate.relative_percent[0], 3.2, 0.25);
    let pulses = fit.errors(&emps.log("validation_pulses.csv"));
    assert_within("error on pulses, %", pulses.relative_percent[0], 5.4, 0.25);
}

#[test]
fn tx40_lacks_the_coupling_of_its_wrist() {
    let Some(tx40) = Machine::find("tx40") else {
        return;
    };
    let verdict = tx40.trace();
    let first = named(&verdict)
        .first()
        .unwrap_or_else(|| panic!("nothing found: {verdict:?}"));
    assert_eq!(first.kind, "gear-coupling", "{verdict:?}");
    assert_eq!(first.joints, [4, 5], "{verdict:?}");
}

/// Published: Iam6 = 0.00964 kg m^2, fvm6 = 0.616 N m s/rad, fsm6 = 1.95 N m. Fits of other parts of the same log differ by a
/// tenth; 15 % leaves room for that and would not pass for another effect.
#[test]
fn tx40_with_the_coupling_is_as_published() {
    let Some(tx40) = Machine::find("tx40") else {
        return;
    };
    let validation = tx40.log("validation.csv");
    // Without the coupling joint 5's error is larger than its torque: other bands give 150 %, give or take.
    let before = tx40.fit("").errors(&validation).relative_percent[4];
    assert!((100.0..200.0).contains(&before), "before: {before} %");

    let fit = tx40.fit("gear_coupling on (joint5, joint6);");
    let after = fit.errors(&validation).relative_percent[4];
    assert!(after < 30.0, "after: {after} %");
    assert_within_percent("Iam6", fit.value("joint5.gear_coupling.ia"), 0.00964, 15.0);
    assert_within_percent("fvm6", fit.value("joint5.gear_coupling.fv"), 0.616, 15.0);
    assert_within_percent("fsm6", fit.value("joint5.gear_coupling.fc"), 1.95, 15.0);
}
