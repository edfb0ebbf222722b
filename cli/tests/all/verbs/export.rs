//! `export`: an identified arm as a URDF and as MJCF.

use robot_model::Inertial;
use serde_json::Value;

use crate::verbs::common::{CART, Folder, PENDULUM, json, moved, numbers};

/// The pendulum with friction and rotors, and values of these.
pub(crate) const EFFECTS: &str = "viscous_friction on all; coulomb_friction on all; motor_inertia on all; stribeck(vs = 0.1) on lower;";
pub(crate) const VALUES: &str = r#"{
    "upper.viscous_friction.fv": 0.5, "lower.viscous_friction.fv": 0.2, "upper.coulomb_friction.fc": 0.4, "lower.coulomb_friction.fc": 0.3,
    "upper.motor_inertia.ia": 0.2, "lower.motor_inertia.ia": 0.1, "lower.stribeck.fs": 0.15
}"#;

fn arm(effects: &str) -> String {
    PENDULUM.replace("\n}\n", &format!("\n    effects {{ {effects} }}\n}}\n"))
}

/// A folder with the arm and a fit of its log.
fn fitted(effects: &str) -> Folder {
    fitted_with(effects, VALUES)
}

/// The same with other values.
pub(crate) fn fitted_with(effects: &str, values: &str) -> Folder {
    let folder = Folder::new();
    moved(&folder, &arm(EFFECTS), values, |t| {
        [
            0.6 * (1.3 * t).sin() + 0.2 * (2.9 * t).sin(),
            0.5 * (1.9 * t).sin() - 0.3 * (3.3 * t).cos(),
        ]
    });
    folder.write("arm.robot", &arm(effects));
    folder.succeed(&["identify", "arm.robot", "log.csv", "--json", "fit.json"]);
    folder
}

/// A URDF of the fit with rotors in its links.
pub(crate) const IN_LINKS: [&str; 8] = [
    "--as",
    "urdf",
    "--parameters",
    "fit.json",
    "-o",
    "out.urdf",
    "--rotors",
    "in-links",
];

pub(crate) fn export(folder: &Folder, more: &[&str]) -> String {
    let run = folder.run(&[&["export", "arm.robot"], more].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(run.stdout, "");
    run.stderr
}

/// Forms at some states.
fn forms(folder: &Folder, spec: &str, parameters: &[&str]) -> Value {
    let states = r#"{"states":[{"q":[0.3,-0.8],"dq":[0,0],"ddq":[1,-2]},{"q":[-2,1.1],"dq":[1e-9,1e-9],"ddq":[3,4]},
        {"q":[0.3,-0.8],"dq":[1.5,-2.5],"ddq":[0,0]}]}"#;
    folder.write("states.json", states);
    let eval = [&["eval", spec, "--states", "states.json"], parameters].concat();
    json(&folder.succeed(&eval))["states"].clone()
}

fn assert_alike(found: &Value, wanted: &Value, tolerance: f64) {
    let (found, wanted) = (numbers(found), numbers(wanted));
    let scale = wanted.iter().fold(1e-3_f64, |most, x| most.max(x.abs()));
    for (found, wanted) in found.iter().zip(&wanted) {
        assert!(
            (found - wanted).abs() < tolerance * scale,
            "{found} {wanted}"
        );
    }
}

/// Reads the URDF that was written into `back.robot`.
pub(crate) fn import_back(folder: &Folder) {
    let gravity = ["--gravity", "0,-9.81,0"];
    folder.succeed(&[&["import", "out.urdf", "-o", "back.robot"], &gravity[..]].concat());
}

/// What an estimate has for a name.
fn value(folder: &Folder, name: &str) -> f64 {
    let fit = json(&folder.read("fit.json"));
    let mut list = fit["parameters"].as_array().expect("a list").iter();
    let found = list.find(|entry| entry["name"] == name).expect(name);
    found["value"].as_f64().expect("a number")
}

