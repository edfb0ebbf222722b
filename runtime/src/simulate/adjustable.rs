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
/// A block on oil:
/// ```
#[doc = include_str!("../../tests/doc/block.rs")]
///
/// // Its rows say by how much torque errs where a parameter does.
/// let (mut block, mut slopes) = (Block([2.0, 0.7]), ParameterSlopes::zeros(&Block([2.0, 0.7])));
/// block.parameter_slopes(&MOVING, &mut slopes);
/// assert_eq!((block.parameters(), slopes.torque.as_slice()), (2, &[3.0, 0.5][..]));
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
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use robot_model::simulate::Adjustable;
    /// assert_eq!(block::Block([2.0, 0.7]).values(), [2.0, 0.7]); // kg and N s/m
    /// ```
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
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use robot_model::simulate::Adjustable;
    /// let mut block = block::Block([2.0, 0.7]);
    /// block.adjust(&[4.0, 0.7]);
    /// assert_eq!(block.values(), [4.0, 0.7]);
    /// ```
    fn adjust(&mut self, values: &[f64]);

    /// Slopes by them.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use robot_model::simulate::{Adjustable, ParameterSlopes};
    /// // Of m: ddq; of c: dq.
    /// let mut block = block::Block([2.0, 0.7]);
    /// let mut slopes = ParameterSlopes::zeros(&block);
    /// block.parameter_slopes(&block::MOVING, &mut slopes);
    /// assert_eq!(slopes.torque.as_slice(), [3.0, 0.5]);
    /// ```
    fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes);
}
