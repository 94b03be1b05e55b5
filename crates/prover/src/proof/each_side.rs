//! One of something for each analytic side.

use std::ops::{Index, IndexMut};

use super::options::Reference;

/// One of each analytic side, found by the side.
#[derive(Clone, Copy, Debug, Default)]
pub struct EachSide<T>([T; 2]);

impl<T> EachSide<T> {
    /// What side 1 and side 2 have.
    pub const fn new(assur: T, newton: T) -> Self {
        EachSide([assur, newton])
    }

    /// What `of` says of every side.
    pub fn of(of: impl FnMut(Reference) -> T) -> Self {
        EachSide(Reference::ALL.map(of))
    }

    /// The same, with the first error.
    pub(crate) fn tried<E>(mut of: impl FnMut(Reference) -> Result<T, E>) -> Result<Self, E> {
        Ok(EachSide([of(Reference::Assur)?, of(Reference::Newton)?]))
    }

    /// Every side and what it has.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Reference, &T)> {
        Reference::ALL.into_iter().zip(&self.0)
    }

    /// The same by reference.
    pub(crate) fn each_ref(&self) -> EachSide<&T> {
        EachSide(self.pair())
    }

    /// What side 1 and side 2 have.
    pub(crate) fn pair(&self) -> [&T; 2] {
        self.0.each_ref()
    }

    /// The same, taken apart.
    pub(crate) fn into_pair(self) -> [T; 2] {
        self.0
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
