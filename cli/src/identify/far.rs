//! Positions that go where none goes in radians or meters, and torques that no joint has.

use robot_model::log::Log;
use robot_model_spec::Model;
use robot_model_spec::model::JointKind;

use crate::units::Units;

/// Positions and torques beyond this many times their limit are of another unit.
const BEYOND: f64 = 3.0;

/// A joint without limits that turns further than this, rad, in a log.
const FAR: f64 = 30.0;

/// What is asked of joints of a kind.
struct Asked {
    moves: &'static str,
    /// Unit of logs.
    unit: &'static str,
    /// What it may be instead, and that in a spec.
    other: [&'static str; 2],
    /// The step of an encoder in a spec.
    step: &'static str,
}

const TURNING: Asked = Asked {
    moves: "turns",
    unit: "rad",
    other: ["degrees", "deg"],
    step: "360 deg/4096",
};
const SLIDING: Asked = Asked {
    moves: "slides",
    unit: "m",
    other: ["mm", "mm"],
    step: "0.001 mm",
};

/// A joint that goes too far.
struct Far {
    joint: usize,
    is_prismatic: bool,
    said: String,
}

/// Joints that go too far, those that turn and those that slide, each told at once.
pub(crate) fn positions(model: &Model, log: &Log) -> Vec<String> {
    let far: Vec<Far> = (0..model.joints.len())
        .filter_map(|joint| far(model, log, joint))
        .collect();
    let (sliding, turning): (Vec<Far>, Vec<Far>) =
        far.into_iter().partition(|far| far.is_prismatic);
    let turning = question(&TURNING, log, &turning);
    turning
        .into_iter()
        .chain(question(&SLIDING, log, &sliding))
        .collect()
}

/// Torques beyond what the spec says that joints have.
pub(crate) fn torques(model: &Model, log: &Log) -> Option<String> {
    let joints = model.joints.iter().enumerate();
    let far = joints.filter_map(|(joint, declared)| {
        let limit = declared.limits.torque?;
        let most = log.tau[joint]
            .iter()
            .map(|tau| tau.abs())
            .fold(0.0, f64::max);
        let most = most * declared.actuator_gain.abs();
        let unit = Units::of(declared.kind).torque;
        (most > BEYOND * limit)
            .then(|| format!("`{}` {most:.1} of {limit:.1} {unit}", declared.name))
    });
    let far: Vec<String> = far.collect();
    (!far.is_empty()).then(|| {
        format!(
            "torques exceed the limits of the spec: {}: are they in another unit, or currents? Logs are in N m and N unless the spec says \
             otherwise (`log`, `actuator_gain`)",
            far.join(", ")
        )
    })
}

fn far(model: &Model, log: &Log, joint: usize) -> Option<Far> {
    let declared = &model.joints[joint];
    let name = &declared.name;
    let is_prismatic = declared.kind == JointKind::Prismatic;
    let most = log.q[joint].iter().map(|q| q.abs()).fold(0.0, f64::max);
    let free = if is_prismatic { f64::INFINITY } else { FAR };
    let limit = declared.limits.position;
    let limit = limit.map_or(free, |(low, high)| BEYOND * low.abs().max(high.abs()));
    let said = if is_prismatic {
        format!(
            "`{name}` {most:.1} m ({:.0} times its limit)",
            BEYOND * most / limit
        )
    } else {
        format!(
            "`{name}` {most:.1} rad ({:.1} turns)",
            most / std::f64::consts::TAU
        )
    };
    (most > limit).then_some(Far {
        joint,
        is_prismatic,
        said,
    })
}

fn question(asked: &Asked, log: &Log, far: &[Far]) -> Option<String> {
    let first = far.first()?.joint + 1;
    let joints: Vec<&str> = far.iter().map(|far| far.said.as_str()).collect();
    let are_they = if far.len() == 1 { "is it" } else { "are they" };
    let [other, in_spec] = asked.other;
    let are_counts = far.iter().all(|far| is_counted(&log.q[far.joint]));
    let (other, in_spec) = if are_counts {
        (format!("encoder counts, or whole {other}"), asked.step)
    } else {
        (other.to_owned(), in_spec)
    };
    Some(format!(
        "positions are farther than any joint {}: {}: {are_they} in {other}? Logs are in {} unless the spec says otherwise: `log {{ q = \
         \"q{first}\": {in_spec}, ..; }}`",
        asked.moves,
        joints.join(", "),
        asked.unit
    ))
}

/// Whether all values are whole numbers.
fn is_counted(values: &[f64]) -> bool {
    let mut values = values.iter();
    values.all(|value| (value - value.round()).abs() < 1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPEC: &str = "robot Two {
        gravity = [0, 0, -9.81];
        convention = standard_dh;
        joint turn: revolute { a = 0.5; alpha = 0; d = 0; }
        joint lift: prismatic { a = 0; alpha = 0; theta = 0; position = -0.5 m .. 0.5 m; }
    }";

    fn said(turn: f64, lift: f64, whole: bool) -> Vec<String> {
        let model = robot_model_spec::load("two.robot", SPEC).expect("a spec");
        let time: Vec<f64> = (0..200).map(|k| 0.01 * f64::from(k)).collect();
        let wave = |size: f64| -> Vec<f64> {
            let values = time.iter().map(|t| size * (3.0 * t).sin());
            values.map(|x| if whole { x.round() } else { x }).collect()
        };
        let q = vec![wave(turn), wave(lift)];
        let log = Log::from_samples("a log", time.clone(), q, vec![vec![0.0; 200]; 2]);
        positions(&model, &log.expect("sound"))
    }

    #[test]
    fn far_positions_are_asked_for_their_unit() {
        assert_eq!(said(3.0, 0.4, false), Vec::<String>::new());
        let both = said(90.0, 400.0, false);
        assert!(
            both[0].contains("`turn` 90.0 rad (14.3 turns): is it in degrees?"),
            "{both:?}"
        );
        assert!(both[0].contains("q = \"q1\": deg"), "{both:?}");
        assert!(
            both[1].contains("`lift` 400.0 m (800 times its limit): is it in mm?"),
            "{both:?}"
        );
        assert!(both[1].contains("q = \"q2\": mm"), "{both:?}");
    }

    #[test]
    fn torques_beyond_the_limits_are_asked_for_their_unit() {
        let spec = SPEC.replace("d = 0; }", "d = 0; torque = 20 Nm; }");
        assert_ne!(spec, SPEC);
        let model = robot_model_spec::load("two.robot", &spec).expect("a spec");
        let said = |most: f64| {
            let time: Vec<f64> = (0..200).map(|k| 0.01 * f64::from(k)).collect();
            let wave = |t: &f64| most * (3.0 * t).sin();
            let tau = vec![time.iter().map(wave).collect(), vec![0.0; 200]];
            let log = Log::from_samples("a log", time, vec![vec![0.1; 200]; 2], tau);
            torques(&model, &log.expect("sound"))
        };
        assert_eq!(said(25.0), None);
        let told = said(12_000.0).expect("far");
        assert!(told.contains("`turn` 12000.0 of 20.0 N m:"), "{told}");
    }

    #[test]
    fn whole_numbers_are_asked_whether_they_are_counts() {
        let counts = said(1200.0, 400.0, true);
        for said in &counts {
            assert!(said.contains("is it in encoder counts"), "{said}");
        }
        assert!(counts[0].contains("360 deg/4096") && counts.len() == 2);
    }
}
