//! What holds for every expression and every chain, tried on ones that nobody wrote. Seeds are fixed.

use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use robot_model_codegen::expr::{Dag, ExprId, Function, Symbol};
use robot_model_codegen::interpreter::Program;
use robot_model_spec::model::Function as SpecFunction;
use robot_model_tests::base_map::largest_difference;
use robot_model_tests::evaluate::Interpreter;
use robot_model_tests::states::{self, State};
use robot_model_tests::twin::jet::{E1, Jet};

fn config(cases: u32) -> Config {
    Config {
        cases,
        rng_seed: RngSeed::Fixed(2026),
        failure_persistence: None,
        ..Config::default()
    }
}

/// An expression that is smooth where it is evaluated, and stays of moderate size.
#[derive(Debug, Clone)]
enum Tree {
    Number(f64),
    Symbol(usize),
    Add(Box<Tree>, Box<Tree>),
    Mul(Box<Tree>, Box<Tree>),
    Sin(Box<Tree>),
    Cos(Box<Tree>),
    Tanh(Box<Tree>),
    Abs(Box<Tree>),
    /// `sqrt(1 + x^2)`
    Length(Box<Tree>),
    /// `1 / (2 + cos x)`
    Share(Box<Tree>),
    /// Whole power of a sine: of any expression they grow beyond all numbers.
    Power(Box<Tree>, i32),
    /// `if c > 0 { x } else { y }`
    Select(Box<Tree>, Box<Tree>, Box<Tree>),
}

const SYMBOLS: [Symbol; 4] = [Symbol::Q(0), Symbol::Q(1), Symbol::Dq(0), Symbol::Ddq(1)];

fn tree() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        // Among them the numbers that rules look for.
        prop::sample::select(vec![-1.0, 0.0, 0.5, 1.0, 2.0]).prop_map(Tree::Number),
        (-3.0..3.0).prop_map(Tree::Number),
        (0..SYMBOLS.len()).prop_map(Tree::Symbol),
        (0..SYMBOLS.len()).prop_map(Tree::Symbol),
    ];
    leaf.prop_recursive(6, 60, 3, |inner| {
        let one = || inner.clone().prop_map(Box::new);
        prop_oneof![
            (one(), one()).prop_map(|(x, y)| Tree::Add(x, y)),
            (one(), one()).prop_map(|(x, y)| Tree::Mul(x, y)),
            one().prop_map(Tree::Sin),
            one().prop_map(Tree::Cos),
            one().prop_map(Tree::Tanh),
            one().prop_map(Tree::Abs),
            one().prop_map(Tree::Length),
            one().prop_map(Tree::Share),
            (one(), 2..5).prop_map(|(x, k)| Tree::Power(x, k)),
            (one(), one(), one()).prop_map(|(c, x, y)| Tree::Select(c, x, y)),
        ]
    })
}

impl Tree {
    fn build(&self, dag: &mut Dag) -> ExprId {
        match self {
            Self::Number(value) => dag.constant(*value),
            Self::Symbol(k) => dag.symbol(SYMBOLS[*k]),
            Self::Add(x, y) => {
                let (x, y) = (x.build(dag), y.build(dag));
                dag.add(x, y)
            }
            Self::Mul(x, y) => {
                let (x, y) = (x.build(dag), y.build(dag));
                dag.mul(x, y)
            }
            Self::Sin(x) => call(dag, Function::Sin, x),
            Self::Cos(x) => call(dag, Function::Cos, x),
            Self::Tanh(x) => call(dag, Function::Tanh, x),
            Self::Abs(x) => call(dag, Function::Abs, x),
            Self::Length(x) => {
                let x = x.build(dag);
                let square = dag.mul(x, x);
                let one = dag.constant(1.0);
                let sum = dag.add(one, square);
                dag.call(Function::Sqrt, sum)
            }
            Self::Share(x) => {
                let cos = call(dag, Function::Cos, x);
                let two = dag.constant(2.0);
                let sum = dag.add(two, cos);
                dag.call(Function::Recip, sum)
            }
            Self::Power(x, k) => {
                let sin = call(dag, Function::Sin, x);
                let exponent = dag.constant(f64::from(*k));
                dag.power(sin, exponent)
            }
            Self::Select(c, x, y) => {
                let (c, x, y) = (c.build(dag), x.build(dag), y.build(dag));
                dag.select(c, x, y)
            }
        }
    }

