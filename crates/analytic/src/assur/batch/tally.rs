//! Quantities of every pose of a case batch, and their statistics.

use std::array;

use linkage::case::Case;
use linkage::math::tally::{LanePeak, Tally, Weighted};
use linkage::math::{Vec2, cross, rotated};
use linkage::mechanism::{GroupId, JointId, LinkId};
use linkage::trajectory::OfPoint;
use pulp::Simd;

use super::lanes::{Eight, Lanes, TILE, Window};
use super::poses::{ACCELERATION, ALPHA, DIRECTION, Layout, OMEGA, ORIGIN, VELOCITY};
use crate::assur::turns::{crossing, principal};

/// Numbers of the rows of a tile.
const COUNT: [f64; TILE] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// A quantity of every pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PoseQuantity {
    /// Angle of a link (rad), with its whole turns.
    Angle(LinkId),
    /// Angular velocity of a link (rad/s).
    Omega(LinkId),
    /// Angular acceleration of a link (rad/s^2).
    Alpha(LinkId),
    /// Position (m), velocity (m/s) or acceleration (m/s^2) of a point of a link, by the index of the point.
    Point(LinkId, usize, OfPoint),
    /// Position (m), velocity (m/s) or acceleration (m/s^2) of the mass centre of a link.
    Centre(LinkId, OfPoint),
    /// Force of the first link of a joint on the second along x (N).
    ForceX(JointId),
    /// Force of the first link of a joint on the second along y (N).
    ForceY(JointId),
    /// Magnitude of the force in a joint (N).
    Force(JointId),
    /// Square of the force's magnitude in a joint (N^2).
    ForceSquare(JointId),
    /// Balancing moment of a drive (N m).
    Torque(usize),
    /// Sine of the transmission angle of an RRR dyad, without its sign.
    TransmissionSine(GroupId),
}

/// Returns the magnitude of the sine of the transmission angle of an RRR dyad.
/// `directions` are the world directions of the dyad's links.
/// `spans` are the vectors from outer to inner joint in the frames of these links (m).
#[must_use]
pub fn rrr_sine(directions: [Vec2; 2], spans: [Vec2; 2]) -> f64 {
    let [a, b] = array::from_fn(|k| rotated(directions[k], spans[k]));
    cross(a, b).abs() / product(spans)
}

/// Product of two lengths.
fn product(spans: [Vec2; 2]) -> f64 {
    (spans[0].norm_squared() * spans[1].norm_squared()).sqrt()
}

/// The vectors from outer to inner joint of a dyad, in the frames of its links (m).
///
/// # Panics
/// If the group is not a dyad.
#[must_use]
pub fn spans(case: &Case, group: GroupId) -> [Vec2; 2] {
    let (group, joints) = (&case.structure.groups[group], case.mechanism.joints());
    array::from_fn(|k| {
        let [outer, inner] = [group.outer[k], group.inner[0]].map(|joint| joints[joint].on(group.links[k]));
        inner.expect("the joint is on both links") - outer.expect("the joint is on its link")
    })
}

/// A statistic of a quantity over all instants of a case.
#[derive(Clone, Debug)]
pub struct PoseTally {
    /// The quantity.
    pub quantity: PoseQuantity,
    /// Unit of the values, as a multiple of the SI unit.
    pub unit: f64,
    /// The statistic of the last case.
    pub tally: Tally,
    reading: Reading,
    /// Zero if all values so far are finite, otherwise NaN.
    fault: Eight,
}

/// Where a quantity is read in a case.
#[derive(Clone, Copy, Debug)]
enum Reading {
    Column(usize),
    Size(usize),
    Square(usize),
    /// Angle of the crank, which is given.
    Given,
    /// Angle of a link: first column of the link, direction of the link in the last row, and whole turns.
    Angle(usize, Vec2, f64),
    /// A point: first column of its link, and position of the point on the link.
    Point(usize, Vec2, OfPoint),
    /// Sine of a transmission angle: first columns of the two links, their spans, and the product of their lengths.
    Sine([usize; 2], [Vec2; 2], f64),
}

