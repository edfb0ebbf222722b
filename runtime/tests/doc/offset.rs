use robot_model::columns::{Arm, Change, Columns};

pub mod axis {
    include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/axis.rs"));
}

/// An encoder that is off, by up to half a turn: the last shape of an axis.
pub struct Offset(axis::Axis);

pub fn offset() -> Offset {
    Offset(axis::axis())
}

impl Change for Offset {
    fn arm(&self) -> &dyn Arm {
        &self.0
    }
    fn neutral(&self) -> &[f64] {
        &[0.0]
    }
    fn probe(&self) -> &[f64] {
        &[0.01]
    }
    fn counts(&self, shapes: &[f64], _period: f64) -> bool {
        shapes[0].abs() < 3.1
    }
}
