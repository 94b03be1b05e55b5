//! Loads, compared with closed forms, the balance of powers, the energy of springs, and the engine by every route.

mod closed_form;
mod engines;
mod friction;
mod jumps;
mod losses;
mod random;
mod reduced;
