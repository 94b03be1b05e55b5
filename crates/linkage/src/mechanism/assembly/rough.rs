//! First pose of a group from a rough drawing, for groups whose configurations are not all known.
//!
//! Each link is first placed by the approximate positions of its points, and by its joints with links already placed.
//! Then a Newton method with Levenberg-Marquardt damping closes all joints of the group at once:
//! (J^T J + lambda) dx = -J^T f. The vector f contains the gaps of all joints.
//! There are as many gaps as unknowns.

use super::dyads::turn;
use super::mode::{AssemblyMode, ConfigurationChoice};
use crate::error::{Error, ErrorKind, Result};
use crate::math::angle::wrapped;
use crate::math::dense::Lu;
use crate::math::{KeepNan, Vec2, cross, rotated, turned, unit};
use crate::mechanism::pose::SidePoint;
use crate::mechanism::{Group, Joint, LinkId, LinkPose, Mechanism, Pose};
use crate::sentences;

#[cfg(test)]
mod tests;

type Near = [(SidePoint, Vec2)];

/// A joint counts as closed if its gap is at most this fraction of the mechanism's size.
/// The limit is at the level of rounding errors.
const CLOSED: f64 = 1e-13;
/// Largest number of steps of the damped iteration.
/// If the drawing has errors of a tenth of a link's length, about ten steps are enough.
const STEPS: usize = 200;

/// Poses the links of the group near the approximate positions `near`.
pub(super) fn place(mechanism: &Mechanism, group: &Group, near: &Near, pose: &mut Pose) -> Result<ConfigurationChoice> {
    let mut drawn = pose.clone();
    lay_out(mechanism, group, near, &mut drawn)?;
    let system = System { mechanism, group, size: mechanism.size() };
    system.close(&mut drawn).ok_or_else(|| {
        Error::new(ErrorKind::Geometry, sentences::NO_CONFIGURATION_OF_THE_GROUP)
            .help(sentences::GIVE_PLACES_NEARER_TO_THE_CONFIGURATION)
    })?;
    let mut farthest: f64 = 0.0;
    for (point, guess) in near {
        let distance = (drawn.0[point.side.link].point(point.side.local) - guess).norm();
        let half = half_link(mechanism, group, &point.name);
        if !(distance <= half) {
            let message = sentences::the_configuration_found_from_the_rough(&point.name, &distance, &half);
            let error = Error::new(ErrorKind::Geometry, message);
            return Err(error.help(sentences::GIVE_PLACES_NEARER_TO_THE_CONFIGURATION));
        }
        farthest = farthest.larger(distance);
    }
    *pose = drawn;
    Ok(ConfigurationChoice { mode: AssemblyMode::Followed, nearest_m: Some(farthest), next_m: None })
}

/// Half the length of the shortest link of the group that carries the point. Links of zero length do not count.
/// If there is no such link, the result is half the mechanism's size.
fn half_link(mechanism: &Mechanism, group: &Group, point: &str) -> f64 {
    let links = group.links.iter().map(|&link| &mechanism.links()[link]);
    let carriers = links.filter(|link| link.points.iter().any(|own| own.name == point));
    let least = carriers.map(|link| link.size()).filter(|&size| size > 0.0).fold(f64::INFINITY, f64::smaller);
    0.5 * if least.is_finite() { least } else { mechanism.size() }
}

/// Gives every link of the group an approximate pose.
/// The pose follows from the approximate positions of the link's points, and from links that are already placed.
fn lay_out(mechanism: &Mechanism, group: &Group, near: &Near, pose: &mut Pose) -> Result<()> {
    let mut left = group.links.clone();
    while !left.is_empty() {
        let is_placed = |link: LinkId| !left.contains(&link);
        let laid = left.iter().enumerate().find_map(|(index, &link)| {
            let joints = group.inner.iter().chain(&group.outer).map(|&joint| &mechanism.joints()[joint]);
            let hooks = joints.filter(|joint| joint.on(link).is_some() && is_placed(joint.other(link).link));
            lay(mechanism, link, near, &hooks.collect::<Vec<_>>(), pose).map(|place| (index, place))
        });
        let Some((index, place)) = laid else {
            let name = &mechanism.links()[left[0]].name;
            return Err(Error::new(ErrorKind::Input, sentences::the_rough_places_do_not_tell(&name))
                .help(sentences::GIVE_NEAR_FOR_TWO_POINTS));
        };
        pose.0[left.remove(index)] = place;
    }
    Ok(())
}

