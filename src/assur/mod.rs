//! Kinematics group by group: the driving link, then every Assur group in closed form, one file a kind.

mod rrr;

pub use rrr::Rrr;

use crate::error::{Error, ErrorKind, Result};
use crate::math::{Motion, Vec2, rotated, turned, unit};
use crate::mechanism::{AssemblyMode, GroupKind, Mechanism, Side, Structure};

/// Driving link that turns about a joint with the ground.
#[derive(Clone, Copy, Debug)]
struct Driver {
    link: usize,
    pivot: Vec2,
    base: Side,
}

/// A mechanism made ready for solving pose after pose without allocation.
#[derive(Clone, Debug)]
pub struct Plan {
    drivers: Vec<Driver>,
    dyads: Vec<Rrr>,
}

/// A dyad whose links do not reach each other at some crank angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfReach {
    /// Index of the group in [`Structure::groups`].
    pub group: usize,
    /// Distance of the outer joints (m).
    pub distance: f64,
    /// Shortest and longest distance that the group's links can span (m).
    pub span: [f64; 2],
}

impl Plan {
    /// Prepares a mechanism of the given structure in the given assembly modes (one a group).
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for groups that have no closed form here.
    pub fn of(mechanism: &Mechanism, structure: &Structure, modes: &[AssemblyMode]) -> Result<Self> {
        let drivers = structure.drivers.iter().map(|&(link, joint)| {
            let joint = &mechanism.joints()[joint];
            Driver { link, pivot: joint.on(link).expect("the driven joint is on its link"), base: joint.other(link) }
        });
        let dyads = structure.groups.iter().zip(modes).map(|(group, &mode)| match group.kind {
            GroupKind::Rrr => Ok(Rrr::of(mechanism, group, mode)),
            GroupKind::Higher => Err(Error::new(
                ErrorKind::Unsupported,
                format!("there is no closed form for the group ({})", group.names(mechanism)),
            )),
        });
        Ok(Plan { drivers: drivers.collect(), dyads: dyads.collect::<Result<_>>()? })
    }

    /// Positions of all links for the world angle of the driving link (rad).
    ///
    /// # Errors
    /// The first group that cannot be assembled.
    #[inline]
    pub fn positions(&self, angle: f64, motions: &mut [Motion]) -> std::result::Result<(), OutOfReach> {
        let direction = unit(angle);
        for driver in &self.drivers {
            let pivot = motions[driver.base.link].point(driver.base.local);
            let motion = &mut motions[driver.link];
            motion.direction = direction;
            motion.origin = pivot - rotated(direction, driver.pivot);
        }
        for (index, dyad) in self.dyads.iter().enumerate() {
            dyad.positions(motions).map_err(|(distance, span)| OutOfReach { group: index, distance, span })?;
        }
        Ok(())
    }

    /// Velocities of all links, once their positions are known; `omega` is the driving link's (rad/s).
    #[inline]
    pub fn velocities(&self, omega: f64, motions: &mut [Motion]) {
        for driver in &self.drivers {
            let motion = &mut motions[driver.link];
            motion.omega = omega;
            motion.velocity = turned(motion.arm(driver.pivot)) * -omega;
        }
        for dyad in &self.dyads {
            dyad.velocities(motions);
        }
    }

    /// Accelerations of all links, once their velocities are known; `alpha` is the driving link's (rad/s^2).
    #[inline]
    pub fn accelerations(&self, alpha: f64, motions: &mut [Motion]) {
        for driver in &self.drivers {
            let motion = &mut motions[driver.link];
            let arm = motion.arm(driver.pivot);
            motion.alpha = alpha;
            motion.acceleration = arm * (motion.omega * motion.omega) - turned(arm) * alpha;
        }
        for dyad in &self.dyads {
            dyad.accelerations(motions);
        }
    }
}
