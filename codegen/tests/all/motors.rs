//! The load of a transmission has no rotor in it, also where the inertia of the rotor is told as one sum with that of the link.

use robot_model_codegen::expr::{Dag, ExprId, Symbol};
use robot_model_codegen::interpreter::Program;
use robot_model_codegen::{Compiled, compile_model};

/// Nominally it has `izz = 2 + 3 * 0.1^2` about its joint, kg m^2.
const LINK: &str = "link a: nominal { mass = 3; com = [0.1, 0, 0]; inertia = [1, 0, 0, 1, 0, 2]; }";

fn pendulum(link: &str, effects: &str) -> Compiled {
    let text = format!(
        "robot R {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint a: revolute {{ a = 0; alpha = 0; d = 0; }}
            {link}
            effects {{ motor_inertia on a; {effects} }}
        }}"
    );
    let model = robot_model_spec::load("r.robot", &text).unwrap_or_else(|e| panic!("{e}"));
    compile_model(&model)
}

const NOMINAL: f64 = 2.0 + 3.0 * 0.01;
const DDQ: f64 = 1.7;

fn at(compiled: &Compiled, beta: &[f64], symbol: Symbol) -> f64 {
    match symbol {
        Symbol::Q(_) => 0.4,
        Symbol::Dq(_) => -0.8,
        Symbol::Ddq(_) => DDQ,
        Symbol::Parameter(k) => compiled.parameter_values(beta)[k],
        other => panic!("{other:?} is not read"),
    }
}

fn value(compiled: &Compiled, beta: &[f64], dag: &Dag, output: ExprId) -> f64 {
    dag.evaluate(output, &|symbol| at(compiled, beta, symbol))
}

fn run(compiled: &Compiled, beta: &[f64], program: &Program) -> f64 {
    program.eval(&|symbol| at(compiled, beta, symbol))[0]
}

/// Base parameters with this sum of inertias; all others are 0.3.
fn beta(compiled: &Compiled, sum: f64) -> Vec<f64> {
    let names = compiled.base.names.iter();
    names
        .map(|name| if name.starts_with("a.izz") { sum } else { 0.3 })
        .collect()
}

#[test]
fn a_load_is_without_what_is_more_than_its_links_have() {
    let arm = pendulum(LINK, "");
    let motor = arm.motor_torque().expect("the rotor is in the sum");
    for (sum, rotor) in [(NOMINAL + 1.5, 1.5), (NOMINAL, 0.0), (0.5, 0.0)] {
        let beta = beta(&arm, sum);
        let load = run(&arm, &beta, &arm.load());
        let rigid = run(&arm, &beta, &arm.rigid_torque());
        assert!((rigid - load - rotor * DDQ).abs() < 1e-12, "{sum}");
        assert!(
            (run(&arm, &beta, &motor) - rotor * DDQ).abs() < 1e-12,
            "{sum}"
        );
    }
}

#[test]
fn without_nominal_values_nobody_knows_the_share() {
    let arm = pendulum("", "");
    assert!(arm.motor_torque().is_none());
    let beta = beta(&arm, 4.0);
    let [load, rigid] = [arm.load(), arm.rigid_torque()].map(|all| run(&arm, &beta, &all));
    assert!((load - rigid).abs() < 1e-12 && rigid.abs() > 1.0);
}

/// `tau = load + rotor + mu |load| sign(dq)`, of the arm and of one with its numbers in it.
#[test]
fn friction_of_the_load_is_that_of_the_links() {
    let arm = pendulum(LINK, "load_dependent_friction on a;");
    let beta = beta(&arm, NOMINAL + 1.5);
    let rigid = run(&arm, &beta, &arm.rigid_torque());
    let load = run(&arm, &beta, &arm.load());
    assert!((rigid - load - 1.5 * DDQ).abs() < 1e-12);
    let expected = rigid - 0.3 * load.abs();
    let baked = arm.baked(&beta, &[]).expect("numbers of an arm");
    for arm in [&arm, &baked] {
        let torque = value(arm, &beta, &arm.dag, arm.computed.inverse_dynamics[0]);
        assert!((torque - expected).abs() < 1e-12, "{torque} {expected}");
        assert!((run(arm, &beta, &arm.load()) - load).abs() < 1e-12);
        // All that moves is in the mass matrix.
        let mass = value(arm, &beta, &arm.dag, arm.computed.mass_matrix[0][0]);
        assert!((mass - NOMINAL - 1.5).abs() < 1e-12, "{mass}");
    }
}

