//! Checks forces against the laws of momentum and energy.
//! All derivatives are taken by finite differences.

use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::math::{KeepNan, Vec2, cross};
use linkage::solver::State;
use proptest::test_runner::TestCaseError;

use super::{Around, COUNT};
use crate::common::random::{REACH, for_each, within};
use crate::common::{centre, centre_velocity};
use linkage::mechanism::LinkId;

/// Seven states around an instant, and the scales of the balances.
struct Instant<'a> {
    case: &'a Case,
    around: Around,
    /// Largest angular velocity of a link (rad/s).
    fastest: f64,
    /// Mass of all links (kg).
    mass: f64,
}

impl Instant<'_> {
    fn here(&self) -> &State {
        self.around.here()
    }

    fn masses(&self) -> impl Iterator<Item = (LinkId, &linkage::mechanism::Link)> {
        self.case.mechanism.links().entries().skip(1)
    }

    /// For every link, the resultant of the loads on this link, at the link's mass centre.
    fn loads(&self) -> Vec<Wrench> {
        let here = self.here();
        let mut loads = vec![Wrench::ZERO; here.motions.len()];
        self.case.loads_on(&here.motions, &here.angles, &mut loads);
        loads
    }

    /// Forces of the joints on `link`; link 0 is the ground.
    /// A joint acts on both of its links at the joint's point on the second link.
    fn on(&self, link: LinkId) -> Vec<Action> {
        let here = self.here();
        let joints = self.case.mechanism.joints().iter().zip(here.forces.iter().zip(&here.moments));
        let own = joints.filter(|(joint, _)| joint.on(link).is_some()).map(|(joint, (&force, moment))| {
            let sign = if joint.second.link == link { 1.0 } else { -1.0 };
            let place = here.motions[joint.second.link].point(joint.second.local);
            Action { place, force: force * sign, moment: moment * sign }
        });
        own.collect()
    }
}

/// A force with its point of application in the world, and a moment.
struct Action {
    place: Vec2,
    force: Vec2,
    moment: f64,
}

impl Action {
    fn about(&self, point: Vec2) -> f64 {
        cross(self.place - point, self.force) + self.moment
    }
}

/// Runs `check` at three instants of every sample with both solvers.
fn at_instants(check: impl Fn(&Instant) -> Result<(), TestCaseError>) {
    for_each(COUNT, |sample| {
        let case = &sample.scenario.case;
        for solver in analytic::all() {
            for k in [0, case.grid.len() / 2, case.grid.len() - 1] {
                let around = Around::of(solver, sample, case.grid.times[k]);
                let fastest = around.here().motions.iter().map(|m| m.omega.abs()).fold(0.0, f64::larger);
                let mass = case.mechanism.links().iter().map(|link| link.mass).sum();
                check(&Instant { case, around, fastest, mass })?;
            }
        }
        Ok(())
    });
}

#[test]
fn ground_reactions_and_gravity_change_the_momentum() {
    at_instants(|at| {
        let case = at.case;
        let momentum =
            |s: &State| -> Vec2 { at.masses().map(|(link, body)| centre_velocity(case, s, link) * body.mass).sum() };
        let weight: Vec2 = at.masses().map(|(_, body)| case.gravity * body.mass).sum();
        let ground: Vec2 = at.on(LinkId(0)).iter().map(|action| -action.force).sum();
        let loads: Vec2 = at.loads()[1..].iter().map(|load| load.force).sum();
        at.around.are_slopes("momentum", at.mass * REACH * at.fastest, momentum, weight + ground + loads)
    });
}

#[test]
fn ground_reactions_drive_loads_and_gravity_change_the_angular_momentum() {
    at_instants(|at| {
        let case = at.case;
        let momentum = |s: &State| -> f64 {
            let of = |(link, body): (LinkId, &linkage::mechanism::Link)| {
                body.mass * cross(centre(case, s, link), centre_velocity(case, s, link))
                    + body.inertia * s.motions[link].omega
            };
            at.masses().map(of).sum()
        };
        let loads = at.loads();
        let weight = at.masses().map(|(link, body)| {
            cross(centre(case, at.here(), link), case.gravity * body.mass + loads[link].force) + loads[link].moment
        });
        let ground = at.on(LinkId(0)).into_iter().map(|action| -action.about(Vec2::zeros()));
        let outer: f64 = weight.chain(ground).sum::<f64>() + at.here().torques[0];
        at.around.is_slope("angular momentum", at.mass * REACH * REACH * at.fastest, momentum, outer)
    });
}

#[test]
fn every_link_is_in_equilibrium() {
    at_instants(|at| {
        let (case, loads) = (at.case, at.loads());
        for (link, body) in at.masses() {
            let middle = centre(case, at.here(), link);
            let force: Vec2 = at.on(link).iter().map(|action| action.force).sum();
            let arms: f64 = at.on(link).iter().map(|action| action.about(middle)).sum();
            let drive = if link == case.crank().link { at.here().torques[0] } else { 0.0 };
            let scale = body.mass * REACH * at.fastest;
            let push = |s: &State| centre_velocity(case, s, link) * body.mass;
            at.around.are_slopes("force", scale, push, force + case.gravity * body.mass + loads[link].force)?;
            let spin = |s: &State| s.motions[link].omega * body.inertia;
            at.around.is_slope("moment", scale * REACH, spin, arms + drive + loads[link].moment)?;
        }
        Ok(())
    });
}

#[test]
fn drive_and_loads_change_the_energy() {
    at_instants(|at| {
        let case = at.case;
        let energy = |s: &State| -> f64 {
            let of = |(link, body): (LinkId, &linkage::mechanism::Link)| {
                let (v, spin) = (centre_velocity(case, s, link), s.motions[link].omega);
                0.5 * (body.mass * v.norm_squared() + body.inertia * spin * spin)
                    - body.mass * case.gravity.dot(&centre(case, s, link))
            };
            at.masses().map(of).sum()
        };
        let loads = case.load_power(&at.here().motions, &at.here().angles, at.here().reactions());
        let power = at.here().torques[0] * case.crank().at(0.0).rate + loads;
        at.around.is_slope("energy", at.mass * (REACH * at.fastest).powi(2), energy, power)
    });
}

#[test]
fn joints_hold_together_and_guides_push_across_their_axes_only() {
    at_instants(|at| {
        let here = at.here();
        let largest = here.forces.iter().map(|force| force.norm()).fold(0.0, f64::larger);
        for (joint, force) in at.case.mechanism.joints().iter().zip(&here.forces) {
            let sides = [joint.first, joint.second].map(|side| (&here.motions[side.link], side.local));
            let places = sides.map(|(motion, local)| motion.point(local));
            let (gap, turn) = joint.opening(places, sides.map(|(motion, _)| motion.direction));
            // The bound is the rounding error of coordinates up to REACH; this error grows from dyad to dyad.
            let rounding = 10.0 * f64::EPSILON * at.around.condition;
            within("gap", gap, REACH * rounding)?;
            within("turn of a guide", turn, rounding)?;
            if let Some(axis) = joint.axis_on(joint.first.link) {
                let along = sides[0].0.arm(axis).dot(force).abs();
                within("push along a guide", along, 10.0 * f64::EPSILON * largest)?;
            }
        }
        Ok(())
    });
}
