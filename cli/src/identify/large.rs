//! Logs that are fitted as a whole and need not be.

use robot_model::log::Log;

/// Torques of all joints from where on it is told: their rows take half a gigabyte or more.
const MANY: usize = 1_000_000;

/// What is said of long logs before they are fitted, where `--factor` would take them.
pub(super) fn hint(logs: &[Log], joints: usize) -> Option<String> {
    said(logs.iter().map(|log| log.time.len()).sum(), joints)
}

fn said(samples: usize, joints: usize) -> Option<String> {
    (samples * joints > MANY).then(|| {
        format!(
            "all {samples} samples are fitted at once, and memory grows with them; `--factor FILE.json` reads them piece by piece, with the \
             same result for `ls` and `wls`"
        )
    })
}

#[cfg(test)]
mod tests {
    #[test]
    fn an_hour_of_six_joints_at_1_khz_is_told_and_a_minute_is_not() {
        let told = super::said(3_600_000, 6).expect("long");
        assert!(
            told.starts_with("all 3600000 samples are fitted at once"),
            "{told}"
        );
        assert_eq!(super::said(60_000, 6), None);
    }
}
