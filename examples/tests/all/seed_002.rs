//! Seed 002, row by row: the figures that a reproduction has to show, findings that come out, and findings that go away once what is
//! wrong is repaired.

use std::sync::LazyLock;

use robot_model_examples::Paper;
use robot_model_examples::seed_002::excitation::against_differences;
use robot_model_examples::seed_002::experiment::RIPPLE_2;
use robot_model_examples::seed_002::results::{Results, results};
use robot_model_examples::seed_002::table_two::{drop, mean};
use robot_model_examples::seed_002::truth::{FRICTION, TABLE_2};
use robot_model_examples::seed_002::{law, paper};

use super::common::agrees;

const PAGE: &str = include_str!("../../../docs/papers/seed_002.md");

static RESULTS: LazyLock<(Results, Paper)> = LazyLock::new(|| {
    let results = results().unwrap_or_else(|error| panic!("{error}"));
    let paper = paper(&results).unwrap_or_else(|error| panic!("{error}"));
    (results, paper)
});

#[test]
fn the_page_says_what_the_program_says() {
    let paper = &RESULTS.1;
    let wrong = [
        "2.1.jump",
        "2.1.slope",
        "2.1.displacement",
        "2.1.passive",
        "2.3.k",
        "2.3.lengths",
        "2.8.unit",
        "2.9",
        "2.9.sign",
    ];
    agrees(paper, "seed_002", PAGE, [&["2.5.here"], &wrong]);
    assert_eq!(paper.rows.len(), 22);
}

#[test]
fn the_law_jumps_drives_and_has_neither_fall_nor_position() {
    let results = &RESULTS.0;
    assert!(results.law_difference < 1e-12);
    for (k, jump) in results.jumps[0].iter().enumerate() {
        let viscous = FRICTION.fv1[k] * 1e-2 + FRICTION.fv2[k] * 1e-4 + FRICTION.fv3[k] * 1e-6;
        let [by, at] = jump.expect("`audit` finds a jump");
        assert!((by - viscous).abs() < 1e-9, "{by} {viscous}");
        assert!((at - 1e-2).abs() < 1e-9, "{at}");
    }
    assert!(results.jumps[1].iter().all(Option::is_none));
    let falls = [1.57, 1.47, 0.81, 2.55, 1.62, 1.77];
    let drives = [2.70, 2.61, 1.48, 4.66, 2.96, 3.39];
    for k in 0..6 {
        let speeds = results.speeds[k];
        assert!(
            (speeds.falls_in_mean - falls[k]).abs() < 0.006,
            "{speeds:?}"
        );
        // The square takes from one direction what it gives to the other.
        let [least, most] = [f64::min, f64::max].map(|of| speeds.falls.into_iter().reduce(of));
        assert!(least < Some(speeds.falls_in_mean) && Some(speeds.falls_in_mean) < most);
        let found = results.drives_from(1, k).expect("a speed");
        assert!((found - drives[k]).abs() < 0.006, "{k}: {found}");
        // The audit's is that of the worse direction.
        let scanned = speeds.drives[0].min(speeds.drives[1]);
        assert!((found - scanned).abs() < 0.006, "{k}: {found} {scanned}");
    }
    // Without square and cube it brakes.
    assert_eq!(results.ours[0].findings("friction").len(), 6);
    assert_eq!(results.ours[1].findings("friction"), [""; 0]);
    assert_eq!(results.missing_fall[0], ["stribeck"]);
    assert_eq!(results.missing_fall[1], [""; 0]);
    assert_eq!(results.missing_position[0], ["position_dependent_friction"]);
    assert_eq!(results.missing_position[1], [""; 0]);
    assert_eq!(results.reads_position, [false, true]);
    // The law that begins at rest is the printed one from `eps` on.
    let [printed, repaired] = [law::PRINTED, law::CONTINUOUS]
        .map(|spec| law::compiled_friction(spec, 2).expect("sound specs"));
    for v in [-1.3, -0.011, 0.011, 0.7] {
        assert!((printed(v) - repaired(v)).abs() < 1e-12, "{v}");
    }
    assert!((repaired(0.005) - printed(0.005) - 0.5e-2 * FRICTION.fv1[2]).abs() < 1e-3);
}

#[test]
fn base_parameters_are_seventy_both_ways() {
    let base = &RESULTS.0.base;
    assert_eq!(
        (base.standard, base.symbolic, base.identified, base.numeric),
        (96, 70, 70, 70)
    );
    assert_eq!((base.friction, base.rotors.len()), (30, 4));
    assert_eq!(base.rotors, ["j3", "j4", "j5", "j6"]);
    assert!(base.kept_apart > 1e-3 && base.dropped_apart < 1e-12);
    assert!(base.k < 1e-10, "{}", base.k);
    // `R2 R1^-1` does not exist; lengths of columns belong into `R1^-1 R2`.
    assert_eq!(base.printed, [26, 70]);
    assert!(base.regrouped[0] < 1e-12 && base.regrouped[1] > 0.1);
    // So says the audit of the base parameters that these matrices make.
    let asked = &base.regrouping;
    for (wrong, least) in [(&asked.printed, 20), (&asked.of_unit, 10)] {
        assert_eq!(wrong.passed, Some(false));
        assert!(wrong.findings.len() >= least, "{:?}", wrong.findings);
        for said in &wrong.findings {
            assert!(said.starts_with("torques do not determine `"), "{said}");
        }
    }
    assert_eq!(asked.of_measured.findings, [""; 0]);
    assert_eq!(asked.of_measured.passed, Some(true));
    assert_eq!(asked.of_measured.quantity("independent", None), Some(70.0));
}

