//! Of what a torque is made: inertia, Coriolis and centrifugal torque, gravity, and each effect.

use crate::model::{Matrix, RobotModel, Vector};
use crate::state::State;

/// Elements of a link in the order of the standard parameters.
const ELEMENTS: [&str; 10] = [
    "m", "mx", "my", "mz", "ixx", "ixy", "ixz", "iyy", "iyz", "izz",
];

/// The torque of a declared effect on all joints.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::Dissection;
/// use robot_model::{State, Vector};
/// // The elbow turns at 0.5 rad/s, with 0.6 N m s/rad.
/// let state = State::new(Vector::zeros(), Vector::from([0.0, 0.5]), Vector::zeros());
/// let shares = Dissection::new(&arms::two_link(), &state);
/// let share = shares.effects().find(|share| share.name == "elbow.viscous_friction").expect("it is declared");
/// assert!((share.torque - Vector::from([0.0, 0.3])).norm() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Share<const D: usize> {
    /// `JOINT.EFFECT`, of several joints the first one's.
    pub name: &'static str,
    /// Sum over the effect's parameters, N m or N.
    pub torque: Vector<D>,
}

/// Shares of the torque of one state, which sum to it.
///
/// Those of the rigid body are the columns of its parameters, so that a body that an effect adds is the effect's, and no share is
/// counted twice. An arm that knows its base parameters only has what regroups, such as the rotor of a first joint, in the share into which it
/// regroups.
///
/// Source: seed 004, section 4.1.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::Dissection;
/// use robot_model::{RobotModel, State, Vector};
///
/// let arm = arms::two_link();
/// let state = State::new(Vector::from([0.3, 0.9]), Vector::from([1.0, -0.5]), Vector::from([2.0, 1.0]));
/// let shares = Dissection::new(&arm, &state);
/// assert!((shares.inertia - arm.mass_matrix(&state.q) * state.ddq).norm() < 1e-12);
/// assert!((shares.gravity - arm.gravity(&state.q)).norm() < 1e-12);
/// let dry = shares.effects().find(|share| share.name == "elbow.coulomb_friction").expect("it is declared");
/// assert_eq!(dry.torque, Vector::from([0.0, -0.8]));
/// assert!((shares.sum() - arm.inverse_dynamics(&state.q, &state.dq, &state.ddq)).norm() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Dissection<const D: usize, const S: usize> {
    /// `M ddq`, N m or N.
    pub inertia: Vector<D>,
    /// `C dq`, N m or N.
    pub coriolis: Vector<D>,
    /// `G`, N m or N.
    pub gravity: Vector<D>,
    names: [&'static str; S],
    /// Torque a standard parameter; those of the rigid body are not read.
    contributions: Matrix<D, S>,
    rigid: usize,
}

