//! A mechanism as a Rapier world, whatever its build and its precision.

use super::tree::Tree;
use crate::case::Case;
use crate::drive::Wrench;
use crate::engine::bodies::stand_in;
use crate::math::Vec2;
use crate::mechanism::{GROUND, Joint, Link, LinkPose, Side};

/// The Rapier world of a case: links in its tree as one multibody, the others as bodies of their own, joints that the tree cuts as impulse
/// joints, every drive as a motor of its own so that its impulse can be read. All numbers are f64, SI, world axes.
pub trait World {
    /// The spanning tree; without branches every link is a body of its own.
    fn tree(&self) -> &Tree;

    /// One time step of Rapier, after which angles and points can be read: it may fail to close loops, and may panic.
    fn step(&mut self);

    /// Rapier's own step and nothing else; angles that count their turns are not followed.
    fn bare_step(&mut self);

    /// Sets the time step (s).
    fn set_step(&mut self, step: f64);

    /// Sets the angular velocity (rad/s, counter-clockwise positive) that a drive, by its number in [`Case::drives`], gives its link.
    fn set_drive(&mut self, drive: usize, omega: f64);

    /// Leaves a drive to a motor: moment (N m) on its link of `damping` (N m s/rad, not negative) times what `target` (rad/s) is ahead of the speed at the END of
    /// the step.
    fn set_motor(&mut self, drive: usize, target: f64, damping: f64);

    /// Sets the loads on a link, which stay until they are set again.
    fn set_load(&mut self, link: usize, load: Wrench);

    /// Puts all links into poses; velocities stay as they are.
    fn place(&mut self, poses: &[LinkPose]);

    /// Angle of a link's frame (rad), turns kept.
    fn angle(&self, link: usize) -> f64;

    /// World position of a point of a link (m).
    fn point(&self, side: Side) -> Vec2;

    /// Speed of the joint of branch `index` of the tree, as it stood at the START of the last step (Rapier reports velocities
    /// one step late): angular velocity of the child less that of its parent (rad/s), or of a prismatic joint, speed of the
    /// child along the parent's axis (m/s).
    fn relative_speed(&self, index: usize) -> f64;

    /// Velocity of the mass centre (m/s) and angular velocity (rad/s) of a link that is a body of its own, one step late likewise;
    /// `None` for links of the tree.
    fn velocity(&self, link: usize) -> Option<(Vec2, f64)>;

    /// Reaction in a joint that the tree cuts, from the impulses of the last step: force of the first link on the second (N) and
    /// moment about the place on the second (N m); `None` for joints of the tree, which report none. Only in a world built to be read.
    fn reaction(&self, joint: usize) -> Option<(Vec2, f64)>;

    /// Moment of a drive on its link (N m), from the motor's impulse in the last step.
    fn torque(&self, drive: usize) -> f64;
}

/// Moment of inertia that driving links have on top of their own, in units of all masses times the square of the mechanism's size. A
/// link whose speed is prescribed may have any moment of inertia: it enters neither motion nor reactions, and the drive's moment only where the
/// speed changes, from which it is taken off again ([`Ghost`](super::ghost::Ghost)). With a
/// heavy one, the drives' rows hardly feel those of the loops, and the sweeps converge: on a four-bar whose coupler is thirteen times as
/// heavy as its crank, 32 of them do what 1024 do without. Ten times as much brings no more.
const FLYWHEEL: f64 = 1.0;

/// Mass (kg) and moment of inertia (kg m^2) that every link is given in Rapier, which cannot move a body without them, flywheels left
/// out. Under a prescribed speed the motion does not depend on the masses; what they add to reactions that are read is taken off
/// again ([`Ghost`](super::ghost::Ghost)). In a free motion they are the links' own, and the crank carries rotor and reducer.
pub(super) fn masses(case: &Case) -> Vec<[f64; 2]> {
    let of = |(index, link): (usize, &Link)| {
        let [mass, inertia] = stand_in(case, index);
        [link.mass + mass, link.inertia + inertia]
    };
    let mut masses: Vec<[f64; 2]> = case.mechanism.links().iter().enumerate().map(of).collect();
    masses[GROUND] = [0.0; 2];
    masses[case.drive.link][1] += case.inertia_on_free_crank();
    masses
}

/// The same with flywheels on the driving links whose speed is prescribed.
pub(super) fn masses_with_flywheels(case: &Case) -> Vec<[f64; 2]> {
    let mut masses = masses(case);
    if case.is_free() {
        return masses;
    }
    let total: f64 = masses.iter().map(|[mass, _]| mass).sum();
    let size = case.mechanism.size();
    for drive in case.drives() {
        masses[drive.link][1] += FLYWHEEL * total * size * size;
    }
    masses
}

/// How far a joint is open (m); an angle between the axes of a prismatic joint counts at the mechanism's size `size` (m).
pub(super) fn opening(world: &dyn World, joint: &Joint, size: f64) -> f64 {
    let sides = [joint.first, joint.second];
    let places = sides.map(|side| world.point(side));
    if !joint.is_prismatic() {
        return (places[1] - places[0]).norm();
    }
    let (distance, turn) = joint.opening(places, sides.map(|side| crate::math::unit(world.angle(side.link))));
    distance.max(turn * size)
}
