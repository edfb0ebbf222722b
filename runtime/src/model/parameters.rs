//! Arms that are made from vectors of parameters.

use super::{RobotModel, Vector};

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
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{FromParameters, RobotModel};
    /// let mut doubled = arms::two_link().standard();
    /// doubled *= 2.0;
    /// assert_eq!(arms::TwoLink::from_standard(&doubled).elbow.inertial.mass, 5.0);
    /// ```
    #[must_use]
    fn from_standard(standard: &Vector<STANDARD>) -> Self {
        Self::from_parameters(standard, &Self::NOMINAL_SHAPES.into())
    }

    /// An arm with these base parameters and nominal shapes. Standard parameters that are regrouped into others are 0.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{FromParameters, RobotModel, Vector};
    /// // An estimate has no mass of its own, and the torque of the arm: 2.5 kg at 0.2 m from the elbow.
    /// let arm = arms::TwoLink::from_base(&arms::two_link().beta());
    /// assert_eq!(arm.elbow.inertial.mass, 0.0);
    /// assert!((arm.gravity(&Vector::from([0.0, 0.0]))[1] - 9.81 * 2.5 * 0.2).abs() < 1e-12);
    /// ```
    #[must_use]
    fn from_base(beta: &Vector<BASE>) -> Self {
        Self::from_standard(&Self::standard_of(beta))
    }

    /// Standard parameters with the base parameters `beta`, and so with the same torque: of a chain the base parameters at
    /// the places of the kept standard ones, what the spec fixes at its own, 0 elsewhere.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::{FromParameters, RobotModel};
    /// let beta = arms::two_link().beta();
    /// let standard = arms::TwoLink::standard_of(&beta);
    /// assert_eq!(arms::TwoLink::STANDARD_PARAMETERS[0], "shoulder.m");
    /// assert!(standard[0] == 0.0 && (arms::TwoLink::base_parameters(&standard) - beta).norm() < 1e-12);
    /// ```
    fn standard_of(beta: &Vector<BASE>) -> Vector<STANDARD>;
}
