//! The crank angles over which a mechanism can be followed on its branch, with their limits and the condition numbers
//! of the groups.
//!
//! The crank is not driven. The curve of all poses is followed by arc length, in both directions from the start pose.
//! In each direction, the curve ends where the start pose is reached again, or at a singular pose.
//! At a *limit of rotation* (dead point of the crank) the determinant of one group is zero.
//! Two branches meet at the limit and form one smooth curve, along which the crank reverses.
//! At a *change point* two curves of poses cross.
//! The group's determinant changes its sign at the change point, and the crank does not reverse.
//! Geometry does not decide which of the two curves the mechanism follows beyond the change point.

mod constraints;
mod extremes;
mod gearing;
mod grashof;
mod measure;
mod singularity;
mod tracking;

use crate::sentences;
pub use extremes::{ExtremePosition, LinkRange};
pub use grashof::{FourBar, FourBarType};
pub use measure::GroupCondition;
pub use singularity::{Singularity, SingularityKind, ValueAtCrank};

use constraints::{Constraints, Given};
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::Vec2;
use linkage::mechanism::{Group, GroupId, Mechanism, PerGroup, Pose};
use linkage::work::limited;
use tracking::{End, Point, Tracker};

/// A minimum of the determinant's magnitude below this value, but above zero, is reported as
/// [`SingularityKind::BranchContact`].
/// The value corresponds to a transmission angle of 0.06 deg, at which accelerations have lost six digits.
const CONTACT: f64 = 1e-3;
/// If a group's determinant is smaller than this value, the pose counts as singular.
/// Rounding separates coinciding configurations by the square root of the rounding error, 1e-8 to 1e-7.
/// The limit is therefore larger than this separation.
const SINGULAR: f64 = 1e-6;

/// Work allowed for finding the reachable crank angles as a by-product, for example for an error message.
/// This work is counted in the unit of work budgets, and is a twentieth of the work allowed for a proof.
pub const ASIDE: f64 = 1e6;

/// Crank angles over which a mechanism can be followed on its branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// All crank angles.
    /// The mechanism returns to its first pose after this number of turns (one, except with some higher groups).
    FullTurn(i32),
    /// Crank angles between two singular poses; the start pose lies between the two. The range may exceed one turn.
    Limited([Singularity; 2]),
}

/// Smallest determinant and largest condition number of one group over the range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroupRange {
    /// The normalised determinant where its magnitude is smallest. The value keeps its sign.
    pub determinant: ValueAtCrank,
    /// Largest condition number. `None` if the group is singular at a limit, where its condition number grows without
    /// bound.
    pub condition: Option<ValueAtCrank>,
}

/// The measures of all groups at one pose.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupMeasures {
    /// Crank angle (rad, in the scenario's convention).
    pub crank: f64,
    /// Determinant and condition number of each group, in the order of the structure.
    /// The determinant of a dyad with two modes is positive in the modes
    /// [`AssemblyMode::Left`](linkage::mechanism::AssemblyMode::Left) and
    /// [`AssemblyMode::Ahead`](linkage::mechanism::AssemblyMode::Ahead).
    /// The determinant of a higher group is positive at the start.
    pub groups: Vec<GroupCondition>,
}

/// The range of motion of a mechanism on its branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// Crank angles that can be reached.
    pub extent: Extent,
    /// Limits, change points and contacts, in ascending order of the crank angle.
    pub singularities: Vec<Singularity>,
    /// Smallest determinant and largest condition number of each group.
    pub groups: PerGroup<GroupRange>,
    /// The range of every moving link.
    pub links: Vec<LinkRange>,
    /// Measures of all groups in ascending order of the crank angle.
    /// The samples are at most two degrees apart and do not include the limits.
    pub samples: Vec<GroupMeasures>,
    /// Grashof's type, if the mechanism is a four-bar.
    pub four_bar: Option<FourBar>,
}

impl Range {
    /// Follows the mechanism of a case over all crank angles that its branch reaches.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if the start pose is singular.
    /// [`ErrorKind::Numeric`] if the branch cannot be followed.
    /// [`ErrorKind::Unsupported`] if following the branch takes more work than [`limited`] allows, if the mechanism
    /// does not return to its first pose, if a driven slide has no limit, or if one of several drives changes its
    /// speed.
    pub fn of(case: &Case) -> Result<Self> {
        let (tracker, start) = Tracker::new(case)?;
        let (points, extent) = both_ways(&tracker, &start)?;
        let closed = matches!(extent, Extent::FullTurn(_));
        let inside = if closed { &points[..points.len() - 1] } else { &points[1..points.len() - 1] };
        let samples: Vec<GroupMeasures> = inside
            .iter()
            .map(|point| GroupMeasures { crank: tracker.crank_of(&point.q), groups: point.measures.clone() })
            .collect();
        let contacts = extremes::contacts(&tracker, &points, closed, CONTACT);
        let mut singularities: Vec<Singularity> = match extent {
            Extent::FullTurn(_) => contacts,
            Extent::Limited([from, to]) => [from].into_iter().chain(contacts).chain([to]).collect(),
        };
        singularities.sort_by(|a, b| a.crank.total_cmp(&b.crank));
        let groups = case.structure.groups.ids().map(|group| worst(&tracker, &points, extent, group)).collect();
        let links = extremes::links(&tracker, &points, closed, case.mechanism.links().len());
        tracker.allowed(Ok(Range { extent, singularities, groups, links, samples, four_bar: FourBar::of(case) }))
    }
}

