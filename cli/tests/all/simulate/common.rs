//! Plants of specs.

use robot_model::simulate::{
    Controller, Desired, Instant, Integrator, Measured, Tolerances, Trajectory,
};
use robot_model_cli::interpreted::InterpretedPlant;
use robot_model_codegen::base::shape_values;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::parameter::Status;

/// A spec of the crate `tests`, without its effects where that is wanted.
pub fn spec(name: &str, with_effects: bool) -> Compiled {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/specs/pass");
    let text = std::fs::read_to_string(format!("{root}/{name}.robot")).expect("in the repository");
    let text = match text.find("    effects {") {
        Some(start) if !with_effects => {
            let end = start + text[start..].find('}').expect("a block ends") + 1;
            format!("{}{}", &text[..start], &text[end..])
        }
        _ => text,
    };
    compiled(&text)
}

/// A double pendulum.
pub fn pendulum(effects: &str) -> Compiled {
    pendulum_with("", effects)
}

/// A double pendulum with effects of its own.
pub fn pendulum_with(definitions: &str, effects: &str) -> Compiled {
    compiled(&format!(
        "{definitions}
        robot Pendulum {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint upper: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint lower: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            link upper {{ mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }}
            link lower {{ mass = 1; com = [-0.2, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }}
            effects {{ {effects} }}
        }}"
    ))
}

pub fn compiled(text: &str) -> Compiled {
    let model =
        robot_model_spec::load("test.robot", text).unwrap_or_else(|errors| panic!("{errors}"));
    compile_model(&model)
}

/// With the spec's values; `more` has those that it leaves open, by the ends of their names.
pub fn plant(compiled: Compiled, more: &[(&str, f64)]) -> InterpretedPlant {
    let value = |name: &str, status: Status| {
        let given = more.iter().find(|(end, _)| name.ends_with(end));
        match (given, status) {
            (Some(&(_, value)), _) | (None, Status::Nominal(value) | Status::Fixed(value)) => value,
            (None, Status::Unknown) => panic!("a value for {name}"),
        }
    };
    let standard = compiled.standard.iter();
    let standard: Vec<f64> = standard.map(|p| value(&p.name, p.status)).collect();
    let beta = compiled.base.beta(&standard);
    let mut shapes = shape_values(&compiled.model);
    for (shape, name) in shapes.iter_mut().zip(compiled.shape_names()) {
        if let Some((_, value)) = more.iter().find(|(end, _)| name.ends_with(end)) {
            *shape = *value;
        }
    }
    InterpretedPlant::new(compiled, &beta, &shapes).expect("sound")
}

pub fn released(plant: InterpretedPlant, q: &[f64], dq: &[f64]) -> Integrator<InterpretedPlant> {
    Integrator::new(plant, q, dq, Tolerances::default()).expect("sound")
}

/// At rest with motors and a link at a position.
pub fn resting<'a>(q: &'a [f64], dq: &'a [f64]) -> Instant<'a> {
    Instant {
        time: 0.0,
        q,
        dq,
        ddq: dq,
        memory: &[],
        switches: &[],
        torque: dq,
        inputs: &[],
    }
}

/// A controller of one line.
pub struct Law<F>(pub F);

impl<F: FnMut(&Measured<'_>) -> f64> Controller for Law<F> {
    fn torque(&mut self, measured: &Measured<'_>, _: &Desired, torque: &mut [f64]) {
        torque[0] = (self.0)(measured);
    }
}

/// Staying where the joint is.
pub fn still(q: &[f64]) -> Trajectory {
    let time = vec![0.0, 1.0, 2.0, 3.0];
    let q = q.iter().map(|&q| vec![q; 4]).collect();
    Trajectory::new(time, q, vec![], vec![], vec![]).expect("sound")
}
