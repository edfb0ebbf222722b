//! Equations for people, against what the book says.

use robot_model_codegen::expr::Style;
use robot_model_codegen::show::{What, document, form};
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
    let text = document(&compiled(&TEXTBOOK.replace("two", "second_link")));
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

fn spec(robot: &str) -> Compiled {
    let path = format!(
        "{}/../tests/specs/pass/{robot}.robot",
        env!("CARGO_MANIFEST_DIR")
    );
    compiled(&std::fs::read_to_string(path).expect("the spec is in the repository"))
}

/// What `TeX` would stumble over: environments and braces that do not close, a second `&` in a line of a display, an end of
/// line at the end of a display, and characters with a meaning of their own.
#[test]
fn documents_are_well_formed() {
    for robot in ["two_link", "slider", "puma560", "every_effect", "phantom"] {
        let text = document(&spec(robot));
        let mut environments: Vec<&str> = Vec::new();
        let mut lines = text.lines().peekable();
        while let Some(line) = lines.next() {
            let mut depth = 0;
            let mut last = ' ';
            for c in line.chars() {
                match c {
                    '{' if last != '\\' => depth += 1,
                    '}' if last != '\\' => depth -= 1,
                    '_' if last != '\\' => assert!(
                        environments.contains(&"align*") || line.contains('$'),
                        "{robot}: {line}"
                    ),
                    '#' | '%' | '~' => panic!("{robot}: {line}"),
                    _ => {}
                }
                last = c;
            }
            if let Some(name) = argument(line, "\\begin{") {
                environments.push(name);
            } else if let Some(name) = argument(line, "\\end{") {
                assert_eq!(environments.pop(), Some(name), "{robot}: {line}");
            } else if environments.last() == Some(&"align*") {
                let own = without_cases(line);
                assert_eq!(own.matches('&').count(), 1, "{robot}: {line}");
                let ends = lines.peek().is_some_and(|next| next.starts_with("\\end"));
                assert_eq!(line.ends_with("\\\\"), !ends, "{robot}: {line}");
            }
            // The group of a small display opens before it and closes behind it.
            let group = i32::from(line.starts_with("{\\footnotesize"));
            let closed = i32::from(line.starts_with("\\end{align*}}"));
            assert_eq!(depth, group - closed, "{robot}: {line}");
        }
        assert!(environments.is_empty(), "{robot}: {environments:?}");
    }
}

/// The line without its choices, which are environments of their own.
fn without_cases(line: &str) -> String {
    let mut outside = String::new();
    let mut depth = 0;
    for part in line.split_inclusive("{cases}") {
        let (own, edge) = match part.strip_suffix("{cases}") {
            Some(rest) if rest.ends_with("\\begin") => (rest, 1),
            Some(rest) => (rest, -1),
            None => (part, 0),
        };
        if depth == 0 {
            outside.push_str(own);
        }
        depth += edge;
    }
    assert_eq!(depth, 0, "{line}");
    outside
}

fn argument<'a>(line: &'a str, command: &str) -> Option<&'a str> {
    line.strip_prefix(command)?.split('}').next()
}

#[test]
fn the_filtered_regressor_of_a_textbook_arm_reads_as_momentum_and_drift() {
    let arm = compiled(TEXTBOOK);
    let text = form(&arm, What::BaseFilteredRegressor, Style::Text);
    assert!(text.contains("Y_p[1,one.izzr] = dq1\n"), "{text}");
    assert!(text.contains("Y_h[1,one.mxr]  = -9.81 cos(q1)\n"), "{text}");
    let kinematics = form(&arm, What::ForwardKinematics, Style::Text);
    assert!(
        kinematics.contains("p2[1]   = 0.5 cos(q1)\n"),
        "{kinematics}"
    );
    let slopes = form(&arm, What::Slopes, Style::Latex);
    assert!(
        slopes.contains("\\partial \\tau_{1} / \\partial \\dot q_{2} &= "),
        "{slopes}"
    );
}

#[test]
fn what_has_no_filtered_form_is_told() {
    let arm = compiled(
        &(TEXTBOOK.replace(
            "convention",
            "effects { load_dependent_friction on two; } convention",
        )),
    );
    let text = form(&arm, What::FilteredRegressor, Style::Text);
    let told =
        "no filtered form: two.load_dependent_friction.mu, as its torque depends on the load";
    assert!(text.contains(told), "{text}");
}

/// Each line uses the one before it twice: written out, the last one would be 2^40 long.
fn nested(first: &str) -> String {
    let lines = (1..=40).map(|k| format!("let n{k} = sin(n{p}) + cos(n{p});\n", p = k - 1));
    format!("let n0 = {first};\n{}", lines.collect::<String>())
}

#[test]
fn what_is_used_twice_is_written_once() {
    let effect = format!(
        "effect nest(j) {{
            /// Torque, N m.
            linear k;
            {}
            torque(j) = k * n40;
        }}
        {}",
        nested("q(j)"),
        TEXTBOOK.trim_end_matches('}').to_owned() + "effects { nest on two; } }"
    );
    let point = format!(
        "robot Arm {{
            coordinates th;
            parameters J: kg*m^2;
            constants a = 1 m;
            {}
            kinetic = J/2*dot(th)^2;
            potential = 0;
            point tip = [a*n40, 0, 0];
        }}",
        nested("th")
    );
    for (spec, what) in [
        (&effect, What::InverseDynamics),
        (&effect, What::BaseRegressor),
        (&effect, What::Slopes),
        (&point, What::ForwardKinematics),
        (&point, What::Jacobian),
    ] {
        for style in [Style::Text, Style::Latex] {
            let text = form(&compiled(spec), what, style);
            assert!(text.len() < 60_000, "{what:?}: {} characters", text.len());
        }
    }
}

/// Parameters and rates may stand in a position where they cancel.
#[test]
fn positions_are_free_of_what_cancels() {
    let arm = compiled(
        "robot Arm {
            coordinates x: m;
            parameters m: kg;
            let moment = m*x;
            kinetic = m/2*dot(x)^2;
            potential = 0;
            point tip = [moment/m, 0*dot(x)*2, 0];
        }",
    );
    let text = form(&arm, What::ForwardKinematics, Style::Text);
    assert_eq!(text, "tip[1] = x\nzero   tip[2] tip[3]\n");
}
