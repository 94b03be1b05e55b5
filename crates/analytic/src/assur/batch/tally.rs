//! Quantities of every pose of a case batch, and their statistics.

use std::array;

use super::lanes::{Eight, Lanes, TILE, Window};
use super::poses::{ACCELERATION, ALPHA, DIRECTION, Layout, OMEGA, ORIGIN, VELOCITY};
use super::registers::Registers;
use crate::assur::turns::{crossing, principal};
use linkage::case::Case;
use linkage::math::tally::{LanePeak, Tally};
use linkage::math::{Vec2, cross, rotated};
use linkage::mechanism::{GroupId, JointId, LinkId};
use linkage::trajectory::OfPoint;

/// Number of tiles that are solved before their statistics are computed. All columns of a block stay in the fastest
/// cache, and a statistic stays in registers during a block.
pub(super) const BLOCK: usize = 8;
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

/// Replaces every value of a block by an expression of it. A closure would not be vectorised.
macro_rules! change {
    ($on:expr, $block:expr, |$value:ident| $changed:expr) => {
        for values in &mut *$block {
            for part in 0..Window::<R>::PARTS {
                let $value = Lanes::of($on, &values.0, part);
                $changed.put(&mut values.0, part);
            }
        }
    };
}

/// Sums an expression over a block, lane by lane. The variables of the expression are a value and the number of its
/// tile.
macro_rules! sum {
    ($on:expr, $sums:expr, $block:expr, |$value:ident, $tile:ident, $part:ident| $summand:expr) => {
        for $part in 0..Window::<R>::PARTS {
            let mut sum = Lanes::of($on, &$sums, $part);
            for ($tile, values) in $block.iter().enumerate() {
                let $value = Lanes::of($on, &values.0, $part);
                sum = sum + $summand;
            }
            sum.put(&mut $sums, $part);
        }
    };
}

/// How a quantity is read from the columns of a tile.
#[derive(Clone, Copy, Debug)]
enum Reading {
    Column(usize),
    Size(usize),
    Square(usize),
    /// Angle of the crank, which is given.
    Given,
    /// Angle of a link: first column of the link, its direction in the last row read so far, and its whole turns.
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

    /// Prepares the statistic for the first row of a case.
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

    /// Adds the rows of a block. The values have the same bits as those of the
    /// [sampler](linkage::solver::Sampler).
    /// `row` is the first row of the block, `angles` are the angles of the crank, and every tile has `columns` columns.
    #[inline(always)]
    pub(super) fn add<'a, R: Registers>(
        &mut self,
        on: R,
        row: usize,
        angles: impl ExactSizeIterator<Item = &'a Eight>,
        tiles: &mut [Eight],
        columns: usize,
    ) {
        let mut block = [Eight([0.0; TILE]); BLOCK];
        let block = &mut block[..angles.len()];
        // Reads the values of all rows. A closure would not be vectorised.
        macro_rules! value {
            (|$tile:ident| $value:expr) => {
                for (columns, values) in tiles.chunks_exact_mut(columns).zip(&mut *block) {
                    for part in 0..Window::<R>::PARTS {
                        let $tile = Window { on, columns: &mut *columns, part };
                        let found = $value;
                        found.put(&mut values.0, part);
                    }
                }
            };
        }
        match &mut self.reading {
            Reading::Given => block.iter_mut().zip(angles).for_each(|(values, own)| *values = *own),
            Reading::Column(column) => value!(|tile| tile.get(*column)),
            Reading::Size(column) => value!(|tile| {
                let force = tile.vector(*column);
                force.dot(force).sqrt()
            }),
            Reading::Square(column) => value!(|tile| {
                let force = tile.vector(*column);
                force.dot(force)
            }),
            Reading::Angle(first, last, turns) => value!(|tile| with_turns(*first, last, turns, &tile)),
            Reading::Point(first, local, reading) => value!(|tile| point(*first, *local, *reading, &tile)),
            Reading::Sine(links, spans, lengths) => value!(|tile| {
                let a = tile.vector(links[0] + DIRECTION).rotate(spans[0]);
                let b = tile.vector(links[1] + DIRECTION).rotate(spans[1]);
                a.cross(b).abs() / *lengths
            }),
        }
        if self.unit != 1.0 {
            change!(on, block, |value| value / self.unit);
        }
        sum!(on, self.fault.0, block, |value, _tile, part| value * 0.0);
        add(&mut self.tally, on, row, block);
    }
}

/// [`Tally::add`] for a block.
#[inline(always)]
fn add<R: Registers>(tally: &mut Tally, on: R, row: usize, block: &mut [Eight]) {
    match tally {
        Tally::Max(own) => raise(own, on, row, block),
        Tally::Min(own) => {
            change!(on, block, |value| -value);
            raise(own, on, row, block);
        }
        Tally::MaxAbs(own) => {
            change!(on, block, |value| value.abs());
            raise(own, on, row, block);
        }
        Tally::Range([most, least]) => {
            raise(most, on, row, block);
            change!(on, block, |value| -value);
            raise(least, on, row, block);
        }
        Tally::Mean(own) => {
            let weights = &own.weights[row / TILE..];
            sum!(on, own.sums, block, |value, tile, part| Lanes::of(on, &weights[tile], part) * value);
        }
        Tally::Rms(own) => {
            let weights = &own.weights[row / TILE..];
            sum!(on, own.sums, block, |value, tile, part| Lanes::of(on, &weights[tile], part) * (value * value));
        }
        Tally::At(wanted, value) => {
            let place = wanted.checked_sub(row).and_then(|own| Some(block.get(own / TILE)?.0[own % TILE]));
            *value = place.unwrap_or(*value);
        }
        Tally::Column(all) => all.extend(block.iter().flat_map(|values| values.0)),
    }
}

#[inline(always)]
fn raise<R: Registers>(peak: &mut LanePeak, on: R, row: usize, block: &[Eight]) {
    for part in 0..Window::<R>::PARTS {
        let (mut best, mut at) = (Lanes::of(on, &peak.scores, part), Lanes::of(on, &peak.rows, part));
        let mut now = Lanes::of(on, &COUNT, part) + row as f64;
        for scores in block {
            let scores = Lanes::of(on, &scores.0, part);
            let is_better = scores.exceeds(best);
            (best, at) = (is_better.of(scores, best), is_better.of(now, at));
            now = now + TILE as f64;
        }
        best.put(&mut peak.scores, part);
        at.put(&mut peak.rows, part);
    }
}

/// Direction of a link in a row of a tile.
fn direction(tile: &[Eight], first: usize, row: usize) -> Vec2 {
    Vec2::new(tile[first + DIRECTION].0[row], tile[first + DIRECTION + 1].0[row])
}

/// Angles of a link, as [`Turns`](crate::assur::turns::Turns) counts them.
fn with_turns<R: Registers>(first: usize, last: &mut Vec2, turns: &mut f64, tile: &Window<R>) -> Lanes<R> {
    let mut found = [0.0; TILE];
    for (lane, angle) in found[..R::LANES].iter_mut().enumerate() {
        let now = direction(tile.columns, first, tile.part * R::LANES + lane);
        *turns += crossing(*last, now);
        *last = now;
        *angle = principal(now) + std::f64::consts::TAU * *turns;
    }
    Lanes::of(tile.on, &found, 0)
}

/// A coordinate of a point, of its velocity or of its acceleration.
#[inline(always)]
fn point<R: Registers>(first: usize, local: Vec2, reading: OfPoint, tile: &Window<R>) -> Lanes<R> {
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
