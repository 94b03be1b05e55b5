//! Whatever comes in: no panic, no hang, no message without its place, no name that leaves its folder.

mod bad;
mod doors;
mod entry_points;
mod memory;
mod names;
mod overwriting;
mod recordings;
mod scales;
mod turns;
