//! Tables of the publication beside ours.

use super::arm::truth;
use super::excitation::CRITERIA;
use super::law::Speeds;
use super::results::Results;
use super::table_two::{Fit, WEIGHTS, drop, mean};
use super::truth::{FRICTION, METHODS, TABLE_1, TABLE_2};
use crate::paper::Table;

/// All of them.
#[must_use]
pub fn tables(results: &Results) -> Vec<Table> {
    vec![
        rigid(results),
        audited(results),
        table_1(results),
        friction(results),
        criteria(results),
        table_2(results),
        ablation(results),
        guiding(results),
        streaming(results),
    ]
}

/// Seconds are those of a machine and of what else it does, so a page has others.
fn streaming(results: &Results) -> Table {
    let mut table = Table::new(
        "From positions to an estimate, piece by piece: seconds",
        ["columns", "seconds"],
    )
    .rough();
    for streamed in &results.streamed {
        let [_, columns] = streamed.size;
        table.push([format!("{columns}"), format!("{:.2}", streamed.seconds)]);
    }
    table
}

/// Numbers as text.
fn cells<'a>(name: &str, values: impl IntoIterator<Item = &'a f64>) -> Vec<String> {
    let values = values.into_iter().map(|x| format!("{x:.2}"));
    std::iter::once(name.to_owned()).chain(values).collect()
}

/// Links and rotors of Table I beside those of the arm that is simulated.
fn rigid(results: &Results) -> Table {
    let mut table = Table::new(
        "Links and rotors of Table I, printed, and those of the simulated arm: kg, kg m, kg m^2",
        ["", "1", "2", "3", "4", "5", "6"],
    );
    let ours = truth();
    let rigid = TABLE_1
        .iter()
        .take_while(|(name, _)| !name.starts_with("rokae"));
    for (name, printed) in rigid {
        let short = if *name == "motor_inertia.ia" {
            "J"
        } else {
            *name
        };
        // Without zeros at the end, and without a sign before zero.
        let digits = |x: f64| format!("{}", (1e4 * x).round() / 1e4 + 0.0);
        let cells = |said: &str, values: [f64; 6]| {
            let first = std::iter::once(format!("{short}, {said}"));
            first.chain(values.map(digits)).collect::<Vec<String>>()
        };
        table.push(cells("printed", *printed));
        let here = std::array::from_fn(|k| {
            ours.get(&format!("j{}.{name}", k + 1))
                .copied()
                .unwrap_or(f64::NAN)
        });
        table.push(cells("here", here));
    }
    let checks = [("printed", &results.table_1[1]), ("here", &results.ours[0])];
    for (said, audited) in checks {
        let (links, rotors) = (audited.told("bodies"), audited.told_of("signs", "value"));
        let joint = |k: usize| format!("j{}", k + 1);
        let of = |name: &str, is_wrong: &dyn Fn(usize) -> bool, wrong: &str| {
            let cells = (0..6).map(|k| if is_wrong(k) { wrong } else { "possible" }.to_owned());
            let first = std::iter::once(format!("{name}, {said}, by `audit`"));
            first.chain(cells).collect::<Vec<String>>()
        };
        table.push(of("link", &|k| links.contains(&&*joint(k)), "no body"));
        let is_below = |k: usize| rotors.contains(&&*format!("{}.motor_inertia.ia", joint(k)));
        table.push(of("rotor", &is_below, "below zero"));
    }
    table
}

/// What the audit says of links and rotors, word by word.
fn audited(results: &Results) -> Table {
    let mut table = Table::new(
        "What `audit` says of links and rotors of Table I",
        ["check", "finding"],
    );
    for check in ["bodies", "signs", "inertia"] {
        for finding in results.table_1[1].findings(check) {
            table.push([check, finding]);
        }
    }
    table
}

/// Friction of Table I, which the arm has that is simulated, and what comes back of it.
fn table_1(results: &Results) -> Table {
    let mut table = Table::new(
        "Friction of Table I, printed and true here, and identified: N m, N m s/rad, ..; fc2 as a magnitude",
        ["", "1", "2", "3", "4", "5", "6"],
    );
    let found = |fit: &Fit, name: &str| -> Vec<f64> {
        let value = |k: usize| {
            let name = format!("j{}.rokae.{name}", k + 1);
            let mut all = fit.estimate.parameters.iter();
            all.find(|one| one.name == name)
                .map_or(f64::NAN, |one| one.value)
        };
        (0..6).map(value).collect()
    };
    for (name, printed) in FRICTION.by_name() {
        table.push(cells(&format!("{name}, printed"), &printed));
        table.push(cells(
            &format!("{name}, MFWLS"),
            &found(&results.modified[1], name),
        ));
        let rippled = found(&results.with_ripple, name);
        table.push(cells(&format!("{name}, with the ripple"), &rippled));
    }
    table
}

