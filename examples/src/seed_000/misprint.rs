//! Table 1 starts where Table 2 ends, with the back-EMF taken out of the friction: whether the printed numbers do.
//!
//! Which sum of friction and back-EMF a voltage tells is the compiler's to say: of `motor.robot` it makes base parameters, and these are
//! compared.

use robot_model::identify::output_error::OutputEstimate;

use super::Findings;
use super::truth::{ARM, BACK_EMF, ROUNDING, TABLE_1, TABLE_2};
use super::words::{GRAVITY, INERTIA};
use crate::paper::{Error, Row, Table, compiled};

const MOTOR: &str = include_str!("motor.robot");

/// A number of both tables.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// `alpha`, `beta`, `c1` or `c2`.
    pub name: String,
    /// What the start of Table 1 makes of it in model (5.2), within the rounding of what is printed.
    pub made: [f64; 2],
    /// What Table 2 ends with.
    pub printed: f64,
    /// By how much the start of Table 1 is off; 0 within rounding.
    pub off: f64,
}

/// A ratio of what the start of Table 1 makes in model (5.2), beside what output error tells of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Beside {
    /// `alpha/c2`, ..
    pub name: String,
    /// Within the rounding of what is printed.
    pub made: [f64; 2],
    /// What output error tells.
    pub told: f64,
    /// How far these are apart, %; 0 within rounding.
    pub percent: f64,
}

/// What is told is true within that, %: the square wave has its level from a voltage in steps of 5 mV, which are 0.3 % of it, and no
/// deviation knows of that.
const BEYOND: f64 = 1.0;

impl Beside {
    /// Whether the motion of the arm speaks against the start.
    #[must_use]
    pub fn is_refused(&self) -> bool {
        self.percent > BEYOND
    }
}

/// Ratios of what a start of Table 1 makes, beside those that a fit of model (5.2) tells.
///
/// # Errors
/// Mistakes of the spec.
pub fn beside(start: [f64; 4], fit: &OutputEstimate) -> Result<Vec<Beside>, Error> {
    let made = pairs(start, ARM)?;
    let of = |name: &str| made.iter().find(|pair| pair.name == name);
    let ratios = fit.ratios.iter().filter_map(|ratio| {
        let ([low, high], [least, most]) = (of(&ratio.name)?.made, of(&ratio.reference)?.made);
        let made = [low / most, high / least];
        let off = (made[0] - ratio.value).max(ratio.value - made[1]).max(0.0);
        Some(Beside {
            name: format!("{}/{}", ratio.name, ratio.reference),
            made,
            told: ratio.value,
            percent: 100.0 * off / ratio.value.abs(),
        })
    });
    Ok(ratios.collect())
}

/// The start of law (6.3) with a number put right.
#[must_use]
pub fn mended(wrong: &Pair) -> [f64; 4] {
    let names = ["alpha", "beta", "c1", "c2"];
    let start = start();
    std::array::from_fn(|k| {
        let own = if names[k] == wrong.name {
            wrong.off
        } else {
            0.0
        };
        start[k] - own
    })
}

/// Base parameters of the motor's spec for `[alpha, beta, c1, c2]` of model (5.1), in the paper's words.
fn of_model_5_2([alpha, beta, c1, c2]: [f64; 4]) -> Result<Vec<(String, f64)>, Error> {
    let motor = compiled("motor.robot", MOTOR)?;
    let standard = motor.standard.iter().map(|parameter| {
        let name = parameter.name.as_str();
        match name {
            INERTIA => Ok(1.0 / beta),
            GRAVITY => Ok(alpha / beta),
            "th.direction_law.c1" => Ok(c1 / beta),
            "th.direction_law.c2" => Ok(c2 / beta),
            "th.back_emf.k" => Ok(BACK_EMF),
            _ => Err(Error::from(format!("what is {name}?"))),
        }
    });
    let standard: Vec<f64> = standard.collect::<Result<_, _>>()?;
    let base = motor.base.names.iter().zip(motor.base.beta(&standard));
    let words = base.map(|(name, value)| match name.as_str() {
        INERTIA => ("beta".to_owned(), 1.0 / value),
        GRAVITY => ("alpha".to_owned(), value * beta),
        _ => {
            let name = name.trim_start_matches("th.direction_law.");
            (name.trim_end_matches('r').to_owned(), value * beta)
        }
    });
    Ok(words.collect())
}

