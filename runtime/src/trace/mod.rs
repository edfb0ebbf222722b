//! Residual tracing: which effect, that the spec does not declare, does the residual come from?
//!
//! In: an arm's columns, candidate effects and the identification logs. Out: a [`Verdict`]. The validation log is not seen
//! here. Every candidate is judged three times. Its *score* asks whether it explains more of the residual than chance, with
//! all model columns projected out and neighboring samples not counted as independent. The *gate* asks whether it lowers the
//! error on data that it was not fitted on, by an amount that matters, in nearly every fold, with steady coefficients of
//! the right sign; each time the full system of all joints is fitted again. Last, *structure* asks whether what is left
//! still follows the motion; then no name is given.
//!
//! What changes the arm itself, as an encoder's offset does, has no column: it is scored by its first order, and where that is promising it
//! is judged as what it is. Of candidates that lower the error alike the simplest is named, unless another one says all that it says and
//! more; the rest are alternatives. What passes but for its size is no unknown structure. Of structure that is left the verdict says what it
//! is a function of.
//!
//! # Examples
//! A pendulum's model declares inertia, gravity and viscous friction; the machine has dry friction, too.
//! ```
//! # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
//! # use pendulum::{dry_friction, measure, pendulum};
//! use robot_model::trace::{Outcome, Trace};
//!
//! let (arm, candidate) = (pendulum(), dry_friction());
//! let trace = Trace::new(vec![&candidate]);
//!
//! let verdict = trace.run(&arm, &[measure(0.7)], &mut |stage| eprintln!("{stage}"))?;
//! assert_eq!(verdict.outcome, Outcome::Explained);
//! assert_eq!(verdict.findings[0].kind, "coulomb-friction");
//! assert!((verdict.findings[0].parameters[0].value - 0.7).abs() < 0.02);
//!
//! let verdict = trace.run(&arm, &[measure(0.0)], &mut |_| ())?;
//! assert_eq!(verdict.outcome, Outcome::NothingMissing);
//! # Ok::<(), robot_model::identify::IdentifyError>(())
//! ```

mod away;
mod calm;
mod chance;
mod change;
mod choose;
mod conclude;
mod curve;
mod edges;
mod elsewhere;
mod encompass;
mod floor;
mod folds;
mod forward;
mod gate;
mod gram;
mod grid;
mod jackknife;
mod line;
mod multiplicity;
mod noise;
mod normal;
mod once;
mod periodic;
mod profile;
mod projected;
mod prune;
mod pulses;
mod quantity;
mod raw;
mod refine;
mod residual;
mod round;
mod rows;
mod score;
mod search;
#[cfg(test)]
mod series;
mod slopes;
mod small;
mod stage;
mod step;
mod structure;
mod sure;
mod together;
mod trial;
mod verdict;
mod wander;
mod whereabouts;

pub use floor::{Floor, FloorFrom};
pub use forward::Trace;
pub use quantity::Quantity;
pub use search::MOST_EFFECTS;
pub use stage::Stage;
pub use step::Step;
pub use structure::Structure;
pub use verdict::{
    Alternative, Evidence, Finding, FoundParameter, Outcome, Refusal, Tried, Verdict,
};
pub use whereabouts::{Share, TermShare, Whereabouts};
