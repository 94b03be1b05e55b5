//! Loads on links besides gravity and inertia.

/// A load on one link.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Load {
    /// Moment of constant size that acts against the link's rotation, and not at all while it stands still.
    Resistance {
        /// The loaded link.
        link: usize,
        /// Size of the moment (N m), not negative.
        moment: f64,
    },
}

impl Load {
    /// The link the load acts on.
    #[inline]
    #[must_use]
    pub fn link(&self) -> usize {
        match *self {
            Load::Resistance { link, .. } => link,
        }
    }

    /// Moment on the link (N m, counter-clockwise positive) while it turns with `omega` (rad/s).
    #[inline]
    #[must_use]
    pub fn moment(&self, omega: f64) -> f64 {
        match *self {
            Load::Resistance { moment, .. } if omega > 0.0 => -moment,
            Load::Resistance { moment, .. } if omega < 0.0 => moment,
            Load::Resistance { .. } => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resistance_opposes_the_rotation() {
        let load = Load::Resistance { link: 3, moment: 100.0 };
        assert_eq!([load.moment(2.0), load.moment(-0.1), load.moment(0.0)], [-100.0, 100.0, 0.0]);
        assert_eq!(load.link(), 3);
    }
}
