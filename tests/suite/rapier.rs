//! Parts of the crate `rapier-twin` that are tested on shipped scenarios.

mod newton_euler;
