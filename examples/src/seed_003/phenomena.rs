//! What the model shows beside its curve: the loop before it slides, and stick-slip; by hand, and by the runtime's `simulate`.

use std::f64::consts::TAU;

use robot_model::simulate::{Controller, Desired, Loop, Measured, Trajectory};

use super::plant::{Friction, Link, State};

use super::tool;
use crate::paper::Error;

/// The pull to and fro: a share of the breakaway torque, and its period, s.
const PULL: f64 = 0.6;
const PERIOD_S: f64 = 30.0;
const PERIODS: f64 = 2.0;

/// A spring whose end is pulled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// N m/rad.
    pub stiffness: f64,
    /// The way of its end in a pull, rad: some ten slips.
    pub way: f64,
    /// Steps of the integrator by hand from one torque to the next.
    steps: usize,
}

/// As stiff as the printed bristles, and softer than those of 1001 N m/rad.
pub const STIFF: Spring = Spring {
    stiffness: 2.0,
    way: 15.0,
    steps: 16,
};

/// Much softer than the printed bristles, too: a joint on bristles that bend as far as the spring does creeps along with its end. Slips take
/// seconds, so steps may be longer.
pub const SOFT: Spring = Spring {
    stiffness: 0.05,
    way: 600.0,
    steps: 4,
};

/// What is pulled: the link and a load, kg m^2. The link alone has less than a thousandth, with which its slips are as fast as printed
/// damping, below zero there, lets them be.
pub const LOADED: f64 = 0.1;

/// How often the pulling torque is set anew, Hz, and steps of the integrator by hand in between.
const RATE: f64 = 250.0;
const STEPS: usize = STIFF.steps;

/// Of these samples one in so many is kept.
const KEPT: usize = 5;

/// A motion, 50 Hz of it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Motion {
    /// s.
    pub time: Vec<f64>,
    /// rad.
    pub q: Vec<f64>,
    /// rad/s.
    pub v: Vec<f64>,
    /// N m.
    pub torque: Vec<f64>,
}

/// A joint stands below this share of the speed at which it is pulled, and jumps above that many times it.
const STANDS: f64 = 0.05;
const JUMPS: f64 = 1.5;

/// A joint that sticks stands for this share of the time: one that turns round after a jump passes through standstill, and does not stay.
const STICKS: f64 = 0.15;

/// How a joint moves over the last third of a pull; speeds are over that of the pull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Late {
    /// Least speed.
    pub least: f64,
    /// Largest speed.
    pub largest: f64,
    /// Share of the time for which it stands.
    pub standing: f64,
    /// How often it stood, and then jumped.
    pub jumps: usize,
}

impl Late {
    /// Whether it stands, and jumps, over and over.
    #[must_use]
    pub fn sticks(&self) -> bool {
        self.standing > STICKS && self.jumps > 1
    }

    /// Whether it goes along evenly.
    #[must_use]
    pub fn is_even(&self) -> bool {
        self.least > 0.99 && self.largest < 1.01
    }

    /// In a word.
    #[must_use]
    pub fn word(&self) -> &'static str {
        if self.sticks() {
            "sticks"
        } else if self.is_even() {
            "even"
        } else {
            "swings"
        }
    }
}

/// A torque of time and angle that is held between samples.
struct Pull<F>(F);

impl<F: FnMut(f64, f64) -> f64> Controller for Pull<F> {
    fn torque(&mut self, measured: &Measured<'_>, _: &Desired, torque: &mut [f64]) {
        torque[0] = (self.0)(measured.time, measured.q[0]);
    }
}

/// By the integrator by hand.
pub fn by_hand(
    friction: Friction,
    inertia: f64,
    seconds: f64,
    pull: impl Fn(f64, f64) -> f64,
) -> Motion {
    in_steps(STEPS, friction, inertia, seconds, pull)
}

