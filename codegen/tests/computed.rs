//! What is computed is what is shown: two derivations of the same equations, for every spec that compiles.

use robot_model_codegen::expr::{ExprId, Symbol};
use robot_model_codegen::{Compiled, compile_model};

fn compiled() -> Vec<(String, Compiled)> {
    let folder = format!("{}/../tests/specs/pass", env!("CARGO_MANIFEST_DIR"));
    let files = std::fs::read_dir(folder).expect("the specs are in the repository");
    let mut paths: Vec<_> = files
        .map(|file| file.expect("a readable folder").path())
        .collect();
    paths.sort();
    let compile = |path: std::path::PathBuf| {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(&path).expect("a readable spec");
        let model = robot_model_spec::load(&name, &text).unwrap_or_else(|e| panic!("{e}"));
        (name, compile_model(&model))
    };
    paths.into_iter().map(compile).collect()
}

/// A state without special values.
fn value(symbol: Symbol) -> f64 {
    match symbol {
        Symbol::Q(k) => 0.3 + (1.7 * k as f64).sin(),
        Symbol::Dq(k) => 0.9 * (1.1 + 2.3 * k as f64).sin(),
        Symbol::Ddq(k) => 1.9 * (0.4 + 3.1 * k as f64).cos(),
        Symbol::Parameter(k) => 0.6 + 0.5 * (0.7 * k as f64).sin(),
        Symbol::Time => 0.7,
        Symbol::Shape(k) => 0.2 + 0.05 * k as f64,
        Symbol::RigidTorque(k) => 1.3 - 0.4 * k as f64,
        Symbol::MeasuredTorque(_) | Symbol::Input(_) | Symbol::State(_) => 0.3,
    }
}

/// Relative to the largest of the form: sums of hundreds of terms in another order.
const TOLERANCE: f64 = 1e-12;

fn assert_equal(robot: &str, form: &str, model: &Compiled, computed: &[ExprId], shown: &[ExprId]) {
    let of = |outputs: &[ExprId]| -> Vec<f64> {
        let values = outputs.iter().map(|&x| model.dag.evaluate(x, &value));
        values.collect()
    };
    let (computed, shown) = (of(computed), of(shown));
    let size = shown.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    assert_eq!(computed.len(), shown.len(), "{robot} {form}");
    for (k, (x, y)) in computed.iter().zip(&shown).enumerate() {
        assert!(
            (x - y).abs() <= TOLERANCE * size,
            "{robot} {form} {k}: {x} {y}"
        );
    }
}

#[test]
fn what_is_computed_is_what_is_shown() {
    for (robot, model) in compiled() {
        let (computed, shown) = (&model.computed, &model.dynamics);
        for (form, computed, shown) in [
            (
                "torque",
                &computed.inverse_dynamics,
                &shown.inverse_dynamics,
            ),
            ("rigid torque", &computed.rigid_torque, &shown.rigid_torque),
            ("bias", &computed.bias, &shown.bias),
            ("gravity", &computed.gravity, &shown.gravity),
            (
                "M",
                &computed.mass_matrix.concat(),
                &shown.mass_matrix.concat(),
            ),
            (
                "C",
                &computed.coriolis_matrix.concat(),
                &shown.coriolis_matrix.concat(),
            ),
            (
                "Y",
                &model.computed_linear.regressor.concat(),
                &model.linear.regressor.concat(),
            ),
            (
                "Y'",
                &model.computed_candidates.regressor.concat(),
                &model.candidates.regressor.concat(),
            ),
        ] {
            assert_equal(&robot, form, &model, computed, shown);
        }
    }
}

/// Entries that are zero for every state stay so: no program computes them.
#[test]
fn columns_that_are_zero_are_not_computed() {
    for (robot, model) in compiled() {
        let computed = model.computed_linear.regressor.concat();
        for (&computed, &shown) in computed.iter().zip(&model.linear.regressor.concat()) {
            assert!(
                !model.dag.is_zero(shown) || model.dag.is_zero(computed),
                "{robot}"
            );
        }
    }
}
