//! Data of graphs over the crank angle, timing diagrams, cyclograms, comparisons and motion diagrams.
//! The graphical methods of motion diagrams are chords, tangents, and integration by rays or by areas.

pub mod chord;
pub mod comparison;
pub mod construction;
pub mod cyclogram;
pub mod graphs;
pub mod method;
pub mod motion;
pub mod timing;

pub use construction::{Construction, ConstructionSort};
pub use graphs::{CrankGraph, GraphPoint, Graphs};
pub use method::Method;
pub use motion::{MotionCurve, MotionDiagram};
pub use timing::TimingDiagram;
