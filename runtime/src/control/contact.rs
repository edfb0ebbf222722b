//! Contact forces from joint torques, also where the arm cannot feel them all.

use super::command::{Reason, Signal, Status};
use super::directions::{directions, dot};
use super::error::{ControlError, POSITIVE, is_positive, number};
use super::guard::flaw;
use crate::mechanics::{Kinematics, Points};
use crate::model::{Matrix, RobotModel, Vector, as_array};
use crate::state::State;

/// Length by which a moment is compared with a force without another word, m.
const LENGTH: f64 = 0.2;

/// A force of `R` numbers, and how well `D` joints feel it: at the tip force and moment (`R = 6`), at a point a force (`R = 3`).
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::ContactForce;
/// use robot_model::{Kinematics, Vector};
///
/// let arm = arms::two_link();
/// let contact = ContactForce::new(arm, 0.02)?;
/// let q = Vector::from([0.3, 0.9]);
/// let found = contact.at_tip(&q, &Vector::from([1.0, 2.0]));
/// // Two joints feel two of the six directions of a wrench, and explain each torque by one in them.
/// assert_eq!(found.seen.iter().filter(|seen| **seen == 1.0).count(), 2);
/// assert_eq!(found.unseen().count(), 4);
/// assert!((arm.jacobian(&q).transpose() * found.force - Vector::from([1.0, 2.0])).norm() < 1e-12);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
#[non_exhaustive]
pub struct Contact<const R: usize, const D: usize> {
    /// Along the axes of the base frame, N; at the tip then the moment, N m.
    pub force: Vector<R>,
    /// Directions of forces, one a column, the best felt first; moments in N m per N of force.
    pub directions: Matrix<R, R>,
    /// How strongly the joints feel each, N m per N: singular values of the Jacobian, falling.
    pub singular_values: Vector<R>,
    /// Which share of a force along each is in [`Self::force`]: 1, or `(sigma / threshold)^2` where the singular value is below the
    /// threshold.
    pub seen: Vector<R>,
    /// The largest damping that was needed, `lambda^2 = threshold^2 - sigma^2` of the least felt direction, as `lambda`.
    pub damping: f64,
    /// Product of the `min(R, D)` largest singular values: `sqrt(det(J J^T))` where the joints suffice.
    pub manipulability: f64,
    /// Torque that no such force makes, N m or N: of joints to spare, of a singular pose, and of a model that is wrong.
    pub unexplained: Vector<D>,
    /// [`Status::Held`] where a number was none: the force is zero then.
    pub status: Status,
}

impl<const R: usize, const D: usize> Contact<R, D> {
    /// Directions that are not felt or felt in part.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::Vector;
    /// use robot_model::control::ContactForce;
    ///
    /// // Stretched along x, two joints in a plane feel what acts upward and about z, and none of the other four directions.
    /// let contact = ContactForce::new(arms::two_link(), 0.02)?;
    /// let found = contact.at_tip(&Vector::from([0.0, 0.0]), &Vector::from([9.0, 4.0]));
    /// assert_eq!(found.unseen().count(), 4);
    /// assert!(found.unseen().all(|direction| direction[1].abs() < 1e-9));
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn unseen(&self) -> impl Iterator<Item = Vector<R>> + '_ {
        // Entries that are looked up: an iterator over columns has a panic in it.
        (0..R)
            .filter(|k| self.seen.get(*k).is_some_and(|seen| *seen < 1.0))
            .map(|k| Vector::from_fn(|r, _| self.directions.get((r, k)).copied().unwrap_or(0.0)))
    }
}

/// The contact force `F = J^-T (tau - Y pi)`, by damped least squares near singular poses.
///
/// Force and moment at the tip of a chain, or the force at a point of a robot that says its energies. With the singular values
/// `sigma_k` of the Jacobian, its directions `v_k` and what the joints feel of them, `b_k = J^T v_k`,
///
/// ```text
/// F = sum_k v_k (b_k . t) / max(sigma_k, threshold)^2
/// ```
///
/// This is damping by `lambda_k^2 = threshold^2 - sigma_k^2` of those directions alone that are felt less than the threshold; the others are
/// exact. What comes out is never larger than the torque over the threshold, and goes to zero where nothing is felt: a joint
/// short, as with fewer than six, is nothing else. A moment counts as the force at [`Self::with_length`] that makes it.
///
/// Source: seed 004, equation 20; Chiaverini 1997 for damping by the singular value.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::ContactForce;
/// use robot_model::{Kinematics, RobotModel, State, Vector};
///
/// let arm = arms::two_link();
/// let contact = ContactForce::new(arm, 0.02)?;
/// let state = State::new(Vector::from([0.3, 0.9]), Vector::from([1.0, -0.5]), Vector::from([2.0, 1.0]));
/// // The arm pushes with 7 N, 10 N: in a plane, two joints feel a force with a moment that belongs to it.
/// let push = Vector::from([7.0, 10.0, 0.0, 0.0, 0.0, 0.0]);
/// let load = arm.jacobian(&state.q).transpose() * push;
/// let tau = arm.inverse_dynamics(&state.q, &state.dq, &state.ddq) + load;
/// let found = contact.of_arm(&state, &tau);
/// assert!((arm.jacobian(&state.q).transpose() * found.force - load).norm() < 1e-9);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce<A, const D: usize> {
    arm: A,
    threshold: f64,
    length: f64,
}

