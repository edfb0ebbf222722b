//! Springs between motors and their links, from displacements that follow the load.
//!
//! A spec says how far a link is displaced by the load that it takes, `d(R)`, falling. A motion has that the other way round: the link
//! is displaced by `x`, and the load is that with `d(R) = x`. Where `d` jumps at no load, as with backlash, there is a gap without
//! load; where nothing gives, teeth are as stiff as [`TEETH_HZ`] says. Where `d` follows loads of other joints, too, as with a belt
//! over two of them, all loads are found together.

use std::f64::consts::TAU;

use nalgebra::DVector;
use robot_model::simulate::Instant;
use robot_model_codegen::{Compiled, Driven, Linkage};

use super::runner::{Numbers, Runner};
use crate::Error;

mod slopes;
mod solve;

pub(super) use slopes::SpringSlopes;

/// Frequency of a motor against its link where only teeth are between them, at the position zero, Hz: fast beside all that controllers
/// do, and slow enough for a motion.
const TEETH_HZ: f64 = 300.0;

/// The same where something else than its load displaces a link, too, and the damping ratio. What does so may be active and would feed
/// a swing of nothing but teeth; these are to hold the link where it is led.
const LED_HZ: f64 = 1000.0;
const LED_DAMPING: f64 = 0.3;

/// Of its motor's inertia: a link that has less there, as where it turns about itself, may have more elsewhere.
const LEAST_LINK: f64 = 0.01;

/// Compliance of teeth until inertias are known, rad/(N m) or m/N.
const TEETH: f64 = 1e-6;

/// Compliance of what does not give, rad/(N m) or m/N.
const NOTHING: f64 = 1e-15;

/// Springs of an arm.
#[derive(Debug, Clone)]
pub(super) struct Springs {
    /// Their joints.
    pub joints: Vec<usize>,
    give: Runner,
    slopes: Runner,
    /// Compliance of teeth, rad/(N m) or m/N: what is added to springs that do not give.
    teeth: Vec<f64>,
    /// Damping over stiffness of teeth, s: a load is that of `x + lag d(x - d)/dt`.
    lag: Vec<f64>,
    /// Which springs follow more than their load, positions, time and channels.
    led: Vec<bool>,
    /// Loads at which the programs are run, one a joint.
    load: Vec<f64>,
    states: usize,
    /// Whether springs follow loads of each other.
    pub is_coupled: bool,
    /// How they follow accelerations.
    pub driven: Driven,
}

/// What a spring carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Carried {
    /// N m or N.
    pub load: f64,
    /// Its slope by the displacement of the link, not above 0, under the same loads of other springs.
    pub by_displacement: f64,
}

impl Springs {
    pub fn new(linkage: &Linkage, compiled: &Compiled, numbers: &Numbers) -> Result<Self, Error> {
        let mut found = Self {
            joints: linkage.springs.clone(),
            give: Runner::new(linkage.give.clone(), numbers),
            slopes: Runner::new(linkage.give_slopes.clone(), numbers),
            teeth: vec![TEETH; linkage.springs.len()],
            lag: vec![0.0; linkage.springs.len()],
            led: linkage.led.clone(),
            load: vec![0.0; compiled.dof()],
            states: compiled.dynamics.state_rates.len(),
            is_coupled: linkage.is_coupled,
            driven: linkage.driven,
        };
        let mut loads: Vec<f64> = (-30..=45)
            .map(|fifth| 10_f64.powf(0.2 * f64::from(fifth)))
            .flat_map(|load| [load, -load])
            .collect();
        loads.sort_by(f64::total_cmp);
        for (k, &joint) in linkage.springs.iter().enumerate() {
            found.load.fill(0.0);
            let falls = found.at_rest(compiled, |found, at| {
                let curve = loads.iter().map(|&load| found.displacement(at, k, load));
                let curve: Vec<(f64, f64)> = curve.collect();
                curve.iter().all(|(_, slope)| *slope <= 0.0)
                    && curve.windows(2).all(|pair| pair[1].0 <= pair[0].0)
            });
            // What channels do to it is seen when it moves.
            if !falls && !linkage.is_timed {
                return Err(Error::Argument(format!(
                    "{}: joint {}: its spring deflects against its load; `position(j)` must decrease with `rigid_torque(j)`, as \
                     `-rigid_torque(j)/k` with `k` above 0",
                    compiled.model.source, compiled.model.joints[joint].name
                )));
            }
        }
        Ok(found)
    }

