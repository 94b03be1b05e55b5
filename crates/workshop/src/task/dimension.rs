//! Dimensions that vary: places of points in their links, by coordinates or by distance and direction from another point.

use linkage::math::{Vec2, unit};
use linkage::mechanism::{Handle, Mechanism};

/// A number that is fixed, or one of those that vary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// Fixed (SI).
    Fixed(f64),
    /// The variable of this index.
    Free(usize),
}

impl Entry {
    /// Its value (SI), with those of the variables.
    #[inline]
    #[must_use]
    pub fn value(self, values: &[f64]) -> f64 {
        match self {
            Entry::Fixed(value) => value,
            Entry::Free(index) => values[index],
        }
    }
}

/// The place of a point in its link.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The point, and the joints that move with it.
    pub handle: Handle,
    /// Point of the same link that length and angle count from; without one the entries are x and y.
    pub from: Option<usize>,
    /// x and y (m), or length (m) and angle (rad) in the link's frame.
    pub entries: [Entry; 2],
}

impl Place {
    /// Puts the point where `values` say.
    #[inline]
    pub fn apply(&self, values: &[f64], mechanism: &mut Mechanism) {
        let [a, b] = self.entries.map(|entry| entry.value(values));
        let local = match self.from {
            None => Vec2::new(a, b),
            Some(from) => mechanism.links()[self.handle.link].points[from].local + unit(b) * a,
        };
        mechanism.place(&self.handle, local);
    }
}
