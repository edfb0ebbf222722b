//! The paper's tables beside ours.

use super::audit::{Rest, Told, off, said};
use super::releases::BoxPlot;
use super::search::Found;
use super::truth::{BOUNDS, CAD, ESTIMATED, HEIGHTS, NAMES};
use super::validation::Validation;
use crate::paper::Table;

/// Initial angles, as the box plots of figures 3 and 8 have them.
#[must_use]
pub fn starts(found: &Found) -> Table {
    let mut table = Table::new(
        "Figures 3 and 8: initial angles of twenty releases, degrees",
        [
            "link",
            "height",
            "least .. largest, mode, printed",
            "least .. largest, mode, here",
            "quartiles, here",
            "mean, here",
        ],
    );
    for link in 0..2 {
        for (height, batch) in HEIGHTS.iter().zip(&found.batches) {
            let printed = height.starts[link];
            let own = BoxPlot::new(&batch[link].starts);
            let [low, middle, high] = own.quartiles;
            table.push([
                (link + 1).to_string(),
                format!("{}", height.angle),
                format!(
                    "{:.3} .. {:.3}, {:.3}",
                    printed.least, printed.most, printed.mode
                ),
                format!("{:.3} .. {:.3}, {:.3}", own.least, own.most, own.mode),
                format!("{low:.3} {middle:.3} {high:.3}"),
                format!("{:.3}", own.mean),
            ]);
        }
    }
    table
}

/// Tables 3, 4, 7 to 10: errors before and after.
#[must_use]
pub fn errors(validations: &[Validation], link: usize) -> Table {
    let numbers = if link == 0 {
        "3, 7 and 9"
    } else {
        "4, 8 and 10"
    };
    let mut table = Table::new(
        format!(
            "Tables {numbers}: link {}, MAE in degrees and NRMSE in percent",
            link + 1
        ),
        [
            "height",
            "before, printed",
            "before, here",
            "after, printed",
            "after, here",
            "the arm itself",
            "no noise, before",
            "no noise, first 5 s",
            "no noise, after",
        ],
    );
    for own in validations.iter().filter(|own| own.link == link) {
        let height = &HEIGHTS[own.height];
        let both = |mae: f64, nrmse: f64| format!("{mae:.4}, {nrmse:.2}");
        let (before, after) = (height.before[link], height.after[link]);
        table.push([
            format!("{}", height.angle),
            both(before.mae, before.nrmse),
            both(own.before.mae, own.before.nrmse),
            both(after.mae, after.nrmse),
            both(own.after.mae, own.after.nrmse),
            format!("{:.2}", own.itself),
            format!("{:.2}", own.exact_before[0]),
            format!("{:.2}", own.exact_before[1]),
            format!("{:.3}", own.exact_after),
        ]);
    }
    table
}

/// Tables 5, 6 and 11: parameters before and after, and what releases tell of them.
#[must_use]
pub fn parameters(found: &Found, told: &Told) -> Table {
    let mut table = Table::new(
        "Tables 2, 5, 6 and 11: parameters in SI units; searches end where they like, and one parameter has a value",
        [
            "name",
            "CAD",
            "bounds",
            "printed after",
            "10",
            "20",
            "30",
            "40",
            "no noise",
            "told by releases",
        ],
    );
    for (k, name) in NAMES.into_iter().enumerate() {
        let searches = found.means.iter().chain([&found.exact]);
        let ends = searches.map(|estimate| format!("{:.4}", estimate.values[k]));
        let told = told.eleven.std[k].map(|_| {
            let last = &found.means[HEIGHTS.len() - 1];
            let std = last.std[k].map_or(String::new(), |std| format!(" +- {std:.4}"));
            format!("{:.4}{std}", last.values[k])
        });
        let cells = [
            name.to_owned(),
            format!("{}", CAD.values()[k]),
            format!("{} .. {}", BOUNDS[k][0], BOUNDS[k][1]),
            format!("{}", ESTIMATED.values()[k]),
        ];
        let told = told.unwrap_or_else(|| "no value".to_owned());
        table.push(cells.into_iter().chain(ends).chain([told]));
    }
    table
}

/// Null directions, as the library says them.
#[must_use]
pub fn silent(told: &Told) -> Table {
    let mut table = Table::new(
        "Null directions of the eleven parameters at Table 6",
        ["direction"],
    );
    for direction in &told.eleven.identifiability.directions {
        table.push([direction.to_string()]);
    }
    // Any mixture of them is one: rounding chooses.
    table.rough()
}

/// Ratios of base parameters, which releases do tell.
#[must_use]
pub fn ratios(told: &Told, [before, after]: &[Vec<f64>; 2]) -> Table {
    let mut table = Table::new(
        "What releases tell: base parameters over one of them, from the means of twenty releases from 40 degrees",
        ["ratio", "by Table 2", "by Table 6", "here", "deviation"],
    );
    let value = |values: &[f64], name: &str| {
        let place = told.names.iter().position(|other| other == name);
        place.map_or(f64::NAN, |place| values[place])
    };
    for ratio in &told.base.ratios {
        let of = |values: &[f64]| value(values, &ratio.name) / value(values, &ratio.reference);
        table.push([
            format!("{} / {}", ratio.name, ratio.reference),
            format!("{:.4}", of(before)),
            format!("{:.4}", of(after)),
            format!("{:.4}", ratio.value),
            ratio.std.map_or(String::new(), |std| format!("{std:.1e}")),
        ]);
    }
    table
}

/// Bounds as printed and as the text says.
#[must_use]
pub fn bounds() -> Table {
    let mut table = Table::new(
        "Table 5: bounds beside 30 % less and more than Table 2",
        ["name", "printed", "as the text says", "is off"],
    );
    let off = off(&BOUNDS);
    for ((name, printed), said) in NAMES.into_iter().zip(BOUNDS).zip(said()) {
        let is_off = off.iter().any(|off| off.name == name);
        table.push([
            name.to_owned(),
            format!("{} .. {}", printed[0], printed[1]),
            format!("{:.4} .. {:.4}", said[0], said[1]),
            if is_off { "yes" } else { "no" }.to_owned(),
        ]);
    }
    table
}

/// Where arms come to rest.
#[must_use]
pub fn rests(rests: &[Rest]) -> Table {
    let mut table = Table::new(
        "Where the arm of Table 6 comes to rest, degrees",
        [
            "link",
            "height",
            "by hand",
            "library",
            "gravity over dry friction",
            "with a steep curve",
        ],
    );
    for rest in rests {
        let both = |q: [f64; 2]| {
            // Without the sign of a zero.
            let [one, other] = q.map(|q| (1e4 * q.to_degrees()).round() / 1e4 + 0.0);
            format!("{one:.4}, {other:.4}")
        };
        table.push([
            (rest.link + 1).to_string(),
            format!("{}", HEIGHTS[rest.height].angle),
            both(rest.by_hand),
            both(rest.library),
            format!("{:.2}, {:.2}", rest.share[0], rest.share[1]),
            both(rest.smooth),
        ]);
    }
    table
}
