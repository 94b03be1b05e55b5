//! Kinematics group by group: the driving link, then every Assur group, one file a kind: dyads in closed form, higher groups
//! by Newton's method on their contours.

mod chain;
mod rrr;

pub use chain::{Chain, Closing, Node};
pub use rrr::Rrr;

use crate::math::{Motion, Vec2, rotated, turned, unit};
use crate::mechanism::{AssemblyMode, GroupKind, Mechanism, Side, Structure};

/// Driving link that turns about a joint with the ground.
#[derive(Clone, Copy, Debug)]
struct Driver {
    link: usize,
    pivot: Vec2,
    base: Side,
}

/// An Assur group, ready for solving.
#[derive(Clone, Debug)]
pub enum Step {
    /// RRR dyad.
    Rrr(Rrr),
    /// Group of more than two links.
    Chain(Chain),
}

/// A mechanism made ready for solving pose after pose without allocation.
#[derive(Clone, Debug)]
pub struct Plan {
    drivers: Vec<Driver>,
    steps: Vec<Step>,
    /// World angle of the driving link at the last pose (rad).
    angle: f64,
}

/// A group that cannot be placed at some crank angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfReach {
    /// Index of the group in [`Structure::groups`].
    pub group: usize,
    /// Distance of a dyad's outer joints, and the shortest and longest distance that its links can span (m); `None` for
    /// a higher group, whose branch could not be followed.
    pub span: Option<(f64, [f64; 2])>,
}

impl Plan {
    /// Prepares a mechanism of the given structure in the given assembly modes (one a group).
    #[must_use]
    pub fn of(mechanism: &Mechanism, structure: &Structure, modes: &[AssemblyMode]) -> Self {
        let drivers = structure.drivers.iter().map(|&(link, joint)| {
            let joint = &mechanism.joints()[joint];
            Driver { link, pivot: joint.on(link).expect("the driven joint is on its link"), base: joint.other(link) }
        });
        let steps = structure.groups.iter().zip(modes).map(|(group, &mode)| match group.kind {
            GroupKind::Rrr => Step::Rrr(Rrr::of(mechanism, group, mode)),
            _ => Step::Chain(Chain::of(mechanism, group)),
        });
        Plan { drivers: drivers.collect(), steps: steps.collect(), angle: f64::NAN }
    }

    /// The groups, in the order of [`Structure::groups`].
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Whether all groups are placed in closed form; if not, poses must be followed in small steps.
    #[must_use]
    pub fn is_closed_form(&self) -> bool {
        self.steps.iter().all(|step| matches!(step, Step::Rrr(_)))
    }

    /// Positions of all links for the world angle of the driving link (rad). Higher groups start from the last pose in `motions`.
    ///
    /// # Errors
    /// The first group that cannot be placed.
    #[inline]
    pub fn positions(&mut self, angle: f64, motions: &mut [Motion]) -> std::result::Result<(), OutOfReach> {
        let direction = unit(angle);
        for driver in &self.drivers {
            let pivot = motions[driver.base.link].point(driver.base.local);
            let motion = &mut motions[driver.link];
            motion.direction = direction;
            motion.origin = pivot - rotated(direction, driver.pivot);
        }
        for (group, step) in self.steps.iter_mut().enumerate() {
            match step {
                Step::Rrr(dyad) => dyad.positions(motions).map_err(|span| OutOfReach { group, span: Some(span) })?,
                Step::Chain(chain) => {
                    if !chain.positions(angle - self.angle, motions) {
                        return Err(OutOfReach { group, span: None });
                    }
                }
            }
        }
        self.angle = angle;
        Ok(())
    }

    /// Velocities of all links, once their positions are known; `omega` is the driving link's (rad/s).
    #[inline]
    pub fn velocities(&mut self, omega: f64, motions: &mut [Motion]) {
        for driver in &self.drivers {
            let motion = &mut motions[driver.link];
            motion.omega = omega;
            motion.velocity = turned(motion.arm(driver.pivot)) * -omega;
        }
        for step in &mut self.steps {
            match step {
                Step::Rrr(dyad) => dyad.velocities(motions),
                Step::Chain(chain) => chain.velocities(motions),
            }
        }
    }

    /// Accelerations of all links, once their velocities are known; `alpha` is the driving link's (rad/s^2).
    #[inline]
    pub fn accelerations(&mut self, alpha: f64, motions: &mut [Motion]) {
        for driver in &self.drivers {
            let motion = &mut motions[driver.link];
            let arm = motion.arm(driver.pivot);
            motion.alpha = alpha;
            motion.acceleration = arm * (motion.omega * motion.omega) - turned(arm) * alpha;
        }
        for step in &mut self.steps {
            match step {
                Step::Rrr(dyad) => dyad.accelerations(motions),
                Step::Chain(chain) => chain.accelerations(motions),
            }
        }
    }
}
