//! Effects that are tried.

use super::{Arm, Columns};

/// An effect that the spec does not declare, tried on given joints.
///
/// # Examples
/// ```
/// use robot_model::columns::{Candidate, Columns, Entry, Shape, Unknown};
/// use robot_model::motion::Motion;
///
/// /// `tau = k q` on the first joint.
/// struct Spring([Unknown; 1]);
///
/// impl Columns for Spring {
///     fn unknowns(&self) -> &[Unknown] { &self.0 }
///     fn shapes(&self) -> &[Shape] { &[] }
///     fn uses_rigid_torque(&self) -> bool { false }
///     fn entries(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
///         vec![Entry { joint: 0, column: 0, values: motion.smooth.q[0].clone() }]
///     }
/// }
///
/// impl Candidate for Spring {
///     fn kind(&self) -> &str { "joint-spring" }
///     fn joints(&self) -> &[usize] { &[0] }
/// }
///
/// let spring = Spring([Unknown { name: "shoulder.joint_spring.k".to_owned(), nonnegative: true }]);
/// assert_eq!((spring.kind(), spring.effect().as_str(), spring.joints()), ("joint-spring", "joint_spring", &[0][..]));
/// ```
pub trait Candidate: Columns {
    /// Kebab-case name of what it is, in reports.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::Candidate;
    /// assert_eq!(pendulum::dry_friction().kind(), "coulomb-friction");
    /// ```
    fn kind(&self) -> &str;

    /// Name in the language of what a spec declares: that of the kind, unless it is one of several laws of this kind.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::Candidate;
    /// assert_eq!(pendulum::dry_friction().effect(), "coulomb_friction"); // of the kind `coulomb-friction`
    /// ```
    fn effect(&self) -> String {
        self.kind().replace('-', "_")
    }

    /// The joints it is tried on, from 0; none where it is of the arm as a whole.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::Candidate;
    /// assert_eq!(pendulum::dry_friction().joints(), [0]);
    /// ```
    fn joints(&self) -> &[usize];

    /// Whether its columns are made of the torque as logged, whose residual is traced: the noise of that explains itself.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::Candidate;
    /// assert!(!pendulum::dry_friction().follows_torque()); // it follows the velocity
    /// ```
    fn follows_torque(&self) -> bool {
        false
    }

    /// Whether it is a law of time or of the part of a period, as a contact is: a wander of the zero is one of time as well.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::Candidate;
    /// assert!(!pendulum::dry_friction().is_of_time());
    /// ```
    fn is_of_time(&self) -> bool {
        false
    }

    /// Whether its torque is one of the positions of its joints and of nothing else, as a spring's and a ripple's are.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::Candidate;
    /// assert!(!pendulum::dry_friction().is_of_position()); // it follows the velocity
    /// ```
    fn is_of_position(&self) -> bool {
        false
    }

    /// What it is where it is no torque that is added; its [`Columns::unknowns`] are then its shapes, one a [`Change::probe`], and it
    /// has no [`Columns::entries`].
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// use robot_model::columns::Candidate;
    /// assert!(pendulum::dry_friction().change().is_none()); // a torque that is added
    /// ```
    fn change(&self) -> Option<&dyn Change> {
        None
    }
}

/// An effect that changes the arm: where links stand against their joints, where gravity comes from.
///
/// # Examples
/// An encoder that is off, `mx sin(q + lean)`:
/// ```
#[doc = include_str!("../../tests/doc/offset.rs")]
///
/// let own = |lean: f64| offset().arm().entries(&axis::upright(), &[0.1, lean])[1].values[0];
/// assert_eq!((own(0.0), own(0.2)), (1.0, 0.2_f64.cos())); // sin(pi / 2 + lean)
/// ```
pub trait Change: Sync {
    /// The arm with it, whose last shapes are its own.
    ///
    /// # Examples
    /// ```
    /// # mod offset { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/offset.rs")); }
    /// use robot_model::columns::{Arm, Change, Columns};
    /// // How far the encoder is off is the last of its shapes.
    /// let offset = offset::offset();
    /// assert_eq!(offset.arm().shapes()[1].name, "axis.encoder_offset.lean");
    /// ```
    fn arm(&self) -> &dyn Arm;

    /// Own shapes at which nothing is changed, or next to nothing.
    ///
    /// # Examples
    /// ```
    /// # mod offset { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/offset.rs")); }
    /// use robot_model::columns::Change;
    /// assert_eq!(offset::offset().neutral(), [0.0]); // an encoder that is right
    /// ```
    fn neutral(&self) -> &[f64];

    /// Own shapes each of which, the others neutral, changes a little.
    ///
    /// # Examples
    /// ```
    /// # mod offset { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/offset.rs")); }
    /// use robot_model::columns::Change;
    /// assert_eq!(offset::offset().probe(), [0.01]); // rad
    /// ```
    fn probe(&self) -> &[f64];

    /// Whether own shapes are a change at all, for logs with samples `period` seconds apart.
    ///
    /// # Examples
    /// ```
    /// # mod offset { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/offset.rs")); }
    /// use robot_model::columns::Change;
    /// // Up to half a turn, however fast the log is; a delay would have to be some samples.
    /// assert!(offset::offset().counts(&[0.1], 0.002) && !offset::offset().counts(&[3.2], 0.002));
    /// ```
    fn counts(&self, _shapes: &[f64], _period: f64) -> bool {
        true
    }
}
