//! Poses of all links over an interval of crank angles: the pose of the analytic solver (side 1) at the middle, a
//! uniform motion through this pose, and a proven bound on the deviation from the uniform motion.
//! The comments of this module say "crank angle (rad)" also where [`RangeVariable`](super::RangeVariable) is the time
//! (s).
//!
//! Over the interval, a uniform motion approximates the motion of each link.
//! The link's reference point moves along a straight line, and the link's angle changes in proportion to the crank
//! angle.
//! The deviation of the true motion is bounded group by group, for all crank angles of the interval at once (Krawczyk
//! 1969; Moore 1977).
//! Let x be the poses of a group's links, F(x) = 0 the group's joint equations and x0 the uniform motion.
//! Let F' be the derivative of F, and A an approximate inverse of F' at the middle.
//! Then T(x) = x - A F(x) maps the box |x - x0| <= r into itself and contracts if
//!
//!   |A| |F(x0)| + (|1 - A F'(middle)| + |A| |F' - F'(middle)|) r < r.
//!
//! The box then contains exactly one pose for every crank angle, and this pose continues the pose at the middle.
//! This proves, without sampling, that the motion stays on its branch.
//! F is linear except for the sines and cosines of the links' angles.
//! So F(x0) and the change of F' have closed-form bounds: |exp(i a) - 1 - i a| <= a^2 / 2 and |exp(i a) - 1| <= |a|.

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::rc::Rc;

use analytic::PoseSolver;
use linkage::case::Case;
use linkage::drive::Drive;
use linkage::error::Result;
use linkage::input::Input;
use linkage::math::{KeepNan, Matrix, Vec2, cross, rotated, turned};
use linkage::mechanism::{Coordinate, GROUND, Joint, JointId, LinkId, TransmissionId};
use linkage::trajectory::Stage;

/// Largest width of a part in the initial division of the range, before any part is halved.
/// The limit is an angle (rad) for a crank, or a fraction of the mechanism's size for a slide.
const FIRST: f64 = std::f64::consts::PI / 24.0;
/// How often each part of the initial division of the range may be halved at most.
/// The width of the smallest possible part is about 1.5e-8 times the width before the first halving.
pub const MOST_HALVINGS: u32 = 26;
/// Largest number of boxes that are tried in search of a box that provably contains the motion.
/// `WIDER` is the factor by which each trial widens the box.
const TRIALS: usize = 12;
const WIDER: f64 = 1.1;
/// Rounding error of a position, divided by the lengths from which the position is computed.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Upper limit of the number of cached slices. Slices beyond this limit are recomputed on demand.
const KEPT: usize = 20_000;

/// Part of the range that results from a part of the initial division by `halvings` halvings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct RangePart {
    /// Number of halvings.
    pub halvings: u32,
    /// Index among the parts of the same size, in the direction of motion.
    pub index: u64,
}

impl RangePart {
    /// Returns both halves, in the direction of motion.
    pub fn halves(self) -> [RangePart; 2] {
        [0, 1].map(|half| RangePart { halvings: self.halvings + 1, index: 2 * self.index + half })
    }
}

/// Point of a link over a part of the range, as a function of the crank angle d measured from the middle of the part.
/// The position of the point is `at` + `rate` d (m, m/rad), with an error of at most `error` (m).
#[derive(Clone, Copy, Debug)]
pub struct Track {
    /// Position at the middle (m).
    pub at: Vec2,
    /// Derivative with respect to the crank angle (m/rad).
    pub rate: Vec2,
    /// Largest deviation of the true position from the uniform motion (m).
    pub error: f64,
}

impl Track {
    /// Largest distance from the position at the middle (m), for crank angles within `half` (rad) of the middle.
    pub fn reach(&self, half: f64) -> f64 {
        self.rate.norm() * half + self.error
    }
}

/// Enclosure of a link's motion over a part of the range.
#[derive(Clone, Copy, Debug)]
pub struct Tube {
    /// Reference point in the link's frame (m).
    centre: Vec2,
    at: Vec2,
    rate: Vec2,
    direction: Vec2,
    spin: f64,
    /// Error bound of the reference point (m). `twist` is the error bound of the angle (rad).
    off: f64,
    twist: f64,
    half: f64,
}

