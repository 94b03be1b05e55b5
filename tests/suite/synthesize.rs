//! Synthesis against analysis.
//! Results from closed forms or by search are followed by the solvers, which do not use the synthesis.

mod closed_form;
mod drives;
mod motor;
mod search;