fn in_steps(
    steps: usize,
    friction: Friction,
    inertia: f64,
    seconds: f64,
    pull: impl Fn(f64, f64) -> f64,
) -> Motion {
    let link = Link::lying(friction, inertia);
    let mut x = State::default();
    let mut motion = Motion::default();
    let mut k = 0_usize;
    loop {
        let t = k as f64 / RATE;
        let torque = pull(t, x.q);
        if k.is_multiple_of(KEPT) {
            motion.time.push(t);
            motion.q.push(x.q);
            motion.v.push(x.v);
            motion.torque.push(torque);
        }
        if t >= seconds {
            return motion;
        }
        for _ in 0..steps {
            x = link.step(x, torque, 1.0 / (RATE * steps as f64));
        }
        k += 1;
    }
}

/// By the runtime, from the spec with the bristles.
///
/// # Errors
/// Those of the libraries.
pub fn by_runtime(
    friction: Friction,
    inertia: f64,
    seconds: f64,
    pull: impl Fn(f64, f64) -> f64,
) -> Result<Motion, Error> {
    let still = Trajectory::new(
        (0..4).map(f64::from).collect(),
        vec![vec![0.0; 4]],
        vec![],
        vec![],
        vec![],
    )?;
    let setting = Loop {
        rate: RATE,
        log_rate: RATE / KEPT as f64,
        duration: seconds,
        ..Loop::default()
    };
    let plant = tool::plant(&friction, Some(inertia))?;
    let (record, _) = setting.run(plant, &mut Pull(&pull), &still, &mut |_| ())?;
    let [q, v] = [&record.q[0], &record.dq[0]];
    Ok(Motion {
        torque: record
            .time
            .iter()
            .zip(q)
            .map(|(t, q)| pull(*t, *q))
            .collect(),
        q: q.clone(),
        v: v.clone(),
        time: record.time,
    })
}

/// A pull to and fro below breakaway.
pub fn to_and_fro(friction: &Friction) -> (f64, impl Fn(f64, f64) -> f64 + use<>) {
    let size = PULL * friction.breakaway;
    (PERIODS * PERIOD_S, move |t: f64, _: f64| {
        size * (TAU * t / PERIOD_S).sin()
    })
}

impl Spring {
    /// The pull of the spring whose end moves at a speed.
    pub fn pulled(self, speed: f64) -> impl Fn(f64, f64) -> f64 {
        move |t, q| self.stiffness * (speed * t - q)
    }

    /// A loaded joint that is pulled so for some seconds, by hand.
    #[must_use]
    pub fn pulls(self, friction: Friction, speed: f64, seconds: f64) -> Motion {
        in_steps(self.steps, friction, LOADED, seconds, self.pulled(speed))
    }
}

impl Motion {
    /// Energy that the last turn of the loop takes, J, and how wide it is where the torque is zero, rad.
    #[must_use]
    pub fn last_loop(&self) -> (f64, f64) {
        let samples = (self.time.len() - 1) as f64;
        let at = |periods: f64| crate::seed_003::nearest(samples * periods / PERIODS);
        let range = at(PERIODS - 1.0)..at(PERIODS);
        let work = range
            .map(|k| 0.5 * (self.torque[k] + self.torque[k + 1]) * (self.q[k + 1] - self.q[k]));
        let width = self.q[at(PERIODS - 0.5)] - self.q[at(PERIODS - 1.0)];
        (work.sum(), width)
    }

    /// How a joint moves late, the end of whose spring moves at `speed`.
    #[must_use]
    pub fn late(&self, speed: f64) -> Late {
        let late = &self.v[2 * self.v.len() / 3..];
        let count = |is_so: &dyn Fn(f64) -> bool| late.iter().filter(|v| is_so(**v)).count() as f64;
        let mut jumps = 0_usize;
        let mut stood = false;
        for v in late {
            stood |= v.abs() < STANDS * speed;
            if stood && *v > JUMPS * speed {
                jumps += 1;
                stood = false;
            }
        }
        Late {
            least: late.iter().copied().fold(f64::INFINITY, f64::min) / speed,
            largest: late.iter().copied().fold(f64::NEG_INFINITY, f64::max) / speed,
            standing: count(&|v| v.abs() < STANDS * speed) / late.len() as f64,
            jumps,
        }
    }

    /// Largest distance of two motions' angles, rad.
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        let pairs = self.q.iter().zip(&other.q);
        pairs.fold(0.0, |most: f64, (one, other)| most.max((one - other).abs()))
    }
}
