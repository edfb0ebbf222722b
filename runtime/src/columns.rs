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

mod candidate;
mod momentum;

pub use candidate::{Candidate, Change};
pub use momentum::MomentumArm;

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
///
/// # Examples
/// The module has one of an effect, [`Arm`] of a whole arm; examples of the methods are of that arm.
pub trait Columns: Sync {
    /// The unknowns, one per column.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Columns;
    /// let axis = axis::axis();
    /// let names: Vec<&str> = axis.unknowns().iter().map(|unknown| unknown.name.as_str()).collect();
    /// assert_eq!(names, ["link.izz", "link.mx", "axis.stribeck.fs", "axis.warm.kt"]);
    /// ```
    fn unknowns(&self) -> &[Unknown];

    /// Shape parameters that are not given a value; often none.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Columns;
    /// // The Stribeck speed, and how far the encoder is off.
    /// let axis = axis::axis();
    /// assert_eq!((axis.shapes().len(), axis.shapes()[0].name.as_str()), (2, "axis.stribeck.vs"));
    /// ```
    fn shapes(&self) -> &[Shape];

    /// Whether [`Self::entries`] reads [`Motion::rigid_torque`].
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Columns;
    /// assert!(!axis::axis().uses_rigid_torque()); // no friction that grows with the load
    /// ```
    fn uses_rigid_torque(&self) -> bool;

    /// Channels of the log, beside positions and torques, that [`Self::entries`] reads; often none.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Columns;
    /// // Its friction falls as it warms up.
    /// assert_eq!(axis::axis().inputs(), ["temperature"]);
    /// ```
    fn inputs(&self) -> &[String] {
        &[]
    }

    /// The columns over a motion; entries that are zero by structure are left out. `shapes` has one value per
    /// [`Self::shapes`].
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Columns;
    /// // Of izz, mx, fs and kt at 40 degrees: ddq, sin(q), exp(-(dq / vs)^2), 40 dq.
    /// let entries = axis::axis().entries(&axis::upright(), &[0.1, 0.0]);
    /// let columns: Vec<f64> = entries.iter().map(|entry| entry.values[0]).collect();
    /// assert_eq!(columns, [3.0, 1.0, (-1.0_f64).exp(), 4.0]);
    /// ```
    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry>;
}

/// A whole arm: its base regressor and declared effects as columns, and the parts that are not unknown.
///
/// # Examples
/// ```
#[doc = include_str!("../tests/doc/axis.rs")]
///
/// // 50 tau at vs = 0.1, with izz = 0.5, mx = 9, fs = 1.
/// let (shapes, estimate) = ([0.1, 0.0], [0.5, 9.0, 1.0, 0.0]);
/// let entries = axis().entries(&upright(), &shapes);
/// let unknown: f64 = entries.iter().map(|entry| estimate[entry.column] * entry.values[0]).sum();
/// let torque = unknown + axis().known_torque(&upright(), &shapes)[0][0];
/// assert!((torque - (0.5 * 3.0 + 9.0 + (-1.0_f64).exp() + 0.2 * 0.1)).abs() < 1e-12);
/// ```
pub trait Arm: Columns {
    /// Degrees of freedom.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// assert_eq!(axis::axis().dof(), 1);
    /// ```
    fn dof(&self) -> usize;

    /// Names of the joints, base to tip.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// assert_eq!(axis::axis().joints(), ["axis"]);
    /// ```
    fn joints(&self) -> &[String];

    /// Joint torque per unit of the logged channel, one a joint.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// assert_eq!(axis::axis().actuator_gain(), [50.0]); // N m/A: its log has currents
    /// ```
    fn actuator_gain(&self) -> &[f64];

