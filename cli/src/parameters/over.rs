//! Files that have values for a part of an arm, as of one joint's friction, beside a fit of all of it.

use std::path::Path;

use robot_model_codegen::Compiled;

use super::read;
use crate::Error;
use crate::output::{self, counted, names};

/// Base parameters, and shapes.
pub(crate) type Numbers = (Vec<f64>, Vec<f64>);

/// Those of a file where it has them, the others those of a fit: its `shapes`, and base parameters of the `fit` with the shapes that are
/// taken. Nothing where that has none, or where the file names parameters that are in sums with others, of which it would have to say all.
pub(crate) fn over(
    compiled: &Compiled,
    path: &Path,
    mut shapes: Vec<f64>,
    fit: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
) -> Result<Option<Numbers>, Error> {
    let base_names = &compiled.base.names;
    let shape_names = compiled.shape_names();
    let mut given = read(compiled, path)?;
    let mut taken_shapes = Vec::new();
    for k in compiled.free_shapes() {
        match given.remove(&shape_names[k]) {
            Some(found) => shapes[k] = found,
            None => taken_shapes.push(shape_names[k].as_str()),
        }
    }
    let Some(mut beta) = fit(&shapes) else {
        return Ok(None);
    };
    let mut taken = Vec::new();
    for (name, value) in base_names.iter().zip(&mut beta) {
        match given.remove(name) {
            Some(found) => *value = found,
            None => taken.push(name.as_str()),
        }
    }
    taken.extend(taken_shapes);
    // What is left is of shapes that the spec gives, or unknown.
    if given.keys().any(|name| !shape_names.contains(name)) {
        return Ok(None);
    }
    output::say(&format!(
        "note: {}: no value for {}: the value of `--method wls` on the same logs is used for {}",
        path.display(),
        counted(taken.len(), "parameter"),
        names(&taken)
    ));
    Ok(Some((beta, shapes)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_does_not_say_is_of_a_fit_with_the_shapes_that_it_says() {
        let spec = "robot A {
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint up: revolute { a = 0.5; alpha = 0; d = 0; }
            effects { coulomb_friction on up; stribeck on up; }
        }";
        let model = robot_model_spec::load("a.robot", spec).expect("a spec");
        let compiled = robot_model_codegen::compile_model(&model);
        let file = tempfile::NamedTempFile::new().expect("a file");
        std::fs::write(file.path(), r#"{"up.stribeck.vs": 0.3}"#).expect("text");
        let count = compiled.base.kept.len();
        let fit = |shapes: &[f64]| Some(vec![10.0 * shapes[0]; count]);
        let (beta, shapes) = over(&compiled, file.path(), vec![0.1], &fit)
            .expect("a file")
            .expect("values");
        assert_eq!((beta, shapes), (vec![3.0; count], vec![0.3]));
        let none = over(&compiled, file.path(), vec![0.1], &|_| None);
        assert_eq!(none.expect("a file"), None);
    }
}
