//! What is computed is what is shown: two derivations of the same equations, for every spec that compiles.

use robot_model_codegen::expr::{Dag, ExprId, Node, Symbol};
use robot_model_codegen::optimize::optimize;
use robot_model_codegen::{Compiled, compile_for_rows, compile_model};

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
        Symbol::MeasuredTorque(_)
        | Symbol::Input(_)
        | Symbol::State(_)
        | Symbol::Switch(_)
        | Symbol::Weight(_) => 0.3,
    }
}

/// Relative to the largest of the form: sums of hundreds of terms in another order.
const TOLERANCE: f64 = 1e-12;

fn assert_equal(robot: &str, form: &str, model: &Compiled, computed: &[ExprId], shown: &[ExprId]) {
    assert_near(
        robot,
        form,
        &at_state(model, computed),
        &at_state(model, shown),
    );
}

fn at_state(model: &Compiled, outputs: &[ExprId]) -> Vec<f64> {
    let values = outputs.iter().map(|&x| model.dag.evaluate(x, &value));
    values.collect()
}

fn assert_near(robot: &str, form: &str, computed: &[f64], shown: &[f64]) {
    let size = shown.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    assert_eq!(computed.len(), shown.len(), "{robot} {form}");
    for (k, (x, y)) in computed.iter().zip(shown).enumerate() {
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

/// What is not sought for rows has the same values, and their columns are as cheap.
#[test]
fn what_is_compiled_for_rows_is_the_same_arm() {
    for (robot, all) in compiled() {
        let rows = compile_for_rows(&all.model);
        assert_eq!(rows.base.names, all.base.names, "{robot}");
        let columns = |model: &Compiled| -> Vec<ExprId> {
            let kept = model.base.kept.iter();
            let columns = kept.flat_map(|&k| model.computed_candidates.column(&model.dag, k));
            columns.map(|(_, entry)| entry).collect()
        };
        let operations = |model: &Compiled| optimize(&model.dag, &columns(model)).cost();
        assert_eq!(operations(&rows), operations(&all), "{robot}");
        let of = |model: &Compiled| {
            let computed = &model.computed;
            [
                columns(model),
                computed.rigid_torque.clone(),
                computed.inverse_dynamics.clone(),
                computed.mass_matrix.concat(),
                computed.coriolis_matrix.concat(),
                computed.bias.clone(),
                model.computed_linear.regressor.concat(),
            ]
            .map(|outputs| at_state(model, &outputs))
        };
        for (form, (rows, all)) in of(&rows).iter().zip(of(&all)).enumerate() {
            assert_near(&robot, &form.to_string(), rows, &all);
        }
    }
}

fn compile(text: &str) -> Compiled {
    compile_model(&robot_model_spec::load("arm", text).unwrap_or_else(|e| panic!("{e}")))
}

/// `a` and `d`, m.
const LENGTHS: [[f64; 3]; 2] = [[0.0, 0.3, 0.1], [0.2; 3]];

/// An arm of three joints, slides among them, in both conventions of DH.
fn chain(
    gravity: &str,
    modified: bool,
    kinds: usize,
    alphas: [&str; 3],
    [lengths, offsets]: [[f64; 3]; 2],
) -> String {
    let convention = if modified {
        "modified_dh"
    } else {
        "standard_dh"
    };
    let joint = |k: usize| {
        let [a, d] = [lengths, offsets].map(|numbers| numbers[k]);
        let (kind, last) = if kinds >> k & 1 == 0 {
            ("revolute", format!("d = {d};"))
        } else {
            ("prismatic", "theta = 0;".to_owned())
        };
        let alpha = alphas[k];
        format!("joint j{k}: {kind} {{ a = {a}; alpha = {alpha}; {last} }}\n")
    };
    let joints: String = (0..3).map(joint).collect();
    format!("robot Arm {{ gravity = {gravity}; convention = {convention};\n{joints}}}\n")
}

/// Three of the angles, each choice of them once.
fn choices(angles: [&'static str; 3]) -> impl Iterator<Item = [&'static str; 3]> {
    (0..27).map(move |case| [1, 3, 9].map(|place| angles[case / place % 3]))
}

/// With numbers for the parameters there are more ways to write an arm; all have its values.
#[test]
fn baked_arms_have_the_values_of_the_arm() {
    let mut specs = compiled();
    for alphas in choices(["0", "90 deg", "45 deg"]) {
        for case in 0..2 * 8 {
            let text = chain("[0, 0, -9.81]", case % 2 == 1, case / 2, alphas, LENGTHS);
            let model = compile(&text);
            specs.push((text, model));
        }
    }
    for (robot, model) in specs {
        let beta: Vec<f64> = model
            .base
            .kept
            .iter()
            .map(|&k| value(Symbol::Parameter(k)))
            .collect();
        let parameters = model.parameter_values(&beta);
        let shapes = robot_model_codegen::base::shape_values(&model.model);
        let baked = model.baked(&beta, &shapes).expect("finite numbers");
        let bind = |symbol| match symbol {
            Symbol::Parameter(k) => parameters[k],
            Symbol::Shape(k) => shapes[k],
            other => value(other),
        };
        let forms = |compiled: &Compiled| {
            let computed = &compiled.computed;
            [
                computed.inverse_dynamics.clone(),
                computed.bias.clone(),
                computed.gravity.clone(),
                computed.mass_matrix.concat(),
                computed.coriolis_matrix.concat(),
            ]
            .map(|outputs| -> Vec<f64> {
                let values = outputs.iter().map(|&x| compiled.dag.evaluate(x, &bind));
                values.collect()
            })
        };
        for (form, (found, wanted)) in forms(&baked).into_iter().zip(forms(&model)).enumerate() {
            let size = wanted.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
            for (x, y) in found.iter().zip(&wanted) {
                assert!(
                    (x - y).abs() <= TOLERANCE * size,
                    "{robot} form {form}: {x} {y}"
                );
            }
        }
    }
}

/// In single precision, but for sines and cosines, which are those of doubles rounded.
fn in_singles(dag: &Dag, outputs: &[ExprId], bind: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
    #[expect(clippy::cast_possible_truncation, reason = "what is asked for")]
    let single = |x: f64| x as f32;
    let mut values = vec![0.0_f32; dag.len()];
    for x in dag.reachable(outputs) {
        let of = |x: ExprId| values[x.index()];
        values[x.index()] = match dag.node(x) {
            Node::Constant(value) => single(value.get()),
            Node::Symbol(symbol) => single(bind(symbol)),
            Node::Add(p, q) => of(p) + of(q),
            Node::Mul(p, q) => of(p) * of(q),
            Node::Call(function, p) => single(function.apply(f64::from(of(p)))),
            other => panic!("{other:?} in an arm without effects"),
        };
    }
    let outputs = outputs.iter();
    outputs.map(|x| f64::from(values[x.index()])).collect()
}

/// A mass that is lent to make a first moment vanish is no heavier than the arm, however small the offset between the axes: what
/// it adds to one link and takes from another would cancel, with the arm's digits.
#[test]
fn small_offsets_lose_no_digits_of_a_baked_arm() {
    /// Sums of some hundred terms.
    const ROUNDINGS: f64 = 100.0;
    let offsets = (2..=9).map(|decade| 2.0 * 10f64.powi(-decade));
    for offset in offsets {
        for (modified, alphas, lengths) in [
            (
                true,
                ["0", "0", "0"],
                [[0.0, offset, 0.3], [0.2, 0.25, 0.1]],
            ),
            (
                true,
                ["0", "90 deg", "-90 deg"],
                [[0.0, offset, 0.3], [0.2, 0.25, 0.1]],
            ),
            (
                false,
                ["90 deg", "-90 deg", "0"],
                [[offset, 0.3, offset], [0.2, 0.25, 0.1]],
            ),
        ] {
            let robot = chain("[0.1, 0.2, -9.81]", modified, 0, alphas, lengths);
            let model = compile(&robot);
            for weight in [1e-5, 1e-2, 1.0, 1e3] {
                let standard: Vec<f64> = (0..model.standard.len())
                    .map(|k| weight * value(Symbol::Parameter(k)))
                    .collect();
                let beta = model.base.beta(&standard);
                let baked = model.baked(&beta, &[]).expect("numbers");
                let optimized = optimize(&baked.dag, &baked.computed.inverse_dynamics);
                let singles = in_singles(&optimized.dag, &optimized.outputs, &value);
                let rows = model.candidates.regressor.iter();
                let terms = rows.map(|row| -> Vec<f64> {
                    let columns = model.base.kept.iter().zip(&beta);
                    let terms = columns.map(|(&k, beta)| model.dag.evaluate(row[k], &value) * beta);
                    terms.collect()
                });
                let terms: Vec<Vec<f64>> = terms.collect();
                let sizes = terms.iter().map(|row| row.iter().map(|x| x.abs()).sum());
                let size = sizes.fold(0.0, f64::max);
                for (joint, terms) in terms.iter().enumerate() {
                    let wanted: f64 = terms.iter().sum();
                    let double = optimized.dag.evaluate(optimized.outputs[joint], &value);
                    for (found, rounding) in [
                        (double, f64::EPSILON),
                        (singles[joint], f64::from(f32::EPSILON)),
                    ] {
                        let roundings = (found - wanted).abs() / (rounding * size);
                        assert!(
                            roundings < ROUNDINGS,
                            "{robot} {weight}: {roundings} of {rounding:e}"
                        );
                    }
                }
            }
        }
    }
}

/// Coefficients are no larger than one over an angle between axes, in decades from parallel to what a calibration finds.
#[test]
fn coefficients_grow_with_one_over_an_angle() {
    for decade in 1..=7 {
        let angle = 10f64.powi(-decade);
        let alpha = format!("{angle}");
        let lengths = [[0.3, 0.2, 0.2], [0.1, 0.2, 0.0]];
        let robot = chain("[0, 0, -9.81]", false, 0, [&alpha, "90 deg", "0"], lengths);
        let combinations = compile(&robot).base.combinations.concat();
        let largest = combinations
            .iter()
            .fold(0.0, |size: f64, (_, x)| size.max(x.abs()));
        assert!(largest < 2.0 / angle, "{robot}: {largest}");
    }
}

/// An angle that is nearly none makes columns that are nearly none: strong ones of the link do not regroup into their parameters.
#[test]
fn nearly_parallel_axes_lose_no_digits() {
    for alphas in choices(["1e-7", "0", "90 deg"]) {
        for (gravity, modified, lengths) in [
            ("[9.81, 0, 0]", false, [[0.0, 0.3, 0.0], [0.0, 2e-4, 0.3]]),
            ("[1e-8, 0, -9.81]", true, LENGTHS),
        ] {
            let robot = chain(gravity, modified, 0, alphas, lengths);
            let model = compile(&robot);
            let standard: Vec<f64> = (0..model.standard.len())
                .map(|k| value(Symbol::Parameter(k)))
                .collect();
            let coefficients = model.base.combinations.concat();
            // One over the angle may be among them, which leaves nine digits; one over its square would leave two.
            assert!(
                coefficients.iter().all(|(_, x)| x.abs() < 1e8),
                "{robot}: {coefficients:?}"
            );
            let beta = model.base.beta(&standard);
            let baked = model.baked(&beta, &[]).expect("numbers");
            let computed = &baked.computed;
            // With velocities and accelerations so many times those of `value`.
            let forms = [
                (&computed.inverse_dynamics, 1.0, 1.0),
                (&computed.bias, 1.0, 0.0),
                (&computed.gravity, 0.0, 0.0),
            ];
            for (joint, row) in model.linear.regressor.iter().enumerate() {
                let torques = forms.map(|(outputs, dq, ddq)| {
                    let state = |symbol| match symbol {
                        Symbol::Dq(_) => dq * value(symbol),
                        Symbol::Ddq(_) => ddq * value(symbol),
                        other => value(other),
                    };
                    let terms = row.iter().zip(&standard);
                    let terms: Vec<f64> = terms
                        .map(|(&y, p)| model.dag.evaluate(y, &state) * p)
                        .collect();
                    let size: f64 = terms.iter().map(|x| x.abs()).sum();
                    let found = baked.dag.evaluate(outputs[joint], &state);
                    (found, terms.iter().sum::<f64>(), size)
                });
                // What base parameters leave out of a column is 1e-10 of it.
                let tolerance = 1e-10 * torques[0].2;
                for (found, wanted, _) in torques {
                    assert!(
                        (found - wanted).abs() <= tolerance,
                        "{robot} {joint}: {torques:?}"
                    );
                }
            }
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
