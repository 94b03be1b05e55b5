//! Printed numbers: value, uncertainty, and the correction of a number that is known to be wrong.

use super::reader::TomlTable;
use super::unit::{ANGLE, LENGTH, NamedUnit, UnitFamily};
use crate::sentences;
use columns::TableCell;
use formula::Rounded;
use linkage::error::Result;
use linkage::trajectory::{self, CHANNELS, Channel, ChannelKind};

/// A number as printed: its value and its count of decimals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// The number, in the printed unit.
    pub value: f64,
    /// Number of printed decimals; negative if the last printed digit lies before the decimal point (1.5e3 has -2).
    pub digits: i32,
    /// Largest distance of the true number from the printed number, in the printed unit.
    pub half_unit: f64,
}

impl Printed {
    /// A number with a given count of decimals.
    #[must_use]
    pub fn with_digits(value: f64, digits: i32) -> Printed {
        // The decimal number is also rounded to a binary number. The factor (1 + 1e-9) covers only this rounding.
        Printed { value, digits, half_unit: 0.5 * 10f64.powi(-digits) * (1.0 + 1e-9) }
    }

    /// A number of a column. The uncertainty of the number comes from the count of digits that the column prints.
    #[must_use]
    pub fn of_column(number: &Rounded) -> Printed {
        let Rounded { value, error } = *number;
        Printed { value, digits: -(2.0 * error).log10().round() as i32, half_unit: error }
    }

    /// Reads a decimal number with an optional exponent. Any other text is refused, and so is an empty cell.
    #[must_use]
    pub fn cell(text: &str) -> Option<TableCell> {
        let begins = text.strip_prefix(['+', '-']).unwrap_or(text);
        TableCell::parse(text).filter(|cell| !begins.starts_with('.') && cell.value.is_finite())
    }
}

/// Upper limit of the magnitude of a count of decimals. In double precision, a larger count makes no sense.
pub const MOST_DIGITS: i32 = 20;

/// Ending of a name that denotes the magnitude of a joint's reaction.
const MAGNITUDE: &str = "f_N";

/// Ending of the name of the channel that represents the magnitude: the channel of the x component.
const X_OF_MAGNITUDE: &str = "fx_N";

/// Ending of the name of the channel of the y component.
const Y_OF_MAGNITUDE: &str = "fy_N";

/// The units in which a channel may be printed. `None` if the channel is printed only in its SI unit.
fn family(unit: trajectory::Unit) -> Option<&'static UnitFamily> {
    match unit {
        trajectory::Unit::Radian => Some(&ANGLE),
        trajectory::Unit::Metre => Some(&LENGTH),
        trajectory::Unit::RadianPerSecond | trajectory::Unit::RadianPerSecondSquared => None,
        trajectory::Unit::MetrePerSecond | trajectory::Unit::MetrePerSecondSquared => None,
        trajectory::Unit::Newton | trajectory::Unit::NewtonMetre => None,
    }
}

/// The endings of channel names of a kind, one for every printed unit.
#[must_use]
pub fn endings(kind: &ChannelKind) -> Vec<String> {
    let si = format!("_{}", kind.unit.suffix());
    let mut endings = match (family(kind.unit), kind.suffix.strip_suffix(&si)) {
        (Some(family), Some(stem)) => family.keys(stem),
        (None, _) | (_, None) => vec![kind.suffix.to_string()],
    };
    if kind.suffix == X_OF_MAGNITUDE {
        endings.push(MAGNITUDE.into());
    }
    endings
}

/// A channel with the unit in which its values are printed.
#[derive(Clone, Debug)]
pub struct PrintedChannel {
    /// The channel, in SI.
    pub channel: Channel,
    /// Family of units to which the printed unit belongs; `None` if the numbers are always in SI.
    pub family: Option<&'static UnitFamily>,
    /// Whether the printed number is the magnitude of a vector; `channel` is then the x component of the vector.
    pub magnitude: bool,
    unit: Option<&'static NamedUnit>,
}

