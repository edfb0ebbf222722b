//! `all:viscous_friction,coulomb_friction;3:motor_inertia;(5,6):gear_coupling` to declarations of a spec.

use super::ImportError;
use super::tree::Chain;
use super::write::Names;
use crate::library::standard_effects;
use crate::suggest;

/// Lines of an `effects { .. }` block, without the `;`: one per effect, in the order of first mention.
pub(super) fn declarations(
    text: &str,
    chain: &Chain,
    names: &Names,
) -> Result<Vec<String>, ImportError> {
    let mut by_effect: Vec<(String, Vec<String>)> = Vec::new();
    for part in text
        .split(';')
        .map(str::trim)
        .filter(|part| !part.is_empty())
    {
        let Some((joints, effects)) = part.split_once(':') else {
            return fault(format!(
                "`{part}` names no effect: write `JOINTS:effect,effect`"
            ));
        };
        let targets = targets(joints.trim(), chain, names)?;
        for effect in effects.split(',').map(str::trim) {
            let effect = known(effect)?;
            match by_effect.iter_mut().find(|(name, _)| *name == effect) {
                Some((_, all)) => all.extend(targets.iter().cloned()),
                None => by_effect.push((effect, targets.clone())),
            }
        }
    }
    for (effect, targets) in &by_effect {
        let twice = targets
            .iter()
            .enumerate()
            .find(|(k, target)| targets[..*k].contains(target));
        let beside_all = targets.len() > 1 && targets.iter().any(|target| target == "all");
        if let Some(target) = twice
            .map(|(_, target)| target.as_str())
            .or(beside_all.then_some("all"))
        {
            return fault(format!(
                "`{effect}` is there twice for joint `{target}`: once is enough"
            ));
        }
    }
    for (effect, names) in given(chain, names) {
        match by_effect.iter_mut().find(|(name, _)| *name == effect) {
            Some((_, all)) if all.iter().any(|target| target == "all") => {}
            Some((_, all)) => {
                let missing: Vec<String> = names.filter(|name| !all.contains(name)).collect();
                all.extend(missing);
            }
            None => {
                let targets: Vec<String> = names.collect();
                if !targets.is_empty() {
                    by_effect.push((effect.to_owned(), targets));
                }
            }
        }
    }
    Ok(by_effect
        .into_iter()
        .map(|(effect, targets)| format!("{effect} on {}", targets.join(", ")))
        .collect())
}

/// What `<dynamics damping=.. friction=..>` of the joints declares.
fn given<'a>(
    chain: &'a Chain,
    names: &'a Names,
) -> [(&'static str, impl Iterator<Item = String> + 'a); 2] {
    let joints_with = |value: fn(&urdf_rs::Dynamics) -> f64| {
        let joints = chain.joints.iter().zip(&names.joints);
        joints
            .filter(move |(joint, _)| {
                let dynamics = joint.joint.dynamics.as_ref();
                dynamics.is_some_and(|dynamics| value(dynamics) > 0.0)
            })
            .map(|(_, name)| name.clone())
    };
    [
        ("viscous_friction", joints_with(|dynamics| dynamics.damping)),
        (
            "coulomb_friction",
            joints_with(|dynamics| dynamics.friction),
        ),
    ]
}

/// The values of `<dynamics ..>`, joint by joint: the language identifies them, so they are told in a comment.
pub(super) fn values(chain: &Chain, names: &Names) -> Vec<String> {
    let joints = chain.joints.iter().zip(&names.joints);
    joints
        .filter_map(|(joint, name)| {
            let dynamics = joint.joint.dynamics.as_ref()?;
            let told = [
                ("damping", dynamics.damping),
                ("friction", dynamics.friction),
            ]
            .iter()
            .filter(|(_, value)| *value > 0.0)
            .map(|(what, value)| format!("{what} {value}"))
            .collect::<Vec<_>>();
            (!told.is_empty()).then(|| format!("{name}: {}", told.join(", ")))
        })
        .collect()
}

/// Negative coefficients: no friction drives a joint.
pub(super) fn left_out(chain: &Chain) -> Vec<String> {
    let joints = chain.joints.iter().map(|joint| joint.joint);
    joints
        .filter_map(|joint| Some((&joint.name, joint.dynamics.as_ref()?)))
        .flat_map(|(name, dynamics)| {
            let values = [
                ("damping", dynamics.damping),
                ("friction", dynamics.friction),
            ];
            let negative = values.into_iter().filter(|(_, value)| *value < 0.0);
            negative.map(move |(what, value)| {
                format!("joint `{name}` has a negative {what} of {value}: left out")
            })
        })
        .collect()
}

fn fault<T>(message: String) -> Result<T, ImportError> {
    Err(ImportError::Effects(message))
}

/// Kebab case is taken too: reports write it so.
fn known(effect: &str) -> Result<String, ImportError> {
    let snake = effect.replace('-', "_");
    let names = standard_effects()
        .iter()
        .map(|definition| definition.name.as_str());
    if names.clone().any(|name| name == snake) {
        return Ok(snake);
    }
    fault(format!(
        "there is no standard effect `{effect}`; {}",
        suggest::help(&snake, names)
    ))
}

/// `all`, `1,2`, `(5,6)`, by number or by name.
fn targets(text: &str, chain: &Chain, names: &Names) -> Result<Vec<String>, ImportError> {
    if text == "all" {
        return Ok(vec!["all".to_owned()]);
    }
    if let Some(inner) = text
        .strip_prefix('(')
        .and_then(|rest| rest.strip_suffix(')'))
    {
        let joints = inner
            .split(',')
            .map(|one| joint(one.trim(), chain, names))
            .collect::<Result<Vec<_>, _>>()?;
        return Ok(vec![format!("({})", joints.join(", "))]);
    }
    text.split(',')
        .map(|one| joint(one.trim(), chain, names))
        .collect()
}

/// The name in the spec of a joint that is given by number from 1 or by its name in the URDF.
fn joint(text: &str, chain: &Chain, names: &Names) -> Result<String, ImportError> {
    let count = chain.joints.len();
    let known = || chain.joints.iter().map(|joint| joint.joint.name.as_str());
    if let Some(index) = known().position(|name| name == text) {
        return Ok(names.joints[index].clone());
    }
    match text.parse::<usize>() {
        Ok(number) if (1..=count).contains(&number) => Ok(names.joints[number - 1].clone()),
        Ok(number) => fault(format!(
            "there is no joint {number}: the chain has joints 1 to {count}"
        )),
        Err(_) => fault(format!(
            "the chain has no joint `{text}`; {}, or a number from 1 to {count}",
            suggest::help(text, known().collect::<Vec<_>>())
        )),
    }
}
