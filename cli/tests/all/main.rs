//! The command line, as its users have it.

mod cpp_control;
mod demo;
mod excite;
mod interpreted;
mod pages;
mod simulate;
mod tutorial;
mod verbs;
