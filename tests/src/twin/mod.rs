//! A numeric twin of every arm: the same physics from the same spec, with no line in common with the compiler.
//!
//! Everything is in the base frame: link motions go forward from the base, then the virtual work of every link's inertia
//! force and moment gives the joint torques (Kane's form). The compiler works in link frames and sums forces backward from
//! the tip. Both take the ten parameters about the link frame's origin.

mod acts;
mod energies;
pub mod jet;

use nalgebra::{DMatrix, Matrix3, Rotation3, Unit, Vector3};
use robot_model_spec::Model;
use robot_model_spec::model::{Act, Effect, JointKind, Transform};

use energies::EnergyTwin;

use crate::expression::{self, Scope};
use crate::states::State;

/// The twin of a model.
#[derive(Debug, Clone)]
pub struct Twin<'a> {
    model: &'a Model,
    shapes: Vec<f64>,
}

/// A link in the base frame.
struct LinkMotion {
    rotation: Matrix3<f64>,
    origin: Vector3<f64>,
    /// Angular velocity and acceleration.
    w: Vector3<f64>,
    dw: Vector3<f64>,
    /// Velocity and acceleration of the frame's origin.
    v: Vector3<f64>,
    dv: Vector3<f64>,
    /// The joint that moves it: unit vector of the axis, and a point on it.
    axis: Vector3<f64>,
    point: Vector3<f64>,
}

/// Mass, first moments and inertia of a link about its frame's origin, in the base frame.
struct Body {
    mass: f64,
    moments: Vector3<f64>,
    inertia: Matrix3<f64>,
}

impl Body {
    fn new(p: &[f64], rotation: &Matrix3<f64>) -> Self {
        let inertia = Matrix3::new(p[4], p[5], p[6], p[5], p[7], p[8], p[6], p[8], p[9]);
        Self {
            mass: p[0],
            moments: rotation * Vector3::new(p[1], p[2], p[3]),
            inertia: rotation * inertia * rotation.transpose(),
        }
    }
}

fn matrix(transform: &Transform) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| transform.rotation[i][j])
}

impl<'a> Twin<'a> {
    /// `shapes` are the values of all shape parameters of the declared effects.
    #[must_use]
    pub fn new(model: &'a Model, shapes: Vec<f64>) -> Self {
        Self { model, shapes }
    }

    fn links(&self, state: &State) -> Vec<LinkMotion> {
        let state = &self.placed(state);
        let mut links: Vec<LinkMotion> = Vec::new();
        let zero = Vector3::zeros();
        let chain = self.model.chain().expect("the twin is of a chain");
        for (j, joint) in self.model.joints.iter().enumerate() {
            let (rotation, origin, w, dw, v, dv) = links.last().map_or(
                (Matrix3::identity(), zero, zero, zero, zero, zero),
                |link| (link.rotation, link.origin, link.w, link.dw, link.v, link.dv),
            );
            let placement = &chain.links[j].placement;
            let before = rotation * matrix(&placement.before);
            let point = origin + rotation * Vector3::from(placement.before.translation);
            let own_axis = Vector3::from(placement.axis);
            let axis = before * own_axis;
            let (q, dq, ddq) = (state.q[j] + placement.offset, state.dq[j], state.ddq[j]);
            let after = Vector3::from(placement.after.translation);
            // The joint's own motion: turn, slide, and what they add to the rates.
            let (turn, slide, spin, dspin, slip, dslip) = match joint.kind {
                JointKind::Revolute => {
                    let turn = Rotation3::from_axis_angle(&Unit::new_normalize(own_axis), q);
                    let dspin = axis * ddq + w.cross(&axis) * dq;
                    (*turn.matrix(), zero, axis * dq, dspin, zero, zero)
                }
                JointKind::Prismatic => {
                    let dslip = axis * ddq + 2.0 * w.cross(&axis) * dq;
                    (Matrix3::identity(), axis * q, zero, zero, axis * dq, dslip)
                }
            };
            // From the parent's origin to the joint, rigid with the parent; from there to the link's origin, rigid with the link.
            let arm = point + slide - origin;
            let reach = before * turn * after;
            let (next_w, next_dw) = (w + spin, dw + dspin);
            links.push(LinkMotion {
                rotation: before * turn * matrix(&placement.after),
                origin: point + slide + reach,
                w: next_w,
                dw: next_dw,
                v: v + w.cross(&arm) + slip + next_w.cross(&reach),
                dv: dv
                    + dw.cross(&arm)
                    + w.cross(&w.cross(&arm))
                    + dslip
                    + next_dw.cross(&reach)
                    + next_w.cross(&next_w.cross(&reach)),
                axis,
                point,
            });
        }
        links
    }

    /// Velocity of link `i`'s origin and its angular velocity per unit speed of joint `j <= i`.
    fn partial(&self, links: &[LinkMotion], i: usize, j: usize) -> (Vector3<f64>, Vector3<f64>) {
        let LinkMotion { axis, point, .. } = &links[j];
        match self.model.joints[j].kind {
            JointKind::Revolute => (axis.cross(&(links[i].origin - point)), *axis),
            JointKind::Prismatic => (*axis, Vector3::zeros()),
        }
    }

