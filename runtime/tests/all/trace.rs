//! The tracer on a plant: names what is missing, says nothing when nothing is, abstains when it knows no name.

use super::laws::{Law, names};
use super::plant::{Pendulums, Plant, TRUTH, sign};
use robot_model::columns::{Arm, Candidate, Columns, Entry, Shape, Unknown};
use robot_model::log::Log;
use robot_model::motion::Motion;
use robot_model::trace::{Outcome, Quantity, Trace, Verdict};

/// A small library on both joints.
fn library() -> Vec<Law> {
    let speeds: Vec<f64> = (0..12)
        .map(|k| 0.005 * 100.0_f64.powf(f64::from(k) / 11.0))
        .collect();
    (0..2)
        .flat_map(|j| {
            [
                Law::new("torque-offset", j, false, None, |_, _, _| 1.0),
                Law::new("asymmetric-viscous", j, false, None, |_, v, _| v.abs()),
                Law::new("quadratic-viscous", j, true, None, |_, v, _| v * v.abs()),
                Law::new("joint-spring", j, true, None, |q, _, _| q),
                Law::new("stribeck", j, true, Some(speeds.clone()), |_, v, s| {
                    sign(v) * (-(v / s).powi(2)).exp()
                }),
            ]
        })
        .collect()
}

fn trace(plant: &Plant) -> Verdict {
    traced(&[plant.log()])
}

fn traced(logs: &[Log]) -> Verdict {
    let library = library();
    let candidates = library.iter().map(|law| law as &dyn Candidate).collect();
    Trace::new(candidates)
        .run(&Pendulums::new(), logs, &mut |_| ())
        .expect("the logs are sound")
}

#[test]
fn nothing_missing_in_white_and_colored_noise() {
    for seed in 1..6 {
        for (white, colored) in [(0.05, 0.0), (0.02, 0.08)] {
            for periodic in [true, false] {
                let verdict = trace(&Plant {
                    seed,
                    periodic,
                    white,
                    colored,
                    ..Plant::default()
                });
                assert_eq!(
                    verdict.outcome,
                    Outcome::NothingMissing,
                    "seed {seed}, {periodic}: {verdict:#?}"
                );
                assert!(verdict.findings.is_empty() && verdict.leads.is_empty());
            }
        }
    }
}

#[test]
fn a_missing_effect_is_named_on_its_joint() {
    type Extra = fn(usize, [f64; 2], [f64; 2]) -> f64;
    let cases: [(&str, usize, Extra); 4] = [
        ("quadratic-viscous", 1, |j, _, v| {
            if j == 0 { 0.6 * v[0] * v[0].abs() } else { 0.0 }
        }),
        (
            "joint-spring",
            2,
            |j, q, _| if j == 1 { 1.5 * q[1] } else { 0.0 },
        ),
        ("asymmetric-viscous", 2, |j, _, v| {
            if j == 1 { 0.3 * v[1].abs() } else { 0.0 }
        }),
        ("stribeck", 1, |j, _, v| {
            if j == 0 {
                1.2 * v[0].signum() * (-(v[0] / 0.2_f64).powi(2)).exp()
            } else {
                0.0
            }
        }),
    ];
    for (kind, joint, extra) in cases {
        for periodic in [true, false] {
            let verdict = trace(&Plant {
                periodic,
                extra,
                ..Plant::default()
            });
            assert_eq!(verdict.outcome, Outcome::Explained, "{kind}: {verdict:#?}");
            assert_eq!(names(&verdict), [(kind, joint)]);
        }
    }
}

#[test]
fn the_shape_and_size_of_a_found_effect_are_right() {
    let verdict = trace(&Plant {
        extra: |j, _, v| {
            if j == 0 {
                1.2 * v[0].signum() * (-(v[0] / 0.2_f64).powi(2)).exp()
            } else {
                0.0
            }
        },
        ..Plant::default()
    });
    let found = &verdict.findings[0].parameters;
    assert!((found[0].value - 1.2).abs() < 0.1, "{found:?}");
    assert!(
        found[1].shape && (found[1].value - 0.2).abs() < 0.03,
        "{found:?}"
    );
}

#[test]
fn two_effects_on_two_joints_are_both_found() {
    let verdict = trace(&Plant {
        extra: |j, _, v| if j == 0 { 0.8 } else { 0.5 * v[1] * v[1].abs() },
        ..Plant::default()
    });
    let mut found = names(&verdict);
    found.sort_unstable();
    assert_eq!(found, [("quadratic-viscous", 2), ("torque-offset", 1)]);
}

