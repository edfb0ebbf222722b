//! Recursive Newton-Euler with few operations, on a serial chain.
//!
//! In: a [`Chain`]. Out: the torque of every joint, as of [`Chain::torque`]. The equations are the same; how they are written is
//! chosen by the number of operations ([`search`]):
//!
//! - the axis of a revolute joint is fixed in the link and in its parent, so a column of `U` is turned over from the parent
//!   ([`motion`]);
//! - bodies are written with their inertia or with second moments ([`body`]);
//! - origins are moved along axes, so that forces at joints that intersect are not needed;
//! - the last link, and one before a parallel axis, may be written in axes that do not turn with its joint: then its few
//!   parameters turn instead of all motions and wrenches;
//! - lengths are measured in one of the arm's own;
//! - a mass is lent from link to link, so that a first moment vanishes.

mod body;
mod motion;
mod search;

use robot_model_spec::model::JointKind;

use super::chain::Chain;
use super::frame::{Frame, multiply};
use super::inertia::Turn;
use super::rigid::Terms;
use super::vector::{self, Vector};
use crate::expr::{Dag, ExprId};
pub use body::{Body, Form};
pub use motion::Motion;
pub use search::{Choice, Wanted};

/// A chain as it is computed with.
#[derive(Clone)]
pub struct LeanChain {
    pub(super) frames: Vec<Frame>,
    bodies: Vec<Body>,
    /// Acceleration of gravity in the base frame.
    gravity: Vector,
    is_in_meters: bool,
}

impl LeanChain {
    /// The chain, written as chosen.
    pub fn new(dag: &mut Dag, chain: &Chain, choice: &Choice) -> Self {
        let links = chain.links.iter().zip(&chain.frames).zip(&choice.forms);
        let bodies = links
            .map(|((link, frame), &form)| {
                let along = frame.main_axis(dag).map_or(2, |axis| axis.link);
                Body::new(dag, link, form, along)
            })
            .collect();
        let mut lean = Self {
            frames: chain.frames.clone(),
            bodies,
            gravity: chain.gravity,
            is_in_meters: true,
        };
        lean.hand_over(dag);
        lean.move_origins(dag, &choice.origins);
        lean.lend(dag, &choice.lent);
        lean.measure_in(dag, choice.unit);
        for (link, &turned) in choice.turned.iter().enumerate() {
            if turned {
                lean.turn(dag, link);
            }
        }
        lean
    }

    /// The chain again, for derivations that know no second moments.
    pub fn into_chain(self) -> Chain {
        let links = self.bodies.iter().map(Body::parameters).collect();
        Chain {
            frames: self.frames,
            links,
            gravity: self.gravity,
        }
    }

    /// A dumbbell along a joint's axis moves with the parent as well as with the link: where it is one of the second moments
    /// that are written, it goes to the parent, and the base does not feel it.
    fn hand_over(&mut self, dag: &mut Dag) {
        for link in (0..self.frames.len()).rev() {
            let Some(axis) = self.frames[link].main_axis(dag) else {
                continue;
            };
            if self.bodies[link].form == Form::Inertia {
                continue;
            }
            let along = &mut self.bodies[link].second[axis.link][axis.link];
            let dumbbell = std::mem::replace(along, dag.zero());
            if link > 0 {
                self.bodies[link - 1].add_dumbbell(dag, axis.parent, dumbbell);
            }
        }
    }

