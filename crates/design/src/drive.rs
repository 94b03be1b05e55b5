//! Choice of a drive: the motor's power and speed, its catalogue, and the flywheel.

pub mod catalogue;
pub mod flywheel;
pub mod motor;