#[test]
fn a_urdf_has_the_torques_of_the_fit() {
    // Without rotors, Coulomb and viscous friction are all there is beside the links, and a URDF says all of it.
    let folder = fitted("viscous_friction on all; coulomb_friction on all;");
    let said = export(
        &folder,
        &["--as", "urdf", "--parameters", "fit.json", "-o", "out.urdf"],
    );
    assert!(
        said.contains("note: arm.robot: the parameters do not determine every inertial value; the file has for `upper`, `lower` one of \
                       many sets"),
        "{said}"
    );
    assert!(
        said.contains("a URDF cannot hold gravity: [0, -9.81, 0] m/s^2"),
        "{said}"
    );
    assert!(!said.contains("not written"), "{said}");
    let urdf = folder.read("out.urdf");
    assert!(
        urdf.contains("identified only in sums: m, mx")
            && urdf.contains("gravity in the frame of `base`"),
        "{urdf}"
    );
    import_back(&folder);
    let friction = ["viscous_friction.fv", "coulomb_friction.fc"].map(|effect| {
        ["upper", "lower"].map(|joint| {
            let name = format!("{joint}.{effect}");
            format!("\"{name}\": {}", value(&folder, &name))
        })
    });
    let friction = friction.concat().join(", ");
    folder.write("friction.json", &format!("{{{friction}}}"));
    let wanted = forms(&folder, "arm.robot", &["--parameters", "fit.json"]);
    let found = forms(&folder, "back.robot", &["--parameters", "friction.json"]);
    for state in 0..3 {
        assert_alike(&found[state]["torque"], &wanted[state]["torque"], 1e-6);
        assert_alike(&found[state]["gravity"], &wanted[state]["gravity"], 1e-6);
        for row in 0..2 {
            for form in ["mass_matrix", "coriolis_matrix"] {
                assert_alike(&found[state][form][row], &wanted[state][form][row], 1e-6);
            }
        }
    }
    let spec = folder.read("back.robot");
    assert!(
        spec.contains("it says upper: damping") && !spec.contains("no body"),
        "{spec}"
    );
}

#[test]
fn what_a_format_does_not_say_is_told_or_put_where_it_moves_alike() {
    let folder = fitted(EFFECTS);
    let said = export(&folder, &IN_LINKS);
    // The rotor of the first joint is in the link's moment of inertia about its axis; that of the second is one of its own.
    let rotor = value(&folder, "lower.motor_inertia.ia");
    assert!(
        said.contains(&format!(
            "armature of the joints: `lower` {rotor:.4} kg m^2; where a log determines"
        )),
        "{said}"
    );
    assert!(
        said.contains(
            "effects that a URDF cannot express are not written: `lower.stribeck` (fs = 0.1"
        ),
        "{said}"
    );
    assert!(
        folder
            .read("out.urdf")
            .contains("`lower.stribeck` (fs = 0.1")
    );
    import_back(&folder);
    let friction = "\"upper.viscous_friction.fv\": 0, \"lower.viscous_friction.fv\": 0, \"upper.coulomb_friction.fc\": 0, \
                    \"lower.coulomb_friction.fc\": 0";
    folder.write("friction.json", &format!("{{{friction}}}"));
    let found = forms(&folder, "back.robot", &["--parameters", "friction.json"]);
    let wanted = forms(&folder, "arm.robot", &["--parameters", "fit.json"]);
    assert_alike(&found[0]["gravity"], &wanted[0]["gravity"], 1e-6);
    // At rest the arm of the spec has the rotor of the second joint beside what the URDF has.
    let (found, wanted) = (numbers(&found[0]["torque"]), numbers(&wanted[0]["torque"]));
    assert!((found[0] - wanted[0]).abs() < 1e-5, "{found:?} {wanted:?}");
    assert!(
        (found[1] - 2.0 * rotor - wanted[1]).abs() < 1e-5,
        "{found:?} {wanted:?} {rotor}"
    );

    let said = export(
        &folder,
        &["--as", "mjcf", "--parameters", "fit.json", "-o", "out.xml"],
    );
    assert!(
        said.contains("MJCF cannot express are not written: `lower.stribeck` (fs"),
        "{said}"
    );
    assert!(!said.contains("motor_inertia"), "{said}");
    let mjcf = folder.read("out.xml");
    assert!(mjcf.contains("<option gravity=\"0 -9.81 0\"/>"), "{mjcf}");
    assert!(
        mjcf.contains(&format!(
            " damping=\"{}\"",
            value(&folder, "upper.viscous_friction.fv")
        )),
        "{mjcf}"
    );
    assert!(
        mjcf.contains(" armature=\"") && mjcf.contains(" frictionloss=\""),
        "{mjcf}"
    );
}

