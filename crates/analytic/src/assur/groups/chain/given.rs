//! Joints of a group whose coordinates are given.

use super::contour::Node;
use linkage::input::Input;
use linkage::mechanism::{DrivingLink, Mechanism};

/// A joint with a given coordinate, between a node and its parent.
#[derive(Clone, Copy, Debug)]
pub(in crate::assur) struct Given {
    pub(in crate::assur) node: usize,
    /// Number of the drive.
    pub(in crate::assur) drive: usize,
    /// `sign` is +1 if the node is the joint's second link, and -1 if it is the first. `factor` is `sign` divided by
    /// the unit of the node's unknown.
    pub(in crate::assur) sign: f64,
    pub(in crate::assur) factor: f64,
    pub(in crate::assur) is_slide: bool,
    /// The node that has the parent's angle as its unknown.
    pub(super) parent_spin: Option<usize>,
}

impl Given {
    /// The given coordinates of a group's joints; `size` is the unit of slides (m).
    pub(super) fn all(mechanism: &Mechanism, nodes: &[Node], drivers: &[DrivingLink], size: f64) -> Vec<Self> {
        let of = |(drive, driver): (usize, &DrivingLink)| {
            let node = nodes.iter().position(|node| node.joint == driver.joint)?;
            let sign = if mechanism.joints()[driver.joint].second.link == nodes[node].link { 1.0 } else { -1.0 };
            let is_slide = driver.input == Input::Slide;
            let factor = if is_slide { sign / size } else { sign };
            let parent_spin = nodes[node].parent_node.and_then(|parent| nodes[parent].spin);
            Some(Given { node, drive, sign, factor, is_slide, parent_spin })
        };
        drivers.iter().enumerate().filter(|(_, driver)| driver.in_group).filter_map(of).collect()
    }
}
