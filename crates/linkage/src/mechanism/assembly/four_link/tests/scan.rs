//! Counts the configurations of a base on three leads by a scan.
//! The scan uses no polynomial, so it checks the module under test independently.
//!
//! At a given angle of the base, two leads allow at most two positions of the base's reference point.
//! The third lead's condition is then a function of the angle, which changes sign at a configuration.
//! The two positions form two branches.
//! The scan runs through the angles forwards on one branch and backwards on the other branch.
//! Along this path the function is smooth and periodic.
//! Samples are closer together where the position changes fast.
//! If two neighbouring samples have equal signs, the extremum between them is computed.
//! The sign at the extremum distinguishes a pair of zeros from a near miss.

use crate::math::KeepNan;
use std::convert::Infallible;
use std::f64::consts::{PI, TAU};

use crate::math::{Vec2, cross, extremum, root, rotated, turned, unit};
use crate::mechanism::assembly::three_leads::{LeadPair, PlatformLead};

/// Number of bisections for a zero, and number of golden section steps for an extremum.
/// After 60 steps the remaining interval is as small as a rounding error of the angle.
const STEPS: usize = 60;

/// An extremum below this fraction of the function's largest value counts as a double root.
/// A root that looks double may be two zeros or a near miss. Scan and module cannot distinguish these two cases.
const DOUBLE: f64 = 1e-9;

/// Result of a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scan {
    pub count: usize,
    /// Whether a root is double to within [`DOUBLE`].
    pub double: bool,
}

/// Possible positions of the base's reference point.
#[derive(Clone, Copy)]
enum Locus {
    Circle(Vec2, f64),
    /// A point on the line and the direction of the line.
    Line(Vec2, Vec2),
}

/// Possible positions of the base's reference point, computed directly from the definition of the pairs.
/// First the lead is placed, then the base's far joint is put on the lead's far joint.
fn locus(lead: &PlatformLead, b: Vec2) -> Option<Locus> {
    let (near, far) = (lead.near, lead.far);
    let span = far.lead.place - near.lead.place;
    let arm = rotated(b, far.body.place);
    // Direction of the lead's frame at which the pair's axis on the lead has the world direction `axis`.
    let onto = |pair: LeadPair, axis: Vec2| rotated(Vec2::new(pair.lead.axis.x, -pair.lead.axis.y), axis);
    match (near.slides, far.slides) {
        (false, false) => Some(Locus::Circle(near.body.place - arm, span.norm())),
        (true, false) => {
            let axis = near.body.axis;
            Some(Locus::Line(near.body.place + rotated(onto(near, axis), span) - arm, axis))
        }
        (false, true) => {
            let axis = rotated(b, far.body.axis);
            Some(Locus::Line(near.body.place + rotated(onto(far, axis), span) - arm, axis))
        }
        (true, true) => None,
    }
}

/// A function of a point that is zero on the locus and has opposite signs on the two sides of the locus.
fn off(locus: Locus, o: Vec2) -> f64 {
    match locus {
        Locus::Circle(centre, radius) => (o - centre).norm_squared() - radius * radius,
        Locus::Line(point, direction) => cross(direction, o - point),
    }
}

/// Returns a smooth function that is positive if the circle intersects the locus `other`.
/// Also returns the intersection on the branch `sign`.
fn meet(centre: Vec2, radius: f64, other: Locus, sign: f64) -> (f64, Vec2) {
    match other {
        Locus::Line(point, direction) => {
            let height = cross(direction, point - centre);
            let room = (radius - height) * (radius + height);
            (room, centre + turned(direction) * height + direction * (sign * room.larger(0.0).sqrt()))
        }
        Locus::Circle(second, length) => {
            let base = second - centre;
            let distance = base.norm();
            let twice = base.norm_squared() + (radius - length) * (radius + length);
            let room = 4.0 * base.norm_squared() * radius * radius - twice * twice;
            let across = turned(base) * (sign * room.larger(0.0).sqrt());
            (room, centre + (base * twice + across) / (2.0 * distance * distance))
        }
    }
}

