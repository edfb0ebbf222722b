//! The rows: what a function of an arm costs in one form.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Everything that was measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// By robot, function and form.
    pub rows: Vec<Row>,
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

    /// Ours over the fastest peer's: whole, and with sines and cosines given.
    #[must_use]
    pub fn ratios(&self) -> [Option<f64>; 2] {
        [
            best(&self.peers).map(|(_, ns)| self.ns / ns),
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
    }
}

#[cfg(test)]
mod tests {
    use super::{Report, example};

    #[test]
    fn the_shape_of_the_json() {
        let report = Report {
            rows: vec![example()],
        };
        let text = serde_json::to_string(&report).expect("plain numbers");
        let wanted = r#"{"rows":[{"robot":"puma560","function":"gravity","form":"baked","mul":36,"add":20,"trig":10,"ns":15.0,"ns_arithmetic":6.0,"peers":{"casadi":90.0,"symforce":60.0},"ns_plain":25.0,"peers_arithmetic":{"casadi":12.0}}]}"#;
        assert_eq!(text, wanted);
        assert_eq!(serde_json::from_str::<Report>(&text).ok(), Some(report));
    }

    #[test]
    fn the_fastest_peer_counts() {
        let row = example();
        assert_eq!(row.best_peer(), Some(("symforce", 60.0)));
        assert_eq!(row.ratios(), [Some(0.25), Some(0.5)]);
    }
}
