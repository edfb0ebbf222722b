//! What a controller believes of the arm: effects' states are at rest in it, and links where joints put them, springs stiff.

use robot_model::simulate::{Instant, InverseDynamics, Measured};

use super::{InterpretedPlant, of_links};

impl InverseDynamics for InterpretedPlant {
    fn inverse_dynamics(
        &mut self,
        measured: &Measured<'_>,
        ddq: &[f64],
        sliding: &[f64],
        torque: &mut [f64],
    ) {
        let memory = vec![0.0; self.states];
        let still = vec![0.0; self.joints];
        let at = Instant {
            time: measured.time,
            q: measured.q,
            dq: measured.dq,
            ddq,
            memory: &memory,
            switches: &[],
            torque: &still,
            inputs: measured.inputs,
        };
        let links = self.links.motion(&at);
        let load = self.rigid_torque(&of_links(&at, &links));
        let at = Instant { dq: sliding, ..at };
        let links = self.links.motion(&at);
        let switches = self.signs(&at, &of_links(&at, &links));
        let at = Instant {
            switches: &switches,
            ..at
        };
        let effects = self.effects.torque(&at, &load).torque;
        let forces = self.forces.as_mut();
        let forces = forces.map(|forces| forces.torque(&of_links(&at, &links), &load).torque);
        for (joint, torque) in torque.iter_mut().enumerate() {
            let force = forces.as_ref().map_or(0.0, |forces| forces[joint]);
            *torque = load[joint] + effects[joint] + force;
        }
    }
}
