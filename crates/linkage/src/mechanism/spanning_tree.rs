//! Spanning tree of a linkage: which joint carries which link, and which joints are cut.
//! In the tree used for runs, prismatic joints are never cut, so their constraints are satisfied exactly.
//! All prismatic joints fit into the tree, because structural analysis rejects loops that consist only of prismatic
//! joints.
//! An engine also works if prismatic joints are cut. Its order of convergence is 2 in both cases.
//! Two trees were compared by the largest error of any channel, relative to half the channel's range, at a step of 1e-3
//! s.
//! In the following list, the first number is for a tree that keeps prismatic joints.
//! The second number is for a tree that cuts the innermost joint of each loop, whatever the joint's kind.
//! The errors are 1.4e-4 and 2.0e-4 for a slider-crank, and 8.3e-4 and 1.2e-3 for a swinging guide.
//! The errors are 7.8e-5 and 6.5e-5 for a Scotch yoke.
//! With both trees, the error is 1.9e-3 for a crank with a slot and 9.0e-5 for an Oldham coupling.

use super::{GROUND, Joint, LinkPose, Mechanism};
use crate::math::{rotated, unit};
use crate::mechanism::{JointId, LinkId};

/// A link of the tree, with the link's parent and the joint between the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TreeBranch {
    /// The link.
    pub link: LinkId,
    /// The parent link, nearer to the ground.
    pub parent: LinkId,
    /// The joint between parent and child.
    pub joint: JointId,
}

/// Branches from the ground, and the cut joints. The cut joints close the loops. Links without a branch are free
/// bodies.
#[derive(Clone, Debug, PartialEq, Eq)]
#[must_use]
pub struct SpanningTree {
    /// Branches; a parent always comes before its children.
    pub branches: Vec<TreeBranch>,
    /// Joints that close loops.
    pub cut: Vec<JointId>,
}

impl SpanningTree {
    /// No tree: every link is a free body and every joint is cut.
    pub fn none(mechanism: &Mechanism) -> Self {
        SpanningTree { branches: Vec::new(), cut: mechanism.joints().ids().collect() }
    }

    /// Several spanning trees. Each joint in `joints` is cut in at least one tree.
    /// The first tree is that of [`SpanningTree::of`].
    /// Each further tree cuts as many as possible of the joints that no earlier tree cuts.
    #[must_use]
    pub fn covering(mechanism: &Mechanism, joints: &[JointId]) -> Vec<Self> {
        let mut trees = vec![SpanningTree::of(mechanism)];
        loop {
            let covered =
                |joint: &JointId| !joints.contains(joint) || trees.iter().any(|tree| tree.cut.contains(joint));
            let (kept, wanted): (Vec<JointId>, Vec<JointId>) = mechanism.joints().ids().partition(covered);
            if wanted.is_empty() {
                return trees;
            }
            let mut tree = SpanningTree::along(mechanism, kept.into_iter().chain(wanted.iter().copied()));
            // `wanted` contains the joints that no tree cuts so far. If the new tree cuts none of these joints either,
            // each joint in `wanted` is the only connection of some links to the ground.
            // An example is a crank on its pin without any second joint. Such joints are then cut, and the links beyond
            // them leave the tree.
            if !tree.cut.iter().any(|joint| wanted.contains(joint)) {
                let mut held = vec![GROUND];
                let (kept, lost): (Vec<TreeBranch>, Vec<TreeBranch>) = tree.branches.into_iter().partition(|branch| {
                    let stays = held.contains(&branch.parent) && !wanted.contains(&branch.joint);
                    held.extend(stays.then_some(branch.link));
                    stays
                });
                tree.branches = kept;
                tree.cut.extend(lost.iter().map(|branch| branch.joint));
                tree.cut.sort_unstable();
            }
            trees.push(tree);
        }
    }

    /// The spanning tree of Kruskal's algorithm: joints are added in the given order, except joints that close a loop.
    fn along(mechanism: &Mechanism, order: impl Iterator<Item = JointId>) -> Self {
        let mut part: Vec<LinkId> = mechanism.links().ids().collect();
        let (mut taken, mut cut) = (Vec::new(), Vec::new());
        for index in order {
            let joint = &mechanism.joints()[index];
            let [first, second] = [part[joint.first.link], part[joint.second.link]];
            if first == second {
                cut.push(index);
            } else {
                taken.push(index);
                part.iter_mut().filter(|part| **part == second).for_each(|part| *part = first);
            }
        }
        cut.sort_unstable();
        let (mut branches, mut reached, mut next) = (Vec::new(), vec![GROUND], 0);
        while let Some(&parent) = reached.get(next) {
            next += 1;
            for &joint in &taken {
                let found = &mechanism.joints()[joint];
                let link = found.other(parent).link;
                if found.on(parent).is_some() && !reached.contains(&link) {
                    branches.push(TreeBranch { link, parent, joint });
                    reached.push(link);
                }
            }
        }
        SpanningTree { branches, cut }
    }

