//! Drawings of mechanisms: marks in the frames of the links, by the rules of ISO 3952.
//!
//! The caller makes the [`Sketch`] of a mechanism once.
//! For each pose, the caller then draws every [`LinkMarks`] at the pose of its link, and every [`Stretched`] between
//! its ends:
//!
//! ```
//! # use fixtures::four_bar;
//! # use linkage::mechanism::LinkPose;
//! use linkproof_drawing::{Sketch, Travels, unit};
//!
//! # let mechanism = four_bar();
//! let sketch = Sketch::of(&mechanism, &Travels::none(&mechanism), unit(&mechanism));
//! let pose = LinkPose::GROUND;
//! for (link, mark) in sketch.in_order() {
//!     let line = mark.shape.points();
//!     // Draw `line` with the pose of `link`, as `mark.role` says.
//!     # let _ = (line.iter().map(|&local| pose.point(local)).collect::<Vec<_>>(), mark.role.look(), link);
//! }
//! ```

mod acting;
pub mod bitmap;
mod body;
mod dimension;
mod dimensioning;
pub mod dxf;
pub mod groups;
mod guide;
pub mod lay;
mod mark;
pub mod palette;
pub mod paper;
mod paths;
pub mod pdf;
pub mod picture;
mod pins;
pub mod plot;
pub mod positions;
mod sentences;
pub mod sheet;
mod sign;
mod sketch;
mod stretched;
mod transmission;
mod travel;
pub mod view;

pub use acting::{Acting, Tension, Weight, acting, tensions, weights};
pub use body::places;
pub use dimension::{Dimension, DimensionLine, Measure, dimensions};
pub use guide::inside;
pub use mark::{Fill, Ink, Layer, Look, Mark, MarkRole, MarkShape};
pub use paths::lacking_letters;
pub use sign::{LoadSign, arrow, turning};
pub use sketch::{Lettering, LinkMarks, Sketch, SketchLabel, unit};
pub use stretched::Stretched;
pub use travel::Travels;
