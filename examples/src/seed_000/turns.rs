//! That simulated motions come through turn-arounds.

use robot_model::simulate::Work;
use robot_model_spec::amend::{Amendment, amend};

use super::law::{Law, SHOULDER};
use super::motion::{apart, simulate};
use super::plant::{Arm, Experiment};
use super::truth::{ARM, SAMPLES};
use super::words::{InWords, in_words};
use crate::paper::{Error, compiled};

/// A motion through turn-arounds by the simulator and by the hand-written one.
#[derive(Debug, Clone)]
pub struct Turns {
    /// Largest difference, rad.
    pub apart: f64,
    /// What the simulator took.
    pub work: Work,
    /// Steps a sample.
    pub steps: f64,
    /// Samples at rest.
    pub resting: usize,
}

/// Dry friction over the inertia, rad/s^2: of 0.7 V.
const DRY: f64 = 0.7 * ARM[1];

/// The experiment with law (6.3), and one with dry friction besides that stops the arm between its swings.
///
/// # Errors
/// Where the simulator stops.
pub fn turns(experiment: &Experiment) -> Result<[Turns; 2], Error> {
    let of = |plant: InWords, path: &[f64], drive: &[f64]| -> Result<Turns, Error> {
        let found = simulate(plant, [0.0, 0.0], drive, true)?;
        let Work {
            explicit,
            implicit,
            impulses,
            ..
        } = found.work;
        let rests = path.windows(2).filter(|pair| pair[1] - pair[0] == 0.0);
        Ok(Turns {
            apart: apart(&found.angle, path),
            work: found.work,
            steps: (explicit + implicit + impulses) as f64 / f64::from(SAMPLES),
            resting: rests.count(),
        })
    };
    let plain = of(
        Law::Directional.plant(&ARM)?,
        &experiment.angle,
        &experiment.command,
    )?;
    let dry = Arm {
        values: ARM,
        dry: DRY,
    };
    // Three quarters of a second each: forward, none, backward, none.
    let drive: Vec<f64> = (0..SAMPLES)
        .map(|k| [2.5, 0.0, -2.5, 0.0][(4 * k / 90 % 4) as usize])
        .collect();
    let mut state = [0.0, 0.0];
    let path = drive.iter().map(|v| {
        let now = state[0];
        state = dry.sample_later(state, *v);
        now
    });
    let path: Vec<f64> = path.collect();
    let effects = ["direction_law", "coulomb_friction"].map(|effect| Amendment {
        effect: effect.to_owned(),
        joints: vec!["th".to_owned()],
        shapes: Vec::new(),
    });
    let spec = compiled(
        "shoulder.robot",
        &amend("shoulder.robot", SHOULDER, &effects)?,
    )?;
    let plant = in_words(spec, &[ARM.as_slice(), &[DRY]].concat())?;
    Ok([plain, of(plant, &path, &drive)?])
}
