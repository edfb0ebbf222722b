//! Logs of several rates, packed ones, such as say nothing, and arms of which a link is known.

use std::fmt::Write;
use std::sync::Arc;

use parquet::basic::{Compression, GzipLevel, ZstdLevel};
use parquet::data_type::DoubleType;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use serde_json::Value;

use crate::verbs::common::{CART, Folder, PENDULUM, cart_log, json, white};

fn value(fit: &Value, name: &str) -> [f64; 2] {
    let mut list = fit["parameters"].as_array().expect("a list").iter();
    let found = list.find(|entry| entry["name"] == name).expect(name);
    ["value", "std"].map(|key| found[key].as_f64().expect("a number"))
}

#[test]
fn what_is_found_beside_a_known_link_is_right() {
    let folder = Folder::new();
    let arm = PENDULUM
        .replace("link lower {", "link lower: fixed {")
        .replace("\n}\n", "\n    effects { viscous_friction on all; }\n}\n");
    folder.write("arm.robot", &arm);
    let values = r#"{"upper.viscous_friction.fv": 1.0, "lower.viscous_friction.fv": 0.5}"#;
    folder.write("values.json", values);
    let mut wanted = String::from("time,q1,q2\n");
    for k in 0..=2000 {
        let t = f64::from(k) / 200.0;
        let upper = -1.57 + 0.6 * (1.3 * t).sin() + 0.2 * (4.1 * t).sin();
        let lower = 0.7 * (2.1 * t + 1.0).sin() + 0.2 * (5.3 * t).cos();
        writeln!(wanted, "{t},{upper},{lower}").expect("a string takes all");
    }
    folder.write("wanted.csv", &wanted);
    let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let more = ["--parameters", "values.json", "--torque-noise", "0.02"];
    folder.succeed(&[&["simulate", "arm.robot"][..], &motion, &more].concat());
    folder.succeed(&["identify", "arm.robot", "log.csv", "--json", "fit.json"]);
    let fit = json(&folder.read("fit.json"));
    assert_eq!(fit["parameters"].as_array().expect("a list").len(), 5);
    // a m + m x and izz - m a^2 of the upper link alone, about its joint.
    for (name, truth) in [
        ("upper.mxr", 0.5),
        ("upper.my", 0.0),
        ("upper.izzr", 0.05 + 2.0 * 0.0625 - 2.0 * 0.25),
        ("upper.viscous_friction.fv", 1.0),
        ("lower.viscous_friction.fv", 0.5),
    ] {
        let [found, std] = value(&fit, name);
        assert!(
            (found - truth).abs() < 4.0 * std && std < 0.01,
            "{name}: {found} +- {std}, not {truth}"
        );
    }
}

/// The cart at such a rate, with a mass of 3 kg and friction of 5 N s/m.
fn cart_at(rate_hz: f64, seconds: f64, phase: f64) -> String {
    let mut text = String::from("time,q1,tau1\n");
    let mut noise = 99;
    let mut k = 0_u32;
    loop {
        let t = f64::from(k) / rate_hz;
        if t > seconds {
            return text;
        }
        let (slow, fast) = ((1.3 * t + phase).sin_cos(), (7.9 * t).sin_cos());
        let q = 0.2 * slow.0 + 0.02 * fast.0;
        let dq = 0.26 * slow.1 + 0.158 * fast.1;
        let ddq = -0.338 * slow.0 - 1.2482 * fast.0;
        let tau = 3.0 * ddq + 5.0 * dq + 0.1 * white(&mut noise);
        writeln!(text, "{t:.6},{q:.9},{tau:.6}").expect("a string takes all");
        k += 1;
    }
}

#[test]
fn logs_of_other_rates_are_fitted_together() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let logs = [("slow.csv", 73.0), ("log.csv", 200.0), ("fast.csv", 1000.0)];
    for (k, (name, rate_hz)) in (0..).zip(logs) {
        folder.write(name, &cart_at(rate_hz, 15.0, f64::from(k)));
    }
    let names = logs.map(|(name, _)| name);
    let fit = |logs: &[&str]| {
        folder.succeed(&[&["identify", "cart.robot", "--json", "fit.json"], logs].concat());
        json(&folder.read("fit.json"))
    };
    let all = fit(&names);
    for (name, truth) in [("cart.m", 3.0), ("rail.viscous_friction.fv", 5.0)] {
        let [found, std] = value(&all, name);
        assert!(
            (found - truth).abs() < 4.0 * std + 1e-3 * truth,
            "{name}: {found} +- {std}"
        );
        // The slowest has the bands of all.
        let [_, alone] = value(&fit(&names[..1]), name);
        assert!(std < alone, "{name}: {std}, {alone} alone");
    }
}

