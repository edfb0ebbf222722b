//! `import`.

use crate::common::{Folder, URDF};

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
        "error: cannot write `nowhere/arm.robot`: there is no folder `nowhere`; make it first\n"
    );
    assert_eq!(
        folder
            .run(&["import", "arm.urdf", "-o", "arm.robot", "--gravity", "0,1"])
            .code,
        Some(2)
    );
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
