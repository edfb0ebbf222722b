//! The table's examples: one row a rule.

use super::*;
use crate::expr::{Names, Style, Symbol};

/// Builds the left-hand side of a rule from `x`, `y` and `k`.
type Build = fn(&mut Dag, ExprId, ExprId, ExprId) -> ExprId;

fn cos(dag: &mut Dag, x: ExprId) -> ExprId {
    dag.call(Function::Cos, x)
}

fn sin(dag: &mut Dag, x: ExprId) -> ExprId {
    dag.call(Function::Sin, x)
}

/// `k f(x) g(y)`
fn product(dag: &mut Dag, k: ExprId, f: (Function, ExprId), g: (Function, ExprId)) -> ExprId {
    let (f, g) = (dag.call(f.0, f.1), dag.call(g.0, g.1));
    let left = dag.mul(k, f);
    dag.mul(left, g)
}

/// One row a rule: its name, an expression that it rewrites, the result.
const TABLE: &[(&str, Build, &str)] = &[
    (
        "2 + 3 = 5",
        |d, _, _, _| {
            let (a, b) = (d.constant(2.0), d.constant(3.0));
            d.add(a, b)
        },
        "5",
    ),
    (
        "x + 0 = x",
        |d, x, _, _| {
            let zero = d.zero();
            d.add(x, zero)
        },
        "q1",
    ),
    (
        "c x + d x = (c + d) x",
        |d, x, _, _| {
            let (a, b) = (d.scale(2.0, x), d.scale(-5.0, x));
            d.add(a, b)
        },
        "-3 q1",
    ),
    (
        "(y + c x) + d x = y + (c + d) x",
        |d, x, y, _| {
            let sum = d.add(x, y);
            d.sub(sum, x)
        },
        "q2",
    ),
    (
        "c x (y z) + d (x y) z = (c + d) x y z",
        |d, x, y, k| {
            let (xy, yk) = (d.mul(x, y), d.mul(y, k));
            let (left, right) = (d.mul(xy, k), d.mul(x, yk));
            d.sub(left, right)
        },
        "0",
    ),
    (
        "k cos^2 x + k sin^2 x = k",
        |d, x, _, k| {
            let c = product(d, k, (Function::Cos, x), (Function::Cos, x));
            let s = product(d, k, (Function::Sin, x), (Function::Sin, x));
            d.add(c, s)
        },
        "t",
    ),
    (
        "k cos x cos y - k sin x sin y = k cos(x + y)",
        |d, x, y, k| {
            let c = product(d, k, (Function::Cos, x), (Function::Cos, y));
            let s = product(d, k, (Function::Sin, x), (Function::Sin, y));
            d.sub(c, s)
        },
        "t cos(q1 + q2)",
    ),
    (
        "k sin x cos y + k cos x sin y = k sin(x + y)",
        |d, x, y, k| {
            let a = product(d, k, (Function::Sin, x), (Function::Cos, y));
            let b = product(d, k, (Function::Cos, x), (Function::Sin, y));
            d.sub(a, b)
        },
        "t sin(q1 - q2)",
    ),
    (
        "c x + c y = c (x + y)",
        |d, x, y, _| {
            let (a, b) = (d.neg(x), d.neg(y));
            d.add(a, b)
        },
        "-(q1 + q2)",
    ),
    (
        "2 * 3 = 6",
        |d, _, _, _| {
            let (a, b) = (d.constant(2.0), d.constant(3.0));
            d.mul(a, b)
        },
        "6",
    ),
    (
        "0 x = 0",
        |d, x, _, _| {
            let zero = d.zero();
            d.mul(x, zero)
        },
        "0",
    ),
    (
        "1 x = x",
        |d, x, _, _| {
            let one = d.constant(1.0);
            d.mul(x, one)
        },
        "q1",
    ),
    (
        "c (d x) = (c d) x",
        |d, x, _, _| {
            let negative = d.neg(x);
            d.neg(negative)
        },
        "q1",
    ),
    (
        "(c x) (d y) = (c d) (x y)",
        |d, x, y, _| {
            let a = d.scale(2.0, x);
            let b = d.neg(y);
            d.mul(a, b)
        },
        "-2 q1 q2",
    ),
    ("x / x = 1", |d, x, _, _| d.div(x, x), "1"),
    (
        "abs(x) sign(x) = x",
        |d, x, _, _| {
            let (a, s) = (d.call(Function::Abs, x), d.call(Function::Sign, x));
            d.mul(a, s)
        },
        "q1",
    ),
    (
        "sqrt(x) sqrt(x) = x",
        |d, x, _, _| {
            let root = d.call(Function::Sqrt, x);
            d.mul(root, root)
        },
        "q1",
    ),
    (
        "exp(0) = 1",
        |d, _, _, _| {
            let zero = d.zero();
            d.call(Function::Exp, zero)
        },
        "1",
    ),
    (
        "cos(-x) = cos(x)",
        |d, x, _, _| {
            let x = d.neg(x);
            cos(d, x)
        },
        "cos(q1)",
    ),
    (
        "sin(-x) = -sin(x)",
        |d, x, _, _| {
            let x = d.neg(x);
            sin(d, x)
        },
        "-sin(q1)",
    ),
    (
        "abs(c x) = |c| abs(x)",
        |d, x, _, _| {
            let x = d.scale(-3.0, x);
            d.call(Function::Abs, x)
        },
        "3 abs(q1)",
    ),
    (
        "1 / (c x) = (1 / c) (1 / x)",
        |d, x, _, _| {
            let x = d.scale(4.0, x);
            d.call(Function::Recip, x)
        },
        "0.25 / q1",
    ),
    (
        "1 / (1 / x) = x",
        |d, x, _, _| {
            let recip = d.call(Function::Recip, x);
            d.call(Function::Recip, recip)
        },
        "q1",
    ),
    (
        "abs(abs(x)) = abs(x)",
        |d, x, _, _| {
            let modulus = d.call(Function::Abs, x);
            d.call(Function::Abs, modulus)
        },
        "abs(q1)",
    ),
    (
        "if 2 { x } else { y } = x",
        |d, x, y, _| {
            let two = d.constant(2.0);
            d.select(two, x, y)
        },
        "q1",
    ),
    (
        "if c { x } else { x } = x",
        |d, x, _, k| d.select(k, x, x),
        "q1",
    ),
    (
        "if 2 c { x } else { y } = if c { x } else { y }",
        |d, x, y, k| {
            let condition = d.scale(2.0, k);
            d.select(condition, x, y)
        },
        "(if t > 0 { q1 } else { q2 })",
    ),
    (
        "if c { k x } else { k y } = k if c { x } else { y }",
        |d, x, y, _| {
            let (x, y) = (d.scale(3.0, x), d.scale(3.0, y));
            d.max(x, y)
        },
        "3 (if q1 > q2 { q1 } else { q2 })",
    ),
];

