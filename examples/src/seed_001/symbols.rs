//! Equations (3) and (4) term by term, as printed, less those that the compiler derives from the energies and from the frames, multiplied out
//! in symbols.

use robot_model_codegen::Compiled;
use robot_model_codegen::expr::{Dag, ExprId, Function, Names, Style, Symbol};
use robot_model_codegen::show::polynomial::{expand, terms};

use super::truth::G;
use crate::paper::Error;

/// A factor of a term; joints count from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Factor {
    /// Acceleration of a joint.
    Acceleration(usize),
    /// Velocity of a joint.
    Velocity(usize),
    /// Sine of the first angle.
    Sin1,
    /// Sine of the second one.
    Sin2,
    /// Cosine of the second one.
    Cos2,
    /// Sine of both.
    Sin12,
}

/// A term of the torque of a joint: coefficient, product of the paper's constants, factors.
pub type Term = (f64, &'static str, &'static [Factor]);

/// Terms of both joints, as (3) and (4) have them.
pub const PRINTED: [&[Term]; 2] = {
    use Factor::{Acceleration, Cos2, Sin1, Sin2, Sin12, Velocity};
    [
        &[
            (1.0, "m1*c1^2", &[Acceleration(0)]),
            (1.0, "m2*c2^2", &[Acceleration(0)]),
            (1.0, "m2*l1^2", &[Acceleration(0)]),
            (2.0, "m2*l1*c2", &[Cos2, Acceleration(0)]),
            (1.0, "I1", &[Acceleration(0)]),
            (1.0, "I2", &[Acceleration(0)]),
            (1.0, "m2*c2^2", &[Acceleration(1)]),
            (1.0, "m2*l1*c2", &[Cos2, Acceleration(1)]),
            (1.0, "I2", &[Acceleration(1)]),
            (-2.0, "m2*l1*c2", &[Sin2, Velocity(0), Velocity(1)]),
            (-1.0, "m2*l1*c2", &[Sin2, Velocity(1), Velocity(1)]),
            (G, "m2*c2", &[Sin12]),
            (G, "m1*c1", &[Sin1]),
            (G, "m2*l1", &[Sin1]),
        ],
        &[
            (1.0, "m2*c2^2", &[Acceleration(0)]),
            (1.0, "m2*l1*c2", &[Cos2, Acceleration(0)]),
            (1.0, "I2", &[Acceleration(0)]),
            (1.0, "m2*c2^2", &[Acceleration(1)]),
            (1.0, "I2", &[Acceleration(1)]),
            (1.0, "m2*l1*c2", &[Sin2, Velocity(0), Velocity(0)]),
            (G, "m2*c2", &[Sin12]),
        ],
    ]
};

fn factor(dag: &mut Dag, factor: Factor) -> ExprId {
    let (function, joints): (Function, &[usize]) = match factor {
        Factor::Acceleration(joint) => return dag.symbol(Symbol::Ddq(joint)),
        Factor::Velocity(joint) => return dag.symbol(Symbol::Dq(joint)),
        Factor::Sin1 => (Function::Sin, &[0]),
        Factor::Sin2 => (Function::Sin, &[1]),
        Factor::Cos2 => (Function::Cos, &[1]),
        Factor::Sin12 => (Function::Sin, &[0, 1]),
    };
    let angles: Vec<ExprId> = joints.iter().map(|&j| dag.symbol(Symbol::Q(j))).collect();
    let angle = dag.sum(angles);
    dag.call(function, angle)
}

/// Terms that are left of each joint where equations are taken from those of the compiler; none where they are the same.
///
/// # Errors
/// A product of constants that is none of the spec's, and what is too long to be multiplied out.
pub fn left(compiled: &Compiled, equations: [&[Term]; 2]) -> Result<[Vec<String>; 2], Error> {
    // Each of the paper's products by itself, and not those sums of them that a motion tells.
    let compiled = compiled.ungrouped();
    let mut dag = compiled.dag.clone();
    let names = Names {
        parameters: compiled.standard.iter().map(|p| p.name.clone()).collect(),
        ..Names::default()
    };
    let torque = compiled.dynamics.rigid_torque.clone();
    let product = |dag: &mut Dag, product: &str| {
        let mut own = names.parameters.iter();
        let place = own.position(|name| name == product);
        let place = place.ok_or_else(|| format!("`{product}` is no parameter of the spec"))?;
        Ok(dag.symbol(Symbol::Parameter(place)))
    };
    less(&mut dag, &torque, equations, &names, &product)
}

