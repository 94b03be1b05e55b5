//! Colours of links, and the number format of drawings.

use crate::palette::{self, LINKS, QUIET, TEXT};
use linkage::mechanism::LinkId;

/// Colours of the first two links on light paper, for curves.
pub const COLOURS: [&str; 2] = [LINKS[0].light, LINKS[1].light];

/// Colour of elements that belong to no link.
pub const BLACK: &str = TEXT.light;

/// Colour of background elements.
pub const GREY: &str = QUIET.light;

/// Colour of the link with this number.
pub fn colour(link: LinkId) -> &'static str {
    palette::link(link).light
}

/// A number with four significant digits, as in drawings and tables.
pub fn significant(value: f64) -> String {
    let rounded = format!("{value:.3e}");
    let power = rounded.rsplit_once('e').and_then(|(_, power)| power.parse::<i32>().ok());
    match power {
        _ if value == 0.0 => "0".into(),
        Some(power @ -3..=4) => format!("{value:.*}", usize::try_from(3 - power).unwrap_or(0)),
        _ => rounded,
    }
}

#[cfg(test)]
mod tests {
    use super::significant;

    #[test]
    fn numbers_have_four_significant_digits() {
        let shown = [0.0, 12.3456, 1234.56, 0.0123456, -9.99999, 1e-5, 123_456.0, f64::NAN].map(significant);
        assert_eq!(shown, ["0", "12.35", "1235", "0.01235", "-10.00", "1.000e-5", "1.235e5", "NaN"]);
    }
}
