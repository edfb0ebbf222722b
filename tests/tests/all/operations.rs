//! Operation counts of the emitted functions and of arms with their parameters baked in: a snapshot, so that no count grows
//! unseen.

use std::fmt::Write;

use robot_model_codegen::base::shape_values;
use robot_model_codegen::dynamics::Computed;
use robot_model_codegen::emit::rust;
use robot_model_codegen::expr::{Dag, ExprId, Symbol};
use robot_model_codegen::optimize::optimize;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::parameter::Status;
use robot_model_tests::specs;

const ROBOTS: [&str; 3] = ["puma560", "ur10", "panda"];

/// Functions that are counted, in the order of the page.
const FUNCTIONS: [&str; 7] = [
    "mass_matrix",
    "coriolis_matrix",
    "gravity",
    "bias",
    "inverse_dynamics",
    "regressor",
    "base_regressor",
];

/// The rigid body alone, so that counts compare with those of programs that know no effects.
fn bare(robot: &str) -> Compiled {
    let spec = specs::folder("pass")
        .into_iter()
        .find(|spec| spec.name == robot)
        .unwrap_or_else(|| panic!("no spec `{robot}`"));
    let (before, effects) = spec
        .text
        .split_once("effects {")
        .expect("it declares effects");
    let (_, after) = effects.split_once('}').expect("the block ends");
    let text = format!("{before}{after}");
    let model = robot_model_spec::load(robot, &text).unwrap_or_else(|errors| panic!("{errors}"));
    compile_model(&model)
}

/// Base parameters of the inertials in the spec.
fn nominal(compiled: &Compiled) -> Vec<f64> {
    let standard = compiled
        .standard
        .iter()
        .map(|parameter| match parameter.status {
            Status::Fixed(value) | Status::Nominal(value) => value,
            Status::Unknown => panic!("{} has a nominal value", parameter.name),
        });
    compiled.base.beta(&standard.collect::<Vec<f64>>())
}

/// The arm of these.
fn baked(compiled: &Compiled) -> Compiled {
    let shapes = shape_values(&compiled.model);
    let baked = compiled.baked(&nominal(compiled), &shapes);
    baked.expect("the numbers of an arm")
}

/// Each form that numbers make smaller, by the name of its function.
fn forms(computed: &Computed) -> [(&'static str, Vec<ExprId>); 5] {
    [
        ("mass_matrix", computed.mass_matrix.concat()),
        ("coriolis_matrix", computed.coriolis_matrix.concat()),
        ("gravity", computed.gravity.clone()),
        ("bias", computed.bias.clone()),
        ("inverse_dynamics", computed.inverse_dynamics.clone()),
    ]
}

#[test]
fn counts() {
    let mut table = String::new();
    for robot in ROBOTS {
        let compiled = bare(robot);
        let costs = rust::costs(&compiled);
        let mut line = |name: &str, form: &str, cost: rust::Cost| {
            let sum = cost.mul + cost.add;
            writeln!(table, "{robot:8} {name:16} {form:8} {sum:5} = {cost}").expect("a string");
        };
        for (name, cost) in costs.iter().filter(|(name, _)| FUNCTIONS.contains(name)) {
            line(name, "runtime", *cost);
        }
        let baked = baked(&compiled);
        for (name, outputs) in forms(&baked.computed) {
            line(name, "baked", optimize(&baked.dag, &outputs).cost());
        }
    }
    insta::assert_snapshot!(table);
}

/// What is emitted costs what the optimizer says.
#[test]
fn the_page_says_what_the_optimizer_counts() {
    for robot in ROBOTS {
        let compiled = bare(robot);
        let baked = baked(&compiled);
        for compiled in [compiled, baked] {
            let costs = rust::costs(&compiled);
            for (name, outputs) in forms(&compiled.computed) {
                let (_, emitted) = costs.iter().find(|cost| cost.0 == name).expect("emitted");
                let counted = optimize(&compiled.dag, &outputs).cost();
                assert_eq!(*emitted, counted, "{robot} {name}");
            }
        }
    }
}

#[test]
fn baked_equations_have_the_values_of_the_arm() {
    for robot in ROBOTS {
        let compiled = bare(robot);
        let beta = nominal(&compiled);
        let parameters = compiled.parameter_values(&beta);
        let baked = baked(&compiled);
        let bind = |symbol| match symbol {
            Symbol::Q(k) => 0.4 + 1.3 * k as f64,
            Symbol::Dq(k) => 0.9 - 0.7 * k as f64,
            Symbol::Ddq(k) => 2.0 * (k as f64).cos(),
            Symbol::Parameter(k) => parameters[k],
            other => panic!("{other:?}"),
        };
        let values = |dag: &Dag, outputs: &[ExprId]| -> Vec<f64> {
            outputs.iter().map(|&x| dag.evaluate(x, &bind)).collect()
        };
        let (run_time, baked_forms) = (forms(&compiled.computed), forms(&baked.computed));
        for ((name, run_time), (_, outputs)) in run_time.iter().zip(&baked_forms) {
            let expected = values(&compiled.dag, run_time);
            let size = expected.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
            for (x, y) in values(&baked.dag, outputs).iter().zip(&expected) {
                // Thousands of roundings of numbers not larger than a few times the result.
                assert!((x - y).abs() < 1e-12 * size, "{robot} {name}: {x} {y}");
            }
        }
    }
}

/// An arm of right angles with some lengths between them.
fn chain(joints: usize) -> String {
    let mut text = "robot Chain { gravity = [0, 0, -9.81]; convention = modified_dh;\n".to_owned();
    for k in 0..joints {
        let (a, alpha, d) = [
            ("0", "0", "0.2"),
            ("0.1", "-90", "0"),
            ("0.3", "90", "0.15"),
        ][k % 3];
        writeln!(
            text,
            "joint j{k}: revolute {{ a = {a}; alpha = {alpha} deg; d = {d}; }}"
        )
        .expect("a string");
    }
    text + "}\n"
}

/// Recursion pays for each joint once, however many there are.
#[test]
fn inverse_dynamics_grows_with_the_number_of_joints() {
    let counts = [5usize, 10, 20, 40].map(|joints| {
        let model = robot_model_spec::load("chain", &chain(joints)).expect("a sound spec");
        let compiled = compile_model(&model);
        let cost = optimize(&compiled.dag, &compiled.computed.inverse_dynamics).cost();
        (joints as f64, (cost.mul + cost.add) as f64)
    });
    let slopes: Vec<f64> = counts
        .windows(2)
        .map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0))
        .collect();
    for slope in &slopes {
        // The pattern of lengths has a period of three joints, which the first interval does not hold evenly.
        assert!((slope / slopes[0] - 1.0).abs() < 0.05, "{counts:?}");
    }
}
