//! Output error: the parameters with which a simulated arm moves as the measured one did.
//!
//! In: an [`Adjustable`] plant, logs and where to start. Out: an [`OutputEstimate`]. A simulation is driven by the logged torque, or by the
//! controller of the experiment, and its positions are compared with the logged ones:
//! `J = 1/2 sum_j sum_k ((q_j(t_k; u) - y_jk) / s_j)^2`. Nothing is differentiated but the model, so noise of positions biases nothing; a
//! motion that runs away from its log biases all.
//!
//! Sources: Ljung 1999, System Identification, section 7.2; Janot, Vandanjon, Gautier 2014, A generic instrumental variable approach for
//! industrial robot identification, on closed loops.

mod equations;
mod estimate;
mod identifiable;
mod law;
mod parts;
mod ratios;
mod recording;
mod search;
mod starts;
mod sums;
#[cfg(test)]
mod tests;
mod turns;
mod window;

use nalgebra::DVector;
use thiserror::Error;

use crate::simulate::{Adjustable, SimulateError};

pub use estimate::{Comparison, Distance, OutputEstimate};
pub use identifiable::{Direction, Identifiability};
pub use law::{JointLaw, Law, Tap};
pub use ratios::Ratio;
pub use recording::{Hold, Recording};
pub use search::{Ending, Iterate, Search};

use estimate::{comparison, result};
use parts::Parts;
use window::{Rows, Run, Window};

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
}

/// Why there is no estimate.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum OutputErrorError {
    /// The arm cannot be simulated where the search starts.
    #[error(
        "{log}: with the parameters that the search starts from: {error}; start nearer to the arm, cut the log into windows, or simulate its controller too"
    )]
    Start {
        /// The log.
        log: String,
        /// What happened.
        error: SimulateError,
    },
    /// An arm with given parameters does not stay near its log.
    #[error(
        "{log}: with these parameters the simulated arm runs away from it: {error}; windows that are shorter keep it near"
    )]
    Away {
        /// The log.
        log: String,
        /// What happened.
        error: SimulateError,
    },
    /// Positions are the same all along.
    #[error(
        "no joint moves in these logs, so that simulated positions say nothing of the arm: move it"
    )]
    Still,
    /// A controller remembers across windows.
    #[error("a controller is simulated along whole logs; leave the window out")]
    WindowedLaw,
    /// Starts that are held are those of whole logs.
    #[error("starts that are held are those of whole logs; leave the window out")]
    WindowedStarts,
    /// Parts have other sizes than the arm.
    #[error("{what}: {found} for an arm with {expected}")]
    Size {
        /// What it is.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A start outside of its bounds.
    #[error("parameter {name} starts at {value}, outside of its bounds {low} .. {high}")]
    Outside {
        /// The parameter.
        name: String,
        /// Where it starts.
        value: f64,
        /// Its least value.
        low: f64,
        /// Its largest.
        high: f64,
    },
    /// A log lacks what its controller reads.
    #[error("{log}: it has no column `{channel}`, which the controller reads")]
    NoChannel {
        /// The log.
        log: String,
        /// The channel.
        channel: String,
    },
    /// A window without room for a motion.
    #[error("windows of {seconds} s have too few samples for a motion; make them longer")]
    Short {
        /// Its length, s.
        seconds: f64,
    },
}

/// A place of the search: parameters, and where each window starts.
#[derive(Debug, Clone)]
struct Place {
    values: Vec<f64>,
    starts: Vec<DVector<f64>>,
}

/// All windows with what they are fitted by.
struct Problem<'a, P> {
    plant: P,
    windows: Vec<Window<'a>>,
    law: Option<&'a Law>,
    hold: Hold,
    /// Where windows start, if that is not fitted.
    held_starts: Option<&'a [Vec<f64>]>,
    /// One a joint.
    scale: Vec<f64>,
    /// Iterations of a search.
    most: usize,
}

