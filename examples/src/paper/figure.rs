//! A figure: series between two axes, drawn by `drawing.rs`.

/// How points of a series are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A line through them.
    Line,
    /// A broad, pale line through them, on which another one is seen.
    Broad,
    /// A dot at each.
    Dots,
    /// A bar from zero to each.
    Bars,
    /// The area that they enclose.
    Band,
    /// A box plot for every five: least value, quartiles, largest value at one place.
    Boxes,
}

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
    /// Name of its file, without an extension: `figure_NN`, or a word.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// What stands along the axis to the right, with its unit.
    pub x: String,
    /// What stands along the axis upward, with its unit.
    pub y: String,
    /// What is drawn, the first one below the others.
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

    /// The figure with the area between two curves: `[place, low, high]`.
    #[must_use]
    pub fn with_band(
        self,
        name: impl Into<String>,
        between: impl IntoIterator<Item = [f64; 3]>,
    ) -> Self {
        let between: Vec<[f64; 3]> = between.into_iter().collect();
        let above = between.iter().map(|[x, _, high]| (*x, *high));
        let below = between.iter().rev().map(|[x, low, _]| (*x, *low));
        self.with(name, Mark::Band, above.chain(below).collect::<Vec<_>>())
    }

    /// The figure with box plots: a place, and least value, quartiles and largest value there.
    #[must_use]
    pub fn with_boxes(
        self,
        name: impl Into<String>,
        boxes: impl IntoIterator<Item = (f64, [f64; 5])>,
    ) -> Self {
        let points = boxes.into_iter().flat_map(|(x, five)| five.map(|y| (x, y)));
        self.with(name, Mark::Boxes, points.collect::<Vec<_>>())
    }
}