/// The paper's constants but for the length, which is a number in the frames of a chain.
const CONSTANTS: [&str; 6] = ["m1", "m2", "c1", "c2", "I1", "I2"];

/// The same of the chain, whose standard parameters are what the paper's constants make them, with the number `l1` for its length.
///
/// Both sides are of the second degree in the length, so that three lengths settle all.
///
/// # Errors
/// As [`left`].
pub fn left_of_chain(
    compiled: &Compiled,
    l1: f64,
    equations: [&[Term]; 2],
) -> Result<[Vec<String>; 2], Error> {
    let compiled = compiled.ungrouped();
    let mut dag = compiled.dag.clone();
    let standard = compiled.standard.iter().map(|p| p.name.clone());
    // Behind the standard parameters, which all go.
    let first = compiled.standard.len();
    let parameters = standard.clone().chain(CONSTANTS.map(str::to_owned));
    let names = Names {
        parameters: parameters.collect(),
        ..Names::default()
    };
    let [m1, m2, c1, c2, i1, i2] =
        std::array::from_fn(|k| dag.symbol(Symbol::Parameter(first + k)));
    let length = dag.constant(l1);
    // The frame of the first link is at its end.
    let x1 = dag.sub(c1, length);
    let mut about = |mass: ExprId, x: ExprId, inertia: ExprId| {
        let moment = dag.mul(mass, x);
        let square = dag.mul(moment, x);
        [moment, dag.add(inertia, square)]
    };
    let ([mx1, izz1], [mx2, izz2]) = (about(m1, x1, i1), about(m2, c2, i2));
    let zero = dag.zero();
    let of_name = |name: String| match name.as_str() {
        "q1.m" => m1,
        "q1.mx" => mx1,
        "q1.izz" => izz1,
        "q2.m" => m2,
        "q2.mx" => mx2,
        "q2.izz" => izz2,
        _ => zero,
    };
    let values: Vec<ExprId> = standard.map(of_name).collect();
    let torque = dag.substitute(&compiled.dynamics.rigid_torque, &|symbol| match symbol {
        Symbol::Parameter(k) => values.get(k).copied(),
        _ => None,
    });
    let product = |dag: &mut Dag, product: &str| {
        let mut made = dag.constant(1.0);
        for part in product.split('*') {
            let (name, power) = part.split_once('^').unwrap_or((part, "1"));
            let own = CONSTANTS.iter().position(|own| *own == name);
            let own = match own {
                Some(k) => dag.symbol(Symbol::Parameter(first + k)),
                None if name == "l1" => dag.constant(l1),
                None => return Err(format!("`{name}` is no constant of the paper").into()),
            };
            for _ in 0..power.parse::<u32>()? {
                made = dag.mul(made, own);
            }
        }
        Ok(made)
    };
    less(&mut dag, &torque, equations, &names, &product)
}

/// Terms of torques less those of equations, whose products of constants `product` makes.
fn less(
    dag: &mut Dag,
    torque: &[ExprId],
    equations: [&[Term]; 2],
    names: &Names,
    product: &dyn Fn(&mut Dag, &str) -> Result<ExprId, Error>,
) -> Result<[Vec<String>; 2], Error> {
    let mut all = [Vec::new(), Vec::new()];
    for (joint, equation) in equations.into_iter().enumerate() {
        let mut difference = torque[joint];
        for &(coefficient, constants, factors) in equation {
            let mut term = product(dag, constants)?;
            for &own in factors {
                let own = factor(dag, own);
                term = dag.mul(term, own);
            }
            let term = dag.scale(-coefficient, term);
            difference = dag.add(difference, term);
        }
        let polynomial = expand(dag, difference, names).ok_or("too long")?;
        let left = terms(dag, &polynomial, names, Style::Text).into_iter();
        all[joint] = left.map(|(_, term)| term).collect();
    }
    Ok(all)
}
