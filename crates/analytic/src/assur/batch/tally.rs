//! Quantities of every pose of a case batch, and their statistics.

use std::array;
use std::ops::Range;

use super::lanes::{Columns, Lanes, TILE, Tile, TileColumn};
use super::poses::{ALPHA, Layout, LinkColumns, OMEGA};
use crate::assur::turns::{crossing, principal};
use linkage::case::Case;
use linkage::math::tally::{LANES, LanePeak, Tally};
use linkage::math::{Vec2, cross, rotated};
use linkage::mechanism::{GroupId, JointId, LinkId};
use linkage::trajectory::OfPoint;
use pulp::Simd;

/// The number of each lane.
const COUNT: [f64; LANES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

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
    /// Sums of all values so far, by lane, unless the statistic is such a sum itself. A sum is not finite if one of its
    /// values is not.
    fault: [f64; LANES],
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
        PoseTally { quantity, unit, tally, has_rows: false, reading: Reading::Given, fault: [0.0; LANES] }
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
        let sums = if let Tally::Mean(own) | Tally::Rms(own) = &self.tally { &own.sums } else { &self.fault };
        sums.iter().sum::<f64>().is_finite()
    }

    /// Prepares the statistic for the first row of a case.
    pub(super) fn start(&mut self, case: &Case, layout: Layout) {
        let link = |link: LinkId| layout.link(link).expect("a moving link");
        let links = case.mechanism.links();
        self.tally.clear();
        self.fault = [0.0; LANES];
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
    pub(super) fn begin<S: Simd>(&mut self, tile: Columns<S>) -> bool {
        let Reading::Angle(first, last, _) = &mut self.reading else { return true };
        *last = tile.link(*first).direction(0);
        last.x > 0.0 || last.y.abs() > 1e-6
    }

    /// Adds the rows of a tile. The values have the same bits as those of the [sampler](linkage::solver::Sampler).
    /// `angles` are the angles of the crank, and `values` is one column of working memory.
    #[inline(always)]
    pub(super) fn add<S: Simd>(&mut self, rows: Range<usize>, angles: &TileColumn, tile: Tile<S>, values: Columns<S>) {
        let (unit, blocks, on) = (self.unit, rows.len().div_ceil(LANES).min(TILE / LANES), values.on);
        // Writes the values of all rows. A closure would not be vectorised.
        macro_rules! each {
            (|$part:ident| $value:expr) => {
                if unit == 1.0 {
                    for $part in tile.parts() {
                        values.put(0, $part, $value);
                    }
                } else {
                    for $part in tile.parts() {
                        values.put(0, $part, $value / unit);
                    }
                }
            };
        }
        match self.reading {
            Reading::Column(column) if unit == 1.0 => {
                return self.count(on, rows, blocks, OneColumn(tile.columns.column(column)));
            }
            Reading::Column(column) => {
                let column = tile.columns.column(column);
                each!(|part| column.get(0, part));
            }
            Reading::Size(column) => {
                let force = tile.columns.adjacent::<2>(column);
                each!(|part| {
                    let force = force.vector(0, part);
                    force.dot(force).sqrt()
                });
            }
            Reading::Square(column) if unit == 1.0 => {
                return self.count(on, rows, blocks, Squares(tile.columns.adjacent::<2>(column)));
            }
            Reading::Square(column) => {
                let square = Squares(tile.columns.adjacent::<2>(column));
                each!(|part| square.at(part));
            }
            Reading::Point(first, local, reading) => {
                let link = tile.columns.link(first);
                macro_rules! coordinate {
                    ($of:expr, $axis:ident) => {
                        each!(|part| {
                            let link = link.get(part);
                            link.at(link.direction.rotate(local))[$of].$axis
                        })
                    };
                }
                match reading {
                    OfPoint::X => coordinate!(0, x),
                    OfPoint::Y => coordinate!(0, y),
                    OfPoint::VelocityX => coordinate!(1, x),
                    OfPoint::VelocityY => coordinate!(1, y),
                    OfPoint::AccelerationX => coordinate!(2, x),
                    OfPoint::AccelerationY => coordinate!(2, y),
                }
            }
            Reading::Sine(links, spans, lengths) => {
                let [a, b] = links.map(|link| tile.columns.link(link));
                each!(|part| {
                    let (a, b) = (a.get(part).direction.rotate(spans[0]), b.get(part).direction.rotate(spans[1]));
                    a.cross(b).abs() / lengths
                });
            }
            Reading::Given => each!(|part| Lanes::of(on, &angles.0, part)),
            Reading::Angle(first, ref mut last, ref mut turns) => {
                let angles = with_turns(tile.columns.link(first), rows.len(), last, turns);
                each!(|part| Lanes::of(on, &angles.0, part));
            }
        }
        self.count(on, rows, blocks, OneColumn(values));
    }

    /// [`Tally::add`] for the rows of a tile. They fill `blocks` blocks of eight poses.
    #[inline(always)]
    fn count<S: Simd>(&mut self, on: S, rows: Range<usize>, blocks: usize, values: impl PoseValues<S>) {
        let (row, has_rows, fault) = (rows.start, self.has_rows, &mut self.fault);
        let number = |row: usize| values.at(row / S::F64_LANES).number(row % S::F64_LANES);
        // Adds an expression of the values to sums, lane by lane.
        macro_rules! sum {
            ($sums:expr, |$part:ident| $summand:expr) => {
                let mut sums = Eight::of(on, &$sums);
                for block in 0..blocks {
                    for lane in 0..Eight::<S>::REGISTERS {
                        let $part = block * Eight::<S>::REGISTERS + lane;
                        sums.0[lane] = sums.0[lane] + $summand;
                    }
                }
                sums.put(&mut $sums);
            };
        }
        match &mut self.tally {
            Tally::Max(own) => raise::<S, Plain>(on, own, fault, row, has_rows, blocks, values),
            Tally::Min(own) => raise::<S, Negated>(on, own, fault, row, has_rows, blocks, values),
            Tally::MaxAbs(own) => raise::<S, Magnitude>(on, own, fault, row, has_rows, blocks, values),
            Tally::Range([most, least]) => {
                raise::<S, Plain>(on, most, fault, row, has_rows, blocks, values);
                raise::<S, Negated>(on, least, fault, row, has_rows, blocks, values);
            }
            Tally::Mean(own) => {
                let weights = own.weights[row / LANES..].as_flattened();
                sum!(own.sums, |part| Lanes::of(on, weights, part) * values.at(part));
            }
            Tally::Rms(own) => {
                let weights = own.weights[row / LANES..].as_flattened();
                sum!(own.sums, |part| {
                    let value = values.at(part);
                    Lanes::of(on, weights, part) * (value * value)
                });
            }
            Tally::At(wanted, value) => {
                sum!(self.fault, |part| values.at(part));
                if rows.contains(wanted) {
                    *value = number(*wanted - row);
                }
            }
            Tally::Column(all) => {
                sum!(self.fault, |part| values.at(part));
                all.extend((0..rows.len()).map(number));
            }
        }
    }
}

