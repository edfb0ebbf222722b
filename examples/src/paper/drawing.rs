//! A figure as SVG: its key stands below the axes, where it covers nothing.

use std::ops::Range;

use plotters::coord::ranged1d::ValueFormatter;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use super::figure::{Figure, Mark, Series};
use super::looks::{Shape, quoted};

/// The drawing has whole numbers for places: so many of them to a pixel.
const FINE: u32 = 10;
const WIDTH: u32 = 720 * FINE;
/// Of the title and the axes.
const HEIGHT: u32 = 420 * FINE;
/// A line of the key.
const LINE: u32 = 18 * FINE;
/// Where the key begins and ends, and the swatch before a name.
const EDGE: u32 = 64 * FINE;
const SWATCH: u32 = 44 * FINE;
/// What is drawn of a series there.
const SAMPLE: u32 = 36 * FINE;
/// A letter of the key is so wide, or less.
const LETTER: u32 = 7 * FINE;
const TITLE: (&str, u32) = ("sans-serif", 16 * FINE);
const SMALL: (&str, u32) = ("sans-serif", 12 * FINE);
const DOT: u32 = 2 * FINE;
/// Of dots that are no disks.
const BIG: u32 = 3 * FINE;

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
/// How much of what lies below a broad line, a bar or a band hides.
const PALE: f64 = 0.3;
/// Half the width of a box or a bar, as a share of the way from one to the next.
const HALF: f64 = 0.3;

/// A string takes whatever is drawn on it.
const DRAWN: &str = "drawing on a string does not fail";

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

impl Figure {
    /// How many parts of the drawing are of a series, by its place: lines, dots, bars, areas with its color, beside that of the key.
    #[must_use]
    pub fn parts_of(&self, svg: &str, place: usize) -> usize {
        let (mark, in_key) = match self.series[place].mark {
            Mark::Line | Mark::Broad => ("<polyline", 1),
            Mark::Boxes => ("<polyline", 0),
            Mark::Dots => (Shape::of(self.order(place)).element(), 1),
            Mark::Bars => ("<rect", 1),
            Mark::Band => ("<polygon", 0),
        };
        let color = quoted(COLORS[place % COLORS.len()]);
        let parts = svg.split('<').map(|part| format!("<{part}"));
        let own = parts.filter(|part| part.starts_with(mark) && part.contains(&color));
        own.count().saturating_sub(in_key)
    }

    /// The drawing; points that are not finite are left out.
    #[must_use]
    pub fn svg(&self) -> String {
        let key = places(&self.series);
        let lines = key.last().map_or(0, |(_, line)| line + 1);
        let size = (WIDTH, HEIGHT + LINE * lines + LINE / 2);
        let mut text = String::new();
        {
            let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
            root.fill(&WHITE).expect(DRAWN);
            let (axes, below) = root.split_vertically(HEIGHT);
            self.axes(&axes);
            for (k, ((x, line), color)) in key.into_iter().zip(colors()).enumerate() {
                let at = [x, line * LINE + LINE / 2];
                entry(&below, &self.series[k], at, color, self.order(k));
            }
            root.present().expect(DRAWN);
        }
        let colors: Vec<RGBColor> = colors().take(self.series.len()).collect();
        let text = self.dashed(&text, &colors);
        // The page has it in pixels; inside, places stay as fine as they are drawn.
        let [fine, own] = [FINE, 1].map(|fine| {
            let (width, height) = (size.0 * fine / FINE, size.1 * fine / FINE);
            format!(r#"width="{width}" height="{height}""#)
        });
        text.replacen(&fine, &own, 1)
    }

    fn axes(&self, area: &Area<'_>) {
        let (x, y) = self.ranges();
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, TITLE)
            .margin(10 * FINE)
            .x_label_area_size(40 * FINE)
            .y_label_area_size(EDGE)
            .build_cartesian_2d(x, y)
            .expect(DRAWN);
        let bars = self.series.iter().filter(|one| one.mark == Mark::Bars);
        let bars: Vec<&Series> = bars.collect();
        // Bars are counted, and nothing between them has a number.
        let tick = |x: &f64| match (bars.is_empty(), x.fract().abs() < 1e-9) {
            (true, _) => RangedCoordf64::format(x),
            (false, true) => format!("{x:.0}"),
            (false, false) => String::new(),
        };
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID.stroke_width(FINE))
            .axis_style(BLACK.mix(0.5).stroke_width(FINE))
            .set_all_tick_mark_size(5 * FINE)
            .x_desc(&self.x)
            .y_desc(&self.y)
            .x_label_formatter(&tick)
            .label_style(SMALL)
            .draw()
            .expect(DRAWN);
        for (k, (series, color)) in self.series.iter().zip(colors()).enumerate() {
            draw(&mut chart, series, color, [self.order(k), bars.len()]);
        }
    }

    /// Of both axes: all points with some room; bars begin at zero and have a width, as boxes do.
    fn ranges(&self) -> (Range<f64>, Range<f64>) {
        let points = || self.series.iter().flat_map(|one| finite(&one.points));
        let sides = self.series.iter().flat_map(|one| match one.mark {
            Mark::Bars | Mark::Boxes => vec![0.5 * step(one), -0.5 * step(one)],
            _ => Vec::new(),
        });
        let side = sides.fold(0.0, f64::max);
        let has_bars = self.series.iter().any(|one| one.mark == Mark::Bars);
        let ground = has_bars.then_some(0.0);
        (
            roomy(points().flat_map(|(x, _)| [x - side, x + side])),
            roomy(points().map(|(_, y)| y).chain(ground)),
        )
    }
}

