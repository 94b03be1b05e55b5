//! Poses of all links over an interval of crank angles: side 1's pose at the middle, and a proven bound of the
//! deviation.
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
//!   |A| |F(x0)| + (|1 - A F'(middle)| + |A| |F' - F'(middle)|) r <= r.
//!
//! The box then contains exactly one pose for every crank angle, and this pose continues the pose at the middle.
//! The branch is thus proven without sampling.
//! F is linear except for the sines and cosines of the links' angles.
//! So F(x0) and the change of F' have closed-form bounds: |exp(i a) - 1 - i a| <= a^2 / 2 and |exp(i a) - 1| <= |a|.

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::rc::Rc;

use analytic::PoseSolver;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::{KeepNan, Matrix, Vec2, cross, rotated, turned};
use linkage::mechanism::{GROUND, Group, Joint, LinkId};
use linkage::trajectory::Stage;

/// Upper limit of the width of the first parts, into which the range is divided at the beginning (rad).
const FIRST: f64 = std::f64::consts::PI / 24.0;
/// Upper limit of the number of halvings of a first part.
/// The width of the smallest part is about 1.5e-8 times the width of the first part.
pub const MOST_HALVINGS: u32 = 26;
/// Upper limit of the number of trials to find a box that contains the motion.
/// `WIDER` is the factor by which each trial widens the box.
const TRIALS: usize = 12;
const WIDER: f64 = 1.1;
/// Rounding error of a position, divided by the lengths from which the position is computed.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Upper limit of the number of cached slices. Slices beyond this limit are recomputed on demand.
const KEPT: usize = 20_000;

/// Part of the range that results from a first part by `halvings` halvings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct RangePart {
    /// Number of halvings.
    pub halvings: u32,
    /// Index among the parts of the same size, in the direction of motion.
    pub index: u64,
}

impl RangePart {
    /// Returns both halves, in the direction of motion.
    #[must_use]
    pub fn halves(self) -> [RangePart; 2] {
        [0, 1].map(|half| RangePart { halvings: self.halvings + 1, index: 2 * self.index + half })
    }
}

/// Point of a link over a part of the range, as a function of the crank angle d from the middle.
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
    #[must_use]
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
    #[must_use]
    pub fn point(&self, local: Vec2) -> Track {
        let (arm, turn) = (rotated(self.direction, local - self.centre), self.turn());
        Track {
            at: self.at + arm,
            rate: self.rate + turned(arm) * self.spin,
            error: self.off + arm.norm() * (self.twist + turn * turn / 2.0),
        }
    }

    /// Largest rotation from the middle (rad).
    fn turn(&self) -> f64 {
        self.spin.abs() * self.half + self.twist
    }

    /// Origin and direction of the link's frame at the middle (m, world).
    #[must_use]
    pub fn frame(&self) -> (Vec2, Vec2) {
        (self.at - rotated(self.direction, self.centre), self.direction)
    }

    /// Converts a world position into the link's frame at the middle (m).
    #[must_use]
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
    /// The links.
    pub tubes: Vec<Tube>,
    /// Whether the bounds are proven; otherwise only the poses at the middle are known.
    pub sound: bool,
}

/// Range of crank angles, with the enclosures of all links over its parts.
pub struct Tubes<'a> {
    case: &'a Case,
    solver: PoseSolver<'a>,
    centres: Vec<Vec2>,
    from: f64,
    to: f64,
    first: u64,
    scale: f64,
    kept: BTreeMap<RangePart, Rc<Slice>>,
    /// Number of poses computed by side 1.
    pub poses: usize,
}

impl<'a> Tubes<'a> {
    /// Creates the tubes for the range between two crank angles (rad, in the direction of motion).
    /// `extent` is the largest distance of a queried point from the origin of its frame (m).
    /// The bound on rounding errors grows with `extent`.
    ///
    /// # Errors
    /// The errors of [`PoseSolver::new`].
    pub fn new(case: &'a Case, [from, to]: [f64; 2], extent: f64) -> Result<Self> {
        let mechanism = &case.mechanism;
        let centre = |link: LinkId| {
            let places: Vec<Vec2> = mechanism.joints().iter().filter_map(|joint| joint.on(link)).collect();
            places.iter().sum::<Vec2>() / (places.len() as f64).larger(1.0)
        };
        let first = ((to - from).abs() / FIRST - 1e-9).ceil().larger(1.0) as u64;
        let ground = mechanism.links()[GROUND].points.iter().map(|point| point.local.norm()).fold(0.0, f64::larger);
        Ok(Tubes {
            case,
            solver: PoseSolver::new(case)?,
            centres: mechanism.links().ids().map(centre).collect(),
            from,
            to,
            first,
            scale: mechanism.size() + ground + extent,
            kept: BTreeMap::new(),
            poses: 0,
        })
    }

