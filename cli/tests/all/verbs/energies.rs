//! Every verb on a robot that says its energies.

use std::fmt::Write;

use crate::verbs::common::{Folder, close, json, numbers, white};

const SWING: &str = "\
robot Swing {
    coordinates q1, q2;
    parameters I1: kg*m^2, I2: kg*m^2, m1 = 6 kg, m2: kg, l1: m, c1: m, c2: m;
    constants g = 9.81 m/s^2;
    let x1 = c1*sin(q1);
    let y1 = -c1*cos(q1);
    let x2 = l1*sin(q1) + c2*sin(q1 + q2);
    let y2 = -l1*cos(q1) - c2*cos(q1 + q2);
    kinetic = m1/2*(dot(x1)^2 + dot(y1)^2) + I1/2*dot(q1)^2 + m2/2*(dot(x2)^2 + dot(y2)^2) + I2/2*(dot(q1) + dot(q2))^2;
    potential = g*(m1*y1 + m2*y2);
    effects {
        viscous_friction on all;
    }
}
";

const PARAMETERS: &str = r#"{"I1": 0.264, "I2": 0.012, "m1": 6.813, "m2": 3.361, "l1": 0.552, "c1": 0.346, "c2": 0.212,
    "q1.viscous_friction.fv": 0.3, "q2.viscous_friction.fv": 0.2}"#;

/// Names and values of the base parameters of those numbers.
const BASE: [(&str, f64); 7] = [
    ("I1r", 0.264 + 6.813 * 0.346 * 0.346 + 3.361 * 0.552 * 0.552),
    ("I2r", 0.012 + 3.361 * 0.212 * 0.212),
    ("m1*c1r", 6.813 * 0.346 + 3.361 * 0.552),
    ("m2*c2", 3.361 * 0.212),
    ("m2*l1*c2", 3.361 * 0.552 * 0.212),
    ("q1.viscous_friction.fv", 0.3),
    ("q2.viscous_friction.fv", 0.2),
];

/// The arm's torque, written out by hand.
fn torque(q: [f64; 2], dq: [f64; 2], ddq: [f64; 2]) -> [f64; 2] {
    let [a, b, s1, s2, d] = [BASE[0].1, BASE[1].1, BASE[2].1, BASE[3].1, BASE[4].1];
    let (cos, sin) = (q[1].cos(), q[1].sin());
    let lower = 9.81 * s2 * (q[0] + q[1]).sin();
    [
        (a + b + 2.0 * d * cos) * ddq[0] + (b + d * cos) * ddq[1]
            - d * sin * dq[1] * (2.0 * dq[0] + dq[1])
            + lower
            + 9.81 * s1 * q[0].sin()
            + 0.3 * dq[0],
        (b + d * cos) * ddq[0] + b * ddq[1] + d * sin * dq[0] * dq[0] + lower + 0.2 * dq[1],
    ]
}

/// A log at 200 Hz with dry friction of `coulomb` N m on the second joint, and a little noise.
fn log(seconds: u32, coulomb: f64, phase: f64) -> String {
    let tones = [[(0.6, 1.3), (0.3, 3.1)], [(0.7, 1.7), (0.25, 4.3)]];
    let mut text = String::from("time,q1,q2,tau1,tau2\n");
    let mut noise = 12_345_u64;
    for k in 0..seconds * 200 {
        let t = f64::from(k) / 200.0;
        let sum = |joint: usize, f: fn(f64, f64, f64) -> f64| -> f64 {
            let tones = tones[joint].iter();
            tones.map(|&(a, w)| f(a, w, w * t + phase * w)).sum()
        };
        let q = [0, 1].map(|j| sum(j, |a, _, x| a * x.sin()));
        let dq = [0, 1].map(|j| sum(j, |a, w, x| a * w * x.cos()));
        let ddq = [0, 1].map(|j| sum(j, |a, w, x| -a * w * w * x.sin()));
        let tau = torque(q, dq, ddq);
        let first = tau[0] + 0.1 * white(&mut noise);
        let second = tau[1] + coulomb * dq[1].signum() + 0.1 * white(&mut noise);
        writeln!(
            text,
            "{t:.3},{:.9},{:.9},{first:.9},{second:.9}",
            q[0], q[1]
        )
        .expect("a string takes all");
    }
    text
}

