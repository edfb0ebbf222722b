//! Samples that a recorder lost.

use super::*;

fn rows(is_there: impl Fn(u32) -> bool, stamp: impl Fn(u32) -> f64) -> Vec<String> {
    let kept = (0..2000).filter(|k| is_there(*k));
    let row = |k: u32| {
        let t = stamp(k);
        format!("{t:.6},{:.9},{:.9}", (2.0 * t).sin(), 5.0 * (3.0 * t).cos())
    };
    kept.map(row).collect()
}

fn gaps(log: &Log) -> Vec<(usize, usize)> {
    let told = log.report.iter().filter_map(|note| match note {
        Note::Gaps { at } => Some((at.times, at.samples)),
        _ => None,
    });
    told.collect()
}

/// A gap and two single rows of a regular log: lines in their place, a hole over the long one, and nothing else changes.
#[test]
fn short_gaps_are_filled_and_long_ones_are_holes() {
    let lost = |k: u32| (400..450).contains(&k) || k == 700 || k == 1203;
    let regular = |k: u32| 0.002 * f64::from(k);
    let whole = read(&text("time,q1,tau1", &rows(|_| true, regular)), 1);
    let whole = whole.expect("a sound log");
    let log = read(&text("time,q1,tau1", &rows(|k| !lost(k), regular)), 1).expect("few are lost");
    assert_eq!(log.time, whole.time);
    assert_eq!(gaps(&log), [(3, 52)]);
    for (k, (found, there)) in log.q[0].iter().zip(&whole.q[0]).enumerate() {
        let is_lost = u32::try_from(k).is_ok_and(lost);
        let within = if is_lost { 6e-3 } else { 0.0 };
        assert!((found - there).abs() <= within, "{k}: {found} {there}");
    }
    let [hole] = &log.holes[..] else {
        panic!("{:?}", log.holes);
    };
    assert!((hole.start - 0.8).abs() < 1e-9 && (hole.end - 0.9).abs() < 1e-9);
    let told = log.report[0].to_string();
    assert!(
        told.starts_with(
            "samples are missing, 3 times, the first at 0.800 s, 52 samples in all, 0.100 s at most"
        ),
        "{told}"
    );
    let mended = log.mended();
    assert!(
        matches!(&mended.faults[..], [fault @ Fault::Gaps { .. }] if fault.channel() == "time"),
        "{:?}",
        mended.faults
    );
    assert_eq!(mended.log.holes.len(), 1);
}

/// A step of milliseconds that are taken for seconds is longer than any gap may be: the unit is what is told.
#[test]
fn a_gap_in_another_unit_of_time_is_told_as_the_unit() {
    for (unit, scale) in [("ms", 1e3), ("us", 1e6), ("ns", 1e9)] {
        let stamp = |k: u32| 0.002 * scale * f64::from(k);
        let said = read(
            &text("time,q1,tau1", &rows(|k| !(700..720).contains(&k), stamp)),
            1,
        );
        let said = said.expect_err("another unit").to_string();
        assert!(
            said.contains(&format!(
                "is time in seconds? in {unit} it would be plausible"
            )),
            "{said}"
        );
    }
}

/// With time stamps that jitter a step of two is none of a lost row, a step of many is; the grid goes on behind it.
#[test]
fn gaps_of_a_log_that_jitters_are_filled_too() {
    let jitters = |k: u32| 0.002 * f64::from(k) + 0.0007 * f64::from(k * k % 3);
    let lost = |k: u32| (400..440).contains(&k) || k == 700;
    let log = read(&text("time,q1,tau1", &rows(|k| !lost(k), jitters)), 1).expect("few are lost");
    assert_eq!(gaps(&log).iter().map(|gap| gap.0).collect::<Vec<_>>(), [1]);
    assert_eq!(log.holes.len(), 1);
    let is_in = |time: f64| log.holes[0].start - 0.004 < time && time < log.holes[0].end + 0.004;
    for (time, q) in log.time.iter().zip(&log.q[0]) {
        assert!(
            is_in(*time) || (q - (2.0 * time).sin()).abs() < 1e-4,
            "{time}: {q}"
        );
    }
    assert!(
        log.holes[0].start > 0.79 && log.holes[0].end < 0.89,
        "{:?}",
        log.holes
    );
}

/// Half a second, or a twentieth of the log, is too long; so is a row in ten that is lost, where steps are then taken as they are.
#[test]
fn long_gaps_are_refused() {
    let regular = |k: u32| 0.002 * f64::from(k);
    let with =
        |lost: &dyn Fn(u32) -> bool| read(&text("time,q1,tau1", &rows(|k| !lost(k), regular)), 1);
    assert!(with(&|k| (400..499).contains(&k)).is_ok());
    for lost in [400..505, 400..700] {
        let refused = with(&|k| lost.contains(&k))
            .expect_err("a long gap")
            .to_string();
        assert!(
            refused.contains("split the log here and give both parts"),
            "{refused}"
        );
    }
    let thin = with(&|k| k % 10 == 5).expect("jitter");
    assert!(
        matches!(thin.report[..], [Note::Resampled { .. }]),
        "{:?}",
        thin.report
    );
}

