//! `identify --method iv`: what motions without noise tell of a log with noisy encoders.

use crate::verbs::common::{json, numbers};
use crate::verbs::methods::{TRUTH, folder, identify, values};

#[test]
fn instruments_see_what_noisy_accelerations_hide() {
    let folder = folder();
    // Filters that let the encoders' noise through.
    let wide = ["--bands", "100,150,150"];
    let (ordinary, _) = identify(&folder, "arm.robot", &wide);
    let inertia = values(&ordinary, "value")[5];
    assert!(
        (inertia - TRUTH[5]).abs() > 0.01,
        "noise of accelerations hides inertia: {inertia}"
    );
    let instruments = ["--method", "iv", "--instruments", "wanted.csv"];
    let (fit, said) = identify(&folder, "arm.robot", &[&wide[..], &instruments].concat());
    let (found, std) = (values(&fit, "value"), values(&fit, "std"));
    for (c, truth) in TRUTH.iter().enumerate() {
        let off = (found[c] - truth).abs();
        assert!(off < 3.5 * std[c] && off < 0.05, "{c}: {found:?} {std:?}");
    }
    let hausman = &fit["hausman"];
    assert!(
        hausman["probability"].as_f64().expect("a number") < 1e-3,
        "{hausman}"
    );
    assert_eq!(numbers(&hausman["differences"]).len(), found.len());
    assert_eq!(
        hausman["least_squares"][5]["value"],
        ordinary["parameters"][5]["value"]
    );
    assert!(
        said.contains("Durbin, Wu, Hausman: they disagree"),
        "{said}"
    );
    // Where the filters do their work, both agree about what moves slowly.
    let (fit, _) = identify(&folder, "arm.robot", &instruments);
    assert!((values(&fit, "value")[2] - TRUTH[2]).abs() < 0.01);
    // The filtered form has instruments, too.
    let filtered = [&instruments[..], &["--form", "filtered"]].concat();
    let (fit, _) = identify(&folder, "arm.robot", &filtered);
    assert!((values(&fit, "value")[2] - TRUTH[2]).abs() < 0.01);
}

/// Filters so wide that accelerations are noise: instruments part what least squares is refused.
#[test]
fn what_noise_drowns_instruments_tell() {
    let folder = folder();
    let wide = ["identify", "arm.robot", "log.csv", "--bands", "60,100,150"];
    let refused = folder.refuse(&[&wide[..], &["--json", "fit.json"]].concat());
    assert!(
        refused.contains("only position noise: lower `--bands` reduce it"),
        "{refused}"
    );
    let (fit, _) = identify(
        &folder,
        "arm.robot",
        &[
            &wide[3..],
            &["--method", "iv", "--instruments", "wanted.csv"],
        ]
        .concat(),
    );
    let (found, std) = (values(&fit, "value"), values(&fit, "std"));
    for (c, truth) in TRUTH.iter().enumerate() {
        let off = (found[c] - truth).abs();
        assert!(
            off < 3.5 * std[c] && std[c] < 0.01,
            "{c}: {found:?} {std:?}"
        );
    }
}

/// What a simulation without noise wrote is a motion for instruments; that noise of the columns is left of the torque is no fault of the model.
#[test]
fn instruments_may_be_of_a_simulation() {
    let folder = folder();
    let clean = ["--trajectory", "wanted.csv", "--out", "clean.csv"];
    let more = ["--parameters", "values.json"];
    folder.succeed(&[&["simulate", "arm.robot"][..], &clean, &more].concat());
    let wide = ["identify", "arm.robot", "log.csv", "--bands", "100,150,150"];
    let instruments = ["--method", "iv", "--instruments", "clean.csv"];
    let out = ["--json", "fit.json"];
    let run = folder.run(&[&wide[..], &instruments, &out].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(!run.stderr.contains("almost none"), "{}", run.stderr);
    let fit = json(&folder.read("fit.json"));
    // As far as that is so here.
    let left = numbers(&fit["relative_percent"]);
    assert!(left.iter().all(|percent| *percent > 85.0), "{left:?}");
    let (found, std) = (values(&fit, "value"), values(&fit, "std"));
    for (c, truth) in TRUTH.iter().enumerate() {
        let off = (found[c] - truth).abs();
        assert!(off < 3.5 * std[c] && off < 0.05, "{c}: {found:?} {std:?}");
    }
}

/// The motion of another log, as a whole and from another time on.
#[test]
fn instruments_of_another_motion_are_noted() {
    let folder = folder();
    let wanted = folder.read("wanted.csv");
    let mut lines = wanted.lines();
    let header = lines.next().expect("a header");
    let turned: Vec<String> = lines
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            format!("{},{},{}", fields[0], fields[2], fields[1])
        })
        .collect();
    folder.write("turned.csv", &format!("{header}\n{}\n", turned.join("\n")));
    let notes = |motion: &str| {
        let identify = ["identify", "arm.robot", "log.csv", "--method", "iv"];
        let run = folder.run(&[&identify[..], &["--instruments", motion]].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        run.stderr
    };
    let said = notes("turned.csv");
    assert!(
        said.contains("note: turned.csv hardly resembles the motion of log.csv"),
        "{said}"
    );
    let said = notes("wanted.csv");
    assert!(!said.contains("hardly resembles"), "{said}");
}
