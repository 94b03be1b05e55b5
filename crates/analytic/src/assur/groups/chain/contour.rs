//! A group's links as a tree, and the joints that close its contours.

use crate::assur::groups::guide::turn_between;
use linkage::math::{Motion, Vec2};
use linkage::mechanism::{Group, Joint, JointId, JointKind, JointSide, LinkId, Mechanism, PerJoint};

/// Guide of a link that has a prismatic joint to its parent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guided {
    /// The axis in the parent's frame.
    pub(super) axis: Vec2,
    /// Direction of the link's frame in the parent's frame.
    pub(super) turn: Vec2,
}

/// A link of the group. A joint connects the link to its parent, which is placed before the link.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// The link.
    pub link: LinkId,
    /// The joint to its parent.
    pub joint: JointId,
    /// Position of the joint in the link's frame, and whether this position is the origin.
    pub own: Vec2,
    pub(super) at_origin: bool,
    /// The parent, and the position of the joint on it.
    pub parent: JointSide,
    /// Index of the parent among the nodes; `None` if the parent is outside the group.
    pub parent_node: Option<usize>,
    /// Index of the node whose unknown angle determines this link's angle.
    /// If the joint to the parent is revolute, the index belongs to this link's node.
    /// If the joint to the parent is prismatic, the index is the `spin` of the parent.
    /// `None` if the rotation of a link outside the group determines the angle.
    pub spin: Option<usize>,
    /// Position of the joint to the parent, on the parent's side.
    pub(in crate::assur) hangs: Hangs,
    pub(super) guided: Option<Guided>,
}

/// Position of a joint on the parent: of the joint's two links, the parent is placed first.
#[derive(Clone, Copy, Debug)]
pub(in crate::assur) enum Hangs {
    /// A joint on a link outside the group: index in [`Contours::roots`].
    Root(usize),
    /// A joint on another node, at the end of an arrow: index in [`Contours::arrows`].
    Arrow(usize),
}

impl Node {
    fn of(joints: &PerJoint<Joint>, joint: JointId, link: LinkId, before: &mut Contours) -> Self {
        let found = &joints[joint];
        let parent = found.other(link);
        let parent_node = before.nodes.iter().position(|node| node.link == parent.link);
        let (guided, spin) = match found.kind {
            JointKind::Revolute => (None, Some(before.nodes.len())),
            JointKind::Prismatic { .. } => {
                let [axis, own] = [parent.link, link].map(|on| found.axis_on(on).expect("the joint is on the link"));
                let spin = parent_node.and_then(|node| before.nodes[node].spin);
                (Some(Guided { axis, turn: turn_between(axis, own) }), spin)
            }
        };
        let own = found.on(link).expect("the joint is on the link");
        let hangs = match parent_node {
            Some(node) => Hangs::Arrow(before.arrow(node, Some(parent.local))),
            None => Hangs::Root(before.root(parent)),
        };
        let at_origin = own == Vec2::zeros();
        Node { link, joint, own, at_origin, parent, parent_node, spin, hangs, guided }
    }

    /// Whether the joint to the parent is prismatic.
    #[inline]
    #[must_use]
    pub fn is_guided(&self) -> bool {
        self.guided.is_some()
    }

    /// World direction of the prismatic joint to the parent; `None` for a revolute joint.
    #[inline]
    #[must_use]
    pub fn axis(&self, motions: &[Motion]) -> Option<Vec2> {
        self.guided.map(|guided| motions[self.parent.link].arm(guided.axis))
    }

    /// World direction of the prismatic joint of a node; the node must have a prismatic joint.
    #[inline]
    pub(super) fn slide_axis(&self, motions: &[Motion]) -> Vec2 {
        self.axis(motions).expect("slides belong to prismatic joints")
    }
}

/// A vector of the tree. It begins at the joint to the node's parent and ends at another joint on the node's link, or
/// it is the node's slide.
#[derive(Clone, Copy, Debug)]
pub(in crate::assur) struct Arrow {
    pub(in crate::assur) node: usize,
    /// The vector in the frame of the node's link; `None` if the vector is the node's slide.
    pub(in crate::assur) local: Option<Vec2>,
    /// The link with which the vector turns, and the node that has this link's angle as its unknown.
    pub(super) carrier: LinkId,
    pub(in crate::assur) spin: Option<usize>,
}

/// An arrow on the path to a closing joint.
#[derive(Clone, Copy, Debug)]
pub(in crate::assur) struct Stretch {
    /// Index in [`Contours::arrows`], and the sign of the arrow on this path.
    pub(in crate::assur) arrow: usize,
    pub(in crate::assur) sign: f64,
    /// Carrier and spin of the arrow, as in [`Arrow`].
    pub(super) carrier: LinkId,
    pub(super) spin: Option<usize>,
    /// The node whose slide is this arrow; `None` for a vector fixed to a link.
    pub(super) slide: Option<usize>,
}