impl Tube {
    const STILL: Tube = Tube {
        centre: Vec2::new(0.0, 0.0),
        at: Vec2::new(0.0, 0.0),
        rate: Vec2::new(0.0, 0.0),
        direction: Vec2::new(1.0, 0.0),
        spin: 0.0,
        off: 0.0,
        twist: 0.0,
        half: 0.0,
    };

    /// Track of a point of the link (m, in its frame).
    pub fn point(&self, local: Vec2) -> Track {
        let (arm, turn) = (rotated(self.direction, local - self.centre), self.turn());
        Track {
            at: self.at + arm,
            rate: self.rate + turned(arm) * self.spin,
            error: self.off + arm.norm() * (self.twist + turn * turn / 2.0),
        }
    }

    /// Derivative of the link's angle (rad/rad), and the largest deviation of the angle from a uniform rotation (rad).
    pub fn turning(&self) -> [f64; 2] {
        [self.spin, self.twist]
    }

    /// Largest rotation of the link from its pose at the middle (rad).
    fn turn(&self) -> f64 {
        self.spin.abs() * self.half + self.twist
    }

    /// Origin and direction of the link's frame at the middle (m, world).
    pub fn frame(&self) -> (Vec2, Vec2) {
        (self.at - rotated(self.direction, self.centre), self.direction)
    }

    /// Converts a world position into the link's frame at the middle (m).
    pub fn local(&self, place: Vec2) -> Vec2 {
        rotated(Vec2::new(self.direction.x, -self.direction.y), place - self.at) + self.centre
    }
}

/// Enclosures of all links over a part of the range.
#[derive(Debug)]
pub struct Slice {
    /// Crank angle at the middle (rad).
    pub crank: f64,
    /// Half width of the part (rad), not negative.
    pub half: f64,
    /// Enclosures of the motions, one for each link.
    pub tubes: Vec<Tube>,
    /// Whether the bounds are proven; otherwise only the poses at the middle are known.
    pub sound: bool,
}

/// Range of crank angles, with the enclosures of all links over its parts.
pub struct Tubes<'a> {
    case: &'a Case,
    solver: PoseSolver<'a>,
    centres: Vec<Vec2>,
    /// Units in the order of solution. A unit consists of links that are solved together, and of their equations.
    units: Vec<(&'a [LinkId], Vec<Row<'a>>)>,
    /// Both ends of the range (rad), in the direction of motion.
    pub range: [f64; 2],
    first: u64,
    /// Upper bound of the lengths from which a position is computed (m): the mechanism's size, plus the largest
    /// distance of a ground point from the origin, plus `extent`.
    pub scale: f64,
    kept: BTreeMap<RangePart, Rc<Slice>>,
    /// Number of poses computed by the analytic solver (side 1).
    pub poses: usize,
}

impl<'a> Tubes<'a> {
    /// Creates the tubes for the range between two crank angles (rad, in the direction of motion).
    /// `extent` is the largest distance of a queried point from the origin of its frame (m).
    /// The bound on rounding errors grows with `extent`.
    ///
    /// # Errors
    /// The errors of [`PoseSolver::new`].
    pub fn new(case: &'a Case, range: [f64; 2], extent: f64) -> Result<Self> {
        let mechanism = &case.mechanism;
        let centre = |link: LinkId| {
            let places: Vec<Vec2> = mechanism.joints().iter().filter_map(|joint| joint.on(link)).collect();
            places.iter().sum::<Vec2>() / (places.len() as f64).larger(1.0)
        };
        let first = ((range[1] - range[0]).abs() / case.stride(FIRST) - 1e-9).ceil().larger(1.0) as u64;
        let ground = mechanism.links()[GROUND].points.iter().map(|point| point.local.norm()).fold(0.0, f64::larger);
        Ok(Tubes {
            case,
            solver: PoseSolver::new(case)?,
            centres: mechanism.links().ids().map(centre).collect(),
            units: units(case),
            range,
            first,
            scale: mechanism.size() + ground + extent,
            kept: BTreeMap::new(),
            poses: 0,
        })
    }

