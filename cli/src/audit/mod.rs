//! `robot-model audit`: whether an arm can have given parameters; [`audit`] asks the same of values in memory.

mod against;
mod base;
mod bodies;
mod drives;
mod friction;
mod inertia;
mod jumps;
mod memory;
mod signs;
mod workspace;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use robot_model_codegen::Compiled;
use serde::Serialize;

use crate::output::{self, Content, Files, Record, counted, names};
use crate::parameters::{self, Beside, Values};
use crate::{Error, json, spec};

use against::Source;
pub use base::Sums;

/// Check whether parameters are physically possible: bodies, signs, mass matrix in the workspace, friction over speed, torque limits, rank.
///
/// Exit code 1 if a check fails; the report is written anyway.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model audit arm.robot --parameters fit.json
  robot-model audit arm.robot --parameters monday.json --against tuesday.json
  robot-model audit arm.robot --base paper.json")]
pub(crate) struct Audit {
    /// The `.robot` file. Position limits are the workspace, velocity limits the speeds.
    spec: PathBuf,
    /// Parameter values by name, or what `identify --json` writes; without it the spec's own values.
    #[arg(long, value_name = "FILE.json")]
    parameters: Option<PathBuf>,
    /// Base parameters of another source, `{"NAME": {"STANDARD PARAMETER": FACTOR, ..}, ..}`: check that they are base parameters of this
    /// arm. Alone it needs no parameter values, and checks nothing else.
    #[arg(long, value_name = "FILE.json")]
    base: Option<PathBuf>,
    /// Parameters of another source, in a form of `--parameters`: check that both agree.
    #[arg(long, value_name = "FILE.json")]
    against: Option<PathBuf>,
    /// Write the result as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// What `--json` writes; a contract.
#[derive(Serialize)]
struct Report<'a> {
    robot: &'a str,
    passed: bool,
    checks: Vec<Check>,
}

/// One question, and what speaks against it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Check {
    /// `bodies`, `signs`, `inertia`, `friction`, `jumps`, `memory`, `drives`, `rank`, `against`, `base`.
    pub name: &'static str,
    /// None where it was not decided.
    pub passed: Option<bool>,
    /// What was looked at.
    pub scope: String,
    /// What is wrong; of `rank` what cannot be known, of `bodies` and `signs` that passed what deviations of the file leave open.
    pub findings: Vec<String>,
    /// The numbers that these sentences say, unrounded.
    pub quantities: Vec<Quantity>,
}

/// A number of a [`Check`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Quantity {
    /// `mass`, `least_second_moment`, `nearest`, `deviations` (bodies); `value`, `deviations` (signs); `least_eigenvalue`, `position` (inertia); `driven_from`, `power`
    /// (friction); `jump`, `at` (jumps); `work` (memory); `friction`, `at_rest`, `largest_torque` (drives); `base_parameters`, `parameters`
    /// (rank); `value`, `other`, `apart`, `std` (against); `factor`, `needed`, `independent`, `base_parameters` (base).
    pub what: &'static str,
    /// The link, joint or parameter that it is of; none where it is of the whole arm.
    pub of: Option<String>,
    /// In SI units.
    pub value: f64,
    /// Of the value; empty where it has none or the spec's parameter says it.
    pub unit: &'static str,
}

impl Quantity {
    fn of(what: &'static str, of: &str, value: f64, unit: &'static str) -> Self {
        Self {
            of: Some(of.to_owned()),
            ..Self::of_all(what, value, unit)
        }
    }

    fn of_all(what: &'static str, value: f64, unit: &'static str) -> Self {
        Self {
            what,
            of: None,
            value,
            unit,
        }
    }
}

/// Deviations that a value of a file may miss what is possible by: chance, not a value that is wrong.
const MISSED: f64 = 2.0;

/// A sentence and the numbers in it.
type Finding = (String, Vec<Quantity>);

