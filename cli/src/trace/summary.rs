//! What a trace found, for people.

use std::fmt::Write;

use robot_model::columns::Arm;
use robot_model::trace::{Finding, FloorFrom, MOST_EFFECTS, Outcome};

use super::apart::{apart, undistinguished};
use super::doubt::{doubts, on_joints};
use super::report::effect;
use super::said::{errors_of, in_part, of_kind, outcome, parameter};
use super::tried::tried;
use super::whereabouts::structure_left;
use crate::close_the_loop::Loop;
use crate::diff::diff;
use crate::output::{self, significant};

/// The result for people, of the spec at a path: outcome, effects, the spec's change, errors before and after.
pub(crate) fn summary(spec: &str, closed: &Loop, text: &str) -> String {
    let verdict = &closed.verdict;
    let mut out = match closed.outcome() {
        Outcome::NothingMissing => format!("nothing missing: {}\n", outcome(closed)),
        Outcome::Explained => format!("explained{}:{}\n", in_part(closed), one_of(closed)),
        _ => format!("unexplained: {}\n", outcome(closed)),
    };
    for fault in &closed.faults {
        writeln!(out, "  {}: {}", fault.kind, fault.told).expect("a string takes all");
    }
    let mut show = |finding: &Finding, place: usize| {
        let effect = effect(finding, closed, place);
        let parameters: Vec<String> = effect
            .parameters
            .iter()
            .map(|own| {
                let told = (own.name, own.value, own.sure);
                parameter(closed, finding, told, |decimals| {
                    let std = own.std.unwrap_or_default();
                    format!(" +- {std:.decimals$}")
                })
            })
            .collect();
        writeln!(
            out,
            "  {}{}: {} (score {:.0}, better in {} of {} folds)",
            on_joints(closed, &finding.effect, &finding.joints),
            of_kind(finding),
            parameters.join(", "),
            finding.evidence.score,
            finding.evidence.folds.0,
            finding.evidence.folds.1,
        )
        .expect("a string takes all");
    };
    let found = verdict.findings.iter().chain(&verdict.leads);
    found
        .enumerate()
        .for_each(|(place, finding)| show(finding, place));
    if verdict.outcome == Outcome::Explained {
        out.push_str(&apart(spec, text, closed));
    }

    if verdict.leads.len() >= MOST_EFFECTS {
        writeln!(
            out,
            "  the search stops at {MOST_EFFECTS} effects: declare the friction common to all joints, and trace again"
        )
        .expect("a string takes all");
    }
    if verdict.findings.len() >= MOST_EFFECTS && !verdict.left.is_empty() {
        writeln!(
            out,
            "  the search stops at {MOST_EFFECTS} effects: write the amended spec (`--amend`), and trace it for more"
        )
        .expect("a string takes all");
    }
    for said in structure_left(closed) {
        for (k, said) in said.iter().enumerate() {
            let indent = if k == 0 { 2 } else { 4 };
            writeln!(out, "{:indent$}{said}", "").expect("a string takes all");
        }
    }
    for told in doubts(closed) {
        writeln!(out, "  {told}").expect("a string takes all");
    }
    out.push_str(&tried(closed));
    let change = diff(text, &closed.amended);
    if !change.is_empty() {
        write!(out, "\n{change}").expect("a string takes all");
    }
    out.push('\n');
    out.push_str(&table(closed));
    out
}

/// Of how many effects the logs do not say which it is; nothing where they do.
fn one_of(closed: &Loop) -> String {
    match undistinguished(&closed.verdict.alternatives) {
        0 => String::new(),
        others => format!(
            " these logs do not distinguish what is named from {others} other{}, listed after \"or\"; the simplest is named",
            if others == 1 { "" } else { "s" }
        ),
    }
}

/// Errors per joint before and after the amendment: on the logs that were fitted, and on the validation log where there is
/// one.
fn table(closed: &Loop) -> String {
    let (before, after) = (&closed.before, closed.after());
    let mut columns = vec![Column {
        title: "relative, identification",
        unit: " %",
        before: &before.estimate.relative_percent,
        after: &after.estimate.relative_percent,
    }];
    if let (Some(old), Some(new)) = (&before.validation, &after.validation) {
        columns.push(Column {
            title: "RMSE, validation",
            unit: "",
            before: &old.rmse,
            after: &new.rmse,
        });
        columns.push(Column {
            title: "relative, validation",
            unit: " %",
            before: &old.relative_percent,
            after: &new.relative_percent,
        });
    }
    let mut out = format!("{}\n", output::ERRORS);
    for said in errors_of(closed) {
        writeln!(out, "{said}").expect("a string takes all");
    }
    if columns.len() == 1 {
        out.push_str("(give a validation log with --validate)\n");
    }
    let joints = before.arm.joints();
    let names = joints.iter().map(String::len);
    let width = names.max().unwrap_or(0).max("joint".len());
    let mut line = |first: &str, cells: Vec<String>| {
        write!(out, "{first:width$}").expect("a string takes all");
        for cell in cells {
            write!(out, "   {cell:>24}").expect("a string takes all");
        }
        out.push('\n');
    };
    let each = |cell: &dyn Fn(&Column) -> String| columns.iter().map(cell).collect();
    line("joint", each(&|column| column.title.to_owned()));
    line("", each(&|_| format!("{:>11}  {:>11}", "before", "after")));
    for (joint, name) in joints.iter().enumerate() {
        line(name, each(&|column| column.row(joint)));
    }
    out.push_str(&floor(closed));
    out
}

