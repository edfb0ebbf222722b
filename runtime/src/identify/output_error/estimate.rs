//! What output error found, and how far simulated motions are from their logs.

use nalgebra::DMatrix;

use super::deviations::Deviations;
use super::equations::Equations;
use super::identifiable::{KNOWN, frail};
use super::parts::Part;
use super::ratios::{self, Ratio};
use super::run::Run;
use super::search::Ending;
use super::turns::Moves;
use super::window::Window;
use super::{Direction, Hold, Identifiability, Iterate, sums};
use crate::identify::Combination;
use crate::simulate::Adjustable;

/// How far a simulated channel is from its log.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Distance {
    /// Root of the mean square.
    pub rmse: f64,
    /// Mean absolute error.
    pub mae: f64,
    /// `100 |y - y_s| / |y|`; none of a channel that is zero throughout.
    pub relative_percent: Option<f64>,
    /// `100 (1 - |y - y_s| / |y - mean y|)`; none of a channel that stands.
    pub nrmse_fit_percent: Option<f64>,
}

/// A simulated motion beside its log, a distance a joint.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Comparison {
    /// Of positions.
    pub position: Vec<Distance>,
    /// Of torques, where a controller made them.
    pub torque: Option<Vec<Distance>>,
}

/// What output error found.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OutputEstimate {
    /// One value a parameter.
    pub values: Vec<f64>,
    /// Standard deviations, that know how errors are alike from sample to sample; none where the logs say nothing of a parameter by itself.
    pub std: Vec<Option<f64>>,
    /// The way of the search, from its start.
    pub iterates: Vec<Iterate>,
    /// How the last part of the search ended; where it ran out of iterations there are no deviations.
    pub ending: Ending,
    /// Parameters on a bound, by their places: the logs would have them beyond.
    pub bound: Vec<usize>,
    /// What the logs say of which of the other parameters.
    pub identifiability: Identifiability,
    /// Ratios of parameters of which the logs tell all but a common factor, or hardly that one: where the frail direction scales them all.
    pub ratios: Vec<Ratio>,
    /// Sums of other parameters that the logs do not tell apart; none where the search ran out of iterations.
    pub combinations: Vec<Combination>,
    /// Parameters whose deviations are small, and that hang on what the model lacks: shares of values along which positions change
    /// least, with the ratio of that to the most.
    pub frail: Option<Direction>,
    /// Where the search ran out of iterations, parameters that the logs hardly tell at the place it came to, with their deviations as shares of
    /// values.
    pub unsure: Vec<(String, f64)>,
    /// On the logs that were fitted.
    pub fit: Comparison,
    /// Positions and velocities of all degrees of freedom where each window starts.
    pub starts: Vec<Vec<f64>>,
    /// Samples a joint.
    pub samples: usize,
    /// Seconds of the windows that were fitted, none of whole logs: shorter than what was asked for where the arm runs away in those.
    pub window: Option<f64>,
    /// How logged torque goes between samples; none where a controller makes it.
    pub hold: Option<Hold>,
    /// What was found where torque goes between samples in the other way, where the logs were asked which it is.
    pub rival_hold: Option<RivalHold>,
}

/// What is found where torque goes between samples in another way than that which fits best.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct RivalHold {
    /// How it goes there.
    pub hold: Hold,
    /// By which share errors of positions are larger there, in the geometric mean of the joints.
    pub worse: f64,
    /// Values, in the order of the parameters.
    pub values: Vec<f64>,
}

impl RivalHold {
    pub(super) fn of<P: Adjustable + Clone + Sync>(part: &Part<'_, P>, best: f64) -> Self {
        let joints = part.problem.scale.len().max(1) as f64;
        Self {
            hold: part.problem.hold,
            worse: ((part.error() - best) / joints).exp() - 1.0,
            values: part.place.values.clone(),
        }
    }
}

