//! How series of one kind are told apart without their colors: dashes of lines, shapes of dots, stripes of bars.

use plotters::style::RGBColor;

use super::figure::{Figure, Mark};

/// Dashes and the gaps behind them in tenths of a pixel, by the place among lines; the first one is whole.
const DASHES: [&str; 8] = [
    "",
    "80 40",
    "20 30",
    "120 30 20 30",
    "40 20",
    "160 50",
    "80 20 20 20 20 20",
    "50 80",
];

/// Shape of a dot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Disk,
    Triangle,
    Ring,
}

/// Shapes by the place among series of dots.
const SHAPES: [Shape; 3] = [Shape::Disk, Shape::Triangle, Shape::Ring];

impl Shape {
    pub(super) fn of(order: usize) -> Self {
        SHAPES[order % SHAPES.len()]
    }

    /// What it is in the drawing.
    pub(super) fn element(self) -> &'static str {
        match self {
            Self::Disk | Self::Ring => "<circle",
            Self::Triangle => "<polygon",
        }
    }
}

impl Figure {
    /// How many series before the one at a place are drawn as it is.
    pub(super) fn order(&self, place: usize) -> usize {
        let mark = self.series[place].mark;
        let before = self.series[..place].iter();
        before.filter(|one| one.mark == mark).count()
    }

    /// Names of series that only their colors tell from others.
    #[must_use]
    pub fn look_alike(&self) -> Vec<&str> {
        let all = self.series.iter().enumerate();
        let alike = all.filter(|(place, one)| {
            let looks = match one.mark {
                Mark::Line | Mark::Broad => DASHES.len(),
                Mark::Dots => SHAPES.len(),
                // A bar has as many stripes as stand before it.
                Mark::Bars => usize::MAX,
                Mark::Band | Mark::Boxes => 1,
            };
            self.order(*place) >= looks
        });
        alike.map(|(_, one)| one.name.as_str()).collect()
    }

    /// The drawing with its lines dashed, in the axes and then in the key; `colors` are those of the series.
    pub(super) fn dashed(&self, svg: &str, colors: &[RGBColor]) -> String {
        let is_line = |place: &usize| matches!(self.series[*place].mark, Mark::Line | Mark::Broad);
        let is_drawn = |place: &usize| {
            let mut points = self.series[*place].points.iter();
            points.any(|(x, y)| x.is_finite() && y.is_finite())
        };
        let lines = || (0..self.series.len()).filter(is_line);
        let mut left = lines().filter(is_drawn).chain(lines()).peekable();
        let parts = svg.split_inclusive('\n').map(|part| {
            let Some(&place) = left.peek() else {
                return part.to_owned();
            };
            if !part.starts_with("<polyline") || !part.contains(&quoted(colors[place])) {
                return part.to_owned();
            }
            left.next();
            match DASHES[self.order(place) % DASHES.len()] {
                "" => part.to_owned(),
                dashes => part.replacen(
                    "<polyline",
                    &format!("<polyline stroke-dasharray=\"{dashes}\""),
                    1,
                ),
            }
        });
        parts.collect()
    }
}

/// A color as the drawing has it.
pub(super) fn quoted(RGBColor(red, green, blue): RGBColor) -> String {
    format!("\"#{red:02X}{green:02X}{blue:02X}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_of_one_kind_differ_in_more_than_their_color() {
        let with = |figure: Figure, mark: Mark| {
            let name = format!("series {}", figure.series.len());
            figure.with(name, mark, [(0.0, 1.0), (1.0, 2.0)])
        };
        let empty = Figure::new("looks", "looks", "x", "y");
        let lines = (0..DASHES.len()).fold(empty.clone(), |figure, _| with(figure, Mark::Line));
        let svg = lines.svg();
        for dashes in &DASHES[1..] {
            // One in the axes and one in the key.
            let dashed = format!("stroke-dasharray=\"{dashes}\"");
            assert_eq!(svg.matches(&dashed).count(), 2, "{dashes}: {svg}");
        }
        assert_eq!(lines.look_alike(), [""; 0]);
        assert_eq!(with(lines, Mark::Line).look_alike(), ["series 8"]);
        let dots = (0..2).fold(empty.clone(), |figure, _| with(figure, Mark::Dots));
        assert_eq!(
            [0, 1].map(|place| dots.parts_of(&dots.svg(), place)),
            [2, 2]
        );
        assert_eq!(dots.svg().matches("<polygon").count(), 3);
        // A bar, and one with a stripe, in the axes at both places and in the key.
        let stripes = |figure: &Figure| figure.svg().matches("stroke=\"#FFFFFF\"").count();
        let bar = with(empty, Mark::Bars);
        assert_eq!(stripes(&bar), 0);
        assert_eq!(stripes(&with(bar, Mark::Bars)), 3);
    }
}