#[test]
fn motions_keep_limits_and_are_best_by_their_own_criteria() {
    let results = &RESULTS.0;
    for (design, violation) in results.designs.iter().zip(&results.violations) {
        assert!(against_differences(&design.motion) < 1e-9);
        assert!(*violation <= 0.0, "{violation}");
        let coefficients = &design.motion.coefficients;
        assert_eq!(coefficients.iter().map(Vec::len).sum::<usize>(), 66);
    }
    let quality: Vec<_> = results
        .designs
        .iter()
        .map(|design| &design.quality)
        .collect();
    for k in 1..4 {
        assert!(quality[0].hadamard > quality[k].hadamard);
    }
    for k in [0, 2, 3] {
        assert!(quality[1].log_det > quality[k].log_det);
    }
    // Hadamard's bound does not see columns that look alike.
    assert!(quality[0].condition_of_unit_columns > 3.0 * quality[1].condition_of_unit_columns);
    let [raw, unit] = &results.objectives;
    assert_eq!(unit.values.len(), 2);
    assert!(unit.values.iter().all(|value| value.abs() < 1e-9));
    assert_eq!(unit.log_det, [None, None]);
    assert!(raw.values.iter().all(|value| *value < -0.5));
    assert!(raw.log_det.iter().all(Option::is_some));
    // The product overflows; the sum of logarithms does not, nor does the product of means over rows.
    let sums = &results.sums;
    assert_eq!((sums.len(), 1.0 / sums.iter().product::<f64>()), (70, 0.0));
    assert!(sums.iter().map(|sum| sum.ln()).sum::<f64>().is_finite());
    let means = sums.iter().map(|sum| sum / 120_000.0);
    assert!(means.product::<f64>().is_normal());
}

#[test]
fn weights_bring_more_than_friction() {
    let results = &RESULTS.0;
    let [tfls, _, mfwls] = &TABLE_2;
    assert!((drop(mean(tfls), mean(mfwls)) - 54.1).abs() < 0.05);
    let error = |fit: &robot_model_examples::seed_002::table_two::Fit| mean(&fit.rmse);
    let plain = [0, 1].map(|k| error(&results.conventional[k]));
    let modified = [0, 1].map(|k| error(&results.modified[k]));
    assert!(plain[1] < modified[0] && modified[0] < plain[0]);
    assert!(modified[1] < plain[1]);
    let gained = drop(plain[0], modified[1]);
    assert!((35.0..65.0).contains(&gained), "{gained}");
    // That is the ripple's doing: without it weights bring next to nothing, and friction does.
    let quiet = results.without_ripple.each_ref().map(error);
    assert!(drop(quiet[0], quiet[1]) < 10.0 && drop(quiet[0], quiet[2]) > 50.0);
    // Joint 2 keeps its error, the others lose theirs.
    let [ls, wls] = [0, 1].map(|k| &results.modified[k].rmse);
    assert!(wls[1] > 0.7 * ls[1]);
    for k in [0, 2, 3, 4, 5] {
        assert!(wls[k] < 0.5 * ls[k], "{k}: {} {}", wls[k], ls[k]);
    }
    // On the run that is fitted, no weights lower the sum of squares.
    for weighted in &results.modified[1..] {
        assert!(weighted.trained > results.modified[0].trained);
    }
    // What joint 2 has and the model does not know of is its ripple.
    let known = &results.with_ripple;
    assert!(known.rmse[1] < 0.05 * wls[1]);
    let mut parameters = known.estimate.parameters.iter();
    let size = parameters.find(|one| one.name == "j2.torque_ripple.a");
    let size = size.expect("declared").value;
    assert!((size - RIPPLE_2[0]).abs() < 0.02 * RIPPLE_2[0], "{size}");
}

#[test]
fn table_one_is_no_arm_and_the_simulated_one_is() {
    let results = &RESULTS.0;
    let [as_printed, magnitude] = &results.table_1;
    let bodies = magnitude.findings("bodies");
    assert!(bodies.len() >= 5);
    // 10 kg with a first moment of -858 kg m: what the body's inertia would have to be about its center is far below zero.
    assert!(
        bodies
            .iter()
            .any(|said| said.contains("`j2`") || said.contains("j2")),
        "{bodies:?}"
    );
    let rotors = magnitude.findings("signs");
    assert_eq!(rotors.len(), 3);
    let names = ["j3", "j5", "j6"].map(|joint| format!("{joint}.motor_inertia.ia"));
    assert_eq!(magnitude.told_of("signs", "value"), names);
    assert_eq!(magnitude.findings("inertia").len(), 1);
    // With the sign of `fc2` as printed dry friction drives.
    assert_eq!(as_printed.findings("signs").len(), 9);
    assert!((0..6).all(|k| results.drives_from(0, k).is_some_and(|speed| speed < 0.1)));
    for check in ["bodies", "signs", "inertia", "friction"] {
        assert_eq!(results.ours[1].findings(check), [""; 0], "{check}");
    }
}

#[test]
fn a_hand_needs_less_with_the_better_model() {
    let [tfls, mfwls] = &RESULTS.0.guided;
    for k in 0..6 {
        // The ripple of joint 2 is felt with both.
        let share = if k == 1 { 0.8 } else { 0.7 };
        assert!(mfwls.effort(k, true) < share * tfls.effort(k, true), "{k}");
    }
    assert!(mfwls.at_rest[2].abs() < 0.6 * tfls.at_rest[2].abs());
    let [all, base] = &RESULTS.0.streamed;
    assert_eq!((all.size, base.size), ([120_000, 96], [120_000, 70]));
    assert_eq!((all.rank, base.rank), (70, 70));
    assert!(all.error.is_none() && base.error.is_some_and(|error| error < 0.05));
}
