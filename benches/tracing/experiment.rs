//! One experiment: an arm with something in it that its spec does not declare, in closed loop, and its two logs.

use std::fmt::Display;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use robot_model::log::{Log, MOTION_PHASE};
use robot_model::simulate::{ComputedTorque, Gains, Loop, Sensors};
use robot_model_cli::interpreted::InterpretedPlant;
use robot_model_codegen::base::shape_values;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::amend::{Amendment, amend};
use robot_model_spec::load;
use robot_model_spec::parameter::Status;

use crate::arms::{Arm, DECLARED};
use crate::catalogue::{ALL, Injection, Place};
use crate::draw::{Draw, place};
use crate::motion::{CHANNELS, Waves};

/// Lengths of the logs, s, and their rate, Hz.
pub(crate) const SECONDS: [f64; 2] = [20.0, 15.0];
pub(crate) const RATE_HZ: f64 = 500.0;

/// Share of samples that are spikes.
const SPIKES: f64 = 0.003;

/// The controller's error: rad/s, damping.
const GAINS: (f64, f64) = (40.0, 0.8);

/// What is done with which arm.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// The arm.
    pub arm: &'static Arm,
    /// What is put into it.
    pub injection: &'static Injection,
    /// Root mean square of what it adds, as a share of the joint's torque.
    pub share: f64,
    /// Of joint, motion and noise.
    pub seed: u64,
}

/// What comes of it.
#[derive(Debug)]
pub struct Experiment {
    /// The spec that is traced.
    pub declared: String,
    /// The spec that says all; none where no spec can.
    pub truth: Option<String>,
    /// Joints that it is on.
    pub joints: Vec<usize>,
    /// Parameters of what was put in, shapes among them, SI.
    pub parameters: Vec<(&'static str, f64)>,
    /// Whether its motions repeat.
    pub repeats: bool,
    /// The log that is fitted, the one that is not.
    pub logs: [Log; 2],
}

/// What went wrong, in words.
pub(crate) fn said(error: impl Display) -> String {
    error.to_string()
}

impl Case {
    /// Its place in the catalogue.
    pub fn number(&self) -> usize {
        place(ALL, self.injection)
    }

    /// Moves the arm twice. `None` where this much of it cannot be: friction of a load that is not there.
    ///
    /// # Errors
    /// What went wrong, in words.
    pub fn run(&self) -> Result<Option<Experiment>, String> {
        let draw = Draw::new(self);
        let joints = draw.joints;
        let declared = self.declared(&joints, true)?;
        let model = load(self.arm.name, &declared).map_err(said)?;
        let waves = |k: usize| Waves::new(&model, SECONDS[k], draw.motions[k], draw.repeats);
        let (identify, validate) = (waves(0), waves(1));
        let Some(size) = self.size(&declared, &joints, &identify)? else {
            return Ok(None);
        };
        let machine = self.machine(&joints, size, false)?;
        let log = |waves: &Waves, part: usize| {
            let noise = draw.noises[part];
            let mut log = self.measure(&machine, size, waves, part, noise)?;
            if self.injection.kind == "corrupt-samples" {
                self.spoil(&mut log, joints[0], noise);
            }
            Ok::<_, String>(log)
        };
        let logs = [log(&identify, 0)?, log(&validate, 1)?];
        let is_said = self.injection.kind != "corrupt-samples";
        Ok(Some(Experiment {
            declared,
            truth: is_said.then_some(machine),
            parameters: self.linear(size).chain(self.shapes(size)).collect(),
            repeats: draw.repeats,
            joints,
            logs,
        }))
    }

    /// The arm with what it declares; `is_spec` for the spec, else for the machine without what is put in.
    pub(crate) fn declared(&self, joints: &[usize], is_spec: bool) -> Result<String, String> {
        let text = self.arm.text(self.injection.is_of_known_links);
        let replaced = |joint: usize, effect: &str| {
            let is_itself = self.injection.effect() == effect;
            self.injection.replaces == Some(effect)
                && joints.contains(&joint)
                && (is_itself || !is_spec)
        };
        let model = load(self.arm.name, &text).map_err(said)?;
        let mut amendments = Vec::new();
        for (joint, one) in model.joints.iter().enumerate() {
            for (effect, _) in DECLARED {
                if !replaced(joint, effect) {
                    amendments.push(Amendment {
                        effect: effect.to_owned(),
                        joints: vec![one.name.clone()],
                        shapes: Vec::new(),
                    });
                }
            }
        }
        amend(self.arm.name, &text, &amendments).map_err(said)
    }

