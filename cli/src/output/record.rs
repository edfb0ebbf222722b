//! JSON that this program writes, each kind known by names that it has side by side at its top: what somebody wrote by hand and files of other
//! programs have not all of them.

use serde_json::{Map, Value};

/// Kinds of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Record {
    /// Of `merge`, too.
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
    #[cfg(test)]
    pub(super) const ALL: [Self; 12] = [
        Self::Identify,
        Self::Factor,
        Self::Trace,
        Self::Demo,
        Self::Excite,
        Self::Coefficients,
        Self::Simulate,
        Self::Audit,
        Self::Dissect,
        Self::Friction,
        Self::StaticGain,
        Self::BackEmf,
    ];

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

    /// Names at the top of every one, and all of them of no other kind.
    pub(super) const fn names(self) -> &'static [&'static str] {
        match self {
            Self::Identify => &["method", "form", "parameters", "condition", "unexcited"],
            Self::Factor => &["factor", "unknowns", "equations", "blocks"],
            Self::Trace => &["outcome", "effects", "rmse_before", "rmse_after"],
            Self::Demo => &["clean", "worn"],
            Self::Excite => &["condition", "log_det", "max_violation", "starts"],
            Self::Coefficients => &["period", "equation", "joints"],
            Self::Simulate => &["seconds", "tracking_error", "events", "rejected_steps"],
            Self::Audit => &["robot", "passed", "checks"],
            Self::Dissect => &["robot", "measured", "model", "shares"],
            Self::Friction => &["joint", "points", "law", "parameters"],
            Self::StaticGain => &["gain", "gain_interval", "residual_std"],
            Self::BackEmf => &["back_emf", "back_emf_interval"],
        }
    }

    /// Whether a text is one; an object without names holds nothing.
    pub(super) fn is(self, text: &[u8]) -> bool {
        let Ok(names) = serde_json::from_slice::<Map<String, Value>>(text) else {
            return false;
        };
        names.is_empty() || self.names().iter().all(|name| names.contains_key(*name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An object that has these names.
    fn object(names: &[&str]) -> String {
        let names: Vec<String> = names.iter().map(|name| format!("\"{name}\": 1")).collect();
        format!("{{ {} }}", names.join(", "))
    }

    #[test]
    fn a_kind_is_told_from_all_others() {
        for record in Record::ALL {
            for other in Record::ALL {
                let text = object(other.names());
                assert_eq!(record.is(text.as_bytes()), record == other, "{record:?}");
            }
            assert!(record.is(b"{}"));
        }
    }

    #[test]
    fn what_somebody_wrote_is_no_result() {
        let deep = format!("{{\"mine\": {}}}", object(Record::Identify.names()));
        for text in [
            "{\"shoulder.m\": 4}",
            "[1, 2]",
            "{\"payload\": 2.5, \"method\": \"CAD\"}",
            "{\"joint_names\": [], \"points\": []}",
            "{\"method\": \"wls\",",
            &deep,
        ] {
            assert!(
                !Record::ALL.iter().any(|one| one.is(text.as_bytes())),
                "{text}"
            );
        }
    }
}