    /// The value with its slope along the first symbol, by rules that share nothing with the compiler's.
    fn jet(&self, values: &[f64; 4]) -> Jet {
        let number = Jet::number;
        match self {
            Self::Number(value) => number(*value),
            Self::Symbol(0) => number(values[0]).plus(E1, 1.0),
            Self::Symbol(k) => number(values[*k]),
            Self::Add(x, y) => x.jet(values) + y.jet(values),
            Self::Mul(x, y) => x.jet(values) * y.jet(values),
            Self::Sin(x) => x.jet(values).call(SpecFunction::Sin),
            Self::Cos(x) => x.jet(values).call(SpecFunction::Cos),
            Self::Tanh(x) => x.jet(values).call(SpecFunction::Tanh),
            Self::Abs(x) => x.jet(values).call(SpecFunction::Abs),
            Self::Length(x) => {
                let x = x.jet(values);
                (number(1.0) + x * x).power(0.5)
            }
            Self::Share(x) => (number(2.0) + x.jet(values).call(SpecFunction::Cos)).power(-1.0),
            Self::Power(x, k) => {
                let sin = x.jet(values).call(SpecFunction::Sin);
                (0..*k).fold(number(1.0), |power, _| power * sin)
            }
            Self::Select(c, x, y) => {
                let side = if c.jet(values).0[0] > 0.0 { x } else { y };
                side.jet(values)
            }
        }
    }

    /// Whether a choice or a kink is so near that rounding decides.
    fn is_on_an_edge(&self, values: &[f64; 4]) -> bool {
        let near = |x: &Self| x.jet(values).0[0].abs() < 1e-9;
        match self {
            Self::Number(_) | Self::Symbol(_) => false,
            Self::Add(x, y) | Self::Mul(x, y) => x.is_on_an_edge(values) || y.is_on_an_edge(values),
            Self::Abs(x) => near(x) || x.is_on_an_edge(values),
            Self::Sin(x)
            | Self::Cos(x)
            | Self::Tanh(x)
            | Self::Length(x)
            | Self::Share(x)
            | Self::Power(x, _) => x.is_on_an_edge(values),
            Self::Select(c, x, y) => {
                near(c) || [c, x, y].iter().any(|part| part.is_on_an_edge(values))
            }
        }
    }
}

fn call(dag: &mut Dag, function: Function, x: &Tree) -> ExprId {
    let x = x.build(dag);
    dag.call(function, x)
}

fn values() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(-2.0..2.0)
}

fn bind(values: &[f64; 4]) -> impl Fn(Symbol) -> f64 {
    move |symbol| {
        let place = SYMBOLS.iter().position(|known| *known == symbol);
        values[place.expect("only these are built")]
    }
}

/// Relative to the larger of the number and 1; products of sixty factors below ten grow, and so does their rounding.
fn close(found: f64, wanted: f64) -> bool {
    (found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0)
}

proptest! {
    #![proptest_config(config(2000))]

    /// The rules of the dag keep the value, and the schedule of the interpreter is that of direct evaluation.
    #[test]
    fn interpreter_dag_and_tree_have_one_value(tree in tree(), values in values()) {
        prop_assume!(!tree.is_on_an_edge(&values));
        let mut dag = Dag::new();
        let root = tree.build(&mut dag);
        let direct = dag.evaluate(root, &bind(&values));
        let interpreted = Program::new(&dag, &[root]).eval(&bind(&values))[0];
        let wanted = tree.jet(&values).0[0];
        prop_assume!(wanted.abs() < 1e9);
        prop_assert!(close(direct, wanted), "dag {direct}, tree {wanted}");
        prop_assert!(close(interpreted, direct), "interpreter {interpreted}, dag {direct}");
    }

    /// Symbolic derivatives are those of dual numbers.
    #[test]
    fn symbolic_derivatives_are_those_of_dual_numbers(tree in tree(), values in values()) {
        prop_assume!(!tree.is_on_an_edge(&values));
        let mut dag = Dag::new();
        let root = tree.build(&mut dag);
        let slope = dag.derivative(root, SYMBOLS[0]);
        let found = dag.evaluate(slope, &bind(&values));
        let wanted = tree.jet(&values).0[E1];
        prop_assume!(wanted.abs() < 1e9);
        prop_assert!(close(found, wanted), "symbolic {found}, dual {wanted}");
    }
}

/// A joint of a chain in standard DH: special and general lengths and angles.
fn joint() -> impl Strategy<Value = (bool, f64, i32, f64)> {
    let length = || prop_oneof![Just(0.0), Just(0.3), 0.1..0.8];
    (
        prop::bool::weighted(0.8),
        length(),
        prop::sample::select(vec![-90, 0, 90, 35]),
        length(),
    )
}

/// Effects of the last joint, of which some are one law with others.
const EFFECTS: [&str; 6] = [
    "viscous_friction",
    "coulomb_friction",
    "stribeck(vs = 0.02)",
    "motor_inertia",
    "asymmetric_coulomb",
    "asymmetric_viscous",
];

