//! The `LuGre` link: what comes back, what the model shows, what is wrong in print and passes where it is mended.

use std::sync::OnceLock;

use super::common::agrees;

use robot_model_examples::Paper;
use robot_model_examples::seed_003::audit::{Finding, in_kgf_cm, off, stiff};
use robot_model_examples::seed_003::encoder::{BITS, stiffest};
use robot_model_examples::seed_003::phenomena::Late;
use robot_model_examples::seed_003::plant::PRINTED;
use robot_model_examples::seed_003::results::{PULLED, Results, results};
use robot_model_examples::seed_003::{paper, truth};

/// Everything takes half a minute, once.
fn all() -> &'static (Results, Paper) {
    static ALL: OnceLock<(Results, Paper)> = OnceLock::new();
    ALL.get_or_init(|| {
        let results = results().expect("results");
        let paper = paper(&results).expect("a paper");
        (results, paper)
    })
}

fn close(what: &str, found: f64, truth: f64, share: f64) {
    let is_close = (found / truth - 1.0).abs() < share;
    assert!(is_close, "{what}: {found}, {truth}");
}

/// 3.1
#[test]
fn the_chain_is_a_uniform_rod() {
    let body = &all().0.body;
    close("share", body.share, 1.0 / 3.0, 1e-12);
    assert!(body.off < 1e-12, "{}", body.off);
}

/// 3.2
#[test]
fn settled_bristles_are_the_stribeck_curve() {
    let [by_hand, spec] = all().0.settled;
    assert!(by_hand < 1e-9 && spec < 1e-9, "{by_hand} {spec}");
    assert_eq!(all().0.findings.friction.printed, None);
}

/// 3.3: twenty speeds, 12 bits and 10 mA of noise; a fine encoder for what moves bristles.
#[test]
fn the_static_four_and_the_dynamic_two_come_back() {
    let found = &all().0.found;
    assert_eq!(found.curve.points.len(), truth::SPEEDS);
    assert!(off(&found.law, &PRINTED) < 0.02, "{:?}", found.law);
    close("s0", found.dynamic.stiffness.value, truth::STIFFNESS, 0.1);
    close("s1", found.dynamic.damping.value, truth::DAMPING, 0.1);
    // 3.5 and 3.6
    close(
        "s0 of a ramp",
        found.bristles.stiffness.value,
        truth::STIFFNESS,
        0.1,
    );
    close(
        "s1 of the second order",
        found.first[1],
        truth::DAMPING,
        0.1,
    );
}

/// 3.4: printed bristles settle within 280 degrees if the start is left out; stiff ones have from rest on.
#[test]
fn bristles_settle_in_the_range() {
    let [settled, from_rest, held, stiffer, stiff_held] = &all().0.protocols[..] else {
        panic!("five protocols");
    };
    assert!(off(&settled.law, &PRINTED) < 0.02, "{:?}", settled.law);
    assert!(off(&from_rest.law, &PRINTED) > 0.1, "{:?}", from_rest.law);
    assert!(off(&stiffer.law, &stiff()) < 0.02, "{:?}", stiffer.law);
    assert_eq!(stiffer.points, truth::SPEEDS);
    // The printed gains lose the speeds at which friction falls.
    assert!(off(&held.law, &PRINTED) > 0.1, "{:?}", held.law);
    assert!(stiff_held.points < truth::SPEEDS, "{}", stiff_held.points);
}

/// 3.7: beyond squares, the largest error falls.
#[test]
fn the_mixed_cost_has_its_own_least() {
    let mixed = &all().0.found.mixed;
    assert!((mixed.cost(&mixed.of_squares) - 2.0).abs() < 1e-9);
    assert!(mixed.cost(&mixed.found) < 1.999);
    assert!(mixed.found.largest < mixed.of_squares.largest);
    assert!(mixed.found.squares > mixed.of_squares.squares);
    for point in [&mixed.found, &mixed.from_first] {
        close("s0", point.stiffness, truth::STIFFNESS, 0.1);
        close("s1", point.damping, truth::DAMPING, 0.1);
    }
    close(
        "s0",
        mixed.found.stiffness,
        mixed.from_first.stiffness,
        0.01,
    );
}

/// 3.9: in the unit that the motor can give.
#[test]
fn currents_are_within_what_the_chain_reads() {
    let chain = &all().0.in_kgf_cm;
    let [with, without] = [&chain.law, &chain.without].map(|law| off(law, &in_kgf_cm()));
    assert!((with - without).abs() < 0.01, "{with} {without}");
    assert!(chain.volts < truth::CONVERTER_VOLTS, "{}", chain.volts);
}

