//! What the comment of an effect says: paragraphs, of which some begin with words that have a meaning.

use super::EffectDefinition;

/// How the paragraph begins that says when an effect can be identified.
const IDENTIFIABLE: &str = "Identifiable ";
/// How a paragraph begins that says what is taken for an effect.
const CONFUSED: &str = "Confused with ";
/// How the last sentence of such a paragraph begins.
const PARTED: &str = "Distinguished by ";

/// What an effect may be taken for: ``Confused with `a`, `b`: why. Distinguished by what.``
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Confusion {
    /// Names of the other effects.
    pub effects: Vec<String>,
    /// In which logs they look alike.
    pub why: String,
    /// What tells them apart.
    pub parted_by: String,
}

impl Confusion {
    /// Whether some motion tells them apart.
    #[must_use]
    pub fn is_parted_by_motion(&self) -> bool {
        !self.parted_by.starts_with("no motion")
    }

    fn read(paragraph: &str) -> Option<Self> {
        let rest = paragraph.strip_prefix(CONFUSED)?;
        let (names, text) = rest.split_once(": ")?;
        let name = |name: &str| {
            let name = name.strip_prefix('`')?.strip_suffix('`')?;
            Some(name.to_owned())
        };
        let (why, parted_by) = text.rsplit_once(PARTED)?;
        Some(Self {
            effects: names.split(", ").map(name).collect::<Option<_>>()?,
            why: why.trim().to_owned(),
            parted_by: parted_by.to_owned(),
        })
    }
}

impl EffectDefinition {
    /// The paragraphs of its comment, each on one line.
    fn paragraphs(&self) -> impl Iterator<Item = String> {
        let join = |paragraph: &str| paragraph.split_whitespace().collect::<Vec<_>>().join(" ");
        self.doc.split("\n\n").map(join)
    }

    /// What it is: the first paragraph of its comment.
    #[must_use]
    pub fn summary(&self) -> String {
        self.paragraphs().next().unwrap_or_default()
    }

    /// What its comment says of its equations: the paragraphs that say nothing else.
    pub fn remarks(&self) -> impl Iterator<Item = String> {
        let is_other =
            |text: &String| !text.starts_with(IDENTIFIABLE) && !text.starts_with(CONFUSED);
        self.paragraphs().skip(1).filter(is_other)
    }

    /// When it can be identified, where its comment says so: the paragraph that begins with "Identifiable".
    #[must_use]
    pub fn identifiable(&self) -> Option<String> {
        self.paragraphs()
            .find(|text| text.starts_with(IDENTIFIABLE))
    }

    /// What it may be taken for, as its own comment has it: the comment of the other effect may say so instead.
    ///
    /// # Errors
    /// A paragraph that begins as one of these and has not their form.
    pub fn confusions(&self) -> Result<Vec<Confusion>, String> {
        self.paragraphs()
            .filter(|text| text.starts_with(CONFUSED))
            .map(|text| Confusion::read(&text).ok_or(text))
            .collect()
    }
}
