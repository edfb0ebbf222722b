//! Every item of the list, with what became of it.

use super::arm_rows;
use super::base_rows;
use super::excitation::{Objectives, against_differences};
use super::law::{Besides, speeds};
use super::results::Results;
use super::table_two::{drop, mean, mean_drop, squares};
use super::truth::{EPS, HARMONICS, SAMPLES, TABLE_2};
use crate::paper::Row;

/// Numbers, one a joint.
pub(super) fn list(values: &[f64], digits: usize) -> String {
    let values: Vec<String> = values.iter().map(|x| format!("{x:.digits$}")).collect();
    values.join(", ")
}

/// A number that may be zero but for rounding.
fn small(value: f64) -> String {
    if value.abs() < 1e-12 {
        "0".to_owned()
    } else if value.abs() < 1e-2 {
        format!("{value:.0e}")
    } else {
        format!("{value:.2}")
    }
}

/// All rows.
#[must_use]
pub fn rows(results: &Results) -> Vec<Row> {
    let parts = [
        law(results),
        base_rows::rows(results),
        identification(results),
        excitation(results),
        arm_rows::of_table(results),
        arm_rows::of_use(results),
    ];
    parts.into_iter().flatten().collect()
}

fn law(results: &Results) -> Vec<Row> {
    let drives: Vec<f64> = (0..6).filter_map(|k| results.drives_from(1, k)).collect();
    let falls = results.speeds.each_ref().map(|speeds| speeds.falls);
    let [forward, backward] = [0, 1].map(|way| falls.map(|falls| falls[way]));
    let pairs = drives.iter().zip(falls);
    let jumps = results.jumps[0].map(Option::unwrap_or_default);
    let is_found = drives.len() == 6
        && pairs
            .into_iter()
            .all(|(drives, falls)| falls.iter().all(|falls| drives > falls));
    vec![
        Row::holds(
            "2.1",
            "friction law (3), (4) by name: `rokae`",
            "five parameters a joint and `eps`",
            format!(
                "compiled law within {:.0e} N m of it at {} speeds of six joints; without the jump as an effect that a spec has of its own",
                results.law_difference,
                speeds().count()
            ),
            results.law_difference < 1e-12,
            "the compiled law is another",
        ),
        Row::wrong_in_print(
            "2.1.jump",
            "the law at the speed `eps`",
            "movement is made smoother",
            format!(
                "`audit` finds jumps by {} N m at {} rad/s; on {} joints where the viscous part begins at rest",
                list(&jumps.map(|[by, _]| by), 2),
                list(&jumps.map(|[_, at]| at), 2),
                results.jumps[1].iter().flatten().count()
            ),
            jumps
                .iter()
                .all(|[by, at]| *by > 5e-3 && (at - EPS).abs() < 1e-6)
                && results.jumps[1].iter().all(Option::is_none),
            "the viscous part is missing below `eps`, so the torque jumps there",
        ),
        Row::wrong_in_print(
            "2.1.slope",
            "a negative slope at low speed",
            "the law is to fit it",
            format!(
                "where friction falls at low speeds the tracer names {}; with it declared, {}",
                names(&results.missing_fall[0]),
                names(&results.missing_fall[1])
            ),
            results.missing_fall[0] == [Besides::Falls.effect()]
                && results.missing_fall[1].is_empty(),
            "no term of the law falls at low speed",
        ),
        Row::wrong_in_print(
            "2.1.displacement",
            "friction over the angle",
            "abstract: angular displacement is considered",
            format!(
                "where friction depends on the angle the tracer names {}; with it declared, {}; the compiled torque reads positions: {}; \
                 with it declared: {}",
                names(&results.missing_position[0]),
                names(&results.missing_position[1]),
                results.reads_position[0],
                results.reads_position[1]
            ),
            results.missing_position[0] == [Besides::Position.effect()]
                && results.missing_position[1].is_empty()
                && results.reads_position == [false, true],
            "no term of the law has the position in it",
        ),
        Row::wrong_in_print(
            "2.1.passive",
            "sign of friction with the values of Table I",
            "the square and the cube guarantee accuracy",
            format!(
                "`audit`: drives in the worse direction from {} rad/s; without square and cube {} findings; by a scan of the compiled law it \
                 falls from {} rad/s forward and {} backward, {} in the mean of both",
                list(&drives, 2),
                results.ours[1].findings("friction").len(),
                list(&forward, 2),
                list(&backward, 2),
                list(
                    &results.speeds.each_ref().map(|speeds| speeds.falls_in_mean),
                    2
                ),
            ),
            is_found && results.ours[1].findings("friction").is_empty(),
            "`fv3 < 0`, and `fv2` is even in the velocity: friction gives energy at high speeds",
        ),
    ]
}

