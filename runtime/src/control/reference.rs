//! The regressor of a reference velocity: what adaptive control multiplies its parameters with.

use crate::mechanics::Mechanics;
use crate::model::{Matrix, RobotModel, Vector};
use crate::state::State;

/// Velocity and acceleration of which the torque is wanted while the arm moves with others.
///
/// # Examples
/// ```
/// use robot_model::Vector;
/// use robot_model::control::Reference;
/// let reference = Reference { dq: Vector::from([1.0]), ddq: Vector::from([-0.5]) };
/// assert_eq!(reference.ddq[0], -0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference<const D: usize> {
    /// Velocity, rad/s or m/s.
    pub dq: Vector<D>,
    /// Acceleration, rad/s^2 or m/s^2.
    pub ddq: Vector<D>,
}

/// The regressor `Y_r` with `Y_r beta = M ddq_r + C(q, dq) dq_r + G + effects(q, dq, ddq_r)`, besides what the spec fixes; DOF x BASE.
///
/// The arm's own base regressor has `C(q, dq) dq` in it, which is quadratic in `dq`. By Christoffel symbols
/// `C(q, u) v = C(q, v) u`, so with `e = dq_r - dq` and `c(u) = C(q, u) u`
///
/// ```text
/// C(q, dq) e = (c(dq + e) - c(dq - e)) / 4
/// Y_r = Y_b(q, dq, ddq_r) + (Y_b(q, dq + e, 0) - Y_b(q, dq - e, 0)) / 4
/// ```
///
/// where the second term is of the columns with a momentum only: friction stays that of the measured velocity.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::{Reference, ReferenceRegressor};
/// use robot_model::{RobotModel, State, Vector};
///
/// let arm = arms::two_link();
/// let regressor = ReferenceRegressor::new(&arm);
/// let state = State::new(Vector::from([0.3, 0.9]), Vector::from([1.0, -0.5]), Vector::zeros());
/// let reference = Reference { dq: Vector::from([0.8, 0.1]), ddq: Vector::from([2.0, 1.0]) };
/// let (q, dq) = (&state.q, &state.dq);
/// let friction = arm.inverse_dynamics(q, dq, &Vector::zeros()) - arm.bias(q, dq);
/// let wanted = arm.mass_matrix(q) * reference.ddq + arm.coriolis_matrix(q, dq) * reference.dq + arm.gravity(q) + friction;
/// assert!((regressor.at(&arm, &state, &reference) * arm.beta() - wanted).norm() < 1e-12);
/// assert!((ReferenceRegressor::torque(&arm, &state, &reference) - wanted).norm() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReferenceRegressor<const BASE: usize> {
    /// Columns with a momentum.
    inertial: [bool; BASE],
}

impl<const BASE: usize> ReferenceRegressor<BASE> {
    /// Looks which columns of an arm have a momentum.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{Reference, ReferenceRegressor};
    /// use robot_model::{RobotModel, State, Vector};
    ///
    /// let arm = arms::two_link();
    /// let regressor = ReferenceRegressor::new(&arm);
    /// // At rest, stretched, with no reference but the pose: gravity.
    /// let rest = Reference { dq: Vector::zeros(), ddq: Vector::zeros() };
    /// let tau = regressor.at(&arm, &State::at_rest(Vector::from([0.0, 0.0])), &rest) * arm.beta();
    /// assert!((tau[1] - 9.81 * 2.5 * 0.2).abs() < 1e-12);
    /// ```
    pub fn new<A, const D: usize, const S: usize, const H: usize, const M: usize, const I: usize>(
        arm: &A,
    ) -> Self
    where
        A: Mechanics<D, S, BASE, H, M, I>,
    {
        // Columns that vanish do so everywhere; two places, so that a column that happens to be zero at one is seen at the other.
        let places = [0.7, -1.1].map(|start: f64| {
            let some = |k: usize| start + 0.37 * k as f64;
            let state = State::new(
                Vector::from_fn(|k, _| some(k)),
                Vector::from_fn(|k, _| 1.3 * start - 0.21 * k as f64),
                Vector::zeros(),
            );
            let state = state
                .with_memory(Vector::repeat(0.1))
                .with_inputs(Vector::repeat(1.0));
            A::base_momentum_regressor_at(&state, &arm.shapes())
        });
        Self {
            inertial: core::array::from_fn(|column| {
                places
                    .iter()
                    .any(|regressor| regressor.column(column).iter().any(|entry| *entry != 0.0))
            }),
        }
    }

