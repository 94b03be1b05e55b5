//! What a kind of fault is.

use linkage::case::Case;
use linkage::solver::State;
use prover::check::SlipKind as Slip;

linkage::words! {
    /// What a fault is in.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum FaultFamily: name {
        /// Lengths, guides and configurations.
        Geometry = "geometry",
        /// Angles and speeds of driving links, and instants.
        Drive = "drive",
        /// Gravity, masses, mass centres and moments of inertia.
        Mass = "mass",
        /// Loads, springs and dampers.
        Load = "load",
        /// Motor and reducer.
        Motor = "motor",
        /// Positions and angles that are answered.
        Position = "position",
        /// First derivatives.
        Rate = "rate",
        /// Second derivatives.
        Acceleration = "acceleration",
        /// Reactions and moments.
        Force = "force",
        /// What only one comparison sees.
        Judgement = "judgement",
        /// Formulas of the scenario, and what they claim.
        Formula = "formula",
    }
}

/// One answered state among all of a run.
#[derive(Clone, Copy)]
pub struct FaultInstant<'a> {
    /// The case that was asked.
    pub case: &'a Case,
    /// Row of the grid.
    pub row: usize,
}

/// How a fault is planted. A size is relative to what the fault is in: a share of a length, of a mass, an angle in rad.
#[derive(Clone, Copy)]
pub enum Plant {
    /// In the case that a party gets. `None` where the case has no such part.
    Case(fn(&Case, f64) -> Option<Case>),
    /// In every state that a party answers. `None` where the state has no such part.
    Answer(fn(FaultInstant, &mut State, f64) -> Option<()>),
    /// In a formula of the scenario.
    Formula(Mistake),
}

/// A mistake in a formula that claims an exact value, or in a step that it uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// One slip in writing.
    Slip(Slip),
    /// The whole formula is larger by a share.
    Larger,
    /// The same quantity of another link, point or joint is claimed.
    Subject,
    /// Another quantity with the same unit is claimed.
    Quantity,
}

/// A kind of fault.
#[derive(Clone, Copy)]
pub struct FaultKind {
    /// Name, as on the command line.
    pub name: &'static str,
    /// What is wrong, in words.
    pub says: &'static str,
    /// What it is in.
    pub family: FaultFamily,
    /// Its size at first, if it has one that can be made smaller.
    pub size: Option<f64>,
    /// How it is planted.
    pub plant: Plant,
}

impl FaultKind {
    /// The same with a size that can be made smaller.
    pub(in crate::mutate) const fn sized(self, size: f64) -> FaultKind {
        FaultKind { size: Some(size), ..self }
    }
}

/// What a change has to say of itself.
pub(in crate::mutate) trait Told<T> {
    /// What it comes to; `None` where there was nothing to change.
    fn told(self) -> Option<T>;
}

impl<T> Told<T> for Option<T> {
    fn told(self) -> Option<T> {
        self
    }
}

impl Told<()> for () {
    fn told(self) -> Option<()> {
        Some(())
    }
}

/// The table of a family: `"name": "what is wrong", |..| how it is planted;`, the name followed by the size at first
/// where it can be made smaller.
macro_rules! kinds {
    ($family:ident, $plant:ident: $($name:literal $(($size:literal))?: $says:literal, |$($given:pat_param),*| $change:expr;)*) => {
        pub(super) const KINDS: &[$crate::mutate::kinds::FaultKind] = &[$($crate::mutate::kinds::FaultKind {
            name: $name,
            says: $says,
            family: $crate::mutate::kinds::FaultFamily::$family,
            size: None,
            plant: $crate::mutate::kinds::Plant::$plant(|$($given),*| $crate::mutate::kinds::Told::told($change)),
        }$(.sized($size))?),*];
    };
}
pub(in crate::mutate) use kinds;
