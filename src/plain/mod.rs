//! A proof, its diagnosis and an error as plain text: what a failed test shows, and what every report has in common.

pub mod brief;
pub mod cells;
pub mod diagnosis;
pub mod engines;
pub mod errors;
pub mod own_forces;
pub mod reasons;
pub mod style;
pub mod tell;
