//! The integration of equations of motion that both sides share, whatever the equations are.
//! See docs/numerics/forces.md.

pub(crate) mod flow;
pub(crate) mod free;
mod inside;
mod knots;
pub(crate) mod march;
pub(crate) mod side;
pub(crate) mod step;
