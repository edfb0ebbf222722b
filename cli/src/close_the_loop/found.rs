//! What was found, with the values that the arm has with it.

use robot_model::trace::Finding;

use super::{Loop, Stage};

/// Deviations that a parameter is told by.
const TOLD: f64 = 2.0;

/// How well the value of a parameter is known.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Sure {
    /// With this standard deviation.
    Std(f64),
    /// As well as the share of a motor in a sum of the motor and its link, which the logs do not tell: a stiffness scales with the load, and the
    /// load is what the motor leaves.
    Nominal,
    /// Not at all: others do the same.
    Traded,
    /// Not at all: the logs do not show it, as a drive's largest speed that no motion comes near.
    Unfelt,
}

impl Sure {
    /// The standard deviation, where there is one.
    #[must_use]
    pub fn std(self) -> Option<f64> {
        match self {
            Self::Std(std) => Some(std),
            Self::Nominal | Self::Traded | Self::Unfelt => None,
        }
    }

    /// Why there is none, in the words of reports.
    #[must_use]
    pub const fn without_interval(self) -> Option<&'static str> {
        match self {
            Self::Std(_) => None,
            Self::Nominal => Some("as far as the spec splits motor and link correctly"),
            Self::Traded => Some("not separable from other parameters"),
            Self::Unfelt => Some("not determined by these logs"),
        }
    }
}

impl Stage {
    /// Name of one of the model's last effects, which are the findings; none of a lead, which is not declared.
    fn effect_name(&self, findings: usize, place: usize) -> Option<String> {
        let model = &self.arm.compiled().model;
        let first = model.effects.len().checked_sub(findings)?;
        (place < findings).then(|| model.effect_name(first + place))
    }

    /// Names, values and deviations of a finding's parameters: as the model was identified with them, else as they were traced. Shapes of a
    /// spec are fixed, so that deviations with it know nothing of theirs. A law that was traced before a change of the arm, and has no shapes,
    /// has those of the model with it alone: what was missing is in the others.
    fn parameters<'a>(
        &self,
        finding: &'a Finding,
        effect: Option<&str>,
    ) -> Vec<(&'a str, f64, Option<f64>)> {
        let has_shapes = finding.parameters.iter().any(|one| one.shape);
        let is_afresh = finding.precedes_change && !has_shapes;
        let all = finding.parameters.iter().map(|traced| {
            let afresh = effect.and_then(|effect| {
                let full = format!("{effect}.{}", traced.name);
                let mut all = self.estimate.parameters.iter();
                all.find(|one| one.name == full)
            });
            let std = traced.std.map(|std| match afresh {
                Some(afresh) if is_afresh => afresh.std,
                Some(afresh) => std.max(afresh.std),
                None => std,
            });
            let value = afresh.map_or(traced.value, |afresh| afresh.value);
            (traced.name.as_str(), value, std)
        });
        all.collect()
    }

    /// The first finding of which nothing is left in a model that was identified with all of them: none of its parameters stands out of its
    /// deviation.
    pub(super) fn vanished(&self, findings: &[Finding]) -> Option<usize> {
        (0..findings.len()).find(|&place| {
            let effect = self.effect_name(findings.len(), place);
            let parameters = self.parameters(&findings[place], effect.as_deref());
            // What others do as well says nothing.
            let own = parameters.into_iter();
            let own: Vec<f64> = own
                .filter_map(|(_, value, std)| std.map(|std| value.abs() - TOLD * std))
                .collect();
            !own.is_empty() && own.iter().all(|beyond| *beyond <= 0.0)
        })
    }
}

impl Loop {
    /// Name of a finding in the amended model; none of a lead.
    pub(crate) fn effect_name(&self, place: usize) -> Option<String> {
        self.after().effect_name(self.verdict.findings.len(), place)
    }

    /// Whether links give way to their load by a finding.
    pub(crate) fn is_spring(&self, finding: &Finding) -> bool {
        let mut definitions = self.before.arm.compiled().model.definitions.iter();
        definitions.any(|one| one.name == finding.effect && one.gives_way())
    }

