//! PHANTOM
pub mod device;
pub mod equations;
pub mod plant;
pub mod rig;
pub mod truth;

/// Its energies.
pub const SPEC: &str = include_str!("phantom.robot");
