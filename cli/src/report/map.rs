//! Figure of a report: which parameters of which links each base parameter is a sum of.

use plotters::prelude::*;

use super::axis::Axis;
use super::chart::{DRAWN, GRID, INK, Ink, TEXT, on_page};

/// Widths of a square's cell, between which all cells of a row are about as wide as paper; its height, which letters have; room around the
/// drawing, and what a letter of a name takes.
const NARROWEST: usize = 5;
const WIDEST: usize = 11;
const ROW: usize = 770;
const HEIGHT: usize = 15;
const AROUND: u32 = 48;
const LETTER: u32 = 7;

/// Sides of squares as shares of their cells, of factors of 1 and more and of a hundredth and less.
const LARGE: f64 = 0.9;
const SMALL: f64 = 0.3;
const DECADES: f64 = 2.0;

/// One drawing.
pub(crate) struct Map<'a> {
    /// What it says, for those who do not see it.
    pub(crate) label: &'a str,
    /// Names of the links, each with as many columns.
    pub(crate) links: Vec<&'a str>,
    pub(crate) columns: usize,
    /// A row a base parameter: its name, and columns with factors.
    pub(crate) rows: Vec<(&'a str, Vec<(usize, f64)>)>,
}

impl Map<'_> {
    /// The drawing as SVG inside a page.
    pub(crate) fn svg(&self) -> String {
        let pixels = |count: usize| u32::try_from(count).unwrap_or(1);
        let [columns, rows] = [self.columns * self.links.len(), self.rows.len()];
        let longest = self.rows.iter().map(|(name, _)| name.chars().count()).max();
        let names = LETTER * u32::try_from(longest.unwrap_or(0)).unwrap_or(1) + 16;
        let cell = (ROW / columns.max(1)).clamp(NARROWEST, WIDEST);
        let size = (
            pixels(cell * columns) + names + 20,
            pixels(HEIGHT * rows) + AROUND,
        );
        // Squares are as high as they are wide.
        let flat = cell as f64 / HEIGHT as f64;
        // The first row is the uppermost.
        let middle = |row: usize| (rows - row) as f64 - 0.5;
        let of_link = |link: usize| (self.columns * link) as f64 + self.columns as f64 / 2.0;
        let links = 0..self.links.len();
        let x = Axis::at(0.0..columns as f64, links.clone().map(of_link).collect());
        let y = Axis::at(0.0..rows as f64, (0..rows).map(middle).collect());
        let name_at = |names: &[&str], place: &dyn Fn(usize) -> f64, at: f64| {
            let found = (0..names.len()).find(|k| (place(*k) - at).abs() < 0.1);
            found.map_or_else(String::new, |k| names[k].to_owned())
        };
        let names_of_rows: Vec<&str> = self.rows.iter().map(|(name, _)| *name).collect();
        let mut text = String::new();
        {
            let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
            let mut chart = ChartBuilder::on(&root)
                .margin(6)
                .x_label_area_size(30)
                .y_label_area_size(names)
                .build_cartesian_2d(x, y)
                .expect(DRAWN);
            chart
                .configure_mesh()
                .light_line_style(TRANSPARENT)
                .bold_line_style(TRANSPARENT)
                .axis_style(INK)
                .x_label_formatter(&|at| name_at(&self.links, &of_link, *at))
                .y_label_formatter(&|at| name_at(&names_of_rows, &middle, *at))
                .label_style(TEXT.into_font().color(&INK))
                .draw()
                .expect(DRAWN);
            let between = links.skip(1).map(|link| {
                let at = (self.columns * link) as f64;
                PathElement::new([(at, 0.0), (at, rows as f64)], GRID)
            });
            chart.draw_series(between).expect(DRAWN);
            for (row, (_, factors)) in self.rows.iter().enumerate() {
                chart
                    .draw_series(factors.iter().map(|&(column, factor)| {
                        let half = side(factor) / 2.0;
                        let (x, y) = (column as f64 + 0.5, middle(row));
                        let corners = [(x - half, y + flat * half), (x + half, y - flat * half)];
                        let ink = if factor < 0.0 {
                            Ink::Before
                        } else {
                            Ink::After
                        };
                        let style = ShapeStyle {
                            color: ink.stand_in().into(),
                            filled: factor > 0.0,
                            stroke_width: 1,
                        };
                        Rectangle::new(corners, style)
                    }))
                    .expect(DRAWN);
            }
            root.present().expect(DRAWN);
        }
        on_page(&text, self.label, size)
    }
}

/// Side of the square of a factor.
fn side(factor: f64) -> f64 {
    let decades = -factor.abs().min(1.0).log10();
    LARGE - (LARGE - SMALL) * (decades / DECADES).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_factor_has_a_square_larger_or_smaller_filled_or_not() {
        let map = Map {
            label: "sums",
            links: vec!["upper", "lower"],
            columns: 10,
            rows: vec![
                ("upper.mxr", vec![(1, 1.0), (10, 0.5)]),
                ("upper.my", vec![(2, 1.0), (12, -0.02)]),
            ],
        };
        let svg = map.svg();
        for name in ["upper", "lower", "upper.mxr", "upper.my"] {
            assert!(svg.contains(name), "{name}: {svg}");
        }
        let squares = |ink: &str, is_filled: bool| {
            let lines = svg.lines().filter(|line| line.starts_with("<rect"));
            let own = lines.filter(|line| line.contains(ink));
            own.filter(|line| line.contains("fill=\"none\"") != is_filled)
                .count()
        };
        let counts = ["var(--after)", "var(--before)"]
            .map(|ink| [true, false].map(|is_filled| squares(ink, is_filled)));
        assert_eq!(counts, [[3, 0], [0, 1]], "{svg}");
        assert!(side(1.0) > side(0.5) && side(0.5) > side(0.02));
        assert!((side(1e-9) - SMALL).abs() < 1e-12 && (side(30.0) - LARGE).abs() < 1e-12);
    }
}
