//! Two effects as the command line says them.

use robot_model_spec::amend::Amendment;

use crate::Error;

/// Names with values.
pub(super) type Sizes = Vec<(String, f64)>;

/// An effect with what its parameters are worth.
pub(super) fn said(text: &str) -> Result<(Amendment, Sizes), Error> {
    let refused = || {
        Error::Argument(format!(
            "`{text}` is not an effect with its size: write `stribeck(vs = 0.1) on elbow: fs = 2`, values separated by commas"
        ))
    };
    let (declaration, sizes) = match text.split_once(':') {
        Some((declaration, sizes)) => (declaration, Some(sizes)),
        None => (text, None),
    };
    let (head, joints) = match declaration.split_once(" on ") {
        Some((head, joints)) => (head, joints),
        None => (declaration, ""),
    };
    let (effect, shapes) = match head.trim().split_once('(') {
        Some((effect, shapes)) => (effect, shapes.trim().strip_suffix(')').ok_or_else(refused)?),
        None => (head, ""),
    };
    let joints = joints.trim().trim_start_matches('(').trim_end_matches(')');
    let joints = joints
        .split(',')
        .map(str::trim)
        .filter(|joint| !joint.is_empty());
    let amendment = Amendment {
        effect: effect.trim().to_owned(),
        joints: joints.map(str::to_owned).collect(),
        shapes: pairs(shapes).ok_or_else(refused)?,
    };
    let sizes = match sizes {
        Some(sizes) => pairs(sizes)
            .filter(|sizes| !sizes.is_empty())
            .ok_or_else(refused)?,
        None => Vec::new(),
    };
    Ok((amendment, sizes))
}

/// `a = 1, b = 2`
fn pairs(text: &str) -> Option<Sizes> {
    let parts = text
        .split(',')
        .map(str::trim)
        .filter(|part| !part.is_empty());
    parts
        .map(|part| {
            let (name, value) = part.split_once('=')?;
            let value: f64 = value.trim().parse().ok()?;
            value.is_finite().then(|| (name.trim().to_owned(), value))
        })
        .collect()
}
