//! Equations (3) and (4) term by term, as printed, less those that the compiler derives from the energies, multiplied out in symbols.

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
    let mut all = [Vec::new(), Vec::new()];
    for (joint, equation) in equations.into_iter().enumerate() {
        let mut difference = compiled.dynamics.rigid_torque[joint];
        for &(coefficient, product, factors) in equation {
            let mut own = names.parameters.iter();
            let place = own.position(|name| name == product);
            let place = place.ok_or_else(|| format!("`{product}` is no parameter of the spec"))?;
            let mut term = dag.symbol(Symbol::Parameter(place));
            for &own in factors {
                let own = factor(&mut dag, own);
                term = dag.mul(term, own);
            }
            let term = dag.scale(-coefficient, term);
            difference = dag.add(difference, term);
        }
        let polynomial = expand(&mut dag, difference, &names).ok_or("too long")?;
        let left = terms(&dag, &polynomial, &names, Style::Text).into_iter();
        all[joint] = left.map(|(_, term)| term).collect();
    }
    Ok(all)
}
