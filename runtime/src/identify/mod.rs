//! Identification: from logs and a model's columns to parameters with their uncertainty.
//!
//! # Examples
//! A pendulum, `tau = izz ddq + mx sin(q) + fv dq`, whose machine has `izz = 2`, `mx = 9`, `fv = 1`.
//! ```
//! # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); } use pendulum::{measure, pendulum};
//! use robot_model::identify::Identify;
//!
//! let (arm, log) = (pendulum(), measure(0.0));
//! let estimate = Identify::default().fit(&arm, &[log])?;
//! println!("{estimate}");
//! for (value, truth) in estimate.values().iter().zip([2.0, 9.0, 1.0]) {
//!     assert!((value - truth).abs() < 0.01 * truth);
//! }
//! # Ok::<(), robot_model::identify::IdentifyError>(())
//! ```

mod autoregression;
mod band;
mod bootstrap;
mod clipped;
mod combination;
mod creep;
mod deviated;
pub(crate) mod drowned;
mod error;
mod errors;
mod essential;
mod estimate;
mod factor;
mod filtered;
mod fitted;
mod hac;
mod instruments;
mod judged;
mod lacking;
mod late;
mod least_squares;
pub(crate) mod left_out;
mod logs;
mod method;
mod motion;
pub mod output_error;
mod payload;
mod possible;
mod ridge;
mod robust;
mod shapes;
mod short;
pub(crate) mod slope;
mod smoothed;
mod stack;
mod table;
mod total;
mod turns;

pub(crate) use autoregression::Autoregression;
pub(crate) use autoregression::long_run_sum;
pub use bootstrap::Bootstrap;
pub use combination::{Combination, Shared};
use deviated::Solved;
pub use deviated::Z_95;
pub use drowned::PositionNoise;
pub use error::IdentifyError;
pub use errors::Errors;
pub use essential::Essential;
pub use estimate::{Estimate, Form, Identified};
pub use factor::{Factor, FactorBlock, FactorRows};
use fitted::Fitted;
pub use hac::correlation_time;
pub use instruments::Hausman;
pub use judged::judged_samples;
use lacking::Lacking;
pub use lacking::{HiddenDelay, OtherFriction};
pub(crate) use late::longest_period;
pub use late::{Delay, is_delay};
pub use least_squares::{Factors, RANK_TOLERANCE, Solution};
use least_squares::{check_counts, check_excited};
use logs::update_load;
pub(crate) use logs::{check_logs, load_motion, missing_input, prepare_all, slowest_bands};
use method::Beside;
pub use method::{Beyond, Method, Weights};
pub use payload::{Carried, DriveGain, Driven, KnownPayload};
pub use possible::{Origin, Possible, PossibleArms, PossibleLink};
pub(crate) use shapes::{golden, is_of_decades, moved, neighbors, with_slopes};
pub use smoothed::Smoothed;
pub(crate) use stack::whole_torque;
pub use stack::{JointRows, Segment, Stack, filtered_columns, torque_of};
pub use table::{is_shape_told, relative_deviation, table_value};
pub use turns::AtTurns;
pub(crate) use turns::{away as away_from_turns, leave_out as leave_out_turns};

use crate::columns::{Arm, Nominal};
use crate::log::Log;
use crate::signal::{Bands, Prepared};
use crate::simulate::Trajectory;

/// How often the torque of the rigid body, which some effects depend on, is computed from the last estimate.
const RIGID_TORQUE_PASSES: usize = 4;

