//! What stands on the pages of `identify --report`.

use std::fmt::Write;

use scraper::{ElementRef, Html, Selector};

use crate::verbs::common::{CART, Folder, cart_log, json, white};
use crate::verbs::page::{all, text};

/// The report of an identification.
pub(crate) fn identified(more: &[&str]) -> Folder {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(40, 2.0, 0.0));
    folder.write("other.csv", &cart_log(20, 2.0, 0.7));
    let identify = ["identify", "cart.robot", "log.csv", "--report", "page"];
    folder.succeed(&[&identify[..], more].concat());
    folder
}

/// The cells of the first table whose caption has some words, row by row.
pub(crate) fn cells(page: &Html, caption: &str) -> Vec<Vec<String>> {
    let [head, rows, row_cells] =
        ["caption", "tbody tr", "th, td"].map(|what| Selector::parse(what).expect("a selector"));
    let mut tables = all(page, "table").into_iter();
    let table = tables.find(|table| {
        let mut captions = table.select(&head);
        captions.any(|found| text(found).contains(caption))
    });
    let table = table.unwrap_or_else(|| panic!("no table {caption}"));
    let row = |row: ElementRef| row.select(&row_cells).map(text).collect();
    table.select(&rows).map(row).collect()
}

#[test]
fn the_report_of_an_identification_says_what_was_found_whatever_the_method() {
    let validate = ["--validate", "other.csv"];
    let simulate = ["--method", "output-error", "--validate", "other.csv"];
    let factor = ["--factor", "factor.json"];
    let physical = ["--method", "physical", "--form", "acceleration"];
    for (more, columns, is_drawn) in [
        (&[][..], 5, true),
        (&validate, 9, true),
        (&["--form", "filtered"], 5, true),
        (&simulate, 9, true),
        (&factor, 5, false),
        (&physical, 5, true),
    ] {
        let folder = identified(&[more, &["--json", "fit.json"]].concat());
        let html = folder.read("page/index.html");
        let page = Html::parse_document(&html);
        let fit = json(&folder.read("fit.json"));
        // The parameters of the page are those of JSON.
        let rows = cells(&page, "95 % confidence intervals");
        let found = fit["parameters"].as_array().expect("a list");
        assert_eq!(rows.len(), found.len(), "{more:?}");
        for (row, parameter) in rows.iter().zip(found) {
            assert_eq!(parameter["name"], row[0].as_str());
            let value = parameter["value"].as_f64().expect("a number");
            let shown: f64 = row[1].parse().expect("a number");
            assert!((shown - value).abs() <= 1e-4 * value.abs(), "{row:?}");
            let [low, high] = [3, 4].map(|k| row[k].parse::<f64>().expect("a number"));
            assert!(low < shown && shown < high, "{row:?}");
        }
        let rows = cells(&page, "RMSE and MAE");
        assert_eq!(rows[0].len(), columns, "{more:?}: {rows:?}");
        let figures = all(&page, "svg").len();
        // The bars and the map of base parameters are there without a log.
        assert_eq!(figures > 2, is_drawn, "{more:?}: {figures}");
        assert!(html.contains("identify cart.robot log.csv --report page"));
    }
}

