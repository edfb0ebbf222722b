//! What is wrong with a spec, where, and what to write instead.
//!
//! [`Diagnostic`] carries token spans: a derive turns it into a `compile_error!` at the attribute. [`Diagnostics`] carries
//! the text and byte ranges: it renders the way rustc does and may cross threads.

#[cfg(test)]
mod goldens;

use std::fmt;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use proc_macro2::Span;

/// Between message and help where both travel in one `syn::Error`.
const HELP_MARK: &str = "\nhelp: ";

/// One mistake.
#[derive(Debug, Clone)]
pub struct Diagnostic {
    message: String,
    labels: Vec<Label>,
    help: Option<String>,
}

/// A place in the text and what is to be seen there.
#[derive(Debug, Clone)]
struct Label {
    place: Place,
    text: String,
}

/// Where a label points.
#[derive(Debug, Clone)]
enum Place {
    /// Tokens of a file or of a macro's input.
    Tokens(Span),
    /// Bytes of a text that could not be made into tokens.
    Bytes(Range<usize>),
}

impl Place {
    fn span(&self) -> Span {
        match self {
            Self::Tokens(span) => *span,
            Self::Bytes(_) => Span::call_site(),
        }
    }

    /// Kept inside `text`: within a macro the compiler's spans may belong to another file.
    fn byte_range(&self, text: &str) -> Range<usize> {
        let mut range = match self {
            Self::Tokens(span) => span.byte_range(),
            Self::Bytes(range) => range.clone(),
        };
        range.end = range.end.min(text.len());
        range.start = range.start.min(range.end);
        while !text.is_char_boundary(range.start) {
            range.start -= 1;
        }
        while !text.is_char_boundary(range.end) {
            range.end += 1;
        }
        range
    }
}

impl Diagnostic {
    /// A mistake at a place. The message stands alone; the label is short and points.
    #[must_use]
    #[track_caller]
    #[doc(hidden)]
    pub fn new(span: Span, message: impl Into<String>, label: impl Into<String>) -> Self {
        Self::at(Place::Tokens(span), message.into(), label.into())
    }

    /// A mistake in a text that has no tokens yet.
    #[track_caller]
    pub(crate) fn in_text(bytes: Range<usize>, message: impl Into<String>, label: &str) -> Self {
        Self::at(Place::Bytes(bytes), message.into(), label.to_owned())
    }

    #[track_caller]
    fn at(place: Place, message: String, label: String) -> Self {
        #[cfg(test)]
        robot_model_goldens::note(&message);
        Self {
            message,
            labels: vec![Label { place, text: label }],
            help: None,
        }
    }

    /// A second place that has to do with it.
    #[must_use]
    #[doc(hidden)]
    pub fn also(mut self, span: Span, label: impl Into<String>) -> Self {
        self.labels.push(Label {
            place: Place::Tokens(span),
            text: label.into(),
        });
        self
    }

    /// [`Self::also`] in a text that has no tokens yet.
    pub(crate) fn also_in_text(mut self, bytes: Range<usize>, label: &str) -> Self {
        self.labels.push(Label {
            place: Place::Bytes(bytes),
            text: label.to_owned(),
        });
        self
    }

    /// The same at another place of the text where it has none of its own.
    #[cfg(feature = "log-settings")]
    pub(crate) fn or_in_text(mut self, bytes: Range<usize>) -> Self {
        if let Some(label) = self.labels.first_mut()
            && label.place.span().byte_range().is_empty()
        {
            label.place = Place::Bytes(bytes);
        }
        self
    }

    /// What to do about it.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// What is wrong, in one line.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }

    /// What to do about it.
    #[must_use]
    pub fn help_text(&self) -> Option<&str> {
        self.help.as_deref()
    }

    /// The place of the mistake.
    #[must_use]
    #[doc(hidden)]
    pub fn span(&self) -> Span {
        self.labels
            .first()
            .map_or_else(Span::call_site, |label| label.place.span())
    }

    /// For a macro: an error at the same tokens, the help in its message.
    #[must_use]
    #[doc(hidden)]
    pub fn to_syn_error(&self) -> syn::Error {
        syn_error(self.span(), &self.message, self.help.as_deref())
    }

    /// Every error that `error` combines.
    pub(crate) fn from_syn(error: syn::Error) -> impl Iterator<Item = Self> {
        error.into_iter().map(|one| {
            let text = one.to_string();
            let (message, help) = match text.split_once(HELP_MARK) {
                Some((message, help)) => (message, help.to_owned()),
                None => (text.as_str(), remedy(&text)),
            };
            let help = Some(help);
            Self {
                help,
                ..Self::new(one.span(), message, "")
            }
        })
    }
}

/// Help for an error of `syn`'s own: "expected `,`" says what to write.
fn remedy(message: &str) -> String {
    match message.rsplit_once("expected ") {
        Some((_, "token")) | None => "remove this".to_owned(),
        Some((_, expected)) => format!("write {expected} here"),
    }
}

/// A `syn` error whose help survives the way through [`Diagnostic::from_syn`].
#[track_caller]
pub(crate) fn syn_error(span: Span, message: &str, help: Option<&str>) -> syn::Error {
    #[cfg(test)]
    robot_model_goldens::note(message);
    match help {
        Some(help) => syn::Error::new(span, format!("{message}{HELP_MARK}{help}")),
        None => syn::Error::new(span, message),
    }
}