#[test]
fn equations_and_numbers_that_are_wrong_are_told_and_pass_when_mended() {
    let findings = &all().0.findings;
    let (deflection, [printed, repaired]) = &findings.deflection;
    let told: [(&str, &Finding, &str); 10] = [
        ("(7)", &findings.gravity, "kg m^3/s^2"),
        (
            "(8)",
            &findings.unit,
            "terms of different dimensions cannot be added",
        ),
        ("(17)", deflection, "the torque off by"),
        ("(22)", &findings.damping, "and 1/s^2"),
        (
            "stall",
            &findings.drives,
            "has 2.0020 N m of friction, but its torque limit is 1.0885 N m",
        ),
        (
            "passivity",
            &findings.memory,
            "effects with memory add energy",
        ),
        ("softness", &findings.softness, "(15."),
        ("differences", &findings.differences, "1.534 rad/s"),
        ("a third", &findings.third, "of a uniform rod's torque"),
        ("step", &findings.encoder, "0.0879 degrees"),
    ];
    for (what, finding, words) in told {
        assert!(finding.text().contains(words), "{what}: {finding:?}");
        assert_eq!(finding.repaired, None, "{what}");
        assert!(finding.is_told());
    }
    // Dimensions of (17) are right; its stiffness is not, and that of its repair is.
    assert!((printed / truth::STIFFNESS - 1.0).abs() > 0.5, "{printed}");
    close("repaired", *repaired, truth::STIFFNESS, 0.1);
}

/// 3.8: bristles stick below a critical speed only where the spring that pulls them is softer than they are.
#[test]
fn the_loop_closes_and_stick_slip_ends_at_a_critical_speed() {
    let [beside, printed, stiff, _] = &all().0.shown[..] else {
        panic!("four");
    };
    let (work, width) = printed.to_and_fro.0.last_loop();
    assert!(work > 0.1 && width > 0.1, "{work} {width}");
    let (work, width) = stiff.to_and_fro.0.last_loop();
    assert!(work > 0.0 && width > 0.0, "{work} {width}");
    for shown in [beside, printed, stiff] {
        let off = shown.to_and_fro.1.max(shown.slip.1);
        assert!(off < 1e-3, "{}: {off}", shown.name);
    }
    for shown in [printed, stiff] {
        assert!(shown.sticks_below_a_speed_only(), "{:?}", shown.late);
        let fastest = shown.speeds(Late::sticks).len();
        assert!(PULLED[fastest - 1] >= 0.5, "{fastest}");
    }
    // A spring as stiff as the bristles bends no further than they do, and a joint that turns round after each jump, without standing,
    // does not stick.
    assert_eq!(beside.speeds(Late::sticks), [0.0; 0], "{:?}", beside.late);
    let rebounds = beside.late.iter().any(|late| late.least < 0.0);
    assert!(rebounds, "{:?}", beside.late);
}

#[test]
fn what_an_encoder_is_said_to_tell_it_tells() {
    let trials = &all().0.encoders;
    for trial in trials.iter().filter(|trial| trial.is_resolved) {
        assert!(trial.is_close(), "{trial:?}");
    }
    let coarse = trials
        .iter()
        .find(|trial| trial.bits == truth::BITS)
        .expect("12 bits");
    close(
        "told by 12 bits",
        coarse.most,
        0.5843 / (5.0 * std::f64::consts::TAU / 4096.0),
        0.02,
    );
    // Four times the stiffness with two bits more, until the study ends.
    let found = BITS.map(|bits| stiffest(trials, bits));
    assert!(
        found[0] < 500.0 && found[1] > found[0] && found[2] > found[1],
        "{found:?}"
    );
    assert!(trials.iter().any(|trial| !trial.is_close()));
}

#[test]
fn the_page_says_what_the_program_says() {
    let paper = &all().1;
    let page = include_str!("../../../docs/papers/seed_003.md");
    let impossible = [
        "3.third",
        "3.gravity",
        "3.passive",
        "3.deflection",
        "3.damping",
        "3.unit",
        "3.soft",
        "3.stall",
        "3.speed",
    ];
    agrees(paper, "seed_003", page, [&["3.4.gains"], &impossible]);
    assert_eq!(paper.rows.len(), 22);
    for figure in &paper.figures {
        assert!(figure.svg().len() < 150_000, "{}", figure.name);
    }
}