    /// Torque of the parameters that the spec fixes, `[joint][sample]`; zeros where it fixes none. `shapes` as in
    /// [`Columns::entries`].
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// // 0.2 N m s/rad at 0.1 rad/s.
    /// assert_eq!(axis::axis().known_torque(&axis::upright(), &[0.1, 0.0]), [[0.2 * 0.1]]);
    /// ```
    fn known_torque(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>>;

    /// The load that effects read at `estimate` (one value per unknown), `[joint][sample]`: torque of the rigid body alone,
    /// `M ddq + C dq + G`, without rotors that are in one sum with links, as far as their share is known. `shapes` as in [`Columns::entries`]. Links count as standing where the log has their joints.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// // izz ddq + mx sin(q)
    /// let torque = axis::axis().rigid_torque(&axis::upright(), &[0.1, 0.0], &[0.5, 9.0, 1.0, 0.0]);
    /// assert_eq!(torque, [[0.5 * 3.0 + 9.0]]);
    /// ```
    fn rigid_torque(&self, motion: &Motion, shapes: &[f64], estimate: &[f64]) -> Vec<Vec<f64>>;

    /// What the transmissions carried, `[joint][sample]`: the logged torque less that of the declared effects at `estimate`.
    /// Empty where no link stands elsewhere because of it, as for most arms.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// // The link stands where its joint does: nothing bends.
    /// assert!(axis::axis().transmitted_torque(&axis::upright(), &[0.1, 0.0], &[0.5, 9.0, 1.0, 0.0]).is_empty());
    /// ```
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
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// assert_eq!(axis::axis().dry_joints(), [0]); // Stribeck friction jumps where the axis turns
    /// ```
    fn dry_joints(&self) -> &[usize] {
        &[]
    }

    /// Open shapes of the friction of [`Self::dry_joints`], places in [`Columns::shapes`]: rows where joints turn say another thing than
    /// their law, so such shapes are looked for without these rows where others tell them.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::{Arm, Columns};
    /// let axis = axis::axis();
    /// assert_eq!(axis.shapes()[axis.dry_shapes()[0]].name, "axis.stribeck.vs");
    /// ```
    fn dry_shapes(&self) -> &[usize] {
        &[]
    }

    /// Whether links stand elsewhere by what their transmissions carry, which is known by torques as noisy as they are logged, and that twice
    /// differentiated: the bands of a fit are then those of [`Bands::for_rate`](crate::signal::Bands::for_rate) and no wider.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// assert!(!axis::axis().follows_load()); // a stiff one
    /// ```
    fn follows_load(&self) -> bool {
        false
    }

    /// Joints whose columns say what a drive at its limit does not deliver, from 0: samples of [clipped](crate::log::Log::clipped) torque
    /// are left out of the fit of all others.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// assert!(axis::axis().saturated_joints().is_empty()); // no column says what a limit takes
    /// ```
    fn saturated_joints(&self) -> &[usize] {
        &[]
    }

    /// Functions of the motion that the torques are sums of, by their names: `cos(q1 - q2) dq1^2`. What is left of a joint's torque may
    /// be one of them: a term that is missing there, or has another coefficient. None where equations are too long to be told so.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// assert_eq!(axis::axis().terms(), ["ddq1", "sin(q1)"]);
    /// ```
    fn terms(&self) -> Vec<String> {
        Vec::new()
    }

    /// [`Self::terms`] along a motion, `[term][sample]`.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// assert_eq!(axis::axis().term_values(&axis::upright()), [[3.0], [1.0]]); // ddq and sin(q)
    /// ```
    fn term_values(&self, _motion: &Motion) -> Vec<Vec<f64>> {
        Vec::new()
    }

    /// What is known of each unknown before any log, from CAD: one entry an unknown, or none at all.
    ///
    /// # Examples
    /// ```
    /// # mod axis { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs")); }
    /// use robot_model::columns::Arm;
    /// // CAD knows the moment of inertia, and no friction.
    /// let nominal = axis::axis().nominal();
    /// assert_eq!((nominal[0].map(|izz| izz.value), nominal[2]), (Some(0.5), None));
    /// ```
    fn nominal(&self) -> Vec<Option<Nominal>> {
        Vec::new()
    }

    /// The arms that can be, in standard parameters; `None` where nothing says what bodies the unknowns are made of.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::Arm;
    /// // izz, mx and fv of a pendulum are those of one body, and friction that is not negative.
    /// let arms = pendulum::pendulum().possible_arms().expect("a link and friction");
    /// assert_eq!((arms.links.len(), arms.nonnegative.len()), (1, 1));
    /// ```
    fn possible_arms(&self) -> Option<PossibleArms> {
        None
    }
}
