//! Data of velocity and acceleration plans, kinematic diagrams, and the singular Assur point of a class IV group.

pub(crate) mod builder;
mod names;
mod planner;
pub mod scheme;
pub mod singular;
mod sliding;
pub(crate) mod vectors;

pub use planner::{Planner, Plans, grid_at, state_at};
pub use scheme::Scheme;
pub use singular::SingularPoint;
pub use vectors::{Quantity, Tip, TipKind, Vector, VectorKind, VectorPlan};