/// The pose of a link, from the approximate positions of its points and its joints with links already placed.
/// `None` if this information is not enough.
fn lay(mechanism: &Mechanism, link: LinkId, near: &Near, hooks: &[&Joint], pose: &Pose) -> Option<LinkPose> {
    let own = |name: &str| mechanism.links()[link].points.iter().find(|point| point.name == name);
    let rough = near.iter().filter_map(|(point, place)| Some((own(&point.name)?.local, *place)));
    let pins = hooks.iter().filter(|joint| joint.is_pin()).map(|joint| {
        let other = joint.other(link);
        (joint.on(link).expect("the joint is on the link"), pose.0[other.link].point(other.local))
    });
    let places: Vec<(Vec2, Vec2)> = rough.chain(pins).collect();
    let count = places.len() as f64;
    let mean = |of: fn(&(Vec2, Vec2)) -> Vec2| places.iter().map(of).sum::<Vec2>() / count;
    let (local, world) = (mean(|place| place.0), mean(|place| place.1));
    let guided = hooks.iter().find_map(|joint| {
        let other = joint.other(link).link;
        let axis = rotated(unit(pose.0[other].angle), joint.axis_on(other)?);
        Some(turn(joint.axis_on(link)?, axis))
    });
    // The rotation that best fits the link to its approximate positions.
    // The local and world vectors of each point are taken as complex numbers. Their product is conj(local) world.
    // The argument of the sum of these products is the angle of the rotation.
    let fit: Vec2 = places
        .iter()
        .map(|place| (place.0 - local, place.1 - world))
        .map(|(own, at)| Vec2::new(own.dot(&at), cross(own, at)))
        .sum();
    let fitted = (fit.norm() > 0.0).then(|| fit.y.atan2(fit.x));
    (count > 0.0).then_some(())?;
    Some(LinkPose::through(local, world, guided.or(fitted)?))
}

/// The gaps of a group's joints as functions of the unknowns. The unknowns are x, y and size * angle of each link.
struct System<'a> {
    mechanism: &'a Mechanism,
    group: &'a Group,
    size: f64,
}

