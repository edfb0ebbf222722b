//! Designs for an arm that is written by hand: two pendulums beside each other, `izz ddq + mx sin(q) + fv dq` each.

use super::criterion::Sharpness;
use super::problem::{Problem, Stage};
use super::*;
use crate::motion::Kinematics;

struct Pendulums;

impl Function for Pendulums {
    fn outputs(&self) -> usize {
        6
    }

    fn values(&self, motion: &Kinematics) -> Vec<Vec<f64>> {
        let of = |joint: usize| {
            [
                motion.ddq[joint].clone(),
                motion.q[joint].iter().map(|q| q.sin()).collect(),
                motion.dq[joint].clone(),
            ]
        };
        [of(0), of(1)].concat()
    }

    fn pullback(&self, motion: &Kinematics, weights: &[Vec<f64>]) -> Kinematics {
        let slopes = |joint: usize| -> Vec<f64> {
            let pairs = motion.q[joint].iter().zip(&weights[3 * joint + 1]);
            pairs.map(|(q, weight)| q.cos() * weight).collect()
        };
        Kinematics {
            q: vec![slopes(0), slopes(1)],
            dq: vec![weights[2].clone(), weights[5].clone()],
            ddq: vec![weights[0].clone(), weights[3].clone()],
        }
    }
}

/// `2 ddq + 9 sin(q) + dq` of each pendulum.
struct Torque;

impl Function for Torque {
    fn outputs(&self) -> usize {
        2
    }

    fn values(&self, motion: &Kinematics) -> Vec<Vec<f64>> {
        let columns = Pendulums.values(motion);
        let of = |joint: usize| -> Vec<f64> {
            let [a, s, v] = [0, 1, 2].map(|k| &columns[3 * joint + k]);
            (0..a.len())
                .map(|k| 2.0 * a[k] + 9.0 * s[k] + v[k])
                .collect()
        };
        vec![of(0), of(1)]
    }

    fn pullback(&self, motion: &Kinematics, weights: &[Vec<f64>]) -> Kinematics {
        let times = |size: f64, joint: usize| weights[joint].iter().map(|w| size * w).collect();
        let columns: Vec<Vec<f64>> = (0..6)
            .map(|k| times([2.0, 9.0, 1.0][k % 3], k / 3))
            .collect();
        Pendulums.pullback(motion, &columns)
    }
}

fn request(criterion: Criterion) -> Request {
    let joints = vec!["shoulder".to_owned(), "elbow".to_owned()];
    Request {
        regressor: Regressor {
            columns: (0..6).map(|k| format!("p{k}")).collect(),
            entries: (0..6).map(|k| (k / 3, k)).collect(),
            function: Box::new(Pendulums),
            exact: Box::new(Pendulums),
        },
        limits: Limits {
            position: vec![(-1.0, 2.0), (-0.5, 0.7)],
            velocity: vec![3.0, 2.0],
            acceleration: vec![8.0, 9.0],
            torque: vec![14.0, 12.0],
        },
        clearances: vec![Box::new(TorqueLimits {
            torque: Box::new(Torque),
            exact: Box::new(Torque),
            limits: vec![14.0, 12.0],
            joints: joints.clone(),
        })],
        joints,
        criterion,
        basis: None,
        scaling: Scaling::Raw,
        noise: vec![1.0, 0.5],
        period: 5.0,
        harmonics: 3,
        ends: Ends::AtRest,
        starts: 2,
        seed: 7,
    }
}

/// A function whose values are so many times those that the smooth one has.
struct Larger<F>(f64, F);

impl<F: Function> Function for Larger<F> {
    fn outputs(&self) -> usize {
        self.1.outputs()
    }

    fn values(&self, motion: &Kinematics) -> Vec<Vec<f64>> {
        let mut values = self.1.values(motion);
        for value in values.iter_mut().flatten() {
            *value *= self.0;
        }
        values
    }

    fn pullback(&self, motion: &Kinematics, weights: &[Vec<f64>]) -> Kinematics {
        self.1.pullback(motion, weights)
    }
}

#[test]
fn what_a_motion_is_worth_is_told_by_exact_columns() {
    let mut request = request(Criterion::DOptimal);
    let plain = request.run(&always).expect("room to move");
    request.regressor.exact = Box::new(Larger(2.0, Pendulums));
    let quality = request.quality(&plain.motion).expect("columns");
    let more = quality.log_det - plain.quality.log_det;
    assert!((more - 12.0 * 2_f64.ln()).abs() < 1e-9, "{more}");
}

fn always(_: Progress) -> bool {
    true
}

