//! The momentum form, from which the filtered regressor is made: no acceleration anywhere.
//!
//! In: a [`Model`] with its energies and its [`LinearForm`]. Out: [`MomentumForm`]. Invariant gained: no entry contains an
//! acceleration, and `tau = d/dt (Y_p * standard) - Y_h * standard` along every motion.
//!
//! Of the rigid body, `p = dT/d dq` is the momentum and `h = d(T - V)/dq`, which is `C^T dq - G`. A column of an effect that
//! is `A(q, t) ddq + r` goes by parts, `A ddq = d/dt (A dq) - dA/dt dq`: `A dq` is momentum, `dA/dt dq - r` drift.
//!
//! Passed through `L(s) = w / (s + w)`, with `s L = w (1 - L)`: `L{tau} = Y_L * standard` where
//! `Y_L = w (Y_p - L{Y_p}) - L{Y_h}` (Hsu, Bodson, Sastry and Paden 1987). The columns are filtered after their
//! nonlinear terms are formed, so that holds for drifts that jump, such as dry friction, as well.

use std::fmt;

use robot_model_spec::model::Model;

use crate::dynamics::Energies;
use crate::expr::{Dag, ExprId, Symbol};
use crate::regressor::LinearForm;

/// `tau = d/dt (Y_p * standard) - Y_h * standard`, with the load of load-dependent effects as [`Symbol::RigidTorque`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MomentumForm {
    /// `Y_p[joint][parameter]`, the momentum regressor; reads `q, dq`.
    pub momentum: Vec<Vec<ExprId>>,
    /// `Y_h[joint][parameter]`, the regressor of what changes the momentum beside the torque; reads `q, dq` and what effects
    /// read beside accelerations.
    pub drift: Vec<Vec<ExprId>>,
    /// Columns that have no momentum form; both regressors are zero there.
    pub refused: Vec<Refusal>,
}

/// A parameter whose column reads accelerations in a way that no filter takes away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Refusal {
    /// Index of the standard parameter.
    pub parameter: usize,
    /// Why.
    pub reason: Reason,
}

/// Why a column has no momentum form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reason {
    /// It is not a sum of accelerations with coefficients.
    NotAffine,
    /// An acceleration's coefficient depends on more than positions and time.
    Coefficient,
    /// An acceleration's coefficient jumps.
    Jump,
    /// It reads the torque of the rigid body, in which accelerations are.
    Load,
    /// The effect moves a link by what changes along a motion, its load as a rule.
    Displacement,
    /// It has a memory whose rate reads accelerations or the torque of the rigid body.
    Memory,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotAffine => "its torque is not linear in the acceleration",
            Self::Jump => "its torque has an acceleration with a factor that jumps",
            Self::Coefficient => {
                "its torque has an acceleration with a factor that depends on more than positions"
            }
            Self::Displacement => "it displaces a link depending on the motion",
            Self::Memory => "its torque has a memory that follows the acceleration",
            Self::Load => {
                "its torque depends on the load, `rigid_torque`, which contains the acceleration"
            }
        })
    }
}

/// Derives both regressors. `energies` have a symbol for every standard parameter of the rigid body; `state_rates` are the rates
/// of the declared effects' internal states.
pub fn derive(
    dag: &mut Dag,
    model: &Model,
    energies: Energies,
    linear: &LinearForm,
    state_rates: &[ExprId],
) -> MomentumForm {
    let dof = model.joints.len();
    let standard = model.standard_parameters();
    let count = standard.len();
    let (rigid, effects): (Vec<usize>, Vec<usize>) =
        (0..count).partition(|&k| model.is_rigid(&standard[k]));
    let mut form = MomentumForm {
        momentum: vec![vec![dag.zero(); count]; dof],
        drift: vec![vec![dag.zero(); count]; dof],
        refused: Vec::new(),
    };
    let mut kinetic = Vec::with_capacity(rigid.len());
    let mut lagrangian = Vec::with_capacity(rigid.len());
    for &parameter in &rigid {
        let of = [energies.kinetic, energies.potential];
        let of = dag.derivatives(&of, Symbol::Parameter(parameter));
        kinetic.push(of[0]);
        lagrangian.push(dag.sub(of[0], of[1]));
    }
    for joint in 0..dof {
        let momentum = dag.derivatives(&kinetic, Symbol::Dq(joint));
        let drift = dag.derivatives(&lagrangian, Symbol::Q(joint));
        for ((&parameter, p), h) in rigid.iter().zip(momentum).zip(drift) {
            form.momentum[joint][parameter] = p;
            form.drift[joint][parameter] = h;
        }
    }
    for parameter in effects {
        let entries: Vec<(usize, ExprId)> = linear.column(dag, parameter).collect();
        let split: Result<Vec<Split>, Reason> = entries
            .iter()
            .map(|&(_, entry)| by_parts(dag, entry, dof, state_rates))
            .collect();
        match split {
            Err(reason) => form.refused.push(Refusal { parameter, reason }),
            Ok(parts) => {
                for ((joint, _), part) in entries.into_iter().zip(parts) {
                    form.momentum[joint][parameter] = part.momentum;
                    form.drift[joint][parameter] = part.drift;
                }
            }
        }
    }
    form
}

