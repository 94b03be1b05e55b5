//! Joint reactions group by group, last group first, and the balancing moment from the driving link's equilibrium.
//!
//! D'Alembert: every link carries m (g - a) at its mass centre, the moment -J alpha, its loads, and the forces of the
//! groups that hang on it. For an RRR dyad with outer joints A, B and inner joint C, the moments of each link about C
//! and the forces of both give (u x R = -M_a, w x R = M_b - w x F with u = A - C, w = B - C) the reaction at A;
//! Artobolevsky, "Theory of mechanisms and machines", kinetostatics of class II groups.

use crate::case::Case;
use crate::math::{Motion, Vec2, cross};
use crate::mechanism::Group;

/// A force that acts on a link at one of its joints: `sign` times the joint's force.
#[derive(Clone, Copy, Debug)]
struct Action {
    joint: usize,
    local: Vec2,
    sign: f64,
}

impl Action {
    fn of(case: &Case, joint: usize, link: usize) -> Self {
        let found = &case.mechanism.joints()[joint];
        let local = found.on(link).expect("the joint is on the link");
        Action { joint, local, sign: if found.second.link == link { 1.0 } else { -1.0 } }
    }
}

/// A link with the joints at which later groups hang on it.
#[derive(Clone, Debug)]
struct Body {
    link: usize,
    hanging: Vec<Action>,
}

impl Body {
    fn of(case: &Case, link: usize, settled: &[bool]) -> Self {
        let joints = case.mechanism.joints().iter().enumerate();
        let on_link = joints.filter(|(index, joint)| settled[*index] && joint.on(link).is_some());
        Body { link, hanging: on_link.map(|(index, _)| Action::of(case, index, link)).collect() }
    }

    /// Resultant of all known forces on the link and their moment about the world point `pole`.
    #[inline]
    fn resultant(&self, case: &Case, motions: &[Motion], forces: &[Vec2], pole: Vec2) -> (Vec2, f64) {
        let body = &case.mechanism.links()[self.link];
        let motion = &motions[self.link];
        let mut force = (case.gravity - motion.point_acceleration(body.mass_centre)) * body.mass;
        let mut moment = cross(motion.point(body.mass_centre) - pole, force) - body.inertia * motion.alpha
            + case.load_moment(self.link, motion.omega);
        for action in &self.hanging {
            let hung = forces[action.joint] * action.sign;
            force += hung;
            moment += cross(motion.point(action.local) - pole, hung);
        }
        (force, moment)
    }
}

/// A dyad, seen from its forces.
#[derive(Clone, Debug)]
struct Dyad {
    bodies: [Body; 2],
    outer: [Action; 2],
    inner: [Action; 2],
}

impl Dyad {
    fn of(case: &Case, group: &Group, settled: &[bool]) -> Self {
        let both = |joint: [usize; 2]| [0, 1].map(|k| Action::of(case, joint[k], group.links[k]));
        Dyad {
            bodies: [0, 1].map(|k| Body::of(case, group.links[k], settled)),
            outer: both([group.outer[0], group.outer[1]]),
            inner: both([group.inner[0], group.inner[0]]),
        }
    }

    #[inline]
    fn solve(&self, case: &Case, motions: &[Motion], forces: &mut [Vec2]) {
        let [a, b] = &self.bodies;
        let [outer_a, outer_b] = self.outer;
        let pole = motions[a.link].point(self.inner[0].local);
        let u = motions[a.link].point(outer_a.local) - pole;
        let w = motions[b.link].point(outer_b.local) - pole;
        let (force_a, moment_a) = a.resultant(case, motions, forces, pole);
        let (force_b, moment_b) = b.resultant(case, motions, forces, pole);
        let total = force_a + force_b;
        let reaction_a = (w * -moment_a - u * (moment_b - cross(w, total))) / cross(u, w);
        let reaction_b = -(reaction_a + total);
        forces[outer_a.joint] = reaction_a * outer_a.sign;
        forces[outer_b.joint] = reaction_b * outer_b.sign;
        forces[self.inner[0].joint] = (reaction_a + force_a) * -self.inner[0].sign;
    }
}

/// The force analysis of a case, ready for pose after pose without allocation.
#[derive(Clone, Debug)]
pub(super) struct Kinetostatics {
    dyads: Vec<Dyad>,
    driver: Body,
    pivot: Action,
}

impl Kinetostatics {
    /// Prepares the groups in reverse order, then the driving link.
    pub(super) fn of(case: &Case) -> Self {
        let mut settled = vec![false; case.mechanism.joints().len()];
        let mut dyads = Vec::with_capacity(case.structure.groups.len());
        for group in case.structure.groups.iter().rev() {
            dyads.push(Dyad::of(case, group, &settled));
            group.inner.iter().chain(&group.outer).for_each(|&joint| settled[joint] = true);
        }
        let driver = Body::of(case, case.drive.link, &settled);
        Kinetostatics { dyads, driver, pivot: Action::of(case, case.drive.joint, case.drive.link) }
    }

    /// Fills in the force of the first link on the second in every joint (N) and returns the balancing moment on the
    /// driving link (N m), from its equilibrium about the pivot.
    pub(super) fn solve(&self, case: &Case, motions: &[Motion], forces: &mut [Vec2]) -> f64 {
        for dyad in &self.dyads {
            dyad.solve(case, motions, forces);
        }
        let pole = motions[self.driver.link].point(self.pivot.local);
        let (force, moment) = self.driver.resultant(case, motions, forces, pole);
        forces[self.pivot.joint] = -force * self.pivot.sign;
        -moment
    }
}
