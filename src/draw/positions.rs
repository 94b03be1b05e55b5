//! Several positions of a mechanism, and enlarged paths.

use super::motion::Course;
use super::points::{NamedPoint, RequestedPoints};
use crate::sentences;
use drawing::picture::{LinkPlacement, short};
use drawing::positions::{NumberedPath, Series, enlarged, ratio};
use drawing::sheet::SheetCell;
use linkage::case::Case;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{JointSide, LinkPose, Mechanism};
use linkage::solver::State;

/// The path of a point is drawn only if it is larger than this fraction of the mechanism's size.
const STILL: f64 = 1e-9;

/// Several positions for the picture of the mechanism, and enlarged paths for separate cells.
#[derive(Default)]
pub(super) struct DrawnPositions {
    /// The positions with thin lines, and the paths; `None` if a single position is drawn.
    pub(super) series: Option<Series>,
    /// Lines of text that state the positions.
    pub(super) heading: Vec<String>,
    enlarged: Vec<NumberedPath>,
}

impl DrawnPositions {
    /// The positions of the motion `course`. The position `shown` is drawn with full lines, and may differ from all
    /// positions of `course`.
    pub(super) fn of(case: &Case, course: &Course, shown: &State, points: RequestedPoints, is_series: bool) -> Self {
        let mechanism = &case.mechanism;
        let path = |point: NamedPoint| {
            let at = |state: &State| state.motions[point.side.link].point(point.side.local);
            NumberedPath {
                path: course.states.iter().map(at).collect(),
                places: course.rows.iter().map(|&row| at(&course.states[row])).collect(),
                link: point.side.link,
                name: point.name,
            }
        };
        let enlarged = points.enlarged.into_iter().map(path).collect();
        let told = course.told(case);
        if !is_series {
            return DrawnPositions { series: None, heading: Vec::new(), enlarged };
        }
        let mut traced = cranks(case);
        traced.extend(points.traced);
        // The path of a crank pin that is also requested by name is drawn once.
        let mut all: Vec<NamedPoint> = Vec::new();
        for point in traced {
            all.retain(|own| own.side != point.side);
            all.push(point);
        }
        let moves = |own: &NumberedPath| own.size().norm() > STILL * mechanism.size();
        let paths: Vec<NumberedPath> = all.into_iter().map(path).filter(moves).collect();
        let placed = |state: &State| poses(state).into_iter().map(LinkPlacement::Here).collect::<Vec<_>>();
        let shown = placed(shown);
        let places: Vec<Vec<LinkPlacement>> = course.rows.iter().map(|&row| placed(&course.states[row])).collect();
        let whole = places.iter().position(|own| is_same_pose(mechanism, own, &shown));
        let thin = places.into_iter().enumerate().filter(|(k, _)| Some(*k) != whole);
        let thin = thin.map(|(k, places)| (places, sentences::position_number(&k))).collect();
        let whole = whole.map(|k| sentences::position_drawn_fully(&k));
        let heading = std::iter::once(told).chain(whole).collect();
        DrawnPositions { series: Some(Series { thin, paths }), heading, enlarged }
    }

    /// Number of enlarged paths.
    pub(super) fn count(&self) -> usize {
        self.enlarged.len()
    }

    /// The scale of the picture in words; `None` if no path is drawn enlarged.
    pub(super) fn scale(&self, cell: &SheetCell) -> Option<String> {
        (!self.enlarged.is_empty()).then(|| sentences::the_scale_is(&ratio(cell.scale)))
    }

    /// The cells of the enlarged paths; `room` is their size (mm).
    pub(super) fn cells(&self, room: Vec2) -> impl Iterator<Item = SheetCell> {
        self.enlarged.iter().map(move |own| {
            let mut cell = enlarged(own, room);
            let [wide, high] = [own.size().x, own.size().y].map(|size| short(size * 1e3));
            cell.heading.push(sentences::path_of_a_point(&own.name, &ratio(cell.scale)));
            cell.heading.push(sentences::wide_and_high(&wide, &high));
            cell
        })
    }
}

impl Course {
    /// The number of the positions, the distance between them, and the first position, in words.
    fn told(&self, case: &Case) -> String {
        let input = case.crank().input;
        let (apart, from) = match self.is_timed {
            true => (format!("{} s", short(self.apart)), format!("{} s", short(self.from))),
            false => (format!("{}{}", short(input.shown(self.apart.abs())), input.sign()), input.marked(self.from)),
        };
        sentences::positions_apart(&self.rows.len(), &apart, &from)
    }
}

/// For each driving link outside groups, the point of this link that is farthest from the driven joint.
fn cranks(case: &Case) -> Vec<NamedPoint> {
    let mechanism = &case.mechanism;
    let of = |(_, driver): (usize, &linkage::mechanism::DrivingLink)| {
        let (link, pivot) = (driver.link, mechanism.joints()[driver.joint].on(driver.link)?);
        let joints = mechanism.joints_on(link).iter().filter_map(|&joint| mechanism.joints()[joint].on(link));
        let places = mechanism.links()[link].points.iter().map(|point| point.local).chain(joints);
        let local = places.max_by(|a, b| (a - pivot).norm().total_cmp(&(b - pivot).norm()))?;
        let name = mechanism.links()[link].points.iter().find(|point| point.local == local);
        let name = name.map_or(&mechanism.links()[link].name, |point| &point.name).clone();
        Some(NamedPoint { name, side: JointSide { link, local } })
    };
    case.structure.leading().filter_map(of).collect()
}

/// The poses of all links in a state.
pub(super) fn poses(state: &State) -> Vec<LinkPose> {
    let pose = |(motion, &angle): (&linkage::math::Motion, &f64)| LinkPose { origin: motion.origin, angle };
    state.motions.iter().zip(&state.angles).map(pose).collect()
}

/// Whether two lists of placements are equal for all links, except for rounding errors.
pub(super) fn is_same_pose(mechanism: &Mechanism, one: &[LinkPlacement], other: &[LinkPlacement]) -> bool {
    let size = mechanism.size();
    one.iter().zip(other).all(|(a, b)| match (a.pose(), b.pose()) {
        (Some(a), Some(b)) => {
            let turn = ((a.angle - b.angle) / 2.0).sin().abs();
            ((a.origin - b.origin).norm() / size).larger(turn) < 1e-6
        }
        _ => false,
    })
}
