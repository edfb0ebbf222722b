//! Figures as SVG: lines, dots and bars between axes, with a key.

use std::ops::Range;

use plotters::prelude::*;

const SIZE: (u32, u32) = (720, 440);
const GRID: RGBColor = RGBColor(225, 225, 225);
/// Told apart by those who do not see all colors (Okabe & Ito 2008).
const COLORS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(80, 80, 80),
];

/// A string takes whatever is drawn on it.
const DRAWN: &str = "drawing on a string does not fail";

/// How points of a series are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A line through them.
    Line,
    /// A dot at each.
    Dots,
    /// A bar from zero to each, beside those of other series at the same whole number.
    Bars,
}

/// Room of all bars at one number.
const BARS: f64 = 0.8;

/// Points that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// What they are, for the key.
    pub name: String,
    /// How they are drawn.
    pub mark: Mark,
    /// Where they are.
    pub points: Vec<(f64, f64)>,
}

/// One drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name of its file, without an extension.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// What stands along the axis to the right, with its unit.
    pub x: String,
    /// What stands along the axis upward, with its unit.
    pub y: String,
    /// What is drawn.
    pub series: Vec<Series>,
}

impl Figure {
    /// A figure without series.
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        x: impl Into<String>,
        y: impl Into<String>,
    ) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            x: x.into(),
            y: y.into(),
            series: Vec::new(),
        }
    }

    /// The figure with one series more.
    #[must_use]
    pub fn with(
        mut self,
        name: impl Into<String>,
        mark: Mark,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        self.series.push(Series {
            name: name.into(),
            mark,
            points: points.into_iter().collect(),
        });
        self
    }

    /// The drawing; points that are not finite are left out.
    #[must_use]
    pub fn svg(&self) -> String {
        let points = || self.series.iter().flat_map(Series::reaches);
        let (x, y) = (roomy(points().map(|p| p.0)), roomy(points().map(|p| p.1)));
        let mut text = String::new();
        {
            let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
            root.fill(&WHITE).expect(DRAWN);
            let mut chart = ChartBuilder::on(&root)
                .caption(&self.title, ("sans-serif", 16))
                .margin(10)
                .x_label_area_size(40)
                .y_label_area_size(64)
                .build_cartesian_2d(x, y)
                .expect(DRAWN);
            chart
                .configure_mesh()
                .light_line_style(TRANSPARENT)
                .bold_line_style(GRID)
                .axis_style(BLACK.mix(0.5))
                .x_desc(&self.x)
                .y_desc(&self.y)
                .label_style(("sans-serif", 12))
                .draw()
                .expect(DRAWN);
            let bars = self.series.iter().filter(|s| s.mark == Mark::Bars);
            let width = BARS / bars.count().max(1) as f64;
            let mut left = -0.5 * BARS;
            for (k, series) in self.series.iter().enumerate() {
                let color = COLORS[k % COLORS.len()];
                let points = finite(&series.points);
                let drawn = match series.mark {
                    Mark::Line => chart
                        .draw_series(LineSeries::new(points, color.stroke_width(2)))
                        .expect(DRAWN),
                    Mark::Dots => chart
                        .draw_series(points.map(|at| Circle::new(at, 2, color.filled())))
                        .expect(DRAWN),
                    Mark::Bars => {
                        let from = left;
                        left += width;
                        chart
                            .draw_series(points.map(|(x, y)| {
                                let ends = [(x + from, 0.0), (x + from + width, y)];
                                Rectangle::new(ends, color.filled())
                            }))
                            .expect(DRAWN)
                    }
                };
                drawn.label(&series.name).legend(move |(x, y)| {
                    Rectangle::new([(x, y - 1), (x + 14, y + 2)], color.filled())
                });
            }
            chart
                .configure_series_labels()
                .background_style(WHITE.mix(0.8))
                .border_style(GRID)
                .label_font(("sans-serif", 12))
                .draw()
                .expect(DRAWN);
            root.present().expect(DRAWN);
        }
        text
    }
}

impl Series {
    /// Points that have to be in the figure.
    fn reaches(&self) -> impl Iterator<Item = (f64, f64)> {
        let is_bars = self.mark == Mark::Bars;
        finite(&self.points).flat_map(move |(x, y)| {
            if is_bars {
                vec![(x - 0.5, 0.0), (x + 0.5, y)]
            } else {
                vec![(x, y)]
            }
        })
    }
}

fn finite(points: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> {
    let points = points.iter().copied();
    points.filter(|(x, y)| x.is_finite() && y.is_finite())
}

/// The values with some room.
fn roomy(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    if low > high {
        return 0.0..1.0;
    }
    let room = (0.05 * (high - low)).max(1e-9 * high.abs().max(1.0));
    low - room..high + room
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_says_what_it_shows_and_leaves_out_what_is_no_number() {
        let figure = Figure::new("fall", "a fall", "time, s", "angle, rad")
            .with("measured", Mark::Dots, [(0.0, 1.0), (1.0, f64::NAN)])
            .with("simulated", Mark::Line, [(0.0, 1.0), (1.0, 0.5)]);
        let svg = figure.svg();
        for word in ["a fall", "time, s", "angle, rad", "measured", "simulated"] {
            assert!(svg.contains(word), "{word}");
        }
        assert_eq!(svg.matches("<circle").count(), 1, "{svg}");
        assert!(!svg.contains("NaN"));
    }

    #[test]
    fn bars_stand_side_by_side_from_zero() {
        let figure = Figure::new("parts", "parts", "joint", "torque")
            .with("one", Mark::Bars, [(1.0, 2.0), (2.0, 1.0)])
            .with("other", Mark::Bars, [(1.0, 1.0), (2.0, 2.0)]);
        let svg = figure.svg();
        let bars: Vec<[f64; 2]> = svg
            .lines()
            .filter(|line| line.starts_with("<rect") && line.contains("fill=\"#0072B2\""))
            .map(|line| {
                ["x=\"", "height=\""].map(|name| {
                    let value = line
                        .split(name)
                        .nth(1)
                        .and_then(|rest| rest.split('"').next());
                    value
                        .and_then(|value| value.parse().ok())
                        .expect("a number")
                })
            })
            .collect();
        // Two of the first series, and its sign in the key.
        assert_eq!(bars.len(), 3, "{svg}");
        assert!(bars[1][0] > bars[0][0], "{bars:?}");
        assert!((bars[0][1] / bars[1][1] - 2.0).abs() < 0.05, "{bars:?}");
    }
}
