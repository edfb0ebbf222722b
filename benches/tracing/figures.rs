//! The study drawn: detection of every effect over its size, and the methods beside each other.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::comparison::{Group, Method, methods};
use crate::judge::{Mark, Row};
use crate::table::{kinds, sizes};

/// Panels side by side, their size, and the room above them for the legend.
const ACROSS: usize = 6;
const PANEL: (u32, u32) = (190, 150);
const WIDE: (u32, u32) = (330, 260);
const HEAD: u32 = 40;

/// Room of a panel around its axes: left, top, right, bottom.
const ROOM: [i32; 4] = [40, 24, 10, 22];

const RIGHT: RGBColor = RGBColor(0, 90, 160);
const NEAR: RGBColor = RGBColor(120, 175, 220);
const MATTERS: RGBColor = RGBColor(170, 170, 170);
const GRID: RGBColor = RGBColor(225, 225, 225);
const METHODS: [RGBColor; 5] = [
    RIGHT,
    RGBColor(190, 60, 40),
    RGBColor(220, 150, 30),
    RGBColor(90, 140, 70),
    RGBColor(130, 80, 160),
];

/// A string takes whatever is drawn on it.
const DRAWN: &str = "drawing on a string does not fail";

/// An area of the picture.
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Percentages over a few places.
struct Curve {
    color: RGBColor,
    /// Nothing where nothing was tried.
    values: Vec<Option<f64>>,
    /// Whether places are neighbors; of those that are not only points are drawn.
    is_line: bool,
}

struct Panel {
    title: String,
    ticks: Vec<String>,
    curves: Vec<Curve>,
}

/// A panel for every effect: how often it matters, is named right, or has a neighboring name, over its size.
pub fn detection(rows: &[Row]) -> String {
    let sizes = sizes(rows);
    let kinds = kinds(rows);
    let panels = kinds.iter().filter(|kind| **kind != "nothing").map(|kind| {
        let share = |is_so: &dyn Fn(&Row) -> bool| -> Vec<Option<f64>> {
            let of_size = |size: &f64| {
                let here = || {
                    rows.iter()
                        .filter(|row| row.kind == *kind && row.is_of(*size))
                };
                let (all, hits) = (here().count(), here().filter(|row| is_so(row)).count());
                (all > 0).then(|| 100.0 * hits as f64 / all as f64)
            };
            sizes.iter().map(of_size).collect()
        };
        let curve = |color: RGBColor, is_so: &dyn Fn(&Row) -> bool| Curve {
            color,
            values: share(is_so),
            is_line: true,
        };
        Panel {
            title: (*kind).to_owned(),
            ticks: ticks(&sizes),
            curves: vec![
                curve(MATTERS, &|row| row.is_material),
                curve(NEAR, &|row| matches!(row.mark, Mark::Exact | Mark::Near)),
                curve(RIGHT, &|row| row.mark == Mark::Exact),
            ],
        }
    });
    let legend = [
        ("right name and joint", RIGHT),
        ("that or a neighboring law", NEAR),
        ("matters", MATTERS),
    ];
    let legend = legend.map(|(name, color)| (name.to_owned(), color));
    picture(&panels.collect::<Vec<_>>(), ACROSS, PANEL, &legend)
}

/// The methods beside each other; `None` where no baseline was asked.
pub fn comparison(rows: &[Row]) -> Option<String> {
    let methods = methods(rows);
    if methods.is_empty() {
        return None;
    }
    assert_eq!(methods.len(), METHODS.len(), "a color for every method");
    let sizes = sizes(rows);
    let over_sizes = |title: &str, marks: &[Mark]| {
        let curves = methods.iter().zip(METHODS).map(|(method, color)| {
            let of_size = |size: &f64| method.percent(Group::Matters(*size), marks);
            Curve {
                color,
                values: sizes.iter().map(of_size).collect(),
                is_line: true,
            }
        });
        Panel {
            title: title.to_owned(),
            ticks: ticks(&sizes),
            curves: curves.collect(),
        }
    };
    let groups = [
        (Group::AnyMatters, "effects"),
        (Group::Nothing, "nothing"),
        (Group::Unknown, "unknown law"),
    ];
    let wrong = |(method, color): (&Method, RGBColor)| {
        let of_group = |(group, _): &(Group, &str)| method.percent(*group, &[Mark::Wrong]);
        Curve {
            color,
            values: groups.iter().map(of_group).collect(),
            is_line: false,
        }
    };
    let panels = [
        over_sizes("right name and joint, where it matters", &[Mark::Exact]),
        over_sizes(
            "that or a neighboring law, where it matters",
            &[Mark::Exact, Mark::Near],
        ),
        Panel {
            title: "wrong name, by what is missing".to_owned(),
            ticks: groups.iter().map(|(_, name)| (*name).to_owned()).collect(),
            curves: methods.iter().zip(METHODS).map(wrong).collect(),
        },
    ];
    let legend = methods.iter().zip(METHODS);
    let legend: Vec<(String, RGBColor)> = legend
        .map(|(method, color)| (method.name.clone(), color))
        .collect();
    Some(picture(&panels, panels.len(), WIDE, &legend))
}

