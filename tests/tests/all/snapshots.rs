//! Equations and code as their readers see them, one file a form: what changes in a review of a change.
//!
//! That they are right is for `laws.rs` and `oracle.rs` to say.

use std::fmt::Write;
use std::sync::LazyLock;

use robot_model_codegen::Compiled;
use robot_model_codegen::compile_text;
use robot_model_codegen::expr::Style;
use robot_model_codegen::show::{What, document, form};
use robot_model_tests::specs::{self, Spec};

/// Shown whole: a planar arm, an arm with a prismatic joint and fixed inertials, the arm of the books, those that say their
/// energies, those with a memory.
const WHOLE: [&str; 16] = [
    "cart_pole",
    "fixed_arm",
    "known_springs",
    "lone_slide",
    "lugre_link",
    "memory",
    "mounted_arm",
    "odd_angles",
    "phantom",
    "pneumatic_arm",
    "puma560",
    "puma_shoulder",
    "slider",
    "spring_arm",
    "two_link",
    "units",
];

/// Shown by the forms that a person reads of a large arm.
const LARGE: [&str; 6] = [
    "every_effect",
    "panda",
    "rokae_like",
    "skew",
    "stanford",
    "ur10",
];

/// Those whose code is shown too: a chain of each kind, energies with and without lumps.
const EMITTED: [&str; 6] = [
    "two_link",
    "slider",
    "puma560",
    "phantom",
    "pneumatic_arm",
    "spring_arm",
];

/// Each spec, compiled once for all tests of this file.
static COMPILED: LazyLock<Vec<(Spec, Compiled)>> = LazyLock::new(|| {
    let specs = specs::folder("pass").into_iter();
    specs
        .map(|spec| {
            let compiled = spec.compiled();
            (spec, compiled)
        })
        .collect()
});

fn for_each(robots: &[&str], name: &str, text: impl Fn(&Spec, &Compiled) -> String) {
    for robot in robots {
        let (spec, compiled) = COMPILED
            .iter()
            .find(|(spec, _)| spec.name == *robot)
            .unwrap_or_else(|| panic!("no spec `{robot}`"));
        let text = text(spec, compiled);
        // A form that a robot does not have, as points or memories.
        if text.trim().is_empty() {
            continue;
        }
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(format!("snapshots/{robot}"));
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| insta::assert_snapshot!(name, text));
    }
}

fn forms(compiled: &Compiled, whats: &[What]) -> String {
    let forms = whats.iter().map(|&what| form(compiled, what, Style::Text));
    forms.collect::<Vec<_>>().join("\n")
}

#[test]
fn every_spec_is_shown() {
    let mut shown = [&WHOLE[..], &LARGE].concat();
    shown.sort_unstable();
    let specs: Vec<&str> = COMPILED
        .iter()
        .map(|(spec, _)| spec.name.as_str())
        .collect();
    assert_eq!(shown, specs, "list it in `WHOLE` or `LARGE`");
}

#[test]
fn model() {
    for_each(&[&WHOLE[..], &LARGE].concat(), "model", |_, compiled| {
        let model = &compiled.model;
        let Some(chain) = model.chain() else {
            return energies(compiled);
        };
        let mut text = format!(
            "{} from {}, {:?}, gravity {:?}\n",
            model.name, model.source, chain.convention, chain.gravity
        );
        for (joint, link) in model.joints.iter().zip(&chain.links) {
            let placement = &link.placement;
            writeln!(
                text,
                "\n{} (line {}), {:?}",
                joint.name, joint.line, joint.kind
            )
            .unwrap();
            for (place, transform) in [("before", placement.before), ("after", placement.after)] {
                writeln!(
                    text,
                    "  {place:6} rotation {:?}, translation {:?}",
                    transform.rotation, transform.translation
                )
                .unwrap();
            }
            writeln!(
                text,
                "  axis   {:?}, offset {:?}",
                placement.axis, placement.offset
            )
            .unwrap();
            writeln!(text, "  limits {:?}", joint.limits).unwrap();
            writeln!(text, "  gain   {:?}", joint.actuator_gain).unwrap();
            writeln!(text, "  link   {}: {:?}", link.name, link.inertial).unwrap();
        }
        text.push('\n');
        for (k, effect) in model.effects.iter().enumerate() {
            let name = model.effect_name(k);
            writeln!(
                text,
                "{name} on {:?}, shapes {:?}",
                effect.joints, effect.shapes
            )
            .unwrap();
        }
        text
    });
}

/// Coordinates, parameters and the products of parameters.
fn energies(compiled: &Compiled) -> String {
    let model = &compiled.model;
    let energies = model.energies().expect("no chain");
    let mut text = format!("{} from {}\n\n", model.name, model.source);
    for joint in &model.joints {
        writeln!(
            text,
            "{} (line {}), {:?}",
            joint.name, joint.line, joint.kind
        )
        .unwrap();
    }
    text.push('\n');
    for parameter in &energies.parameters {
        writeln!(text, "{}: {:?}", parameter.name, parameter.nominal).unwrap();
    }
    text.push('\n');
    for parameter in &compiled.standard {
        writeln!(text, "{}: {:?}", parameter.name, parameter.status).unwrap();
    }
    text
}

#[test]
fn dynamics() {
    let whats = [
        What::MassMatrix,
        What::CoriolisMatrix,
        What::Gravity,
        What::InverseDynamics,
    ];
    for_each(&WHOLE, "dynamics", |_, compiled| forms(compiled, &whats));
}

#[test]
fn regressor() {
    for_each(&WHOLE, "regressor", |_, compiled| {
        forms(compiled, &[What::BaseRegressor])
    });
}

#[test]
fn mechanics() {
    let whats = [What::Energies, What::ForwardKinematics, What::Jacobian];
    for_each(&WHOLE, "mechanics", |_, compiled| forms(compiled, &whats));
}

#[test]
fn filtered() {
    for_each(&WHOLE, "filtered", |_, compiled| {
        forms(compiled, &[What::BaseFilteredRegressor])
    });
}

/// What large arms have that reads well: gravity and the place of the tip.
#[test]
fn large() {
    let whats = [What::Gravity, What::ForwardKinematics];
    for_each(&LARGE, "large", |_, compiled| forms(compiled, &whats));
}

/// Rates of what effects remember, and what they change of the measurement.
#[test]
fn memory() {
    let whats = [What::StateRates, What::Measurement];
    for_each(&[&WHOLE[..], &LARGE].concat(), "memory", |_, compiled| {
        forms(compiled, &whats)
    });
}

/// The whole document of the planar arm; those of others have the same chapters.
#[test]
fn latex() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("snapshots/two_link");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    let text = document(&specs::named("pass/two_link").compiled());
    settings.bind(|| insta::assert_snapshot!("latex", text));
}

#[test]
fn base() {
    for_each(&[&WHOLE[..], &LARGE].concat(), "base", |_, compiled| {
        forms(compiled, &[What::BaseParameters])
    });
}

#[test]
fn cost() {
    for_each(&[&WHOLE[..], &LARGE].concat(), "cost", |_, compiled| {
        forms(compiled, &[What::Cost])
    });
}

#[test]
fn emitted() {
    for_each(&EMITTED, "emitted", |spec, _| {
        compile_text(&format!("{}.robot", spec.name), &spec.text)
            .unwrap_or_else(|error| panic!("{error}"))
    });
}
