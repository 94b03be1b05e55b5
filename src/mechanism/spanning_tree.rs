//! Spanning tree of a linkage: which joint carries which link, and which joints are cut.
//!
//! Prismatic joints are never cut: they close no loop by themselves (structural analysis refuses that), so all of them fit into
//! the tree, where they hold exactly. As cuts they work too, in Rapier with order 2. Largest error over the half range in any channel at a
//! step of 1e-3 s, with prismatic joints kept and with the innermost joint cut whatever its kind: slider-crank 1.4e-4 and 2.0e-4,
//! swinging guide 8.3e-4 and 1.2e-3, Scotch yoke 7.8e-5 and 6.5e-5, a crank with a slot 1.9e-3 and an Oldham coupling 9.0e-5 both ways.

use super::{GROUND, Mechanism};

/// A link hung on its parent by a joint of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Branch {
    /// The link.
    pub link: usize,
    /// The link it hangs on, nearer to the ground.
    pub parent: usize,
    /// The joint between the two.
    pub joint: usize,
}

/// Spanning tree from the ground, breadth first with all that slides on a link taken along with it, and the joints left over,
/// which close the loops: revolute ones.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tree {
    /// Branches; a parent always comes before its children.
    pub branches: Vec<Branch>,
    /// Joints that close loops.
    pub cut: Vec<usize>,
}

impl Tree {
    /// The spanning tree of a connected mechanism.
    #[must_use]
    pub fn of(mechanism: &Mechanism) -> Self {
        Tree::with(mechanism, &[])
    }

    /// The same with the given joints of the ground in it, whatever else could reach their links: in an Oldham coupling the driven
    /// disc is reached by sliding alone, and a drive that is to be a coordinate of the tree would be cut.
    #[must_use]
    pub fn with(mechanism: &Mechanism, joints: &[usize]) -> Self {
        let mut tree = Tree { branches: Vec::new(), cut: Vec::new() };
        let mut reached = Vec::new();
        tree.reach(mechanism, GROUND, &mut reached);
        for &joint in joints {
            let link = mechanism.joints()[joint].other(GROUND).link;
            tree.branches.push(Branch { link, parent: GROUND, joint });
            tree.reach(mechanism, link, &mut reached);
        }
        let mut next = 0;
        while let Some(&parent) = reached.get(next) {
            next += 1;
            for (joint, found) in mechanism.joints().iter().enumerate() {
                let link = found.other(parent).link;
                if found.on(parent).is_some() && !reached.contains(&link) {
                    tree.branches.push(Branch { link, parent, joint });
                    tree.reach(mechanism, link, &mut reached);
                }
            }
        }
        tree.cut = (0..mechanism.joints().len())
            .filter(|&joint| tree.branches.iter().all(|branch| branch.joint != joint))
            .collect();
        tree
    }

    /// Takes a link and all that slides on it.
    fn reach(&mut self, mechanism: &Mechanism, parent: usize, reached: &mut Vec<usize>) {
        reached.push(parent);
        for (joint, found) in mechanism.joints().iter().enumerate().filter(|(_, found)| found.is_prismatic()) {
            let link = found.other(parent).link;
            if found.on(parent).is_some() && !reached.contains(&link) {
                self.branches.push(Branch { link, parent, joint });
                self.reach(mechanism, link, reached);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec2;
    use crate::mechanism::fixtures::four_bar;
    use crate::mechanism::{Joint, JointKind};

    #[test]
    fn four_bar_is_cut_once() {
        let tree = Tree::of(&four_bar());
        assert_eq!(tree.cut, [2]);
        assert_eq!(tree.branches.iter().map(|b| (b.parent, b.link)).collect::<Vec<_>>(), [(0, 1), (0, 3), (1, 2)]);
    }

    #[test]
    fn a_joint_can_be_asked_for() {
        let pairs = |tree: &Tree| tree.branches.iter().map(|b| (b.parent, b.link)).collect::<Vec<_>>();
        let asked = Tree::with(&four_bar(), &[3]);
        assert_eq!((pairs(&asked), asked.cut), (vec![(0, 3), (0, 1), (3, 2)], vec![1]));
        // With the coupler sliding on both cranks, the second would be reached by sliding alone.
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
        assert_eq!((pairs(&Tree::of(&mechanism)), Tree::of(&mechanism).cut), (vec![(0, 1), (1, 2), (2, 3)], vec![3]));
        let asked = Tree::with(&mechanism, &[3]);
        assert_eq!((pairs(&asked), asked.cut), (vec![(0, 3), (3, 2), (2, 1)], vec![0]));
    }

    #[test]
    fn what_slides_on_a_link_hangs_on_it() {
        // The joint that the four-bar is cut at made a prismatic one: the coupler slides on the rocker, the cut is the crank pin.
        let kind = JointKind::Prismatic { axes: [Vec2::new(1.0, 0.0); 2] };
        let mut joints = four_bar().joints().to_vec();
        joints[2] = Joint { kind, ..joints[2].clone() };
        let mut links = four_bar().links().to_vec();
        links[3].points[1].name = "D".into();
        let tree = Tree::of(&Mechanism::new(links, joints).unwrap());
        assert_eq!(tree.cut, [1]);
        assert_eq!(tree.branches.iter().map(|b| (b.parent, b.link)).collect::<Vec<_>>(), [(0, 1), (0, 3), (3, 2)]);
    }
}
