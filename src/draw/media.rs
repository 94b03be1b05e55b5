//! Options of a picture, and the format of a picture, which follows from the file ending.

use crate::sentences;
use std::path::Path;

use drawing::bitmap::{Bitmap, bitmap, to_gif, to_png, to_webp};
use drawing::dxf::Dxf;
use drawing::lacking_letters;
use drawing::paper::document::{Drawing, document};
use drawing::paper::figure::DrawnFigure;
use drawing::pdf::pdf;
use linkage::case::When;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{KeepNan, Vec2};
use prover::run::Reference;

/// Pixels per millimetre of a drawing for print, and largest number of pixels of such a drawing.
const PRINTED: f64 = 12.0;
const MOST_PIXELS: f64 = 3e7;

/// Options of a picture.
#[derive(Clone, Debug, Default)]
pub struct PictureOptions {
    /// Instant of the picture; `None` for the start.
    pub at: Option<When>,
    /// Whether to draw all configurations at the crank angle, each with the modes of its groups.
    pub each_mode: bool,
    /// Whether to draw gravity, and forces and moments as arrows with their sizes.
    pub loads: bool,
    /// Whether the picture states the lengths and angles that define the links and the ground.
    pub dimensions: bool,
    /// Whether to draw the paths of all moving points, except joints that move on a circle about a pivot.
    pub all_traces: bool,
    /// Names of the points whose paths are drawn.
    pub traces: Vec<String>,
    /// Number of positions drawn in one picture with the paths of points; `None` for a single position.
    pub positions: Option<usize>,
    /// Names of the points whose paths are drawn enlarged, each in a separate cell.
    pub enlarged: Vec<String>,
    /// Whether to draw the driving links and the groups apart, in the order in which they are solved.
    pub groups: bool,
    /// Whether to draw a small picture, to be shown about 240 pixels wide: without words, numbers and scale, and with
    /// large symbols.
    pub small: bool,
    /// Analytic solver.
    pub solver: Reference,
    /// Width of a bitmap in pixels; `None` for 800.
    pub width: Option<u32>,
    /// Frames of an animation; `None` for 48.
    pub frames: Option<usize>,
    /// Duration of an animation (s); `None` for 4.
    pub seconds: Option<f64>,
    /// Names of `traces`, `enlarged`, `positions` and `groups` in messages.
    #[doc(hidden)]
    pub keys: Option<[&'static str; 4]>,
}

/// A format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Medium {
    /// Lines and letters.
    Svg,
    /// Lines and letters, the letters as outlines.
    Pdf,
    /// A bitmap.
    Png,
    /// Lines on layers at full size in mm, for programs of computer-aided design.
    Dxf,
    /// A bitmap that moves.
    Gif,
    /// A bitmap that moves, in a smaller file than a GIF.
    WebP,
}

/// Number of positions on an enlarged path if the picture shows a single position.
const USUAL: usize = 12;
/// Smallest and largest number of positions in a picture.
const POSITIONS: [usize; 2] = [2, 72];

impl PictureOptions {
    pub(super) fn keys(&self) -> [&'static str; 4] {
        self.keys.unwrap_or(["traces", "enlarged", "positions", "groups"])
    }

    /// Number of positions of the motion; `None` if the motion is not needed, because neither several positions nor
    /// enlarged paths are drawn.
    pub(super) fn course(&self) -> Option<usize> {
        self.positions.or((!self.enlarged.is_empty()).then_some(USUAL))
    }

    /// Refuses options that contradict each other, and a number of positions outside [`POSITIONS`].
    pub(super) fn check(&self, medium: Medium) -> Result<()> {
        let [_, enlarged, positions, groups] = self.keys();
        let given =
            [(enlarged, !self.enlarged.is_empty()), (positions, self.positions.is_some()), (groups, self.groups)];
        let refused = |key: &str, message: &str, help: &str| {
            Err(Error::new(ErrorKind::Input, message.to_string()).key(key).help(help.to_string()))
        };
        let is_motion = self.course().is_some();
        if let (Some((key, _)), true) = (given.into_iter().find(|(_, is_given)| *is_given), medium.moves()) {
            return refused(key, sentences::AN_ANIMATION_SHOWS_ONE_POSITION, sentences::WRITE_AN_SVG_OR_A_PNG);
        }
        match self.positions {
            _ if self.groups && (is_motion || self.loads) => {
                refused(groups, sentences::GROUPS_ARE_DRAWN_AT_ONE_INSTANT, sentences::MAKE_TWO_PICTURES)
            }
            _ if self.each_mode && (self.groups || is_motion) => {
                let key = if is_motion { given[usize::from(self.positions.is_some())].0 } else { groups };
                refused(key, sentences::ALL_CONFIGURATIONS_HAVE_ONE_INSTANT, sentences::MAKE_TWO_PICTURES)
            }
            Some(count) if !(POSITIONS[0]..=POSITIONS[1]).contains(&count) => {
                let message = sentences::positions_are_requested(&count);
                refused(positions, &message, &sentences::give_positions_between(&POSITIONS[0], &POSITIONS[1]))
            }
            _ => Ok(()),
        }
    }
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
            Some("pdf") => Ok(Medium::Pdf),
            Some("png") => Ok(Medium::Png),
            Some("dxf") => Ok(Medium::Dxf),
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
            Medium::Svg | Medium::Pdf | Medium::Png | Medium::Dxf => false,
            Medium::Gif | Medium::WebP => true,
        }
    }

    pub(super) fn frames(self, wish: &PictureOptions) -> usize {
        if self.moves() && !wish.each_mode { wish.frames.unwrap_or(48) } else { 1 }
    }

    /// A warning if figures have letters that this format cannot show.
    pub(crate) fn lacking<'a>(self, figures: impl Iterator<Item = &'a DrawnFigure>) -> Option<Error> {
        match self {
            Medium::Svg | Medium::Dxf => None,
            Medium::Pdf | Medium::Png | Medium::Gif | Medium::WebP => lacking_letters(figures),
        }
    }

    /// The bytes of a drawing. A bitmap has enough pixels for print.
    pub(crate) fn drawn(self, drawing: &Drawing) -> Result<Vec<u8>> {
        let [width, height] = drawing.size;
        let density = PRINTED.smaller((MOST_PIXELS / (width * height)).sqrt());
        let wish = PictureOptions { width: Some((width * density).round() as u32), ..PictureOptions::default() };
        self.bytes(&[(drawing.figure.clone(), drawing.size)], &drawing.title, &wish)
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
            Medium::Pdf => Ok(pages.first().map(|(figure, size)| pdf(figure, *size, title)).unwrap_or_default()),
            Medium::Dxf => {
                let mut file = Dxf::default();
                pages.iter().for_each(|(figure, _)| file.figure(figure, 1.0, Vec2::zeros()));
                Ok(file.finish().into_bytes())
            }
            Medium::Png => bitmaps()?.first().map_or_else(|| Ok(Vec::new()), to_png),
            Medium::Gif => to_gif(&bitmaps()?, (seconds * 100.0).round().clamp(2.0, 60_000.0) as u16),
            Medium::WebP => to_webp(&bitmaps()?, (seconds * 1000.0).round().clamp(10.0, 1e6) as u32),
        }
    }
}
