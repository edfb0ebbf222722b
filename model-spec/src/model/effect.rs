//! Effects as the language defines them, and as a robot declares them.

use std::sync::Arc;

use super::Expr;

/// One declared effect on one joint, or on one tuple of joints.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Effect {
    /// Its definition in the language.
    pub definition: Arc<EffectDefinition>,
    /// Joint indices, one per formal joint of the definition; none where it acts on the arm as a whole.
    pub joints: Vec<usize>,
    /// Values of the shape parameters as written at the declaration; `None` where they are left to identification.
    pub shapes: Vec<Option<f64>>,
    /// 1 for the first instance of a definition that starts at this first joint, 2 for the second, and so on: `JOINT.EFFECT2`.
    pub instance: usize,
    /// Line of the declaration in the spec, from 1.
    pub line: usize,
}

/// An effect as the language defines it: torque added to the right-hand side of `tau = M ddq + C dq + G + effect`, or a change of
/// what stands there.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EffectDefinition {
    /// Snake case, as in specs.
    pub name: String,
    /// The effect that it is a case of, its own name where it is none: what reports call it, in kebab case.
    pub kind: String,
    /// The `///` comment in front of the definition.
    pub doc: String,
    /// Formal joints: `effect gear_coupling(j, k)`. None where it acts on the arm as a whole.
    pub joints: Vec<String>,
    /// Parameters that least squares solves for; torques and bodies are linear in them.
    pub linear: Vec<LinearParameter>,
    /// Nonlinear parameters.
    pub shapes: Vec<ShapeParameter>,
    /// Columns of the log that the equations read beside positions and torques.
    pub inputs: Vec<EffectInput>,
    /// What the equations name: `let` bindings and the rates of states. Each uses earlier ones only.
    pub bindings: Vec<EffectBinding>,
    /// Internal states; each is 0 at the start of a log.
    pub states: Vec<EffectState>,
    /// One equation per formal joint on which the effect is a torque.
    pub torques: Vec<EffectTorque>,
    /// What it changes beside torques.
    pub acts: Vec<Act>,
}

impl EffectDefinition {
    /// Right-hand sides of all equations; bindings are not among them.
    pub fn equations(&self) -> impl Iterator<Item = &EffectExpr> {
        let torques = self.torques.iter().map(|torque| &torque.value);
        torques.chain(self.acts.iter().flat_map(Act::values))
    }

    /// Right-hand sides that are torques or make some: components of forces among them.
    pub fn torque_equations(&self) -> impl Iterator<Item = &EffectExpr> {
        let torques = self.torques.iter().map(|torque| &torque.value);
        let forces = self
            .acts
            .iter()
            .filter(|act| matches!(act, Act::Force { .. }));
        torques.chain(forces.flat_map(Act::values))
    }

    /// Whether a linear parameter is one of a body, not of a torque.
    #[must_use]
    pub fn is_of_body(&self, parameter: usize) -> bool {
        let is_it = |leaf: &EffectLeaf| *leaf == EffectLeaf::Linear(parameter);
        let mut bodies = self.acts.iter().filter_map(|act| match act {
            Act::Body { inertial, .. } => Some(inertial),
            _ => None,
        });
        bodies.any(|inertial| inertial.iter().any(|value| self.reads(value, &is_it)))
    }

    /// Whether an expression stays what it is along a motion.
    #[must_use]
    pub fn is_constant(&self, value: &EffectExpr) -> bool {
        let moves = |leaf: &EffectLeaf| match leaf {
            EffectLeaf::Signal(..)
            | EffectLeaf::Time
            | EffectLeaf::Input(_)
            | EffectLeaf::State(_) => true,
            EffectLeaf::Linear(_) | EffectLeaf::Shape(_) | EffectLeaf::Binding(_) => false,
        };
        !self.reads(value, &moves)
    }

    /// Whether links move against their joints by what changes along a motion: then the torque at an instant is no function of
    /// `q, dq, ddq` at that instant.
    #[must_use]
    pub fn moves_links(&self) -> bool {
        self.acts.iter().any(|act| match act {
            Act::Position { value, .. } => !self.is_constant(value),
            Act::Force { .. } | Act::Body { .. } | Act::Tilt { .. } | Act::Delay { .. } => false,
        })
    }

