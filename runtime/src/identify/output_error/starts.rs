//! Which of several starts lead deepest.
//!
//! Costs have several valleys where shapes matter, as that of a Stribeck curve, and a search ends in the one where it starts. A few
//! steps from each of several starts tell which valley is the deepest.

use super::run::Asked;
use super::window::Pace;
use super::{Iterate, OutputError, OutputErrorError, Recording, search};
use crate::simulate::Adjustable;

/// Steps from each start.
const STEPS: usize = 8;

impl OutputError {
    /// Where a few steps from each of several starts lead, the best first; costs are compared by the sum of the logarithms of each joint's
    /// error. Starts from which the arm does not move, or that are out of bounds, do not count, unless none is left: then it is the first.
    ///
    /// # Errors
    /// [`OutputErrorError`] where nothing can be simulated.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// # use block::{Block, measure};
    /// # use robot_model::identify::output_error::{Hold, OutputError, Recording};
    /// let recordings = [Recording::new(&measure(), &[1.0], 0.0, Vec::new())];
    /// let settings = OutputError { hold: Some(Hold::Sample), ..OutputError::default() };
    /// let names = ["m", "c"].map(str::to_owned);
    /// let starts = [vec![500.0, 30.0], vec![1.8, 0.5]];
    /// let led = settings.nearest(&Block([2.0, 0.7]), &names, &starts, &recordings, &mut |_| ())?;
    /// assert!((led[0][0] - 2.0).abs() < 0.01);
    /// # Ok::<(), robot_model::identify::output_error::OutputErrorError>(())
    /// ```
    pub fn nearest<P: Adjustable + Clone + Sync>(
        &self,
        plant: &P,
        names: &[String],
        starts: &[Vec<f64>],
        recordings: &[Recording],
        progress: &mut dyn FnMut(&Iterate),
    ) -> Result<Vec<Vec<f64>>, OutputErrorError> {
        let Some(first) = starts.first() else {
            return Err(OutputErrorError::Size {
                what: "starts",
                found: 0,
                expected: 1,
            });
        };
        if starts.len() == 1 {
            return Ok(vec![first.clone()]);
        }
        let mut plant = plant.clone();
        plant.prepare();
        let mut places: Vec<(f64, Vec<f64>)> = Vec::new();
        for start in starts {
            if self.check(&plant, names, start).is_err() {
                continue;
            }
            let (window, hold) = (self.first_window(), self.hold.unwrap_or_default());
            let problem =
                |window| self.problem(plant.clone(), recordings, (window, Pace::Coarse), hold);
            let mut problem = match problem(window) {
                Err(OutputErrorError::Short { .. }) => problem(self.window)?,
                problem => problem?,
            };
            problem.most = STEPS;
            let mut place = problem.place(start);
            let bounds = self.bounds_of(start.len());
            let mut iterates = Vec::new();
            let Ok(runs) = problem.run(&place, Asked::Motion) else {
                continue;
            };
            problem.scale = problem.scales(&runs);
            let found = search::search(
                self.search,
                &mut problem,
                &mut place,
                &bounds,
                &mut iterates,
                progress,
            );
            let Ok((runs, _)) = found else {
                continue;
            };
            places.push((problem.error(&runs), place.values));
        }
        if places.is_empty() {
            return Ok(vec![first.clone()]);
        }
        places.sort_by(|one, other| one.0.total_cmp(&other.0));
        Ok(places.into_iter().map(|(_, values)| values).collect())
    }

    /// The window of the first part of a search.
    pub(super) fn first_window(&self) -> Option<f64> {
        self.window.map(|window| super::FIRST_SHARE * window)
    }
}
