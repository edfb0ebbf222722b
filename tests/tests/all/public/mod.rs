//! The public face of `runtime`, as its source has it: every function has an example, a type that others can make or match to the end
//! is one of those that do so on purpose, and no type of a dependency but nalgebra is in it.

mod source;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use source::Source;

/// Types whose fields and variants stay as they are until a new major version, by why.
const EXHAUSTIVE: &[&str] = &[
    // Options and limits, which users fill by `..Default::default()` or beside a constructor.
    "control::adaptive::Adaptation",
    "control::friction::Friction",
    "excite::Request",
    "excite::limits::Limits",
    "identify::Identify",
    "identify::output_error::OutputError",
    "identify::output_error::law::JointLaw",
    "identify::output_error::law::Law",
    "identify::output_error::law::Tap",
    "log::columns::Column",
    "log::columns::Columns",
    "signal::prepare::Bands",
    "simulate::integrate::tolerances::Tolerances",
    "simulate::looped::Loop",
    "simulate::noise::Sensors",
    // What implementations of traits make, and what they are asked with.
    "columns::Entry",
    "columns::Nominal",
    "columns::Shape",
    "columns::Unknown",
    "excite::function::Regressor",
    "motion::Kinematics",
    "motion::Motion",
    "simulate::adjustable::ParameterSlopes",
    "simulate::controller::Measured",
    "simulate::plant::Instant",
    "simulate::plant::Jumps",
    "simulate::plant::Slopes",
    // What users hand in.
    "control::counterbalance::Weight",
    "control::reference::Reference",
    "excite::clearance::Ball",
    "excite::clearance::Room",
    "excite::clearance::TorqueLimits",
    "excite::criterion::Rivals",
    "excite::fourier::Fourier",
    "friction_curve::rows::Measured",
    "identify::payload::drive_gains::KnownPayload",
    "identify::stack::JointRows",
    "identify::stack::Segment",
    "identify::stack::Stack",
    "log::Channel",
    "log::mcap::written::JointStates",
    "simulate::motion::Drive",
    "simulate::trajectory::Desired",
    // Numbers: a value with its deviation, a dual number, a body, a state.
    "calibrate::Measured",
    "friction_curve::Value",
    "friction_curve::law::fall::Fall",
    "link::Inertial",
    "link::Link",
    "scalar::dual::Dual",
    "state::State",
    // Two of a kind, and who goes on has to know which: another one would be a new version anyway.
    "identify::estimate::Form",
    "identify::output_error::recording::Hold",
];

/// What nalgebra asks of the entries of its matrices.
const LEAKS: &[(&str, &str)] = &[("scalar::Scalar", "One"), ("scalar::Scalar", "Zero")];

fn runtime() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime")
}

fn source() -> Source {
    Source::read(&runtime().join("src"))
}

#[test]
fn every_public_function_has_an_example() {
    let functions = source().functions();
    assert!(functions.len() > 350, "{} are too few", functions.len());
    let bare = functions.iter().filter(|(_, has)| !has);
    let bare: Vec<&str> = bare.map(|(at, _)| at.as_str()).collect();
    let (count, all) = (bare.len(), functions.len());
    assert!(
        bare.is_empty(),
        "{count} of {all} have none:\n{}",
        bare.join("\n")
    );
}

#[test]
fn types_that_cannot_grow_are_so_on_purpose() {
    let found = source().exhaustive();
    let listed: BTreeSet<String> = EXHAUSTIVE.iter().map(|&name| name.to_owned()).collect();
    let new: Vec<&String> = found.difference(&listed).collect();
    assert!(
        new.is_empty(),
        "neither `#[non_exhaustive]` nor listed: {new:#?}"
    );
    let gone: Vec<&String> = listed.difference(&found).collect();
    assert!(gone.is_empty(), "listed for nothing: {gone:#?}");
}

#[test]
fn nalgebra_is_the_only_dependency_in_signatures() {
    let manifest = fs::read_to_string(runtime().join("Cargo.toml")).expect("a manifest");
    let manifest: toml::Table = manifest.parse().expect("TOML");
    let crates = manifest["dependencies"].as_table().expect("a table").keys();
    let crates = crates.filter(|name| !["nalgebra", "robot-model-derive"].contains(&name.as_str()));
    let crates = crates.map(|name| name.replace('-', "_")).collect();
    let found = source().leaks(&crates);
    let listed = LEAKS
        .iter()
        .map(|(at, name)| ((*at).to_owned(), (*name).to_owned()));
    assert_eq!(found, listed.collect());
}

/// Items behind private modules and re-exports are seen as what they are.
#[test]
fn what_is_missing_is_seen() {
    let source = Source::of(
        "mod inner {
             use faer::Mat;
             /// # Examples
             /// ```
             /// assert!(true);
             /// ```
             pub fn shown() {}
             pub struct Open { pub field: Mat<f64> }
             impl Open { pub fn bare(&self) {} pub(crate) fn own(&self, _: Mat<f64>) {} }
             #[non_exhaustive]
             pub enum Grows { One }
             pub enum Hidden { One }
         }
         pub use inner::{Grows, Open as Renamed, shown};
         pub trait Law { fn torque(&self); }",
    );
    let functions = source.functions().into_iter();
    let bare: Vec<String> = functions
        .filter(|(_, has)| !has)
        .map(|(at, _)| at)
        .collect();
    assert_eq!(bare, ["Law::torque", "inner::Open::bare"]);
    assert_eq!(source.exhaustive(), ["inner::Open".to_owned()].into());
    let leaks = source.leaks(&["faer".to_owned()].into());
    assert_eq!(leaks, [("inner::Open".to_owned(), "Mat".to_owned())].into());
}
