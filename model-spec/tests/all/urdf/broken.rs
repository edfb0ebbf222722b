//! URDFs that cannot be read: which line, which element, what to do.

use robot_model_spec::urdf::{ImportOptions, Inertials, import};

const SOUND: &str = r#"<robot name="arm">
  <link name="base"/>
  <link name="fore">
    <inertial>
      <origin xyz="0 0 0.1"/>
      <mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
    </inertial>
  </link>
  <joint name="joint-1" type="revolute">
    <parent link="base"/>
    <child link="fore"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="5" velocity="2"/>
  </joint>
</robot>
"#;

fn refused(from: &str, to: &str, options: &ImportOptions) -> String {
    assert!(SOUND.contains(from), "{from}");
    let broken = SOUND.replacen(from, to, 1);
    let error = import(&broken, options).expect_err("must be refused");
    error.to_string()
}

/// An element of xacro in a file that declares its prefix is XML, and what reads URDFs goes past it.
#[test]
fn xacro_that_was_not_expanded_is_told_with_its_line() {
    let xacro = "<robot name=\"arm\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">";
    let declared = SOUND.replace("<robot name=\"arm\">", xacro);
    let options = ImportOptions::default();
    // `xacro` itself leaves the declaration behind.
    assert!(import(&declared, &options).is_ok());
    let called = declared.replace("</robot>", "  <xacro:gripper parent=\"fore\"/>\n</robot>");
    let error = import(&called, &options).expect_err("must be refused");
    assert_eq!(
        error.to_string(),
        "the URDF does not parse: line 16: `<xacro:gripper>` is of xacro: expand the file first, `xacro arm.urdf.xacro > arm.urdf`"
    );
}

#[test]
fn what_does_not_parse_is_told_with_its_line() {
    for (from, to, said) in [
        (
            r#"xyz="0 0 1""#,
            r#"xyz="0 a 0""#,
            r#"line 13: `xyz="0 a 0"` in `<axis>` of joint `joint-1` is not 3 numbers: write them with blanks between, in SI units, without units"#,
        ),
        (
            r#"value="2""#,
            r#"value="${m}""#,
            r#"line 6: `value="${m}"` in `<mass>` of link `fore` is of xacro: expand the file first, `xacro arm.urdf.xacro > arm.urdf`"#,
        ),
        (
            r#"value="2""#,
            r#"value="1 kg""#,
            r#"line 6: `value="1 kg"` in `<mass>` of link `fore` is no number: write it in SI units, without a unit"#,
        ),
        (
            r#"<mass value="2"/>"#,
            "",
            "line 4: `<inertial>` of link `fore` has no `<mass ../>`: write one",
        ),
        (
            r#"<mass value="2"/>"#,
            r#"<mass value="2"/><mass value="3"/>"#,
            "line 6: a second `<mass>` in link `fore`: keep one",
        ),
        (
            r#"iyz="0" "#,
            "",
            r#"line 7: `<inertia>` of link `fore` has no `iyz`: write `iyz=".."`"#,
        ),
        (
            r#"type="revolute""#,
            r#"type="hinge""#,
            r#"line 10: `type="hinge"` in `<joint>` of joint `joint-1` is no type of a joint: write one of revolute, continuous, prismatic, fixed, floating, planar, spherical"#,
        ),
        (
            r#"    <child link="fore"/>
"#,
            "",
            "line 10: `<joint>` of joint `joint-1` has no `<child ../>`: write one",
        ),
        (
            r#"value="2""#,
            r#"value="&m;""#,
            "line 6: `&m;` stands for nothing here: write what is meant; the sign `&` itself is `&amp;`",
        ),
        (
            "  </joint>\n</robot>\n",
            "",
            "line 15: the file ends inside the `<joint>` of line 10: close it, or read the whole file again",
        ),
    ] {
        assert_eq!(
            refused(from, to, &ImportOptions::default()),
            format!("the URDF does not parse: {said}")
        );
    }
}

/// The library that reads URDFs leaves such words out, and takes the numbers that are left.
#[test]
fn words_among_numbers_are_refused_with_their_letters() {
    for (from, to, said, letters) in [
        (
            r#"xyz="0 0 0.1""#,
            r#"xyz="1m 0 0 0.1""#,
            r#"line 5: `xyz="1m 0 0 0.1"` in `<origin>` of link `fore` is not 3 numbers: write them with blanks between, in SI units, without units"#,
            15..31,
        ),
        (
            r#"xyz="0 0 1""#,
            r#"xyz="0 0 1 0""#,
            r#"line 13: `xyz="0 0 1 0"` in `<axis>` of joint `joint-1` is not 3 numbers: write them with blanks between, in SI units, without units"#,
            11..24,
        ),
        (
            r#"value="2""#,
            r#"value="2kg""#,
            r#"line 6: `value="2kg"` in `<mass>` of link `fore` is no number: write it in SI units, without a unit"#,
            13..24,
        ),
        (
            r#"lower="-1""#,
            r#"lower="-60 deg""#,
            r#"line 14: `lower="-60 deg"` in `<limit>` of joint `joint-1` is no number: write it in SI units, without a unit"#,
            12..27,
        ),
    ] {
        let broken = SOUND.replacen(from, to, 1);
        let error = import(&broken, &ImportOptions::default()).expect_err(to);
        assert_eq!(
            error.to_string(),
            format!("the URDF does not parse: {said}")
        );
        let place = error.place(&broken).expect("a place");
        assert_eq!(place.letters, Some(letters), "{to}");
    }
    // What is drawn is no part of the arm.
    let drawn = "<visual><origin xyz=\"0 0 0 1m\"/><geometry><sphere radius=\"1\"/></geometry></visual>\n  </link>\n  <joint";
    let drawn = SOUND.replacen("</link>\n  <joint", drawn, 1);
    assert!(import(&drawn, &ImportOptions::default()).is_ok());
}

