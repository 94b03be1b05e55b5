//! What both sides integrate equations of motion with, whatever the equations are.

pub(crate) mod flow;
pub(crate) mod free;
pub(crate) mod march;
pub(crate) mod side;