#[test]
fn eval_takes_the_unknown_constants_themselves() {
    let folder = Folder::new();
    folder.write("swing.robot", SWING);
    folder.write("parameters.json", PARAMETERS);
    let (q, dq, ddq) = ([0.4, -0.9], [1.1, -0.6], [2.0, 3.0]);
    folder.write(
        "states.json",
        &format!(r#"{{"states":[{{"q":{q:?},"dq":{dq:?},"ddq":{ddq:?}}}]}}"#),
    );
    let arguments = |file: &'static str| {
        [
            "eval",
            "swing.robot",
            "--states",
            "states.json",
            "--parameters",
            file,
        ]
    };
    let out = json(&folder.succeed(&arguments("parameters.json")));
    let found = numbers(&out["states"][0]["torque"]);
    for (found, wanted) in found.iter().zip(torque(q, dq, ddq)) {
        close(*found, wanted, 1e-12);
    }
    let combination = &out["base_parameters"][0]["combination"];
    assert_eq!(out["base_parameters"][0]["name"], "I1r");
    assert_eq!(combination["m2*l1^2"], 1.0);

    // A nominal mass stands in for one that is not given; a length that is given nowhere does not.
    folder.write("fewer.json", &PARAMETERS.replace(r#""m1": 6.813, "#, ""));
    folder.succeed(&arguments("fewer.json"));
    folder.write("none.json", &PARAMETERS.replace(r#""l1": 0.552, "#, ""));
    let told = folder.refuse(&arguments("none.json"));
    assert!(told.contains("no value for `m2*l1`"), "{told}");
    folder.write("two.json", &PARAMETERS.replacen('{', r#"{"m2*l1": 9, "#, 1));
    let told = folder.refuse(&arguments("two.json"));
    assert!(
        told.contains("the values of its factors make 1.855"),
        "{told}"
    );
}

#[test]
fn identify_finds_the_lumps_with_and_without_accelerations() {
    let folder = Folder::new();
    folder.write("swing.robot", SWING);
    folder.write("log.csv", &log(30, 0.0, 0.0));
    for form in ["acceleration", "filtered"] {
        folder.succeed(&[
            "identify",
            "swing.robot",
            "log.csv",
            "--form",
            form,
            "--json",
            "out.json",
        ]);
        let out = json(&folder.read("out.json"));
        for (k, (name, value)) in BASE.into_iter().enumerate() {
            assert_eq!(out["parameters"][k]["name"], name);
            let found = out["parameters"][k]["value"].as_f64().expect("a number");
            close(found, value, 3e-2 * value);
        }
    }
}

#[test]
fn trace_adds_what_is_missing_to_the_energies() {
    let folder = Folder::new();
    folder.write("swing.robot", SWING);
    folder.write("log.csv", &log(40, 0.8, 0.0));
    folder.write("other.csv", &log(20, 0.8, 0.7));
    folder.succeed(&[
        "trace",
        "swing.robot",
        "log.csv",
        "--validate",
        "other.csv",
        "--amend",
        "more.robot",
        "--json",
        "out.json",
    ]);
    let out = json(&folder.read("out.json"));
    assert_eq!(out["outcome"], "explained", "{out}");
    assert_eq!(out["effects"][0]["kind"], "coulomb-friction");
    assert_eq!(out["effects"][0]["joint"], 2);
    let amended = folder.read("more.robot");
    assert!(amended.contains("coulomb_friction on q2;"), "{amended}");
    assert!(amended.contains("let x2 = l1*sin(q1) + c2*sin(q1 + q2);"));
}

#[test]
fn eval_gives_points_and_their_jacobians() {
    let folder = Folder::new();
    let spec = "\
robot Slide {
    coordinates th, x: m;
    parameters m = 2 kg, J = 0.1 kg*m^2;
    constants l = 0.4 m, h = 1.5 m;
    let px = x + l*sin(th);
    kinetic = m/2*dot(x)^2 + J/2*dot(th)^2;
    potential = 0;
    point tip = [px, 0, h - l*cos(th)];
    point cart = [x, 0, 0];
}
";
    folder.write("slide.robot", spec);
    folder.write(
        "states.json",
        r#"{"states":[{"q":[0.3,-0.8],"dq":[1,2],"ddq":[0,0]}]}"#,
    );
    let out = json(&folder.succeed(&["eval", "slide.robot", "--states", "states.json"]));
    let points = &out["states"][0]["points"];
    let (sin, cos) = 0.3_f64.sin_cos();
    let wanted = [
        (
            "tip",
            [-0.8 + 0.4 * sin, 0.0, 1.5 - 0.4 * cos],
            [[0.4 * cos, 1.0], [0.0, 0.0], [0.4 * sin, 0.0]],
        ),
        (
            "cart",
            [-0.8, 0.0, 0.0],
            [[0.0, 1.0], [0.0, 0.0], [0.0, 0.0]],
        ),
    ];
    for (k, (name, position, jacobian)) in wanted.into_iter().enumerate() {
        let point = &points[k];
        assert_eq!(point["name"], name);
        for (found, wanted) in numbers(&point["position"]).into_iter().zip(position) {
            close(found, wanted, 1e-15);
        }
        for (row, wanted) in jacobian.into_iter().enumerate() {
            for (found, wanted) in numbers(&point["jacobian"][row]).into_iter().zip(wanted) {
                close(found, wanted, 1e-15);
            }
        }
    }
}
