//! The size-at-run-time face of a model: regressor columns over many states a call.
//!
//! Identification and tracing see models, declared effects and candidate effects through these traits only; emitted code
//! and the interpreter both stand behind them.
//!
//! # Examples
//! An effect of one's own, on the first joint: `tau = k q`.
//! ```
//! use robot_model::columns::{Columns, Entry, Shape, Unknown};
//! use robot_model::motion::Motion;
//!
//! struct Spring([Unknown; 1]);
//!
//! impl Columns for Spring {
//!     fn unknowns(&self) -> &[Unknown] {
//!         &self.0
//!     }
//!     fn shapes(&self) -> &[Shape] {
//!         &[]
//!     }
//!     fn uses_rigid_torque(&self) -> bool {
//!         false
//!     }
//!     fn entries(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
//!         vec![Entry { joint: 0, column: 0, values: motion.smooth.q[0].clone() }]
//!     }
//! }
//!
//! let mut motion = Motion { time: vec![0.0, 0.1], ..Motion::default() };
//! motion.smooth.q = vec![vec![0.3, 0.4]];
//! let stiffness = Unknown { name: "shoulder.spring.k".to_owned(), nonnegative: true };
//! let torque = robot_model::identify::torque_of(&Spring([stiffness]), &motion, &[], &[10.0], 1);
//! assert_eq!(torque, [[3.0, 4.0]]);
//! ```

use crate::identify::PossibleArms;
use crate::motion::Motion;

/// An unknown that least squares solves for.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknown {
    /// `LINK.izz`, `JOINT.EFFECT.PARAMETER`.
    pub name: String,
    /// A negative value is not physical.
    pub nonnegative: bool,
}

/// What CAD says of an unknown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nominal {
    /// Its value.
    pub value: f64,
    /// How large such a parameter is of bodies of that mass and extent, in its unit: positive where the value itself may be 0.
    pub size: f64,
}

/// An unknown in which the torque is not linear, with the range in which it is looked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// `JOINT.EFFECT.SHAPE`.
    pub name: String,
    /// First values to try, ascending, from the lowest to the highest that are allowed.
    pub grid: Vec<f64>,
}

/// One column's values on one joint, for all samples of a motion, before any filter.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Row block: the joint whose torque it is, from 0.
    pub joint: usize,
    /// Column: index into [`Columns::unknowns`].
    pub column: usize,
    /// One value a sample.
    pub values: Vec<f64>,
}

/// Something that contributes columns to `tau = columns * unknowns + known`.
pub trait Columns: Sync {
    /// The unknowns, one per column.
    fn unknowns(&self) -> &[Unknown];

    /// Shape parameters that are not given a value; often none.
    fn shapes(&self) -> &[Shape];

    /// Whether [`Self::entries`] reads [`Motion::rigid_torque`].
    fn uses_rigid_torque(&self) -> bool;

    /// Channels of the log, beside positions and torques, that [`Self::entries`] reads; often none.
    fn inputs(&self) -> &[String] {
        &[]
    }

    /// The columns over a motion; entries that are zero by structure are left out. `shapes` has one value per
    /// [`Self::shapes`].
    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry>;
}

/// A whole arm: its base regressor and declared effects as columns, and the parts that are not unknown.
pub trait Arm: Columns {
    /// Degrees of freedom.
    fn dof(&self) -> usize;

    /// Names of the joints, base to tip.
    fn joints(&self) -> &[String];

    /// Joint torque per unit of the logged channel, one a joint.
    fn actuator_gain(&self) -> &[f64];