/// Identification of an arm's unknowns from logs.
///
/// Torque and every regressor column pass one zero-phase low-pass and are decimated; then
/// `minimize sum_j || tau_j - W_j beta ||^2 / sigma_j^2` by QR, with `sigma_j = 1` for [`Method::Ls`]; other methods go on from there.
#[derive(Debug, Clone)]
pub struct Identify {
    /// How parameters are found.
    pub method: Method,
    /// How joints are weighed, by methods that take weights.
    pub weights: Weights,
    /// Filter bands; `None`: the shared band is chosen from the logs, as wide as the model's torque stands out.
    pub bands: Option<Bands>,
    /// Of [`Method::Ridge`]: by which share of a body's own size its nominal values are off, one standard deviation.
    pub prior: f64,
    /// Of [`Method::Instrumental`]: a motion without noise for each log, the wanted one or a simulated one, that starts with it. The
    /// log's own positions are refused: their noise is that of its columns.
    pub instruments: Vec<Trajectory>,
    /// Values of the shapes that the spec leaves open, in its order; `None`: they are looked for.
    pub shapes: Option<Vec<f64>>,
    /// Of [`Method::Ls`], [`Method::Wls`] and [`Method::Robust`]: how often blocks of the logs are drawn for intervals, 100 times or more; 0 for none.
    pub bootstrap: usize,
    /// Of the same methods: whether to look for the parameters that are essential.
    pub essential: bool,
    /// What becomes of rows around the turns of [`Arm::dry_joints`].
    pub at_turns: AtTurns,
    /// What is asked beyond the parameters.
    pub beyond: Beyond,
}

impl Default for Identify {
    fn default() -> Self {
        Self {
            method: Method::default(),
            weights: Weights::default(),
            bands: None,
            prior: 0.3,
            instruments: Vec::new(),
            shapes: None,
            bootstrap: 0,
            essential: false,
            at_turns: AtTurns::default(),
            beyond: Beyond::default(),
        }
    }
}

impl Identify {
    /// Identifies from one or several logs.
    ///
    /// # Errors
    /// [`IdentifyError`]: no log, a log of another arm, too few samples, an arm that does not move, signals that cannot be
    /// filtered. Unknowns that the logs do not excite are no error: the estimate names them.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); } use pendulum::*;
    /// let found = robot_model::identify::Identify::default().fit(&pendulum(), &[measure(0.0)]).expect("it moves");
    /// assert!((found.values()[0] - 2.0).abs() < 0.02); // kg m^2
    /// ```
    pub fn fit(&self, arm: &dyn Arm, logs: &[Log]) -> Result<Estimate, IdentifyError> {
        check_logs(arm, logs)?;
        self.away_from_turns(arm, &|identify| identify.fit_rows(arm, logs))
    }

    fn fit_rows(&self, arm: &dyn Arm, logs: &[Log]) -> Result<Estimate, IdentifyError> {
        let bands = match self.bands {
            Some(bands) => bands,
            None => self.choose_bands(arm, logs)?,
        };
        let mut prepared = prepare_all(logs, &bands)?;
        let solved = self.solve(arm, &mut prepared, self.given_shapes(arm)?)?;
        let of_logs = (logs, prepared.as_slice(), &bands);
        let prepare = |logs: &[Log]| prepare_all(logs, &bands);
        let solved = self.without_drowned(arm, of_logs, prepare, solved)?;
        let shapes = solved.1.clone();
        let solved = self.deviated(arm, &prepared, solved);
        let without = self.surer_without(&solved, &|identify| identify.fit_rows(arm, logs));
        if let Some(without) = without {
            return Ok(without);
        }
        let found = solved.solution.estimate.clone();
        let late = self.delays_in(arm, of_logs, &solved.stack, (&shapes, &found));
        let lacking = self.lacking(arm, &prepared, &|_, _, tau| tau, &solved);
        let instruments = |shapes: &[f64]| -> Result<Stack, IdentifyError> {
            let wanted = self.wanted(logs)?;
            let mut wanted = prepare_all(&wanted, &bands)?;
            // What effects read of the load is that of the estimate.
            update_load(arm, &mut wanted, shapes, &found);
            Ok(instruments::rows(arm, &wanted, shapes))
        };
        let estimate = self.estimate(arm, Form::Acceleration, bands, (solved, lacking), &|| {
            instruments(&shapes)
        })?;
        Ok(estimate.with_late(late))
    }

