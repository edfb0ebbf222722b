//! Equations (4) and (13) beside those that the compiler derives from the energies.

use rand::{RngExt as _, SeedableRng};
use rand_chacha::ChaCha8Rng;
use robot_model::signal::FirstOrder;
use robot_model::trace::{Outcome, Verdict};
use robot_model::{Mechanics as _, RobotModel as _, Vector};

use super::device::Phantom;
use super::plant::Three;
use super::sensors::RATE;
use super::sines::Sines;
use super::tracing::{FASTER, said, term};
use super::truth::{CORNER, NAMES};
use crate::paper::{Error, Row};

/// A row a parameter, a column a joint, as the paper has its regressors.
pub(super) type Transposed = [Three; 8];

/// Equation (4); `sign` is that of the last term of `pi4` on joint 3, printed as +1.
fn printed_regressor(q: &Three, v: &Three, a: &Three, sign: f64) -> Transposed {
    let [_, t2, t3] = *q;
    let (s2, c2, s3, c3) = (t2.sin(), t2.cos(), t3.sin(), t3.cos());
    let (s23, c23) = ((t2 - t3).sin(), (t2 - t3).cos());
    let (s22, c22) = ((2.0 * t2).sin(), (2.0 * t2).cos());
    let (s33, c33) = ((2.0 * t3).sin(), (2.0 * t3).cos());
    [
        [a[0], 0.0, 0.0],
        [
            a[0] * c22 - 2.0 * v[0] * v[1] * s2 * c2 - v[0] * v[1] * s22,
            v[0] * v[0] * s22,
            0.0,
        ],
        [
            a[0] * c33 - 2.0 * v[0] * v[2] * s3 * c3 - v[0] * v[2] * s33,
            0.0,
            v[0] * v[0] * s33,
        ],
        [
            a[0] * c2 * s3 - v[0] * v[1] * s2 * s3 + v[0] * v[2] * c2 * c3,
            0.5 * (-a[2] * s23 + v[0] * v[0] * s2 * s3 + v[2] * v[2] * c23),
            0.5 * (-a[1] * s23 - v[0] * v[0] * c2 * c3 + sign * v[1] * v[1] * c23),
        ],
        [0.0, a[1], 0.0],
        [0.0, 0.0, a[2]],
        [0.0, c2, 0.0],
        [0.0, 0.0, s3],
    ]
}

/// Equation (13) as `Y_L = w (p - L{p}) + L{h} + u`: `p`, `h`, and `u` that is printed without the filter. The squared
/// velocity of joint 2 is in the row of `pi4` on joint 3 so many times, printed once.
pub(super) fn printed_filtered(q: &Three, v: &Three, times: f64) -> [Transposed; 3] {
    let [_, t2, t3] = *q;
    let (s2, c2, s3, c3) = (t2.sin(), t2.cos(), t3.sin(), t3.cos());
    let (s23, c23) = ((t2 - t3).sin(), (t2 - t3).cos());
    let (c22, c33) = ((2.0 * t2).cos(), (2.0 * t3).cos());
    let none = [0.0; 3];
    let momentum = [
        [v[0], 0.0, 0.0],
        [v[0] * c22, 0.0, 0.0],
        [v[0] * c33, 0.0, 0.0],
        [v[0] * c2 * s3, -0.5 * v[2] * s23, -0.5 * v[1] * s23],
        [0.0, v[1], 0.0],
        [0.0, 0.0, v[2]],
        none,
        none,
    ];
    let filtered = [
        none,
        none,
        none,
        [
            0.0,
            0.5 * (v[1] * v[2] * c23 + v[0] * v[0] * s2 * s3),
            times * v[1] * v[1] * c23 - 0.5 * v[0] * v[0] * c2 * c3 - 0.5 * v[1] * v[2] * c23,
        ],
        none,
        none,
        none,
        none,
    ];
    let bare = [
        none,
        [0.0, v[0] * v[0] * (2.0 * t2).sin(), 0.0],
        [0.0, 0.0, v[0] * v[0] * (2.0 * t3).sin()],
        none,
        none,
        none,
        [0.0, c2, 0.0],
        [0.0, 0.0, s3],
    ];
    [momentum, filtered, bare]
}

