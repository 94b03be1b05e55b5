//! The graphical methods of the theory of mechanisms, as data and as drawings to scale.
//! They are velocity and acceleration plans, the singular Assur point of a class IV group,
//! motion diagrams by chords and by graphical integration, and graphs over the crank angle.

mod builder;
pub mod chord;
pub mod draw;
pub mod graphs;
pub mod motion;
mod names;
pub mod plan;
pub mod scheme;
pub mod singular;
mod sliding;
pub mod timing;
mod vectors;

pub use graphs::{CrankGraph, GraphPoint, Graphs};
pub use motion::{MotionCurve, MotionDiagram};
pub use plan::{Planner, Plans};
pub use scheme::Scheme;
pub use singular::SingularPoint;
pub use timing::TimingDiagram;
pub use vectors::{Quantity, Tip, TipKind, Vector, VectorKind, VectorPlan};
