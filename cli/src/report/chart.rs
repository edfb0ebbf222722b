//! Figures of a report: dots and lines between axes, in the colors of the page.

use std::fmt::Write;
use std::ops::Range;

use plotters::prelude::*;

use super::axis::Axis;
use super::page::escaped;
use crate::output::significant;

const SIZE: (u32, u32) = (380, 284);

/// Room above a drawing, for the letter by which its caption calls it.
const HEAD: u32 = 22;

/// Room behind a drawing, for half of a number at the end of its axis.
const END: u32 = 16;

/// Letters at axes.
pub(super) const TEXT: (&str, i32) = ("sans-serif", 15);

/// Numbers at axes, which are smaller than what the axes are of.
const NUMBERS: (&str, i32) = ("sans-serif", 14);

/// Lines of what was measured and of a model: a dark thin one over a light wide one, so that both are seen where they are the same.
const WIDE: u32 = 4;
const THIN: u32 = 1;

/// A string takes whatever is drawn on it.
pub(super) const DRAWN: &str = "drawing on a string does not fail";

/// Stand-ins for colors that the style of the page has.
pub(super) const GRID: RGBColor = RGBColor(1, 2, 3);
pub(super) const INK: RGBColor = RGBColor(4, 5, 6);
const ZERO: RGBColor = RGBColor(16, 17, 18);

/// What is drawn in which color.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ink {
    Measured,
    Before,
    After,
}

impl Ink {
    const ALL: [Self; 3] = [Self::Measured, Self::Before, Self::After];

    pub(super) const fn stand_in(self) -> RGBColor {
        match self {
            Self::Measured => RGBColor(7, 8, 9),
            Self::Before => RGBColor(10, 11, 12),
            Self::After => RGBColor(13, 14, 15),
        }
    }

    const fn style(self) -> &'static str {
        match self {
            Self::Measured => "var(--measured)",
            Self::Before => "var(--before)",
            Self::After => "var(--after)",
        }
    }
}

/// Points that belong together.
#[derive(Debug)]
pub(crate) struct Series {
    pub(super) color: Ink,
    pub(super) is_line: bool,
    pub(super) points: Vec<(f64, f64)>,
}

/// One drawing.
#[derive(Debug)]
pub(crate) struct Chart<'a> {
    /// What it says, for those who do not see it.
    pub(super) label: &'a str,
    /// What its caption calls it, where it stands beside others.
    pub(super) letter: Option<char>,
    pub(super) x: &'a str,
    pub(super) y: &'a str,
    /// Whether both axes are those of powers of ten; points are then positive.
    pub(super) is_logarithmic: bool,
    pub(super) series: Vec<Series>,
}

