//! Essential parameters: those without which an arm is predicted worse than the noise of the logs allows.
//!
//! Parameter after parameter is left out, each time the one whose value is least beside its deviation, and the rest is identified
//! anew, until every one that is left is told from zero.
//!
//! Source: Pham, Gautier 1991, Essential parameters of robots, with a fixed confidence in place of a ratio of deviations.

use super::least_squares::Solution;
use super::stack::Stack;
use super::{Combination, Identified, Identify, IdentifyError};

/// A value is told from zero when it is at least so many deviations from it: 95 %.
const TOLD: f64 = 1.96;

/// The parameters that are essential, identified without the others.
///
/// # Examples
/// A pendulum whose friction is next to nothing: what the logs cannot tell from zero is left out.
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use pendulum::{measure, pendulum};
/// # use robot_model::identify::Identify;
/// let mut log = measure(0.0);
/// // The log without its friction of 1 N m s/rad.
/// for k in 1..log.time.len() - 1 {
///     log.tau[0][k] -= (log.q[0][k + 1] - log.q[0][k - 1]) / 0.004;
/// }
/// let identify = Identify { essential: true, ..Identify::default() };
/// let estimate = identify.fit(&pendulum(), &[log])?;
/// let essential = estimate.essential.as_ref().expect("it was asked for");
/// let names: Vec<&str> = essential.parameters.iter().map(|one| one.name.as_str()).collect();
/// assert_eq!(names, ["link.izz", "link.mx"]);
/// # Ok::<(), robot_model::identify::IdentifyError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Essential {
    /// What is left, with values and deviations of its own fit, in the arm's order.
    pub parameters: Vec<Identified>,
    /// Sums of parameters that the logs tell, of whose parts they tell none.
    pub combinations: Vec<Combination>,
    /// `100 || residual || / || tau ||` per joint with those alone.
    pub relative_percent: Vec<f64>,
}

/// What is essential of a solution with its deviations.
pub(super) fn find(
    identify: &Identify,
    mut stack: Stack,
    solution: &Solution,
) -> Result<Essential, IdentifyError> {
    let mut solution = solution.clone();
    while let Some(worst) = least_told(&solution) {
        stack.silence(&[worst]);
        if solution.unexcited.len() + 1 == solution.estimate.len() {
            // Nothing is told from zero.
            solution.estimate.fill(0.0);
            solution.unexcited = (0..solution.estimate.len()).collect();
            break;
        }
        solution = identify.solve_stack(&stack)?;
        solution.std = identify.deviations(&stack, &solution);
    }
    let names: Vec<String> = stack.unknowns.iter().map(|one| one.name.clone()).collect();
    let told = (0..solution.estimate.len()).filter(|c| solution.is_told(*c));
    let parameters = told.map(|c| Identified {
        name: names[c].clone(),
        value: solution.estimate[c],
        std: solution.std[c],
    });
    Ok(Essential {
        parameters: parameters.collect(),
        combinations: Combination::all(&solution, &names),
        relative_percent: stack.relative_percent(&solution.estimate),
    })
}

/// The parameter that is least of all told from zero, where there is one.
fn least_told(solution: &Solution) -> Option<usize> {
    let n = solution.estimate.len();
    let told = (0..n).filter(|c| !solution.unexcited.contains(c));
    let told = told.map(|c| (c, solution.estimate[c].abs() / solution.std[c]));
    let least = told.min_by(|one, other| one.1.total_cmp(&other.1));
    least
        .filter(|(_, ratio)| *ratio < TOLD)
        .map(|(column, _)| column)
}
