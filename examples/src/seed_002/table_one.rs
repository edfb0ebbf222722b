//! Table I, asked whether an arm can have it.

use std::collections::BTreeMap;

use super::arm::truth;
use super::truth::TABLE_1;

/// Table I by name; `fc2` as printed, or as the magnitude that equation 3 wants.
#[must_use]
pub fn printed(as_magnitude: bool) -> BTreeMap<String, f64> {
    let mut values = BTreeMap::new();
    for (name, row) in TABLE_1 {
        for (joint, value) in (1..).zip(row) {
            let is_turned = as_magnitude && name == "rokae.fc2";
            let value = if is_turned { value.abs() } else { value };
            values.insert(format!("j{joint}.{name}"), value);
        }
    }
    values
}

/// The arm that is simulated here, its friction that of Table I or the same without square and cube.
#[must_use]
pub fn ours(with_cubes: bool) -> BTreeMap<String, f64> {
    let mut values = truth();
    if !with_cubes {
        for (name, value) in &mut values {
            if ["rokae.fv2", "rokae.fv3"]
                .iter()
                .any(|end| name.ends_with(end))
            {
                *value = 0.0;
            }
        }
    }
    values
}
