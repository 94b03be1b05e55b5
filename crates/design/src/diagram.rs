//! Graphs over the crank angle, timing diagrams, and motion diagrams by chords and by graphical integration, as data.

pub mod chord;
pub mod graphs;
pub mod motion;
pub mod timing;

pub use graphs::{CrankGraph, GraphPoint, Graphs};
pub use motion::{MotionCurve, MotionDiagram};
pub use timing::TimingDiagram;
