//! The curve of all poses of a mechanism, followed by arc length (pseudo-arclength continuation; Allgower and Georg,
//! "Numerical continuation methods", 1990, chapters 2 to 4 and 8).
//!
//! With the arc length as parameter, a limit of rotation is a regular point: the crank's component of the tangent has a
//! simple zero.
//! As a function of the crank angle, the pose behaves like a square root at a limit of rotation.
//! Where branches cross, the rank of the equations drops.
//! The smallest singular value of the Jacobian is a lower bound on the distance to another branch.
//! Steps are kept smaller than this singular value, so that no step jumps to another branch.

use crate::sentences;
use std::cell::{OnceCell, RefCell};
use std::f64::consts::TAU;

use super::constraints::{Constraints, Given};
use super::gearing::gearings;
use super::measure::{self, GroupCondition};
use super::singularity::{Singularity, SingularityKind};
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::{Input, InputValue};
use linkage::math::dense::Lu;
use linkage::math::root::{self, Close};
use linkage::math::{ColumnVector, KeepNan, Matrix, unit};
use linkage::mechanism::{GroupId, LinkId};
use linkage::work;

/// Longest step along the curve. If only the crank turns, the longest step is two degrees.
const LONGEST: f64 = std::f64::consts::PI / 90.0;
/// Largest number of inverse iterations for the smallest singular value, and the relative change that ends them.
const MOST_ITERATIONS: usize = 60;
const SETTLED: f64 = 1e-3;
/// Largest ratio of a step to the smallest singular value.
/// In units of the mechanism's size, the derivatives of the equations are at most of order one.
/// Another branch is therefore farther away than a step with this ratio.
const SAFE: f64 = 0.5;
/// Smallest accepted cosine of the angle between the tangents of neighbouring poses. This cosine allows an angle of
/// 0.25 rad.
const STRAIGHT: f64 = 0.969;
/// Two branches count as meeting if their distance is below this value (in units of the mechanism's size and rad).
/// Rounding separates crossing branches by about 1e-8, the square root of the rounding error of lengths.
const MEET: f64 = 1e-6;
/// Shortest step. If even this step is too long, two branches count as meeting.
const SHORTEST: f64 = 1e-9;
/// Largest number of steps of the search for a zero along the curve; about eight are needed.
const STEPS_TO_ZERO: usize = 60;
/// Largest number of poses on a curve. A curve with more poses indicates an error of the program.
const MOST_POINTS: usize = 200_000;
/// Work (in the unit of budgets) of one elimination, or of two solutions with a factored matrix, divided by the square
/// of the number of coordinates.
const SQUARE: f64 = 1e-3;
/// The search for a return to the first pose ends after this number of turns of the crank.
const MOST_TURNS: i32 = 12;
/// The limit of turns for a mechanism with transmissions, whose wheels may return to the first pose only after many
/// turns.
const MOST_GEARED_TURNS: i32 = 100;

/// A pose on the curve.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub(super) q: ColumnVector,
    /// Unit vector along the curve.
    pub(super) tangent: ColumnVector,
    /// Smallest singular value of the Jacobian.
    pub(super) sigma: f64,
    /// Measures of each group.
    pub(super) measures: Vec<GroupCondition>,
}

/// How a track ends.
pub(super) enum End {
    /// The mechanism is back at its first pose after this number of turns of the crank.
    Closed(i32),
    /// The mechanism cannot be followed any further.
    Limit(Singularity),
}

/// Poses from the start to an end.
pub(super) struct Track {
    pub(super) points: Vec<Point>,
    pub(super) end: End,
}

/// A link counts as going to infinity if it is farther than this from the crank's pivot, in units of the mechanism's
/// size.
const FAR: f64 = 50.0;

