//! The input: the joint coordinate that moves a mechanism.
//! This module alone defines inputs: the measured quantity, the names in files and messages, and the conversion of
//! units.

use std::f64::consts::TAU;
use std::fmt;

/// Quantity that an input measures. The input's values are in SI units and are measured from the scenario's zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Input {
    /// Angle of a crank, a driving link that turns about its joint.
    /// The angle is measured counter-clockwise from the link's zero direction and counts whole turns.
    #[default]
    Angle,
    /// Angle of a joint between two moving links: the angle of the joint's second link minus that of its first link.
    /// The angle is counter-clockwise positive and counts whole turns.
    Turn,
    /// Slide of a prismatic joint.
    /// A slide is measured along the joint's axis, from the joint's point on the first link to the joint's point on the
    /// second link.
    Slide,
}

impl Input {
    /// All quantities.
    pub const ALL: [Input; 3] = [Input::Angle, Input::Turn, Input::Slide];

    /// The value `value` (in the SI unit) of this input, in a form that messages can display.
    #[inline]
    pub const fn at(self, value: f64) -> InputValue {
        InputValue { input: self, value }
    }

    /// Name in messages.
    #[must_use]
    pub const fn noun(self) -> &'static str {
        match self {
            Input::Angle => "crank angle",
            Input::Turn => "joint angle",
            Input::Slide => "slide",
        }
    }

    /// SI unit of the input's values.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Input::Angle | Input::Turn => "rad",
            Input::Slide => "m",
        }
    }

    /// Name of the input's column in SI units, in recordings, tables and JSON.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Input::Angle => "crank_rad",
            Input::Turn => "joint_rad",
            Input::Slide => "slide_m",
        }
    }

    /// Unit in which people read and write the input, and name of its column in that unit.
    #[must_use]
    pub const fn shown_in(self) -> (&'static str, &'static str) {
        match self {
            Input::Angle => ("deg", "crank_deg"),
            Input::Turn => ("deg", "joint_deg"),
            Input::Slide => ("mm", "slide_mm"),
        }
    }

    /// First word of the input's names in columns and files.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Input::Angle => "crank",
            Input::Turn => "joint",
            Input::Slide => "slide",
        }
    }

    /// Sign of the unit that follows a number in pictures.
    #[must_use]
    pub const fn sign(self) -> &'static str {
        match self {
            Input::Angle | Input::Turn => "°",
            Input::Slide => " mm",
        }
    }

    /// Title of a picture at this value, without digits of rounding error: `crank at 70°`, `slide at 300 mm`.
    #[must_use]
    pub fn marked(self, value: f64) -> String {
        format!("{} at {}{}", self.word(), (self.shown(value) * 1e6).round() / 1e6 + 0.0, self.sign())
    }

    /// Converts a value to the unit in which people read and write it.
    #[inline]
    #[must_use]
    pub fn shown(self, value: f64) -> f64 {
        match self {
            Input::Angle | Input::Turn => value.to_degrees(),
            Input::Slide => value * 1e3,
        }
    }

    /// Converts a value that people have written to its SI value.
    #[inline]
    #[must_use]
    pub fn read(self, shown: f64) -> f64 {
        match self {
            Input::Angle | Input::Turn => shown.to_radians(),
            Input::Slide => shown / 1e3,
        }
    }

    /// Period of the input, and the name of the period in the plural.
    /// After each period the driving link returns to its pose.
    /// `None` for an input without a period.
    #[must_use]
    pub const fn period(self) -> Option<(f64, &'static str)> {
        match self {
            Input::Angle | Input::Turn => Some((TAU, "turns")),
            Input::Slide => None,
        }
    }

    /// Change of the input that moves points by about the size of the mechanism (m): one radian, or a slide as long as
    /// the mechanism's size.
    #[inline]
    #[must_use]
    pub const fn span(self, size: f64) -> f64 {
        match self {
            Input::Angle | Input::Turn => 1.0,
            Input::Slide => size,
        }
    }

    /// Length that corresponds to one unit of the input, if `size` (m) is the size of the mechanism.
    /// A slide is a length itself. A rotation by 1 rad moves points by up to the size of the mechanism.
    #[inline]
    #[must_use]
    pub const fn reach(self, size: f64) -> f64 {
        match self {
            Input::Angle | Input::Turn => size,
            Input::Slide => 1.0,
        }
    }
}

/// Value of an input. The value is displayed with the input's name and unit: `crank angle 41.0000 deg`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct InputValue {
    /// The quantity that the input measures.
    pub input: Input,
    /// The value, in the input's SI unit.
    pub value: f64,
}

impl fmt::Display for InputValue {
    /// Prints the value with the requested number of decimals; the default is four.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (decimals, shown) = (f.precision().unwrap_or(4), self.input.shown(self.value));
        write!(f, "{} {shown:.decimals$} {}", self.input.noun(), self.input.shown_in().0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_input_is_printed_with_name_and_unit_and_read_back() {
        let half = Input::Angle.at(std::f64::consts::PI);
        assert_eq!(
            (half.to_string(), format!("{half:.1}")),
            ("crank angle 180.0000 deg".into(), "crank angle 180.0 deg".into())
        );
        assert_eq!(format!("{:.1}", Input::Slide.at(0.25)), "slide 250.0 mm");
        for input in Input::ALL {
            assert_eq!(input.read(input.shown(0.75)), 0.75);
            assert!(input.key().ends_with(input.unit()) && input.shown_in().1.ends_with(input.shown_in().0));
            assert!([input.key(), input.shown_in().1].iter().all(|name| name.starts_with(input.word())));
        }
    }
}
