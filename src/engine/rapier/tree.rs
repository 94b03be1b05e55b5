//! Spanning tree of a linkage: which joint carries which link, and which joints are cut.

use crate::mechanism::{GROUND, Mechanism};

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

/// Spanning tree from the ground, breadth first, and the joints left over, which close the loops.
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
        let mut reached = vec![GROUND];
        let mut tree = Tree { branches: Vec::new(), cut: Vec::new() };
        let mut next = 0;
        while let Some(&parent) = reached.get(next) {
            next += 1;
            for (joint, found) in mechanism.joints().iter().enumerate() {
                let link = found.other(parent).link;
                if found.on(parent).is_some() && !reached.contains(&link) {
                    reached.push(link);
                    tree.branches.push(Branch { link, parent, joint });
                }
            }
        }
        tree.cut = (0..mechanism.joints().len())
            .filter(|&joint| tree.branches.iter().all(|branch| branch.joint != joint))
            .collect();
        tree
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::fixtures::four_bar;

    #[test]
    fn four_bar_is_cut_once() {
        let tree = Tree::of(&four_bar());
        assert_eq!(tree.cut, [2]);
        assert_eq!(tree.branches.iter().map(|b| (b.parent, b.link)).collect::<Vec<_>>(), [(0, 1), (0, 3), (1, 2)]);
    }
}
