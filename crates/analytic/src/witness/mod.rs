//! Other ways to what the two sides compute: they bear witness, nothing else rests on them.

pub mod momentum;
pub mod power;
pub mod triad;