fn friction(results: &Results) -> Table {
    let mut table = Table::new(
        "Friction of Table I, joint by joint",
        ["", "1", "2", "3", "4", "5", "6"],
    );
    let jumps = results.jumps[0].map(|jump| jump.unwrap_or([f64::NAN; 2]));
    table.push(cells("jumps by, N m", &jumps.map(|[by, _]| by)));
    table.push(cells("jumps at, rad/s", &jumps.map(|[_, at]| at)));
    let scanned = |of: &dyn Fn(&Speeds) -> f64| results.speeds.each_ref().map(of);
    for (way, name) in ["forward", "backward"].into_iter().enumerate() {
        let name = format!("falls from, {name}, rad/s");
        table.push(cells(&name, &scanned(&|speeds| speeds.falls[way])));
    }
    table.push(cells(
        "falls from, mean of both, rad/s",
        &scanned(&|speeds| speeds.falls_in_mean),
    ));
    for (way, name) in ["forward", "backward"].into_iter().enumerate() {
        let name = format!("drives from, {name}, rad/s");
        table.push(cells(&name, &scanned(&|speeds| speeds.drives[way])));
    }
    let drives: Vec<f64> = (0..6)
        .map(|k| results.drives_from(1, k).unwrap_or(f64::NAN))
        .collect();
    table.push(cells("drives from, `audit`, rad/s", &drives));
    table
}

fn criteria(results: &Results) -> Table {
    let mut table = Table::new(
        "Motions of 20 s by four criteria",
        [
            "criterion",
            "sum ln A_jj",
            "ln det A",
            "condition",
            "of unit columns",
            "least singular value",
        ],
    );
    for ((name, _), design) in CRITERIA.iter().zip(&results.designs) {
        let quality = &design.quality;
        table.push([
            (*name).to_owned(),
            format!("{:.1}", quality.hadamard),
            format!("{:.1}", quality.log_det),
            format!("{:.0}", quality.condition),
            format!("{:.1}", quality.condition_of_unit_columns),
            format!("{:.2e}", quality.least_singular),
        ]);
    }
    table
}

/// A row of errors with their mean.
fn errors(name: &str, values: &[f64]) -> Vec<String> {
    let all: Vec<f64> = values.iter().copied().chain([mean(values)]).collect();
    cells(name, &all)
}

fn table_2(results: &Results) -> Table {
    let mut table = Table::new(
        "Table II: root mean square errors on the test run, N m",
        ["method", "1", "2", "3", "4", "5", "6", "mean"],
    );
    let ours = [
        &results.conventional[0],
        &results.modified[0],
        &results.modified[1],
    ];
    for ((name, printed), ours) in METHODS.iter().zip(&TABLE_2).zip(ours) {
        table.push(errors(&format!("{name}, printed"), printed));
        table.push(errors(&format!("{name}, here"), &ours.rmse));
    }
    table.push(errors(
        "MFWLS with the ripple of joint 2",
        &results.with_ripple.rmse,
    ));
    table
}

fn ablation(results: &Results) -> Table {
    let mut table = Table::new(
        "Mean error on the test run by friction and weights, N m, and its drop from TFLS",
        [
            "weights",
            "conventional friction",
            "",
            "modified friction",
            "",
        ],
    );
    let from = mean(&results.conventional[0].rmse);
    let cell = |fit: &Fit| {
        let own = mean(&fit.rmse);
        [format!("{own:.3}"), format!("{:.0} %", drop(from, own))]
    };
    for (k, (name, ..)) in WEIGHTS.iter().enumerate() {
        let pair = [&results.conventional[k], &results.modified[k]].map(cell);
        let cells = pair.into_iter().flatten();
        table.push(std::iter::once((*name).to_owned()).chain(cells));
    }
    let [plain, plain_weighted, modified, modified_weighted] = &results.without_ripple;
    let from = mean(&plain.rmse);
    let cell = |fit: &Fit| {
        let own = mean(&fit.rmse);
        [format!("{own:.3}"), format!("{:.0} %", drop(from, own))]
    };
    let pairs = [[plain, modified], [plain_weighted, modified_weighted]];
    for ((name, ..), pair) in WEIGHTS.iter().zip(pairs) {
        let cells = pair.map(cell).into_iter().flatten();
        table.push(std::iter::once(format!("{name}, no ripple on joint 2")).chain(cells));
    }
    table
}

fn guiding(results: &Results) -> Table {
    let mut table = Table::new(
        "Hand guiding: torque of the hand, N m root mean square",
        ["", "1", "2", "3", "4", "5", "6"],
    );
    for (name, guided) in ["TFLS", "MFWLS"].iter().zip(&results.guided) {
        for (what, is_slow) in [("slower than 0.01 rad/s", true), ("faster", false)] {
            let efforts: Vec<f64> = (0..6).map(|k| guided.effort(k, is_slow)).collect();
            table.push(cells(&format!("{name}, {what}"), &efforts));
        }
    }
    table
}
