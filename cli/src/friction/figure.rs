//! The curve drawn: points with their deviations, and the law through them.

use std::ops::Range;

use plotters::prelude::*;
use robot_model_spec::model::JointKind;

use super::report::Found;
use crate::units::Units;

const SIZE: (u32, u32) = (840, 520);
/// Values of the law drawn on either side.
const SAMPLES: usize = 300;
/// Deviations that a bar shows on either side of its point.
const BAR: f64 = 2.0;

const LINE: RGBColor = RGBColor(190, 60, 40);
const POINT: RGBColor = RGBColor(0, 90, 160);
const GRID: RGBColor = RGBColor(225, 225, 225);

/// A string takes whatever is drawn on it.
const DRAWN: &str = "drawing on a string does not fail";

/// The picture as SVG.
pub(super) fn svg(found: &Found<'_>) -> String {
    let (curve, law) = (found.curve, found.law);
    let speeds = curve.points.iter().map(|point| point.speed);
    let low = speeds.clone().fold(0.0, f64::min);
    let high = speeds.fold(0.0, f64::max);
    // Nothing is said of a direction in which the joint never moved.
    let branch = |end: f64| -> Vec<(f64, f64)> {
        let at = |k: usize| end * (k as f64 + 1e-3) / SAMPLES as f64;
        let values = (0..=SAMPLES).map(|k| (at(k), law.torque(at(k))));
        if end == 0.0 {
            Vec::new()
        } else {
            values.collect()
        }
    };
    let branches = [branch(low), branch(high)];
    let bars = curve.points.iter().map(|point| {
        let [value, bar] = [point.torque.value, BAR * point.torque.std];
        (point.speed, [value - bar, value, value + bar])
    });
    let bars: Vec<(f64, [f64; 3])> = bars.collect();
    let torques = branches.iter().flatten().map(|(_, f)| *f);
    let torques = torques.chain(bars.iter().flat_map(|(_, bar)| *bar));
    let shown = roomy(torques.chain([0.0]));
    let units = Units::of(found.joint.kind);
    let what = match found.joint.kind {
        JointKind::Revolute => "torque",
        JointKind::Prismatic => "force",
    };
    let torque = format!("friction {what}, {}", units.torque);
    let speed = format!("speed, {}", units.velocity);
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE).expect(DRAWN);
        let mut chart = ChartBuilder::on(&root)
            .caption(
                format!("friction of {}", found.joint.name),
                ("sans-serif", 16),
            )
            .margin(10)
            .x_label_area_size(40)
            .y_label_area_size(64)
            .build_cartesian_2d(roomy([low, high].into_iter()), shown)
            .expect(DRAWN);
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(BLACK.mix(0.5))
            .x_desc(speed)
            .y_desc(torque)
            .label_style(("sans-serif", 12))
            .draw()
            .expect(DRAWN);
        for line in branches {
            let line = LineSeries::new(line, LINE.stroke_width(2));
            chart.draw_series(line).expect(DRAWN);
        }
        let lines = bars.iter().map(|(v, [from, _, to])| {
            PathElement::new(vec![(*v, *from), (*v, *to)], POINT.stroke_width(1))
        });
        chart.draw_series(lines).expect(DRAWN);
        let dots = bars
            .iter()
            .map(|(v, [_, f, _])| Circle::new((*v, *f), 3, POINT.filled()));
        chart.draw_series(dots).expect(DRAWN);
        root.present().expect(DRAWN);
    }
    text
}

/// The values with some room.
fn roomy(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    let room = (0.06 * (high - low)).max(1e-9 * high.abs().max(1.0));
    low - room..high + room
}
