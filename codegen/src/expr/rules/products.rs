//! Sums of two products, compared factor by factor. Where parallel axes follow each other, their angles add.

use crate::expr::{Dag, ExprId, Function, Node};

/// A product taken apart: `coefficient * cos(..).. * sin(..).. * rest`.
struct Factors {
    coefficient: f64,
    factors: Vec<ExprId>,
}

/// Longer products are left alone: comparing them costs more than the rule gives.
const MOST_FACTORS: usize = 8;

fn factors(dag: &Dag, x: ExprId) -> Option<Factors> {
    let (coefficient, rest) = dag.coefficient(x);
    let mut stack = vec![rest?];
    let mut factors = Vec::new();
    while let Some(x) = stack.pop() {
        match dag.node(x) {
            Node::Mul(p, q) => stack.extend([q, p]),
            _ => factors.push(x),
        }
        if factors.len() + stack.len() > MOST_FACTORS {
            return None;
        }
    }
    Some(Factors {
        coefficient,
        factors,
    })
}

/// What two products share, and the two trigonometric factors that each has alone.
struct Pair {
    common: Vec<ExprId>,
    coefficients: (f64, f64),
    left: [(Function, ExprId); 2],
    right: [(Function, ExprId); 2],
}

fn trigonometric_pair(dag: &Dag, x: ExprId, y: ExprId) -> Option<Pair> {
    let left = factors(dag, x)?;
    let right = factors(dag, y)?;
    #[expect(
        clippy::float_cmp,
        reason = "the rules hold for identical factors only"
    )]
    if left.factors.len() != right.factors.len()
        || left.coefficient.abs() != right.coefficient.abs()
    {
        return None;
    }
    let mut unmatched = right.factors;
    let (mut common, mut own) = (Vec::new(), Vec::new());
    for factor in left.factors {
        match unmatched.iter().position(|&other| other == factor) {
            Some(k) => {
                unmatched.remove(k);
                common.push(factor);
            }
            None => own.push(factor),
        }
    }
    let trigonometric = |factors: &[ExprId]| -> Option<[(Function, ExprId); 2]> {
        let &[p, q] = factors else { return None };
        let call = |x| match dag.node(x) {
            Node::Call(f @ (Function::Sin | Function::Cos), x) => Some((f, x)),
            _ => None,
        };
        Some([call(p)?, call(q)?])
    };
    Some(Pair {
        common,
        coefficients: (left.coefficient, right.coefficient),
        left: trigonometric(&own)?,
        right: trigonometric(&unmatched)?,
    })
}

fn times_common(dag: &mut Dag, pair: &Pair, coefficient: f64, value: ExprId) -> ExprId {
    let mut product: Option<ExprId> = None;
    for &factor in &pair.common {
        product = Some(match product {
            Some(product) => dag.mul(product, factor),
            None => factor,
        });
    }
    let product = match product {
        Some(product) => dag.mul(product, value),
        None => value,
    };
    dag.multiple(coefficient, product)
}

/// Products of the same factors in another order.
pub(super) fn collect_reordered(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    if !matches!((dag.node(x), dag.node(y)), (Node::Mul(..), Node::Mul(..))) {
        return None;
    }
    let (mut left, mut right) = (factors(dag, x)?, factors(dag, y)?);
    left.factors.sort_unstable();
    right.factors.sort_unstable();
    if left.factors != right.factors {
        return None;
    }
    let (_, product) = dag.coefficient(x);
    super::collected(dag, left.coefficient, right.coefficient, product?)
}

pub(super) fn pythagoras(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    let pair = trigonometric_pair(dag, x, y)?;
    let ((f, p), (g, q)) = (pair.left[0], pair.right[0]);
    let squares =
        pair.left[0] == pair.left[1] && pair.right[0] == pair.right[1] && p == q && f != g;
    let (c, d) = pair.coefficients;
    (squares && !differ(c, d)).then(|| {
        let one = dag.constant(1.0);
        times_common(dag, &pair, c, one)
    })
}

pub(super) fn cosine_of_sum(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    use Function::{Cos, Sin};
    let pair = trigonometric_pair(dag, x, y)?;
    let (cosines, sines, c, d) = match (pair.left, pair.right) {
        ([(Cos, a), (Cos, b)], [(Sin, p), (Sin, q)]) => {
            ([a, b], [p, q], pair.coefficients.0, pair.coefficients.1)
        }
        ([(Sin, p), (Sin, q)], [(Cos, a), (Cos, b)]) => {
            ([a, b], [p, q], pair.coefficients.1, pair.coefficients.0)
        }
        _ => return None,
    };
    if sines != cosines && sines != [cosines[1], cosines[0]] {
        return None;
    }
    let [a, b] = ordered(cosines);
    let angle = if differ(c, d) {
        dag.add(a, b)
    } else {
        dag.sub(b, a)
    };
    let cosine = dag.call(Cos, angle);
    Some(times_common(dag, &pair, c, cosine))
}

pub(super) fn sine_of_sum(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    use Function::{Cos, Sin};
    let pair = trigonometric_pair(dag, x, y)?;
    // `(a, b)` with the factors `sin a cos b`.
    let split = |factors: [(Function, ExprId); 2]| match factors {
        [(Sin, a), (Cos, b)] | [(Cos, b), (Sin, a)] => Some((a, b)),
        _ => None,
    };
    let ((a, b), (p, q)) = (split(pair.left)?, split(pair.right)?);
    if (p, q) != (b, a) {
        return None;
    }
    let (c, d) = pair.coefficients;
    // c sin a cos b + d sin b cos a: the sine with the positive sign goes first.
    let angle = if differ(c, d) {
        dag.sub(a, b)
    } else {
        let [a, b] = ordered([a, b]);
        dag.add(a, b)
    };
    let sine = dag.call(Sin, angle);
    Some(times_common(dag, &pair, c, sine))
}

/// Whether signs do; a product of small numbers may have none.
pub(super) fn differ(c: f64, d: f64) -> bool {
    c.is_sign_negative() != d.is_sign_negative()
}

fn ordered([a, b]: [ExprId; 2]) -> [ExprId; 2] {
    [a.min(b), a.max(b)]
}