/// The rigid columns of one of the compiler's regressors, in the paper's order.
fn transposed(regressor: &robot_model::Matrix<3, 14>) -> Transposed {
    std::array::from_fn(|k| {
        let names = Phantom::STANDARD_PARAMETERS;
        let column = names.iter().position(|name| *name == NAMES[k]);
        column.map_or([f64::NAN; 3], |c| {
            std::array::from_fn(|joint| regressor[(joint, c)])
        })
    })
}

/// An entry that is printed otherwise than it is derived, as `(parameter, joint)` from 0.
pub type Place = (usize, usize);

/// What is printed otherwise than derived, and by how much, in states by chance.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Entries of (4).
    pub regressor: Vec<Place>,
    /// Largest difference of all other entries of (4).
    pub regressor_rest: f64,
    /// How far the difference is from `dtheta2^2 cos(theta2 - theta3)`, at most.
    pub regressor_sign: f64,
    /// Entries of (13), with a filter over all that is not `w (p - L{p})`.
    pub filtered: Vec<Place>,
    /// Largest difference of all other entries of (13).
    pub filtered_rest: f64,
    /// How far the difference is from `dtheta2^2 cos(theta2 - theta3)`, at most.
    pub filtered_sign: f64,
}

/// Smaller differences are rounding.
const ROUNDING: f64 = 1e-12;

/// Compares (4) and (13) with what the compiler derives from the energies, as they are printed or with the sign of (4) put right.
#[must_use]
pub fn compare(is_repaired: bool) -> Comparison {
    let (own_sign, times) = if is_repaired { (-1.0, 0.0) } else { (1.0, 1.0) };
    let mut random = ChaCha8Rng::seed_from_u64(41);
    let mut found = Comparison {
        regressor: Vec::new(),
        regressor_rest: 0.0,
        regressor_sign: 0.0,
        filtered: Vec::new(),
        filtered_rest: 0.0,
        filtered_sign: 0.0,
    };
    for _ in 0..100 {
        let mut three = || -> Three { std::array::from_fn(|_| random.random_range(-2.0..2.0)) };
        let (q, v, a) = (three(), three(), three());
        let (x, dx, ddx) = (Vector::from(q), Vector::from(v), Vector::from(a));
        let derived = transposed(&Phantom::regressor(&x, &dx, &ddx));
        let momentum = transposed(&Phantom::momentum_regressor(&x, &dx));
        let drift = transposed(&Phantom::drift_regressor(&x, &dx));
        let printed = printed_regressor(&q, &v, &a, own_sign);
        let [printed_momentum, filtered, bare] = printed_filtered(&q, &v, times);
        let sign = v[1] * v[1] * (q[1] - q[2]).cos();
        for k in 0..8 {
            for joint in 0..3 {
                let off = printed[k][joint] - derived[k][joint];
                note(
                    &mut found.regressor,
                    &mut found.regressor_rest,
                    off,
                    (k, joint),
                );
                if (k, joint) == SIGN {
                    found.regressor_sign = found.regressor_sign.max((off - sign).abs());
                }
                // `Y_L = w (p - L{p}) - L{drift}`
                let off = filtered[k][joint] + bare[k][joint] + drift[k][joint];
                let off = off.abs() + (printed_momentum[k][joint] - momentum[k][joint]).abs();
                note(
                    &mut found.filtered,
                    &mut found.filtered_rest,
                    off,
                    (k, joint),
                );
                if (k, joint) == SIGN {
                    found.filtered_sign = found.filtered_sign.max((off - sign.abs()).abs());
                }
            }
        }
    }
    found
}

/// The entry with the wrong sign: `pi4` on joint 3, and the function of the motion there.
pub(super) const SIGN: Place = (3, 2);
const TERM: &str = "cos(theta2 - theta3) dtheta2^2";

fn note(places: &mut Vec<Place>, rest: &mut f64, off: f64, place: Place) {
    if off.abs() <= ROUNDING {
        *rest = rest.max(off.abs());
    } else if !places.contains(&place) {
        places.push(place);
    }
}

/// Whether the only entry of (13) that differs is that one, and by its term.
pub(super) fn is_sign(found: &Comparison) -> bool {
    found.filtered == [SIGN] && found.filtered_sign < ROUNDING
}

/// An entry of (13) whose series is off, and by how much, in percent of the derived one.
pub type Off = (Place, f64);

/// Series are off beyond that, percent.
const SERIES: f64 = 0.1;

/// Samples of a motion along which series are compared.
const SAMPLES: u32 = 20_000;

/// The first of them that counts: by then filters have forgotten where they started.
const BEGUN: usize = 2000;

