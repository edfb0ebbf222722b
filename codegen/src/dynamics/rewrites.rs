//! The derivation's rewrites, a row each, as `optimize/README.md` lists them: the same equations, with and without.

use super::chain::Chain;
use super::columns::{Columns, Meet, Way, columns};
use super::computed::operations;
use super::coriolis;
use super::lean::{Choice, Form, LeanChain};
use super::rigid::{RigidBody, Terms};
use super::vanishing::without_vanishing;
use super::{Value, parameter_expressions};
use crate::expr::{Dag, ExprId, Symbol};
use crate::random::Generator;

type Derivation = fn(&mut Dag, &Chain) -> Vec<ExprId>;

/// One of the rewrites.
struct Row {
    name: &'static str,
    /// Joints of an arm that it is made for, standard DH, with numbers for all parameters.
    arm: &'static str,
    without: Derivation,
    with: Derivation,
}

/// Axes at right angles, lengths between.
const SQUARE: &str = "revolute { a = 0.4; alpha = 90 deg; d = 0; } revolute { a = 0.4; alpha = -90 deg; d = 0; } \
                      revolute { a = 0; alpha = 0; d = 0; }";

/// Axes that meet.
const WRIST: &str = "revolute { a = 0; alpha = -90 deg; d = 0; } revolute { a = 0; alpha = 90 deg; d = 0; } \
                     revolute { a = 0; alpha = 0; d = 0.3; }";

const TABLE: &[Row] = &[
    Row {
        name: "a revolute joint's axis is fixed in the link and in its parent",
        arm: WRIST,
        without: |dag, chain| chain.torque(dag, Terms::All, false),
        with: |dag, chain| torque(dag, chain, |_| ()),
    },
    Row {
        name: "origins move along axes",
        arm: WRIST,
        without: |dag, chain| torque(dag, chain, |_| ()),
        with: |dag, chain| {
            let origins = onto_joints(dag, chain);
            torque(dag, chain, |choice| choice.origins = origins)
        },
    },
    Row {
        name: "links are written in axes that do not turn",
        arm: SQUARE,
        without: |dag, chain| torque(dag, chain, |_| ()),
        with: |dag, chain| torque(dag, chain, |choice| choice.turned.fill(true)),
    },
    Row {
        name: "lengths are measured in one of the arm's own",
        arm: SQUARE,
        without: |dag, chain| torque(dag, chain, |_| ()),
        with: |dag, chain| torque(dag, chain, |choice| choice.unit = 0.4),
    },
    Row {
        name: "a mass is lent from link to link",
        arm: SQUARE,
        without: |dag, chain| torque(dag, chain, |_| ()),
        with: |dag, chain| {
            let lent = lent(dag, chain);
            torque(dag, chain, |choice| choice.lent = lent)
        },
    },
    Row {
        name: "second moments in place of inertias",
        arm: WRIST,
        without: |dag, chain| torque(dag, chain, |_| ()),
        with: |dag, chain| torque(dag, chain, |choice| choice.forms.fill(Form::SecondMoments)),
    },
    Row {
        name: "M by composite bodies",
        arm: SQUARE,
        without: |dag, chain| {
            let torque = chain.torque(dag, Terms::All, false);
            let columns = (0..torque.len()).map(|k| dag.derivatives(&torque, Symbol::Ddq(k)));
            columns.collect::<Vec<_>>().concat()
        },
        with: |dag, chain| chain.mass_matrix(dag).concat(),
    },
    Row {
        name: "C by composite bodies",
        arm: SQUARE,
        without: |dag, chain| {
            let torque = chain.torque(dag, Terms::Velocity, false);
            coriolis::coriolis_matrix(dag, &torque).concat()
        },
        with: |dag, chain| chain.coriolis_matrix(dag).concat(),
    },
    Row {
        name: "what vanishes at every state is zero",
        arm: SQUARE,
        without: |dag, chain| chain.torque(dag, Terms::Gravity, false),
        with: |dag, chain| {
            let torque = chain.torque(dag, Terms::Gravity, false);
            without_vanishing(dag, torque)
        },
    },
    Row {
        name: "three of ten columns are sums of the parent's",
        arm: SQUARE,
        without: |dag, chain| regressor(dag, chain, false, AT_THE_BASE),
        with: |dag, chain| regressor(dag, chain, true, AT_THE_BASE),
    },
    Row {
        name: "wrenches come inward, axes outward",
        arm: SQUARE,
        without: |dag, chain| regressor(dag, chain, false, AT_THE_BASE),
        with: |dag, chain| {
            regressor(dag, chain, false, |link| Meet {
                link,
                at_joint: false,
            })
        },
    },
];

const AT_THE_BASE: fn(usize) -> Meet = |_| Meet {
    link: 0,
    at_joint: true,
};

fn torque(dag: &mut Dag, chain: &Chain, change: impl FnOnce(&mut Choice)) -> Vec<ExprId> {
    let mut choice = Choice::plain(chain.frames.len());
    change(&mut choice);
    LeanChain::new(dag, chain, &choice).torque(dag, Terms::All)
}

/// For each link the way from its origin to its joint.
fn onto_joints(dag: &Dag, chain: &Chain) -> Vec<[f64; 3]> {
    let back = |x: ExprId| dag.as_constant(x).map_or(0.0, |x| -x);
    let frames = chain.frames.iter();
    frames.map(|frame| frame.to_origin.map(back)).collect()
}

