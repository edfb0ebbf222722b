//! What the workspace is built from: one oldest compiler, and dependencies that anybody may use. `deny.toml` says what is allowed, for
//! `cargo deny` and for this test, which needs no tool and no network; it sees what the host's own target needs.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use spdx::{Expression, ParseMode};

const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn toml(path: &Path) -> toml::Table {
    let text = fs::read_to_string(path).expect("a file of the repository");
    text.parse().expect("TOML")
}

fn output(command: &mut Command) -> String {
    let output = command.output().expect("the toolchain that runs this");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {said}");
    String::from_utf8(output.stdout).expect("text")
}

/// What `cargo metadata` tells of every package that is built here.
fn packages() -> Vec<Value> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let about = output(Command::new(rustc).arg("-vV"));
    let host = about.lines().find_map(|line| line.strip_prefix("host: "));
    let arguments = ["metadata", "--locked", "--offline", "--format-version", "1"];
    let metadata = output(
        Command::new(env!("CARGO"))
            .args(arguments)
            .args(["--filter-platform", host.expect("a host")])
            .current_dir(root()),
    );
    let metadata: Value = serde_json::from_str(&metadata).expect("JSON");
    metadata["packages"].as_array().expect("a list").clone()
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or("")
}

/// Names in a list of `deny.toml`.
fn names(list: &toml::Value) -> BTreeSet<&str> {
    let list = list.as_array().expect("a list");
    list.iter()
        .map(|name| name.as_str().expect("a name"))
        .collect()
}

#[test]
fn every_license_is_allowed() {
    let deny = toml(&root().join("deny.toml"));
    let licenses = &deny["licenses"];
    let allowed = names(&licenses["allow"]);
    let exceptions = licenses["exceptions"].as_array().expect("a list");
    let mut used = BTreeSet::new();
    let packages = packages();
    for package in &packages {
        let (name, license) = (text(package, "name"), text(package, "license"));
        let expression = Expression::parse_mode(license, ParseMode::LAX);
        let expression = expression.unwrap_or_else(|error| panic!("{name}: {error}"));
        let exception = exceptions
            .iter()
            .find(|own| own["crate"].as_str() == Some(name));
        let own = exception
            .map(|own| names(&own["allow"]))
            .unwrap_or_default();
        let is_allowed = expression.evaluate(|asked| {
            let id = asked.license.id().map(|id| id.name);
            let id = id.filter(|_| asked.addition.is_none());
            let of_all = id.filter(|id| allowed.contains(id));
            let of_one = id.filter(|id| own.contains(id));
            used.extend(of_all.or(of_one));
            of_all.or(of_one).is_some()
        });
        assert!(
            is_allowed,
            "{name} is under `{license}`, which deny.toml does not allow"
        );
    }
    assert!(packages.len() > 100, "{}", packages.len());
    // What nothing asks for is no rule.
    let idle: Vec<&&str> = allowed.iter().filter(|id| !used.contains(**id)).collect();
    assert!(idle.is_empty(), "nothing is under {idle:?}");
}

#[test]
fn every_dependency_is_of_the_registry_or_of_the_workspace() {
    for package in packages() {
        let name = text(&package, "name");
        let source = &package["source"];
        assert!(
            source.is_null() || source == REGISTRY,
            "{name} is from {source}"
        );
        for dependency in package["dependencies"].as_array().expect("a list") {
            let is_any = text(dependency, "req") == "*" && dependency["path"].is_null();
            let of_ours = source.is_null() && is_any;
            assert!(
                !of_ours,
                "{name} takes any version of {}",
                text(dependency, "name")
            );
        }
    }
}

#[test]
fn all_crates_have_the_one_oldest_compiler() {
    let workspace = toml(&root().join("Cargo.toml"));
    let oldest = workspace["workspace"]["package"]["rust-version"].as_str();
    let oldest = oldest.expect("a version");
    let members = workspace["workspace"]["members"]
        .as_array()
        .expect("a list");
    for member in members {
        let member = member.as_str().expect("a path");
        let own = toml(&root().join(member).join("Cargo.toml"));
        let inherited = own["package"]
            .get("rust-version")
            .and_then(|own| own.get("workspace"));
        let is_inherited = inherited.and_then(toml::Value::as_bool);
        assert_eq!(
            is_inherited,
            Some(true),
            "{member} has no `rust-version.workspace = true`"
        );
    }
    let mut of_ours = 0;
    for package in packages() {
        let (name, own) = (text(&package, "name"), text(&package, "rust_version"));
        if package["source"].is_null() {
            assert_eq!(own, oldest, "{name}");
            of_ours += 1;
        } else {
            let number = |version: &str| {
                let parts = version
                    .split('.')
                    .map(|part| part.parse::<u32>().expect("a number"));
                parts.chain([0, 0]).take(3).collect::<Vec<_>>()
            };
            let is_older = own.is_empty() || number(own) <= number(oldest);
            assert!(
                is_older,
                "{name} needs Rust {own}, and Cargo.toml says {oldest}"
            );
        }
    }
    assert_eq!(of_ours, members.len());
    for page in ["README.md", "CONTRIBUTING.md"] {
        let page = fs::read_to_string(root().join(page)).expect("a page");
        assert!(page.contains(&format!("Rust {oldest}")), "{oldest}");
    }
}
