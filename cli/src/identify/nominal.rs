//! Logged torques, less those of the effects that were found, beside those of the spec's nominal links along the same motion: another
//! unit or sign shows as a factor.

use robot_model::identify::Estimate;
use robot_model::log::Log;
use robot_model_codegen::Compiled;
use robot_model_spec::parameter::{Owner, Status};

use super::fit::Fit;
use crate::output::names;

/// Cosine of the angle between both torques from where on a factor says something; friction and rotors are in one of them alone.
const ALIKE: f64 = 0.5;

/// Factors that no friction, rotor or rough CAD makes of all joints: at least so much, or at most one over it.
const FAR: f64 = 5.0;

/// By how much joints may differ in a factor that they are said to have in common.
const APART: f64 = 3.0;

/// By how much the factor of one joint is another than those of all others, to be told.
const ALONE: f64 = 1.5;

/// Cosine from where on torques go as nominal ones do, on all joints: friction or a rotor turns them by more.
const SAME_WAY: f64 = 0.95;

/// What logged torque over nominal torque is on a joint, and the cosine of the angle between them.
#[derive(Clone, Copy)]
struct Likeness {
    factor: f64,
    cosine: f64,
}

/// What nominal values pull away from the logs.
pub(super) fn pulled(estimate: &Estimate) -> Option<String> {
    let pulled = &estimate.possible.as_ref()?.pulled;
    let pulled: Vec<&str> = pulled.iter().map(String::as_str).collect();
    (!pulled.is_empty()).then(|| {
        format!(
            "the spec's nominal values pull {} more than three standard deviations away from the physically possible estimate of the logs; \
             check the units, frames and payload of these values, or remove them from the spec",
            names(&pulled)
        )
    })
}

/// Where all links have nominal values. A heavy rotor behind gears moves against what gravity asks of a link, so a sign is told only where
/// what was found `is_odd`, too. Links behind springs move with torques of their own.
pub(super) fn doubt(
    form: &dyn Fit,
    estimate: &Estimate,
    logs: &[Log],
    is_odd: bool,
) -> Option<String> {
    if form.compiled().displacements().is_some() {
        return None;
    }
    let values = nominal(form.compiled())?;
    let of_effects = of_effects(form.compiled(), estimate);
    let gains = form.model().joints.iter().map(|joint| joint.actuator_gain);
    let gains: Vec<f64> = gains.collect();
    let mut sums = vec![[0.0; 3]; form.dof()];
    for log in logs {
        let torque = form.predict(&values, estimate, log).ok()?;
        let effects = form.predict(&of_effects, estimate, log).ok()?;
        let torques = torque.iter().zip(&effects).zip(&gains).enumerate();
        for ((joint, ((nominal, effects), gain)), sums) in torques.zip(&mut sums) {
            let logged = effects.iter().zip(&log.tau[joint]);
            let logged = logged.map(|(effects, logged)| gain * logged - effects);
            for (nominal, logged) in nominal.iter().zip(logged) {
                sums[0] += nominal * nominal;
                sums[1] += nominal * logged;
                sums[2] += logged * logged;
            }
        }
    }
    let likeness = |[nominal, both, logged]: [f64; 3]| Likeness {
        factor: both / nominal,
        cosine: both / (nominal * logged).sqrt(),
    };
    let all: Vec<Likeness> = sums.into_iter().map(likeness).collect();
    said(&all, &estimate.joints, &hidden(form.compiled()), is_odd)
}

/// Joints of effects of which the logs tell only a sum with links, as of a rotor at the foot of an arm: how much of a torque is theirs is not known.
fn hidden(compiled: &Compiled) -> Vec<usize> {
    let joints = 0..compiled.model.joints.len();
    joints
        .filter(|joint| !compiled.mixed_on(&[*joint]).is_empty())
        .collect()
}

/// What was found of friction, rotors and other effects, and nothing of links: friction may well be more than a link's torque.
fn of_effects(compiled: &Compiled, estimate: &Estimate) -> Vec<f64> {
    let kept = compiled.base.kept.iter().zip(&estimate.parameters);
    let value = kept.map(|(&k, found)| match compiled.standard[k].owner {
        Owner::Effect { .. } if estimate.is_separated(&found.name) => found.value,
        _ => 0.0,
    });
    value.collect()
}

