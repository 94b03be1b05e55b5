//! Figures as bitmaps: PNG, and animated GIF and WebP.
//! The same figure gives the same bytes on every machine, because letters come from a bundled font.

mod canvas;
mod encode;

pub use canvas::{Bitmap, bitmap};
pub use encode::{to_gif, to_png, to_webp};
