//! Guides and the blocks that slide on them, as lines: rails of the ground, lines of moving links, rectangles.

use super::placed::Placed;
use linkage::math::{KeepNan, Vec2, turned};
use linkage::mechanism::{GROUND, Mechanism, Side};

/// Half length and half width of a block, as shares of the mechanism's size: here in a fixed guide, below on a moving
/// guide. They differ so that two blocks on one pin are both visible.
const FIXED: [f64; 2] = [0.055, 0.035];
const MOVING: [f64; 2] = [0.042, 0.022];
/// Distance of a rail from the block beside it, as a share of the mechanism's size: half the line thickness, and a gap.
const PLAY: f64 = 0.015;

/// A guide and its block.
pub struct Guide {
    guide: Side,
    block: Side,
    /// Unit vectors along the guide, in the frame of its link and in that of the block.
    axes: [Vec2; 2],
    /// Least and largest distance of the block's place from the guide's place along the axis (m), over all sides.
    ways: [f64; 2],
    /// Half length and half width of the block (m).
    half: [f64; 2],
    play: f64,
}

/// A line of a link's picture, in its frame.
pub struct Strip {
    /// Its points (m).
    pub points: Vec<Vec2>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
}

impl Guide {
    /// All guides of a mechanism of this size (m), as long as the travel of their blocks in all sides.
    pub fn all(mechanism: &Mechanism, sides: &[Placed], size: f64) -> Vec<Guide> {
        let guide = |joint| {
            let [guide, block] = mechanism.guide_and_block(joint)?;
            let axes = [joint.axis_on(guide.link)?, joint.axis_on(block.link)?];
            let way = |(side, row): (&Placed, usize)| {
                let [at, on] = [guide, block].map(|part| side.pose(mechanism, part.link, row).point(part.local));
                let axis = side.pose(mechanism, guide.link, row).point(guide.local + axes[0]) - at;
                (on - at).dot(&axis)
            };
            let rows = sides.iter().flat_map(|side| (0..side.trajectory.times().len()).map(move |row| (side, row)));
            let ways =
                rows.map(way).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], way| [l.smaller(way), h.larger(way)]);
            let half = if guide.link == GROUND { FIXED } else { MOVING }.map(|part| part * size);
            Some(Guide { guide, block, axes, ways, half, play: PLAY * size })
        };
        mechanism.joints().iter().filter_map(guide).collect()
    }

    /// The parts of this guide that belong to a link: its line or rails, the block's outline, or nothing.
    pub fn strips(&self, link: usize) -> Vec<Strip> {
        let [long, wide] = self.half;
        let mut strips = Vec::new();
        if link == self.guide.link {
            let (from, to) = (self.ways[0] - long, self.ways[1] + long);
            // The line of a moving guide begins at the guide's place on the link, wherever the block is.
            let (from, to) = if link == GROUND { (from, to) } else { (from.smaller(0.0), to.larger(0.0)) };
            let ends = [from, to].map(|way| self.guide.local + self.axes[0] * way);
            let aside = turned(self.axes[0]) * (wide + self.play);
            let rails = if link == GROUND { vec![aside, -aside] } else { vec![Vec2::zeros()] };
            strips.extend(
                rails.into_iter().map(|side| Strip { points: ends.map(|end| end + side).to_vec(), closed: false }),
            );
        }
        if link == self.block.link {
            let (along, aside) = (self.axes[1] * long, turned(self.axes[1]) * wide);
            let corners = [along + aside, aside - along, -along - aside, along - aside];
            strips.push(Strip { points: corners.map(|corner| self.block.local + corner).to_vec(), closed: true });
        }
        strips
    }
}
