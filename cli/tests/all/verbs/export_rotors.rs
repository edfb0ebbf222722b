//! `export` of rotors, for which a URDF has no place: apart from the links, or in them.

use crate::verbs::common::Folder;
use crate::verbs::common::moved;
use crate::verbs::export::{EFFECTS, IN_LINKS, VALUES, export, fitted_with, import_back};

/// Center and mass of a link of which no torque tells either.
const COLUMN: [f64; 4] = [0.03, -0.02, 0.05, 4.0];

/// The pendulum with a rotor of ten times the link's inertia about its axis, fitted.
fn with_a_large_rotor() -> Folder {
    let rotor = VALUES.replace(
        "\"upper.motor_inertia.ia\": 0.2",
        "\"upper.motor_inertia.ia\": 2.0",
    );
    assert_ne!(rotor, VALUES);
    fitted_with(EFFECTS, &rotor)
}

/// Such a rotor in its link leaves the mass of CAD there.
#[test]
fn a_rotor_in_a_link_changes_no_mass() {
    let folder = with_a_large_rotor();
    let said = export(&folder, &IN_LINKS);
    // No link of CAD has ten times its inertia.
    assert!(
        said.contains("more than 10 times larger or smaller than the nominal ones")
            && said.contains("`upper` "),
        "{said}"
    );
    import_back(&folder);
    let masses = |text: &str| -> Vec<f64> {
        let spec = robot_model_spec::load("a spec", text).expect("a spec");
        let links = &spec.chain().expect("a chain").links;
        let masses = links.iter().map(|link| match link.inertial {
            robot_model_spec::model::Inertial::Nominal(ten) => ten[0],
            _ => panic!("nominal"),
        });
        masses.collect()
    };
    let [given, written] = ["arm.robot", "back.robot"].map(|file| masses(&folder.read(file)));
    for (given, written) in given.iter().zip(&written) {
        assert!(
            (given - written).abs() < 1e-3 * given,
            "{given} {written}\n{said}"
        );
    }
    assert_eq!((given.len(), written.len()), (2, 2));
    assert!(!said.contains("kg in place of"), "{said}");
}

/// A URDF has the bodies that an MJCF model of the same fit has, and rotors are told with it, as that model has them.
#[test]
fn bodies_of_a_urdf_are_those_beside_its_rotors() {
    let folder = with_a_large_rotor();
    let fit = ["--parameters", "fit.json"];
    let said = export(
        &folder,
        &[&["--as", "urdf", "-o", "out.urdf"], &fit[..]].concat(),
    );
    export(
        &folder,
        &[&["--as", "mjcf", "-o", "out.xml"], &fit[..]].concat(),
    );
    let (urdf, mjcf) = (folder.read("out.urdf"), folder.read("out.xml"));
    for link in [1, 2] {
        let of_urdf = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"].map(|k| attribute(&urdf, k, link));
        let of_urdf = of_urdf.concat();
        let of_mjcf = attribute(&mjcf, "fullinertia", link);
        assert_eq!((of_urdf.len(), of_mjcf.len()), (6, 6));
        for (x, y) in of_urdf.iter().zip(&of_mjcf) {
            assert!((x - y).abs() < 1e-9, "{urdf}\n{mjcf}");
        }
        assert_eq!(
            attribute(&urdf, "mass value", link),
            attribute(&mjcf, "mass", link)
        );
    }
    // Each rotor is told with four digits, on the terminal and in the file.
    let rotors = [1, 2].map(|joint| attribute(&mjcf, "armature", joint)[0]);
    assert!(rotors[0] > 1.0, "{rotors:?}");
    let told = |name: &str, rotor: f64| {
        format!(
            "`{name}` {rotor:.*} kg m^2",
            if rotor < 1.0 { 4 } else { 3 }
        )
    };
    let told = format!(
        "armature of the joints: {}, {}",
        told("upper", rotors[0]),
        told("lower", rotors[1])
    );
    assert!(
        said.contains(&told) && urdf.contains(&told),
        "{said}\n{told}"
    );
    assert!(!said.contains("times larger"), "{said}");
    assert!(!said.contains("motor_inertia"), "{said}");
}

/// The first joint stands upright, so no torque tells where the mass of its link is: a rotor in it moves that no more than the mass.
#[test]
fn a_rotor_in_a_link_moves_no_center_that_no_torque_tells() {
    const UPRIGHT: &str = "robot Upright {
        gravity = [0, 0, -9.81];
        convention = origin;
        joint turn: revolute { xyz = [0, 0, 0.3]; axis = [0, 0, 1]; link = column; }
        joint lift: revolute { xyz = [0.1, 0, 0.1]; axis = [0, 1, 0]; link = arm; }
        link column { mass = 4; com = [0.03, -0.02, 0.05]; inertia = [0.03, 0, 0, 0.03, 0, 0.02]; }
        link arm { mass = 3; com = [0.02, 0, 0.15]; inertia = [0.04, 0, 0, 0.04, 0, 0.005]; }
        effects { motor_inertia on all; }
    }";
    let folder = Folder::new();
    let rotors = r#"{"turn.motor_inertia.ia": 1.5, "lift.motor_inertia.ia": 0.1}"#;
    moved(&folder, UPRIGHT, rotors, |t| {
        [
            0.6 * (1.3 * t).sin() + 0.2 * (2.9 * t).sin(),
            0.5 * (1.9 * t).sin() - 0.3 * (3.3 * t).cos(),
        ]
    });
    folder.write("arm.robot", UPRIGHT);
    folder.succeed(&["identify", "arm.robot", "log.csv", "--json", "fit.json"]);
    let fit = ["--parameters", "fit.json"];
    let said = export(&folder, &IN_LINKS);
    let urdf = folder.read("out.urdf");
    let [found, mass] = [
        attribute(&urdf, "origin xyz", 1),
        attribute(&urdf, "mass value", 1),
    ];
    assert_alike(&[&found[..], &mass].concat(), &said);
    // As in an MJCF model, which says the rotor beside the link.
    let said = export(
        &folder,
        &[&["--as", "mjcf", "-o", "out.xml"], &fit[..]].concat(),
    );
    let mjcf = folder.read("out.xml");
    let [found, mass] = [
        attribute(&mjcf, "inertial pos", 1),
        attribute(&mjcf, "mass", 1),
    ];
    assert_alike(&[&found[..], &mass].concat(), &said);
}

/// The numbers of the n-th attribute of a name.
fn attribute(text: &str, name: &str, place: usize) -> Vec<f64> {
    let value = text.split(&format!("{name}=\"")).nth(place);
    let value = value.and_then(|rest| rest.split('"').next());
    let numbers = value.expect("an attribute").split(' ');
    numbers.map(|x| x.parse().expect("a number")).collect()
}

fn assert_alike(found: &[f64], said: &str) {
    for (found, given) in found.iter().zip(COLUMN) {
        assert!((found - given).abs() < 1e-9, "{found} {given}\n{said}");
    }
    assert_eq!(found.len(), COLUMN.len());
}
