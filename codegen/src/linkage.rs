//! Where links stand against their joints, as a simulation wants it.
//!
//! A spec says `position(j) = d(..)`: the link of joint `j` is at `q_j + d`. Where `d` follows the load of its own joint that is a
//! spring: the link has a place of its own, and the load is what the spring carries there. Else the link is where its joint puts it,
//! as behind an encoder with an error, and its motion follows from that of the joints.

use std::fmt;

use robot_model_spec::model::Model;

use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Symbol};
use crate::interpreter::Program;
use crate::plant::jacobian;

/// Links that are not where their joints are; `n` joints, `p` internal states.
#[derive(Debug, Clone)]
pub struct Linkage {
    /// Joints with a spring, `s` of them, ascending.
    pub springs: Vec<usize>,
    /// `d` of springs and its slopes by the load of their joints, `2 s` outputs.
    pub give: Program,
    /// Other slopes of springs, by `q`, `dq` and `z`: `s n`, `s n` and `s p` outputs.
    pub give_slopes: Program,
    /// Joints that place their links, `k` of them, ascending.
    pub placed: Vec<usize>,
    /// `d`, `dd/dt` and `d^2 d/dt^2` of those: `3 k` outputs. Channels are taken to change slowly.
    pub place: Program,
    /// Slopes: `d` by `q`, `dd/dt` by `q`, and `d^2 d/dt^2` by `q` and by `dq`; `k n` outputs each.
    pub place_slopes: Program,
    /// Whether a link's place depends on time or on channels.
    pub is_timed: bool,
}

/// A displacement from which no motion follows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NoMotion {
    joint: String,
    follows: &'static str,
}

impl fmt::Display for NoMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { joint, follows } = self;
        write!(
            f,
            "joint {joint}: its link is displaced by {follows}; links move behind springs, whose `position(j)` follows \
             `rigid_torque(j)`, or where positions, time and channels put them; another displacement can be identified, not \
             simulated"
        )
    }
}

impl std::error::Error for NoMotion {}

/// What a displacement reads that no motion follows from.
fn unfit(model: &Model, joint: usize, reads: &[Symbol]) -> Option<NoMotion> {
    let is_spring = reads.contains(&Symbol::RigidTorque(joint));
    let unfit = |symbol: &Symbol| match symbol {
        Symbol::RigidTorque(other) if *other != joint => Some("the load of another joint"),
        Symbol::Ddq(_) => Some("an acceleration"),
        Symbol::Dq(_) if !is_spring => Some("a velocity"),
        Symbol::State(_) if !is_spring => Some("an internal state"),
        Symbol::MeasuredTorque(_) if !is_spring => Some("a motor's torque"),
        _ => None,
    };
    let follows = reads.iter().find_map(unfit)?;
    Some(NoMotion {
        joint: model.joints[joint].name.clone(),
        follows,
    })
}

/// How fast expressions of positions, velocities and time change along a motion.
fn rates(dag: &mut Dag, values: &[ExprId], dof: usize) -> Vec<ExprId> {
    let rate = |&value: &ExprId| {
        let mut terms = vec![dag.derivative(value, Symbol::Time)];
        for joint in 0..dof {
            for (by, rate) in [
                (Symbol::Q(joint), Symbol::Dq(joint)),
                (Symbol::Dq(joint), Symbol::Ddq(joint)),
            ] {
                let (slope, rate) = (dag.derivative(value, by), dag.symbol(rate));
                terms.push(dag.mul(slope, rate));
            }
        }
        dag.sum(terms)
    };
    values.iter().map(rate).collect()
}

/// Displacements as expressions.
pub(crate) struct LinkEquations {
    pub dag: Dag,
    springs: Vec<usize>,
    /// Of springs.
    pub gives: Vec<ExprId>,
    placed: Vec<usize>,
    /// Of links that joints place, with first and second rates.
    pub places: [Vec<ExprId>; 3],
}

impl Compiled {
    pub(crate) fn link_equations(&self) -> LinkEquations {
        let mut dag = self.dag.clone();
        let dof = self.dof();
        let displacements = self.measurement(&mut dag).displacements.into_iter();
        let (springs, placed): (Vec<_>, Vec<_>) = displacements.partition(|&(joint, value)| {
            dag.symbols(&[value]).contains(&Symbol::RigidTorque(joint))
        });
        let (springs, gives) = springs.into_iter().unzip();
        let (placed, places): (Vec<usize>, Vec<ExprId>) = placed.into_iter().unzip();
        let first = rates(&mut dag, &places, dof);
        let second = rates(&mut dag, &first, dof);
        LinkEquations {
            dag,
            springs,
            gives,
            placed,
            places: [places, first, second],
        }
    }

    /// Where links stand against their joints.
    ///
    /// # Errors
    /// [`NoMotion`] where a displacement follows an acceleration or the load of another joint; where it follows a velocity, an
    /// internal state or a motor's torque and not the load.
    pub fn linkage(&self) -> Result<Linkage, NoMotion> {
        let LinkEquations {
            mut dag,
            springs,
            gives,
            placed,
            places: [places, first, second],
        } = self.link_equations();
        let joints = springs.iter().zip(&gives).chain(placed.iter().zip(&places));
        for (&joint, &value) in joints {
            if let Some(error) = unfit(&self.model, joint, &dag.symbols(&[value])) {
                return Err(error);
            }
        }
        let by_load = springs.iter().zip(&gives);
        let by_load: Vec<ExprId> = by_load
            .map(|(&joint, &give)| dag.derivative(give, Symbol::RigidTorque(joint)))
            .collect();
        let (dof, states) = (self.dof(), self.dynamics.state_rates.len());
        let give_slopes = [
            jacobian(&mut dag, &gives, dof, Symbol::Q),
            jacobian(&mut dag, &gives, dof, Symbol::Dq),
            jacobian(&mut dag, &gives, states, Symbol::State),
        ];
        let place_slopes = [
            jacobian(&mut dag, &places, dof, Symbol::Q),
            jacobian(&mut dag, &first, dof, Symbol::Q),
            jacobian(&mut dag, &second, dof, Symbol::Q),
            jacobian(&mut dag, &second, dof, Symbol::Dq),
        ];
        let all = dag.symbols(&[&gives[..], &places].concat());
        let is_timed = |symbol: &Symbol| matches!(symbol, Symbol::Time | Symbol::Input(_));
        Ok(Linkage {
            give: Program::new(&dag, &[&gives[..], &by_load].concat()),
            give_slopes: Program::new(&dag, &give_slopes.concat()),
            place: Program::new(&dag, &[places, first, second].concat()),
            place_slopes: Program::new(&dag, &place_slopes.concat()),
            is_timed: all.iter().any(is_timed),
            springs,
            placed,
        })
    }
}