    /// The spanning tree for runs, built breadth first.
    /// Each link is added together with all links that slide on this link, so that only revolute joints are cut.
    pub fn of(mechanism: &Mechanism) -> Self {
        SpanningTree::with(mechanism, &[])
    }

    /// Returns the tree for runs, changed so that it contains the given joints.
    /// Usually, each given joint adds one link to the tree. In two cases the tree is built in another order: both links
    /// of a given joint are in the tree already, or neither link is. Kruskal's algorithm then takes first all given
    /// joints, then all prismatic joints, then the remaining joints.
    /// Both links are in the tree already if prismatic joints connect them, as in an Oldham coupling with its driven
    /// disc.
    /// In the usual order the driven joint would then be cut, although it must be a coordinate of the tree.
    pub fn with(mechanism: &Mechanism, joints: &[JointId]) -> Self {
        let mut tree = SpanningTree { branches: Vec::new(), cut: Vec::new() };
        let mut reached = Vec::new();
        tree.reach(mechanism, GROUND, &mut reached);
        for &joint in joints {
            let [first, second] = [mechanism.joints()[joint].first.link, mechanism.joints()[joint].second.link];
            if tree.branches.iter().any(|branch| branch.joint == joint) {
                continue;
            }
            if reached.contains(&first) == reached.contains(&second) {
                let others = mechanism.joints().ids().filter(|joint| !joints.contains(joint));
                let (sliding, turning): (Vec<JointId>, Vec<JointId>) =
                    others.partition(|&joint| mechanism.joints()[joint].slides());
                return SpanningTree::along(mechanism, joints.iter().copied().chain(sliding).chain(turning));
            }
            let (parent, link) = if reached.contains(&first) { (first, second) } else { (second, first) };
            tree.branches.push(TreeBranch { link, parent, joint });
            tree.reach(mechanism, link, &mut reached);
        }
        let mut next = 0;
        while let Some(&parent) = reached.get(next) {
            next += 1;
            for (joint, found) in mechanism.joints().entries() {
                let link = found.other(parent).link;
                if found.on(parent).is_some() && !reached.contains(&link) {
                    tree.branches.push(TreeBranch { link, parent, joint });
                    tree.reach(mechanism, link, &mut reached);
                }
            }
        }
        tree.cut = mechanism
            .joints()
            .ids()
            .filter(|&joint| tree.branches.iter().all(|branch| branch.joint != joint))
            .collect();
        tree
    }

    /// Adds a link to the tree, and all links that slide on it directly or through other links.
    fn reach(&mut self, mechanism: &Mechanism, parent: LinkId, reached: &mut Vec<LinkId>) {
        reached.push(parent);
        for (joint, found) in mechanism.joints().entries().filter(|(_, found)| found.slides()) {
            let link = found.other(parent).link;
            if found.on(parent).is_some() && !reached.contains(&link) {
                self.branches.push(TreeBranch { link, parent, joint });
                self.reach(mechanism, link, reached);
            }
        }
    }
}

