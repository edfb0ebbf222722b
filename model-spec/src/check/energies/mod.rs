//! Robots that say their energies: names, dimensions, degrees, and the products of parameters that torques are linear in.

mod declared;
mod dimension;
mod inertia;
mod monomials;
mod rates;
mod resolve;
mod rules;
mod written;

use super::setting::Settings;
use super::words::{reserved, reserved_name};
use super::{Errors, check_unique};
use crate::ast::{self, Robot, Value};
use crate::diagnostic::Diagnostic;
use crate::model::{Energies, Joint, JointKind};
use declared::{check_constants, check_coordinates, check_parameters};
use dimension::Inference;
pub(in crate::check) use inertia::check_inertia;
use resolve::Scope;
use written::Written;

/// A rule of energies that an expression breaks, before its place in the text is known.
struct Fault {
    statement: Statement,
    /// Operands from the whole expression to the offending part.
    path: Vec<usize>,
    message: String,
    label: String,
    /// A second part that the message is about.
    other: Option<(Vec<usize>, String)>,
    help: String,
}

impl Fault {
    #[track_caller]
    fn new(
        statement: Statement,
        path: Vec<usize>,
        message: impl Into<String>,
        label: impl Into<String>,
        help: &str,
    ) -> Box<Self> {
        let message = message.into();
        #[cfg(test)]
        robot_model_goldens::note(&message);
        Box::new(Self {
            statement,
            path,
            message,
            label: label.into(),
            other: None,
            help: help.to_owned(),
        })
    }

    /// A second part that the message is about.
    fn also(mut self: Box<Self>, path: Vec<usize>, label: String) -> Box<Self> {
        self.other = Some((path, label));
        self
    }
}

/// Boxed: rules are passed far more often than broken.
type Checked<T> = Result<T, Box<Fault>>;

/// Which expression of the robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Statement {
    /// A `let`, by its index.
    Binding(usize),
    /// `kinetic = ..;`
    Kinetic,
    /// `potential = ..;`
    Potential,
    /// A coordinate of a point.
    Point(usize, usize),
}

/// The settings that a robot has which says its energies.
pub(super) const SETTINGS: [&str; 2] = ["kinetic", "potential"];

/// Whether the robot is described by its energies.
pub(super) fn says_energies(robot: &Robot) -> bool {
    let energies = &robot.energies;
    !energies.coordinates.is_empty()
        || !energies.parameters.is_empty()
        || !energies.constants.is_empty()
        || !energies.bindings.is_empty()
        || !energies.points.is_empty()
        || !energies.limits.is_empty()
        || robot
            .settings
            .iter()
            .any(|s| SETTINGS.contains(&s.key.to_string().as_str()))
}

/// The coordinates and the energies; `None` behind an error.
pub(super) fn check_energies(
    robot: &Robot,
    settings: &Settings,
    errors: &mut Errors,
) -> Option<(Vec<Joint>, Energies)> {
    let before = errors.len();
    check_not_a_chain(robot, errors);
    check_names(robot, errors);
    let joints = check_coordinates(robot, errors);
    let kinds: Vec<JointKind> = joints.iter().map(|joint| joint.kind).collect();
    let mut inference = Inference::new(&kinds);
    let parameters = check_parameters(robot, &mut inference, errors);
    let constants = check_constants(robot, &mut inference, errors);
    let energies = Written {
        robot,
        kinetic: check_present(robot, settings, "kinetic", errors),
        potential: check_present(robot, settings, "potential", errors),
    };
    if errors.len() > before {
        return None;
    }
    let scope = Scope {
        coordinates: joints.iter().map(|joint| joint.name.clone()).collect(),
        parameters: parameters.iter().map(|p| p.name.clone()).collect(),
        constants,
        bindings: Vec::new(),
        later: robot
            .energies
            .bindings
            .iter()
            .map(|b| b.name.to_string())
            .collect(),
    };
    let energies = energies.check(scope, inference, parameters, errors)?;
    check_used(robot, &energies, errors);
    (errors.len() == before).then_some((joints, energies))
}

