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
    Ok(by_effect
        .into_iter()
        .map(|(effect, targets)| format!("{effect} on {}", targets.join(", ")))
        .collect())
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