/// Base parameters of the nominal links, without friction or rotors that the spec has no value for.
fn nominal(compiled: &Compiled) -> Option<Vec<f64>> {
    let standard =
        compiled
            .standard
            .iter()
            .map(|parameter| match (parameter.status, parameter.owner) {
                (Status::Nominal(value) | Status::Fixed(value), _) => Some(value),
                (Status::Unknown, Owner::Effect { .. }) => Some(0.0),
                (Status::Unknown, _) => None,
            });
    let standard: Vec<f64> = standard.collect::<Option<_>>()?;
    Some(compiled.base.beta(&standard))
}

/// What factors say, those of hidden joints only where all joints have one in common.
fn said(all: &[Likeness], joints: &[String], hidden: &[usize], is_odd: bool) -> Option<String> {
    if all.iter().any(|joint| !joint.cosine.is_finite()) {
        return None;
    }
    if let Some(factor) = common(all).filter(|factor| *factor > 0.0 || is_odd) {
        let what = match factor.abs() {
            large if large >= FAR => "are they in N mm, or in counts of the drive?",
            small if small <= 1.0 / FAR => {
                "are they in kN m, motor torques before the gears, or currents?"
            }
            _ => "do their signs agree with the spec's joints?",
        };
        return Some(format!(
            "logged torques of all joints are about {} times those of the spec's nominal links along this motion: {what} Set units and \
             gains with `log` and `actuator_gain` in the spec",
            short(factor)
        ));
    }
    let seen = (0..all.len()).filter(|joint| !hidden.contains(joint));
    let seen = seen.map(|joint| (all[joint], joints[joint].clone()));
    let (seen, names_of_seen): (Vec<Likeness>, Vec<String>) = seen.unzip();
    if let Some(alone) = alone(&seen, &names_of_seen) {
        return Some(alone);
    }
    let is_turned = |joint: &Likeness| is_odd && joint.cosine < -ALIKE;
    let turned = names_of_seen.iter().zip(&seen);
    let turned = turned.filter(|(_, joint)| is_turned(joint));
    let turned: Vec<&str> = turned.map(|(name, _)| name.as_str()).collect();
    (!turned.is_empty()).then(|| {
        format!(
            "the logged torque has the opposite sign to that of the spec's nominal links on {}: are signs and order of the columns those of \
             the spec's joints?",
            names(&turned)
        )
    })
}

/// The factor that all joints have in common, where it is far from 1.
fn common(all: &[Likeness]) -> Option<f64> {
    let is_negative = all.first()?.factor < 0.0;
    let has_sign = |joint: &&Likeness| (joint.factor < 0.0) == is_negative;
    if !all
        .iter()
        .all(|joint| joint.cosine.abs() > ALIKE && has_sign(&joint))
    {
        return None;
    }
    let logs = all.iter().map(|joint| joint.factor.abs().ln());
    let size = (logs.sum::<f64>() / all.len() as f64).exp();
    let is_common = all
        .iter()
        .all(|joint| (joint.factor.abs() / size).ln().abs() < APART.ln());
    let is_far = is_negative || !(1.0 / FAR..FAR).contains(&size);
    let sign = if is_negative { -1.0 } else { 1.0 };
    (is_common && is_far).then_some(sign * size)
}

/// The joint whose factor is not that of the others.
fn alone(all: &[Likeness], joints: &[String]) -> Option<String> {
    let is_alike = |joint: &Likeness| joint.cosine > SAME_WAY && joint.factor > 0.0;
    if all.len() < 2 || !all.iter().all(is_alike) {
        return None;
    }
    let off = |joint: usize| {
        let others = all.iter().enumerate().filter(|(k, _)| *k != joint);
        let logs = others.map(|(_, other)| other.factor.ln());
        let ranges = logs.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
            [low.min(x), high.max(x)]
        });
        let own = all[joint].factor.ln();
        // From the nearest of them.
        let away = f64::max(ranges[0] - own, own - ranges[1]);
        away > ALONE.ln() && ranges[1] - ranges[0] < ALONE.ln()
    };
    // Of two joints it may be either.
    let alone: Vec<&str> = (0..all.len())
        .filter(|&joint| off(joint))
        .map(|joint| joints[joint].as_str())
        .collect();
    if alone.is_empty() {
        return None;
    }
    let factors = all.iter().zip(joints);
    let factors: Vec<String> = factors
        .map(|(found, name)| format!("`{name}` {}", short(found.factor)))
        .collect();
    Some(format!(
        "logged torques are those of the spec's nominal links times {}: are gains and units of {} right, and do links, rotors \
         (`motor_inertia`) and payload agree with the spec? If a gain is wrong, parameters are wrong by the same factor",
        factors.join(", "),
        match alone.as_slice() {
            [one, other] => format!("`{one}` and `{other}`"),
            _ => names(&alone),
        }
    ))
}

