//! `import`.

use serde_json::Value;

use crate::verbs::common::{CART, Folder, URDF, cart_log, close, json, numbers};

#[test]
fn import_writes_a_spec_that_passes_the_check() {
    let folder = Folder::new();
    folder.write("arm.urdf", URDF);
    let arguments = [
        "import",
        "arm.urdf",
        "-o",
        "arm.robot",
        "--effects",
        "all:viscous_friction;2:motor_inertia",
    ];
    folder.succeed(
        &[
            arguments.as_slice(),
            &["--gravity", "0,-9.81,0", "--inertials", "fixed"],
        ]
        .concat(),
    );
    assert_eq!(
        folder.succeed(&["check", "arm.robot"]),
        "Arm: 2 joints, 3 base parameters of 23 standard parameters\n   1  lift  prismatic  viscous_friction\n   \
         2  swing revolute   viscous_friction, motor_inertia\n"
            .replace("swing r", "swing  r")
            .replace("lift  p", "lift   p")
    );
    assert!(folder.read("arm.robot").contains("gravity = [0, -9.81, 0]"));
}

/// A URDF has no friction; that the spec has none is told, and where it matters again.
#[test]
fn that_no_friction_is_declared_is_told() {
    let folder = Folder::new();
    folder.write("arm.urdf", URDF);
    let with = "all:coulomb_friction";
    for (effects, is_told) in [("", true), (with, false)] {
        let import = ["import", "arm.urdf", "-o", "arm.robot", "--force"];
        let run = folder.run(&[&import[..], &["--effects", effects]].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let note = "note: no friction is declared";
        assert_eq!(run.stderr.contains(note), is_told, "{}", run.stderr);
    }
    // Nearly all of this cart's force is dry friction.
    folder.write("log.csv", &cart_log(20, 40.0, 0.0));
    let declared = "    effects {\n        viscous_friction on rail;\n    }\n";
    let bare = CART.replace(declared, "");
    assert_ne!(bare, CART);
    for (spec, is_told) in [(bare.as_str(), true), (CART, false)] {
        folder.write("cart.robot", spec);
        let run = folder.run(&["identify", "cart.robot", "log.csv"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let note = "the spec declares no effects, and real joints have friction";
        assert_eq!(run.stderr.contains(note), is_told, "{}", run.stderr);
    }
}

#[test]
fn import_refuses_what_it_cannot_use() {
    let folder = Folder::new();
    folder.write("arm.urdf", URDF);
    folder.write("broken.urdf", &URDF.replace("</robot>", ""));
    let said = folder.refuse(&["import", "broken.urdf", "-o", "arm.robot"]);
    assert!(
        said.starts_with("error: broken.urdf: the URDF does not parse: "),
        "{said}"
    );
    // The line is shown, and in it what is at fault.
    folder.write(
        "unit.urdf",
        &URDF.replacen("value=\"4\"", "value=\"4 kg\"", 1),
    );
    let said = folder.refuse(&["import", "unit.urdf", "-o", "arm.robot"]);
    let [line, caret] = ["value=\"4 kg\"", "^^^^^^^^^^^^"].map(|sign| {
        let lines = said.lines().skip(1).filter_map(|line| line.find(sign));
        lines.collect::<Vec<usize>>()
    });
    assert!(line.len() == 1 && line == caret, "{said}");
    // So is what parses and is no arm.
    for (from, to, reason, caret) in [
        (
            "<parent link=\"base\"/>",
            "<parent link=\"bas\"/>",
            "line 7: the URDF has no link `bas`; write `base`",
            "^^^^^^^^^^",
        ),
        (
            "<axis xyz=\"0 1 0\"/>",
            "<axis xyz=\"0 0 0\"/>",
            "line 9: joint `swing` has an axis without direction",
            "^^^^^^^^^^^",
        ),
    ] {
        assert!(URDF.contains(from), "{from}");
        folder.write("tree.urdf", &URDF.replacen(from, to, 1));
        let said = folder.refuse(&["import", "tree.urdf", "-o", "arm.robot"]);
        assert!(
            said.starts_with(&format!("error: tree.urdf: {reason}")),
            "{said}"
        );
        let marked = said
            .lines()
            .any(|line| line.trim_start_matches([' ', '|']).trim_end() == caret);
        assert!(marked, "{said}");
    }
    // Fingers are no end of an arm; what carries them is.
    let fingers = ["left", "right"].map(|side| {
        format!(
            "<link name=\"{side}\"/><joint name=\"{side}_slide\" type=\"prismatic\"><parent link=\"pendulum\"/><child link=\"{side}\"/>\
             <axis xyz=\"0 1 0\"/><limit lower=\"0\" upper=\"0.04\" effort=\"20\" velocity=\"0.2\"/></joint>"
        )
    });
    let gripper = URDF.replace("</robot>", &format!("{}</robot>", fingers.concat()));
    folder.write("gripper.urdf", &gripper);
    let said = folder.refuse(&["import", "gripper.urdf", "-o", "arm.robot"]);
    assert!(
        said.contains(
            "with --tip, one of `pendulum` (the arm without what moves on it), `left`, `right`"
        ),
        "{said}"
    );
    // A camera on a joint of its own beside the rest of the arm is no finger.
    let turning = gripper.replace("type=\"prismatic\"", "type=\"revolute\"");
    folder.write("camera.urdf", &turning);
    let said = folder.refuse(&["import", "camera.urdf", "-o", "arm.robot"]);
    assert!(
        said.contains("with --tip, one of `left`, `right`"),
        "{said}"
    );
    let said = folder.refuse(&["import", "arm.urdf", "-o", "arm.robot", "--tip", "hand"]);
    assert!(said.contains("the URDF has no link `hand`"), "{said}");
    let said = folder.refuse(&[
        "import",
        "arm.urdf",
        "-o",
        "arm.robot",
        "--effects",
        "all:magic",
    ]);
    assert!(said.starts_with("error: --effects: "), "{said}");
    let said = folder.refuse(&["import", "arm.urdf", "-o", "nowhere/arm.robot"]);
    assert_eq!(
        said,
        "error: cannot write `nowhere/arm.robot`: there is no folder `nowhere`; create it first\n"
    );
    assert_eq!(
        folder
            .run(&["import", "arm.urdf", "-o", "arm.robot", "--gravity", "0,1"])
            .code,
        Some(2)
    );
}

#[test]
fn an_edited_spec_stays() {
    let folder = Folder::new();
    folder.write("arm.urdf", URDF);
    folder.write("arm.robot", "mine");
    let import = ["import", "arm.urdf", "-o", "arm.robot"];
    let said = folder.refuse(&import);
    assert_eq!(
        said,
        "error: cannot write `arm.robot`: this file exists; give another name, or `--force` to replace it\n"
    );
    assert_eq!(folder.read("arm.robot"), "mine");
    folder.succeed(&[&import[..], &["--force"]].concat());
    assert!(folder.read("arm.robot").contains("robot Arm {"));
}

#[test]
fn import_tells_faults_of_the_effects_by_the_argument() {
    let folder = Folder::new();
    folder.write("arm.urdf", URDF);
    let import = |effects: &str| {
        folder.refuse(&[
            "import",
            "arm.urdf",
            "-o",
            "arm.robot",
            "--effects",
            effects,
        ])
    };
    for (effects, why) in [
        ("1:gear_coupling", "acts on two joints together"),
        ("all:gear_coupling", "acts on two joints together"),
        ("(1,1):gear_coupling", "couples a joint with itself"),
        ("(1,2):viscous_friction", "acts on one joint"),
    ] {
        let said = import(effects);
        assert!(said.starts_with("error: --effects: "), "{said}");
        assert!(
            said.contains(why) && !said.contains("imported.robot"),
            "{said}"
        );
    }
    folder.succeed(&[
        "import",
        "arm.urdf",
        "-o",
        "arm.robot",
        "--effects",
        "(1,2):gear_coupling",
    ]);
}

/// Two turning joints of which the second follows the first, `q(elbow) = 2 q(shoulder) + 0.1`; a point of 2 kg at its end,
/// 0.3 m from the elbow, which is 0.5 m from the shoulder. Gravity is along -y.
const TIED: &str = r#"<robot name="tied">
  <link name="base"/>
  <link name="upper"/>
  <link name="fore"><inertial><mass value="2"/><origin xyz="0.3 0 0"/>
    <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>
    <mimic joint="shoulder" multiplier="2" offset="0.1"/></joint>
</robot>"#;

/// `import` with gravity along -y, then `eval` at one state: what the first says, and the second gives.
fn import_and_eval(urdf: &str, [q, dq, ddq]: [[f64; 2]; 3]) -> (String, Value) {
    let folder = Folder::new();
    folder.write("arm.urdf", urdf);
    let state = format!(r#"{{"states":[{{"q":{q:?},"dq":{dq:?},"ddq":{ddq:?}}}]}}"#);
    folder.write("states.json", &state);
    let import = ["import", "arm.urdf", "-o", "arm.robot"];
    let run = folder.run(&[import.as_slice(), &["--gravity", "0,-9.81,0"]].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let out = folder.succeed(&["eval", "arm.robot", "--states", "states.json"]);
    (run.stderr, json(&out))
}

#[test]
fn a_chain_with_a_follower_is_the_arm_without_the_tie() {
    let state = [[0.3, -0.8], [1.0, 2.0], [-1.0, 3.0]];
    let (said, tied) = import_and_eval(TIED, state);
    let tie = r#"<mimic joint="shoulder" multiplier="2" offset="0.1"/>"#;
    let (nothing, free) = import_and_eval(&TIED.replace(tie, ""), state);
    assert_eq!(tied, free);
    assert!(
        said.contains("warning: joint `elbow` follows joint `shoulder` in the URDF, q(elbow) = 2*q(shoulder) + 0.1; "),
        "{said}"
    );
    assert!(!nothing.contains("follows"), "{nothing}");
}

#[test]
fn the_torque_of_the_joint_that_leads_is_the_sum_that_import_says() {
    let [q, dq, ddq] = [0.4_f64, 1.5, -2.0];
    let motion = [[q, 2.0 * q + 0.1], [dq, 2.0 * dq], [ddq, 2.0 * ddq]];
    let (said, out) = import_and_eval(TIED, motion);
    assert!(
        said.contains("motions that keep this tie take tau(shoulder) + 2*tau(elbow) at `shoulder`"),
        "{said}"
    );
    let torque = numbers(&out["states"][0]["torque"]);
    // Lagrange's equation of the tied arm, whose only coordinate is q. The fore arm turns by q + (2 q + 0.1), so the point is
    // at l1 e(q) + l2 e(3 q + 0.1), and its kinetic energy is dq^2 / 2 times J = m (l1^2 + 9 l2^2 + 6 l1 l2 cos(2 q + 0.1)).
    let (m, l1, l2, g) = (2.0, 0.5, 0.3, 9.81);
    let (sin, cos) = (2.0 * q + 0.1).sin_cos();
    let inertia = m * (l1 * l1 + 9.0 * l2 * l2 + 6.0 * l1 * l2 * cos);
    let slope = -12.0 * m * l1 * l2 * sin;
    let gravity = m * g * (l1 * q.cos() + 3.0 * l2 * (3.0 * q + 0.1).cos());
    let wanted = inertia * ddq + 0.5 * slope * dq * dq + gravity;
    close(torque[0] + 2.0 * torque[1], wanted, 1e-12);
}
