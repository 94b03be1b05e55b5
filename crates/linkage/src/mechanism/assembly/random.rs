//! Random mechanisms for the tests of this module, the same in every run.

use crate::math::{KeepNan, Vec2, rotated, unit};
use crate::mechanism::{
    Group, GroupKind, Joint, JointId, JointKind, JointSide, Link, LinkId, LinkPose, Mechanism, Pose,
};

/// Linear congruential generator (Knuth's MMIX). Only the upper 53 bits of its state are used.
pub struct Lcg(pub u64);

impl Lcg {
    pub fn number(&mut self, from: f64, to: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn yes(&mut self) -> bool {
        self.number(0.0, 1.0) < 0.5
    }

    pub fn place(&mut self) -> Vec2 {
        Vec2::new(self.number(-1.0, 1.0), self.number(-1.0, 1.0))
    }

    pub fn pose(&mut self) -> LinkPose {
        LinkPose { origin: self.place(), angle: self.number(-3.1, 3.1) }
    }

    /// A joint between links `a` and `b` in random order, at random positions.
    pub fn joint(&mut self, name: &str, slides: bool, a: LinkId, b: LinkId) -> Joint {
        let [first, second] = if self.yes() { [a, b] } else { [b, a] };
        let side = |link, local| JointSide { link, local };
        let axes = [self.number(-3.1, 3.1), self.number(-3.1, 3.1)].map(unit);
        let kind = if slides { JointKind::Prismatic { axes } } else { JointKind::Revolute };
        Joint {
            name: name.into(),
            kind,
            first: side(first, self.place()),
            second: side(second, self.place()),
            drawn: None,
        }
    }

    /// Moves the second side of a joint so that the joint is closed in `pose`.
    /// A revolute joint gets a new position. A prismatic joint gets a new position and a new axis.
    pub fn fitted(&mut self, mut joint: Joint, pose: &Pose) -> Joint {
        let (first, second) = (pose.0[joint.first.link], pose.0[joint.second.link]);
        let back = |v: Vec2| rotated(unit(-second.angle), v);
        let mut place = first.point(joint.first.local);
        if let JointKind::Prismatic { axes: [axis, other] } = &mut joint.kind {
            let world = rotated(unit(first.angle), *axis);
            *other = back(world).normalize();
            place += world * self.number(-1.0, 1.0);
        }
        joint.second.local = back(place - second.origin);
        joint
    }
}

/// A mechanism of `count` links and the given joints. The mechanism's points are the positions of the joints.
pub fn mechanism(count: usize, joints: Vec<Joint>) -> Mechanism {
    let link = |index: usize| Link {
        name: if index == 0 { "ground".into() } else { format!("link{index}") },
        points: joints
            .iter()
            .filter_map(|joint| {
                Some(crate::mechanism::Point {
                    name: format!("{}{index}", joint.name),
                    local: joint.on(LinkId(index))?,
                })
            })
            .collect(),
        mass: 0.0,
        mass_centre: Vec2::zeros(),
        inertia: 0.0,
    };
    let links = (0..count).map(link).collect();
    Mechanism::new(links, joints).unwrap()
}

/// The group of `links` as found by structural analysis, if the poses of all other links are known.
pub fn group(mechanism: &Mechanism, links: &[LinkId], kind: GroupKind) -> Group {
    let inside = |joint: JointId| {
        let joint = &mechanism.joints()[joint];
        [joint.first, joint.second].iter().filter(|side| links.contains(&side.link)).count()
    };
    let all = mechanism.joints().ids();
    let mut outer: Vec<JointId> = all.clone().filter(|&joint| inside(joint) == 1).collect();
    outer.sort_by_key(|&joint| links.iter().position(|&link| mechanism.joints()[joint].on(link).is_some()));
    Group {
        links: links.into(),
        inner: all.filter(|&joint| inside(joint) == 2).collect(),
        outer,
        given: Vec::new(),
        trains: Vec::new(),
        class: 2,
        kind,
    }
}

/// Reference length for errors (m).
/// The reference length is the mechanism's size, or the largest distance of a link's origin from the world's origin if
/// this distance is larger.
pub fn size(mechanism: &Mechanism, pose: &Pose) -> f64 {
    let bases = pose.0.iter().map(|link| link.origin.norm()).fold(0.0, f64::larger);
    mechanism.size().larger(bases)
}
