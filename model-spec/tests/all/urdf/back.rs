//! Numbers back into a URDF: what changes and what does not.

use robot_model_spec::Model;
use robot_model_spec::export::{JointNumbers, LinkNumbers, Numbers};
use robot_model_spec::parameter::Status;
use robot_model_spec::urdf::{ImportOptions, WrittenBack, import, write_back};

/// A base, an arm with a plate and an open joint on it, a hand; comments, visuals, blanks and both kinds of empty elements.
const ORIGINAL: &str = r#"<?xml version="1.0"?>
<!-- by hand -->
<robot name="arm" xmlns:x="http://x">
    <material name="red"><color rgba="1 0 0 1"/></material>
    <link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
    <link name="upper-arm">
        <!-- of steel -->
        <inertial>
            <origin xyz="0 0 0.1" rpy="0 0 1"/>
            <mass value="4"/>
            <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.15"/>
        </inertial>
        <collision><geometry><sphere radius="0.1"/></geometry></collision>
    </link>
    <link name="plate"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.02"/></inertial></link>
    <link name="hand"/>
    <joint name="shoulder" type="revolute">
        <parent link="base"/><child link="upper-arm"/>
        <axis xyz="0 0 2"/>
        <limit lower="-1" upper="1" effort="5" velocity="2"/>
        <dynamics friction='0.5' spring="1"/>
    </joint>
    <joint name="weld" type="fixed"><origin xyz="0 0.2 0"/><parent link="upper-arm"/><child link="plate"/></joint>
    <joint name="wrist" type="continuous">
        <origin xyz="0.3 0 0"/>
        <parent link="upper-arm"/><child link="hand"/>
        <axis xyz="0 1 0"/>
    </joint>
</robot>
"#;

