//! An arm whose friction falls with speed, led by hand.

use nalgebra::{DMatrix, DVector};
use robot_model::State;
use robot_model::control::HandGuiding;
use robot_model::signal::{Bands, prepare};
use robot_model::simulate::{Instant, Jumps, Plant, Slopes, Trajectory};
use robot_model_cli::interpreted::InterpretedPlant;

use super::knowledge::{EXCITING, Knowledge, experiment};
use super::puma::{STRIBECK, limits, log, plant, root_mean_square, run, setting, waves};

/// A hand that leads each joint along a path and does not give way: what it takes is then of the path, not of the hand.
#[derive(Debug, Clone)]
struct Hand(Trajectory);

/// A natural frequency of the joints of 200 rad/s, critically damped: inertias, kg m^2.
const INERTIA: [f64; 6] = [3.5, 4.5, 1.2, 0.2, 0.2, 0.2];
const FREQUENCY: f64 = 200.0;

fn stiffness(joint: usize) -> f64 {
    INERTIA[joint] * FREQUENCY * FREQUENCY
}

fn damping(joint: usize) -> f64 {
    2.0 * INERTIA[joint] * FREQUENCY
}

impl Hand {
    fn torque(&self, time: f64, q: &[f64], dq: &[f64]) -> [f64; 6] {
        let wanted = self.0.at(time);
        std::array::from_fn(|k| {
            stiffness(k) * (wanted.q[k] - q[k]) + damping(k) * (wanted.dq[k] - dq[k])
        })
    }
}

/// The arm with the hand on it.
struct Led {
    arm: InterpretedPlant,
    hand: Hand,
}

impl Plant for Led {
    fn dof(&self) -> usize {
        self.arm.dof()
    }

    fn switches(&self) -> usize {
        self.arm.switches()
    }

    fn is_timed(&self) -> bool {
        true
    }

    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        self.arm.torque(at, torque, inertia);
        for (torque, hand) in torque
            .iter_mut()
            .zip(self.hand.torque(at.time, at.q, at.dq))
        {
            *torque -= hand;
        }
    }

    fn arguments(&mut self, at: &Instant<'_>, arguments: &mut [f64]) {
        self.arm.arguments(at, arguments);
    }

    fn jumps(&mut self, at: &Instant<'_>, jumps: &mut Jumps) {
        self.arm.jumps(at, jumps);
    }

    fn slopes(&mut self, at: &Instant<'_>, slopes: &mut Slopes) {
        self.arm.slopes(at, slopes);
        for k in 0..6 {
            slopes.torque[0][(k, k)] += stiffness(k);
            slopes.torque[1][(k, k)] += damping(k);
        }
    }
}

/// Speeds of this experiment want finer encoders than the arm had: these see 1e-4 rad/s in a filter's time.
const BITS: i32 = 22;
const STANDING: f64 = 1e-4;

/// Up to 0.04 rad/s, and slow where joints turn round.
const TONES: &[(f64, f64)] = &[(0.1, 0.05)];
const SECONDS: f64 = 12.0;

/// Below this speed, rad/s, effort counts.
const SLOW: f64 = 0.01;

/// `K_d`, N m s/rad.
const DAMPING: [f64; 6] = [2.0, 2.0, 1.0, 0.1, 0.1, 0.1];

/// Torque of the hand on each joint, N m, root mean square where the joint is slow.
fn effort(known: &Knowledge) -> [f64; 6] {
    let path = waves(TONES, 0.4, SECONDS);
    let hand = Hand(path.clone());
    let arm = Led {
        arm: plant(STRIBECK),
        hand: hand.clone(),
    };
    let mut control = HandGuiding::new(known.arm(), DAMPING)
        .and_then(|control| control.with_safety(limits()))
        .expect("dampings and limits");
    let record = run(arm, &setting(SECONDS, BITS, 9), &path, |now, _| {
        // A filter never comes to rest: what friction a joint has that stands, its last velocity does not say.
        let dq = now.dq.map(|v| if v.abs() < STANDING { 0.0 } else { v });
        control.torque(&State { dq, ..*now }).torque
    });
    let log = log(record.expect("a motion"));
    let prepared = prepare(&log, &Bands::for_log(&log)).expect("a log of 12 s");
    let led = &prepared.motion.smooth;
    let at = |columns: &[Vec<f64>], k: usize| -> Vec<f64> {
        columns.iter().map(|column| column[k]).collect()
    };
    let mut efforts = vec![Vec::new(); 6];
    for (k, &time) in prepared.motion.time.iter().enumerate() {
        let (q, dq) = (at(&led.q, k), at(&led.dq, k));
        let torque = hand.torque(time, &q, &dq);
        for (joint, efforts) in efforts.iter_mut().enumerate() {
            if time >= 0.5 && dq[joint].abs() <= SLOW {
                efforts.push(torque[joint]);
            }
        }
    }
    std::array::from_fn(|joint| root_mean_square(efforts[joint].iter().copied()))
}

/// A joint that stands is helped by neither model, and has to be broken away; the difference is in how it goes on.
#[test]
fn hand_guiding_wants_the_right_friction() {
    // Friction at low speeds shows in slow motions only.
    let logs = [
        experiment(STRIBECK, EXCITING, 10.0, BITS, 2),
        experiment(STRIBECK, &[(0.15, 0.05), (0.04, 0.17)], 10.0, BITS, 3),
    ];
    let right = effort(&Knowledge::identified_with_stribeck(&logs));
    let plain = effort(&Knowledge::identified(&logs));
    eprintln!("guiding: with Stribeck friction {right:.2?} N m");
    eprintln!("guiding: with Coulomb and viscous friction alone {plain:.2?} N m");
    for (right, plain) in right.iter().zip(plain) {
        assert!(*right < 0.9 * plain, "{right} {plain}");
    }
}
