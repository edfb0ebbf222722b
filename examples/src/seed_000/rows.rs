//! The list of what a reproduction has to show, item by item.

use super::drive::{GAIN, white_gain};
use super::fits::{Fit, ITERATIONS, digits, listed};
use super::truth::{ARM, BACK_EMF, RATE, STATIC_R, TABLE_1, TABLE_2};
use super::words::{GRAVITY, INERTIA};
use super::{Findings, Law};
use crate::paper::{Error, Row};

/// A cost that no search of model (5.1) comes below, and all of model (5.2) do.
const FAILED: f64 = 100.0;

fn costs(fits: &[Fit], digits: fn(f64) -> String) -> String {
    let costs: Vec<String> = fits.iter().map(|fit| digits(fit.cost())).collect();
    costs.join(", ")
}

/// A cost of model (5.1), of which rounding leaves one digit.
fn rough(cost: f64) -> String {
    format!("{cost:.0e}")
}

/// All items.
pub(super) fn rows(found: &Findings) -> Result<Vec<Row>, Error> {
    let mut rows = model(found)?;
    rows.extend(searches(found));
    rows.extend(measurements(found));
    rows.extend(audit(found));
    Ok(rows)
}

/// 0.1 to 0.6: the arm and its simulation.
fn model(found: &Findings) -> Result<Vec<Row>, Error> {
    let compiled = Law::Directional.compiled()?;
    let names = compiled.base.names.join(", ");
    let has = |name: &str| compiled.base.names.iter().any(|known| known == name);
    let second = &found.tables.second;
    let starts: Vec<f64> = second
        .iter()
        .filter_map(|fit| fit.iterates.first().map(super::cost))
        .collect();
    let [plain, dry] = &found.turns;
    let is_through = |turns: &super::Turns| turns.apart < 1e-6 && turns.steps < 100.0;
    let slope = found.slope_errors.iter().copied().fold(0.0, f64::max);
    let all = found.tables.first.iter().chain(second);
    let steps = all.flat_map(|fit| fit.iterates.windows(2));
    let rises = steps.filter(|pair| pair[1].cost > pair[0].cost).count();
    let data = &found.data;
    let free = found.tables.free.found.clone()?;
    let truth = found.experiment.velocity[data.window.start];
    let fitted = free.starts[0][1];
    let [first_rate, second_rate] = found.rates;
    Ok(vec![
        Row::holds(
            "0.1",
            "base parameters that the compiler derives of energies and law (6.3)",
            "alpha, beta, c1, c2",
            &names,
            compiled.base.names.len() == 4 && has(INERTIA) && has(GRAVITY),
            "the compiler finds other parameters",
        ),
        Row::holds(
            "0.2",
            "three laws on the same data by one call; cost of the common start, and how far each search comes down",
            "301, 301, 301",
            format!(
                "{}; {}",
                starts
                    .iter()
                    .map(|x| digits(*x))
                    .collect::<Vec<_>>()
                    .join(", "),
                costs(second, digits)
            ),
            starts.len() == 3
                && starts.iter().all(|x| (x / starts[0] - 1.0).abs() < 1e-6)
                && second
                    .iter()
                    .zip(&starts)
                    .all(|(fit, start)| fit.cost() < 0.1 * start),
            "a search fails, or the laws do not agree where they are the same",
        ),
        Row::holds(
            "0.3",
            "steps a sample through turn-arounds, and distance from hand-written motions: law (6.3), and dry friction besides",
            "DGEAR and DVERK hang",
            format!(
                "{:.0} and {:.0} steps, {:.0e} and {:.0e} rad, {} samples at rest",
                plain.steps, dry.steps, plain.apart, dry.apart, dry.resting
            ),
            is_through(plain) && is_through(dry) && dry.resting > 0,
            "the motion does not come through",
        ),
        Row::holds(
            "0.4",
            "Levenberg-Marquardt with exact slopes; their error beside differences",
            "finite differences",
            format!(
                "{slope:.0e} of the largest; costs of iterates rise in {rises} steps of {} searches",
                found.tables.first.len() + second.len()
            ),
            slope < 1e-3 && rises == 0,
            "slopes are off, or a step went up",
        ),
        Row::holds(
            "0.5",
            "samples, samples fitted, initial velocity by difference and fitted (true)",
            "512, 1.67 to 15 s, 0.63 .. 0.76 rad/s",
            format!(
                "{}, {}, {:.3} and {fitted:.3} ({truth:.3}) rad/s",
                data.time.len(),
                data.window.len(),
                data.start()[1]
            ),
            data.time.len() == 512 && data.window.len() == 401 && (fitted - truth).abs() < 0.05,
            "the fitted velocity is off",
        ),
        Row::holds(
            "0.6",
            "rate at which the upright falls at alpha = 12: (5.1) with c = 2.59, (5.2) with c = 35; wanted 2.40 and 0.34 1/s",
            "-",
            format!("{first_rate:.2}, {second_rate:.2} 1/s"),
            (first_rate - 2.40).abs() < 0.01 && (second_rate - 0.34).abs() < 0.01,
            "other rates",
        ),
    ])
}

