//! Area that a body sweeps: the union of all its positions over the range.
//!
//! The plane is divided into squares.
//! A square is divided into four if it is neither proven covered nor proven free.
//! A square is covered if it lies inside the outline at one instant or if a side of the outline passes over it.
//! A square is free if the outline stays away from it during every part of the range.
//! `Sweep::least` proves that a square is free, by a lower bound of the outline's distance from the square.
//! [`super::gap`] computes such a bound for two bodies.
//! The remaining squares lie on the border of the area and determine the error bound of the area.
//! To compute the covered fraction of a remaining square, the border within the square is assumed to be straight.

#[cfg(test)]
mod tests;

use linkage::error::Result;
use linkage::math::{KeepNan, Vec2, cross, rotated};
use linkage::mechanism::LinkId;

use super::tube::{MOST_HALVINGS, RangePart, Track, Tube, Tubes};
use scenario::clearance::Outline;

/// If the outline's border moves farther than this fraction of a square's half diagonal during a part of the range, the
/// part is halved.
const SPREAD: f64 = 0.5;
/// Width of a window divided by the width of a part of the range. The window is a wider part of the range around this
/// part.
/// `ANCESTORS` is the largest number of windows that are tried: around the part itself, then around the wider parts
/// that were halved to obtain this part.
const WINDOW: f64 = 4.0;
const ANCESTORS: usize = 4;
/// If the outline's border moves less than this fraction of a square's half diagonal, no window is tried for the
/// square.
const CROSSING: f64 = 0.02;
/// The first square is divided at most this many times in succession.
const MOST_DIVISIONS: usize = 24;

/// A swept area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Area (m2). Within every square that the border crosses, the border is assumed to be straight.
    pub value: f64,
    /// Proven lower bound: area of the covered squares (m2).
    pub least: f64,
    /// Proven upper bound: area of the covered squares and of the squares on the border (m2).
    pub most: f64,
}

impl Area {
    /// Error bound of the value (m2).
    pub fn error(&self) -> f64 {
        (self.most - self.value).larger(self.value - self.least)
    }
}

/// Part of the range with the tube of the body.
struct Node {
    part: RangePart,
    half: f64,
    tube: Tube,
    parts: Vec<Vec<Track>>,
    sides: Vec<[Track; 2]>,
    parent: Option<u32>,
    halves: Option<u32>,
    /// The sides of the outline and their motion over a wider part of the range around this part, computed on demand.
    window: Option<Window>,
}

/// Sides of an outline with their motion over a part of the range. The list is empty if nothing is proven for the part.
struct Window {
    half: f64,
    sides: Vec<[Track; 2]>,
}

/// Class of a square.
enum Square {
    Covered,
    Free,
    /// Square on the border.
    /// The first field lists the parts of the range during which the outline is near the square.
    /// The second field is the fraction of the square that is covered if the border is straight.
    Border(Vec<u32>, f64),
}

/// Search for the area that one body sweeps.
pub struct Sweep<'a, 'c> {
    tubes: &'a mut Tubes<'c>,
    outline: &'a Outline,
    link: LinkId,
    nodes: Vec<Node>,
    rounding: f64,
    /// Number of tests of a square against a part of the range.
    pub tests: usize,
    /// Parts of the range (rad, m or s) that are left out of the area, because nothing is proven for them.
    pub open: Vec<[f64; 2]>,
}

impl<'a, 'c> Sweep<'a, 'c> {
    /// Prepares the search for the area that `link` sweeps with `outline`.
    pub fn new(tubes: &'a mut Tubes<'c>, link: LinkId, outline: &'a Outline) -> Self {
        let rounding = tubes.rounding();
        Sweep { tubes, outline, link, nodes: Vec::new(), rounding, tests: 0, open: Vec::new() }
    }

