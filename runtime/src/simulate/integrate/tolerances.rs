//! How exact a motion is, and what it takes.

/// How exact a motion is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Error of a step relative to each position, velocity and state.
    pub relative: f64,
    /// The same of what is near zero.
    pub absolute: f64,
    /// Shortest step of high order, s: below it impulses take over, which grow where they follow each other.
    pub floor: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self {
            relative: 1e-10,
            absolute: 1e-11,
            floor: 1e-6,
        }
    }
}

/// What a motion took.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Work {
    /// Steps of high order for motions that are not stiff.
    pub explicit: u64,
    /// Linearly implicit steps of high order.
    pub implicit: u64,
    /// Steps of the first order over impulses.
    pub impulses: u64,
    /// Steps that were too long.
    pub rejected: u64,
    /// Joints that stop, turn round, or break away, and other jumps.
    pub events: u64,
    /// Solutions for accelerations.
    pub evaluations: u64,
}
