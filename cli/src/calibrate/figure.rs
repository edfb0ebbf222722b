//! Pictures of calibrations: points with their line, and signals over time.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use robot_model::calibrate::StaticGain;

use super::words::measured;

const WIDTH: u32 = 900;
const HEIGHT: u32 = 560;
const ROW: u32 = 190;
const HEAD: u32 = 36;
/// Samples drawn of a line's band.
const STEPS: u32 = 64;

const LINE: RGBColor = RGBColor(0, 90, 160);
const BAND: RGBColor = RGBColor(205, 222, 238);
const OVER: RGBColor = RGBColor(190, 60, 40);
const GRID: RGBColor = RGBColor(225, 225, 225);

/// A string takes whatever is drawn on it.
const DRAWN: &str = "drawing on a string does not fail";

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'b, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// A signal, and what is drawn over it.
pub(super) struct Curve {
    pub name: &'static str,
    pub values: Vec<f64>,
    pub over: Option<Vec<f64>>,
}

/// Torques over currents, with the line and the band that holds it with 95 %.
pub(super) fn line(found: &StaticGain, current: &[f64], torque: &[f64]) -> String {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, (WIDTH, HEIGHT)).into_drawing_area();
        root.fill(&WHITE).expect(DRAWN);
        let (head, body) = root.split_vertically(HEAD);
        heading(
            &head,
            &format!("over current, A: gain {}", measured(&found.gain, "N m/A")),
        );
        let across = shown(current.iter().copied());
        let at =
            |k: u32| across.start + (across.end - across.start) * f64::from(k) / f64::from(STEPS);
        let steps: Vec<(f64, _)> = (0..=STEPS).map(|k| (at(k), found.torque(at(k)))).collect();
        let ends = steps.iter().flat_map(|(_, torque)| torque.interval);
        let mut chart = chart(
            &body,
            across.clone(),
            shown(torque.iter().copied().chain(ends)),
            "torque, N m",
        );
        let low = steps.iter().map(|(i, torque)| (*i, torque.interval[0]));
        let high = steps
            .iter()
            .rev()
            .map(|(i, torque)| (*i, torque.interval[1]));
        let band: Vec<(f64, f64)> = low.chain(high).collect();
        let band = Polygon::new(band, BAND.filled());
        chart.draw_series(std::iter::once(band)).expect(DRAWN);
        let middle = steps.iter().map(|(i, torque)| (*i, torque.value));
        draw(&mut chart, middle, LINE);
        let points = current.iter().zip(torque);
        let points = points.map(|(i, torque)| Circle::new((*i, *torque), 3, OVER.filled()));
        chart.draw_series(points).expect(DRAWN);
        root.present().expect(DRAWN);
    }
    text
}

/// Signals below each other over the same time.
pub(super) fn curves(time: &[f64], curves: &[Curve]) -> String {
    let mut text = String::new();
    {
        let rows = u32::try_from(curves.len()).expect("few curves");
        let root =
            SVGBackend::with_string(&mut text, (WIDTH, HEAD + ROW * rows)).into_drawing_area();
        root.fill(&WHITE).expect(DRAWN);
        let (head, body) = root.split_vertically(HEAD);
        heading(&head, "over time, s");
        let across = time[0]..time[time.len() - 1];
        for (area, curve) in body.split_evenly((curves.len(), 1)).iter().zip(curves) {
            let all = curve.values.iter().chain(curve.over.iter().flatten());
            let mut chart = chart(area, across.clone(), shown(all.copied()), curve.name);
            let pairs = |values: &[f64]| -> Vec<(f64, f64)> {
                time.iter().copied().zip(values.iter().copied()).collect()
            };
            draw(&mut chart, pairs(&curve.values).into_iter(), LINE);
            if let Some(over) = &curve.over {
                draw(&mut chart, pairs(over).into_iter(), OVER);
            }
        }
        root.present().expect(DRAWN);
    }
    text
}

fn heading(area: &Area<'_>, title: &str) {
    let font = ("sans-serif", 16).into_font();
    area.draw(&Text::new(title, (12, 10), font)).expect(DRAWN);
}

fn chart<'a, 'b>(area: &'b Area<'a>, x: Range<f64>, y: Range<f64>, name: &str) -> Chart<'a, 'b> {
    let mut chart = ChartBuilder::on(area)
        .margin(4)
        .margin_right(14)
        .x_label_area_size(22)
        .y_label_area_size(64)
        .build_cartesian_2d(x, y)
        .expect(DRAWN);
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(BLACK.mix(0.5))
        .y_labels(5)
        .label_style(("sans-serif", 12).into_font())
        .y_desc(name)
        .draw()
        .expect(DRAWN);
    chart
}

fn draw(chart: &mut Chart<'_, '_>, points: impl Iterator<Item = (f64, f64)>, color: RGBColor) {
    let line = LineSeries::new(points, color.stroke_width(2));
    chart.draw_series(line).expect(DRAWN);
}

/// The values with some room.
fn shown(values: impl Iterator<Item = f64>) -> Range<f64> {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values.fold(start, |(low, high), x| (low.min(x), high.max(x)));
    let room = (0.08 * (high - low)).max(1e-9 * high.abs().max(1.0));
    low - room..high + room
}
