//! The interface of an analytic side to the integrator: for given angles and speeds of the free driving links, the side
//! computes their accelerations.

use crate::sentences;
use linkage::case::Case;
use linkage::drive::load::sense_of;
use linkage::drive::{Load, Wrench};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::dense::Lu;
use linkage::math::{Motion, Vec2};
use linkage::mechanism::{GROUND, JointId, JointSide as Place, LinkId};
use linkage::solver::State;

/// The driven coordinates at one instant, in the order of the drives, with their rates and accelerations.
/// A coordinate is an angle (rad; for a crank the world angle) or a slide (m).
/// A drive that follows its law has the values of the law.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inputs {
    pub(crate) angles: Vec<f64>,
    pub(crate) speeds: Vec<f64>,
    pub(crate) accelerations: Vec<f64>,
}

/// The data of motor, loads and losses that stay constant during a step or during one piece of the motion.
#[derive(Clone, Debug)]
pub(crate) struct Held {
    /// Moment of the motor on the crank (N m), counter-clockwise positive.
    pub(crate) motor: f64,
    /// Moment of inertia that turns with the crank (kg m^2): rotor and reducer.
    pub(crate) added: f64,
    /// For every load and then for every transmission: the sense of the motion on which it depends (+1, -1, or 0 for
    /// standstill). The entry is unused if the load or transmission depends on no sense of a link or joint.
    pub(crate) senses: Vec<f64>,
    /// For every load against the motion of a point: direction of this motion at the beginning of the present step.
    /// The direction is a unit vector, or zero for standstill. Entries of other loads are unused.
    pub(crate) ways: Vec<Vec2>,
    /// Crank angles (rad) between which the loads' tables are smooth.
    pub(crate) piece: [f64; 2],
}

impl Held {
    /// For a load against the motion of a point: unit vector of this motion, zero at standstill.
    /// `velocity` is the point's velocity (m/s). The direction turns with the velocity.
    /// If the point reverses within a step, the direction does not reverse.
    fn way(&self, load: usize, velocity: Vec2) -> Vec2 {
        let held = self.ways[load];
        let now = sense_of(velocity);
        let along = now.dot(&held);
        if along == 0.0 { held } else { now * along.signum() }
    }
}

/// Like [`Case::loads_on`], but loads that depend on a sense use the held sense.
pub(crate) fn loads_held(case: &Case, motions: &[Motion], angles: &[f64], held: &Held, out: &mut [Wrench]) {
    let moment = |index: usize, load: &Load, crank: f64| load.moment_in(held.senses[index], crank);
    case.loads_along(motions, angles, held.piece, moment, |index, velocity| held.way(index, velocity), out);
}

/// Solves a side's equations of motion for the accelerations of the free driving links, and writes them to the inputs.
/// `free` contains the indices of these links.
pub(crate) fn embed(matrix: &mut Lu, right: &mut [f64], free: &[usize], inputs: &mut Inputs) -> Result<()> {
    if !matrix.factor() {
        let message = sentences::THE_EQUATIONS_OF_MOTION_ARE_SINGULAR;
        return Err(Error::new(ErrorKind::Numeric, message).help(sentences::GIVE_ITS_LINKS_OR_THE_MOTOR));
    }
    matrix.solve(right);
    for (&index, &alpha) in free.iter().zip(right.iter()) {
        inputs.accelerations[index] = alpha;
    }
    Ok(())
}

/// An analytic side's equations of motion in the coordinates of the driving links.
pub(crate) trait Side {
    /// Solves for the accelerations of the free driving links and writes them to the inputs.
    /// The accelerations of driving links that are not free are known.
    fn accelerate(&mut self, inputs: &mut Inputs, held: &Held) -> Result<()>;

    /// Angular velocity (rad/s) of a link at the angles and speeds in `inputs`.
    fn spin(&mut self, inputs: &Inputs, link: LinkId) -> Result<f64>;

    /// Velocity (m/s) of a point of a link at the angles and speeds in `inputs`.
    fn velocity(&mut self, inputs: &Inputs, at: Place) -> Result<Vec2>;

    /// Rate of a joint's coordinate (rad/s or m/s) at the angles and speeds in `inputs`.
    fn joint_rate(&mut self, inputs: &Inputs, joint: JointId) -> Result<f64> {
        let [first, second] = self.joint_ends(joint);
        self.spin(inputs, if second == GROUND { first } else { second })?;
        Ok(self.joint_rates(joint)[0])
    }

    /// First and second link of a joint.
    fn joint_ends(&self, joint: JointId) -> [LinkId; 2];

    /// First derivative (rad/s or m/s) and second derivative (rad/s^2 or m/s^2) of a joint's coordinate, after the last
    /// call of [accelerate](Side::accelerate).
    fn joint_rates(&mut self, joint: JointId) -> [f64; 2];

    /// Acceleration (m/s^2) of a point of a link after the last call of [accelerate](Side::accelerate).
    fn acceleration(&self, at: Place) -> Vec2;

    /// Angular velocity and acceleration of a link after the last call of [accelerate](Side::accelerate).
    fn link_rates(&self, link: LinkId) -> [f64; 2];

    /// Fills in the complete state after the last call of [accelerate](Side::accelerate). The links' angles include
    /// whole turns.
    /// The state includes reactions if they are requested.
    fn fill(&mut self, inputs: &Inputs, state: &mut State) -> Result<()>;
}