/// The least errors that any model can have on the logs that were fitted.
fn floor(closed: &Loop) -> String {
    let floors = closed.verdict.noise_floor.iter();
    let floors = floors.map(|floor| {
        let (rms, std) = (significant(floor.rms, 3), significant(floor.std, 1));
        format!("{rms} +- {std}")
    });
    let from = closed.verdict.noise_floor.first().map(|floor| floor.from);
    let how = match from {
        Some(FloorFrom::Periods) => "variation between periods of the motion",
        _ => "upper bound: residual of curves over the motion, on data they were not fitted to",
    };
    let floors: Vec<String> = floors.collect();
    format!(
        "noise floor of the fitted logs, RMSE per joint ({how}): {}\n",
        floors.join(", ")
    )
}

/// One kind of error, before and after.
struct Column<'a> {
    title: &'static str,
    unit: &'static str,
    before: &'a [f64],
    after: &'a [f64],
}

impl Column<'_> {
    fn row(&self, joint: usize) -> String {
        let digits = if self.unit.is_empty() { 4 } else { 2 };
        let cell = |value: f64| format!("{value:.digits$}{}", self.unit);
        let (before, after) = (cell(self.before[joint]), cell(self.after[joint]));
        format!("{before:>11}  {after:>11}")
    }
}

#[cfg(test)]
mod tests {
    use robot_model::trace::{Alternative, MOST_EFFECTS, Outcome};

    use super::summary;
    use crate::close_the_loop::{close, compiled};
    use crate::progress::Progress;
    use crate::trace::cart::{CART, log};

    #[test]
    fn leads_are_told_from_findings() {
        let mut closed = close("cart.robot", CART, &[log()], None, &Progress::new())
            .unwrap_or_else(|error| panic!("{error}"));
        let finding = closed
            .verdict
            .findings
            .first()
            .expect("dry friction")
            .clone();
        assert!(
            summary("cart.robot", &closed, CART)
                .starts_with("explained:\n  coulomb-friction on rail")
        );

        // Another law that would do as well asks for another experiment.
        let undeclared = compiled("cart.robot", CART).expect("a spec").undeclared();
        let candidates = undeclared.candidates().into_iter();
        let mut rivals = candidates.filter(|candidate| candidate.kind() == "stribeck");
        let rival = rivals.next().expect("a candidate");
        closed.verdict.alternatives = vec![Alternative::of(rival, 0, 0.4)];
        let told = summary("my arms/cart.robot", &closed, CART);
        assert!(
            told.contains("or stribeck on rail instead of coulomb-friction: +0.4 % raw error"),
            "{told}"
        );
        let command = "robot-model excite 'my arms/cart.robot' --separate 'coulomb_friction on rail: fc = 1.9";
        let command = told
            .find(command)
            .or_else(|| told.find(&command.replace("1.9", "2.0")));
        assert!(
            command.is_some() && told.contains("--from 'stribeck(vs = "),
            "{told}"
        );
        // No motion tells a channel or time, nor a rotor from the mass that it moves with; it tells a memory.
        for (kind, is_told) in [
            ("dahl", true),
            ("motor_inertia", false),
            ("temperature_viscous", false),
            ("parameter_drift", false),
        ] {
            kind.clone_into(&mut closed.verdict.alternatives[0].effect);
            let told = summary("cart.robot", &closed, CART).contains("robot-model excite");
            assert_eq!(told, is_told, "{kind}");
        }

        // What is left beside them is told in the headline, and where all rounds were used, how to go on.
        closed.verdict.alternatives.clear();
        let mut other = log();
        for (torque, time) in other.tau[0].iter_mut().zip(&other.time) {
            *torque += 4.0 * (2.36 * time + 0.3 * (0.7 * time).sin()).sin();
        }
        let other = close("cart.robot", CART, &[other], None, &Progress::new());
        let left = other.unwrap_or_else(|error| panic!("{error}")).verdict.left;
        assert!(!left.is_empty());
        closed.verdict.left = left;
        let told = summary("cart.robot", &closed, CART);
        assert!(told.starts_with("explained in part:\n"), "{told}");
        assert!(!told.contains("the search stops"), "{told}");
        closed.verdict.findings = vec![finding.clone(); MOST_EFFECTS];
        let told = summary("cart.robot", &closed, CART);
        assert!(
            told.contains("the search stops at 6 effects: write the amended spec"),
            "{told}"
        );

        closed.verdict.outcome = Outcome::Unexplained;
        closed.verdict.left.clear();
        closed.verdict.findings.clear();
        closed.verdict.leads = vec![finding.clone()];
        CART.clone_into(&mut closed.amended);
        closed.changed = None;
        let told = summary("cart.robot", &closed, CART);
        assert!(
            told.contains("pass the gates but do not explain its structure, so none is named\n  coulomb-friction on rail"),
            "{told}"
        );
        assert!(!told.contains("the search stops"), "{told}");

        closed.verdict.leads = vec![finding; MOST_EFFECTS];
        assert!(summary("cart.robot", &closed, CART).contains("the search stops at 6 effects"));
    }
}