/// `column = d momentum/dt - drift`
struct Split {
    momentum: ExprId,
    drift: ExprId,
}

fn by_parts(
    dag: &mut Dag,
    column: ExprId,
    dof: usize,
    state_rates: &[ExprId],
) -> Result<Split, Reason> {
    if memory_follows_acceleration(dag, column, state_rates) {
        return Err(Reason::Memory);
    }
    let symbols = dag.symbols(&[column]);
    if symbols.iter().any(|s| matches!(s, Symbol::RigidTorque(_))) {
        return Err(Reason::Load);
    }
    if !dag.is_affine(&[column], &|symbol| matches!(symbol, Symbol::Ddq(_))) {
        return Err(Reason::NotAffine);
    }
    let (mut momentum, mut drift) = (dag.zero(), dag.zero());
    for symbol in symbols {
        let Symbol::Ddq(joint) = symbol else {
            continue;
        };
        let coefficient = dag.derivative(column, symbol);
        let is_position = |s: Symbol| matches!(s, Symbol::Q(_) | Symbol::Time);
        let mut inside = dag.symbols(&[coefficient]).into_iter();
        if !inside.all(|s| is_position(s) || matches!(s, Symbol::Shape(_))) {
            return Err(Reason::Coefficient);
        }
        // A momentum that jumps has a rate that no drift takes away.
        if dag.may_jump(coefficient, &is_position) {
            return Err(Reason::Jump);
        }
        let dq = dag.symbol(Symbol::Dq(joint));
        let part = dag.mul(coefficient, dq);
        momentum = dag.add(momentum, part);
        let rate = rate(dag, coefficient, dof);
        let part = dag.mul(rate, dq);
        drift = dag.add(drift, part);
    }
    let zero = dag.zero();
    let still = |symbol| matches!(symbol, Symbol::Ddq(_)).then_some(zero);
    let rest = dag.substitute(&[column], &still)[0];
    Ok(Split {
        momentum,
        drift: dag.sub(drift, rest),
    })
}

/// Whether a state that the column reads, itself or through other states, has a rate that reads accelerations.
fn memory_follows_acceleration(dag: &Dag, column: ExprId, state_rates: &[ExprId]) -> bool {
    let mut seen = vec![false; state_rates.len()];
    let mut to_look_at = vec![(column, false)];
    while let Some((x, is_rate)) = to_look_at.pop() {
        for symbol in dag.symbols(&[x]) {
            match symbol {
                Symbol::State(k) if !std::mem::replace(&mut seen[k], true) => {
                    to_look_at.push((state_rates[k], true));
                }
                Symbol::Ddq(_) | Symbol::RigidTorque(_) if is_rate => return true,
                _ => {}
            }
        }
    }
    false
}

/// `dA/dt` of an expression of positions and time.
fn rate(dag: &mut Dag, x: ExprId, dof: usize) -> ExprId {
    let mut sum = dag.derivative(x, Symbol::Time);
    for joint in 0..dof {
        let slope = dag.derivative(x, Symbol::Q(joint));
        let dq = dag.symbol(Symbol::Dq(joint));
        let part = dag.mul(slope, dq);
        sum = dag.add(sum, part);
    }
    sum
}