/// With a payload the page has the arm's parameters, the payload's, and errors of logs without and with it.
#[test]
fn the_report_of_a_payload_says_what_is_carried() {
    let folder = crate::verbs::payload::folder("");
    let identify = [
        "identify",
        "arm.robot",
        "empty.csv",
        "--payload",
        "loaded.csv",
    ];
    let outputs = [
        "--validate",
        "other.csv",
        "--json",
        "fit.json",
        "--report",
        "page",
    ];
    for known in [&[][..], &["--payload-mass", "0.8"]] {
        folder.succeed(&[&identify[..], &outputs, known].concat());
        let fit = json(&folder.read("fit.json"));
        let page = Html::parse_document(&folder.read("page/index.html"));
        let rows = cells(&page, "95 % confidence intervals");
        let found = [&fit["parameters"], &fit["payload"]["parameters"]];
        let names = found
            .into_iter()
            .flat_map(|list| list.as_array().expect("a list"));
        let names: Vec<&str> = names
            .map(|one| one["name"].as_str().expect("a name"))
            .collect();
        assert!(names.contains(&"lo.payload.mx"), "{names:?}");
        assert_eq!(
            rows.iter().map(|row| row[0].as_str()).collect::<Vec<_>>(),
            names
        );
        assert_eq!(cells(&page, "RMSE and MAE")[0].len(), 13, "{known:?}");
        let verdict = text(all(&page, ".verdict")[0]);
        assert_eq!(
            verdict.matches("Largest residual: ").count(),
            3,
            "{verdict}"
        );
        assert!(!all(&page, "svg").is_empty());
    }
}

/// A torque that has nothing to do with the motion: the page says so first of all.
#[test]
fn the_report_of_a_model_that_does_not_fit_says_so() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(40, 2.0, 0.0);
    let rows = log.lines().enumerate().map(|(k, line)| {
        if k == 0 {
            return line.to_owned();
        }
        let fields: Vec<&str> = line.split(',').collect();
        let noise = ((k * k) % 97) as f64 - 48.0;
        format!("{},{},{noise}", fields[0], fields[1])
    });
    folder.write("log.csv", &rows.collect::<Vec<_>>().join("\n"));
    folder.write("robot-model.toml", "[log]\nq = { unit = \"m\" }\n");
    folder.succeed(&["identify", "cart.robot", "log.csv", "--report", "page"]);
    let html = folder.read("page/index.html");
    let page = Html::parse_document(&html);
    let verdict = text(all(&page, ".verdict")[0]);
    assert!(verdict.starts_with("The model does not fit"), "{verdict}");
    // What to do comes before how files were read, though it was found later.
    let place = |words: &str| {
        html.find(words)
            .unwrap_or_else(|| panic!("no {words}: {html}"))
    };
    let of_result = place("<h3>What to check</h3>");
    let of_files = place("<summary>How the files were read: ");
    assert!(place("explains almost none of the torque") > of_result);
    assert!(of_result < of_files && of_files < place("robot-model.toml sets the columns"));
    assert!(of_files > place("RMSE and MAE: root mean square"));
}

/// The verdict, which joint is worst, what comes next and a bar of the error stand above all that is said of files.
#[test]
fn a_page_begins_with_errors_and_the_next_command() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(40, 2.0, 0.0));
    folder.write("other.csv", &cart_log(20, 2.0, 0.7));
    folder.write("robot-model.toml", "[log]\nq = { unit = \"m\" }\n");
    let identify = [
        "identify",
        "cart.robot",
        "log.csv",
        "--validate",
        "other.csv",
    ];
    folder.succeed(&[&identify[..], &["--report", "page"]].concat());
    let html = folder.read("page/index.html");
    let page = Html::parse_document(&html);
    let verdict = text(all(&page, ".verdict")[0]);
    for of in ["(fitted).", "(validation)."] {
        assert!(
            verdict.contains("% of the torque of rail ") && verdict.contains(of),
            "{verdict}"
        );
    }
    let place = |words: &str| {
        html.find(words)
            .unwrap_or_else(|| panic!("no {words}: {html}"))
    };
    let next = place(
        "robot-model trace cart.robot log.csv --validate other.csv --report page-trace</pre>",
    );
    let bars = place("<svg class=\"bars\"");
    let files = place("<summary>How the files were read: ");
    assert!(next < bars && bars < place("RMSE and MAE: root mean square") && bars < files);
    // It is closed.
    assert_eq!(&html[files - "<details>".len()..files], "<details>");
}

