//! What stands before the names of an arm in C, and what its files are called.
//!
//! Several arms are linked into one program, and their files stand among those of others. So two rules beside those of C:
//!
//! - No prefix but an equal one makes the same names. `arm` and `arm_base` would: `arm_base_regressor` is the base regressor of
//!   one and the regressor of the other. That takes a prefix that ends as the head of a name that is whole without its head,
//!   and these heads are few ([`HEADS`]; a test compares them with all that is emitted).
//! - No file takes the place of a header of the system, and none is called as a word or function that everybody knows.

use std::fmt;

use super::reserved::{self, Reserved};

/// Last words of what stands before `_regressor` in `base_regressor`, and before other names of the page in longer ones.
const HEADS: [(&str, &str); 4] = [
    ("base", "regressor"),
    ("drift", "regressor"),
    ("memory", "after"),
    ("momentum", "regressor"),
];
/// Longer names are of no use to anybody.
const LONGEST: usize = 64;
/// What is put behind the name of a robot that cannot stand alone.
const INSTEAD: &str = "robot";

/// A prefix that is good in C: words of small letters and digits, a letter first, one underscore between them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Prefix {
    text: String,
    refused: Option<PrefixError>,
}

/// Why a prefix is none.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum PrefixError {
    /// It is not spelled as one.
    Spelling {
        /// What was given.
        given: String,
        /// The same as it would be for a robot of this name.
        instead: String,
    },
    /// A file or a name of C that everybody knows.
    Reserved {
        /// What was given.
        given: String,
        /// What it is already.
        what: Reserved,
    },
    /// Another prefix could make the same names.
    Ambiguous {
        /// What was given.
        given: String,
        /// The other prefix.
        other: String,
        /// A name that both make.
        name: String,
    },
}

impl fmt::Display for PrefixError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Spelling { given, instead } => write!(
                f,
                "names in C start with words of small letters and digits, a letter first, one underscore between words, at most \
                 {LONGEST} characters: `{given}` would be `{instead}`"
            ),
            Self::Reserved { given, what } => write!(f, "{}", what.said(given)),
            Self::Ambiguous { given, other, name } => write!(
                f,
                "`{name}` would be a name of both `{other}` and `{given}`, which can then not be in one program"
            ),
        }
    }
}

impl std::error::Error for PrefixError {}

impl Prefix {
    /// A prefix as it is written.
    ///
    /// # Errors
    /// What is spelled otherwise, names of system headers, words and functions of C and C++, and what could make the same names
    /// as another prefix.
    pub fn new(text: &str) -> Result<Self, PrefixError> {
        if snake_case(text) != text || text.len() > LONGEST {
            let mut instead = Self::of_robot(text).text;
            instead.truncate(LONGEST);
            return Err(PrefixError::Spelling {
                given: text.to_owned(),
                instead: instead.trim_end_matches('_').to_owned(),
            });
        }
        match refusal(text) {
            Some(reason) => Err(reason),
            None => Ok(Self {
                text: text.to_owned(),
                refused: None,
            }),
        }
    }

    /// That of a robot: its name in snake case, with `_robot` behind it where this is no prefix.
    #[must_use]
    pub fn of_robot(name: &str) -> Self {
        let text = snake_case(name);
        let refused = refusal(&text);
        Self {
            text: match refused {
                Some(_) => format!("{text}_{INSTEAD}"),
                None => text,
            },
            refused,
        }
    }

    /// The prefix, without an underscore behind it.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// Why it is not the robot's name alone.
    #[must_use]
    pub const fn refused(&self) -> Option<&PrefixError> {
        self.refused.as_ref()
    }
}

/// Why words in snake case are no prefix.
fn refusal(text: &str) -> Option<PrefixError> {
    if let Some(what) = reserved::what(text) {
        let given = text.to_owned();
        return Some(PrefixError::Reserved { given, what });
    }
    let (other, last) = text.rsplit_once('_')?;
    let (head, rest) = HEADS.iter().find(|(head, _)| *head == last)?;
    Some(PrefixError::Ambiguous {
        given: text.to_owned(),
        other: other.to_owned(),
        name: format!("{other}_{head}_{rest}"),
    })
}

