//! Units of scenario files. Every key of a physical quantity ends in its unit. The program itself uses only SI.

use crate::sentences;
use std::f64::consts::{PI, TAU};

use linkage::input::Input;

/// One unit of a family.
#[derive(Debug, PartialEq)]
pub struct NamedUnit {
    /// Ending of keys in this unit, without the underscore before the ending.
    pub suffix: &'static str,
    factor: f64,
    // The divisor is kept separate from the factor because of rounding: 150 / 1000 is the double nearest to 0.15, but
    // 150 * 0.001 need not be.
    divisor: f64,
}

const fn unit(suffix: &'static str, factor: f64, divisor: f64) -> NamedUnit {
    NamedUnit { suffix, factor, divisor }
}

impl NamedUnit {
    /// A number in this unit, converted to SI.
    #[must_use]
    pub fn to_si(&self, value: f64) -> f64 {
        value * self.factor / self.divisor
    }
}

/// Units that measure one quantity, the SI unit first.
#[derive(Debug)]
pub struct UnitFamily {
    /// The quantity with its article, for messages.
    pub noun: &'static str,
    /// Units, the SI unit first.
    pub units: &'static [NamedUnit],
    /// Further units. Keys may end in these units, but messages and channels use only the units in `units`.
    pub further: &'static [NamedUnit],
    /// Upper limit of the magnitude in SI, far beyond any real machine. A number above the limit is a mistake in the
    /// unit.
    /// Up to this limit, solvers and engines can multiply the number by other quantities of the file without overflow.
    pub most: f64,
}

impl UnitFamily {
    const fn of(noun: &'static str, units: &'static [NamedUnit], most: f64) -> UnitFamily {
        UnitFamily { noun, units, further: &[], most }
    }

    const fn also(self, further: &'static [NamedUnit]) -> UnitFamily {
        UnitFamily { further, ..self }
    }

    /// All units in which a key of this family may be written.
    fn all(&self) -> impl DoubleEndedIterator<Item = &'static NamedUnit> {
        self.units.iter().chain(self.further)
    }

    /// The usual spellings of a key of this family: `length_m` or `length_mm`.
    #[must_use]
    pub fn keys(&self, base: &str) -> Vec<String> {
        self.units.iter().map(|unit| format!("{base}_{}", unit.suffix)).collect()
    }

    /// All spellings of a key of this family, the usual spellings first.
    #[must_use]
    pub fn all_keys(&self, base: &str) -> Vec<String> {
        self.all().map(|unit| format!("{base}_{}", unit.suffix)).collect()
    }

    /// The unit at the end of `key`, if `key` consists of `base` and a unit of this family.
    #[must_use]
    pub fn unit_of(&self, base: &str, key: &str) -> Option<&'static NamedUnit> {
        let suffix = key.strip_prefix(base)?.strip_prefix('_')?;
        self.all().find(|unit| unit.suffix == suffix)
    }
}

const fn si(suffix: &'static str) -> NamedUnit {
    unit(suffix, 1.0, 1.0)
}

/// Lengths and coordinates.
pub static LENGTH: UnitFamily = UnitFamily::of("a length", &[si("m"), unit("mm", 1.0, 1e3)], 1e9)
    .also(&[unit("cm", 1.0, 1e2), unit("in", 25.4, 1e3)]);
/// Angles.
pub static ANGLE: UnitFamily = UnitFamily::of("an angle", &[si("rad"), unit("deg", PI / 180.0, 1.0)], 1e9);
/// Angular velocities; rpm are turns per minute.
pub static ANGULAR_SPEED: UnitFamily = UnitFamily::of(
    sentences::AN_ANGULAR_VELOCITY,
    &[si("rad_s"), unit("rpm", TAU, 60.0)],
    1e9,
)
.also(&[unit("deg_s", PI / 180.0, 1.0)]);
/// Speeds along a line.
pub static SPEED: UnitFamily = UnitFamily::of("a speed", &[si("m_s"), unit("mm_s", 1.0, 1e3)], 1e9)
    .also(&[unit("cm_s", 1.0, 1e2), unit("in_s", 25.4, 1e3)]);
/// Times.
pub static TIME: UnitFamily = UnitFamily::of("a time", &[si("s"), unit("ms", 1.0, 1e3)], 1e12);
/// Masses.
pub static MASS: UnitFamily = UnitFamily::of("a mass", &[si("kg"), unit("g", 1.0, 1e3)], 1e30)
    .also(&[unit("t", 1e3, 1.0), unit("lb", 0.453_592_37, 1.0)]);