fn ticks(sizes: &[f64]) -> Vec<String> {
    let tick = |size: &f64| format!("{} %", (1e4 * size).round() / 1e2);
    sizes.iter().map(tick).collect()
}

/// Panels in rows below a legend.
fn picture(
    panels: &[Panel],
    across: usize,
    (width, height): (u32, u32),
    legend: &[(String, RGBColor)],
) -> String {
    let count = |n: usize| u32::try_from(n).expect("a picture has few panels");
    let rows = panels.len().div_ceil(across).max(1);
    let size = (count(across) * width, HEAD + count(rows) * height);
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE).expect(DRAWN);
        let (head, body) = root.split_vertically(HEAD);
        let mut left = ROOM[0];
        for (name, color) in legend {
            let line = PathElement::new([(left, 18), (left + 22, 18)], color.stroke_width(2));
            head.draw(&line).expect(DRAWN);
            let at = (left + 28, 11);
            head.draw(&Text::new(name.clone(), at, ("sans-serif", 16)))
                .expect(DRAWN);
            // Letters are about this wide.
            left += 52 + 7 * i32::try_from(name.len()).expect("a short name");
        }
        for (panel, area) in panels.iter().zip(body.split_evenly((rows, across))) {
            panel.draw(&area);
        }
        root.present().expect(DRAWN);
    }
    text
}

impl Panel {
    fn draw(&self, area: &Area<'_>) {
        let (width, height) = area.dim_in_pixel();
        let pixels = |n: u32| i32::try_from(n).expect("a small picture");
        let [left, top, right, bottom] = ROOM;
        let (across, down) = (pixels(width) - left - right, pixels(height) - top - bottom);
        let y = |percent: i32| top + down - down * percent / 100;
        let places = i32::try_from(self.ticks.len()).expect("few sizes");
        let x = |place: i32| left + across * (2 * place + 1) / (2 * places.max(1));
        let small = ("sans-serif", 12);
        area.draw(&Text::new(
            self.title.clone(),
            (left, 6),
            ("sans-serif", 14),
        ))
        .expect(DRAWN);
        for percent in [0, 50, 100] {
            let line = [(left, y(percent)), (left + across, y(percent))];
            area.draw(&PathElement::new(line, GRID.stroke_width(1)))
                .expect(DRAWN);
            let at = (6, y(percent) - 5);
            area.draw(&Text::new(format!("{percent:>3} %"), at, small))
                .expect(DRAWN);
        }
        for (place, tick) in (0..).zip(&self.ticks) {
            // Half of its letters to the left.
            let half = 5 * i32::try_from(tick.len()).expect("a short tick") / 2;
            let at = (x(place) - half, top + down + 6);
            area.draw(&Text::new(tick.clone(), at, small)).expect(DRAWN);
        }
        let count = i32::try_from(self.curves.len()).expect("few curves");
        for (number, curve) in (0..).zip(&self.curves) {
            // Points that are no line stand beside each other.
            let aside = if curve.is_line {
                0
            } else {
                8 * (2 * number + 1 - count) / 2
            };
            let places = (0..).zip(&curve.values);
            let points: Vec<(i32, i32)> = places
                .filter_map(|(place, value)| {
                    let percent = (*value)?;
                    // Whole percents, between 0 and 100.
                    let whole = (0..=100).find(|whole| f64::from(*whole) + 0.5 > percent)?;
                    Some((x(place) + aside, y(whole)))
                })
                .collect();
            if curve.is_line {
                let line = PathElement::new(points.clone(), curve.color.stroke_width(2));
                area.draw(&line).expect(DRAWN);
            }
            for point in points {
                area.draw(&Circle::new(point, 3, curve.color.filled()))
                    .expect(DRAWN);
            }
        }
    }
}
