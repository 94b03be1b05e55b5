//! Independent geometry of the variants: poses from the given angles, transmission angles by the law of cosines.
//! The geometry uses no code of the solvers.
//!
//! The guide has the direction t at the angle theta, and the normal n; B0 is the position of B in the given pose.
//! The slider stays on its line, so at the crank angle a: n . (B - A) = n . B0 - l1 sin(a - theta).
//! This expression divided by l2 is the cosine of the angle between rod and normal.
//! The angle at D between link 3 and rocker 4 has the cosine (l3^2 + l4^2 - |C O2|^2) / 2 l3 l4.
//! Either dyad is singular where its cosine is 1 or -1.

use linkage::math::{KeepNan, Vec2, cross, turned, unit};

/// One line of the table: lengths (m), angles (deg), angular velocity of the crank (rad/s).
#[derive(Clone, Debug)]
pub struct Variant {
    pub number: usize,
    pub scheme: usize,
    /// l1, l2, l3; scheme 4 has no l4.
    pub lengths: [f64; 3],
    pub rocker: Option<f64>,
    pub ac: f64,
    pub alpha: f64,
    pub beta: f64,
    pub gamma: f64,
    pub phi: f64,
    pub theta: f64,
    pub omega: f64,
}

/// All lines of variants.csv.
pub fn variants(csv: &str) -> Vec<Variant> {
    let line = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |k: usize| cells[k].parse::<f64>().unwrap();
        Variant {
            number: cells[0].parse().unwrap(),
            scheme: cells[1].parse().unwrap(),
            lengths: [2, 3, 4].map(number),
            rocker: (!cells[5].is_empty()).then(|| number(5)),
            ac: number(6),
            alpha: number(7),
            beta: number(8),
            gamma: number(9),
            phi: number(10),
            theta: number(11),
            omega: number(12),
        }
    };
    csv.lines().skip(1).map(line).collect()
}

/// Directions in which beta, gamma and phi are measured; 1 is the direction in the project's interpretation.
pub type Senses = [f64; 3];
pub const OURS: Senses = [1.0; 3];

/// Data for the dependence of the slider dyad's transmission angle on the crank.
#[derive(Clone, Copy, Debug)]
struct Slide {
    along: Vec2,
    /// n . B.
    line: f64,
    /// 1 if B is ahead of A along the guide, otherwise -1.
    sense: f64,
}

/// A variant's mechanism in the pose given by its angles.
#[derive(Clone, Debug)]
pub struct Linkage {
    pub variant: Variant,
    pub a: Vec2,
    pub b: Vec2,
    pub c: Vec2,
    pub d: Vec2,
    pub o2: Vec2,
    slide: Option<Slide>,
}

fn degrees(angle: f64) -> Vec2 {
    unit(angle.to_radians())
}

/// An absolute value below this limit counts as zero, and the pose as singular; the limit is the rounding error of a
/// sine and a few products.
const SINGULAR: f64 = 1e-12;

impl Linkage {
    pub fn of(variant: &Variant, [beta, gamma, phi]: Senses) -> Self {
        let v = variant.clone();
        let [l1, l2, l3] = v.lengths;
        let a = degrees(v.alpha) * l1;
        let rod = v.alpha + 180.0 - beta * v.beta;
        let (b, c) = (a + degrees(rod) * l2, a + degrees(rod) * v.ac);
        let Some(l4) = v.rocker else {
            // In scheme 4, D and B are one point, so gamma is the angle at B between coupler and rocker.
            let o2 = b + degrees(rod + 180.0 + gamma * v.gamma) * l3;
            return Linkage { variant: v, a, b, c, d: b, o2, slide: None };
        };
        let lead = rod + gamma * v.gamma;
        let d = c + degrees(lead) * l3;
        let o2 = d + degrees(lead + 180.0 + phi * v.phi) * l4;
        let along = degrees(v.theta);
        let ahead = along.dot(&(b - a));
        // In a singular pose both directions are possible; the code takes B as ahead.
        let sense = if ahead < -SINGULAR { -1.0 } else { 1.0 };
        let slide = Some(Slide { along, line: cross(along, b), sense });
        Linkage { variant: v, a, b, c, d, o2, slide }
    }

    /// Whether the slider is ahead of A along the guide; `None` in scheme 4.
    pub fn is_ahead(&self) -> Option<bool> {
        self.slide.map(|slide| slide.sense > 0.0)
    }

    /// Whether D (scheme 4: B) is to the left of the line from C (A) to O2.
    pub fn is_left(&self) -> bool {
        let outer = if self.slide.is_some() { self.c } else { self.a };
        cross(self.o2 - outer, self.d - outer) > 0.0
    }

