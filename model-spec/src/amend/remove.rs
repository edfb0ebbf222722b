//! An effect out of the text of a spec.

use std::ops::Range;

use crate::ast::{DeclaredEffect, Targets};
use crate::diagnostic::Diagnostics;
use crate::{load, parse};

/// Removes one of [`Model::effects`](crate::Model::effects), by its place there, from the declaration that has it: the joint from the list, or,
/// where it is the only one, the declaration. What is `on all` is on the other joints by name. A place that there is none at changes nothing.
///
/// # Examples
/// ```
/// let text = "robot R { gravity = [0, 0, 0]; convention = standard_dh;
///     joint a: revolute { a = 1; alpha = 0; d = 0; }
///     joint b: revolute { a = 1; alpha = 0; d = 0; }
///     effects { viscous_friction on all; coulomb_friction on b; }
/// }";
/// let without = robot_model_spec::amend::remove("r.robot", text, 0)?;
/// assert!(without.contains("viscous_friction on b; coulomb_friction on b;"));
/// # Ok::<(), robot_model_spec::diagnostic::Diagnostics>(())
/// ```
///
/// # Errors
/// Mistakes of `text`, or of what would come out of it, if what is left needs the effect.
pub fn remove(source_name: &str, text: &str, effect: usize) -> Result<String, Diagnostics> {
    let model = load(source_name, text)?;
    let ast = parse(source_name, text)?;
    let blocks = ast.robots.first().map(|robot| &robot.effects);
    let declared = blocks
        .into_iter()
        .flatten()
        .flat_map(|block| &block.declared);
    let mut place = effect;
    for declaration in declared {
        let count = match &declaration.targets {
            Targets::Arm => 1,
            Targets::All(_) => model.joints.len(),
            Targets::Each(targets) => targets.len(),
        };
        if place < count {
            let names: Vec<&str> = model.joints.iter().map(|joint| &joint.name[..]).collect();
            let (range, instead) = cut(text, declaration, place, &names);
            let mut left = text.to_owned();
            left.replace_range(range, &instead);
            load(source_name, &left)?;
            return Ok(left);
        }
        place -= count;
    }
    Ok(text.to_owned())
}

/// What of the text to replace, and by what, for a declaration to lose one of its instances; `joints` are the names of all.
fn cut(
    text: &str,
    declaration: &DeclaredEffect,
    instance: usize,
    joints: &[&str],
) -> (Range<usize>, String) {
    let others = |mut all: Vec<&str>| {
        all.remove(instance);
        all.join(", ")
    };
    match &declaration.targets {
        Targets::All(all) if joints.len() > 1 => (all.byte_range(), others(joints.to_vec())),
        Targets::Each(targets) if targets.len() > 1 => {
            let ranges = targets.iter().map(|target| target.span.byte_range());
            let ranges: Vec<Range<usize>> = ranges.collect();
            let whole = ranges[0].start..ranges[ranges.len() - 1].end;
            let texts = ranges.into_iter().map(|range| &text[range]);
            (whole, others(texts.collect()))
        }
        _ => {
            let start = declaration.name.span().byte_range().start;
            (start..end_of_statement(text, start), String::new())
        }
    }
}

/// Behind the semicolon that ends what begins at a place, and is in no comment.
fn end_of_statement(text: &str, start: usize) -> usize {
    let mut at = start;
    while let Some(found) = text[at..].find([';', '/']) {
        let rest = &text[at + found..];
        let comment = ["//", "/*"]
            .into_iter()
            .position(|open| rest.starts_with(open));
        let length = match comment {
            Some(kind) => {
                let close = ["\n", "*/"][kind];
                rest.find(close).map_or(rest.len(), |end| end + close.len())
            }
            None if rest.starts_with(';') => return at + found + 1,
            None => 1,
        };
        at += found + length;
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::remove;
    use crate::load;

    const TEXT: &str = "robot R {
    gravity = [0, 0, 0];
    convention = standard_dh;
    joint a: revolute { a = 1; alpha = 0; d = 0; }
    joint b: revolute { a = 1; alpha = 0; d = 0; }
    joint c: revolute { a = 1; alpha = 0; d = 0; }

    effects {
        // Of both drives.
        viscous_friction on all;
        stribeck(vs = 0.2) on a, c; // Measured.
        gear_coupling on (b, c), (a, b);
        base_tilt // It hangs; nearly.
            /* Upside down; see above. */ (first = 0.1, second = 3 / 30);
    }
}
";

    #[test]
    fn an_instance_is_gone_and_all_else_stays() {
        let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
        let model = load("r.robot", TEXT).expect("a spec");
        let wanted = [
            (9, "        viscous_friction on b, c;"),
            (9, "        viscous_friction on a, c;"),
            (9, "        viscous_friction on a, b;"),
            (10, "        stribeck(vs = 0.2) on c; // Measured."),
            (10, "        stribeck(vs = 0.2) on a; // Measured."),
            (11, "        gear_coupling on (a, b);"),
            (11, "        gear_coupling on (b, c);"),
            (12, "        "),
        ];
        assert_eq!(model.effects.len(), wanted.len());
        for (effect, (line, instead)) in wanted.into_iter().enumerate() {
            let without = remove("r.robot", TEXT, effect).expect("a spec without it");
            let mut expected = lines(TEXT);
            instead.clone_into(&mut expected[line]);
            if line == 12 {
                expected.remove(13);
            }
            assert_eq!(lines(&without), expected);
            let left = load("r.robot", &without).expect("a spec").effects;
            let mut others = model.effects.clone();
            others.remove(effect);
            let what = |of: &crate::model::Effect| (of.definition.name.clone(), of.joints.clone());
            assert_eq!(
                left.iter().map(what).collect::<Vec<_>>(),
                others.iter().map(what).collect::<Vec<_>>()
            );
        }
    }

    #[test]
    fn what_is_not_there_is_not_removed() {
        assert_eq!(remove("r.robot", TEXT, 8).expect("a spec"), TEXT);
    }
}
