//! The typed face of an arm: sizes in the type, no allocation, no panics. The compiler writes its implementations.
//!
//! A value is a parameter set; equations that need none are associated functions. Motions and results are in any
//! [`Scalar`], parameters in `f64`.

pub use nalgebra::{SMatrix, SVector};

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
/// // m l^2 ddq + fv dq + m g l cos(q)
/// let tau = arm.inverse_dynamics(&q, &dq, &ddq);
/// assert!((tau[0] - (0.5 + 0.3 + 9.81)).abs() < 1e-12);
/// assert!((tau - arm.regressor_of(&q, &dq, &ddq) * arm.standard()).norm() < 1e-12);
/// assert!((tau - Pendulum::base_regressor(&q, &dq, &ddq) * arm.beta()).norm() < 1e-12);
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
    fn base_parameters(standard: &Vector<STANDARD>) -> Vector<BASE>;

    /// The arm's standard parameters, in SI units. An arm that knows its base parameters only has those that
    /// [`FromParameters::standard_of`] makes of them: the torque is the same.
    fn standard(&self) -> Vector<STANDARD>;

    /// The arm's base parameters, in the order of [`Self::BASE_PARAMETERS`].
    fn beta(&self) -> Vector<BASE> {
        Self::base_parameters(&self.standard())
    }

    /// The arm's shape parameters, in the order of [`Self::SHAPE_PARAMETERS`].
    fn shapes(&self) -> Vector<SHAPES>;

    /// Mass matrix `M(q)`, DOF x DOF, kg m^2 (kg for prismatic joints); symmetric.
    ///
    /// That of the rigid body: of the inertia of effects, as of rotors, it has what regroups into a base parameter of a link, and
    /// no more. The slope of the torque by `ddq` with all of it is what
    /// [`forward_dynamics`](crate::Mechanics::forward_dynamics) solves with; for computed torque call
    /// [`Self::inverse_dynamics`].
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{Mechanics, RobotModel, Vector};
    /// let (arm, q, dq) = (arms::two_link(), Vector::from([0.3, -0.8]), Vector::from([1.0, 0.5]));
    /// let energy = 0.5 * dq.dot(&(arm.mass_matrix(&q) * dq));
    /// assert!((energy - arm.kinetic_energy(&q, &dq)).abs() < 1e-12);
    /// ```
    fn mass_matrix<S: Scalar>(&self, q: &SVector<S, DOF>) -> SMatrix<S, DOF, DOF>;

    /// Coriolis matrix `C(q, dq)`, DOF x DOF, with `dM/dt - 2 C` skew.
    fn coriolis_matrix<S: Scalar>(
        &self,
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
    ) -> SMatrix<S, DOF, DOF>;

    /// Gravity torque `G(q)`, N m or N.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{RobotModel, Vector};
    /// // Stretched: 4 kg at 0.25 m, 2.5 kg at 0.7 m from the shoulder and 0.2 m from the elbow.
    /// let gravity = arms::two_link().gravity(&Vector::from([0.0, 0.0]));
    /// assert!((gravity - Vector::from([9.81 * (4.0 * 0.25 + 2.5 * 0.7), 9.81 * 2.5 * 0.2])).norm() < 1e-12);
    /// ```
    fn gravity<S: Scalar>(&self, q: &SVector<S, DOF>) -> SVector<S, DOF>;

    /// Bias torque `C * dq + G`, N m or N.
    fn bias<S: Scalar>(&self, q: &SVector<S, DOF>, dq: &SVector<S, DOF>) -> SVector<S, DOF>;

    /// Joint torque `tau = M * ddq + C * dq + G + effects`, N m or N, at time zero and with no measured torque.
    fn inverse_dynamics<S: Scalar>(
        &self,
        q: &SVector<S, DOF>,
        dq: &SVector<S, DOF>,
        ddq: &SVector<S, DOF>,
    ) -> SVector<S, DOF>
    where
        Self: RobotModel<DOF, STANDARD, BASE, SHAPES>,
    {
        <Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::inverse_dynamics_at(
            self,
            &State::new(*q, *dq, *ddq),
        )
    }

    /// [`Self::inverse_dynamics`] for effects that depend on more than the motion. `state.rigid_torque` is not read: the
    /// load of load-dependent effects is the arm's own.
    fn inverse_dynamics_at<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
    ) -> SVector<S, DOF>;

    /// Regressor `Y` of this arm, DOF x STANDARD: `inverse_dynamics = Y * standard`, at time zero.
    ///
    /// Columns of load-dependent effects are those of the arm's own load `M ddq + C dq + G`, and shape parameters are its own.
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
        <Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::regressor_of_at(
            self,
            &State::new(*q, *dq, *ddq),
        )
    }

    /// [`Self::regressor_of`] for effects that depend on more than the motion.
    #[must_use]
    fn regressor_of_at<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
    ) -> SMatrix<S, DOF, STANDARD> {
        Self::regressor_at(&self.loaded(state), &self.shapes())
    }

    /// Base regressor `Y_b` of this arm, DOF x BASE: `inverse_dynamics = Y_b * beta`, besides the torque of what the spec
    /// fixes; as [`Self::regressor_of`].
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
        <Self as RobotModel<DOF, STANDARD, BASE, SHAPES>>::base_regressor_of_at(
            self,
            &State::new(*q, *dq, *ddq),
        )
    }

    /// [`Self::base_regressor_of`] for effects that depend on more than the motion.
    #[must_use]
    fn base_regressor_of_at<S: Scalar>(
        &self,
        state: &State<DOF, STATES, INPUTS, S>,
    ) -> SMatrix<S, DOF, BASE> {
        Self::base_regressor_at(&self.loaded(state), &self.shapes())
    }

    /// The same instant with the arm's own load in it, `rigid_torque = M * ddq + C * dq + G`: what [`Self::regressor_at`]
    /// reads.
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
    fn regressor_at<S: Scalar>(
        state: &State<DOF, STATES, INPUTS, S>,
        shapes: &Vector<SHAPES>,
    ) -> SMatrix<S, DOF, STANDARD>;

    /// Base regressor `Y_b`, DOF x BASE: `tau = Y_b * beta`, besides the torque of what the spec fixes; as
    /// [`Self::regressor`] at time zero, without load, with nominal shapes.
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
    fn base_regressor_at<S: Scalar>(
        state: &State<DOF, STATES, INPUTS, S>,
        shapes: &Vector<SHAPES>,
    ) -> SMatrix<S, DOF, BASE>;
}

