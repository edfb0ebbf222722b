//! Joints beside the chain: where they stand.

use robot_model_spec::Model;
use robot_model_spec::model::Inertial;
use robot_model_spec::urdf::{ImportOptions, import};

use super::{imported, joint, link, two_joints, urdf};

/// A link beside the chain, on a joint of its own.
pub(super) fn beside(kind: &str, inner: &str) -> Vec<String> {
    let mut parts = two_joints();
    parts.push(link("side", 2.0, 0.0));
    parts.push(joint("arm", kind, "upper", "side", inner));
    parts
}

pub(super) fn to_the_tool() -> ImportOptions {
    ImportOptions {
        tip: Some("tool".to_owned()),
        ..ImportOptions::default()
    }
}

#[test]
fn what_mimics_another_joint_stands_where_it_is_put() {
    // `lead` stands at zero, `arm` at 3 * 0 + 0.25; one meter above the joint's origin, 4 kg of the link itself.
    let mut parts = beside(
        "prismatic",
        "<mimic joint='lead' multiplier='3' offset='0.25'/>",
    );
    parts.push(link("other", 0.0, 0.0));
    parts.push(joint("lead", "prismatic", "upper", "other", ""));
    let (text, model) = imported(&parts, &to_the_tool());
    assert!(
        text.contains(": lead, arm at 0.25.") || text.contains(": arm at 0.25, lead."),
        "{text}"
    );
    let Inertial::Nominal(upper) = model.chain().unwrap().links[0].inertial else {
        panic!("nominal by default")
    };
    // 2 kg at 0, 2 kg at 1 m, 2 kg at 1.25 m.
    assert_eq!(upper[..4], [6.0, 0.0, 0.0, 2.0 + 2.5]);

    // Of a follower of a follower: 2 * 0.1 + 0.05.
    let mut parts = beside(
        "prismatic",
        "<mimic joint='lead' multiplier='2' offset='0.05'/>",
    );
    parts.push(link("other", 0.0, 0.0));
    parts.push(joint(
        "lead",
        "prismatic",
        "upper",
        "other",
        "<mimic joint='first' offset='0.1'/>",
    ));
    parts.push(link("third", 0.0, 0.0));
    parts.push(joint("first", "prismatic", "upper", "third", ""));
    let (text, _) = imported(&parts, &to_the_tool());
    assert!(text.contains("arm at 0.25"), "{text}");
}

#[test]
fn a_turned_follower_turns_its_link() {
    let inner = "<mimic joint='j1' multiplier='-1' offset='1.5708'/>";
    let (_, straight) = imported(&beside("revolute", ""), &to_the_tool());
    let (_, turned) = imported(&beside("revolute", inner), &to_the_tool());
    let com = |model: &Model| match model.chain().unwrap().links[0].inertial {
        Inertial::Nominal(ten) => ten,
        _ => panic!("nominal by default"),
    };
    // The link's mass is on the axis, and its inertia is that of a ball: nothing changes.
    assert_eq!(com(&straight), com(&turned));
    let mut parts = beside("revolute", inner);
    let side = parts
        .iter_mut()
        .find(|part| part.contains("'side'"))
        .unwrap();
    *side = link("side", 2.0, 0.5);
    let (_, turned) = imported(&parts, &to_the_tool());
    // A quarter turn of the joint's origin and one of the joint: half a meter along -x.
    // Centers of mass are written with 13 digits.
    for (found, wanted) in com(&turned).iter().zip([6.0, -1.0, 0.0]) {
        assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    }
}

#[test]
fn a_follower_of_the_chain_that_has_mass_is_warned_of() {
    let inner = "<mimic joint='j2' multiplier='-1' offset='0.1'/>";
    let imported = import(&urdf(&beside("prismatic", inner)), &to_the_tool()).unwrap();
    assert_eq!(
        imported.warnings,
        [
            "joint `arm` follows joint `j2` of the chain with 2 kg: the spec holds it where `j2` is zero, so its own motion is \
             missing in the equations"
        ]
    );
    assert!(
        imported
            .spec
            .contains(&format!("// {}.\n", imported.warnings[0])),
        "{}",
        imported.spec
    );

    let mut massless = beside("prismatic", inner);
    let side = massless
        .iter_mut()
        .find(|part| part.contains("'side'"))
        .unwrap();
    *side = link("side", 0.0, 0.0);
    let imported = import(&urdf(&massless), &to_the_tool()).unwrap();
    assert_eq!(imported.warnings, [""; 0]);
}