/// What a start of Table 1 makes of each number of Table 2, both `[alpha, beta, c1, c2]`.
///
/// # Errors
/// Mistakes of the spec.
pub fn pairs(start: [f64; 4], end: [f64; 4]) -> Result<Vec<Pair>, Error> {
    let middle = of_model_5_2(start)?;
    let mut made: Vec<[f64; 2]> = middle.iter().map(|(_, value)| [*value; 2]).collect();
    // All corners of what rounding leaves open.
    for corner in 0..16_u32 {
        let mut values = start;
        for (k, value) in values.iter_mut().enumerate() {
            let is_up = (corner >> k) & 1 == 1;
            *value += if is_up { ROUNDING } else { -ROUNDING };
        }
        for (made, (_, value)) in made.iter_mut().zip(of_model_5_2(values)?) {
            *made = [made[0].min(value), made[1].max(value)];
        }
    }
    let names = ["alpha", "beta", "c1", "c2"];
    let pairs = middle.iter().zip(made).filter_map(|((name, value), made)| {
        let printed = end[names.iter().position(|known| known == name)?];
        // Both are rounded; a hair for the rounding of sums.
        let is_near = made[0] - ROUNDING - 1e-9 <= printed && printed <= made[1] + ROUNDING + 1e-9;
        Some(Pair {
            name: name.clone(),
            made,
            printed,
            off: if is_near { 0.0 } else { value - printed },
        })
    });
    let mut pairs: Vec<Pair> = pairs.collect();
    pairs.sort_by(|one, other| one.name.cmp(&other.name));
    Ok(pairs)
}

/// The start of law (6.3), as printed.
#[must_use]
pub fn start() -> [f64; 4] {
    std::array::from_fn(|k| TABLE_1[2][0].values[k])
}

/// The start of laws (6.1) and (6.2), as printed, with one constant for both directions.
fn linear() -> [[f64; 4]; 2] {
    [TABLE_1[0][0].values, TABLE_2[0][5].values].map(|x| [x[0], x[1], x[2], x[2]])
}

/// Numbers that are off, of laws (6.1) and (6.3).
///
/// # Errors
/// As [`pairs`].
pub fn table() -> Result<(Table, Vec<Pair>), Error> {
    let mut table = Table::new(
        "Start of Table 1 in model (5.2), k = 1.5, beside the end of Table 2",
        ["law", "number", "made of Table 1", "Table 2", "off"],
    );
    let [start_linear, end_linear] = linear();
    let laws = [
        ("linear (6.1)", pairs(start_linear, end_linear)?),
        ("directional (6.3)", pairs(start(), ARM)?),
    ];
    let mut wrong = Vec::new();
    for (law, pairs) in laws {
        for pair in pairs {
            table.push([
                law.to_owned(),
                pair.name.clone(),
                format!("{:.3} .. {:.3}", pair.made[0], pair.made[1]),
                format!("{:.2}", pair.printed),
                if pair.off == 0.0 {
                    "within rounding".to_owned()
                } else {
                    format!("{:+.2}", pair.off)
                },
            ]);
            if pair.off != 0.0 {
                wrong.push(pair);
            }
        }
    }
    Ok((table, wrong))
}

/// Ratios as `alpha/c2 0.3257 for 0.3348 (2.7 %)`.
fn listed(all: &[Beside]) -> String {
    let all = all.iter().map(|one| {
        let made = 0.5 * (one.made[0] + one.made[1]);
        format!(
            "{} {made:.4} for {:.4} ({:.1} %)",
            one.name, one.told, one.percent
        )
    });
    all.collect::<Vec<String>>().join(", ")
}

/// The number of Table 1 that is off.
pub(super) fn row(found: &Findings) -> Row {
    let wrong = &found.misprints.1;
    let is_that = wrong.len() == 1 && wrong[0].name == "c2" && (wrong[0].off - 1.0).abs() < 0.02;
    let [printed, repaired] = &found.start_told;
    let refused = |all: &[Beside]| all.iter().filter(|one| one.is_refused()).count();
    let numbers = wrong.iter().map(|pair| {
        format!(
            "{} makes {:.2} .. {:.2} of it for {:.2}: {:+.2}, so {:.2}",
            pair.name,
            pair.made[0],
            pair.made[1],
            pair.printed,
            pair.off,
            mended(pair)[3]
        )
    });
    Row::wrong_in_print(
        "0.misprint",
        "c2 where Table 1 starts, law (6.3), beside what output error tells of an arm that is simulated with Table 2",
        "4.87",
        format!(
            "ratios in model (5.2) for those that output error tells, and how far off: {}; with the number mended {}; {}",
            listed(printed),
            listed(repaired),
            numbers.collect::<Vec<String>>().join("; ")
        ),
        is_that && refused(printed) == 3 && repaired.len() == 3 && refused(repaired) == 0,
        &format!(
            "{:.2} - {BACK_EMF} * {} is {:.2}; all other numbers of both starts agree with Table 2 within rounding",
            ARM[3],
            ARM[1],
            ARM[3] - BACK_EMF * ARM[1]
        ),
    )
    .by_comparison()
}