    /// Lends a mass to each link behind a revolute joint, at its joint point, from its parent: one on the joint's axis moves with
    /// both. What lies on the axes after that goes back down.
    fn lend(&mut self, dag: &mut Dag, masses: &[f64]) {
        if masses.iter().all(|&mass| mass == 0.0) {
            return;
        }
        for (link, &mass) in masses.iter().enumerate() {
            if self.frames[link].kind != JointKind::Revolute {
                continue;
            }
            let back = self.frames[link].to_origin.map(|x| dag.neg(x));
            let joint = self.frames[link].joint_point;
            let (given, taken) = (dag.constant(mass), dag.constant(-mass));
            self.bodies[link].add_mass(dag, given, back);
            if link > 0 {
                self.bodies[link - 1].add_mass(dag, taken, joint);
            }
        }
        for link in (0..self.frames.len()).rev() {
            let frame = &self.frames[link];
            let (axis, joint) = (frame.main_axis(dag), frame.joint_point);
            let on_axis = frame.to_origin.iter().all(|&x| dag.is_zero(x));
            let Some(axis) = axis.filter(|_| on_axis) else {
                continue;
            };
            let zero = dag.zero();
            let along = std::mem::replace(&mut self.bodies[link].first[axis.link], zero);
            if link > 0 {
                let mut moment = [zero; 3];
                moment[axis.parent] = dag.scale(axis.turned, along);
                self.bodies[link - 1].add_dipole(dag, moment, joint);
            } else {
                self.bodies[link].mass = zero;
            }
        }
        self.hand_over(dag);
    }

    /// Moves the origin of each link's frame by a vector in link coordinates.
    fn move_origins(&mut self, dag: &mut Dag, shifts: &[[f64; 3]]) {
        for (link, shift) in shifts.iter().enumerate() {
            if shift.iter().any(|&x| x != 0.0) {
                let shift = vector::constant(dag, *shift);
                self.move_origin(dag, link, shift);
            }
        }
    }

    fn move_origin(&mut self, dag: &mut Dag, link: usize, shift: Vector) {
        let back = shift.map(|x| dag.neg(x));
        let frame = &mut self.frames[link];
        frame.to_origin = vector::add(dag, frame.to_origin, shift);
        if let Some(outer) = self.frames.get_mut(link + 1) {
            outer.joint_point = vector::add(dag, outer.joint_point, back);
        }
        self.bodies[link] = self.bodies[link].seen_from(dag, back);
        self.straighten(dag, link);
    }

    /// Any point of a joint's axis is a joint point: the one next to the link's origin leaves least to go.
    fn straighten(&mut self, dag: &mut Dag, link: usize) {
        let frame = &mut self.frames[link];
        let Some(axis) = frame.main_axis(dag) else {
            return;
        };
        let along = std::mem::replace(&mut frame.to_origin[axis.link], dag.zero());
        let in_parent = dag.scale(axis.turned, along);
        let joint = &mut frame.joint_point[axis.parent];
        *joint = dag.add(*joint, in_parent);
    }

    /// Where a joint point is off the parent's origin by no more than a way along its axis, it moves there: then the parent
    /// needs the moment alone.
    pub fn slide_joint_points(&mut self, dag: &mut Dag) {
        // The base does not turn.
        for frame in self.frames.iter_mut().skip(1) {
            let Some(axis) = frame.main_axis(dag) else {
                continue;
            };
            let others = (0..3).filter(|&k| k != axis.parent);
            if others.map(|k| frame.joint_point[k]).all(|x| dag.is_zero(x)) {
                let along = std::mem::replace(&mut frame.joint_point[axis.parent], dag.zero());
                let in_link = dag.scale(axis.turned, along);
                let to_origin = &mut frame.to_origin[axis.link];
                *to_origin = dag.add(*to_origin, in_link);
            }
        }
    }

    /// Lengths in multiples of `unit` meters, masses so that energies and the torques of revolute joints stay as they are: a
    /// length that is the unit is no factor. Chains with prismatic joints keep their unit.
    fn measure_in(&mut self, dag: &mut Dag, unit: f64) {
        let is_revolute = |frame: &Frame| frame.kind == JointKind::Revolute;
        if unit.to_bits() == 1.0f64.to_bits() || !self.frames.iter().all(is_revolute) {
            return;
        }
        self.is_in_meters = false;
        let mut shorter = |v: Vector| v.map(|x| dag.scale(unit.recip(), x));
        self.gravity = shorter(self.gravity);
        for frame in &mut self.frames {
            frame.joint_point = shorter(frame.joint_point);
            frame.to_origin = shorter(frame.to_origin);
        }
        for body in &mut self.bodies {
            body.mass = dag.scale(unit * unit, body.mass);
            body.first = body.first.map(|x| dag.scale(unit, x));
        }
    }

