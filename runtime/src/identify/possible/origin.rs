//! Where the values of a possible arm are from.

use super::{PossibleArms, Solution};

/// Where the value of a standard parameter is from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Origin {
    /// The logs tell it.
    Logs,
    /// The spec fixes it.
    Spec,
    /// The logs tell it in a sum at most; of all values that make this sum it is the nearest to the nominal one.
    Nominal,
    /// The same where the spec has no nominal value: nearest to what stands for one.
    Assumed,
}

impl Origin {
    /// Name in JSON.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::Origin;
    /// assert_eq!(Origin::Nominal.name(), "nominal");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Logs => "logs",
            Self::Spec => "spec",
            Self::Nominal => "nominal",
            Self::Assumed => "assumed",
        }
    }
}

impl PossibleArms {
    /// Those of all standard parameters, for what logs tell of the unknowns. Each unknown that they tell has a standard parameter of its
    /// own, so a standard parameter is told where an unknown is nothing but that.
    pub(super) fn origins(&self, solution: &Solution) -> Vec<Origin> {
        let is_told = |k: usize| {
            let unknown = self.kept.iter().position(|kept| *kept == k);
            unknown.is_some_and(|c| {
                let terms = self.combinations[c].iter();
                terms
                    .filter(|(term, _)| self.fixed[*term].is_none())
                    .count()
                    == 1
                    && !solution.unexcited.contains(&c)
                    && solution.shared.iter().all(|shared| shared.lead != c)
            })
        };
        let has_nominal = |k: usize| {
            let mut links = self.links.iter();
            links.any(|link| link.parameters.contains(&k) && link.body().is_some())
        };
        let fixed = self.fixed.iter().enumerate();
        fixed
            .map(|(k, fixed)| match fixed {
                Some(_) => Origin::Spec,
                None if is_told(k) => Origin::Logs,
                None if has_nominal(k) => Origin::Nominal,
                None => Origin::Assumed,
            })
            .collect()
    }
}
