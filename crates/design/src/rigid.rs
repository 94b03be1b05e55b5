//! A mechanism as rigid bodies and joints in the start pose. Every model file is written from these numbers.

use linkage::case::Case;
use linkage::math::{KeepNan, Vec2, rotated, unit};
use linkage::mechanism::{
    Coordinate, GROUND, Joint, JointId, JointKind, LinkId, LinkPose, SpanningTree, Transmission, TreeBranch,
};
use linkage::solver::State;

/// Mass of a massless link, divided by the mass of the whole mechanism. Physics engines refuse a mass of zero.
/// A smaller mass would change the reactions less, but MuJoCo would keep loops closed less exactly: the compliance of
/// its loop constraint is inversely proportional to the masses that the constraint connects.
/// docs/mjcf.md states the resulting errors.
const LIGHT: f64 = 1e-5;
/// Radius of gyration of a link for which the case gives no moment of inertia, divided by the link's size.
/// A link smaller than `SHORTEST` times the mechanism's size counts as having this size.
const GYRATION: f64 = 0.3;
const SHORTEST: f64 = 0.1;

/// A mechanism as rigid bodies and joints in the start pose.
#[derive(Debug)]
pub struct RigidModel<'a> {
    pub(crate) case: &'a Case,
    pub(crate) name: &'a str,
    /// State at t = 0 with its velocities.
    pub(crate) start: State,
    /// The spanning tree, which contains all driven joints.
    pub(crate) tree: SpanningTree,
    /// One body for each branch of the tree.
    pub(crate) bodies: Vec<Body>,
    /// The joints that close loops. Each is stored as a body: the joint's second link is the child, and its first link
    /// the parent. If the second link is the ground, the ground is the parent.
    pub(crate) closing: Vec<Body>,
}

impl<'a> RigidModel<'a> {
    /// The model of a case whose state at t = 0 is `start`.
    #[must_use]
    pub fn new(case: &'a Case, start: &State, name: &'a str) -> Self {
        let driven = case.drives.joint_ids();
        let mut tree = SpanningTree::of(&case.mechanism);
        if driven.iter().any(|joint| tree.cut.contains(joint)) {
            tree = SpanningTree::with(&case.mechanism, &driven);
        }
        let closing = tree.cut.iter().map(|&joint| {
            let [first, second] =
                [case.mechanism.joints()[joint].first.link, case.mechanism.joints()[joint].second.link];
            let (parent, link) = if second == GROUND { (second, first) } else { (first, second) };
            TreeBranch { link, parent, joint }
        });
        let [bodies, closing] = [tree.branches.clone(), closing.collect()]
            .map(|branches: Vec<_>| branches.iter().map(|branch| body(case, start, branch)).collect());
        RigidModel { case, name, start: start.clone(), tree, bodies, closing }
    }

    /// Pose of a link in the start pose.
    pub(crate) fn pose(&self, link: LinkId) -> LinkPose {
        self.case.start.0[link]
    }

    /// Point of a joint on one of its links, in the link's frame (m).
    pub(crate) fn point(&self, joint: JointId, link: LinkId) -> Vec2 {
        self.case.mechanism.joints()[joint].on(link).expect("the joint is on the link")
    }