#[test]
fn slopes_of_the_design_are_those_of_its_value() {
    // Twice the gravity, and friction that is counted as the difference from inertia.
    let names = (0..6).map(|k| format!("x{k}")).collect();
    let mixed = Basis::new(names, |i, k| match (i, k) {
        (1, 1) => 2.0,
        (0, 2) => -1.0,
        _ if i == k => 1.0,
        _ => 0.0,
    });
    for (criterion, basis) in [
        (Criterion::DOptimal, None),
        (Criterion::Condition, None),
        (Criterion::Condition, Some(mixed)),
    ] {
        let mut request = request(criterion);
        request.basis = basis;
        let weights = [1.0, 2.0];
        let problem = Problem::new(&request, &weights);
        let z = start::inside(&request, &problem, 0).expect("room to move");
        let stage = Stage {
            barrier: 0.1,
            sharpness: Sharpness(4.0),
        };
        let at = |z: &[f64]| problem.evaluate(z, stage).expect("inside the limits");
        let slopes = at(&z).slopes();
        for (k, slope) in slopes.iter().enumerate() {
            let h = 1e-6;
            let moved = |by: f64| {
                let mut moved = z.clone();
                moved[k] += by;
                at(&moved).value()
            };
            let numeric = (moved(h) - moved(-h)) / (2.0 * h);
            assert!(
                (numeric - slope).abs() < 1e-6 * slope.abs().max(1.0),
                "{k}: {numeric} {slope}"
            );
        }
    }
}

#[test]
fn a_motion_keeps_all_limits_begins_at_rest_and_is_the_same_again() {
    let request = request(Criterion::DOptimal);
    let design = request.run(&always).expect("room to move");
    assert_eq!(design, request.run(&always).expect("room to move"));
    assert!(design.quality.violation == 0.0, "{:?}", design.quality);
    for joint in 0..2 {
        for time in [0.0, 5.0] {
            let [_, dq, ddq] = design.motion.at(joint, time);
            assert!(dq.abs() < 1e-12 && ddq.abs() < 1e-12);
        }
    }
    // Much better than where it began, and at some limit.
    let first = request.quality(&Fourier {
        period: 5.0,
        coefficients: vec![vec![0.1, 0.2, -0.2, 0.0, 0.1, -0.05, 0.0]; 2],
    });
    let first = first.expect("columns that differ");
    assert!(
        design.quality.log_det > first.log_det + 3.0,
        "{design:?} {first:?}"
    );
    let fine = design.motion.motion(&design.motion.instants(3000));
    let fastest = fine.dq[0]
        .iter()
        .fold(0.0, |most: f64, dq| most.max(dq.abs()));
    let strongest = Torque.values(&fine)[0]
        .iter()
        .fold(0.0, |most: f64, tau| most.max(tau.abs()));
    assert!(fastest > 2.5 || strongest > 12.0, "{fastest} {strongest}");
}

#[test]
fn the_condition_number_is_what_is_minimized_when_asked_for() {
    let by_volume = request(Criterion::DOptimal).run(&always).expect("room");
    let by_condition = request(Criterion::Condition).run(&always).expect("room");
    assert!(by_condition.quality.condition < by_volume.quality.condition);
    assert!(by_volume.quality.log_det > by_condition.quality.log_det);
}

#[test]
fn a_design_that_separates_drives_two_columns_apart() {
    let rivals = Rivals {
        effects: [vec![(1, 1.0)], vec![(2, 1.0)]],
    };
    let design = request(Criterion::Separation(rivals.clone()))
        .run(&always)
        .expect("room");
    let distances = design
        .quality
        .distances
        .expect("of a design that separates");
    let mut other = request(Criterion::Hadamard);
    let hadamard = other.run(&always).expect("room").motion;
    other.criterion = Criterion::Separation(rivals);
    let of_other = other
        .quality(&hadamard)
        .expect("columns")
        .distances
        .expect("two effects");
    let worst = |distances: [f64; 2]| distances[0] * distances[1];
    assert!(
        worst(distances) > worst(of_other),
        "{distances:?} {of_other:?}"
    );
}

/// Reserves grow until what is verified is kept, and end where nothing is left but the start.
#[test]
fn what_is_kept_is_what_is_exact() {
    for limits in [[14.0, 12.0], [9.5, 9.5]] {
        let mut request = request(Criterion::DOptimal);
        request.clearances = vec![Box::new(TorqueLimits {
            torque: Box::new(Torque),
            exact: Box::new(Larger(1.5, Torque)),
            limits: limits.to_vec(),
            joints: request.joints.clone(),
        })];
        let design = request.run(&always).expect("room to move");
        assert!(design.quality.violation <= 0.0, "{:?}", design.quality);
        let fine = design.motion.motion(&design.motion.instants(1200));
        for (torque, limit) in Larger(1.5, Torque).values(&fine).iter().zip(limits) {
            assert!(torque.iter().all(|x| x.abs() <= limit), "{limit}");
        }
    }
}

