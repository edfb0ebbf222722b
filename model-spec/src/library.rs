//! The standard effects: the files of `effects/`, checked like any other definition.

use std::sync::{Arc, OnceLock};

use crate::check::check_definition;
use crate::diagnostic::Diagnostics;
use crate::model::EffectDefinition;

/// File name and text, sorted by name; written by the build script from the folder.
const FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/effects.rs"));

/// All standard effects by name.
#[must_use]
pub fn standard_effects() -> &'static [Arc<EffectDefinition>] {
    static EFFECTS: OnceLock<Vec<Arc<EffectDefinition>>> = OnceLock::new();
    EFFECTS.get_or_init(|| {
        let mut effects: Vec<Arc<EffectDefinition>> = FILES
            .iter()
            .flat_map(|(file, text)| {
                effect_definitions(file, text)
                    .expect("every standard effect is checked by this crate's tests")
            })
            .map(Arc::new)
            .collect();
        effects.sort_by(|x, y| x.name.cmp(&y.name));
        effects
    })
}

/// The effects defined in a text, in its order; a robot beside them is not looked at.
///
/// # Errors
/// Mistakes of the text, or of its definitions.
pub fn effect_definitions(
    source_name: &str,
    text: &str,
) -> Result<Vec<EffectDefinition>, Diagnostics> {
    let ast = crate::parse(source_name, text)?;
    let mut errors = Vec::new();
    let definitions = ast
        .effects
        .iter()
        .filter_map(|effect| check_definition(effect, &mut errors))
        .collect();
    if errors.is_empty() {
        Ok(definitions)
    } else {
        Err(Diagnostics::new(source_name, text, errors))
    }
}

#[cfg(test)]
mod tests {
    use super::{FILES, effect_definitions, standard_effects};

    #[test]
    fn each_file_defines_the_effect_of_its_name() {
        for (file, text) in FILES {
            let definitions =
                effect_definitions(file, text).unwrap_or_else(|errors| panic!("{errors}"));
            let names: Vec<String> = definitions
                .iter()
                .map(|d| format!("{}.robot", d.name))
                .collect();
            assert_eq!(names, [*file]);
        }
    }

    #[test]
    fn every_effect_and_parameter_is_explained() {
        for effect in standard_effects() {
            assert!(
                effect.doc.lines().count() > 1,
                "{} needs its physics",
                effect.name
            );
            assert!(
                effect.linear.iter().all(|p| !p.doc.is_empty()),
                "{}",
                effect.name
            );
            assert!(
                effect.shapes.iter().all(|p| !p.doc.is_empty()),
                "{}",
                effect.name
            );
        }
    }

    #[test]
    fn every_effect_says_when_it_is_identifiable_and_what_is_taken_for_it() {
        let effects = standard_effects();
        let is_effect = |name: &String| effects.iter().any(|effect| effect.name == *name);
        let mut pairs: Vec<[&str; 2]> = Vec::new();
        for effect in effects {
            let identifiable = effect.identifiable();
            assert!(
                identifiable.is_some(),
                "{}: no paragraph begins with `Identifiable `",
                effect.name
            );
            let confusions = effect.confusions().unwrap_or_else(|paragraph| {
                panic!(
                    "{}: write \"Confused with `a`, `b`: why. Distinguished by what.\", not \"{paragraph}\"",
                    effect.name
                )
            });
            for other in confusions.iter().flat_map(|confusion| &confusion.effects) {
                assert!(is_effect(other), "{}: no effect `{other}`", effect.name);
                let found = effects.iter().find(|effect| effect.name == *other);
                let mut pair = [
                    effect.name.as_str(),
                    found.map_or("", |found| found.name.as_str()),
                ];
                pair.sort_unstable();
                assert!(pair[0] != pair[1], "{} with itself", effect.name);
                assert!(!pairs.contains(&pair), "{pair:?}: say it at one of them");
                pairs.push(pair);
            }
        }
        for effect in effects {
            assert!(
                pairs
                    .iter()
                    .any(|pair| pair.contains(&effect.name.as_str())),
                "{}: nothing is taken for it",
                effect.name
            );
        }
    }
}
