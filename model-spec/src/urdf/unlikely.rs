//! Numbers of a URDF that look like those of another unit, where they stand there.

use urdf_rs::{JointType, Robot};

use crate::check::{Dimension, is_unlikely};

/// Angles of a frame beyond this are degrees.
const TURN: f64 = std::f64::consts::TAU + 1e-6;

/// A joint that turns further, rad, turns without end; ten turns in degrees are less.
const NO_RANGE: f64 = 3601.0;

/// Numbers that are larger than those of any usual arm. A URDF is in m, kg, rad and s.
pub(super) fn warnings(robot: &Robot, gravity: Option<[f64; 3]>) -> Vec<String> {
    let mut told = Vec::new();
    let mut tell = |numbers: &[f64], dimension: Dimension, what: &str, owner: &str, meant: &str| {
        let all = numbers.iter();
        if let Some(x) = all.copied().find(|x| is_unlikely(*x, dimension)) {
            told.push(format!("{owner} has {x} in its {what}: {meant}"));
        }
    };
    for joint in &robot.joints {
        let owner = format!("joint `{}`", joint.name);
        let xyz = &joint.origin.xyz.0;
        tell(xyz, Dimension::LENGTH, "origin", &owner, MILLIMETERS);
        let range = [joint.limit.lower, joint.limit.upper];
        let (position, range, meant) = match joint.joint_type {
            JointType::Prismatic => (Dimension::LENGTH, range, MILLIMETERS),
            JointType::Revolute if range.iter().all(|end| end.abs() < NO_RANGE) => {
                let meant = "a URDF has rad; were degrees meant?";
                (Dimension::ANGLE, range, meant)
            }
            _ => (Dimension::ANGLE, [0.0; 2], ""),
        };
        tell(&range, position, "range", &owner, meant);
        let (speed, meant) = match joint.joint_type {
            JointType::Prismatic => (
                Dimension::SPEED,
                "a URDF has m/s, as it stands that is faster than arms are",
            ),
            _ => (
                Dimension::ANGULAR_SPEED,
                "a URDF has rad/s; were degrees meant?",
            ),
        };
        tell(
            &[joint.limit.velocity],
            speed,
            "limit of speed",
            &owner,
            meant,
        );
    }
    let meant = "accelerations are in m/s^2; were mm/s^2 meant?";
    let gravity = gravity.unwrap_or_default();
    tell(
        &gravity,
        Dimension::ACCELERATION,
        "gravity",
        "the arm",
        meant,
    );
    for link in &robot.links {
        let owner = format!("link `{}`", link.name);
        let inertial = &link.inertial;
        let com = &inertial.origin.xyz.0;
        tell(
            com,
            Dimension::LENGTH,
            "center of mass",
            &owner,
            MILLIMETERS,
        );
        let mass = [inertial.mass.value];
        tell(
            &mass,
            Dimension::MASS,
            "mass",
            &owner,
            "a URDF has kg; were grams meant?",
        );
        let i = &inertial.inertia;
        let inertia = [i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz];
        let meant = "a URDF has kg m^2; were kg mm^2 meant?";
        tell(&inertia, Dimension::INERTIA, "inertia", &owner, meant);
    }
    let turned = robot.joints.iter().filter_map(|joint| {
        let mut angles = joint.origin.rpy.0.iter();
        let angle = angles.find(|angle| angle.abs() > TURN)?;
        Some(format!(
            "joint `{}` has an angle of {angle} in its origin: a URDF has rad; were degrees meant?",
            joint.name
        ))
    });
    let turned: Vec<String> = turned.collect();
    told.extend(turned);
    told
}

const MILLIMETERS: &str = "a URDF has m; were millimeters meant?";

#[cfg(test)]
mod tests {
    use crate::urdf::{ImportOptions, import};

    const SOUND: &str = "<robot name=\"a\"><link name=\"base\"/><link name=\"arm\"><inertial><mass value=\"2\"/><origin xyz=\"0 0 0.3\"/>\
         <inertia ixx=\"4\" ixy=\"0\" ixz=\"0\" iyy=\"4\" iyz=\"0\" izz=\"4\"/></inertial></link>\
         <joint name=\"turn\" type=\"revolute\"><origin xyz=\"0 0 0.5\" rpy=\"1.57 0 0\"/><parent link=\"base\"/><child link=\"arm\"/>\
         <limit lower=\"-1\" upper=\"1\" effort=\"50\" velocity=\"3\"/></joint></robot>";

    #[test]
    fn numbers_in_other_units_are_told_and_taken_as_they_stand() {
        let import = |urdf: &str| import(urdf, &ImportOptions::default()).expect("a sound URDF");
        let is_told =
            |warnings: &[String], words: &str| warnings.iter().any(|told| told.contains(words));
        let sound = import(SOUND).warnings;
        assert!(!is_told(&sound, "meant"), "{sound:?}");
        for (number, other, words, written) in [
            (
                "0.5\"",
                "500\"",
                "joint `turn` has 500 in its origin: a URDF has m; were millimeters",
                "500 m]",
            ),
            (
                "0.3\"",
                "300\"",
                "link `arm` has 300 in its center of mass",
                "300 m]",
            ),
            (
                "value=\"2\"",
                "value=\"2500\"",
                "link `arm` has 2500 in its mass: a URDF has kg; were grams",
                "mass = 2500 kg",
            ),
            (
                "1.57 ",
                "90 ",
                "joint `turn` has an angle of 90 in its origin",
                "90 rad",
            ),
            (
                "velocity=\"3\"",
                "velocity=\"180\"",
                "joint `turn` has 180 in its limit of speed",
                "velocity = 180 rad/s",
            ),
            (
                "lower=\"-1\"",
                "lower=\"-150\"",
                "joint `turn` has -150 in its range: a URDF has rad; were degrees",
                "position = -150 rad",
            ),
        ] {
            let found = import(&SOUND.replace(number, other));
            assert!(is_told(&found.warnings, words), "{:?}", found.warnings);
            assert!(found.spec.contains(written), "{}", found.spec);
        }
        // A joint that turns without end may say so by a large number.
        let endless = import(&SOUND.replace("\"-1\"", "\"-1e6\"")).warnings;
        assert!(!is_told(&endless, "in its range"), "{endless:?}");
    }

    #[test]
    fn gravity_in_millimeters_is_told() {
        let options = ImportOptions {
            gravity: Some([0.0, 0.0, -9810.0]),
            ..ImportOptions::default()
        };
        let warnings = super::super::import(SOUND, &options)
            .expect("a sound URDF")
            .warnings;
        let told = "the arm has -9810 in its gravity: accelerations are in m/s^2";
        assert!(
            warnings.iter().any(|one| one.contains(told)),
            "{warnings:?}"
        );
    }
}
