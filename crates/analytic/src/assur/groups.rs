//! Kinematics group by group: the driving link, then every Assur group, one file per kind.
//! Dyads are solved in closed form, higher groups by Newton's method on their contours.

mod bounds;
mod chain;
mod driver;
mod guide;
mod half;
mod misfit;
mod pin;
mod prp;
mod rpp;
mod rpr;
mod rrp;
mod rrr;
mod shaped;

pub(in crate::assur) use bounds::{Bound, Bounds, Limit};
#[cfg(feature = "batch")]
pub(in crate::assur) use chain::{Arrow, Hangs};
pub use chain::{Chain, ClosingJoint, Node};
pub(in crate::assur) use driver::Driver;
pub use misfit::{Misfit, SINGULAR, SingularityDistance};
pub use prp::Prp;
pub use rpp::Rpp;
pub use rpr::Rpr;
pub use rrp::Rrp;
pub use rrr::Rrr;
pub use shaped::Shaped;

use linkage::math::{KeepNan, Motion};
use linkage::mechanism::{AssemblyMode, GROUND, Group, GroupId, GroupKind, LinkId, Mechanism, PerGroup, Structure};
use linkage::work::{Count, WorkTally};

/// Two configurations of a dyad are compared with an expected pose.
/// The squared distance of the nearer configuration, divided by that of the farther one, must be below this value.
const NEARER: f64 = 0.04;

/// An Assur group, prepared for solving.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "groups are few, and each is read in every pose")]
pub enum Step {
    /// RRR dyad.
    Rrr(Rrr),
    /// RRP dyad.
    Rrp(Rrp),
    /// RPR dyad.
    Rpr(Rpr),
    /// RPP dyad.
    Rpp(Rpp),
    /// PRP dyad.
    Prp(Prp),
    /// RRR dyad whose bodies change their shape.
    Shaped(Box<Shaped>),
    /// Any other group.
    Chain(Chain),
}

impl Step {
    #[inline]
    fn positions(&mut self, angles: &[f64], motions: &mut [Motion]) -> std::result::Result<(), Misfit> {
        match self {
            Step::Rrr(dyad) => dyad.positions(motions),
            Step::Rrp(dyad) => dyad.positions(motions),
            Step::Rpr(dyad) => dyad.positions(motions),
            Step::Rpp(dyad) => dyad.positions(motions),
            Step::Prp(dyad) => dyad.positions(motions),
            Step::Shaped(dyad) => dyad.positions(angles, motions),
            Step::Chain(chain) => match chain.positions(angles, motions) {
                true => Ok(()),
                false => Err(Misfit::Lost),
            },
        }
    }

    #[inline]
    fn velocities(&mut self, rates: &[f64], motions: &mut [Motion]) {
        match self {
            Step::Rrr(dyad) => dyad.velocities(motions),
            Step::Rrp(dyad) => dyad.velocities(motions),
            Step::Rpr(dyad) => dyad.velocities(motions),
            Step::Rpp(dyad) => dyad.velocities(motions),
            Step::Prp(dyad) => dyad.velocities(motions),
            Step::Shaped(dyad) => dyad.velocities(rates, motions),
            Step::Chain(chain) => chain.velocities(rates, motions),
        }
    }

    #[inline]
    fn accelerations(&mut self, second: &[f64], motions: &mut [Motion]) {
        match self {
            Step::Rrr(dyad) => dyad.accelerations(motions),
            Step::Rrp(dyad) => dyad.accelerations(motions),
            Step::Rpr(dyad) => dyad.accelerations(motions),
            Step::Rpp(dyad) => dyad.accelerations(motions),
            Step::Prp(dyad) => dyad.accelerations(motions),
            Step::Shaped(dyad) => dyad.accelerations(second, motions),
            Step::Chain(chain) => chain.accelerations(second, motions),
        }
    }

    /// Whether the group has a [clearance](SolutionPlan::clearances).
    pub(crate) fn has_clearance(&self) -> bool {
        self.other().is_some()
    }

    /// Distance of the group from a singular pose: see [`SolutionPlan::clearances`].
    #[inline]
    pub(crate) fn clearance(&self, motions: &[Motion]) -> Option<SingularityDistance> {
        match self {
            Step::Rrr(dyad) => Some(dyad.clearance(motions)),
            Step::Rrp(dyad) => Some(dyad.clearance(motions)),
            Step::Rpr(dyad) => Some(dyad.clearance(motions)),
            Step::Shaped(dyad) => Some(dyad.clearance(motions)),
            Step::Rpp(_) | Step::Prp(_) | Step::Chain(_) => None,
        }
    }

