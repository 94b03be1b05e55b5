//! A mechanism as a Rapier world, whatever its build and its precision.

use std::f64::consts::TAU;

use super::tree::Tree;
use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::engine::bodies::stand_in;
use linkage::math::{KeepNan, Vec2, cross, rotated};
use linkage::mechanism::{GROUND, Joint, JointKind, Link, LinkPose, Side};

/// What is known of a link's angle (rad, counter-clockwise positive).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinkAngle {
    /// The angle itself, turns kept: of a link of the tree, the sum of the coordinates that lead there.
    Whole(f64),
    /// Whole turns (rad), to be added to the angle of the link's direction between -pi and pi: a body of its own has a direction only, whose arc
    /// tangent is left to those who ask for it.
    Turns(f64),
}

/// Frame of a link as the engine has it after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkFrame {
    /// World position of the frame's origin (m).
    pub origin: Vec2,
    /// Unit vector of its x axis: (cos, sin) of its angle.
    pub direction: Vec2,
    /// Its angle.
    pub angle: LinkAngle,
}

impl LinkFrame {
    /// The ground's.
    pub const GROUND: LinkFrame =
        LinkFrame { origin: Vec2::new(0.0, 0.0), direction: Vec2::new(1.0, 0.0), angle: LinkAngle::Whole(0.0) };

    /// Chord of a turn (rad) below which the chord is taken for the turn: it is less by the square of the turn over 24.
    const SMALL: f64 = 0.1;

    /// Angle of the frame's x axis (rad), turns kept.
    #[must_use]
    pub fn angle(&self) -> f64 {
        match self.angle {
            LinkAngle::Whole(angle) => angle,
            LinkAngle::Turns(turns) => turns + own_angle(self.direction),
        }
    }

    /// World position of the body point `local` (m).
    #[inline]
    #[must_use]
    pub fn point(&self, local: Vec2) -> Vec2 {
        self.origin + rotated(self.direction, local)
    }

    /// By how much the link has turned since it was `before` (rad, without sign), to within 4 parts in ten thousand; where only turns are
    /// counted, at most half a turn.
    #[inline]
    #[must_use]
    pub fn turn_since(&self, before: &LinkFrame) -> f64 {
        if let (LinkAngle::Whole(angle), LinkAngle::Whole(before)) = (self.angle, before.angle) {
            return (angle - before).abs();
        }
        let chord = (self.direction - before.direction).norm();
        if chord < Self::SMALL {
            return chord;
        }
        cross(before.direction, self.direction).atan2(before.direction.dot(&self.direction)).abs()
    }

    /// Takes the place of a body of its own after a step, in which it has turned by less than half a turn.
    #[inline]
    pub(super) fn follow(&mut self, origin: Vec2, direction: Vec2) {
        if let LinkAngle::Turns(turns) = &mut self.angle
            && (self.direction.y < 0.0) != (direction.y < 0.0)
        {
            // Across the x axis; to the left of the origin the direction's own angle jumps there by a turn.
            let turn = cross(self.direction, direction);
            if turn > 0.0 && direction.y < 0.0 {
                *turns += TAU;
            } else if turn < 0.0 && self.direction.y < 0.0 {
                *turns -= TAU;
            }
        }
        (self.origin, self.direction) = (origin, direction);
    }

    /// Takes a place whose angle is `angle` (rad) but for rounding.
    pub(super) fn put(&mut self, origin: Vec2, direction: Vec2, angle: f64) {
        (self.origin, self.direction) = (origin, direction);
        self.angle = match self.angle {
            LinkAngle::Whole(_) => LinkAngle::Whole(angle),
            LinkAngle::Turns(_) => LinkAngle::Turns(TAU * ((angle - own_angle(direction)) / TAU).round()),
        };
    }
}

/// Angle of a direction (rad), from -pi to pi; exactly to the left it is pi, whatever the sign of its zero.
fn own_angle(direction: Vec2) -> f64 {
    (direction.y + 0.0).atan2(direction.x)
}

/// The Rapier world of a case: links in its tree as one multibody, the others as bodies of their own, joints that the tree cuts as impulse
/// joints, every drive as a motor of its own so that its impulse can be read. All numbers are f64, SI, world axes.
pub trait World {
    /// The spanning tree; without branches every link is a body of its own.
    fn tree(&self) -> &Tree;

