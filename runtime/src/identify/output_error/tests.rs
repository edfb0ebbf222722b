//! A block on a table, that is pushed.

mod cogs;
mod controller;
mod hold;
mod pace;
mod share;
mod starts;
mod torques;
mod upright;

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::log::{Channel, Log};
use crate::simulate::{
    Drive, Instant, Integrator, Jumps, ParameterSlopes, Plant, Slopes, Tolerances,
};

/// `m ddq + c dq + f sign(dq) = tau`, and what does nothing.
#[derive(Debug, Clone)]
struct Block([f64; 4]);

const TRUTH: [f64; 4] = [2.0, 0.7, 1.5, 1.0];
const STEP: f64 = 0.01;

impl Plant for Block {
    fn dof(&self) -> usize {
        1
    }

    fn switches(&self) -> usize {
        1
    }

    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        let [m, c, f, _] = self.0;
        torque[0] = m * at.ddq[0] + c * at.dq[0] + f * at.switches[0];
        inertia[(0, 0)] = m;
    }

    fn arguments(&mut self, at: &Instant<'_>, arguments: &mut [f64]) {
        arguments[0] = at.dq[0];
    }

    fn jumps(&mut self, _: &Instant<'_>, jumps: &mut Jumps) {
        jumps.halves[(0, 0)] = self.0[2];
        jumps.directions[(0, 0)] = 1.0;
    }

    fn slopes(&mut self, _: &Instant<'_>, slopes: &mut Slopes) {
        slopes.torque[0][(0, 0)] = 0.0;
        slopes.torque[1][(0, 0)] = self.0[1];
    }
}

impl Adjustable for Block {
    fn values(&self) -> Vec<f64> {
        self.0.to_vec()
    }

    fn adjust(&mut self, values: &[f64]) {
        self.0.copy_from_slice(values);
    }

    fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes) {
        let by = [at.ddq[0], at.dq[0], at.switches[0], 0.0];
        slopes.torque.copy_from_slice(&by);
    }
}

fn names() -> Vec<String> {
    ["m", "c", "f", "idle"].map(str::to_owned).to_vec()
}

/// A log of it under torques that are held, which turns and sticks.
fn log(seconds: f64) -> Log {
    pushed_by(seconds, |t| {
        4.0 * (2.3 * t).sin() + 2.5 * (5.1 * t + 0.4).cos()
    })
}

/// That under a torque of one's own.
fn pushed_by(seconds: f64, push: impl Fn(f64) -> f64) -> Log {
    sampled(STEP, seconds, push)
}

/// That with a sample every `step` seconds.
fn sampled(step: f64, seconds: f64, push: impl Fn(f64) -> f64) -> Log {
    let mut block =
        Integrator::new(Block(TRUTH), &[0.2], &[0.5], Tolerances::default()).expect("sound");
    let (mut time, mut q, mut tau) = (Vec::new(), Vec::new(), Vec::new());
    while block.time() < seconds {
        let t = block.time();
        time.push(t);
        q.push(block.q()[0]);
        tau.push(push(t));
        block.drive(Drive {
            torque: vec![push(t)],
            ..Drive::default()
        });
        block.advance(t + step).expect("a motion");
    }
    Log {
        source: "block.csv".to_owned(),
        time,
        q: vec![q],
        dq: Vec::new(),
        tau: vec![tau],
        extra: Vec::new(),
        report: Vec::new(),
        holes: Vec::new(),
        clipped: Vec::new(),
        turn_speeds: Vec::new(),
        tau_units: vec![1.0],
    }
}

fn noisy(mut log: Log, sigma: f64, seed: u64) -> Log {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    for q in &mut log.q[0] {
        let noise: f64 = StandardNormal.sample(&mut random);
        *q += sigma * noise;
    }
    log
}

fn fit(settings: &OutputError, log: &Log) -> OutputEstimate {
    let recording = Recording::new(log, &[1.0], 0.0, Vec::new());
    let start = [2.6, 0.4, 1.1, 1.0];
    let found = settings.fit(&Block(start), &names(), &start, &[recording], &mut |_| ());
    found.expect("an estimate")
}

const HELD: OutputError = OutputError {
    search: Search::LevenbergMarquardt,
    bounds: Vec::new(),
    window: None,
    law: None,
    hold: Some(Hold::Sample),
    held_starts: None,
    iterations: None,
    below: None,
};

