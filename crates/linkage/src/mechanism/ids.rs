//! Numbers of links, joints, groups and transmissions.
//! Each kind of item has its own type of number. A joint's number can therefore not be used for a link.

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut, Index, IndexMut, RangeFrom};

/// Number of a link, joint, group or transmission.
pub trait Ordinal: Copy {
    /// The number of the item at this index, counted from 0.
    fn at(index: usize) -> Self;

    /// Index of the item with this number, counted from 0.
    fn index(self) -> usize;
}

/// Declares types of numbers. Slices and vectors can be indexed with such a number in the same way as with a `usize`.
macro_rules! ids {
    ($($(#[$about:meta])* $name:ident,)*) => {$(
        $(#[$about])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub usize);

        impl $name {
            /// Index of the item with this number, counted from 0.
            #[inline]
            #[must_use]
            pub const fn index(self) -> usize {
                self.0
            }
        }

        impl Ordinal for $name {
            #[inline]
            fn at(index: usize) -> Self {
                $name(index)
            }

            #[inline]
            fn index(self) -> usize {
                self.0
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.0.fmt(f)
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.0.fmt(f)
            }
        }

        impl<T> Index<$name> for [T] {
            type Output = T;

            #[inline]
            fn index(&self, id: $name) -> &T {
                &self[id.0]
            }
        }

        impl<T> IndexMut<$name> for [T] {
            #[inline]
            fn index_mut(&mut self, id: $name) -> &mut T {
                &mut self[id.0]
            }
        }

        impl<T> Index<$name> for Vec<T> {
            type Output = T;

            #[inline]
            fn index(&self, id: $name) -> &T {
                &self[id.0]
            }
        }

        impl<T> IndexMut<$name> for Vec<T> {
            #[inline]
            fn index_mut(&mut self, id: $name) -> &mut T {
                &mut self[id.0]
            }
        }
    )*};
}

ids! {
    /// Number of a link in [`Mechanism::links`](super::Mechanism::links). 0 is the ground: [`GROUND`](super::GROUND).
    LinkId,
    /// Number of a joint in [`Mechanism::joints`](super::Mechanism::joints).
    JointId,
    /// Number of an Assur group in [`Structure::groups`](super::Structure::groups).
    GroupId,
    /// Number of a transmission in [`Mechanism::transmissions`](super::Mechanism::transmissions).
    TransmissionId,
}

/// One value for each link, joint, group or transmission, in the order of their numbers.
/// The list can be indexed only with numbers of the matching type.
/// Apart from the index type, the list behaves like a slice.
///
/// ```
/// use linkproof_linkage::mechanism::{LinkId, PerLink};
/// let masses = PerLink::from(vec![0.0, 2.0]);
/// assert_eq!(masses[LinkId(1)], 2.0);
/// ```
///
/// A joint's number is not accepted as a link's number:
///
/// ```compile_fail,E0277
/// use linkproof_linkage::mechanism::{JointId, PerLink};
/// let masses = PerLink::from(vec![0.0, 2.0]);
/// assert_eq!(masses[JointId(1)], 2.0);
/// ```
#[derive(PartialEq, Eq)]
pub struct Per<I, T>(Vec<T>, PhantomData<I>);

/// One value for each link, the ground included.
pub type PerLink<T> = Per<LinkId, T>;

/// One value for each joint.
pub type PerJoint<T> = Per<JointId, T>;

/// One value for each Assur group.
pub type PerGroup<T> = Per<GroupId, T>;

/// One value for each transmission.
pub type PerTransmission<T> = Per<TransmissionId, T>;

impl<I: Ordinal, T> Per<I, T> {
    /// The numbers, ascending.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = I> + ExactSizeIterator + Clone + use<I, T> {
        (0..self.0.len()).map(I::at)
    }

    /// All values with their numbers.
    pub fn entries(&self) -> impl DoubleEndedIterator<Item = (I, &T)> + ExactSizeIterator + Clone {
        self.0.iter().enumerate().map(|(index, value)| (I::at(index), value))
    }

    /// All values with their numbers; the values can be changed.
    pub fn entries_mut(&mut self) -> impl DoubleEndedIterator<Item = (I, &mut T)> + ExactSizeIterator {
        self.0.iter_mut().enumerate().map(|(index, value)| (I::at(index), value))
    }

    /// The value with this number; `None` if the number is too large.
    #[must_use]
    pub fn get(&self, id: I) -> Option<&T> {
        self.0.get(id.index())
    }

    /// Number of the first value for which `wanted` is true.
    #[must_use]
    pub fn find(&self, wanted: impl FnMut(&T) -> bool) -> Option<I> {
        self.0.iter().position(wanted).map(I::at)
    }
}

impl<I, T: fmt::Debug> fmt::Debug for Per<I, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<I, T: Clone> Clone for Per<I, T> {
    fn clone(&self) -> Self {
        Per(self.0.clone(), PhantomData)
    }

    /// Copies `source` into the memory of `self`. The default implementation would allocate new memory.
    fn clone_from(&mut self, source: &Self) {
        self.0.clone_from(&source.0);
    }
}

impl<I, T> Default for Per<I, T> {
    fn default() -> Self {
        Per(Vec::new(), PhantomData)
    }
}

impl<I, T> From<Vec<T>> for Per<I, T> {
    fn from(values: Vec<T>) -> Self {
        Per(values, PhantomData)
    }
}

impl<I, T> FromIterator<T> for Per<I, T> {
    fn from_iter<A: IntoIterator<Item = T>>(values: A) -> Self {
        Per(values.into_iter().collect(), PhantomData)
    }
}

impl<I, T> Deref for Per<I, T> {
    type Target = [T];

    #[inline]
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<I, T> DerefMut for Per<I, T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}

impl<'a, I, T> IntoIterator for &'a Per<I, T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl<'a, I, T> IntoIterator for &'a mut Per<I, T> {
    type Item = &'a mut T;
    type IntoIter = std::slice::IterMut<'a, T>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter_mut()
    }
}

impl<I: Ordinal, T> Index<I> for Per<I, T> {
    type Output = T;

    #[inline]
    fn index(&self, id: I) -> &T {
        &self.0[id.index()]
    }
}

impl<I: Ordinal, T> IndexMut<I> for Per<I, T> {
    #[inline]
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.0[id.index()]
    }
}

impl<I, T> Index<RangeFrom<usize>> for Per<I, T> {
    type Output = [T];

    #[inline]
    fn index(&self, from: RangeFrom<usize>) -> &[T] {
        &self.0[from]
    }
}

impl<I, T> IndexMut<RangeFrom<usize>> for Per<I, T> {
    #[inline]
    fn index_mut(&mut self, from: RangeFrom<usize>) -> &mut [T] {
        &mut self.0[from]
    }
}
