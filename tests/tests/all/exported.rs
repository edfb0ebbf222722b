//! `export` against the arm that it writes: read again, by `import` or by the reader of MJCF in `src/mjcf.rs`, it has the same M, C, G
//! and torques; and Pinocchio's, where it has those of a URDF.

use std::ffi::OsString;
use std::fs;
use std::process::ExitCode;

use robot_model::Inertial;
use robot_model_codegen::compile_model;
use robot_model_spec::Model;
use robot_model_spec::export::{JointNumbers, LinkNumbers, NO_RANGE, Numbers, mjcf, urdf};
use robot_model_spec::model::JointKind;
use robot_model_spec::urdf::{ImportOptions, Inertials, import, write_back};
use robot_model_tests::evaluate::{Forms, Interpreter, relative_difference};
use robot_model_tests::states;
use robot_model_tests::urdfs::{self, given};
use robot_model_tests::{cases, mjcf as reader, shared, specs};
use serde_json::Value;

/// Double precision through texts that keep every digit, and other orders of summation.
const ROUNDING: f64 = 1e-10;

/// The links of an arm, with what fits its ten numbers each.
fn numbers(standard: &[f64], joints: usize) -> Numbers {
    let links = standard.chunks_exact(10).take(joints);
    Numbers {
        links: links
            .map(|ten| LinkNumbers {
                inertial: std::array::from_fn(|k| ten[k]),
                remark: "a remark with -- in it".to_owned(),
            })
            .collect(),
        joints: vec![JointNumbers::default(); joints],
        notes: vec!["a note".to_owned()],
    }
}

fn load(text: &str) -> Model {
    robot_model_spec::load("read.robot", text).unwrap_or_else(|errors| panic!("{errors}\n{text}"))
}

/// A URDF, read with gravity as the spec has it.
fn imported(urdf: &str, gravity: [f64; 3]) -> Model {
    let options = ImportOptions {
        inertials: Inertials::Fixed,
        gravity: Some(gravity),
        ..ImportOptions::default()
    };
    let read = import(urdf, &options).unwrap_or_else(|error| panic!("{error}\n{urdf}"));
    load(&read.spec)
}

fn assert_alike(name: &str, found: &Forms, wanted: &Forms, tolerance: f64) {
    let pairs = [
        ("M", &found.mass_matrix, &wanted.mass_matrix),
        ("C", &found.coriolis_matrix, &wanted.coriolis_matrix),
        ("bias", &found.bias, &wanted.bias),
    ];
    for (what, found, wanted) in pairs {
        // An arm without any Coriolis torque has rounding in its place.
        if wanted.amax() > 1e-9 {
            let difference = relative_difference(found, wanted);
            assert!(
                difference < tolerance,
                "{name}, {what}: {difference:.1e}\n{found}{wanted}"
            );
        }
    }
    let apart = (&found.gravity - &wanted.gravity).amax() / wanted.bias.amax().max(1.0);
    assert!(apart < tolerance, "{name}, G: {apart:.1e}");
}

/// Chains of all conventions, with bodies of eight points; effects are another test's.
#[test]
fn frames_of_all_conventions_are_read_back() {
    let mut chains = 0;
    for spec in [specs::folder("pass"), specs::folder("run")].concat() {
        let mut model = spec.model();
        let Some(chain) = model.chain() else {
            continue;
        };
        let gravity = chain.gravity;
        model.effects.clear();
        let dof = model.joints.len();
        let mut random = states::generator(11);
        let standard = states::physical(&mut random, &model);
        let written = numbers(&standard, dof);
        let interpreter = Interpreter::new(compile_model(&model));
        let as_urdf = urdf(&model, &written).expect("a chain");
        let as_mjcf = mjcf(&model, &written).expect("a chain");
        for (format, read) in [
            ("URDF", imported(&as_urdf, gravity)),
            ("MJCF", load(&reader::spec(&as_mjcf))),
        ] {
            let name = format!("{} as {format}", spec.name);
            for (old, new) in model.joints.iter().zip(&read.joints) {
                assert_eq!((&old.name, old.kind), (&new.name, new.kind), "{name}");
                // A slide of a URDF has a range.
                let made_up = (format == "URDF" && old.kind == JointKind::Prismatic)
                    .then_some((-NO_RANGE, NO_RANGE));
                let wanted = old.limits.position.or(made_up);
                assert_eq!(new.limits.position, wanted, "{name}");
            }
            let values = given(&read);
            let again = Interpreter::new(compile_model(&read));
            for _ in 0..4 {
                let state = states::state(&mut random, dof);
                let found = again.forms(&values, &state);
                assert_alike(
                    &name,
                    &found,
                    &interpreter.forms(&standard, &state),
                    ROUNDING,
                );
            }
        }
        chains += 1;
    }
    assert!(chains >= 14, "{chains}");
}

