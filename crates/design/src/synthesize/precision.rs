//! Four-bars through precision points: coupler poses, path points with crank angles, or pairs of crank and rocker
//! angles.
//! The solutions of all three tasks use the dyad in standard form, see [`dyad`] (Freudenstein and Sandor 1959; Sandor
//! and Erdman, Advanced Mechanism Design, vol. 2, 1984, chapters 2 and 3).

mod choice;
pub mod dyad;
pub mod four_bar;
mod function;
mod motion;
mod path;
mod points;

pub use choice::PrecisionSynthesis;
pub use four_bar::{CrankTravel, FourBarChecks, PositionFrame, PrecisionFourBar};
pub use function::{FunctionSpec, FunctionStart};
pub use motion::{CouplerPose, MotionSpec};
pub use path::{PathSpec, TimedPoint};
