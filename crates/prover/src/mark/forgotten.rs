//! Accelerations of the whole mechanism, if the student forgot a normal or Coriolis part.
//!
//! The accelerations solve linear equations: one or two for each joint, and one for the drive.
//! The right-hand side consists of the centripetal parts of the links and the Coriolis parts of the slides.
//! The equations are derived from the constraint equations in E. J. Haug, Computer Aided Kinematics and Dynamics of
//! Mechanical Systems, vol. 1, Allyn and Bacon 1989, eq. 3.3.10 and 3.3.13.
//! Let point P2 of the second link slide on the line through P1 of the first link, with the axis e, the normal n and
//! the slide s. Then
//! n . (a2 - a1) - alpha1 s = 2 omega1 s' + n . (omega2^2 r2 - omega1^2 r1).
//! a1 and a2 are the accelerations of P1 and P2 without their centripetal parts.
//! r1 and r2 are the vectors from the origins of the link frames to P1 and P2.

use super::cause::MarkCause;
use super::hypothesis::Hypothesis;
use super::question::AskedColumn;
use super::sheet::AnswerSheet;
use linkage::input::Input;
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, Motion, Vec2, largest_size, rotated, turned};
use linkage::mechanism::{GROUND, JointId, JointSide, LinkId, PerLink};
use linkage::solver::State;
use linkage::trajectory::{OfLink, OfPoint, Reading, Stage};

/// The parts that are left out.
#[derive(Clone, Copy, PartialEq)]
enum LeftOut {
    Nothing,
    Normal(LinkId),
    Normals,
    Coriolis(JointId),
}

/// The hypotheses that a normal or Coriolis part was forgotten. The list is empty if the sheet asks for no
/// acceleration, if the mechanism has transmissions, or if the input is not an angle.
pub(super) fn all(sheet: &AnswerSheet) -> Vec<Hypothesis> {
    let (case, mechanism) = (&sheet.case, &sheet.case.mechanism);
    let asks = sheet.columns.iter().any(|column| column.stage() == Stage::Accelerations);
    if !asks || !mechanism.transmissions().is_empty() || case.crank().input != Input::Angle {
        return Vec::new();
    }
    let mut causes = Vec::new();
    let moving = || mechanism.links().entries().skip(1).filter(|(index, _)| case.can_turn(*index));
    causes.extend(moving().map(|(index, link)| (LeftOut::Normal(index), MarkCause::NoNormal(link.name.clone()), -1.8)));
    if moving().count() > 1 {
        causes.push((LeftOut::Normals, MarkCause::NoNormals, -1.8));
    }
    let slides = mechanism.joints().entries().filter(|(_, joint)| joint.slides() && joint.first.link != GROUND);
    causes.extend(
        slides.map(|(index, joint)| (LeftOut::Coriolis(index), MarkCause::NoCoriolis(joint.name.clone()), -1.2)),
    );
    let table = |left_out: LeftOut| -> Vec<Option<Vec<Vec<f64>>>> {
        let row = |(row, state): (usize, &State)| {
            let motions = accelerated(sheet, state, left_out)?;
            let columns = sheet.columns.iter().enumerate();
            Some(vec![
                columns.map(|(place, own)| value(sheet, own, &motions).unwrap_or(sheet.right[row][place])).collect(),
            ])
        };
        sheet.states.iter().enumerate().map(row).collect()
    };
    // The equations must give the right accelerations if nothing is left out.
    let is_right = |(row, found): (usize, Option<Vec<Vec<f64>>>)| {
        let Some(found) = found else { return false };
        let size = largest_size(&sheet.right[row]).larger(1e-6);
        found[0].iter().zip(&sheet.right[row]).all(|(one, other)| (one - other).abs() <= 1e-6 * size)
    };
    if !table(LeftOut::Nothing).into_iter().enumerate().all(is_right) {
        return Vec::new();
    }
    // A student may forget a part in one quantity only, so a single wrong quantity is enough evidence.
    let alone = |own: Hypothesis| Hypothesis { is_whole: false, ..own };
    let of = |(left_out, cause, prior)| alone(Hypothesis::of_table(cause, prior, table(left_out)));
    causes.into_iter().map(of).collect()
}

