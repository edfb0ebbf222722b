//! A node in the manner of ROS 2, in plain Rust: joint states come in one by one, and the torque that something outside puts on
//! the arm goes out.
//!
//! A bag plays the part of the subscription and another one that of the publisher; in a node of a client library for ROS 2 the callback
//! stays as it is. `cargo run -p robot-model-examples --example node -- --play IN.mcap OUT.mcap` plays a bag with the joints `shoulder` and `slide`;
//! without arguments the arm is pushed in a bag of its own making.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;
use std::process::ExitCode;

use robot_model::control::{ControlError, ExternalTorque, MomentumObserver};
use robot_model::effects::ViscousFriction;
use robot_model::log::{Columns, JointStates, Log};
use robot_model::{Inertial, Link, RobotModel, State, Vector};

/// A shoulder that turns and a slide on its arm, in a vertical plane.
#[derive(Debug, Clone, Copy, RobotModel)]
#[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
pub struct Reach {
    /// Turns about a horizontal axis.
    #[joint(revolute, a = 0, alpha = 90 deg, d = 0)]
    pub shoulder: Link<ViscousFriction>,
    /// Slides along the arm.
    #[joint(prismatic, a = 0, alpha = 0, theta = 0)]
    pub slide: Link<ViscousFriction>,
}

/// What was identified.
fn identified() -> Reach {
    Reach {
        shoulder: Link::new(5.0, [0.0; 3], [0.0, 0.0, 0.0, 2.0, 0.0, 0.0])
            .with(ViscousFriction { fv: 0.8 }),
        slide: Link::from(Inertial::about_com(1.5, [0.0, 0.0, 0.07], [0.0; 6]))
            .with(ViscousFriction { fv: 30.0 }),
    }
}

/// Pole of the observer, 1/s: it shows a push within some multiples of 1/30 s.
const POLE: f64 = 30.0;

/// The node.
struct ContactNode {
    observer: MomentumObserver<Reach, 2>,
}

impl ContactNode {
    fn new(seconds: f64) -> Result<Self, ControlError> {
        let observer = MomentumObserver::new(identified(), POLE, seconds)?;
        Ok(Self { observer })
    }

    /// The callback of the subscription, which returns what is to be published.
    fn on_joint_state(
        &mut self,
        position: Vector<2>,
        velocity: Vector<2>,
        effort: Vector<2>,
    ) -> ExternalTorque<2> {
        let state = State::new(position, velocity, Vector::zeros());
        self.observer.update(&state, &effort)
    }
}

fn columns() -> Columns {
    let joints = Reach::JOINTS.map(str::to_owned).to_vec();
    Columns {
        joints,
        ..Columns::standard(2)
    }
}

/// Plays a bag to a node; external torques, N m and N, `[joint][sample]`.
fn play(bag: &Log) -> Result<Vec<Vec<f64>>, Box<dyn Error>> {
    if bag.dq.is_empty() {
        return Err(format!(
            "{}: joint states without velocities, which the observer needs",
            bag.source
        )
        .into());
    }
    let mut node = ContactNode::new(1.0 / bag.rate_hz())?;
    let mut external = vec![Vec::new(); 2];
    for k in 0..bag.time.len() {
        let [q, dq, tau] =
            [&bag.q, &bag.dq, &bag.tau].map(|channel| Vector::from([channel[0][k], channel[1][k]]));
        let found = node.on_joint_state(q, dq, tau);
        for (series, torque) in external.iter_mut().zip(&found.torque) {
            series.push(*torque);
        }
    }
    Ok(external)
}

/// A bag of the torques on `/external_torque`.
fn published(bag: &Log, external: &[Vec<f64>]) -> Result<Vec<u8>, Box<dyn Error>> {
    let states = JointStates {
        topic: "/external_torque",
        joints: &columns().joints,
        time: &bag.time,
        q: &bag.q,
        dq: &bag.dq,
        tau: external,
    };
    Ok(states.to_mcap()?)
}

/// A bag of an arm that somebody pushes down with 6 N m for a second, as a driver would record it at 500 Hz.
fn pushed() -> Result<Vec<u8>, Box<dyn Error>> {
    let arm = identified();
    let time: Vec<f64> = (0..2000_u32).map(|k| f64::from(k) / 500.0).collect();
    let mut channels = [(); 3].map(|()| vec![Vec::new(); 2]);
    for &t in &time {
        let wave = |a: f64, w: f64| {
            [
                a * (w * t).sin(),
                a * w * (w * t).cos(),
                -a * w * w * (w * t).sin(),
            ]
        };
        let (turn, slide) = (wave(0.8, 1.7), wave(0.2, 2.3));
        let [q, dq, ddq] = [0, 1, 2].map(|k| Vector::from([turn[k], slide[k]]));
        let q = q + Vector::from([0.0, 0.6]);
        let tau = arm.inverse_dynamics(&q, &dq, &ddq) - Vector::from([push(t), 0.0]);
        for (channel, values) in channels.iter_mut().zip([q, dq, tau]) {
            for (series, value) in channel.iter_mut().zip(&values) {
                series.push(*value);
            }
        }
    }
    let [q, dq, tau] = channels;
    let states = JointStates {
        topic: "/joint_states",
        joints: &columns().joints,
        time: &time,
        q: &q,
        dq: &dq,
        tau: &tau,
    };
    Ok(states.to_mcap()?)
}

/// What the push is worth at an instant, N m.
fn push(t: f64) -> f64 {
    if (2.0..3.0).contains(&t) { -6.0 } else { 0.0 }
}

/// Plays the bag of its own making: a push is seen where it is and nowhere else.
fn pushed_arm() -> Result<(), Box<dyn Error>> {
    let bag = Log::from_reader_as("pushed.mcap", pushed()?.as_slice(), &columns())?;
    let external = play(&bag)?;
    // Joint states as any other: a second node could subscribe to them.
    let out = Columns {
        topic: Some("/external_torque".to_owned()),
        ..columns()
    };
    let out = Log::from_reader_as("out.mcap", published(&bag, &external)?.as_slice(), &out)?;
    let settled = 5.0 / POLE;
    for (k, &t) in out.time.iter().enumerate() {
        if (push(t) - push(t - settled)).abs() > 0.0 {
            continue; // the observer is on its way
        }
        let [shoulder, slide] = [out.tau[0][k], out.tau[1][k]];
        assert!((shoulder - push(t)).abs() < 0.1, "{shoulder} N m at {t} s");
        assert!(slide.abs() < 0.1, "{slide} N at {t} s");
    }
    let at = |t: f64| out.tau[0][out.time.partition_point(|time| *time < t)];
    println!(
        "external torque on the shoulder: {:.2} N m at 1 s, {:.2} N m at 2.5 s, {:.2} N m at 3.5 s",
        at(1.0),
        at(2.5),
        at(3.5)
    );
    Ok(())
}

/// Plays one bag into another, or the one of its own making.
///
/// # Errors
/// Bags that cannot be read or written, or are of another arm.
pub fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let ["--play", from, to] = arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] else {
        return pushed_arm();
    };
    let bag = Log::read_as(from, &columns())?;
    let external = play(&bag)?;
    std::fs::write(to, published(&bag, &external)?)?;
    println!("{} messages on /external_torque in {to}", bag.time.len());
    Ok(())
}