/// Beyond this distance from the crank's pivot, in units of the mechanism's size, steps grow in proportion to the
/// distance.
const NEAR: f64 = 2.0;
/// The pose with links at infinity is extrapolated from poses with distant links. The extrapolated pose is accurate
/// enough if it changes by less than this (rad) when the pose with the most distant links is left out.
const AGREED: f64 = 1e-9;
/// Between two extrapolations to links at infinity, the distance of the farthest link from the crank's pivot grows by
/// this factor.
const FARTHER: f64 = 1.2;
/// Largest number of poses from which a singular pose is extrapolated.
const MOST_KNOWN: usize = 9;

/// Follows the curve of one case.
pub(super) struct Tracker<'a> {
    case: &'a Case,
    constraints: Constraints<'a>,
    /// Index and unit of the first drive's coordinate: 1 for an angle, the mechanism's size (m) for a slide.
    crank: usize,
    unit: f64,
    /// Factors +1 or -1 of the groups' determinants.
    /// Multiplied by its factor, the determinant of a dyad has the sign of the transmission sine, and the determinant
    /// of any other group is positive at the start pose.
    signs: Vec<f64>,
    /// Right singular vector of the smallest singular value at the last pose. The inverse iteration at the next pose
    /// starts from this direction.
    weakest: RefCell<ColumnVector>,
    /// The error that reports that the allowed work is used up. After this error, no further pose is placed.
    over: OnceCell<Error>,
}

impl<'a> Tracker<'a> {
    /// Starts at the start pose of a case.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if the start pose is singular; the errors of [`gearings`] and [`Tracker::allowed`].
    pub(super) fn new(case: &'a Case) -> Result<(Self, Point)> {
        let drive = case.crank();
        let other = case.mechanism.joints()[drive.joint].other(drive.link);
        let given = case.drives.iter().filter(|drive| drive.input != Input::Angle).map(|drive| Given(drive.joint));
        let constraints =
            Constraints::of(&case.mechanism, case.start.0[other.link].point(other.local), given.collect());
        let (crank, gearings) = gearings(case, &constraints)?;
        let constraints = constraints.geared(gearings, &case.start);
        let q = constraints.coordinates_of(&case.start);
        let mut tracker = Tracker {
            case,
            constraints,
            crank,
            unit: drive.input.span(case.mechanism.size()),
            signs: vec![1.0; case.structure.groups.len()],
            weakest: RefCell::new(any_direction(q.len())),
            over: OnceCell::new(),
        };
        let mut along = ColumnVector::zeros(q.len());
        along[tracker.crank] = 1.0;
        let rough = tracker.point(q, &along);
        tracker.check_regular(&rough)?;
        let start = tracker
            .at_crank(&rough, drive.coordinate(drive.start) / tracker.unit)
            .ok_or_else(|| lost(drive.told(drive.start)));
        let start = tracker.allowed(start)?;
        for (index, group) in case.structure.groups.entries() {
            let sine = linkage::mechanism::assembly::transmission_sine(&case.mechanism, group, &case.start);
            let wanted = sine.map_or(1.0, f64::signum);
            tracker.signs[index] = wanted * start.measures[index].determinant.signum();
        }
        let start = tracker.point(start.q, &along);
        Ok((tracker, start))
    }

    /// Subtracts the work of `squares` eliminations from the allowed work; `None` if this work is used up.
    fn spend(&self, squares: usize) -> Option<()> {
        let size = self.constraints.coordinates() as f64;
        let spent = work::spend(SQUARE * squares as f64 * size * size);
        spent.map_err(|error| self.over.get_or_init(|| error).kind()).ok()
    }

    /// Returns `found`, unless a pose is missing because the allowed work is used up.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if the work is used up. The error advises a larger budget.
    pub(super) fn allowed<T>(&self, found: Result<T>) -> Result<T> {
        match self.over.get() {
            Some(error) => Err(error.clone()),
            None => found,
        }
    }

    /// Crank angle of a pose as the scenario states it (rad).
    pub(super) fn crank_of(&self, q: &ColumnVector) -> f64 {
        self.case.crank().from_coordinate(q[self.crank] * self.unit)
    }

