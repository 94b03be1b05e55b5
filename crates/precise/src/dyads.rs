//! Dyads of three revolute pairs in closed form, one dyad after the other. Forces are computed in reverse order.
//!
//! The inner joint is an intersection of two circles. In every pose, the inner joint lies on the same side of the line
//! through the outer joints as in the start pose.
//! The angular velocities follow from the relative velocity of the outer joints, projected on the two links.
//! Equations of moments about the inner joint and about the first outer joint give the forces.

use crate::sentences;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::{Group, GroupKind, JointId, JointSide, LinkId};
use linkage::trajectory::Trajectory;

use super::Long;
use super::equations::Whole;
use super::frame::{Frame, Snapshot};
use super::numbers::CaseNumbers;
use super::readings::trajectory;
use super::scalar::angle_of;
use super::task::{Task, at_start, stuck};
use super::vector::Vector as AnyVector;

type Vector = AnyVector<Long>;

/// A dyad: its two links, the outer joint of each link, and the inner joint.
struct Dyad {
    links: [LinkId; 2],
    outer: [JointId; 2],
    inner: JointId,
    /// Positions of the outer joints in the frames of the links to which the dyad is attached. These links belong to
    /// earlier groups, or are the ground or the crank.
    bases: [JointSide; 2],
    /// For each link of the dyad: positions of the outer and the inner joint.
    locals: [[linkage::math::Vec2; 2]; 2],
    /// Whether the inner joint is to the left of the line from the first outer joint to the second.
    is_left: bool,
}

/// Does the same as [`solve`](super::solve), but only for mechanisms of dyads with three revolute pairs.
///
/// # Errors
/// The errors of [`solve`](super::solve). [`ErrorKind::Unsupported`] if the mechanism has a group of another kind,
/// loads, or a drive other than one crank at constant speed.
pub fn solve(case: &Case) -> Result<Trajectory> {
    let task = Task::of(case)?;
    let numbers = CaseNumbers::of(case)?;
    let start = at_start(case);
    let dyads: Vec<Dyad> =
        case.structure.groups.iter().map(|group| dyad(case, &start, group)).collect::<Result<_>>()?;
    let mut instants = Vec::with_capacity(case.grid.len());
    for (row, &time) in case.grid.times.iter().enumerate() {
        let mut instant = Snapshot::at_rest(case);
        instant.crank = task.angle(time);
        instant.frames[task.link] = task.crank(case, instant.crank);
        for dyad in &dyads {
            dyad.place(&mut instant.frames).ok_or_else(|| stuck(case, row, sentences::A_DYAD_CANNOT_BE_ASSEMBLED))?;
        }
        let angle = |frame: &Frame<Long>| angle_of([frame.direction.x, frame.direction.y], 0.0);
        instant.angles = instant.frames.iter().map(angle).collect();
        forces(case, &numbers, &task, &dyads, &mut instant);
        instants.push(instant);
    }
    trajectory(&Whole::new(case, &numbers), &instants)
}

fn dyad(case: &Case, start: &[Frame<Long>], group: &Group) -> Result<Dyad> {
    let (GroupKind::Rrr, [one, two], &[inner]) = (group.kind, group.links.as_slice(), group.inner.as_slice()) else {
        let message = sentences::NO_CLOSED_FORM_IN_FULL_PRECISION;
        return Err(Error::new(ErrorKind::Unsupported, message).of_group(group.names(&case.mechanism)));
    };
    let links = [*one, *two];
    let joints = case.mechanism.joints();
    let outer = links.map(|link| group.outer_on(&case.mechanism, link).expect("each link of a dyad has one"));
    let bases = [0, 1].map(|k| joints[outer[k]].other(links[k]));
    let local = |joint: JointId, link: LinkId| joints[joint].on(link).expect("the joint is on the link");
    let locals = [0, 1].map(|k| [local(outer[k], links[k]), local(inner, links[k])]);
    let [a, b] = bases.map(|side| start[side.link].point(Vector::of(side.local)));
    let c = start[links[0]].point(Vector::of(locals[0][1]));
    Ok(Dyad { links, outer, inner, bases, locals, is_left: (b - a).cross(c - a) > Long::ZERO })
}

