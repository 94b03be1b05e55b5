//! Drawings as SVG with one unit per millimetre.
//! The scale factors on a drawing are correct if the drawing is printed at full size.

mod axes;
mod clearance_sheet;
mod graph_sheet;
mod motion_sheet;
mod plan_sheet;
mod scheme_figure;
mod timing_sheet;

pub use clearance_sheet::clearance;
pub use drawing::paper::style::significant;
pub use graph_sheet::graphs;
pub use motion_sheet::motion;
pub use plan_sheet::plans;
pub use timing_sheet::timing;
