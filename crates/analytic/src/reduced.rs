//! Motion of a mechanism of one degree of freedom under forces: the equation of motion is reduced to the crank.
//!
//! `omega^2 / 2 dI*/dphi + I* domega/dt = M`. The first and second transfer functions give I* and dI*/dphi.
//! M is the power of motor, gravity and loads per unit speed of the crank.
//! This equation is the kinetic energy theorem for E = I* omega^2 / 2.
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.
//! See docs/numerics/forces.md.

pub(crate) mod flow;
pub mod means;
pub(crate) mod model;
pub mod run_up;
mod turn;

pub use crate::motion::march::ACCURACY;
pub use model::{Reduced, ReducedModel};
pub use run_up::{CrankState, RunUp, RunUpEnd, motion};