/// 0.7 to 0.9: both tables, and the figures of section 5.
fn searches(found: &Findings) -> Vec<Row> {
    let (first, second) = (&found.tables.first, &found.tables.second);
    let printed = |table: [&[super::truth::Line]; 3]| {
        let last = table.map(|lines| lines.last().map_or(0.0, |line| line.cost));
        last.map(digits).join(", ")
    };
    let windowed = found.tables.windowed.cost();
    let directional = &second[2];
    let is_best = second[..2]
        .iter()
        .all(|fit| fit.cost() > 100.0 * directional.cost() && fit.steps() > directional.steps());
    let steps: Vec<String> = second.iter().map(|fit| fit.steps().to_string()).collect();
    let apart = found.changes.each_ref().map(super::Change::apart);
    let far = |all: &[f64]| all.iter().filter(|apart| **apart > FAR).count();
    let carried = found.carried.each_ref().map(|all| {
        let (least, middle, largest) = (all[0], all[all.len() / 2], all[all.len() - 1]);
        format!(
            "{middle:.1} ({least:.1} .. {largest:.1}, {} beyond {FAR} rad)",
            far(all)
        )
    });
    let [c1, velocity, whole_c1, whole, ..] = apart;
    let nearby = found.nearby.iter().map(|[_, apart]| *apart);
    let (least, most) = (
        nearby.clone().fold(f64::INFINITY, f64::min),
        nearby.fold(0.0, f64::max),
    );
    let turns = found.nearby.iter().filter(|[_, apart]| *apart > HALF_TURN);
    let is_far = c1.min(velocity) > HALF_TURN
        && c1.min(velocity) > SEVERAL * whole
        && whole_c1.max(whole) < FAR;
    let values = directional.values();
    let samples = found.data.window.len() as f64;
    let degrees = TABLE_2.map(|lines| {
        let cost = lines.last().map_or(0.0, |line| line.cost);
        format!("{:.2}", (cost / samples).sqrt().to_degrees())
    });
    vec![
        Row::holds(
            "0.7",
            format!(
                "last costs of (5.1) after {ITERATIONS} iterations at most: linear, quadratic, directional"
            ),
            printed(TABLE_1),
            format!(
                "{}; directional in windows of 1 s: {}",
                costs(first, rough),
                digits(windowed)
            ),
            first.iter().all(|fit| fit.cost() > FAILED) && windowed < 0.1,
            "a search of model (5.1) succeeds",
        ),
        Row::holds(
            "0.8",
            "last costs of (5.2), and iterates until within twice that",
            format!(
                "{}, which are {} degrees root mean square",
                printed(TABLE_2),
                degrees.join(", ")
            ),
            format!(
                "{}; {}; directional ends at {}",
                costs(second, digits),
                steps.join(", "),
                listed(values)
            ),
            is_best && second.iter().all(|fit| fit.cost() < FAILED),
            "law (6.3) is not the fastest with the lowest cost",
        ),
        Row::holds(
            "0.9",
            "largest distance of motions: figures 7, 8 (5.1) of an arm with their parameters, along its own current without noise from its own start; 9, 10 \
             (5.2); asked is that a hundredth carries over the top in (5.1), and ten times as far as a whole rad/s in (5.2): how many turns it makes hangs on \
             where the arm falls",
            "drawn only; 7 and 8 are called almost chaotic",
            format!(
                "{}; {} rad; figure 8 with 0.001 to 0.02 rad/s less and more: {least:.1} to {most:.1} rad, a half turn and more in {} of {}; a remark: along noisy logs of the arm of Table 2 as printed {}, with its own parameters median and range of 11 {}: it \
                 falls sooner there, and an arm that hangs down is not sensitive",
                listed(&apart[..2]),
                listed(&apart[2..4]),
                turns.count(),
                found.nearby.len(),
                listed(&apart[4..6]),
                carried.join(", "),
            ),
            is_far,
            "a hundredth does not carry that far in (5.1), or a whole carries further in (5.2)",
        ),
    ]
}

/// Further than a whole change carries in model (5.2), rad.
const FAR: f64 = 2.0;

/// From upright to where it hangs on the other side, rad: what is further apart has turned over.
const HALF_TURN: f64 = std::f64::consts::PI;

/// A hundredth carries that many times as far in (5.1) as a whole rad/s does in (5.2), at least.
const SEVERAL: f64 = 10.0;