/// A motor that a coupling has in the sums of several columns has no share that one column tells.
#[test]
fn a_motor_in_several_sums_stays_in_the_load() {
    let text = "robot R {
        gravity = [0, -9.81, 0];
        convention = standard_dh;
        joint a: revolute { a = 0.3; alpha = 0; d = 0; }
        joint b: revolute { a = 0; alpha = 0; d = 0; }
        link a: nominal { mass = 2; com = [0.1, 0, 0]; inertia = [1, 0, 0, 1, 0, 2]; }
        link b: nominal { mass = 3; com = [0.1, 0, 0]; inertia = [1, 0, 0, 1, 0, 2]; }
        effects { gear_coupling on (a, b); motor_inertia on b; load_dependent_friction on a, b; }
    }";
    let model = robot_model_spec::load("r.robot", text).unwrap_or_else(|e| panic!("{e}"));
    let arm = compile_model(&model);
    let ia = arm
        .standard
        .iter()
        .position(|p| p.name == "b.motor_inertia.ia");
    let ia = ia.expect("it is declared");
    let combinations = arm.base.combinations.iter();
    let sums = combinations.filter(|terms| terms.len() > 1 && terms.iter().any(|&(k, _)| k == ia));
    assert!(sums.count() > 1, "{:?}", arm.base.combinations);
    assert!(arm.motor_torque().is_none());
}

/// `tau = Y_b beta` where columns read the load, of an arm with a share of its first motor in a sum, and of one with a motor in several sums.
#[test]
fn columns_at_the_load_make_the_torque() {
    let spec = |effects: &str| {
        format!(
            "robot R {{
                gravity = [0, -9.81, 0];
                convention = standard_dh;
                joint a: revolute {{ a = 0.3; alpha = 0; d = 0; }}
                joint b: revolute {{ a = 0.2; alpha = 0; d = 0; }}
                link a: nominal {{ mass = 2; com = [-0.1, 0, 0]; inertia = [1, 0, 0, 1, 0, 2]; }}
                link b: nominal {{ mass = 3; com = [-0.1, 0, 0]; inertia = [1, 0, 0, 1, 0, 2]; }}
                effects {{ {effects} load_dependent_friction on a, b; }}
            }}"
        )
    };
    for (effects, has_share) in [
        ("motor_inertia on all;", true),
        ("gear_coupling on (a, b); motor_inertia on b;", false),
    ] {
        let model = robot_model_spec::load("r.robot", &spec(effects));
        let arm = compile_model(&model.unwrap_or_else(|e| panic!("{e}")));
        assert_eq!(arm.motor_torque().is_some(), has_share, "{effects}");
        let count = arm.base.kept.len();
        let beta: Vec<f64> = (0..count).map(|k| 3.0 - 0.2 * k as f64).collect();
        let moving = |symbol| match symbol {
            Symbol::Q(k) => 0.4 - 0.9 * k as f64,
            Symbol::Dq(k) => -0.8 + 1.5 * k as f64,
            Symbol::Ddq(k) => 1.7 - 2.6 * k as f64,
            Symbol::Parameter(k) => arm.parameter_values(&beta)[k],
            other => panic!("{other:?} is not read"),
        };
        let load = arm.load().eval(&moving);
        let torque = arm.inverse_dynamics().eval(&moving);
        let columns = arm.base_regressor();
        let values = columns.program.eval(&|symbol| match symbol {
            Symbol::RigidTorque(joint) => load[joint],
            other => moving(other),
        });
        let mut found = [0.0; 2];
        for (&(joint, column), value) in columns.entries.iter().zip(values) {
            found[joint] += value * beta[column];
        }
        for (found, torque) in found.iter().zip(&torque) {
            assert!((found - torque).abs() < 1e-9, "{effects}: {found} {torque}");
        }
        let rigid = arm.rigid_torque().eval(&moving);
        assert_eq!(
            (rigid[0] - load[0]).abs() > 0.1,
            has_share,
            "{rigid:?} {load:?}"
        );
    }
}