    /// Name of a joint.
    pub(crate) fn joint_name(&self, joint: JointId) -> &'a str {
        &self.case.mechanism.joints()[joint].name
    }

    /// Name of a link.
    pub(crate) fn link_name(&self, link: LinkId) -> &'a str {
        &self.case.mechanism.links()[link].name
    }

    /// Mass of the mechanism (kg). A mechanism without mass gets 1 kg, so that its motion can still be simulated.
    pub(crate) fn mass(&self) -> f64 {
        let mass: f64 = self.case.mechanism.links().iter().map(|link| link.mass).sum();
        if mass > 0.0 { mass } else { 1.0 }
    }

    /// Size of the mechanism (m), for drawing and for inertias.
    pub(crate) fn size(&self) -> f64 {
        let size = self.case.mechanism.size();
        if size > 0.0 { size } else { 1.0 }
    }

    /// Whether a joint is driven.
    pub(crate) fn is_driven(&self, joint: JointId) -> bool {
        self.case.drives.iter().any(|drive| drive.joint == joint)
    }

    /// Whether a law prescribes the motion of a joint.
    pub(crate) fn is_prescribed(&self, joint: JointId) -> bool {
        self.case.drives.iter().any(|drive| drive.joint == joint && !drive.is_free())
    }

    /// Mass (kg) and moment of inertia (kg m^2) of a link for physics engines.
    /// A missing mass or moment of inertia is replaced by the value of a light rod.
    pub fn inertial(&self, link: LinkId) -> (f64, f64) {
        let link = &self.case.mechanism.links()[link];
        let light = LIGHT * self.mass();
        let radius = GYRATION * link.size().larger(SHORTEST * self.size());
        let own_or = |own: f64, lent: f64| if own > 0.0 { own } else { lent };
        (own_or(link.mass, light), own_or(link.inertia, light * radius * radius))
    }

    /// Index of the branch that carries `link`.
    pub(crate) fn branch_of(&self, link: LinkId) -> Option<usize> {
        self.tree.branches.iter().position(|branch| branch.link == link)
    }

    /// Child links of `parent`, in the tree's order.
    pub(crate) fn children(&self, parent: LinkId) -> Vec<LinkId> {
        self.tree.branches.iter().filter(|branch| branch.parent == parent).map(|branch| branch.link).collect()
    }

    /// Bodies in the order of MuJoCo's coordinates.
    /// Each body precedes its children, and the children precede the body's next sibling.
    pub(crate) fn in_order(&self) -> Vec<&Body> {
        let mut order = Vec::new();
        let mut waiting = self.children(GROUND);
        waiting.reverse();
        while let Some(link) = waiting.pop() {
            order.extend(self.branch_of(link).map(|branch| &self.bodies[branch]));
            waiting.extend(self.children(link).into_iter().rev());
        }
        order
    }

    /// Branches from the ground to `link`, as indices. The branch that carries `link` is last.
    fn way(&self, mut link: LinkId) -> Vec<usize> {
        let mut way = Vec::new();
        while link != GROUND {
            let branch = self.branch_of(link).expect("every moving link is in the tree");
            way.push(branch);
            link = self.tree.branches[branch].parent;
        }
        way.reverse();
        way
    }

    fn is_slide(&self, branch: usize) -> bool {
        self.case.mechanism.joints()[self.tree.branches[branch].joint].keeps_angle()
    }

    /// Hinges from the ground to `link`, as indices of branches. The hinge nearest to `link` is last.
    pub(crate) fn hinges(&self, link: LinkId) -> Vec<usize> {
        self.way(link).into_iter().filter(|branch| !self.is_slide(*branch)).collect()
    }

    /// Whether a slide lies between the ground and `link`.
    pub(crate) fn slides(&self, link: LinkId) -> bool {
        self.way(link).into_iter().any(|branch| self.is_slide(branch))
    }

    /// Branches of the tree whose coordinates a transmission couples, each with a factor.
    /// The transmission keeps one sum constant: that of all coordinates, each multiplied by its factor.
    pub(crate) fn coupled(&self, transmission: &Transmission) -> Vec<(usize, f64)> {
        let mut sum: Vec<(usize, f64)> = Vec::new();
        let mut add = |branch: usize, factor: f64| match sum.iter_mut().find(|(own, _)| *own == branch) {
            Some((_, own)) => *own += factor,
            None => sum.push((branch, factor)),
        };
        let [first, second] = &transmission.coordinates;
        let ratio = transmission.ratio().expect("cams are refused");
        let terms = second.iter().copied().chain(first.iter().map(|&(of, sign)| (of, -ratio * sign)));
        for (of, factor) in terms {
            match of {
                Coordinate::Angle(link) => self.hinges(link).into_iter().for_each(|hinge| add(hinge, factor)),
                Coordinate::Slide(joint) => {
                    let branch = self.tree.branches.iter().position(|branch| branch.joint == joint);
                    add(branch.expect("prismatic joints are in the tree"), factor);
                }
            }
        }
        let most = sum.iter().fold(0.0, |most: f64, (_, factor)| most.larger(factor.abs()));
        sum.retain(|(_, factor)| factor.abs() > 1e-12 * most);
        sum
    }
}

