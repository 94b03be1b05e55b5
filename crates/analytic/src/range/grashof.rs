//! Grashof's type of a four-bar.
//!
//! Let s and l be the lengths of the shortest and the longest link, and p and q the lengths of the other two links.
//! If s + l < p + q, the shortest link turns fully relative to all others. The type depends on which link is shortest.
//! If s + l > p + q, no link turns fully.
//! If both sums are equal, all joints can lie on one line. Branches cross in this pose.
//! (Grashof 1883; for example Hunt, "Kinematic geometry of mechanisms", 1978, section 4.1.)

use crate::sentences;
use linkage::case::Case;
use linkage::input::Input;
use linkage::mechanism::{GROUND, GroupKind, LinkId};

/// Two sums of lengths count as equal if their relative difference is at most this value. The value is the rounding
/// error of four lengths that are given as decimal numbers.
const EQUAL: f64 = 1e-14;

linkage::words! {
    /// Rotation of the links of a four-bar.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FourBarType: name {
        /// The driving link is the shortest: it turns fully, the output link rocks.
        CrankRocker = sentences::CRANK_ROCKER_GRASHOF_THE_DRIVING,
        /// The output link is the shortest: the driving link rocks, the output link can turn fully.
        RockerCrank = sentences::ROCKER_CRANK_GRASHOF_THE_OUTPUT,
        /// The frame is the shortest (drag link): driving and output link turn fully.
        DoubleCrank = sentences::DOUBLE_CRANK_DRAG_LINK_GRASHOF,
        /// The coupler is the shortest: driving and output link rock, the coupler turns fully relative to both of these
        /// links.
        DoubleRocker = sentences::DOUBLE_ROCKER_GRASHOF_THE_COUPLER,
        /// No link turns fully relative to any other link of the four-bar: s + l > p + q.
        TripleRocker = sentences::TRIPLE_ROCKER_NON_GRASHOF,
        /// s + l = p + q: all joints can lie on one line.
        ChangePoint = sentences::CHANGE_POINT_MECHANISM,
    }
}

/// A four-bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBar {
    /// Lengths of frame, driving link, coupler and output link (m).
    pub lengths: [f64; 4],
    /// Type of the four-bar.
    pub of_type: FourBarType,
}

impl FourBar {
    /// The four-bar of these lengths (m): frame, driving link, coupler, output link.
    #[must_use]
    pub fn of_lengths(lengths: [f64; 4]) -> Self {
        let mut sorted = lengths;
        sorted.sort_by(f64::total_cmp);
        let [s, p, q, l] = sorted;
        let excess = (s + l) - (p + q);
        let of_type = if excess.abs() <= EQUAL * (s + l + p + q) {
            FourBarType::ChangePoint
        } else if excess > 0.0 {
            FourBarType::TripleRocker
        } else if lengths[0] == s {
            FourBarType::DoubleCrank
        } else if lengths[1] == s {
            FourBarType::CrankRocker
        } else if lengths[2] == s {
            FourBarType::DoubleRocker
        } else {
            FourBarType::RockerCrank
        };
        FourBar { lengths, of_type }
    }

    /// The four-bar of a case; `None` if the mechanism of the case is not a four-bar.
    #[must_use]
    pub fn of(case: &Case) -> Option<Self> {
        let (mechanism, drive) = (&case.mechanism, case.crank());
        let joints = mechanism.joints();
        let [group] = &*case.structure.groups else { return None };
        let is_crank = drive.input == Input::Angle && group.is_rigid();
        if !is_crank || group.kind != GroupKind::Rrr || joints.len() != 4 || !joints.iter().all(|joint| joint.is_pin())
        {
            return None;
        }
        let output = *group
            .links
            .iter()
            .find(|&&link| joints.iter().any(|j| j.on(link).is_some() && j.other(link).link == GROUND))?;
        // Distance between the two joints on a link.
        let length = |link: LinkId| {
            let mut on_link = joints.iter().filter_map(|joint| joint.on(link));
            let (a, b) = (on_link.next()?, on_link.next()?);
            on_link.next().is_none().then(|| (a - b).norm())
        };
        let coupler = *group.links.iter().find(|&&link| link != output)?;
        let all = [length(GROUND)?, length(drive.link)?, length(coupler)?, length(output)?];
        Some(FourBar::of_lengths(all))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_link_decides_the_grashof_type() {
        for (place, expected) in
            [FourBarType::DoubleCrank, FourBarType::CrankRocker, FourBarType::DoubleRocker, FourBarType::RockerCrank]
                .into_iter()
                .enumerate()
        {
            let mut lengths = [4.0; 4];
            lengths[place] = 1.0;
            assert_eq!(FourBar::of_lengths(lengths).of_type, expected);
        }
        assert_eq!(FourBar::of_lengths([4.0, 3.5, 3.0, 3.0]).of_type, FourBarType::TripleRocker);
    }

    #[test]
    fn equal_sums_are_detected_despite_rounding() {
        // Parallelogram, deltoid, and lengths whose sums differ in the last digit.
        for lengths in [[0.4, 0.1, 0.4, 0.1], [0.1, 0.1, 0.4, 0.4], [0.1, 0.2, 0.5, 0.4]] {
            assert_eq!(FourBar::of_lengths(lengths).of_type, FourBarType::ChangePoint, "{lengths:?}");
        }
    }
}
