//! The interface of an analytic side to the integrator: accelerations of the free driving links at their angles and
//! speeds.

use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Motion;
use linkage::math::dense::Lu;
use linkage::solver::State;

/// The driving links at one instant, in the order of the drives: angles in the world (rad), angular velocities (rad/s)
/// and accelerations (rad/s^2).
/// A drive that follows its law has the values of the law.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inputs {
    pub(crate) angles: Vec<f64>,
    pub(crate) speeds: Vec<f64>,
    pub(crate) accelerations: Vec<f64>,
}

/// The actions besides gravity that keep their form during one piece of the motion.
#[derive(Clone, Debug)]
pub(crate) struct Held {
    /// Moment of the motor on the crank (N m), counter-clockwise positive.
    pub(crate) motor: f64,
    /// Moment of inertia that turns with the crank (kg m^2): rotor and reducer.
    pub(crate) added: f64,
    /// For every load that depends on the sense of a link: that sense (+1, -1, 0 for standstill). Not used for other
    /// loads.
    pub(crate) senses: Vec<f64>,
}

/// As [`Case::loads_on`], but with fixed senses for the loads that depend on one.
pub(crate) fn loads_held(case: &Case, motions: &[Motion], angles: &[f64], senses: &[f64], out: &mut [Wrench]) {
    case.loads_with(motions, angles, |index, load, _, crank| load.moment_in(senses[index], crank), out);
}

/// Solves a side's equations of motion for the accelerations of the free driving links, whose numbers are `free`, and
/// writes them to the inputs.
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
    /// Solves for the accelerations of the free driving links and writes them to the inputs. Those of the others are
    /// known.
    fn accelerate(&mut self, inputs: &mut Inputs, held: &Held) -> Result<()>;

    /// Angular velocity (rad/s) of a link at these angles and speeds.
    fn spin(&mut self, inputs: &Inputs, link: usize) -> Result<f64>;

    /// Angular velocity and acceleration of a link after the last call of [accelerate](Side::accelerate).
    fn link_rates(&self, link: usize) -> [f64; 2];

    /// The whole state after the last call of [accelerate](Side::accelerate): turns of the links kept, reactions if
    /// wanted.
    fn fill(&mut self, inputs: &Inputs, state: &mut State) -> Result<()>;
}
