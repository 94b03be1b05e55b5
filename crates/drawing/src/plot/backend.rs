//! Backend of the library `plotters` that draws into a figure. A pixel of `plotters` is a hundredth of a millimetre.

use std::cell::Cell;
use std::convert::Infallible;
use std::rc::Rc;

use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontTransform,
};

use super::chart::{GRID, LINE};
use crate::paper::figure::{DrawnFigure, Style, Tint, Type, rectangle, solid, width, words};
use crate::paper::style::BLACK;
use crate::paths::rgb;
use linkage::math::Vec2;

/// Pixels of `plotters` in a millimetre.
pub(super) const PIXELS: f64 = 100.0;
/// Height of capital letters, and depth of descenders; both divided by the font size.
const CAPITAL: f64 = 0.72;
const BELOW: f64 = 0.22;

/// Converts a length (mm) to pixels.
pub(super) fn pixels(millimetres: f64) -> i32 {
    (millimetres * PIXELS).round() as i32
}

/// The place of a pixel on paper (mm, y upwards). The origin is the upper left corner of the plot.
pub(super) fn place((x, y): BackendCoord) -> Vec2 {
    Vec2::new(f64::from(x) / PIXELS, -f64::from(y) / PIXELS)
}

/// The figure into which `plotters` draws.
pub(super) struct PlotPaper<'a> {
    pub(super) figure: &'a mut DrawnFigure,
    /// Size of the plot (pixels).
    pub(super) size: (u32, u32),
    /// Colour and dashes of the curve that is being drawn. For axes, this is `None`, and `plotters` states the colour.
    pub(super) pen: Rc<Cell<Option<Style>>>,
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

/// The name of a colour of axes: [`GRID`] for grid lines, black for all else.
fn named(colour: BackendColor) -> &'static str {
    let (red, green, blue) = colour.rgb;
    if rgb(GRID) == [red, green, blue] { GRID } else { BLACK }
}

impl PlotPaper<'_> {
    fn style(&self, style: &impl BackendStyle) -> Style {
        self.pen.get().unwrap_or(solid(named(style.color()), f64::from(style.stroke_width()) / PIXELS))
    }
}

impl DrawingBackend for PlotPaper<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, colour: BackendColor) -> Drawn {
        let dot = 0.5 / PIXELS;
        self.figure.disc(place(at), dot, named(colour), solid(named(colour), 0.0));
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        let style = self.style(style);
        self.figure.line([from, to].map(place), style);
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Drawn {
        let (corners, style) = (path.into_iter().map(place).collect::<Vec<_>>(), self.style(style));
        match corners.as_slice() {
            [from, to] if self.pen.get().is_none() => self.figure.line([*from, *to], style),
            _ => self.figure.curve(corners, None, style),
        }
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S, fill: bool) -> Drawn {
        let own = self.style(style);
        let tint = fill.then_some(Tint::opaque(own.colour));
        self.figure.area(rectangle([place((from.0, to.1)), place((to.0, from.1))]), tint, own);
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(&mut self, at: BackendCoord, radius: u32, style: &S, fill: bool) -> Drawn {
        let own = self.style(style);
        self.figure.disc(place(at), f64::from(radius) / PIXELS, if fill { own.colour } else { "none" }, own);
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Drawn {
        let own = self.style(style);
        self.figure.area(path.into_iter().map(place).collect(), Some(Tint::opaque(own.colour)), solid(own.colour, 0.0));
        Ok(())
    }

    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, at: BackendCoord) -> Drawn {
        let size = style.size() / PIXELS;
        let anchor = match style.anchor().h_pos {
            HPos::Left => "start",
            HPos::Center => "middle",
            HPos::Right => "end",
        };
        let down = match style.anchor().v_pos {
            VPos::Top => CAPITAL * size,
            VPos::Center => CAPITAL * size / 2.0,
            VPos::Bottom => -BELOW * size,
        };
        let upward = matches!(style.transform(), FontTransform::Rotate270);
        let count = text.lines().count() as f64;
        for (index, line) in text.lines().enumerate() {
            // If a text is anchored at its bottom, its last line is at the anchor, and its other lines are above it.
            let row = match style.anchor().v_pos {
                VPos::Top | VPos::Center => index as f64,
                VPos::Bottom => index as f64 + 1.0 - count,
            };
            let down = down + LINE * size * row;
            let step = if upward { Vec2::new(down, 0.0) } else { Vec2::new(0.0, -down) };
            self.figure.text(place(at) + step, line, Type { anchor, upward, ..words(size) });
        }
        Ok(())
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let wide = width(text, style.size() / PIXELS) * PIXELS;
        Ok((wide.round() as u32, style.size().round() as u32))
    }
}
