//! Whether base parameters give the torque of the standard ones: parameter by parameter, since each has a unit of its own.

use nalgebra::DVector;

use crate::evaluate::Interpreter;
use crate::states::State;

/// Largest difference of `Y * standard` and `Y_b * map * standard` where one standard parameter is 1 and the others are 0,
/// relative to the largest torque of that parameter at these states. Parameters that the spec fixes have no part in it. The
/// torque of one without influence is rounding of what cancels in it, so it is held against a ten-thousandth of the largest
/// torque of all. With the name of that parameter.
#[must_use]
pub fn largest_difference(interpreter: &Interpreter, states: &[State]) -> (f64, String) {
    let compiled = &interpreter.compiled;
    let zero = vec![0.0; compiled.standard.len()];
    let forms: Vec<_> = states
        .iter()
        .map(|state| interpreter.forms(&zero, state))
        .collect();
    let of_all = forms
        .iter()
        .fold(0.0f64, |size, form| size.max(form.regressor.amax()));
    let mut largest = (0.0f64, String::new());
    for k in (0..compiled.standard.len()).filter(|k| !compiled.base.fixed.contains(k)) {
        let mut one = zero.clone();
        one[k] = 1.0;
        let beta = DVector::from_vec(compiled.base.beta(&one));
        let (mut own, mut difference) = (0.0f64, 0.0f64);
        for form in &forms {
            let wanted = form.regressor.column(k);
            own = own.max(wanted.amax());
            difference = difference.max((&form.base_regressor * &beta - wanted).amax());
        }
        if compiled.base.unidentifiable.contains(&k) {
            own = own.max(1e-4 * of_all);
        }
        // What has no torque may have none.
        if difference > 0.0 {
            let relative = difference / own.max(f64::MIN_POSITIVE);
            if relative > largest.0 {
                largest = (relative, compiled.standard[k].name.clone());
            }
        }
    }
    largest
}