/// A robot is a chain or says its energies, not both.
fn check_not_a_chain(robot: &Robot, errors: &mut Errors) {
    let joint = robot.joints.first().map(|joint| &joint.name);
    let link = robot.links.first().map(|link| &link.name);
    let setting = |key: &str| robot.settings.iter().map(|s| &s.key).find(|k| *k == key);
    let chain = joint
        .or(link)
        .or(setting("convention"))
        .or(setting("gravity"));
    if let Some(chain) = chain {
        errors.push(
            Diagnostic::new(
                chain.span(),
                format!("robot `{}` has both energies and a chain", robot.name),
                "belongs to a chain",
            )
            .help(
                "describe the arm by joints and links, or by `coordinates`, `kinetic` and `potential`; with energies, define gravity as a \
                 constant, such as `constants g = 9.81 m/s^2;`",
            ),
        );
    }
}

/// All names of the robot share one scope.
fn check_names(robot: &Robot, errors: &mut Errors) {
    let energies = &robot.energies;
    let names = || {
        let coordinates = energies.coordinates.iter().map(|c| &c.name);
        coordinates
            .chain(energies.parameters.iter().map(|p| &p.name))
            .chain(energies.constants.iter().map(|c| &c.name))
            .chain(energies.bindings.iter().map(|b| &b.name))
    };
    check_unique(names(), "name", errors);
    check_unique(energies.points.iter().map(|p| &p.name), "point", errors);
    check_unique(
        energies.limits.iter().map(|l| &l.name),
        "block of limits of",
        errors,
    );
    // The position of a joint has no name in energies, and `q` is what many call theirs.
    let taken = || {
        let words = reserved().filter(|word| *word != "q");
        words.chain(["all", "known"])
    };
    for name in names().filter(|name| taken().any(|word| *name == word)) {
        errors.push(reserved_name(name, taken()));
    }
    // `dx` is how equations write the rate of `x`.
    let rate_of = |name: &syn::Ident| {
        let name = name.to_string();
        let mut coordinates = energies.coordinates.iter().map(|c| c.name.to_string());
        let rests = ["d", "dd"].map(|d| name.strip_prefix(d).map(str::to_owned));
        coordinates.find(|coordinate| rests.iter().flatten().any(|rest| rest == coordinate))
    };
    for name in names() {
        if let Some(coordinate) = rate_of(name) {
            errors.push(
                Diagnostic::new(
                    name.span(),
                    format!("equations write a rate of `{coordinate}` as `{name}`"),
                    "",
                )
                .help(format!(
                    "give one of them another name; the rate itself is `dot({coordinate})`"
                )),
            );
        }
    }
}

fn check_present<'a>(
    robot: &Robot,
    settings: &Settings<'a>,
    key: &str,
    errors: &mut Errors,
) -> Option<&'a ast::Expr> {
    match settings.get(key) {
        Some(Value::Scalar(expr)) => Some(expr),
        Some(other) => {
            errors.push(
                Diagnostic::new(other.span(), format!("`{key}` is one expression"), "").help(
                    format!("write `{key} = ..;` in coordinates, rates `dot(..)` and parameters"),
                ),
            );
            None
        }
        None if !settings.lacks(key) => None,
        None => {
            errors.push(
                Diagnostic::new(
                    robot.name.span(),
                    format!("the robot does not define its {key} energy"),
                    format!("no `{key}`"),
                )
                .help(format!(
                    "write `{key} = ..;`, in joules; 0 if there is none"
                )),
            );
            None
        }
    }
}

/// What is declared is used.
fn check_used(robot: &Robot, energies: &Energies, errors: &mut Errors) {
    for (k, parameter) in robot.energies.parameters.iter().enumerate() {
        let used = energies
            .monomials
            .iter()
            .any(|monomial| monomial.factors.iter().any(|(index, _)| *index == k));
        if !used {
            errors.push(
                Diagnostic::new(
                    parameter.name.span(),
                    format!(
                        "parameter `{}` has no influence on any torque",
                        parameter.name
                    ),
                    "in no energy that changes",
                )
                .help("use it in an energy, or delete it"),
            );
        }
    }
}
