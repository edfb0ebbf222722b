//! Sections 3.2 and 4.1: shares of the torque, where friction changes over.

use robot_model::control::Dissection;
use robot_model::{RobotModel as _, State, Vector};

use super::device::phantom;
use super::plant::Three;
use super::sensors::RATE;
use super::sines::Sines;
use super::truth::{FASTEST, Pi, table_1};

/// Shares in the order of figure 10.
pub const NAMES: [&str; 5] = ["inertia", "Coriolis", "gravity", "viscous", "Coulomb"];

/// Root mean squares of the shares of one installation, `[share][joint]`, N m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shares {
    /// One a name of [`NAMES`].
    pub rms: [Three; 5],
    /// Of viscous and Coulomb friction together, which are not at right angles to each other.
    pub friction: Three,
    /// Of the whole torque.
    pub torque: Three,
    /// Largest difference of the sum of all shares from the torque, N m.
    pub off: f64,
}

/// Of a device with these parameters along a motion, whose fastest joint reaches [`FASTEST`].
#[must_use]
pub fn shares(pi: &Pi, motion: &Sines) -> Shares {
    let arm = phantom(pi);
    let samples = 2000;
    let states = |motion: &Sines| -> Vec<[Three; 3]> {
        let at = |k| motion.at(f64::from(k) * 20.0 / RATE);
        (0..samples).map(at).collect()
    };
    let all = states(motion).into_iter();
    let fastest = all
        .flat_map(|[_, v, _]| v)
        .fold(0.0, |top: f64, v| top.max(v.abs()));
    let motion = motion.clone().at_pace(FASTEST / fastest);
    let mut sums = [[0.0; 3]; 5];
    let (mut torque, mut friction, mut off) = ([0.0; 3], [0.0; 3], 0.0_f64);
    for [q, v, a] in states(&motion) {
        let (q, v, a) = (Vector::from(q), Vector::from(v), Vector::from(a));
        let found = Dissection::new(&arm, &State::new(q, v, a));
        let whole = arm.inverse_dynamics(&q, &v, &a);
        off = off.max((found.sum() - whole).amax());
        let mut parts = [
            found.inertia,
            found.coriolis,
            found.gravity,
            Vector::zeros(),
            Vector::zeros(),
        ];
        for effect in found.effects() {
            let place = if effect.name.ends_with("viscous_friction") {
                3
            } else {
                4
            };
            parts[place] += effect.torque;
        }
        for j in 0..3 {
            torque[j] += whole[j] * whole[j];
            friction[j] += (parts[3][j] + parts[4][j]).powi(2);
            for (sum, part) in sums.iter_mut().zip(&parts) {
                sum[j] += part[j] * part[j];
            }
        }
    }
    let root = |sum: Three| sum.map(|x| (x / f64::from(samples)).sqrt());
    Shares {
        rms: sums.map(root),
        friction: root(friction),
        torque: root(torque),
        off,
    }
}

/// What section 4.1 says of the shares, and in how many of the installations that it is said of it holds along this motion.
#[must_use]
pub fn sentences(all: &[Shares]) -> Vec<(&'static str, [usize; 2])> {
    let [inertia, coriolis, gravity] = [0, 1, 2];
    let of = |one: &Shares, share: usize, j: usize| one.rms[share][j];
    let [upright, gimbal, _, _, turned_gimbal] = all else {
        return Vec::new();
    };
    let count = |said, installations: &[&Shares], holds: &dyn Fn(&Shares) -> bool| {
        let held = installations.iter().filter(|one| holds(one)).count();
        (said, [held, installations.len()])
    };
    let every: Vec<&Shares> = all.iter().collect();
    let gimbals = [gimbal, turned_gimbal];
    vec![
        count("friction is most of joint 1", &every, &|one| {
            (0..3).all(|share| one.friction[0] > of(one, share, 0))
        }),
        count("and Coriolis comes next", &every, &|one| {
            of(one, coriolis, 0) > of(one, inertia, 0)
        }),
        count("inertia is most of joint 2", &every, &|one| {
            (1..3).all(|share| of(one, inertia, 1) > of(one, share, 1))
                && of(one, inertia, 1) > one.friction[1]
        }),
        count("and Coriolis comes next there", &every, &|one| {
            of(one, coriolis, 1) > of(one, gravity, 1)
        }),
        count(
            "gravity is more on joint 3 than on joint 2",
            &every,
            &|one| of(one, gravity, 2) > of(one, gravity, 1),
        ),
        count("inertia is more there with a gimbal", &gimbals, &|one| {
            of(one, inertia, 2) > 2.0 * of(upright, inertia, 2)
        }),
    ]
}

/// Gravity on joint 3 over that of UR along one motion, of all five: with a force sensor, and with the gimbal's counterweight, upright and
/// upside down.
#[must_use]
pub fn gravity_of_joint_3(all: &[Shares]) -> Three {
    let gravity = |installation: usize| all[installation].rms[2][2];
    [2, 1, 4].map(|installation| gravity(installation) / gravity(0))
}

/// Whether that is as section 4.1 has it: half of it, and nearly none.
#[must_use]
pub fn is_as_said([sensor, upright, turned]: Three) -> bool {
    (0.4..0.6).contains(&sensor) && upright.max(turned) < 0.1
}

/// Speed at which viscous friction is as much as dry friction, UR, deg/s.
#[must_use]
pub fn crossover() -> Three {
    let pi = table_1(0);
    std::array::from_fn(|j| (pi[11 + j] / pi[8 + j]).abs().to_degrees())
}
