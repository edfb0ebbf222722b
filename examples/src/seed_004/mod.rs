//! PHANTOM
pub mod contact;
pub mod control;
pub mod device;
pub mod equations;
pub mod fits;
pub mod plant;
pub mod rig;
pub mod shares;
pub mod tracing;
pub mod truth;
