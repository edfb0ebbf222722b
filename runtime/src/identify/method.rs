//! How an estimate is made.

use super::stack::{Stack, norm};
use super::{Bootstrap, Essential, Hausman, Possible};

/// How parameters are found from rows of torque and columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Method {
    /// Ordinary least squares: a newton meter of error counts the same on every joint.
    Ls,
    /// Weighted least squares: each joint's rows are divided by what [`Weights`] says.
    #[default]
    Wls,
    /// [`Self::Wls`], in which samples far from the rest count less: Huber's M-estimate, by iterated weights.
    Robust,
    /// [`Self::Wls`], and of all estimates the one nearest to it that an arm can have: each link's pseudo-inertia positive
    /// definite, friction and rotors not negative.
    Physical,
    /// Weighted least squares with the nominal values of the spec as a measurement of their own, of a deviation that
    /// [`Identify::prior`](super::Identify::prior) says.
    Ridge,
    /// Total least squares: columns have errors, too, each in proportion to its length, as the torque has.
    Total,
    /// Instrumental variables: the columns of a motion without noise, [`Identify::instruments`](super::Identify::instruments),
    /// multiply the equations, so that what the noise of positions has in common with that of the torque biases nothing.
    Instrumental,
}

impl Method {
    /// Name on the command line and in JSON.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::Method;
    /// assert_eq!((Method::Wls.name(), Method::Total.name()), ("wls", "tls"));
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ls => "ls",
            Self::Wls => "wls",
            Self::Robust => "robust",
            Self::Physical => "physical",
            Self::Ridge => "ridge",
            Self::Total => "tls",
            Self::Instrumental => "iv",
        }
    }

    /// Whether joints may be weighed by something else than their residuals.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::Method;
    /// assert!(Method::Wls.takes_weights());
    /// assert!(!Method::Ls.takes_weights());
    /// ```
    #[must_use]
    pub const fn takes_weights(self) -> bool {
        match self {
            Self::Wls | Self::Robust | Self::Total | Self::Instrumental => true,
            // Without weights, or in units of deviations.
            Self::Ls | Self::Physical | Self::Ridge => false,
        }
    }
}

/// What a joint's rows are divided by; methods that do not [take](Method::takes_weights) any have their own.
///
/// # Examples
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use pendulum::{measure, pendulum};
/// use robot_model::identify::{Identify, Weights};
/// // One joint weighs what it weighs.
/// let fit = |weights| Identify { weights, ..Identify::default() }.fit(&pendulum(), &[measure(0.0)]);
/// let (residual, torque) = (fit(Weights::Residual)?, fit(Weights::TorqueNorm)?);
/// assert!((residual.values()[0] - torque.values()[0]).abs() < 1e-9);
/// # Ok::<(), robot_model::identify::IdentifyError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Weights {
    /// The standard deviation of its residual, by iteration: of linear weights those with the least variance where joints have noise of
    /// their own (Gautier 1997).
    #[default]
    Residual,
    /// The length of its torque, `|| tau_j ||` (Liu et al., A New Joint Friction Model, equations 20-22).
    TorqueNorm,
    /// The largest size of its torque, `max |tau_j|`.
    MaxTorque,
}

impl Weights {
    /// Name on the command line.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::Weights;
    /// assert_eq!(Weights::TorqueNorm.name(), "torque-norm");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Residual => "residual",
            Self::TorqueNorm => "torque-norm",
            Self::MaxTorque => "max-torque",
        }
    }

    /// What the rows of each joint are divided by where that is known from the torque.
    pub(super) fn scale(self, stack: &Stack) -> Vec<f64> {
        let joints = stack.joints.iter();
        match self {
            Self::Residual => vec![1.0; stack.dof()],
            Self::TorqueNorm => joints.map(|rows| norm(&rows.tau)).collect(),
            Self::MaxTorque => joints
                .map(|rows| rows.tau.iter().map(|tau| tau.abs()).fold(0.0, f64::max))
                .collect(),
        }
    }
}

/// What an identification asks beyond the parameters.
///
/// # Examples
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); } use pendulum::*;
/// use robot_model::identify::{Beyond, Identify};
/// let (all, log) = (Identify::default(), measure(0.2));
/// let rough = Identify { beyond: Beyond::Residuals, ..all.clone() };
/// let [all, rough] = [all, rough].map(|identify| identify.fit(&pendulum(), &[log.clone()]).expect("it moves"));
/// assert_eq!(all.values(), rough.values());
/// assert_ne!(all.parameters[0].std, rough.parameters[0].std);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Beyond {
    /// What is left of the torque. Deviations are rough ones, of correlation times, and shapes have none.
    Residuals,
    /// Standard deviations of the residuals' whole series, too, which take several times as long.
    Deviations,
    /// And channels that are late or early, see [`Estimate::delays`](super::Estimate::delays): that takes longer than the fit where little is
    /// explained.
    #[default]
    Delays,
}

/// What a method leaves beside the solution.
#[derive(Debug, Clone, Default)]
pub(super) struct Beside {
    pub bootstrap: Option<Bootstrap>,
    pub essential: Option<Essential>,
    pub possible: Option<Possible>,
    pub outliers: Option<Vec<usize>>,
    pub hausman: Option<Hausman>,
}