#[test]
fn an_effect_outside_the_library_gets_no_name() {
    for periodic in [true, false] {
        let verdict = trace(&Plant {
            extra: |j, _, v| if j == 0 { 1.5 * v[0] * v[1] } else { 0.0 },
            periodic,
            ..Plant::default()
        });
        assert_eq!(verdict.outcome, Outcome::Unexplained, "{verdict:#?}");
        assert!(verdict.findings.is_empty());
        assert!(verdict.after[0].is_material() && !verdict.after[1].is_material());
        let most = &verdict.left[0].shares[0];
        assert!(
            most.of == Quantity::Velocities(0, 1) && most.share > 0.7,
            "{:?}",
            verdict.left
        );
    }
}

/// A torque in a window of positions, which a motion that does not come again passes now and then.
#[test]
fn a_window_of_positions_is_told_as_such() {
    let verdict = trace(&Plant {
        extra: |j, q, _| f64::from(u8::from(j == 0 && (0.1..0.5).contains(&q[0]))),
        periodic: false,
        ..Plant::default()
    });
    assert_eq!(verdict.outcome, Outcome::Unexplained, "{verdict:#?}");
    let most = &verdict.left[0].shares[0];
    assert!(
        most.of == Quantity::Position(0) && most.share > 0.7,
        "{:?}",
        verdict.left
    );
}

/// Noise that is alike over as long as a law is has no less power there than above, so that no structure is seen.
#[test]
fn a_law_that_hides_in_slow_noise_is_missing_all_the_same() {
    for (size, wanted) in [(0.0, Outcome::NothingMissing), (1.0, Outcome::Unexplained)] {
        let with: fn(usize, [f64; 2], [f64; 2]) -> f64 = if size > 0.0 {
            |j, _, v| if j == 0 { 0.3 * v[0] * v[1] } else { 0.0 }
        } else {
            |_, _, _| 0.0
        };
        let verdict = trace(&Plant {
            extra: with,
            periodic: false,
            seconds: 60,
            colored: 0.3,
            correlated_s: 0.03,
            ..Plant::default()
        });
        assert!(!verdict.after[0].is_material(), "{:?}", verdict.after);
        assert_eq!(verdict.outcome, wanted, "{:?}", verdict.left);
    }
}

/// The zero of a torque sensor wanders so slowly that a short log has little else than its mean, which no offset explains beyond chance, and
/// which is in a curve of any quantity.
#[test]
fn a_zero_that_is_off_by_chance_follows_no_motion() {
    for seed in 1..7 {
        let verdict = trace(&Plant {
            seed,
            seconds: 12,
            white: 0.02,
            colored: 0.1,
            correlated_s: 20.0,
            ..Plant::default()
        });
        let told = (&verdict.findings, &verdict.left);
        assert_eq!(
            verdict.outcome,
            Outcome::NothingMissing,
            "{seed}: {told:#?}"
        );
    }
}

/// A law that takes a part off the error, beside one of no library that hides in slow noise: what is left most of may be another law.
#[test]
fn a_name_that_leaves_most_is_doubted_for_what_hides_in_slow_noise() {
    type Extra = fn(usize, [f64; 2], [f64; 2]) -> f64;
    let named: Extra = |j, _, v| if j == 0 { 0.5 * v[0] * v[0].abs() } else { 0.0 };
    let both: Extra = |j, _, v| {
        if j == 0 {
            0.5 * v[0] * v[0].abs() + 0.3 * v[0] * v[1]
        } else {
            0.0
        }
    };
    for (extra, wanted) in [(named, Outcome::Explained), (both, Outcome::Unexplained)] {
        let verdict = trace(&Plant {
            extra,
            periodic: false,
            seconds: 120,
            colored: 0.3,
            correlated_s: 0.03,
            ..Plant::default()
        });
        assert!(!verdict.after[0].is_material(), "{:?}", verdict.after);
        assert_eq!(verdict.outcome, wanted, "{verdict:#?}");
        let found = verdict.findings.iter().chain(&verdict.leads);
        let kinds: Vec<&str> = found.map(|one| one.kind.as_str()).collect();
        assert_eq!(kinds, ["quadratic-viscous"], "{verdict:#?}");
    }
}

#[test]
fn a_negative_coefficient_is_no_law() {
    // Torque that falls with the square of speed is not churning: its coefficient would be negative.
    let verdict = trace(&Plant {
        extra: |j, _, v| {
            if j == 0 {
                -0.6 * v[0] * v[0].abs()
            } else {
                0.0
            }
        },
        ..Plant::default()
    });
    assert!(
        names(&verdict)
            .iter()
            .all(|(kind, _)| *kind != "quadratic-viscous"),
        "{verdict:#?}"
    );
}