    /// The field `sine` of the [clearance](SolutionPlan::clearances), computed from positions alone.
    #[inline]
    pub(crate) fn sine(&self, motions: &[Motion]) -> Option<f64> {
        match self {
            Step::Rrr(dyad) => Some(dyad.sine()),
            Step::Rrp(dyad) => Some(dyad.sine(motions)),
            Step::Rpr(dyad) => Some(dyad.sine(motions)),
            Step::Shaped(dyad) => Some(dyad.sine()),
            Step::Rpp(_) | Step::Prp(_) | Step::Chain(_) => None,
        }
    }

    /// Gauge at the last pose: see [`bounds`]. NaN if the group has no gauge.
    #[inline]
    pub(in crate::assur) fn gauge(&self) -> f64 {
        // Most groups are RRR dyads, so this kind is tested first.
        if let Step::Rrr(dyad) = self {
            return dyad.gauge();
        }
        match self {
            Step::Rrr(dyad) => dyad.gauge(),
            Step::Rrp(dyad) => dyad.gauge(),
            Step::Rpr(dyad) => dyad.gauge(),
            Step::Prp(dyad) => dyad.gauge(),
            Step::Rpp(_) | Step::Shaped(_) | Step::Chain(_) => f64::NAN,
        }
    }

    /// Limit of the gauge during a step of the crank that begins or ends at the pose `motions`.
    /// The limit is valid while the gauge is at most `farthest`.
    /// `None` if the group has no gauge, or if the bounds of the links that carry the group are not known.
    pub(in crate::assur) fn limit(
        &self,
        links: &Bounds,
        motions: &[Motion],
        farthest: f64,
        step: f64,
    ) -> Option<Limit> {
        match self {
            Step::Rrr(dyad) => dyad.limit(links, step),
            Step::Rrp(dyad) => dyad.limit(links, motions, step),
            Step::Rpr(dyad) => dyad.limit(links, farthest, step),
            Step::Prp(dyad) => dyad.limit(links),
            Step::Rpp(_) | Step::Shaped(_) | Step::Chain(_) => None,
        }
    }

    /// Writes the bounds of the group's links, if they exist. The bounds hold while the gauge stays within `band`.
    pub(in crate::assur) fn bound(&self, band: [f64; 2], step: f64, motions: &[Motion], links: &mut Bounds) {
        match self {
            Step::Rrr(dyad) => dyad.bound(band, links),
            Step::Rrp(dyad) => dyad.bound(band, step, motions, links),
            Step::Rpr(dyad) => dyad.bound(band, links),
            // For RPP and PRP dyads no bounds are written, because the travel of their sliders is unlimited.
            // For bodies of changing shape and for higher groups there are no bounds.
            Step::Prp(_) | Step::Rpp(_) | Step::Shaped(_) | Step::Chain(_) => {}
        }
    }

    /// If the group is a dyad with two configurations, returns the dyad switched to its other configuration, and the
    /// dyad's links.
    /// Returns `None` for groups that are not dyads with two configurations.
    fn other(&self) -> Option<(Step, [LinkId; 2])> {
        match self {
            Step::Rrr(dyad) => Some((Step::Rrr(dyad.flipped()), dyad.links())),
            Step::Rrp(dyad) => Some((Step::Rrp(dyad.flipped()), dyad.links())),
            Step::Rpr(dyad) => Some((Step::Rpr(dyad.flipped()), dyad.links())),
            Step::Shaped(dyad) => Some((Step::Shaped(Box::new(dyad.flipped())), dyad.links())),
            Step::Rpp(_) | Step::Prp(_) | Step::Chain(_) => None,
        }
    }
}

/// A mechanism prepared to solve many poses without allocation.
#[derive(Clone, Debug)]
pub struct SolutionPlan {
    drivers: Vec<Driver>,
    steps: PerGroup<Step>,
    tally: WorkTally,
}

/// A group that cannot be placed at a certain crank angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfReach {
    /// Index of the group in [`Structure::groups`].
    pub group: GroupId,
    /// The reason.
    pub why: Misfit,
}

impl SolutionPlan {
    /// Adds `way` (rad), a whole number of turns, to the driving angle of the last pose. The links stay where they are.
    pub(in crate::assur) fn skip(&mut self, way: f64) {
        for step in &mut self.steps {
            if let Step::Chain(chain) = step {
                chain.skip(way);
            }
        }
    }