impl<A, const D: usize> ContactForce<A, D> {
    /// Of an arm with its parameters; `threshold` in m is the lever, of a force on all joints together, below which it counts as felt
    /// in part.
    ///
    /// # Errors
    /// [`ControlError::Number`], where the threshold is not positive.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::ContactForce;
    ///
    /// let refused = ContactForce::new(arms::two_link(), 0.0).unwrap_err();
    /// assert_eq!(refused.to_string(), "threshold of contact forces is 0 m; give a positive, finite number");
    /// ```
    pub fn new<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        arm: A,
        threshold: f64,
    ) -> Result<Self, ControlError>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let what = ("threshold of contact forces", " m", POSITIVE);
        number(threshold, what, is_positive(threshold))?;
        Ok(Self {
            arm,
            threshold,
            length: LENGTH,
        })
    }

    /// The same with another length, m, at which a force counts as its moment; 0.2 m without it.
    ///
    /// # Errors
    /// [`ControlError::Number`], where it is not positive.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::ContactForce;
    ///
    /// assert!(ContactForce::new(arms::two_link(), 0.02)?.with_length(0.1).is_ok());
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn with_length(self, length: f64) -> Result<Self, ControlError> {
        let what = ("length for moments", " m", POSITIVE);
        number(length, what, is_positive(length))?;
        Ok(Self { length, ..self })
    }

    /// Force and moment that the arm exerts at its tip, `J^-T (tau - inverse_dynamics)`; `tau` in N m or N, `measured` with
    /// its acceleration. What acts on the arm is the opposite.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::ContactForce;
    /// use robot_model::{State, Vector};
    ///
    /// // At rest, with gravity's torque and no more, the tip is free; 9.81 * 2.75 N m at the shoulder, 9.81 * 0.5 N m at the elbow.
    /// let contact = ContactForce::new(arms::two_link(), 0.02)?;
    /// let found = contact.of_arm(&State::at_rest(Vector::from([0.0, 0.0])), &Vector::from([26.9775, 4.905]));
    /// assert!(found.force.norm() < 1e-9);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn of_arm<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        &self,
        measured: &State<D, M, I>,
        tau: &Vector<D>,
    ) -> Contact<6, D>
    where
        A: RobotModel<D, S, B, H, M, I> + Kinematics<D>,
    {
        self.at_tip(&measured.q, &(tau - self.arm.inverse_dynamics_at(measured)))
    }

    /// Force and moment at the tip that load the joints with `torque`, N m or N: of [`ExternalTorque`](super::ExternalTorque)
    /// what acts on the arm.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::Vector;
    /// use robot_model::control::ContactForce;
    ///
    /// // Stretched, 10 N upward at levers of 0.9 m and 0.4 m: no moment is needed to explain them.
    /// let contact = ContactForce::new(arms::two_link(), 0.02)?;
    /// let found = contact.at_tip(&Vector::from([0.0, 0.0]), &Vector::from([9.0, 4.0]));
    /// assert!((found.force[1] - 10.0).abs() < 1e-9 && found.force[5].abs() < 1e-9);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn at_tip(&self, q: &Vector<D>, torque: &Vector<D>) -> Contact<6, D>
    where
        A: Kinematics<D>,
    {
        let l = self.length;
        let scale = [1.0, 1.0, 1.0, l, l, l];
        solve(&self.arm.jacobian(q), &scale, self.threshold, q, torque)
    }

    /// Force that the robot exerts at its point number `point`, from 0, N: as [`Self::of_arm`]. `None` where there is no such point.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// use robot_model::control::ContactForce;
    /// use robot_model::{Points, RobotModel, State, Vector};
    ///
    /// #[derive(Clone, Copy, RobotModel)]
    /// #[robot(file = "tests/doc/swing.robot")]
    /// struct Swing { m: f64 }
    ///
    /// let arm = Swing { m: 2.0 };
    /// let contact = ContactForce::new(arm, 0.01)?;
    /// let state = State::at_rest(Vector::from([0.3, 0.4]));
    /// let push = Vector::from([1.0, 2.0, 0.0]);
    /// let [jacobian] = arm.point_jacobians(&state.q);
    /// let tau = arm.gravity(&state.q) + jacobian.transpose() * push;
    /// let found = contact.of_robot(&state, &tau, 0).expect("the first of its points");
    /// // Two joints: what is across the plane is not felt.
    /// assert!((found.force - push).norm() < 1e-9 && found.unseen().count() == 1);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn of_robot<
        const S: usize,
        const B: usize,
        const H: usize,
        const M: usize,
        const I: usize,
        const P: usize,
    >(
        &self,
        measured: &State<D, M, I>,
        tau: &Vector<D>,
        point: usize,
    ) -> Option<Contact<3, D>>
    where
        A: RobotModel<D, S, B, H, M, I> + Points<D, P>,
    {
        let torque = tau - self.arm.inverse_dynamics_at(measured);
        self.at_point(&measured.q, &torque, point)
    }

    /// Force at the point number `point`, from 0, that loads the joints with `torque`, N m or N. `None` where there is no such
    /// point.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// use robot_model::control::ContactForce;
    /// use robot_model::{RobotModel, Vector};
    ///
    /// #[derive(Clone, Copy, RobotModel)]
    /// #[robot(file = "tests/doc/swing.robot")] // two rods of 0.5 m, y up
    /// struct Swing { m: f64 }
    ///
    /// // The upper rod hangs, the lower one lies along x: 3 N downward at the tip have a lever of 0.5 m about both joints.
    /// let contact = ContactForce::new(Swing { m: 2.0 }, 0.01)?;
    /// let q = Vector::from([0.0, std::f64::consts::FRAC_PI_2]);
    /// let found = contact.at_point(&q, &Vector::from([-1.5, -1.5]), 0).expect("the first of its points");
    /// assert!((found.force - Vector::from([0.0, -3.0, 0.0])).norm() < 1e-9);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn at_point<const P: usize>(
        &self,
        q: &Vector<D>,
        torque: &Vector<D>,
        point: usize,
    ) -> Option<Contact<3, D>>
    where
        A: Points<D, P>,
    {
        let jacobians = self.arm.point_jacobians(q);
        let jacobian = jacobians.get(point)?;
        Some(solve(jacobian, &[1.0; 3], self.threshold, q, torque))
    }
}