    /// The error for a pose at which the mechanism cannot be followed.
    pub(super) fn lost(&self, q: &ColumnVector) -> Error {
        lost(self.case.told(self.crank_of(q)))
    }

    /// The crank's component of the tangent.
    pub(super) fn crank_rate(&self, point: &Point) -> f64 {
        point.tangent[self.crank]
    }

    fn check_regular(&self, start: &Point) -> Result<()> {
        for (group, measure) in self.case.structure.groups.iter().zip(&start.measures) {
            if !(measure.determinant.abs() > MEET) {
                let (names, at) = (group.names(&self.case.mechanism), self.case.told(self.case.crank().start));
                return Err(Error::new(ErrorKind::Geometry, sentences::the_start_pose_at_is_singular(&at, &names))
                    .key("start")
                    .at_input(at)
                    .of_group(names)
                    .help(sentences::START_AT_ANOTHER_CRANK_ANGLE));
            }
        }
        Ok(())
    }

    /// The pose at `q`, with its tangent in the direction of `along`.
    fn point(&self, q: ColumnVector, along: &ColumnVector) -> Point {
        let jacobian = self.constraints.at(&q).jacobian;
        let tangent = tangent(&jacobian, along);
        let (sigma, rounds) = smallest_singular_value(&bordered(&jacobian, &tangent), &mut self.weakest.borrow_mut());
        // One elimination for the tangent, one for the singular value.
        // If the work is used up, the next pose reports it.
        let _ = self.spend(2 + rounds);
        let groups = self.case.structure.groups.iter().zip(&self.signs);
        let pose = self.constraints.pose(&q);
        let measures = groups.map(|(group, sign)| {
            let found = measure::of(&self.constraints.block(&jacobian, group), &self.case.mechanism, group, &pose);
            GroupCondition { determinant: sign * found.determinant, ..found }
        });
        let measures = measures.collect();
        Point { q, tangent, sigma, measures }
    }

    /// Solves all equations and `across . (q - from) = distance` by Newton's method from `q`.
    /// `None` if a correction is longer than `most` or the method does not converge.
    fn correct(
        &self,
        mut q: ColumnVector,
        across: &ColumnVector,
        from: &ColumnVector,
        distance: f64,
        most: f64,
    ) -> Option<ColumnVector> {
        let mut last = f64::INFINITY;
        for _ in 0..10 {
            self.spend(1)?;
            let equations = self.constraints.at(&q);
            let ahead = across.dot(&(&q - from)) - distance;
            let rows = equations.residual.len();
            let rest = equations.residual.insert_row(rows, ahead);
            let step = solved(&bordered(&equations.jacobian, across), rest)?;
            let change = step.norm();
            if !(change <= most) {
                return None;
            }
            q -= step;
            if change < 1e-15 || (last < 1e-8 && change < 1e-8) {
                return Some(q);
            }
            last = change;
        }
        None
    }

    /// The pose at `distance` ahead of `from`, measured along its tangent.
    pub(super) fn advance(&self, from: &Point, distance: f64) -> Option<Point> {
        let predicted = &from.q + &from.tangent * distance;
        let most = 0.25 * distance.abs() + 1e-12;
        let q = self.correct(predicted, &from.tangent, &from.q, distance, most)?;
        let point = self.point(q, &from.tangent);
        (point.tangent.dot(&from.tangent) >= STRAIGHT).then_some(point)
    }

    /// The pose near `near` at which the coordinate of the first drive has the value `angle` (rad; for a slide, in
    /// units of the mechanism's size).
    fn at_crank(&self, near: &Point, angle: f64) -> Option<Point> {
        let mut across = ColumnVector::zeros(near.q.len());
        across[self.crank] = 1.0;
        let q = self.correct(near.q.clone(), &across, &ColumnVector::zeros(near.q.len()), angle, 2.0 * LONGEST)?;
        Some(self.point(q, &near.tangent))
    }