    /// `M ddq + C dq + G` by virtual work.
    #[must_use]
    pub fn rigid_torque(&self, standard: &[f64], state: &State) -> Vec<f64> {
        if let Some(energies) = self.model.energies() {
            return EnergyTwin::new(energies).torque(standard, &self.placed(state));
        }
        let links = self.links(state);
        let (gravity, standard) = (self.gravity(state), self.loaded(standard, state));
        let mut torque = vec![0.0; links.len()];
        for (i, link) in links.iter().enumerate() {
            let body = Body::new(&standard[10 * i..10 * i + 10], &link.rotation);
            let (w, dw, c) = (&link.w, &link.dw, &body.moments);
            let fall = link.dv - gravity;
            let force = body.mass * fall + dw.cross(c) + w.cross(&w.cross(c));
            let moment = body.inertia * dw + w.cross(&(body.inertia * w)) + c.cross(&fall);
            for j in 0..=i {
                let (v, w) = self.partial(&links, i, j);
                torque[j] += v.dot(&force) + w.dot(&moment);
            }
        }
        torque
    }

    /// Torque of the declared effects, from their definitions as written.
    #[must_use]
    pub fn effect_torque(&self, standard: &[f64], state: &State) -> Vec<f64> {
        let rigid = self.rigid_torque(standard, state);
        let mut torque = vec![0.0; rigid.len()];
        self.each_effect(standard, state, &rigid, |effect, scope| {
            for equation in &effect.definition.torques {
                torque[effect.joints[equation.joint]] += expression::value(&equation.value, scope);
            }
            for act in &effect.definition.acts {
                if let Act::Force { joint, components } = act {
                    let force = Vector3::from_fn(|k, _| expression::value(&components[k], scope));
                    self.hold(&mut torque, effect.joints[*joint], &force, state);
                }
            }
        });
        torque
    }

    /// The torques that hold a force on a link: by virtual work the power of the force is taken by the motors.
    fn hold(&self, torque: &mut [f64], link: usize, force: &Vector3<f64>, state: &State) {
        let links = self.links(state);
        for (j, torque) in torque.iter_mut().enumerate().take(link + 1) {
            *torque -= self.partial(&links, link, j).0.dot(force);
        }
    }

    /// Every declared effect with what its names stand for.
    fn each_effect(
        &self,
        standard: &[f64],
        state: &State,
        rigid: &[f64],
        mut visit: impl FnMut(&Effect, &Scope<'_>),
    ) {
        let (mut linear, mut shape, mut first_state) = (self.model.rigid_parameters(), 0, 0);
        let columns = self.model.inputs();
        for effect in &self.model.effects {
            let definition = &effect.definition;
            let inputs = definition.inputs.iter().map(|input| {
                let column = input.column(&effect.joints);
                let place = columns.iter().position(|other| *other == column);
                state.inputs[place.expect("the model lists all inputs")]
            });
            let inputs: Vec<f64> = inputs.collect();
            let scope = Scope {
                linear: &standard[linear..linear + definition.linear.len()],
                shapes: &self.shapes[shape..shape + definition.shapes.len()],
                joints: &effect.joints,
                signals: [
                    &state.q,
                    &state.dq,
                    &state.ddq,
                    rigid,
                    &state.measured_torque,
                ],
                inputs: &inputs,
                states: &state.states[first_state..],
                bindings: &definition.bindings,
                time: state.time,
            };
            visit(effect, &scope);
            linear += definition.linear.len();
            shape += definition.shapes.len();
            first_state += definition.states.len();
        }
    }

    /// `rigid_torque + effect_torque`
    #[must_use]
    pub fn inverse_dynamics(&self, standard: &[f64], state: &State) -> Vec<f64> {
        let rigid = self.rigid_torque(standard, state);
        let effects = self.effect_torque(standard, state);
        rigid.iter().zip(effects).map(|(r, e)| r + e).collect()
    }

    /// `M`, the Hessian of the kinetic energy in `dq`: `sum_i J_i^T I_i J_i`.
    #[must_use]
    pub fn mass_matrix(&self, standard: &[f64], state: &State) -> DMatrix<f64> {
        if let Some(energies) = self.model.energies() {
            return EnergyTwin::new(energies).mass_matrix(standard, &self.placed(state));
        }
        let (links, standard) = (self.links(state), self.loaded(standard, state));
        let mut mass_matrix = DMatrix::zeros(links.len(), links.len());
        for (i, link) in links.iter().enumerate() {
            let body = Body::new(&standard[10 * i..10 * i + 10], &link.rotation);
            for j in 0..=i {
                for k in 0..=i {
                    let ((v, w), (v2, w2)) =
                        (self.partial(&links, i, j), self.partial(&links, i, k));
                    let c = &body.moments;
                    mass_matrix[(j, k)] += body.mass * v.dot(&v2)
                        + v.dot(&w2.cross(c))
                        + v2.dot(&w.cross(c))
                        + w.dot(&(body.inertia * w2));
                }
            }
        }
        mass_matrix
    }

    /// Potential energy of gravity, J: `V = -sum_i g . (m_i p_i + R_i c_i)`.
    #[must_use]
    pub fn potential_energy(&self, standard: &[f64], state: &State) -> f64 {
        if let Some(energies) = self.model.energies() {
            return EnergyTwin::new(energies).potential_energy(standard, &self.placed(state));
        }
        let (gravity, standard) = (self.gravity(state), self.loaded(standard, state));
        let links = self.links(state);
        let energy = |(i, link): (usize, &LinkMotion)| {
            let body = Body::new(&standard[10 * i..10 * i + 10], &link.rotation);
            -gravity.dot(&(body.mass * link.origin + body.moments))
        };
        links.iter().enumerate().map(energy).sum()
    }
}
