//! URDFs to specs, and numbers back into them.

use robot_model_spec::export::{ExportError, JointNumbers, LinkNumbers, Numbers};
use robot_model_spec::load;
use robot_model_spec::urdf::{ImportError, ImportOptions, import, write_back};

use crate::answer::{Answer, skeleton};

/// What stands in URDFs.
pub(crate) const WORDS: [&str; 56] = [
    "<",
    ">",
    "/>",
    "</",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?xml",
    "?>",
    "&lt;",
    "&#0;",
    "&x;",
    "\"",
    "=",
    "<robot>",
    "<link/>",
    "</link>",
    "</joint>",
    "</robot>",
    "<link name=\"tip\"/>",
    "<inertial/>",
    "<mass value=\"1\"/>",
    "<origin/>",
    "xyz=\"0 0 1\"",
    "rpy=\"0 0 1.5708\"",
    "<axis xyz=\"0 1 0\"/>",
    "<axis/>",
    "<limit/>",
    "<dynamics damping=\"1\" friction=\"2\"/>",
    "<mimic joint=\"lift\" multiplier=\"2\"/>",
    "<parent link=\"base\"/>",
    "<child link=\"tip\"/>",
    "revolute",
    "continuous",
    "prismatic",
    "fixed",
    "floating",
    "planar",
    "spherical",
    "name",
    "type",
    "base",
    "lift",
    "swing",
    "1e999",
    "NaN",
    "inf",
    "-0",
    "1e300",
    "1e-300",
    "0 0",
    "${x}",
    "xacro:macro",
    "version=\"1.2\"",
    "quat_xyzw=\"0 0 0 1\"",
];

/// Sound URDFs: a chain with fixed joints, and a tree with what mimics.
pub(crate) fn seeds() -> Vec<Vec<u8>> {
    let body = |mass: f64| {
        format!(
            "<inertial><origin xyz=\"0 0 0.1\" rpy=\"0 0 1.5708\"/><mass value=\"{mass}\"/>\
             <inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.1\" iyz=\"0\" izz=\"0.1\"/></inertial>"
        )
    };
    let chain = format!(
        "<?xml version=\"1.0\"?>\n<!-- an arm -->\n<robot name=\"arm\">\n  <link name=\"base\"/>\n\
         <link name=\"sledge\">{}</link>\n  <link name=\"pendulum\">{}</link>\n  <link name=\"flange\">{}</link>\n\
         <joint name=\"lift\" type=\"prismatic\"><parent link=\"base\"/><child link=\"sledge\"/><axis xyz=\"0 0 1\"/>\
         <limit lower=\"0\" upper=\"1\" effort=\"100\" velocity=\"1\"/></joint>\n\
         <joint name=\"swing\" type=\"continuous\"><origin xyz=\"0.1 0 0\" rpy=\"1.5708 0 0\"/><parent link=\"sledge\"/>\
         <child link=\"pendulum\"/><axis xyz=\"0 1 0\"/><dynamics damping=\"0.5\" friction=\"0.2\"/></joint>\n\
         <joint name=\"mount\" type=\"fixed\"><origin xyz=\"0 0 -0.3\"/><parent link=\"pendulum\"/><child link=\"flange\"/></joint>\n\
         </robot>\n",
        body(4.0),
        body(1.0),
        body(0.2)
    );
    let finger = "<link name=\"finger\"/><joint name=\"grip\" type=\"prismatic\"><parent link=\"flange\"/><child link=\"finger\"/>\
                  <axis xyz=\"1 0 0\"/><limit lower=\"0\" upper=\"0.1\" velocity=\"1\" effort=\"1\"/></joint>\n\
                  <link name=\"thumb\"><visual><geometry><box size=\"1 1 1\"/></geometry></visual></link>\
                  <joint name=\"follow\" type=\"prismatic\"><parent link=\"flange\"/><child link=\"thumb\"/><axis xyz=\"-1 0 0\"/>\
                  <limit lower=\"0\" upper=\"0.1\" velocity=\"1\" effort=\"1\"/><mimic joint=\"grip\" multiplier=\"-1\" offset=\"0.01\"/></joint>\n";
    let tree = chain.replace("</robot>", &format!("{finger}</robot>"));
    vec![chain.into_bytes(), tree.into_bytes()]
}

/// What comes of a URDF, to its first tip where it has several.
///
/// # Panics
/// Where a spec that was imported is none, where the text with other numbers is no URDF, and where a message names nothing.
pub(crate) fn answer(urdf: &str) -> Answer {
    let mut options = ImportOptions::default();
    let imported = match import(urdf, &options) {
        Err(ImportError::Branches { tips, .. }) => {
            let tip = tips.first().expect("a tree that branches has tips");
            options.tip = Some(tip.clone());
            import(urdf, &options)
        }
        other => other,
    };
    let imported = match imported {
        Err(error) => {
            let message = error.to_string();
            let names_a_place = message.contains('`')
                || message.contains("line ")
                // In a line of the spec that it would become, which is shown.
                || message.contains("--> ")
                // As a whole.
                || message.starts_with("the URDF has no ");
            assert!(
                names_a_place,
                "a message that names no place: {}",
                skeleton(&message)
            );
            return Answer::refused(&message);
        }
        Ok(imported) => imported,
    };
    let Ok(model) = load("imported.robot", &imported.spec) else {
        panic!("a spec that was imported is none");
    };
    let joints = model.joints.len();
    let link = LinkNumbers {
        inertial: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0],
        ..LinkNumbers::default()
    };
    let numbers = Numbers {
        links: vec![link; joints],
        joints: vec![JointNumbers::default(); joints],
        notes: vec!["a note -- with -- dashes".to_owned()],
    };
    let mut remarks: Vec<String> = imported
        .warnings
        .iter()
        .map(|said| skeleton(said))
        .collect();
    match write_back(urdf, &model, &numbers) {
        Ok(written) => {
            let again = import(&written.urdf, &options);
            assert!(
                again.is_ok(),
                "what was written back is not imported: {}",
                skeleton(&again.expect_err("it is refused").to_string())
            );
            remarks.extend(written.notes.iter().map(|said| skeleton(said)));
        }
        // Whoever writes into a text reads it more strictly than whoever takes numbers out of it.
        Err(ExportError::Parse(fault)) => {
            assert!(
                fault.place.is_some(),
                "a message that names no place: {}",
                skeleton(&fault.reason)
            );
            remarks.push(skeleton(&fault.to_string()));
        }
        Err(error) => remarks.push(skeleton(&error.to_string())),
    }
    remarks.sort();
    remarks.dedup();
    Answer::Read {
        size: imported.spec.len().ilog2(),
        parts: u32::try_from(joints).unwrap_or(u32::MAX),
        remarks,
    }
}
