//! Mistakes in the velocity or acceleration of a point, and in an angular velocity computed from a point's velocity.

use super::cause::{MarkCause, PartOfPoint};
use super::hypothesis::{Hypothesis, Origin};
use super::question::AskedColumn;
use super::sheet::AnswerSheet;
use linkage::math::{Vec2, turned};
use linkage::mechanism::{GROUND, LinkId};
use linkage::trajectory::{ChannelSubject, Stage};

/// The hypotheses of these mistakes, for all pairs of points of all links.
pub(super) fn all(sheet: &AnswerSheet) -> Vec<Hypothesis> {
    let mut found = Vec::new();
    for (index, link) in sheet.case.mechanism.links().entries().filter(|(index, _)| *index != GROUND) {
        for point in &link.points {
            for other in link.points.iter().filter(|other| (other.local - point.local).norm() > 0.0) {
                let ends = Ends { sheet, link: index, at: point.local, from: other.local };
                for part in [PartOfPoint::Carried, PartOfPoint::Normal, PartOfPoint::Tangential] {
                    found.extend(ends.without(part, &point.name, &other.name));
                }
                found.extend(ends.whole_speed(&link.name, &point.name));
            }
        }
    }
    found
}

/// Two points of a link: P at `at`, and Q at `from` (m, in the frame of the link).
struct Ends<'a> {
    sheet: &'a AnswerSheet,
    link: LinkId,
    at: Vec2,
    from: Vec2,
}

impl Ends<'_> {
    /// The velocity or acceleration of P without one of its terms.
    fn without(&self, part: PartOfPoint, point: &str, other: &str) -> Option<Hypothesis> {
        let stages: &[Stage] = match part {
            PartOfPoint::Carried => &[Stage::Velocities, Stage::Accelerations],
            PartOfPoint::Normal | PartOfPoint::Tangential => &[Stage::Accelerations],
        };
        let is_meant = |own: &AskedColumn| {
            own.channels[0].kind.subject == ChannelSubject::Point && own.of() == point && stages.contains(&own.stage())
        };
        if !self.sheet.columns.iter().any(is_meant) {
            return None;
        }
        let cause = MarkCause::WithoutPart(part, point.into(), other.into());
        Some(Hypothesis::by_rule(self.sheet, Origin::Mistake(cause), -2.2, |at, _| {
            let column = &self.sheet.columns[at.column];
            let motion = &self.sheet.states[at.row].motions[self.link];
            let arm = motion.arm(self.at - self.from);
            let whole = match column.stage() {
                Stage::Velocities => motion.point_velocity(self.at),
                Stage::Positions | Stage::Accelerations | Stage::Reactions | Stage::BalancingMoment => {
                    motion.point_acceleration(self.at)
                }
            };
            let missing = match (part, column.stage()) {
                (PartOfPoint::Normal, _) => -arm * motion.omega.powi(2),
                (PartOfPoint::Tangential, _) => turned(arm) * motion.alpha,
                (PartOfPoint::Carried, Stage::Velocities) => motion.point_velocity(self.from),
                (PartOfPoint::Carried, _) => motion.point_acceleration(self.from),
            };
            is_meant(column).then(|| component(column, whole - missing))
        }))
    }

    /// The angular velocity of the link, computed as the whole velocity of P divided by the distance PQ.
    fn whole_speed(&self, link: &str, point: &str) -> Option<Hypothesis> {
        let is_meant = |own: &AskedColumn| {
            let kind = own.channels[0].kind;
            kind.subject == ChannelSubject::Link && own.of() == link && kind.suffix == "omega_rad_s"
        };
        if !self.sheet.columns.iter().any(is_meant) {
            return None;
        }
        let cause = MarkCause::FromWholeSpeed(point.into());
        Some(Hypothesis::by_rule(self.sheet, Origin::Mistake(cause), -2.5, |at, right| {
            let speed = self.sheet.states[at.row].motions[self.link].point_velocity(self.at).norm();
            let own = speed / (self.at - self.from).norm();
            is_meant(&self.sheet.columns[at.column]).then(|| own.copysign(right))
        }))
    }
}

/// The value that a column requests of a vector: one component, or the magnitude.
fn component(column: &AskedColumn, vector: Vec2) -> f64 {
    match (column.is_size(), column.channels[0].kind.suffix.as_bytes().get(1)) {
        (true, _) => vector.norm(),
        (false, Some(b'y')) => vector.y / column.scale,
        (false, _) => vector.x / column.scale,
    }
}