impl Chart<'_> {
    /// The drawing as SVG inside a page.
    pub(super) fn svg(&self) -> String {
        let place = |value: f64| {
            if self.is_logarithmic {
                value.log10()
            } else {
                value
            }
        };
        let points = || {
            let all = self.series.iter().flat_map(|series| &series.points);
            all.map(|(x, y)| (place(*x), place(*y)))
        };
        let (x, y) = (roomy(points().map(|p| p.0)), roomy(points().map(|p| p.1)));
        let (x_span, y_span) = (x.end - x.start, y.end - y.start);
        let axis = if self.is_logarithmic {
            Axis::of_powers
        } else {
            Axis::linear
        };
        let mut text = String::new();
        {
            let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
            let mut chart = ChartBuilder::on(&root)
                .margin(6)
                .margin_top(HEAD)
                .margin_right(END)
                .x_label_area_size(42)
                .y_label_area_size(66)
                .build_cartesian_2d(axis(x.clone()), axis(y.clone()))
                .expect(DRAWN);
            let tick = |value: f64, span: f64| {
                if self.is_logarithmic {
                    let digits = significant(10.0_f64.powf(value), 2);
                    tick(digits.parse().unwrap_or_default())
                } else if value.abs() < ROUNDING * span {
                    tick(0.0)
                } else {
                    tick(value)
                }
            };
            chart
                .configure_mesh()
                .light_line_style(TRANSPARENT)
                .bold_line_style(GRID)
                .axis_style(INK)
                .x_label_formatter(&|value| tick(*value, x_span))
                .y_label_formatter(&|value| tick(*value, y_span))
                .x_desc(self.x)
                .y_desc(self.y)
                .label_style(NUMBERS.into_font().color(&INK))
                .axis_desc_style(TEXT.into_font().color(&INK))
                .draw()
                .expect(DRAWN);
            if let Some(letter) = self.letter {
                let bold = TEXT.into_font().style(FontStyle::Bold).color(&INK);
                let letter = Text::new(format!("({letter})"), (6, 3), bold);
                root.draw(&letter).expect(DRAWN);
            }
            for line in self.zeros(&x, &y) {
                let line = LineSeries::new(line, ZERO.stroke_width(1));
                chart.draw_series(line).expect(DRAWN);
            }
            for series in &self.series {
                let color = series.color.stand_in();
                let points = series.points.iter().map(|(x, y)| (place(*x), place(*y)));
                if series.is_line {
                    let width = if series.color == Ink::Measured {
                        WIDE
                    } else {
                        THIN
                    };
                    let line = LineSeries::new(points, color.stroke_width(width));
                    chart.draw_series(line).expect(DRAWN);
                } else {
                    let dots = points.map(|point| Circle::new(point, 1, color.filled()));
                    chart.draw_series(dots).expect(DRAWN);
                }
            }
            root.present().expect(DRAWN);
        }
        on_page(&text, self.label, SIZE)
    }

    /// Lines where one of both axes is at zero, within the drawing.
    fn zeros(&self, x: &Range<f64>, y: &Range<f64>) -> Vec<[(f64, f64); 2]> {
        // Beyond the room at both ends, which time that begins at zero has, too.
        let has_zero = |axis: &Range<f64>| {
            let edge = ROOM * (axis.end - axis.start);
            axis.start + edge < 0.0 && 0.0 < axis.end - edge
        };
        let across =
            (!self.is_logarithmic && has_zero(y)).then_some([(x.start, 0.0), (x.end, 0.0)]);
        let up = (!self.is_logarithmic && has_zero(x)).then_some([(0.0, y.start), (0.0, y.end)]);
        across.into_iter().chain(up).collect()
    }
}

/// A drawing in the page's colors, with a label, and as wide as it is drawn where there is room, so that letters of all drawings are alike; dots of one color are one path, which is a tenth as long.
pub(super) fn on_page(svg: &str, label: &str, (width, height): (u32, u32)) -> String {
    let mut out = String::with_capacity(svg.len() / 4);
    let mut dots: Option<(&str, String)> = None;
    for line in svg.lines() {
        let dot = line.starts_with("<circle").then(|| dot(line)).flatten();
        if let Some((color, at)) = dot {
            match &mut dots {
                Some((same, path)) if *same == color => path.push_str(&at),
                other => {
                    out.push_str(&path_of(other.take()));
                    *other = Some((color, at));
                }
            }
            continue;
        }
        out.push_str(&path_of(dots.take()));
        if line.starts_with("<svg") {
            writeln!(
                out,
                "<svg role=\"img\" aria-label=\"{}\" viewBox=\"0 0 {width} {height}\" style=\"--width: {width}px\">",
                escaped(label)
            )
            .expect("a string takes all");
        } else {
            out.push_str(line);
            out.push('\n');
        }
    }
    out.push_str(&path_of(dots.take()));
    let hex = |color: RGBColor| format!("#{:02X}{:02X}{:02X}", color.0, color.1, color.2);
    let mut out = out
        .replace(&hex(GRID), "var(--grid)")
        .replace(&hex(INK), "currentColor")
        .replace(&hex(ZERO), "var(--soft)");
    for color in Ink::ALL {
        out = out.replace(&hex(color.stand_in()), color.style());
    }
    out
}

/// Color and path of a dot.
fn dot(line: &str) -> Option<(&str, String)> {
    let attribute = |name: &str| {
        let start = line.find(&format!(" {name}=\""))? + name.len() + 3;
        let length = line[start..].find('"')?;
        Some(&line[start..start + length])
    };
    let (x, y) = (attribute("cx")?, attribute("cy")?);
    Some((attribute("fill")?, format!("M{x} {y}h0")))
}

fn path_of(dots: Option<(&str, String)>) -> String {
    dots.map_or_else(String::new, |(color, path)| {
        format!(
            "<path d=\"{path}\" stroke=\"{color}\" stroke-width=\"2.4\" stroke-linecap=\"round\" stroke-opacity=\"0.6\" fill=\"none\"/>\n"
        )
    })
}

/// Ticks below this share of an axis are zero, and off it by rounding.
const ROUNDING: f64 = 1e-9;

