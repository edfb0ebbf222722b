//! JSON that this program writes, each kind known by a name that it has: values by hand and settings of other programs have none of these.

/// Kinds of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Record {
    Identify,
    Factor,
    Trace,
    Demo,
    Excite,
    Coefficients,
    Simulate,
    Audit,
    Dissect,
    Friction,
    StaticGain,
    BackEmf,
}

impl Record {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Identify => "result of `identify`",
            Self::Factor => "factor of `identify`",
            Self::Trace => "result of `trace`",
            Self::Demo => "result of `demo`",
            Self::Excite => "result of `excite`",
            Self::Coefficients => "motion of `excite` as JSON",
            Self::Simulate => "result of `simulate`",
            Self::Audit => "result of `audit`",
            Self::Dissect => "result of `dissect`",
            Self::Friction => "result of `friction`",
            Self::StaticGain => "result of `calibrate static`",
            Self::BackEmf => "result of `calibrate back-emf`",
        }
    }

    /// A name that stands near its beginning.
    const fn key(self) -> &'static str {
        match self {
            Self::Identify => "method",
            Self::Factor => "factor",
            Self::Trace | Self::Demo => "outcome",
            Self::Excite => "condition",
            Self::Coefficients => "equation",
            Self::Simulate => "tracking_error",
            Self::Audit => "passed",
            Self::Dissect => "measured",
            Self::Friction => "points",
            Self::StaticGain => "gain_interval",
            Self::BackEmf => "back_emf_interval",
        }
    }

    /// Whether a text begins such a one; an object without names holds nothing.
    pub(super) fn begins(self, text: &str) -> bool {
        if !text.starts_with(['{', '[']) {
            return false;
        }
        let dense: String = text.split_whitespace().collect();
        dense == "{}" || dense.contains(&format!("\"{}\":", self.key()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_somebody_wrote_is_no_result() {
        for text in ["{\"shoulder.m\": 4}", "[1, 2]", "{\"name\": \"method\"}"] {
            assert!(!Record::Identify.begins(text), "{text}");
        }
        for text in ["{\n  \"method\": \"wls\",\n", "{}", "{ \"method\" : 1"] {
            assert!(Record::Identify.begins(text), "{text}");
        }
        assert!(!Record::Trace.begins("{\"method\": \"wls\"}"));
    }
}
