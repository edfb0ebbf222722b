//! Effects as the language defines them, and as a robot declares them.

use std::sync::Arc;

use super::Expr;

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
    /// Columns of the log that the equations read beside positions and torques.
    pub inputs: Vec<EffectInput>,
    /// What the equations name: `let` bindings and the rates of states. Each uses earlier ones only.
    pub bindings: Vec<EffectBinding>,
    /// Internal states; each is 0 at the start of a log.
    pub states: Vec<EffectState>,
    /// One equation per formal joint that the effect acts on.
    pub torques: Vec<EffectTorque>,
}

impl EffectDefinition {
    /// Whether an equation reads the torque that the model is to explain.
    #[must_use]
    pub fn reads_measured_torque(&self) -> bool {
        let reads = |part: &EffectExpr| {
            matches!(
                part,
                Expr::Leaf(EffectLeaf::Signal(Signal::MeasuredTorque, _))
            )
        };
        let torques = self.torques.iter().map(|torque| &torque.value);
        let bindings = self.bindings.iter().map(|binding| &binding.value);
        torques.chain(bindings).any(|value| value.contains(&reads))
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
    /// Spacing of the first search; `None`: logarithmic.
    pub step: Option<f64>,
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
