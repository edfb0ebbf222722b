//! The tracer beside the baselines, on the experiments that all of them had.

use std::fmt::Write;

use crate::judge::{Mark, Row};
use crate::table::sizes;

/// What a method made of an experiment.
pub struct Given<'a> {
    pub row: &'a Row,
    pub mark: Mark,
    /// How many effects it named, and how many it chose, with those that do not matter.
    pub named: usize,
    pub chosen: usize,
    pub seconds: f64,
}

/// A method and its answers.
pub struct Method<'a> {
    pub name: String,
    answers: Vec<Given<'a>>,
}

/// The tracer, then the baselines; none where no baseline was asked.
pub fn methods(rows: &[Row]) -> Vec<Method<'_>> {
    let compared = || rows.iter().filter(|row| !row.baselines.is_empty());
    let Some(first) = compared().next() else {
        return Vec::new();
    };
    let tracer = Method {
        name: "tracer".to_owned(),
        answers: compared()
            .map(|row| Given {
                row,
                mark: row.mark,
                named: row.said.len(),
                chosen: row.said.len(),
                seconds: row.seconds,
            })
            .collect(),
    };
    let baseline = |name: &str| {
        let of = |row: &'_ Row| row.baselines.iter().position(|one| one.method == name);
        let answers = compared().filter_map(|row| {
            let answer = &row.baselines[of(row)?];
            Some(Given {
                row,
                mark: answer.mark,
                named: answer.said.len(),
                chosen: answer.chosen,
                seconds: answer.seconds,
            })
        });
        Method {
            name: name.to_owned(),
            answers: answers.collect(),
        }
    };
    let names = first.baselines.iter().map(|one| one.method.as_str());
    std::iter::once(tracer).chain(names.map(baseline)).collect()
}

/// Which experiments are counted.
#[derive(Debug, Clone, Copy)]
pub enum Group {
    /// An effect that matters, of this share of the torque.
    Matters(f64),
    /// An effect that matters, of any size.
    AnyMatters,
    /// An effect that does not matter.
    Small,
    /// Arms that lack nothing.
    Nothing,
    /// Laws that no library has.
    Unknown,
}

impl Group {
    fn has(self, row: &Row) -> bool {
        let is_effect = row.kind != "nothing" && row.kind != "unknown";
        match self {
            Self::Matters(size) => row.is_material && row.is_of(size),
            Self::AnyMatters => row.is_material,
            Self::Small => is_effect && !row.is_material,
            Self::Nothing => row.kind == "nothing",
            Self::Unknown => row.kind == "unknown",
        }
    }
}

impl Method<'_> {
    /// Number of a group's experiments.
    pub fn count(&self, group: Group) -> usize {
        self.answers.iter().filter(|one| group.has(one.row)).count()
    }

    /// Percent of a group with one of these marks; `None` for an empty group.
    pub fn percent(&self, group: Group, marks: &[Mark]) -> Option<f64> {
        self.percent_of(group, &|one| marks.contains(&one.mark))
    }

    fn percent_of(&self, group: Group, is_so: &dyn Fn(&Given) -> bool) -> Option<f64> {
        let all = self.answers.iter().filter(|one| group.has(one.row));
        let hits = all.filter(|one| is_so(one)).count();
        let count = self.count(group);
        (count > 0).then(|| 100.0 * hits as f64 / count as f64)
    }

    fn mean(&self, of: &dyn Fn(&Given) -> usize) -> f64 {
        let sum: usize = self.answers.iter().map(of).sum();
        sum as f64 / self.answers.len().max(1) as f64
    }

    fn median_seconds(&self) -> f64 {
        let mut seconds: Vec<f64> = self.answers.iter().map(|one| one.seconds).collect();
        seconds.sort_by(f64::total_cmp);
        seconds.get(seconds.len() / 2).copied().unwrap_or(0.0)
    }
}

/// Measures as rows, methods as columns; nothing where no baseline was asked.
pub fn table(rows: &[Row]) -> String {
    let methods = methods(rows);
    let Some(tracer) = methods.first() else {
        return String::new();
    };
    let names: Vec<&str> = methods.iter().map(|method| method.name.as_str()).collect();
    let mut text = format!(
        "\n| | {} |\n|---|{}\n",
        names.join(" | "),
        "---|".repeat(names.len())
    );
    let mut line = |label: &str, cell: &dyn Fn(&Method) -> String| {
        let cells: Vec<String> = methods.iter().map(cell).collect();
        let _ = writeln!(text, "| {label} | {} |", cells.join(" | "));
    };
    let percent = |percent: Option<f64>| {
        percent.map_or_else(String::new, |percent| format!("{percent:.0} %"))
    };
    for size in sizes(rows) {
        let group = Group::Matters(size);
        if tracer.count(group) == 0 {
            continue;
        }
        let head = format!("{} % of torque ({})", 100.0 * size, tracer.count(group));
        let mut share = |what: &str, is_so: &dyn Fn(&Given) -> bool| {
            let cell = |method: &Method| percent(method.percent_of(group, is_so));
            line(&format!("{head}: {what}"), &cell);
        };
        let is_near = |one: &Given| matches!(one.mark, Mark::Exact | Mark::Near);
        share("exact", &|one| one.mark == Mark::Exact);
        share("exact or near", &is_near);
        share("that and nothing else named", &|one| {
            is_near(one) && one.named == 1
        });
        share("that and nothing else chosen", &|one| {
            is_near(one) && one.chosen == 1
        });
        share("wrong name", &|one| one.mark == Mark::Wrong);
        share("no name", &|one| {
            matches!(one.mark, Mark::Missed | Mark::Abstained)
        });
    }
    let others = [
        (Group::Small, "too little to matter", "wrong name"),
        (Group::Nothing, "nothing missing", "false alarm"),
        (Group::Unknown, "unknown laws", "wrong name"),
    ];
    for (group, head, what) in others {
        if tracer.count(group) == 0 {
            continue;
        }
        let head = format!("{head} ({})", tracer.count(group));
        line(&format!("{head}: {what}"), &|method| {
            percent(method.percent(group, &[Mark::Wrong]))
        });
        line(&format!("{head}: anything chosen"), &|method| {
            percent(method.percent_of(group, &|one| one.chosen > 0))
        });
    }
    line("effects named, mean", &|method| {
        format!("{:.1}", method.mean(&|one| one.named))
    });
    line("effects chosen, mean", &|method| {
        format!("{:.1}", method.mean(&|one| one.chosen))
    });
    line("seconds, median", &|method| {
        format!("{:.1}", method.median_seconds())
    });
    text
}