    /// `Y_r` at a state, of which the acceleration is not read.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{Reference, ReferenceRegressor};
    /// use robot_model::{RobotModel, State, Vector};
    ///
    /// let arm = arms::two_link();
    /// // A reference that is the motion itself: the arm's own base regressor.
    /// let (q, dq, ddq) = (Vector::from([0.3, 0.9]), Vector::from([1.0, -0.5]), Vector::from([2.0, 1.0]));
    /// let regressor = ReferenceRegressor::new(&arm).at(&arm, &State::new(q, dq, ddq), &Reference { dq, ddq });
    /// assert!((regressor - arm.base_regressor_of(&q, &dq, &ddq)).norm() < 1e-12);
    /// ```
    #[must_use]
    pub fn at<A, const D: usize, const S: usize, const H: usize, const M: usize, const I: usize>(
        &self,
        arm: &A,
        state: &State<D, M, I>,
        reference: &Reference<D>,
    ) -> Matrix<D, BASE>
    where
        A: RobotModel<D, S, BASE, H, M, I>,
    {
        let shapes = arm.shapes();
        let coasting = |dq: Vector<D>| {
            let state = State {
                dq,
                ddq: Vector::zeros(),
                ..*state
            };
            A::base_regressor_at(&state, &shapes)
        };
        let mut regressor = arm.base_regressor_of_at(&State {
            ddq: reference.ddq,
            ..*state
        });
        let ahead = coasting(reference.dq);
        let behind = coasting(state.dq * 2.0 - reference.dq);
        for (column, inertial) in self.inertial.iter().enumerate() {
            if *inertial {
                for joint in 0..D {
                    let difference = ahead[(joint, column)] - behind[(joint, column)];
                    regressor[(joint, column)] += 0.25 * difference;
                }
            }
        }
        regressor
    }

    /// The same torque of the arm's own parameters, N m or N, what the spec fixes with it:
    /// `inverse_dynamics(q, dq, ddq_r) + C(q, dq) (dq_r - dq)`.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{Reference, ReferenceRegressor};
    /// use robot_model::{State, Vector};
    ///
    /// // Bent at a right angle the shoulder turns at 2 rad/s and should at 3: 2.5 kg at 0.2 m from the elbow, 0.5 m from the shoulder.
    /// let bent = Vector::from([0.0, std::f64::consts::FRAC_PI_2]);
    /// let state = State::new(bent, Vector::from([2.0, 0.0]), Vector::zeros());
    /// let reference = Reference { dq: Vector::from([3.0, 0.0]), ddq: Vector::zeros() };
    /// let tau = ReferenceRegressor::<10>::torque(&arms::two_link(), &state, &reference);
    /// assert!((tau[1] - 2.5 * 0.5 * 0.2 * 2.0 * 3.0).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn torque<
        A,
        const D: usize,
        const S: usize,
        const H: usize,
        const M: usize,
        const I: usize,
    >(
        arm: &A,
        state: &State<D, M, I>,
        reference: &Reference<D>,
    ) -> Vector<D>
    where
        A: RobotModel<D, S, BASE, H, M, I>,
    {
        let moving = State {
            ddq: reference.ddq,
            ..*state
        };
        let slip = reference.dq - state.dq;
        arm.inverse_dynamics_at(&moving) + arm.coriolis_matrix(&state.q, &state.dq) * slip
    }
}