    /// Computes the area to the relative tolerance `wanted`.
    /// If the tolerance would take more than `budget` tests, the area is less accurate.
    ///
    /// # Errors
    /// The errors of the pose solver.
    pub fn area(&mut self, wanted: f64, budget: usize) -> Result<Area> {
        let first = self.sound_parts()?;
        if first.is_empty() {
            return Ok(Area { value: 0.0, least: 0.0, most: 0.0 });
        }
        let [low, high] = self.bounds(&first);
        let mut half = (high - low).amax() / 2.0 + self.rounding;
        let (mut open, mut covered) = (vec![((low + high) / 2.0, first, 0.5)], 0.0);
        let mut best = Area { value: 0.0, least: 0.0, most: f64::INFINITY };
        for _ in 0..MOST_DIVISIONS {
            let mut next = Vec::new();
            half /= 2.0;
            for (centre, near, _) in &open {
                for (x, y) in [(-half, -half), (half, -half), (-half, half), (half, half)] {
                    let centre = centre + Vec2::new(x, y);
                    match self.judge(centre, half, near)? {
                        Square::Covered => covered += 4.0 * half * half,
                        Square::Free => {}
                        Square::Border(near, share) => next.push((centre, near, share)),
                    }
                }
            }
            open = next;
            let border = open.len() as f64 * 4.0 * half * half;
            let share: f64 = open.iter().map(|(_, _, share)| share).sum::<f64>() * 4.0 * half * half;
            best = Area { value: covered + share, least: covered, most: covered + border };
            if best.error() <= wanted * best.value || 4 * self.tests > budget {
                break;
            }
        }
        Ok(best)
    }

    /// Divides the range into parts with proven bounds, as far as possible.
    fn sound_parts(&mut self) -> Result<Vec<u32>> {
        let mut ahead: Vec<RangePart> = self.tubes.parts().rev().collect();
        let mut found = Vec::with_capacity(ahead.len());
        while let Some(part) = ahead.pop() {
            let slice = self.tubes.at(part)?;
            if slice.sound {
                found.push(self.node(part, None)?);
            } else if part.halvings < MOST_HALVINGS {
                ahead.extend(part.halves().into_iter().rev());
            } else {
                self.open.push(self.tubes.ends(part));
            }
        }
        Ok(found)
    }

