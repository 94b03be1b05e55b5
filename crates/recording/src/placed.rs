//! A side with the positions of its links, row by row.

use super::shapes::Paint;
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, LinkId, LinkPose, Mechanism};
use linkage::trajectory::{Channel, Trajectory};

/// A side with the positions of its links.
pub struct Placed<'a> {
    /// Name of the side.
    pub name: &'a str,
    /// Its values.
    pub trajectory: &'a Trajectory,
    /// Colour, thickness and height of the side in drawings.
    pub paint: Paint,
    /// Rows in ascending order of time.
    pub(super) rows: Vec<usize>,
    /// Columns for each moving link: angle and coordinates of the mass centre.
    pub(super) links: Vec<[&'a [f64]; 3]>,
}

impl Placed<'_> {
    /// Row of the last sample that is not after `time`, or of the first sample.
    pub fn row_at(&self, time: f64) -> usize {
        let times = self.trajectory.times();
        let after = self.rows.partition_point(|&row| times[row] <= time);
        self.rows[after.max(1) - 1]
    }

    /// Pose of a link's frame, from the mass centre in the trajectory.
    pub fn pose(&self, mechanism: &Mechanism, link: LinkId, row: usize) -> LinkPose {
        if link == GROUND {
            return LinkPose::GROUND;
        }
        let [angle, x, y] = self.links[link.index() - 1].map(|column| column[row]);
        LinkPose::through(mechanism.links()[link].mass_centre, Vec2::new(x, y), angle)
    }
}

/// Column of the channel called `name`, if the trajectory has it.
pub fn column<'a>(trajectory: &'a Trajectory, name: &str) -> Option<&'a [f64]> {
    trajectory.column(&Channel::named(name)?)
}
