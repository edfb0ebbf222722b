//! The paper's figures, by their numbers.

use robot_model::identify::output_error::OutputEstimate;

use super::plant::{Position, degrees};
use super::releases::{Batch, BoxPlot};
use super::search::Found;
use super::truth::{HEIGHTS, NAMES, PULSE, STEP};
use super::validation::Validation;
use crate::paper::{Figure, Mark};

/// Every so many samples is drawn.
const EVERY: usize = 10;

const TIME: &str = "time, s";
const ANGLE: &str = "angle, degrees";

fn line(values: Vec<f64>) -> Vec<(f64, f64)> {
    let points = values.into_iter().enumerate().step_by(EVERY);
    points.map(|(k, y)| (k as f64 * STEP, y)).collect()
}

fn name(number: usize) -> String {
    format!("figure_{number:02}")
}

/// All of them.
#[must_use]
pub fn all(found: &Found, validations: &[Validation]) -> Vec<Figure> {
    let mut figures = Vec::new();
    for link in 0..2 {
        figures.push(starts(found, link));
        for (k, batches) in found.batches.iter().enumerate() {
            figures.push(band(&batches[link], link, k));
        }
    }
    for own in validations {
        let number = 13 + 4 * own.link + own.height;
        figures.push(beside(own, number, "before estimation", &own.cad));
        figures.push(beside(own, number + 8, "after estimation", &own.fitted));
    }
    let last = HEIGHTS.len() - 1;
    for (number, is_after) in [(29, false), (30, true)] {
        figures.push(both(validations, last, number, is_after));
    }
    figures.extend(traces(&found.means[last]));
    figures
}

fn starts(found: &Found, link: usize) -> Figure {
    let batches = found.batches.iter().zip(&HEIGHTS);
    let boxes = batches.clone().map(|(batch, height)| {
        let own = BoxPlot::new(&batch[link].starts);
        let [low, middle, high] = own.quartiles;
        let five = [own.least, low, middle, high, own.most];
        (height.angle, five.map(|start| start - height.angle))
    });
    let means = batches.map(|(batch, height)| {
        let own = BoxPlot::new(&batch[link].starts);
        (height.angle, own.mean - height.angle)
    });
    let title = format!("initial angles of twenty releases, link {}", link + 1);
    Figure::new(
        name(3 + 5 * link),
        title,
        "height, degrees",
        "initial angle less height, degrees",
    )
    .with_boxes("least, quartiles, largest of 20 releases", boxes)
    .with("mean", Mark::Dots, means)
}

fn band(batch: &Batch, link: usize, height: usize) -> Figure {
    let mean = degrees(&batch.mean, link);
    let deviation = degrees(&batch.deviation, link);
    let edge = |sign: f64| {
        let pairs = mean.iter().zip(&deviation);
        line(pairs.map(|(mean, std)| mean + sign * std).collect())
    };
    let edges = edge(-1.0).into_iter().zip(edge(1.0));
    let between = edges.map(|((t, low), (_, high))| [t, low, high]);
    let title = format!(
        "mean and deviation of twenty releases, link {}, {} degrees",
        link + 1,
        HEIGHTS[height].angle
    );
    let times = enlarged(&deviation, &mean);
    let enlarged = deviation.iter().map(|std| times * std).collect();
    // Nothing is seen after the arm has come to rest but for a pulse.
    let last = mean.iter().rposition(|angle| angle.abs() > PULSE);
    let end = last.map_or(0.0, |sample| (sample as f64 + 200.0) * STEP);
    let moving = |points: Vec<(f64, f64)>| points.into_iter().filter(move |(t, _)| *t <= end);
    Figure::new(name(4 + 5 * link + height), title, TIME, ANGLE)
        .with_band(
            "a standard deviation to each side",
            between.filter(|[t, ..]| *t <= end),
        )
        .with("mean", Mark::Line, moving(line(mean.clone())))
        .with(
            sized("deviation", times),
            Mark::Line,
            moving(line(enlarged)),
        )
}

fn beside(own: &Validation, number: usize, what: &str, model: &[Position]) -> Figure {
    let (link, measured) = (own.link, degrees(&own.measured, own.link));
    let model = degrees(model, link);
    let error = measured.iter().zip(&model).map(|(y, model)| y - model);
    let error: Vec<f64> = error.collect();
    let times = enlarged(&error, &measured);
    let error = line(error.into_iter().map(|error| times * error).collect());
    let title = format!(
        "model {what}, link {}, {} degrees",
        link + 1,
        HEIGHTS[own.height].angle
    );
    Figure::new(name(number), title, TIME, ANGLE)
        .with("mean of releases", Mark::Broad, line(measured))
        .with("model", Mark::Line, line(model))
        .with(sized("error", times), Mark::Line, error)
}

/// A name in the key of what is enlarged.
fn sized(name: &str, times: f64) -> String {
    if times > 1.0 {
        format!("{name}, {times} times as large")
    } else {
        name.to_owned()
    }
}

/// A power of ten by which errors are seen beside what they are of.
fn enlarged(error: &[f64], beside: &[f64]) -> f64 {
    let most = |values: &[f64]| values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let share = most(beside) / most(error);
    if share.is_finite() {
        10_f64.powf(share.log10().floor()).max(1.0)
    } else {
        1.0
    }
}

fn both(validations: &[Validation], height: usize, number: usize, is_after: bool) -> Figure {
    let what = if is_after { "after" } else { "before" };
    let title = format!(
        "both links {what} estimation, {} degrees",
        HEIGHTS[height].angle
    );
    let own = validations.iter().filter(|own| own.height == height);
    own.fold(
        Figure::new(name(number), title, TIME, ANGLE),
        |figure, own| {
            let model = if is_after { &own.fitted } else { &own.cad };
            let link = own.link + 1;
            figure
                .with(
                    format!("mean, link {link}"),
                    Mark::Broad,
                    line(degrees(&own.measured, own.link)),
                )
                .with(
                    format!("model, link {link}"),
                    Mark::Line,
                    line(degrees(model, own.link)),
                )
        },
    )
}

/// Figures 31 and 32: parameters along the search.
fn traces(estimate: &OutputEstimate) -> [Figure; 3] {
    let figure = |name: &str, title: &str, unit: &str, places: std::ops::Range<usize>| {
        places.fold(
            Figure::new(name, title, "step of the search", unit),
            |figure, place| {
                let values = estimate.iterates.iter().enumerate();
                let values = values.map(|(k, iterate)| (k as f64, iterate.values[place]));
                figure.with(NAMES[place], Mark::Line, values)
            },
        )
    };
    [
        figure("figure_31", "masses along the search", "mass, kg", 0..2),
        figure(
            "figure_32",
            "lengths and inertia along the search",
            "m, kg m^2",
            2..7,
        ),
        figure(
            "figure_32_friction",
            "friction along the search",
            "N m s/rad, N m",
            7..NAMES.len(),
        ),
    ]
}