    /// Zero of `f` between the neighbours `a` and `b`, at which `f` has different signs.
    /// The Illinois method finds the distance of the zero from `a`.
    pub(super) fn zero(&self, a: &Point, b: &Point, f: impl Fn(&Point) -> f64) -> Point {
        let width = a.tangent.dot(&(&b.q - &a.q));
        let ends = [(0.0, f(a)), (width, f(b))];
        let nearer = usize::from(!(ends[0].1.abs() < ends[1].1.abs()));
        let mut best = ([a, b][nearer].clone(), ends[nearer].1.abs());
        let close = Close { value: 0.0, width: 1e-14 * width.abs() };
        // If Newton's method finds no pose, the best result so far is as accurate as the equations allow.
        let _ = root::regula_falsi(ends, close, STEPS_TO_ZERO, |at| {
            let point = self.advance(a, at).ok_or(())?;
            let value = f(&point);
            if value.abs() <= best.1 {
                best = (point, value.abs());
            }
            Ok::<f64, ()>(value)
        });
        best.0
    }

    /// Follows the curve. The sign of `sense` is the direction in which the crank turns first.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] if the curve cannot be followed to an end. [`ErrorKind::Unsupported`] if the mechanism
    /// does not return to its first pose, or if a driven slide has no limit. The errors of [`Tracker::allowed`].
    pub(super) fn follow(&self, start: &Point, sense: f64) -> Result<Track> {
        self.allowed(self.followed(start, sense))
    }

