//! Positions and motions of the links of a mechanism, row by row, and the area that the motion covers.

use super::thinned::ends;
use linkage::case::Case;
use linkage::math::{KeepNan, Motion, Vec2, unit as direction};
use linkage::mechanism::{GROUND, LinkId, LinkPose, Mechanism};
use linkage::solver::State;
use linkage::trajectory::{Channel, Trajectory};

/// A mechanism with the positions of all its links.
pub(super) struct Placed<'a> {
    pub(super) mechanism: &'a Mechanism,
    /// Columns of each moving link: angle and coordinates of the mass centre.
    links: Vec<[&'a [f64]; 3]>,
    /// First and second derivatives of the columns in `links`; a derivative is present only if all links have it.
    rates: Vec<Vec<[&'a [f64]; 3]>>,
}

/// Channels of a link's angle and mass centre, and of their first and second derivatives.
const SUFFIXES: [[&str; 3]; 3] =
    [["angle_rad", "x_m", "y_m"], ["omega_rad_s", "vx_m_s", "vy_m_s"], ["alpha_rad_s2", "ax_m_s2", "ay_m_s2"]];

impl<'a> Placed<'a> {
    /// The mechanism with the positions of all its links in a trajectory.
    /// `None` if the channels lack the position of a link, or if the grid has no instant.
    pub(super) fn of(mechanism: &'a Mechanism, trajectory: &'a Trajectory) -> Option<Self> {
        let columns = |suffixes: [&str; 3]| -> Option<Vec<[&'a [f64]; 3]>> {
            let of_link = |name: &str| {
                let column = |suffix| trajectory.column(&Channel::named(&format!("link.{name}.{suffix}"))?);
                let [angle, x, y] = suffixes.map(column);
                Some([angle?, x?, y?])
            };
            mechanism.links()[1..].iter().map(|link| of_link(&link.name)).collect()
        };
        let links = columns(SUFFIXES[0])?;
        let rates = SUFFIXES[1..].iter().map_while(|suffixes| columns(*suffixes)).collect();
        (!trajectory.times().is_empty()).then_some(Placed { mechanism, links, rates })
    }

    /// Whether the velocities of all links are known; if `accelerations` is true, the accelerations must be known too.
    pub(super) fn knows(&self, accelerations: bool) -> bool {
        self.rates.len() > usize::from(accelerations)
    }

    /// The state in a row: positions, velocities and accelerations; unknown rates are 0.
    pub(super) fn state(&self, case: &Case, row: usize) -> State {
        let mut state = State::at_rest(case);
        for (number, link) in self.mechanism.links().entries().skip(1) {
            let of = |columns: &[&[f64]; 3]| columns.map(|column| column[row]);
            let rates = |order: usize| self.rates.get(order).map_or([0.0; 3], |own| of(&own[number.index() - 1]));
            let [angle, x, y] = of(&self.links[number.index() - 1]);
            let [[omega, vx, vy], [alpha, ax, ay]] = [rates(0), rates(1)];
            let centre = [Vec2::new(x, y), Vec2::new(vx, vy), Vec2::new(ax, ay)];
            state.angles[number] = angle;
            state.motions[number] = Motion::of_point(link.mass_centre, centre, direction(angle), omega, alpha);
        }
        state
    }

    /// World position (m) of a point of a link.
    pub(super) fn point(&self, row: usize, link: LinkId, local: Vec2) -> Vec2 {
        self.pose(row, link).point(local)
    }

    /// Pose of a link's frame.
    pub(super) fn pose(&self, row: usize, link: LinkId) -> LinkPose {
        if link == GROUND {
            return LinkPose::GROUND;
        }
        let [angle, x, y] = self.links[link.index() - 1].map(|column| column[row]);
        LinkPose::through(self.mechanism.links()[link].mass_centre, Vec2::new(x, y), angle)
    }

    /// Smallest and largest coordinates (m) of all points and joints over these rows: along x, along y.
    pub(super) fn room(&self, rows: &[usize]) -> [[f64; 2]; 2] {
        let links = self.mechanism.links().entries();
        let points = links.flat_map(|(link, own)| own.points.iter().map(move |point| (link, point.local)));
        let joints = self.mechanism.joints().iter().flat_map(|own| [own.first, own.second]);
        let all: Vec<(LinkId, Vec2)> = points.chain(joints.map(|side| (side.link, side.local))).collect();
        let places = || rows.iter().flat_map(|&row| all.iter().map(move |&(link, at)| self.point(row, link, at)));
        [ends(places().map(|at| at.x)), ends(places().map(|at| at.y))]
    }
}

/// The length (m) of a unit in a picture of this area: the area is at most 120 units wide and 84 high.
pub(super) fn unit(mechanism: &Mechanism, [x, y]: [[f64; 2]; 2]) -> f64 {
    let unit = ((x[1] - x[0]) / 120.0).larger((y[1] - y[0]) / 84.0);
    if unit > 0.0 { unit } else { drawing::unit(mechanism) }
}
