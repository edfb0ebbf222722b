//! `audit` of a table that was published; that of a second paper is asked in `examples/tests/all/seed_002.rs`.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::verbs::audit::{audit, findings};

fn spec(name: &str) -> String {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/specs/pass");
    std::fs::read_to_string(format!("{root}/{name}.robot")).expect("in the repository")
}

/// Taati, Tahmasebi, Hashtrudi-Zaad, Table 1, times 1000: our name, then the columns of [`CONFIGURATIONS`].
const TABLE: [(&str, [f64; 5]); 14] = [
    ("Ibase_yyr", [1.42, 3.40, 1.02, 1.20, 3.04]),
    ("Ibe_yyr", [1.35, 4.43, 2.16, 1.61, 3.29]),
    ("Ia_yyr", [-0.40, -1.17, -0.76, -0.51, -0.73]),
    ("m_ar", [0.69, 9.23, 3.00, 0.65, 9.19]),
    ("Ibe_xxr", [2.08, 7.54, 3.47, 2.85, 6.37]),
    ("Ia_xxr", [0.95, 3.55, 1.13, 1.28, 3.15]),
    ("m_ber", [-19.23, 26.92, 46.84, 21.24, -16.59]),
    ("m_cr", [-109.96, 46.52, -69.08, 108.75, -112.45]),
    (
        "th1.viscous_friction.fv",
        [-2.08, -2.71, -0.91, -1.35, -0.10],
    ),
    ("th2.viscous_friction.fv", [-1.28, 0.10, -0.32, -0.14, 0.54]),
    ("th3.viscous_friction.fv", [-0.18, 1.13, 0.43, 0.91, 0.73]),
    (
        "th1.coulomb_friction.fc",
        [25.89, 26.22, 27.06, 26.08, 24.35],
    ),
    ("th2.coulomb_friction.fc", [9.19, 8.35, 9.34, 8.24, 7.28]),
    ("th3.coulomb_friction.fc", [9.08, 9.04, 10.00, 8.09, 8.71]),
];

/// Upright, with gimbal and counterbalance weight, with force sensor, upside down, and upside down with both.
const CONFIGURATIONS: [&str; 5] = ["UR", "GCW", "FS", "USD", "USD+GCW"];

/// A column of [`TABLE`] by our names.
fn column(configuration: usize) -> BTreeMap<String, f64> {
    let rows = TABLE.iter();
    rows.map(|(name, row)| ((*name).to_owned(), row[configuration] / 1000.0))
        .collect()
}

/// Least eigenvalue of the paper's inertia on a grid of a degree: `M11 = p1 + p2 cos 2 th2 + p3 cos 2 th3 + p4 cos th2 sin th3`, and
/// beside it `[[p5, x], [x, p6]]` with `x = -p4 sin(th2 - th3) / 2`, which is least at a right angle.
fn least_inertia(values: &BTreeMap<String, f64>) -> [f64; 2] {
    let p = |k: usize| values[TABLE[k].0];
    let angles = || (0..360).map(|degrees| f64::from(degrees).to_radians());
    let first = angles().flat_map(|th2| angles().map(move |th3| (th2, th3)));
    let first = first.map(|(th2, th3)| {
        p(0) + p(1) * (2.0 * th2).cos() + p(2) * (2.0 * th3).cos() + p(3) * th2.cos() * th3.sin()
    });
    let (mean, half) = (f64::midpoint(p(4), p(5)), (p(4) - p(5)) / 2.0);
    [
        first.fold(f64::INFINITY, f64::min),
        mean - half.hypot(p(3) / 2.0),
    ]
}

/// The least eigenvalue that a check says.
fn told_least(check: &Value) -> f64 {
    let quantities = check["quantities"].as_array().expect("numbers");
    let mut quantities = quantities.iter();
    let least = quantities.find(|one| one["what"] == "least_eigenvalue");
    least.expect("told")["value"].as_f64().expect("a number")
}

/// The inertia is said to be positive definite everywhere, in all five configurations, with a least eigenvalue of 1.8e-3.
#[test]
fn no_column_of_the_table_of_seed_004_is_positive_definite() {
    // Of fifteen viscous coefficients nine are negative.
    let negative = [3, 1, 2, 2, 1];
    for (k, name) in CONFIGURATIONS.into_iter().enumerate() {
        let mut values = column(k);
        let (code, checks, text) = audit(&spec("phantom"), &values);
        assert_eq!(code, Some(1), "{name}: {text}");
        let signs = findings(&checks["signs"]);
        assert_eq!(signs.len(), negative[k], "{name}: {text}");
        assert!(
            signs
                .iter()
                .all(|said| said.contains("viscous_friction.fv"))
        );
        assert!(
            findings(&checks["inertia"])[0].contains("not positive definite"),
            "{name}: {text}"
        );
        let [about_vertical, of_others] = least_inertia(&values);
        let least = told_least(&checks["inertia"]);
        assert!(about_vertical < 0.0 && about_vertical < of_others, "{name}");
        assert!(
            (least / about_vertical - 1.0).abs() < 0.01,
            "{name}: {least}"
        );
        assert_eq!(checks["friction"]["passed"], true, "{name}: {text}");
        // With a base that is heavy enough the other two joints are left, of which those upside down with both weights have none.
        values.insert("Ibase_yyr".to_owned(), 50e-3);
        let (_, checks, text) = audit(&spec("phantom"), &values);
        let is_inertia = name != "USD+GCW";
        assert_eq!(checks["inertia"]["passed"], is_inertia, "{name}: {text}");
        let least = told_least(&checks["inertia"]);
        assert!(
            (least - of_others).abs() < 1e-6,
            "{name}: {least} {of_others}"
        );
    }
    assert!((least_inertia(&column(4))[1] + 0.11e-3).abs() < 0.01e-3);
}

/// Column UR: what is not right of it, and an arm that is.
#[test]
fn what_the_table_of_seed_004_lacks_is_told_one_by_one() {
    let mut values = column(0);
    let (_, checks, text) = audit(&spec("phantom"), &values);
    assert!(
        !checks.contains_key("bodies"),
        "a robot of energies has none: {text}"
    );
    assert_eq!(findings(&checks["signs"]).len(), 3, "{text}");
    let inertia = findings(&checks["inertia"]);
    assert!(inertia[0].contains("least eigenvalue -3.3"), "{text}");
    assert_eq!(
        checks["friction"]["passed"], true,
        "dry friction outweighs it at these speeds"
    );
    // With less of it they drive.
    let mut driven = values.clone();
    driven.insert("th1.coulomb_friction.fc".to_owned(), 1e-3);
    let (_, checks, text) = audit(&spec("phantom"), &driven);
    assert!(findings(&checks["friction"])[0].contains("`th1`"), "{text}");
    // Without the negative coefficients, and with a base that is heavy enough, nothing is left to say.
    for joint in 1..=3 {
        values.insert(format!("th{joint}.viscous_friction.fv"), 1e-3);
    }
    values.insert("Ibase_yyr".to_owned(), 5e-3);
    let (code, _, text) = audit(&spec("phantom"), &values);
    assert_eq!(code, Some(0), "{text}");
}