/// The values of a quantity in the poses of a tile.
trait PoseValues<S: Simd>: Copy {
    /// The values in the poses `part`.
    fn at(self, part: usize) -> Lanes<S>;
}

/// The values of a column.
#[derive(Clone, Copy)]
struct OneColumn<'a, S: Simd>(Columns<'a, S>);

/// The squares of the vectors in two columns.
#[derive(Clone, Copy)]
struct Squares<'a, S: Simd>(Columns<'a, S>);

impl<S: Simd> PoseValues<S> for OneColumn<'_, S> {
    #[inline(always)]
    fn at(self, part: usize) -> Lanes<S> {
        self.0.get(0, part)
    }
}

impl<S: Simd> PoseValues<S> for Squares<'_, S> {
    #[inline(always)]
    fn at(self, part: usize) -> Lanes<S> {
        let vector = self.0.vector(0, part);
        vector.dot(vector)
    }
}

/// The score of a value: the largest score is the wanted extreme.
trait Score {
    fn of<S: Simd>(value: Lanes<S>) -> Lanes<S>;
}

/// For the largest value.
struct Plain;

/// For the smallest value.
struct Negated;

/// For the largest absolute value.
struct Magnitude;

impl Score for Plain {
    #[inline(always)]
    fn of<S: Simd>(value: Lanes<S>) -> Lanes<S> {
        value
    }
}