    fn followed(&self, start: &Point, sense: f64) -> Result<Track> {
        let mut first = start.clone();
        if self.crank_rate(&first) * sense < 0.0 {
            first.tangent.neg_mut();
        }
        let mut points = vec![first];
        let mut turns = 1;
        let (mut longest, mut tried) = (LONGEST, FARTHER);
        while points.len() < MOST_POINTS {
            let here = &points[points.len() - 1];
            let Some((next, step)) = self.step(here, longest) else { return self.met(points) };
            longest = (2.0 * step).smaller(LONGEST * self.extent(&next.q));
            if self.crank_rate(&next) * sense <= 0.0 {
                let limit = self.zero(here, &next, |point| self.crank_rate(point));
                let singularity = self.singularity(SingularityKind::DeadPoint, &limit);
                points.push(limit);
                return Ok(Track { points, end: End::Limit(singularity) });
            }
            let whole = points[0].q[self.crank] + sense * TAU * f64::from(turns);
            let returns = self.case.crank().input.period().is_some();
            if returns && (next.q[self.crank] - whole) * sense >= 0.0 {
                if let Some(last) = self.at_crank(&next, whole)
                    && self.is_same(&last, &points[0])
                {
                    points.push(last);
                    return Ok(Track { points, end: End::Closed(turns) });
                }
                turns += 1;
                let is_geared = !self.case.mechanism.transmissions().is_empty();
                let most = if is_geared { MOST_GEARED_TURNS } else { MOST_TURNS };
                if turns > most {
                    let message = sentences::the_mechanism_does_not_return(&most);
                    return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::ASK_FOR_INSTANTS_OF_A_GRID));
                }
            }
            let is_near = next.sigma < MEET;
            let extent = self.extent(&next.q);
            if !returns && (next.q[self.crank] - points[0].q[self.crank]).abs() > FAR {
                return Err(self.unlimited(&next.q));
            }
            points.push(next);
            if extent > tried {
                tried = extent * FARTHER;
                if extent > FAR / NEAR || self.is_settled(&points) {
                    return self.escaped(points);
                }
            }
            if is_near {
                return self.met(points);
            }
        }
        Err(self.lost(&points[points.len() - 1].q))
    }

    /// The error for a slide without a limit.
    fn unlimited(&self, q: &ColumnVector) -> Error {
        let at = self.case.told(self.crank_of(q));
        let message = sentences::the_slide_has_no_limit(&at);
        Error::new(ErrorKind::Unsupported, message).at_input(at).help(sentences::THE_MECHANISM_MOVES_OVER)
    }

    /// Distance of the farthest link from the crank's pivot, divided by [`NEAR`] sizes of the mechanism; at least 1.
    fn extent(&self, q: &ColumnVector) -> f64 {
        q.iter()
            .take(self.constraints.of_links())
            .enumerate()
            .filter(|(k, _)| k % 3 < 2)
            .fold(1.0, |most, (_, x)| most.larger(x.abs() / NEAR))
    }

    /// Lower bound on the distance to another branch.
    /// The smallest singular value is small if links are far away, even without a branch nearby, because the axes that
    /// guide these links are almost parallel.
    /// The singular value is therefore multiplied by the extent.
    /// Multiplication by the extent is not valid for groups without a far link. For groups without a far link, the
    /// determinants bound the distance to another branch.
    fn clearance(&self, here: &Point) -> f64 {
        let extent = self.extent(&here.q);
        let all = here.sigma * extent;
        if extent == 1.0 {
            return all;
        }
        let is_far = |link: &LinkId| here.q.rows(Constraints::angle(*link) - 2, 2).amax() > NEAR;
        let groups = self.case.structure.groups.iter().zip(&here.measures);
        let near = groups.filter(|(group, _)| !group.links.iter().any(is_far));
        near.fold(all, |least, (_, measure)| least.smaller(measure.determinant.abs()))
    }

    /// Takes one step of at most `longest`. The step may pass one limit of rotation, but no other singular pose.
    /// `None` if branches meet.
    fn step(&self, here: &Point, longest: f64) -> Option<(Point, f64)> {
        let mut step = longest.smaller(SAFE * self.clearance(here));
        while step >= SHORTEST {
            if let Some(next) = self.advance(here, step) {
                let changed = |a: f64, b: f64| a * b <= 0.0;
                let pairs = here.measures.iter().zip(&next.measures);
                let passed = pairs.filter(|(a, b)| changed(a.determinant, b.determinant)).count();
                let turned = usize::from(changed(self.crank_rate(here), self.crank_rate(&next)));
                if passed == turned {
                    return Some((next, step));
                }
            }
            step /= 2.0;
        }
        None
    }

    /// The end of a track at a pose where branches meet. Near this pose the equations lose digits.
    /// Along the branch, all quantities are smooth functions of the determinant that goes to zero.
    /// The pose with determinant zero is therefore extrapolated from poses at a distance (Neville's scheme).
    fn met(&self, mut points: Vec<Point>) -> Result<Track> {
        let last = &points[points.len() - 1];
        let Some(group) = weakest(&last.measures) else { return Err(self.lost(&last.q)) };
        let known = by_determinant(&points, GroupId(group));
        let known: Vec<(f64, ColumnVector)> = known.into_iter().map(|(x, point)| (x, point.q.clone())).collect();
        let q = if known.len() < 3 { last.q.clone() } else { neville_at_zero(&known) };
        let moved = (&q - &last.q).norm();
        let q = if moved < 1e-3 { q } else { last.q.clone() };
        // If the crank stands still on the curve, the pose is a dead point, of one group or of several groups at once.
        // If the crank moves on along the curve, the pose is a change point.
        let kind =
            if self.crank_rate(last).abs() < 1e-3 { SingularityKind::DeadPoint } else { SingularityKind::ChangePoint };
        let mut end = Point { q, ..last.clone() };
        end.measures[group] = GroupCondition { determinant: 0.0, condition: f64::MAX };
        let singularity = self.singularity(kind, &end);
        points.push(end);
        Ok(Track { points, end: End::Limit(singularity) })
    }

    /// Whether the extrapolated pose with links at infinity is accurate enough (see [`AGREED`]) and is the next
    /// singular pose of the curve.
    /// The accuracy of the angles of all links and of all determinants is tested.
    /// The pose is the next singular pose if the determinants of the other groups keep their signs up to it.
    fn is_settled(&self, points: &[Point]) -> bool {
        let last = &points[points.len() - 1];
        let Some(group) = weakest(&last.measures) else { return false };
        let known = by_determinant(points, GroupId(group));
        if known.len() < MOST_KNOWN {
            return false;
        }
        let known: Vec<(f64, ColumnVector)> = known.into_iter().map(|(x, point)| (x, self.finite(point))).collect();
        let [now, before] = [&known[..], &known[1..]].map(neville_at_zero);
        let keeps_sign = |other: usize| now[other] * last.measures[other].determinant > 0.0;
        (&now - before).amax() < AGREED && (0..last.measures.len()).all(|other| other == group || keeps_sign(other))
    }

    /// Quantities that stay finite if links go to infinity: determinants of all groups, then angles of all links (rad).
    fn finite(&self, point: &Point) -> ColumnVector {
        let angles = self.case.mechanism.links().ids().skip(1).map(|link| point.q[Constraints::angle(link)]);
        let all: Vec<f64> = point.measures.iter().map(|measure| measure.determinant).chain(angles).collect();
        ColumnVector::from_vec(all)
    }

    /// The end of a track along which a slide grows without bound.
    /// Along this track, the crank angle is a smooth function of the determinant that goes to zero.
    /// The angles of all links and the measures of the other groups are also smooth functions of this determinant.
    fn escaped(&self, mut points: Vec<Point>) -> Result<Track> {
        let last = &points[points.len() - 1];
        let Some(group) = weakest(&last.measures) else { return Err(self.lost(&last.q)) };
        let known = by_determinant(&points, GroupId(group));
        if known.len() < 3 {
            return Err(self.lost(&last.q));
        }
        let known: Vec<(f64, ColumnVector)> = known.into_iter().map(|(x, point)| (x, self.finite(point))).collect();
        let found = neville_at_zero(&known);
        let mut end = last.clone();
        for (measure, determinant) in end.measures.iter_mut().zip(found.iter()) {
            measure.determinant = *determinant;
        }
        for (link, angle) in self.case.mechanism.links().ids().skip(1).zip(found.iter().skip(end.measures.len())) {
            end.q[Constraints::angle(link)] = *angle;
        }
        end.measures[group] = GroupCondition { determinant: 0.0, condition: f64::MAX };
        let singularity = self.singularity(SingularityKind::ParallelAxes, &end);
        points.push(end);
        Ok(Track { points, end: End::Limit(singularity) })
    }

    /// A singular pose, attributed to the group with the smallest determinant.
    pub(super) fn singularity(&self, kind: SingularityKind, at: &Point) -> Singularity {
        let group = weakest(&at.measures).unwrap_or(0);
        let determinant = if kind == SingularityKind::BranchContact { at.measures[group].determinant } else { 0.0 };
        Singularity { kind, crank: self.crank_of(&at.q), group: GroupId(group), determinant }
    }

    /// Whether all links have the same pose at `a` and `b`, apart from whole turns.
    /// The coordinates of slides are not compared, because they follow from the poses of the links.
    fn is_same(&self, a: &Point, b: &Point) -> bool {
        (0..self.constraints.of_links()).all(|k| match k % 3 {
            2 => (unit(a.q[k]) - unit(b.q[k])).norm() < 1e-6,
            _ => (a.q[k] - b.q[k]).abs() < 1e-6,
        })
    }
}

