//! The motion drawn: a row a joint, with position, velocity and acceleration beside each other over one period, and their limits.

use plotters::coord::Shift;
use plotters::prelude::*;
use robot_model::excite::{Design, Request};

const WIDTH: u32 = 1080;
const ROW: u32 = 112;
const HEAD: u32 = 56;
/// Samples drawn of a period: as many as a panel has points across, and then some.
const SAMPLES: usize = 400;

const LINE: RGBColor = RGBColor(0, 90, 160);
const LIMIT: RGBColor = RGBColor(190, 60, 40);
const GRID: RGBColor = RGBColor(225, 225, 225);

/// A string takes whatever is drawn on it.
const DRAWN: &str = "drawing on a string does not fail";

/// An area of the picture.
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A signal of one joint, with what it may be.
struct Panel {
    values: Vec<f64>,
    limits: [f64; 2],
}

/// The picture as SVG.
pub(super) fn svg(request: &Request, design: &Design) -> String {
    let motion = &design.motion;
    let time: Vec<f64> = (0..=SAMPLES)
        .map(|k| motion.period * k as f64 / SAMPLES as f64)
        .collect();
    let kinematics = motion.motion(&time);
    let joints = request.joints.len();
    let mut text = String::new();
    {
        let height = HEAD + ROW * u32::try_from(joints).expect("an arm has few joints");
        let root = SVGBackend::with_string(&mut text, (WIDTH, height)).into_drawing_area();
        root.fill(&WHITE).expect(DRAWN);
        let (head, body) = root.split_vertically(HEAD);
        heading(&head, request, design);
        let rows = body.split_evenly((joints, 3));
        for (joint, row) in rows.chunks_exact(3).enumerate() {
            let limits = &request.limits;
            let both_ways = |limit: f64| [-limit, limit];
            let (low, high) = limits.position[joint];
            let panels = [
                (&kinematics.q, [low, high]),
                (&kinematics.dq, both_ways(limits.velocity[joint])),
                (&kinematics.ddq, both_ways(limits.acceleration[joint])),
            ];
            for (k, (area, (values, limits))) in row.iter().zip(panels).enumerate() {
                let panel = Panel {
                    values: values[joint].clone(),
                    limits,
                };
                let name = if k == 0 {
                    request.joints[joint].as_str()
                } else {
                    ""
                };
                panel.draw(area, &time, name);
            }
        }
        root.present().expect(DRAWN);
    }
    text
}

fn heading(area: &Area<'_>, request: &Request, design: &Design) {
    let font = |size: u32| ("sans-serif", size).into_font();
    let quality = &design.quality;
    let title = format!(
        "{} harmonics of {} s over time in s; condition number {:.1}, {:.1} with columns of unit length",
        request.harmonics, request.period, quality.condition, quality.condition_of_unit_columns,
    );
    area.draw(&Text::new(title, (12, 8), font(16)))
        .expect(DRAWN);
    let third = i32::try_from(WIDTH / 3).expect("a narrow picture");
    let heads = [
        "position, rad or m",
        "velocity, rad/s or m/s",
        "acceleration, rad/s² or m/s²",
    ];
    for (k, head) in (0..).zip(heads) {
        let at = (k * third + 64, 34);
        area.draw(&Text::new(head, at, font(14))).expect(DRAWN);
    }
}

impl Panel {
    fn draw(&self, area: &Area<'_>, time: &[f64], name: &str) {
        let shown = self.shown();
        let end = time.last().copied().unwrap_or(1.0);
        let mut chart = ChartBuilder::on(area)
            .margin(4)
            .margin_right(14)
            .x_label_area_size(20)
            .y_label_area_size(56)
            .build_cartesian_2d(0.0..end, shown.start..shown.end)
            .expect(DRAWN);
        let label = ("sans-serif", 11).into_font();
        chart
            .configure_mesh()
            .disable_x_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(BLACK.mix(0.5))
            .x_labels(6)
            .y_labels(5)
            .label_style(label)
            .y_desc(name)
            .draw()
            .expect(DRAWN);
        for limit in self.limits.into_iter().filter(|limit| limit.is_finite()) {
            let line = [(0.0, limit), (end, limit)];
            chart
                .draw_series(DashedLineSeries::new(line, 5, 4, LIMIT.stroke_width(1)))
                .expect(DRAWN);
        }
        let line = time.iter().copied().zip(self.values.iter().copied());
        chart
            .draw_series(LineSeries::new(line, LINE.stroke_width(2)))
            .expect(DRAWN);
    }

    /// The values and the limits, with some room.
    fn shown(&self) -> std::ops::Range<f64> {
        let finite = self.limits.into_iter().filter(|limit| limit.is_finite());
        let all = self.values.iter().copied().chain(finite);
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        let room = (0.08 * (high - low)).max(1e-9 * high.abs().max(1.0));
        low - room..high + room
    }
}
