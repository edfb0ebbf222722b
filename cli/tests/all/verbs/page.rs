//! Pages of `--report`: readable by all, light, and alive in a browser.

use std::collections::BTreeSet;
use std::io::Write as _;
use std::process::Command;

use scraper::{ElementRef, Html, Selector};

use crate::verbs::common::{CART, Folder, cart_log};
use crate::verbs::page_of_identify::identified;

pub(crate) fn all<'a>(page: &'a Html, what: &str) -> Vec<ElementRef<'a>> {
    let selector = Selector::parse(what).expect("a selector");
    page.select(&selector).collect()
}

pub(crate) fn text(element: ElementRef) -> String {
    element.text().collect::<String>().trim().to_owned()
}

/// The report of a trace that finds something.
fn traced() -> Folder {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(40, 2.0, 0.0));
    folder.write("other.csv", &cart_log(20, 2.0, 0.7));
    let trace = ["trace", "cart.robot", "log.csv", "--validate", "other.csv"];
    folder.succeed(&[&trace[..], &["--report", "page"]].concat());
    folder
}

/// What a screen reader and a keyboard need (WCAG 2.2: 1.1.1, 1.3.1, 2.1.1, 2.4.1, 2.4.2, 2.4.6, 3.1.1, 4.1.2).
#[test]
fn a_report_is_readable_without_seeing_it() {
    is_readable(&traced().read("page/index.html"));
    let folder = identified(&[]);
    is_readable(&folder.read("page/index.html"));
}

fn is_readable(html: &str) {
    let page = Html::parse_document(html);
    assert!(page.errors.is_empty(), "{:?}", page.errors);
    assert_eq!(
        all(&page, "html")[0].value().attr("lang"),
        Some("en"),
        "the page's language"
    );
    assert!(!text(all(&page, "title")[0]).is_empty());
    assert_eq!(all(&page, "h1").len(), 1);
    assert_eq!(all(&page, "main").len(), 1);
    // No level is left out.
    let mut before = 1;
    for heading in all(&page, "h1, h2, h3, h4") {
        let level: u32 = heading.value().name()[1..].parse().expect("a level");
        assert!(level <= before + 1, "{} after h{before}", heading.html());
        assert!(!text(heading).is_empty());
        before = level;
    }
    let figures = all(&page, "svg");
    assert!(figures.len() >= 6, "{}", figures.len());
    let mut labels = BTreeSet::new();
    for figure in figures {
        assert_eq!(figure.value().attr("role"), Some("img"));
        let label = figure.value().attr("aria-label").unwrap_or_default();
        assert!(label.len() > 10, "a figure called `{label}`");
        assert!(labels.insert(label), "two figures called `{label}`");
    }
    for figure in all(&page, "figure") {
        let caption = Selector::parse("figcaption").expect("a selector");
        assert!(
            figure
                .select(&caption)
                .any(|caption| !text(caption).is_empty())
        );
    }
    let tables = all(&page, "table");
    assert!(tables.len() >= 3, "{}", tables.len());
    for table in tables {
        let caption = Selector::parse("caption").expect("a selector");
        assert!(
            table
                .select(&caption)
                .any(|caption| !text(caption).is_empty())
        );
        for head in table.select(&Selector::parse("th").expect("a selector")) {
            assert!(head.value().attr("scope").is_some(), "{}", head.html());
        }
    }
    for button in all(&page, "button, summary, a") {
        assert!(!text(button).is_empty(), "{}", button.html());
    }
    // What scrolls can be scrolled by keys.
    for wide in all(&page, ".wide") {
        assert_eq!(wide.value().attr("tabindex"), Some("0"), "{}", wide.html());
    }
    let mut anchors = BTreeSet::new();
    for element in all(&page, "[id]") {
        let id = element.value().attr("id").unwrap_or_default();
        assert!(anchors.insert(id), "two `{id}`");
    }
    for link in all(&page, "a[href]") {
        let target = link.value().attr("href").unwrap_or_default();
        let target = target
            .strip_prefix('#')
            .expect("nothing but the page itself");
        assert!(anchors.contains(target), "no {target}");
    }
}

