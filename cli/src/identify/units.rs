//! Whether positions of a log are in another unit than the spec's, asked of the torques.

use robot_model::identify::{Estimate, Identify};
use robot_model::log::Log;
use robot_model_spec::Model;
use robot_model_spec::model::JointKind;

use super::fit::Fit;

/// Degrees are asked for where a joint moves further than this, rad: less is a motion of less than three degrees.
const LEAST_RANGE: f64 = 3.0;

/// A model that explains its torques to this, percent, has its unit.
const WELL: f64 = 15.0;

/// By which factor errors have to be less in degrees, over joints.
const FACTOR: f64 = 2.0;

/// Turns are asked for where no joint moves by more of them than this.
const MOST_TURNS: f64 = 3.0;

/// A unit of angles: a plural, its name in a spec, its size in rad.
type Unit = (&'static str, &'static str, f64);

const DEGREES: Unit = ("degrees", "deg", std::f64::consts::PI / 180.0);
const TURNS: Unit = ("revolutions", "rev", std::f64::consts::TAU);

/// A model that explains its torques to this, percent, has them in radians: positions that are six times too small leave a sixth of what
/// gravity bends, which other parameters make up for.
const WELL_IN_TURNS: f64 = 5.0;

/// Says so where the torques follow positions in degrees or revolutions far better than in radians. Where nothing bends with positions, as
/// on a lone joint without gravity, no torque can tell.
pub(super) fn others(
    form: &dyn Fit,
    identify: &Identify,
    logs: &[Log],
    found: &Estimate,
) -> Option<String> {
    let model = form.model();
    let worst = found.relative_percent.iter().copied().fold(0.0, f64::max);
    let ranges = || logs.iter().flat_map(|log| ranges(model, log));
    let may_be_degrees = worst > WELL && ranges().any(|range| range > LEAST_RANGE);
    let may_be_turns = worst > WELL_IN_TURNS && ranges().all(|range| range < MOST_TURNS);
    let units = [(DEGREES, may_be_degrees), (TURNS, may_be_turns)];
    let mut asked = units.into_iter().filter(|(_, may_be)| *may_be);
    asked.find_map(|(unit, _)| told(form, identify, logs, found, unit))
}

fn told(
    form: &dyn Fit,
    identify: &Identify,
    logs: &[Log],
    found: &Estimate,
    (plural, name, size): Unit,
) -> Option<String> {
    let model = form.model();
    let logs: Vec<Log> = logs.iter().map(|log| in_unit(model, log, size)).collect();
    let plain = Identify {
        bootstrap: 0,
        essential: false,
        instruments: Vec::new(),
        method: robot_model::identify::Method::Wls,
        ..identify.clone()
    };
    let other = form.fit(&plain, &logs).ok()?;
    let falls = other.relative_percent.iter().zip(&found.relative_percent);
    let falls: Vec<f64> = falls
        .map(|(other, found)| (found / other.max(f64::MIN_POSITIVE)).ln())
        .collect();
    let mean = falls.iter().sum::<f64>() / falls.len() as f64;
    let percent = |of: &[f64]| of.iter().copied().fold(0.0, f64::max);
    (mean > FACTOR.ln()).then(|| {
        format!(
            "with positions in {plural} the model leaves {:.1} % of the torque of its worst joint, as they are {:.0} %: are they in {plural}? \
             Logs are in rad, or as the spec says: `log {{ q = \"q1\": {name}, ..; }}`",
            percent(&other.relative_percent),
            percent(&found.relative_percent)
        )
    })
}

fn revolute(model: &Model) -> impl Iterator<Item = usize> + '_ {
    let joints = model.joints.iter().enumerate();
    joints
        .filter(|(_, joint)| joint.kind != JointKind::Prismatic)
        .map(|(k, _)| k)
}

/// How far revolute joints move in a log.
fn ranges(model: &Model, log: &Log) -> Vec<f64> {
    let range = |joint: usize| {
        let (low, high) = log.q[joint]
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), q| {
                (low.min(*q), high.max(*q))
            });
        high - low
    };
    revolute(model).map(range).collect()
}

fn in_unit(model: &Model, log: &Log, size: f64) -> Log {
    let mut log = log.clone();
    for joint in revolute(model) {
        for q in &mut log.q[joint] {
            *q *= size;
        }
    }
    log
}