impl<P: Adjustable + Clone> Problem<'_, P> {
    fn run(
        &mut self,
        place: &Place,
        with_slopes: bool,
    ) -> Result<Vec<Run>, (usize, SimulateError)> {
        self.plant.adjust(&place.values);
        let windows = self.windows.iter().zip(&place.starts).enumerate();
        windows
            .map(|(k, (window, start))| {
                let run = window.run(&self.plant, start, self.law, self.hold, with_slopes);
                run.map_err(|error| (k, error))
            })
            .collect()
    }

    /// These parameters, and starts as logs have them.
    fn place(&mut self, values: &[f64]) -> Place {
        self.plant.adjust(values);
        let starts = if let Some(held) = self.held_starts {
            let held = held.iter();
            held.map(|start| DVector::from_column_slice(start))
                .collect()
        } else {
            let windows = self.windows.iter();
            windows.map(|window| window.start(&self.plant)).collect()
        };
        Place {
            starts,
            values: values.to_vec(),
        }
    }

    /// Windows that begin where one of another problem does start as that was found to.
    fn start_as(&self, place: &mut Place, other: &Self, known: &Place) {
        for (start, window) in place.starts.iter_mut().zip(&self.windows) {
            let same = other
                .windows
                .iter()
                .position(|other| other.begins_as(window));
            if let Some(same) = same {
                start.clone_from(&known.starts[same]);
            }
        }
    }

    fn rows(&self, runs: &[Run]) -> Vec<Rows> {
        let runs = self.windows.iter().zip(runs);
        let rows = runs.map(|(window, run)| {
            let mut rows = window.rows(run, &self.scale);
            if self.held_starts.is_some() {
                rows.by_start.fill(0.0);
            }
            rows
        });
        rows.collect()
    }

    fn cost(&self, runs: &[Run]) -> f64 {
        let rows = self.windows.iter().zip(runs);
        let squares = rows.map(|(window, run)| window.squares(run, &self.scale));
        0.5 * squares.flatten().sum::<f64>()
    }

    /// Root mean square of the errors of each joint.
    fn spread(&self, runs: &[Run]) -> Vec<f64> {
        let ones = vec![1.0; self.scale.len()];
        let mut sums = vec![0.0; ones.len()];
        let mut samples = 0;
        for (window, run) in self.windows.iter().zip(runs) {
            samples += window.counted();
            let squares = window.squares(run, &ones);
            sums.iter_mut().zip(squares).for_each(|(sum, x)| *sum += x);
        }
        let root = |sum: f64| (sum / samples.max(1) as f64).sqrt();
        sums.into_iter().map(root).collect()
    }

    /// Samples of all joints that count.
    fn samples(&self) -> usize {
        let counted = self.windows.iter().map(Window::counted);
        self.scale.len() * counted.sum::<usize>()
    }

    /// What joints are weighed by: their errors, but none by less than a share of the largest, so that one that is exact does not drown the
    /// others.
    fn scales(&self, runs: &[Run]) -> Vec<f64> {
        let spread = self.spread(runs);
        let largest = spread.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let scales = spread.into_iter();
        scales.map(|scale| scale.max(1e-3 * largest)).collect()
    }
}

impl OutputError {
    /// Looks for the parameters, from `start` on. `names` are theirs, for messages; `progress` is told each iterate.
    ///
    /// # Errors
    /// [`OutputErrorError`].
    pub fn fit<P: Adjustable + Clone>(
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
        let problem = |window, hold| self.problem(plant.clone(), recordings, window, hold);
        // From a start that is far away a short motion leads back sooner than a long one.
        let first = match self.first_window() {
            Some(first) => match problem(Some(first), hold) {
                Err(OutputErrorError::Short { .. }) => None,
                problem => Some(parts.search(problem?, Some(first), start, None)?),
            },
            None => None,
        };
        let values = first.as_ref().map_or(start, |part| &part.place.values);
        let whole = parts.search(
            problem(self.window, hold)?,
            self.window,
            values,
            first.as_ref(),
        );
        let mut part = match (whole, first) {
            // The arm runs away along the longer motion; the shorter ones have told what they could.
            (Err(_), Some(first)) => first,
            (whole, _) => whole?,
        };
        // A search that has not come to its end would only be given more time.
        if part.found.1 == search::Ending::Converged && self.is_hold_open(recordings) {
            let window = part.window;
            let other = parts.search(
                problem(window, Hold::Sample)?,
                window,
                &part.place.values,
                Some(&part),
            );
            // An arm that runs away was not driven so.
            part = match other {
                Ok(other) if other.error() < part.error() - FITS_BETTER => other,
                _ => part,
            };
        }
        Ok(result(part, &parts.bounds, parts.iterates, names))
    }

