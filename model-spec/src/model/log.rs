//! Where logs have their channels.

/// The columns of logs, and what they are worth in SI units.
///
/// Channels of which the spec says nothing have their standard names, `time`, `q1`, `dq1`, `tau1`, and SI units.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct LogColumns {
    /// The time.
    pub time: Option<LogColumn>,
    /// Positions, one a joint, or none.
    pub q: Vec<LogColumn>,
    /// Velocities, one a joint, or none.
    pub dq: Vec<LogColumn>,
    /// Torques or currents, one a joint, or none.
    pub tau: Vec<LogColumn>,
    /// Inputs of effects, by the name that a log would have for them otherwise: `temperature`, `current2`.
    pub inputs: Vec<(String, LogColumn)>,
    /// Line of the spec's `log`, from 1; none where it has none.
    pub line: Option<usize>,
    /// The topic of bags of ROS 2, where the spec names one.
    pub topic: Option<String>,
}

impl LogColumns {
    /// All columns, each with the name of its channel: `time`, `q`, `dq`, `tau`, or of an input.
    pub fn all(&self) -> impl Iterator<Item = (&str, &LogColumn)> {
        let time = self.time.iter().map(|own| ("time", own));
        let families = [("q", &self.q), ("dq", &self.dq), ("tau", &self.tau)];
        let families = families
            .into_iter()
            .flat_map(|(name, own)| own.iter().map(move |own| (name, own)));
        let inputs = self.inputs.iter().map(|(name, own)| (name.as_str(), own));
        time.chain(families).chain(inputs)
    }
}

/// A column of a log.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LogColumn {
    /// Its name in the header.
    pub name: String,
    /// What a one in it is worth, in SI units; amperes where it is a current.
    pub unit: f64,
    /// Whether that is written; else the unit is 1.
    pub is_unit_written: bool,
}