/// Every mistake of one stage in one text, by place.
#[derive(Debug, Clone)]
pub struct Diagnostics {
    source_name: String,
    text: String,
    entries: Vec<Entry>,
}

/// A [`Diagnostic`] whose spans have become byte ranges of the text.
#[derive(Debug, Clone, PartialEq)]
struct Entry {
    message: String,
    labels: Vec<(Range<usize>, String)>,
    help: Option<String>,
}

/// Mistakes that are shown at once: more of them follow from one another, mostly.
const MOST_SHOWN: usize = 20;

impl Diagnostics {
    /// Ties mistakes to the text that they were found in.
    #[must_use]
    pub fn new(source_name: &str, text: &str, mistakes: Vec<Diagnostic>) -> Self {
        let mut entries: Vec<Entry> = mistakes
            .into_iter()
            .map(|mistake| Entry {
                message: mistake.message,
                labels: mistake
                    .labels
                    .into_iter()
                    .map(|l| (l.place.byte_range(text), l.text))
                    .collect(),
                help: mistake.help,
            })
            .collect();
        entries.sort_by_key(|entry| entry.labels.first().map_or(0, |(range, _)| range.start));
        // What is wrong of one place is wrong for every joint that reads it.
        entries.dedup();
        Self {
            source_name: source_name.to_owned(),
            text: text.to_owned(),
            entries,
        }
    }

    /// How many mistakes there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Never true for an `Err` of this crate.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The one-line messages, by place.
    pub fn messages(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|entry| entry.message.as_str())
    }

    /// The one-line messages with what to do, by place: for readers who do not have the text before them.
    pub fn messages_with_help(&self) -> impl Iterator<Item = String> {
        self.entries.iter().map(|entry| match &entry.help {
            Some(help) => format!("{}; {help}", entry.message),
            None => entry.message.clone(),
        })
    }

    /// The way rustc shows errors: message, place, source line, help; with ANSI colors on request. Of very many the first ones.
    #[must_use]
    pub fn render(&self, color: bool) -> String {
        let renderer = if color {
            Renderer::styled()
        } else {
            Renderer::plain()
        };
        let shown = self.entries.iter().take(MOST_SHOWN);
        let mut mistakes: Vec<String> = shown
            .map(|entry| renderer.render(&[self.group(entry)]))
            .collect();
        if let Some(others) = self.entries.len().checked_sub(MOST_SHOWN + 1) {
            let others = others + 1;
            let mistake = if others == 1 { "mistake" } else { "mistakes" };
            mistakes.push(format!("{others} more {mistake}: fix those above first"));
        }
        mistakes.join("\n\n")
    }

    fn group<'a>(&'a self, entry: &'a Entry) -> Group<'a> {
        let mut snippet = Snippet::source(self.text.as_str()).path(self.source_name.as_str());
        for (k, (range, label)) in entry.labels.iter().enumerate() {
            let kind = if k == 0 {
                AnnotationKind::Primary
            } else {
                AnnotationKind::Context
            };
            let annotation = kind.span(range.clone());
            snippet = snippet.annotation(if label.is_empty() {
                annotation
            } else {
                annotation.label(label.as_str())
            });
        }
        let group = Level::ERROR
            .primary_title(entry.message.as_str())
            .element(snippet);
        match &entry.help {
            Some(help) => group.element(Level::HELP.message(help.as_str())),
            None => group,
        }
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Diagnostics {}

#[cfg(test)]
mod tests {
    use super::{Diagnostic, Diagnostics};
    use proc_macro2::Span;

    #[test]
    fn errors_may_cross_threads() {
        fn check<T: Send + Sync + 'static>() {}
        check::<Diagnostics>();
    }

    #[test]
    fn help_survives_a_syn_error() {
        let mistake = Diagnostic::new(Span::call_site(), "wrong", "here").help("do it right");
        let again: Vec<Diagnostic> = Diagnostic::from_syn(mistake.to_syn_error()).collect();
        assert_eq!(again[0].message(), "wrong");
        assert_eq!(again[0].help_text(), Some("do it right"));
    }

    #[test]
    fn of_many_mistakes_the_first_are_shown() {
        let shown = |count: usize| {
            let mistakes = (0..count)
                .map(|k| Diagnostic::new(Span::call_site(), format!("wrong {k}"), "here"));
            Diagnostics::new("arm.robot", "robot A {}", mistakes.collect()).render(false)
        };
        let all = shown(20);
        assert!(
            all.matches("error: wrong").count() == 20 && !all.contains("more mistake"),
            "{all}"
        );
        for (count, told) in [(21, "1 more mistake:"), (2000, "1980 more mistakes:")] {
            let some = shown(count);
            assert!(
                some.matches("error: wrong").count() == 20 && some.contains(told),
                "{some}"
            );
        }
    }

    #[test]
    fn colors_come_on_request_only() {
        let errors = Diagnostics::new(
            "r.robot",
            "robot",
            vec![Diagnostic::new(Span::call_site(), "wrong", "")],
        );
        assert!(!errors.render(false).contains('\u{1b}'));
        assert!(errors.render(true).contains('\u{1b}'));
        assert_eq!(errors.to_string(), errors.render(false));
    }
}