    /// How an arm with given parameters moves beside logs, with the start of each window fitted.
    ///
    /// # Errors
    /// As [`Self::fit`].
    pub fn compare<P: Adjustable + Clone>(
        &self,
        plant: &P,
        values: &[f64],
        recordings: &[Recording],
    ) -> Result<Comparison, OutputErrorError> {
        self.check_starts(plant, recordings)?;
        let bounds: Vec<[f64; 2]> = values.iter().map(|&value| [value, value]).collect();
        let hold = self.hold.unwrap_or_default();
        let near = |window, before: Option<&(Problem<'_, P>, Place)>| {
            let mut problem = self.problem(plant.clone(), recordings, window, hold)?;
            let mut place = problem.place(values);
            if let Some((shorter, known)) = before {
                problem.start_as(&mut place, shorter, known);
            }
            let found = problem.run(&place, false).and_then(|runs| {
                search::search(
                    self.search,
                    &mut problem,
                    &mut place,
                    &runs,
                    &bounds,
                    &mut Vec::new(),
                    &mut |_| (),
                )
            });
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
            .and_then(|first| near(Some(first), None).ok());
        let ((problem, _), runs) = near(self.window, first.as_ref().map(|(first, _)| first))?;
        Ok(comparison(&problem.windows, &runs, self.law.is_some()))
    }

    fn bounds_of(&self, parameters: usize) -> Vec<[f64; 2]> {
        if self.bounds.is_empty() {
            vec![[f64::NEG_INFINITY, f64::INFINITY]; parameters]
        } else {
            self.bounds.clone()
        }
    }

    fn problem<'a, P: Adjustable + Clone>(
        &'a self,
        plant: P,
        recordings: &'a [Recording],
        window: Option<f64>,
        hold: Hold,
    ) -> Result<Problem<'a, P>, OutputErrorError> {
        let windows = recordings.iter().map(|recording| {
            if recording.torque.len() != plant.joints() {
                return Err(OutputErrorError::Size {
                    what: "joints of a log",
                    found: recording.torque.len(),
                    expected: plant.joints(),
                });
            }
            Window::cut(recording, window, self.law.as_ref())
        });
        let windows: Vec<Vec<Window>> = windows.collect::<Result<_, _>>()?;
        Ok(Problem {
            scale: vec![1.0; plant.joints()],
            windows: windows.into_iter().flatten().collect(),
            law: self.law.as_ref(),
            hold,
            held_starts: self.held_starts.as_deref(),
            most: self.iterations.unwrap_or(search::MOST),
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

    fn check(
        &self,
        plant: &impl Adjustable,
        names: &[String],
        start: &[f64],
    ) -> Result<(), OutputErrorError> {
        let expected = plant.parameters();
        if let Some(seconds) = self.window {
            if seconds.is_nan() || seconds <= 0.0 {
                return Err(OutputErrorError::Short { seconds });
            }
            if self.law.is_some() {
                return Err(OutputErrorError::WindowedLaw);
            }
        }
        let sizes = [
            ("names of parameters", names.len(), expected),
            ("values to start from", start.len(), expected),
        ];
        let bounds = (!self.bounds.is_empty()).then_some(("bounds", self.bounds.len(), expected));
        let law = self.law.as_ref();
        let law = law.map(|law| ("joints of the controller", law.joints.len(), plant.joints()));
        for (what, found, expected) in sizes.into_iter().chain(bounds).chain(law) {
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
