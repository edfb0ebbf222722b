//! URDF in: what is folded, named, refused; and every URDF of the shared data, where that is present.
#![expect(clippy::float_cmp, reason = "these numbers are exact")]

mod back;
mod broken;
mod effects;
mod held;
mod mimic;

use std::fs;
use std::path::PathBuf;

use robot_model_spec::model::{Inertial, JointKind};
use robot_model_spec::urdf::{ImportOptions, Inertials, import};
use robot_model_spec::{Model, load};

fn link(name: &str, mass: f64, x: f64) -> String {
    format!(
        "<link name='{name}'><inertial><origin xyz='{x} 0 0'/><mass value='{mass}'/>\
         <inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>"
    )
}

fn joint(name: &str, kind: &str, parent: &str, child: &str, inner: &str) -> String {
    format!(
        "<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>\
         <origin xyz='0 0 1' rpy='0 0 1.570796325'/><axis xyz='0 0 1'/>\
         <limit lower='-1' upper='2' effort='10' velocity='3'/>{inner}</joint>"
    )
}

fn urdf(parts: &[String]) -> String {
    format!("<robot name='my-arm'>{}</robot>", parts.concat())
}

fn imported(parts: &[String], options: &ImportOptions) -> (String, Model) {
    let text = import(&urdf(parts), options)
        .unwrap_or_else(|error| panic!("{error}"))
        .spec;
    let model = load("imported.robot", &text).unwrap_or_else(|errors| panic!("{errors}"));
    (text, model)
}

fn refusal(parts: &[String], options: &ImportOptions) -> String {
    import(&urdf(parts), options)
        .expect_err("must be refused")
        .to_string()
}

/// base - mount (fixed) - upper (j1) - bracket (fixed) - fore (j2, prismatic) - tool (fixed)
fn two_joints() -> Vec<String> {
    vec![
        link("base", 9.0, 0.0),
        link("mount", 9.0, 0.0),
        link("upper", 2.0, 0.0),
        link("bracket", 2.0, 0.0),
        link("fore", 3.0, 0.5),
        link("tool", 1.0, 0.5),
        joint("weld", "fixed", "base", "mount", ""),
        joint("j1", "revolute", "mount", "upper", ""),
        joint("bolt", "fixed", "upper", "bracket", ""),
        joint("j2", "prismatic", "bracket", "fore", ""),
        joint("flange", "fixed", "fore", "tool", ""),
    ]
}

#[test]
fn fixed_joints_are_folded_into_frames_and_links() {
    let (text, model) = imported(&two_joints(), &ImportOptions::default());
    assert!(text.contains("robot MyArm {"), "{text}");
    assert_eq!(model.joints.len(), 2);
    assert_eq!(model.joints[1].kind, JointKind::Prismatic);
    // Two quarter turns about z, two meters up.
    let before = model.chain().unwrap().links[0].placement.before;
    assert_eq!(
        before.rotation,
        [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]
    );
    assert_eq!(before.translation, [0.0, 0.0, 2.0]);
    // Two bodies of 2 kg, one meter apart along z: half a meter from the common center each.
    let Inertial::Nominal(upper) = model.chain().unwrap().links[0].inertial else {
        panic!("nominal by default")
    };
    assert_eq!(upper, [4.0, 0.0, 0.0, 2.0, 4.0, 0.0, 0.0, 4.0, 0.0, 2.0]);
}

#[test]
fn inertials_may_be_exact_or_left_out() {
    let with = |inertials| {
        imported(
            &two_joints(),
            &ImportOptions {
                inertials,
                ..ImportOptions::default()
            },
        )
        .1
    };
    assert!(
        matches!(with(Inertials::Fixed).chain().unwrap().links[1].inertial, Inertial::Fixed(ten) if ten[0] == 4.0)
    );
    assert_eq!(
        with(Inertials::None).chain().unwrap().links[1].inertial,
        Inertial::Unknown
    );
}

#[test]
fn a_branching_tree_needs_its_tip() {
    let mut parts = two_joints();
    parts.push(link("camera", 1.0, 0.0));
    parts.push(joint("pan", "continuous", "upper", "camera", ""));
    assert_eq!(
        refusal(&parts, &ImportOptions::default()),
        "the tree branches at link `upper`: choose the chain's end with --tip, one of `fore`, `camera`"
    );
    let to = |tip: &str| ImportOptions {
        tip: Some(tip.to_owned()),
        ..ImportOptions::default()
    };
    let (text, arm) = imported(&parts, &to("tool"));
    assert!(
        text.contains("part of the links that carry them: pan.\n"),
        "{text}"
    );
    assert_eq!(arm.joints.len(), 2);
    // The camera stands still on the upper link.
    assert!(
        matches!(arm.chain().unwrap().links[0].inertial, Inertial::Nominal(ten) if ten[0] == 5.0)
    );
    let (_, pan) = imported(&parts, &to("camera"));
    assert_eq!(pan.joints[1].limits.position, None);
    assert_eq!(
        refusal(&parts, &to("camra")),
        "the URDF has no link `camra`; write `camera`"
    );
}

