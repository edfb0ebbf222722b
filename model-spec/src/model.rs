//! The checked model: what a spec says once every rule of the language holds.
//!
//! In: an [`Ast`](crate::ast) without errors. Out: [`Model`]. Invariants gained: names are unique and resolved, units are
//! SI, every joint has one frame convention (folded into [`Placement`]), effects refer to joints by index. Nothing
//! downstream validates again. A `Model` cannot be built by hand: only `check` makes one.

use std::sync::Arc;

/// A robot: its coordinates, what moves with them, and the effects it declares.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Model {
    /// The robot's name as written, in upper camel case.
    pub name: String,
    /// Name of the spec file without its folder, for headers and messages.
    pub source: String,
    /// The coordinates; joints of a chain stand in order from the base to the tip.
    pub joints: Vec<Joint>,
    /// The rigid body that they move.
    pub body: Body,
    /// Declared effects, one entry per instance (a joint or a tuple of joints), in the order of the spec.
    pub effects: Vec<Effect>,
    /// Every effect that this spec may declare: the standard ones by name, then its own in the order of the spec.
    pub definitions: Vec<Arc<EffectDefinition>>,
}

/// How the rigid body is described.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Body {
    /// Links joined by frames.
    Chain(Chain),
    /// Kinetic and potential energy.
    Energies(Energies),
}

impl Model {
    /// The chain, where the robot is one.
    #[must_use]
    pub const fn chain(&self) -> Option<&Chain> {
        match &self.body {
            Body::Chain(chain) => Some(chain),
            Body::Energies(_) => None,
        }
    }

    /// The energies, where the robot is described by them.
    #[must_use]
    pub const fn energies(&self) -> Option<&Energies> {
        match &self.body {
            Body::Chain(_) => None,
            Body::Energies(energies) => Some(energies),
        }
    }
}

/// A serial chain: joint `i` moves link `i`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Chain {
    /// How the author writes frames. Derivations use [`Link::placement`] only.
    pub convention: Convention,
    /// Acceleration of gravity in the base frame, m/s^2.
    pub gravity: [f64; 3],
    /// Links from the base to the tip, one a joint.
    pub links: Vec<Link>,
}

/// A robot that says its energies instead of its frames.
///
/// Both energies are polynomials in [`Self::parameters`]; the monomials that occur are its standard parameters, in which
/// the torque is linear.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Energies {
    /// Unknown constants, in the order of the spec.
    pub parameters: Vec<Parameter>,
    /// `let` bindings; each uses earlier ones only. Constants of the spec are numbers in all expressions.
    pub bindings: Vec<Binding>,
    /// Kinetic energy, J: quadratic in the rates.
    pub kinetic: EnergyExpr,
    /// Potential energy, J: free of rates.
    pub potential: EnergyExpr,
    /// Products of powers of parameters that the energies are sums of, lowest degree first.
    pub monomials: Vec<Monomial>,
    /// Points whose position the spec gives, in the order of the spec.
    pub points: Vec<Point>,
}

/// An unknown constant of a robot that is described by its energies.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Parameter {
    /// Name as written.
    pub name: String,
    /// The `///` comment in front of it.
    pub doc: String,
    /// A value from CAD, in SI units: used where a number is needed before identification.
    pub nominal: Option<f64>,
}

/// `let name = ..;`
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Binding {
    /// Name as written.
    pub name: String,
    /// What it stands for.
    pub value: EnergyExpr,
}

/// `point name = [x, y, z];`: forward kinematics, m in the base frame.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Point {
    /// Name as written.
    pub name: String,
    /// Its coordinates; free of parameters and rates.
    pub position: [EnergyExpr; 3],
}

/// A product of powers of parameters.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub struct Monomial {
    /// `(parameter, exponent)`, by rising parameter; no exponent is zero.
    pub factors: Vec<(usize, i32)>,
}

/// An expression of energies.
pub type EnergyExpr = Expr<EnergyLeaf>;