/// The motions of all links, with the accelerations that result without the part `left_out`; `None` in a singular pose.
fn accelerated(sheet: &AnswerSheet, state: &State, left_out: LeftOut) -> Option<PerLink<Motion>> {
    let (case, mechanism) = (&sheet.case, &sheet.case.mechanism);
    let count = 3 * (mechanism.links().len() - 1);
    let (mut system, mut right, mut row) = (Lu::new(count), vec![0.0; count], 0);
    let motions = &state.motions;
    let column = |link: LinkId| 3 * (link.index() - 1);
    // The normal acceleration -omega^2 r of a point, or zero if this part is left out.
    let normal = |side: JointSide| {
        let is_left_out = left_out == LeftOut::Normals || left_out == LeftOut::Normal(side.link);
        let own = &motions[side.link];
        if is_left_out { Vec2::zeros() } else { -own.arm(side.local) * own.omega.powi(2) }
    };
    for (index, joint) in mechanism.joints().entries() {
        let sides = [(joint.first, -1.0), (joint.second, 1.0)];
        let along = |axis: Vec2, row: usize, system: &mut Lu, right: &mut [f64]| {
            for (side, sign) in sides {
                right[row] -= sign * axis.dot(&normal(side));
                if side.link != GROUND {
                    let arm = motions[side.link].arm(side.local);
                    system.add(row, column(side.link), sign * axis.x);
                    system.add(row, column(side.link) + 1, sign * axis.y);
                    system.add(row, column(side.link) + 2, sign * axis.dot(&turned(arm)));
                }
            }
        };
        if row + joint.kind.equations() > count {
            return None;
        }
        match joint.kind.line() {
            None => {
                along(Vec2::x(), row, &mut system, &mut right);
                along(Vec2::y(), row + 1, &mut system, &mut right);
            }
            Some(axis) => {
                let first = &motions[joint.first.link];
                let axis = rotated(first.direction, axis);
                let [from, to] = [joint.first, joint.second].map(|side| motions[side.link].point(side.local));
                let [slow, fast] =
                    [joint.first, joint.second].map(|side| motions[side.link].point_velocity(side.local));
                let slide = axis.dot(&(to - from));
                along(turned(axis), row, &mut system, &mut right);
                if joint.first.link != GROUND {
                    system.add(row, column(joint.first.link) + 2, -slide);
                }
                // The block's velocity relative to the rotating guide.
                if left_out != LeftOut::Coriolis(index) {
                    let relative = fast - slow - turned(to - from) * first.omega;
                    right[row] += 2.0 * first.omega * axis.dot(&relative);
                }
                if joint.keeps_angle() {
                    for (side, sign) in sides.into_iter().filter(|(side, _)| side.link != GROUND) {
                        system.add(row + 1, column(side.link) + 2, sign);
                    }
                }
            }
        }
        row += joint.kind.equations();
    }
    if row + 1 != count {
        return None;
    }
    let crank = case.crank().link;
    system.add(row, column(crank) + 2, 1.0);
    right[row] = motions[crank].alpha;
    if !system.factor() {
        return None;
    }
    system.solve(&mut right);
    let mut found = motions.clone();
    for link in mechanism.links().ids().skip(1) {
        let at = column(link);
        found[link].acceleration = Vec2::new(right[at], right[at + 1]);
        found[link].alpha = right[at + 2];
        if left_out == LeftOut::Normals || left_out == LeftOut::Normal(link) {
            // With omega set to zero, the accelerations of the link's points also have no normal part.
            found[link].omega = 0.0;
        }
    }
    Some(found)
}

/// The value of a column for these motions; `None` for a quantity other than an acceleration.
fn value(sheet: &AnswerSheet, column: &AskedColumn, motions: &PerLink<Motion>) -> Option<f64> {
    let mechanism = &sheet.case.mechanism;
    let one = |channel: &linkage::trajectory::Channel| -> Option<f64> {
        let own = match channel.kind.reading {
            Reading::Link(OfLink::Alpha) => motions[mechanism.link_named(&channel.of)?].alpha,
            Reading::Point(of) => {
                let (_, side) = mechanism.moving_points().find(|(name, _)| *name == channel.of)?;
                let whole = motions[side.link].point_acceleration(side.local);
                match of {
                    OfPoint::AccelerationX => whole.x,
                    OfPoint::AccelerationY => whole.y,
                    OfPoint::X | OfPoint::Y | OfPoint::VelocityX | OfPoint::VelocityY => return None,
                }
            }
            Reading::Link(_) | Reading::Joint(_) | Reading::Slider(_) | Reading::Journal(_) | Reading::Guide(_) => {
                return None;
            }
            Reading::Transmission(_) | Reading::Frame(_) | Reading::Drive(_) | Reading::Motor(_) => return None,
            Reading::Thrust(_) | Reading::FurtherThrust(_) => return None,
        };
        Some(own / column.scale)
    };
    match &column.channels[..] {
        [x, y] => Some(one(x)?.hypot(one(y)?)),
        own => one(&own[0]),
    }
}