    /// What holds where the arm stands at zero, at time 0.
    fn at_rest<T>(
        &mut self,
        compiled: &Compiled,
        find: impl FnOnce(&mut Self, &Instant<'_>) -> T,
    ) -> T {
        let still = vec![0.0; compiled.dof()];
        let (memory, inputs) = (
            vec![0.0; self.states],
            vec![0.0; compiled.model.inputs().len()],
        );
        let at = Instant {
            time: 0.0,
            q: &still,
            dq: &still,
            ddq: &still,
            memory: &memory,
            switches: &[],
            torque: &still,
            inputs: &inputs,
        };
        find(self, &at)
    }

    /// Teeth for springs that do not give under large loads, none for others; `inertia` has motors and links, each by itself.
    pub fn set_teeth(&mut self, compiled: &Compiled, inertia: &[f64]) {
        /// N m or N, beyond what any joint carries.
        const LARGE: f64 = 1e9;
        self.teeth.fill(0.0);
        for k in 0..self.joints.len() {
            self.load.fill(0.0);
            let least = self.at_rest(compiled, |found, at| {
                let [up, down] = [LARGE, -LARGE].map(|load| found.displacement(at, k, load).1);
                up.abs().min(down.abs())
            });
            if least < NOTHING {
                let motor = inertia[self.joints[k]];
                let link = inertia[self.load.len() + k].max(LEAST_LINK * motor);
                let hz = if self.led[k] { LED_HZ } else { TEETH_HZ };
                self.teeth[k] = (1.0 / motor + 1.0 / link) / (TAU * hz).powi(2);
                if self.led[k] {
                    self.lag[k] = 2.0 * LED_DAMPING / (TAU * hz);
                }
            }
        }
    }

    /// Displacement of a link under a load, and its slope.
    fn displacement(&mut self, at: &Instant<'_>, k: usize, load: f64) -> (f64, f64) {
        self.load[self.joints[k]] = load;
        let found = self.give.run(at, &self.load);
        let (give, slope) = (found.output(k), found.output(self.joints.len() + k));
        (give - self.teeth[k] * load, slope - self.teeth[k])
    }

    /// What springs carry; joints without one have the load `body`. Not numbers where no loads displace links so far. Where an instant
    /// has velocities of joints alone, links move with them.
    pub fn carried(&mut self, at: &Instant<'_>, body: &[f64]) -> Vec<Carried> {
        let n = self.load.len();
        let links = self.joints.iter().zip(&at.q[n..]);
        let mut x: Vec<f64> = links.map(|(&joint, link)| link - at.q[joint]).collect();
        let found = self.at_displacements(at, &x, body);
        let is_moving = at.dq.len() > n;
        if !is_moving || self.lag.iter().all(|lag| *lag == 0.0) {
            return found;
        }
        let [q, _, _, load, _] = self.give_slopes(at, &found, body);
        let rates = self.led_rates(&found, &q, &load) * DVector::from_column_slice(at.dq);
        for ((x, lag), rate) in x.iter_mut().zip(&self.lag).zip(rates.iter()) {
            *x += lag * rate;
        }
        self.at_displacements(at, &x, body)
    }

    pub fn runners(&mut self) -> impl Iterator<Item = &mut Runner> {
        [&mut self.give, &mut self.slopes].into_iter()
    }
}

impl Carried {
    /// No load displaces a link so far.
    const NONE: Self = Self {
        load: f64::NAN,
        by_displacement: f64::NAN,
    };
}
