//! Files that have values for a part of an arm, as of one joint's friction, beside a fit of all of it.

use std::path::Path;

use robot_model_codegen::Compiled;

use super::file;
use crate::Error;
use crate::output::{self, counted, names};

/// Base parameters, and shapes.
pub(crate) type Numbers = (Vec<f64>, Vec<f64>);

/// Those of a file where it has them, the others those of a fit. Nothing where the file names parameters
/// that are in sums with others, of which it would have to say all.
pub(crate) fn over(
    compiled: &Compiled,
    path: &Path,
    (mut beta, mut shapes): Numbers,
) -> Result<Option<Numbers>, Error> {
    let base_names = &compiled.base.names;
    let shape_names = compiled.shape_names();
    let mut given = file::read(path, &shape_names)?;
    let mut taken = Vec::new();
    for (name, value) in base_names.iter().zip(&mut beta) {
        match given.remove(name) {
            Some(found) => *value = found,
            None => taken.push(name.as_str()),
        }
    }
    for k in compiled.free_shapes() {
        match given.remove(&shape_names[k]) {
            Some(found) => shapes[k] = found,
            None => taken.push(&shape_names[k]),
        }
    }
    // What is left is of shapes that the spec gives, or unknown.
    if given.keys().any(|name| !shape_names.contains(name)) {
        return Ok(None);
    }
    output::say(&format!(
        "note: {}: no value for {}: those of `--method wls` on the same logs for {}",
        path.display(),
        counted(taken.len(), "parameter"),
        names(&taken)
    ));
    Ok(Some((beta, shapes)))
}