/// Entries of (13), with its sign put right, whose series along a motion are not those that are derived: with the filters that are printed,
/// or with one over all that is not `w (p - L{p})`.
///
/// # Errors
/// None are expected; those of the filter are passed on.
pub fn off_along(motion: &Sines, passes_all: bool) -> Result<Vec<Off>, Error> {
    let filter = FirstOrder::new(CORNER, RATE)?;
    let mut printed = vec![[[[0.0; 3]; 8]; 3]; 0];
    let mut derived = Vec::new();
    for k in 0..SAMPLES {
        let [q, v, _] = motion.at(f64::from(k) / RATE);
        let (x, dx) = (Vector::from(q), Vector::from(v));
        printed.push(printed_filtered(&q, &v, 0.0));
        derived.push([
            transposed(&Phantom::momentum_regressor(&x, &dx)),
            transposed(&Phantom::drift_regressor(&x, &dx)),
        ]);
    }
    let passed = |series: &[f64]| {
        let mut out = Vec::new();
        filter.apply(0.0, series, &mut out);
        out
    };
    let rate = |series: &[f64]| {
        let mut out = Vec::new();
        filter.apply_to_rate(series, &mut out);
        out
    };
    let mut found = Vec::new();
    for (k, joint) in (0..8).flat_map(|k| (0..3).map(move |joint| (k, joint))) {
        let of =
            |part: usize| -> Vec<f64> { printed.iter().map(|all| all[part][k][joint]).collect() };
        let own =
            |part: usize| -> Vec<f64> { derived.iter().map(|all| all[part][k][joint]).collect() };
        let (momentum, inside, bare) = (rate(&of(0)), passed(&of(1)), of(2));
        let bare = if passes_all { passed(&bare) } else { bare };
        let (own_momentum, own_drift) = (rate(&own(0)), passed(&own(1)));
        let (mut off, mut size) = (0.0, 0.0);
        for i in BEGUN..bare.len() {
            let wanted = own_momentum[i] - own_drift[i];
            off += (momentum[i] + inside[i] + bare[i] - wanted).powi(2);
            size += wanted.powi(2);
        }
        let percent = 100.0 * (off / size).sqrt();
        if percent > SERIES {
            found.push(((k, joint), percent));
        }
    }
    Ok(found)
}

pub(super) fn names(places: &[Place]) -> String {
    let all: Vec<String> = places
        .iter()
        .map(|(k, joint)| format!("{} on joint {}", NAMES[*k], joint + 1))
        .collect();
    if all.is_empty() {
        "none".to_owned()
    } else {
        all.join(", ")
    }
}

/// What the tracer says where (4) is the model: of print, of what is mended.
fn traced([printed, mended]: &[Verdict; 2]) -> (String, bool) {
    let term = term(printed);
    let said = term.map_or_else(
        || said(printed),
        |(joint, term)| {
            format!(
                "{} on joint {}, times {:.2e}, {:.0} % of what is left",
                term.term,
                joint + 1,
                term.coefficient,
                100.0 * term.share
            )
        },
    );
    let is_told = term.is_some_and(|(joint, term)| joint == SIGN.1 && term.term == TERM);
    (
        format!("{said}; with a minus {}", mended.outcome),
        is_told && mended.outcome == Outcome::NothingMissing,
    )
}

/// Items 4.1.
#[must_use]
pub fn rows(found: &Comparison, equation_4: &[Verdict; 2]) -> Vec<Row> {
    let (traced, is_traced) = traced(equation_4);
    vec![
        Row::holds(
            "4.1",
            "entries of (4) that follow from the energies, of 24",
            "24",
            format!(
                "{}, the others to {:.0e}",
                24 - found.regressor.len(),
                found.regressor_rest.max(1e-16)
            ),
            found.regressor.iter().all(|place| *place == SIGN),
            "other entries differ, too",
        ),
        Row::wrong_in_print(
            "4.1.sign",
            "(4), pi4 on joint 3: sign of 1/2 dtheta2^2 cos(theta2 - theta3)",
            "+",
            format!(
                "differs from the derived one: {}; the tracer, with (4) as the model of UR with viscous friction that brakes, on a motion {FASTER} times as fast: {traced}",
                names(&found.regressor)
            ),
            found.regressor == [SIGN] && found.regressor_sign < ROUNDING && is_traced,
            "Lagrange's equations have a minus",
        ),
    ]
}
