//! Whether what is asked for can be looked for at all.

use super::{Criterion, Ends, ExciteError, Request, Rivals};

/// Most harmonics: the work grows with their third power.
const MOST_HARMONICS: usize = 100;

/// Refuses lists of another length.
pub(super) fn size(what: &'static str, found: usize, expected: usize) -> Result<(), ExciteError> {
    if found == expected {
        return Ok(());
    }
    Err(ExciteError::Size {
        what,
        found,
        expected,
    })
}

impl Request {
    pub(super) fn check(&self) -> Result<(), ExciteError> {
        self.check_sizes()?;
        self.limits.check(&self.joints)?;
        let period = self.period;
        if period.is_nan() || period <= 0.0 || period.is_infinite() {
            return Err(ExciteError::NotPositive {
                what: "period",
                value: period,
            });
        }
        let least = if self.ends == Ends::Free { 1 } else { 2 };
        if !(least..=MOST_HARMONICS).contains(&self.harmonics) {
            return Err(ExciteError::Harmonics {
                harmonics: self.harmonics,
                least,
                most: MOST_HARMONICS,
            });
        }
        for (joint, &noise) in self.joints.iter().zip(&self.noise) {
            if !(noise > 0.0 && noise.is_finite()) {
                return Err(ExciteError::Noise {
                    joint: joint.clone(),
                    noise,
                });
            }
        }
        self.check_pose()?;
        match &self.criterion {
            Criterion::Separation(rivals) => self.check_rivals(rivals),
            _ => Ok(()),
        }
    }

    fn check_sizes(&self) -> Result<(), ExciteError> {
        let dof = self.joints.len();
        let columns = self.regressor.columns.len();
        if columns == 0 || dof == 0 {
            return Err(ExciteError::NoColumns);
        }
        let limits = &self.limits;
        size("position limits", limits.position.len(), dof)?;
        size("velocity limits", limits.velocity.len(), dof)?;
        size("acceleration limits", limits.acceleration.len(), dof)?;
        size("torque limits", limits.torque.len(), dof)?;
        size("deviations of torque noise", self.noise.len(), dof)?;
        let entries = &self.regressor.entries;
        size(
            "outputs of the regressor",
            self.regressor.function.outputs(),
            entries.len(),
        )?;
        let inside = entries.iter().filter(|&&(j, c)| j < dof && c < columns);
        size(
            "entries inside the regressor",
            inside.count(),
            entries.len(),
        )?;
        if let Some(basis) = &self.basis {
            size("parameters of the basis", basis.names.len(), columns)?;
        }
        Ok(())
    }

    fn check_pose(&self) -> Result<(), ExciteError> {
        let Ends::At(pose) = &self.ends else {
            return Ok(());
        };
        if pose.len() != self.joints.len() {
            return Err(ExciteError::Ends {
                given: pose.len(),
                joints: self.joints.len(),
            });
        }
        for (k, &position) in pose.iter().enumerate() {
            let (middle, half) = self.limits.range(k);
            let away = (position - middle).abs();
            if away.is_nan() || away > half {
                return Err(ExciteError::Pose {
                    joint: self.joints[k].clone(),
                    position,
                    low: middle - half,
                    high: middle + half,
                });
            }
        }
        Ok(())
    }

    fn check_rivals(&self, rivals: &Rivals) -> Result<(), ExciteError> {
        let [first, second] = &rivals.effects;
        let refused = |reason| Err(ExciteError::Rivals(reason));
        if self.basis.is_some() {
            return refused("they are columns of the regressor, not of other parameters");
        }
        if [first, second]
            .iter()
            .any(|effect| effect.iter().all(|&(_, size)| size == 0.0))
        {
            return refused("one size is missing");
        }
        let columns = self.regressor.columns.len();
        if first
            .iter()
            .chain(second)
            .any(|&(c, size)| c >= columns || !size.is_finite())
        {
            return refused("a column or a size is missing");
        }
        if first.iter().any(|a| second.iter().any(|b| a.0 == b.0)) {
            return refused("they have a column in common");
        }
        Ok(())
    }
}