    /// Parts into which the range is divided first.
    pub fn parts(&self) -> impl DoubleEndedIterator<Item = RangePart> + use<> {
        (0..self.first).map(|index| RangePart { halvings: 0, index })
    }

    /// Both ends of a part (rad), in the direction of motion.
    #[must_use]
    pub fn ends(&self, part: RangePart) -> [f64; 2] {
        let count = self.first as f64 * f64::from(part.halvings).exp2();
        [0, 1].map(|end| self.from + (self.to - self.from) * ((part.index + end) as f64 / count))
    }

    /// Both ends of the range (rad), in the direction of motion.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        [self.from, self.to]
    }

    /// Size of the mechanism including its distance from the world origin (m).
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Rounding error of positions (m).
    #[must_use]
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
        let state = self.solver.solve(crank, 1.0, 0.0, Stage::Velocities)?;
        let mut tubes = vec![Tube::STILL; state.motions.len()];
        let rounding = ROUNDING * self.scale;
        for (link, tube) in state.motions.ids().zip(&mut tubes).skip(1) {
            let (motion, centre) = (&state.motions[link], self.centres[link]);
            let (at, rate) = (motion.point(centre), motion.point_velocity(centre));
            let (direction, spin) = (motion.direction, motion.omega);
            *tube = Tube { centre, at, rate, direction, spin, off: rounding, twist: ROUNDING, half };
        }
        for drive in case.drives.iter() {
            // The crank turns uniformly about its pivot on the ground.
            // A drive on a moving link is free, so a mechanism with such a drive has several degrees of freedom.
            // A single angle does not determine the pose of such a mechanism, so such mechanisms do not occur here.
            let pivot = case.mechanism.joints()[drive.joint].on(drive.link).unwrap_or_else(Vec2::zeros);
            let (tube, motion) = (&mut tubes[drive.link], &state.motions[drive.link]);
            (tube.centre, tube.at, tube.rate) = (pivot, motion.point(pivot), Vec2::zeros());
        }
        let sound = case.structure.groups.iter().all(|group| enclose(case, group, half, &mut tubes, rounding));
        Ok(Slice { crank, half, tubes, sound })
    }
}

