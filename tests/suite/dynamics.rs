//! Motion under forces, from outside: closed forms, conservation laws, published figures.

mod crank;
mod energy;
mod figures;
mod free;
mod held;
mod through;
