use nalgebra::DMatrix;
use robot_model::simulate::Functions;

/// `m` of a block is its own mass and a load's.
pub struct Loaded;

impl Functions for Loaded {
    fn own(&self, values: &[f64]) -> Vec<f64> {
        vec![values[0] + values[1], values[2]]
    }
    fn slopes(&self, _values: &[f64]) -> DMatrix<f64> {
        DMatrix::from_row_slice(2, 3, &[1.0, 1.0, 0.0, 0.0, 0.0, 1.0])
    }
}
