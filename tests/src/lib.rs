//! What the crates promise together, tested from outside: the specs, their independent twin, the oracles and real logs.

pub mod base_map;
pub mod cases;
pub mod compiler;
pub mod emitted;
pub mod evaluate;
pub mod expression;
pub mod mechanics;
pub mod mjcf;
pub mod oracle;
pub mod program;
pub mod shared;
pub mod specs;
pub mod states;
pub mod twin;
pub mod urdfs;