    /// Writes a link in axes that do not turn with its joint: its few parameters are turned instead of all that passes it. The
    /// next joint, if there is one, has to have a parallel axis, so that both turn as one.
    fn turn(&mut self, dag: &mut Dag, link: usize) {
        let Some(own) = self.frames[link].main_axis(dag) else {
            return;
        };
        if let Some(next) = self.frames.get(link + 1) {
            let parallel = next
                .main_axis(dag)
                .is_some_and(|next| next.parent == own.link);
            if !parallel {
                return;
            }
        }
        let Some(turn) = Turn::of(dag, &self.frames[link].rotation) else {
            return;
        };
        let back = self.frames[link].to_origin.map(|x| dag.neg(x));
        self.move_origin(dag, link, back);
        let rotation = self.frames[link].rotation;
        self.bodies[link] = self.bodies[link].turned(dag, &rotation, &turn);
        if let Some(next) = self.frames.get_mut(link + 1) {
            next.joint_point = vector::apply(dag, &rotation, next.joint_point);
            next.axis_in_parent = vector::apply(dag, &rotation, next.axis_in_parent);
            next.rotation = multiply(dag, &rotation, &next.rotation);
        }
        let frame = &mut self.frames[link];
        frame.axis = frame.axis_in_parent;
        let (zero, one) = (dag.zero(), dag.constant(1.0));
        let unit = |i, j| if i == j { one } else { zero };
        frame.rotation = std::array::from_fn(|i| std::array::from_fn(|j| unit(i, j)));
    }

    /// Torque of every joint, N m or N.
    pub fn torque(&self, dag: &mut Dag, terms: Terms) -> Vec<ExprId> {
        let motions = self.forward(dag, terms);
        let mut torque = Vec::with_capacity(motions.len());
        let mut carried = (vector::zero(dag), vector::zero(dag));
        for (index, motion) in motions.iter().enumerate().rev() {
            let (own_force, own_moment) = motion.wrench(dag, &self.bodies[index]);
            let force = vector::add(dag, own_force, carried.0);
            let moment = vector::add(dag, own_moment, carried.1);
            // Other axes than the link's have no names, and parts of a motion would take those of the whole. Wrenches have none
            // either: they are those of the bodies that base parameters describe.
            if terms == Terms::All && !self.frames[index].is_turned_back(dag) {
                motion.label(dag, index, self.is_in_meters);
            }
            let along_joint;
            (along_joint, carried) = self.frames[index].transmit(dag, (force, moment));
            torque.push(along_joint);
        }
        torque.reverse();
        torque
    }

    /// Motion of every link.
    pub fn forward(&self, dag: &mut Dag, terms: Terms) -> Vec<Motion> {
        let up = if terms.gravity() {
            self.gravity.map(|g| dag.neg(g))
        } else {
            vector::zero(dag)
        };
        let (dq, ddq) = terms.rates(dag, self.frames.len());
        let base = Motion::of_base(dag, up);
        let mut motions: Vec<Motion> = Vec::with_capacity(self.frames.len());
        for (index, frame) in self.frames.iter().enumerate() {
            let parent = motions.last().unwrap_or(&base);
            let next = self.frames.get(index + 1);
            let asked = next.is_some_and(|next| {
                let axes = (frame.main_axis(dag), next.main_axis(dag));
                !matches!(axes, (Some(own), Some(next)) if own.link == next.parent)
            });
            motions.push(parent.outward(dag, frame, (dq[index], ddq[index]), asked));
        }
        motions
    }
}