    /// Parts of the initial division of the range.
    pub fn parts(&self) -> impl DoubleEndedIterator<Item = RangePart> + use<> {
        (0..self.first).map(|index| RangePart { halvings: 0, index })
    }

    /// Both ends of a part (rad), in the direction of motion.
    pub fn ends(&self, part: RangePart) -> [f64; 2] {
        let count = self.first as f64 * f64::from(part.halvings).exp2();
        let [from, to] = self.range;
        [0, 1].map(|end| from + (to - from) * ((part.index + end) as f64 / count))
    }

    /// Largest change of the range's variable during which no driving link turns by more than `turn` (rad).
    pub fn stride(&self, turn: f64) -> f64 {
        self.case.stride(turn)
    }

    /// Rounding error of positions (m).
    pub fn rounding(&self) -> f64 {
        ROUNDING * self.scale
    }

    /// Returns the enclosures of all links over a part.
    ///
    /// # Errors
    /// The errors of [`PoseSolver::solve`].
    pub fn at(&mut self, part: RangePart) -> Result<Rc<Slice>> {
        if let Some(slice) = self.kept.get(&part) {
            return Ok(Rc::clone(slice));
        }
        let [from, to] = self.ends(part);
        let slice = Rc::new(self.slice(f64::midpoint(from, to), (to - from).abs() / 2.0)?);
        if self.kept.len() < KEPT {
            self.kept.insert(part, Rc::clone(&slice));
        }
        Ok(slice)
    }

    /// Computes the enclosures of all links within `half` (rad) of a crank angle (rad).
    ///
    /// # Errors
    /// The errors of [`PoseSolver::solve`].
    pub fn slice(&mut self, crank: f64, half: f64) -> Result<Slice> {
        self.poses += 1;
        let case = self.case;
        // For each drive: the rate of its coordinate per unit of the range's variable, and the largest deviation of the
        // coordinate from a uniform change at this rate.
        let courses: Vec<[f64; 2]> = match case.goes_by_time() {
            true => {
                let course = |drive: &Drive| [drive.at(crank).rate, drive.largest_acceleration() * half * half / 2.0];
                case.drives.iter().map(course).collect()
            }
            false => case.drives.ratios(0.0).map(|ratio| [ratio, 0.0]).collect(),
        };
        let state = self.solver.solve(crank, 1.0, 0.0, Stage::Velocities)?;
        let mut tubes = vec![Tube::STILL; state.motions.len()];
        let rounding = ROUNDING * self.scale;
        for (link, tube) in state.motions.ids().zip(&mut tubes).skip(1) {
            let (motion, centre) = (&state.motions[link], self.centres[link]);
            let (at, rate) = (motion.point(centre), motion.point_velocity(centre));
            let (direction, spin) = (motion.direction, motion.omega);
            *tube = Tube { centre, at, rate, direction, spin, off: rounding, twist: ROUNDING, half };
        }
        for (drive, [_, bend]) in case.drives.iter().zip(&courses) {
            // A crank turns about its pivot on the ground.
            // A link on a driven guide of the ground moves along the guide.
            let pivot = case.mechanism.joints()[drive.joint].on(drive.link).unwrap_or_else(Vec2::zeros);
            let (tube, motion) = (&mut tubes[drive.link], &state.motions[drive.link]);
            if drive.input == Input::Angle {
                (tube.centre, tube.at, tube.rate) = (pivot, motion.point(pivot), Vec2::zeros());
                tube.twist += bend;
            } else {
                tube.off += bend;
            }
        }
        for row in self.units.iter_mut().flat_map(|(_, rows)| rows) {
            if let Some(drive) = row.drive {
                [row.rate, row.bend] = courses[drive];
            }
        }
        let sound = self.units.iter().all(|(links, rows)| enclose(rows, links, half, &mut tubes, rounding));
        Ok(Slice { crank, half, tubes, sound })
    }
}

