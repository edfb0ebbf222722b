//! Lines of a `robot-model.toml` that name the columns of a header as they are.

use super::meant::{FAMILIES, Meant};
use super::{units, words};

/// Lines below `[log]` for columns whose names are nearly standard ones, each with the channel that it seems to be and with the units in
/// brackets behind the names; none where a family has not a column for each joint.
pub(super) fn lines(meant: &[(String, Meant)], dof: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut times = meant.iter().filter(|(_, own)| *own == Meant::Time);
    if let (Some((name, _)), None) = (times.next(), times.next())
        && name != "time"
    {
        let column = quoted(name);
        lines.push(match units::behind(name, "time") {
            Some(unit) => format!("time = {{ column = {column}, unit = \"{unit}\" }}"),
            None => format!("time = {column}"),
        });
    }
    for family in FAMILIES {
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
            let names: Vec<&str> = own.iter().map(|(_, name)| name.as_str()).collect();
            lines.push(line(family, &names));
        }
    }
    lines
}

/// Of one family, with units where all its columns have one.
fn line(family: &str, names: &[&str]) -> String {
    let list = |words: Vec<String>| format!("[{}]", words.join(", "));
    let columns = list(names.iter().map(|name| quoted(name)).collect());
    let units = names.iter().map(|name| units::behind(name, family));
    let Some(units) = units.collect::<Option<Vec<_>>>() else {
        return format!("{family} = {columns}");
    };
    let is_one = units.windows(2).all(|pair| pair[0] == pair[1]);
    let unit = match units.first() {
        Some(unit) if is_one => quoted(unit),
        _ => list(units.iter().map(|unit| quoted(unit)).collect()),
    };
    format!("{family} = {{ columns = {columns}, unit = {unit} }}")
}

fn quoted(name: &str) -> String {
    format!("\"{}\"", words::field(name))
}
