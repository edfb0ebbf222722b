//! Where and when a report is made, and by which tools: what a reader must know of its times.

use std::collections::BTreeMap;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use crate::peers;
use crate::report::Run;

/// This machine, today, with the versions of the compilers and of the peers that are installed.
#[must_use]
pub fn run(passes: u32) -> Run {
    let (cc, cxx) = (peers::cc(), peers::cxx());
    let mut tools = BTreeMap::new();
    for (name, program) in [("rustc", "rustc"), ("cc", &cc), ("c++", &cxx)] {
        if let Some(version) = first_line(program, &["--version"]) {
            tools.insert(name.to_owned(), version);
        }
    }
    for peer in peers::NAMES {
        if let Ok(version) = peers::version(peer) {
            tools.insert(peer.to_owned(), version);
        }
    }
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    Run {
        date: date(since.map_or(0, |time| time.as_secs() / 86_400)),
        processor: processor(),
        cores: std::thread::available_parallelism().map_or(1, usize::from),
        tools,
        passes,
    }
}

fn first_line(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().next()?.trim().to_owned();
    (output.status.success() && !line.is_empty()).then_some(line)
}

/// As Linux or macOS tell it.
fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    model_name(&info)
        .or_else(|| first_line("sysctl", &["-n", "machdep.cpu.brand_string"]))
        .unwrap_or_else(|| std::env::consts::ARCH.to_owned())
}

/// Of `/proc/cpuinfo`; families and models of one name are other machines.
fn model_name(info: &str) -> Option<String> {
    let value = |wanted: &str| {
        info.lines().find_map(|line| {
            let (key, value) = line.split_once(':')?;
            (key.trim() == wanted).then(|| value.trim())
        })
    };
    let name = value("model name")?;
    Some(match (value("cpu family"), value("model")) {
        (Some(family), Some(model)) => format!("{name}, family {family}, model {model}"),
        _ => name.to_owned(),
    })
}

/// The day so many days after 1970-01-01, in the Gregorian calendar.
fn date(days: u64) -> String {
    // Years from March on, so that the leap day is the last; four hundred of them are 146 097 days.
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, later) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    format!("{:04}-{month:02}-{day:02}", 400 * era + year + later)
}

#[cfg(test)]
mod tests {
    use super::{date, model_name};

    #[test]
    fn days_have_dates() {
        for (days, wanted) in [
            (0, "1970-01-01"),
            (59, "1970-03-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_483, "2026-01-30"),
            (20_819, "2027-01-01"),
        ] {
            assert_eq!(date(days), wanted);
        }
    }

    #[test]
    fn a_processor_has_a_name() {
        let info = "processor\t: 0\ncpu family\t: 25\nmodel\t\t: 17\nmodel name\t: Abacus 3\n";
        assert_eq!(
            model_name(info).as_deref(),
            Some("Abacus 3, family 25, model 17")
        );
        assert_eq!(model_name("BogoMIPS: 100"), None);
    }
}