/// Relative luminance of `#rrggbb` (WCAG 2.2).
fn luminance(color: &str) -> f64 {
    let channel = |place: usize| {
        let value = u8::from_str_radix(&color[place..place + 2], 16).expect("a color");
        let value = f64::from(value) / 255.0;
        if value <= 0.04045 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        }
    };
    0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
}

fn contrast(one: &str, other: &str) -> f64 {
    let (one, other) = (luminance(one), luminance(other));
    (one.max(other) + 0.05) / (one.min(other) + 0.05)
}

/// Text 4.5 times, lines and dots 3 times as light or as dark as what is behind it, on a light and on a dark screen and on paper.
#[test]
fn a_report_has_enough_contrast() {
    assert!((contrast("#000000", "#ffffff") - 21.0).abs() < 1e-9);
    let style = include_str!("../../../src/report/page.css");
    // Each `:root` in its place; what a later one leaves out is as in the first.
    let mut first = std::collections::BTreeMap::new();
    let mut looked_at = 0;
    for theme in style.split(":root {").skip(1) {
        let block = theme.split('}').next().expect("a block");
        let mut colors = first.clone();
        for entry in block.split(';') {
            let Some((name, value)) = entry.split_once(": #") else {
                continue;
            };
            colors.insert(name.trim().to_owned(), format!("#{}", value.trim()));
        }
        if first.is_empty() {
            first.clone_from(&colors);
        }
        // A theme that left a color out would have that of a dark screen on paper.
        for name in first.keys() {
            assert!(
                block.contains(&format!("{name}: #")),
                "{name}, theme {looked_at}"
            );
        }
        looked_at += 1;
        let pairs = [
            ("--ink", "--paper", 4.5),
            ("--soft", "--paper", 4.5),
            ("--ink", "--panel", 4.5),
            ("--known", "--paper", 4.5),
            ("--good", "--panel", 3.0),
            ("--known", "--panel", 3.0),
            ("--open", "--panel", 3.0),
            ("--before", "--paper", 3.0),
            ("--after", "--paper", 3.0),
            ("--measured", "--paper", 3.0),
            // Told apart without their hues, too.
            ("--before", "--after", 2.0),
        ];
        for (front, back, least) in pairs {
            let found = contrast(&colors[front], &colors[back]);
            assert!(
                found >= least,
                "{front} on {back}: {found:.2}, theme {looked_at}"
            );
        }
    }
    assert_eq!(looked_at, 3);
}

/// However long a log is, a figure has so many dots; so a page grows with its joints alone. That of `identify` is asked of seven joints.
#[test]
fn a_report_of_seven_joints_is_light() {
    let html = traced().read("page/index.html");
    let page = Html::parse_document(&html);
    let figures = all(&page, "svg");
    let drawn: usize = figures.iter().map(|figure| figure.html().len()).sum();
    // This log of 40 s at 200 Hz has more rows than a figure has dots of a model: longer ones have no more.
    let dots = |figure: &ElementRef| figure.html().matches("h0").count();
    let most = figures.iter().map(dots).max().unwrap_or_default();
    assert!((500..=800).contains(&most), "{most} dots of two models");
    let rest = html.len() - drawn;
    assert!(7 * drawn + 7 * rest < 3_000_000, "{drawn} and {rest} bytes");
}