fn colors() -> impl Iterator<Item = RGBColor> {
    COLORS.into_iter().cycle()
}

/// Where the name of each series stands in the key: its distance from the left, and its line.
fn places(series: &[Series]) -> Vec<(u32, u32)> {
    let (mut x, mut line) = (EDGE, 0);
    let place = |one: &Series| {
        let letters = u32::try_from(one.name.chars().count()).unwrap_or(u32::MAX / LETTER / 2);
        let width = SWATCH + LETTER * letters + SWATCH / 2;
        if x > EDGE && x + width > WIDTH {
            (x, line) = (EDGE, line + 1);
        }
        let own = (x, line);
        x += width;
        own
    };
    series.iter().map(place).collect()
}

/// The name of a series, behind what it looks like; `order` of its kind are drawn before it.
fn entry(area: &Area<'_>, series: &Series, at: [u32; 2], color: RGBColor, order: usize) {
    let [x, y] = at.map(|place| i32::try_from(place).unwrap_or(i32::MAX));
    let px = FINE.cast_signed();
    let right = x + SAMPLE.cast_signed();
    let middle = x + (right - x) / 2;
    let swatch = |share: f64| {
        let corners = [(x, y - 4 * px), (right, y + 4 * px)];
        Rectangle::new(corners, color.mix(share).filled())
    };
    let line = |style: ShapeStyle| PathElement::new(vec![(x, y), (right, y)], style);
    match series.mark {
        Mark::Line => area.draw(&line(color.stroke_width(2 * FINE))),
        Mark::Broad => area.draw(&line(color.mix(PALE).stroke_width(7 * FINE))),
        Mark::Bars => area.draw(&swatch(1.0)),
        Mark::Band | Mark::Boxes => area.draw(&swatch(PALE)),
        Mark::Dots => match Shape::of(order) {
            Shape::Disk => area.draw(&Circle::new((middle, y), DOT, color.filled())),
            Shape::Triangle => area.draw(&TriangleMarker::new((middle, y), BIG, color.filled())),
            Shape::Ring => area.draw(&Circle::new((middle, y), BIG, color.stroke_width(FINE))),
        },
    }
    .expect(DRAWN);
    if series.mark == Mark::Bars {
        let step = (right - x) / (i32::try_from(order).unwrap_or(i32::MAX - 1) + 1);
        for stripe in (1..).take(order) {
            let x = x + stripe * step;
            let ends = vec![(x, y - 4 * px), (x, y + 4 * px)];
            area.draw(&PathElement::new(ends, WHITE.stroke_width(FINE)))
                .expect(DRAWN);
        }
    }
    let name = Text::new(series.name.clone(), (right + 5 * px, y - 6 * px), SMALL);
    area.draw(&name).expect(DRAWN);
}