fn model(original: &str) -> Model {
    let imported = import(original, &ImportOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    robot_model_spec::load("arm.robot", &imported.spec).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The values that the spec has.
fn numbers(model: &Model) -> Numbers {
    let value = |status| match status {
        Status::Nominal(value) | Status::Fixed(value) => value,
        Status::Unknown => 0.0,
    };
    let all = model.standard_parameters();
    let values: Vec<f64> = all.iter().map(|one| value(one.status)).collect();
    let links = values.chunks_exact(10).take(model.joints.len());
    Numbers {
        links: links
            .map(|ten| LinkNumbers {
                inertial: std::array::from_fn(|k| ten[k]),
                remark: String::new(),
            })
            .collect(),
        joints: vec![JointNumbers::default(); model.joints.len()],
        notes: vec!["so -- it is".to_owned()],
    }
}

fn written(original: &str, change: impl Fn(&mut Numbers)) -> WrittenBack {
    let model = model(original);
    let mut numbers = numbers(&model);
    change(&mut numbers);
    write_back(original, &model, &numbers).unwrap_or_else(|error| panic!("{error}"))
}

/// What an edit takes away and puts in its place, where it is one piece.
fn change<'a>(old: &'a str, new: &'a str) -> (&'a str, &'a str) {
    let same = old
        .bytes()
        .zip(new.bytes())
        .take_while(|(x, y)| x == y)
        .count();
    let ends = old[same..].bytes().rev().zip(new[same..].bytes().rev());
    let behind = ends.take_while(|(x, y)| x == y).count();
    (
        &old[same..old.len() - behind],
        &new[same..new.len() - behind],
    )
}

#[test]
fn numbers_that_are_there_already_change_nothing_but_the_comment_at_the_top() {
    let back = written(ORIGINAL, |_| {});
    let comment = "    <!-- robot-model:\n      so - - it is -->\n    <material";
    assert_eq!(back.urdf, ORIGINAL.replacen("    <material", comment, 1));
    assert_eq!(
        back.notes,
        ["joint `shoulder` keeps its friction of 0.5: the spec declares no such effect"]
    );
    // Written again, the comment is renewed.
    let again = written(&back.urdf, |_| {});
    assert_eq!(again.urdf, back.urdf);
}

/// Nor is a comment left of an earlier export that had something to say.
#[test]
fn where_nothing_is_to_be_said_there_is_no_comment() {
    let silent = |original: &str| written(original, |numbers| numbers.notes.clear()).urdf;
    assert_eq!(silent(ORIGINAL), ORIGINAL);
    let noted = written(ORIGINAL, |_| {}).urdf;
    assert_ne!(noted, ORIGINAL);
    assert_eq!(silent(&noted), ORIGINAL);
}

#[test]
fn a_link_takes_what_is_held_against_it_leaves() {
    let base = written(ORIGINAL, |_| {}).urdf;
    let back = written(ORIGINAL, |numbers| {
        // One kilogram more at the origin of the link.
        numbers.links[0].inertial[0] += 1.0;
        numbers.links[0].remark = "why".to_owned();
    });
    let (gone, new) = change(&base, &back.urdf);
    assert!(
        gone.contains("0 0 0.1") && !gone.contains("visual") && !gone.contains("collision"),
        "{gone}"
    );
    assert!(new.contains("<!-- why -->\n          <origin"), "{new}");
    let read = urdf_rs::read_from_string(&back.urdf).expect("a URDF");
    let inertial = |name: &str| {
        let link = read.links.iter().find(|link| link.name == name);
        link.expect("a link").inertial.clone()
    };
    assert!((inertial("upper-arm").mass.value - 5.0).abs() < 1e-12);
    assert!((inertial("upper-arm").origin.xyz.0[2] - 0.08).abs() < 1e-12);
    assert!((inertial("plate").mass.value - 1.0).abs() < 1e-12);

    let light = written(ORIGINAL, |numbers| {
        numbers.links[0].inertial = [0.5, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.01, 0.0, 0.01];
    });
    assert_eq!(
        light.notes[0],
        "link `upper-arm` carries the inertials of `plate`, which are heavier than the identified sum of all"
    );
    let read = urdf_rs::read_from_string(&light.urdf).expect("a URDF");
    let mass = |k: usize| read.links[k].inertial.mass.value;
    assert!((mass(1) - 0.5).abs() < 1e-12 && mass(2) == 0.0);
}

#[test]
fn elements_that_were_not_there_are_made() {
    let base = written(ORIGINAL, |_| {}).urdf;
    let with = |numbers: &mut Numbers| {
        numbers.links[1].inertial = [2.0, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.01, 0.0, 0.01];
        numbers.joints[0].friction = Some(0.25);
        numbers.joints[0].damping = Some(3.0);
        numbers.joints[1].damping = Some(1e-9);
    };
    let back = written(ORIGINAL, with);
    let expected = base
        .replace(
            "<link name=\"hand\"/>",
            "<link name=\"hand\">\n      <inertial>\n        <origin xyz=\"0 0 0\" rpy=\"0 0 0\"/>\n        <mass value=\"2\"/>\n        \
             <inertia ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.01\" iyz=\"0\" izz=\"0.01\"/>\n      </inertial>\n    </link>",
        )
        .replace("<dynamics friction='0.5'", "<dynamics damping=\"3\" friction='0.25'")
        .replace(
            "<axis xyz=\"0 1 0\"/>",
            "<axis xyz=\"0 1 0\"/>\n        <dynamics damping=\"1e-9\"/>",
        );
    assert_eq!(back.urdf, expected);
    assert!(back.notes.is_empty(), "{:?}", back.notes);
    // Lines end as they did, and elements that are open and empty are filled.
    let other = ORIGINAL
        .replace("<link name=\"hand\"/>", "<link name=\"hand\"></link>")
        .replace('\n', "\r\n");
    let back = written(&other, with).urdf;
    let expected = expected.replace('\n', "\r\n");
    assert_eq!(back, expected);
}

#[test]
fn urdfs_of_other_arms_are_refused() {
    let model = model(ORIGINAL);
    let numbers = numbers(&model);
    let refused = |from: &str, to: &str| {
        let other = ORIGINAL.replace(from, to);
        assert_ne!(other, ORIGINAL);
        let error = write_back(&other, &model, &numbers).expect_err("another arm");
        error.to_string()
    };
    let joints = refused("joint name=\"wrist\"", "joint name=\"elbow\"");
    assert_eq!(
        joints,
        "the URDF has no chain of the joints `shoulder`, `wrist`; give the URDF that the spec was imported from, or remove `--urdf`"
    );
    for (from, to, why) in [
        (
            "0.3 0 0",
            "0.31 0 0",
            "joint `wrist` stands elsewhere in the URDF",
        ),
        (
            "0 1 0",
            "0 -1 0",
            "joint `wrist` has another axis in the URDF",
        ),
        (
            "continuous",
            "prismatic",
            "joint `wrist` has another type in the URDF",
        ),
        ("</robot>", "", "the URDF does not parse: line"),
    ] {
        let said = refused(from, to);
        assert!(said.starts_with(why), "{said}");
    }
}