/// In words.
fn names(found: &[String]) -> String {
    match found {
        [] => "nothing".to_owned(),
        found => found.join(", "),
    }
}

fn identification(results: &Results) -> Vec<Row> {
    let [tfls, mfls, mfwls] = &TABLE_2;
    let total = drop(mean(tfls), mean(mfwls));
    let each = mean_drop(tfls, mfwls);
    let friction: Vec<f64> = tfls.iter().zip(mfls).map(|(a, b)| drop(*a, *b)).collect();
    let ours = [
        &results.conventional[0],
        &results.conventional[1],
        &results.modified[0],
        &results.modified[1],
    ];
    let means = ours.map(|fit| mean(&fit.rmse));
    let drops = [1, 2, 3].map(|k| drop(means[0], means[k]));
    let better = (0..6)
        .filter(|&k| ours[3].rmse[k] < ours[0].rmse[k])
        .count();
    let quiet = results.without_ripple.each_ref();
    let quiet = quiet.map(|fit| mean(&fit.rmse));
    let quiet = [1, 2, 3].map(|k| drop(quiet[0], quiet[k]));
    let times = |k: usize| ours[0].rmse[k] / tfls[k];
    let furthest = (0..6).max_by(|&j, &k| times(j).total_cmp(&times(k)));
    let furthest = furthest.unwrap_or_default();
    let trained: Vec<f64> = results.modified.iter().map(|fit| fit.trained).collect();
    let sums = [squares(mfls), squares(mfwls)];
    vec![
        Row::holds(
            "2.4",
            "weights by torque norm (20)-(22), beside others; 2 x 2 with friction",
            "1 / |tau_i|",
            format!(
                "mean error on the test run: TFLS {:.2}, weights alone {:.2}, friction alone {:.2}, both {:.2} N m",
                means[0], means[1], means[2], means[3]
            ),
            means[3] < means[2] && means[3] < means[1] && means[1] < means[0],
            "both together are not the best",
        ),
        Row::holds(
            "2.5",
            "what brings the drop of the mean error: Table II, and here",
            "friction and weights together, more than 54 %",
            format!(
                "of Table II {total:.1} % of the mean, {each:.1} % mean over joints, friction alone {} %; here weights alone {:.0} %, friction \
                 alone {:.0} %",
                list(&friction, 0),
                drops[0],
                drops[1]
            ),
            total > 50.0 && friction.iter().sum::<f64>() < 0.5 * 6.0 * total && drops[0] > drops[1],
            "friction brings more than weights",
        ),
        Row::holds(
            "2.5.here",
            "drop of the mean error by both on the simulated arm",
            "more than 54 %",
            format!(
                "weights alone {:.0} %, friction alone {:.0} %, both {:.0} %; {better} of 6 joints better; without the ripple of joint 2, \
                 which is a guess, {:.0}, {:.0} and {:.0} %; TFLS by joints {} for {} in print: joint {} is {:.0} times as far off",
                drops[0],
                drops[1],
                drops[2],
                quiet[0],
                quiet[1],
                quiet[2],
                list(&ours[0].rmse, 2),
                list(tfls, 2),
                furthest + 1,
                times(furthest)
            ),
            drops[2] > 54.0,
            "neither the ripple nor what TFLS leaves is that of the paper's arm, of which no log is published",
        ),
        Row::holds(
            "2.5.sum",
            "sum of squares over all joints, with weights and without: of the errors of Table II, and over all rows here",
            format!("falls from {:.0} to {:.0} N^2 m^2", sums[0], sums[1]),
            format!(
                "on the run that is fitted {:.0} without weights and {} N^2 m^2 with the three kinds of them",
                trained[0],
                list(&trained[1..], 0)
            ),
            sums[1] < sums[0] && trained[1..].iter().all(|sum| *sum > trained[0]),
            "weights lower the sum on the run that is fitted",
        ),
    ]
}