/// Units of links that are solved together, each with its equations, in the order of solution.
/// A unit is either a group, or a driving link whose driven joint connects it with a moving link.
fn units(case: &Case) -> Vec<(&[LinkId], Vec<Row<'_>>)> {
    let mechanism = &case.mechanism;
    let drivers = case.structure.leading().map(|(_, driver)| driver);
    let moved = drivers.filter(|driver| mechanism.joints()[driver.joint].other(driver.link).link != GROUND);
    let moved = moved.map(|own| {
        let joint = std::slice::from_ref(&own.joint);
        (std::slice::from_ref(&own.link), rows(case, joint.iter(), joint, &[]))
    });
    let groups = case.structure.groups.iter().map(|group| {
        let joints = group.inner.iter().chain(&group.outer);
        (&group.links[..], rows(case, joints, &group.given, &group.trains))
    });
    moved.chain(groups).collect()
}

/// An equation: the sum of its terms is zero, or changes at a known rate.
struct Row<'a> {
    terms: Vec<(Term<'a>, f64)>,
    /// Index of the drive that changes the sum; `None` if no drive changes it.
    drive: Option<usize>,
    /// Rate of the sum per unit of the variable, and the largest deviation of the sum from a change at this rate.
    rate: f64,
    bend: f64,
    /// Whether the sum must be zero at the middle. If not, the solver's pose gives the sum at the middle.
    is_zero: bool,
}

/// A function of the poses of links.
#[derive(Clone, Copy)]
enum Term<'a> {
    /// Distance of the joint's second point from its first point along a direction in the world.
    Along(&'a Joint, Vec2),
    /// Distance of the joint's second point from its first point along a direction in the first link.
    Inside(&'a Joint, Vec2),
    /// Angle of a link.
    Angle(LinkId),
    /// Angle between the joint's axes.
    Axes(&'a Joint, [Vec2; 2]),
}

/// The equations of joints, driven joints and transmissions.
/// The equation of a cam has no constant ratio, so nothing is proven for the links of a cam.
fn rows<'a>(
    case: &'a Case,
    joints: impl Iterator<Item = &'a JointId>,
    given: &[JointId],
    trains: &[TransmissionId],
) -> Vec<Row<'a>> {
    let all = case.mechanism.joints();
    let mut rows: Vec<Row> = joints.flat_map(|&id| closure(&all[id])).collect();
    rows.extend(given.iter().map(|&id| {
        let drive = case.drives.iter().position(|drive| drive.joint == id);
        // `Tubes::slice` sets the rate.
        Row { drive, ..motion(&all[id], f64::NAN) }
    }));
    for &id in trains {
        let own = &case.mechanism.transmissions()[id];
        let ratio = own.ratio().unwrap_or(f64::NAN);
        let of = |(coordinate, sign): &(Coordinate, f64), factor: f64| match *coordinate {
            Coordinate::Angle(link) => (Term::Angle(link), sign * factor),
            Coordinate::Slide(joint) => {
                let joint = &all[joint];
                let axis = joint.kind.axes().map_or_else(Vec2::zeros, |axes| axes[0]);
                (Term::Inside(joint, axis), sign * factor)
            }
        };
        let [first, second] = &own.coordinates;
        let terms = first.iter().map(|own| of(own, -ratio)).chain(second.iter().map(|own| of(own, 1.0)));
        rows.push(Row { terms: terms.collect(), drive: None, rate: 0.0, bend: 0.0, is_zero: false });
    }
    rows
}

/// The equations that close a joint.
fn closure(joint: &Joint) -> [Row<'_>; 2] {
    let terms = match joint.kind.axes() {
        None => [Vec2::x(), Vec2::y()].map(|way| Term::Along(joint, way)),
        Some(axes) => [Term::Inside(joint, turned(axes[0])), Term::Axes(joint, axes)],
    };
    terms.map(|term| Row { terms: vec![(term, 1.0)], drive: None, rate: 0.0, bend: 0.0, is_zero: true })
}