#[test]
fn dry_friction_is_found_through_turns_and_rests() {
    let log = log(4.0);
    for (search, window) in [
        (Search::LevenbergMarquardt, None),
        (Search::TrustRegion, None),
        (Search::LevenbergMarquardt, Some(1.0)),
    ] {
        let settings = OutputError {
            search,
            window,
            ..HELD
        };
        let found = fit(&settings, &log);
        for k in 0..3 {
            let (value, truth) = (found.values[k], TRUTH[k]);
            assert!((value - truth).abs() < 1e-5 * truth, "{search:?}: {value}");
            assert!(found.std[k].is_some());
        }
        // What does nothing stays where it was, and nothing is claimed of it.
        assert_eq!(found.values[3].to_bits(), 1.0_f64.to_bits());
        assert_eq!(found.std[3], None);
        assert_eq!(found.identifiability.rank, 3);
        let idle = found.identifiability.directions.last().expect("one");
        assert!(idle.is_silent() && idle.moves == [("idle".to_owned(), 1.0)]);
        let rmse = found.fit.position[0].rmse;
        assert!(rmse < 1e-6, "{rmse}");
    }
}

#[test]
fn deviations_are_those_of_repeated_fits() {
    const DRAWS: u64 = 40;
    let clean = log(4.0);
    let fits = (0..DRAWS).map(|seed| fit(&HELD, &noisy(clean.clone(), 1e-3, seed)));
    let fits: Vec<OutputEstimate> = fits.collect();
    for k in 0..3 {
        let errors = fits.iter().map(|found| found.values[k] - TRUTH[k]);
        let errors: Vec<f64> = errors.collect();
        let spread = (errors.iter().map(|x| x * x).sum::<f64>() / DRAWS as f64).sqrt();
        let told = fits.iter().map(|found| found.std[k].expect("identified"));
        let told = (told.map(|x| x * x).sum::<f64>() / DRAWS as f64).sqrt();
        // Forty draws know a deviation to 11 %.
        let ratio = told / spread;
        assert!((0.7..1.4).contains(&ratio), "{k}: {told} {spread}");
        let bias = errors.iter().sum::<f64>() / DRAWS as f64;
        assert!(bias.abs() < 0.6 * spread, "{k}: {bias} {spread}");
    }
}

#[test]
fn a_bound_holds_what_the_log_would_have_beyond_it() {
    let log = log(4.0);
    let open = [f64::NEG_INFINITY, f64::INFINITY];
    for search in [Search::LevenbergMarquardt, Search::TrustRegion] {
        let settings = OutputError {
            search,
            bounds: vec![open, [0.0, 0.5], open, open],
            ..HELD
        };
        let found = fit(&settings, &log);
        assert_eq!(found.ending, Ending::Converged);
        assert_eq!(found.bound, [1], "{search:?}");
        assert!((found.values[1] - 0.5).abs() < 1e-15 && found.std[1].is_none());
        // Others make up for it: dry friction is larger, and is told with a deviation.
        assert!(found.values[2] > TRUTH[2] && found.std[2].is_some());
        assert_eq!(found.identifiability.rank, 2);
    }
}

#[test]
fn the_same_log_is_as_far_away_when_it_is_judged() {
    let noisy = noisy(log(4.0), 1e-3, 7);
    for window in [None, Some(0.5)] {
        let settings = OutputError { window, ..HELD };
        let found = fit(&settings, &noisy);
        let recording = Recording::new(&noisy, &[1.0], 0.0, Vec::new());
        let judged = settings.compare(&Block(TRUTH), &found.values, &[recording]);
        let judged = judged.expect("a motion").position[0];
        let fitted = found.fit.position[0];
        assert!(
            (judged.rmse - fitted.rmse).abs() < 1e-4 * fitted.rmse,
            "{judged:?} {fitted:?}"
        );
        assert!((fitted.rmse - 1e-3).abs() < 1e-4, "{fitted:?}");
    }
}

#[test]
fn a_search_is_given_so_many_iterations() {
    let log = log(4.0);
    let of = |iterations| fit(&OutputError { iterations, ..HELD }, &log);
    let (all, some) = (of(None), of(Some(2)));
    assert_eq!(all.ending, Ending::Converged);
    assert_eq!(
        (some.ending, some.iterates.len()),
        (Ending::OutOfIterations, 3)
    );
    for (some, all) in some.iterates.iter().zip(&all.iterates) {
        assert_eq!((&some.values, some.cost), (&all.values, all.cost));
    }
    assert_eq!(some.iterates[2].values, some.values);
    // Of slopes to judge by the last simulation is.
    let simulations = some.iterates.iter().map(|iterate| iterate.simulations);
    assert_eq!(simulations.collect::<Vec<_>>(), [1, 2, 4]);
    // A part begins with one.
    let parts = fit(
        &OutputError {
            window: Some(2.0),
            ..HELD
        },
        &log,
    );
    let pairs = parts.iterates.windows(2);
    let mut next = pairs.filter(|pair| pair[0].stage != pair[1].stage);
    let begins = next.next().expect("shorter windows, then those");
    assert_eq!(begins[1].simulations, begins[0].simulations + 1);
}