/// A ripple above the band of the fit leaves no structure in it, but far more than what differs from period to period.
#[test]
fn what_comes_back_above_the_band_is_missing_all_the_same() {
    let traced = |extra: fn(usize, [f64; 2], [f64; 2]) -> f64| {
        trace(&Plant {
            extra,
            periodic: true,
            ..Plant::default()
        })
    };
    let verdict = traced(|j, q, _| {
        if j == 0 {
            1.5 * (150.0 * q[0]).sin()
        } else {
            0.0
        }
    });
    assert_eq!(verdict.outcome, Outcome::Unexplained, "{verdict:#?}");
    let exceeded = |verdict: &Verdict| -> Vec<bool> {
        let floors = verdict.noise_floor.iter();
        floors.map(|floor| floor.exceeded().is_some()).collect()
    };
    assert_eq!(exceeded(&verdict), [true, false]);
    assert_eq!(exceeded(&traced(|_, _, _| 0.0)), [false, false]);
}

/// A log in which a brake holds the second joint, with a torque that is noise.
fn parked(plant: &Plant) -> Log {
    let mut log = plant.log();
    log.q[1].fill(0.8);
    log
}

#[test]
fn a_joint_that_a_brake_holds_says_nothing_of_the_others() {
    let plant = Plant {
        extra: |j, _, v| if j == 0 { 0.6 * v[0] * v[0].abs() } else { 0.0 },
        ..Plant::default()
    };
    let verdict = traced(&[parked(&plant)]);
    assert_eq!(names(&verdict), [("quadratic-viscous", 1)], "{verdict:#?}");
}

#[test]
fn rows_that_a_fit_leaves_out_are_none_of_a_law_either() {
    let plant = Plant {
        extra: |j, q, _| if j == 1 { 1.5 * q[1] } else { 0.0 },
        ..Plant::default()
    };
    let other = Plant { seed: 2, ..plant };
    let verdict = traced(&[parked(&plant), other.log()]);
    assert_eq!(names(&verdict), [("joint-spring", 2)], "{verdict:#?}");
    let value = verdict.findings[0].parameters[0].value;
    assert!((value - 1.5).abs() < 0.1, "{value}");
}

/// The pendulums with inertia and gravity that are known.
struct Known {
    arm: Pendulums,
    friction: Vec<Unknown>,
}

impl Known {
    fn new() -> Self {
        let arm = Pendulums::new();
        let of_friction = arm.unknowns().iter().filter(|unknown| unknown.nonnegative);
        let friction = of_friction.cloned().collect();
        Self { arm, friction }
    }
}

impl Columns for Known {
    fn unknowns(&self) -> &[Unknown] {
        &self.friction
    }

    fn shapes(&self) -> &[Shape] {
        &[]
    }

    fn uses_rigid_torque(&self) -> bool {
        false
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let all = self.arm.entries(motion, shapes).into_iter();
        let friction = all.filter(|entry| entry.column % 4 >= 2);
        let numbered = friction.enumerate();
        numbered
            .map(|(column, entry)| Entry { column, ..entry })
            .collect()
    }
}

impl Arm for Known {
    fn dof(&self) -> usize {
        2
    }

    fn joints(&self) -> &[String] {
        self.arm.joints()
    }

    fn actuator_gain(&self) -> &[f64] {
        self.arm.actuator_gain()
    }

    fn known_torque(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        self.arm.rigid_torque(motion, shapes, &TRUTH)
    }

    fn rigid_torque(&self, motion: &Motion, shapes: &[f64], _: &[f64]) -> Vec<Vec<f64>> {
        self.arm.rigid_torque(motion, shapes, &TRUTH)
    }
}

/// Where a motion repeats to the last digit its encoder's steps do, too, and what they make of the torque is the same in every period.
#[test]
fn steps_of_a_coarse_encoder_come_back_and_are_nothing() {
    let plant = Plant {
        encoder: std::f64::consts::TAU / 4096.0,
        white: 0.02,
        ..Plant::default()
    };
    let arms: [&dyn Arm; 2] = [&Pendulums::new(), &Known::new()];
    for arm in arms {
        let verdict = Trace::new(Vec::new())
            .run(arm, &[plant.log()], &mut |_| ())
            .expect("the log is sound");
        let floors = &verdict.noise_floor;
        assert_eq!(verdict.outcome, Outcome::NothingMissing, "{floors:?}");
        // They are what the model leaves, above the floor.
        assert!(floors[0].rms < 0.1, "{floors:?}");
    }
}
