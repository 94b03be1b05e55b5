//! The sorts of loads.

/// Sort of a load: see the variants of [`Load`](super::Load).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadSort {
    /// A moment against the rotation of a link.
    Resistance,
    /// A moment that does not depend on the speed.
    Moment,
    /// A force on a point.
    Force,
    /// A force against the motion of a point.
    ResistingForce,
    /// A spring between two points.
    Spring,
    /// A damper between two points.
    Damper,
    /// A spring between the angles of two links.
    TorsionSpring,
    /// A damper between the angular velocities of two links.
    TorsionDamper,
}

impl LoadSort {
    /// All sorts, in the order of the documentation.
    pub const ALL: [LoadSort; 8] = [
        LoadSort::Resistance,
        LoadSort::Moment,
        LoadSort::Force,
        LoadSort::ResistingForce,
        LoadSort::Spring,
        LoadSort::Damper,
        LoadSort::TorsionSpring,
        LoadSort::TorsionDamper,
    ];

    /// Name in scenario files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            LoadSort::Resistance => "resistance",
            LoadSort::Moment => "moment",
            LoadSort::Force => "force",
            LoadSort::ResistingForce => "resisting_force",
            LoadSort::Spring => "spring",
            LoadSort::Damper => "damper",
            LoadSort::TorsionSpring => "torsion_spring",
            LoadSort::TorsionDamper => "torsion_damper",
        }
    }

    /// The sort called `name` in scenario files.
    #[must_use]
    pub fn named(name: &str) -> Option<LoadSort> {
        LoadSort::ALL.into_iter().find(|sort| sort.name() == name)
    }
}