impl PoseTally {
    /// A statistic of a quantity in the unit `unit`, a multiple of the SI unit.
    #[must_use]
    pub fn of(quantity: PoseQuantity, unit: f64, tally: Tally) -> PoseTally {
        PoseTally { quantity, unit, tally, reading: Reading::Given, fault: Eight([0.0; TILE]) }
    }

    /// Whether `other` is the same statistic of the same quantity in the same unit.
    #[must_use]
    pub fn is_like(&self, other: &PoseTally) -> bool {
        self.quantity == other.quantity && self.unit == other.unit && self.tally == other.tally
    }

    /// Whether all values of the last case are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.fault.0.iter().all(|lane| *lane == 0.0)
    }

    /// Prepares the first row of a case.
    pub(super) fn start(&mut self, case: &Case, layout: Layout) {
        let link = |link: LinkId| layout.link(link).expect("a moving link");
        let links = case.mechanism.links();
        self.tally.clear();
        self.fault = Eight([0.0; TILE]);
        self.reading = match self.quantity {
            PoseQuantity::Angle(of) if of == case.crank().link => Reading::Given,
            PoseQuantity::Angle(of) => Reading::Angle(link(of), Vec2::zeros(), 0.0),
            PoseQuantity::Omega(of) => Reading::Column(link(of) + OMEGA),
            PoseQuantity::Alpha(of) => Reading::Column(link(of) + ALPHA),
            PoseQuantity::Point(of, point, reading) => Reading::Point(link(of), links[of].points[point].local, reading),
            PoseQuantity::Centre(of, reading) => Reading::Point(link(of), links[of].mass_centre, reading),
            PoseQuantity::ForceX(joint) => Reading::Column(layout.force(joint)),
            PoseQuantity::ForceY(joint) => Reading::Column(layout.force(joint) + 1),
            PoseQuantity::Force(joint) => Reading::Size(layout.force(joint)),
            PoseQuantity::ForceSquare(joint) => Reading::Square(layout.force(joint)),
            PoseQuantity::Torque(drive) => Reading::Column(layout.torque(drive)),
            PoseQuantity::TransmissionSine(group) => {
                let of = &case.structure.groups[group].links;
                let spans = spans(case, group);
                Reading::Sine([link(of[0]), link(of[1])], spans, product(spans))
            }
        };
    }

    /// Whether the quantity depends on earlier poses.
    pub(super) fn needs_start(&self) -> bool {
        matches!(self.reading, Reading::Angle(..))
    }

    /// Reads the start pose. Returns `false` if the link's direction in this pose is nearly -x, because the number of
    /// whole turns is then uncertain.
    pub(super) fn begin(&mut self, tile: &[Eight]) -> bool {
        let Reading::Angle(first, last, _) = &mut self.reading else { return true };
        *last = direction(tile, *first, 0);
        last.x > 0.0 || last.y.abs() > 1e-6
    }

    /// Adds the rows of a part of a tile. The values have the same bits as those of the
    /// [sampler](linkage::solver::Sampler).
    /// `row` is the first row of the tile, and `given` has the angles of the crank.
    #[inline(always)]
    pub(super) fn add<S: Simd>(&mut self, row: usize, given: &Eight, tile: &Window<S>) {
        let mut values = match &mut self.reading {
            Reading::Column(column) => tile.get(*column),
            Reading::Given => tile.of(given),
            Reading::Size(column) => {
                let force = tile.vector(*column);
                force.dot(force).sqrt()
            }
            Reading::Square(column) => {
                let force = tile.vector(*column);
                force.dot(force)
            }
            Reading::Angle(first, last, turns) => angles(*first, last, turns, tile),
            Reading::Point(first, local, reading) => point(*first, *local, *reading, tile),
            Reading::Sine(links, spans, lengths) => {
                let a = tile.vector(links[0] + DIRECTION).rotate(spans[0]);
                let b = tile.vector(links[1] + DIRECTION).rotate(spans[1]);
                a.cross(b).abs() / *lengths
            }
        };
        if self.unit != 1.0 {
            values = values / self.unit;
        }
        tile.add_to(&mut self.fault.0, values * 0.0);
        add(&mut self.tally, row, values, tile);
    }
}

