//! Checks whether the engine is still on the branch on which it began.
//!
//! Near a dead point, two assembly modes of a group are close together.
//! Near a dead point, the engine may slip from one mode to the other mode while its loops hardly open.
//! The two modes differ in the sign of the determinant of the group's constraints, so this sign is watched.

use crate::sentences;
use linkage::case::Case;
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, Motion, Vec2, cross, turned, unit};
use linkage::mechanism::{GROUND, GroupId, LinkPose};
use linkage::solver::State;

/// Threshold for determinants of the wrong sign, as a fraction of a group's largest determinant.
/// Above this threshold, the group is on another branch than its start branch. Below this threshold, the small opening
/// of the engine's loops at a dead point explains the wrong sign, and the group counts as being on its start branch.
const BEYOND: f64 = 0.02;

/// The supervised groups of a case. In a free motion, no group is supervised.
#[derive(Debug)]
pub(super) struct Branches {
    groups: Vec<Watched>,
}

/// One supervised group.
#[derive(Debug)]
struct Watched {
    /// Index of the group in the structure.
    index: GroupId,
    /// Constraints of the group's joints, in the coordinates of the group's links.
    /// The coordinates of a link are x, y (m), and its angle times the mechanism's size.
    constraints: Lu,
    /// Sign of the determinant on the start branch.
    sense: f64,
    /// Largest absolute value of the determinant so far.
    largest: f64,
    /// Times (s) and determinants of the last two states, the older state first.
    last: [Option<(f64, f64)>; 2],
}

impl Branches {
    /// The branches of the start pose.
    /// In a free motion no group is watched, because the motion may pass change points.
    pub(super) fn of(case: &Case) -> Self {
        if case.is_free() {
            return Branches { groups: Vec::new() };
        }
        let at_start = |pose: &LinkPose| Motion { origin: pose.origin, direction: unit(pose.angle), ..Motion::REST };
        let motions: Vec<Motion> = case.start.0.iter().map(at_start).collect();
        let of = |index: GroupId| {
            let constraints = Lu::new(3 * case.structure.groups[index].links.len());
            let mut own = Watched { index, constraints, sense: 0.0, largest: 0.0, last: [None; 2] };
            let determinant = own.determinant(case, &motions);
            (own.sense, own.largest) = (determinant.signum(), determinant.abs());
            own
        };
        Branches { groups: case.structure.groups.ids().map(of).collect() }
    }

    /// Checks that all groups of a state at `t` (s) are on their start branches. If the crank passes change points, the
    /// groups must instead have passed these points smoothly. Free motions are not checked.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] if a group has changed its branch.
    pub(super) fn check(&mut self, case: &Case, state: &State, t: f64) -> Result<()> {
        for own in &mut self.groups {
            let determinant = own.determinant(case, &state.motions);
            own.largest = own.largest.larger(determinant.abs());
            if case.crank().through {
                if own.turns_back(t, determinant) {
                    return Err(turned_back(case, own.index, t));
                }
                continue;
            }
            if own.sense * determinant < -BEYOND * own.largest {
                let names = case.structure.groups[own.index].names(&case.mechanism);
                let at = case.told(case.crank().at(t).value);
                let message = sentences::the_engine_has_slipped_into(&names, &t, &at);
                return Err(Error::new(ErrorKind::Numeric, message)
                    .at_time(t)
                    .at_input(at)
                    .of_group(names)
                    .help(Advice::SmallerStep { to: None })
                    .or_help(sentences::KEEP_THE_GRID_FARTHER_FROM_THE_DEAD));
            }
        }
        Ok(())
    }
}

/// The error for an engine that has changed to the other branch at a change point: the determinant of the group turned
/// back before it reached zero.
fn turned_back(case: &Case, group: GroupId, t: f64) -> Error {
    let names = case.structure.groups[group].names(&case.mechanism);
    let at = case.told(case.crank().at(t).value);
    let message = sentences::the_engine_has_not_gone_on_smoothly(&names, &t, &at);
    let error = Error::new(ErrorKind::Numeric, message).at_time(t).at_input(at).of_group(names);
    error.help(Advice::SmallerStep { to: None }).or_help(sentences::LET_THE_GRID_END_BEFORE_THE_CHANGE)
}

impl Watched {
    /// Whether the determinant has turned back before it reaches zero.
    /// At a change point that is passed smoothly, the determinant passes through zero.
    /// If the slope of the determinant reverses shortly before zero, the engine has changed branch.
    fn turns_back(&mut self, t: f64, determinant: f64) -> bool {
        let [older, newer] = self.last;
        self.last = [newer, Some((t, determinant))];
        let (Some((t0, d0)), Some((t1, d1))) = (older, newer) else { return false };
        let foreseen = d1 + (d1 - d0) * (t - t1) / (t1 - t0);
        let counts = foreseen.abs() > BEYOND * self.largest;
        counts && foreseen * d1 < 0.0 && determinant * d1 > 0.0 && determinant.abs() > 0.5 * foreseen.abs()
    }

