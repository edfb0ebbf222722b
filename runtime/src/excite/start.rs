//! Motions to start from, inside all limits.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::fourier::Ends;
use super::problem::{Problem, each_slack};
use super::{ExciteError, Request};

/// Poses that are tried before limits are said to leave no motion.
const TRIES: usize = 300;

/// Part of a joint's range from which poses are drawn.
const INNER: f64 = 0.8;

/// Slack that a start keeps of every limit.
const ROOM: f64 = 0.05;

/// Variables of a random motion inside the limits.
pub(super) fn inside(
    request: &Request,
    problem: &Problem<'_>,
    start: usize,
) -> Result<Vec<f64>, ExciteError> {
    let mut random = ChaCha8Rng::seed_from_u64(request.seed);
    random.set_stream(start as u64);
    let mut last = None;
    for _ in 0..TRIES {
        let mut pose = vec![0.0; problem.len()];
        let mut wave = vec![0.0; problem.len()];
        for (joint, range) in problem.parts() {
            let (middle, half) = request.limits.range(joint);
            for (k, place) in range.clone().enumerate() {
                let draw: f64 = random.random_range(-1.0..1.0);
                if k == 0 && !matches!(request.ends, Ends::At(_)) {
                    pose[place] = middle + INNER * half * draw;
                } else {
                    wave[place] = request.limits.velocity[joint] * draw;
                }
            }
        }
        let at = |size: f64| -> Vec<f64> {
            let pairs = pose.iter().zip(&wave);
            pairs.map(|(pose, wave)| pose + size * wave).collect()
        };
        // Half as large until it fits.
        let sizes = (0..24).map(|halvings| 0.5f64.powi(halvings));
        for size in sizes {
            let z = at(size);
            if problem.least_slack(&problem.motion(&z)) > ROOM {
                return Ok(z);
            }
        }
        last = Some(at(0.0));
    }
    Err(worst(request, problem, &last.unwrap_or_default()))
}

/// Which limit a pose misses most.
fn worst(request: &Request, problem: &Problem<'_>, z: &[f64]) -> ExciteError {
    let motion = problem.motion(z);
    let (mut least, mut what) = (f64::INFINITY, "positions".to_owned());
    for clearance in &request.clearances {
        each_slack(&**clearance, &motion, &mut |which, slack| {
            if slack < least {
                (least, what) = (slack, clearance.name(which));
            }
        });
    }
    for (joint, name) in request.joints.iter().enumerate() {
        let (middle, half) = request.limits.range(joint);
        let slack = 1.0 - (motion.q[joint][0] - middle).abs() / half;
        if slack < least {
            (least, what) = (slack, format!("position of `{name}`"));
        }
    }
    ExciteError::Infeasible {
        tries: TRIES,
        what,
        percent: -100.0 * (least - ROOM).min(0.0),
    }
}

/// Draws `z` toward `inside` until it keeps all limits with what is reserved.
pub(super) fn back_inside(problem: &Problem<'_>, inside: &[f64], z: &mut [f64]) {
    while problem.least_slack(&problem.motion(z)) <= 1e-6 {
        for (z, inside) in z.iter_mut().zip(inside) {
            *z = inside + 0.9 * (*z - inside);
        }
    }
}
