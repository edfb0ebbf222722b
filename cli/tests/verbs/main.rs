//! Every verb on inputs that are sound, and on inputs that are not.

mod apart;
mod audit;
mod c;
mod calibrate;
mod columns;
mod common;
mod dissect;
mod energies;
mod equations;
mod eval;
mod every;
mod excite;
mod friction;
mod identify;
mod import;
mod merge;
mod methods;
mod motions;
mod output_error;
mod outputs;
mod parameters;
mod payload;
mod possible;
mod simulate;
mod starts;
mod trace;
