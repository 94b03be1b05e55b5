//! What an analytic side gives the integrator: accelerations of the free driving links at their angles and speeds.

use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Motion;
use linkage::math::dense::Lu;
use linkage::solver::State;

/// The driving links at one instant, in the order of the drives: angles in the world (rad), angular velocities (rad/s) and accelerations (rad/s^2).
/// Those of a drive that follows its law are the law's.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inputs {
    pub(crate) angles: Vec<f64>,
    pub(crate) speeds: Vec<f64>,
    pub(crate) accelerations: Vec<f64>,
}

/// What acts besides gravity while a piece of the motion lasts.
#[derive(Clone, Debug)]
pub(crate) struct Held {
    /// Moment of the motor on the crank (N m), counter-clockwise positive.
    pub(crate) motor: f64,
    /// Moment of inertia that turns with the crank (kg m^2): rotor and reducer.
    pub(crate) added: f64,
    /// Sense of the link that a load asks for (+1, -1, 0 for standstill), of every load; not read for others.
    pub(crate) senses: Vec<f64>,
}

/// As [`Case::loads_on`], with the senses held that loads ask for.
pub(crate) fn loads_held(case: &Case, motions: &[Motion], angles: &[f64], senses: &[f64], out: &mut [Wrench]) {
    case.loads_with(motions, angles, |index, load, _, crank| load.moment_in(senses[index], crank), out);
}

/// Solves a side's equations of motion for the accelerations of the free driving links, whose numbers are `free`, and puts them into the inputs.
pub(crate) fn embed(matrix: &mut Lu, right: &mut [f64], free: &[usize], inputs: &mut Inputs) -> Result<()> {
    if !matrix.factor() {
        let message = "the equations of motion are singular: a freedom has no inertia at this pose";
        return Err(
            Error::new(ErrorKind::Numeric, message).help("give its links, or the motor's rotor, a moment of inertia")
        );
    }
    matrix.solve(right);
    for (&index, &alpha) in free.iter().zip(right.iter()) {
        inputs.accelerations[index] = alpha;
    }
    Ok(())
}

/// An analytic side's equations of motion in the coordinates of the driving links.
pub(crate) trait Side {
    /// Solves for the accelerations of the free driving links, and puts them into the inputs. Those of the others are known.
    fn accelerate(&mut self, inputs: &mut Inputs, held: &Held) -> Result<()>;

    /// Angular velocity (rad/s) of a link at these angles and speeds.
    fn spin(&mut self, inputs: &Inputs, link: usize) -> Result<f64>;

    /// Angular velocity and acceleration of a link as last [accelerated](Side::accelerate).
    fn link_rates(&self, link: usize) -> [f64; 2];

    /// The whole state as last [accelerated](Side::accelerate), turns of the links kept, reactions if they are wanted.
    fn fill(&mut self, inputs: &Inputs, state: &mut State) -> Result<()>;
}
