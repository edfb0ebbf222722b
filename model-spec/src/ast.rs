//! What was written, with spans: the form between `parse` and `check`.
//!
//! Nothing here is known to make sense: keys may be misspelt, names unresolved, values of the wrong dimension. Every type
//! can be built by hand and parsed with `syn`, so that a derive makes the same tree from attributes.

mod expr;
mod log;

use proc_macro2::Span;
use syn::Ident;

pub use crate::model::BinaryOp;
pub use expr::{Condition, Expr, ExprKind, Unit};
pub use log::{LogBlock, LogChannel, LogColumn};

/// A whole file: robots and effect definitions in the order of the text.
#[derive(Debug, Clone, Default)]
pub struct Ast {
    /// `robot Name { .. }`; a spec has exactly one.
    pub robots: Vec<Robot>,
    /// `effect name(j) { .. }`
    pub effects: Vec<Effect>,
}

/// `robot Name { .. }`
#[derive(Debug, Clone)]
pub struct Robot {
    /// Its name.
    pub name: Ident,
    /// `gravity = ..;` and `convention = ..;`
    pub settings: Vec<Setting>,
    /// Joints from the base to the tip.
    pub joints: Vec<Joint>,
    /// Inertials of links.
    pub links: Vec<Link>,
    /// What a robot that says its energies is made of; its energies are settings.
    pub energies: Energies,
    /// `effects { .. }`; at most one is allowed.
    pub effects: Vec<Effects>,
    /// `log { .. }`; at most one is allowed.
    pub logs: Vec<LogBlock>,
    /// The closing brace.
    pub close: Span,
}

/// What the energies of a robot are made of, each kind in the order of the text.
#[derive(Debug, Clone, Default)]
pub struct Energies {
    /// `coordinates th, x: m;`
    pub coordinates: Vec<Coordinate>,
    /// `parameters m1: kg, l1 = 0.615 m;`
    pub parameters: Vec<Parameter>,
    /// `constants g = 9.81 m/s^2;`
    pub constants: Vec<Constant>,
    /// `let x = ..;`
    pub bindings: Vec<Binding>,
    /// `point tip = [x, y, z];`
    pub points: Vec<Binding<Vec<Expr>>>,
    /// `limits th { .. }`
    pub limits: Vec<Limits>,
}

/// `x: m`; without a unit an angle.
#[derive(Debug, Clone)]
pub struct Coordinate {
    /// Its name.
    pub name: Ident,
    /// Its unit.
    pub unit: Option<Expr>,
}

/// `m1: kg` or `m1 = 5.9 kg`
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Lines of the `///` comment.
    pub doc: String,
    /// Its name.
    pub name: Ident,
    /// Its unit.
    pub unit: Option<Expr>,
    /// A value from CAD.
    pub nominal: Option<Expr>,
}

/// `g = 9.81 m/s^2`
#[derive(Debug, Clone)]
pub struct Constant {
    /// Its name.
    pub name: Ident,
    /// Its value.
    pub value: Expr,
}

/// `name = ..`
#[derive(Debug, Clone)]
pub struct Binding<T = Expr> {
    /// Its name.
    pub name: Ident,
    /// What it stands for.
    pub value: T,
}

/// `limits th { position = ..; velocity = ..; torque = ..; actuator_gain = ..; }`
#[derive(Debug, Clone)]
pub struct Limits {
    /// The coordinate.
    pub name: Ident,
    /// What is known of it.
    pub settings: Vec<Setting>,
}

/// `key = value`
#[derive(Debug, Clone)]
pub struct Setting {
    /// Left-hand side.
    pub key: Ident,
    /// Right-hand side.
    pub value: Value,
}

/// Right-hand side of a setting.
#[derive(Debug, Clone)]
pub enum Value {
    /// One expression; a word such as `standard_dh` is a name.
    Scalar(Expr),
    /// `[x, y, z]`
    List(Vec<Expr>, Span),
    /// `low .. high`
    Range(Expr, Expr),
}

/// `joint name: kind { .. }`
#[derive(Debug, Clone)]
pub struct Joint {
    /// Its name.
    pub name: Ident,
    /// `revolute` or `prismatic`.
    pub kind: Ident,
    /// Frame, limits, link name.
    pub settings: Vec<Setting>,
}

/// `link name: status { .. }`
#[derive(Debug, Clone)]
pub struct Link {
    /// Its name, as in a joint's `link = name`, or the joint's own name.
    pub name: Ident,
    /// `nominal` or `fixed`; absent means nominal.
    pub status: Option<Ident>,
    /// Mass, center of mass, inertia.
    pub settings: Vec<Setting>,
}

/// `effects { .. }`
#[derive(Debug, Clone)]
pub struct Effects {
    /// The word `effects`.
    pub keyword: Span,
    /// Declarations in order.
    pub declared: Vec<DeclaredEffect>,
    /// The closing brace.
    pub close: Span,
}