    /// Whether links give way in proportion to the load of the transmission, as at a spring: then its stiffness is known as well as the load.
    #[must_use]
    pub fn gives_way(&self) -> bool {
        self.acts.iter().any(|act| match act {
            Act::Position { value, .. } => {
                let [once, twice] = [1.0, 2.0].map(|load| self.under_load(value, load));
                once.zip(twice).is_some_and(|(once, twice)| {
                    once != 0.0 && (twice - 2.0 * once).abs() < 1e-9 * once.abs()
                })
            }
            Act::Force { .. } | Act::Body { .. } | Act::Tilt { .. } | Act::Delay { .. } => false,
        })
    }

    /// The value of an expression at rest under so much load, with parameters at 1; none where it is not made of numbers alone.
    fn under_load(&self, value: &EffectExpr, load: f64) -> Option<f64> {
        value.number(&|leaf| match leaf {
            EffectLeaf::Linear(_) | EffectLeaf::Shape(_) => Some(1.0),
            EffectLeaf::Signal(Signal::RigidTorque, _) => Some(load),
            EffectLeaf::Signal(..)
            | EffectLeaf::Time
            | EffectLeaf::Input(_)
            | EffectLeaf::State(_) => Some(0.0),
            EffectLeaf::Binding(k) => self.under_load(&self.bindings[*k].value, load),
        })
    }

    /// Whether an expression reads a leaf that is wanted, itself or through bindings.
    #[must_use]
    pub fn reads(&self, value: &EffectExpr, wanted: &dyn Fn(&EffectLeaf) -> bool) -> bool {
        let mut through = vec![false; self.bindings.len()];
        // Bindings use earlier ones only: from the last to the first, each is known to be read or not when its turn comes.
        let mut next = Some(value);
        let mut k = self.bindings.len();
        loop {
            if let Some(value) = next {
                let is_wanted =
                    |part: &EffectExpr| matches!(part, Expr::Leaf(leaf) if wanted(leaf));
                if value.contains(&is_wanted) {
                    return true;
                }
                for (k, read) in through.iter_mut().enumerate() {
                    *read |= value.contains(&|part| *part == Expr::Leaf(EffectLeaf::Binding(k)));
                }
            }
            if k == 0 {
                return false;
            }
            k -= 1;
            next = through[k].then(|| &self.bindings[k].value);
        }
    }

    /// Whether an equation reads the torque that the model is to explain.
    #[must_use]
    pub fn reads_measured_torque(&self) -> bool {
        let reads = |part: &EffectExpr| {
            matches!(
                part,
                Expr::Leaf(EffectLeaf::Signal(Signal::MeasuredTorque, _))
            )
        };
        let bindings = self.bindings.iter().map(|binding| &binding.value);
        let mut all = self.equations().chain(bindings);
        all.any(|value| value.contains(&reads))
    }
}

/// `input name;` or `input name(j);` of an effect definition.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EffectInput {
    /// Name as written.
    pub name: String,
    /// The `///` comment in front of it.
    pub doc: String,
    /// Index of the formal joint whose column it is; `None` where one column serves all joints.
    pub joint: Option<usize>,
}

impl EffectInput {
    /// Name of the log's column where the formal joints are `joints` of the robot, from 0: `temperature`, `current3`.
    #[must_use]
    pub fn column(&self, joints: &[usize]) -> String {
        match self.joint {
            Some(formal) => format!("{}{}", self.name, joints[formal] + 1),
            None => self.name.clone(),
        }
    }
}

/// `let name = ..;` of an effect definition, or the rate of a state, which is named `dot(z)`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EffectBinding {
    /// Name as written.
    pub name: String,
    /// What it stands for.
    pub value: EffectExpr,
}

