//! The integrator that both analytic sides share, for any equations of motion.
//! See docs/numerics/forces.md.

pub(crate) mod flow;
pub(crate) mod free;
mod inside;
mod knots;
pub(crate) mod march;
pub(crate) mod side;
pub(crate) mod step;
