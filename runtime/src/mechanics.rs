//! What the same equations give beside torque and its regressor: energies, momentum, forward dynamics, slopes, kinematics.

mod places;

pub use places::{Kinematics, Points};

use crate::model::{RobotModel, SMatrix, SVector, Vector};
use crate::scalar::Scalar;
use crate::state::State;

/// Energies, momentum, forward dynamics and slopes of an arm; the compiler writes the implementations.
///
/// Nothing allocates, nothing panics. Energies and momentum are those of the rigid body; where a rotor's inertia regroups into
/// a link's, that of the rotor is among it.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// use robot_model::{Kinematics, Link, Mechanics, RobotModel, Vector};
///
/// #[derive(RobotModel)]
/// #[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
/// struct Pendulum {
///     #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
///     pivot: Link,
/// }
///
/// // 2 kg at the tip, where the link's frame is.
/// let arm = Pendulum { pivot: Link::new(2.0, [0.0; 3], [0.0; 6]) };
/// let (q, dq) = (Vector::from([0.3]), Vector::from([3.0]));
/// assert!((arm.kinetic_energy(&q, &dq) - 0.5 * 2.0 * (0.5 * 3.0_f64).powi(2)).abs() < 1e-12);
/// // Falling freely: m l^2 ddq = -m g l cos(q)
/// let ddq = arm.forward_dynamics(&q, &dq, &Vector::zeros()).expect("a mass at the tip");
/// assert!((ddq[0] + 9.81 / 0.5 * 0.3_f64.cos()).abs() < 1e-12);
/// // The tip moves at l dq, across the arm.
/// let velocity = arm.jacobian(&q) * dq;
/// assert!((velocity[1] - 1.5 * 0.3_f64.cos()).abs() < 1e-12 && velocity[5] == 3.0);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no `Mechanics` of these sizes",
    note = "an arm whose effects have a memory or read channels has no methods of the motion alone: use those whose name ends in `_at`, with `State::new(q, dq, ddq).with_memory(..).with_inputs(..)`"
)]
pub trait Mechanics<
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize = 0,
    const STATES: usize = 0,
    const INPUTS: usize = 0,
