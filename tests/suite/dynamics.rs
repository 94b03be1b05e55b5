//! Motion under forces against independent sources: closed forms, conservation laws, published figures.

mod crank;
mod energy;
mod figures;
mod free;
mod held;
mod through;
