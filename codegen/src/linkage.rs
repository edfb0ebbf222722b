//! Where links stand against their joints, as a simulation wants it.
//!
//! A spec says `position(j) = d(..)`: the link of joint `j` is at `q_j + d`. Where `d` reads positions, time and channels alone, as behind
//! an encoder with an error, the link is where its joint puts it, and its motion follows from that of the joints. Else the link has a
//! place of its own, and its joint a spring: what that carries is the load at which the link is displaced as it is.

use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Symbol};
use crate::interpreter::Program;
use crate::plant::jacobian;

/// Links that are not where their joints are; `n` joints, `p` internal states.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Linkage {
    /// Joints with a spring, `s` of them, ascending.
    pub springs: Vec<usize>,
    /// Which of them follow more than their own load, positions, time and channels, and may take energy from that.
    pub led: Vec<bool>,
    /// `d` of springs and its slopes by the load of their joints, `2 s` outputs.
    pub give: Program,
    /// Slopes of `d` of springs by `q`, `dq`, `ddq`, loads of all joints and `z`: four times `s n` outputs and `s p`.
    pub give_slopes: Program,
    /// Whether springs follow loads of other springs.
    pub is_coupled: bool,
    /// How springs follow accelerations.
    pub driven: Driven,
    /// Joints that place their links, `k` of them, ascending.
    pub placed: Vec<usize>,
    /// `d`, `dd/dt` and `d^2 d/dt^2` of those: `3 k` outputs. Channels are taken to change slowly.
    pub place: Program,
    /// Slopes: `d` by `q`, `dd/dt` by `q`, and `d^2 d/dt^2` by `q` and by `dq`; `k n` outputs each.
    pub place_slopes: Program,
    /// Whether a link's place depends on time or on channels.
    pub is_timed: bool,
}

/// How springs follow accelerations, or loads of joints without a spring, which do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Driven {
    /// Not at all.
    Not,
    /// What they carry is affine in accelerations.
    Affinely,
    /// It is bent.
    Otherwise,
}

/// Whether a link is where its joint puts it, by a displacement that reads these.
fn is_place(reads: &[Symbol]) -> bool {
    reads.iter().all(|symbol| match symbol {
        Symbol::Dq(_)
        | Symbol::Ddq(_)
        | Symbol::RigidTorque(_)
        | Symbol::MeasuredTorque(_)
        | Symbol::State(_)
        | Symbol::Switch(_) => false,
        Symbol::Q(_)
        | Symbol::Time
        | Symbol::Input(_)
        | Symbol::Parameter(_)
        | Symbol::Shape(_)
        | Symbol::Weight(_) => true,
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
        let (placed, springs): (Vec<_>, Vec<_>) =
            displacements.partition(|&(_, value)| is_place(&dag.symbols(&[value])));
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
    #[must_use]
    pub fn linkage(&self) -> Linkage {
        let LinkEquations {
            mut dag,
            springs,
            gives,
            placed,
            places: [places, first, second],
        } = self.link_equations();
        let (mut is_coupled, mut is_driven, mut led) = (false, false, Vec::new());
        for (&joint, &give) in springs.iter().zip(&gives) {
            let mut reads = dag.symbols(&[give]);
            reads.retain(|symbol| *symbol != Symbol::RigidTorque(joint));
            led.push(!is_place(&reads));
            for symbol in reads {
                match symbol {
                    Symbol::RigidTorque(other) if springs.contains(&other) => is_coupled = true,
                    Symbol::Ddq(_) | Symbol::RigidTorque(_) => is_driven = true,
                    _ => {}
                }
            }
        }
        let is_affine = |symbol| matches!(symbol, Symbol::Ddq(_) | Symbol::RigidTorque(_));
        let driven = match is_driven {
            false => Driven::Not,
            true if dag.is_affine(&gives, &is_affine) => Driven::Affinely,
            true => Driven::Otherwise,
        };
        let by_load = springs.iter().zip(&gives);
        let by_load: Vec<ExprId> = by_load
            .map(|(&joint, &give)| dag.derivative(give, Symbol::RigidTorque(joint)))
            .collect();
        let (dof, states) = (self.dof(), self.dynamics.state_rates.len());
        let give_slopes = [
            jacobian(&mut dag, &gives, dof, Symbol::Q),
            jacobian(&mut dag, &gives, dof, Symbol::Dq),
            jacobian(&mut dag, &gives, dof, Symbol::Ddq),
            jacobian(&mut dag, &gives, dof, Symbol::RigidTorque),
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
        Linkage {
            give: Program::new(&dag, &[&gives[..], &by_load].concat()),
            give_slopes: Program::new(&dag, &give_slopes.concat()),
            place: Program::new(&dag, &[places, first, second].concat()),
            place_slopes: Program::new(&dag, &place_slopes.concat()),
            is_timed: all.iter().any(is_timed),
            is_coupled,
            driven,
            led,
            springs,
            placed,
        }
    }
}