    /// Prepares a mechanism of this structure in these assembly modes (one mode per group).
    #[must_use]
    pub fn of(mechanism: &Mechanism, structure: &Structure, modes: &[AssemblyMode]) -> Self {
        let drivers = structure.leading().map(|(index, driver)| Driver::of(mechanism, index, driver));
        let chain = |group: &Group| Step::Chain(Chain::of(mechanism, group, &structure.drivers));
        let steps = structure.groups.iter().zip(modes).map(|(group, &mode)| match group.kind {
            GroupKind::Rrr if !group.is_rigid() => {
                Step::Shaped(Box::new(Shaped::of(mechanism, group, mode, &structure.drivers)))
            }
            _ if !group.is_rigid() => chain(group),
            GroupKind::Rrr => Step::Rrr(Rrr::of(mechanism, group, mode)),
            GroupKind::Rrp => Step::Rrp(Rrp::of(mechanism, group, mode)),
            GroupKind::Rpr => Step::Rpr(Rpr::of(mechanism, group, mode)),
            GroupKind::Rpp => Step::Rpp(Rpp::of(mechanism, group)),
            GroupKind::Prp => Step::Prp(Prp::of(mechanism, group)),
            GroupKind::Higher | GroupKind::Driven => chain(group),
        });
        SolutionPlan { drivers: drivers.collect(), steps: steps.collect(), tally: WorkTally::default() }
    }

    /// Returns the groups, in the order of [`Structure::groups`].
    #[must_use]
    pub fn steps(&self) -> &PerGroup<Step> {
        &self.steps
    }

    /// Whether all groups are solved in closed form. If `false`, poses must be followed in small steps.
    #[must_use]
    pub fn is_closed_form(&self) -> bool {
        !self.steps.iter().any(|step| matches!(step, Step::Chain(_)))
    }

    /// Computes the positions of all links (m) for the driven coordinates `angles`, in the order of
    /// [`Structure::drivers`]: the world angle of a crank, a joint angle (rad) or a slide (m).
    /// Higher groups start from the last pose in `motions`.
    ///
    /// # Errors
    /// The error names the first group that cannot be placed.
    #[inline]
    pub fn positions(&mut self, angles: &[f64], motions: &mut [Motion]) -> std::result::Result<(), OutOfReach> {
        self.count_pose();
        self.turn_drivers(angles, motions);
        for (group, step) in self.steps.entries_mut() {
            step.positions(angles, motions).map_err(|why| OutOfReach { group, why })?;
        }
        Ok(())
    }

    /// Computes the positions, velocities and accelerations of all links in one pass.
    /// The arguments are the same as for the separate functions of positions, velocities and accelerations.
    ///
    /// # Errors
    /// The errors of [`SolutionPlan::positions`].
    // A separate function is faster: if this code is inlined into its caller, dyads take a fifth more time although
    // fewer instructions are executed.
    #[inline(never)]
    pub(crate) fn motions(
        &mut self,
        angles: &[f64],
        [omegas, alphas]: [&[f64]; 2],
        motions: &mut [Motion],
    ) -> std::result::Result<(), OutOfReach> {
        self.count_pose();
        self.tally.one(Count::Velocities);
        self.tally.one(Count::Accelerations);
        for driver in &self.drivers {
            let index = driver.index;
            driver.place_at([angles[index], omegas[index], alphas[index]], motions);
        }
        for (group, step) in self.steps.entries_mut() {
            // Most groups are RRR dyads, so this kind is tested first.
            if let Step::Rrr(dyad) = step {
                dyad.motions(motions).map_err(|why| OutOfReach { group, why })?;
            } else if let Step::Shaped(dyad) = step {
                dyad.motions([angles, omegas, alphas], motions).map_err(|why| OutOfReach { group, why })?;
            } else {
                step.positions(angles, motions).map_err(|why| OutOfReach { group, why })?;
                step.velocities(omegas, motions);
                step.accelerations(alphas, motions);
            }
        }
        Ok(())
    }

    /// Computes the positions of all links, with each dyad in the configuration nearest to the expected poses `like`.
    /// The plan keeps these configurations.
    ///
    /// # Errors
    /// [`Misfit::Singular`] if two configurations are about equally near to the expected pose, and the errors of
    /// [`SolutionPlan::positions`].
    pub(crate) fn positions_like(
        &mut self,
        like: &[Motion],
        angles: &[f64],
        motions: &mut [Motion],
    ) -> std::result::Result<(), OutOfReach> {
        self.count_pose();
        self.turn_drivers(angles, motions);
        for (group, step) in self.steps.entries_mut() {
            let misfit = |why| OutOfReach { group, why };
            if let Step::Chain(chain) = step {
                if !chain.positions_like(like, angles, motions) {
                    return Err(misfit(Misfit::Lost));
                }
                continue;
            }
            let Some((mut other, links)) = step.other() else {
                step.positions(angles, motions).map_err(misfit)?;
                continue;
            };
            let off = |motions: &[Motion]| {
                links.iter().map(|&link| (motions[link].direction - like[link].direction).norm_squared()).sum::<f64>()
            };
            other.positions(angles, motions).map_err(misfit)?;
            let beyond = off(motions);
            step.positions(angles, motions).map_err(misfit)?;
            let kept = off(motions);
            if !(kept.smaller(beyond) < NEARER * kept.larger(beyond)) {
                return Err(misfit(Misfit::Singular));
            }
            if beyond < kept {
                *step = other;
                step.positions(angles, motions).map_err(misfit)?;
            }
        }
        Ok(())
    }