/// What a browser is asked to do: open all, sort every table by each of its heads, and say what it saw.
const LOOK: &str = r#"<script>
addEventListener("load", () => {
    document.querySelectorAll("details").forEach((part) => { part.open = true; });
    const seen = [...document.querySelectorAll("svg")].map((figure) => {
        const { width, height } = figure.getBoundingClientRect();
        return width > 100 && height > 40;
    });
    // Letters as they are seen, px.
    const letters = [...document.querySelectorAll("svg")].flatMap((figure) => {
        const scale = figure.getBoundingClientRect().width / figure.viewBox.baseVal.width;
        return [...figure.querySelectorAll("text")].map((text) => scale * parseFloat(getComputedStyle(text).fontSize));
    });
    let sorted = 0, unsorted = [];
    for (const table of document.querySelectorAll("table")) {
        const heads = [...table.querySelectorAll("thead th")];
        heads.forEach((head, column) => {
            for (const way of ["ascending", "descending"]) {
                head.querySelector("button").click();
                const cells = [...table.tBodies[0].rows].map((row) => row.cells[column]);
                const numbers = cells.filter((cell) => "value" in cell.dataset).map((cell) => Number(cell.dataset.value));
                const rises = numbers.every((value, k) => k === 0 || (way === "ascending" ? numbers[k - 1] <= value : numbers[k - 1] >= value));
                const told = head.getAttribute("aria-sort") === way;
                if (rises && told) { sorted += 1; } else { unsorted.push(head.textContent); }
            }
        });
    }
    const wider = document.documentElement.scrollWidth > innerWidth;
    const cut = [...document.querySelectorAll(".drawings")].filter((figure) => figure.scrollWidth > figure.clientWidth).length;
    // Rows keep their names while the rest of a wide table moves.
    const nameless = [...document.querySelectorAll(".wide:has(> table)")].filter((box) => {
        box.scrollLeft = box.scrollWidth;
        const [name, whole] = [box.querySelector("tbody th"), box].map((part) => part.getBoundingClientRect());
        return box.scrollLeft > 0 && (Math.abs(name.left - whole.left) > 1 || name.width > whole.width / 2);
    }).length;
    const sideways = [...document.querySelectorAll(".wide:has(> .cards)")].filter((box) => box.scrollWidth > box.clientWidth).length;
    const found = { nameless, sideways, errors: window.errors, figures: seen.length, unseen: seen.filter((is) => !is).length, sorted, unsorted, wider, cut,
        smallest: Math.min(...letters), largest: Math.max(...letters) };
    const place = document.createElement("pre");
    place.id = "found";
    place.textContent = JSON.stringify(found);
    document.body.append(place);
    parent.postMessage(place.textContent, "*");
});
</script>"#;

/// A phone: browsers without a head have no window as narrow as this frame.
const PHONE: &str = r#"<!DOCTYPE html><html lang="en"><head><title>a phone</title></head><body>
<script>addEventListener("message", (event) => { document.querySelector("pre").textContent = event.data; });</script>
<iframe src="look.html" title="a page" style="width: 360px; height: 800px; border: 0"></iframe><pre id="found"></pre></body></html>"#;

const LISTEN: &str = r#"<script>
window.errors = [];
addEventListener("error", (event) => window.errors.push(String(event.message)));
const error = console.error;
console.error = (...words) => { window.errors.push(words.join(" ")); error(...words); };
</script>"#;

/// A browser on the path, or the one that `CHROMIUM` names.
fn browser() -> Option<std::path::PathBuf> {
    if let Some(named) = std::env::var_os("CHROMIUM") {
        return Some(named.into());
    }
    let path = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome", "chrome"];
    std::env::split_paths(&path)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|file| file.is_file())
}

#[test]
fn a_report_works_in_a_browser_on_a_desk_and_on_a_phone() {
    let Some(browser) = browser() else {
        let _ = writeln!(
            std::io::stderr(),
            "not tested: reports in a browser; no chromium on the path, and CHROMIUM names none"
        );
        return;
    };
    for folder in [traced(), identified(&["--validate", "other.csv"])] {
        works_in(&browser, &folder);
    }
}