/// Late torques are of one log, and want another spec or log: they are no remark on a file.
#[test]
fn late_torques_are_to_be_looked_at() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(40, 0.0, 0.0);
    let rows: Vec<Vec<&str>> = log.lines().map(|line| line.split(',').collect()).collect();
    let late = rows.iter().enumerate().map(|(k, row)| {
        let tau = if k == 0 {
            row[2]
        } else {
            rows[k.saturating_sub(3).max(1)][2]
        };
        format!("{},{},{tau}", row[0], row[1])
    });
    folder.write("log.csv", &late.collect::<Vec<_>>().join("\n"));
    folder.write("robot-model.toml", "[log]\nq = { unit = \"m\" }\n");
    folder.succeed(&["identify", "cart.robot", "log.csv", "--report", "page"]);
    let html = folder.read("page/index.html");
    let place = |words: &str| {
        html.find(words)
            .unwrap_or_else(|| panic!("no {words}: {html}"))
    };
    let of_files = place("<summary>How the files were read: ");
    let told = place("<li>log.csv: ");
    assert!(place("<h3>What to check</h3>") < told && told < of_files);
}

/// A table with two intervals' worth of numbers says which are whose.
#[test]
fn intervals_of_draws_are_told_from_those_of_the_formula() {
    for (more, said) in [
        (&[][..], "1.96 standard deviations to either side"),
        (&["--bootstrap", "100"], "from the draws of --bootstrap"),
    ] {
        let page = Html::parse_document(&identified(more).read("page/index.html"));
        let captions: Vec<String> = all(&page, "caption").into_iter().map(text).collect();
        assert!(
            captions.iter().any(|caption| caption.contains(said)),
            "{captions:?}"
        );
    }
}

/// A folder that was made for a report that never came goes with it.
#[test]
fn a_refused_identification_leaves_no_report() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", "time,q1,tau1\n0,0,0\n");
    let before = folder.files();
    folder.refuse(&["identify", "cart.robot", "log.csv", "--report", "page"]);
    assert_eq!(folder.files(), before);
}

/// Seven joints for a minute at 1 kHz, and as long a log to judge by: torques of no arm, of which a page has as much to draw as of any.
#[test]
fn the_report_of_seven_joints_and_a_minute_is_light() {
    let folder = Folder::new();
    let joints = (1..=7).map(|k| {
        let alpha = if k % 2 == 0 { 90 } else { -90 };
        format!("joint j{k}: revolute {{ a = 0.1; alpha = {alpha} deg; d = 0.3; }}\n")
    });
    let joints: String = joints.collect();
    let effects = "effects { viscous_friction on all; coulomb_friction on all; }";
    folder.write(
        "arm.robot",
        &format!("robot Seven {{ gravity = [0, 0, -9.81]; convention = standard_dh;\n{joints}{effects} }}"),
    );
    let mut state = 7;
    for file in ["log.csv", "other.csv"] {
        let mut log = String::from("time,q1,q2,q3,q4,q5,q6,q7,tau1,tau2,tau3,tau4,tau5,tau6,tau7");
        for row in 0..=60_000 {
            let t = f64::from(row) / 1000.0;
            let of = |joint: i32| (t * (1.0 + 0.37 * f64::from(joint))).sin();
            let positions = (0..7).map(of);
            let torques = (0..7).map(|joint| 5.0 * of(joint + 1) + white(&mut state));
            write!(log, "\n{t}").expect("a string takes all");
            for value in positions.chain(torques) {
                write!(log, ",{value:.6}").expect("a string takes all");
            }
        }
        folder.write(file, &log);
    }
    let validate = ["--validate", "other.csv", "--report", "page"];
    folder.succeed(&[&["identify", "arm.robot", "log.csv"][..], &validate].concat());
    let html = folder.read("page/index.html");
    let figures = all(&Html::parse_document(&html), "svg").len();
    assert!(figures >= 7, "{figures} figures");
    assert!(
        (100_000..3_000_000).contains(&html.len()),
        "{} bytes",
        html.len()
    );
}
