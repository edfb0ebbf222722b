//! What stands on the pages of `trace --report`.

use scraper::Html;

use crate::verbs::common::{CART, Folder, cart_breaking_away, cart_log};
use crate::verbs::delays::late;
use crate::verbs::page::{all, text};
use crate::verbs::page_of_identify::cells;

/// The report of a trace of a cart, and its folder.
fn traced(spec: &str, log: &str) -> (Folder, String) {
    let folder = Folder::new();
    folder.write("cart.robot", spec);
    folder.write("log.csv", log);
    folder.succeed(&["trace", "cart.robot", "log.csv", "--report", "page"]);
    let html = folder.read("page/index.html");
    (folder, html)
}

/// The paragraph below a heading.
fn below(html: &str, heading: &str) -> String {
    let start = html
        .find(&format!(">{heading}</h2>"))
        .unwrap_or_else(|| panic!("no {heading}"));
    let rest = &html[start..];
    let text = rest
        .split("<p>")
        .nth(1)
        .and_then(|text| text.split("</p>").next());
    text.expect("a paragraph").to_owned()
}

#[test]
fn where_nothing_is_missing_the_page_says_that_nothing_was_added() {
    let (_, html) = traced(CART, &cart_log(40, 0.0, 0.0));
    let page = Html::parse_document(&html);
    assert!(text(all(&page, ".verdict")[0]).starts_with("Nothing missing"));
    assert_eq!(
        below(&html, "Change of the spec"),
        "Nothing was added to the spec: the declared model leaves no significant structure."
    );
    assert!(
        !html.contains("amended") && !html.contains("after</"),
        "{html}"
    );
    // All that was looked for, with nothing found but the rate.
    let looks = cells(&page, "Checks of the fitted logs");
    assert!(looks.len() >= 10, "{looks:?}");
    for look in &looks {
        let is_of_velocities = look[0].starts_with("logged velocities");
        let wanted = if is_of_velocities {
            "not checked: no log has velocities"
        } else {
            "none found"
        };
        assert!(look[1].starts_with(wanted), "{look:?}");
    }
    assert_eq!(looks[0][1], "none found: 200.0 Hz");
}

#[test]
fn a_verdict_has_units_and_the_fall_of_the_error() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(40, 4.0, 0.0));
    folder.write("other.csv", &cart_log(40, 4.0, 0.7));
    let validated = ["--validate", "other.csv", "--report", "page"];
    let told = folder.succeed(&[&["trace", "cart.robot", "log.csv"][..], &validated].concat());
    let finding = told.lines().nth(1).expect("a finding");
    assert!(
        finding.starts_with("  coulomb-friction on rail: fc = 4.0")
            && finding.contains(" N (score"),
        "{finding}"
    );
    let html = folder.read("page/index.html");
    let page = Html::parse_document(&html);
    let items: Vec<String> = all(&page, "li").into_iter().map(text).collect();
    let has = |start: &str, end: &str| {
        let mut items = items.iter();
        items.any(|item| item.starts_with(start) && item.ends_with(end))
    };
    assert!(has("coulomb-friction on rail: fc = 4.0", " N"), "{items:?}");
    let fall = "on the validation log the error of rail falls from ";
    assert!(has(fall, " % of its torque"), "{items:?}");
}

/// The command of each page leads to the next one.
#[test]
fn the_next_command_of_a_page_is_one_that_can_be_given() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(40, 4.0, 0.0));
    let next = || {
        let html = folder.read("page/index.html");
        let rest = html.split_once("<h3>Next</h3>").expect("a next command").1;
        let (command, _) = rest.split_once("</pre>").expect("an end");
        let (_, commands) = command
            .split_once("<pre class=\"commands\">")
            .expect("commands");
        let first = commands.lines().next().expect("a command").to_owned();
        // It stands above the figures.
        assert!(html.find("<h3>Next</h3>") < html.find("<svg"), "{html}");
        first
    };
    let given = |command: &str| {
        let words = shlex::split(command).expect("a command of a shell");
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        assert_eq!(words[0], "robot-model");
        folder.succeed(&words[1..])
    };
    given("robot-model trace cart.robot log.csv --report page");
    given(&next());
    let amended = folder.read("cart-amended.robot");
    assert!(amended.contains("coulomb_friction on rail"), "{amended}");
    given("robot-model trace cart-amended.robot log.csv --report page");
    let told = given(&next());
    assert!(told.contains("rail.coulomb_friction.fc"), "{told}");
    assert!(folder.read("fit.json").contains("coulomb_friction"));
    assert!(
        folder
            .read("page-fit/index.html")
            .contains("Identification")
    );
}

