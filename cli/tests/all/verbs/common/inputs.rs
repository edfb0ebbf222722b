//! Specs, a URDF, and logs whose every number can be checked by hand.

use std::fmt::Write;

use super::Folder;

/// A mass on a rail: every number of a test can be checked by hand.
pub const CART: &str = "\
robot Cart {
    gravity = [0, 0, -9.81];
    convention = origin;
    joint rail: prismatic { xyz = [0, 0, 0]; axis = [1, 0, 0]; link = cart; }   // runs level
    effects {
        viscous_friction on rail;
    }
}
";

/// A double pendulum with CAD values.
pub const PENDULUM: &str = "\
robot Pendulum {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint upper: revolute { a = 0.5; alpha = 0; d = 0; }
    joint lower: revolute { a = 0.4; alpha = 0; d = 0; }
    link upper { mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }
    link lower { mass = 1; com = [-0.2, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }
}
";

/// The same with units, limits and friction.
pub const MEASURED_PENDULUM: &str = "\
robot Pendulum {
    gravity = [0 m/s^2, -9.81 m/s^2, 0 m/s^2];
    convention = standard_dh;
    joint upper: revolute { a = 500 mm; alpha = 0 deg; d = 0 m; position = -170 deg .. 170 deg; velocity = 180 deg/s; torque = 60 Nm; }
    joint lower: revolute { a = 40 cm; alpha = 0 rad; d = 0 mm; position = -2.5 rad .. 2.5 rad; velocity = 30 rpm; torque = 20 Nm; }
    link upper { mass = 2 kg; com = [-250 mm, 0 m, 0 m]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }
    link lower { mass = 1000 g; com = [-20 cm, 0 m, 0 m]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }
    effects {
        coulomb_friction on all;
        stribeck(vs = 0.1 rad/s) on upper;
    }
}
";

/// A lift with a pendulum on it.
pub const URDF: &str = r#"<robot name="arm">
  <link name="base"/>
  <link name="sledge"><inertial><mass value="4"/><origin xyz="0 0 0.1"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <link name="pendulum"><inertial><mass value="1"/><origin xyz="0 0 -0.3"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.01"/></inertial></link>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="sledge"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="100" velocity="1"/></joint>
  <joint name="swing" type="continuous"><parent link="sledge"/><child link="pendulum"/><axis xyz="0 1 0"/></joint>
</robot>"#;

/// A log of the cart at 200 Hz: mass 3 kg, viscous friction 5 N s/m, Coulomb friction `coulomb` N, a little noise.
pub fn cart_log(seconds: u32, coulomb: f64, phase: f64) -> String {
    cart_with(200, seconds, &tones(phase), |_, dq| coulomb * dq.signum())
}

/// Amplitude, angular frequency and phase of the sines that the cart moves along.
pub const fn tones(phase: f64) -> [[f64; 3]; 3] {
    [
        [0.20, 1.3, phase],
        [0.05, 4.1, 1.0 + phase],
        [0.02, 7.9, 2.0],
    ]
}

/// A log of the cart along other sines and with another force of position and velocity beside inertia and viscous friction.
pub fn cart_with(
    rate: u32,
    seconds: u32,
    tones: &[[f64; 3]],
    extra: impl Fn(f64, f64) -> f64,
) -> String {
    let mut text = String::from("time,q1,tau1\n");
    let mut noise = 12_345_u64;
    for k in 0..seconds * rate {
        let t = f64::from(k) / f64::from(rate);
        let sum = |f: &dyn Fn(f64, f64, f64) -> f64| {
            tones
                .iter()
                .map(|&[a, w, p]| f(a, w, w * t + p))
                .sum::<f64>()
        };
        let q = sum(&|a, _, angle| a * angle.sin());
        let dq = sum(&|a, w, angle| a * w * angle.cos());
        let ddq = sum(&|a, w, angle| -a * w * w * angle.sin());
        let tau = 3.0 * ddq + 5.0 * dq + extra(q, dq) + 0.1 * white(&mut noise);
        writeln!(text, "{t:.3},{q:.9},{tau:.6}").expect("a string takes all");
    }
    text
}

/// A cart whose spec has dry friction, and a log of it that has a Stribeck curve besides.
pub fn cart_breaking_away() -> (String, String) {
    let spec = super::CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail; coulomb_friction on rail;",
    );
    let tones = [[0.2, 2.3, 0.0], [0.11, 5.17, 1.0], [0.05, 9.7, 2.0]];
    let rise = |dq: f64| 0.6 * (-(dq / 0.02).powi(2)).exp();
    let log = cart_with(200, 40, &tones, |_, dq| (1.0 + rise(dq)) * dq.signum());
    (spec, log)
}

/// Between -1/2 and 1/2: a linear congruence is random enough for a sensor.
pub fn white(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    f64::from(u32::try_from(*state >> 33).expect("31 bits")) / f64::from(1_u32 << 31) - 0.5
}

/// A log of a spec's arm of two joints in a folder, `log.csv`: by parameters, along a wanted motion of 25 s, with a little noise.
pub fn moved(folder: &Folder, spec: &str, parameters: &str, at: impl Fn(f64) -> [f64; 2]) {
    folder.write("true.robot", spec);
    folder.write("true.json", parameters);
    let mut wanted = String::from("time,q1,q2\n");
    for k in 0..=5000 {
        let t = f64::from(k) / 200.0;
        let [up, lo] = at(t);
        writeln!(wanted, "{t},{up},{lo}").expect("a string takes all");
    }
    folder.write("wanted.csv", &wanted);
    let simulate = ["simulate", "true.robot", "--parameters", "true.json"];
    let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let noise = ["--torque-noise", "0.02", "--seed", "1"];
    folder.succeed(&[&simulate[..], &motion, &noise].concat());
}

/// Two joints and known links, with friction and `effects`.
pub fn folding(effects: &str) -> String {
    format!(
        "robot A {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint up: revolute {{ a = 0.5; alpha = 90 deg; d = 0; }}
            joint lo: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            link up: fixed {{ mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }}
            link lo: fixed {{ mass = 1; com = [-0.2, 0, 0.03]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }}
            effects {{ viscous_friction on all; coulomb_friction on all; {effects} }}
        }}"
    )
}

/// A motion of two joints for `--trajectory`, so many samples at 500 Hz: sums of waves of a size, rad, and of these rates, rad/s, which each
/// joint has with phases of its own.
pub fn two_joints_waving(samples: i32, size: f64, rates: &[f64]) -> String {
    let mut wanted = String::from("time,q1,q2\n");
    for k in 0..samples {
        let t = 0.002 * f64::from(k);
        let sum = |phase: f64| -> f64 {
            let waves = rates.iter();
            waves.map(|w| size * (w * t + phase * w).sin()).sum()
        };
        writeln!(wanted, "{t},{},{}", sum(0.3), sum(1.1)).expect("a string takes all");
    }
    wanted
}
