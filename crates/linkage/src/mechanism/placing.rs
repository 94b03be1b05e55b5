//! Changes the dimensions of a mechanism: moves a point of a link together with the joints at this point.

use super::{Joint, JointSide, Mechanism};
use crate::math::Vec2;
use crate::mechanism::{JointId, LinkId};

/// A point of a link that can be moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Handle {
    /// Index of the link.
    pub link: LinkId,
    /// Index of the point in the link.
    pub point: usize,
    /// Joints at the point.
    joints: Vec<JointId>,
}

impl Mechanism {
    /// The point with index `point` of the link `link`, and the joints at this point.
    /// `None` if another point of the link has the same position, because a joint at this position could then belong to
    /// either point.
    #[must_use]
    pub fn handle(&self, link: LinkId, point: usize) -> Option<Handle> {
        let points = &self.links[link].points;
        let local = points[point].local;
        if points.iter().enumerate().any(|(index, other)| index != point && other.local == local) {
            return None;
        }
        let lies_there = |joint: &Joint| joint.on(link) == Some(local);
        let joints = self.joints.ids().filter(|&joint| lies_there(&self.joints[joint])).collect();
        Some(Handle { link, point, joints })
    }

    /// Moves a point to the position `local` in its link's frame (m), together with the joints at the point. Masses
    /// stay unchanged.
    pub fn place(&mut self, handle: &Handle, local: Vec2) {
        self.links[handle.link].points[handle.point].local = local;
        for &joint in &handle.joints {
            let Joint { first, second, .. } = &mut self.joints[joint];
            let side: &mut JointSide = if first.link == handle.link { first } else { second };
            side.local = local;
        }
    }

    /// The joints at a point. The number beside each joint tells which link of the joint is the point's link: 0 for the
    /// joint's first link, 1 for its second link.
    pub fn sides<'a>(&'a self, handle: &'a Handle) -> impl Iterator<Item = (JointId, usize)> + 'a {
        let side = |joint: JointId| usize::from(self.joints[joint].first.link != handle.link);
        handle.joints.iter().map(move |&joint| (joint, side(joint)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::four_bar;

    #[test]
    fn joints_move_with_their_points() {
        let mut mechanism = four_bar();
        let old = mechanism.links()[LinkId(3)].points.clone();
        let handle = mechanism.handle(LinkId(3), 1).unwrap();
        mechanism.place(&handle, Vec2::new(0.7, 0.1));
        let moved: Vec<&Joint> =
            mechanism.joints().iter().filter(|joint| joint.on(LinkId(3)) == Some(Vec2::new(0.7, 0.1))).collect();
        assert_eq!(moved.len(), 1, "{moved:?}");
        mechanism.place(&handle, old[1].local);
        assert_eq!(mechanism, four_bar());
    }

    #[test]
    fn coincident_points_have_no_handle() {
        let mut mechanism = four_bar();
        let handle = mechanism.handle(LinkId(3), 1).unwrap();
        let other = mechanism.links()[LinkId(3)].points[0].local;
        mechanism.place(&handle, other);
        assert!(mechanism.handle(LinkId(3), 1).is_none());
    }
}