/// `stribeck(vs = 0.2) on elbow, (wrist_pitch, wrist_roll)`
#[derive(Debug, Clone)]
pub struct DeclaredEffect {
    /// Name of the definition.
    pub name: Ident,
    /// Values of shape parameters.
    pub shapes: Vec<Setting>,
    /// Where it acts.
    pub targets: Targets,
}

/// Where a declared effect acts.
#[derive(Debug, Clone)]
pub enum Targets {
    /// Nothing: on the arm as a whole.
    Arm,
    /// `all`: one instance on every joint.
    All(Span),
    /// One instance on each.
    Each(Vec<Target>),
}

/// A joint or a tuple of joints.
#[derive(Debug, Clone)]
pub struct Target {
    /// One name, or several in parentheses.
    pub joints: Vec<Ident>,
    /// All of it.
    pub span: Span,
}

/// `effect name(j, k) { .. }`
#[derive(Debug, Clone)]
pub struct Effect {
    /// Lines of the `///` comment.
    pub doc: String,
    /// Its name.
    pub name: Ident,
    /// Formal joints.
    pub joints: Vec<Ident>,
    /// `kind name;`
    pub kind: Option<Ident>,
    /// `linear ..;`
    pub linear: Vec<Linear>,
    /// `shape ..;`
    pub shapes: Vec<Shape>,
    /// `input ..;`
    pub inputs: Vec<Input>,
    /// `state ..;`
    pub states: Vec<State>,
    /// `let name = ..;`
    pub lets: Vec<Let>,
    /// `dot(z) = ..;`
    pub rates: Vec<Equation>,
    /// `torque(j) = ..;`
    pub torques: Vec<Equation>,
    /// What it changes beside torques.
    pub acts: Vec<Act>,
}

/// `linear fs >= 0`
#[derive(Debug, Clone)]
pub struct Linear {
    /// Lines of the `///` comment.
    pub doc: String,
    /// Its name.
    pub name: Ident,
    /// `>= 0` is there.
    pub nonnegative: bool,
}

/// `shape vs in 0.005 .. 0.5 step 0.01`
#[derive(Debug, Clone)]
pub struct Shape {
    /// Lines of the `///` comment.
    pub doc: String,
    /// Its name.
    pub name: Ident,
    /// Lowest value.
    pub low: Expr,
    /// Highest value.
    pub high: Expr,
    /// Spacing of the first search.
    pub step: Option<Expr>,
}

/// `input temperature`, `input current(j)`
#[derive(Debug, Clone)]
pub struct Input {
    /// Lines of the `///` comment.
    pub doc: String,
    /// Its name, and that of the log's column.
    pub name: Ident,
    /// The formal joint whose column it is.
    pub joint: Option<Ident>,
}

/// `state z`
#[derive(Debug, Clone)]
pub struct State {
    /// Lines of the `///` comment.
    pub doc: String,
    /// Its name.
    pub name: Ident,
}

/// `let name = ..`
#[derive(Debug, Clone)]
pub struct Let {
    /// Its name.
    pub name: Ident,
    /// What it stands for.
    pub value: Expr,
}

/// `torque(j) = ..`, `dot(z) = ..`
#[derive(Debug, Clone)]
pub struct Equation {
    /// The formal joint, or the state.
    pub of: Ident,
    /// The right-hand side.
    pub value: Expr,
}

/// `force(j) = [..]`, `position(j) = ..`, `body(j) = [..]`, `tilt = [..]`, `delay = ..`
#[derive(Debug, Clone)]
pub struct Act {
    /// Which of them.
    pub kind: ActKind,
    /// Its word.
    pub keyword: Ident,
    /// The formal joint; none where the whole arm is meant.
    pub of: Option<Ident>,
    /// The right-hand side, or the entries of its list.
    pub values: Vec<Expr>,
}

/// What an effect can change beside torques.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActKind {
    /// `force(j) = [x, y, z]`
    Force,
    /// `position(j) = ..`
    Position,
    /// `body(j) = [m, mx, ..]`
    Body,
    /// `tilt = [a, b]`
    Tilt,
    /// `delay = ..`
    Delay,
}

impl ActKind {
    /// All of them with their words.
    pub const ALL: [(&'static str, Self); 5] = [
        ("force", Self::Force),
        ("position", Self::Position),
        ("body", Self::Body),
        ("tilt", Self::Tilt),
        ("delay", Self::Delay),
    ];

    /// Whether it is one of a joint.
    #[must_use]
    pub const fn has_joint(self) -> bool {
        matches!(self, Self::Force | Self::Position | Self::Body)
    }
}

impl Value {
    /// The whole right-hand side.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Scalar(value) => value.span,
            Self::List(_, span) => *span,
            Self::Range(low, high) => join(low.span, high.span),
        }
    }
}

/// From the start of one span to the end of another; the first where the compiler cannot join them.
pub(crate) fn join(first: Span, last: Span) -> Span {
    first.join(last).unwrap_or(first)
}