pub(super) fn result<P: Adjustable + Clone + Sync>(
    part: Part<'_, P>,
    bounds: &[[f64; 2]],
    iterates: Vec<Iterate>,
    names: &[String],
) -> OutputEstimate {
    let Part {
        problem,
        place,
        found: (runs, ending),
        window,
    } = &part;
    let rows = problem.rows(runs);
    let reduced = Equations::new(&rows).reduced(0.0);
    let is_bound = |k: usize| {
        let [low, high] = bounds[k];
        place.values[k] <= low || place.values[k] >= high
    };
    let (bound, free): (Vec<usize>, Vec<usize>) = (0..names.len()).partition(|&k| is_bound(k));
    let values: Vec<f64> = free.iter().map(|&k| place.values[k]).collect();
    let free_names: Vec<String> = free.iter().map(|&k| names[k].clone()).collect();
    let r = reduced.r.select_columns(&free);
    let identifiability = Identifiability::new(&r, &values, &free_names);
    let told = sums::sums(&identifiability, &r, &free_names);
    let mut combinations = Vec::new();
    let mut std = vec![None; names.len()];
    let inverse = identifiability.inverse(&r);
    let moves = Moves::new(problem, (place, runs), (&rows, &reduced), (&free, &inverse));
    let noise = Deviations::new(problem.scale.len(), (&rows, &reduced), (&free, &inverse));
    // Of functions of the parameters with given slopes.
    let deviations = |slopes: &DMatrix<f64>| -> Vec<f64> {
        let pairs = noise.of(slopes).into_iter().zip(moves.squares(slopes));
        pairs
            .map(|(noise, turns)| noise.hypot(turns.sqrt()))
            .collect()
    };
    let found = deviations(&DMatrix::identity(free.len(), free.len()));
    let of_free = found.into_iter().enumerate();
    let of_free: Vec<Option<f64>> = of_free
        .map(|(place, std)| identifiability.is_identified(place).then_some(std))
        .collect();
    // What hangs on what the model lacks does so on the way, too.
    let frail = frail(&r, &values, &of_free, &free_names);
    let pairs = ratios::pairs(&identifiability, frail.as_ref(), &r, &values, &free_names);
    let mut ratio_std = vec![None; pairs.len()];
    let mut unsure = Vec::new();
    if *ending == Ending::OutOfIterations {
        for ((name, value), std) in free_names.iter().zip(&values).zip(&of_free) {
            let share = std.map_or(f64::INFINITY, |std| std / value.abs());
            if share > KNOWN {
                unsure.push((name.clone(), share));
            }
        }
    } else {
        for (&k, deviation) in free.iter().zip(of_free) {
            std[k] = deviation;
        }
        let found = deviations(&sums::slopes(&told, values.len()));
        combinations = told
            .iter()
            .zip(found)
            .map(|(sum, std)| Combination::of(sum, &values, &free_names, std))
            .collect();
        let found = deviations(&ratios::slopes(&pairs, &values));
        ratio_std = found.into_iter().map(Some).collect();
    }
    let ratios = pairs.iter().zip(ratio_std).map(|(pair, std)| Ratio {
        name: free_names[pair.of].clone(),
        reference: free_names[pair.reference].clone(),
        value: values[pair.of] / values[pair.reference],
        std,
    });
    OutputEstimate {
        ratios: ratios.collect(),
        combinations,
        frail,
        unsure,
        std,
        iterates,
        ending: *ending,
        bound,
        fit: comparison(&problem.windows, runs, problem.law.is_some()),
        samples: problem.windows.iter().map(Window::counted).sum(),
        identifiability,
        window: *window,
        hold: problem.law.is_none().then_some(problem.hold),
        rival_hold: None,
        starts: place.starts.iter().map(|x| x.as_slice().to_vec()).collect(),
        values: part.place.values,
    }
}

pub(super) fn comparison<'w>(windows: &[Window<'w>], runs: &[Run], has_law: bool) -> Comparison {
    let joints = runs.first().map_or(0, |run| run.q.len());
    let distances = |pairs: fn(&Window<'w>, &Run, usize) -> Vec<(f64, f64)>| -> Vec<Distance> {
        let distance = |joint: usize| {
            let runs = windows.iter().zip(runs);
            let all = runs.flat_map(|(window, run)| pairs(window, run, joint));
            Distance::new(&all.collect::<Vec<_>>())
        };
        (0..joints).map(distance).collect()
    };
    Comparison {
        position: distances(Window::positions),
        torque: has_law.then(|| distances(Window::torques)),
    }
}

impl Distance {
    /// Of pairs of a measured and a simulated value, at least one.
    ///
    /// # Examples
    /// ```
    /// use robot_model::identify::output_error::Distance;
    /// // Measured 1 and 3, simulated 2 both times: no better than the mean.
    /// let distance = Distance::new(&[(1.0, 2.0), (3.0, 2.0)]);
    /// assert_eq!((distance.rmse, distance.mae), (1.0, 1.0));
    /// assert_eq!(distance.nrmse_fit_percent, Some(0.0));
    /// ```
    #[must_use]
    pub fn new(pairs: &[(f64, f64)]) -> Self {
        let count = pairs.len().max(1) as f64;
        let sum = |value: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(value).sum::<f64>();
        let squares = sum(&|(y, s)| (y - s).powi(2));
        let mean = sum(&|(y, _)| *y) / count;
        let level = sum(&|(y, _)| y * y);
        let spread = sum(&|(y, _)| (y - mean).powi(2));
        let share = |of: f64| 100.0 * (squares / of).sqrt();
        Self {
            rmse: (squares / count).sqrt(),
            mae: sum(&|(y, s)| (y - s).abs()) / count,
            relative_percent: (level > 0.0).then(|| share(level)),
            nrmse_fit_percent: (spread > 1e-12 * level).then(|| 100.0 - share(spread)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_their_equations() {
        let found = Distance::new(&[(1.0, 1.5), (2.0, 2.0), (6.0, 4.5)]);
        assert!((found.mae - 2.0 / 3.0).abs() < 1e-12);
        assert!((found.rmse - (2.5_f64 / 3.0).sqrt()).abs() < 1e-12);
        let share = found.relative_percent.expect("a channel that is not zero");
        assert!((share - 100.0 * (2.5_f64 / 41.0).sqrt()).abs() < 1e-12);
        assert_eq!(Distance::new(&[(0.0, 1.0)]).relative_percent, None);
        // About the mean of what was measured, 3.
        let fit = 100.0 * (1.0 - (2.5_f64 / 14.0).sqrt());
        assert!(
            found
                .nrmse_fit_percent
                .is_some_and(|x| (x - fit).abs() < 1e-12)
        );
    }

    #[test]
    fn a_mean_fits_nothing_and_a_channel_that_stands_has_no_fit() {
        let mean = Distance::new(&[(1.0, 2.0), (3.0, 2.0)]);
        assert!(mean.nrmse_fit_percent.is_some_and(|fit| fit.abs() < 1e-12));
        assert_eq!(Distance::new(&[(2.0, 1.0); 3]).nrmse_fit_percent, None);
    }
}