/// A piece has its own gaps, on its own time.
#[test]
fn pieces_have_holes_where_their_own_gaps_are() {
    let regular = |k: u32| 0.002 * f64::from(k);
    let text = text(
        "time,q1,tau1",
        &rows(|k| !(1000..1020).contains(&k), regular),
    );
    let columns = Columns::standard(1);
    let pieces = Pieces::new("monday.csv", text.as_bytes(), &columns, 600, 0.1).expect("a header");
    let pieces: Vec<Log> = pieces.map(|piece| piece.expect("a sound piece")).collect();
    let holes: Vec<f64> = pieces
        .iter()
        .flat_map(|piece| piece.holes.iter().map(|hole| piece.time[0] + hole.start))
        .collect();
    assert!(pieces.len() > 2);
    assert_eq!(holes.len(), 1);
    assert!((holes[0] - 2.0).abs() < 1e-9, "{holes:?}");
}

/// Rows without a number in them count as missing where they are few; text that is none, and many of them, are refused as before.
#[test]
fn rows_without_numbers_are_missing() {
    let regular = |k: u32| 0.002 * f64::from(k);
    let with = |bad: &dyn Fn(u32) -> Option<&'static str>| {
        let all = rows(|_| true, regular);
        let worn = all.into_iter().enumerate().map(|(k, row)| {
            let bad = u32::try_from(k).ok().and_then(bad);
            let (rest, _) = row.rsplit_once(',').expect("columns");
            bad.map_or(row.clone(), |bad| format!("{rest},{bad}"))
        });
        read(&text("time,q1,tau1", &worn.collect::<Vec<_>>()), 1)
    };
    let log = with(&|k| match k {
        300 => Some("nan"),
        400..=429 => Some(""),
        900 => Some("-inf"),
        _ => None,
    });
    let log = log.expect("few rows");
    assert_eq!(
        (log.time.len(), gaps(&log), log.holes.len()),
        (2000, vec![(3, 32)], 1)
    );
    assert_eq!(
        log.report[0].to_string(),
        "32 rows count as missing, the first of them since monday.csv:302: `nan` in column `tau1` is not finite; remove or repair the row"
    );
    for (time, tau) in log.time.iter().zip(&log.tau[0]) {
        assert!(
            (tau - 5.0 * (3.0 * time).cos()).abs() < 0.03,
            "{time}: {tau}"
        );
    }
    let refused = |log: Result<Log, LogError>| log.expect_err("bad rows").to_string();
    assert!(
        refused(with(&|k| (k == 300).then_some("1.2.3")))
            .contains("`1.2.3` in column `tau1` is not a number")
    );
    assert!(refused(with(&|k| (k % 16 == 3).then_some("nan"))).starts_with("monday.csv:5: `nan`"));
    // Half a second of them is a gap, whose rows are in the file.
    let long = |k: u32| (300..=560).contains(&k);
    let row = |k: u32| {
        format!(
            "{:.3},0.5,{}",
            regular(k),
            if long(k) { "nan" } else { "1" }
        )
    };
    let longer: Vec<String> = (0..6000).map(row).collect();
    assert!(refused(read(&text("time,q1,tau1", &longer), 1)).starts_with("monday.csv:302: `nan`"));
}

/// None of them is too long, and all together say too little of what the arm did.
#[test]
fn many_short_gaps_are_told_as_many() {
    let lost = |k: u32| (100..1900).contains(&k) && k % 300 < 60;
    let regular = |k: u32| 0.002 * f64::from(k);
    let refused = read(&text("time,q1,tau1", &rows(|k| !lost(k), regular)), 1);
    let told = refused.expect_err("six gaps").to_string();
    assert!(
        told.starts_with("monday.csv: 6 gaps in time take 0.72 s of 4.00 s, more than 5 %, the first after 0.598 s"),
        "{told}"
    );
}

/// A row without numbers has nothing to do with a gap elsewhere; of several the one inside the gap is named.
#[test]
fn gaps_are_told_where_they_are() {
    let with = |bad: &dyn Fn(u32) -> bool, is_there: &dyn Fn(u32) -> bool| {
        let row = |k: u32| {
            let tau = if bad(k) { "nan" } else { "1" };
            format!("{:.3},0.5,{tau}", 0.002 * f64::from(k))
        };
        let rows: Vec<String> = (0..60_000).filter(|k| is_there(*k)).map(row).collect();
        let refused = read(&text("time,q1,tau1", &rows), 1);
        refused.expect_err("a long gap").to_string()
    };
    let long = |k: u32| (50_000..51_000).contains(&k);
    let told = with(&|k| k == 8, &|k| !long(k));
    assert!(
        told.starts_with("monday.csv:50002: gap in time from 99.998 s to 102 s"),
        "{told}"
    );
    for bad in [51_000, 51_003] {
        let told = with(&|k| k == 49_990 || k == bad, &|k| !long(k));
        let gap = if bad == 51_000 {
            "`nan`"
        } else {
            "gap in time"
        };
        assert!(
            told.starts_with(&format!("monday.csv:50002: {gap}")),
            "{told}"
        );
    }
    let told = with(&|k| k == 8 || long(k), &|_| true);
    assert!(told.starts_with("monday.csv:50002: `nan`"), "{told}");
}
