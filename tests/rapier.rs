//! Parts of the Rapier twin that are tested on shipped scenarios.

#[path = "rapier/newton_euler.rs"]
mod newton_euler;