/// Coordinate of a branch's joint in the given poses.
/// The coordinate does not depend on which of the two links is the joint's first link.
/// The coordinate is the angle of the child relative to its parent (rad), or a distance along the parent's axis (m).
/// The distance goes from the joint's point on the parent to the joint's point on the child.
#[must_use]
pub fn coordinate(joint: &Joint, branch: &TreeBranch, poses: &[LinkPose]) -> f64 {
    let [parent, child] = [branch.parent, branch.link].map(|link| poses[link]);
    let on = |link: LinkId| joint.on(link).expect("a branch's joint is on both links");
    match joint.axis_on(branch.parent) {
        None => child.angle - parent.angle,
        Some(axis) => {
            rotated(unit(parent.angle), axis).dot(&(child.point(on(branch.link)) - parent.point(on(branch.parent))))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{class_four, four_bar};
    use crate::math::Vec2;
    use crate::mechanism::JointKind;

    fn numbers(joints: &[JointId]) -> Vec<usize> {
        joints.iter().map(|joint| joint.index()).collect()
    }

    /// Parent and child of every branch.
    fn pairs(tree: &SpanningTree) -> Vec<(usize, usize)> {
        tree.branches.iter().map(|branch| (branch.parent.index(), branch.link.index())).collect()
    }

    #[test]
    fn four_bar_is_cut_once() {
        let tree = SpanningTree::of(&four_bar());
        assert_eq!(numbers(&tree.cut), [2]);
        assert_eq!(pairs(&tree), [(0, 1), (0, 3), (1, 2)]);
    }

    #[test]
    fn every_joint_is_cut_in_one_of_the_covering_trees() {
        let trees = SpanningTree::covering(&four_bar(), &[JointId(0), JointId(1), JointId(2), JointId(3)]);
        // Each tree of the four-bar cuts one of its four joints.
        assert_eq!(trees.iter().map(|tree| numbers(&tree.cut)).collect::<Vec<_>>(), [[2], [3], [1], [0]]);
        let class_four = class_four(1.0, 1.0);
        let trees = SpanningTree::covering(&class_four, &class_four.joints().ids().collect::<Vec<_>>());
        for tree in &trees {
            assert_eq!((tree.branches.len(), tree.cut.len()), (5, 2));
            let mut reached = vec![GROUND];
            for branch in &tree.branches {
                assert!(reached.contains(&branch.parent));
                reached.push(branch.link);
            }
        }
        // Each tree cuts two of the seven joints.
        assert_eq!(trees.len(), 4);
        assert!(class_four.joints().ids().all(|joint| trees.iter().any(|tree| tree.cut.contains(&joint))));
    }

    #[test]
    fn only_requested_joints_need_a_tree() {
        let cuts = |joints: &[usize]| {
            let joints: Vec<JointId> = joints.iter().map(|&joint| JointId(joint)).collect();
            SpanningTree::covering(&four_bar(), &joints).len()
        };
        assert_eq!([cuts(&[]), cuts(&[2]), cuts(&[3]), cuts(&[2, 0])], [1, 1, 2, 2]);
    }

    #[test]
    fn cutting_the_joint_of_a_lone_crank_leaves_no_branch() {
        let four_bar = four_bar();
        let alone =
            Mechanism::new(four_bar.links().to_vec()[..2].to_vec(), four_bar.joints().to_vec()[..1].to_vec()).unwrap();
        let trees = SpanningTree::covering(&alone, &[JointId(0)]);
        assert_eq!(trees.len(), 2);
        assert_eq!((trees[1].branches.len(), numbers(&trees[1].cut)), (0, vec![0]));
    }

    #[test]
    fn a_requested_joint_is_part_of_the_tree() {
        let asked = SpanningTree::with(&four_bar(), &[JointId(3)]);
        assert_eq!((pairs(&asked), numbers(&asked.cut)), (vec![(0, 3), (0, 1), (3, 2)], vec![1]));
        // If the coupler slides on both cranks, the first crank is connected with the second crank by prismatic joints
        // only.
        let kind = JointKind::Prismatic { axes: [Vec2::new(1.0, 0.0); 2] };
        let mut joints = four_bar().joints().to_vec();
        for slide in [1, 2] {
            joints[slide] = Joint { kind, ..joints[slide].clone() };
        }
        let mut links = four_bar().links().to_vec();
        for (link, name) in [(2, "E"), (3, "F")] {
            links[link].points.iter_mut().for_each(|point| point.name += name);
        }
        let mechanism = Mechanism::new(links, joints).unwrap();
        assert_eq!(
            (pairs(&SpanningTree::of(&mechanism)), numbers(&SpanningTree::of(&mechanism).cut)),
            (vec![(0, 1), (1, 2), (2, 3)], vec![3])
        );
        let asked = SpanningTree::with(&mechanism, &[JointId(3)]);
        assert_eq!((pairs(&asked), numbers(&asked.cut)), (vec![(0, 3), (3, 2), (2, 1)], vec![0]));
    }

    #[test]
    fn a_prismatic_joint_stays_in_the_tree() {
        // The tree of the four-bar cuts the joint between coupler and rocker. If this joint is made prismatic, the tree
        // cuts the crank pin instead.
        let kind = JointKind::Prismatic { axes: [Vec2::new(1.0, 0.0); 2] };
        let mut joints = four_bar().joints().to_vec();
        joints[2] = Joint { kind, ..joints[2].clone() };
        let mut links = four_bar().links().to_vec();
        links[3].points[1].name = "D".into();
        let tree = SpanningTree::of(&Mechanism::new(links, joints).unwrap());
        assert_eq!(numbers(&tree.cut), [1]);
        assert_eq!(pairs(&tree), [(0, 1), (0, 3), (3, 2)]);
    }
}