/// [`Tally::add`] for a part of a tile.
/// The arms call functions, because the compiler would not vectorise closures.
#[inline(always)]
fn add<S: Simd>(tally: &mut Tally, row: usize, values: Lanes<S>, part: &Window<S>) {
    match tally {
        Tally::Max(own) => raise(own, row, values, part),
        Tally::Min(own) => raise(own, row, -values, part),
        Tally::MaxAbs(own) => raise(own, row, values.abs(), part),
        Tally::Range([most, least]) => {
            raise(most, row, values, part);
            raise(least, row, -values, part);
        }
        Tally::Mean(own) => sum(own, row, values, part),
        Tally::Rms(own) => sum(own, row, values * values, part),
        Tally::At(wanted, value) => {
            let first = row + part.part * S::F64_LANES;
            if (first..first + S::F64_LANES).contains(wanted) {
                *value = values.to_column()[*wanted - first];
            }
        }
        Tally::Column(all) => all.extend_from_slice(&values.to_column()[..S::F64_LANES]),
    }
}

#[inline(always)]
fn raise<S: Simd>(peak: &mut LanePeak, row: usize, scores: Lanes<S>, part: &Window<S>) {
    let (best, at) = (part.in_array(&peak.scores), part.in_array(&peak.rows));
    let is_better = scores.exceeds(best);
    part.put_in(&mut peak.scores, is_better.of(scores, best));
    part.put_in(&mut peak.rows, is_better.of(part.in_array(&COUNT) + row as f64, at));
}

#[inline(always)]
fn sum<S: Simd>(own: &mut Weighted, row: usize, values: Lanes<S>, part: &Window<S>) {
    let weights = part.in_array(&own.weights[row / TILE]);
    part.add_to(&mut own.sums, weights * values);
}

/// Direction of a link in a row of a tile.
fn direction(tile: &[Eight], first: usize, row: usize) -> Vec2 {
    Vec2::new(tile[first + DIRECTION].0[row], tile[first + DIRECTION + 1].0[row])
}

/// Angles of a link, as [`Turns`](crate::assur::turns::Turns) counts them.
fn angles<S: Simd>(first: usize, last: &mut Vec2, turns: &mut f64, tile: &Window<S>) -> Lanes<S> {
    let mut found = [0.0; TILE];
    for (lane, angle) in found[..S::F64_LANES].iter_mut().enumerate() {
        let now = direction(tile.columns, first, tile.part * S::F64_LANES + lane);
        *turns += crossing(*last, now);
        *last = now;
        *angle = principal(now) + std::f64::consts::TAU * *turns;
    }
    Lanes::of_column(tile.simd, &found)
}

/// A coordinate of a point, of its velocity or of its acceleration.
#[inline(always)]
fn point<S: Simd>(first: usize, local: Vec2, reading: OfPoint, tile: &Window<S>) -> Lanes<S> {
    let arm = tile.vector(first + DIRECTION).rotate(local);
    let place = tile.vector(first + ORIGIN) + arm;
    let omega = tile.get(first + OMEGA);
    let velocity = tile.vector(first + VELOCITY) + arm.turned() * omega;
    let turned = tile.vector(first + ACCELERATION) + arm.turned() * tile.get(first + ALPHA);
    let acceleration = turned - arm * (omega * omega);
    match reading {
        OfPoint::X => place.x,
        OfPoint::Y => place.y,
        OfPoint::VelocityX => velocity.x,
        OfPoint::VelocityY => velocity.y,
        OfPoint::AccelerationX => acceleration.x,
        OfPoint::AccelerationY => acceleration.y,
    }
}
