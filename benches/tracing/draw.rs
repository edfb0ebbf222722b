//! What chance decides of an experiment: joint, motion and noise, drawn apart from each other and for every effect, arm and seed anew.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::arms::ARMS;
use crate::catalogue::{Injection, Place};
use crate::experiment::Case;

/// The effect that comes back in every period, and so needs periods.
const OF_PERIODS: &str = "recurring_force";

/// What is drawn. All sizes of a known effect share it, so that a curve over sizes is of one motion.
#[derive(Debug)]
pub struct Draw {
    /// Joints that the effect is on, from 0.
    pub joints: Vec<usize>,
    /// Whether the motion repeats; one in two does.
    pub repeats: bool,
    /// Seeds of both motions, and of both logs' noise.
    pub motions: [u64; 2],
    pub noises: [u64; 2],
}

impl Draw {
    /// Of this experiment: a stream of its own for every arm and place in the catalogue, and for every size where no name is right, whose rates no
    /// curve over sizes shows. What is added at the end of the catalogue changes no other.
    pub fn new(case: &Case) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(case.seed);
        let size = if case.injection.is_named() {
            0
        } else {
            case.share.to_bits()
        };
        let own = (place(ARMS, case.arm) as u64) << 32 | (case.number() as u64) << 16;
        random.set_stream(own ^ size);
        // Each is drawn whether it is needed or not: what one effect needs changes no other draw.
        let turn = random.random_range(0..u32::MAX) as usize;
        let repeats = random.random_bool(0.5) || case.injection.effect() == OF_PERIODS;
        Self {
            joints: joints(case.injection, case.arm.joints.len(), turn),
            repeats,
            motions: random.random(),
            noises: random.random(),
        }
    }
}

/// The joints that turn `turn` has.
fn joints(injection: &Injection, dof: usize, turn: usize) -> Vec<usize> {
    match injection.place {
        // The last link's error is a payload.
        Place::Joint if injection.kind == "link-inertial-error" => vec![turn % (dof - 1)],
        Place::Joint | Place::Log => vec![turn % dof],
        Place::Pair => {
            let first = turn % (dof - 1);
            vec![first, first + 1]
        }
        Place::Last => vec![dof - 1],
        Place::Arm | Place::Nowhere => Vec::new(),
    }
}

/// Where `one` is in `all`.
pub fn place<T>(all: &[T], one: &T) -> usize {
    let is_it = |other: &T| std::ptr::eq(other, one);
    all.iter().position(is_it).expect("a case is of the lists")
}
