//! Reports for people who look: one page of HTML with everything in it, figures and style included.
//!
//! [`Page`] knows how a page is written and nothing of robots, `chart` draws, `comment` reads what effects say of their parameters, `again` says of which files a page is, [`Drawn`] has what is drawn of models on a log, and `sections`
//! what several verbs say. What stands in the report of a verb is the verb's own.

mod again;
mod axis;
mod bars;
mod chart;
mod comment;
mod folder;
mod map;
mod page;
mod sections;
mod series;

pub(crate) use again::again;
pub(crate) use bars::Bars;
pub(crate) use chart::Ink;
pub(crate) use comment::unit_and_meaning;
pub(crate) use folder::{ReportFolder, beside};
pub(crate) use map::Map;
pub(crate) use page::Page;
pub(crate) use sections::{as_read, base_parameters, figures, parameters};
pub(crate) use series::{Drawn, Shown};
