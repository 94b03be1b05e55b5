//! Where the links of a mechanism are, row by row, and the room that the motion takes.

use super::thinned::ends;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{GROUND, LinkPose, Mechanism};
use linkage::trajectory::{Channel, Trajectory};

/// A mechanism with the places of all its links.
pub(super) struct Placed<'a> {
    pub(super) mechanism: &'a Mechanism,
    /// Columns of each moving link: angle and coordinates of the mass centre.
    links: Vec<[&'a [f64]; 3]>,
}

impl<'a> Placed<'a> {
    /// `None` if the position of a link is not among the channels, or if there is no instant.
    pub(super) fn of(mechanism: &'a Mechanism, trajectory: &'a Trajectory) -> Option<Self> {
        let columns = |name: &str| {
            let column = |suffix| trajectory.column(&Channel::named(&format!("link.{name}.{suffix}"))?);
            Some([column("angle_rad")?, column("x_m")?, column("y_m")?])
        };
        let links = mechanism.links()[1..].iter().map(|link| columns(&link.name)).collect::<Option<_>>()?;
        (!trajectory.times().is_empty()).then_some(Placed { mechanism, links })
    }

    /// World place (m) of a point of a link.
    pub(super) fn point(&self, row: usize, link: usize, local: Vec2) -> Vec2 {
        self.pose(row, link).point(local)
    }

    /// Pose of a link's frame.
    pub(super) fn pose(&self, row: usize, link: usize) -> LinkPose {
        if link == GROUND {
            return LinkPose::GROUND;
        }
        let [angle, x, y] = self.links[link - 1].map(|column| column[row]);
        LinkPose::through(self.mechanism.links()[link].mass_centre, Vec2::new(x, y), angle)
    }

    /// Least and greatest coordinates (m) of all points and joints over these rows: along x, along y.
    pub(super) fn room(&self, rows: &[usize]) -> [[f64; 2]; 2] {
        let links = self.mechanism.links().iter().enumerate();
        let points = links.flat_map(|(link, own)| own.points.iter().map(move |point| (link, point.local)));
        let joints = self.mechanism.joints().iter().flat_map(|own| [own.first, own.second]);
        let all: Vec<(usize, Vec2)> = points.chain(joints.map(|side| (side.link, side.local))).collect();
        let places = || rows.iter().flat_map(|&row| all.iter().map(move |&(link, at)| self.point(row, link, at)));
        [ends(places().map(|at| at.x)), ends(places().map(|at| at.y))]
    }
}

/// The length (m) of a unit in a picture of this room: it is at most 120 units wide and 84 high.
pub(super) fn unit(mechanism: &Mechanism, [x, y]: [[f64; 2]; 2]) -> f64 {
    let unit = ((x[1] - x[0]) / 120.0).larger((y[1] - y[0]) / 84.0);
    if unit > 0.0 { unit } else { drawing::unit(mechanism) }
}
