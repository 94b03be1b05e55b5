//! Quantities of every pose of a case batch, and their statistics.

use std::array;
use std::ops::Range;

use super::lanes::{Lanes, TILE, TileColumn, Window};
use super::poses::{ALPHA, DIRECTION, Layout, OMEGA};
use super::registers::Registers;
use crate::assur::turns::{crossing, principal};
use linkage::case::Case;
use linkage::math::tally::{LANES, LanePeak, PEAK_LANES, Tally};
use linkage::math::{Vec2, cross, rotated};
use linkage::mechanism::{GroupId, JointId, LinkId};
use linkage::trajectory::OfPoint;

/// Number of tiles that are solved before their statistics are computed. All columns of a block stay in the fastest
/// cache, and a statistic stays in registers during a block.
pub(super) const BLOCK: usize = 4;
/// The rows of a tile, counted from its first row.
const COUNT: [f64; TILE] = {
    let (mut count, mut row) = ([0.0; TILE], 0);
    while row < TILE {
        count[row] = row as f64;
        row += 1;
    }
    count
};
const _: () = assert!(PEAK_LANES == TILE);

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
    /// Whether the rows of an extreme are wanted; if `false`, the statistic has only its value.
    has_rows: bool,
    reading: Reading,
    /// Sums of all values so far. A sum is not finite if one of its values is not.
    fault: [f64; TILE],
}

