//! Positions that go where none goes in radians or meters.

use robot_model::log::Log;
use robot_model_spec::Model;
use robot_model_spec::model::JointKind;

/// Positions beyond this many times their limit are of another unit.
const BEYOND: f64 = 3.0;

/// A joint without limits that turns further than this, rad, in a log.
const FAR: f64 = 30.0;

/// Joints that go too far, those that turn and those that slide, each told at once.
pub(super) fn positions(model: &Model, log: &Log) -> Vec<String> {
    let (mut turning, mut sliding) = (Vec::new(), Vec::new());
    for (k, joint) in model.joints.iter().enumerate() {
        let is_prismatic = joint.kind == JointKind::Prismatic;
        let most = log.q[k].iter().map(|q| q.abs()).fold(0.0, f64::max);
        let limit = joint.limits.position;
        let free = if is_prismatic { f64::INFINITY } else { FAR };
        let limit = limit.map_or(free, |(low, high)| BEYOND * low.abs().max(high.abs()));
        if most <= limit {
            continue;
        }
        if is_prismatic {
            let times = BEYOND * most / limit;
            sliding.push((
                k,
                format!("`{}` {most:.1} m ({times:.0} times its limit)", joint.name),
            ));
        } else {
            let turns = most / std::f64::consts::TAU;
            turning.push((
                k,
                format!("`{}` {most:.1} rad ({turns:.1} turns)", joint.name),
            ));
        }
    }
    let said = |far: &[(usize, String)], goes: &str, unit: &str, logs: &str| {
        let joints: Vec<&str> = far.iter().map(|(_, said)| said.as_str()).collect();
        let first = far.first()?.0;
        let are_they = if far.len() == 1 { "is it" } else { "are they" };
        let unit = if far.iter().all(|(k, _)| is_counted(&log.q[*k])) {
            "counts of an encoder"
        } else {
            unit
        };
        Some(format!(
            "positions go where no joint {goes}: {}: {are_they} in {unit}? Logs are in {logs}, or as the spec says: \
             `log {{ q = \"q{}\": {}, ..; }}`",
            joints.join(", "),
            first + 1,
            match unit {
                "degrees" => "deg",
                "mm" => "mm",
                _ if logs == "m" => "0.01 mm",
                _ => "360 deg/4096",
            }
        ))
    };
    let turning = said(&turning, "turns", "degrees", "rad");
    turning
        .into_iter()
        .chain(said(&sliding, "slides", "mm", "m"))
        .collect()
}

/// Whether all values are whole numbers.
fn is_counted(values: &[f64]) -> bool {
    values
        .iter()
        .all(|value| (value - value.round()).abs() < 1e-9)
}