    /// Cosines of the transmission angles at crank angle `crank` (deg).
    /// The first cosine belongs to the angle between rod and normal, the second to the angle between link 3 and rocker.
    /// If the first dyad is beyond a limit, the second cosine is infinite.
    pub fn cosines(&self, crank: f64) -> [f64; 2] {
        let [l1, l2, l3] = self.variant.lengths;
        let a = degrees(crank) * l1;
        let of_sides = |p: f64, q: f64, outer: Vec2| (p * p + q * q - (outer - self.o2).norm_squared()) / (2.0 * p * q);
        let (Some(slide), Some(l4)) = (self.slide, self.variant.rocker) else { return [0.0, of_sides(l2, l3, a)] };
        let cosine = (slide.line - cross(slide.along, a)) / l2;
        let rest = 1.0 - cosine * cosine;
        if rest < -SINGULAR {
            return [cosine, f64::INFINITY];
        }
        let rod = slide.along * (slide.sense * rest.larger(0.0).sqrt()) + turned(slide.along) * cosine;
        [cosine, of_sides(l3, l4, a + rod * self.variant.ac)]
    }

    /// The larger absolute value of the two cosines.
    fn worst(&self, crank: f64) -> f64 {
        self.cosines(crank).iter().fold(0.0, |max, cosine| cosine.abs().larger(max))
    }

    /// Smaller transmission angle (deg).
    pub fn transmission(&self, crank: f64) -> f64 {
        self.worst(crank).smaller(1.0).acos().to_degrees()
    }

    /// Interval of crank angles (deg) around `from` in which both transmission angles stay above `least` (deg).
    /// `None` if both angles stay above `least` over a whole revolution.
    /// The search uses steps of 0.01 deg.
    /// If a cosine has a peak between two steps, the peak exceeds the cosines at these steps by less than 1e-7.
    pub fn interval(&self, from: f64, least: f64) -> Option<[f64; 2]> {
        const STEP: f64 = 0.01;
        let bound = least.to_radians().cos();
        let end = |sense: f64| {
            let out = (1..=36_000).map(|k| from + sense * STEP * f64::from(k)).find(|&at| self.worst(at) > bound);
            let crossed = out.map(|out| {
                let (mut inside, mut outside) = (out - sense * STEP, out);
                for _ in 0..60 {
                    let middle = 0.5 * (inside + outside);
                    *(if self.worst(middle) > bound { &mut outside } else { &mut inside }) = middle;
                }
                inside
            });
            let touched = self.change_point(from, sense);
            let ends = crossed.into_iter().chain(touched);
            ends.min_by(|x, y| (sense * x).total_cmp(&(sense * y)))
        };
        Some([end(-1.0)?, end(1.0)?])
    }

    /// The next crank angle (deg) at which the cosine of the slider's dyad has an extreme value of exactly 1 or -1.
    /// At this crank angle, crank and rod are perpendicular to the guide, and two branches cross.
    pub fn change_point(&self, from: f64, sense: f64) -> Option<f64> {
        let [l1, l2, _] = self.variant.lengths;
        let line = self.slide?.line;
        let across = |up: f64| {
            let cosine = (line - up * l1) / l2;
            let way = (sense * (self.variant.theta + 90.0 * up - from)).rem_euclid(360.0);
            ((cosine.abs() - 1.0).abs() <= SINGULAR).then_some(from + sense * way)
        };
        let ends = [1.0, -1.0].into_iter().filter_map(across);
        ends.min_by(|x, y| (sense * x).total_cmp(&(sense * y)))
    }

    /// Smallest transmission angle (deg) of each dyad between two crank angles (deg).
    /// Steps of 0.05 deg find the smallest value; a golden section search between the neighbouring steps refines this
    /// value.
    pub fn least(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        let count = ((to - from) / 0.05).ceil().larger(1.0);
        let at = |k: f64| from + (to - from) * (k / count).clamp(0.0, 1.0);
        [0, 1].map(|dyad| {
            let size = |crank: f64| self.cosines(crank)[dyad].abs();
            let places = (0..=count as usize).map(|k| k as f64);
            let top = places.max_by(|&x, &y| size(at(x)).total_cmp(&size(at(y)))).unwrap();
            let value = |crank: f64| Ok::<_, std::convert::Infallible>(size(crank));
            let Ok([low, high]) = linkage::math::extremum::golden([at(top - 1.0), at(top + 1.0)], 40, value);
            let largest = [at(top), 0.5 * (low + high)].map(size).into_iter().fold(0.0, f64::larger);
            largest.smaller(1.0).acos().to_degrees()
        })
    }
}
