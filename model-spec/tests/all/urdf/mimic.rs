//! Joints of the chain that mimic others: joints of their own in the spec, with the tie told.

use robot_model_spec::urdf::{ImportOptions, Imported, import};

use super::held::{beside, to_the_tool};
use super::{joint, link, refusal, urdf};

/// A chain of turning joints, by their names and what they mimic; the last link is `link_<name>`.
fn chain(joints: &[(&str, &str)]) -> Vec<String> {
    let mut parts = vec![link("base", 1.0, 0.0)];
    let mut parent = "base".to_owned();
    for (name, mimic) in joints {
        let child = format!("link_{name}");
        parts.push(link(&child, 1.0, 0.5));
        parts.push(joint(name, "revolute", &parent, &child, mimic));
        parent = child;
    }
    parts
}

fn import_of(parts: &[String], options: &ImportOptions) -> Imported {
    import(&urdf(parts), options).unwrap_or_else(|error| panic!("{error}"))
}

/// The spec without its comments.
fn equations(spec: &str) -> String {
    let lines = spec.lines().filter(|line| !line.starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

/// The spec is that of the URDF without ties, limits included; what is left out stands in its comments.
fn assert_free(joints: &[(&str, &str)], warnings: &[&str]) {
    let tied = import_of(&chain(joints), &ImportOptions::default());
    let free: Vec<(&str, &str)> = joints.iter().map(|(name, _)| (*name, "")).collect();
    let free = import_of(&chain(&free), &ImportOptions::default());
    assert_eq!(tied.warnings, warnings);
    assert_eq!(equations(&tied.spec), equations(&free.spec));
    assert!(tied.spec.contains("joint b: revolute { xyz = [0, 0, 1]; rpy = [0, 0, 90 deg]; axis = [0, 0, 1]; position = -1 .. 2;"), "{}", tied.spec);
    for warning in warnings {
        assert!(
            tied.spec.contains(&format!("// {warning}.\n")),
            "{}",
            tied.spec
        );
    }
}

#[test]
fn a_follower_of_the_chain_moves_freely_and_its_tie_is_told() {
    assert_free(
        &[
            ("a", ""),
            ("b", "<mimic joint='a' multiplier='2' offset='0.1'/>"),
        ],
        &[
            "joint `b` follows joint `a` in the URDF, q(b) = 2*q(a) + 0.1; in the spec it moves freely: M, C, G and tau are those of \
             the arm without this tie, a log needs the positions and torques of `a` and of `b`, and motions that keep this tie take \
             tau(a) + 2*tau(b) at `a`",
        ],
    );
}

#[test]
fn a_leader_may_stand_behind_its_follower() {
    assert_free(
        &[
            ("b", "<mimic joint='a' multiplier='-1' offset='-0.25'/>"),
            ("a", ""),
        ],
        &[
            "joint `b` follows joint `a` in the URDF, q(b) = -q(a) - 0.25; in the spec it moves freely: M, C, G and tau are those of \
             the arm without this tie, a log needs the positions and torques of `a` and of `b`, and motions that keep this tie take \
             tau(a) - tau(b) at `a`",
        ],
    );
}

#[test]
fn followers_of_followers_act_on_the_joint_that_leads_them_all() {
    // c = -0.5 (2 a + 0.1) + 0.3
    assert_free(
        &[
            ("a", ""),
            ("b", "<mimic joint='a' multiplier='2' offset='0.1'/>"),
            ("c", "<mimic joint='b' multiplier='-0.5' offset='0.3'/>"),
        ],
        &[
            "joints `b`, `c` follow joint `a` in the URDF, q(b) = 2*q(a) + 0.1, q(c) = -q(a) + 0.25; in the spec they move freely: \
             M, C, G and tau are those of the arm without these ties, a log needs the positions and torques of `a` and of `b`, `c`, \
             and motions that keep these ties take tau(a) + 2*tau(b) - tau(c) at `a`",
        ],
    );
}

#[test]
fn a_multiplier_of_zero_leaves_the_leader_alone() {
    assert_free(
        &[
            ("a", ""),
            ("b", "<mimic joint='a' multiplier='0' offset='1.5708'/>"),
        ],
        // The offset is a quarter turn that is written short.
        &[
            "joint `b` follows joint `a` in the URDF, q(b) = 1.570796326795; in the spec it moves freely: M, C, G and tau are those \
             of the arm without this tie, a log needs the positions and torques of `a` and of `b`, and motions that keep this tie \
             take tau(a) at `a`",
        ],
    );
}

#[test]
fn a_leader_beside_the_chain_stands_still() {
    let mut parts = chain(&[
        ("a", ""),
        ("b", "<mimic joint='side' multiplier='2'/>"),
        ("c", "<mimic joint='b' multiplier='3'/>"),
    ]);
    parts.push(link("rocker", 1.0, 0.0));
    parts.push(joint("side", "revolute", "link_a", "rocker", ""));
    let options = ImportOptions {
        tip: Some("link_c".to_owned()),
        ..ImportOptions::default()
    };
    assert_eq!(
        import_of(&parts, &options).warnings,
        [
            "joint `b` follows joint `side` in the URDF, q(b) = 2*q(side); in the spec it moves freely: M, C, G and tau are those of \
             the arm without this tie, `side` is not on the chain and stands still, and motions that keep this tie take 2*tau(b) at \
             `side` beside what moves `side` itself",
            "joint `c` follows joint `b` in the URDF, q(c) = 3*q(b); in the spec it moves freely: M, C, G and tau are those of the arm \
             without this tie, a log needs the positions and torques of `b` and of `c`, and motions that keep this tie take \
             tau(b) + 3*tau(c) at `b`",
        ]
    );
}

#[test]
fn ties_are_told_in_the_names_of_the_spec() {
    let parts = chain(&[("1-lead", ""), ("2-follow", "<mimic joint='1-lead'/>")]);
    let warnings = import_of(&parts, &ImportOptions::default()).warnings;
    assert!(
        warnings[0].starts_with(
            "joint `j2_follow` follows joint `j1_lead` in the URDF, q(j2_follow) = q(j1_lead); "
        ),
        "{warnings:?}"
    );
}

#[test]
fn limits_of_a_follower_are_its_own() {
    let mut parts = chain(&[("a", ""), ("b", "<mimic joint='a'/>")]);
    let follower = parts.last_mut().expect("a joint");
    *follower = follower.replace("lower='-1' upper='2'", "lower='0' upper='0'");
    let imported = import_of(&parts, &ImportOptions::default());
    assert_eq!(imported.warnings.len(), 2);
    assert_eq!(
        imported.warnings[1],
        "joint `b` has limits from 0 to 0, which are no range to move in: left out"
    );
}

#[test]
fn a_mimic_of_nothing_or_of_itself_is_refused() {
    let on_the_chain = |joints: &[(&str, &str)]| refusal(&chain(joints), &ImportOptions::default());
    let aside = |inner: &str| refusal(&beside("prismatic", inner), &to_the_tool());
    assert_eq!(
        on_the_chain(&[("lead", ""), ("b", "<mimic joint='laed'/>")]),
        "joint `b` mimics joint `laed`, which the URDF does not have: write `lead`"
    );
    assert_eq!(
        on_the_chain(&[("a", ""), ("b", "<mimic joint='wheel'/>")]),
        "joint `b` mimics joint `wheel`, which the URDF does not have: write `a`"
    );
    // The one that names it is told, not the one that follows that one.
    assert_eq!(
        on_the_chain(&[("a", "<mimic joint='b'/>"), ("b", "<mimic joint='wheel'/>")]),
        "joint `b` mimics joint `wheel`, which the URDF does not have: write `a`"
    );
    assert_eq!(
        on_the_chain(&[("a", "<mimic joint='a'/>")]),
        "joint `a` mimics itself, by way of joint `a`: take one `<mimic>` away"
    );
    let [a, b, c] = [
        ("a", "<mimic joint='b'/>"),
        ("b", "<mimic joint='c'/>"),
        ("c", "<mimic joint='b'/>"),
    ];
    let cycle = "joint `b` mimics itself, by way of joint `c`: take one `<mimic>` away";
    assert_eq!(on_the_chain(&[a, b, c]), cycle);
    assert_eq!(on_the_chain(&[b, c, a]), cycle);
    assert_eq!(
        aside("<mimic joint='lead'/>"),
        "joint `arm` mimics joint `lead`, which the URDF does not have: write one of `j1`, `j2`"
    );
    assert_eq!(
        aside("<mimic joint='arm'/>"),
        "joint `arm` mimics itself, by way of joint `arm`: take one `<mimic>` away"
    );
    assert_eq!(
        on_the_chain(&[("a", ""), ("b", "<mimic joint='a' multiplier='inf'/>")]),
        "the place where joint `b` mimics another is not finite: write a number"
    );
}
