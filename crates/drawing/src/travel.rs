//! Travel of blocks on their guides, which sets the drawn length of the guides.

use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{JointId, LinkId, Mechanism};

/// Range of the distance between the block's point and the guide's point along the guide's axis (m), for every joint.
/// The range is `None` for joints that do not slide, and before the first pose is included.
#[derive(Clone, Debug, PartialEq)]
pub struct Travels(Vec<Option<[f64; 2]>>);

impl Travels {
    /// Nothing is known yet.
    #[must_use]
    pub fn none(mechanism: &Mechanism) -> Travels {
        Travels(vec![None; mechanism.joints().len()])
    }

    /// Includes one pose: `point` gives the world position (m) of a point that is given in the frame of a link.
    /// `None` or NaN means that the link has no pose.
    pub fn take_in(&mut self, mechanism: &Mechanism, point: impl Fn(LinkId, Vec2) -> Option<Vec2>) {
        for (joint, travel) in mechanism.joints().iter().zip(&mut self.0) {
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
    }

    /// Includes other travels of the same mechanism.
    pub fn widen(&mut self, others: &Travels) {
        for (own, other) in self.0.iter_mut().zip(&others.0) {
            *own = match (*own, *other) {
                (Some(a), Some(b)) => Some([a[0].smaller(b[0]), a[1].larger(b[1])]),
                (own, other) => own.or(other),
            };
        }
    }

    /// Travel of the joint with this number (m).
    #[must_use]
    pub fn of(&self, joint: JointId) -> Option<[f64; 2]> {
        self.0[joint]
    }

    /// These travels, with the travel of one joint replaced (m).
    #[must_use]
    pub fn with(mut self, joint: JointId, travel: [f64; 2]) -> Travels {
        self.0[joint] = Some(travel);
        self
    }
}