impl<const D: usize, const S: usize> Dissection<D, S> {
    /// Takes the torque of a state apart. Three regressors: not for every cycle of a controller.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::Dissection;
    /// use robot_model::{State, Vector};
    /// // Stretched, the elbow turns at 2 rad/s: gravity of 2.5 kg at 0.2 m, and no Coriolis torque.
    /// let state = State::new(Vector::from([0.0, 0.0]), Vector::from([0.0, 2.0]), Vector::zeros());
    /// let shares = Dissection::new(&arms::two_link(), &state);
    /// assert!((shares.gravity[1] - 9.81 * 2.5 * 0.2).abs() < 1e-12 && shares.coriolis.norm() < 1e-12);
    /// ```
    pub fn new<A, const B: usize, const H: usize, const M: usize, const I: usize>(
        arm: &A,
        state: &State<D, M, I>,
    ) -> Self
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let (standard, shapes) = (arm.standard(), arm.shapes());
        let rigid = rigid_parameters(&A::JOINTS, &A::STANDARD_PARAMETERS);
        let coasting = State {
            ddq: Vector::zeros(),
            ..*state
        };
        let resting = State {
            dq: Vector::zeros(),
            ..coasting
        };
        let mut contributions = arm.regressor_of_at(state);
        let [mut coasting, mut resting] =
            [coasting, resting].map(|state| A::regressor_at(&state, &shapes));
        for regressor in [&mut contributions, &mut coasting, &mut resting] {
            for (mut column, value) in regressor.column_iter_mut().zip(standard.iter()) {
                column *= *value;
            }
        }
        let sum = |regressor: &Matrix<D, S>| {
            Vector::from_fn(|joint, _| {
                let row = (0..S).filter(|column| *column < rigid);
                row.map(|column| regressor[(joint, column)]).sum()
            })
        };
        let gravity = sum(&resting);
        Self {
            inertia: sum(&(contributions - coasting)),
            coriolis: sum(&(coasting - resting)),
            gravity,
            names: A::STANDARD_PARAMETERS,
            contributions,
            rigid,
        }
    }

    /// Shares of the declared effects, in the order of the spec.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::Dissection;
    /// use robot_model::{State, Vector};
    /// let state = State::new(Vector::from([0.0, 0.0]), Vector::from([0.0, 2.0]), Vector::zeros());
    /// let shares = Dissection::new(&arms::two_link(), &state);
    /// // Each joint's viscous friction, then its dry friction; the elbow's are 0.6 N m s/rad and 0.8 N m.
    /// let of_elbow: Vec<f64> = shares.effects().map(|share| share.torque[1]).collect();
    /// assert_eq!(of_elbow, [0.0, 0.0, 1.2, 0.8]);
    /// ```
    pub fn effects(&self) -> impl Iterator<Item = Share<D>> + '_ {
        let mut next = self.rigid;
        core::iter::from_fn(move || {
            let name = owner(self.names.get(next)?);
            let mut torque = Vector::<D>::zeros();
            // Indices that are looked up: a sum of columns from a number on has a panic in it.
            while self
                .names
                .get(next)
                .is_some_and(|other| owner(other) == name)
            {
                for (joint, sum) in torque.iter_mut().enumerate() {
                    *sum += self.contributions.get((joint, next)).unwrap_or(&0.0);
                }
                next += 1;
            }
            Some(Share { name, torque })
        })
    }

    /// All shares together: the torque.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::Dissection;
    /// use robot_model::{State, Vector};
    /// let state = State::new(Vector::from([0.0, 0.0]), Vector::from([0.0, 2.0]), Vector::zeros());
    /// let tau = Dissection::new(&arms::two_link(), &state).sum();
    /// assert!((tau[1] - (9.81 * 2.5 * 0.2 + 0.6 * 2.0 + 0.8)).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn sum(&self) -> Vector<D> {
        let rigid = self.inertia + self.coriolis + self.gravity;
        self.effects().fold(rigid, |sum, share| sum + share.torque)
    }
}

/// `JOINT.EFFECT` of `JOINT.EFFECT.PARAMETER`.
fn owner(parameter: &'static str) -> &'static str {
    let dot = parameter.bytes().rposition(|byte| byte == b'.');
    dot.and_then(|dot| parameter.get(..dot))
        .unwrap_or(parameter)
}

/// How many standard parameters, from the first, are those of links or energies: `LINK.izz` ten a link, or names without a dot.
fn rigid_parameters<const D: usize>(joints: &[&'static str; D], names: &[&'static str]) -> usize {
    let links = joints
        .iter()
        .flat_map(|link| ELEMENTS.map(|element| (*link, element)));
    let is_link = |name: &str, link: &str, element: &str| {
        let rest = name
            .strip_prefix(link)
            .and_then(|rest| rest.strip_prefix("."));
        rest == Some(element)
    };
    let of_links = names.iter().zip(links);
    let chain = of_links
        .take_while(|(name, (link, element))| is_link(name, link, element))
        .count();
    let is_product = |name: &&&str| !name.bytes().any(|byte| byte == b'.');
    chain.max(names.iter().take_while(is_product).count())
}