#[test]
fn the_only_start_is_stopped_too() {
    let mut request = request(Criterion::DOptimal);
    request.starts = 1;
    let full = request.run(&always).expect("room");
    assert!(!full.stopped);
    let cut = request.run(&|_| false).expect("room");
    assert!(cut.stopped && cut.starts == 1 && cut.quality.violation <= 0.0);
    assert!(cut.quality.log_det < full.quality.log_det);
}

#[test]
fn stopped_early_it_has_the_best_so_far() {
    let calls = std::cell::Cell::new(0);
    let design = request(Criterion::DOptimal).run(&|_| {
        calls.set(calls.get() + 1);
        calls.get() < 5
    });
    let design = design.expect("one start is made");
    assert!(design.stopped && design.starts == 1 && design.quality.violation == 0.0);
}

/// From one step to the next, and from nothing on with every start.
#[test]
fn a_start_tells_what_part_of_its_steps_is_behind_it() {
    let told = std::cell::RefCell::new(Vec::new());
    let mut request = request(Criterion::DOptimal);
    request.starts = 2;
    let design = request.run(&|progress| {
        told.borrow_mut().push((progress.start, progress.part));
        true
    });
    assert_eq!(design.expect("room").starts, 2);
    let told = told.into_inner();
    for pair in told.windows(2) {
        let [(start, part), (next, more)] = [pair[0], pair[1]];
        let is_on = if next == start {
            more > part
        } else {
            more == 0.0
        };
        assert!(is_on && more <= 1.0, "{pair:?}");
    }
    assert!(told.len() > 10 && told.last().is_some_and(|last| last.0 == 2));
}

#[test]
fn what_leaves_no_motion_is_told() {
    let refused = |change: &dyn Fn(&mut Request)| {
        let mut request = request(Criterion::DOptimal);
        change(&mut request);
        request.run(&always).expect_err("no motion").to_string()
    };
    let said = refused(&|request| request.limits.position[1] = (0.3, 0.3));
    assert!(said.contains("`elbow` has no range"), "{said}");
    let said = refused(&|request| request.limits.velocity[0] = f64::INFINITY);
    assert!(said.contains("`shoulder` has no velocity limit"), "{said}");
    let said = refused(&|request| request.limits.acceleration[0] = -1.0);
    assert!(said.contains("acceleration limit of -1"), "{said}");
    let said = refused(&|request| request.ends = Ends::At(vec![0.0]));
    assert!(said.contains("1 positions"), "{said}");
    let said = refused(&|request| {
        request.limits.position[0] = (1.2, 2.0);
        request.clearances = vec![Box::new(TorqueLimits {
            torque: Box::new(Torque),
            exact: Box::new(Torque),
            limits: vec![5.0, 12.0],
            joints: request.joints.clone(),
        })];
    });
    assert!(said.contains("torque of `shoulder`"), "{said}");
    let said = refused(&|request| request.ends = Ends::At(vec![0.0, f64::NAN]));
    assert!(said.contains("joint `elbow` at NaN"), "{said}");
    let said = refused(&|request| request.ends = Ends::At(vec![2.1, 0.0]));
    assert!(said.contains("not within -1 .. 2"), "{said}");
    let said = refused(&|request| request.harmonics = 1);
    assert!(said.contains("1 harmonics are not from 2"), "{said}");
    let said = refused(&|request| request.harmonics = usize::MAX);
    assert!(said.contains("to 100"), "{said}");
    let said = refused(&|request| request.noise = vec![1.0]);
    assert!(
        said.contains("1 deviations of torque noise, 2 are needed"),
        "{said}"
    );
    let said = refused(&|request| request.limits.velocity.clear());
    assert!(said.contains("0 velocity limits"), "{said}");
    let said = refused(&|request| request.regressor.entries[0] = (7, 0));
    assert!(said.contains("5 entries inside the regressor"), "{said}");
    let said = refused(&|request| request.regressor.columns.clear());
    assert!(said.contains("there is nothing to design"), "{said}");
    for effects in [
        [vec![(1, 0.0)], vec![(2, 1.0)]],
        [vec![], vec![(2, 1.0)]],
        [vec![(1, 1.0)], vec![(1, 1.0)]],
        [vec![(1, 1.0)], vec![(9, 1.0)]],
    ] {
        let criterion = Criterion::Separation(Rivals { effects });
        let said = refused(&|request| request.criterion = criterion.clone());
        assert!(said.contains("two effects need"), "{said}");
    }
    let said = refused(&|request| request.regressor.entries[2] = (0, 1));
    assert!(said.contains("`p2`"), "{said}");
}