/// A joint that closes a contour.
#[derive(Clone, Debug)]
pub struct ClosingJoint {
    /// The joint.
    pub joint: JointId,
    /// Nodes of the joint's first and second link; `None` if that link is outside the group.
    pub nodes: [Option<usize>; 2],
    /// Position of the joint on its second link.
    place: JointSide,
    /// Indices of the known joints at which the two paths start, and the signs of the paths.
    /// The sign is +1 for the path to the second link, and -1 for the path to the first link.
    pub(in crate::assur) ends: [(usize, f64); 2],
    /// Arrows along both paths.
    pub(in crate::assur) ways: Vec<Stretch>,
}

impl ClosingJoint {
    /// World position of the joint.
    #[inline]
    #[must_use]
    pub fn place(&self, motions: &[Motion]) -> Vec2 {
        motions[self.place.link].point(self.place.local)
    }
}

/// The group's links as a tree and the joints that close its contours.
#[derive(Clone, Debug, Default)]
pub(in crate::assur) struct Contours {
    /// The group's links, parents before children.
    pub(in crate::assur) nodes: Vec<Node>,
    /// The joints outside the tree.
    pub(in crate::assur) closings: Vec<ClosingJoint>,
    /// Joints on links outside the group.
    pub(in crate::assur) roots: Vec<JointSide>,
    /// All vectors from joint to joint.
    pub(in crate::assur) arrows: Vec<Arrow>,
}

impl Contours {
    pub(super) fn of(mechanism: &Mechanism, group: &Group) -> Self {
        let joints = mechanism.joints();
        let mut all = Contours::default();
        let mut used = vec![false; joints.len()];
        // Breadth first: all outer joints come first, then inner joints on links already in the tree.
        while all.nodes.len() < group.links.len() {
            let known = |link: LinkId| !group.links.contains(&link) || all.nodes.iter().any(|node| node.link == link);
            let hung = |&joint: &JointId| {
                let (a, b) = (joints[joint].first.link, joints[joint].second.link);
                match (known(a), known(b)) {
                    (true, false) => Some((joint, b)),
                    (false, true) => Some((joint, a)),
                    _ => None,
                }
            };
            let next = || group.outer.iter().chain(&group.inner).filter_map(hung);
            // Prismatic joints and joints with a given coordinate come first, so that the tree contains all of these
            // joints (Prim's algorithm for the minimum spanning tree).
            let slider = next().find(|&(joint, _)| joints[joint].slides() || group.given.contains(&joint));
            let (joint, link) = slider.or_else(|| next().next()).expect("the links of a group are connected");
            used[joint] = true;
            let node = Node::of(joints, joint, link, &mut all);
            all.nodes.push(node);
        }
        let left = group.inner.iter().chain(&group.outer).copied().filter(|&joint| !used[joint]);
        for joint in left {
            let closing = all.closing(&joints[joint], joint);
            all.closings.push(closing);
        }
        all
    }

    /// Index of a joint on a link outside the group.
    fn root(&mut self, side: JointSide) -> usize {
        self.roots.iter().position(|&known| known == side).unwrap_or_else(|| {
            self.roots.push(side);
            self.roots.len() - 1
        })
    }

    /// Index of the arrow from a node's joint to the position `to` on its link.
    /// If `to` is `None`, index of the node's slide.
    fn arrow(&mut self, node: usize, to: Option<Vec2>) -> usize {
        let own = &self.nodes[node];
        let local = to.map(|to| to - own.own);
        let known = self.arrows.iter().position(|arrow| arrow.node == node && arrow.local == local);
        known.unwrap_or_else(|| {
            let carrier = if local.is_some() { own.link } else { own.parent.link };
            self.arrows.push(Arrow { node, local, carrier, spin: own.spin });
            self.arrows.len() - 1
        })
    }

    /// Returns the closing joint with two paths to it, one through each of its links.
    fn closing(&mut self, found: &Joint, joint: JointId) -> ClosingJoint {
        let mut ways = Vec::new();
        let mut way = |side: JointSide, sign: f64| {
            // If prismatic joints already connect all links to the tree, an outer pin also closes a contour. The path
            // to this pin through the link outside the group is empty.
            let node = self.nodes.iter().position(|node| node.link == side.link);
            let (mut next, mut to) = (node, side);
            while let Some(index) = next {
                ways.push((self.arrow(index, Some(to.local)), sign));
                if self.nodes[index].guided.is_some() {
                    ways.push((self.arrow(index, None), sign));
                }
                (next, to) = (self.nodes[index].parent_node, self.nodes[index].parent);
            }
            (node, (self.root(to), sign))
        };
        let (second, second_end) = way(found.second, 1.0);
        let (first, first_end) = way(found.first, -1.0);
        // Arrows common to the beginnings of both paths cancel, so they are removed.
        let all = ways.clone();
        ways.retain(|&(arrow, sign)| !all.contains(&(arrow, -sign)));
        let stretch = |(number, sign): (usize, f64)| {
            let Arrow { node, local, carrier, spin } = self.arrows[number];
            Stretch { arrow: number, sign, carrier, spin, slide: local.is_none().then_some(node) }
        };
        let ways = ways.into_iter().map(stretch).collect();
        ClosingJoint { joint, place: found.second, nodes: [first, second], ends: [second_end, first_end], ways }
    }
}
