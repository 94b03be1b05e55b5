//! Smallest distances and first meetings of pairs over the range.
//!
//! The search halves a part of the range until a lower bound is proven for all distances in the part. This bound is the
//! smallest distance found minus the tolerance.
//! The search ends when every part is proven, so no instant is skipped.
//! Parts that remain unproven at the smallest size, or when the budget is used up, are reported.

use linkage::error::Result;
use linkage::math::extremum::golden;
use linkage::math::{KeepNan, Vec2};

use super::gap::{Gap, PlacedSolid, Solid, gap};
use super::tube::{MOST_HALVINGS, RangePart, Slice, Tubes};

/// Number of golden-section steps in a bracket around the smallest distance found.
/// `STRIDES` is the largest number of brackets. Each bracket after the first lies around the smallest distance of the
/// bracket before.
const REFINEMENTS: usize = 30;
const STRIDES: usize = 8;
/// Number of further halvings, after [`MOST_HALVINGS`], that enclose the crank angle of a first meeting more narrowly.
const FURTHER: u32 = 6;

/// A part of the range; whether its bounds are proven; the lower bound of each unfinished pair's distance (m).
type Bounds = (RangePart, bool, Vec<(usize, f64)>);

/// Smallest distance of a pair over the range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smallest {
    /// Smallest distance found (m), at `crank` and between `points`; 0 if the bodies meet.
    pub distance: f64,
    /// Lower bound of the distance over the range (m). The bound ignores unproven parts of the range.
    pub least: f64,
    /// Value of the [range variable](super::RangeVariable) at the smallest distance (rad, m or s).
    pub crank: f64,
    /// Nearest points at the value `crank` of the range variable, on the first and the second body (m, world).
    pub points: [Vec2; 2],
}

/// First pose in which a pair comes as near as a given distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Two values of the [range variable](super::RangeVariable) (rad, m or s), in the direction of motion, that enclose
    /// the meeting.
    /// Up to the first value, the distance is proven to be larger than the given distance.
    /// The proof does not cover the parts of the range that are reported as unproven.
    /// At the second value, the distance is at most the given distance plus the contact distance.
    pub cranks: [f64; 2],
    /// Point of the meeting at the second value (m, world).
    pub place: Vec2,
}

/// Inputs and operation counts of a search.
pub struct DistanceSearch<'a, 'c> {
    /// The range, with the tubes of the links.
    pub tubes: &'a mut Tubes<'c>,
    /// All bodies.
    pub solids: &'a [Solid],
    /// Tolerance of a distance (m).
    pub tolerance: f64,
    /// Distance that counts as contact (m).
    pub touch: f64,
    /// Number of pairs of pieces whose nearest points were computed.
    pub asked: usize,
    /// Number of pairs of pieces that may still be examined.
    pub budget: usize,
    /// Parts of the range (rad, m or s) for which nothing is proven.
    pub open: Vec<[f64; 2]>,
}

impl DistanceSearch<'_, '_> {
    fn gap(&mut self, pair: [usize; 2], slice: &Slice, enough: f64) -> Gap {
        let [a, b] = pair.map(|body| &self.solids[body]);
        self.between([a, b], [&a.placed(slice), &b.placed(slice)], slice, enough)
    }

    fn between(&mut self, bodies: [&Solid; 2], places: [&PlacedSolid; 2], slice: &Slice, enough: f64) -> Gap {
        self.budget = self.budget.saturating_sub(bodies[0].pieces.len() * bodies[1].pieces.len());
        gap(bodies, places, slice, self.tubes.rounding(), enough, &mut self.asked)
    }

