//! Equations for people, against what the book says.

use robot_model_codegen::expr::Style;
use robot_model_codegen::show::{What, form, whole};
use robot_model_codegen::{Compiled, compile_model};

fn compiled(text: &str) -> Compiled {
    let model =
        robot_model_spec::load("arm.robot", text).unwrap_or_else(|errors| panic!("{errors}"));
    compile_model(&model)
}

/// A vertical 2R arm in modified DH: the textbook's form, links of length 0.5 and whatever.
const TEXTBOOK: &str = "robot Arm {
    gravity = [0, -9.81, 0];
    convention = modified_dh;
    joint one: revolute { a = 0; alpha = 0; d = 0; }
    joint two: revolute { a = 0.5; alpha = 0; d = 0; }
}";

#[test]
fn the_textbook_arm_reads_as_in_the_textbook() {
    let arm = compiled(TEXTBOOK);
    let mass_matrix = form(&arm, What::MassMatrix, Style::Text);
    assert_eq!(
        mass_matrix,
        "M[1,1] = one.izzr + two.izz + two.mx cos(q2) - two.my sin(q2)\n\
         M[1,2] = two.izz + 0.5 two.mx cos(q2) - 0.5 two.my sin(q2)    (= M[2,1])\n\
         M[2,2] = two.izz\n"
    );
    let coriolis = form(&arm, What::CoriolisMatrix, Style::Text);
    assert!(
        coriolis.contains("C[2,1] = 0.5 two.mx sin(q2) dq1 + 0.5 two.my cos(q2) dq1\n"),
        "{coriolis}"
    );
    assert!(coriolis.ends_with("zero   C[2,2]\n"), "{coriolis}");
    let base = form(&arm, What::BaseParameters, Style::Text);
    assert!(base.contains("one.izzr = one.izz + 0.25 two.m\n"), "{base}");
    assert!(base.contains("one.mxr  = one.mx + 0.5 two.m\n"), "{base}");
    assert!(base.contains("\ntwo.my\n"), "{base}");
    let gravity = form(&arm, What::Gravity, Style::Text);
    assert!(
        gravity.ends_with("G[2] = 9.81 two.mx cos(q1 + q2) - 9.81 two.my sin(q1 + q2)\n"),
        "{gravity}"
    );
}

#[test]
fn latex_has_no_bare_underscores_in_names() {
    let text = whole(
        &compiled(&TEXTBOOK.replace("two", "second_link")),
        Style::Latex,
    );
    assert!(
        text.contains("\\mathrm{second\\_link.mx}") && text.contains("\\ddot q_{2}"),
        "{text}"
    );
}

#[test]
fn large_arms_name_intermediate_results() {
    let path = format!(
        "{}/../tests/specs/pass/puma560.robot",
        env!("CARGO_MANIFEST_DIR")
    );
    let arm = compiled(&std::fs::read_to_string(path).expect("the spec is in the repository"));
    let text = form(&arm, What::MassMatrix, Style::Text);
    for what in [
        What::MassMatrix,
        What::CoriolisMatrix,
        What::InverseDynamics,
    ] {
        for line in form(&arm, what, Style::Text).lines() {
            assert!(line.len() <= 130, "{line}");
        }
    }
    assert!(
        text.contains("\nt0 = ") && text.contains("M[6,6] = "),
        "{text}"
    );
}
