//! Five papers, reproduced: what the program of each prints and draws, and what several of them share; and the pages of the effects.
//!
//! A paper is a module with one function, `run`, which gives back a [`Paper`]: its tables beside ours, what its rows came to, and
//! what is wrong in it. `src/bin` has a program for each, which prints that and draws its figures.

pub mod effects;
pub mod paper;
pub mod seed_000;
pub mod seed_001;
pub mod seed_002;
pub mod seed_003;
pub mod seed_004;

pub use paper::Paper;
