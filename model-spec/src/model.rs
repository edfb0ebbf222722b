//! The checked model: what a spec says once every rule of the language holds.
//!
//! In: an [`Ast`](crate::ast) without errors. Out: [`Model`]. Invariants gained: names are unique and resolved, units are
//! SI, every joint has one frame convention (folded into [`Placement`]), effects refer to joints by index. Nothing
//! downstream validates again. A `Model` cannot be built by hand: only `check` makes one, and [`Model::with`] and [`Model::freeing`] another of
//! it.

mod effect;
mod explained;
mod expr;
mod log;
mod monomial;

use std::sync::Arc;

pub use effect::{
    Act, Effect, EffectBinding, EffectDefinition, EffectExpr, EffectInput, EffectLeaf, EffectState,
    EffectTorque, LinearParameter, ShapeParameter, Signal,
};
pub use explained::Confusion;
pub use expr::{BinaryOp, Choice, Expr, Function};
pub use log::{LogColumn, LogColumns};

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
    /// Where logs have their channels.
    pub log: LogColumns,
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
    /// The same robot with an effect of its library declared last, its shapes left to identification.
    #[must_use]
    pub fn with(&self, definition: &Arc<EffectDefinition>, joints: &[usize]) -> Self {
        let mut model = self.clone();
        let alike = self.effects.iter().filter(|effect| {
            effect.definition.name == definition.name && effect.joints.first() == joints.first()
        });
        model.effects.push(Effect {
            definition: Arc::clone(definition),
            joints: joints.to_vec(),
            shapes: vec![None; definition.shapes.len()],
            instance: 1 + alike.count(),
            line: 0,
        });
        model
    }

    /// The same robot with the bodies of these links of its chain left to identification, whatever the spec says of them.
    #[must_use]
    pub fn freeing(&self, links: &[usize]) -> Self {
        let mut model = self.clone();
        if let Body::Chain(chain) = &mut model.body {
            for &link in links {
                chain.links[link].inertial = Inertial::Unknown;
            }
        }
        model
    }

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
    /// Where forces of the world act on the last link, in its frame, m.
    pub tip: [f64; 3],
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

impl Convention {
    /// Its name in a spec.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::StandardDh => "standard_dh",
            Self::ModifiedDh => "modified_dh",
            Self::Origin => "origin",
        }
    }
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
    /// What the gain is written in; `None` where the spec has none.
    pub actuator_gain_unit: Option<GainUnit>,
    /// Line of the declaration in the spec, from 1.
    pub line: usize,
}

/// What an `actuator_gain` is written in, and so what it is multiplied with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GainUnit {
    /// No unit: whatever the log has makes a torque.
    Plain,
    /// A torque (or force): the log has plain numbers.
    Torque,
    /// A torque (or force) per ampere: the log has currents.
    TorquePerAmpere,
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
    /// Largest acceleration, rad/s^2 or m/s^2.
    pub acceleration: Option<f64>,
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
    /// The numbers of the frame as they are written: `a = 0.4 m; alpha = 90 deg; d = 0`.
    pub frame: String,
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
