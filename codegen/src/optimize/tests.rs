//! The table of rewrites: one row each, with an example, what it costs before and after.

use super::{Cost, operations, optimize};
use crate::expr::{Dag, ExprId, Function, Node, Symbol};

/// Builds outputs from `x`, `y`, `a` and `b`.
type Build = fn(&mut Dag, [ExprId; 4]) -> Vec<ExprId>;

/// Multiplications and additions.
type Operations = (usize, usize);

/// Name, outputs, what they cost before and after.
const TABLE: &[(&str, Build, Operations, Operations)] = &[
    (
        "a x + a y = a (x + y)",
        |d, [x, y, a, _]| {
            let (left, right) = (d.mul(a, x), d.mul(a, y));
            vec![d.add(left, right)]
        },
        (2, 1),
        (1, 1),
    ),
    (
        "2 a x - 2 b x = 2 x (a - b)",
        |d, [x, y, a, b]| {
            // The sum between hides from the rules of the dag that both have a factor 2.
            let (left, right) = (d.mul(a, x), d.mul(b, x));
            let (left, right) = (d.scale(2.0, left), d.scale(2.0, right));
            let sum = d.add(left, y);
            vec![d.sub(sum, right)]
        },
        (4, 2),
        (2, 2),
    ),
    (
        "x + a + y, x + b + y: x + y once",
        |d, [x, y, a, b]| {
            [a, b]
                .map(|other| {
                    let sum = d.add(x, other);
                    d.add(sum, y)
                })
                .to_vec()
        },
        (0, 4),
        (0, 3),
    ),
    (
        "a (x - y), b (y - x): one difference",
        |d, [x, y, a, b]| {
            let (one, other) = (d.sub(x, y), d.sub(y, x));
            vec![d.mul(a, one), d.mul(b, other)]
        },
        (2, 2),
        (2, 1),
    ),
    (
        "(a x) b, (a y) b: a b once",
        |d, [x, y, a, b]| {
            [x, y]
                .map(|other| {
                    let product = d.mul(a, other);
                    d.mul(product, b)
                })
                .to_vec()
        },
        (4, 0),
        (3, 0),
    ),
    (
        "a x + b + a y, a - (y + x): the example of the README",
        |d, [x, y, a, b]| {
            let (left, right) = (d.mul(a, x), d.mul(a, y));
            let sum = d.add(left, b);
            let one = d.add(sum, right);
            let sum = d.add(y, x);
            vec![one, d.sub(a, sum)]
        },
        (2, 4),
        (1, 3),
    ),
    (
        "x + a y - x = a y",
        |d, [x, y, a, b]| {
            let product = d.mul(a, y);
            let one = d.add(x, product);
            // What is in between keeps the two apart.
            let between = d.sub(b, x);
            let sum = d.add(one, between);
            vec![d.sub(sum, b)]
        },
        (1, 4),
        (1, 0),
    ),
    (
        "y + x, y + 2 x: y + x once",
        |d, [x, y, a, b]| {
            let (sum, twice) = (d.add(y, x), d.scale(2.0, x));
            let more = d.add(y, twice);
            vec![d.mul(a, sum), d.mul(b, more)]
        },
        (3, 2),
        (2, 2),
    ),
    (
        "x - (x + y) = -y, although x + y is used",
        |d, [x, y, a, b]| {
            let sum = d.add(x, y);
            let product = d.mul(a, sum);
            // The sum between hides from the rules of the dag that they cancel.
            let other = d.add(x, b);
            vec![product, d.sub(other, sum)]
        },
        (1, 3),
        (1, 2),
    ),
    (
        "(x + y) - (x - y) = 2 y, although both are used",
        |d, [x, y, a, b]| {
            let (sum, difference) = (d.add(x, y), d.sub(x, y));
            let between = d.add(sum, a);
            let both = d.sub(between, difference);
            vec![d.sub(both, a), d.mul(a, sum), d.mul(b, difference)]
        },
        (2, 5),
        (3, 2),
    ),
    (
        "0.5 a ((x + y) - (x - y)) = a y: numbers of a product are one",
        |d, [x, y, a, b]| {
            let (sum, difference) = (d.add(x, y), d.sub(x, y));
            let between = d.add(sum, b);
            let both = d.sub(between, difference);
            let both = d.sub(both, b);
            let product = d.mul(a, both);
            let half = d.scale(0.5, product);
            vec![half, d.mul(a, sum), d.mul(b, difference)]
        },
        (4, 5),
        (3, 2),
    ),
    (
        "0.1 x + y + 0.2 x + a - 0.3 x = y + a: what is left of numbers that cancel is no term",
        |d, [x, y, a, b]| {
            let [one, two, three] = [0.1, 0.2, -0.3].map(|c| d.scale(c, x));
            // What is between hides from the rules of the dag that they cancel.
            let sum = [y, a, two, b, three]
                .iter()
                .fold(one, |sum, &x| d.add(sum, x));
            vec![sum]
        },
        (3, 5),
        (0, 2),
    ),
    (
        "x b, x a - b a x = a (x - x b): one of two common factors",
        |d, [x, _, a, b]| {
            let (alone, left, both) = (d.mul(x, b), d.mul(x, a), d.mul(b, a));
            let right = d.mul(both, x);
            vec![alone, d.sub(left, right)]
        },
        (4, 1),
        (2, 1),
    ),
    (
        "b b - x b - x a b: a saving that another has spoilt is none",
        |d, [x, _, a, b]| {
            let (one, both, square) = (d.mul(x, b), d.mul(x, a), d.mul(b, b));
            let (one, two) = (d.neg(one), d.mul(both, b));
            let sum = d.sub(one, two);
            vec![d.add(sum, square)]
        },
        (4, 2),
        (2, 2),
    ),
    (
        "y y, (y y) y + y x y, x: a product that is there is the shared one",
        |d, [x, y, _, _]| {
            let (square, other) = (d.mul(y, y), d.mul(y, x));
            let (cube, other) = (d.mul(square, y), d.mul(other, y));
            vec![square, d.add(cube, other), x]
        },
        (4, 1),
        (2, 1),
    ),
    (
        "-a x - a y, subtracted: signs go outward",
        |d, [x, y, a, b]| {
            let product = d.mul(a, x);
            let (left, right) = (d.neg(product), d.neg(y));
            let sum = d.add(left, right);
            let inside = d.call(Function::Abs, b);
            let product = d.mul(sum, inside);
            vec![d.sub(b, product)]
        },
        (2, 2),
        (2, 2),
    ),
];

