//! A compiled spec as a plant to be simulated, and as the model of a controller.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, Jumps, Plant, Slopes};
use robot_model_codegen::{Compiled, Driven};

mod adjust;
mod believed;
mod inertia;
mod loads;
mod parted;
mod plain;
mod share;
mod slopes;

use self::adjust::ParameterRunners;
use self::share::ShareRunner;
use self::slopes::SlopeRunners;
use super::links::{LinkSlopes, Links};
use super::runner::{Numbers, Runner, matrix};
use crate::Error;

/// A compiled spec with numbers for all parameters, as a [`Plant`].
///
/// The torque that a spec's effects call measured is that of the motors. Where links hang behind springs or gaps, torques of effects
/// and their states are on the motors' side, as in the spec's equations, and forces of the world where the links are; links are further degrees of
/// freedom behind those of the joints.
#[derive(Debug, Clone)]
pub struct InterpretedPlant {
    compiled: Compiled,
    numbers: Numbers,
    joints: usize,
    links: Links,
    states: usize,
    is_affine: bool,
    is_timed: bool,
    rigid: Runner,
    inertia: Runner,
    effects: ShareRunner,
    /// Where links are parted from motors.
    forces: Option<ShareRunner>,
    rates: Runner,
    energies: Runner,
    /// Torque of the rigid body at an instant.
    load: Vec<f64>,
    /// Made when the first implicit step asks for them.
    slopes: Option<Box<SlopeRunners>>,
    /// Made when sensitivities ask for them.
    parametric: Option<Box<ParameterRunners>>,
}

impl InterpretedPlant {
    /// The arm with base parameters `beta` and shape parameters `shapes`, each in their order.
    ///
    /// # Errors
    /// [`Error`] where a motor with a spring has no inertia, or a spring gives way against its load; where base parameters are those of
    /// motors and links together, see [`Compiled::ungrouped`].
    pub fn new(compiled: Compiled, beta: &[f64], shapes: &[f64]) -> Result<Self, Error> {
        let numbers = Numbers {
            parameters: compiled.parameter_values(beta),
            shapes: shapes.to_vec(),
        };
        let links = Links::new(&compiled, &numbers)?;
        let plant = compiled.plant();
        let runner = |program| Runner::new(program, &numbers);
        let mut found = Self {
            joints: plant.dof,
            is_timed: plant.is_timed || links.is_timed,
            states: plant.states,
            is_affine: plant.is_affine && links.driven() != Driven::Otherwise,
            links,
            rigid: runner(plant.rigid_torque),
            inertia: runner(plant.mass_matrix),
            effects: ShareRunner::new(plant.effects, plant.dof, &numbers),
            forces: plant
                .forces
                .map(|share| ShareRunner::new(share, plant.dof, &numbers)),
            rates: runner(plant.rates),
            energies: runner(compiled.energies()),
            load: Vec::new(),
            slopes: None,
            parametric: None,
            numbers,
            compiled,
        };
        if !found.links.sprung().is_empty() {
            let inertia = found.parted_inertia();
            found.check_motors(&inertia)?;
            found.links.set_teeth(&found.compiled, &inertia);
        }
        Ok(found)
    }

    /// Kinetic and potential energy of the rigid body, J; the latter up to a constant, at time 0 with channels at zero. Motors and springs have
    /// theirs besides.
    pub fn energies(&mut self, q: &[f64], dq: &[f64]) -> [f64; 2] {
        let inputs = vec![0.0; self.compiled.model.inputs().len()];
        let at = Instant {
            time: 0.0,
            q,
            dq,
            ddq: dq,
            memory: &[],
            switches: &[],
            torque: &[],
            inputs: &inputs,
        };
        let links = self.links.motion(&at);
        let found = self.energies.run(&of_links(&at, &links), &[]);
        [found.output(0), found.output(1)]
    }

    /// Where switches stand if motors move as at an instant, links as `there`, and nothing sticks.
    fn signs(&mut self, at: &Instant<'_>, there: &Instant<'_>) -> Vec<f64> {
        let forces = self.forces.as_mut();
        let forces = forces.map(|forces| forces.signs(there));
        let effects = self.effects.signs(at);
        effects.chain(forces.into_iter().flatten()).collect()
    }

    /// Torque of the rigid body, `n`, with links as at an instant.
    fn rigid_torque(&mut self, there: &Instant<'_>) -> Vec<f64> {
        let rigid = self.rigid.run(there, &[]);
        (0..self.joints).map(|joint| rigid.output(joint)).collect()
    }

