//! `simulate`: motions that are nobody's wish.

use std::fmt::Write;

use crate::verbs::common::Folder;

#[test]
fn an_arm_that_falls_beyond_its_limits_is_told() {
    let folder = Folder::new();
    let spec = "robot Falls {
        gravity = [0, -9.81, 0];
        convention = standard_dh;
        joint turn: revolute { a = 0.5; alpha = 0; d = 0; position = -1 .. 1; }
        link turn { mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }
    }";
    folder.write("falls.robot", spec);
    folder.write("still.csv", "time,q1\n0,0\n1,0\n2,0\n3,0\n");
    let files = ["--trajectory", "still.csv", "--out", "log.csv"];
    let run = [
        &["simulate", "falls.robot", "--controller", "none"],
        &files[..],
    ]
    .concat();
    let said = folder.run(&run).stderr;
    assert!(said.contains("joint turn reached position -1."), "{said}");
}

/// A law that is steep through rest, beside joints that stick: its side follows the rounding of an acceleration, and does nothing.
#[test]
fn sides_that_do_nothing_do_not_keep_an_arm_from_moving() {
    let folder = Folder::new();
    let spec = "robot Rrp {
            gravity = [0, 0, -9.81];
            convention = standard_dh;
            joint base: revolute { a = 0.1; alpha = 90 deg; d = 0.3; position = -150 deg .. 150 deg; velocity = 3; acceleration = 20; }
            joint arm: revolute { a = 0.4; alpha = 0; d = 0; position = -100 deg .. 100 deg; velocity = 3; acceleration = 20; }
            joint slide: prismatic { a = 0; alpha = 0; theta = 0; position = 0.05 .. 0.45; velocity = 1; acceleration = 8; }
            link base: nominal { mass = 6; com = [-0.05, 0.01, 0.02]; inertia = [0.05, 0, 0, 0.06, 0, 0.04]; }
            link arm: nominal { mass = 4; com = [-0.18, 0.01, 0.03]; inertia = [0.02, 0, 0, 0.09, 0, 0.08]; }
            link slide: nominal { mass = 2; com = [0.02, 0.01, -0.1]; inertia = [0.02, 0, 0, 0.02, 0, 0.005]; }
            effects { motor_inertia on all; viscous_friction on base, slide; coulomb_friction on base, slide; rokae on arm; }
        }";
    folder.write("arm.robot", spec);
    let values = r#"{
 "base.motor_inertia.ia": 0.3,
 "base.viscous_friction.fv": 2,
 "base.coulomb_friction.fc": 1.5,
 "arm.motor_inertia.ia": 0.4,
 "slide.motor_inertia.ia": 1.5,
 "slide.viscous_friction.fv": 20,
 "slide.coulomb_friction.fc": 8,
 "arm.rokae.fc1": 2,
 "arm.rokae.fc2": 3,
 "arm.rokae.fv1": 4,
 "arm.rokae.fv2": 0.3,
 "arm.rokae.fv3": -0.4,
 "arm.rokae.eps": 0.02
}"#;
    folder.write("values.json", values);
    let mut wanted = String::from("time,q1,q2,q3,dq1,dq2,dq3,ddq1,ddq2,ddq3\n");
    for k in 0..5 {
        let time = f64::from(k) / 1000.0;
        let pose = "7.559559834861e-1,7.017690617831e-1,3.480079102012e-1";
        writeln!(wanted, "{time},{pose},0,0,0,4.440892098501e-16,0,0").expect("a string takes all");
    }
    folder.write("wanted.csv", &wanted);
    folder.succeed(&[
        "simulate",
        "arm.robot",
        "--trajectory",
        "wanted.csv",
        "--parameters",
        "values.json",
        "--controller",
        "computed-torque",
        "--out",
        "log.csv",
    ]);
}

/// Where friction holds next to nothing, its share is found to rounding of all of it, not of itself.
#[test]
fn friction_that_holds_next_to_nothing_is_found() {
    let folder = Folder::new();
    let spec = "robot Arm {
        gravity = [0, -9.81, 0];
        convention = standard_dh;
        joint j: revolute { a = 0.5; alpha = 0; d = 0; }
        effects { viscous_friction on j; coulomb_friction on j; asymmetric_viscous on j; asymmetric_coulomb on j; }
    }";
    folder.write("arm.robot", spec);
    let values = r#"{"j.m": 2, "j.mx": -0.6, "j.my": 0, "j.izz": 0.25, "j.viscous_friction.fv": 0.4, "j.coulomb_friction.fc": 1,
        "j.asymmetric_viscous.delta": 0.1, "j.asymmetric_coulomb.delta": 0.25}"#;
    folder.write("values.json", values);
    let mut wanted = String::from("time,q1\n");
    for k in 0..=400 {
        let t = f64::from(k) / 200.0;
        let q = 0.6 * (2.0 * t).sin() + 0.3 * (5.0 * t).cos();
        writeln!(wanted, "{t},{q}").expect("a string takes all");
    }
    folder.write("wanted.csv", &wanted);
    for seed in ["1", "2", "3"] {
        let motion = [
            "--trajectory",
            "wanted.csv",
            "--out",
            "log.csv",
            "--frequency",
            "30",
        ];
        let values = [
            "--parameters",
            "values.json",
            "--rate",
            "500",
            "--seed",
            seed,
        ];
        let sensors = ["--encoder-bits", "18", "--position-noise", "5e-5"];
        folder.succeed(&[&["simulate", "arm.robot"], &motion[..], &values, &sensors].concat());
    }
}
