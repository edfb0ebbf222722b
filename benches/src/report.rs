//! The rows: what a function of an arm costs in one form.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Everything that was measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// By robot, function and form.
    pub rows: Vec<Row>,
    /// Where and when, and by which tools.
    pub run: Run,
    /// How long code takes to be made.
    pub generation: Vec<Generation>,
    /// What chains of other lengths cost, where it was asked for.
    pub growth: Vec<Growth>,
}

/// Where, when and by which tools a report was made.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The day, UTC, as `2026-01-31`.
    pub date: String,
    /// The processor, in its own words.
    pub processor: String,
    /// How many of its cores this machine has.
    pub cores: usize,
    /// Tools by name, with what they say of their version.
    pub tools: BTreeMap<String, String>,
    /// Passes over all states.
    pub passes: u32,
}

/// How long the code of an arm takes to be made, s.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Generation {
    /// Name of the spec.
    pub robot: String,
    /// From the text of the spec, with its effects, to all functions in Rust.
    pub seconds: f64,
    /// rustc, release, all functions for `f64`.
    pub rustc_seconds: f64,
}

/// What a chain of so many joints costs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Growth {
    /// Joints.
    pub joints: usize,
    /// Multiplications and additions of inverse dynamics with base parameters as an argument.
    pub inverse_dynamics: usize,
    /// Seconds from text to all functions.
    pub seconds: f64,
}

/// A function of an arm in one form.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of the spec.
    pub robot: String,
    /// Its emitted name.
    pub function: String,
    /// Where its parameters are, and how many states a call takes.
    pub form: Form,
    /// Multiplications.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Sines and cosines.
    pub trig: usize,
    /// A state's nanoseconds, built for this machine as the peers are.
    pub ns: f64,
    /// The same with sines and cosines given.
    pub ns_arithmetic: f64,
    /// Nanoseconds of the peers that were found.
    pub peers: BTreeMap<String, f64>,
    /// A state's nanoseconds as a plain `cargo build --release` gives them.
    pub ns_plain: f64,
    /// Nanoseconds of the peers with sines and cosines given, where they can be.
    pub peers_arithmetic: BTreeMap<String, f64>,
    /// Nanoseconds of the emitted C, by the compiler and the flags of the peers; none of lanes, and none without a compiler.
    pub ns_c: Option<f64>,
    /// How far passes of `ns` differ, relative: see `rounds::Timing`.
    pub spread: f64,
}

/// Form of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// Parameters are numbers in the equations.
    Baked,
    /// Base parameters are arguments.
    Runtime,
    /// Parameters are numbers, and a call takes as many states as a vector register holds; times are a state's.
    Lanes,
}

impl Form {
    /// In the order of the table.
    pub const ALL: [Self; 3] = [Self::Baked, Self::Runtime, Self::Lanes];

    /// As in the JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Baked => "baked",
            Self::Runtime => "runtime",
            Self::Lanes => "lanes",
        }
    }
}

impl Row {
    /// The fastest peer.
    #[must_use]
    pub fn best_peer(&self) -> Option<(&str, f64)> {
        best(&self.peers)
    }

    /// Ours over the fastest peer's: whole, built plainly, and with sines and cosines given.
    #[must_use]
    pub fn ratios(&self) -> [Option<f64>; 3] {
        [
            best(&self.peers).map(|(_, ns)| self.ns / ns),
            best(&self.peers).map(|(_, ns)| self.ns_plain / ns),
            best(&self.peers_arithmetic).map(|(_, ns)| self.ns_arithmetic / ns),
        ]
    }
}

fn best(peers: &BTreeMap<String, f64>) -> Option<(&str, f64)> {
    let peers = peers.iter().map(|(name, &ns)| (name.as_str(), ns));
    peers.min_by(|x, y| x.1.total_cmp(&y.1))
}

#[cfg(test)]
pub(crate) fn example() -> Row {
    Row {
        robot: "puma560".to_owned(),
        function: "gravity".to_owned(),
        form: Form::Baked,
        mul: 36,
        add: 20,
        trig: 10,
        ns: 15.0,
        ns_arithmetic: 6.0,
        peers: BTreeMap::from([("casadi".to_owned(), 90.0), ("symforce".to_owned(), 60.0)]),
        ns_plain: 25.0,
        peers_arithmetic: BTreeMap::from([("casadi".to_owned(), 12.0)]),
        ns_c: Some(18.0),
        spread: 0.03,
    }
}

#[cfg(test)]
pub(crate) fn example_report() -> Report {
    Report {
        rows: vec![example()],
        run: Run {
            date: "2026-01-31".to_owned(),
            processor: "abacus".to_owned(),
            cores: 2,
            tools: BTreeMap::from([("casadi".to_owned(), "3.8".to_owned())]),
            passes: 5,
        },
        generation: vec![Generation {
            robot: "puma560".to_owned(),
            seconds: 1.25,
            rustc_seconds: 6.0,
        }],
        growth: vec![Growth {
            joints: 5,
            inverse_dynamics: 400,
            seconds: 0.5,
        }],
    }
}

#[cfg(test)]
mod tests {
    use super::{Report, example, example_report};

    #[test]
    fn the_shape_of_the_json() {
        let report = example_report();
        let text = serde_json::to_string(&report).expect("plain numbers");
        let wanted = r#"{"rows":[{"robot":"puma560","function":"gravity","form":"baked","mul":36,"add":20,"trig":10,"ns":15.0,"ns_arithmetic":6.0,"peers":{"casadi":90.0,"symforce":60.0},"ns_plain":25.0,"peers_arithmetic":{"casadi":12.0},"ns_c":18.0,"spread":0.03}],"run":{"date":"2026-01-31","processor":"abacus","cores":2,"tools":{"casadi":"3.8"},"passes":5},"generation":[{"robot":"puma560","seconds":1.25,"rustc_seconds":6.0}],"growth":[{"joints":5,"inverse_dynamics":400,"seconds":0.5}]}"#;
        assert_eq!(text, wanted);
        assert_eq!(serde_json::from_str::<Report>(&text).ok(), Some(report));
    }

    #[test]
    fn the_fastest_peer_counts() {
        let row = example();
        assert_eq!(row.best_peer(), Some(("symforce", 60.0)));
        assert_eq!(row.ratios(), [Some(0.25), Some(25.0 / 60.0), Some(0.5)]);
    }
}