fn value(symbol: Symbol) -> f64 {
    match symbol {
        Symbol::Q(k) => 0.7 + 1.9 * k as f64,
        _ => unreachable!("the table has positions"),
    }
}

#[test]
fn every_rewrite_saves_what_it_says_and_changes_no_value() {
    for (name, build, before, after) in TABLE {
        let mut dag = Dag::new();
        let symbols = std::array::from_fn(|k| dag.symbol(Symbol::Q(k)));
        let outputs = build(&mut dag, symbols);
        let count = |cost: Cost| (cost.mul, cost.add);
        assert_eq!(count(operations(&dag, &outputs)), *before, "{name}");
        let optimized = optimize(&dag, &outputs);
        assert_eq!(count(optimized.cost()), *after, "{name}");
        for (&x, &y) in outputs.iter().zip(&optimized.outputs) {
            let (x, y) = (dag.evaluate(x, &value), optimized.dag.evaluate(y, &value));
            // A few roundings of terms below 100.
            assert!((x - y).abs() <= 800.0 * f64::EPSILON, "{name}: {x} {y}");
        }
    }
}

#[test]
fn the_same_outputs_give_the_same_dag() {
    for (_, build, ..) in TABLE {
        let mut dag = Dag::new();
        let symbols = std::array::from_fn(|k| dag.symbol(Symbol::Q(k)));
        let outputs = build(&mut dag, symbols);
        let (one, other) = (optimize(&dag, &outputs), optimize(&dag, &outputs));
        assert_eq!(one.outputs, other.outputs);
        let nodes = |dag: &Dag, roots: &[ExprId]| {
            let order = dag.reachable(roots);
            order.iter().map(|&x| dag.node(x)).collect::<Vec<_>>()
        };
        assert_eq!(
            nodes(&one.dag, &one.outputs),
            nodes(&other.dag, &other.outputs)
        );
    }
}