/// All checks of an arm with parameters by name, standard or all base parameters; nominal values of the spec for those that are
/// not given.
///
/// # Errors
/// [`Error`] where a name is not the arm's, or a parameter has no value.
pub fn audit(compiled: &Compiled, parameters: &BTreeMap<String, f64>) -> Result<Vec<Check>, Error> {
    let values = parameters::by_name(compiled, parameters)?;
    Ok(checks(compiled, &values, &[]))
}

/// Whether two sources, each with parameters by name as [`audit`] takes them, say the same of what torques tell: the check `against`.
///
/// # Errors
/// As [`audit`].
pub fn against(
    compiled: &Compiled,
    one: &BTreeMap<String, f64>,
    other: &BTreeMap<String, f64>,
) -> Result<Check, Error> {
    let source = |given| {
        Ok::<_, Error>(Source {
            values: parameters::by_name(compiled, given)?,
            sureness: parameters::Sureness::default(),
        })
    };
    Ok(against::check(compiled, &[source(one)?, source(other)?]))
}

/// Whether sums of standard parameters are base parameters of an arm, as a paper or another program has them: the check `base`.
///
/// # Errors
/// [`Error`] where a part of a sum is no standard parameter of the arm's, or its factor no number.
pub fn base(compiled: &Compiled, sums: &Sums) -> Result<Check, Error> {
    base::check(compiled, sums)
}

/// What is wrong with the inertia of an arm with these base parameters and shapes: why it runs away when it is simulated.
pub(crate) fn inertia_of(compiled: &Compiled, beta: &[f64], shapes: &[f64]) -> Option<String> {
    let check = inertia::check(compiled, &compiled.parameter_values(beta), shapes);
    check.findings.into_iter().next()
}

fn checks(compiled: &Compiled, values: &Values, deviations: &[Option<f64>]) -> Vec<Check> {
    let all = [
        bodies::check(compiled, values, deviations),
        Some(signs::check(compiled, values, deviations)),
        Some(inertia::check(compiled, &values.parameters, &values.shapes)),
        Some(friction::check(compiled, values)),
        Some(jumps::check(compiled, values)),
        memory::check(compiled, values),
        drives::check(compiled, values),
        Some(rank(compiled)),
    ];
    all.into_iter().flatten().collect()
}

impl Check {
    fn new(name: &'static str, scope: String, findings: Vec<Finding>) -> Self {
        let (findings, quantities): (Vec<String>, Vec<Vec<Quantity>>) =
            findings.into_iter().unzip();
        Self {
            name,
            passed: Some(findings.is_empty()),
            scope,
            findings,
            quantities: quantities.into_iter().flatten().collect(),
        }
    }

    /// Passed, with what is remarkable all the same.
    fn noted(name: &'static str, scope: String, findings: Vec<Finding>) -> Self {
        Self {
            passed: Some(true),
            ..Self::new(name, scope, findings)
        }
    }

    fn undecided(name: &'static str, scope: String, reason: &str) -> Self {
        Self {
            name,
            passed: None,
            scope,
            findings: vec![reason.to_owned()],
            quantities: Vec::new(),
        }
    }

    /// The number of this kind, of a link, joint or parameter or of the whole arm.
    #[must_use]
    pub fn quantity(&self, what: &str, of: Option<&str>) -> Option<f64> {
        let mut quantities = self.quantities.iter();
        let found = quantities.find(|one| one.what == what && one.of.as_deref() == of)?;
        Some(found.value)
    }
}

impl Audit {
    /// What is audited beside another file.
    fn beside(&self, compiled: &Compiled, values: Values, other: &Path) -> Result<Check, Error> {
        let own = self.parameters.as_deref().map(parameters::sureness);
        let own = Source {
            values,
            sureness: own.transpose()?.unwrap_or_default(),
        };
        let other = Source {
            values: values_of(compiled, Some(other))?.0,
            sureness: parameters::sureness(other)?,
        };
        Ok(against::check(compiled, &[own, other]))
    }

