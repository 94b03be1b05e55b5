//! The units of channels.

use std::fmt;

crate::words! {
    /// SI unit of a channel.
    /// Code that depends on the unit matches on this enum.
    /// After a unit is added, such code does not compile until it handles this unit.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Unit: symbol {
        /// Angles (rad).
        Radian = "rad",
        /// Angular velocities (rad/s).
        RadianPerSecond = "rad/s",
        /// Angular accelerations (rad/s^2).
        RadianPerSecondSquared = "rad/s^2",
        /// Lengths and coordinates (m).
        Metre = "m",
        /// Velocities (m/s).
        MetrePerSecond = "m/s",
        /// Accelerations (m/s^2).
        MetrePerSecondSquared = "m/s^2",
        /// Forces (N).
        Newton = "N",
        /// Moments (N m).
        NewtonMetre = "N m",
    }
}

impl Unit {
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
