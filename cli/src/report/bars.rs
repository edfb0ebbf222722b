//! Figures of a report: a bar for each joint and model.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::Axis;
use super::chart::{DRAWN, GRID, INK, Ink, TEXT, on_page, tick};
use crate::output::significant;

/// Width of the drawing, with which its letters are a sixth smaller on a phone than those of other drawings at most; what each joint adds to
/// its height.
const WIDTH: u32 = 440;
const EACH: u32 = 56;
const AROUND: u32 = 90;

/// Room for a letter of a joint's name, and for the numbers behind the bars as a share of the longest one.
const LETTER: usize = 8;
const ROOM: f64 = 0.12;

/// Between a bar and its number, as a share of the axis.
const GAP: f64 = 0.008;

/// Share of a joint's height that its bars have.
const FILLED: f64 = 0.76;

/// One drawing.
pub(crate) struct Bars<'a> {
    /// What it says, for those who do not see it.
    pub(crate) label: &'a str,
    pub(crate) x: &'a str,
    pub(crate) joints: &'a [String],
    /// One value a joint.
    pub(crate) models: Vec<(Ink, Vec<f64>)>,
}

impl Bars<'_> {
    /// The drawing as SVG inside a page.
    pub(crate) fn svg(&self) -> String {
        let count = self.joints.len();
        let height = AROUND + EACH * u32::try_from(count).unwrap_or(1);
        let all = || self.models.iter().flat_map(|(_, values)| values);
        let most = all().copied().fold(f64::MIN_POSITIVE, f64::max);
        let end = most * (1.0 + ROOM);
        // The first joint is the uppermost.
        let center = |joint: usize| (count - joint) as f64 - 0.5;
        let x = Axis::linear(0.0..end);
        let y = Axis::at(0.0..count as f64, (0..count).map(center).collect());
        let longest = self.joints.iter().map(|name| name.chars().count()).max();
        let names = u32::try_from(LETTER * longest.unwrap_or(0) + 16).unwrap_or(WIDTH);
        let mut text = String::new();
        {
            let root = SVGBackend::with_string(&mut text, (WIDTH, height)).into_drawing_area();
            let mut chart = ChartBuilder::on(&root)
                .margin(6)
                .margin_right(22)
                .x_label_area_size(42)
                .y_label_area_size(names.min(WIDTH / 3))
                .build_cartesian_2d(x, y)
                .expect(DRAWN);
            let name = |at: &f64| {
                let joint = (0..count).find(|joint| (center(*joint) - at).abs() < 0.1);
                joint.map_or_else(String::new, |joint| self.joints[joint].clone())
            };
            chart
                .configure_mesh()
                .light_line_style(TRANSPARENT)
                .bold_line_style(GRID)
                .axis_style(INK)
                .disable_y_mesh()
                .x_label_formatter(&|value| tick(*value))
                .y_label_formatter(&name)
                .x_desc(self.x)
                .label_style(TEXT.into_font().color(&INK))
                .draw()
                .expect(DRAWN);
            let each = FILLED / self.models.len().max(1) as f64;
            for (place, (ink, values)) in self.models.iter().enumerate() {
                let top = |joint: usize| center(joint) + FILLED / 2.0 - each * place as f64;
                let bar = |(joint, value): (usize, &f64)| {
                    let corners = [(0.0, top(joint)), (*value, top(joint) - each)];
                    Rectangle::new(corners, ink.stand_in().filled())
                };
                chart
                    .draw_series(values.iter().enumerate().map(bar))
                    .expect(DRAWN);
                let style = TEXT
                    .into_font()
                    .color(&INK)
                    .pos(Pos::new(HPos::Left, VPos::Center));
                let number = |(joint, value): (usize, &f64)| {
                    let at = (*value + GAP * end, top(joint) - each / 2.0);
                    Text::new(significant(*value, 3), at, style.clone())
                };
                chart
                    .draw_series(values.iter().enumerate().map(number))
                    .expect(DRAWN);
            }
            root.present().expect(DRAWN);
        }
        let svg = on_page(&text, self.label, (WIDTH, height));
        // The style lets bars shrink further than drawings with more in them.
        svg.replacen("<svg ", "<svg class=\"bars\" ", 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_joint_has_a_bar_of_each_model_with_its_number() {
        let joints = ["one", "two"].map(str::to_owned);
        let bars = Bars {
            label: "errors",
            x: "relative error, %",
            joints: &joints,
            models: vec![
                (Ink::Before, vec![10.0, 0.5]),
                (Ink::After, vec![2.0, 0.25]),
            ],
        };
        let svg = bars.svg();
        for told in [
            "one",
            "two",
            "10.0",
            "0.500",
            "2.00",
            "0.250",
            "relative error, %",
        ] {
            assert!(svg.contains(told), "{told}: {svg}");
        }
        // A bar five times as long as another.
        let widths = |ink: &str| -> Vec<f64> {
            let bars = svg
                .lines()
                .filter(|line| line.starts_with("<rect") && line.contains(ink));
            let width = |line: &str| {
                let start = line.find("width=\"")? + 7;
                line[start..].split('"').next()?.parse::<f64>().ok()
            };
            bars.filter_map(width).collect()
        };
        let (before, after) = (widths("var(--before)"), widths("var(--after)"));
        assert_eq!((before.len(), after.len()), (2, 2), "{svg}");
        assert!((before[0] / after[0] - 5.0).abs() < 0.1, "{svg}");
    }
}
