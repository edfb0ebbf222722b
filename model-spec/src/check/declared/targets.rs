//! `on a, (b, c)`, `on all`, or nothing: the joints of each instance of an effect.

use proc_macro2::Span;
use syn::Ident;

use crate::ast::{DeclaredEffect, Target, Targets};
use crate::check::Errors;
use crate::diagnostic::Diagnostic;
use crate::model::EffectDefinition;
use crate::suggest;

/// Joint indices of every instance, with the place that names them.
pub(super) fn check_targets(
    joints: &[&Ident],
    declared: &DeclaredEffect,
    definition: &EffectDefinition,
    errors: &mut Errors,
) -> Vec<(Vec<usize>, Span)> {
    let wanted = definition.joints.len();
    match &declared.targets {
        Targets::Arm if wanted == 0 => vec![(Vec::new(), declared.name.span())],
        Targets::Arm => {
            errors.push(no_joints(declared));
            Vec::new()
        }
        Targets::All(span) if wanted == 0 => {
            errors.push(on_the_arm(declared, *span));
            Vec::new()
        }
        Targets::Each(targets) if wanted == 0 => {
            let first = targets.first().map_or(declared.name.span(), |t| t.span);
            errors.push(on_the_arm(declared, first));
            Vec::new()
        }
        Targets::All(_) if wanted == 1 => (0..joints.len())
            .map(|k| (vec![k], declared.name.span()))
            .collect(),
        Targets::All(span) => {
            errors.push(wrong_number(
                declared,
                wanted,
                "`all` stands for single joints",
                *span,
            ));
            Vec::new()
        }
        Targets::Each(targets) => targets
            .iter()
            .filter_map(|target| check_target(joints, declared, wanted, target, errors))
            .collect(),
    }
}

fn check_target(
    all: &[&Ident],
    declared: &DeclaredEffect,
    wanted: usize,
    target: &Target,
    errors: &mut Errors,
) -> Option<(Vec<usize>, Span)> {
    let joints: Vec<Option<usize>> = target
        .joints
        .iter()
        .map(|joint| check_joint(all, joint, errors))
        .collect();
    let joints: Vec<usize> = joints.into_iter().collect::<Option<_>>()?;
    if joints.len() != wanted {
        let label = if joints.len() == 1 {
            "one joint".to_owned()
        } else {
            format!("{} joints", joints.len())
        };
        errors.push(wrong_number(declared, wanted, &label, target.span));
        return None;
    }
    let twice = joints
        .iter()
        .enumerate()
        .find(|(k, joint)| joints[..*k].contains(joint));
    if let Some((k, _)) = twice {
        errors.push(
            Diagnostic::new(
                target.joints[k].span(),
                format!("effect `{}` couples a joint with itself", declared.name),
                "again",
            )
            .help("name different joints"),
        );
        return None;
    }
    Some((joints, target.span))
}

fn check_joint(joints: &[&Ident], name: &Ident, errors: &mut Errors) -> Option<usize> {
    if name == "all" {
        errors.push(
            Diagnostic::new(name.span(), "`all` stands alone", "beside other joints")
                .help("write `on all` without other joints"),
        );
        return None;
    }
    let found = joints.iter().position(|joint| *joint == name);
    if found.is_none() {
        let names: Vec<String> = joints.iter().map(ToString::to_string).collect();
        errors.push(
            Diagnostic::new(
                name.span(),
                format!("the robot has no joint `{name}`"),
                "unknown joint",
            )
            .help(suggest::help(
                &name.to_string(),
                names.iter().map(String::as_str),
            )),
        );
    }
    found
}

fn no_joints(declared: &DeclaredEffect) -> Diagnostic {
    let name = &declared.name;
    let title = format!("effect `{name}` does not say which joints it acts on");
    Diagnostic::new(name.span(), title, "on which joints?").help(format!(
        "write `{name} on all;` or `{name} on first_joint, second_joint;`"
    ))
}

fn on_the_arm(declared: &DeclaredEffect, span: Span) -> Diagnostic {
    let name = &declared.name;
    let title = format!("effect `{name}` acts on the arm as a whole");
    Diagnostic::new(span, title, "not on joints").help(format!("write `{name};`"))
}

fn wrong_number(declared: &DeclaredEffect, wanted: usize, label: &str, span: Span) -> Diagnostic {
    let name = &declared.name;
    let (count, example) = match wanted {
        1 => (
            "one joint".to_owned(),
            format!("`{name} on first_joint, second_joint;`"),
        ),
        2 => (
            "two joints together".to_owned(),
            format!("`{name} on (first_joint, second_joint);`"),
        ),
        n => (
            format!("{n} joints together"),
            format!("`{name} on (first_joint, ..);` with {n} names"),
        ),
    };
    Diagnostic::new(span, format!("effect `{name}` acts on {count}"), label)
        .help(format!("write {example}"))
}
