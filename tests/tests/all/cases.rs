//! The open benchmark cases: imported, compiled, identified; and silence on arms that miss nothing.

use robot_model::columns::{Arm, Columns};
use robot_model::identify::Identify;
use robot_model::log::Log;
use robot_model::trace::{Outcome, Trace};
use robot_model_cli::close_the_loop::{Progress, close};
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::base::RankStatus;
use robot_model_codegen::compile_model;
use robot_model_spec::parameter::Owner;
use robot_model_tests::cases::{self, Case};

fn arm(case: &Case) -> InterpretedArm {
    let model =
        robot_model_spec::load(&case.name, &case.spec).unwrap_or_else(|errors| panic!("{errors}"));
    InterpretedArm::new(compile_model(&model))
}

fn log(case: &Case) -> Log {
    Log::read(&case.identify, case.dof).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn imported_arms_compile_with_a_clear_rank() {
    for case in cases::open() {
        let arm = arm(&case);
        let compiled = arm.compiled();
        assert!(
            matches!(compiled.base.rank, RankStatus::Clear { .. }),
            "{}: {}",
            case.name,
            compiled.base.rank
        );
        assert_eq!(arm.dof(), case.dof, "{}", case.name);
        // Behind a revolute joint three of a link's ten always regroup into the link before it; the first link only turns about
        // one axis and keeps its inertia about it and two first moments (Gautier & Khalil 1990).
        let rigid = compiled
            .base
            .kept
            .iter()
            .filter(|&&k| matches!(compiled.standard[k].owner, Owner::Link { .. }))
            .count();
        let most = 7 * case.dof - 4;
        let fixed = !compiled.base.fixed.is_empty();
        assert!(
            if fixed {
                rigid == 0
            } else {
                (1..=most).contains(&rigid)
            },
            "{}: {rigid} base parameters of {} links",
            case.name,
            case.dof
        );
    }
}

/// Every unknown gets a number from every log, no joint is left without explanation of most of its torque, and torque is late where the key
/// says so, by as much as it says.
#[test]
fn every_case_is_identified() {
    for case in cases::open() {
        let arm = arm(&case);
        let estimate = Identify::default()
            .fit(&arm, &[log(&case)])
            .unwrap_or_else(|error| panic!("{}: {error}", case.name));
        assert_eq!(estimate.parameters.len(), arm.unknowns().len());
        for parameter in &estimate.parameters {
            let numbers = parameter.value.is_finite() && parameter.std.is_finite();
            assert!(numbers, "{}: {parameter:?}", case.name);
        }
        let mut effects = case.key.effects.iter();
        let late = effects.find(|effect| effect.kind == "time-delay");
        let late = late.and_then(|effect| effect.params["delay"].as_f64());
        let delays = &estimate.delays;
        let count = if late.is_some() { case.dof } else { 0 };
        assert_eq!(delays.len(), count, "{}: {delays:?}", case.name);
        for (delay, late) in delays.iter().zip(late.into_iter().cycle()) {
            let off = (delay.seconds - late).abs();
            assert!(
                off < 4.0 * delay.std && off < 2e-4,
                "{}: {delay:?}",
                case.name
            );
        }
        // What is missing in the worst of the cases (a coupled wrist) is as large as the rest of the joint's torque.
        for (joint, percent) in estimate.relative_percent.iter().enumerate() {
            assert!(
                *percent < 60.0,
                "{} joint {}: {percent} %",
                case.name,
                joint + 1
            );
        }
    }
}

#[test]
fn nothing_is_named_on_arms_that_miss_nothing() {
    for case in cases::open() {
        if case.key.expected_outcome != "nothing-missing" {
            continue;
        }
        let arm = arm(&case);
        let undeclared = arm.undeclared();
        let verdict = Trace::new(undeclared.candidates())
            .run(&arm, &[log(&case)], &mut |_| ())
            .unwrap_or_else(|error| panic!("{}: {error}", case.name));
        assert_eq!(
            verdict.outcome,
            Outcome::NothingMissing,
            "{}: {:?} {:?}",
            case.name,
            verdict.findings,
            verdict.leads
        );
    }
}

/// Arms of so many joints take seconds each; `cargo bench --bench cases` traces all.
const FEW_JOINTS: usize = 3;

/// How many times the achievable error may be left in the median case.
const MOST_OVER: f64 = 1.10;

/// Their effects are named on their joints and nothing else is, faults of logs are told as such, and what is no effect gets no name; on a log
/// that was not fitted the error is down at what is achievable.
#[test]
fn arms_of_few_joints_have_the_verdicts_of_their_keys() {
    let mut all_over = Vec::new();
    for case in cases::open() {
        if case.dof > FEW_JOINTS {
            continue;
        }
        let unseen = Log::read(&case.validate, case.dof).unwrap_or_else(|error| panic!("{error}"));
        let name = format!("{}.robot", case.name);
        let logs = [log(&case)];
        let closed = close(&name, &case.spec, &logs, Some(&unseen), &Progress::silent())
            .unwrap_or_else(|error| panic!("{}: {error}", case.name));
        let (outcome, said) = (closed.outcome().name(), cases::named(&closed));
        assert!(
            case.key.is_met(outcome, &said),
            "{}: {outcome}, {said:?}",
            case.name
        );
        if case.key.expected_outcome == "explained" {
            let errors = closed.after().validation.as_ref().expect("a log for it");
            all_over.push(case.key.over_achievable(&errors.rmse));
        }
    }
    all_over.sort_by(f64::total_cmp);
    if let Some(median) = all_over.get(all_over.len() / 2) {
        assert!(*median <= MOST_OVER, "{all_over:?}");
    }
}