impl Score for Negated {
    #[inline(always)]
    fn of<S: Simd>(value: Lanes<S>) -> Lanes<S> {
        -value
    }
}

impl Score for Magnitude {
    #[inline(always)]
    fn of<S: Simd>(value: Lanes<S>) -> Lanes<S> {
        value.abs()
    }
}

/// Eight numbers, one for each lane of a statistic. They fill the first [`Eight::REGISTERS`] registers.
#[derive(Clone, Copy)]
struct Eight<S: Simd>([Lanes<S>; LANES]);

impl<S: Simd> Eight<S> {
    const REGISTERS: usize = LANES / S::F64_LANES;

    #[inline(always)]
    fn of(on: S, numbers: &[f64; LANES]) -> Self {
        let mut all = [Lanes::splat(on, 0.0); LANES];
        for (lane, own) in all.iter_mut().enumerate().take(Self::REGISTERS) {
            *own = Lanes::of(on, numbers, lane);
        }
        Eight(all)
    }

    #[inline(always)]
    fn put(self, numbers: &mut [f64; LANES]) {
        let columns = Columns::of(self.0[0].on, numbers);
        for lane in 0..Self::REGISTERS {
            columns.put(0, lane, self.0[lane]);
        }
    }
}

/// Adds the values of a tile, beginning with the row `row`, to an extreme and to the sums `fault`.
#[inline(always)]
fn raise<S: Simd, Of: Score>(
    on: S,
    peak: &mut LanePeak,
    fault: &mut [f64; LANES],
    row: usize,
    has_rows: bool,
    blocks: usize,
    values: impl PoseValues<S>,
) {
    let (mut best, mut sums) = (Eight::of(on, &peak.scores), Eight::of(on, fault));
    macro_rules! each {
        (|$is_better:ident, $lane:ident| $then:expr) => {
            for block in 0..blocks {
                for $lane in 0..Eight::<S>::REGISTERS {
                    let value = values.at(block * Eight::<S>::REGISTERS + $lane);
                    let score = Of::of(value);
                    let $is_better = score.exceeds(best.0[$lane]);
                    best.0[$lane] = $is_better.of(score, best.0[$lane]);
                    sums.0[$lane] = sums.0[$lane] + value;
                    $then
                }
            }
        };
    }
    if has_rows {
        let (mut first, mut now) = (Eight::of(on, &peak.rows), Eight::of(on, &COUNT));
        for now in &mut now.0 {
            *now = *now + row as f64;
        }
        each!(|is_better, lane| {
            first.0[lane] = is_better.of(now.0[lane], first.0[lane]);
            now.0[lane] = now.0[lane] + LANES as f64;
        });
        first.put(&mut peak.rows);
    } else {
        each!(|is_better, lane| {});
    }
    best.put(&mut peak.scores);
    sums.put(fault);
}

/// Angles of a link in the first `rows` rows of a tile, as [`Turns`](crate::assur::turns::Turns) counts them.
/// Further rows repeat the last angle.
fn with_turns<S: Simd>(link: LinkColumns<S>, rows: usize, last: &mut Vec2, turns: &mut f64) -> TileColumn {
    let mut angles = [0.0; TILE];
    for (row, angle) in angles.iter_mut().enumerate() {
        let now = if row < rows { link.direction(row) } else { *last };
        *turns += crossing(*last, now);
        *last = now;
        *angle = principal(now) + std::f64::consts::TAU * *turns;
    }
    TileColumn(angles)
}