/// Sums an expression over a block, lane by lane. The variables of the expression are a value and the number of its
/// eight rows in the block. A closure would not be vectorised.
macro_rules! sum {
    ($on:expr, $sums:expr, $block:expr, |$value:ident, $eight:ident, $part:ident| $summand:expr) => {
        for $part in 0..LANES / R::One::LANES {
            let mut sum = Lanes::of($on, &$sums, $part);
            for ($eight, values) in $block.iter().enumerate() {
                let $value = Lanes::of($on, values, $part);
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
    /// A statistic of a quantity in the unit `unit`, a multiple of the SI unit. Rows of extremes are not wanted.
    #[must_use]
    pub fn of(quantity: PoseQuantity, unit: f64, tally: Tally) -> PoseTally {
        PoseTally { quantity, unit, tally, has_rows: false, reading: Reading::Given, fault: [0.0; TILE] }
    }

    /// Asks for the rows of extremes, for [`Tally::rows`].
    pub fn want_rows(&mut self) {
        self.has_rows = true;
    }

    /// Whether `other` is the same statistic of the same quantity in the same unit.
    #[must_use]
    pub fn is_like(&self, other: &PoseTally) -> bool {
        self.quantity == other.quantity && self.unit == other.unit && self.tally == other.tally
    }

    /// Whether all values of the last case are finite. `false` also if a sum of values overflows.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.fault.iter().sum::<f64>().is_finite()
    }

    /// Prepares the statistic for the first row of a case.
    pub(super) fn start(&mut self, case: &Case, layout: Layout) {
        let link = |link: LinkId| layout.link(link).expect("a moving link");
        let links = case.mechanism.links();
        self.tally.clear();
        self.fault = [0.0; TILE];
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
    pub(super) fn begin(&mut self, tile: &[TileColumn]) -> bool {
        let Reading::Angle(first, last, _) = &mut self.reading else { return true };
        *last = direction(tile, *first, 0);
        last.x > 0.0 || last.y.abs() > 1e-6
    }

    /// Adds the rows of a block. The values have the same bits as those of the
    /// [sampler](linkage::solver::Sampler).
    /// `rows` are the rows of the block, `angles` are the angles of the crank, and `tiles` has the columns of one tile
    /// after the other. `block` is working memory.
    #[inline(always)]
    pub(super) fn add<'a, R: Registers>(
        &mut self,
        on: R,
        rows: Range<usize>,
        angles: impl Iterator<Item = &'a TileColumn>,
        tiles: &mut [TileColumn],
        block: &mut TileBlock,
    ) {
        let columns = tiles.len() / BLOCK;
        let block = &mut block.0[..rows.len().div_ceil(TILE)];
        let unit = self.unit;
        // Reads the values of all rows, and adds them to `fault`. A closure would not be vectorised.
        macro_rules! each {
            (|$tile:ident, $values:ident| $value:expr) => {
                for part in 0..Window::<R>::PARTS {
                    let mut fault = Lanes::of(on, &self.fault, part);
                    for (place, $values) in block.iter_mut().enumerate() {
                        let $tile = Window { on, columns: &mut tiles[place * columns..][..columns], part };
                        let value = $value;
                        let value = if unit == 1.0 { value } else { value / unit };
                        fault = fault + value;
                        value.put($values, part);
                    }
                    fault.put(&mut self.fault, part);
                }
            };
        }
        match self.reading {
            Reading::Column(column) => each!(|tile, values| tile.get(column)),
            Reading::Size(column) => each!(|tile, values| {
                let force = tile.vector(column);
                force.dot(force).sqrt()
            }),
            Reading::Square(column) => each!(|tile, values| {
                let force = tile.vector(column);
                force.dot(force)
            }),
            Reading::Point(first, local, reading) => each!(|tile, values| point(first, local, reading, &tile)),
            Reading::Sine(links, spans, lengths) => each!(|tile, values| {
                let a = tile.vector(links[0] + DIRECTION).rotate(spans[0]);
                let b = tile.vector(links[1] + DIRECTION).rotate(spans[1]);
                a.cross(b).abs() / lengths
            }),
            Reading::Given => {
                block.iter_mut().zip(angles).for_each(|(values, own)| *values = own.0);
                each!(|tile, values| Lanes::of(tile.on, values, tile.part));
            }
            Reading::Angle(first, ref mut last, ref mut turns) => {
                for (columns, values) in tiles.chunks_exact(columns).zip(&mut *block) {
                    with_turns(first, last, turns, columns, values);
                }
                each!(|tile, values| Lanes::of(tile.on, values, tile.part));
            }
        }
        self.count(on, rows, block);
    }

    /// [`Tally::add`] for a block.
    #[inline(always)]
    fn count<R: Registers>(&mut self, on: R, rows: Range<usize>, block: &[[f64; TILE]]) {
        let (row, has_rows) = (rows.start, self.has_rows);
        let (eights, _) = block.as_flattened().as_chunks::<LANES>();
        let eights = &eights[..rows.len().div_ceil(LANES)];
        match &mut self.tally {
            Tally::Max(own) => raise::<R, Plain>(own, on, row, has_rows, block),
            Tally::Min(own) => raise::<R, Negated>(own, on, row, has_rows, block),
            Tally::MaxAbs(own) => raise::<R, Magnitude>(own, on, row, has_rows, block),
            Tally::Range([most, least]) => {
                raise::<R, Plain>(most, on, row, has_rows, block);
                raise::<R, Negated>(least, on, row, has_rows, block);
            }
            Tally::Mean(own) => {
                let weights = &own.weights[row / LANES..];
                sum!(on.one(), own.sums, eights, |value, eight, part| {
                    Lanes::of(on.one(), &weights[eight], part) * value
                });
            }
            Tally::Rms(own) => {
                let weights = &own.weights[row / LANES..];
                sum!(on.one(), own.sums, eights, |value, eight, part| {
                    Lanes::of(on.one(), &weights[eight], part) * (value * value)
                });
            }
            Tally::At(wanted, value) => {
                let place = wanted.checked_sub(row).and_then(|own| Some(eights.get(own / LANES)?[own % LANES]));
                *value = place.unwrap_or(*value);
            }
            Tally::Column(all) => all.extend_from_slice(eights.as_flattened()),
        }
    }
}

/// The values of a quantity in a block of tiles.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct TileBlock(pub(super) [[f64; TILE]; BLOCK]);

/// The score of a value: the largest score is the wanted extreme.
trait Score {
    fn of<R: Registers>(value: Lanes<R>) -> Lanes<R>;
}

/// For the largest value.
struct Plain;

/// For the smallest value.
struct Negated;

/// For the largest absolute value.
struct Magnitude;

impl Score for Plain {
    #[inline(always)]
    fn of<R: Registers>(value: Lanes<R>) -> Lanes<R> {
        value
    }
}

impl Score for Negated {
    #[inline(always)]
    fn of<R: Registers>(value: Lanes<R>) -> Lanes<R> {
        -value
    }
}

impl Score for Magnitude {
    #[inline(always)]
    fn of<R: Registers>(value: Lanes<R>) -> Lanes<R> {
        value.abs()
    }
}

#[inline(always)]
fn raise<R: Registers, S: Score>(peak: &mut LanePeak, on: R, row: usize, has_rows: bool, block: &[[f64; TILE]]) {
    for part in 0..Window::<R>::PARTS {
        let mut scores = Lanes::of(on, &peak.scores, part);
        if has_rows {
            let mut rows = Lanes::of(on, &peak.rows, part);
            let mut now = Lanes::of(on, &COUNT, part) + row as f64;
            for values in block {
                let score = S::of(Lanes::of(on, values, part));
                let is_better = score.exceeds(scores);
                (scores, rows) = (is_better.of(score, scores), is_better.of(now, rows));
                now = now + TILE as f64;
            }
            rows.put(&mut peak.rows, part);
        } else {
            for values in block {
                let score = S::of(Lanes::of(on, values, part));
                scores = score.exceeds(scores).of(score, scores);
            }
        }
        scores.put(&mut peak.scores, part);
    }
}

/// Direction of a link in a row of a tile.
fn direction(tile: &[TileColumn], first: usize, row: usize) -> Vec2 {
    Vec2::new(tile[first + DIRECTION].0[row], tile[first + DIRECTION + 1].0[row])
}

/// Angles of a link in a tile, as [`Turns`](crate::assur::turns::Turns) counts them.
fn with_turns(first: usize, last: &mut Vec2, turns: &mut f64, tile: &[TileColumn], angles: &mut [f64; TILE]) {
    for (row, angle) in angles.iter_mut().enumerate() {
        let now = direction(tile, first, row);
        *turns += crossing(*last, now);
        *last = now;
        *angle = principal(now) + std::f64::consts::TAU * *turns;
    }
}

/// A coordinate of a point, of its velocity or of its acceleration.
#[inline(always)]
fn point<R: Registers>(first: usize, local: Vec2, reading: OfPoint, tile: &Window<R>) -> Lanes<R> {
    let link = tile.link(first);
    let [place, velocity, acceleration] = link.at(link.direction.rotate(local));
    match reading {
        OfPoint::X => place.x,
        OfPoint::Y => place.y,
        OfPoint::VelocityX => velocity.x,
        OfPoint::VelocityY => velocity.y,
        OfPoint::AccelerationX => acceleration.x,
        OfPoint::AccelerationY => acceleration.y,
    }
}
