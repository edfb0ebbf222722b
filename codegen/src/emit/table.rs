//! Names and nominal values that a page lists.

use robot_model_spec::parameter::Status;

use crate::compiled::Compiled;

/// Lists of an arm, in the order of the arguments that they name.
pub struct Table {
    pub joints: Vec<String>,
    pub standard: Vec<String>,
    pub base: Vec<String>,
    pub shapes: Vec<String>,
    pub inputs: Vec<String>,
    pub states: Vec<String>,
    pub points: Vec<String>,
    /// Standard parameters as the spec gives them; 0 where it does not.
    pub nominal: Vec<f64>,
    /// Shape parameters, as `nominal_shapes` has them.
    pub nominal_shapes: Vec<f64>,
}

impl Table {
    /// `nominal_shapes` are values for all shape parameters, those that the spec gives too.
    pub fn new(compiled: &Compiled, nominal_shapes: &[f64]) -> Self {
        let model = &compiled.model;
        let (names, free) = (compiled.shape_names(), compiled.free_shapes());
        let standard = compiled.standard.iter();
        Self {
            joints: model.joints.iter().map(|x| x.name.clone()).collect(),
            standard: standard.clone().map(|x| x.name.clone()).collect(),
            base: compiled.base.names.clone(),
            shapes: free.iter().map(|&k| names[k].clone()).collect(),
            inputs: model.inputs(),
            states: model.states(),
            points: compiled.points.iter().map(|x| x.name.clone()).collect(),
            nominal: standard
                .map(|parameter| match parameter.status {
                    Status::Unknown => 0.0,
                    Status::Nominal(value) | Status::Fixed(value) => value,
                })
                .collect(),
            nominal_shapes: free.iter().map(|&k| nominal_shapes[k]).collect(),
        }
    }
}
