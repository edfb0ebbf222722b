//! Equations of effects in text are the language: read again, they are the definitions that they were written from.

use std::fmt::Write as _;

use robot_model_codegen::expr::Style;
use robot_model_codegen::show::{Equation, effect_equations};
use robot_model_spec::model::EffectDefinition;
use robot_model_spec::{load, standard_effects};

/// The names of a definition with its equations as they are shown.
fn written(definition: &EffectDefinition) -> String {
    let mut text = format!("effect shown({}) {{\n", definition.joints.join(", "));
    for parameter in &definition.linear {
        writeln!(text, "linear {};", parameter.name).expect("a string takes all");
    }
    for shape in &definition.shapes {
        writeln!(text, "shape {} in 1 .. 2;", shape.name).expect("a string takes all");
    }
    for input in &definition.inputs {
        let joint = input
            .joint
            .map(|joint| format!("({})", definition.joints[joint]));
        writeln!(text, "input {}{};", input.name, joint.unwrap_or_default())
            .expect("a string takes all");
    }
    for state in &definition.states {
        writeln!(text, "state {};", state.name).expect("a string takes all");
    }
    for Equation { left, right, .. } in effect_equations(definition, Style::Text) {
        let is_binding = definition
            .bindings
            .iter()
            .any(|binding| binding.name == left);
        let is_let = is_binding && !left.starts_with("dot(");
        let word = if is_let { "let " } else { "" };
        writeln!(text, "{word}{left} = {right};").expect("a string takes all");
    }
    text + "}\n"
}

/// The definition in a text, declared on an arm of two joints.
fn read(effect: &str, joints: usize, shapes: &[&str]) -> EffectDefinition {
    let on = ["", "on one", "on (one, two)"][joints];
    let shapes: Vec<String> = shapes.iter().map(|name| format!("{name} = 1")).collect();
    let shapes = match shapes.len() {
        0 => String::new(),
        _ => format!("({})", shapes.join(", ")),
    };
    let robot = format!(
        "robot Arm {{ gravity = [0, -9.81, 0]; convention = standard_dh;
            joint one: revolute {{ a = 1; alpha = 0; d = 0; }}
            joint two: revolute {{ a = 1; alpha = 0; d = 0; }}
            effects {{ shown{shapes} {on}; }}
        }}"
    );
    let model = load("shown", &format!("{effect}{robot}"))
        .unwrap_or_else(|errors| panic!("{effect}\n{errors}"));
    model.effects[0].definition.as_ref().clone()
}

#[test]
fn text_is_read_again_as_what_it_was() {
    for definition in standard_effects() {
        let text = written(definition);
        let shapes: Vec<&str> = definition
            .shapes
            .iter()
            .map(|shape| shape.name.as_str())
            .collect();
        let read = read(&text, definition.joints.len(), &shapes);
        assert_eq!(read.torques, definition.torques, "{text}");
        assert_eq!(read.acts, definition.acts, "{text}");
        assert_eq!(read.bindings, definition.bindings, "{text}");
    }
}

/// What stands in parentheses for a reason keeps them, in both notations.
#[test]
fn parentheses_stay_where_they_count() {
    let text = "effect shown(j) {
        linear a, b;
        shape s in 1 .. 2;
        torque(j) = a * (q(j) - (dq(j) - s)) + b / (s * (2 / s)) - (a - b) * (-s)^2;
    }";
    let definition = read(text, 1, &[]);
    let shown = |style| effect_equations(&definition, style)[0].right.clone();
    assert_eq!(
        shown(Style::Text),
        "a * (q(j) - (dq(j) - s)) + b / (s * (2 / s)) - (a - b) * (-s)^2"
    );
    let latex = shown(Style::Latex);
    assert!(
        latex.contains("\\left(\\dot q_j - s\\right)")
            && latex.contains("\\frac{b}{s \\thinspace \\frac{2}{s}}")
            && latex.contains("\\left(-s\\right)^{2}"),
        "{latex}"
    );
}
