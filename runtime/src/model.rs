//! The typed face of an arm: sizes in the type, no allocation, no panics. The compiler writes its implementations.

use nalgebra::{SMatrix, SVector};

/// A column of `N` numbers.
pub type Vector<const N: usize> = SVector<f64, N>;

/// `R` rows and `C` columns.
pub type Matrix<const R: usize, const C: usize> = SMatrix<f64, R, C>;

/// Where an arm is and how it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<const DOF: usize> {
    /// Joint positions, rad or m.
    pub q: Vector<DOF>,
    /// Joint velocities, rad/s or m/s.
    pub dq: Vector<DOF>,
    /// Joint accelerations, rad/s^2 or m/s^2.
    pub ddq: Vector<DOF>,
    /// Torque of the rigid body alone, N m or N: the load of load-dependent effects in a regressor. Others ignore it.
    pub rigid_torque: Vector<DOF>,
    /// Seconds since the start of the log; for effects that depend on time.
    pub time: f64,
}

impl<const DOF: usize> State<DOF> {
    /// A motion, with no load and time zero.
    ///
    /// # Examples
    /// ```
    /// use robot_model::{State, Vector};
    /// let state = State::new(Vector::from([0.1]), Vector::from([2.0]), Vector::zeros());
    /// assert_eq!((state.dq[0], state.time), (2.0, 0.0));
    /// assert_eq!(State::at_rest(state.q), State { dq: Vector::zeros(), ..state });
    /// ```
    #[must_use]
    pub fn new(q: Vector<DOF>, dq: Vector<DOF>, ddq: Vector<DOF>) -> Self {
        Self {
            q,
            dq,
            ddq,
            rigid_torque: Vector::zeros(),
            time: 0.0,
        }
    }

    /// A position at rest.
    #[must_use]
    pub fn at_rest(q: Vector<DOF>) -> Self {
        Self::new(q, Vector::zeros(), Vector::zeros())
    }
}

/// The equations of motion of one arm: `tau = M(q) * ddq + C(q, dq) * dq + G(q) + effects`.
///
/// `beta` are the base parameters in the order of [`Self::BASE_PARAMETERS`]; what the spec fixes is inside the functions.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// use robot_model::{RobotModel, State, Vector};
///
/// #[derive(RobotModel)]
/// #[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
/// struct Pendulum {
///     #[joint(revolute, a = 0.5, alpha = 0, d = 0)]
///     #[effects(viscous_friction)]
///     pivot: (),
/// }
///
/// // 2 kg at the tip, 0.1 N m s/rad.
/// let standard = Pendulum::STANDARD_PARAMETERS.map(|name| match name {
///     "pivot.m" => 2.0,
///     "pivot.viscous_friction.fv" => 0.1,
///     _ => 0.0,
/// });
/// let beta = Pendulum::base_parameters(&standard.into());
/// let state = State::new(Vector::from([0.0]), Vector::from([3.0]), Vector::from([1.0]));
/// // m l^2 ddq + fv dq + m g l cos(q)
/// let tau = Pendulum::inverse_dynamics(&state, &beta);
/// assert!((tau[0] - (0.5 + 0.3 + 9.81)).abs() < 1e-12);
/// assert!((tau - Pendulum::base_regressor(&state) * beta).norm() < 1e-12);
/// ```
pub trait RobotModel<const DOF: usize, const STANDARD: usize, const BASE: usize> {
    /// Name of the robot.
    const NAME: &'static str;
    /// Names of the joints, base to tip.
    const JOINTS: [&'static str; DOF];
    /// Names of the standard parameters: ten a link about the link frame's origin, then those of the effects.
    const STANDARD_PARAMETERS: [&'static str; STANDARD];
    /// Names of the base parameters; a name that ends in `r` has others regrouped into it.
    const BASE_PARAMETERS: [&'static str; BASE];

    /// `beta = map * standard`; each in SI units.
    fn base_parameters(standard: &Vector<STANDARD>) -> Vector<BASE>;

    /// Mass matrix `M(q)`, DOF x DOF, kg m^2 (kg for prismatic joints); symmetric. Reads `state.q`.
    fn mass_matrix(state: &State<DOF>, beta: &Vector<BASE>) -> Matrix<DOF, DOF>;

    /// Coriolis matrix `C(q, dq)`, DOF x DOF, with `dM/dt - 2 C` skew. Reads `state.q` and `state.dq`.
    fn coriolis_matrix(state: &State<DOF>, beta: &Vector<BASE>) -> Matrix<DOF, DOF>;

    /// Gravity torque `G(q)`, N m or N. Reads `state.q`.
    fn gravity(state: &State<DOF>, beta: &Vector<BASE>) -> Vector<DOF>;

    /// Bias torque `C * dq + G`, N m or N. Reads `state.q` and `state.dq`.
    fn bias(state: &State<DOF>, beta: &Vector<BASE>) -> Vector<DOF>;

    /// Joint torque `tau = M * ddq + C * dq + G + effects`, N m or N. Does not read `state.rigid_torque`: the load of
    /// load-dependent effects is the arm's own.
    fn inverse_dynamics(state: &State<DOF>, beta: &Vector<BASE>) -> Vector<DOF>;

    /// Regressor `Y`, DOF x STANDARD: `tau = Y * standard`.
    fn regressor(state: &State<DOF>) -> Matrix<DOF, STANDARD>;

    /// Base regressor `Y_b`, DOF x BASE: `tau = Y_b * beta`, besides the torque of what the spec fixes.
    fn base_regressor(state: &State<DOF>) -> Matrix<DOF, BASE>;
}

/// A vector's numbers as an array.
///
/// # Examples
/// ```
/// use robot_model::{Vector, model::as_array};
/// assert_eq!(as_array(&Vector::from([1.0, 2.0])), &[1.0, 2.0]);
/// ```
#[must_use]
pub fn as_array<const N: usize>(vector: &Vector<N>) -> &[f64; N] {
    &vector.data.0[0]
}

/// A matrix from `[row][column]`.
///
/// # Examples
/// ```
/// use robot_model::model::from_rows;
/// assert_eq!(from_rows(&[[1.0, 2.0], [3.0, 4.0]])[(1, 0)], 3.0);
/// ```
#[must_use]
pub fn from_rows<const R: usize, const C: usize>(rows: &[[f64; C]; R]) -> Matrix<R, C> {
    Matrix::from_fn(|row, column| rows[row][column])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stay_rows() {
        let matrix = from_rows(&[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        assert_eq!(
            (matrix[(0, 2)].to_bits(), matrix[(1, 0)].to_bits()),
            (3f64.to_bits(), 4f64.to_bits())
        );
        let bits = as_array(&Vector::<2>::new(7.0, 8.0)).map(f64::to_bits);
        assert_eq!(bits, [7.0f64, 8.0].map(f64::to_bits));
    }
}
