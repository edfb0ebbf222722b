//! What least squares finds.

use super::super::combination::Shared;

/// A least-squares solution.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Solution {
    /// One value per unknown; 0 where the column is not excited.
    pub estimate: Vec<f64>,
    /// Standard deviations, same order; 0 where the column is not excited.
    pub std: Vec<f64>,
    /// Unknowns that the logs do not excite, ascending.
    pub unexcited: Vec<usize>,
    /// Directions of the columns that count as silent since all that is seen of them is noise of the positions.
    pub drowned: usize,
    /// Excited unknowns that stand for a combination with others.
    pub shared: Vec<Shared>,
    /// Ratio of the largest to the smallest singular value of the weighted regressor with columns of unit norm.
    pub condition: f64,
    /// Standard deviation of the residual per joint; never below a tiny share of the largest.
    pub sigma: Vec<f64>,
    /// What each joint's rows were divided by.
    pub scale: Vec<f64>,
}

impl Solution {
    /// Whether an unknown has a value of its own: the logs tell it, and not in a sum alone.
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// use robot_model::identify::Factors;
    /// let told = Factors::new(&spring::spring()).ordinary(&[1.0]);
    /// assert!(told.is_told(0) && told.is_told(1));
    /// // Of the way there alone: 3 N m are k or fc.
    /// let mut stack = spring::spring();
    /// stack.joints[0].columns = vec![(0, vec![0.25, 0.25]), (1, vec![1.0, 1.0])];
    /// let sum = Factors::new(&stack).ordinary(&[1.0]);
    /// assert!(!sum.is_told(0) && !sum.is_told(1));
    /// ```
    #[must_use]
    pub fn is_told(&self, unknown: usize) -> bool {
        let is_in = |shared: &Shared| {
            shared.lead == unknown || shared.others.iter().any(|(other, _)| *other == unknown)
        };
        !self.unexcited.contains(&unknown) && !self.shared.iter().any(is_in)
    }
}