/// Widens the tubes of a group's links until they provably contain the motion of the group.
/// Returns whether the proof succeeds.
fn enclose(case: &Case, group: &Group, half: f64, tubes: &mut [Tube], rounding: f64) -> bool {
    let size = 3 * group.links.len();
    let joints: Vec<&Joint> =
        group.inner.iter().chain(&group.outer).map(|&joint| &case.mechanism.joints()[joint]).collect();
    if joints.iter().map(|joint| joint.kind.equations()).sum::<usize>() != size {
        return false;
    }
    let column = |link: LinkId| group.links.iter().position(|&own| own == link).map(|index| 3 * index);
    let mut derivative = Matrix::zeros(size, size);
    let mut open = vec![0.0; size];
    let mut row = 0;
    for joint in &joints {
        equations(joint, tubes, half, &column, row, &mut derivative, &mut open);
        row += joint.kind.equations();
    }
    open.iter_mut().for_each(|open| *open += rounding);
    let Some(inverse) = derivative.clone().try_inverse() else { return false };
    let own = (Matrix::identity(size, size) - &inverse * &derivative).abs();
    let inverse = inverse.abs();
    let least: Vec<f64> =
        (0..size).map(|i| (0..size).map(|k| inverse[(i, k)] * open[k]).sum::<f64>() * (1.0 + ROUNDING)).collect();
    let mut radii = least.clone();
    for _ in 0..TRIALS {
        radii.iter_mut().for_each(|radius| *radius *= WIDER);
        for (index, &link) in group.links.iter().enumerate() {
            let [x, y, twist] = [0, 1, 2].map(|k| radii[3 * index + k]);
            (tubes[link].off, tubes[link].twist) = (x.hypot(y), twist);
        }
        // Upper bound of the change of every equation over the box.
        let mut change = vec![0.0; size];
        let mut row = 0;
        for joint in &joints {
            for own in changes(joint, tubes, half, &column, &radii).into_iter().take(joint.kind.equations()) {
                change[row] = own;
                row += 1;
            }
        }
        let next: Vec<f64> = (0..size)
            .map(|i| least[i] + (0..size).map(|k| own[(i, k)] * radii[k] + inverse[(i, k)] * change[k]).sum::<f64>())
            .collect();
        if next.iter().zip(&radii).all(|(next, radius)| next < radius) {
            for (index, &link) in group.links.iter().enumerate() {
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

/// Writes the derivative of a joint's two equations at the middle into `derivative`.
/// Writes the largest residual of these equations under the uniform motion into `open`.
/// Links of the group move uniformly. Links outside the group may be anywhere in their tubes.
fn equations(
    joint: &Joint,
    tubes: &[Tube],
    half: f64,
    column: &impl Fn(LinkId) -> Option<usize>,
    row: usize,
    derivative: &mut Matrix,
    open: &mut [f64],
) {
    let sides = [joint.first, joint.second];
    let own = sides.map(|side| column(side.link));
    let even = [0, 1].map(|k| {
        let tube = tubes[sides[k].link];
        if own[k].is_some() { Tube { off: 0.0, twist: 0.0, ..tube } } else { tube }
    });
    let [first, second] = [0, 1].map(|k| even[k].point(sides[k].local));
    let arms = [0, 1].map(|k| rotated(even[k].direction, sides[k].local - even[k].centre));
    let (gap, rate) = (second.at - first.at, second.rate - first.rate);
    let error = first.error + second.error;
    let Some(axes) = joint.kind.axes() else {
        for k in 0..2 {
            open[row + k] = gap[k].abs() + rate[k].abs() * half + error;
        }
        for (side, sign) in [(0, -1.0), (1, 1.0)] {
            let Some(at) = own[side] else { continue };
            let lever = turned(arms[side]) * sign;
            derivative[(row, at)] = sign;
            derivative[(row + 1, at + 1)] = sign;
            (derivative[(row, at + 2)], derivative[(row + 1, at + 2)]) = (lever.x, lever.y);
        }
        return;
    };
    let [along, other] = [0, 1].map(|k| rotated(even[k].direction, axes[k]));
    let (normal, turn, twist) = (turned(along), even[0].turn(), even[0].twist);
    let linear = normal.dot(&rate) - even[0].spin * along.dot(&gap);
    open[row] = normal.dot(&gap).abs()
        + linear.abs() * half
        + error
        + gap.norm() * (twist + turn * turn / 2.0)
        + turn * rate.norm() * half;
    let angle = cross(along, other).atan2(along.dot(&other));
    open[row + 1] = angle.abs() + (even[1].spin - even[0].spin).abs() * half + twist + even[1].twist;
    if let Some(at) = own[0] {
        (derivative[(row, at)], derivative[(row, at + 1)]) = (-normal.x, -normal.y);
        derivative[(row, at + 2)] = -along.dot(&gap) - normal.dot(&turned(arms[0]));
        derivative[(row + 1, at + 2)] = -1.0;
    }
    if let Some(at) = own[1] {
        (derivative[(row, at)], derivative[(row, at + 1)]) = (normal.x, normal.y);
        derivative[(row, at + 2)] = normal.dot(&turned(arms[1]));
        derivative[(row + 1, at + 2)] = 1.0;
    }
}

/// Bounds |F' - F'(middle)| r (docs/clearance.md) over the tubes, for a joint's two equations and the box `radii`.
fn changes(
    joint: &Joint,
    tubes: &[Tube],
    half: f64,
    column: &impl Fn(LinkId) -> Option<usize>,
    radii: &[f64],
) -> [f64; 2] {
    let sides = [joint.first, joint.second];
    let own = sides.map(|side| column(side.link));
    let turns = sides.map(|side| tubes[side.link].turn());
    let arms = sides.map(|side| (side.local - tubes[side.link].centre).norm());
    if joint.kind.axes().is_none() {
        let each = [0, 1].map(|k| own[k].map_or(0.0, |at| arms[k] * turns[k] * radii[at + 2]));
        return [each[0] + each[1]; 2];
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
    [sum, 0.0]
}
