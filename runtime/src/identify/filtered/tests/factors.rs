//! Factors of the filtered form say what the rows say.

use super::*;
use crate::identify::{AtTurns, Factor, FactorBlock, Method};

const BANDS: Bands = Bands {
    shared_hz: 10.0,
    smooth_hz: 30.0,
    wide_hz: 90.0,
};

fn factor(wheel: &Wheel, log: &Log) -> Factor {
    let mut factor = Factor::filtered(wheel, BANDS, Some(CORNER)).expect("an arm without shapes");
    factor
        .push_filtered(wheel, log)
        .expect("a log of the wheel");
    factor
}

fn ask(method: Method, at_turns: AtTurns) -> Identify {
    Identify {
        method,
        bands: Some(BANDS),
        at_turns,
        ..Identify::default()
    }
}

#[test]
fn merged_factors_are_what_both_logs_say_with_turns_and_without() {
    let wheel = Wheel::new();
    let logs = [log(0.0), log(50.0)];
    let [mut both, other] = [&logs[0], &logs[1]].map(|log| factor(&wheel, log));
    both.merge(other).expect("of one arm, form and corner");
    let mut values = Vec::new();
    for at_turns in [AtTurns::Kept, AtTurns::LeftOut] {
        for method in [Method::Ls, Method::Wls] {
            let identify = ask(method, at_turns);
            let found = both.estimate(&wheel, &identify).expect("told");
            let direct = identify.fit_filtered(&wheel, &logs, Some(CORNER));
            let direct = direct.expect("told");
            let pairs = found.values().into_iter().zip(direct.values());
            for (found, direct) in pairs {
                assert!((found / direct - 1.0).abs() < 1e-9, "{found} {direct}");
            }
            let percents = [&found, &direct].map(|estimate| estimate.relative_percent[0]);
            assert!((percents[0] - percents[1]).abs() < 1e-9, "{percents:?}");
            assert_eq!(found.form, direct.form);
            assert_eq!(found.samples, direct.samples);
            assert_eq!(found.turns, direct.turns);
            assert!(found.turns[0] > 100, "{:?}", found.turns);
            assert_eq!(found.is_without_turns, at_turns == AtTurns::LeftOut);
        }
        values.push(both.estimate(&wheel, &ask(Method::Wls, at_turns)));
    }
    // What the filter remembers of turns moves the estimate, and that is in its deviations.
    let [with, without] = [0, 1].map(|k| values[k].clone().expect("told"));
    for (k, truth) in TRUTH.iter().enumerate() {
        let [with, without] = [&with, &without].map(|estimate| &estimate.parameters[k]);
        let off = (with.value - without.value).abs();
        assert!(off < 2.0 * with.std, "{}: {off} {}", with.name, with.std);
        assert!((with.value - truth).abs() < 3.0 * with.std, "{}", with.name);
    }
    assert!((with.values()[0] / TRUTH[0] - 1.0).abs() > 0.01);
    assert!((without.values()[0] / TRUTH[0] - 1.0).abs() < 0.002);
    // Factors judge by deviations of blocks and rows by their own, which here come out otherwise: each is the one that it says it is.
    let judged = ask(Method::Wls, AtTurns::Judged);
    let merged = both.estimate(&wheel, &judged).expect("told");
    let direct = judged.fit_filtered(&wheel, &logs, Some(CORNER));
    let direct = direct.expect("told");
    for found in [merged, direct] {
        let chosen = if found.is_without_turns {
            &without
        } else {
            &with
        };
        for (found, chosen) in found.values().iter().zip(chosen.values()) {
            assert!((found / chosen - 1.0).abs() < 1e-9, "{found} {chosen}");
        }
    }
}

/// `L` starts in each piece where the filters of the motion have settled, so a wheel without friction comes out of pieces as of the whole.
#[test]
fn pieces_of_a_log_approximate_nothing() {
    let wheel = Wheel::new();
    let [inertia, viscous, _] = TRUTH;
    let piece = |samples: std::ops::Range<u32>| {
        let time: Vec<f64> = samples.map(|k| f64::from(k) / RATE).collect();
        let (q, tau): (Vec<f64>, Vec<f64>) = time
            .iter()
            .map(|t| {
                let (slow, fast) = ((3.0 * t).sin_cos(), (7.1 * t).sin_cos());
                let dq = 3.0 * slow.1 + 2.13 * fast.1;
                let ddq = -9.0 * slow.0 - 15.123 * fast.0;
                (slow.0 + 0.3 * fast.0, inertia * ddq + viscous * dq)
            })
            .unzip();
        Log::from_samples("wheel", time, vec![q], vec![tau]).expect("samples in order")
    };
    let mut factor = Factor::filtered(&wheel, BANDS, Some(CORNER)).expect("no shapes");
    // Two periods of the shared band.
    let overlap = 100;
    for part in 0..5 {
        let start = 2000 * part;
        let blocks = FactorBlock::of_filtered_log(
            &wheel,
            &piece(start..start + 2000 + overlap),
            &BANDS,
            Some(CORNER),
        );
        factor.extend(blocks.expect("a piece of some seconds"));
    }
    let whole = self::factor(&wheel, &piece(0..10_000 + overlap));
    let close = factor.samples().abs_diff(whole.samples());
    assert!(close < 10, "{} {}", factor.samples(), whole.samples());
    let found = factor.estimate(&wheel, &ask(Method::Wls, AtTurns::Kept));
    let found = found.expect("told").values();
    for (found, truth) in found.iter().zip([inertia, viscous, 0.0]) {
        assert!((found - truth).abs() < 1e-4 * viscous, "{found} {truth}");
    }
}

#[test]
fn factors_of_another_form_or_corner_are_refused() {
    let wheel = Wheel::new();
    let log = log(0.0);
    let filtered = || factor(&wheel, &log);
    let with = |bands: Bands, corner: Option<f64>| {
        Factor::filtered(&wheel, bands, corner).expect("no shapes")
    };
    let narrow = Bands {
        shared_hz: 5.0,
        ..BANDS
    };
    let plain = |bands: Bands| Factor::new(&wheel, bands).expect("no shapes");
    for (other, told) in [
        (
            with(BANDS, Some(7.0)),
            "different rows (of the form filtered with a corner of 7 rad/s, where filtered with a corner of 5 rad/s is wanted)",
        ),
        (
            plain(BANDS),
            "different rows (of the form acceleration, where filtered with a corner of 5 rad/s is wanted)",
        ),
        // Filters that are chosen differ where forms do.
        (plain(narrow), "different rows (of the form acceleration"),
        (with(narrow, Some(CORNER)), "different filters (5,30,90 Hz"),
    ] {
        let refused = filtered().merge(other).expect_err("another factor");
        let refused = refused.to_string();
        assert!(refused.contains(told), "{refused}");
        assert!(refused.contains("`--form` and `--corner`"), "{refused}");
    }
    assert!(plain(BANDS).merge(filtered()).is_err());
    assert!(filtered().push(&wheel, &log).is_err());
    assert!(plain(BANDS).push_filtered(&wheel, &log).is_err());
    let by_default = with(BANDS, None);
    let corner = std::f64::consts::TAU * BANDS.shared_hz;
    assert_eq!(by_default.form, Form::Filtered { corner });
    // A corner that the log's rate does not bear.
    let mut fast = with(BANDS, Some(1e9));
    let refused = fast
        .push_filtered(&wheel, &log)
        .expect_err("no such filter");
    assert!(matches!(refused, IdentifyError::Signal(_)), "{refused}");
}