/// Moments of inertia.
pub static INERTIA: UnitFamily = UnitFamily::of(sentences::A_MOMENT_OF_INERTIA, &[si("kg_m2")], 1e30);
/// Accelerations.
pub static ACCELERATION: UnitFamily = UnitFamily::of("an acceleration", &[si("m_s2")], 1e12);
/// Moments of forces.
pub static MOMENT: UnitFamily = UnitFamily::of("a moment", &[si("N_m")], 1e20).also(&[unit("kN_m", 1e3, 1.0)]);
/// Moments per angular velocity.
pub static MOMENT_PER_SPEED: UnitFamily =
    UnitFamily::of(sentences::A_CHANGE_OF_A_MOMENT_WITH_AN_ANGULAR, &[si("N_m_s")], 1e20);
/// Forces.
pub static FORCE: UnitFamily =
    UnitFamily::of("a force", &[si("N"), unit("kN", 1e3, 1.0)], 1e20).also(&[unit("lbf", 4.448_221_615_260_5, 1.0)]);
/// Pressures.
pub static PRESSURE: UnitFamily =
    UnitFamily::of("a pressure", &[si("Pa"), unit("bar", 1e5, 1.0)], 1e20).also(&[unit("MPa", 1e6, 1.0)]);
/// Forces per length.
pub static STIFFNESS: UnitFamily = UnitFamily::of("a stiffness", &[si("N_m"), unit("N_mm", 1e3, 1.0)], 1e20);
/// Forces per velocity.
pub static DAMPING: UnitFamily = UnitFamily::of("a damping", &[si("N_s_m")], 1e20);
/// Moments per angle.
pub static TORSIONAL_STIFFNESS: UnitFamily = UnitFamily::of(sentences::A_TORSIONAL_STIFFNESS, &[si("N_m_rad")], 1e20);
/// Masses of bars per unit length.
pub static MASS_PER_LENGTH: UnitFamily = UnitFamily::of(sentences::A_MASS_PER_LENGTH, &[si("kg_per_m")], 1e20);
/// Powers.
pub static POWER: UnitFamily = UnitFamily::of("a power", &[si("W"), unit("kW", 1e3, 1.0)], 1e20);

/// The families of units in which inputs of any kind are written.
pub static INPUTS: [&UnitFamily; 2] = [&ANGLE, &LENGTH];
/// The units in which rates of inputs are written.
pub static INPUT_RATES: [&UnitFamily; 2] = [&ANGULAR_SPEED, &SPEED];
/// The units in which inputs or times are written.
pub static INPUTS_OR_TIMES: [&UnitFamily; 3] = [&ANGLE, &LENGTH, &TIME];

/// The units in which values of an input are written.
#[must_use]
pub fn of_input(input: Input) -> &'static UnitFamily {
    match input {
        Input::Angle | Input::Turn => INPUTS[0],
        Input::Slide => INPUTS[1],
    }
}

/// The units in which rates of an input are written.
#[must_use]
pub fn of_input_rate(input: Input) -> &'static UnitFamily {
    match input {
        Input::Angle | Input::Turn => INPUT_RATES[0],
        Input::Slide => INPUT_RATES[1],
    }
}

/// Units that scenario files do not support: ending of the key, name, and value in a supported unit.
static UNSUPPORTED: [(&str, &str, &str); 11] = [
    ("inch", "inches", "1 in = 25.4 mm"),
    ("ft", "feet", "1 ft = 304.8 mm"),
    ("um", "micrometres", "1 um = 1e-3 mm"),
    ("kgf", "kilograms-force", "1 kgf = 9.80665 N"),
    ("kp", "kiloponds", "1 kp = 9.80665 N"),
    ("grad", "gradians", "1 grad = 0.9 deg"),
    ("turns", "turns", "1 turn = 360 deg"),
    ("rps", "turns per second", "1 turn/s = 60 rpm"),
    ("hz", "hertz", "1 turn/s = 60 rpm"),
    ("min", "minutes", "1 min = 60 s"),
    ("N_mm", "newton millimetres", "1 N·mm = 1e-3 N·m"),
];