/// The last regular poses, each with the determinant of the group `group`.
/// The determinant nearest to zero comes first. Each following determinant is more than 1.5 times the preceding one.
fn by_determinant(points: &[Point], group: GroupId) -> Vec<(f64, &Point)> {
    let mut known: Vec<(f64, &Point)> = Vec::new();
    for point in points.iter().rev().filter(|point| point.sigma > 1e-4) {
        let determinant = point.measures[group].determinant;
        let apart = known.last().is_none_or(|(nearer, _)| determinant.abs() > 1.5 * nearer.abs());
        if apart && known.len() < MOST_KNOWN {
            known.push((determinant, point));
        }
    }
    known
}

/// The group with the smallest determinant.
fn weakest(measures: &[GroupCondition]) -> Option<usize> {
    (0..measures.len()).min_by(|&a, &b| measures[a].determinant.abs().total_cmp(&measures[b].determinant.abs()))
}

fn lost(at: InputValue) -> Error {
    Error::new(ErrorKind::Numeric, sentences::the_poses_of_the_mechanism(&at))
        .at_input(at)
        .help(sentences::CHECK_THE_LENGTHS_OR_START)
}

/// A Jacobian with one more row.
fn bordered(jacobian: &Matrix, row: &ColumnVector) -> Matrix {
    let mut square = jacobian.clone().insert_row(jacobian.nrows(), 0.0);
    square.row_mut(jacobian.nrows()).copy_from(&row.transpose());
    square
}

