//! Loads: against closed forms, the balance of powers, the energy of springs, and the engine by every route.

#[path = "loads/closed_form.rs"]
mod closed_form;
mod common;
#[path = "loads/engines.rs"]
mod engines;
#[path = "loads/random.rs"]
mod random;
#[path = "loads/reduced.rs"]
mod reduced;
