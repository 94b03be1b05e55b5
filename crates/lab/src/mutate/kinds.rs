//! Kinds of single faults. The table of a family has one row for each kind.

mod accelerations;
mod drives;
mod forces;
mod formulas;
mod geometry;
mod judgement;
mod kind;
mod loads;
mod masses;
mod motors;
mod positions;
mod rates;
mod touch;

pub(super) use kind::Told;
#[cfg(test)]
pub(super) use kind::kinds;
pub use kind::{FaultFamily, FaultInstant, FaultKind, Mistake, Plant};

/// All kinds, family by family.
pub fn all() -> impl Iterator<Item = &'static FaultKind> {
    let tables: [&'static [FaultKind]; 11] = [
        geometry::KINDS,
        drives::KINDS,
        masses::KINDS,
        loads::KINDS,
        motors::KINDS,
        positions::KINDS,
        rates::KINDS,
        accelerations::KINDS,
        forces::KINDS,
        judgement::KINDS,
        formulas::KINDS,
    ];
    tables.into_iter().flatten()
}

/// The kind called `name`.
pub fn named(name: &str) -> Option<&'static FaultKind> {
    all().find(|kind| kind.name == name)
}