/// What an energy is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EnergyLeaf {
    /// Index into [`Model::joints`].
    Coordinate(usize),
    /// `dot(q)`: the rate of a coordinate, by the same index.
    Rate(usize),
    /// Index into [`Energies::parameters`].
    Parameter(usize),
    /// Index into [`Energies::bindings`].
    Binding(usize),
    /// `dot(x)` of a binding `x`, by the same index.
    BindingRate(usize),
}

/// How frames are written in the spec; never defaulted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Convention {
    /// `Rz(theta) Tz(d) Tx(a) Rx(alpha)`; link frame `i` after the whole product.
    StandardDh,
    /// `Rx(alpha) Tx(a) Rz(theta) Tz(d)`; link frame `i` after the whole product.
    ModifiedDh,
    /// URDF-style: fixed `xyz`, `rpy`, then motion about or along `axis`; link frame `i` moves with joint `i`.
    Origin,
}

/// One joint, or one coordinate of a robot that is described by its energies.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Joint {
    /// Name as written.
    pub name: String,
    /// Revolute or prismatic.
    pub kind: JointKind,
    /// Limits, where the spec states them.
    pub limits: Limits,
    /// Joint torque (N m, or N) per unit of the logged channel; 1 where the log holds torques.
    pub actuator_gain: f64,
    /// Line of the declaration in the spec, from 1.
    pub line: usize,
}

/// What a joint's coordinate is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// An angle in rad.
    Revolute,
    /// A length in m.
    Prismatic,
}

/// Pose of link `i` in link `i - 1`: `before * motion(axis, q + offset) * after`.
///
/// The one home of the three frame conventions: standard DH has `before = 1`, modified DH and origin frames have
/// `after = 1`. Entries whose angle is a multiple of a quarter turn are exact (0, 1, -1).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Placement {
    /// Fixed part before the motion.
    pub before: Transform,
    /// Unit vector of the joint's axis, in the frame after `before`.
    pub axis: [f64; 3],
    /// Added to `q` before the motion, rad or m.
    pub offset: f64,
    /// Fixed part after the motion.
    pub after: Transform,
}

/// A rigid transform `x -> rotation * x + translation`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// Rotation matrix, `[row][column]`.
    pub rotation: [[f64; 3]; 3],
    /// Translation, m.
    pub translation: [f64; 3],
}

/// Limits of a joint; `None` where the spec is silent.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Lowest and highest position, rad or m.
    pub position: Option<(f64, f64)>,
    /// Largest speed, rad/s or m/s.
    pub velocity: Option<f64>,
    /// Largest torque, N m or N.
    pub torque: Option<f64>,
}

/// A rigid link.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Link {
    /// Name as written; the joint's name where the spec gives no other.
    pub name: String,
    /// Pose of the link's frame in its parent's as a function of `q`.
    pub placement: Placement,
    /// What the spec says of mass, first moments and inertia.
    pub inertial: Inertial,
}

/// The ten standard inertial parameters of a link, about the origin of the link frame, in the order of
/// [`InertialElement::ALL`](crate::parameter::InertialElement::ALL).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inertial {
    /// Not given: to be identified.
    Unknown,
    /// A CAD value: to be identified, and used where a number is needed before that.
    Nominal([f64; 10]),
    /// Exact: kept, never identified.
    Fixed([f64; 10]),
}

/// One declared effect on one joint, or on one tuple of joints.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Effect {
    /// Its definition in the language.
    pub definition: Arc<EffectDefinition>,
    /// Joint indices, one per formal joint of the definition.
    pub joints: Vec<usize>,
    /// Values of the shape parameters as written at the declaration; `None` where they are left to identification.
    pub shapes: Vec<Option<f64>>,
    /// 1 for the first instance of a definition that starts at this first joint, 2 for the second, and so on: `JOINT.EFFECT2`.
    pub instance: usize,
    /// Line of the declaration in the spec, from 1.
    pub line: usize,
}

