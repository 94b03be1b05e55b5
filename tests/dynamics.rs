//! Motion under forces, from outside: closed forms, conservation laws, published figures.

mod common;
#[path = "dynamics/crank.rs"]
mod crank;
#[path = "dynamics/energy.rs"]
mod energy;
#[path = "dynamics/figures.rs"]
mod figures;
#[path = "dynamics/free.rs"]
mod free;