/// For each link the mass that makes a first moment of its parent vanish, or any other.
fn lent(dag: &Dag, chain: &Chain) -> Vec<f64> {
    let parents = chain.links.iter().zip(&chain.frames[1..]);
    let lent = parents.map(|(parent, frame)| {
        let step = dag.as_constant(frame.joint_point[0]).unwrap_or(0.0);
        let first = dag.as_constant(parent[1]).expect("a number");
        if step.abs() > 0.1 { first / step } else { 0.5 }
    });
    std::iter::once(0.0).chain(lent).collect()
}

fn regressor(
    dag: &mut Dag,
    chain: &Chain,
    from_parents: bool,
    meet: fn(usize) -> Meet,
) -> Vec<ExprId> {
    let way = Way {
        from_parents,
        meets: (0..chain.frames.len()).map(meet).collect(),
    };
    let columns: Vec<Columns> = columns(dag, chain, &way, &|_, _| true);
    columns.into_iter().flatten().flatten().collect()
}

/// The chain of an arm, with random numbers for its parameters.
fn chain(dag: &mut Dag, random: &mut Generator, text: &str) -> Chain {
    let model = robot_model_spec::load("arm", text).unwrap_or_else(|e| panic!("{e}"));
    let count = 10 * model.joints.len();
    let values: Vec<Value> = (0..count)
        .map(|_| Value::Number(1.0 + 0.5 * random.symmetric()))
        .collect();
    let parameters = parameter_expressions(dag, &values);
    match RigidBody::new(dag, &model, None, &parameters) {
        RigidBody::Chain(chain) => chain,
        RigidBody::Lagrangian(_) => panic!("an arm is a chain"),
    }
}

fn spec(convention: &str, gravity: [f64; 3], joints: &[String]) -> String {
    let joints = joints.iter().enumerate();
    let joints: Vec<String> = joints
        .map(|(k, joint)| format!("joint j{k}: {joint}\n"))
        .collect();
    let joints = joints.concat();
    format!("robot Arm {{ gravity = {gravity:?}; convention = {convention};\n{joints}}}\n")
}

/// Four joints, some that slide, some with axes along those of the frame, some without a length.
fn random_arm(random: &mut Generator) -> String {
    let joint = |random: &mut Generator| {
        let mut length = || match random.below(3) {
            0 => 0.0,
            _ => 0.5 * random.symmetric(),
        };
        let (a, d) = (length(), length());
        let alpha = match random.below(4) {
            0 => "0".to_owned(),
            1 => "90 deg".to_owned(),
            2 => "-90 deg".to_owned(),
            _ => format!("{}", random.symmetric()),
        };
        let (kind, own) = match random.below(4) {
            0 => ("prismatic", "theta"),
            _ => ("revolute", "d"),
        };
        format!("{kind} {{ a = {a}; alpha = {alpha}; {own} = {d}; }}")
    };
    let joints: Vec<String> = (0..4).map(|_| joint(random)).collect();
    let convention = ["standard_dh", "modified_dh"][random.below(2)];
    let gravity = match random.below(2) {
        0 => [0.0, 0.0, -9.81],
        _ => [0.0; 3].map(|_: f64| 9.81 * random.symmetric()),
    };
    spec(convention, gravity, &joints)
}

#[test]
fn every_rewrite_has_the_same_values() {
    const ARMS: usize = 20;
    let mut random = Generator::new(4);
    for _ in 0..ARMS {
        let text = random_arm(&mut random);
        let mut dag = Dag::new();
        let chain = chain(&mut dag, &mut random, &text);
        let state = [(); 12].map(|()| 2.0 * random.symmetric());
        let value = |symbol| match symbol {
            Symbol::Q(k) => state[k],
            Symbol::Dq(k) => state[4 + k],
            Symbol::Ddq(k) => state[8 + k],
            _ => unreachable!("parameters are numbers"),
        };
        for row in TABLE {
            let [wanted, found] = [row.without, row.with].map(|derive| -> Vec<f64> {
                let outputs = derive(&mut dag, &chain);
                outputs.iter().map(|&x| dag.evaluate(x, &value)).collect()
            });
            let size = wanted.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
            assert_eq!(found.len(), wanted.len());
            for (k, (x, y)) in found.iter().zip(&wanted).enumerate() {
                // Sums of some hundred terms in another order.
                assert!(
                    (x - y).abs() <= 1e-12 * size,
                    "{} {k}: {x} {y}\n{text}",
                    row.name
                );
            }
        }
    }
}

#[test]
fn every_rewrite_saves_operations_where_it_is_made_for() {
    for row in TABLE {
        let joints = row.arm.split_inclusive('}');
        let joints: Vec<String> = joints.map(|joint| joint.trim().to_owned()).collect();
        let text = spec("standard_dh", [0.0, 0.0, -9.81], &joints);
        let [without, with] = [row.without, row.with].map(|derive| {
            let mut dag = Dag::new();
            let chain = chain(&mut dag, &mut Generator::new(1), &text);
            let outputs = derive(&mut dag, &chain);
            operations(&dag, &outputs)
        });
        assert!(with < without, "{}: {without} -> {with}", row.name);
    }
}