proptest! {
    #![proptest_config(config(150))]

    /// As many base parameters as the stacked regressor has rank, and `Y_b * beta = Y * standard` for each parameter by
    /// itself, for arms from tenths of millimeters to tens of meters.
    #[test]
    fn base_parameters_are_the_rank_of_the_regressor(
        joints in prop::collection::vec(joint(), 1..5),
        size in -4.0..2.0,
        effects in prop::sample::subsequence(EFFECTS.to_vec(), 0..5),
    ) {
        let unit = 10f64.powf(size);
        let joints: Vec<String> = joints
            .iter()
            .enumerate()
            .map(|(k, (revolute, a, alpha, other))| {
                let length = |value: f64| format!("{} m", value * unit);
                let (kind, key, other) = if *revolute {
                    ("revolute", "d", length(*other))
                } else {
                    ("prismatic", "theta", format!("{other} rad"))
                };
                let a = length(*a);
                format!("joint j{k}: {kind} {{ a = {a}; alpha = {alpha} deg; {key} = {other}; }}")
            })
            .collect();
        let last = joints.len() - 1;
        let declared: Vec<String> = effects.iter().map(|effect| format!("{effect} on j{last};")).collect();
        let text = format!(
            "robot Random {{ gravity = [0, 0, -9.81]; convention = standard_dh; {} effects {{ {} }} }}",
            joints.join(" "),
            declared.join(" "),
        );
        let model = robot_model_spec::load("random.robot", &text).expect("a spec");
        let interpreter = Interpreter::new(robot_model_codegen::compile_model(&model));
        let mut random = states::generator(9);
        let mut samples: Vec<State> = (0..60)
            .map(|_| states::state(&mut random, joints.len()))
            .collect();
        // Dry friction that differs between directions is told from an offset at rest.
        for (k, state) in samples.iter_mut().enumerate() {
            let rests = k % (2 * joints.len());
            if let Some(speed) = state.dq.get_mut(rests) {
                *speed = 0.0;
            }
        }
        let (difference, name) = largest_difference(&interpreter, &samples);
        prop_assert!(difference <= 1e-9, "{text}: {name} {difference:.1e}");

        prop_assume!(interpreter.compiled.base.rank.is_clear());
        let zero = vec![0.0; interpreter.compiled.standard.len()];
        let mut rows = Vec::new();
        for state in &samples {
            let forms = interpreter.forms(&zero, state);
            rows.extend(forms.regressor.row_iter().map(nalgebra::Matrix::into_owned));
        }
        let mut stacked = nalgebra::DMatrix::from_rows(&rows);
        // Rounding, as was seen above.
        for &k in &interpreter.compiled.base.unidentifiable {
            stacked.column_mut(k).fill(0.0);
        }
        // Each parameter has a unit of its own, and each joint's torque and each motion a size.
        for _ in 0..3 {
            for mut row in stacked.row_iter_mut() {
                row /= row.amax().max(f64::MIN_POSITIVE);
            }
            for mut column in stacked.column_iter_mut() {
                column /= column.amax().max(f64::MIN_POSITIVE);
            }
        }
        let singular = stacked.singular_values();
        // Rounding is below, what a clear decision keeps is above.
        let rank = singular.iter().filter(|value| **value > 1e-9 * singular.max()).count();
        prop_assert_eq!(rank, interpreter.compiled.base.kept.len(), "{}", text);
    }

    /// Lumps keep the torque of every parameter, whatever the units of parameters and lengths make of its coefficient.
    #[test]
    fn lumps_keep_the_torque_of_each_parameter(
        exponents in prop::collection::vec(-14.0..14.0, 5),
        shares in prop::collection::vec(0.2..3.0, 3),
    ) {
        let [l, i, c, d, e] = std::array::from_fn(|k| format!("{:e}", 10f64.powf(exponents[k])));
        let text = format!(
            "robot Random {{
                coordinates th, x: m;
                parameters m, J, E, k, b;
                constants L = {l}, I = {i}, c = {c}, d = {d}, e = {e}, g = 9.81, one = 1;
                let px = x + L*sin(th);
                let pz = -L*cos(th);
                kinetic = m/2*(dot(px)^2 + dot(pz)^2) + {s0}*J/2*dot(th)^2 + c*J*dot(th)*dot(x) + b/2*dot(x)^2;
                potential = m*g*pz + 3*E*I/2*x^2 + {s1}*k/2*x^2 + d*E*x^4 + e*k*{s2}*x^4 + one*b*cos(2*th + 0.3);
            }}",
            s0 = shares[0],
            s1 = shares[1],
            s2 = shares[2],
        );
        let model = robot_model_spec::load("random.robot", &text).expect("a spec");
        let interpreter = Interpreter::new(robot_model_codegen::compile_model(&model));
        prop_assert!(interpreter.compiled.base.rank.is_clear(), "{}", interpreter.compiled.base.rank);
        prop_assert!(interpreter.compiled.base.unidentifiable.is_empty(), "{}", text);
        let mut random = states::generator(5);
        let samples: Vec<State> = (0..20).map(|_| states::state(&mut random, 2)).collect();
        let (difference, name) = largest_difference(&interpreter, &samples);
        prop_assert!(difference <= 1e-10, "{text}: {name} {difference:.1e}");
    }
}
