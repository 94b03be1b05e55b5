//! Colours of links, and the number format of drawings.

/// Colours of links, dark enough for white paper and different in grey scale (after Okabe and Ito 2008).
pub(super) const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#b0578d", "#b8860b", "#4b2e83", "#3b8ea5"];

/// Colour of elements that belong to no link.
pub(super) const BLACK: &str = "#1a1a1a";

/// Colour of background elements.
pub(super) const GREY: &str = "#8a8a8a";

/// Colour of the link with this number.
pub(super) fn colour(link: usize) -> &'static str {
    COLOURS[(link + COLOURS.len() - 1) % COLOURS.len()]
}

/// A number with four significant digits, as in drawings and tables.
#[must_use]
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
    fn four_digits_count() {
        let shown = [0.0, 12.3456, 1234.56, 0.0123456, -9.99999, 1e-5, 123_456.0, f64::NAN].map(significant);
        assert_eq!(shown, ["0", "12.35", "1235", "0.01235", "-10.00", "1.000e-5", "1.235e5", "NaN"]);
    }
}
