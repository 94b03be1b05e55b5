//! The sorts of loads.

/// The sorts with their names and meanings in one table: what is not in it is no sort, so that no list can lack one.
macro_rules! sorts {
    ($($(#[$meaning:meta])* $sort:ident = $name:literal,)*) => {
        /// Sort of a load: see the variants of [`Load`](super::Load).
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum LoadSort {
            $($(#[$meaning])* $sort,)*
        }

        impl LoadSort {
            /// All sorts, in the order of the documentation.
            pub const ALL: &[LoadSort] = &[$(LoadSort::$sort),*];

            /// Name in scenario files.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(LoadSort::$sort => $name,)*
                }
            }
        }
    };
}

sorts! {
    /// A moment against the rotation of a link.
    Resistance = "resistance",
    /// A moment that does not depend on the speed.
    Moment = "moment",
    /// A force on a point.
    Force = "force",
    /// A force against the motion of a point.
    ResistingForce = "resisting_force",
    /// A spring between two points.
    Spring = "spring",
    /// A damper between two points.
    Damper = "damper",
    /// A spring between the angles of two links.
    TorsionSpring = "torsion_spring",
    /// A damper between the angular velocities of two links.
    TorsionDamper = "torsion_damper",
}

impl LoadSort {
    /// The sort called `name` in scenario files.
    #[must_use]
    pub fn named(name: &str) -> Option<LoadSort> {
        LoadSort::ALL.iter().copied().find(|sort| sort.name() == name)
    }
}
