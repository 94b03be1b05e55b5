//! Options of a picture, and its format, given by the file ending.

use crate::sentences;
use std::path::Path;

use drawing::bitmap::{Bitmap, bitmap, to_gif, to_png, to_webp};
use drawing::paper::document::document;
use drawing::paper::figure::DrawnFigure;
use linkage::case::When;
use linkage::error::Result;
use prover::run::Reference;

/// Options of a picture.
#[derive(Clone, Debug, Default)]
pub struct PictureOptions {
    /// Instant of the picture; `None` for the start.
    pub at: Option<When>,
    /// Whether to draw all configurations at the crank angle, each with the modes of its groups.
    pub each_mode: bool,
    /// Whether to draw gravity, and forces and moments as arrows with their sizes.
    pub loads: bool,
    /// Whether to write the lengths of the links into the picture.
    pub dimensions: bool,
    /// Whether to draw the paths of all points without a joint.
    pub all_traces: bool,
    /// Names of the points whose paths are drawn.
    pub traces: Vec<String>,
    /// Analytic solver.
    pub solver: Reference,
    /// Width of a bitmap in pixels; `None` for 800.
    pub width: Option<u32>,
    /// Frames of an animation; `None` for 48.
    pub frames: Option<usize>,
    /// Time that a turn takes in an animation (s); `None` for 4.
    pub seconds: Option<f64>,
    /// Name of `traces` in messages.
    #[doc(hidden)]
    pub traces_key: Option<&'static str>,
}

/// A format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Medium {
    /// Lines and letters.
    Svg,
    /// A bitmap.
    Png,
    /// A bitmap that moves.
    Gif,
    /// A bitmap that moves, in a smaller file than a GIF.
    WebP,
}

impl Medium {
    /// The format of a path, by its ending; SVG for `-`.
    ///
    /// # Errors
    /// A message if no picture format has this ending.
    pub fn of(path: impl AsRef<Path>) -> std::result::Result<Medium, String> {
        let path = path.as_ref();
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("svg") => Ok(Medium::Svg),
            None if path == Path::new("-") => Ok(Medium::Svg),
            Some("png") => Ok(Medium::Png),
            Some("gif") => Ok(Medium::Gif),
            Some("webp") => Ok(Medium::WebP),
            Some(other) => Err(sentences::no_pictures_end_in_expected(&other)),
            None => Err(sentences::EXPECTED_A_FILE_THAT_ENDS.into()),
        }
    }

    /// Whether the picture moves.
    #[must_use]
    pub fn moves(self) -> bool {
        match self {
            Medium::Svg | Medium::Png => false,
            Medium::Gif | Medium::WebP => true,
        }
    }

    pub(super) fn frames(self, wish: &PictureOptions) -> usize {
        if self.moves() && !wish.each_mode { wish.frames.unwrap_or(48) } else { 1 }
    }

    /// The bytes of a picture file. Each page is a figure with its size (mm); an animation has a page for each frame.
    pub(super) fn bytes(
        self,
        pages: &[(DrawnFigure, [f64; 2])],
        title: &str,
        wish: &PictureOptions,
    ) -> Result<Vec<u8>> {
        let width = wish.width.unwrap_or(800);
        let seconds = wish.seconds.unwrap_or(4.0) / self.frames(wish) as f64;
        let bitmaps =
            || pages.iter().map(|(figure, size)| bitmap(figure, *size, width)).collect::<Result<Vec<Bitmap>>>();
        match self {
            Medium::Svg => {
                Ok(pages.iter().map(|(figure, size)| document(figure, *size, title)).collect::<String>().into_bytes())
            }
            Medium::Png => bitmaps()?.first().map_or_else(|| Ok(Vec::new()), to_png),
            Medium::Gif => to_gif(&bitmaps()?, (seconds * 100.0).round().clamp(2.0, 60_000.0) as u16),
            Medium::WebP => to_webp(&bitmaps()?, (seconds * 1000.0).round().clamp(10.0, 1e6) as u32),
        }
    }
}
