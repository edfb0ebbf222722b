//! Why an identification was refused.

use crate::log::MOTION_PHASE;
use crate::signal::SignalError;

/// Why an identification was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IdentifyError {
    /// There is no log.
    #[error("no log to identify from; give at least one")]
    NoLog,
    /// A log has another number of joints than the arm.
    #[error("{source_name}: the log has {log} joints, the spec {arm}")]
    Joints {
        /// Name of the log.
        source_name: String,
        /// Joints of the log.
        log: usize,
        /// Joints of the arm.
        arm: usize,
    },
    /// Speeds at which joints of a log creep are not one a joint.
    #[error(
        "{source_name}: {found} speeds at velocity reversals for {arm} joints; give `with_turn_speeds` one per joint"
    )]
    TurnSpeeds {
        /// Name of the log.
        source_name: String,
        /// How many speeds the log has.
        found: usize,
        /// Joints of the arm.
        arm: usize,
    },
    /// A log lacks a channel that a declared effect reads.
    #[error(
        "{source_name}: the log has no column `{channel}`, which a declared effect of the spec reads; {}, or remove the effect from the spec",
        way_to(channel)
    )]
    NoChannel {
        /// Name of the log.
        source_name: String,
        /// Name of the column.
        channel: String,
    },
    /// No more rows than unknowns.
    #[error(
        "{rows} rows of {dof} joints are left after filtering, for {unknowns} unknowns; give a longer log"
    )]
    TooFewSamples {
        /// Rows of all joints that say something.
        rows: usize,
        /// Joints.
        dof: usize,
        /// Unknowns.
        unknowns: usize,
    },
    /// The log excites none of the unknowns.
    #[error(
        "the log excites none of the {unknowns} unknowns: no joint moves with a changing torque; log a motion, or identify a freely \
         swinging arm by output error"
    )]
    NothingExcited {
        /// Unknowns.
        unknowns: usize,
    },
    /// The logs do not tell all unknowns apart.
    #[error("the logs do not determine all parameters (rank {rank} of {unknowns}): {why}")]
    NotSeparated {
        /// Numerical rank of the regressor.
        rank: usize,
        /// Unknowns.
        unknowns: usize,
        /// Which are not told, and what is told of them.
        why: String,
    },
    /// Too few draws for an interval.
    #[error("{draws} bootstrap draws are too few for a 95 % interval; ask for {least} or more")]
    Draws {
        /// Draws that were asked for.
        draws: usize,
        /// Least number.
        least: usize,
    },
    /// Draws of blocks that do not tell all.
    #[error(
        "only {made} of {draws} draws of blocks determine all parameters: some are excited in only a few places of the logs; give logs that \
         excite them repeatedly, or use the standard deviations without a bootstrap"
    )]
    FewDraws {
        /// Draws.
        draws: usize,
        /// Those that do.
        made: usize,
    },
    /// The link that would carry a payload is known.
    #[error(
        "link {link} is fixed by the spec; declare its payload there instead of giving two kinds of logs: `payload on ..`"
    )]
    FixedLink {
        /// Its name.
        link: String,
    },
    /// No link by that name whose body is looked for.
    #[error(
        "this link cannot carry an identified payload: links not fixed by the spec are {}; name one of these", if links.is_empty() { "none".to_owned() } else { links.join(", ") }
    )]
    NoLink {
        /// Names of links that there are.
        links: Vec<String>,
    },
    /// A payload without mass.
    #[error("a payload of {mass} kg determines no gain; give its weighed mass, above 0")]
    PayloadMass {
        /// The mass, kg.
        mass: f64,
    },
    /// A search for gains that does not settle.
    #[error(
        "the search for the drives' gains did not converge: logs with the payload hardly differ from those without; do all of them have it, \
         and is it heavy enough?"
    )]
    PayloadLost,
    /// No torque shows what is known of a payload.
    #[error(
        "no drive's gain is identified: unknown parameters can explain every torque of the payload; also give its center of mass, attach it \
         to a link further out, or move joints that lift or swing it"
    )]
    PayloadHidden,
    /// Not one value for each open shape.
    #[error(
        "{given} values for the {open} shapes that the spec leaves open; give one for each, in its order"
    )]
    Shapes {
        /// Values that were given.
        given: usize,
        /// Shapes.
        open: usize,
    },
    /// Logs too short to be cut into blocks.
    #[error(
        "a bootstrap needs {blocks} blocks of {samples:.0} rows, the correlation length of the errors, but the logs have {rows} rows; give \
         longer logs, or use the standard deviations without it"
    )]
    FewBlocks {
        /// Least number of blocks.
        blocks: usize,
        /// Rows in a block.
        samples: f64,
        /// Rows there are.
        rows: usize,
    },
    /// Nothing says what bodies the unknowns are made of.
    #[error(
        "a robot defined by its energies has no links that could be checked for physical bodies; use another method"
    )]
    NoBodies,
    /// The search for a possible arm did not come to an end.
    #[error(
        "no physically possible arm was found: the search did not converge; give nominal values of the links (`link name {{ mass = ..; com \
         = ..; inertia = ..; }}`), or another method"
    )]
    NoEnd,
    /// The torque has no part in the direction that total least squares looks for.
    #[error(
        "total least squares has no estimate here: the torque does not depend on the columns; use another method"
    )]
    NoTotal,
    /// Columns that are no further apart than the errors that total least squares gives them.
    #[error(
        "total least squares has no estimate here: it assumes that every column has relative errors as large as those of the torque, and \
         some columns, such as an offset and gravity, differ by less; use another method, such as `iv` if columns have errors"
    )]
    TotalApart,
    /// The spec gives no nominal value.
    #[error(
        "the spec has no nominal values to use; write CAD values (`link name {{ mass = ..; com = ..; inertia = ..; }}`), or use another method"
    )]
    NoNominal,
    /// A deviation of nominal values that is none.
    #[error(
        "the standard deviation of nominal values is {prior}: give a share above 0, such as 0.3"
    )]
    Prior {
        /// What was given.
        prior: f64,
    },
    /// Not one motion without noise for each log.
    #[error(
        "{instruments} noise-free motions for {logs} logs: give one for each log, in their order"
    )]
    Instruments {
        /// Motions that were given.
        instruments: usize,
        /// Logs.
        logs: usize,
    },
    /// A motion without noise that ends before the log.
    #[error(
        "{source_name}: the noise-free motion is {reference:.3} s long, the log {log:.3} s; give it over the whole log, period by period"
    )]
    ShortReference {
        /// Name of the log.
        source_name: String,
        /// Length of the log, s.
        log: f64,
        /// Length of the motion, s.
        reference: f64,
    },
    /// A motion without noise that lacks samples.
    #[error(
        "{source_name}: the noise-free motion has a gap from {from:.3} s to {to:.3} s; give all samples"
    )]
    HoleInReference {
        /// Name of the log.
        source_name: String,
        /// Time of the sample before it.
        from: f64,
        /// Time of the sample behind it.
        to: f64,
    },
    /// Positions of the log itself in place of a motion without noise.
    #[error(
        "{source_name}: the noise-free motion is the log's own noisy motion: instruments would repeat least squares; give the commanded \
         motion, or the log that `simulate` makes of it with the parameters of `--method wls`"
    )]
    OwnReference {
        /// Name of the log.
        source_name: String,
    },
    /// A method that does not solve for an arm and its payload at once.
    #[error("a payload is identified by `ls`, `wls` or `robust`, and not by `{method}`")]
    PayloadMethod {
        /// Name of the method.
        method: &'static str,
    },
    /// Rows that cannot be reduced to a factor.
    #[error("a factor does not hold the required data: {why}; identify from the logs themselves")]
    NotReduced {
        /// What a factor does not hold.
        why: String,
    },
    /// A factor of another arm, or of other rows.
    #[error(
        "the factor has different {what} than the arm or the factors before it; make all with one spec and the same `--bands`, `--form` and \
         `--corner`"
    )]
    OtherFactor {
        /// Joints, unknowns, equations, filters or rows.
        what: String,
    },
    /// The signals cannot be filtered.
    #[error(transparent)]
    Signal(#[from] SignalError),
}

/// How a log comes to a channel.
fn way_to(channel: &str) -> &'static str {
    if channel == MOTION_PHASE {
        "it needs a motion that repeats at least twice, which this one does not"
    } else {
        "log it"
    }
}
