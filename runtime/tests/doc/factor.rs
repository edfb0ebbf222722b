// The factor of the documentation's examples, which include this file: what a log tells of a pendulum.

use robot_model::identify::{Factor, Identify};
use robot_model::log::Log;
use robot_model::signal::Bands;

pub mod pendulum {
    include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs"));
}

/// 20 s of a pendulum with `izz = 2`, `mx = 9`, `fv = 1`.
pub fn log() -> Log {
    pendulum::measure(0.0)
}

pub fn bands() -> Bands {
    let bands = Identify::default().bands_of(&pendulum::pendulum(), &log());
    bands.expect("a log that moves")
}

pub fn factor() -> Factor {
    let arm = pendulum::pendulum();
    let mut factor = Factor::new(&arm, bands()).expect("no shapes, no load");
    factor.push(&arm, &log()).expect("a log of this arm");
    factor
}