/// Zeros of a periodic function on [0, `period`), and whether one of them is double.
/// The samples are so close together that `place` changes by at most `step` from one sample to the next.
fn zeros(f: &dyn Fn(f64) -> f64, place: &dyn Fn(f64) -> Vec2, period: f64, step: f64) -> (Vec<f64>, bool) {
    let first = 400;
    let mut at = vec![0.0];
    for k in 0..first {
        let mut ends = vec![period * (k + 1) as f64 / first as f64];
        while let Some(&end) = ends.last() {
            let from = at[at.len() - 1];
            if (place(end) - place(from)).norm() > step && end - from > 1e-9 {
                ends.push(0.5 * (from + end));
            } else {
                at.push(end);
                ends.pop();
            }
        }
    }
    let values: Vec<f64> = at.iter().map(|&x| f(x)).collect();
    let largest = values.iter().fold(0.0f64, |most, v| most.larger(v.abs()));
    let n = at.len() - 1;
    let (mut found, mut double) = (Vec::new(), false);
    for k in 0..n {
        if (values[k] > 0.0) != (values[k + 1] > 0.0) {
            found.push(bisect(f, at[k], at[k + 1]));
        }
        let (before, after) = if k == 0 { (n - 1, 1) } else { (k - 1, k + 1) };
        let sign = values[k].signum();
        let low = [before, k, after].map(|k| values[k] * sign);
        if low.iter().all(|&v| v > 0.0) && low[1] <= low[0] && low[1] <= low[2] {
            let back = if k == 0 { at[n - 1] - period } else { at[k - 1] };
            let g = |x: f64| sign * f(x.rem_euclid(period));
            let x = least(&g, back, at[after]);
            double |= g(x).abs() < DOUBLE * largest;
            if g(x) < 0.0 {
                found.push(bisect(&g, back, x).rem_euclid(period));
                found.push(bisect(&g, x, at[after]).rem_euclid(period));
            }
        }
    }
    (found, double)
}

fn bisect(f: &dyn Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let rises = f(high) > 0.0;
    let Ok([low, high]) = root::halved([low, high], STEPS, |x| Ok::<_, Infallible>((f(x) > 0.0) != rises));
    f64::midpoint(low, high)
}

/// Position of the smallest value of `f` between `low` and `high`.
fn least(f: &dyn Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let Ok([low, high]) = extremum::golden([low, high], STEPS, |x| Ok::<_, Infallible>(-f(x)));
    f64::midpoint(low, high)
}

/// Counts the configurations. `None` if a lead fixes the base's angle, because no angle is left to scan.
pub fn scanned(leads: &[PlatformLead; 3]) -> Option<Scan> {
    let at =
        |beta: f64| Some([locus(&leads[0], unit(beta))?, locus(&leads[1], unit(beta))?, locus(&leads[2], unit(beta))?]);
    let circle = at(0.0)?.iter().position(|locus| matches!(locus, Locus::Circle(..)));
    let at = |beta: f64| at(beta).expect("as at zero");
    let still = |_: f64| Vec2::zeros();
    let Some(circle) = circle else {
        // Lines 1 and 2 intersect at p1 + d1 (p2 - p1) x d2 / d1 x d2.
        // The function is d1 x d2 times the distance of the intersection from line 3.
        let f = |beta: f64| {
            let [Locus::Line(p1, d1), Locus::Line(p2, d2), Locus::Line(p3, d3)] = at(beta) else { return f64::NAN };
            cross(d1, d2) * cross(d3, p1 - p3) + cross(d3, d1) * cross(p2 - p1, d2)
        };
        let (found, double) = zeros(&f, &still, TAU, 1.0);
        return Some(Scan { count: found.len(), double });
    };
    let (second, third) = ((circle + 1) % 3, (circle + 2) % 3);
    let both = |beta: f64, sign: f64| {
        let loci = at(beta);
        let Locus::Circle(centre, radius) = loci[circle] else { return (f64::NAN, Vec2::zeros(), f64::NAN) };
        let (room, o) = meet(centre, radius, loci[second], sign);
        (room, o - centre, off(loci[third], o))
    };
    let radius = (leads[circle].far.lead.place - leads[circle].near.lead.place).norm();
    let (ends, mut double) = zeros(&|beta| both(beta, 1.0).0, &still, TAU, 1.0);
    let mut ends = ends;
    ends.sort_by(f64::total_cmp);
    let mut count = 0;
    let mut add = |f: &dyn Fn(f64) -> f64, place: &dyn Fn(f64) -> Vec2| {
        let (found, close) = zeros(f, place, TAU, 0.02 * radius);
        count += found.len();
        double |= close;
    };
    if ends.is_empty() {
        if both(0.0, 1.0).0 > 0.0 {
            for sign in [1.0, -1.0] {
                add(&|beta| both(beta, sign).2, &|beta| both(beta, sign).1);
            }
        }
        return Some(Scan { count, double });
    }
    for (index, &from) in ends.iter().enumerate() {
        let to = ends.get(index + 1).copied().unwrap_or(ends[0] + TAU);
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        if both(middle, 1.0).0 > 0.0 {
            // The path runs forwards on one branch and backwards on the other branch.
            let on = |turn: f64| both(middle - half * turn.cos(), if turn < PI { 1.0 } else { -1.0 });
            add(&|turn| on(turn).2, &|turn| on(turn).1);
        }
    }
    Some(Scan { count, double })
}