    fn mass_matrix(&mut self, there: &Instant<'_>) -> DMatrix<f64> {
        matrix(self.inertia.run(there, &[]), 0, self.joints, self.joints)
    }
}

/// The instant as links have it.
fn of_links<'a>(at: &Instant<'a>, links: &'a [Vec<f64>; 3]) -> Instant<'a> {
    let [q, dq, ddq] = links;
    Instant { q, dq, ddq, ..*at }
}

impl Plant for InterpretedPlant {
    fn dof(&self) -> usize {
        self.links.dof()
    }

    fn joints(&self) -> usize {
        self.joints
    }

    fn joint(&self, coordinate: usize) -> usize {
        self.links.joint(coordinate)
    }

    fn states(&self) -> usize {
        self.states
    }

    fn switches(&self) -> usize {
        let forces = self.forces.as_ref();
        self.effects.switches + forces.map_or(0, |forces| forces.switches)
    }

    fn is_affine(&self) -> bool {
        self.is_affine
    }

    fn is_timed(&self) -> bool {
        self.is_timed
    }

    fn start(&mut self, joints: &Instant<'_>) -> Vec<f64> {
        let mut links = self.links.clone();
        links.hang(joints, |q| {
            let at = Instant { q, ..*joints };
            // A force that sets in with the motion is there.
            let soon = Instant {
                time: at.time + 1e-9,
                ..at
            };
            let switches = self.signs(&soon, &soon);
            let at = Instant {
                switches: &switches,
                ..at
            };
            let body = self.rigid_torque(&at);
            let mut torque = body.clone();
            if let Some(forces) = &mut self.forces {
                let more = forces.torque(&at, &body).torque;
                torque
                    .iter_mut()
                    .zip(&more)
                    .for_each(|(x, more)| *x += more);
            }
            [body, torque]
        })
    }

    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        if self.is_plain() {
            self.plain_torque(at, torque, inertia);
        } else {
            self.parted_torque(at, torque, inertia);
        }
    }

    fn rates(&mut self, at: &Instant<'_>, rates: &mut [f64]) {
        let links = self.links.motion(at);
        let loads = self.loads(at, &of_links(at, &links));
        let found = self.rates.run(at, &loads.seen);
        for (state, rate) in rates.iter_mut().enumerate() {
            *rate = found.output(state);
        }
    }

    fn arguments(&mut self, at: &Instant<'_>, arguments: &mut [f64]) {
        let links = self.links.motion(at);
        let forces = self.forces.as_mut();
        let there = of_links(at, &links);
        let forces = forces.map(|forces| forces.arguments(&there));
        let found = self
            .effects
            .arguments(at)
            .chain(forces.into_iter().flatten());
        for (argument, found) in arguments.iter_mut().zip(found) {
            *argument = found;
        }
    }

    fn jumps(&mut self, at: &Instant<'_>, jumps: &mut Jumps) {
        let (m, dof) = (self.effects.switches, self.dof());
        let links = self.links.motion(at);
        let there = of_links(at, &links);
        let loads = self.loads(at, &there);
        let own = self.effects.jumps(at, &loads.seen);
        jumps.halves = own.halves.resize_horizontally(self.switches(), 0.0);
        jumps.halves.resize_vertically_mut(dof, 0.0);
        jumps.directions = own.directions.resize(self.switches(), dof, 0.0);
        jumps.drifts.rows_mut(0, m).copy_from(&own.drifts);
        let LinkSlopes { position, .. } = self.links.slopes(at);
        // What links do where joints have no acceleration.
        let still = vec![0.0; dof];
        let [.., coasting] = self.links.motion(&Instant { ddq: &still, ..*at });
        if let Some(forces) = &mut self.forces {
            let own = forces.jumps(&there, &loads.body);
            for (joint, coordinate) in self.links.coordinates().into_iter().enumerate() {
                let mut row = jumps.halves.row_mut(coordinate);
                row.columns_mut(m, forces.switches)
                    .copy_from(&own.halves.row(joint));
            }
            let coasting = &own.directions * DVector::from_vec(coasting);
            let k = forces.switches;
            jumps
                .directions
                .rows_mut(m, k)
                .copy_from(&(own.directions * position));
            jumps
                .drifts
                .rows_mut(m, k)
                .copy_from(&(own.drifts + coasting));
        }
    }

    fn slopes(&mut self, at: &Instant<'_>, slopes: &mut Slopes) {
        if self.is_plain() {
            self.plain_slopes(at, slopes);
        } else {
            self.parted_slopes(at, slopes);
        }
    }
}