#[test]
fn every_rule_rewrites_its_example() {
    let names = SUM
        .iter()
        .chain(PRODUCT)
        .map(|rule| rule.name)
        .chain(CALL.iter().map(|rule| rule.name))
        .chain(SELECT.iter().map(|rule| rule.name));
    assert_eq!(
        names.collect::<Vec<_>>(),
        TABLE.iter().map(|row| row.0).collect::<Vec<_>>()
    );
    for (name, build, expected) in TABLE {
        let mut dag = Dag::new();
        let (x, y) = (dag.symbol(Symbol::Q(0)), dag.symbol(Symbol::Q(1)));
        let k = dag.symbol(Symbol::Time);
        let result = build(&mut dag, x, y, k);
        assert_eq!(
            dag.display(result, &Names::default(), Style::Text),
            *expected,
            "{name}"
        );
    }
}

#[test]
fn a_difference_of_cosines_is_the_cosine_of_a_difference() {
    let mut dag = Dag::new();
    let (x, y) = (dag.symbol(Symbol::Q(0)), dag.symbol(Symbol::Q(1)));
    let (cx, cy, sx, sy) = (
        cos(&mut dag, x),
        cos(&mut dag, y),
        sin(&mut dag, x),
        sin(&mut dag, y),
    );
    let (c, s) = (dag.mul(cx, cy), dag.mul(sx, sy));
    let sum = dag.add(c, s);
    let value = dag.evaluate(sum, &|symbol| {
        if symbol == Symbol::Q(0) { 0.3 } else { 1.1 }
    });
    assert!((value - 0.8f64.cos()).abs() < 1e-15);
    assert!(
        dag.reachable(&[sum]).len() <= 6,
        "one cosine of one difference"
    );
}

/// Where one number in place of two would be infinite, zero or short of digits, there are two.
#[test]
fn numbers_are_folded_where_their_product_has_all_its_digits() {
    for size in [1e200, 1e-200, 1e-155] {
        let mut dag = Dag::new();
        let (x, y) = (dag.symbol(Symbol::Q(0)), dag.symbol(Symbol::Q(1)));
        let small = dag.scale(size, x);
        let product = dag.scale(size, small);
        let sum = dag.add(small, y);
        let (large, other) = (dag.scale(size, sum), dag.scale(size, y));
        let twice = dag.scale(size, y);
        let outputs = [product, dag.sub(large, other), dag.mul(small, twice)];
        let state = |symbol| match symbol {
            Symbol::Q(0) => f64::powf(size, -1.5),
            _ => size.recip(),
        };
        let (x, y) = (state(Symbol::Q(0)), state(Symbol::Q(1)));
        let values = outputs.map(|output| dag.evaluate(output, &state));
        let wanted = [size * (size * x), size * (size * x), size * x * (size * y)];
        for (found, wanted) in values.iter().zip(wanted) {
            assert!(
                (found - wanted).abs() <= 1e-14 * wanted,
                "{size}: {found} {wanted}"
            );
        }
    }
    // Nor is a sum of numbers that is none.
    let mut dag = Dag::new();
    let x = dag.symbol(Symbol::Q(0));
    let large = dag.scale(1.7e308, x);
    let twice = dag.add(large, large);
    assert!((dag.evaluate(twice, &|_| 1e-300) / 3.4e8 - 1.0).abs() < 1e-14);
}