/// An arm that is made from a vector of parameters: from an estimate, or from CAD values.
///
/// Arms of links and arms of base parameters are; an arm whose value holds unknowns of which its standard parameters are
/// products is not.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// use robot_model::{FromParameters, Link, RobotModel, Vector};
///
/// #[derive(RobotModel)]
/// #[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
/// struct Pendulum {
///     #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
///     pivot: Link,
/// }
///
/// assert_eq!(Pendulum::BASE_PARAMETERS, ["pivot.mxr", "pivot.my", "pivot.izzr"]);
/// let beta = Vector::from([1.0, 0.0, 0.5]);
/// let arm = Pendulum::from_base(&beta);
/// assert!((arm.beta() - beta).norm() < 1e-12);
/// assert_eq!(arm.pivot.inertial.mass, 0.0); // regrouped into mx and izz
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be made from a vector of parameters",
    note = "its standard parameters are products of its unknowns: give the fields their values, or let the spec's unknowns be those products"
)]
pub trait FromParameters<
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize = 0,
    const STATES: usize = 0,
    const INPUTS: usize = 0,
>: RobotModel<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS> + Sized
{
    /// An arm with these standard and shape parameters. What the spec fixes stays as it is.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{FromParameters, RobotModel, Vector};
    /// let arm = arms::two_link();
    /// assert_eq!(arms::TwoLink::from_parameters(&arm.standard(), &Vector::zeros()), arm);
    /// ```
    fn from_parameters(standard: &Vector<STANDARD>, shapes: &Vector<SHAPES>) -> Self;

    /// An arm with these standard parameters and nominal shapes.
    #[must_use]
    fn from_standard(standard: &Vector<STANDARD>) -> Self {
        Self::from_parameters(standard, &Self::NOMINAL_SHAPES.into())
    }

    /// An arm with these base parameters and nominal shapes. Standard parameters that are regrouped into others are 0.
    #[must_use]
    fn from_base(beta: &Vector<BASE>) -> Self {
        Self::from_standard(&Self::standard_of(beta))
    }

    /// Standard parameters with the base parameters `beta`, and so with the same torque: of a chain the base parameters at
    /// the places of the kept standard ones, what the spec fixes at its own, 0 elsewhere.
    fn standard_of(beta: &Vector<BASE>) -> Vector<STANDARD>;
}

/// A vector's numbers as an array.
///
/// # Examples
/// ```
/// use robot_model::{Vector, model::as_array};
/// assert_eq!(as_array(&Vector::from([1.0, 2.0])), &[1.0, 2.0]);
/// ```
#[must_use]
pub fn as_array<S: Scalar, const N: usize>(vector: &SVector<S, N>) -> &[S; N] {
    &vector.data.0[0]
}

/// An arm's numbers in the scalar of its motion.
///
/// # Examples
/// ```
/// use robot_model::{Vector, model::in_scalar};
/// assert_eq!(in_scalar::<f32, 2>(&Vector::from([1.0, 0.5])), [1.0_f32, 0.5]);
/// ```
#[must_use]
pub fn in_scalar<S: Scalar, const N: usize>(vector: &Vector<N>) -> [S; N] {
    as_array(vector).map(S::of)
}

/// A matrix from `[row][column]`.
///
/// # Examples
/// ```
/// use robot_model::model::from_rows;
/// assert_eq!(from_rows(&[[1.0, 2.0], [3.0, 4.0]])[(1, 0)], 3.0);
/// ```
#[must_use]
pub fn from_rows<S: Scalar, const R: usize, const C: usize>(
    rows: &[[S; C]; R],
) -> SMatrix<S, R, C> {
    SMatrix::from_fn(|row, column| rows[row][column])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stay_rows() {
        let matrix = from_rows(&[[1.0_f64, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        assert_eq!(
            (matrix[(0, 2)].to_bits(), matrix[(1, 0)].to_bits()),
            (3f64.to_bits(), 4f64.to_bits())
        );
        let bits = as_array(&Vector::<2>::new(7.0, 8.0)).map(f64::to_bits);
        assert_eq!(bits, [7.0f64, 8.0].map(f64::to_bits));
    }
}