/// Two digits.
fn short(factor: f64) -> f64 {
    format!("{factor:.1e}").parse().unwrap_or(factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(all: &[(f64, f64)], is_odd: bool) -> Option<String> {
        let likeness = |&(factor, cosine)| Likeness { factor, cosine };
        let all: Vec<Likeness> = all.iter().map(likeness).collect();
        let joints: Vec<String> = (1..=all.len()).map(|k| format!("j{k}")).collect();
        said(&all, &joints, &[], is_odd)
    }

    /// The rotors of the first two joints are in sums with links; that of the third has a number of its own.
    #[test]
    fn a_rotor_in_a_sum_with_a_link_says_nothing_of_gains() {
        let text = "robot A {
            gravity = [0, 0, -9.81];
            convention = standard_dh;
            joint foot: revolute { a = 0; alpha = 90 deg; d = 0.4; }
            joint lift: revolute { a = 0.5; alpha = 0; d = 0; }
            joint bend: revolute { a = 0.3; alpha = 0; d = 0; }
            effects { viscous_friction on all; motor_inertia on all; }
        }";
        let model = robot_model_spec::load("arm.robot", text).expect("a spec");
        assert_eq!(hidden(&robot_model_codegen::compile_model(&model)), [0, 1]);
    }

    #[test]
    fn hidden_joints_count_where_all_have_one_factor() {
        let likeness = |factor: f64| Likeness {
            factor,
            cosine: 0.98,
        };
        let joints = ["j1", "j2", "j3"].map(str::to_owned);
        let said = |factors: [f64; 3]| said(&factors.map(likeness), &joints, &[1], false);
        assert_eq!(said([1.1, 2.0, 0.95]), None);
        let told = said([0.6, 1.0, 1.0]).expect("one of two gains");
        assert!(told.contains("`j1` and `j3`"), "{told}");
        let told = said([1e3, 1.4e3, 900.0]).expect("a unit");
        assert!(
            told.contains("of all joints are about 1100 times"),
            "{told}"
        );
    }

    #[test]
    fn a_factor_of_all_joints_is_told() {
        let about = |all: &[(f64, f64)], words: [&str; 2]| {
            let said = told(all, true).expect("a factor");
            assert!(words.iter().all(|word| said.contains(word)), "{said}");
        };
        about(
            &[(1440.0, 0.7), (1000.0, 0.99)],
            ["about 1200 times", "N mm"],
        );
        about(
            &[(0.01, 0.7), (0.01, 0.99)],
            ["about 0.01 times", "currents"],
        );
        about(
            &[(-1.1, -0.7), (-0.9, -0.99)],
            ["about -0.99 times", "signs"],
        );
        assert_eq!(told(&[(-1.1, -0.7), (-0.9, -0.99)], false), None);
    }

    #[test]
    fn a_drive_with_another_gain_is_told_beside_the_others() {
        let said = told(&[(1.1, 0.99), (0.6, 0.98), (0.95, 0.97)], false).expect("a gain");
        assert!(
            said.contains("units of `j2`") && said.contains("`j2` 0.6"),
            "{said}"
        );
        let said = told(&[(1.1, 0.99), (0.6, 0.98)], false).expect("one of two gains");
        assert!(said.contains("units of `j1` and `j2`"), "{said}");
        // CAD that is off by a third, a joint that friction turns, joints that are all different.
        assert_eq!(told(&[(1.1, 0.99), (0.8, 0.98), (0.95, 0.97)], false), None);
        assert_eq!(told(&[(1.1, 0.99), (0.6, 0.9), (0.95, 0.97)], false), None);
        assert_eq!(told(&[(2.0, 0.99), (0.6, 0.98), (1.1, 0.97)], false), None);
    }

    #[test]
    fn friction_rotors_and_rough_cad_are_no_unit() {
        for is_odd in [false, true] {
            assert_eq!(told(&[(1.9, 0.6), (0.7, 0.9)], is_odd), None);
            // A joint that its rotor moves, beside one that carries links.
            assert_eq!(told(&[(9.0, 0.8), (1.1, 0.9)], is_odd), None);
            assert_eq!(told(&[(9.0, 0.2), (8.0, 0.9)], is_odd), None);
            assert_eq!(told(&[(f64::NAN, f64::NAN), (8.0, 0.9)], is_odd), None);
        }
        let turned = [(1.1, 0.9), (-0.9, -0.6)];
        assert_eq!(told(&turned, false), None);
        let said = told(&turned, true).expect("a sign");
        assert!(said.contains("nominal links on `j2`"), "{said}");
    }
}