/// A name in snake case: `puma560` of `Puma560`, `two_link` of `TwoLink`.
fn snake_case(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    let mut words = String::new();
    for (k, c) in letters.iter().enumerate() {
        let before = k.checked_sub(1).map(|k| letters[k]);
        let after = letters.get(k + 1);
        let starts_a_word = c.is_ascii_uppercase()
            && before.is_some_and(|before| {
                before.is_ascii_lowercase()
                    || before.is_ascii_uppercase() && after.is_some_and(char::is_ascii_lowercase)
            });
        if starts_a_word || !c.is_ascii_alphanumeric() {
            words.push('_');
        }
        if c.is_ascii_alphanumeric() {
            words.push(c.to_ascii_lowercase());
        }
    }
    let words: Vec<&str> = words.split('_').filter(|word| !word.is_empty()).collect();
    let words = words.join("_");
    if words.starts_with(|c: char| c.is_ascii_lowercase()) {
        words
    } else {
        // Letters of other alphabets are left out.
        format!("arm{words}")
    }
}

#[cfg(test)]
mod tests {
    use super::Prefix;

    #[test]
    fn robots_have_names_in_snake_case() {
        for (name, wanted) in [
            ("Puma560", "puma560"),
            ("TwoLink", "two_link"),
            ("UR10e", "ur10e"),
            ("LBRiiwa", "lb_riiwa"),
            ("Tx40", "tx40"),
            ("Ärm", "rm"),
            ("Æ7", "arm7"),
            ("Base", "base"),
            ("RobotStates", "robot_states"),
            ("MyRobotStates", "my_robot_states"),
        ] {
            let prefix = Prefix::of_robot(name);
            assert_eq!(prefix.as_str(), wanted, "{name}");
            assert_eq!(prefix.refused(), None, "{name}");
            assert_eq!(Prefix::new(wanted), Ok(prefix));
        }
    }

    #[test]
    fn robots_whose_names_are_taken_have_another_word_behind_them() {
        for (name, wanted, why) in [
            ("Math", "math_robot", "`math.h` is a header of the system"),
            (
                "STDIO",
                "stdio_robot",
                "`stdio.h` is a header of the system",
            ),
            ("Time", "time_robot", "`time.h` is a header of the system"),
            ("Struct", "struct_robot", "`struct` is a word of C or C++"),
            (
                "StaticAssert",
                "static_assert_robot",
                "`static_assert` is a word of C or C++",
            ),
            ("Sin", "sin_robot", "`sin` is a function of the C library"),
            (
                "Main",
                "main_robot",
                "`main` is a function of every program",
            ),
            (
                "Aux",
                "aux_robot",
                "`aux` is a device of Windows, where no file can have this name",
            ),
            (
                "COM3",
                "com3_robot",
                "`com3` is a device of Windows, where no file can have this name",
            ),
            (
                "ArmBase",
                "arm_base_robot",
                "`arm_base_regressor` would be a name of both `arm` and `arm_base`, which can then not be in one program",
            ),
            (
                "arm_memory",
                "arm_memory_robot",
                "`arm_memory_after` would be a name of both `arm` and `arm_memory`, which can then not be in one program",
            ),
        ] {
            let prefix = Prefix::of_robot(name);
            assert_eq!(prefix.as_str(), wanted);
            assert_eq!(
                prefix.refused().map(ToString::to_string).as_deref(),
                Some(why)
            );
            assert!(Prefix::new(wanted).is_ok(), "{wanted}");
        }
    }

    #[test]
    fn prefixes_are_spelled_in_one_way() {
        let long = "a".repeat(65);
        for (given, instead) in [
            ("Arm", "arm"),
            ("leftArm", "left_arm"),
            ("left-arm", "left_arm"),
            ("left__arm", "left_arm"),
            ("_arm", "arm"),
            ("arm_", "arm"),
            ("2arm", "arm2arm"),
            ("", "arm"),
            ("Math", "math_robot"),
            (long.as_str(), &long[..64]),
        ] {
            let said = Prefix::new(given).expect_err(given).to_string();
            let end = format!("`{given}` would be `{instead}`");
            assert!(said.ends_with(&end), "{said}");
        }
    }
}
