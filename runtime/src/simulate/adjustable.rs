//! Plants with parameters that can be moved.

use nalgebra::DMatrix;

use super::plant::{Instant, Plant};

/// Slopes of a plant's equations by its parameters, all else held; `u` parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterSlopes {
    /// `d tau / du`, `n` by `u`.
    pub torque: DMatrix<f64>,
    /// `d (dz/dt) / du`, `p` by `u`.
    pub rates: DMatrix<f64>,
    /// `dg / du` of switches, `m` by `u`.
    pub arguments: DMatrix<f64>,
}

impl ParameterSlopes {
    /// Room for those of a plant.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use robot_model::simulate::ParameterSlopes;
    /// // One joint, two parameters.
    /// assert_eq!(ParameterSlopes::zeros(&block::Block([2.0, 0.7])).torque.shape(), (1, 2));
    /// ```
    #[must_use]
    pub fn zeros(plant: &impl Adjustable) -> Self {
        let unknowns = plant.parameters();
        let room = |rows| DMatrix::zeros(rows, unknowns);
        Self {
            torque: room(plant.dof()),
            rates: room(plant.states()),
            arguments: room(plant.switches()),
        }
    }
}

/// A plant with parameters that can be moved.
///
/// # Examples
/// A block on oil, `tau = m ddq + c dq`:
/// ```
/// use nalgebra::{DMatrix, DVector};
/// use robot_model::simulate::{Adjustable, Instant, ParameterSlopes, Plant, Slopes};
///
/// struct Block { m: f64, c: f64 }
///
/// impl Plant for Block {
///     fn dof(&self) -> usize { 1 }
///     fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
///         torque[0] = self.m * at.ddq[0] + self.c * at.dq[0];
///         inertia[(0, 0)] = self.m;
///     }
///     fn slopes(&mut self, _: &Instant<'_>, slopes: &mut Slopes) { slopes.torque[1][(0, 0)] = self.c; }
/// }
///
/// impl Adjustable for Block {
///     fn values(&self) -> Vec<f64> { vec![self.m, self.c] }
///     fn adjust(&mut self, values: &[f64]) { (self.m, self.c) = (values[0], values[1]); }
///     fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes) {
///         slopes.torque.copy_from_slice(&[at.ddq[0], at.dq[0]]);
///     }
/// }
///
/// let mut block = Block { m: 2.0, c: 0.7 };
/// let [q, dq, ddq] = [[0.0], [0.5], [3.0]];
/// let (nothing, rest) = (&[][..], &[0.0]);
/// let at = Instant { time: 0.0, q: &q, dq: &dq, ddq: &ddq, memory: nothing, switches: nothing, torque: rest, inputs: nothing };
/// let mut slopes = ParameterSlopes::zeros(&block);
/// block.parameter_slopes(&at, &mut slopes);
/// assert_eq!(slopes.torque.as_slice(), [3.0, 0.5]);
/// block.adjust(&[4.0, 0.7]);
/// assert_eq!(block.values(), [4.0, 0.7]);
/// ```
pub trait Adjustable: Plant {
    /// How many parameters there are, `u`.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use robot_model::simulate::Adjustable;
    /// // Of m and c.
    /// assert_eq!(block::Block([2.0, 0.7]).parameters(), 2);
    /// ```
    fn parameters(&self) -> usize {
        self.values().len()
    }

    /// Their values.
    fn values(&self) -> Vec<f64>;

    /// Makes what sensitivities need, so that copies of the plant have it.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use robot_model::simulate::Adjustable;
    /// // A block needs nothing: its values stay, as those of any plant do.
    /// let mut block = block::Block([2.0, 0.7]);
    /// block.prepare();
    /// assert_eq!(block.values(), [2.0, 0.7]);
    /// ```
    fn prepare(&mut self) {}

    /// Takes other values.
    fn adjust(&mut self, values: &[f64]);

    /// Slopes by them.
    fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes);
}
