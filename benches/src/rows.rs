//! From the times of cases to the rows of a report.

use std::collections::BTreeMap;

use crate::Error;
use crate::arm::{Arm, FUNCTIONS};
use crate::ours::case;
use crate::peers::{self, Contender};
use crate::report::{Form, Row};
use crate::rounds::{Case, Timing};

/// The first programs are ours: plain, native. The contenders follow.
pub(crate) const OURS_ARE: usize = 2;
const PLAIN: usize = 0;
const NATIVE: usize = 1;

/// Times of an arm's programs.
struct Times<'a> {
    contenders: &'a [Contender],
    times: &'a BTreeMap<Case, Timing>,
}

impl Times<'_> {
    fn of(&self, program: usize, name: String) -> Option<Timing> {
        self.times.get(&Case { program, name }).copied()
    }

    /// Of a function of ours in a form: the faster width of lanes counts.
    fn ours(&self, program: usize, function: &str, form: Form, given: bool) -> Option<Timing> {
        let names: &[&str] = match form {
            Form::Lanes => &["lanes4", "lanes8"],
            Form::Runtime if self.of(program, case(function, "runtime", given)).is_some() => {
                &["runtime"]
            }
            // One that has no parameters is one function in both forms, and timed once.
            Form::Runtime | Form::Baked => &["baked"],
        };
        let times = names
            .iter()
            .filter_map(|name| self.of(program, case(function, name, given)));
        fastest(times)
    }

    /// Of a program that is compiled from C or C++: the fastest way counts.
    fn contender(&self, k: usize, function: &str, given: bool) -> Option<f64> {
        let ways = 0..peers::WAYS;
        let times = ways.filter_map(|way| self.of(k + OURS_ARE, peers::case(function, way, given)));
        fastest(times).map(|timing| rounded(timing.ns))
    }

    fn peers(&self, function: &str, given: bool) -> BTreeMap<String, f64> {
        let peers = self.contenders.iter().enumerate();
        peers
            .filter(|(_, contender)| contender.ours.is_none())
            .filter_map(|(k, it)| Some((it.name.clone(), self.contender(k, function, given)?)))
            .collect()
    }

    fn ours_in_c(&self, function: &str, form: Form) -> Option<f64> {
        let of = |form: Form| {
            let k = self
                .contenders
                .iter()
                .position(|it| it.ours == Some(form))?;
            self.contender(k, function, false)
        };
        match form {
            Form::Runtime => of(form).or_else(|| of(Form::Baked)),
            form => of(form),
        }
    }
}

fn fastest(times: impl Iterator<Item = Timing>) -> Option<Timing> {
    times.min_by(|x, y| x.ns.total_cmp(&y.ns))
}

/// Rows of an arm.
///
/// # Errors
/// A page without one of the functions.
pub(crate) fn rows_of(
    arm: &Arm,
    contenders: &[Contender],
    times: &BTreeMap<Case, Timing>,
) -> Result<Vec<Row>, Error> {
    let times = Times { contenders, times };
    let mut rows = Vec::new();
    for function in FUNCTIONS {
        for form in Form::ALL {
            let native = times.ours(NATIVE, function, form, false);
            let ns = |timing: Option<Timing>| rounded(timing.map_or(f64::INFINITY, |it| it.ns));
            let compiled = if form == Form::Runtime {
                &arm.runtime
            } else {
                &arm.baked
            };
            let cost = Arm::cost(compiled, function)?;
            rows.push(Row {
                robot: arm.name.to_owned(),
                function: function.to_owned(),
                form,
                mul: cost.mul,
                add: cost.add,
                trig: cost.trig,
                ns: ns(native),
                ns_arithmetic: ns(times.ours(NATIVE, function, form, true)),
                peers: times.peers(function, false),
                ns_plain: ns(times.ours(PLAIN, function, form, false)),
                peers_arithmetic: times.peers(function, true),
                ns_c: times.ours_in_c(function, form),
                spread: (native.map_or(0.0, |it| it.spread) * 1e4).round() / 1e4,
            });
        }
    }
    Ok(rows)
}

/// A clock tells no more than this.
fn rounded(ns: f64) -> f64 {
    (ns * 100.0).round() / 100.0
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::path::PathBuf;

    use super::{Case, Contender, Form, OURS_ARE, Times, Timing};

    #[test]
    fn the_fastest_way_counts_and_what_is_one_function_is_taken_for_both_forms() {
        let contender = |name: &str, ours: Option<Form>| Contender {
            name: name.to_owned(),
            ours,
            executable: PathBuf::new(),
        };
        let contenders = [
            contender("c baked", Some(Form::Baked)),
            contender("casadi", None),
        ];
        let measured = [
            (1, "regressor/baked", 9.0),
            (1, "gravity/baked", 2.0),
            (1, "gravity/runtime", 3.0),
            (1, "gravity/lanes4", 1.5),
            (1, "gravity/lanes8", 1.0),
            (OURS_ARE, "regressor", 8.0),
            (OURS_ARE + 1, "regressor", 7.0),
            (OURS_ARE + 1, "regressor~2", 6.0),
        ];
        let times: BTreeMap<Case, Timing> = measured
            .map(|(program, name, ns)| {
                let name = name.to_owned();
                (Case { program, name }, Timing { ns, spread: 0.0 })
            })
            .into();
        let times = Times {
            contenders: &contenders,
            times: &times,
        };
        let ours = |function: &str, form: Form| Some(times.ours(1, function, form, false)?.ns);
        assert_eq!(ours("gravity", Form::Runtime), Some(3.0));
        assert_eq!(ours("gravity", Form::Lanes), Some(1.0));
        assert_eq!(ours("regressor", Form::Runtime), Some(9.0));
        assert_eq!(times.ours_in_c("regressor", Form::Runtime), Some(8.0));
        assert_eq!(times.ours_in_c("regressor", Form::Lanes), None);
        let peers = BTreeMap::from([("casadi".to_owned(), 6.0)]);
        assert_eq!(times.peers("regressor", false), peers);
    }
}