/// The shapes of what was found have rows among the parameters, and each interval is the one of the verdict.
#[test]
fn shapes_of_what_was_found_are_parameters_with_the_intervals_of_the_verdict() {
    let (spec, log) = cart_breaking_away();
    let folder = Folder::new();
    folder.write("cart.robot", &spec);
    folder.write("log.csv", &log);
    folder.write("robot-model.toml", "[log]\nq = { unit = \"m\" }\n");
    folder.succeed(&["trace", "cart.robot", "log.csv", "--report", "page"]);
    let html = folder.read("page/index.html");
    let page = Html::parse_document(&html);
    let mut items = all(&page, "li").into_iter().map(text);
    let found = items.find(|item| item.starts_with("stribeck on rail: "));
    let found = found.expect("a finding");
    let rows = cells(&page, "95 % confidence intervals");
    for name in ["fs", "vs"] {
        let row = rows
            .iter()
            .find(|row| row[0] == format!("rail.stribeck.{name}"));
        let row = row.unwrap_or_else(|| panic!("no row of {name}: {rows:?}"));
        let told = found.split(&format!("{name} = ")).nth(1);
        let told = told.and_then(|rest| Some(rest.split_once('(')?.1.split_once(')')?.0));
        let ends = told.expect("an interval").split(" .. ");
        for (told, row) in ends.zip(&row[3..5]) {
            let [told, row] = [told, row].map(|end| end.parse::<f64>().expect("a number"));
            assert!((told - row).abs() < 0.02 * row.abs(), "{found}: {rows:?}");
        }
    }
    // What was assumed of the files is there, too.
    assert!(
        html.contains("<summary>How the files were read: ")
            && html.contains("robot-model.toml sets the columns of <code>q</code>"),
        "{html}"
    );
}

#[test]
fn a_delay_is_said_to_be_found_by_the_data_gate() {
    let (_, html) = traced(CART, &late(&cart_log(20, 0.0, 0.0), 4));
    let page = Html::parse_document(&html);
    let verdict = text(all(&page, ".verdict")[0]);
    assert!(
        verdict.ends_with("The faults of the logs explain the residual of the declared model."),
        "{verdict}"
    );
    let tried = cells(&page, "Effects that explained most");
    let delays = tried.iter().filter(|row| row[1] == "time-delay");
    for row in delays {
        assert!(row[5].starts_with("found by the data gate"), "{row:?}");
    }
    let looks = cells(&page, "Checks of the fitted logs");
    let look = looks
        .iter()
        .find(|look| look[0] == "delays between channels");
    let found = &look.expect("delays")[1];
    assert!(
        found.starts_with("tau1 is 20.0") && found.contains("ms late"),
        "{found}"
    );
}

/// Effects of the library and of one's own, on a joint that slides.
#[test]
fn parameters_of_effects_have_units() {
    let own = "\
/// Dry friction of my seal.
effect seal(j) {
    /// Force of the seal, N m (N for a prismatic joint).
    linear f >= 0;
    torque(j) = f * sign(dq(j));
}
";
    let spec = CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail;\n        seal on rail;",
    );
    let (_, html) = traced(&format!("{own}{spec}"), &cart_log(40, 2.0, 0.0));
    let page = Html::parse_document(&html);
    let rows = cells(&page, "95 % confidence intervals");
    let told = |name: &str| {
        let row = rows.iter().find(|row| row[0] == name);
        let row = row.unwrap_or_else(|| panic!("{name}: {rows:?}"));
        [row[5].clone(), row[6].clone()]
    };
    assert_eq!(told("rail.seal.f"), ["N", "Force of the seal"]);
    assert_eq!(
        told("rail.viscous_friction.fv"),
        ["N s/m", "Viscous coefficient"]
    );
}

/// Another reader sees whether he has the same files, and gets the same page from them.
#[test]
fn a_page_says_of_which_files_it_is() {
    let (folder, html) = traced(CART, &cart_log(20, 0.0, 0.0));
    let version = format!("with robot-model {}:", env!("CARGO_PKG_VERSION"));
    assert!(
        below(&html, "How to reproduce").contains(&version),
        "{html}"
    );
    let page = Html::parse_document(&html);
    let files = cells(&page, "Input files");
    let names: Vec<&str> = files.iter().map(|row| row[0].as_str()).collect();
    assert_eq!(names, ["cart.robot", "log.csv"]);
    assert_eq!(files[0][1], CART.len().to_string());
    let again = || {
        folder.succeed(&["trace", "cart.robot", "log.csv", "--report", "page"]);
        folder.read("page/index.html")
    };
    assert_eq!(again(), html);
    // One more digit of the last torque.
    let log = folder.read("log.csv");
    folder.write("log.csv", &format!("{}1\n", log.trim_end()));
    let other = Html::parse_document(&again());
    let others = cells(&other, "Input files");
    assert_eq!(files[0], others[0]);
    assert_ne!(files[1][2], others[1][2]);
}