/// Losses, rotors and springs of MJCF; damping and friction of a URDF, which `import` tells.
#[test]
fn what_acts_on_joints_is_written() {
    let model = specs::named("pass/two_link").model();
    let mut written = numbers(&[0.0; 20], 2);
    written.joints[0].damping = Some(0.25);
    written.joints[0].friction = Some(1.5);
    written.joints[1].armature = Some(0.125);
    let as_urdf = urdf(&model, &written).expect("a chain");
    let read = urdf_rs::read_from_string(&as_urdf).expect("a URDF");
    let dynamics = read.joints[0].dynamics.as_ref().expect("losses");
    assert_eq!((dynamics.damping, dynamics.friction), (0.25, 1.5));
    assert!(read.joints[1].dynamics.is_none());
    let as_mjcf = mjcf(&model, &written).expect("a chain");
    let joints = reader::joints(&as_mjcf);
    assert_eq!(joints[0]["damping"], "0.25");
    assert_eq!(joints[0]["frictionloss"], "1.5");
    assert_eq!(joints[1]["armature"], "0.125");
    assert!(!joints[1].contains_key("damping"));
    let energies = specs::named("pass/phantom").model();
    let refused = urdf(&energies, &written).expect_err("it has no links");
    assert!(
        refused.to_string().contains("is defined by its energies"),
        "{refused}"
    );
    assert_eq!(mjcf(&energies, &written), Err(refused));
}

/// URDFs of the shared material: made anew from their specs, made as MJCF, and written back into with the numbers that they have, of
/// which none may change.
#[test]
fn what_is_written_has_pinocchios_torques() {
    let mut compared = 0;
    for reference in urdfs::all() {
        let Some(original) = reference.text("its export") else {
            continue;
        };
        let spec = import(&original, &reference.options(Inertials::Nominal))
            .unwrap_or_else(|error| panic!("{error}"))
            .spec;
        let model = load(&spec);
        let dof = model.joints.len();
        let written = numbers(&given(&model), dof);
        let back =
            write_back(&original, &model, &written).unwrap_or_else(|error| panic!("{error}"));
        let note = "<!-- robot-model:";
        let start = back.urdf.find(note).expect("the comment at the top");
        let end = start + back.urdf[start..].find("-->").expect("its end") + 3;
        let rest = back.urdf[end..].trim_start();
        assert!(
            original.ends_with(rest) && original.starts_with(&back.urdf[..start]),
            "{}",
            reference.urdf
        );

        let gravity = model.chain().expect("a chain").gravity;
        let as_urdf = urdf(&model, &written).expect("a chain");
        let as_mjcf = mjcf(&model, &written).expect("a chain");
        for read in [imported(&as_urdf, gravity), load(&reader::spec(&as_mjcf))] {
            // Pinocchio has quarter turns with the eight digits of the URDF.
            reference.assert_torques(&read, 1e-8);
        }
        compared += 1;
    }
    let wanted = if shared::is_present() { 24 } else { 0 };
    assert_eq!(compared, wanted, "URDFs compared");
}