fn parquet(log: &str, compression: Compression) -> Vec<u8> {
    let columns: Vec<Vec<f64>> = (0..3)
        .map(|c| {
            let rows = log.lines().skip(1);
            let field = |row: &str| row.split(',').nth(c).expect("a field").parse();
            rows.map(|row| field(row).expect("a number")).collect()
        })
        .collect();
    let schema = "message log { required double time; required double q1; required double tau1; }";
    let schema = Arc::new(parse_message_type(schema).expect("a schema"));
    let properties = WriterProperties::builder().set_compression(compression);
    let mut bytes = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut bytes, schema, Arc::new(properties.build()))
        .expect("a writer");
    let mut group = writer.next_row_group().expect("a group");
    for values in &columns {
        let mut column = group.next_column().expect("a column").expect("a column");
        let typed = column.typed::<DoubleType>();
        typed.write_batch(values, None, None).expect("values");
        column.close().expect("a column");
    }
    group.close().expect("a group");
    writer.close().expect("a file");
    bytes
}

#[test]
fn packed_parquet_is_read_as_csv_is() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(10, 0.0, 0.0);
    folder.write("log.csv", &log);
    let packed = [
        ("plain.parquet", Compression::UNCOMPRESSED),
        ("zstd.parquet", Compression::ZSTD(ZstdLevel::default())),
        ("gzip.parquet", Compression::GZIP(GzipLevel::default())),
        ("snappy.parquet", Compression::SNAPPY),
    ];
    let fit = |log: &str| {
        folder.succeed(&["identify", "cart.robot", log, "--json", "fit.json"]);
        json(&folder.read("fit.json"))
    };
    let wanted = fit("log.csv");
    for (name, compression) in packed {
        std::fs::write(folder.path(name), parquet(&log, compression)).expect("a file");
        assert_eq!(fit(name)["parameters"], wanted["parameters"], "{name}");
    }
}

#[test]
fn logs_that_say_nothing_are_refused() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let rows = |f: &dyn Fn(f64) -> [f64; 2]| {
        let mut text = String::from("time,q1,tau1\n");
        for k in 0..2000 {
            let t = f64::from(k) / 200.0;
            let [q, tau] = f(t);
            writeln!(text, "{t},{q},{tau}").expect("a string takes all");
        }
        text
    };
    let still = "q1 is the same at all times";
    let dead = "tau1 is 2 at all times";
    for (log, told) in [
        (rows(&|_| [0.5, 2.0]), &[still, dead][..]),
        (rows(&|t| [t.sin(), 2.0]), &[dead]),
        (rows(&|t| [0.5, t.sin()]), &[still]),
    ] {
        folder.write("log.csv", &log);
        let said = folder.refuse(&["identify", "cart.robot", "log.csv", "--json", "fit.json"]);
        for told in told {
            assert!(said.contains(told), "{said}");
        }
        assert!(said.contains("excites none of the 2 unknowns"), "{said}");
    }
}

#[test]
fn the_line_of_a_log_that_is_at_fault_is_shown() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let refused = |text: &str| {
        folder.write("log.csv", text);
        folder.refuse(&["identify", "cart.robot", "log.csv"])
    };
    assert_eq!(
        refused("time,q1,tau1\n0,1,2\n0.01,O.9,3\n"),
        "reading log.csv\nerror: log.csv:3: `O.9` in column `q1` is not a number; repair or remove the row\n  \
         |\n3 | 0.01,O.9,3\n  |      ^^^\n"
    );
    // The way out stands below it.
    let said = refused("time,q1,tua1\n0,1,2\n0.01,1,3\n");
    let [shown, help] = [
        "\n1 | time,q1,tua1\n  |         ^^^^\n",
        "= help: name the columns in a `robot-model.toml`",
    ]
    .map(|part| said.find(part).unwrap_or_else(|| panic!("{said}")));
    assert!(shown < help, "{said}");
    // Rows that are too short are nothing to point into.
    let said = refused("time,q1,tau1\n0,1,2\n0.01,1\n");
    assert!(said.ends_with("\n3 | 0.01,1\n  | ^\n"), "{said}");
}