fn excitation(results: &Results) -> Vec<Row> {
    let motions: Vec<f64> = results
        .designs
        .iter()
        .map(|design| against_differences(&design.motion))
        .collect();
    let off = motions.iter().copied().fold(0.0, f64::max);
    let joints = results.designs[0].motion.coefficients.len();
    let coefficients = joints * (2 * HARMONICS + 1);
    let worst = results.violations.iter().copied().fold(0.0, f64::max);
    let quality = |k: usize| &results.designs[k].quality;
    let best = |own: usize, of: &dyn Fn(usize) -> f64| (0..4).all(|k| of(own) >= of(k));
    let [raw, unit] = &results.objectives;
    let ended = |found: &Objectives, k: usize| {
        let value = found.values.get(k).copied().unwrap_or(f64::NAN);
        let worth = found.log_det[k].map_or_else(
            || "refused, as it tells no parameters apart".to_owned(),
            |log_det| format!("ln det {log_det:.0}"),
        );
        format!("{} ({worth})", small(value))
    };
    let product: f64 = results.sums.iter().product();
    let logarithms: f64 = results.sums.iter().map(|sum| sum.ln()).sum();
    vec![
        Row::holds(
            "2.6",
            "Fourier series (24), 5 harmonics of 20 s",
            "66 coefficients",
            format!(
                "{coefficients} coefficients; within {off:.0e} of differences of the 8th order"
            ),
            coefficients == 66 && off < 1e-9,
            "derivatives are not those of the position",
        ),
        Row::holds(
            "2.7",
            "limits and ends (26)",
            "kept",
            format!(
                "limits exceeded and ends missed by {} at most, on a grid ten times as fine",
                small(worst)
            ),
            worst <= 0.0,
            "a limit is exceeded",
        ),
        Row::holds(
            "2.8",
            "Hadamard's bound (29) beside log det, condition number, least eigenvalue",
            "Hadamard's bound",
            format!(
                "ln det {:.0} / {:.0} / {:.0} / {:.0}, condition of unit columns {:.0} / {:.0} / {:.0} / {:.0}",
                quality(0).log_det,
                quality(1).log_det,
                quality(2).log_det,
                quality(3).log_det,
                quality(0).condition_of_unit_columns,
                quality(1).condition_of_unit_columns,
                quality(2).condition_of_unit_columns,
                quality(3).condition_of_unit_columns,
            ),
            best(0, &|k| quality(k).hadamard)
                && best(1, &|k| quality(k).log_det)
                && best(2, &|k| -quality(k).condition)
                && best(3, &|k| quality(k).least_singular),
            "a motion is better by another's criterion",
        ),
        Row::wrong_in_print(
            "2.8.unit",
            "(29) on the normalized columns of (11), as the text has it",
            "an objective",
            format!(
                "searches from two motions end at {} and at {}; on columns as they are at {} and at {}",
                ended(unit, 0),
                ended(unit, 1),
                ended(raw, 0),
                ended(raw, 1)
            ),
            unit.values.len() == 2
                && unit.values.iter().all(|value| value.abs() < 1e-9)
                && unit.log_det.iter().all(Option::is_none)
                && raw.values.iter().all(|value| *value < -0.5)
                && raw.log_det.iter().all(Option::is_some),
            "columns of unit length have the bound 1 by every motion: nothing is designed",
        ),
        Row::remark(
            "2.8.product",
            format!(
                "(29) as a product of {} sums over {} rows, multiplied in doubles",
                results.sums.len(),
                SAMPLES * joints
            ),
            "1 / product",
            format!(
                "the product is {product}, so (29) is {}; the sum of logarithms, which is minimized here, {logarithms:.0}",
                1.0 / product
            ),
            1.0 / product == 0.0 && logarithms.is_finite(),
            "no misprint: computed as it is printed, the objective is zero by every motion",
        ),
    ]
}
