//! Identification and tracing on plants of known laws.

mod coverage;
mod drowned;
mod identify;
mod lacking;
mod laws;
#[path = "../doc/pendulum.rs"]
#[expect(dead_code, reason = "it is the arm of the documentation's examples")]
mod pendulum;
mod plant;
mod trace;
mod trace_coarse;
mod trace_doubts;
mod trace_where;
