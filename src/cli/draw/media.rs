//! How a picture is written: by its ending.

use std::path::Path;

use crate::cli::output;
use drawing::bitmap::{Bitmap, bitmap, to_gif, to_png, to_webp};
use drawing::paper::document::document;
use drawing::paper::figure::Figure;
use linkage::error::Result;

/// A format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Medium {
    Svg,
    Png,
    Gif,
    WebP,
}

impl Medium {
    /// The format of a path; what is wrong, if its ending is none.
    pub fn of(path: &Path) -> std::result::Result<Medium, String> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("svg") => Ok(Medium::Svg),
            None if output::is_standard(path) => Ok(Medium::Svg),
            Some("png") => Ok(Medium::Png),
            Some("gif") => Ok(Medium::Gif),
            Some("webp") => Ok(Medium::WebP),
            Some(other) => Err(format!("no pictures end in .{other}; expected .svg, .png, .gif or .webp")),
            None => Err("expected a file that ends in .svg, .png, .gif or .webp, or `-`".into()),
        }
    }

    /// Whether the picture moves.
    pub fn moves(self) -> bool {
        match self {
            Medium::Svg | Medium::Png => false,
            Medium::Gif | Medium::WebP => true,
        }
    }

    /// The picture: figures with their sizes (mm), `width` pixels wide where it is a bitmap, each shown for `seconds`
    /// where it moves.
    pub fn bytes(self, pages: &[(Figure, [f64; 2])], title: &str, width: u32, seconds: f64) -> Result<Vec<u8>> {
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
