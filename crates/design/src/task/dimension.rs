//! Variable dimensions: positions of points in their links, by coordinates or by distance and direction from another point.

use linkage::math::{Vec2, unit};
use linkage::mechanism::{Handle, Mechanism};

/// A fixed number or a variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// Fixed (SI).
    Fixed(f64),
    /// The variable with this index.
    Free(usize),
}

impl Entry {
    /// Its value (SI), given the values of the variables.
    #[inline]
    #[must_use]
    pub fn value(self, values: &[f64]) -> f64 {
        match self {
            Entry::Fixed(value) => value,
            Entry::Free(index) => values[index],
        }
    }
}

/// The position of a point in its link.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The point, and the joints that move with it.
    pub handle: Handle,
    /// Point of the same link from which length and angle are measured. Without it the entries are x and y.
    pub from: Option<usize>,
    /// x and y (m), or length (m) and angle (rad) in the link's frame.
    pub entries: [Entry; 2],
}

impl Place {
    /// Moves the point to the position that `values` define.
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