/// A number at an axis, with a minus sign where print has one.
pub(super) fn tick(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    let text = if value != 0.0 && (value.abs() < 1e-4 || value.abs() >= 1e6) {
        format!("{value:.1e}")
    } else if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    };
    text.replace('-', "\u{2212}")
}

/// Room at each end of an axis, as a share of what it shows.
const ROOM: f64 = 0.05;

/// The values with some room.
fn roomy(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    if low > high {
        return 0.0..1.0;
    }
    let room = (ROOM * (high - low)).max(1e-9 * high.abs().max(1.0));
    low - room..high + room
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dots_of_a_color_are_one_path_in_the_pages_colors() {
        let series = |color, is_line| Series {
            color,
            is_line,
            points: (0..50).map(|k| (f64::from(k), f64::from(k * k))).collect(),
        };
        let chart = Chart {
            label: "a \"law\"",
            letter: None,
            x: "x",
            y: "y",
            is_logarithmic: false,
            series: vec![series(Ink::Before, false), series(Ink::After, true)],
        };
        let svg = chart.svg();
        assert_eq!(svg.matches("<path").count(), 1, "{svg}");
        assert_eq!(svg.matches("h0").count(), 50);
        assert!(svg.contains("var(--before)") && svg.contains("var(--after)"));
        assert!(svg.contains("aria-label=\"a &quot;law&quot;\""));
        assert!(
            !svg.contains("http") && !svg.contains("<circle") && !svg.contains("#0"),
            "{svg}"
        );
    }

    /// A grid from -0.3 to 0.3 in steps of 0.1 has a zero that is none; decades have ticks between them.
    #[test]
    fn ticks_are_numbers_that_one_would_write() {
        let svg = |is_logarithmic: bool, points: Vec<(f64, f64)>| {
            let series = vec![Series {
                color: Ink::After,
                is_line: true,
                points,
            }];
            let chart = Chart {
                label: "ticks",
                letter: None,
                x: "x",
                y: "y",
                is_logarithmic,
                series,
            };
            chart.svg()
        };
        let linear = svg(false, vec![(-0.3, -0.3), (0.3, 0.3)]);
        assert!(!linear.contains("e\u{2212}1"), "{linear}");
        assert!(
            linear.contains("\u{2212}0.2") && !linear.contains("-0.2"),
            "{linear}"
        );
        let logarithmic = svg(true, vec![(0.25, 0.009), (100.0, 0.02)]);
        let ticks = logarithmic
            .lines()
            .filter(|line| line.trim().starts_with("0.0"));
        let ticks: Vec<&str> = ticks.map(str::trim).collect();
        let mut apart = ticks.clone();
        apart.dedup();
        assert!(ticks.len() > 2 && ticks == apart, "{ticks:?}");
    }

    #[test]
    fn a_chart_of_nothing_is_empty_axes() {
        let chart = Chart {
            label: "nothing",
            letter: None,
            x: "x",
            y: "y",
            is_logarithmic: false,
            series: Vec::new(),
        };
        assert!(chart.svg().contains("</svg>"));
    }

    /// A zero line is drawn where an axis passes zero, and not at its edge; the letter is the first text.
    #[test]
    fn drawings_have_zero_lines_and_a_letter() {
        let svg = |is_logarithmic: bool, points: Vec<(f64, f64)>| {
            let series = vec![Series {
                color: Ink::Measured,
                is_line: true,
                points,
            }];
            let chart = Chart {
                label: "zeros",
                letter: Some('b'),
                x: "x",
                y: "y",
                is_logarithmic,
                series,
            };
            chart.svg()
        };
        let zeros = |svg: &str| {
            let lines = svg.lines().filter(|line| line.contains("<poly"));
            lines.filter(|line| line.contains("var(--soft)")).count()
        };
        let around = svg(false, vec![(-1.0, -2.0), (1.0, 2.0)]);
        assert_eq!(zeros(&around), 2, "{around}");
        assert!(around.contains("(b)"), "{around}");
        assert!(around.contains("var(--measured)"), "{around}");
        let of_time = svg(false, vec![(0.0, -2.0), (9.0, 2.0)]);
        assert_eq!(zeros(&of_time), 1, "{of_time}");
        let apart = svg(false, vec![(5.0, 1.0), (9.0, 2.0)]);
        assert_eq!(zeros(&apart), 0, "{apart}");
        assert_eq!(zeros(&svg(true, vec![(0.1, 0.1), (9.0, 9.0)])), 0);
    }
}
