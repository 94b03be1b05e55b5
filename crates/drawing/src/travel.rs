//! Travel of blocks on their guides, and one pose of the members of every transmission.
//! The travel sets the drawn length of the guides. A cam's profile is drawn such that it touches the follower in this
//! pose.

use linkage::math::{KeepNan, Motion, Vec2};
use linkage::mechanism::{JointId, LinkId, Mechanism, TransmissionId};

/// Travel of every joint (m): the range of the distance from the guide's point to the block's point, along the guide's
/// axis.
/// The range is `None` for joints that do not slide, and before the first pose is included.
#[derive(Clone, Debug, PartialEq)]
pub struct Travels {
    joints: Vec<Option<[f64; 2]>>,
    /// For every transmission, the coordinates of its two members in one pose: two angles (rad), or the angle (rad) of
    /// the first member and the slide (m) of the second.
    members: Vec<Option<[f64; 2]>>,
}

impl Travels {
    /// Travels before the first pose is included.
    pub fn none(mechanism: &Mechanism) -> Travels {
        Travels { joints: vec![None; mechanism.joints().len()], members: vec![None; mechanism.transmissions().len()] }
    }

    /// Includes one pose: `point` gives the world position (m) of a point that is given in the frame of a link.
    /// `None` or NaN means that the link has no pose.
    pub fn take_in(&mut self, mechanism: &Mechanism, point: impl Fn(LinkId, Vec2) -> Option<Vec2>) {
        for (joint, travel) in mechanism.joints().iter().zip(&mut self.joints) {
            let way = || {
                let [guide, block] = mechanism.guide_and_block(joint)?;
                let at = point(guide.link, guide.local)?;
                let axis = point(guide.link, guide.local + joint.axis_on(guide.link)?)? - at;
                Some((point(block.link, block.local)? - at).dot(&axis)).filter(|way| way.is_finite())
            };
            if let Some(way) = way() {
                let [low, high] = travel.unwrap_or([way; 2]);
                *travel = Some([low.smaller(way), high.larger(way)]);
            }
        }
        if self.members.iter().any(Option::is_none) {
            let motion = |link| {
                let origin = point(link, Vec2::zeros())?;
                Some(Motion { origin, direction: point(link, Vec2::x())? - origin, ..Motion::REST })
            };
            let Some(motions) = mechanism.links().ids().map(motion).collect::<Option<Vec<_>>>() else { return };
            for (transmission, members) in mechanism.transmissions().iter().zip(&mut self.members) {
                let found = transmission.coordinates_in(mechanism.joints(), &motions);
                *members = members.or_else(|| Some(found).filter(|found| found.iter().all(|q| q.is_finite())));
            }
        }
    }

    /// Includes other travels of the same mechanism.
    pub fn widen(&mut self, others: &Travels) {
        self.members.iter_mut().zip(&others.members).for_each(|(own, other)| *own = own.or(*other));
        for (own, other) in self.joints.iter_mut().zip(&others.joints) {
            *own = match (*own, *other) {
                (Some(a), Some(b)) => Some([a[0].smaller(b[0]), a[1].larger(b[1])]),
                (own, other) => own.or(other),
            };
        }
    }

    /// Travel of the joint with this number (m).
    pub fn of(&self, joint: JointId) -> Option<[f64; 2]> {
        self.joints[joint]
    }

    /// Coordinates of the members of a transmission in one pose (rad, or rad and m).
    pub fn members(&self, transmission: TransmissionId) -> Option<[f64; 2]> {
        self.members[transmission]
    }

    /// Replaces the travel of one joint (m).
    pub fn with(mut self, joint: JointId, travel: [f64; 2]) -> Travels {
        self.joints[joint] = Some(travel);
        self
    }
}
