//! Output error: the parameters with which a simulated arm moves as the measured one did.
//!
//! In: an [`Adjustable`] plant, logs and where to start. Out: an [`OutputEstimate`]. A simulation is driven by the logged torque, or by the
//! controller of the experiment, and its positions are compared with the logged ones:
//! `J = 1/2 sum_j sum_k ((q_j(t_k; u) - y_jk) / s_j)^2`. Nothing is differentiated but the model, so noise of positions biases nothing; a
//! motion that runs away from its log biases all.
//!
//! Sources: Ljung 1999, System Identification, section 7.2; Janot, Vandanjon, Gautier 2014, A generic instrumental variable approach for
//! industrial robot identification, on closed loops.

mod deviations;
mod equations;
mod error;
mod estimate;
mod identifiable;
mod law;
mod parts;
mod problem;
mod ranges;
mod ratios;
mod recording;
mod run;
mod search;
mod starts;
mod sums;
#[cfg(test)]
mod tests;
mod turns;
mod window;

use crate::simulate::Adjustable;

pub use error::OutputErrorError;
pub use estimate::{Comparison, Distance, OutputEstimate, RivalHold};
pub use identifiable::{Direction, Identifiability};
pub use law::{JointLaw, Law, Tap};
pub use ranges::{other_ranges, ranges_within};
pub use ratios::Ratio;
pub use recording::{Hold, Recording};
pub use search::{Ending, Iterate, Search};

use estimate::{comparison, result};
use parts::{Part, Parts};
use problem::{Place, Problem};
use search::End;
use window::{Pace, Window};

/// By how much the sum of the logarithms of errors has to be less where torque is held between samples, for that to be told from means.
const FITS_BETTER: f64 = 1e-3;

/// Of the window that is asked for, for the first part of a search.
const FIRST_SHARE: f64 = 0.25;

/// How an output-error estimate is made.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OutputError {
    /// Who looks for the least cost.
    pub search: Search,
    /// Least and largest value of each parameter; none are no bounds.
    pub bounds: Vec<[f64; 2]>,
    /// Logs are cut into windows of this many seconds, each with a start of its own and memories of effects at zero; none leaves them whole.
    /// Where torques drive the arm, the search begins with shorter ones.
    pub window: Option<f64>,
    /// The controller of the experiment; without it logged torques drive the arm.
    pub law: Option<Law>,
    /// Logged torque between samples; none is the one whose errors are less, where it makes a difference.
    pub hold: Option<Hold>,
    /// Positions and velocities of all degrees of freedom where each log starts, which are held there, as of a velocity from differences;
    /// none are fitted. For whole logs.
    pub held_starts: Option<Vec<Vec<f64>>>,
    /// Iterations at most of each part of the search; none are 100.
    pub iterations: Option<usize>,
    /// Cost that the first part of the search has to come below, or it is given up there: that of another search, of which this one is to tell
    /// whether there is a deeper valley.
    pub below: Option<f64>,
}