    /// The machine as a spec; with `is_open` the shapes that are its size have no value.
    pub(crate) fn machine(
        &self,
        joints: &[usize],
        size: f64,
        is_open: bool,
    ) -> Result<String, String> {
        let mut text = self.declared(joints, false)?;
        if let Some(law) = self.injection.law {
            text = format!("{law}\n{text}");
        }
        if self.injection.place == Place::Nowhere || self.injection.kind == "corrupt-samples" {
            return Ok(text);
        }
        let model = load(self.arm.name, &text).map_err(said)?;
        let shapes: Vec<(&str, f64)> = if is_open {
            self.injection.shapes.to_vec()
        } else {
            self.shapes(size).collect()
        };
        let joints = match self.injection.place {
            Place::Log => &[][..],
            _ => joints,
        };
        let amendment = Amendment {
            effect: self.injection.effect(),
            joints: joints
                .iter()
                .map(|&j| model.joints[j].name.clone())
                .collect(),
            shapes: shapes
                .into_iter()
                .map(|(name, value)| (name.to_owned(), value))
                .collect(),
        };
        amend(self.arm.name, &text, &[amendment]).map_err(said)
    }

    /// Values of its linear parameters: its size, unless shapes are that.
    fn linear(&self, size: f64) -> impl Iterator<Item = (&'static str, f64)> {
        let is_sized = self.injection.scaled.is_empty();
        let unit = if is_sized { size } else { 1.0 };
        let linear = self.injection.linear.iter();
        linear.map(move |(name, value)| (*name, unit * value))
    }

    /// Values of its shapes.
    fn shapes(&self, size: f64) -> impl Iterator<Item = (&'static str, f64)> {
        let scaled = self.injection.scaled.iter();
        let scaled = scaled.map(move |(name, of)| (*name, of(size)));
        self.injection.shapes.iter().copied().chain(scaled)
    }

    /// Values of the machine's standard parameters.
    pub(crate) fn standard(&self, compiled: &Compiled, size: f64) -> Vec<f64> {
        let names: Vec<&str> = compiled
            .model
            .joints
            .iter()
            .map(|j| j.name.as_str())
            .collect();
        let value = |name: &str| {
            let mut parts = name.split('.');
            let (joint, effect, parameter) = (parts.next(), parts.next(), parts.next());
            let joint = names
                .iter()
                .position(|one| Some(*one) == joint)
                .unwrap_or(0);
            let own = self.linear(size).find(|(own, _)| Some(*own) == parameter);
            if let (true, Some((_, value))) = (effect == Some(&self.injection.effect()), own) {
                return value;
            }
            let declared = DECLARED.iter().position(|(one, _)| Some(*one) == effect);
            declared.map_or(0.0, |k| self.arm.joints[joint][k])
        };
        let standard = compiled
            .standard
            .iter()
            .map(|parameter| match parameter.status {
                Status::Nominal(value) | Status::Fixed(value) => value,
                Status::Unknown => value(&parameter.name),
            });
        standard.collect()
    }

    /// Moves the machine under a controller that knows it, and logs it with noise.
    fn measure(
        &self,
        machine: &str,
        size: f64,
        waves: &Waves,
        part: usize,
        noise: u64,
    ) -> Result<Log, String> {
        let mut compiled = compile_model(&load(self.arm.name, machine).map_err(said)?);
        if compiled.displacements().is_some() && !compiled.mixed().is_empty() {
            compiled = compiled.ungrouped();
        }
        let standard = self.standard(&compiled, size);
        let shapes = shape_values(&compiled.model);
        let trajectory = waves.trajectory().map_err(said)?;
        let place = |input: &String| CHANNELS.iter().position(|name| name == input);
        let setting = Loop {
            log_rate: RATE_HZ,
            duration: SECONDS[part],
            sensors: Sensors {
                encoder_step: self.injection.encoder_step(),
                velocity_hz: 50.0,
                seed: noise,
                ..Sensors::default()
            },
            torque_delay: if self.injection.kind == "time-delay" {
                size
            } else {
                0.0
            },
            inputs: compiled.model.inputs().iter().filter_map(place).collect(),
            ..Loop::default()
        };
        let plant =
            InterpretedPlant::new(compiled.clone(), &compiled.base.beta(&standard), &shapes)
                .map_err(said)?;
        let mut controller =
            ComputedTorque::new(Gains::new(GAINS.0, GAINS.1).map_err(said)?, plant.clone());
        let (record, _) = setting
            .run(plant, &mut controller, &trajectory, &mut |_| {})
            .map_err(said)?;
        let mut tau = record.tau;
        let mut random = ChaCha8Rng::seed_from_u64(!noise);
        for values in &mut tau {
            self.injection.noise.disturb(values, &mut random);
        }
        let name = ["identification", "validation"][part];
        let mut log = Log::from_samples(name, record.time, record.q, tau).map_err(said)?;
        let logged = record.extra.into_iter();
        log.extra = logged.filter(|one| one.name != MOTION_PHASE).collect();
        Ok(log)
    }

    /// Spikes in the torque of a joint, of both signs.
    fn spoil(&self, log: &mut Log, joint: usize, noise: u64) {
        let mut random = ChaCha8Rng::seed_from_u64(noise.rotate_left(1));
        let size = self.share * rms(log.tau[joint].iter().copied()) / SPIKES.sqrt();
        for value in &mut log.tau[joint] {
            if random.random_bool(SPIKES) {
                *value += if random.random_bool(0.5) { size } else { -size };
            }
        }
    }
}

pub(crate) fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
    (sum / f64::max(count, 1.0)).sqrt()
}