/// The equation of a driven joint: its coordinate changes at the rate `rate` per unit of the input.
fn motion(joint: &Joint, rate: f64) -> Row<'_> {
    let terms = match joint.kind.axes() {
        Some(axes) => vec![(Term::Inside(joint, axes[0]), 1.0)],
        None => vec![(Term::Angle(joint.second.link), 1.0), (Term::Angle(joint.first.link), -1.0)],
    };
    Row { terms, drive: None, rate, bend: 0.0, is_zero: false }
}

/// Writes the derivatives of all equations at the middle into `derivative`.
/// Returns the largest residual of every equation under the uniform motion.
fn equations(
    rows: &[Row],
    tubes: &[Tube],
    half: f64,
    column: &impl Fn(LinkId) -> Option<usize>,
    derivative: &mut Matrix,
) -> Vec<f64> {
    let residual = |(row, own): (usize, &Row)| {
        let [mut value, mut rate, mut error] = [0.0, 0.0, own.bend];
        for &(term, weight) in &own.terms {
            let found = term.linear(tubes, half, column, |column, value| derivative[(row, column)] += weight * value);
            value += weight * found[0];
            rate += weight * found[1];
            error += weight.abs() * found[2];
        }
        let value = if own.is_zero { value.abs() } else { 0.0 };
        value + (rate - own.rate).abs() * half + error
    };
    rows.iter().enumerate().map(residual).collect()
}

/// Returns an upper bound of |F' - F'(middle)| r for every equation, over the tubes and with r = `radii`.
/// The documentation of this module explains F' and r.
fn changes(
    rows: &[Row],
    tubes: &[Tube],
    half: f64,
    column: &impl Fn(LinkId) -> Option<usize>,
    radii: &[f64],
) -> Vec<f64> {
    let of = |(term, weight): &(Term, f64)| weight.abs() * term.change(tubes, half, column, radii);
    rows.iter().map(|row| row.terms.iter().map(of).sum()).collect()
}

/// Widens the tubes of links until they provably contain the motion that the equations determine.
/// Returns whether the proof succeeds.
fn enclose(rows: &[Row], links: &[LinkId], half: f64, tubes: &mut [Tube], rounding: f64) -> bool {
    let size = 3 * links.len();
    if rows.len() != size {
        return false;
    }
    let column = |link: LinkId| links.iter().position(|&own| own == link).map(|index| 3 * index);
    let mut derivative = Matrix::zeros(size, size);
    let mut open = equations(rows, tubes, half, &column, &mut derivative);
    open.iter_mut().for_each(|open| *open += rounding);
    let Some(inverse) = derivative.clone().try_inverse() else { return false };
    let own = (Matrix::identity(size, size) - &inverse * &derivative).abs();
    let inverse = inverse.abs();
    let least: Vec<f64> =
        (0..size).map(|i| (0..size).map(|k| inverse[(i, k)] * open[k]).sum::<f64>() * (1.0 + ROUNDING)).collect();
    let mut radii = least.clone();
    for _ in 0..TRIALS {
        radii.iter_mut().for_each(|radius| *radius *= WIDER);
        for (index, &link) in links.iter().enumerate() {
            let [x, y, twist] = [0, 1, 2].map(|k| radii[3 * index + k]);
            (tubes[link].off, tubes[link].twist) = (x.hypot(y), twist);
        }
        let change = changes(rows, tubes, half, &column, &radii);
        let next: Vec<f64> = (0..size)
            .map(|i| least[i] + (0..size).map(|k| own[(i, k)] * radii[k] + inverse[(i, k)] * change[k]).sum::<f64>())
            .collect();
        if next.iter().zip(&radii).all(|(next, radius)| next < radius) {
            for (index, &link) in links.iter().enumerate() {
                let [x, y, twist] = [0, 1, 2].map(|k| next[3 * index + k]);
                (tubes[link].off, tubes[link].twist) = (x.hypot(y) + rounding, twist + ROUNDING);
            }
            return true;
        }
        if !next.iter().all(|radius| radius.is_finite()) {
            return false;
        }
        radii = next;
    }
    false
}

