//! Parts of the Rapier twin that are tested on shipped scenarios.

mod newton_euler;