impl PrintedChannel {
    /// The channel called `name`. The ending of the name may be a printed unit: `x_mm` for `x_m`, `angle_deg` for
    /// `angle_rad`.
    /// If the ending is not a printed unit, the name denotes the channel in its SI unit.
    #[must_use]
    pub fn named(name: &str) -> Option<PrintedChannel> {
        if let Some(base) = name.strip_suffix(&format!(".{MAGNITUDE}")) {
            let channel = Channel::named(&format!("{base}.{X_OF_MAGNITUDE}"))?;
            return Some(PrintedChannel { channel, family: None, magnitude: true, unit: None });
        }
        let printed = |kind: &ChannelKind| {
            let family = family(kind.unit)?;
            family.units.iter().find_map(|unit| {
                let si = format!("{}{}", name.strip_suffix(unit.suffix)?, kind.unit.suffix());
                let channel = Channel::named(&si).filter(|channel| channel.kind == kind)?;
                Some(PrintedChannel { channel, family: Some(family), magnitude: false, unit: Some(unit) })
            })
        };
        if let Some(found) = CHANNELS.iter().find_map(printed) {
            return Some(found);
        }
        Channel::named(name).map(|channel| PrintedChannel { channel, family: None, magnitude: false, unit: None })
    }

    /// A channel in its SI unit.
    #[must_use]
    pub fn plain(channel: Channel) -> PrintedChannel {
        PrintedChannel { channel, family: None, magnitude: false, unit: None }
    }

    /// A full turn in the channel's unit, if the channel is an angle.
    #[must_use]
    pub fn turn(&self) -> Option<f64> {
        let is_degrees = self.unit.is_some_and(|unit| unit.suffix == "deg");
        self.channel.kind.periodic.then_some(if is_degrees { 360.0 } else { std::f64::consts::TAU })
    }

    /// Symbol of the channel's unit.
    #[must_use]
    pub fn unit_symbol(&self) -> &'static str {
        self.unit.map_or(self.channel.kind.unit.symbol(), |unit| unit.suffix)
    }

    /// For the magnitude of a vector, the channel of its y component.
    #[must_use]
    pub fn other_component(&self) -> Option<Channel> {
        let other = || Channel::named(&format!("{}.{Y_OF_MAGNITUDE}", self.channel.subject()));
        if self.magnitude { other() } else { None }
    }

    /// Converts a value of the channel from SI to the printed unit. `other` is the value of the
    /// [other component](PrintedChannel::other_component), if there is one.
    #[must_use]
    pub fn from_si(&self, value: f64, other: Option<f64>) -> f64 {
        let size = other.map_or(value, |other| (value * value + other * other).sqrt());
        self.unit.map_or(size, |unit| size / unit.to_si(1.0))
    }

    /// Converts a printed number to SI.
    #[must_use]
    pub fn to_si(&self, value: f64) -> f64 {
        self.unit.map_or(value, |unit| unit.to_si(value))
    }
}

/// `value` and `digits` of a number in the scenario itself. `digits` is a separate key, because TOML does not keep the
/// printed text.
pub(super) fn number(entry: &mut TomlTable) -> Result<Printed> {
    let value = entry.number("value")?;
    let digits = digits(entry)?;
    Ok(Printed::with_digits(value, digits))
}

/// Reason why a printed number is wrong, and the correct number, in the printed unit.
pub(super) struct Correction {
    pub finding: String,
    pub right: Printed,
}

impl Correction {
    /// Reads the keys `finding` and `right`, which must occur together. `None` if both keys are missing.
    pub fn read(entry: &mut TomlTable, printed: &Printed) -> Result<Option<Self>> {
        let Some(finding) = finding(entry)? else { return Ok(None) };
        let mut table = entry.table("right")?;
        let right = table.read(|table| {
            let right = number(table)?;
            table.finish()?;
            Ok(right)
        })?;
        check_apart(entry, printed, &right)?;
        Ok(Some(Correction { finding, right }))
    }
}