#[test]
fn joints_that_the_language_cannot_say_are_refused_with_a_reason() {
    let with = |joint: String| vec![link("base", 1.0, 0.0), link("tip", 1.0, 0.0), joint];
    let of = |joint: String| refusal(&with(joint), &ImportOptions::default());
    assert!(of(joint("j", "floating", "base", "tip", "")).starts_with("joint `j` is floating: "));
    assert!(of(joint("j", "planar", "base", "tip", "")).starts_with("joint `j` is planar: "));
    assert_eq!(
        of(joint("j", "fixed", "base", "tip", "")),
        "no joint moves on the way from link `base` to link `base`"
    );
}

#[test]
fn broken_structure_is_refused() {
    let links = || vec![link("a", 1.0, 0.0), link("b", 1.0, 0.0)];
    let with = |joints: &[String]| {
        refusal(
            &[links(), joints.to_vec()].concat(),
            &ImportOptions::default(),
        )
    };
    assert!(
        with(&[
            joint("x", "revolute", "a", "b", ""),
            joint("y", "revolute", "b", "a", "")
        ])
        .contains("loop")
    );
    assert!(
        with(&[
            joint("x", "revolute", "a", "b", ""),
            joint("y", "revolute", "a", "b", "")
        ])
        .contains("two parents")
    );
    assert!(with(&[joint("x", "revolute", "a", "c", "")]).contains("no link `c`"));
    assert!(with(&[]).contains("several trees"));
    let nan = joint("x", "revolute", "a", "b", "").replace("'0 0 1'", "'0 0 NaN'");
    assert_eq!(
        with(&[nan]),
        "the origin of joint `x` is not finite: write a number"
    );
    assert!(
        import("<robot", &ImportOptions::default())
            .expect_err("no XML")
            .to_string()
            .starts_with("the URDF does not parse")
    );
}

#[test]
fn names_become_words_of_the_language() {
    let parts = [
        link("base link", 1.0, 0.0),
        link("1st-link", 1.0, 0.0),
        link("1st link", 1.0, 0.0),
        joint("all", "revolute", "base link", "1st-link", ""),
        joint("loop", "revolute", "1st-link", "1st link", ""),
    ];
    let (_, model) = imported(&parts, &ImportOptions::default());
    let links = &model.chain().unwrap().links;
    let names: Vec<(&str, &str)> = model
        .joints
        .iter()
        .zip(links)
        .map(|(joint, link)| (joint.name.as_str(), link.name.as_str()))
        .collect();
    assert_eq!(names, [("all_", "j1st_link"), ("loop_", "j1st_link_2")]);
}

/// The folder of measured data and cases, which is not part of the repository.
fn shared() -> Option<PathBuf> {
    let folder = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared"));
    folder.is_dir().then_some(folder)
}

