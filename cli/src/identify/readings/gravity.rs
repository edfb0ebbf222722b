//! An arm that stands otherwise than its spec says: it hangs from a ceiling, or is on a wall.

use robot_model_codegen::compile_for_rows;
use robot_model_spec::Model;
use robot_model_spec::model::Body;

use super::candidate::{Candidate, FACTOR};
use super::{Asked, Reading, WELL_IN_SIGNS};

impl Asked<'_> {
    /// What arms leave on which gravity acts along the other axes of the base, either way; `as_logged` is left as the spec has it.
    pub(super) fn stand(&self, as_logged: &[f64]) -> Vec<Candidate> {
        let model = self.form.model();
        let others = model.chain().map(|chain| others(chain.gravity));
        let candidate = |gravity: [f64; 3]| {
            let form = self.form.of(compile_for_rows(&with(model, gravity)))?;
            let found = self.fit_of(&*form, &self.log)?;
            let has_more = form.unknowns().len() > self.form.unknowns().len();
            let is_of_arm = !has_more || mends_the_arm(&found.left, as_logged);
            let reading = Reading::Gravity(gravity);
            is_of_arm.then_some(Candidate { reading, found })
        };
        others.into_iter().flatten().filter_map(candidate).collect()
    }
}

/// The other directions along axes, the opposite one first; none where gravity is along no axis.
fn others(gravity: [f64; 3]) -> Vec<[f64; 3]> {
    let size = gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let along = |axis: usize, value: f64| {
        let mut all = [0.0; 3];
        all[axis] = value;
        all
    };
    let is_axis = |axis: &usize| size > 0.0 && gravity[*axis].abs() > 0.999 * size;
    let Some(own) = (0..3).find(is_axis) else {
        return Vec::new();
    };
    let rest = (0..3).filter(|axis| *axis != own);
    let both = rest.flat_map(|axis| [along(axis, -size), along(axis, size)]);
    let opposite = along(own, -gravity[own]);
    std::iter::once(opposite).chain(both).collect()
}

/// A gravity that bends joints which the declared one does not has parameters of its own, which may stand for a spring of one joint: the arm
/// stands otherwise where every joint that was explained ill is explained far better, several of them.
fn mends_the_arm(left: &[f64], as_logged: &[f64]) -> bool {
    let ill = || {
        let pairs = left.iter().zip(as_logged);
        pairs.filter(|(_, before)| **before > WELL_IN_SIGNS)
    };
    ill().count() > 1 && ill().all(|(left, before)| FACTOR * left < *before)
}

/// The model with another gravity.
fn with(model: &Model, gravity: [f64; 3]) -> Model {
    let mut other = model.clone();
    if let Body::Chain(chain) = &mut other.body {
        chain.gravity = gravity;
    }
    other
}

/// What it is, and a question.
pub(super) fn said(gravity: [f64; 3]) -> [String; 2] {
    let [x, y, z] = gravity.map(|g| format!("{} m/s^2", (1e3 * g).round() / 1e3));
    [
        format!("gravity along [{x}, {y}, {z}]"),
        format!(
            "how is the arm mounted, and where is the zero of its first joint? Gravity is in the frame of the base: `gravity = [{x}, {y}, {z}];`"
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_opposite_comes_first_and_no_direction_twice() {
        let found = others([0.0, 0.0, -9.81]);
        assert!(found.first().is_some_and(|first| first[2] > 9.8));
        assert_eq!(found.len(), 5);
        assert!(found.iter().all(|one| one[2] > -9.8));
        // Of a tilted base and of an arm without gravity nothing is asked.
        assert!(others([1.0, 0.0, -9.7]).is_empty() && others([0.0; 3]).is_empty());
    }

    #[test]
    fn parameters_that_explain_one_joint_are_no_other_gravity() {
        assert!(!mends_the_arm(&[1.0, 6.0], &[60.0, 6.5]));
        assert!(!mends_the_arm(&[1.0], &[60.0]));
        assert!(mends_the_arm(&[1.0, 0.8, 2.0], &[60.0, 30.0, 2.5]));
    }
}