impl Dyad {
    /// Places both links; `None` if the circles do not intersect.
    fn place(&self, frames: &mut [Frame<Long>]) -> Option<()> {
        let [a, b] = self.bases.map(|side| frames[side.link].point(Vector::of(side.local)));
        let rods = self.locals.map(|[outer, inner]| Vector::of(inner) - Vector::of(outer));
        let (base, half) = (b - a, Long::of(0.5));
        let square = base.dot(base);
        // `along` and `across` give the inner joint's position along the base and perpendicular to it, as fractions of
        // the base's length. The first value called `across` is the square.
        let along = (square + rods[0].dot(rods[0]) - rods[1].dot(rods[1])) * half / square;
        let across = rods[0].dot(rods[0]) / square - along * along;
        if !(across > Long::ZERO) {
            return None;
        }
        let across = if self.is_left { across.sqrt() } else { -across.sqrt() };
        let inner = a + base * along + base.turned() * across;
        let arms = [inner - a, inner - b];
        let velocities = self.bases.map(|side| frames[side.link].point_velocity(Vector::of(side.local)));
        let width = arms[0].cross(arms[1]);
        let projected = |gap: Vector| [1, 0].map(|k: usize| gap.dot(arms[k]) / width);
        let omegas = projected(velocities[1] - velocities[0]);
        let carried = [0, 1].map(|k| {
            let side = self.bases[k];
            frames[side.link].point_acceleration(Vector::of(side.local)) - arms[k] * (omegas[k] * omegas[k])
        });
        let alphas = projected(carried[1] - carried[0]);
        for k in 0..2 {
            // The angle of the frame is the angle of the rod in the world minus the angle of the rod in the link's
            // frame.
            let direction = arms[k].rotated_back(rods[k]);
            let direction = direction * (Long::ONE / direction.norm());
            let to_origin = -Vector::of(self.locals[k][0]).rotated(direction);
            let accelerated = frames[self.bases[k].link].point_acceleration(Vector::of(self.bases[k].local));
            frames[self.links[k]] = Frame {
                origin: [a, b][k] + to_origin,
                direction,
                omega: omegas[k],
                alpha: alphas[k],
                velocity: velocities[k] + to_origin.turned() * omegas[k],
                acceleration: accelerated + to_origin.turned() * alphas[k] - to_origin * (omegas[k] * omegas[k]),
            };
        }
        Some(())
    }
}

/// Reactions and torque from the equilibrium of every dyad, starting with the last dyad.
fn forces(case: &Case, numbers: &CaseNumbers<Long>, task: &Task, dyads: &[Dyad], instant: &mut Snapshot<Long>) {
    // The force on every link from weight, inertia and later groups, and its moment about the world's origin.
    let mut acting: Vec<(Vector, Long)> =
        case.mechanism.links().ids().map(|link| instant.inertia(numbers, link)).collect();
    let joints = case.mechanism.joints();
    // Converts the force that a joint exerts on a link to the force that the joint's first link exerts on its second
    // link.
    let told =
        |joint: JointId, link: LinkId, force: Vector| if joints[joint].second.link == link { force } else { -force };
    for dyad in dyads.iter().rev() {
        let [a, b] = dyad.bases.map(|side| instant.frames[side.link].point(Vector::of(side.local)));
        let c = instant.frames[dyad.links[0]].point(Vector::of(dyad.locals[0][1]));
        let [one, two] = dyad.links.map(|link| acting[link]);
        let about = |place: Vector, (force, moment): (Vector, Long)| moment - place.cross(force);
        // The force in the second outer joint follows from two moment equations. The first equation takes moments of
        // both links about the first outer joint. The second equation takes moments of the second link about the inner
        // joint.
        let (whole, part) = (-(about(a, one) + about(a, two)), -about(c, two));
        let (p, q) = (b - a, b - c);
        let second = (q * whole - p * part) * (Long::ONE / p.cross(q));
        let first = -(one.0 + two.0 + second);
        let inner = -(one.0 + first);
        for (k, force) in [first, second].into_iter().enumerate() {
            instant.forces[dyad.outer[k]] = told(dyad.outer[k], dyad.links[k], force);
            let base = &mut acting[dyad.bases[k].link];
            *base = (base.0 - force, base.1 - [a, b][k].cross(force));
        }
        instant.forces[dyad.inner] = told(dyad.inner, dyad.links[0], inner);
    }
    let (force, moment) = acting[task.link];
    let place = instant.frames[task.link].point(Vector::of(joints[task.joint].on(task.link).unwrap_or_default()));
    instant.forces[task.joint] = told(task.joint, task.link, -force);
    instant.efforts[0] = place.cross(force) - moment;
}