/// Draws a series, before which so many of its kind are drawn; of bars, it is one of several at the same places.
fn draw(chart: &mut Chart<'_, '_>, series: &Series, color: RGBColor, [place, of]: [usize; 2]) {
    let points = finite(&series.points);
    match series.mark {
        Mark::Line => {
            let line = LineSeries::new(points, color.stroke_width(2 * FINE));
            chart.draw_series(line).expect(DRAWN);
        }
        Mark::Broad => {
            let line = LineSeries::new(points, color.mix(PALE).stroke_width(7 * FINE));
            chart.draw_series(line).expect(DRAWN);
        }
        Mark::Dots => match Shape::of(place) {
            Shape::Disk => {
                let dots = points.map(|at| Circle::new(at, DOT, color.filled()));
                chart.draw_series(dots).expect(DRAWN);
            }
            Shape::Triangle => {
                let dots = points.map(|at| TriangleMarker::new(at, BIG, color.filled()));
                chart.draw_series(dots).expect(DRAWN);
            }
            Shape::Ring => {
                let dots = points.map(|at| Circle::new(at, BIG, color.stroke_width(FINE)));
                chart.draw_series(dots).expect(DRAWN);
            }
        },
        Mark::Bars => {
            let width = 2.0 * HALF * step(series) / of as f64;
            let left = place as f64 * width - HALF * step(series);
            let bars = points.clone().map(|(x, y)| {
                let corners = [(x + left, 0.0), (x + left + width, y)];
                Rectangle::new(corners, color.filled())
            });
            chart.draw_series(bars).expect(DRAWN);
            let stripes = points.flat_map(|(x, y)| {
                let at = move |stripe: usize| {
                    x + left + width * (stripe + 1) as f64 / (place + 1) as f64
                };
                (0..place).map(move |stripe| vec![(at(stripe), 0.0), (at(stripe), y)])
            });
            let stripes = stripes.map(|line| PathElement::new(line, WHITE.stroke_width(FINE)));
            chart.draw_series(stripes).expect(DRAWN);
        }
        Mark::Band => {
            let outline: Vec<(f64, f64)> = points.collect();
            let area = Polygon::new(outline, color.mix(PALE).filled());
            chart.draw_series([area]).expect(DRAWN);
        }
        Mark::Boxes => {
            let half = HALF * step(series);
            for five in series.points.chunks_exact(5) {
                let x = five[0].0;
                let [least, low, middle, high, most] = std::array::from_fn(|k| five[k].1);
                let corners = [(x - half, low), (x + half, high)];
                let area = Rectangle::new(corners, color.mix(PALE).filled());
                chart.draw_series([area]).expect(DRAWN);
                let outline = Rectangle::new(corners, color.stroke_width(FINE));
                chart.draw_series([outline]).expect(DRAWN);
                let across = |y: f64, half: f64| vec![(x - half, y), (x + half, y)];
                let lines = [
                    vec![(x, least), (x, low)],
                    vec![(x, high), (x, most)],
                    across(least, 0.5 * half),
                    across(most, 0.5 * half),
                    across(middle, half),
                ];
                let lines = lines.map(|line| PathElement::new(line, color.stroke_width(2 * FINE)));
                chart.draw_series(lines).expect(DRAWN);
            }
        }
    }
}

/// The least way from one place to the next; one where there is a single place.
fn step(series: &Series) -> f64 {
    let places = finite(&series.points).map(|(x, _)| x);
    let mut places: Vec<f64> = places.collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    let ways = places.windows(2).map(|pair| pair[1] - pair[0]);
    let least = ways.fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 1.0 }
}

fn finite(points: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> + Clone {
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
        let figure = Figure::new("fall", "a fall", "time, s", "angle, rad").with(
            "simulated",
            Mark::Line,
            [(0.0, 1.0), (1.0, 0.5)],
        );
        let lines = figure.svg().matches("<circle").count();
        let figure = figure.with("measured", Mark::Dots, [(0.0, 1.0), (1.0, f64::NAN)]);
        let svg = figure.svg();
        for word in ["a fall", "time, s", "angle, rad", "measured", "simulated"] {
            assert!(svg.contains(word), "{word}");
        }
        // One in the axes and one in the key.
        assert_eq!(svg.matches("<circle").count(), lines + 2, "{svg}");
        assert!(!svg.contains("NaN"));
        assert_eq!([0, 1].map(|place| figure.parts_of(&svg, place)), [1, 1]);
        let empty = figure.with("nothing", Mark::Line, [(f64::NAN, 1.0)]);
        assert_eq!(empty.parts_of(&empty.svg(), 2), 0);
    }

    #[test]
    fn a_band_is_an_area_and_a_box_has_a_middle() {
        let of = |figure: Figure| figure.svg();
        let empty = Figure::new("spread", "spread", "time, s", "angle, rad");
        let band = empty
            .clone()
            .with_band("band", [[0.0, 1.0, 2.0], [1.0, 1.5, 2.5]]);
        assert_eq!(of(band).matches("<polygon").count(), 1);
        let boxes = empty.with_boxes("boxes", [(10.0, [0.0, 1.0, 2.0, 3.0, 4.0])]);
        assert!(of(boxes).matches("<polyline").count() >= 5);
    }

    #[test]
    fn the_key_goes_on_in_a_new_line_where_it_is_too_wide() {
        let points = [(0.0, 0.0)];
        let series = (0..12).map(|k| Series {
            name: format!("a series with a name {k}"),
            mark: Mark::Line,
            points: points.to_vec(),
        });
        let places = places(&series.collect::<Vec<_>>());
        assert!(places.iter().all(|(x, _)| *x < WIDTH));
        assert!(places[11].1 > 1);
    }
}