#[test]
fn every_shared_urdf_is_imported() {
    let Some(shared) = shared() else {
        eprintln!("shared data is not present: nothing imported");
        return;
    };
    let of = |path: PathBuf, base: Option<&str>, tip: Option<&str>, dof: usize| {
        let text = fs::read_to_string(&path).unwrap();
        let options = ImportOptions {
            base: base.map(str::to_owned),
            tip: tip.map(str::to_owned),
            effects: "all:viscous_friction,coulomb_friction;1:motor_inertia".to_owned(),
            ..ImportOptions::default()
        };
        let imported =
            import(&text, &options).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let model =
            load("imported.robot", &imported.spec).unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!(model.joints.len(), dof, "{}", path.display());
    };
    let mut cases = 0;
    for case in fs::read_dir(shared.join("cases"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
    {
        let urdf = case.join("robot.urdf");
        if urdf.is_file() {
            let dof = fs::read_to_string(&urdf)
                .unwrap()
                .matches("type=\"revolute\"")
                .count();
            of(urdf, None, None, dof);
            cases += 1;
        }
    }
    assert!(cases >= 22, "{cases} cases of 22 have a URDF");
    of(
        shared.join("data/tx40/tx40_mdh_modified.urdf"),
        None,
        None,
        6,
    );
    of(
        shared.join("data/tiago/tiago_48_schunk.urdf"),
        Some("torso_fixed_link"),
        Some("arm_7_link"),
        8,
    );
}

#[test]
fn quarter_turns_that_are_written_short_are_read_as_such_and_told() {
    let with = |angle: &str| {
        let parts: Vec<String> = two_joints()
            .into_iter()
            .map(|part| part.replace("1.570796325", angle))
            .collect();
        imported(&parts, &ImportOptions::default())
    };
    for angle in ["1.5708", "1.570796", "1.57080"] {
        let (text, model) = with(angle);
        let before = model.chain().unwrap().links[0].placement.before;
        assert_eq!(before.rotation[0], [-1.0, 0.0, 0.0], "{angle}");
        let told = angle.trim_end_matches('0');
        assert!(
            text.contains(&format!("are read as one: {told}.\n")),
            "{text}"
        );
    }
    let (text, model) = with("1.571");
    assert!(!text.contains("read as one"), "{text}");
    let before = model.chain().unwrap().links[0].placement.before;
    assert!(before.rotation[0][0] > -1.0, "left as it is");
}

#[test]
fn limits_beyond_those_of_arms_have_their_unit() {
    let parts: Vec<String> = two_joints()
        .into_iter()
        .map(|part| part.replace("lower='-1'", "lower='-50'"))
        .collect();
    let (text, model) = imported(&parts, &ImportOptions::default());
    assert!(text.contains("position = -50 rad .. 2;"), "{text}");
    assert!(text.contains("position = -50 m .. 2;"), "prismatic: {text}");
    assert_eq!(model.joints[0].limits.position, Some((-50.0, 2.0)));
}

#[test]
fn what_is_left_out_is_told() {
    let mut parts = two_joints();
    parts.push("<link name='flange'/>".to_owned());
    parts.push(
        joint(
            "last",
            "revolute",
            "tool",
            "flange",
            "<dynamics damping='-0.5' friction='2'/>",
        )
        .replace("lower='-1' upper='2'", "lower='0' upper='0'"),
    );
    let imported = import(&urdf(&parts), &ImportOptions::default()).unwrap();
    assert_eq!(
        imported.warnings,
        [
            "joint `last` has a negative damping of -0.5: left out",
            "joint `last` has limits from 0 to 0, which are no range to move in: left out",
            "link `flange` has no inertial, which in a URDF means that it weighs nothing: delete its block where its mass is unknown",
        ]
    );
    for warning in &imported.warnings {
        assert!(
            imported.spec.contains(&format!("// {warning}.\n")),
            "{}",
            imported.spec
        );
    }
}

/// Exporters write `1e16` where there is no limit; a spec would refuse it.
#[test]
fn limits_beyond_any_are_none() {
    let mut parts = two_joints();
    let far = "lower='-1e16' upper='1e16' velocity='1e12' effort='1e16'";
    for part in &mut parts {
        *part = part.replace("lower='-1' upper='2' effort='10' velocity='3'", far);
    }
    assert!(parts.iter().any(|part| part.contains(far)));
    let imported = import(&urdf(&parts), &ImportOptions::default()).unwrap();
    for limit in ["position =", "velocity =", "torque ="] {
        assert!(!imported.spec.contains(limit), "{}", imported.spec);
    }
    let told = |warning: &&String| warning.contains("which are no range to move in: left out");
    assert_eq!(imported.warnings.iter().filter(told).count(), 2);
}

#[test]
fn a_name_of_a_novel_is_refused() {
    let mut parts = two_joints();
    let long = "x".repeat(100_000);
    parts.push(link("flange", 1.0, 0.0));
    parts.push(joint(&long, "revolute", "tool", "flange", ""));
    let said = refusal(&parts, &ImportOptions::default());
    assert!(
        said.contains("a name of more than 64 characters"),
        "{}",
        &said[..200]
    );
}

#[test]
fn fixed_joints_behind_the_last_link_lead_to_the_tip() {
    let (text, model) = imported(&two_joints(), &ImportOptions::default());
    assert!(text.contains("tip = [0, 0, 1];"), "{text}");
    assert_eq!(model.chain().expect("a chain").tip, [0.0, 0.0, 1.0]);
    // A chain that ends by name ends there.
    let options = ImportOptions {
        tip: Some("fore".to_owned()),
        ..ImportOptions::default()
    };
    assert!(!imported(&two_joints(), &options).0.contains("tip ="));
}

#[test]
fn other_files_and_links_of_one_name_are_told() {
    let said = |text: &str| {
        let refused = import(text, &ImportOptions::default()).expect_err("refused");
        refused.to_string()
    };
    let other = said("<?xml version='1.0'?>\n<sdf version='1.7'><model name='a'/></sdf>");
    assert!(other.contains("line 2: the file is of `<sdf>`"), "{other}");
    let mut parts = two_joints();
    parts.push("<link name='fore'/>".to_owned());
    let twice = said(&urdf(&parts));
    assert!(twice.contains("two links have the name `fore`"), "{twice}");
}