    /// Returns the lower left and upper right corners of a box that contains the outline at all its positions.
    fn bounds(&self, nodes: &[u32]) -> [Vec2; 2] {
        let radius = self.outline.radius();
        let mut ends = [Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)];
        for node in nodes.iter().map(|&node| &self.nodes[node as usize]) {
            for corner in node.parts.iter().flatten() {
                let reach = Vec2::repeat(corner.reach(node.half) + radius);
                ends = [ends[0].inf(&(corner.at - reach)), ends[1].sup(&(corner.at + reach))];
            }
        }
        ends
    }

    fn node(&mut self, part: RangePart, parent: Option<u32>) -> Result<u32> {
        let slice = self.tubes.at(part)?;
        let tube = slice.tubes[self.link];
        let of = |corners: &Vec<Vec2>| corners.iter().map(|&corner| tube.point(corner)).collect();
        self.nodes.push(Node {
            part,
            half: slice.half,
            tube,
            parts: self.outline.parts().iter().map(of).collect(),
            sides: self.sides(&tube),
            parent,
            halves: None,
            window: None,
        });
        Ok(u32::try_from(self.nodes.len() - 1).unwrap_or(u32::MAX))
    }

    fn sides(&self, tube: &Tube) -> Vec<[Track; 2]> {
        self.outline.sides().map(|side| side.map(|end| tube.point(end))).collect()
    }

    /// Whether a side of the outline passes over a whole disc during a window.
    /// A window is a wider part of the range around a node or around one of its ancestors.
    /// Windows are needed because the part of a node may be so short that no side crosses a whole square during this
    /// part.
    fn is_passed(&mut self, node: u32, centre: Vec2, about: f64) -> Result<bool> {
        let mut next = Some(node);
        for _ in 0..ANCESTORS {
            let Some(index) = next else { break };
            if self.nodes[index as usize].window.is_none() {
                let window = self.window(self.nodes[index as usize].part)?;
                self.nodes[index as usize].window = Some(window);
            }
            let own = &self.nodes[index as usize];
            if let Some(Window { half, sides }) = &own.window
                && sides.iter().any(|side| passes(side, *half, centre, about))
            {
                return Ok(true);
            }
            next = own.parent;
        }
        Ok(false)
    }

    fn window(&mut self, part: RangePart) -> Result<Window> {
        let ([from, to], range) = (self.tubes.ends(part), self.tubes.range);
        let (middle, half) = (f64::midpoint(from, to), WINDOW * (to - from).abs() / 2.0);
        let low = (middle - half).larger(range[0].smaller(range[1]));
        let high = (middle + half).smaller(range[0].larger(range[1]));
        let slice = self.tubes.slice(f64::midpoint(low, high), (high - low) / 2.0)?;
        let sides = if slice.sound { self.sides(&slice.tubes[self.link]) } else { Vec::new() };
        Ok(Window { half: slice.half, sides })
    }

    /// Returns the two halves of a part in order. The halves are computed only once.
    /// Returns `None` if nothing is proven for one of the halves.
    fn halves(&mut self, node: u32) -> Result<Option<[u32; 2]>> {
        if let Some(first) = self.nodes[node as usize].halves {
            return Ok(Some([first, first + 1]));
        }
        let [one, two] = self.nodes[node as usize].part.halves();
        if !(self.tubes.at(one)?.sound && self.tubes.at(two)?.sound) {
            return Ok(None);
        }
        let first = self.node(one, Some(node))?;
        self.node(two, Some(node))?;
        self.nodes[node as usize].halves = Some(first);
        Ok(Some([first, first + 1]))
    }

    fn judge(&mut self, centre: Vec2, half: f64, near: &[u32]) -> Result<Square> {
        let about = half * std::f64::consts::SQRT_2 + self.rounding;
        // Coarse parts are tested first: if the outline covers the square during a coarse part, no other part needs to
        // be halved.
        let (mut ahead, mut next) = (near.to_vec(), 0);
        let (mut kept, mut crossing, mut lowest) = (Vec::new(), Vec::new(), (f64::INFINITY, Vec2::new(1.0, 0.0)));
        while let Some(&index) = ahead.get(next) {
            next += 1;
            self.tests += 1;
            let node = &self.nodes[index as usize];
            let (now, away) = self.outline.distance(node.tube.local(centre));
            if now <= -about {
                return Ok(Square::Covered);
            }
            let away = rotated(node.tube.frame().1, away);
            // Point of the border that is nearest to the square.
            // The point may move away from the square or towards it, so only the magnitude of its rate counts.
            let border = node.tube.point(node.tube.local(centre - away * (now + self.outline.radius())));
            let swing = away.dot(&border.rate).abs() * node.half;
            if self.least(node, centre) > about {
                continue;
            }
            if node.sides.iter().any(|side| passes(side, node.half, centre, about)) {
                return Ok(Square::Covered);
            }
            if swing + border.error > SPREAD * about
                && node.part.halvings < MOST_HALVINGS
                && let Some(halves) = self.halves(index)?
            {
                ahead.extend(halves);
                continue;
            }
            kept.push(index);
            if swing > CROSSING * about {
                crossing.push(index);
            }
            if now - swing < lowest.0 {
                lowest = (now - swing, away);
            }
        }
        for index in crossing {
            if self.is_passed(index, centre, about)? {
                return Ok(Square::Covered);
            }
        }
        Ok(if kept.is_empty() { Square::Free } else { Square::Border(kept, share(lowest.0, lowest.1, half)) })
    }

    /// Lower bound of the body's distance from a point over a part of the range (m).
    /// The bound is negative if the body may cover the point.
    fn least(&self, node: &Node, place: Vec2) -> f64 {
        let mut least = f64::INFINITY;
        for part in &node.parts {
            let nearest = nearest(part, place);
            let off = place - nearest;
            let distance = off.norm();
            if distance <= 0.0 {
                return f64::NEG_INFINITY;
            }
            let normal = off / distance;
            let at = |by: f64| {
                let of = |corner: &Track| normal.dot(&(corner.at + corner.rate * by)) + corner.error;
                normal.dot(&place) - part.iter().map(of).fold(f64::NEG_INFINITY, f64::larger)
            };
            least = least.smaller(at(-node.half)).smaller(at(node.half));
        }
        least - self.outline.radius()
    }
}