    pub(crate) fn run(&self) -> Result<(), Error> {
        let inputs = [
            Some(&self.spec),
            self.parameters.as_ref(),
            self.base.as_ref(),
            self.against.as_ref(),
        ];
        let inputs = inputs.into_iter().flatten().map(PathBuf::as_path);
        let json =
            Files::reading(inputs).claim_if(self.json.as_deref(), Content::Json(Record::Audit))?;
        let compiled = spec::compile(&self.spec)?;
        let (mut checks, mut source) = (Vec::new(), None);
        if self.base.is_none() || self.parameters.is_some() || self.against.is_some() {
            let (values, of) = values_of(&compiled, self.parameters.as_deref())?;
            let deviations = self.parameters.as_deref();
            let deviations = deviations.map(|file| parameters::deviations(&compiled, file));
            let deviations = deviations.transpose()?.unwrap_or_default();
            checks = self::checks(&compiled, &values, &deviations);
            source = Some(of);
            if let Some(other) = &self.against {
                checks.push(self.beside(&compiled, values, other)?);
            }
        }
        if let Some(path) = &self.base {
            checks.push(base::check(&compiled, &sums(path)?)?);
        }
        let source = source.or_else(|| Some(self.base.as_ref()?.display().to_string()));
        let source = source.unwrap_or_default();
        let failed = checks
            .iter()
            .filter(|check| check.passed == Some(false))
            .count();
        let report = Report {
            robot: &compiled.model.name,
            passed: failed == 0,
            checks,
        };
        if let Some(file) = json {
            file.commit(output::json(&report).as_bytes())?;
        }
        output::print(&text(&report, &source))?;
        if failed == 0 {
            return Ok(());
        }
        Err(Error::Argument(format!(
            "{source}: {} of {} failed",
            failed,
            counted(report.checks.len(), "check")
        )))
    }
}

/// The values of a file, or of the spec where there is none, and where they are from.
fn values_of(compiled: &Compiled, file: Option<&Path>) -> Result<(Values, String), Error> {
    let (mut values, _, source) = parameters::values(compiled, file)?;
    if let (Some(file), None) = (file, &values.standard) {
        match parameters::beside(compiled, file, &values.beta)? {
            Beside::Nothing => {}
            Beside::Same(standard) => values.standard = Some(standard),
            Beside::Other => output::say(&format!(
                "warning: {source}: its standard parameters contradict its base parameters for this arm, and are ignored"
            )),
        }
    }
    Ok((values, source))
}

/// Base parameters that a file gives.
fn sums(path: &Path) -> Result<Sums, Error> {
    json::typed(path, json::read(path)?, base::FORM)
}

/// What the torques can tell; nothing here is at fault.
fn rank(compiled: &Compiled) -> Check {
    let base = &compiled.base;
    let known = compiled.standard.len() - base.fixed.len();
    let mut findings = Vec::new();
    if !base.unidentifiable.is_empty() {
        let silent = base.unidentifiable.iter();
        let silent: Vec<&str> = silent
            .map(|&k| compiled.standard[k].name.as_str())
            .collect();
        findings.push(format!("no torque depends on {}", names(&silent)));
    }
    let regrouped = known - base.unidentifiable.len() - base.kept.len();
    if regrouped > 0 {
        findings.push(format!(
            "{} only in sums with others: see `robot-model show --what base-parameters`",
            counted(regrouped, "parameter")
        ));
    }
    Check {
        name: "rank",
        passed: Some(true),
        scope: format!(
            "{} of {} that the spec does not fix",
            counted(base.kept.len(), "base parameter"),
            counted(known, "parameter")
        ),
        findings,
        quantities: vec![
            Quantity::of_all("base_parameters", base.kept.len() as f64, ""),
            Quantity::of_all("parameters", known as f64, ""),
        ],
    }
}

fn text(report: &Report<'_>, source: &str) -> String {
    let mut text = format!("{} with the values of {source}\n", report.robot);
    for check in &report.checks {
        let verdict = match check.passed {
            Some(true) => "passed",
            Some(false) => "FAILED",
            None => "not decided",
        };
        writeln!(text, "{:<9} {verdict}  {}", check.name, check.scope).expect("a string takes all");
        for finding in &check.findings {
            writeln!(text, "    {finding}").expect("a string takes all");
        }
    }
    text
}
