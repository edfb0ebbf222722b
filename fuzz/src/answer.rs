//! What a reader makes of a file; here the compiler, of a spec.

use robot_model_codegen::{compile_model, emit};
use robot_model_spec::load;

use crate::{forms, oracle};

/// What came of a text. Two texts with equal answers exercise about the same code.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Answer {
    /// Refused, with these messages; what stands between backticks and digits is left out.
    Refused(Vec<String>),
    /// Compiled up to base parameters that are not certain: nothing is emitted.
    Uncertain {
        /// Joints.
        dof: usize,
    },
    /// Compiled; the size of what came out, by powers of two.
    Emitted {
        /// Joints.
        dof: usize,
        /// Standard parameters.
        standard: u32,
        /// Base parameters.
        base: u32,
        /// Bytes of the page.
        page: u32,
    },
    /// Read, with these remarks, as messages are kept; what there is of it, by powers of two.
    Read {
        /// Samples of a log, letters of a spec.
        size: u32,
        /// Channels of a log, joints of a robot.
        parts: u32,
        /// What was said of it.
        remarks: Vec<String>,
    },
}

impl Answer {
    /// A refusal with one message.
    pub(crate) fn refused(message: &str) -> Self {
        Self::Refused(vec![skeleton(message)])
    }
}

/// From spec text to emitted code.
///
/// # Panics
/// Where the forms of a text do not agree: a failure of the compiler, as is every other panic.
#[must_use]
pub fn answer(text: &str) -> Answer {
    let model = match load("fuzz.robot", text) {
        Ok(model) => model,
        Err(mistakes) => {
            // Rendering is part of the answer: it must not panic on any span.
            let _ = mistakes.render(true);
            let mut messages: Vec<String> = mistakes.messages().map(skeleton).collect();
            messages.sort_unstable();
            messages.dedup();
            return Answer::Refused(messages);
        }
    };
    let compiled = compile_model(&model);
    let dof = model.joints.len();
    if !compiled.base.rank.is_clear() {
        let _ = compiled.base.rank.to_string();
        return Answer::Uncertain { dof };
    }
    let page = emit::rust::module(&compiled);
    forms::exercise(&compiled);
    assert_eq!(oracle::check(&compiled), Ok(()));
    Answer::Emitted {
        dof,
        standard: compiled.standard.len().checked_ilog2().unwrap_or_default(),
        base: compiled.base.kept.len().checked_ilog2().unwrap_or_default(),
        page: page.len().ilog2(),
    }
}

/// A message without the names and numbers of one spec.
pub(crate) fn skeleton(message: &str) -> String {
    let mut kept = String::new();
    for (k, part) in message.split('`').enumerate() {
        if k % 2 == 0 {
            kept.extend(part.chars().filter(|c| !c.is_ascii_digit()));
        } else {
            kept.push('_');
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::skeleton;

    #[test]
    fn names_and_numbers_do_not_make_a_message_new() {
        assert_eq!(
            skeleton("effect `x` takes 2 of `y`"),
            "effect _ takes  of _"
        );
    }
}