/// Returns the point of a convex part (point, segment or counter-clockwise polygon) that is nearest to `place`.
/// If `place` lies inside the convex part, `place` itself is returned.
fn nearest(part: &[Track], place: Vec2) -> Vec2 {
    let count = part.len();
    let side = |k: usize| [part[k].at, part[(k + 1) % count].at];
    if count > 2 && (0..count).all(|k| cross(side(k)[1] - side(k)[0], place - side(k)[0]) >= 0.0) {
        return place;
    }
    let sides = if count > 2 { count } else { 1 };
    let mut best = (f64::INFINITY, place);
    for k in 0..sides {
        let found = scenario::clearance::outline::nearest(place, side(k));
        let distance = (found - place).norm();
        if distance < best.0 {
            best = (distance, found);
        }
    }
    best.1
}

/// Whether a side of the outline passes over a whole disc during a part of the range.
/// The disc must be left of the side's line at the start and right of the line at the end, or vice versa.
/// During the whole part, the disc must lie between the two ends of the side.
/// Every point of the disc then lies on the side at some instant.
fn passes([from, to]: &[Track; 2], half: f64, centre: Vec2, about: f64) -> bool {
    let error = from.error + to.error;
    let signed = |by: f64| {
        let [a, b] = [from, to].map(|end| end.at + end.rate * by);
        cross(b - a, centre - a) / (b - a).norm()
    };
    let [before, after] = [signed(-half), signed(half)];
    // The limit of the distance contains twice the sum of the position errors of the side's two ends.
    // If these ends are hardly farther apart than their errors, the direction of the side is not proven.
    let sure = about + 2.0 * error;
    if !(before.abs() > sure && after.abs() > sure && before * after < 0.0) {
        return false;
    }
    // (centre - a) . (b - a) and (centre - b) . (a - b) are quadratic functions of the crank angle.
    // Each function has its smallest value at an end of the part of the range, or at the vertex of its parabola.
    let beyond = |a: &Track, b: &Track| {
        let (own, along) = (centre - a.at, b.at - a.at);
        let (moved, turned) = (-a.rate, b.rate - a.rate);
        let [c0, c1, c2] = [own.dot(&along), own.dot(&turned) + moved.dot(&along), moved.dot(&turned)];
        let at = |by: f64| c0 + (c1 + c2 * by) * by;
        let ends = at(-half).smaller(at(half));
        let vertex = -c1 / (2.0 * c2);
        let least = if c2 > 0.0 && vertex.abs() < half { at(vertex) } else { ends };
        let (long, wide) = (along.norm() + turned.norm() * half, own.norm() + moved.norm() * half);
        let doubt = (about + a.error) * (long + error) + wide * error;
        least > doubt
    };
    let longest = (to.at - from.at).norm();
    longest > 4.0 * error && beyond(from, to) && beyond(to, from)
}

/// Returns the fraction of a square's area in which `value` + `away` . (place - centre) <= 0.
/// `half` is half the length of the square's side.
fn share(value: f64, away: Vec2, half: f64) -> f64 {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Vec2::new(x, y) * half);
    let mut kept: Vec<Vec2> = Vec::with_capacity(6);
    for k in 0..4 {
        let [a, b] = [corners[k], corners[(k + 1) % 4]];
        let [at_a, at_b] = [a, b].map(|corner| value + away.dot(&corner));
        if at_a <= 0.0 {
            kept.push(a);
        }
        if (at_a <= 0.0) != (at_b <= 0.0) {
            kept.push(a + (b - a) * (at_a / (at_a - at_b)));
        }
    }
    let around = |k: usize| cross(kept[k], kept[(k + 1) % kept.len()]);
    (0..kept.len()).map(around).sum::<f64>() / 2.0 / (4.0 * half * half)
}
