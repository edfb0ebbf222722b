// The payload of the documentation's examples, which include this file: a pendulum's, 0.5 kg m^2 and 1 kg m about the joint.

use robot_model::identify::{Carried, Identify, IdentifyError};

pub mod pendulum {
    include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs"));
}

pub fn carried() -> Result<Carried, IdentifyError> {
    let alone = pendulum::measure_with([2.0, 9.0, 1.0], 0.0);
    let loaded = pendulum::measure_with([2.5, 10.0, 1.0], 0.0);
    Identify::default().fit_payload(&pendulum::pendulum(), &[alone], &[loaded], None)
}
