//! Motions to start from, inside all limits.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::fourier::Ends;
use super::problem::Problem;
use super::slack::{each_slack, lesser};
use super::{ExciteError, Request};

/// Poses that are tried before limits are said to leave no motion.
const TRIES: usize = 300;

/// Part of a joint's range from which poses are drawn.
const INNER: f64 = 0.8;

/// Slack that a start keeps of every limit, and what it makes do with.
const ROOM: [f64; 3] = [0.05, 0.005, 1e-4];

/// Halvings of a wave until it is taken for none.
const HALVINGS: i32 = 24;

/// Contractions by a tenth toward a start until nothing is left of the way.
const CONTRACTIONS: usize = 200;

/// Variables of a random motion inside the limits.
pub(super) fn inside(
    request: &Request,
    problem: &Problem<'_>,
    start: usize,
) -> Result<Vec<f64>, ExciteError> {
    let mut last = Vec::new();
    for room in ROOM {
        let mut random = ChaCha8Rng::seed_from_u64(request.seed);
        random.set_stream(start as u64);
        for _ in 0..TRIES {
            let (pose, wave) = draw(request, problem, &mut random);
            let at = |size: f64| -> Vec<f64> {
                let pairs = pose.iter().zip(&wave);
                pairs.map(|(pose, wave)| pose + size * wave).collect()
            };
            last = at(0.5f64.powi(HALVINGS));
            let still = problem.least_slack(&problem.motion(&at(0.0)));
            if still.is_nan() || still <= room {
                continue;
            }
            // Half as large until it fits.
            let mut sizes = (0..HALVINGS).map(|halvings| at(0.5f64.powi(halvings)));
            let fits = |z: &Vec<f64>| problem.least_slack(&problem.motion(z)) > room;
            if let Some(z) = sizes.find(fits)
                && request.missing(problem, &z).is_none()
            {
                return Ok(z);
            }
        }
    }
    Err(worst(request, problem, &last))
}

/// A random pose and a random motion around it.
fn draw(request: &Request, problem: &Problem<'_>, random: &mut ChaCha8Rng) -> (Vec<f64>, Vec<f64>) {
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
    (pose, wave)
}

/// Which limit a small motion misses most.
fn worst(request: &Request, problem: &Problem<'_>, z: &[f64]) -> ExciteError {
    let motion = problem.motion(z);
    let (mut least, mut what, mut by) = (f64::INFINITY, "positions".to_owned(), String::new());
    for clearance in &request.clearances {
        each_slack(
            &**clearance,
            clearance.exact(),
            &motion,
            &mut |which, slack| {
                let slack = lesser(f64::INFINITY, slack);
                if slack < least {
                    (least, what) = (slack, clearance.name(which));
                    by = clearance.amount(slack.min(0.0));
                }
            },
        );
    }
    for (joint, name) in request.joints.iter().enumerate() {
        let (middle, half) = request.limits.range(joint);
        let slack = 1.0 - (motion.q[joint][0] - middle).abs() / half;
        if slack < least {
            (least, what) = (slack, format!("position of `{name}`"));
            by = match -100.0 * slack.min(0.0) {
                percent if percent < 1.0 => "less than 1 %".to_owned(),
                percent => format!("{percent:.0} %"),
            };
        }
    }
    let poses = match request.ends {
        Ends::At(_) => "the given pose does not".to_owned(),
        _ => format!("none of {TRIES} random poses does"),
    };
    ExciteError::Infeasible { poses, what, by }
}

/// Draws `z` toward `inside` until it keeps all limits with what is reserved; whether it does in the end.
pub(super) fn back_inside(problem: &Problem<'_>, inside: &[f64], z: &mut [f64]) -> bool {
    for _ in 0..CONTRACTIONS {
        if problem.least_slack(&problem.motion(z)) > 1e-6 {
            return true;
        }
        for (z, inside) in z.iter_mut().zip(inside) {
            *z = inside + 0.9 * (*z - inside);
        }
    }
    false
}