fn works_in(browser: &std::path::Path, folder: &Folder) {
    let page = folder.read("page/index.html");
    let listening = page.replacen("<head>", &format!("<head>{LISTEN}"), 1);
    let looked_at = listening.replacen("</body>", &format!("{LOOK}</body>"), 1);
    folder.write("look.html", &looked_at);
    folder.write("phone.html", PHONE);
    for (file, width) in [("look.html", 1280), ("look.html", 500), ("phone.html", 500)] {
        let out = Command::new(browser)
            .args([
                "--headless=new",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-dev-shm-usage",
                // As on a phone, where they take no room.
                "--hide-scrollbars",
            ])
            .args(["--virtual-time-budget=20000", "--dump-dom"])
            .arg(format!("--window-size={width},900"))
            .arg(format!(
                "--user-data-dir={}",
                folder.path("profile").display()
            ))
            .arg(format!("file://{}", folder.path(file).display()))
            .output()
            .expect("a browser that starts");
        let dom = String::from_utf8_lossy(&out.stdout);
        let dom = Html::parse_document(&dom);
        let found = all(&dom, "#found");
        let found = found.first().map(|found| text(*found));
        let found = found.unwrap_or_else(|| panic!("{}", String::from_utf8_lossy(&out.stderr)));
        let found: serde_json::Value =
            serde_json::from_str(&found).unwrap_or_else(|error| panic!("{file}: {error}: {found}"));
        assert_eq!(found["errors"], serde_json::json!([]), "{found}");
        assert_eq!(found["unsorted"], serde_json::json!([]), "{found}");
        assert!(found["sorted"].as_u64().expect("a number") >= 30, "{found}");
        assert!(found["figures"].as_u64().expect("a number") >= 6, "{found}");
        assert_eq!(found["unseen"], 0, "{found}");
        assert_eq!(found["wider"], false, "{found}, {file} {width} wide");
        assert_eq!(found["cut"], 0, "{found}, {file} {width} wide");
        if width < 640 {
            assert_eq!(found["nameless"], 0, "{found}, {file} {width} wide");
            assert_eq!(found["sideways"], 0, "{found}, {file} {width} wide");
        }
        let [smallest, largest] =
            ["smallest", "largest"].map(|which| found[which].as_f64().expect("a number"));
        assert!(smallest >= 9.0, "{found}, {width} wide");
        // Bars shrink to the width of a phone, and their letters with them; maps beside them do not.
        let most = if width < 1000 { 1.4 } else { 1.2 };
        assert!(largest <= most * smallest, "{found}, {file} {width} wide");
    }
}

/// Browsers print borders, and no backgrounds.
#[test]
fn a_printed_page_has_its_keys_and_whole_figures() {
    let style = include_str!("../../../src/report/page.css");
    let html = traced().read("page/index.html");
    let page = Html::parse_document(&html);
    let keys = all(&page, ".key span");
    assert!(keys.len() > 3, "{}", keys.len());
    for key in keys {
        for class in key.value().classes() {
            let rule = format!(".key .{class} {{ border-");
            assert!(style.contains(&rule), "{class}");
        }
    }
    for rule in style.lines().filter(|line| line.starts_with(".key")) {
        assert!(!rule.contains("background"), "{rule}");
    }
    assert!(style.contains("@page { margin: 15mm; }"));
    let whole = style
        .lines()
        .find(|line| line.contains("{ break-inside: avoid; }"));
    let whole = whole.expect("what is not broken");
    for part in ["svg,", "figcaption,", "caption,"] {
        assert!(whole.contains(part), "{part}");
    }
}

/// On paper letters of figures have 6.5 pt: what a page is as wide as says how large they are.
#[test]
fn figures_are_readable_on_paper() {
    /// Of A4 between margins of 15 mm, CSS pixels; letter paper has more. A point is 4/3 of them.
    const PAPER: f64 = 680.0;
    const GAP: f64 = 12.0;
    let html = traced().read("page/index.html");
    let page = Html::parse_document(&html);
    let style = include_str!("../../../src/report/page.css");
    let print = style
        .split("@media print")
        .nth(1)
        .expect("a style of paper");
    assert!(print.contains(".drawings svg:not(:only-child) { width: calc(50% - 6px); }"));
    let [svg, letters] = ["svg", "text"].map(|what| Selector::parse(what).expect("a selector"));
    for drawings in all(&page, ".drawings") {
        let figures = drawings.select(&svg);
        let figures: Vec<ElementRef> = figures.collect();
        let room = if figures.len() == 1 {
            PAPER
        } else {
            (PAPER - GAP) / 2.0
        };
        for figure in figures {
            let size = figure.value().attr("viewBox").expect("a size");
            let width: f64 = size
                .split(' ')
                .nth(2)
                .and_then(|width| width.parse().ok())
                .expect("a width");
            for text in figure.select(&letters) {
                let size = text
                    .value()
                    .attr("font-size")
                    .and_then(|size| size.parse::<f64>().ok());
                let points = 0.75 * size.expect("a size") * (room / width).min(1.0);
                assert!(points >= 6.5, "{points} pt: {}", text.html());
            }
        }
    }
}