    /// One time step of Rapier, after which frames can be read: it may fail to close loops, and may panic.
    fn step(&mut self);

    /// Rapier's own step and nothing else: frames stay what they were.
    fn bare_step(&mut self);

    /// Sets the time step (s).
    fn set_step(&mut self, step: f64);

    /// Sets the angular velocity (rad/s, counter-clockwise positive) that a drive, by its number in [`drives`](linkage::case::CaseParts::drives), gives its link.
    fn set_drive(&mut self, drive: usize, omega: f64);

    /// Leaves a drive to a motor: moment (N m) on its link of `damping` (N m s/rad, not negative) times what `target` (rad/s) is ahead of the speed at the END of
    /// the step.
    fn set_motor(&mut self, drive: usize, target: f64, damping: f64);

    /// Sets the loads on a link, which stay until they are set again.
    fn set_load(&mut self, link: usize, load: Wrench);

    /// Puts all links into poses; velocities stay as they are.
    fn place(&mut self, poses: &[LinkPose]);

    /// Frames of all links after the last step or placing, in the mechanism's order; the ground's first.
    fn frames(&self) -> &[LinkFrame];

    /// Angle of a link's frame (rad), turns kept.
    fn angle(&self, link: usize) -> f64 {
        self.frames()[link].angle()
    }

    /// World position of a point of a link (m).
    fn point(&self, side: Side) -> Vec2 {
        self.frames()[side.link].point(side.local)
    }

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
    masses[case.crank().link][1] += case.crank().moving_inertia();
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
    for drive in &case.drives {
        masses[drive.link][1] += FLYWHEEL * total * size * size;
    }
    masses
}

/// How far a joint is open (m) between links with the frames given; an angle between the axes of a prismatic joint counts at the mechanism's
/// size `size` (m).
#[inline]
pub(super) fn opening(frames: &[LinkFrame], joint: &Joint, size: f64) -> f64 {
    let sides = [joint.first, joint.second];
    let places = sides.map(|side| frames[side.link].point(side.local));
    match joint.kind {
        JointKind::Revolute => (places[1] - places[0]).norm(),
        JointKind::Prismatic { .. } => {
            let (distance, turn) = joint.opening(places, sides.map(|side| frames[side.link].direction));
            distance.larger(turn * size)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkage::math::unit;
    use proptest::prelude::*;

    proptest! {
        /// From anywhere, by steps of any size below half a turn either way.
        #[test]
        fn turns_are_counted(start in -20.0f64..20.0, steps in prop::collection::vec(-3.1f64..3.1, 1..40)) {
            let mut frame = LinkFrame { angle: LinkAngle::Turns(0.0), ..LinkFrame::GROUND };
            frame.put(Vec2::zeros(), unit(start), start);
            prop_assert!((frame.angle() - start).abs() <= 1e-14);
            let mut angle = start;
            for step in steps {
                let before = frame;
                angle += step;
                frame.follow(Vec2::zeros(), unit(angle));
                prop_assert!((frame.angle() - angle).abs() <= 1e-13, "{} {angle}", frame.angle());
                let turn = frame.turn_since(&before);
                prop_assert!((turn - step.abs()).abs() <= 4.2e-4 * step.abs() + 1e-13, "{turn} {step}");
            }
        }
    }

    /// Onto the axis from either side, with either zero, and off it again.
    #[test]
    fn turns_are_counted_on_the_axis() {
        let back = |y: f64| Vec2::new(-1.0, y);
        for zero in [0.0, -0.0] {
            for (from, to) in [(0.1, -0.1), (-0.1, 0.1), (0.1, 0.1), (-0.1, -0.1)] {
                let mut frame = LinkFrame { angle: LinkAngle::Turns(0.0), ..LinkFrame::GROUND };
                frame.put(Vec2::zeros(), back(from), own_angle(back(from)));
                let start = frame.angle();
                frame.follow(Vec2::zeros(), back(zero));
                assert!((frame.angle() - start).abs() < 0.11, "{from} to {zero}");
                frame.follow(Vec2::zeros(), back(to));
                assert!((frame.angle() - start).abs() < 0.21, "{from} over {zero} to {to}");
            }
        }
    }
}
