//! All that an arm may have and its spec does not declare.

use robot_model::columns::Candidate;

use super::{InterpretedArm, InterpretedBody, InterpretedCandidate, InterpretedChange};

/// Effects that a spec does not declare, by what they are.
#[derive(Debug, Clone)]
pub struct Undeclared {
    torques: Vec<InterpretedCandidate>,
    bodies: Vec<InterpretedBody>,
    changes: Vec<InterpretedChange>,
}

impl InterpretedArm {
    /// Every effect that the spec may declare and does not.
    #[must_use]
    pub fn undeclared(&self) -> Undeclared {
        Undeclared {
            torques: self.candidates(),
            bodies: self.bodies(),
            changes: self.changes(),
        }
    }
}

impl Undeclared {
    /// All of them.
    #[must_use]
    pub fn candidates(&self) -> Vec<&dyn Candidate> {
        let torques = self.torques.iter().map(|torque| torque as &dyn Candidate);
        let bodies = self.bodies.iter().map(|body| body as &dyn Candidate);
        let changes = self.changes.iter().map(|change| change as &dyn Candidate);
        torques.chain(bodies).chain(changes).collect()
    }
}
