//! Output error says what logs cannot tell: of two published models whose parameters were published all the same.

use std::fmt::Write;

use crate::common::{Folder, json};

const SIMULATED: [&str; 4] = ["identify", "arm.robot", "log.csv", "--method"];

/// Trojanova et al., two links that swing freely: 7 constants of the rigid body and 4 of friction were fitted to releases.
#[test]
fn of_eleven_constants_of_an_arm_that_falls_eight_are_told_in_ratios() {
    let folder = Folder::new();
    let spec = include_str!("../../../tests/specs/pass/pneumatic_arm.robot");
    folder.write("arm.robot", spec);
    let friction = |[viscous, dry]: [[f64; 2]; 2]| {
        format!(
            "{{\"q1.viscous_friction.fv\": {}, \"q2.viscous_friction.fv\": {}, \"q1.coulomb_friction.fc\": {}, \
             \"q2.coulomb_friction.fc\": {}}}",
            viscous[0], viscous[1], dry[0], dry[1]
        )
    };
    folder.write("values.json", &friction([[0.335, 0.279], [0.203, 0.076]]));
    folder.write("start.json", &friction([[0.3, 0.3], [0.2, 0.1]]));
    let mut wanted = String::from("time,q1,q2\n");
    for k in 0..400 {
        writeln!(wanted, "{},0.7,0.3", 0.01 * f64::from(k)).expect("a string takes all");
    }
    folder.write("wanted.csv", &wanted);
    let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let free = [
        "--controller",
        "none",
        "--rate",
        "200",
        "--parameters",
        "values.json",
    ];
    folder.succeed(&[&["simulate", "arm.robot"], &motion[..], &free].concat());
    let options = [
        "output-error",
        "--start",
        "start.json",
        "--window",
        "9",
        "--json",
        "fit.json",
    ];
    let said = folder.succeed(&[&SIMULATED[..], &options].concat());
    assert!(said.contains("rank 8 of 9,"), "{said}");
    assert!(
        said.contains("rank 8 of 11 with the spec's own constants: `I1`, `I2`, `m1`, `m2`, `l1`, `c1`, `c2` show in 5 sums"),
        "{said}"
    );
    assert!(said.contains("a common factor of I1r,"), "{said}");
    let fit = json(&folder.read("fit.json"));
    let parameters = fit["parameters"].as_array().expect("a list");
    assert!(
        parameters
            .iter()
            .all(|parameter| parameter["value"].is_null()),
        "{said}"
    );
    // Eight ratios of nine parameters, whose factor nothing tells.
    let ratios = fit["ratios"].as_array().expect("a list");
    assert_eq!(ratios.len(), 8, "{said}");
    let value = |name: &str| {
        let is_reference = ratios[0]["reference"] == name;
        let ratio = ratios.iter().find(|ratio| ratio["name"] == name);
        let [value, std] = ["value", "std"].map(|key| ratio.map(|ratio| ratio[key].as_f64()));
        assert!(
            is_reference || std.flatten().expect("a deviation") > 0.0,
            "{said}"
        );
        value.map_or(1.0, |value| value.expect("a ratio"))
    };
    let dry = value("q2.coulomb_friction.fc") / value("q1.coulomb_friction.fc");
    assert!((dry / (0.076 / 0.203) - 1.0).abs() < 0.01, "{said}");
    let reference = ratios[0]["reference"].as_str().expect("a name");
    assert!(said.contains(&format!(" / {reference} = ")), "{said}");
}

/// `th'' - a sin(th) + c th' = b v` with `b v` a square wave that turns at 1.5 rad, sampled at 30 Hz: model (5.2) of the PUMA shoulder. Its
/// damping is not the same both ways, as there.
fn shoulder() -> String {
    const RATE: f64 = 30.0;
    const STEPS: u32 = 20;
    let (a, b, c) = (12.05, 21.42, [34.72, 36.0]);
    let slope = |[angle, speed]: [f64; 2], v: f64| {
        let damping = if speed > 0.0 { c[0] } else { c[1] };
        [speed, a * angle.sin() - damping * speed + b * v]
    };
    let step = 1.0 / (RATE * f64::from(STEPS));
    let (mut state, mut v, mut noise) = ([0.0_f64, 0.0], 2.6, 0x2545_f491_u32);
    let mut log = String::from("time,q1,tau1\n");
    for k in 0..512_u32 {
        if state[0].abs() > 1.5 {
            v = -2.6 * f64::signum(state[0]);
        }
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let error = 3.4e-3 * (f64::from(noise) / f64::from(u32::MAX) - 0.5);
        let time = f64::from(k) / RATE;
        writeln!(log, "{time},{},{v}", state[0] + error).expect("a string takes all");
        for _ in 0..STEPS {
            let on = |[dx, dv]: [f64; 2], h: f64| [state[0] + h * dx, state[1] + h * dv];
            let first = slope(state, v);
            let second = slope(on(first, step / 2.0), v);
            let third = slope(on(second, step / 2.0), v);
            let fourth = slope(on(third, step), v);
            let mean = [0, 1].map(|k| (first[k] + 2.0 * (second[k] + third[k]) + fourth[k]) / 6.0);
            state = on(mean, step);
        }
    }
    log
}

#[test]
fn an_inertia_that_hardly_shows_is_told() {
    let folder = Folder::new();
    let spec = "robot Shoulder {
        gravity = [0, -9.81, 0];
        convention = standard_dh;
        joint turn: revolute { a = 0.5; alpha = 0; d = 0; }
        effects { viscous_friction on turn; }
    }";
    folder.write("arm.robot", spec);
    folder.write("log.csv", &shoulder());
    let options = ["output-error", "--window", "20", "--json", "fit.json"];
    let said = folder.succeed(&[&SIMULATED[..], &options].concat());
    let fit = json(&folder.read("fit.json"));
    let of = |name: &str, key: &str| {
        let mut all = fit["parameters"].as_array().expect("a list").iter();
        let found = all.find(|parameter| parameter["name"] == name);
        found.expect("one")[key].as_f64().expect("a number")
    };
    // One damping for both ways takes it far off, while its deviation is small.
    let (inertia, std) = (of("turn.izzr", "value"), of("turn.izzr", "std"));
    assert!((inertia - 1.0 / 21.42) > 5.0 * std, "{inertia} +- {std}");
    let damping = of("turn.viscous_friction.fv", "value");
    assert!((damping * 21.42 / 35.36 - 1.0).abs() < 0.02, "{damping}");
    let frail = &fit["frail"];
    let ratio = frail["relative_singular_value"].as_f64().expect("a number");
    assert!(ratio < 1.0 / 30.0, "{said}");
    let moves = frail["moves"].as_array().expect("a list");
    let most = moves.iter().find(|part| part[1] == 1.0).expect("one");
    assert_eq!(most[0], "turn.izzr", "{said}");
    assert!(
        said.contains("hardly identified beside the others: ") && said.contains("turn.izzr +1.00"),
        "{said}"
    );
    // The way there, with values.
    assert!(
        said.contains("cost      turn.mxr       turn.my     turn.izzr"),
        "{said}"
    );
}
