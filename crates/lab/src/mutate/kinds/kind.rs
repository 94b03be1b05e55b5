//! What a kind of fault is.

use linkage::case::Case;
use linkage::solver::State;
use prover::claims::Kind as Slip;

/// What a fault is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// Lengths, guides and configurations.
    Geometry,
    /// Angles and speeds of driving links, and instants.
    Drive,
    /// Gravity, masses, mass centres and moments of inertia.
    Mass,
    /// Loads, springs and dampers.
    Load,
    /// Motor and reducer.
    Motor,
    /// Positions and angles that are answered.
    Position,
    /// First derivatives.
    Rate,
    /// Second derivatives.
    Acceleration,
    /// Reactions and moments.
    Force,
    /// What only one comparison sees.
    Judgement,
    /// Formulas of the scenario, and what they claim.
    Formula,
}

impl Family {
    /// All families.
    pub const ALL: [Family; 11] = [
        Family::Geometry,
        Family::Drive,
        Family::Mass,
        Family::Load,
        Family::Motor,
        Family::Position,
        Family::Rate,
        Family::Acceleration,
        Family::Force,
        Family::Judgement,
        Family::Formula,
    ];

    /// Name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Family::Geometry => "geometry",
            Family::Drive => "drive",
            Family::Mass => "mass",
            Family::Load => "load",
            Family::Motor => "motor",
            Family::Position => "position",
            Family::Rate => "rate",
            Family::Acceleration => "acceleration",
            Family::Force => "force",
            Family::Judgement => "judgement",
            Family::Formula => "formula",
        }
    }
}

/// One answered state among all of a run.
#[derive(Clone, Copy)]
pub struct At<'a> {
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
    Answer(fn(At, &mut State, f64) -> Option<()>),
    /// In a formula of the scenario.
    Formula(Mistake),
}

/// A mistake in a formula that claims an exact value, or in a step that it uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// One slip of the pen.
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
pub struct Kind {
    /// Name, as on the command line.
    pub name: &'static str,
    /// What is wrong, in words.
    pub says: &'static str,
    /// What it is in.
    pub family: Family,
    /// Its size at first, if it has one that can be made smaller.
    pub size: Option<f64>,
    /// How it is planted.
    pub plant: Plant,
}

impl Kind {
    /// A fault in the case, of a fixed size.
    pub(super) const fn case(
        family: Family,
        name: &'static str,
        says: &'static str,
        change: fn(&Case, f64) -> Option<Case>,
    ) -> Kind {
        Kind { name, says, family, size: None, plant: Plant::Case(change) }
    }

    /// A fault in an answer, of a fixed size.
    pub(super) const fn answer(
        family: Family,
        name: &'static str,
        says: &'static str,
        change: fn(At, &mut State, f64) -> Option<()>,
    ) -> Kind {
        Kind { name, says, family, size: None, plant: Plant::Answer(change) }
    }

    /// The same with a size that can be made smaller.
    pub(super) const fn sized(self, size: f64) -> Kind {
        Kind { size: Some(size), ..self }
    }
}