/// Values by name are those that are written; what no body has is not.
#[test]
fn values_by_name_are_written_as_they_are_where_bodies_have_them() {
    let folder = Folder::new();
    folder.write("arm.robot", PENDULUM);
    let said = export(&folder, &["--as", "mjcf", "-o", "out.xml"]);
    assert_eq!(said, "");
    let mjcf = folder.read("out.xml");
    // The spec's frame of a DH link is at its end, that of a body at its joint.
    assert!(
        mjcf.contains("<inertial pos=\"0.25 0 0\" mass=\"2\""),
        "{mjcf}"
    );
    // A mass that its moments do not bear: the base parameters stay what they are.
    folder.write("values.json", r#"{"lower.m": 3, "lower.mx": -2.4}"#);
    let said = export(
        &folder,
        &[
            "--as",
            "urdf",
            "--parameters",
            "values.json",
            "-o",
            "out.urdf",
        ],
    );
    assert!(
        said.contains("do not determine every inertial value; the file has"),
        "{said}"
    );
    folder.succeed(&[
        "import",
        "out.urdf",
        "-o",
        "back.robot",
        "--gravity",
        "0,-9.81,0",
    ]);
    let spec = robot_model_spec::load("back.robot", &folder.read("back.robot")).expect("a spec");
    for link in &spec.chain().expect("a chain").links {
        let robot_model_spec::model::Inertial::Nominal(ten) = link.inertial else {
            panic!("nominal");
        };
        let least = Inertial::from(ten)
            .pseudo_inertia()
            .symmetric_eigenvalues()
            .min();
        assert!(least > 0.0, "{}", link.name);
    }
}

#[test]
fn estimates_that_no_arm_has_are_told() {
    let folder = fitted("viscous_friction on all; coulomb_friction on all;");
    let mut fit = json(&folder.read("fit.json"));
    let list = fit["parameters"].as_array_mut().expect("a list");
    let entry = list
        .iter_mut()
        .find(|entry| entry["name"] == "lower.coulomb_friction.fc");
    entry.expect("Coulomb friction")["value"] = (-0.2).into();
    folder.write("fit.json", &fit.to_string());
    let said = export(
        &folder,
        &["--as", "urdf", "--parameters", "fit.json", "-o", "out.urdf"],
    );
    assert!(
        said.contains("warning: fit.json: no physically possible arm has these values; a near one is written, with \
                       `lower.coulomb_friction.fc`"),
        "{said}"
    );
    assert!(said.contains(" in place of -0.20000 ("), "{said}");
    assert!(said.contains(" standard deviations)"), "{said}");
    assert!(!folder.read("out.urdf").contains("friction=\"-"));
}

/// The possible arm of `physical` is the one that is written.
#[test]
fn a_possible_arm_is_written_as_it_is() {
    let folder = fitted("viscous_friction on all; coulomb_friction on all;");
    let physical = ["identify", "arm.robot", "log.csv", "--method", "physical"];
    folder.succeed(&[&physical[..], &["--json", "fit.json"]].concat());
    export(
        &folder,
        &["--as", "mjcf", "--parameters", "fit.json", "-o", "out.xml"],
    );
    let fit = json(&folder.read("fit.json"));
    let mut standard = fit["possible"]["standard"]
        .as_array()
        .expect("a list")
        .iter();
    let mass = standard
        .find(|entry| entry["name"] == "upper.m")
        .expect("a mass");
    let mass = mass["value"].as_f64().expect("a number");
    assert!(
        folder
            .read("out.xml")
            .contains(&format!(" mass=\"{mass}\"")),
        "{mass}"
    );
}

/// What other commands write has their names.
#[test]
fn formats_of_other_commands_are_told() {
    let folder = Folder::new();
    folder.write("arm.robot", CART);
    for (format, hint) in [
        ("JSON", "use `robot-model identify --json FILE`"),
        ("c", "use `robot-model emit --lang c`"),
        ("mujoco", "write `mjcf`"),
        ("sdf", "[possible values: urdf, mjcf]"),
    ] {
        let run = folder.run(&["export", "arm.robot", "--as", format, "-o", "out"]);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains(hint), "{}", run.stderr);
    }
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let folder = Folder::new();
    folder.write("arm.robot", CART);
    let refused = |more: &[&str]| folder.refuse(&[&["export", "arm.robot"], more].concat());
    let said = refused(&["--as", "urdf", "-o", "out.urdf"]);
    assert!(
        said.starts_with("error: arm.robot: no value for `cart.m`"),
        "{said}"
    );
    let said = refused(&["--as", "mjcf", "--urdf", "a.urdf", "-o", "out.xml"]);
    assert!(
        said.starts_with("error: `--urdf` belongs to `--as urdf`"),
        "{said}"
    );
    let said = refused(&["--as", "mjcf", "--rotors", "in-links", "-o", "out.xml"]);
    assert!(
        said.starts_with("error: `--rotors in-links` is of `--as urdf`"),
        "{said}"
    );
    let said = refused(&["--as", "urdf", "-o", "arm.robot"]);
    assert!(said.contains("it is the same file as the input"), "{said}");
    folder.write(
        "values.json",
        r#"{"cart.m": 3, "rail.viscous_friction.fv": 5}"#,
    );
    folder.write("other.urdf", crate::verbs::common::URDF);
    let with = [
        "--as",
        "urdf",
        "--parameters",
        "values.json",
        "-o",
        "out.urdf",
    ];
    let said = refused(&[&with[..], &["--urdf", "other.urdf"]].concat());
    assert!(
        said.starts_with("error: other.urdf: the URDF has no chain of the joints `rail`; "),
        "{said}"
    );
    folder.write(
        "swing.robot",
        "robot Swing { coordinates q; parameters m = 1 kg, l = 1 m; constants g = 9.81 m/s^2; kinetic = m*l^2/2*dot(q)^2; \
         potential = m*g*l*sin(q); }",
    );
    let said = folder.refuse(&["export", "swing.robot", "--as", "mjcf", "-o", "out.xml"]);
    assert!(
        said.contains("`Swing` is defined by its energies"),
        "{said}"
    );
}
