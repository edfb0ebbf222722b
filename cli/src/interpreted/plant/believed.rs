//! What a controller believes of the arm: effects' states are at rest in it, and links where their motors are.

use robot_model::simulate::{Instant, InverseDynamics, Measured};

use super::InterpretedPlant;

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
        let load = self.rigid_torque(&at);
        let at = Instant { dq: sliding, ..at };
        let switches = self.signs(&at);
        let at = Instant {
            switches: &switches,
            ..at
        };
        torque.copy_from_slice(&load);
        for share in self.shares() {
            let found = share.torque(&at, &load);
            for (torque, more) in torque.iter_mut().zip(&found.torque) {
                *torque += more;
            }
        }
    }
}
