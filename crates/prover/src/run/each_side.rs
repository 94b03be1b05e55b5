//! The analytic sides, and a container with one value for each side.

use std::fmt;
use std::ops::{Index, IndexMut};

use linkage::solver::Solver;

/// An analytic side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reference {
    /// Side 1: Assur groups, dyads in closed form.
    #[default]
    Assur,
    /// Side 2: the whole mechanism by Newton's method and Lagrange multipliers.
    Newton,
}

impl Reference {
    /// Both sides, the default first.
    pub const ALL: [Reference; 2] = [Reference::Assur, Reference::Newton];

    /// Name, as on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.solver().name()
    }

    /// The side called `name`.
    #[must_use]
    pub fn named(name: &str) -> Option<Reference> {
        Reference::ALL.into_iter().find(|side| side.name() == name)
    }

    /// The other side.
    #[must_use]
    pub fn other(self) -> Reference {
        match self {
            Reference::Assur => Reference::Newton,
            Reference::Newton => Reference::Assur,
        }
    }

    /// The solver of this side.
    #[must_use]
    pub fn solver(self) -> &'static dyn Solver {
        match self {
            Reference::Assur => &analytic::AssurSolver,
            Reference::Newton => &analytic::NewtonSolver,
        }
    }
}

impl fmt::Display for Reference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// One value for each analytic side, indexed by the side.
#[derive(Clone, Copy, Debug, Default)]
pub struct EachSide<T>([T; 2]);

impl<T> EachSide<T> {
    /// The values of side 1 and side 2.
    pub const fn new(assur: T, newton: T) -> Self {
        EachSide([assur, newton])
    }

    /// Calls `of` for every side.
    pub fn of(of: impl FnMut(Reference) -> T) -> Self {
        EachSide(Reference::ALL.map(of))
    }

    /// Calls `of` for every side, as `EachSide::of` does, and returns the first error.
    pub(crate) fn tried<E>(mut of: impl FnMut(Reference) -> Result<T, E>) -> Result<Self, E> {
        Ok(EachSide([of(Reference::Assur)?, of(Reference::Newton)?]))
    }

    /// Every side and its value.
    pub fn iter(&self) -> impl Iterator<Item = (Reference, &T)> {
        Reference::ALL.into_iter().zip(&self.0)
    }

    /// References to the values of both sides.
    pub(crate) fn each_ref(&self) -> EachSide<&T> {
        EachSide(self.pair())
    }

    /// The values of side 1 and side 2.
    #[must_use]
    pub fn pair(&self) -> [&T; 2] {
        self.0.each_ref()
    }
}

impl<T> Index<Reference> for EachSide<T> {
    type Output = T;

    fn index(&self, side: Reference) -> &T {
        &self.0[side as usize]
    }
}

impl<T> IndexMut<Reference> for EachSide<T> {
    fn index_mut(&mut self, side: Reference) -> &mut T {
        &mut self.0[side as usize]
    }
}
