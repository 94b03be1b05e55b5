//! Choice of a drive: the power and speed of the motor, the motor catalogue, and the flywheel.

pub mod catalogue;
pub mod flywheel;
pub mod motor;
