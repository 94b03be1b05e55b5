//! Synthesis against analysis.
//! Closed forms or a search give a mechanism; then the solvers, which do not use the synthesis, compute its motion.

mod closed_form;
mod drives;
mod motor;
mod precision;
mod search;
mod sheet;