    /// Torque of the parameters that the spec fixes, `[joint][sample]`; zeros where it fixes none. `shapes` as in
    /// [`Columns::entries`].
    fn known_torque(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>>;

    /// Torque of the rigid body alone, `M ddq + C dq + G`, at `estimate` (one value per unknown), `[joint][sample]`.
    /// `shapes` as in [`Columns::entries`]. Links count as standing where the log has their joints.
    fn rigid_torque(&self, motion: &Motion, shapes: &[f64], estimate: &[f64]) -> Vec<Vec<f64>>;

    /// What the transmissions carried, `[joint][sample]`: the logged torque less that of the declared effects at `estimate`.
    /// Empty where no link stands elsewhere because of it, as for most arms.
    fn transmitted_torque(
        &self,
        _motion: &Motion,
        _shapes: &[f64],
        _estimate: &[f64],
    ) -> Vec<Vec<f64>> {
        Vec::new()
    }

    /// Joints with friction that jumps where they turn, from 0: what holds them there is not what a law says, which deviations
    /// know of, or which is left out. None with effects that say what happens there, such as bristles.
    fn dry_joints(&self) -> &[usize] {
        &[]
    }

    /// Open shapes of the friction of [`Self::dry_joints`], places in [`Columns::shapes`]: rows where joints turn say another thing than
    /// their law, so such shapes are looked for without these rows where others tell them.
    fn dry_shapes(&self) -> &[usize] {
        &[]
    }

    /// Joints whose columns say what a drive at its limit does not deliver, from 0: samples of [clipped](crate::log::Log::clipped) torque
    /// are left out of the fit of all others.
    fn saturated_joints(&self) -> &[usize] {
        &[]
    }

    /// Functions of the motion that the torques are sums of, by their names: `cos(q1 - q2) dq1^2`. What is left of a joint's torque may
    /// be one of them: a term that is missing there, or has another coefficient. None where equations are too long to be told so.
    fn terms(&self) -> Vec<String> {
        Vec::new()
    }

    /// [`Self::terms`] along a motion, `[term][sample]`.
    fn term_values(&self, _motion: &Motion) -> Vec<Vec<f64>> {
        Vec::new()
    }

    /// What is known of each unknown before any log, from CAD: one entry an unknown, or none at all.
    fn nominal(&self) -> Vec<Option<Nominal>> {
        Vec::new()
    }

    /// The arms that can be, in standard parameters; `None` where nothing says what bodies the unknowns are made of.
    fn possible_arms(&self) -> Option<PossibleArms> {
        None
    }
}

/// An arm whose torque is known without accelerations, as `tau = d/dt (momentum columns) - (drift columns)`.
///
/// Both sets of columns belong to [`Columns::unknowns`] of the arm. They read [`Motion`] without `ddq`, which may have no
/// channels.
pub trait MomentumArm: Arm {
    /// Columns of the generalized momentum, `Y_p`; entries that are zero by structure are left out.
    fn momentum(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry>;

    /// Columns of what changes the momentum beside the torque, `Y_h`: for a rigid body `C^T dq - G`.
    fn drift(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry>;

    /// Momentum of the parameters that the spec fixes, `[joint][sample]`; zeros where it fixes none. `shapes` as in
    /// [`Columns::entries`].
    fn known_momentum(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>>;

    /// Drift of the parameters that the spec fixes, `[joint][sample]`; zeros where it fixes none.
    fn known_drift(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>>;
}

/// An effect that the spec does not declare, tried on given joints.
pub trait Candidate: Columns {
    /// Kebab-case name of what it is, in reports.
    fn kind(&self) -> &str;

    /// Name in the language of what a spec declares: that of the kind, unless it is one of several laws of this kind.
    fn effect(&self) -> String {
        self.kind().replace('-', "_")
    }

    /// The joints it is tried on, from 0; none where it is of the arm as a whole.
    fn joints(&self) -> &[usize];

    /// Whether its columns are made of the torque as logged, whose residual is traced: the noise of that explains itself.
    fn follows_torque(&self) -> bool {
        false
    }

    /// Whether it is a law of time or of the part of a period, as a contact is: a wander of the zero is one of time as well.
    fn is_of_time(&self) -> bool {
        false
    }

    /// What it is where it is no torque that is added; its [`Columns::unknowns`] are then its shapes, one a [`Change::probe`], and it
    /// has no [`Columns::entries`].
    fn change(&self) -> Option<&dyn Change> {
        None
    }
}

/// An effect that changes the arm: where links stand against their joints, where gravity comes from.
pub trait Change: Sync {
    /// The arm with it, whose last shapes are its own.
    fn arm(&self) -> &dyn Arm;

    /// Own shapes at which nothing is changed, or next to nothing.
    fn neutral(&self) -> &[f64];

    /// Own shapes each of which, the others neutral, changes a little.
    fn probe(&self) -> &[f64];

    /// Whether own shapes are a change at all, for logs with samples `period` seconds apart.
    fn counts(&self, _shapes: &[f64], _period: f64) -> bool {
        true
    }
}
