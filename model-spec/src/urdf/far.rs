//! Numbers of a URDF that no spec can have, where they stand there.

use urdf_rs::Robot;

use super::{ImportError, UrdfPart};
use crate::transform::is_in_range;

/// The first joint or link with a number that is beyond what is computed with.
pub(super) fn number(robot: &Robot) -> Option<ImportError> {
    let said = |number: f64, what: &str| {
        format!("{number:e} in its {what}: write zero, or a number between 1e-30 and 1e30")
    };
    let of_joints = robot.joints.iter().find_map(|joint| {
        let reason = far(&joint.origin.xyz.0, "origin").or_else(|| far(&joint.axis.xyz.0, "axis"));
        let (number, what) = reason?;
        Some(ImportError::Joint {
            joint: joint.name.clone(),
            reason: format!("has {}", said(number, what)),
            part: UrdfPart::of_joint(&joint.name, what).attribute("xyz"),
        })
    });
    of_joints.or_else(|| {
        robot.links.iter().find_map(|link| {
            let inertial = &link.inertial;
            let inertia = &inertial.inertia;
            let inertia = [
                inertia.ixx,
                inertia.ixy,
                inertia.ixz,
                inertia.iyy,
                inertia.iyz,
                inertia.izz,
            ];
            let (number, what) = far(&inertial.origin.xyz.0, "center of mass")
                .or_else(|| far(&[inertial.mass.value], "mass"))
                .or_else(|| far(&inertia, "inertia"))?;
            Some(ImportError::Inertial {
                link: link.name.clone(),
                reason: said(number, what),
                part: UrdfPart::of_link(
                    &link.name,
                    match what {
                        "mass" => "inertial/mass",
                        "inertia" => "inertial/inertia",
                        _ => "inertial/origin",
                    },
                ),
            })
        })
    })
}

fn far(numbers: &[f64], what: &'static str) -> Option<(f64, &'static str)> {
    let far = numbers.iter().find(|number| !is_in_range(**number));
    far.map(|number| (*number, what))
}

#[cfg(test)]
mod tests {
    use crate::urdf::{ImportOptions, import};

    #[test]
    fn numbers_beyond_reason_are_told_where_they_stand() {
        let sound = "<robot name=\"a\"><link name=\"base\"/><link name=\"arm\"><inertial><mass value=\"2\"/><origin xyz=\"0 0 3\"/>\
             <inertia ixx=\"4\" ixy=\"0\" ixz=\"0\" iyy=\"4\" iyz=\"0\" izz=\"4\"/></inertial></link>\
             <joint name=\"turn\" type=\"continuous\"><origin xyz=\"0 0 5\"/><parent link=\"base\"/><child link=\"arm\"/>\
             <axis xyz=\"0 0 6\"/></joint></robot>";
        let options = ImportOptions::default();
        assert!(import(sound, &options).is_ok());
        for (number, wanted) in [
            ("2", "link `arm` has `mass` 1e200"),
            ("3", "link `arm` has 1e200 in its center of mass"),
            ("5", "joint `turn` has 1e200 in its origin"),
            ("6", "joint `turn` has 1e200 in its axis"),
        ] {
            let far = sound.replace(&format!("{number}\""), "1e200\"");
            let said = import(&far, &options).expect_err("refused").to_string();
            let way_out = "between 1e-30 and 1e30";
            assert!(said.starts_with(wanted) && said.contains("1e200"), "{said}");
            assert!(said.contains(way_out), "{said}");
        }
    }
}
