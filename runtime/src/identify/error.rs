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
        "{source_name}: {found} speeds at which joints creep where they turn, for {arm} joints; give `with_turn_speeds` one a joint"
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
        "{source_name}: the log has no column `{channel}`, which a declared effect of the spec reads; {}, or take the effect out of the spec",
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
        "the log excites none of the {unknowns} unknowns: no joint moves in it whose torque changes; log a motion, or, of an arm that swings \
         free, identify by output error, which motion alone tells something"
    )]
    NothingExcited {
        /// Unknowns.
        unknowns: usize,
    },
    /// The logs do not tell all unknowns apart.
    #[error("the logs do not tell all parameters apart (rank {rank} of {unknowns}): {why}")]
    NotSeparated {
        /// Numerical rank of the regressor.
        rank: usize,
        /// Unknowns.
        unknowns: usize,
        /// Which are not told, and what is told of them.
        why: String,
    },
    /// Too few draws for an interval.
    #[error(
        "{draws} draws of a bootstrap tell no interval with 95 % of them; ask for {least} or more"
    )]
    Draws {
        /// Draws that were asked for.
        draws: usize,
        /// Least number.
        least: usize,
    },
    /// Draws of blocks that do not tell all.
    #[error(
        "of {draws} draws of blocks only {made} tell all parameters apart: something is excited in a few places of the logs alone; give logs that \
         do so again and again, or take the deviations that are there without a bootstrap"
    )]
    FewDraws {
        /// Draws.
        draws: usize,
        /// Those that do.
        made: usize,
    },
    /// The link that would carry a payload is known.
    #[error(
        "link {link} is fixed by the spec; declare its payload there in place of two kinds of logs: `payload on ..`"
    )]
    FixedLink {
        /// Its name.
        link: String,
    },
    /// No link by that name whose body is looked for.
    #[error(
        "no such link can be told from its payload: links whose bodies are not fixed by the spec are {}; name one of these", if links.is_empty() { "none".to_owned() } else { links.join(", ") }
    )]
    NoLink {
        /// Names of links that there are.
        links: Vec<String>,
    },
    /// A payload without mass.
    #[error(
        "a payload of {mass} kg tells no drive's gain; give the mass that a scale shows, more than 0"
    )]
    PayloadMass {
        /// The mass, kg.
        mass: f64,
    },
    /// A search for gains that does not settle.
    #[error(
        "the search for the drives' gains did not settle: logs with the payload hardly differ from those without; is it there in all of them, and \
         heavy enough?"
    )]
    PayloadLost,
    /// No torque shows what is known of a payload.
    #[error(
        "no drive's gain is told: what is known of the payload shows in no torque that parameters which are looked for could not make, too; give its \
         center of mass, too, put it on a link behind other joints, or move joints that lift or swing it"
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
        "a bootstrap wants {blocks} blocks of {samples:.0} rows, over which errors are alike, and the logs have {rows} rows; give longer logs, \
         or take the deviations that are there without it"
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
        "a robot that says its energies has no links whose bodies could be possible; identify it by another method"
    )]
    NoBodies,
    /// The search for a possible arm did not come to an end.
    #[error(
        "no possible arm was found near the logs: the search did not come to an end; give nominal values of the links (`link name {{ mass = ..; com = ..; inertia = ..; }}`), or another method"
    )]
    NoEnd,
    /// The torque has no part in the direction that total least squares looks for.
    #[error(
        "total least squares has no estimate here: the torque says nothing of the columns; identify by another method"
    )]
    NoTotal,
    /// Columns that are no further apart than the errors that total least squares gives them.
    #[error(
        "total least squares has no estimate here: it gives every column errors as large in proportion as those of the torque, and some columns \
         differ by no more than that, as the constant one of an offset may from that of gravity; identify by another method, by `iv` where columns have errors"
    )]
    TotalApart,
    /// The spec gives no nominal value.
    #[error(
        "the spec gives no nominal value to go to; write those of CAD (`link name {{ mass = ..; com = ..; inertia = ..; }}`), or identify by another method"
    )]
    NoNominal,
    /// A deviation of nominal values that is none.
    #[error("nominal values that are off by {prior}: give a share above 0, such as 0.3")]
    Prior {
        /// What was given.
        prior: f64,
    },
    /// Not one motion without noise for each log.
    #[error(
        "{instruments} motions without noise for {logs} logs: give one for each log, in their order"
    )]
    Instruments {
        /// Motions that were given.
        instruments: usize,
        /// Logs.
        logs: usize,
    },
    /// A motion without noise that ends before the log.
    #[error(
        "{source_name}: the motion without noise is {reference:.3} s long, the log {log:.3} s; give it over the whole log, period by period"
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
        "{source_name}: the motion without noise has a hole from {from:.3} s to {to:.3} s, where nothing says how it moved; give all samples"
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
        "{source_name}: the motion without noise is the log's own, whatever noise that has: instruments would agree with least squares, and say \
         nothing of it; give the wanted motion, or the log that `simulate` makes of it with the parameters of `--method wls`"
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
    #[error("a factor does not hold what is wanted: {why}; identify from the logs themselves")]
    NotReduced {
        /// What a factor does not hold.
        why: String,
    },
    /// A factor of another arm, or of other rows.
    #[error(
        "the factor has other {what} than the arm or the factors before it; make all with one spec and the same `--bands`, `--form` and `--corner`"
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
        "it is found in motions that repeat, twice at least, which this one does not"
    } else {
        "log it"
    }
}