impl Term<'_> {
    /// The term as a linear function of the crank angle, for a uniform motion of the group's links.
    /// Returns the term's value at the middle, its rate, and its largest deviation from the linear function.
    /// Links outside the group may be anywhere in their tubes.
    /// Calls `put` for each coordinate that the term depends on, with the coordinate's column and the term's derivative
    /// with respect to the coordinate at the middle.
    fn linear(
        self,
        tubes: &[Tube],
        half: f64,
        column: &impl Fn(LinkId) -> Option<usize>,
        mut put: impl FnMut(usize, f64),
    ) -> [f64; 3] {
        let even = |link: LinkId| match column(link) {
            Some(_) => Tube { off: 0.0, twist: 0.0, ..tubes[link] },
            None => tubes[link],
        };
        let (joint, way) = match self {
            Term::Angle(link) => {
                column(link).into_iter().for_each(|at| put(at + 2, 1.0));
                return [0.0, tubes[link].spin, even(link).twist];
            }
            Term::Axes(joint, axes) => {
                let ends = [joint.first.link, joint.second.link];
                for (link, sign) in ends.into_iter().zip([-1.0, 1.0]) {
                    column(link).into_iter().for_each(|at| put(at + 2, sign));
                }
                let [first, second] = ends.map(even);
                let [along, other] = [rotated(first.direction, axes[0]), rotated(second.direction, axes[1])];
                let angle = cross(along, other).atan2(along.dot(&other));
                return [angle, second.spin - first.spin, first.twist + second.twist];
            }
            Term::Along(joint, way) | Term::Inside(joint, way) => (joint, way),
        };
        let sides = [joint.first, joint.second];
        let [one, two] = sides.map(|side| even(side.link));
        let [first, second] = [one.point(sides[0].local), two.point(sides[1].local)];
        let (gap, rate, error) = (second.at - first.at, second.rate - first.rate, first.error + second.error);
        let arms =
            [(one, sides[0]), (two, sides[1])].map(|(tube, side)| rotated(tube.direction, side.local - tube.centre));
        let turns = matches!(self, Term::Inside(..));
        let way = if turns { rotated(one.direction, way) } else { way };
        let own = if turns { turned(way).dot(&gap) } else { 0.0 };
        if let Some(at) = column(sides[0].link) {
            put(at, -way.x);
            put(at + 1, -way.y);
            put(at + 2, own - way.dot(&turned(arms[0])));
        }
        if let Some(at) = column(sides[1].link) {
            put(at, way.x);
            put(at + 1, way.y);
            put(at + 2, way.dot(&turned(arms[1])));
        }
        let (turn, twist) = if turns { (one.turn(), one.twist) } else { (0.0, 0.0) };
        let error = error + gap.norm() * (twist + turn * turn / 2.0) + turn * rate.norm() * half;
        [way.dot(&gap), way.dot(&rate) + one.spin * own, error]
    }

    /// The term's contribution to the bounds of [`changes`].
    fn change(self, tubes: &[Tube], half: f64, column: &impl Fn(LinkId) -> Option<usize>, radii: &[f64]) -> f64 {
        let (Term::Along(joint, _) | Term::Inside(joint, _)) = self else { return 0.0 };
        let sides = [joint.first, joint.second];
        let own = sides.map(|side| column(side.link));
        let turns = sides.map(|side| tubes[side.link].turn());
        let arms = sides.map(|side| (side.local - tubes[side.link].centre).norm());
        if matches!(self, Term::Along(..)) {
            return (0..2).map(|k| own[k].map_or(0.0, |at| arms[k] * turns[k] * radii[at + 2])).sum();
        }
        let [first, second] = sides.map(|side| tubes[side.link].point(side.local));
        let (gap, rate) = (second.at - first.at, second.rate - first.rate);
        let moved = rate.norm() * half + first.error + second.error;
        let mut sum = 0.0;
        if let Some(at) = own[0] {
            sum += turns[0] * (radii[at] + radii[at + 1]) + (turns[0] * gap.norm() + moved) * radii[at + 2];
        }
        if let Some(at) = own[1] {
            sum += turns[0] * (radii[at] + radii[at + 1]) + arms[1] * (turns[0] + turns[1]) * radii[at + 2];
        }
        sum
    }
}