/// Reads the key `finding`: the anchor of a section of `docs/findings.md`. If this key is present, the key `right` is
/// required too.
pub(super) fn finding(entry: &mut TomlTable) -> Result<Option<String>> {
    let finding = entry.optional_string("finding")?;
    let help = sentences::A_NUMBER_KNOWN_TO_BE_WRONG;
    match (finding, entry.has("right")) {
        (Some(finding), true) => Ok(Some(finding)),
        (None, false) => Ok(None),
        (Some(_), false) => Err(entry.lacks(&["right"], help)),
        (None, true) => Err(entry.lacks(&["finding"], help)),
    }
}

/// Refuses a correct number that is too close to the printed number, because one computed number could then agree with
/// both numbers.
pub(super) fn check_apart(entry: &TomlTable, printed: &Printed, right: &Printed) -> Result<()> {
    if (printed.value - right.value).abs() > printed.half_unit + right.half_unit {
        return Ok(());
    }
    let message = sentences::with_decimals_is_not_apart(&right.value, &right.digits, &printed.value, &printed.digits);
    let help = sentences::GIVE_THE_RIGHT_NUMBER_WITH_MORE;
    entry.refuse("right", message, help)
}

/// The count of printed decimals under the key `digits`.
pub(super) fn digits(entry: &mut TomlTable) -> Result<i32> {
    let digits = entry.integer("digits")?;
    match i32::try_from(digits) {
        Ok(digits) if digits.abs() <= MOST_DIGITS => Ok(digits),
        _ => {
            let help = sentences::give_the_count_of_printed(&(-MOST_DIGITS), &MOST_DIGITS);
            entry.refuse("digits", sentences::found_but_no_number_is_printed(&digits), help)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_counted_in_the_text() {
        let digits = |text| Printed::cell(text).map(|cell| cell.decimals);
        assert_eq!(digits("-14.890"), Some(3));
        assert_eq!(digits("-0.00"), Some(2));
        assert_eq!(digits("82"), Some(0));
        assert_eq!(digits("1.5e3"), Some(-2));
        assert_eq!(digits("1.5E-3"), Some(4));
        for wrong in ["", "-", ".5", "1,5", "1.2.3", "nan", "inf", "--1", "1e", "0x10", "1_000", "12 mm", "1e999"] {
            assert_eq!(digits(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn the_bound_is_half_a_unit_of_the_last_digit_of_the_column() {
        assert_eq!(Printed::with_digits(-14.89, 2).half_unit, 0.005 * (1.0 + 1e-9));
        let cells = ["-14.89", "2.5", "12"].map(|text| Printed::cell(text).unwrap());
        for number in columns::numbers(&cells) {
            let printed = Printed::of_column(&number);
            assert_eq!((printed.digits, printed.half_unit), (2, 0.005 * (1.0 + 1e-9)));
        }
    }

    #[test]
    fn channels_carry_their_printed_unit() {
        let named =
            |name: &str| PrintedChannel::named(name).map(|found| (found.channel.to_string(), found.to_si(180.0)));
        assert_eq!(named("point.2.x_mm"), Some(("point.2.x_m".into(), 0.18)));
        assert_eq!(named("point.2.x_m"), Some(("point.2.x_m".into(), 180.0)));
        assert_eq!(named("joint.B.slide_mm"), Some(("joint.B.slide_m".into(), 0.18)));
        assert_eq!(named("link.a.angle_deg"), Some(("link.a.angle_rad".into(), std::f64::consts::PI)));
        assert_eq!(named("link.a.omega_rad_s"), Some(("link.a.omega_rad_s".into(), 180.0)));
        assert_eq!(named("joint.A.f_N"), Some(("joint.A.fx_N".into(), 180.0)));
        assert!(PrintedChannel::named("joint.A.f_N").unwrap().magnitude);
        assert_eq!(named("link.A.f_N"), None);
        assert_eq!(named("point.2.vx_mm_s"), None);
        assert_eq!(named("link.a.omega_deg_s"), None);
        assert_eq!(named("link.a.angle_mm"), None);
        assert_eq!(named("point.2.x_deg"), None);
        assert_eq!(named("drive.torque_N_mm"), None);
    }
}