/// `J^T F = torque`; `scale` makes lengths of all rows of the Jacobian.
fn solve<const R: usize, const D: usize>(
    jacobian: &Matrix<R, D>,
    scale: &[f64; R],
    threshold: f64,
    q: &Vector<D>,
    torque: &Vector<D>,
) -> Contact<R, D> {
    let mut contact = Contact {
        force: Vector::zeros(),
        directions: Matrix::zeros(),
        singular_values: Vector::zeros(),
        seen: Vector::zeros(),
        damping: threshold,
        manipulability: 0.0,
        unexplained: *torque,
        status: Status::Normal,
    };
    for (signal, values) in [(Signal::Position, q), (Signal::Torque, torque)] {
        if let Some(index) = flaw(values.as_slice()) {
            contact.status = Status::Held(Reason::NoNumber { signal, index });
            return contact;
        }
    }
    let columns = core::array::from_fn(|r| core::array::from_fn(|d| scale[r] * jacobian[(r, d)]));
    let found = directions::<D, R>(&columns);
    let mut manipulability = 1.0;
    for k in 0..R {
        let sigma = found.lengths[k];
        let felt = sigma.max(threshold);
        let amount = dot(&found.columns[k], as_array(torque)) / (felt * felt);
        for r in 0..R {
            // A wrench in N and N m.
            let entry = scale[r] * found.vectors[k][r];
            contact.directions[(r, k)] = entry;
            contact.force[r] += entry * amount;
        }
        for d in 0..D {
            contact.unexplained[d] -= found.columns[k][d] * amount;
        }
        contact.singular_values[k] = sigma;
        contact.seen[k] = (sigma / felt) * (sigma / felt);
        if k < D {
            manipulability *= sigma;
        }
    }
    let least = found.lengths.last().copied().unwrap_or(0.0);
    let slack = threshold * threshold - least * least;
    contact.damping = crate::math::sqrt(slack.max(0.0));
    contact.manipulability = manipulability;
    if let Some(index) = flaw(contact.unexplained.as_slice()) {
        contact.force = Vector::zeros();
        contact.status = Status::Held(Reason::NoTorque { index });
    }
    contact
}
