//! The table of families. A new family needs an entry in this table, and a function that makes the family's case.

mod chain;
mod four_bar;
mod friction;
mod long;
mod rams;
mod random;
mod settings;
mod singular;

use super::StressFamily;

/// All families.
pub static FAMILIES: &[StressFamily] = &[
    four_bar::MASS_RATIO,
    four_bar::LENGTH_RATIO,
    four_bar::TRANSMISSION,
    four_bar::SPEED,
    four_bar::SIZE,
    rams::GEAR_RATIO,
    friction::FRICTION,
    rams::RAM,
    rams::CAM,
    settings::STEP,
    settings::SWEEPS,
    long::STEPS,
    long::TURNS,
    chain::CHAIN,
    singular::CHANGE_POINT,
    singular::REDUNDANT,
    random::RANDOM,
];

/// The family called `name`.
pub fn named(name: &str) -> Option<&'static StressFamily> {
    FAMILIES.iter().find(|family| family.name == name)
}