    /// Shapes that are not looked for.
    fn given_shapes(&self, arm: &dyn Arm) -> Result<Option<Vec<f64>>, IdentifyError> {
        match &self.shapes {
            Some(shapes) if shapes.len() != arm.shapes().len() => Err(IdentifyError::Shapes {
                given: shapes.len(),
                open: arm.shapes().len(),
            }),
            shapes => Ok(shapes.clone()),
        }
    }

    /// What was found, by the method that is wanted; `instruments` are the rows of motions without noise.
    fn estimate(
        &self,
        arm: &dyn Arm,
        form: Form,
        bands: Bands,
        (solved, lacking): (Solved, Lacking),
        instruments: &dyn Fn() -> Result<Stack, IdentifyError>,
    ) -> Result<Estimate, IdentifyError> {
        let Solved {
            mut solution,
            shapes,
            shape_std,
            of_shapes,
            mut stack,
            ..
        } = solved;
        let mut beside = Beside::default();
        let mut is_without_turns = self.leaves_out_turns();
        if matches!(self.method, Method::Ls | Method::Wls | Method::Robust) {
            beside.bootstrap = self.draw(&stack, &solution)?;
            let mut essential = || essential::find(self, stack.clone(), &solution);
            beside.essential = self.essential.then(&mut essential).transpose()?;
        }
        match self.method {
            Method::Ls | Method::Wls => {}
            Method::Robust => beside.outliers = Some(robust::outliers(&stack, &solution.estimate)),
            Method::Physical => beside.possible = Some(possible::make(arm, &mut solution, &stack)?),
            Method::Ridge => {
                let nominal = arm.nominal();
                self.widened_by(&mut solution, &stack, &|solution, stack| {
                    ridge::make(&nominal, self.prior, solution, stack)
                })?;
            }
            Method::Total => self.widened_by(&mut solution, &stack, &|solution, stack| {
                total::make(solution, stack, self.weights)
            })?,
            Method::Instrumental => {
                let mut instruments = instruments()?;
                let [rest, clean] = instruments::without_turns(&stack, &instruments);
                let found = self.solve_stack(&rest).ok();
                // Or turns are all that some parameter shows in.
                if let Some(found) = found.filter(|found| found.unexcited == solution.unexcited) {
                    (solution, stack, instruments) = (found, rest, clean);
                    is_without_turns |= self.has_turns(&stack);
                }
                beside.hausman = Some(instruments::make(
                    &mut solution,
                    &stack,
                    &instruments,
                    self.weights,
                )?);
            }
        }
        if !matches!(self.method, Method::Ls | Method::Wls | Method::Robust) {
            // Others solve for the linear unknowns alone.
            for (std, of_shapes) in solution.std.iter_mut().zip(&of_shapes) {
                if *std > 0.0 {
                    *std = std.hypot(*of_shapes);
                }
            }
        }
        let widened = lacking.widened(&solution.std);
        if let Some(bootstrap) = &mut beside.bootstrap {
            bootstrap.widen(&solution.estimate, &solution.std, &widened);
        }
        solution.std = widened;
        let fitted = Fitted::new(&stack, &solution.estimate);
        let at_turns = lacking.at_turns.iter();
        let told_at_turns = at_turns.map(|&k| fitted.names[k].clone()).collect();
        let estimate = Estimate::new(arm, self.method, form, bands, &solution, shapes, fitted);
        Ok(Estimate {
            told_at_turns,
            possible: beside.possible,
            outliers: beside.outliers,
            hausman: beside.hausman,
            bootstrap: beside.bootstrap,
            essential: beside.essential,
            other_friction: lacking.friction,
            hidden_delay: lacking.delay,
            shape_std,
            is_without_turns,
            ..estimate
        })
    }

