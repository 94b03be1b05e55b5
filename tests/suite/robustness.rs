//! With any input, the program neither panics nor hangs.
//! Every message states the location of the fault, and names in the input cannot lead out of their folder.

mod bad;
mod doors;
mod entry_points;
mod memory;
mod names;
mod overwriting;
mod recordings;
mod scales;
mod turns;
