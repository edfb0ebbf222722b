//! Values of an option by name, with a hint for words that people write in their place.

use std::ffi::OsStr;
use std::marker::PhantomData;

use clap::builder::{EnumValueParser, PossibleValue, TypedValueParser};
use clap::error::{ContextKind, ContextValue};
use clap::{Arg, Command, ValueEnum};

/// Words in lower case, and what to write for them.
pub(crate) type Hints = &'static [(&'static [&'static str], &'static str)];

/// A parser of a [`ValueEnum`] that answers known wrong words with a hint.
#[derive(Debug, Clone)]
pub(crate) struct Hinted<T> {
    hints: Hints,
    of: PhantomData<T>,
}

impl<T> Hinted<T> {
    pub(crate) const fn new(hints: Hints) -> Self {
        Self {
            hints,
            of: PhantomData,
        }
    }
}

impl<T: ValueEnum + Clone + Send + Sync + 'static> TypedValueParser for Hinted<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<T, clap::Error> {
        let parsed = EnumValueParser::<T>::new().parse_ref(command, argument, value);
        parsed.map_err(|mut error| {
            let is_meant = |word: &&str| value.eq_ignore_ascii_case(word);
            let mut hints = self.hints.iter();
            if let Some((_, hint)) = hints.find(|(words, _)| words.iter().any(is_meant)) {
                let hint = (*hint).into();
                error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![hint]));
                error.remove(ContextKind::SuggestedValue);
            }
            error
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let values = T::value_variants().iter();
        Some(Box::new(values.filter_map(ValueEnum::to_possible_value)))
    }
}
