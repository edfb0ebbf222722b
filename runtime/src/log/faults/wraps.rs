//! Angles that begin their turn again.

use std::f64::consts::TAU;

use super::Steps;

/// By how much a whole turn may be missed, in steps of the largest usual kind: the joint moves on from one sample to the next.
const NEAR: f64 = 4.0;

/// Usual steps beyond this are too large to tell a whole turn from, rad.
const FAST: f64 = 0.2;

/// Takes whole turns out of a position, and says behind which samples they were.
pub(super) fn take_out(values: &mut [f64]) -> Vec<usize> {
    let steps = Steps::of(values);
    let near = NEAR * steps.usual.max(steps.quantum);
    if near > NEAR * FAST {
        return Vec::new();
    }
    let whole = |step: f64| {
        let turns = (step / TAU).round();
        if turns != 0.0 && (step - turns * TAU).abs() <= near {
            turns
        } else {
            0.0
        }
    };
    let mut found = Vec::new();
    let (mut before, mut turns) = (values.first().copied().unwrap_or(0.0), 0.0);
    for (k, value) in values.iter_mut().enumerate() {
        let more = whole(*value - before);
        before = *value;
        if more != 0.0 {
            found.push(k - 1);
            turns += more;
        }
        *value -= turns * TAU;
    }
    found
}
