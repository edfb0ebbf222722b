//! `trace`: a law that gravity takes in along the traced motion, and that is worth much along another one.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;

use crate::verbs::common::{Folder, json};

pub(crate) const PENDULUM: &str = "robot Pendulum {
    gravity = [0, -9.81, 0];
    convention = modified_dh;
    joint one: revolute { a = 0; alpha = 0; d = 0; }
    effects { viscous_friction on one; }
}";

/// Frequency, rad/s, size, rad, and phase of sines.
type Tones = [(f64, f64, f64); 3];

/// 30 s at 500 Hz of a pendulum with a spring that moves about a position, with white noise of its torque, N m.
pub(crate) fn swinging(
    stiffness: f64,
    middle: f64,
    tones: Tones,
    size: f64,
    mut random: u32,
) -> String {
    let wave = |t: f64, power: i32| -> f64 {
        let of = |(w, size, shift): (f64, f64, f64)| {
            size * w.powi(power) * (w * t + shift + f64::from(power) * FRAC_PI_2).sin()
        };
        tones.map(of).iter().sum()
    };
    let mut text = "time,q1,tau1\n".to_owned();
    for k in 0..15_000 {
        let t = 0.002 * f64::from(k);
        let q = middle + wave(t, 0);
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = size * (f64::from(random) / f64::from(u32::MAX) - 0.5) * 12_f64.sqrt();
        let gravity = 9.81 * (1.2 * q.cos() - 0.1 * q.sin());
        let tau = 0.5 * wave(t, 2) + gravity + 0.3 * wave(t, 1) + stiffness * q + noise;
        writeln!(text, "{t},{q},{tau}").expect("a string");
    }
    text
}

#[test]
fn a_spring_that_gravity_takes_in_is_told_by_what_it_does_elsewhere() {
    let folder = Folder::new();
    folder.write("arm.robot", PENDULUM);
    for (stiffness, is_there) in [(6.0, true), (0.0, false)] {
        let log = |middle: f64, size: f64, seed: u32| {
            let tones = [(0.7, 0.3, 0.0), (2.3, 0.16, 1.1), (5.9, 0.07, 0.4)];
            let tones = tones.map(|(w, amplitude, shift)| (w, size * amplitude, shift));
            swinging(stiffness, middle, tones, 1.0, seed)
        };
        folder.write("monday.csv", &log(-1.45, 1.0, 1));
        folder.write("tuesday.csv", &log(-0.95, 1.6, 2));
        let trace = ["trace", "arm.robot", "monday.csv"];
        let rest = ["--validate", "tuesday.csv", "--json", "out.json"];
        let said = folder.succeed(&[&trace[..], &rest].concat());
        let out = json(&folder.read("out.json"));
        if !is_there {
            assert_eq!(out["outcome"], "nothing-missing", "{said}");
            continue;
        }
        assert_eq!(out["outcome"], "explained", "{said}");
        // Beside gravity the traced motion tells a spring from a constant no more.
        let kind = out["effects"][0]["kind"].as_str().expect("a kind");
        let springs = ["joint-spring", "asymmetric-coulomb", "torque-offset"];
        assert!(springs.contains(&kind), "{said}");
        // Along the traced motion it takes a twentieth off the raw error, and less.
        let percent = &out["effects"][0]["evidence"]["raw_percent"][0];
        assert!(percent.as_f64().expect("a number") < 5.0, "{said}");
        let error = |when: &str| out[when][0].as_f64().expect("a number");
        assert!(error("rmse_after") < 0.7 * error("rmse_before"), "{said}");
    }
}
