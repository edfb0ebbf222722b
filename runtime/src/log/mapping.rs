//! Lines of a `robot-model.toml` that name the columns of a header as they are.

use super::header::Meant;
use super::words;

/// Lines below `[log]` for columns whose names are nearly standard ones, each with the channel that it seems to be; none where a family
/// has not a column for each joint.
pub(super) fn lines(meant: &[(String, Meant)], dof: usize) -> Vec<String> {
    let quoted = |name: &str| format!("\"{}\"", words::field(name));
    let mut lines = Vec::new();
    let mut times = meant.iter().filter(|(_, own)| *own == Meant::Time);
    if let (Some((name, _)), None) = (times.next(), times.next())
        && name != "time"
    {
        lines.push(format!("time = {}", quoted(name)));
    }
    for family in super::header::FAMILIES {
        let number = |own: &Meant| match own {
            Meant::Joint(of, number) if *of == family => Some(*number),
            _ => None,
        };
        let own = || {
            meant
                .iter()
                .filter_map(|(name, own)| Some((number(own)?, name)))
        };
        let first = own().map(|(number, _)| number).min().unwrap_or_default();
        let mut own: Vec<(usize, &String)> = own().collect();
        own.sort();
        let is_whole = own.iter().map(|(number, _)| *number).eq(first..first + dof);
        let is_other = own
            .iter()
            .any(|(number, name)| **name != format!("{family}{number}"));
        if first < 2 && is_whole && (is_other || first == 0) {
            let names: Vec<String> = own.iter().map(|(_, name)| quoted(name)).collect();
            lines.push(format!("{family} = [{}]", names.join(", ")));
        }
    }
    lines
}
