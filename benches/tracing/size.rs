//! How much of an effect makes the torque that is wanted of it.

use robot_model::columns::Arm as _;
use robot_model::identify::torque_of;
use robot_model::motion::Motion;
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::compile_model;
use robot_model_spec::load;

use crate::catalogue::Place;
use crate::experiment::{Case, rms, said};
use crate::motion::Waves;

/// Rate at which sizes are found, Hz.
const SIZE_HZ: f64 = 100.0;

impl Case {
    /// How much of it adds the wanted share to the torque of its joint along a motion.
    pub(crate) fn size(
        &self,
        declared: &str,
        joints: &[usize],
        waves: &Waves,
    ) -> Result<Option<f64>, String> {
        if self.injection.place == Place::Nowhere {
            return Ok(Some(0.0));
        }
        let base = arm(self.arm.name, &self.declared(joints, false)?)?;
        // What is declared and what it stands for is part of the torque that it is measured by.
        let mut motion = waves.exact(SIZE_HZ);
        let without = self.torque(&base, &mut motion, 0.0, &[]);
        let reference = match self.injection.replaces {
            Some(effect) if effect != self.injection.effect() => {
                self.torque(&arm(self.arm.name, declared)?, &mut motion, 0.0, &[])
            }
            _ => without.clone(),
        };
        motion.tau.clone_from(&without);
        let share = |with: &[Vec<f64>]| {
            let of = |joint: &usize| {
                let change = with[*joint]
                    .iter()
                    .zip(&reference[*joint])
                    .map(|(a, b)| a - b);
                rms(change) / rms(without[*joint].iter().copied())
            };
            let all: Vec<usize> = (0..without.len()).collect();
            let here = if self.injection.place == Place::Joint {
                joints
            } else {
                &all
            };
            here.iter().map(of).fold(0.0, f64::max)
        };
        if self.injection.kind == "corrupt-samples" {
            return Ok(Some(self.share));
        }
        let with: Box<dyn Fn(f64) -> Vec<Vec<f64>>> = match self.injection.kind {
            "time-delay" => {
                let without = &without;
                Box::new(move |seconds| {
                    without
                        .iter()
                        .map(|tau| late(tau, seconds * SIZE_HZ))
                        .collect()
                })
            }
            "torque-saturation" => {
                let (without, joint) = (&without, joints[0]);
                Box::new(move |size: f64| {
                    let mut with = without.clone();
                    for tau in &mut with[joint] {
                        *tau = tau.clamp(-1.0 / size, 1.0 / size);
                    }
                    with
                })
            }
            _ => {
                let machine = arm(
                    self.arm.name,
                    &self.machine(joints, 1.0, !self.injection.scaled.is_empty())?,
                )?;
                let injection = self.injection;
                Box::new(move |size| {
                    let mut motion = motion.clone();
                    let shapes: Vec<f64> =
                        injection.scaled.iter().map(|(_, of)| of(size)).collect();
                    self.torque(&machine, &mut motion, size, &shapes)
                })
            }
        };
        Ok(root(self.injection.part * self.share, &|size| {
            share(&with(size))
        }))
    }

    /// The machine's torque along an exact motion.
    fn torque(
        &self,
        arm: &InterpretedArm,
        motion: &mut Motion,
        size: f64,
        shapes: &[f64],
    ) -> Vec<Vec<f64>> {
        let beta = arm
            .compiled()
            .base
            .beta(&self.standard(arm.compiled(), size));
        motion.rigid_torque = arm.rigid_torque(motion, shapes, &beta);
        motion.transmitted_torque = arm.transmitted_torque(motion, shapes, &beta);
        let mut torque = torque_of(arm, motion, shapes, &beta, arm.dof());
        for (torque, known) in torque.iter_mut().zip(arm.known_torque(motion, shapes)) {
            for (torque, known) in torque.iter_mut().zip(known) {
                *torque += known;
            }
        }
        torque
    }
}

fn arm(name: &str, text: &str) -> Result<InterpretedArm, String> {
    let model = load(name, text).map_err(said)?;
    Ok(InterpretedArm::new(compile_model(&model)))
}

/// Values `samples` later.
fn late(values: &[f64], samples: f64) -> Vec<f64> {
    let at = |k: usize| {
        let place = (k as f64 - samples).clamp(0.0, (values.len() - 1) as f64);
        let before = (0..values.len())
            .take_while(|&i| i as f64 <= place)
            .last()
            .unwrap_or(0);
        let after = (before + 1).min(values.len() - 1);
        let part = place - before as f64;
        values[before] * (1.0 - part) + values[after] * part
    };
    (0..values.len()).map(at).collect()
}

/// Where a function that rises reaches a value; `None` where it does not.
fn root(wanted: f64, of: &dyn Fn(f64) -> f64) -> Option<f64> {
    const FACTOR: f64 = 4.0;
    let mut low = 1e-6;
    let mut high = low;
    while of(high) < wanted {
        low = high;
        high *= FACTOR;
        if high > 1e6 {
            return None;
        }
    }
    for _ in 0..20 {
        let middle = (low * high).sqrt();
        if of(middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(high)
}
