//! Drawings in millimetres, as SVG, PDF or PNG.
//! The scale factors on a drawing are correct if the drawing is printed at full size.

mod assur_figure;
mod axes;
mod centre_figure;
mod clearance_sheet;
mod comparison_sheet;
mod construction_sheet;
mod cyclogram_sheet;
mod graph_sheet;
mod motion_sheet;
mod plan_sheet;
mod scheme_figure;
mod timing_sheet;
mod tornado_sheet;

pub use axes::per_millimetre;
pub use centre_figure::toward;
pub use clearance_sheet::clearance;
pub use comparison_sheet::comparison;
pub use construction_sheet::construction;
pub use cyclogram_sheet::{MOST_RINGS, cyclogram};
pub use drawing::paper::style::significant;
pub use graph_sheet::graphs;
pub use motion_sheet::motion;
pub use plan_sheet::{plans, scale_shown};
pub use timing_sheet::timing;
pub use tornado_sheet::tornado;
