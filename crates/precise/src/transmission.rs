//! Transmission angles of dyads, in any scalar.

use linkage::mechanism::{Group, GroupKind, JointId, LinkId};

use super::frame::Snapshot;
use super::readings::Readings;
use super::scalar::Scalar;
use super::vector::Vector;

impl<S: Scalar> Readings<'_, S> {
    /// Square of the sine of a dyad's transmission angle: 1 at the best transmission, 0 at a dead point.
    /// `linkage::mechanism::assembly::transmission_sine` defines the sine for each kind of dyad.
    /// `None` for other groups, and for groups with driven joints or transmissions inside.
    #[must_use]
    pub fn squared_transmission_sine(&self, instant: &Snapshot<S>, group: &Group) -> Option<S> {
        if !group.is_rigid() {
            return None;
        }
        let joints = self.whole.case.mechanism.joints();
        let members = || group.links.iter().copied().zip(group.outer.iter().copied());
        let pinned = || members().find(|(_, outer)| !joints[*outer].slides());
        let sliding = || members().find(|(_, outer)| joints[*outer].slides());
        let inner = *group.inner.first()?;
        Some(match group.kind {
            GroupKind::Rrr => {
                let [a, b] = [0, 1].map(|k| self.arm(instant, group.links[k], [inner, group.outer[k]]));
                squared_sine(a, b)
            }
            GroupKind::Rrp => {
                let ((rod, pin), (slider, guide)) = (pinned()?, sliding()?);
                squared_cosine(self.axis(instant, guide, slider), self.arm(instant, rod, [inner, pin]))
            }
            GroupKind::Rpr => {
                let first = joints[inner].first.link;
                let [own, other] = if group.links[0] == first { [0, 1] } else { [1, 0] };
                let hook = |k: usize| self.place(instant, group.outer[k], group.links[k]);
                squared_cosine(self.axis(instant, inner, first), hook(other) - hook(own))
            }
            GroupKind::Rpp => {
                let ((swivel, _), (slider, guide)) = (pinned()?, sliding()?);
                squared_sine(self.axis(instant, inner, swivel), self.axis(instant, guide, slider))
            }
            GroupKind::Prp => {
                let [a, b] = [0, 1].map(|k| self.axis(instant, group.outer[k], group.links[k]));
                squared_sine(a, b)
            }
            GroupKind::Higher | GroupKind::Driven => return None,
        })
    }

    /// World position of a joint's point on one of its links (m).
    fn place(&self, instant: &Snapshot<S>, joint: JointId, link: LinkId) -> Vector<S> {
        let side = usize::from(self.whole.case.mechanism.joints()[joint].first.link != link);
        instant.frames[link].point(self.whole.numbers.joints[joint].places[side])
    }

    /// Vector between two joints of a link, from the second to the first, in world axes (m).
    fn arm(&self, instant: &Snapshot<S>, link: LinkId, [to, from]: [JointId; 2]) -> Vector<S> {
        self.place(instant, to, link) - self.place(instant, from, link)
    }

    /// World direction of a prismatic joint's axis on one of its links; the axes on both links are parallel.
    fn axis(&self, instant: &Snapshot<S>, joint: JointId, link: LinkId) -> Vector<S> {
        let side = usize::from(self.whole.case.mechanism.joints()[joint].first.link != link);
        let guides = self.whole.numbers.joints[joint].guides.unwrap_or([Vector::X; 2]);
        instant.frames[link].arm(guides[side])
    }
}

fn squared_sine<S: Scalar>(a: Vector<S>, b: Vector<S>) -> S {
    a.cross(b) * a.cross(b) / (a.dot(a) * b.dot(b))
}

fn squared_cosine<S: Scalar>(a: Vector<S>, b: Vector<S>) -> S {
    a.dot(b) * a.dot(b) / (a.dot(a) * b.dot(b))
}
