//! The typed face of an arm: sizes in the type, no allocation, no panics. The compiler writes its implementations.
//!
//! A value is a parameter set; equations that need none are associated functions. Motions and results are in any
//! [`Scalar`], parameters in `f64`.

mod arrays;
#[macro_use]
mod example;
mod parameters;

pub use arrays::{as_array, from_rows, in_scalar};
pub use nalgebra::{SMatrix, SVector};
pub use parameters::FromParameters;

use crate::scalar::Scalar;
use crate::state::State;

/// A column of `N` numbers.
pub type Vector<const N: usize> = SVector<f64, N>;

/// `R` rows and `C` columns.
pub type Matrix<const R: usize, const C: usize> = SMatrix<f64, R, C>;

/// One arm with its parameters: `tau = M(q) * ddq + C(q, dq) * dq + G(q) + effects`.
///
/// The value is the parameter set, the type has the equations: `arm.inverse_dynamics(&q, &dq, &ddq)` is a torque in N m
/// (N for prismatic joints), `arm.regressor_of(&q, &dq, &ddq)` the matrix `Y` of `tau = Y * standard`, and
/// `Arm::regressor(&q, &dq, &ddq)` the same where no effect depends on the load or on shape parameters. Both routes of the
/// compiler write implementations: `#[derive(RobotModel)]` for a struct of links, the build script for a struct of base
/// parameters. What the spec fixes is inside the functions. Nothing allocates, nothing panics.
///
/// `SHAPES` counts the shape parameters of the declared effects that the spec leaves open, `STATES` their internal states and
/// `INPUTS` the channels that they read; most arms have none. Where there are states or channels, a torque is that of a
/// [`State`] which has them: methods whose name ends in `_at` take one, and those that know a motion only are not there.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// use robot_model::effects::ViscousFriction;
/// use robot_model::{Link, RobotModel, Vector};
///
/// #[derive(RobotModel)]
/// #[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
/// struct Pendulum {
///     #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
///     pivot: Link<ViscousFriction>,
/// }
///
/// // 2 kg at the tip, where the link's frame is; 0.1 N m s/rad.
/// let arm = Pendulum { pivot: Link::new(2.0, [0.0; 3], [0.0; 6]).with(ViscousFriction { fv: 0.1 }) };
/// let (q, dq, ddq) = (Vector::from([0.0]), Vector::from([3.0]), Vector::from([1.0]));
/// // m l^2 ddq + fv dq + m g l cos(q); one joint has no Coriolis torque.
/// let tau = arm.inverse_dynamics(&q, &dq, &ddq);
/// assert!((tau[0] - (0.5 + 0.3 + 9.81)).abs() < 1e-12);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no `RobotModel` of these sizes",
    note = "an arm whose effects have a memory or read channels has no methods of the motion alone: use those whose name ends in `_at`, with `State::new(q, dq, ddq).with_memory(..).with_inputs(..)`",
    note = "a struct becomes an arm by `#[derive(RobotModel)]`"
)]
pub trait RobotModel<
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize = 0,
    const STATES: usize = 0,
    const INPUTS: usize = 0,