/// `state z;` of an effect definition.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EffectState {
    /// Name as written.
    pub name: String,
    /// The `///` comment in front of it.
    pub doc: String,
    /// Its rate: index into [`EffectDefinition::bindings`]. Free of linear parameters.
    pub rate: usize,
}

/// `torque(j) = ...` of an effect definition.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EffectTorque {
    /// Index of the formal joint.
    pub joint: usize,
    /// Linear in the definition's linear parameters.
    pub value: EffectExpr,
}

/// What an effect changes beside torques. Joints are indices into [`EffectDefinition::joints`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Act {
    /// `force(j) = [x, y, z]`: something outside pushes the origin of the frame of the joint's link, N in the axes of the base frame. The
    /// motors supply `-J^T` times that. Each component is zero or linear in linear parameters.
    Force {
        /// The joint that moves the link.
        joint: usize,
        /// Three components.
        components: Vec<EffectExpr>,
    },
    /// `position(j) = ..`: the rigid body stands that far from where the log has the joint, rad or m. Free of linear
    /// parameters.
    Position {
        /// The joint.
        joint: usize,
        /// Added to the logged position.
        value: EffectExpr,
    },
    /// `body(j) = [..]`: a rigid body more on the joint's link. Constant, and linear in linear parameters.
    Body {
        /// The joint that moves the link.
        joint: usize,
        /// Ten inertial parameters about the origin of the link's frame, in the order of
        /// [`InertialElement::ALL`](crate::parameter::InertialElement::ALL).
        inertial: Vec<EffectExpr>,
    },
    /// `tilt = [a, b]`: the base is turned by `a` about the first, then by `b` about the second of the two axes of its frame that
    /// are left when the one nearest to gravity is taken away, in the order x, y, z; rad. Constant.
    Tilt {
        /// Both angles.
        angles: Vec<EffectExpr>,
    },
    /// `delay = ..`: the log has torques that many seconds after their positions. Constant.
    Delay {
        /// Negative where torques come early.
        seconds: EffectExpr,
    },
}

impl Act {
    /// Its right-hand side, or the entries of its list.
    pub fn values(&self) -> impl Iterator<Item = &EffectExpr> {
        match self {
            Self::Position { value, .. } | Self::Delay { seconds: value } => {
                std::slice::from_ref(value)
            }
            Self::Force { components, .. } => components.as_slice(),
            Self::Body { inertial, .. } => inertial.as_slice(),
            Self::Tilt { angles } => angles.as_slice(),
        }
        .iter()
    }

    /// The joint, where it is one of a joint.
    #[must_use]
    pub const fn joint(&self) -> Option<usize> {
        match self {
            Self::Force { joint, .. } | Self::Position { joint, .. } | Self::Body { joint, .. } => {
                Some(*joint)
            }
            Self::Tilt { .. } | Self::Delay { .. } => None,
        }
    }
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

/// A parameter in which an effect's torque is not linear, with the range in which it is looked for; see [`Self::misses`] for
/// the values that a spec may give.
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
    /// Spacing of the first search; `None`: logarithmic.
    pub step: Option<f64>,
}

impl ShapeParameter {
    /// What a value given in a spec has to be, where it is not: the sign that the range has on its whole length.
    ///
    /// The range is where a search is worth its time, not where the law holds. A scale may have any size, but a law that is
    /// searched among positive numbers divides by them, or takes their roots.
    #[must_use]
    pub fn misses(&self, value: f64) -> Option<&'static str> {
        if self.low > 0.0 {
            (value <= 0.0).then_some("a positive number")
        } else if self.low == 0.0 {
            (value < 0.0).then_some("zero or a positive number")
        } else if self.high < 0.0 {
            (value >= 0.0).then_some("a negative number")
        } else if self.high == 0.0 {
            (value > 0.0).then_some("zero or a negative number")
        } else {
            None
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
    /// Index into [`EffectDefinition::inputs`].
    Input(usize),
    /// Index into [`EffectDefinition::states`].
    State(usize),
    /// Index into [`EffectDefinition::bindings`].
    Binding(usize),
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
    /// Torque as the log has it, in N m or N: written `measured_torque(j)`.
    MeasuredTorque,
}