    /// Solves for the linear unknowns, and for free shape parameters unless they are given.
    pub(crate) fn solve(
        &self,
        arm: &dyn Arm,
        logs: &mut [Prepared],
        shapes: Option<Vec<f64>>,
    ) -> Result<(Solution, Vec<f64>, Stack), IdentifyError> {
        let loaded = arm.uses_rigid_torque();
        if loaded {
            // Effects of the load need a load: that of a first estimate, shapes in the middle of their ranges.
            let shapes = shapes.clone().unwrap_or_else(|| shapes::middle(arm));
            let first = self.solve_stack(&self.rows(arm, logs, &shapes))?;
            update_load(arm, logs, &shapes, &first.estimate);
        }
        let free = shapes.is_none() && !arm.shapes().is_empty();
        let cost = |logs: &[Prepared], shapes: &[f64]| self.cost(arm, logs, shapes);
        let mut shapes = match shapes {
            Some(shapes) => shapes,
            None => self.together(arm, logs, shapes::search(arm, logs, cost)?)?,
        };
        let mut last = None;
        for pass in 0..if loaded { RIGID_TORQUE_PASSES } else { 1 } {
            if pass > 0 && free {
                shapes = shapes::refine(arm, logs, shapes, cost)?;
            }
            let stack = self.rows(arm, logs, &shapes);
            let solution = self.solve_stack(&stack)?;
            if loaded {
                update_load(arm, logs, &shapes, &solution.estimate);
            }
            last = Some((solution, shapes.clone(), stack));
        }
        last.ok_or(IdentifyError::NoLog)
    }

    /// The rows of logs without those of clipped torque, and which of them are at turns.
    pub(crate) fn rows(&self, arm: &dyn Arm, logs: &[Prepared], shapes: &[f64]) -> Stack {
        let mut stack = Stack::new(arm, logs, shapes);
        clipped::leave_out(&mut stack, arm, logs);
        turns::find(&mut stack, arm, logs);
        if self.leaves_out_turns() {
            turns::leave_out(&mut stack);
        }
        stack
    }

    /// Sum over joints of the logarithm of the residual's deviation: what free shape parameters minimize. It does not depend
    /// on the unit of a joint's torque.
    fn cost(&self, arm: &dyn Arm, logs: &[Prepared], shapes: &[f64]) -> Result<f64, IdentifyError> {
        let stack = self.rows(arm, logs, shapes);
        let solution = self.solve_stack(&stack)?;
        Ok(solution
            .sigma
            .iter()
            .map(|s| s.max(f64::MIN_POSITIVE).ln())
            .sum())
    }

    /// Solves a stack; standard deviations know how correlated neighboring residuals are.
    ///
    /// # Errors
    /// [`IdentifyError::TooFewSamples`], [`IdentifyError::NothingExcited`].
    ///
    /// # Examples
    /// ```
    /// # mod spring { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/spring.rs")); }
    /// # use robot_model::identify::Identify;
    /// let mut stack = spring::spring(); // k = 10 and fc = 0.5, of which one is asked
    /// stack.truncate(1);
    /// // Two residuals of 0.5 N m, one unknown: sigma^2 = 0.5^2 + 0.5^2.
    /// let found = Identify::default().solve_stack(&stack).expect("more rows than unknowns");
    /// assert!((found.estimate[0] - 10.0).abs() < 1e-9 && (found.sigma[0].powi(2) - 0.5).abs() < 1e-9);
    /// ```
    pub fn solve_stack(&self, stack: &Stack) -> Result<Solution, IdentifyError> {
        check_counts(&stack.counts(), stack.unknowns.len())?;
        let factors = match self.method {
            Method::Robust => robust::factors(stack),
            _ => Factors::new(stack),
        };
        let white = vec![1.0; stack.dof()];
        let first = match (self.method, self.weights) {
            (Method::Ls, _) => factors.ordinary(&white),
            (method, weights) if method.takes_weights() && weights != Weights::Residual => {
                factors.solve(&weights.scale(stack), &white)
            }
            _ => factors.weighted(&white),
        };
        check_excited(&first)?;
        let residuals = stack.residuals(&first.estimate);
        // The same fit again, with what its residuals say of deviations.
        Ok(factors.solve(&first.scale, &stack.correlation_times(&residuals)))
    }
}