>
{
    /// Name of the robot.
    const NAME: &'static str;
    /// Names of the joints, base to tip.
    const JOINTS: [&'static str; DOF];
    /// Names of the standard parameters: those of the rigid body, then those of the effects.
    const STANDARD_PARAMETERS: [&'static str; STANDARD];
    /// Names of the base parameters; a name that ends in `r` has others regrouped into it.
    const BASE_PARAMETERS: [&'static str; BASE];
    /// Names of the shape parameters.
    const SHAPE_PARAMETERS: [&'static str; SHAPES];
    /// Names of the channels that effects read, in the order of [`State::inputs`].
    const INPUTS: [&'static str; INPUTS];
    /// What the spec says of the standard parameters, nominal or fixed; 0 where it is silent.
    const NOMINAL: [f64; STANDARD];
    /// Values of the shape parameters before identification: the spec's, else the middle of the range.
    const NOMINAL_SHAPES: [f64; SHAPES];

    /// `beta = map * standard`; each in SI units.
    ///
    /// # Examples
    #[doc = two_link!()]
    /// // 2 kg at the elbow link's frame, the tip, which is 0.4 m from the elbow.
    /// let mut standard = Vector::zeros();
    /// standard[10] = 2.0;
    /// assert_eq!(arms::TwoLink::BASE_PARAMETERS[3], "elbow.mxr");
    /// assert!((arms::TwoLink::base_parameters(&standard)[3] - 2.0 * 0.4).abs() < 1e-12);
    /// ```
    fn base_parameters(standard: &Vector<STANDARD>) -> Vector<BASE>;

    /// The arm's standard parameters, in SI units. An arm that knows its base parameters only has those that
    /// [`FromParameters::standard_of`] makes of them: the torque is the same.
    ///
    /// # Examples
    #[doc = two_link!()]
    /// // The forearm has 2.5 kg, 0.2 m behind the tip.
    /// let standard = arms::two_link().standard();
    /// assert_eq!(arms::TwoLink::STANDARD_PARAMETERS[10..12], ["elbow.m", "elbow.mx"]);
    /// assert_eq!((standard[10], standard[11]), (2.5, -0.5));
    /// ```
    fn standard(&self) -> Vector<STANDARD>;

    /// The arm's base parameters, in the order of [`Self::BASE_PARAMETERS`].
    ///
    /// # Examples
    #[doc = two_link!()]
    /// // Of the elbow's link 2.5 kg at 0.2 m from the joint: its mass is regrouped into the first moment.
    /// assert_eq!(arms::TwoLink::BASE_PARAMETERS[3], "elbow.mxr");
    /// assert!((arms::two_link().beta()[3] - 2.5 * 0.2).abs() < 1e-12);
    /// ```
    fn beta(&self) -> Vector<BASE> {
        Self::base_parameters(&self.standard())
    }

    /// The arm's shape parameters, in the order of [`Self::SHAPE_PARAMETERS`].
    ///
    /// # Examples
    #[doc = warm!()]
    /// // Oil that halves its friction every 20 K.
    /// assert_eq!(arms::Warm::SHAPE_PARAMETERS, ["pivot.temperature_viscous.beta"]);
    /// assert_eq!(arms::warm().shapes()[0], 0.05 * std::f64::consts::LN_2);
    /// ```
    fn shapes(&self) -> Vector<SHAPES>;

    /// Mass matrix `M(q)`, DOF x DOF, kg m^2 (kg for prismatic joints); symmetric.
    ///
    /// That of the rigid body: of the inertia of effects, as of rotors, it has what regroups into a base parameter of a link, and
    /// no more. The slope of the torque by `ddq` with all of it is what
    /// [`forward_dynamics`](crate::Mechanics::forward_dynamics) solves with; for computed torque call
    /// [`Self::inverse_dynamics`].
    ///
    /// # Examples
    #[doc = two_link!()]
    /// use robot_model::Mechanics;
    /// let (arm, q, dq) = (arms::two_link(), Vector::from([0.3, -0.8]), Vector::from([1.0, 0.5]));
    /// let energy = 0.5 * dq.dot(&(arm.mass_matrix(&q) * dq));
    /// assert!((energy - arm.kinetic_energy(&q, &dq)).abs() < 1e-12);
    /// ```
    fn mass_matrix<S: Scalar>(&self, q: &SVector<S, DOF>) -> SMatrix<S, DOF, DOF>;

    /// Coriolis matrix `C(q, dq)`, DOF x DOF, with `dM/dt - 2 C` skew.
    ///
    /// # Examples
    #[doc = two_link!()]
    /// let (arm, q, dq) = (arms::two_link(), Vector::from([0.3, -0.8]), Vector::from([1.0, 0.5]));
    /// let step = dq * 1e-6;
    /// let rate = (arm.mass_matrix(&(q + step)) - arm.mass_matrix(&(q - step))) / 2e-6;
    /// let skew = rate - arm.coriolis_matrix(&q, &dq) * 2.0;
    /// assert!(skew.norm() > 0.1 && (skew + skew.transpose()).norm() < 1e-8);
    /// ```
    fn coriolis_matrix<S: Scalar>(
        &self,
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, DOF>;

    /// Gravity torque `G(q)`, N m or N.
    ///
    /// # Examples
    #[doc = two_link!()]
    /// // Stretched: 4 kg at 0.25 m, 2.5 kg at 0.7 m from the shoulder and 0.2 m from the elbow.
    /// let gravity = arms::two_link().gravity(&Vector::from([0.0, 0.0]));
    /// assert!((gravity - Vector::from([9.81 * (4.0 * 0.25 + 2.5 * 0.7), 9.81 * 2.5 * 0.2])).norm() < 1e-12);
    /// ```
    fn gravity<S: Scalar>(&self, q: &SVector<S, DOF>) -> SVector<S, DOF>;

    /// Bias torque `C * dq + G`, N m or N.
    ///
    /// # Examples
    #[doc = two_link!()]
    /// // The forearm hangs square to an upper arm of 0.5 m that turns at 2 rad/s: 0.5 m * 0.5 kg m * (2 rad/s)^2.
    /// let q = Vector::from([0.0, std::f64::consts::FRAC_PI_2]);
    /// let bias = arms::two_link().bias(&q, &Vector::from([2.0, 0.0]));
    /// assert!((bias[1] - 0.5 * 0.5 * 4.0).abs() < 1e-12);
    /// ```
    fn bias<S: Scalar>(&self, q: &SVector<S, DOF>, dq: &SVector<S, DOF>) -> SVector<S, DOF>;

    /// Joint torque `tau = M * ddq + C * dq + G + effects`, N m or N, at time zero and with no measured torque.
    ///
    /// # Examples
    #[doc = two_link!()]
    /// // Stretched, only the elbow moves: izz about the elbow is 0.14 kg m^2, fv 0.6 N m s/rad, fc 0.8 N m.
    /// let (q, dq, ddq) = (Vector::from([0.0, 0.0]), Vector::from([0.0, 3.0]), Vector::from([0.0, 2.0]));
    /// let tau = arms::two_link().inverse_dynamics(&q, &dq, &ddq);
    /// assert!((tau[1] - (0.14 * 2.0 + 0.6 * 3.0 + 0.8 + 9.81 * 2.5 * 0.2)).abs() < 1e-12);
    /// ```
    fn inverse_dynamics<S: Scalar>(
        &self,
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
        ddq: &SVector<S, DOF>,
    ) -> SVector<S, DOF>
    where
        Self: RobotModel<DOF, STANDARD, BASE, SHAPES>,
    {
        let state = State::new(*q, *dq, *ddq);
        RobotModel::<DOF, STANDARD, BASE, SHAPES>::inverse_dynamics_at(self, &state)
    }

    /// [`Self::inverse_dynamics`] for effects that depend on more than the motion. `state.rigid_torque` is not read: the
    /// load of load-dependent effects is the arm's own.
    ///
    /// # Examples
    #[doc = warm!()]
    /// let tau = arms::warm().inverse_dynamics_at(&arms::moving());
    /// assert!((tau[0] - (0.5 * 2.0 + 0.2 * 3.0)).abs() < 1e-12);
    /// ```
    fn inverse_dynamics_at<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
    ) -> SVector<S, DOF>;

    /// Regressor `Y` of this arm, DOF x STANDARD: `inverse_dynamics = Y * standard`, at time zero.
    ///
    /// Columns of load-dependent effects are those of the arm's own load `M ddq + C dq + G`, and shape parameters are its own.
    ///
    /// # Examples
    #[doc = two_link!()]
    /// let (arm, rest) = (arms::two_link(), Vector::zeros());
    /// // The torque of a change of one parameter: 0.1 kg more at the elbow link's frame, the tip.
    /// let columns = arm.regressor_of(&rest, &rest, &rest);
    /// assert!((columns.column(10) * 0.1 - Vector::from([9.81 * 0.1 * 0.9, 9.81 * 0.1 * 0.4])).norm() < 1e-12);
    /// ```
    #[must_use]
    fn regressor_of<S: Scalar>(
        &self,
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
        ddq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, STANDARD>
    where
        Self: RobotModel<DOF, STANDARD, BASE, SHAPES>,
    {
        let state = State::new(*q, *dq, *ddq);
        RobotModel::<DOF, STANDARD, BASE, SHAPES>::regressor_of_at(self, &state)
    }

    /// [`Self::regressor_of`] for effects that depend on more than the motion.
    ///
    /// # Examples
    #[doc = warm!()]
    /// // Columns of izz and fv: the oil of 40 degrees has half of the friction at 20.
    /// let row = arms::warm().regressor_of_at(&arms::moving());
    /// assert!((row[9] - 2.0).abs() < 1e-12 && (row[10] - 0.5 * 3.0).abs() < 1e-12);
    /// ```
    #[must_use]
    fn regressor_of_at<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
    ) -> SMatrix<S, DOF, STANDARD> {
        Self::regressor_at(&self.loaded(state), &self.shapes())
    }

    /// Base regressor `Y_b` of this arm, DOF x BASE: `inverse_dynamics = Y_b * beta`, besides the torque of what the spec
    /// fixes; as [`Self::regressor_of`].
    ///
    /// # Examples
    #[doc = two_link!()]
    /// let (arm, rest) = (arms::two_link(), Vector::zeros());
    /// // Stretched and at rest: 2.5 kg at 0.2 m from the elbow.
    /// let tau = arm.base_regressor_of(&rest, &rest, &rest) * arm.beta();
    /// assert!((tau[1] - 9.81 * 2.5 * 0.2).abs() < 1e-12);
    /// ```
    #[must_use]
    fn base_regressor_of<S: Scalar>(
        &self,
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
        ddq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, BASE>
    where
        Self: RobotModel<DOF, STANDARD, BASE, SHAPES>,
    {
        let state = State::new(*q, *dq, *ddq);
        RobotModel::<DOF, STANDARD, BASE, SHAPES>::base_regressor_of_at(self, &state)
    }

    /// [`Self::base_regressor_of`] for effects that depend on more than the motion.
    ///
    /// # Examples
    #[doc = warm!()]
    /// let arm = arms::warm();
    /// let tau = arm.base_regressor_of_at(&arms::moving()) * arm.beta();
    /// assert!((tau[0] - (0.5 * 2.0 + 0.2 * 3.0)).abs() < 1e-12);
    /// ```
    #[must_use]
    fn base_regressor_of_at<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
    ) -> SMatrix<S, DOF, BASE> {
        Self::base_regressor_at(&self.loaded(state), &self.shapes())
    }

    /// The same instant with the arm's own load in it, which [`Self::regressor_at`] reads: `rigid_torque = M * ddq + C * dq + G`,
    /// without the rotors that are in one sum with links of nominal inertia.
    ///
    /// # Examples
    #[doc = two_link!()]
    /// use robot_model::State;
    /// // Stretched and at rest the elbow's gear carries 2.5 kg at 0.2 m.
    /// let loaded = arms::two_link().loaded(&State::at_rest(Vector::from([0.0, 0.0])));
    /// assert!((loaded.rigid_torque[1] - 9.81 * 2.5 * 0.2).abs() < 1e-12);
    /// ```
    #[must_use]
    fn loaded<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
    ) -> State<DOF, STATES, INPUTS, S> {
        let inertial = self.mass_matrix(&state.q) * state.ddq;
        State {
            rigid_torque: inertial + self.bias(&state.q, &state.dq),
            ..*state
        }
    }

    /// Regressor `Y`, DOF x STANDARD, at time zero, without load, with nominal shapes: `tau = Y * standard` of an arm whose
    /// effects read no load and whose shape parameters are the nominal ones. Of every arm: [`Self::regressor_of`].
    ///
    /// # Examples
    #[doc = two_link!()]
    /// let (q, dq) = (Vector::from([0.3, -0.8]), Vector::from([1.0, 0.5]));
    /// let columns = arms::TwoLink::regressor(&q, &dq, &Vector::zeros());
    /// assert_eq!(arms::TwoLink::STANDARD_PARAMETERS[22], "elbow.viscous_friction.fv");
    /// assert_eq!(columns.column(22), Vector::from([0.0, 0.5]));
    /// ```
    #[must_use]
    fn regressor<S: Scalar>(
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
        ddq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, STANDARD>
    where
        Self: RobotModel<DOF, STANDARD, BASE, SHAPES>,
    {
        <Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::regressor_at(
            &State::new(*q, *dq, *ddq),
            &<Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::NOMINAL_SHAPES.into(),
        )
    }

    /// [`Self::regressor`] for effects that depend on load, time, memory, channels or shape parameters.
    ///
    /// # Examples
    #[doc = warm!()]
    /// let (arm, state) = (arms::warm(), arms::moving());
    /// let tau = arms::Warm::regressor_at(&state, &arm.shapes()) * arm.standard();
    /// assert!((tau - arm.inverse_dynamics_at(&state)).norm() < 1e-12);
    /// ```
    fn regressor_at<S: Scalar>(
        state: &State<DOF, STATES, INPUTS, S>,
        shapes: &Vector<SHAPES>,
    ) -> SMatrix<S, DOF, STANDARD>;

    /// Base regressor `Y_b`, DOF x BASE: `tau = Y_b * beta`, besides the torque of what the spec fixes; as
    /// [`Self::regressor`] at time zero, without load, with nominal shapes.
    ///
    /// # Examples
    #[doc = two_link!()]
    /// let (q, dq) = (Vector::from([0.3, -0.8]), Vector::from([1.0, -0.5]));
    /// let columns = arms::TwoLink::base_regressor(&q, &dq, &Vector::zeros());
    /// assert_eq!(arms::TwoLink::BASE_PARAMETERS[9], "elbow.coulomb_friction.fc");
    /// assert_eq!(columns.column(9), Vector::from([0.0, -1.0]));
    /// ```
    #[must_use]
    fn base_regressor<S: Scalar>(
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
        ddq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, BASE>
    where
        Self: RobotModel<DOF, STANDARD, BASE, SHAPES>,
    {
        <Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::base_regressor_at(
            &State::new(*q, *dq, *ddq),
            &<Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::NOMINAL_SHAPES.into(),
        )
    }

    /// [`Self::base_regressor`] for effects that depend on load, time, memory, channels or shape parameters.
    ///
    /// # Examples
    #[doc = warm!()]
    /// // If the oil halved its friction every 10 K:
    /// let (arm, state) = (arms::warm(), arms::moving());
    /// let tau = arms::Warm::base_regressor_at(&state, &(arm.shapes() * 2.0)) * arm.beta();
    /// assert!((tau[0] - (0.5 * 2.0 + 0.1 * 3.0)).abs() < 1e-12);
    /// ```
    fn base_regressor_at<S: Scalar>(
        state: &State<DOF, STATES, INPUTS, S>,
        shapes: &Vector<SHAPES>,
    ) -> SMatrix<S, DOF, BASE>;
}