/// The only degree of freedom of a body relative to its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Freedom {
    /// Hinge about z at a point of the body's frame (m).
    Hinge(Vec2),
    /// Slide along a unit vector of the body's frame.
    Slide(Vec2),
}

/// A link as a body on its parent. A joint that closes a loop is described by the same fields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Body {
    /// The link, its parent and their joint.
    pub branch: TreeBranch,
    /// Origin of the link's frame in the frame of the parent link, in the start pose (m).
    pub offset: Vec2,
    /// Angle of the link minus the parent's angle, in the start pose (rad).
    pub turn: f64,
    /// The joint.
    pub freedom: Freedom,
    /// The joint's coordinate in the start pose: the slide (m), or the angle of the link minus the parent's angle
    /// (rad).
    pub coordinate: f64,
    /// Rate of the joint's coordinate at the start (rad/s, m/s).
    pub rate: f64,
}

impl Body {
    /// Whether the joint is prismatic.
    pub(crate) fn slides(&self) -> bool {
        matches!(self.freedom, Freedom::Slide(_))
    }

    /// The joint's coordinate in a state whose angles are unwrapped (rad, m).
    pub(crate) fn coordinate_in(&self, case: &Case, state: &State) -> f64 {
        match self.freedom {
            Freedom::Hinge(_) => state.angles[self.branch.link] - state.angles[self.branch.parent],
            Freedom::Slide(_) => slide(&case.mechanism.joints()[self.branch.joint], state)[0],
        }
    }

    /// Rate of the joint's coordinate in a state (rad/s, m/s).
    pub(crate) fn rate_in(&self, case: &Case, state: &State) -> f64 {
        match self.freedom {
            Freedom::Hinge(_) => state.motions[self.branch.link].omega - state.motions[self.branch.parent].omega,
            Freedom::Slide(_) => slide(&case.mechanism.joints()[self.branch.joint], state)[1],
        }
    }
}

/// Slide of a prismatic joint, with its rate.
fn slide(joint: &Joint, state: &State) -> [f64; 3] {
    state.slide(joint).expect("the joint slides")
}

/// The body of a branch. Poses are taken from the case at t = 0, and rates from `start`.
fn body(case: &Case, start: &State, branch: &TreeBranch) -> Body {
    let joint = &case.mechanism.joints()[branch.joint];
    let [parent, child] = [branch.parent, branch.link].map(|link| case.start.0[link]);
    let offset = rotated(unit(-parent.angle), child.origin - parent.origin);
    let turn = child.angle - parent.angle;
    let freedom = match joint.kind {
        JointKind::Revolute => Freedom::Hinge(joint.on(branch.link).expect("a branch's joint is on its link")),
        JointKind::Prismatic { .. } => {
            let axis = joint.axis_on(branch.link).expect("a branch's joint is on its link");
            // A slide is measured from the first link to the second. The sign of the axis therefore depends on which
            // of the two links is the child.
            Freedom::Slide(axis * if branch.link == joint.second.link { 1.0 } else { -1.0 })
        }
    };
    let own = Body { branch: *branch, offset, turn, freedom, coordinate: 0.0, rate: 0.0 };
    let coordinate = match freedom {
        Freedom::Hinge(_) => turn,
        Freedom::Slide(_) => slide(joint, &State::at_start(case))[0],
    };
    Body { coordinate, rate: own.rate_in(case, start), ..own }
}