/// What parses and is no arm has its place, too.
#[test]
fn mistakes_of_the_tree_have_their_letters() {
    for (from, to, said, place) in [
        (
            r#"<child link="fore"/>"#,
            r#"<child link="for"/>"#,
            "the URDF has no link `for`; write `fore`",
            (12, 12..22),
        ),
        (
            r#"xyz="0 0 1""#,
            r#"xyz="0 0 0""#,
            "joint `joint-1` has an axis without direction: write its `<axis xyz=..>`",
            (13, 11..22),
        ),
        (
            r#"lower="-1""#,
            r#"lower="3""#,
            "joint `joint-1` has its lower limit 3 above its upper limit 1: swap them",
            (14, 12..21),
        ),
        (
            r#"type="revolute""#,
            r#"type="planar""#,
            "joint `joint-1` is planar: write it as two prismatic joints",
            (10, 25..38),
        ),
        (
            r#"value="2""#,
            r#"value="-2""#,
            "link `fore` has a negative `mass`, -2: write zero or more",
            (6, 13..23),
        ),
        (
            r#"xyz="0 0 0.1""#,
            r#"xyz="0 0 nan""#,
            "the inertial of link `fore` is not finite: write a number",
            (5, 7..14),
        ),
    ] {
        let broken = SOUND.replacen(from, to, 1);
        let error = import(&broken, &ImportOptions::default()).expect_err(to);
        assert_eq!(error.to_string(), said);
        let found = error.place(&broken).expect("a place");
        assert_eq!(
            (found.line, found.letters),
            (place.0, Some(place.1)),
            "{to}"
        );
    }
    let of_argument = ImportOptions {
        tip: Some("hand".to_owned()),
        ..ImportOptions::default()
    };
    let error = import(SOUND, &of_argument).expect_err("no such link");
    assert_eq!(error.place(SOUND), None);
}

#[test]
fn entities_that_a_urdf_declares_are_told() {
    let body = SOUND.replace("value=\"2\"", "value=\"&m;\"");
    let with = format!("<!DOCTYPE robot [\n  <!ENTITY m \"2\">\n]>\n{body}");
    let said = import(&with, &ImportOptions::default()).expect_err("refused");
    assert!(
        said.to_string().starts_with("the URDF does not parse: line 2: `<!ENTITY ..>` declares an entity, and URDFs are read without them"),
        "{said}"
    );
}

#[test]
fn entities_in_comments_hide_no_mistake() {
    let comment = "<!-- no <!ENTITY m \"2\"> here -->\n";
    let said =
        |text: &str| import(text, &ImportOptions::default()).map_err(|error| error.to_string());
    let broken = SOUND.replace("value=\"2\"", "value=\"two\"");
    let plain = said(&broken).expect_err("refused");
    assert!(plain.contains("`value=\"two\"`"), "{plain}");
    let below = said(&format!("{comment}{broken}")).expect_err("refused");
    assert!(below.contains("`value=\"two\"`"), "{below}");
    // A declaration behind a comment is one.
    let declared = SOUND.replace("value=\"2\"", "value=\"&m;\"");
    let with = format!("{comment}<!DOCTYPE robot [<!ENTITY m \"2\">]>\n{declared}");
    let told = said(&with).expect_err("refused");
    assert!(told.contains("line 2: `<!ENTITY ..>` declares"), "{told}");
}

#[test]
fn masses_that_the_language_refuses_are_those_of_the_urdf() {
    let with = |from: &str, to: &str| refused(from, to, &ImportOptions::default());
    assert_eq!(
        with(r#"value="2""#, r#"value="-1""#),
        "link `fore` has a negative `mass`, -1: write zero or more"
    );
    assert_eq!(
        with(r#"izz="1""#, r#"izz="-1""#),
        "link `fore` has a negative `izz`, -1: write zero or more"
    );
    assert_eq!(
        with(r#"value="2""#, r#"value="1e300""#),
        "link `fore` has `mass` 1e300, too large or too small to compute with: write zero, or a value between 1e-30 and 1e30"
    );
    let options = ImportOptions {
        inertials: Inertials::None,
        ..ImportOptions::default()
    };
    let without = SOUND.replace(r#"value="2""#, r#"value="-1""#);
    import(&without, &options).expect("inertials are not asked for");
}

#[test]
fn what_is_assumed_changed_or_impossible_is_told() {
    let odd = SOUND.replace(r#"izz="1""#, r#"izz="3""#);
    let imported = import(&odd, &ImportOptions::default()).expect("a warning, no mistake");
    assert_eq!(
        imported.warnings,
        [
            "link `fore` has a physically impossible inertia: about the center of mass each principal moment must be positive and at most \
             the sum of the other two",
            "names that are no words of the language, or there twice, are changed: joint `joint-1` is `joint_1`",
        ]
    );
    let gravity = "// Gravity is taken to be [0, 0, -9.81] m/s^2 in the frame of the base: a URDF does not say it.\n";
    assert!(imported.spec.contains(gravity), "{}", imported.spec);
    let said = ImportOptions {
        gravity: Some([0.0, 0.0, -9.81]),
        ..ImportOptions::default()
    };
    let imported = import(SOUND, &said).expect("a sound URDF");
    assert!(!imported.spec.contains("Gravity"), "{}", imported.spec);
}
