//! Definition of a kind of fault.

use linkage::case::Case;
use linkage::solver::State;
use prover::check::SlipKind as Slip;

linkage::words! {
    /// The part that a fault affects.
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
        /// Positions and angles in the answers.
        Position = "position",
        /// First derivatives.
        Rate = "rate",
        /// Second derivatives.
        Acceleration = "acceleration",
        /// Reactions and moments.
        Force = "force",
        /// Faults that only one comparison can find.
        Judgement = "judgement",
        /// Formulas of the scenario, and their claims.
        Formula = "formula",
    }
}

/// An instant of a run at which a fault changes the answer.
#[derive(Clone, Copy)]
pub struct FaultInstant<'a> {
    /// The case that was solved.
    pub case: &'a Case,
    /// Row of the grid.
    pub row: usize,
}

/// Method of planting a fault.
/// The size of a fault is an angle in rad, or a fraction of the affected quantity (a length or a mass, for example).
#[derive(Clone, Copy)]
pub enum Plant {
    /// The fault is in the case given to a party. `None` if the case has no part that the fault affects.
    Case(fn(&Case, f64) -> Option<Case>),
    /// The fault is in every state of a party's answer. `None` if the state has no part that the fault affects.
    Answer(fn(FaultInstant, &mut State, f64) -> Option<()>),
    /// The fault is in a formula of the scenario.
    Formula(Mistake),
}

/// A mistake in a formula that claims an exact value, or in a step of its derivation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// A single writing mistake in the formula, such as a wrong sign.
    Slip(Slip),
    /// The value of the whole formula is too large by a relative amount.
    Larger,
    /// The claim names the right quantity, but the wrong link, point or joint.
    Subject,
    /// The claim names a wrong quantity that has the right unit.
    Quantity,
}

/// A kind of fault.
#[derive(Clone, Copy)]
pub struct FaultKind {
    /// Name, as on the command line.
    pub name: &'static str,
    /// Description of the fault.
    pub says: &'static str,
    /// The part that the fault affects.
    pub family: FaultFamily,
    /// Initial size of the fault; `None` if the fault cannot be made smaller.
    pub size: Option<f64>,
    /// How the fault is planted.
    pub plant: Plant,
}

impl FaultKind {
    /// The kind with an initial size, so that its faults can be made smaller.
    pub(in crate::mutate) const fn sized(self, size: f64) -> FaultKind {
        FaultKind { size: Some(size), ..self }
    }
}

/// Return value of a function that plants a fault: an `Option`, or `()` if the function always changes the case or the
/// answer.
pub(in crate::mutate) trait Told<T> {
    /// The changed value; `None` if the function has changed nothing.
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

/// The table of a family: `"name": "what is wrong", |..| how it is planted;`.
/// If the fault can be made smaller, the initial size follows the name.
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