/// A factored matrix. Every joint has two links, so few entries are nonzero, and elimination skips the zeros.
/// The work grows with the square of the number of links. The work of a dense decomposition grows with the cube.
fn factored(matrix: &Matrix) -> Option<Lu> {
    let mut lu = Lu::new(matrix.nrows());
    for (column, entries) in matrix.column_iter().enumerate() {
        for (row, &value) in entries.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            lu.add(row, column, value);
        }
    }
    lu.factor().then_some(lu)
}

/// A start direction for the inverse iteration. No singular vector that occurs in practice is orthogonal to it.
fn any_direction(n: usize) -> ColumnVector {
    ColumnVector::from_fn(n, |row, _| 1.0 + (row as f64).sin()).normalize()
}

/// Solution for this right-hand side; `None` if the matrix is singular to working precision.
fn solved(matrix: &Matrix, mut right: ColumnVector) -> Option<ColumnVector> {
    factored(matrix)?.solve(right.as_mut_slice());
    Some(right)
}

/// Smallest singular value, by inverse iteration, and the number of iterations.
/// The value is 0 for a matrix that is singular to working precision.
/// The iteration starts from the direction `x`. At the end of the iteration, `x` is the right singular vector.
fn smallest_singular_value(matrix: &Matrix, x: &mut ColumnVector) -> (f64, usize) {
    let Some(lu) = factored(matrix) else { return (0.0, 0) };
    // Adds a small component in every direction, so that the iteration can reach every direction.
    *x = (&*x + any_direction(matrix.nrows()) * 1e-3).normalize();
    let (mut largest, mut rounds) = (0.0f64, 0);
    for _ in 0..MOST_ITERATIONS {
        rounds += 1;
        lu.solve_transposed(x.as_mut_slice());
        lu.solve(x.as_mut_slice());
        let grown = x.norm();
        if !(grown.is_finite() && grown > 0.0) {
            *x = any_direction(matrix.nrows());
            return (0.0, rounds);
        }
        *x /= grown;
        let change = (grown - largest).abs();
        largest = grown;
        if change <= SETTLED * grown {
            break;
        }
    }
    (1.0 / largest.sqrt(), rounds)
}

/// Unit vector that the Jacobian maps to zero, with the sign for which the scalar product with `along` is positive.
/// If there are several such vectors, returns `along`.
fn tangent(jacobian: &Matrix, along: &ColumnVector) -> ColumnVector {
    let mut ahead = ColumnVector::zeros(along.len());
    ahead[along.len() - 1] = 1.0;
    match solved(&bordered(jacobian, along), ahead) {
        Some(solved) if solved.norm().is_finite() => solved.normalize(),
        _ => along.clone(),
    }
}

/// Value at zero of the polynomial through (x, column) pairs with different x.
fn neville_at_zero(known: &[(f64, ColumnVector)]) -> ColumnVector {
    let mut row: Vec<ColumnVector> = known.iter().map(|(_, q)| q.clone()).collect();
    for level in 1..known.len() {
        for k in 0..known.len() - level {
            let (x0, x1) = (known[k].0, known[k + level].0);
            row[k] = (&row[k] * x1 - &row[k + 1] * x0) / (x1 - x0);
        }
    }
    row.swap_remove(0)
}