    /// Computes the smallest distances of pairs of bodies.
    ///
    /// # Errors
    /// The errors of the pose solver.
    pub fn smallest(&mut self, pairs: &[[usize; 2]]) -> Result<Vec<Smallest>> {
        let unknown =
            Smallest { distance: f64::INFINITY, least: f64::INFINITY, crank: f64::NAN, points: [Vec2::zeros(); 2] };
        let mut best = vec![unknown; pairs.len()];
        let mut parts: Vec<(RangePart, Vec<usize>)> =
            self.tubes.parts().map(|part| (part, (0..pairs.len()).collect())).collect();
        while !parts.is_empty() {
            // A small distance found in one part makes halvings of other parts unnecessary.
            // All parts of the present size are therefore evaluated before any part is halved.
            let mut bounds: Vec<Bounds> = Vec::with_capacity(parts.len());
            for (part, alive) in parts {
                let slice = self.tubes.at(part)?;
                let placed: Vec<Option<PlacedSolid>> = (0..self.solids.len())
                    .map(|body| {
                        let needed = alive.iter().any(|&pair| pairs[pair].contains(&body));
                        needed.then(|| self.solids[body].placed(&slice))
                    })
                    .collect();
                let mut least = Vec::with_capacity(alive.len());
                for pair in alive {
                    let [a, b] = pairs[pair];
                    let (Some(one), Some(two)) = (&placed[a], &placed[b]) else { continue };
                    let (solids, enough) = (self.solids, best[pair].distance);
                    let found = self.between([&solids[a], &solids[b]], [one, two], &slice, enough);
                    if found.now < best[pair].distance {
                        let own = &mut best[pair];
                        (own.distance, own.crank, own.points) = (found.now, slice.crank, found.points);
                    }
                    least.push((pair, found.least));
                }
                bounds.push((part, slice.sound, least));
            }
            parts = Vec::new();
            for (part, sound, least) in bounds {
                let mut alive = Vec::new();
                for (pair, least) in least {
                    let own = &mut best[pair];
                    if sound && least >= own.distance - self.tolerance {
                        own.least = own.least.smaller(least);
                    } else if own.distance > 0.0 {
                        alive.push(pair);
                    }
                }
                if alive.is_empty() {
                    continue;
                }
                if part.halvings < MOST_HALVINGS && self.budget > 0 {
                    parts.extend(part.halves().map(|half| (half, alive.clone())));
                } else {
                    self.leave(part);
                }
            }
        }
        for (own, &pair) in best.iter_mut().zip(pairs) {
            if own.distance > 0.0 && own.distance.is_finite() {
                self.refine(own, pair)?;
            }
            own.least = own.least.smaller(own.distance).larger(0.0);
        }
        Ok(best)
    }

    /// Records a part of the range for which nothing is proven.
    fn leave(&mut self, part: RangePart) {
        self.open.push(self.tubes.ends(part));
    }

    /// Searches for a smaller distance near the crank angle of the smallest distance found so far.
    fn refine(&mut self, own: &mut Smallest, pair: [usize; 2]) -> Result<()> {
        let [from, to] = self.tubes.range;
        let (low, high) = (from.smaller(to), from.larger(to));
        let wide = self.tubes.stride((self.tolerance / self.tubes.scale).sqrt());
        for _ in 0..STRIDES {
            let begun = own.crank;
            let ends = [(begun - wide).larger(low), (begun + wide).smaller(high)];
            let mut look = |crank: f64| {
                let slice = self.tubes.slice(crank, 0.0)?;
                let found = self.gap(pair, &slice, f64::INFINITY);
                if found.now < own.distance {
                    (own.distance, own.crank, own.points) = (found.now, crank, found.points);
                }
                Ok::<f64, linkage::Error>(-found.now)
            };
            golden(ends, REFINEMENTS, &mut look)?;
            // The ends are evaluated separately, because golden section never evaluates them.
            look(ends[0])?;
            look(ends[1])?;
            if (own.crank - begun).abs() < 0.9 * wide {
                break;
            }
        }
        Ok(())
    }

    /// Finds where a pair first comes as near as `threshold` (m).
    /// If the result is `None`, the distance of the pair is proven larger than `threshold`.
    /// The proof does not cover the parts of the range that are reported as unproven.
    ///
    /// # Errors
    /// The errors of the pose solver.
    pub fn first(&mut self, pair: [usize; 2], threshold: f64) -> Result<Option<Meeting>> {
        let enough = threshold + self.touch;
        let mut ahead: Vec<RangePart> = self.tubes.parts().rev().collect();
        // End of the part of the range that is proven clear.
        let mut clear = None;
        while let Some(part) = ahead.pop() {
            let slice = self.tubes.at(part)?;
            let found = self.gap(pair, &slice, f64::INFINITY);
            let [from, to] = self.tubes.ends(part);
            if slice.sound && found.least > threshold {
                clear = Some(to);
                continue;
            }
            // A part with proven bounds is halved `FURTHER` more times. The motion within the part is then smaller than
            // the contact distance.
            let narrow = part.halvings >= MOST_HALVINGS + if slice.sound { FURTHER } else { 0 };
            if narrow {
                for crank in [slice.crank, to] {
                    let there = self.tubes.slice(crank, 0.0)?;
                    let found = self.gap(pair, &there, f64::INFINITY);
                    if found.now <= enough {
                        let place = (found.points[0] + found.points[1]) / 2.0;
                        return Ok(Some(Meeting { cranks: [clear.unwrap_or(from), crank], place }));
                    }
                }
            }
            if narrow || self.budget == 0 {
                self.leave(part);
                continue;
            }
            ahead.extend(part.halves().into_iter().rev());
        }
        Ok(None)
    }
}