    /// Computes the positions of the driving links and of `groups`. These groups must not depend on any other group.
    ///
    /// # Errors
    /// The errors of [`SolutionPlan::positions`].
    pub(in crate::assur) fn some_positions(
        &mut self,
        groups: impl Iterator<Item = GroupId>,
        angles: &[f64],
        motions: &mut [Motion],
    ) -> std::result::Result<(), OutOfReach> {
        self.tally.one(Count::Poses);
        self.turn_drivers(angles, motions);
        for group in groups {
            self.tally.one(Count::Groups);
            self.steps[group].positions(angles, motions).map_err(|why| OutOfReach { group, why })?;
        }
        Ok(())
    }

    /// Writes the bounds of the ground and of the driving links that are cranks. `ratios` contains the constant ratio
    /// of each crank's speed to the speed of the first crank.
    pub(in crate::assur) fn bound_drivers(&self, ratios: &[f64], links: &mut Bounds) {
        links.fill(None);
        links[GROUND] = Some(Bound::REST);
        for driver in self.drivers.iter().filter(|driver| driver.is_crank()) {
            // Without a constant speed ratio there are no bounds.
            let Some(turn) = ratios.get(driver.index).map(|ratio| ratio.abs()) else { continue };
            links[driver.link] =
                links[driver.base].map(|base| Bound::driven(driver.pivot, base.at(driver.place), turn));
        }
    }

    #[inline]
    fn count_pose(&mut self) {
        self.tally.one(Count::Poses);
        self.tally.many(Count::Groups, self.steps.len());
    }

    /// Determinant of a higher group at the last pose; `None` for a dyad.
    pub(crate) fn determinant(&self, group: GroupId) -> Option<f64> {
        match &self.steps[group] {
            Step::Chain(chain) => Some(chain.determinant()),
            Step::Rrr(_) | Step::Rrp(_) | Step::Rpr(_) | Step::Rpp(_) | Step::Prp(_) | Step::Shaped(_) => None,
        }
    }

    #[inline]
    pub(crate) fn turn_drivers(&self, angles: &[f64], motions: &mut [Motion]) {
        for driver in &self.drivers {
            driver.put_position(angles[driver.index], motions);
        }
    }

    /// Distance of every group from a singular pose at which two of its branches meet. Velocities must be known.
    /// `None` for RPP and PRP dyads, and for groups that are monitored by the sign of their determinant instead.
    pub fn clearances<'a>(&'a self, motions: &'a [Motion]) -> impl Iterator<Item = Option<SingularityDistance>> + 'a {
        self.steps.iter().map(|step| step.clearance(motions))
    }

    /// Computes the velocities of all links (m/s, rad/s) for the rates `omegas` of the driven coordinates (rad/s or
    /// m/s). Positions must be known.
    #[inline]
    pub fn velocities(&mut self, omegas: &[f64], motions: &mut [Motion]) {
        self.tally.one(Count::Velocities);
        self.drive_velocities(omegas, motions);
        self.steps.iter_mut().for_each(|step| step.velocities(omegas, motions));
    }

    /// Computes the velocities of the driving links alone.
    #[inline]
    pub(crate) fn drive_velocities(&self, omegas: &[f64], motions: &mut [Motion]) {
        for driver in &self.drivers {
            driver.put_velocity(omegas[driver.index], motions);
        }
    }

    /// Computes the accelerations of all links (m/s^2, rad/s^2) for the rates and accelerations of the driven
    /// coordinates (rad/s and rad/s^2, or m/s and m/s^2). Velocities must be known.
    #[inline]
    pub fn accelerations(&mut self, rates: [&[f64]; 2], motions: &mut [Motion]) {
        self.tally.one(Count::Accelerations);
        self.drive_accelerations(rates, motions);
        self.steps.iter_mut().for_each(|step| step.accelerations(rates[1], motions));
    }

    /// Computes the accelerations of the driving links alone; their velocities must be known.
    #[inline]
    pub(crate) fn drive_accelerations(&self, [omegas, alphas]: [&[f64]; 2], motions: &mut [Motion]) {
        for driver in &self.drivers {
            driver.put_acceleration([omegas[driver.index], alphas[driver.index]], motions);
        }
    }
}