/// An effect as the language defines it: torque added to the right-hand side of `tau = M ddq + C dq + G + effect`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EffectDefinition {
    /// Snake case, as in specs; JSON shows it in kebab case.
    pub name: String,
    /// The `///` comment in front of the definition.
    pub doc: String,
    /// Formal joints, one or more: `effect gear_coupling(j, k)`.
    pub joints: Vec<String>,
    /// Parameters that least squares solves for; the torque is linear in them.
    pub linear: Vec<LinearParameter>,
    /// Nonlinear parameters.
    pub shapes: Vec<ShapeParameter>,
    /// One equation per formal joint that the effect acts on.
    pub torques: Vec<EffectTorque>,
}

/// `torque(j) = ...` of an effect definition.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectTorque {
    /// Index of the formal joint.
    pub joint: usize,
    /// Linear in the definition's linear parameters.
    pub value: EffectExpr,
}

/// A parameter in which an effect's torque is linear.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LinearParameter {
    /// Name as written.
    pub name: String,
    /// The `///` comment in front of it.
    pub doc: String,
    /// Declared `>= 0`: a negative estimate is not physical.
    pub nonnegative: bool,
}

/// A parameter in which an effect's torque is not linear, with the range in which it is looked for.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ShapeParameter {
    /// Name as written.
    pub name: String,
    /// The `///` comment in front of it.
    pub doc: String,
    /// Lowest value.
    pub low: f64,
    /// Highest value.
    pub high: f64,
    /// Spacing of the first search; `None`: logarithmic, twelve points.
    pub step: Option<f64>,
}

/// A checked expression over leaves that its place allows.
#[derive(Debug, Clone, PartialEq)]
pub enum Expr<Leaf> {
    /// A number in SI units.
    Number(f64),
    /// A name with a meaning.
    Leaf(Leaf),
    /// `-x`
    Neg(Box<Self>),
    /// `x op y`
    Binary(BinaryOp, Box<Self>, Box<Self>),
    /// `f(x)`
    Call(Function, Box<Self>),
}

impl<Leaf> Expr<Leaf> {
    /// Whether `wanted` holds for some part of the expression.
    pub fn contains(&self, wanted: &dyn Fn(&Self) -> bool) -> bool {
        wanted(self)
            || match self {
                Self::Number(_) | Self::Leaf(_) => false,
                Self::Neg(x) | Self::Call(_, x) => x.contains(wanted),
                Self::Binary(_, x, y) => x.contains(wanted) || y.contains(wanted),
            }
    }
}

/// An expression of an effect.
pub type EffectExpr = Expr<EffectLeaf>;

/// What an effect's equation is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EffectLeaf {
    /// Index into [`EffectDefinition::linear`].
    Linear(usize),
    /// Index into [`EffectDefinition::shapes`].
    Shape(usize),
    /// A signal of a formal joint (index into [`EffectDefinition::joints`]).
    Signal(Signal, usize),
    /// Time since the start of the log, s.
    Time,
}

/// A signal of one joint that effects may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// Position `q`, rad or m.
    Position,
    /// Velocity `dq`.
    Velocity,
    /// Acceleration `ddq`.
    Acceleration,
    /// Torque of the rigid body alone, `M ddq + C dq + G`: what the transmission carries. Written `rigid_torque(j)`.
    RigidTorque,
}

/// Arithmetic of the language, by rising precedence; `^` binds tightest and to the right.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BinaryOp {
    /// `+`
    Add,
    /// `-`
    Sub,
    /// `*`
    Mul,
    /// `/`
    Div,
    /// `^`
    Pow,
}

impl Function {
    /// Its value.
    #[must_use]
    pub fn apply(self, x: f64) -> f64 {
        match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Exp => x.exp(),
            Self::Sqrt => x.sqrt(),
            Self::Abs => x.abs(),
            // `f64::signum` is 1 at 0.
            Self::Sign if x == 0.0 => 0.0,
            Self::Sign => x.signum(),
            Self::Tanh => x.tanh(),
        }
    }
}

/// Functions of one argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Function {
    /// `sin`
    Sin,
    /// `cos`
    Cos,
    /// `exp`
    Exp,
    /// `sqrt`
    Sqrt,
    /// `abs`
    Abs,
    /// `sign`: -1, 0 or 1
    Sign,
    /// `tanh`
    Tanh,
}