/// Crank angles that the branch of a case reaches.
/// [`Range::of`] also computes these angles, before its other results.
///
/// # Errors
/// The errors of [`Range::of`].
pub fn reachable(case: &Case) -> Result<Extent> {
    let (tracker, start) = Tracker::new(case)?;
    Ok(both_ways(&tracker, &start)?.1)
}

/// Adds the reachable crank angles of a case to an error that a solver returned for this case.
/// This function is for code that combines solvers and range analysis.
/// The angles are added to the message if the error [reports a pose out of reach](Error::is_out_of_reach) and the crank
/// cannot turn fully.
/// If the crank angles are unknown because the start pose is singular or the allowed work is used up, this reason is
/// added instead.
/// An error that does not report a pose out of reach stays unchanged.
/// The solvers do not call this function themselves, because then both sides would depend on the same range analysis.
pub fn explained(case: &Case, error: Error) -> Error {
    if !error.is_out_of_reach() {
        return error;
    }
    let input = case.crank().input;
    let (reached, is_too_much) = limited(ASIDE, || reachable(case));
    let reached = match reached {
        Ok(Extent::Limited(limits)) => sentences::inputs_can_be_reached(&input.noun(), &interval(limits, input)),
        Ok(Extent::FullTurn(_)) => String::new(),
        Err(why) if why.kind() == ErrorKind::Geometry => format!("; {}", why.message()),
        Err(why) if is_too_much => sentences::which_inputs_can_be_reached(&input.noun(), &why.message()),
        Err(_) => String::new(),
    };
    error.map_message(|message| format!("{message}{reached}")).explained()
}

/// Returns `from X to Y deg on this branch`. The numbers are rounded inwards to 1e-6 deg or mm, so that the user can
/// request them.
fn interval([from, to]: [Singularity; 2], input: Input) -> String {
    // If a value is within 1e-9 deg or mm of a printable number, it counts as that number.
    let from = (input.shown(from.crank) * 1e6 - 1e-3).ceil() / 1e6 + 0.0;
    let to = (input.shown(to.crank) * 1e6 + 1e-3).floor() / 1e6 + 0.0;
    sentences::from_to_on_this_branch(&from, &to, &input.shown_in().0)
}

/// Whether two configurations of a group coincide in this pose within rounding error.
/// Velocities are undetermined in such a pose.
#[must_use]
pub fn is_singular(mechanism: &Mechanism, group: &Group, pose: &Pose) -> bool {
    let given = group.given.iter().map(|&joint| Given(joint)).collect();
    let constraints = Constraints::of(mechanism, Vec2::zeros(), given);
    let jacobian = constraints.at(&constraints.coordinates_of(pose)).jacobian;
    !(measure::of(&constraints.block(&jacobian, group), mechanism, group, pose).determinant.abs() > SINGULAR)
}

/// Condition number of every group at a pose, in order of solution.
/// Errors of position propagate from each group to the groups that it carries.
/// The error of a link grows with the product of the condition numbers of its group and the groups before it.
#[must_use]
pub fn conditions(mechanism: &Mechanism, groups: &[Group], pose: &Pose) -> Vec<f64> {
    let given = groups.iter().flat_map(|group| &group.given).map(|&joint| Given(joint)).collect();
    let constraints = Constraints::of(mechanism, Vec2::zeros(), given);
    let jacobian = constraints.at(&constraints.coordinates_of(pose)).jacobian;
    let of = |group| measure::of(&constraints.block(&jacobian, group), mechanism, group, pose).condition;
    groups.iter().map(of).collect()
}

/// Follows the curve from `start` in both directions.
/// Returns its poses in ascending order of the crank angle, and the crank angles that can be reached.
fn both_ways(tracker: &Tracker, start: &Point) -> Result<(Vec<Point>, Extent)> {
    let forwards = tracker.follow(start, 1.0)?;
    let to = match forwards.end {
        End::Closed(turns) => return Ok((forwards.points, Extent::FullTurn(turns))),
        End::Limit(to) => to,
    };
    let backwards = tracker.follow(start, -1.0)?;
    let End::Limit(from) = backwards.end else { return Err(tracker.lost(&start.q)) };
    let turned = |mut point: Point| {
        point.tangent.neg_mut();
        point
    };
    let points = backwards.points.into_iter().rev().map(turned).chain(forwards.points.into_iter().skip(1));
    Ok((points.collect(), Extent::Limited([from, to])))
}

fn worst(tracker: &Tracker, points: &[Point], extent: Extent, group: GroupId) -> GroupRange {
    let limits = match extent {
        Extent::FullTurn(_) => None,
        Extent::Limited(limits) => limits.into_iter().find(|limit| limit.group == group),
    };
    if let Some(limit) = limits {
        return GroupRange { determinant: ValueAtCrank { crank: limit.crank, value: 0.0 }, condition: None };
    }
    let closed = matches!(extent, Extent::FullTurn(_));
    let least = |f: &dyn Fn(&Point) -> f64| extremes::least(tracker, points, closed, f);
    let flattest = least(&|point| point.measures[group].determinant.abs());
    let stiffest = least(&|point| 1.0 / point.measures[group].condition);
    let at = |point: &Point, value: f64| ValueAtCrank { crank: tracker.crank_of(&point.q), value };
    GroupRange {
        determinant: at(&flattest, flattest.measures[group].determinant),
        condition: Some(at(&stiffest, stiffest.measures[group].condition)),
    }
}
