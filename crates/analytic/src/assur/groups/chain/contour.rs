//! A group's links as a tree, and the joints that close its contours.

use crate::assur::groups::guide::turn_between;
use linkage::math::{Motion, Vec2};
use linkage::mechanism::{Group, Joint, JointKind, Mechanism, Side};

/// How the parent guides a link with a prismatic joint to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guided {
    /// The axis in the parent's frame.
    pub(super) axis: Vec2,
    /// Direction of the link's frame in the parent's.
    pub(super) turn: Vec2,
}

/// A link of the group. A joint connects it to its parent, which is known before it.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// The link.
    pub link: usize,
    /// The joint to its parent.
    pub joint: usize,
    /// That joint in the link's own frame.
    pub own: Vec2,
    /// That joint on the parent.
    pub parent: Side,
    /// Position of the parent among the nodes; `None` for a link outside the group.
    pub parent_node: Option<usize>,
    /// Position of the node whose unknown is this link's angle.
    /// It is the node itself if its joint is revolute, otherwise its parent's; `None` if a link outside the group
    /// leads it.
    pub spin: Option<usize>,
    pub(super) guided: Option<Guided>,
}

impl Node {
    fn of(joints: &[Joint], joint: usize, link: usize, before: &[Node]) -> Self {
        let found = &joints[joint];
        let parent = found.other(link);
        let parent_node = before.iter().position(|node| node.link == parent.link);
        let (guided, spin) = match found.kind {
            JointKind::Revolute => (None, Some(before.len())),
            JointKind::Prismatic { .. } => {
                let [axis, own] = [parent.link, link].map(|on| found.axis_on(on).expect("the joint is on the link"));
                let spin = parent_node.and_then(|node| before[node].spin);
                (Some(Guided { axis, turn: turn_between(axis, own) }), spin)
            }
        };
        let own = found.on(link).expect("the joint is on the link");
        Node { link, joint, own, parent, parent_node, spin, guided }
    }

    /// Whether the joint to the parent is prismatic.
    #[inline]
    #[must_use]
    pub fn is_guided(&self) -> bool {
        self.guided.is_some()
    }

    /// World direction of the prismatic joint to the parent; `None` for a revolute one.
    #[inline]
    #[must_use]
    pub fn axis(&self, motions: &[Motion]) -> Option<Vec2> {
        self.guided.map(|guided| motions[self.parent.link].arm(guided.axis))
    }
}

/// Part of the way to a closing joint: a vector of one link, or the slide vector of a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub(super) node: usize,
    /// Vector in the link's frame; `None` for the node's slide.
    pub(super) local: Option<Vec2>,
    pub(super) sign: f64,
}

/// A joint that closes a contour.
#[derive(Clone, Debug)]
pub struct Closing {
    /// The joint.
    pub joint: usize,
    /// Nodes of the joint's first and second link; `None` for a link outside the group.
    pub nodes: [Option<usize>; 2],
    /// The joint on its second link.
    place: Side,
    /// Known points from which the two ways start: second with sign +1, first with -1.
    pub(super) ends: [(Side, f64); 2],
    pub(super) segments: Vec<Segment>,
}

impl Closing {
    /// World place of the joint.
    #[inline]
    #[must_use]
    pub fn place(&self, motions: &[Motion]) -> Vec2 {
        motions[self.place.link].point(self.place.local)
    }
}

/// The group's links, parents before children, and the remaining joints.
pub(super) fn contours(mechanism: &Mechanism, group: &Group) -> (Vec<Node>, Vec<Closing>) {
    let joints = mechanism.joints();
    let mut nodes: Vec<Node> = Vec::new();
    let mut used = vec![false; joints.len()];
    // Breadth first: all outer joints, then inner ones from the links already in the tree.
    while nodes.len() < group.links.len() {
        let known = |link: usize| !group.links.contains(&link) || nodes.iter().any(|node| node.link == link);
        let hung = |&joint: &usize| {
            let (a, b) = (joints[joint].first.link, joints[joint].second.link);
            match (known(a), known(b)) {
                (true, false) => Some((joint, b)),
                (false, true) => Some((joint, a)),
                _ => None,
            }
        };
        let next = || group.outer.iter().chain(&group.inner).filter_map(hung);
        // Prismatic joints first, so that none of them remains (Prim's spanning tree of smallest weight).
        let slider = next().find(|&(joint, _)| joints[joint].slides());
        let (joint, link) = slider.or_else(|| next().next()).expect("a group hangs together");
        used[joint] = true;
        nodes.push(Node::of(joints, joint, link, &nodes));
    }
    let left = group.inner.iter().chain(&group.outer).copied().filter(|&joint| !used[joint]);
    let closings: Vec<Closing> = left.map(|joint| closing(mechanism, &nodes, joint)).collect();
    (nodes, closings)
}

/// The way to a closing joint over both of its links.
fn closing(mechanism: &Mechanism, nodes: &[Node], joint: usize) -> Closing {
    let found = &mechanism.joints()[joint];
    let mut segments = Vec::new();
    let mut way = |side: Side, sign: f64| {
        // Where sliders carry all links, an outer pin remains too. The way to it over the link outside is empty.
        let node = nodes.iter().position(|node| node.link == side.link);
        let (mut next, mut local, mut end) = (node, side.local, side);
        while let Some(index) = next {
            let own = &nodes[index];
            segments.push(Segment { node: index, local: Some(local - own.own), sign });
            if own.guided.is_some() {
                segments.push(Segment { node: index, local: None, sign });
            }
            (next, local, end) = (own.parent_node, own.parent.local, own.parent);
        }
        (node, (end, sign))
    };
    let (second, second_end) = way(found.second, 1.0);
    let (first, first_end) = way(found.first, -1.0);
    Closing { joint, place: found.second, nodes: [first, second], ends: [second_end, first_end], segments }
}