    fn determinant(&mut self, case: &Case, motions: &[Motion]) -> f64 {
        let group = &case.structure.groups[self.index];
        let size = case.mechanism.size();
        let Watched { constraints, .. } = self;
        constraints.clear();
        let mut first = 0;
        for &joint in group.inner.iter().chain(&group.outer) {
            let joint = &case.mechanism.joints()[joint];
            let sides = [joint.first, joint.second];
            let [one, other] = sides.map(|side| motions[side.link]);
            // The derivative of a joint's position with respect to the angle of its link is the arm turned by 90 deg.
            let arms = sides.map(|side| turned(motions[side.link].arm(side.local)));
            let rows: [[[f64; 3]; 2]; 2] = match joint.kind.axes() {
                None => [0, 1].map(|end: usize| {
                    let sign = if end == 0 { -1.0 } else { 1.0 };
                    [[sign, 0.0, sign * arms[end].x / size], [0.0, sign, sign * arms[end].y / size]]
                }),
                Some(axes) => {
                    let axis: Vec2 = one.arm(axes[0]);
                    let (across, between) =
                        (turned(axis), other.point(joint.second.local) - one.point(joint.first.local));
                    let turns = [-across.dot(&arms[0]) - axis.dot(&between), across.dot(&arms[1])];
                    [0, 1].map(|end: usize| {
                        let sign = if end == 0 { -1.0 } else { 1.0 };
                        [[0.0, 0.0, sign], [sign * across.x, sign * across.y, turns[end] / size]]
                    })
                }
            };
            for (side, rows) in sides.iter().zip(rows) {
                let column = group.links.iter().position(|&link| link == side.link && link != GROUND);
                let Some(column) = column else { continue };
                for (row, entries) in rows.into_iter().enumerate() {
                    let entries = entries.into_iter().enumerate();
                    entries.for_each(|(c, value)| constraints.add(first + row, 3 * column + c, value));
                }
            }
            first += joint.kind.equations();
        }
        for drive in case.drives.iter().filter(|drive| group.given.contains(&drive.joint)) {
            let joint = &case.mechanism.joints()[drive.joint];
            for (side, sign) in [(joint.first, -1.0), (joint.second, 1.0)] {
                let Some(column) = group.links.iter().position(|&link| link == side.link) else { continue };
                let along = match joint.axis_on(joint.first.link) {
                    None => [0.0, 0.0, 1.0],
                    Some(axis) => {
                        let axis: Vec2 = motions[joint.first.link].arm(axis);
                        let arm = motions[joint.second.link].point(joint.second.local) - motions[side.link].origin;
                        [axis.x, axis.y, axis.dot(&turned(arm)) / size]
                    }
                };
                let entries = along.into_iter().enumerate();
                entries.for_each(|(c, value)| constraints.add(first, 3 * column + c, sign * value));
            }
            first += 1;
        }
        for transmission in group.trains.iter().map(|&id| &case.mechanism.transmissions()[id]) {
            for (link, force, place) in transmission.unit_actions(case.mechanism.joints(), motions) {
                let Some(column) = group.links.iter().position(|&own| own == link) else { continue };
                let turn = cross(place - motions[link].origin, force) / size;
                let entries = [force.x, force.y, turn].into_iter().enumerate();
                entries.for_each(|(c, value)| constraints.add(first, 3 * column + c, value));
            }
            first += 1;
        }
        if constraints.factor() { constraints.determinant() } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fixtures::{four_bar, turning};

    /// The rocker and coupler of a four-bar are mirrored about the line between their outer pins. All loops stay
    /// closed.
    #[test]
    fn the_mirrored_dyad_is_another_branch() {
        let case = turning(four_bar());
        let mut branches = Branches::of(&case);
        let mut state = State::at_rest(&case);
        for (motion, pose) in state.motions.iter_mut().zip(&case.start.0) {
            (motion.origin, motion.direction) = (pose.origin, unit(pose.angle));
        }
        branches.check(&case, &state, 0.0).unwrap();
        let group = &case.structure.groups[GroupId(0)];
        let joints = case.mechanism.joints();
        let places = [0, 1].map(|k: usize| {
            let joint = &joints[group.outer[k]];
            case.start.0[joint.first.link].point(joint.first.local)
        });
        let line = (places[1] - places[0]).normalize();
        let mirrored = |v: Vec2| 2.0 * line.dot(&v) * line - v;
        for &link in &group.links {
            // The fixture's links lie along their x axes, so mirroring origin and direction mirrors a link.
            let motion = &mut state.motions[link];
            motion.origin = places[0] + mirrored(motion.origin - places[0]);
            motion.direction = mirrored(motion.direction);
        }
        let error = branches.check(&case, &state, 0.25).unwrap_err();
        assert!(error.message().contains("another assembly mode of the group"), "{error}");
    }
}