/// Name of the unsupported unit at the end of a key, and its value in a supported unit.
#[must_use]
pub fn unsupported(suffix: &str) -> Option<(&'static str, &'static str)> {
    let named = |(own, ..): &&(&str, &str, &str)| own.eq_ignore_ascii_case(suffix);
    UNSUPPORTED.iter().find(named).map(|(_, name, size)| (*name, *size))
}

/// All families.
pub static ALL: [&UnitFamily; 17] = [
    &LENGTH,
    &ANGLE,
    &ANGULAR_SPEED,
    &SPEED,
    &TIME,
    &MASS,
    &INERTIA,
    &ACCELERATION,
    &MOMENT,
    &MOMENT_PER_SPEED,
    &FORCE,
    &PRESSURE,
    &STIFFNESS,
    &DAMPING,
    &TORSIONAL_STIFFNESS,
    &MASS_PER_LENGTH,
    &POWER,
];

/// The longest unit at the end of a key, with the first family that contains this unit.
#[must_use]
pub fn ending(key: &str) -> Option<(&'static UnitFamily, &'static NamedUnit)> {
    let all = ALL.iter().flat_map(|family| family.all().map(move |unit| (*family, unit)));
    let ends =
        |unit: &NamedUnit| key.strip_suffix(unit.suffix).is_some_and(|rest| rest.len() > 1 && rest.ends_with('_'));
    // If several families contain the longest unit, the first family is kept.
    all.filter(|(_, unit)| ends(unit)).rev().max_by_key(|(_, unit)| unit.suffix.len())
}

/// Whether two units measure the same quantity.
#[must_use]
pub fn alike(one: &NamedUnit, other: &NamedUnit) -> bool {
    let has = |family: &UnitFamily, unit: &NamedUnit| family.all().any(|own| own.suffix == unit.suffix);
    ALL.iter().any(|family| has(family, one) && has(family, other))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn si_of(family: &UnitFamily, suffix: &str, value: f64) -> f64 {
        family.all().find(|unit| unit.suffix == suffix).unwrap().to_si(value)
    }

    #[test]
    fn units_are_converted() {
        assert_eq!(si_of(&LENGTH, "mm", 150.0), 0.15);
        assert_eq!(si_of(&ANGLE, "deg", 180.0), PI);
        assert!((si_of(&ANGULAR_SPEED, "rpm", 60.0) / TAU - 1.0).abs() < 4e-16);
        assert!((si_of(&ANGULAR_SPEED, "rpm", 130.0) - 13.613_568_165_555_77).abs() < 4e-15);
        assert_eq!(si_of(&MASS, "g", 2600.0), 2.6);
        assert_eq!(si_of(&TIME, "ms", 1.0), 1e-3);
        assert_eq!(si_of(&FORCE, "kN", 1.5), 1500.0);
        assert_eq!(si_of(&STIFFNESS, "N_mm", 1.5), 1500.0);
        assert_eq!([si_of(&LENGTH, "cm", 2.5), si_of(&LENGTH, "in", 10.0)], [0.025, 0.254]);
        assert_eq!([si_of(&FORCE, "lbf", 1.0), si_of(&MASS, "lb", 100.0)], [4.448_221_615_260_5, 45.359_237]);
        assert_eq!([si_of(&MOMENT, "kN_m", 2.5), si_of(&MASS, "t", 1.5)], [2500.0, 1500.0]);
    }

    #[test]
    fn every_family_starts_with_its_si_unit() {
        for family in ALL {
            assert_eq!(family.units[0].to_si(2.5), 2.5, "{}", family.noun);
        }
    }

    #[test]
    fn the_longest_unit_that_fits_is_taken() {
        let suffix = |key| ending(key).map(|(_, unit)| unit.suffix);
        let keys = ["a_mm", "k_N_mm", "omega_rad_s", "j_kg_m2", "m", "ratio", "_mm", "a_m_s2"];
        assert_eq!(
            keys.map(suffix),
            [Some("mm"), Some("N_mm"), Some("rad_s"), Some("kg_m2"), None, None, None, Some("m_s2")]
        );
    }

    #[test]
    fn keys_end_in_their_unit() {
        assert_eq!(LENGTH.keys("length"), ["length_m", "length_mm"]);
        assert_eq!(LENGTH.unit_of("length", "length_mm").unwrap().suffix, "mm");
        assert!(LENGTH.unit_of("length", "length").is_none() && LENGTH.unit_of("length", "length_ft").is_none());
        assert!(LENGTH.unit_of("x", "x_m_s").is_none());
    }
}
