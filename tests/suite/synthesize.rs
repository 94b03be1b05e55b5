//! Synthesis against analysis: results in closed form or by search are followed by the solvers, which know nothing of
//! the synthesis.

mod closed_form;
mod drives;
mod motor;
mod search;
