//! The arm of the specs in this folder, with numbers.

use std::collections::BTreeMap;

use super::truth::{FRICTION, LINKS};

/// With the law of the publication on all joints.
pub const ROKAE: &str = include_str!("rokae.robot");
/// With Coulomb and viscous friction.
pub const CONVENTIONAL: &str = include_str!("conventional.robot");

/// Standard parameters of the simulated arm by name, those of its friction law among them.
#[must_use]
pub fn truth() -> BTreeMap<String, f64> {
    let mut values = BTreeMap::new();
    for (k, link) in LINKS.iter().enumerate() {
        let mut put = |name: &str, value: f64| values.insert(format!("j{}.{name}", k + 1), value);
        let ([x, y, z], [ixx, iyy, izz], m) = (link.com, link.inertia, link.mass);
        put("m", m);
        put("mx", m * x);
        put("my", m * y);
        put("mz", m * z);
        // About the origin of the frame: Steiner.
        put("ixx", ixx + m * (y * y + z * z));
        put("ixy", -m * x * y);
        put("ixz", -m * x * z);
        put("iyy", iyy + m * (x * x + z * z));
        put("iyz", -m * y * z);
        put("izz", izz + m * (x * x + y * y));
        put("motor_inertia.ia", link.rotor);
        for (name, row) in FRICTION.by_name() {
            put(&format!("rokae.{name}"), row[k]);
        }
    }
    values
}