    /// Names and values of a finding's parameters, or of a lead's as it was traced, and how well they are known.
    #[must_use]
    pub fn parameters<'a>(&self, finding: &'a Finding, place: usize) -> Vec<(&'a str, f64, Sure)> {
        let effect = self.effect_name(place);
        let arm = self.after().arm.compiled();
        let is_nominal = self.is_spring(finding) && !arm.mixed_on(&finding.joints).is_empty();
        let all = self.after().parameters(finding, effect.as_deref());
        let sure = |std: Option<f64>, is_felt: bool| match std {
            Some(_) if is_nominal => Sure::Nominal,
            Some(std) => Sure::Std(std),
            None if is_felt => Sure::Traded,
            None => Sure::Unfelt,
        };
        let all = all.into_iter().zip(&finding.parameters);
        all.map(|((name, value, std), traced)| (name, value, sure(std, traced.is_felt)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use robot_model::trace::{Finding, Outcome};

    use super::Sure;
    use crate::close_the_loop::close;
    use crate::progress::Progress;
    use crate::trace::cart::{CART, log};

    /// What stands out of its deviation in the model that was identified with it is found, and nothing else is.
    #[test]
    fn a_finding_of_which_nothing_is_left_has_vanished() {
        let closed = close("cart.robot", CART, &[log()], None, &Progress::new())
            .unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(
            (closed.outcome(), closed.vanished),
            (Outcome::Explained, None)
        );
        let findings = &closed.verdict.findings;
        let mut stage = closed.changed.expect("an amended model");
        assert_eq!(stage.vanished(findings), None);
        let mut all = stage.estimate.parameters.iter_mut();
        let friction = all.find(|one| one.name == "rail.coulomb_friction.fc");
        let friction = friction.expect("dry friction");
        let std = findings[0].parameters[0].std.expect("a deviation");
        friction.value = 1.5 * std.max(friction.std);
        assert_eq!(stage.vanished(findings), Some(0));
    }

    /// No value is claimed of a shape that the logs do not show.
    #[test]
    fn a_shape_that_is_not_felt_has_no_interval() {
        let closed = close("cart.robot", CART, &[log()], None, &Progress::new())
            .unwrap_or_else(|error| panic!("{error}"));
        let mut finding = closed.verdict.findings[0].clone();
        let sure = |finding: &Finding| closed.parameters(finding, 0)[0].2;
        assert!(sure(&finding).without_interval().is_none());
        finding.parameters[0].std = None;
        assert_eq!(sure(&finding), Sure::Traded);
        finding.parameters[0].is_felt = false;
        assert_eq!((sure(&finding), sure(&finding).std()), (Sure::Unfelt, None));
        assert_eq!(
            sure(&finding).without_interval(),
            Some("not determined by these logs")
        );
    }

    /// A change of the arm that was found later leaves less noise than a law was traced in.
    #[test]
    fn a_law_before_a_change_has_the_deviations_of_the_arm_with_it() {
        let closed = close("cart.robot", CART, &[log()], None, &Progress::new())
            .unwrap_or_else(|error| panic!("{error}"));
        let mut finding = closed.verdict.findings[0].clone();
        let std = |finding: &Finding| {
            closed.parameters(finding, 0)[0]
                .2
                .std()
                .expect("a deviation")
        };
        let own = std(&finding);
        finding.parameters[0].std = Some(35.0 * own);
        assert!((std(&finding) / own - 35.0).abs() < 1e-9);
        finding.precedes_change = true;
        let parameters = &closed.after().estimate.parameters;
        let mut friction = parameters.iter();
        let friction = friction.find(|one| one.name == "rail.coulomb_friction.fc");
        let afresh = friction.expect("dry friction").std;
        assert!((std(&finding) - afresh).abs() < 1e-12 && afresh < 2.0 * own);
    }
}