#[test]
fn a_sign_is_taken_by_a_subtraction() {
    let mut dag = Dag::new();
    let [x, y, a] = std::array::from_fn(|k| dag.symbol(Symbol::Q(k)));
    let (minus_x, minus_y) = (dag.neg(x), dag.neg(y));
    let sum = dag.add(minus_x, minus_y);
    let product = dag.mul(a, sum);
    let output = dag.add(x, product);
    let optimized = optimize(&dag, &[output]);
    let text = optimized.dag.display(
        optimized.outputs[0],
        &crate::expr::Names::default(),
        crate::expr::Style::Text,
    );
    assert_eq!(text, "q1 - (q1 + q2) q3");
}

/// A page has the angles of a state in one list, which is read by joint.
#[test]
fn sines_come_first_in_the_order_in_which_they_were_made() {
    let mut dag = Dag::new();
    let [x, y, a, b] = std::array::from_fn(|k| dag.symbol(Symbol::Q(k)));
    let [sin_x, sin_y] = [x, y].map(|x| dag.call(Function::Sin, x));
    let outputs = [dag.mul(a, sin_y), dag.mul(b, sin_x)];
    let optimized = optimize(&dag, &outputs);
    let order = optimized.dag.reachable(&optimized.outputs);
    let nodes = order.iter().map(|&x| optimized.dag.node(x));
    let computed: Vec<Node> = nodes
        .filter(|node| !matches!(node, Node::Symbol(_)))
        .collect();
    let sine_of = |node: Node| match node {
        Node::Call(Function::Sin, x) => optimized.dag.node(x),
        other => other,
    };
    let first = [0, 1].map(|k| sine_of(computed[k]));
    assert_eq!(first, [0, 1].map(|k| Node::Symbol(Symbol::Q(k))));
}

/// Together they would have no double, or not all of its digits.
#[test]
fn numbers_of_a_product_stay_apart_where_together_they_are_none() {
    for size in [1e200, 1e-200] {
        let mut dag = Dag::new();
        let [x, y, a, b] = std::array::from_fn(|k| dag.symbol(Symbol::Q(k)));
        let small = dag.scale(size, x);
        let product = dag.scale(size, small);
        // A sum that is used twice, and written out where it cancels.
        let sum = dag.add(small, y);
        let (large, other) = (dag.scale(size, sum), dag.scale(size, y));
        let between = dag.add(large, b);
        let written_out = dag.sub(between, other);
        let outputs = [product, written_out, dag.mul(a, sum)];
        let optimized = optimize(&dag, &outputs);
        let state = |symbol| match symbol {
            Symbol::Q(0) => size.powf(-1.5),
            Symbol::Q(1) => size.powf(-0.5),
            Symbol::Q(2) => 1.0,
            _ => size.sqrt(),
        };
        for (&x, &y) in outputs.iter().zip(&optimized.outputs) {
            let (x, y) = (dag.evaluate(x, &state), optimized.dag.evaluate(y, &state));
            assert!((x - y).abs() <= 1e-14 * x.abs(), "{size}: {x} {y}");
        }
    }
}

/// A reciprocal that several products share is one division, and each of them multiplies.
#[test]
fn a_division_is_that_of_one_product() {
    let mut dag = Dag::new();
    let [x, y, a, b] = std::array::from_fn(|k| dag.symbol(Symbol::Q(k)));
    let quotients = [y, a, b].map(|other| dag.div(other, x));
    let count = |outputs: &[ExprId]| {
        let cost = operations(&dag, outputs);
        (cost.mul, cost.div)
    };
    assert_eq!(count(&quotients[..1]), (0, 1));
    assert_eq!(count(&quotients), (3, 1));
}
