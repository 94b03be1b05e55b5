//! Constants of higher groups on pins, for several poses at once.
//!
//! The motion is computed with the equations of [`crate::assur::groups::Chain`], the forces with the equations of the
//! module `assur::forces`.

mod forces;
mod motion;

use super::bodies::{Action, Body, Reader};
use super::elimination;
use crate::assur::groups::{self, Hangs};
use linkage::math::Vec2;
use linkage::mechanism::LinkId;

/// Number of columns for the starting values of a link: its direction at the anchor (2), the fraction of the interval
/// to the next anchor (1), and coefficients of the rotation from the anchor (5, rad).
pub(super) const OF_START: usize = 8;
/// A link of the group, and the joint to its parent link in the group's tree.
/// Moments on the link are about this joint, the link's pole.
#[derive(Clone, Debug)]
struct Node {
    body: Body,
    own: Vec2,
    hangs: Hangs,
    reaction: Action,
}

/// A vector between two joints on the link of a node.
#[derive(Clone, Copy, Debug)]
struct Arrow {
    node: usize,
    /// First column of the link.
    link: usize,
    local: Vec2,
}

/// A joint that closes a contour.
#[derive(Clone, Debug)]
struct Closing {
    ends: [(usize, f64); 2],
    ways: Vec<(usize, f64)>,
    /// Column of the joint's reaction, and the nodes of the joint's first and second link.
    force: usize,
    nodes: [Option<usize>; 2],
}

/// A higher group on pins.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    nodes: Vec<Node>,
    closings: Vec<Closing>,
    arrows: Vec<Arrow>,
    /// For each joint on a link outside the group: the first column of this link (`None` for the ground), and the
    /// position of the joint on the link.
    roots: Vec<(Option<usize>, Vec2)>,
    /// Sign of the group's determinant on the followed branch.
    branch: f64,
    /// The links of the group, with their numbers in the mechanism.
    links: Vec<LinkId>,
}

impl Chain {
    /// Returns the constants of a group; `None` if a link slides, or if the group has neither four nor six links.
    pub(super) fn of(reader: &Reader, chain: &groups::Chain) -> Option<Self> {
        let contours = chain.contours();
        if chain.is_sliding() || !matches!(contours.nodes.len(), 4 | 6) {
            return None;
        }
        let column = |link: LinkId| reader.layout.link(link);
        let nodes = contours.nodes.iter().map(|node| Node {
            body: reader.body(node.link),
            own: node.own,
            hangs: node.hangs,
            reaction: reader.action(node.joint, node.link),
        });
        let arrow = |arrow: &groups::Arrow| {
            let (node, link) = (arrow.node, column(contours.nodes[arrow.node].link)?);
            Some(Arrow { node, link, local: arrow.local? })
        };
        let closings = contours.closings.iter().map(|closing| Closing {
            ends: closing.ends,
            ways: closing.ways.iter().map(|stretch| (stretch.arrow, stretch.sign)).collect(),
            force: reader.layout.force(closing.joint),
            nodes: closing.nodes,
        });
        Some(Chain {
            nodes: nodes.collect(),
            closings: closings.collect(),
            arrows: contours.arrows.iter().map(arrow).collect::<Option<_>>()?,
            roots: contours.roots.iter().map(|side| (column(side.link), side.local)).collect(),
            branch: chain.determinant().signum(),
            links: contours.nodes.iter().map(|node| node.link).collect(),
        })
    }

    /// Number of columns in the working memory.
    /// The columns contain the starting values of the links, the roots and joints of the group's tree, the arrows, and
    /// the factors of the Jacobian.
    /// For each root and joint, four columns contain two vectors: the vector from the origin of its link, and the
    /// position, velocity or acceleration, depending on the present stage.
    pub(super) fn columns(&self) -> usize {
        self.first_factor(0) + elimination::columns(self.nodes.len())
    }

    /// Returns the links with their numbers in the mechanism, in the order of their starting values.
    pub(super) fn links(&self) -> &[LinkId] {
        &self.links
    }

    fn root(&self, first: usize, root: usize) -> usize {
        first + OF_START * self.nodes.len() + 4 * root
    }

    fn joint(&self, first: usize, node: usize) -> usize {
        self.root(first, self.roots.len()) + 4 * node
    }

    fn arrow(&self, first: usize, arrow: usize) -> usize {
        self.joint(first, self.nodes.len()) + 2 * arrow
    }

    fn first_factor(&self, first: usize) -> usize {
        self.arrow(first, self.arrows.len())
    }
}