#[test]
fn a_search_is_given_up_where_it_leads_no_deeper_than_another() {
    let log = noisy(log(4.0), 1e-4, 7);
    let settings = OutputError {
        window: Some(2.0),
        ..HELD
    };
    let other = fit(&settings, &log);
    let first = other.iterates.iter().rfind(|iterate| iterate.stage == 0);
    let cost = first.expect("a part with short windows").cost;
    let below = |share: f64| OutputError {
        below: Some(share * cost),
        ..settings.clone()
    };
    assert_eq!(fit(&below(1.01), &log).iterates, other.iterates);
    let recording = Recording::new(&log, &[1.0], 0.0, Vec::new());
    let start = [2.6, 0.4, 1.1, 1.0];
    let mut told = 0;
    let mut progress = |_: &Iterate| told += 1;
    let ended = below(0.99).fit(&Block(start), &names(), &start, &[recording], &mut progress);
    let expected = OutputErrorError::NotDeeper {
        cost,
        below: 0.99 * cost,
    };
    assert_eq!(ended.expect_err("given up"), expected);
    assert!(told < other.iterates.len(), "{told}");
}

#[test]
fn a_hole_that_covers_a_window_is_no_row() {
    let mut holey = log(4.0);
    holey.holes = vec![0.985..1.515];
    let covered: Vec<usize> = (99..=151).collect();
    for &k in &covered {
        holey.q[0][k] = 0.5;
    }
    let settings = OutputError {
        window: Some(0.5),
        ..HELD
    };
    let found = fit(&settings, &holey);
    assert_eq!(found.samples, holey.time.len() - covered.len());
    for k in 0..3 {
        let (value, truth) = (found.values[k], TRUTH[k]);
        assert!((value - truth).abs() < 1e-3 * truth, "{value} {truth}");
    }
}

#[test]
fn a_late_torque_is_taken_from_where_it_belongs() {
    let clean = log(4.0);
    let mut late = clean.clone();
    // Two samples later, as a drive would report it.
    late.tau[0].rotate_right(2);
    late.tau[0][..2].fill(clean.tau[0][0]);
    let recording = Recording::new(&late, &[1.0], 2.0 * STEP, Vec::new());
    let pairs = recording.torque[0].iter().zip(&clean.tau[0]);
    for (found, expected) in pairs.take(390) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
}

/// The log of a block that is moved along a given way: its torque jumps at turns, between two samples.
fn moved(phase: f64) -> Log {
    let mut log = log(0.2);
    let time: Vec<f64> = (0..600_u32).map(|k| STEP * f64::from(k)).collect();
    let swing = |t: f64, order: i32| -> f64 {
        let parts = [(0.5, 1.7, phase), (0.3, 2.9, 2.0 * phase), (0.2, 4.3, 0.4)];
        let part = |(size, rate, phase): (f64, f64, f64)| {
            let turned = rate * t + phase + std::f64::consts::FRAC_PI_2 * f64::from(order);
            size * rate.powi(order) * turned.sin()
        };
        parts.into_iter().map(part).sum()
    };
    let [m, c, f, _] = TRUTH;
    let torque = |t: &f64| {
        let (dq, ddq) = (swing(*t, 1), swing(*t, 2));
        m * ddq + c * dq + f * dq.signum()
    };
    log.q[0] = time.iter().map(|t| swing(*t, 0)).collect();
    log.tau[0] = time.iter().map(torque).collect();
    log.time = time;
    log
}

#[test]
fn deviations_know_what_turns_of_dry_joints_hide() {
    let settings = OutputError {
        window: Some(0.5),
        hold: Some(Hold::Mean),
        ..HELD
    };
    let runs = 0..12_u32;
    let errors: Vec<f64> = runs
        .flat_map(|run| {
            let log = noisy(moved(0.5 * f64::from(run)), 1e-4, u64::from(run));
            let found = fit(&settings, &log);
            let error = |k: usize| (found.values[k] - TRUTH[k]) / found.std[k].expect("told");
            (0..3).map(error).collect::<Vec<f64>>()
        })
        .collect();
    let held = errors.iter().filter(|z| z.abs() < 1.96).count();
    let share = held as f64 / errors.len() as f64;
    assert!(share > 0.85, "{share}: {errors:.1?}");
    // They are no larger than what they know of.
    let square = errors.iter().map(|z| z * z).sum::<f64>() / errors.len() as f64;
    assert!(square > 0.2, "{square}: {errors:.1?}");
}
