//! The units of channels.

use std::fmt;

/// SI unit of a channel.
/// Code that depends on the unit matches on this enum. Such code does not compile until it handles every new unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Unit {
    /// Angles (rad).
    Radian,
    /// Angular velocities (rad/s).
    RadianPerSecond,
    /// Angular accelerations (rad/s^2).
    RadianPerSecondSquared,
    /// Lengths and coordinates (m).
    Metre,
    /// Velocities (m/s).
    MetrePerSecond,
    /// Accelerations (m/s^2).
    MetrePerSecondSquared,
    /// Forces (N).
    Newton,
    /// Moments (N m).
    NewtonMetre,
}

impl Unit {
    /// Symbol of the unit in files, for example `rad/s^2`.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Unit::Radian => "rad",
            Unit::RadianPerSecond => "rad/s",
            Unit::RadianPerSecondSquared => "rad/s^2",
            Unit::Metre => "m",
            Unit::MetrePerSecond => "m/s",
            Unit::MetrePerSecondSquared => "m/s^2",
            Unit::Newton => "N",
            Unit::NewtonMetre => "N m",
        }
    }

    /// Suffix of names of quantities in this unit, for example `rad_s2`.
    #[must_use]
    pub const fn suffix(self) -> &'static str {
        match self {
            Unit::Radian => "rad",
            Unit::RadianPerSecond => "rad_s",
            Unit::RadianPerSecondSquared => "rad_s2",
            Unit::Metre => "m",
            Unit::MetrePerSecond => "m_s",
            Unit::MetrePerSecondSquared => "m_s2",
            Unit::Newton => "N",
            Unit::NewtonMetre => "N_m",
        }
    }
}

/// The symbol of a unit as people write it: `N·m`, `kg·m²`, `rad/s²`.
#[must_use]
pub fn shown_unit(symbol: &str) -> String {
    symbol.replace("N m", "N·m").replace("kg m", "kg·m").replace("^2", "²")
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&shown_unit(self.symbol()))
    }
}