fn run(arguments: &[&str]) {
    let program = std::iter::once("robot-model").chain(arguments.iter().copied());
    let code = robot_model_cli::run(program.map(OsString::from));
    assert_eq!(
        format!("{code:?}"),
        format!("{:?}", ExitCode::SUCCESS),
        "{arguments:?}"
    );
}

/// A benchmark arm from its URDF over a fit on its log back into its URDF, rotors in links: the URDF has the torques of the fit, its links are bodies, and
/// what is no inertial or loss is where it was.
#[test]
fn an_identified_arm_goes_back_into_its_urdf() {
    let Some(case) = cases::open().into_iter().next() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("text").to_owned();
    let [spec, fit, out] = ["arm.robot", "fit.json", "out.urdf"].map(path);
    fs::write(&spec, &case.spec).expect("a file");
    let log = case.identify.to_str().expect("text").to_owned();
    let original = case.identify.with_file_name("robot.urdf");
    let original = original.to_str().expect("text").to_owned();
    run(&[
        "identify", &spec, &log, "--method", "physical", "--json", &fit,
    ]);
    let export = [
        "export",
        &spec,
        "--as",
        "urdf",
        "--parameters",
        &fit,
        "-o",
        &out,
    ];
    let more = ["--urdf", &original, "--rotors", "in-links"];
    run(&[&export[..], &more].concat());

    let text = |path: &str| fs::read_to_string(path).expect("a readable file");
    let model = load(&case.spec);
    let compiled = compile_model(&model);
    let report: Value = serde_json::from_str(&text(&fit)).expect("JSON");
    let fitted = report["parameters"].as_array().expect("a list");
    let beta: Vec<f64> = compiled
        .base
        .names
        .iter()
        .map(|name| {
            let found = fitted.iter().find(|entry| entry["name"] == name.as_str());
            found.expect(name)["value"].as_f64().expect("a number")
        })
        .collect();
    let read = imported(&text(&out), model.chain().expect("a chain").gravity);
    let values = given(&read);
    for ten in values.chunks_exact(10).take(read.joints.len()) {
        let ten: [f64; 10] = std::array::from_fn(|k| ten[k]);
        let least = Inertial::from(ten)
            .pseudo_inertia()
            .symmetric_eigenvalues()
            .min();
        assert!(least > 0.0, "{ten:?}");
    }
    // The rigid part of the fit, in standard parameters that make it: those kept.
    let mut standard = vec![0.0; compiled.standard.len()];
    for (&kept, value) in compiled.base.kept.iter().zip(&beta) {
        standard[kept] = *value;
    }
    let own = Interpreter::new(compiled);
    let again = Interpreter::new(compile_model(&read));
    let mut random = states::generator(5);
    let dof = read.joints.len();
    for _ in 0..10 {
        let state = states::state(&mut random, dof);
        let (found, wanted) = (
            again.rigid_torque(&values, &state),
            own.rigid_torque(&standard, &state),
        );
        let difference = relative_difference(&found, &wanted);
        assert!(difference < 1e-6, "{difference:.1e}\n{found}{wanted}");
    }
    let losses = urdf_rs::read_from_string(&text(&out)).expect("a URDF");
    let fitted = |name: &str| {
        let found = fitted.iter().find(|entry| entry["name"] == name);
        found.and_then(|entry| entry["value"].as_f64())
    };
    let mut compared = 0;
    for joint in &losses.joints {
        for (value, effect) in [
            (
                joint.dynamics.as_ref().map(|d| d.damping),
                "viscous_friction.fv",
            ),
            (
                joint.dynamics.as_ref().map(|d| d.friction),
                "coulomb_friction.fc",
            ),
        ] {
            if let Some(wanted) = fitted(&format!("{}.{effect}", joint.name)) {
                let found = value.expect("losses");
                assert!(
                    (found - wanted).abs() < 1e-6 * wanted.abs(),
                    "{}: {found} {wanted}",
                    joint.name
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 0, "the arm declares friction");
}
