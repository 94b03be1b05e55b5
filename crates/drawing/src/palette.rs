//! Colours of links, the same in every picture.
//!
//! Colour is never the only distinction: links also have numbers, and plates are hatched at different angles.

use linkage::mechanism::LinkId;

/// A colour for light and dark paper, and the hatching that replaces it in pictures without colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaletteColour {
    /// Colour on light paper (`#rrggbb`). The contrast of this colour with white is at least 3 : 1.
    pub light: &'static str,
    /// Colour on dark paper (`#rrggbb`). The contrast of this colour with #16181c is at least 3 : 1.
    pub dark: &'static str,
    /// Angle of the hatching of plates (deg).
    pub hatch_deg: f64,
}

/// Colours of links, which also differ in grey scale (after Okabe and Ito 2008).
pub const LINKS: [PaletteColour; 7] = [
    PaletteColour { light: "#0072b2", dark: "#56b4e9", hatch_deg: 45.0 },
    PaletteColour { light: "#d55e00", dark: "#ff8c42", hatch_deg: -45.0 },
    PaletteColour { light: "#009e73", dark: "#2ec99a", hatch_deg: 15.0 },
    PaletteColour { light: "#b0578d", dark: "#e38fc0", hatch_deg: -15.0 },
    PaletteColour { light: "#b8860b", dark: "#f0c550", hatch_deg: 75.0 },
    PaletteColour { light: "#4b2e83", dark: "#a991e0", hatch_deg: -75.0 },
    PaletteColour { light: "#3b8ea5", dark: "#7fd1e6", hatch_deg: 0.0 },
];

/// Colour of text and of fixed parts.
pub const TEXT: PaletteColour = PaletteColour { light: "#1a1a1a", dark: "#eceff4", hatch_deg: 45.0 };
/// Colour of auxiliary lines and symbols, such as axes and mass centres.
pub const QUIET: PaletteColour = PaletteColour { light: "#767676", dark: "#9aa0aa", hatch_deg: 45.0 };
/// Colour of loads, springs and dampers.
pub const LOAD: PaletteColour = PaletteColour { light: "#c1121f", dark: "#ff6b6b", hatch_deg: 45.0 };
/// The paper.
pub const PAPER: PaletteColour = PaletteColour { light: "#ffffff", dark: "#16181c", hatch_deg: 45.0 };

/// Colour of the link with this number. The ground has number 0 and the colour of text.
pub fn link(number: LinkId) -> PaletteColour {
    match number.index().checked_sub(1) {
        None => TEXT,
        Some(index) => LINKS[index % LINKS.len()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of a colour, after WCAG 2.
    fn luminance(colour: &str) -> f64 {
        let part = |at: usize| f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
        let linear = |part: f64| if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) };
        [(1, 0.2126), (3, 0.7152), (5, 0.0722)].map(|(at, share)| share * linear(part(at))).iter().sum()
    }

    #[test]
    fn every_colour_has_enough_contrast_with_the_paper() {
        for paint in LINKS.into_iter().chain([TEXT, QUIET, LOAD]) {
            let light = (luminance(PAPER.light) + 0.05) / (luminance(paint.light) + 0.05);
            let dark = (luminance(paint.dark) + 0.05) / (luminance(PAPER.dark) + 0.05);
            assert!(light >= 3.0 && dark >= 3.0, "{paint:?}: {light} {dark}");
        }
    }
}
