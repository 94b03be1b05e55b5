//! Data of graphs over the crank angle, timing diagrams and motion diagrams.
//! Motion diagrams are made by chords and by graphical integration.

pub mod chord;
pub mod graphs;
pub mod motion;
pub mod timing;

pub use graphs::{CrankGraph, GraphPoint, Graphs};
pub use motion::{MotionCurve, MotionDiagram};
pub use timing::TimingDiagram;
