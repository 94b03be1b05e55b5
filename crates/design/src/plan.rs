//! Data of velocity and acceleration plans, kinematic diagrams, instant centres,
//! and the singular Assur point of groups of class III and IV.

pub(crate) mod builder;
pub mod centre_sheet;
pub mod centres;
pub(crate) mod names;
mod planner;
mod scales;
pub mod scheme;
pub mod singular;
mod sliding;
pub(crate) mod vectors;

pub use centre_sheet::CentreSheet;
pub use centres::Centres;
pub use planner::{Planner, Plans, grid_at, state_at};
pub use scales::PlanScale;
pub use scheme::Scheme;
pub use singular::SingularPoint;
pub use vectors::{PlanTurn, Quantity, Tip, TipKind, Vector, VectorKind, VectorPlan};