impl System<'_> {
    fn joints(&self) -> impl Iterator<Item = &Joint> {
        self.group.inner.iter().chain(&self.group.outer).map(|&joint| &self.mechanism.joints()[joint])
    }

    /// Gaps of all joints (m).
    fn gaps(&self, pose: &Pose) -> Vec<f64> {
        let gaps = self.joints().flat_map(|joint| {
            let [first, second] = [joint.first, joint.second].map(|side| pose.0[side.link].point(side.local));
            let gap = second - first;
            let Some(line) = joint.kind.line() else { return vec![gap.x, gap.y] };
            let e = rotated(unit(pose.0[joint.first.link].angle), line);
            let turn = self.second_axis(joint, pose).map(|f| self.size * cross(e, f));
            std::iter::once(cross(e, gap)).chain(turn).collect()
        });
        gaps.collect()
    }

    /// World direction of the axis on the second link, if the joint fixes the angle between its links.
    /// `None` for a joint that does not fix this angle.
    fn second_axis(&self, joint: &Joint, pose: &Pose) -> Option<Vec2> {
        Some(rotated(unit(pose.0[joint.second.link].angle), joint.kind.axes()?[1]))
    }

    /// Rows of the Jacobian, one per gap.
    fn jacobian(&self, pose: &Pose) -> Vec<Vec<f64>> {
        let mut rows = vec![vec![0.0; 3 * self.group.links.len()]; self.unknowns()];
        let mut next = 0;
        for joint in self.joints() {
            let row = next;
            next += joint.kind.equations();
            let sides = [joint.first, joint.second];
            let places = sides.map(|side| pose.0[side.link].point(side.local));
            for (k, sign) in [(0, -1.0), (1, 1.0)] {
                let Some(at) = self.group.links.iter().position(|&link| link == sides[k].link) else { continue };
                // The joint's point is displaced by (dx, dy) and by the rotation of the link about the link's origin.
                let arm = turned(places[k] - pose.0[sides[k].link].origin) / self.size;
                let moves = [Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0), arm];
                for (column, by) in moves.into_iter().enumerate() {
                    let column = 3 * at + column;
                    let Some(line) = joint.kind.line() else {
                        rows[row][column] = sign * by.x;
                        rows[row + 1][column] = sign * by.y;
                        continue;
                    };
                    let e = rotated(unit(pose.0[joint.first.link].angle), line);
                    rows[row][column] = sign * cross(e, by);
                    if column % 3 != 2 {
                        continue;
                    }
                    // The line rotates with the first link, so a rotation of the first link also changes the gap.
                    if k == 0 {
                        rows[row][column] -= e.dot(&(places[1] - places[0])) / self.size;
                    }
                    if let Some(f) = self.second_axis(joint, pose) {
                        rows[row + 1][column] = sign * e.dot(&f);
                    }
                }
            }
        }
        rows
    }

    fn unknowns(&self) -> usize {
        self.joints().map(|joint| joint.kind.equations()).sum()
    }

    fn moved(&self, pose: &Pose, step: &[f64]) -> Pose {
        let mut moved = pose.clone();
        for (&link, step) in self.group.links.iter().zip(step.chunks(3)) {
            let own = &mut moved.0[link];
            *own = LinkPose {
                origin: own.origin - Vec2::new(step[0], step[1]),
                angle: wrapped(own.angle - step[2] / self.size),
            };
        }
        moved
    }

    /// Closes all joints. Returns `None` if a joint stays open.
    fn close(&self, pose: &mut Pose) -> Option<()> {
        let square = |gaps: &[f64]| gaps.iter().map(|gap| gap * gap).sum::<f64>();
        let n = self.unknowns();
        let mut damping = 1e-3;
        let mut gaps = self.gaps(pose);
        for _ in 0..STEPS {
            let rows = self.jacobian(pose);
            let mut normal = Lu::new(n);
            let mut step = vec![0.0; n];
            for (row, gap) in rows.iter().zip(&gaps) {
                for i in 0..n {
                    step[i] += row[i] * gap;
                    (0..n).for_each(|j| normal.add(i, j, row[i] * row[j]));
                }
            }
            (0..n).for_each(|i| normal.add(i, i, damping));
            if !normal.factor() {
                return None;
            }
            normal.solve(&mut step);
            let next = self.moved(pose, &step);
            let next_gaps = self.gaps(&next);
            if square(&next_gaps) < square(&gaps) {
                (*pose, gaps) = (next, next_gaps);
                damping = (damping * 0.1).larger(1e-12);
            } else {
                damping *= 10.0;
            }
            if square(&gaps).sqrt() <= 1e-9 * self.size || damping > 1e9 {
                break;
            }
        }
        self.polish(pose)
    }

    /// Makes a few undamped Newton steps. These steps recover the digits that are lost in the normal equations.
    fn polish(&self, pose: &mut Pose) -> Option<()> {
        let n = self.unknowns();
        for _ in 0..4 {
            let mut jacobian = Lu::new(n);
            for (row, values) in self.jacobian(pose).iter().enumerate() {
                values.iter().enumerate().for_each(|(column, &value)| jacobian.add(row, column, value));
            }
            let mut step = self.gaps(pose);
            if !jacobian.factor() {
                return None;
            }
            jacobian.solve(&mut step);
            *pose = self.moved(pose, &step);
        }
        // By `Joint::opening`, a joint also counts as open if its two axes have opposite directions.
        let open = |joint: &Joint| {
            let sides = [joint.first, joint.second];
            let places = sides.map(|side| pose.0[side.link].point(side.local));
            let (distance, turn) = joint.opening(places, sides.map(|side| unit(pose.0[side.link].angle)));
            distance.larger(turn * self.size)
        };
        self.joints().all(|joint| open(joint) <= CLOSED * self.size).then_some(())
    }
}
