//! Whether friction jumps at a speed that is not zero: between two speeds that close in on each other what the effects' torque changes by
//! goes to nothing, unless it jumps there.

use robot_model_codegen::Compiled;

use super::friction::{CREEP, Effects, fastest};
use super::{Check, Finding, Quantity};
use crate::parameters::Values;
use crate::units::Units;

/// Intervals of speeds, each by one factor wider than the one before, into how many parts one is cut, and how often.
const INTERVALS: i32 = 24;
const PARTS: u32 = 32;
const LEVELS: usize = 9;

/// Parts that are cut further.
const WIDTH: usize = 32;

/// Of the joint's largest torque of effects: what is less is rounding, or a steep curve.
const NOTHING: f64 = 1e-6;

pub(super) fn check(compiled: &Compiled, values: &Values) -> Check {
    let effects = Effects::new(compiled, values);
    let fastest = fastest(compiled);
    let mut findings = Vec::new();
    for (joint, declared) in compiled.model.joints.iter().enumerate() {
        let torque = |speed: f64| effects.alone(joint, speed, fastest.len());
        let units = Units::of(declared.kind);
        for way in [1.0, -1.0] {
            let found = jumps(&torque, way * fastest[joint]);
            findings.extend(
                found
                    .into_iter()
                    .map(|jump| jump.said(&declared.name, &units)),
            );
        }
    }
    let scope = "effects as functions of each joint's speed, away from rest".to_owned();
    Check::new("jumps", scope, findings)
}

/// A jump of a torque where a joint becomes faster.
struct Jump {
    speed: f64,
    by: f64,
}

impl Jump {
    fn said(&self, joint: &str, units: &Units) -> Finding {
        let Self { speed, by } = *self;
        let (torque, velocity) = (units.torque, units.velocity);
        let said = format!(
            "effects of joint `{joint}` jump by {by:.3e} {torque} at {speed:.4} {velocity}: a controller that compensates for them jumps there too"
        );
        let own = [
            Quantity::of("jump", joint, by, torque),
            Quantity::of("at", joint, speed, velocity),
        ];
        (said, own.to_vec())
    }
}

/// Those of a torque over the speed up to the fastest, at most one an interval.
fn jumps(torque: &impl Fn(f64) -> f64, fastest: f64) -> Vec<Jump> {
    let speed = |k: i32| fastest * CREEP.powf(f64::from(INTERVALS - k) / f64::from(INTERVALS));
    let ends: Vec<(f64, f64)> = (0..=INTERVALS)
        .map(|k| (speed(k), torque(speed(k))))
        .collect();
    let size = ends.iter().fold(0.0_f64, |size, (_, f)| size.max(f.abs()));
    let nothing = NOTHING * size;
    let pairs = ends.windows(2);
    let found = pairs.filter_map(|pair| {
        let mut left = vec![[pair[0], pair[1]]];
        for _ in 0..LEVELS {
            // Into the parts that change most: a slope has its share in each, a jump is in one, which may be less than that of a steep slope
            // until parts are small.
            left = left
                .into_iter()
                .flat_map(|ends| parts(ends, torque))
                .collect();
            left.retain(|ends| change(ends) > nothing);
            left.sort_by(|x, y| change(y).total_cmp(&change(x)));
            left.truncate(WIDTH);
        }
        let [low, high] = left.first()?;
        let by = high.1 - low.1;
        Some(Jump { speed: high.0, by })
    });
    found.collect()
}

/// Speeds and torques at both ends of an interval.
type Ends = [(f64, f64); 2];

fn change([low, high]: &Ends) -> f64 {
    (high.1 - low.1).abs()
}

fn parts([low, high]: Ends, torque: &impl Fn(f64) -> f64) -> Vec<Ends> {
    let at = |part: u32| low.0 + (high.0 - low.0) * f64::from(part) / f64::from(PARTS);
    let inner = (1..PARTS).map(|part| (at(part), torque(at(part))));
    let all: Vec<(f64, f64)> = std::iter::once(low).chain(inner).chain([high]).collect();
    all.windows(2).map(|ends| [ends[0], ends[1]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_is_told_from_a_steep_slope() {
        let law = |v: f64| {
            let jump = if v.abs() > 0.01 {
                0.2 * v.signum()
            } else {
                0.0
            };
            (v / 1e-4).tanh() + 0.5 * v + jump
        };
        for way in [3.0, -3.0] {
            let found = jumps(&law, way);
            assert_eq!(found.len(), 1);
            assert!(
                (found[0].speed.abs() - 0.01).abs() < 1e-9,
                "{}",
                found[0].speed
            );
            assert!(
                (found[0].by - 0.2 * way.signum()).abs() < 1e-9,
                "{}",
                found[0].by
            );
        }
        assert!(jumps(&|v: f64| (v / 1e-4).tanh() + 0.5 * v, 3.0).is_empty());
        assert!(jumps(&|_| 0.0, 3.0).is_empty());
        // Behind a ramp that rises faster than it jumps.
        let ramp = |v: f64| {
            if v.abs() < 0.02 {
                v / 0.02
            } else {
                v.signum() + 2.0 * v
            }
        };
        let found = jumps(&ramp, 3.0);
        assert_eq!(found.len(), 1);
        assert!((found[0].by - 0.04).abs() < 1e-9, "{}", found[0].by);
        // Behind one of which any part of an interval has more than the jump.
        let steep = |v: f64| {
            if v.abs() < 0.02 {
                8.0 * v / 0.02
            } else {
                8.01 * v.signum()
            }
        };
        let found = jumps(&steep, 3.0);
        assert_eq!(found.len(), 1);
        assert!((found[0].by - 0.01).abs() < 1e-9, "{}", found[0].by);
    }
}