/// 0.10 to 0.12: calibration, command, velocity.
fn measurements(found: &Findings) -> Vec<Row> {
    let line = &found.statics.line;
    let gain = line.gain;
    let k = found.data.commanded.back_emf;
    let noise = found.noise_gain;
    vec![
        Row::holds(
            "0.10",
            format!(
                "correlation of torque and current, and the gain (simulated with {GAIN:.0} N m/A, and with noise that makes about the printed correlation)"
            ),
            format!("{STATIC_R}; none"),
            format!(
                "{:.4}; {:.2} N m/A, 95 % {:.2} .. {:.2}",
                line.r, gain.value, gain.interval[0], gain.interval[1]
            ),
            gain.interval[0] <= GAIN && GAIN <= gain.interval[1],
            "the interval does not hold the gain",
        ),
        Row::holds(
            "0.11",
            "back-EMF constant that makes the command a square wave",
            "1.5, by trial",
            format!(
                "{:.3} +- {:.3}; {} pieces, {:.1} % of the change in jumps",
                k.value,
                k.std,
                found.data.commanded.pieces.len(),
                found.data.commanded.by_jumps
            ),
            (k.value - BACK_EMF).abs() < 0.05,
            "another constant",
        ),
        Row::holds(
            "0.12",
            "what backward differences at 30 Hz multiply noise by",
            "-",
            format!("{noise:.1} 1/s; {:.1} of white noise", white_gain()),
            (noise / white_gain() - 1.0).abs() < 0.1,
            "another gain",
        ),
    ]
}

/// A condition that is flagged.
const CONDITION: f64 = 1e3;

/// What is wrong, and what to beware of.
fn audit(found: &Findings) -> Vec<Row> {
    let [held, straight, measured, short, printed] = &found.told[..] else {
        unreachable!("told of five");
    };
    let is_off = |told: &super::Told| {
        let ratios = told.ratios();
        (told.factor() - 1.0).abs() > 0.2 && ratios.iter().all(|x| (x - 1.0).abs() < 0.05)
    };
    let conditions = [held, straight, measured].map(super::Told::condition);
    let is_flagged = conditions.iter().all(Option::is_some) && short.common_factor().is_none();
    let rounded = |x: Option<f64>| x.map_or("none".to_owned(), |x| format!("{x:.0}"));
    let ratios = &held.found.ratios;
    let told: Vec<String> = ratios
        .iter()
        .map(|ratio| format!("{}/{} = {:.4}", ratio.name, ratio.reference, ratio.value))
        .collect();
    let quadratic = &found.tables.second[1];
    let (few, many) = (found.by_factor[0].1, found.by_factor[3].1);
    let deviation = measured.found.std[1].unwrap_or(f64::INFINITY);
    vec![
        super::misprint::row(found),
        Row::wrong_in_print(
            "0.scale",
            "alpha and beta of Table 2 by themselves",
            "12.05, 21.42",
            format!(
                "beta is {:.2}, {:.2}, {:.2} times the true one by how the input goes between samples; {} of these fits flagged for a \
                 common factor, with conditions {}; with the start held, as in Table 2, the condition is {} in shares of values, {:.0} with unit columns; told are {}; short swings: {:.2}, {}",
                held.factor(),
                straight.factor(),
                measured.factor(),
                conditions.iter().flatten().count(),
                conditions.map(rounded).join(", "),
                rounded(printed.condition()),
                printed.condition_of_units(),
                told.join(", "),
                short.factor(),
                if short.common_factor().is_none() {
                    "not flagged"
                } else {
                    "flagged"
                },
            ),
            is_flagged
                && printed.condition().is_some_and(|x| x > CONDITION)
                && printed.condition_of_units() > CONDITION
                && is_off(straight)
                && is_off(measured)
                && ratios.len() == 3,
            &format!(
                "with {:.0} 1/s of damping at {RATE} Hz a common factor of alpha, beta and the damping hardly shows; only their ratios do",
                0.5 * (ARM[2] + ARM[3])
            ),
        ),
        Row::holds(
            "0.quadratic",
            "law (6.2) in model (5.2) takes alpha and beta elsewhere",
            "20.23, 26.17 with (6.2); 12.05, 21.42 with (6.3)",
            listed(quadratic.values()),
            (quadratic.values()[1] / ARM[1] - 1.0).abs() > 0.2,
            "they stay",
        ),
        Row::remark(
            "0.feedback",
            "with a measured velocity in the input, v = u + k dy/dt, the fit is nearly one of equation error",
            "output error",
            format!(
                "cost of the wrong law (6.1), nothing fitted: {} at k = 1.5, {} at k = 12; with k = 1.5 and law (6.3) fitted beta is {:.2} +- {deviation:.2}",
                digits(few),
                digits(many),
                measured.found.values[1],
            ),
            many < 0.1 * few && (measured.found.values[1] - ARM[1]).abs() > 3.0 * deviation,
            "no misprint: the more of the measured velocity is in the input, the less a wrong law costs",
        ),
    ]
}
