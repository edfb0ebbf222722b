//! C functions that the arms' functions call. What the runtime crate has for Rust is written again here: its modules `solve` and
//! `memory`. In their files the word `robot` stands for the prefix.

use std::collections::BTreeSet;

/// A function that is on a page where something calls it. Callers stand behind those that they call.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Helper {
    Sign,
    SinesCosines,
    Series,
    After,
    Product,
    AfterSeveral,
    PositiveDefinite,
    General,
    Settled,
}

/// A helper's name behind the prefix, its text, what it calls.
struct Row {
    name: &'static str,
    text: &'static str,
    calls: &'static [Helper],
}

impl Helper {
    const fn row(self) -> Row {
        let (name, text, calls): (_, _, &[Self]) = match self {
            Self::Sign => ("sign", include_str!("helpers/sign.c"), &[]),
            Self::SinesCosines => (
                "sines_cosines",
                include_str!("helpers/sines_cosines.c"),
                &[],
            ),
            Self::Series => ("series", include_str!("helpers/series.c"), &[]),
            Self::After => ("after", include_str!("helpers/after.c"), &[Self::Series]),
            Self::Product => ("product", include_str!("helpers/product.c"), &[]),
            Self::AfterSeveral => (
                "after_several",
                include_str!("helpers/after_several.c"),
                &[Self::Product],
            ),
            Self::PositiveDefinite => (
                "positive_definite",
                include_str!("helpers/positive_definite.c"),
                &[],
            ),
            Self::General => ("general", include_str!("helpers/general.c"), &[]),
            Self::Settled => ("settled", include_str!("helpers/settled.c"), &[]),
        };
        Row { name, text, calls }
    }

    /// Its name on a page.
    pub fn name(self, prefix: &str) -> String {
        format!("{prefix}_{}", self.row().name)
    }

    /// Its definition on a page.
    pub fn definition(self, prefix: &str) -> String {
        /// Macros that are the same for all arms begin so.
        const SHARED: &str = "ROBOT_MODEL_";
        let upper = format!("{}_", prefix.to_ascii_uppercase());
        // The second replacement finds nothing that the first has put there: a prefix has no capitals.
        let named = |part: &str| {
            let part = part.replace("robot_", &format!("{prefix}_"));
            part.replace("ROBOT_", &upper)
        };
        let parts: Vec<String> = self.row().text.split(SHARED).map(named).collect();
        parts.join(SHARED)
    }
}

/// These and what they call, in the order of the page.
pub fn with_callees(called: &BTreeSet<Helper>) -> BTreeSet<Helper> {
    let callees = called.iter().flat_map(|helper| helper.row().calls);
    let all: BTreeSet<Helper> = called.iter().chain(callees).copied().collect();
    if all.len() == called.len() {
        all
    } else {
        with_callees(&all)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{Helper, with_callees};

    const ALL: [Helper; 9] = [
        Helper::Sign,
        Helper::SinesCosines,
        Helper::Series,
        Helper::After,
        Helper::Product,
        Helper::AfterSeveral,
        Helper::PositiveDefinite,
        Helper::General,
        Helper::Settled,
    ];

    /// The table says what the text does.
    #[test]
    fn helpers_call_what_the_table_says() {
        for helper in ALL {
            let text = helper.definition("arm");
            let defined = format!("{}(", helper.name("arm"));
            assert!(text.contains(&format!(" {defined}")), "{text}");
            for other in ALL.into_iter().filter(|&other| other != helper) {
                let call = format!("{}(", other.name("arm"));
                let says = helper.row().calls.contains(&other);
                assert_eq!(text.contains(&call), says, "{helper:?} calls {other:?}");
                assert!(!says || other < helper, "{other:?} stands first");
            }
        }
    }

    /// A prefix that has the word in it, or the words behind it, is put there as any other.
    #[test]
    fn a_prefix_is_put_in_once() {
        for prefix in [
            "robot",
            "robot_dof",
            "robot_states",
            "my_robot_states",
            "robot_model",
        ] {
            let upper = prefix.to_ascii_uppercase();
            for helper in ALL {
                let arm = helper
                    .definition("arm")
                    .replace("arm_", &format!("{prefix}_"));
                let wanted = arm.replace("ARM_", &format!("{upper}_"));
                assert_eq!(helper.definition(prefix), wanted);
            }
        }
    }

    #[test]
    fn what_is_called_is_there() {
        let called = BTreeSet::from([Helper::After, Helper::General]);
        let wanted = BTreeSet::from([Helper::Series, Helper::After, Helper::General]);
        assert_eq!(with_callees(&called), wanted);
    }
}
