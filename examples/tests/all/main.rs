//! Every example and every paper's program runs, and says what its page says.

mod common;
mod effects;
mod programs;
mod run;
mod seed_000;
mod seed_001;
mod seed_002;
mod seed_003;
mod seed_004;