>: RobotModel<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>
{
    /// Kinetic energy `1/2 dq^T M dq`, J.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Mechanics, Vector};
    /// // Stretched, the elbow's link turns at 2 rad/s: 0.04 kg m^2, and 2.5 kg at 0.2 m.
    /// let energy = arms::two_link().kinetic_energy(&Vector::from([0.0, 0.0]), &Vector::from([0.0, 2.0]));
    /// assert!((energy - 0.5 * (0.04 + 2.5 * 0.2_f64.powi(2)) * 2.0_f64.powi(2)).abs() < 1e-12);
    /// ```
    fn kinetic_energy<S: Scalar>(&self, q: &SVector<S, DOF>, dq: &SVector<S, DOF>) -> S;

    /// Potential energy, J, up to a constant; `gravity` is its gradient.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Mechanics, Vector};
    /// // From stretched along x to upright: 4 kg rise by 0.25 m, 2.5 kg by 0.7 m.
    /// let energy = |shoulder: f64| arms::two_link().potential_energy(&Vector::from([shoulder, 0.0]));
    /// let risen = energy(std::f64::consts::FRAC_PI_2) - energy(0.0);
    /// assert!((risen - 9.81 * (4.0 * 0.25 + 2.5 * 0.7)).abs() < 1e-12);
    /// ```
    fn potential_energy<S: Scalar>(&self, q: &SVector<S, DOF>) -> S;

    /// Accelerations that the torque `tau` (N m or N) gives at time zero: the solution of `inverse_dynamics = tau`.
    ///
    /// `None` where the inertia is singular, or not positive definite: no arm that could be built has such parameters. With
    /// friction that depends on the load, `None` too where that holds the arm in a way that Newton's method does not resolve.
    ///
    /// # Examples
    /// What accelerates an arm, from what it takes to accelerate it:
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Mechanics, RobotModel, Vector};
    /// let arm = arms::two_link();
    /// let (q, dq, ddq) = (Vector::from([0.3, -0.8]), Vector::from([1.0, 0.5]), Vector::from([2.0, -3.0]));
    /// let tau = arm.inverse_dynamics(&q, &dq, &ddq);
    /// let found = arm.forward_dynamics(&q, &dq, &tau).expect("an arm that could be built");
    /// assert!((found - ddq).norm() < 1e-12);
    /// ```
    fn forward_dynamics<S: Scalar>(
        &self,
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
        tau: &SVector<S, DOF>,
    ) -> Option<SVector<S, DOF>>
    where
        Self: Mechanics<DOF, STANDARD, BASE, SHAPES>,
    {
        <Self as Mechanics<DOF, STANDARD, BASE, SHAPES>>::forward_dynamics_at(
            self,
            &State::new(*q, *dq, SVector::zeros()),
            tau,
        )
    }

    /// [`Self::forward_dynamics`] for effects that depend on more than the motion; `state.ddq` is not read.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/warm.rs")); }
    /// use robot_model::{Mechanics, Vector};
    /// // Upright in oil of 40 degrees: 0.5 ddq + 0.2 dq = 1.6 at dq = 3.
    /// let ddq = arms::warm().forward_dynamics_at(&arms::moving(), &Vector::from([1.6])).expect("a mass at the tip");
    /// assert!((ddq[0] - 2.0).abs() < 1e-12);
    /// ```
    fn forward_dynamics_at<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
        tau: &SVector<S, DOF>,
    ) -> Option<SVector<S, DOF>>;

    /// `[i][j] = d tau_i / d q_j` of the inverse dynamics at time zero, effects included. Jumps, such as that of dry friction at
    /// rest, have no slope here.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Mechanics, RobotModel, Vector};
    /// let arm = arms::two_link();
    /// let (q, dq, ddq) = (Vector::from([0.3, -0.8]), Vector::from([1.0, 0.5]), Vector::from([2.0, -3.0]));
    /// let step = Vector::from([0.0, 1e-5]);
    /// let torque = |q| arm.inverse_dynamics(&q, &dq, &ddq);
    /// let difference = (torque(q + step) - torque(q - step)) / 2e-5;
    /// let slopes = arm.inverse_dynamics_by_position(&q, &dq, &ddq);
    /// assert!((slopes.column(1) - difference).norm() < 1e-6);
    /// ```
    fn inverse_dynamics_by_position<S: Scalar>(
        &self,
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
        ddq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, DOF>
    where
        Self: Mechanics<DOF, STANDARD, BASE, SHAPES>,
    {
        <Self as Mechanics<DOF, STANDARD, BASE, SHAPES>>::inverse_dynamics_by_position_at(
            self,
            &State::new(*q, *dq, *ddq),
        )
    }

    /// [`Self::inverse_dynamics_by_position`] for effects that depend on more than the motion.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/warm.rs")); }
    /// use robot_model::Mechanics;
    /// // Of 9.81 cos(q), upright.
    /// let slope = arms::warm().inverse_dynamics_by_position_at(&arms::moving());
    /// assert!((slope[0] + 9.81).abs() < 1e-12);
    /// ```
    fn inverse_dynamics_by_position_at<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
    ) -> SMatrix<S, DOF, DOF>;

    /// `[i][j] = d tau_i / d dq_j` of the inverse dynamics at time zero, effects included.
    ///
    /// # Examples
    /// At rest only friction depends on how fast a joint would move; Coulomb friction is flat beside its jump.
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Mechanics, Vector};
    /// let (q, slow) = (Vector::from([0.3, -0.8]), Vector::from([1e-9, 1e-9]));
    /// let slopes = arms::two_link().inverse_dynamics_by_velocity(&q, &slow, &Vector::zeros());
    /// // fv of the shoulder and of the elbow
    /// assert!((slopes[(0, 0)] - 1.5).abs() < 1e-6 && (slopes[(1, 1)] - 0.6).abs() < 1e-6);
    /// assert!(slopes[(0, 1)].abs() < 1e-6 && slopes[(1, 0)].abs() < 1e-6);
    /// ```
    fn inverse_dynamics_by_velocity<S: Scalar>(
        &self,
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
        ddq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, DOF>
    where
        Self: Mechanics<DOF, STANDARD, BASE, SHAPES>,
    {
        <Self as Mechanics<DOF, STANDARD, BASE, SHAPES>>::inverse_dynamics_by_velocity_at(
            self,
            &State::new(*q, *dq, *ddq),
        )
    }

    /// [`Self::inverse_dynamics_by_velocity`] for effects that depend on more than the motion.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/warm.rs")); }
    /// use robot_model::Mechanics;
    /// // Oil of 40 degrees has half of the 0.4 N m s/rad at 20.
    /// let slope = arms::warm().inverse_dynamics_by_velocity_at(&arms::moving());
    /// assert!((slope[0] - 0.2).abs() < 1e-12);
    /// ```
    fn inverse_dynamics_by_velocity_at<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
    ) -> SMatrix<S, DOF, DOF>;

    /// Momentum regressor `Y_p`, DOF x STANDARD: `tau = d/dt (Y_p * standard) - Y_h * standard`, with nominal shapes.
    ///
    /// No acceleration is in it. Effects that read accelerations otherwise, as friction that depends on the load does, have no
    /// such form: their columns are zero here and in `Y_h`, and the equation holds for the torque without them. The emitted
    /// functions say which they are.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Mechanics, RobotModel, Vector};
    /// let arm = arms::two_link();
    /// let (q, dq) = (Vector::from([0.3, -0.8]), Vector::from([1.0, 0.5]));
    /// let momentum = arms::TwoLink::momentum_regressor(&q, &dq) * arm.standard();
    /// assert!((momentum - arm.mass_matrix(&q) * dq).norm() < 1e-12);
    /// ```
    #[must_use]
    fn momentum_regressor<S: Scalar>(
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, STANDARD>
    where
        Self: Mechanics<DOF, STANDARD, BASE, SHAPES>,
    {
        let state = State::new(*q, *dq, SVector::zeros());
        <Self as Mechanics<DOF, STANDARD, BASE, SHAPES>>::momentum_regressor_at(
            &state,
            &<Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::NOMINAL_SHAPES.into(),
        )
    }

    /// [`Self::momentum_regressor`] for effects that depend on more than the motion; `state.ddq` is not read.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/warm.rs")); }
    /// use robot_model::{Mechanics, RobotModel};
    /// let (arm, state) = (arms::warm(), arms::moving()); // m l^2 dq
    /// let momentum = arms::Warm::momentum_regressor_at(&state, &arm.shapes()) * arm.standard();
    /// assert!((momentum[0] - 0.5 * 3.0).abs() < 1e-12);
    /// ```
    fn momentum_regressor_at<S: Scalar>(
        state: &State<DOF, STATES, INPUTS, S>,
        shapes: &Vector<SHAPES>,
    ) -> SMatrix<S, DOF, STANDARD>;

    /// Drift regressor `Y_h`, DOF x STANDARD: what changes the momentum beside the torque. For the rigid body
    /// `Y_h * standard = C^T dq - G`. Zero columns as in [`Self::momentum_regressor`].
    ///
    /// # Examples
    /// At rest nothing but gravity changes the momentum:
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Mechanics, RobotModel, Vector};
    /// let (arm, q) = (arms::two_link(), Vector::from([0.3, -0.8]));
    /// let drift = arms::TwoLink::drift_regressor(&q, &Vector::zeros()) * arm.standard();
    /// assert!((drift + arm.gravity(&q)).norm() < 1e-12);
    /// ```
    #[must_use]
    fn drift_regressor<S: Scalar>(
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, STANDARD>
    where
        Self: Mechanics<DOF, STANDARD, BASE, SHAPES>,
    {
        let state = State::new(*q, *dq, SVector::zeros());
        <Self as Mechanics<DOF, STANDARD, BASE, SHAPES>>::drift_regressor_at(
            &state,
            &<Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::NOMINAL_SHAPES.into(),
        )
    }

    /// [`Self::drift_regressor`] for effects that depend on more than the motion; `state.ddq` is not read.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/warm.rs")); }
    /// use robot_model::{Mechanics, RobotModel};
    /// let (arm, state) = (arms::warm(), arms::moving());
    /// let drift = arms::Warm::drift_regressor_at(&state, &arm.shapes()) * arm.standard();
    /// assert!((drift[0] + 0.2 * 3.0).abs() < 1e-12);
    /// ```
    fn drift_regressor_at<S: Scalar>(
        state: &State<DOF, STATES, INPUTS, S>,
        shapes: &Vector<SHAPES>,
    ) -> SMatrix<S, DOF, STANDARD>;

    /// `Y_p` of the base parameters, DOF x BASE, besides what the spec fixes. Zero columns as in
    /// [`Self::momentum_regressor`].
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Mechanics, RobotModel, Vector};
    /// let (q, dq) = (Vector::from([0.0, 0.0]), Vector::from([0.0, 2.0]));
    /// // Stretched, the elbow's link turns: 0.14 kg m^2 about the elbow.
    /// let momentum = arms::TwoLink::base_momentum_regressor(&q, &dq) * arms::two_link().beta();
    /// assert!((momentum[1] - 0.14 * 2.0).abs() < 1e-12);
    /// ```
    #[must_use]
    fn base_momentum_regressor<S: Scalar>(
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, BASE>
    where
        Self: Mechanics<DOF, STANDARD, BASE, SHAPES>,
    {
        let state = State::new(*q, *dq, SVector::zeros());
        <Self as Mechanics<DOF, STANDARD, BASE, SHAPES>>::base_momentum_regressor_at(
            &state,
            &<Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::NOMINAL_SHAPES.into(),
        )
    }

    /// [`Self::base_momentum_regressor`] for effects that depend on more than the motion.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/warm.rs")); }
    /// use robot_model::{Mechanics, RobotModel};
    /// let (arm, state) = (arms::warm(), arms::moving());
    /// let momentum = arms::Warm::base_momentum_regressor_at(&state, &arm.shapes()) * arm.beta();
    /// assert!((momentum[0] - 0.5 * 3.0).abs() < 1e-12);
    /// ```
    fn base_momentum_regressor_at<S: Scalar>(
        state: &State<DOF, STATES, INPUTS, S>,
        shapes: &Vector<SHAPES>,
    ) -> SMatrix<S, DOF, BASE>;

    /// `Y_h` of the base parameters, DOF x BASE, besides what the spec fixes. Zero columns as in
    /// [`Self::momentum_regressor`].
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Mechanics, RobotModel, Vector};
    /// let (q, dq) = (Vector::from([0.0, 0.0]), Vector::from([0.0, 2.0]));
    /// // Gravity of 2.5 kg at 0.2 m, and friction: fv 0.6 N m s/rad, fc 0.8 N m.
    /// let drift = arms::TwoLink::base_drift_regressor(&q, &dq) * arms::two_link().beta();
    /// assert!((drift[1] + 9.81 * 2.5 * 0.2 + 0.6 * 2.0 + 0.8).abs() < 1e-12);
    /// ```
    #[must_use]
    fn base_drift_regressor<S: Scalar>(
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, BASE>
    where
        Self: Mechanics<DOF, STANDARD, BASE, SHAPES>,
    {
        let state = State::new(*q, *dq, SVector::zeros());
        <Self as Mechanics<DOF, STANDARD, BASE, SHAPES>>::base_drift_regressor_at(
            &state,
            &<Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::NOMINAL_SHAPES.into(),
        )
    }

    /// [`Self::base_drift_regressor`] for effects that depend on more than the motion.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/warm.rs")); }
    /// use robot_model::{Mechanics, RobotModel};
    /// let (arm, state) = (arms::warm(), arms::moving());
    /// let drift = arms::Warm::base_drift_regressor_at(&state, &arm.shapes()) * arm.beta();
    /// assert!((drift[0] + 0.2 * 3.0).abs() < 1e-12);
    /// ```
    fn base_drift_regressor_at<S: Scalar>(
        state: &State<DOF, STATES, INPUTS, S>,
        shapes: &Vector<SHAPES>,
    ) -> SMatrix<S, DOF, BASE>;
}