impl OutputError {
    /// Looks for the parameters, from `start` on. `names` are theirs, for messages; `progress` is told each iterate.
    ///
    /// # Errors
    /// [`OutputErrorError`].
    ///
    /// # Examples
    /// A block on oil, `m ddq + c dq = tau` with 2 kg and 0.7 N s/m; its [`Adjustable`] plant is 25 lines.
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// # use block::{Block, measure};
    /// use robot_model::identify::output_error::{Hold, OutputError, Recording};
    /// let recording = Recording::new(&measure(), &[1.0], 0.0, Vec::new());
    /// let settings = OutputError { hold: Some(Hold::Sample), ..OutputError::default() };
    /// let (start, names) = ([3.0, 0.2], ["m", "c"].map(str::to_owned));
    /// let found = settings.fit(&Block(start), &names, &start, &[recording], &mut |_| ())?;
    /// assert!((found.values[0] - 2.0).abs() < 1e-4 && (found.values[1] - 0.7).abs() < 1e-4);
    /// # Ok::<(), robot_model::identify::output_error::OutputErrorError>(())
    /// ```
    pub fn fit<P: Adjustable + Clone + Sync>(
        &self,
        plant: &P,
        names: &[String],
        start: &[f64],
        recordings: &[Recording],
        progress: &mut dyn FnMut(&Iterate),
    ) -> Result<OutputEstimate, OutputErrorError> {
        self.check(plant, names, start)?;
        self.check_starts(plant, recordings)?;
        if !recordings.iter().any(Recording::moves) {
            return Err(OutputErrorError::Still);
        }
        let mut plant = plant.clone();
        plant.prepare();
        let mut parts = Parts::new(self, start.len(), plant.joints(), progress);
        let hold = self.hold.unwrap_or_default();
        let problem = |window, pace| self.problem(plant.clone(), recordings, (window, pace), hold);
        let coarse = problem(self.window, Pace::Coarse)?;
        let other_hold = self.other_hold(recordings);
        parts.to_come = 1
            + usize::from(self.first_window().is_some())
            + usize::from(coarse.is_coarse())
            + match other_hold {
                None => 0,
                Some(End::Fine) => 1,
                Some(End::Rough) => 2,
            };
        // From a start that is far away a short motion leads back sooner than a long one.
        let first = match self.first_window() {
            Some(first) => match problem(Some(first), Pace::Coarse) {
                Err(OutputErrorError::Short { .. }) => {
                    parts.to_come -= 1;
                    None
                }
                problem => Some(parts.search(problem?, Some(first), start, None, End::Rough)?),
            },
            None => None,
        };
        let values = first.as_ref().map_or(start, |part| &part.place.values);
        let near = if coarse.is_coarse() {
            let found = parts.search(coarse, self.window, values, first.as_ref(), End::Rough);
            found.ok()
        } else {
            None
        };
        let before = near.as_ref().or(first.as_ref());
        let values = before.map_or(start, |part| &part.place.values);
        let whole = problem(self.window, Pace::Sample)?;
        let whole = parts.search(whole, self.window, values, before, End::Fine);
        let mut part = match (whole, first) {
            // The arm runs away along the longer motion; the shorter ones have told what they could.
            (Err(_), Some(first)) => {
                let (window, values) = (first.window, &first.place.values);
                parts.search(
                    problem(window, Pace::Sample)?,
                    window,
                    values,
                    Some(&first),
                    End::Fine,
                )?
            }
            (whole, _) => whole?,
        };
        let mut rival = None;
        // A search that has not come to its end would only be given more time.
        if part.found.1 == search::Ending::Converged
            && let Some(end) = other_hold
        {
            let window = part.window;
            let mut other = |from: &Part<'_, P>, end: End| {
                let cut = (window, Pace::Sample);
                let problem = self.problem(plant.clone(), recordings, cut, Hold::Sample)?;
                parts.search(problem, window, &from.place.values, Some(from), end)
            };
            let is_better = |other: &Part<'_, P>| other.error() < part.error() - FITS_BETTER;
            // An arm that runs away was not driven so.
            let found = match (other(&part, end), end) {
                (Ok(rough), End::Rough) => is_better(&rough)
                    .then(|| other(&rough, End::Fine).ok())
                    .flatten(),
                (found, _) => found.ok(),
            };
            if let Some(other) = found {
                let (chosen, left) = if is_better(&other) {
                    (other, part)
                } else {
                    (part, other)
                };
                rival = Some(RivalHold::of(&left, chosen.error()));
                part = chosen;
            }
        }
        Ok(OutputEstimate {
            rival_hold: rival,
            ..result(part, &parts.bounds, parts.iterates, names)
        })
    }

    /// How an arm with given parameters moves beside logs, with the start of each window fitted.
    ///
    /// # Errors
    /// As [`Self::fit`].
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// # use block::{Block, measure};
    /// # use robot_model::identify::output_error::{Hold, OutputError, Recording};
    /// let recordings = [Recording::new(&measure(), &[1.0], 0.0, Vec::new())];
    /// let settings = OutputError { hold: Some(Hold::Sample), ..OutputError::default() };
    /// let rmse = |m: f64| Ok(settings.compare(&Block([m, 0.7]), &[m, 0.7], &recordings)?.position[0].rmse);
    /// assert!(rmse(2.0)? < 1e-6);
    /// assert!(rmse(2.2)? > 1e-3); // m, of a block that is a tenth too heavy
    /// # Ok::<(), robot_model::identify::output_error::OutputErrorError>(())
    /// ```
    pub fn compare<P: Adjustable + Clone + Sync>(
        &self,
        plant: &P,
        values: &[f64],
        recordings: &[Recording],
    ) -> Result<Comparison, OutputErrorError> {
        self.check_settings(plant)?;
        if values.len() != plant.parameters() {
            return Err(OutputErrorError::Size {
                what: "values of parameters",
                found: values.len(),
                expected: plant.parameters(),
            });
        }
        self.check_starts(plant, recordings)?;
        let bounds: Vec<[f64; 2]> = values.iter().map(|&value| [value, value]).collect();
        let hold = self.hold.unwrap_or_default();
        let near = |cut, before: Option<&(Problem<'_, P>, Place)>| {
            let mut problem = self.problem(plant.clone(), recordings, cut, hold)?;
            let mut place = problem.place(values);
            if let Some((shorter, known)) = before {
                problem.start_as(&mut place, shorter, known);
            }
            let found = search::search(
                self.search,
                &mut problem,
                &mut place,
                &bounds,
                &mut Vec::new(),
                &mut |_| (),
            );
            match found {
                Ok((runs, _)) => Ok(((problem, place), runs)),
                Err((k, error)) => Err(OutputErrorError::Away {
                    log: problem.windows[k].source().to_owned(),
                    error,
                }),
            }
        };
        // Starts that are a little off run away along the whole window, and are found along a part of it.
        let first = self
            .first_window()
            .and_then(|first| near((Some(first), Pace::Coarse), None).ok());
        let cut = (self.window, Pace::Sample);
        let ((problem, _), runs) = near(cut, first.as_ref().map(|(first, _)| first))?;
        Ok(comparison(&problem.windows, &runs, self.law.is_some()))
    }

    fn bounds_of(&self, parameters: usize) -> Vec<[f64; 2]> {
        if self.bounds.is_empty() {
            vec![[f64::NEG_INFINITY, f64::INFINITY]; parameters]
        } else {
            self.bounds.clone()
        }
    }

    fn problem<'a, P: Adjustable + Clone + Sync>(
        &'a self,
        plant: P,
        recordings: &'a [Recording],
        (window, pace): (Option<f64>, Pace),
        hold: Hold,
    ) -> Result<Problem<'a, P>, OutputErrorError> {
        // A controller acts at each sample.
        let pace = if self.law.is_some() {
            Pace::Sample
        } else {
            pace
        };
        let windows = recordings.iter().map(|recording| {
            if recording.torque.len() != plant.joints() {
                return Err(OutputErrorError::Size {
                    what: "joints of a log",
                    found: recording.torque.len(),
                    expected: plant.joints(),
                });
            }
            Window::cut(recording, window, self.law.as_ref(), pace)
        });
        let windows: Vec<Vec<Window>> = windows.collect::<Result<_, _>>()?;
        Ok(Problem {
            scale: vec![1.0; plant.joints()],
            windows: windows.into_iter().flatten().collect(),
            law: self.law.as_ref(),
            hold,
            held_starts: self.held_starts.as_deref(),
            most: self.iterations.unwrap_or(search::MOST),
            end: End::Fine,
            part: 0.0..1.0,
            plant,
        })
    }

    /// Held starts are of whole logs, one a log.
    fn check_starts(
        &self,
        plant: &impl Adjustable,
        recordings: &[Recording],
    ) -> Result<(), OutputErrorError> {
        let Some(starts) = &self.held_starts else {
            return Ok(());
        };
        if self.window.is_some() {
            return Err(OutputErrorError::WindowedStarts);
        }
        let state = 2 * plant.dof();
        let of_logs = ("starts that are held", starts.len(), recordings.len());
        let of_states = starts.iter().map(|x| ("values of a start", x.len(), state));
        match std::iter::once(of_logs)
            .chain(of_states)
            .find(|(_, found, expected)| found != expected)
        {
            Some((what, found, expected)) => Err(OutputErrorError::Size {
                what,
                found,
                expected,
            }),
            None => Ok(()),
        }
    }

    /// Windows and controller.
    fn check_settings(&self, plant: &impl Adjustable) -> Result<(), OutputErrorError> {
        if let Some(seconds) = self.window {
            if seconds.is_nan() || seconds <= 0.0 {
                return Err(OutputErrorError::Short { seconds });
            }
            if self.law.is_some() {
                return Err(OutputErrorError::WindowedLaw);
            }
        }
        match self.law.as_ref().map(|law| law.joints.len()) {
            Some(found) if found != plant.joints() => Err(OutputErrorError::Size {
                what: "joints of the controller",
                found,
                expected: plant.joints(),
            }),
            _ => Ok(()),
        }
    }

    fn check(
        &self,
        plant: &impl Adjustable,
        names: &[String],
        start: &[f64],
    ) -> Result<(), OutputErrorError> {
        self.check_settings(plant)?;
        let expected = plant.parameters();
        let sizes = [
            ("names of parameters", names.len(), expected),
            ("values to start from", start.len(), expected),
        ];
        let bounds = (!self.bounds.is_empty()).then_some(("bounds", self.bounds.len(), expected));
        for (what, found, expected) in sizes.into_iter().chain(bounds) {
            if found != expected {
                return Err(OutputErrorError::Size {
                    what,
                    found,
                    expected,
                });
            }
        }
        for ((&[low, high], &value), name) in self.bounds.iter().zip(start).zip(names) {
            if !(low <= value && value <= high) {
                return Err(OutputErrorError::Outside {
                    name: name.clone(),
                    value,
                    low,
                    high,
                });
            }
        }
        Ok(())
    }
}
