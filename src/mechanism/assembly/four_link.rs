//! All real configurations of an Assur group of four links and six revolute joints.
//!
//! There are two such groups: the class III group of order 3 (a base link on three leads) and the class IV group of order 2
//! (a quadrilateral of two ternary and two binary links that changes shape). Either has two links of unknown angles
//! alpha and beta, and two binary links whose lengths give |c + u e^(i alpha) + w e^(i beta)| = l. For a given beta both are linear in
//! cos alpha and sin alpha; cos^2 + sin^2 = 1 leaves a trigonometric polynomial of degree 3 in beta, whose zeros
//! are found by eigenvalues: at most six, and none is missed.

use super::{AssemblyMode, Configuration};
use crate::error::{Error, ErrorKind, Result};
use crate::math::angle::wrapped;
use crate::math::{Vec2, cross, harmonic, rotated, unit};
use crate::mechanism::{Group, LinkPose, Mechanism, Pose};

/// Distance from one to the other end of a binary link: |c + u e^(i alpha) + w e^(i beta)| = length.
#[derive(Clone, Copy, Debug)]
struct Closing {
    c: Vec2,
    u: Vec2,
    w: Vec2,
    length: f64,
}

/// Product of conj(a) and b as complex numbers.
fn conj_times(a: Vec2, b: Vec2) -> Vec2 {
    Vec2::new(a.dot(&b), cross(a, b))
}

impl Closing {
    /// p and q of |...|^2 - l^2 = p + Re(q e^(i alpha)) for a given beta.
    fn linear(&self, beta: Vec2) -> (f64, Vec2) {
        let rest = self.c + rotated(beta, self.w);
        (rest.norm_squared() + self.u.norm_squared() - self.length.powi(2), conj_times(rest, self.u) * 2.0)
    }

    /// |...|^2 - l^2 and its derivatives by alpha and beta.
    fn residual(&self, alpha: f64, beta: f64) -> (f64, Vec2) {
        let (u, w) = (rotated(unit(alpha), self.u), rotated(unit(beta), self.w));
        let span = self.c + u + w;
        (span.norm_squared() - self.length.powi(2), Vec2::new(cross(u, span), cross(w, span)) * 2.0)
    }
}

/// Solutions (alpha, beta) of two closings.
fn solve(closings: [Closing; 2]) -> Option<Vec<[f64; 2]>> {
    let terms = |beta: f64| closings.map(|closing| closing.linear(unit(beta)));
    let eliminant = |beta: f64| {
        let [(p1, q1), (p2, q2)] = terms(beta);
        (q2 * p1 - q1 * p2).norm_squared() - cross(q1, q2).powi(2)
    };
    let size = closings[0].length.max(closings[1].length).powi(2);
    let mut found: Vec<[f64; 2]> = Vec::new();
    for beta in harmonic::zeros(3, eliminant)? {
        let [(p1, q1), (p2, q2)] = terms(beta);
        let both = q2 * p1 - q1 * p2;
        // Where the two equations in alpha are one (both parts of the eliminant vanish), either angle of the first may do.
        let candidates = if both.norm() > 1e-7 * size * size {
            let solved = Vec2::new(both.y, both.x) / cross(q2, q1);
            vec![solved.y.atan2(solved.x)]
        } else {
            let turn = (-p1 / q1.norm()).clamp(-1.0, 1.0).acos();
            let from = -q1.y.atan2(q1.x);
            vec![from + turn, from - turn]
        };
        for alpha in candidates {
            if let Some(solution) = polish(&closings, [alpha, beta], size)
                && found.iter().all(|known| apart(known, &solution))
            {
                found.push(solution);
            }
        }
    }
    Some(found)
}

fn apart(a: &[f64; 2], b: &[f64; 2]) -> bool {
    (0..2).any(|k| (unit(a[k]) - unit(b[k])).norm() > 1e-6)
}

/// Newton's method on both closings; `None` if it does not end near by with both closed.
fn polish(closings: &[Closing; 2], start: [f64; 2], size: f64) -> Option<[f64; 2]> {
    let mut at = start;
    let mut worst = f64::INFINITY;
    for _ in 0..40 {
        let [(f1, d1), (f2, d2)] = closings.map(|closing| closing.residual(at[0], at[1]));
        worst = f1.abs().max(f2.abs());
        let det = cross(d1, d2);
        let step = [(f1 * d2.y - f2 * d1.y) / det, (d1.x * f2 - d2.x * f1) / det];
        if !(step[0].is_finite() && step[1].is_finite()) || step[0].abs().max(step[1].abs()) < 1e-16 {
            break;
        }
        at = [at[0] - step[0], at[1] - step[1]];
    }
    let near = (0..2).all(|k| (at[k] - start[k]).abs() < 0.1);
    (worst <= 1e-13 * size && near).then_some(at)
}

/// Where something is hung: on a known point of the world, or on a point of the link of angle alpha (its own frame).
#[derive(Clone, Copy, Debug)]
enum Hook {
    World(Vec2),
    Alpha(Vec2),
}

/// A binary link that closes a contour.
#[derive(Clone, Copy, Debug)]
struct Closer {
    link: usize,
    /// Its end on `hook`, in its own frame.
    near: Vec2,
    hook: Hook,
    /// Its end on the link of angle beta, in its own frame and in that link's.
    far: Vec2,
    on_beta: Vec2,
}

/// The group's links by their part.
#[derive(Clone, Copy, Debug)]
struct Layout {
    alpha: usize,
    /// Pivot of the link of angle alpha, in its own frame and in the world.
    pivot: (Vec2, Vec2),
    beta: usize,
    /// Pivot of the link of angle beta in its own frame, and what it hangs on.
    hung: (Vec2, Hook),
    closers: [Closer; 2],
}

impl Layout {
    /// Sorts out the links; `None` if the group is none of the two.
    fn of(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Option<Self> {
        let joints = mechanism.joints();
        let inner_of = |link: usize| group.inner.iter().copied().filter(move |&j| joints[j].on(link).is_some());
        let at = |joint: usize, link: usize| joints[joint].on(link).expect("the joint is on the link");
        let world = |joint: usize, link: usize| {
            let base = joints[joint].other(link);
            pose.0[base.link].point(base.local)
        };
        let outer_of = |link: usize| group.outer_on(mechanism, link);
        let base = group.links.iter().copied().find(|&link| inner_of(link).count() == 3);
        let beta = base.or_else(|| group.links.iter().copied().rev().find(|&link| outer_of(link).is_some()))?;
        let hinged = |link: &usize| *link != beta && outer_of(*link).is_some();
        let alpha = group.links.iter().copied().find(hinged)?;
        let pivot = (at(outer_of(alpha)?, alpha), world(outer_of(alpha)?, alpha));
        let to_beta = |link: usize| inner_of(link).find(|&joint| joints[joint].on(beta).is_some());
        let hung = match base {
            Some(_) => (at(to_beta(alpha)?, beta), Hook::Alpha(at(to_beta(alpha)?, alpha))),
            None => (at(outer_of(beta)?, beta), Hook::World(world(outer_of(beta)?, beta))),
        };
        let closer = |link: usize| {
            let far = to_beta(link)?;
            let (near, hook) = match outer_of(link) {
                Some(outer) => (at(outer, link), Hook::World(world(outer, link))),
                None => {
                    let joint = inner_of(link).find(|&joint| joints[joint].on(alpha).is_some())?;
                    (at(joint, link), Hook::Alpha(at(joint, alpha)))
                }
            };
            Some(Closer { link, near, hook, far: at(far, link), on_beta: at(far, beta) })
        };
        let mut rest = group.links.iter().copied().filter(|&link| link != alpha && link != beta);
        let closers = [closer(rest.next()?)?, closer(rest.next()?)?];
        (rest.next().is_none() && group.links.len() == 4).then_some(Layout { alpha, pivot, beta, hung, closers })
    }

    /// A hook's constant part and its part that turns with alpha.
    fn split(&self, hook: Hook) -> (Vec2, Vec2) {
        match hook {
            Hook::World(place) => (place, Vec2::zeros()),
            Hook::Alpha(local) => (self.pivot.1, local - self.pivot.0),
        }
    }

    fn closings(&self) -> [Closing; 2] {
        let (hung, hung_alpha) = self.split(self.hung.1);
        self.closers.map(|closer| {
            let (near, near_alpha) = self.split(closer.hook);
            let length = (closer.far - closer.near).norm();
            Closing { c: hung - near, u: hung_alpha - near_alpha, w: closer.on_beta - self.hung.0, length }
        })
    }

    /// Poses of the four links, in the order of the group.
    fn poses(&self, group: &Group, [alpha, beta]: [f64; 2]) -> Vec<LinkPose> {
        let first = LinkPose::through(self.pivot.0, self.pivot.1, wrapped(alpha));
        let place = |hook: Hook| match hook {
            Hook::World(place) => place,
            Hook::Alpha(local) => first.point(local),
        };
        let second = LinkPose::through(self.hung.0, place(self.hung.1), wrapped(beta));
        let pose = |link: &usize| {
            if *link == self.alpha {
                return first;
            }
            if *link == self.beta {
                return second;
            }
            let closer = self.closers.iter().find(|closer| closer.link == *link).expect("the rest are closers");
            LinkPose::between(closer.near, closer.far, place(closer.hook), second.point(closer.on_beta))
        };
        group.links.iter().map(pose).collect()
    }
}

/// All real configurations of the group, sorted by the angle of its link beta.
///
/// # Errors
/// [`ErrorKind::Geometry`] if there is none, [`ErrorKind::Unsupported`] if the group is another than the two.
pub(super) fn configurations(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Result<Vec<Configuration>> {
    let layout = Layout::of(mechanism, group, pose).ok_or_else(|| {
        Error::new(
            ErrorKind::Unsupported,
            format!("there is no start for a group of {} links of class {}", group.links.len(), group.class),
        )
        .help("groups of two and of four links are handled; driving another link may split the group")
    })?;
    let solutions = solve(layout.closings()).ok_or_else(|| {
        Error::new(ErrorKind::Geometry, "the group can move while its outer joints are held: its lengths are singular")
            .help("check the lengths: two links of the group may be parallel and equal by mistake")
    })?;
    if solutions.is_empty() {
        return Err(Error::new(ErrorKind::Geometry, "the group cannot be assembled: it has no real configuration")
            .help("check the lengths and the ground points, or start at a crank angle that can be reached"));
    }
    let one = |angles: &[f64; 2]| Configuration { mode: AssemblyMode::Followed, links: layout.poses(group, *angles) };
    Ok(solutions.iter().map(one).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::cross;
    use crate::mechanism::fixtures::class_four;
    use crate::mechanism::{GROUND, Structure};
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    /// Residuals of both closings as functions of the two angles, and all their common zeros by following the zero set of the first
    /// over a fine grid of beta: a method without any polynomial.
    fn scanned(closings: [Closing; 2]) -> usize {
        let branch = |beta: f64, sign: f64| {
            let (p, q) = closings[0].linear(unit(beta));
            let cosine = -p / q.norm();
            (cosine.abs() <= 1.0).then(|| {
                let alpha = sign * cosine.acos() - q.y.atan2(q.x);
                closings[1].residual(alpha, beta).0
            })
        };
        let n = 40_000;
        let mut count = 0;
        for sign in [1.0, -1.0] {
            for k in 0..n {
                let at = |k: usize| branch(TAU * k as f64 / n as f64, sign);
                if let (Some(a), Some(b)) = (at(k), at(k + 1)) {
                    count += usize::from(a * b < 0.0);
                }
            }
        }
        count
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]
        #[test]
        fn as_many_configurations_as_a_scan_finds(v in prop::collection::vec(-1.0f64..1.0, 10), l in prop::collection::vec(0.3f64..2.0, 2), triad: bool) {
            let vector = |k: usize| Vec2::new(v[2 * k], v[2 * k + 1]);
            let u = [vector(1), if triad { vector(1) } else { vector(4) }];
            let c = [vector(0), if triad { vector(4) } else { vector(0) }];
            let closings = [0, 1].map(|k| Closing { c: c[k], u: u[k], w: vector(2 + k), length: l[k] });
            let found = solve(closings).unwrap();
            for [alpha, beta] in &found {
                for closing in &closings {
                    prop_assert!(closing.residual(*alpha, *beta).0.abs() < 1e-12);
                }
            }
            // The scan cannot tell zeros closer than its spacing apart and misses those at the ends of a branch.
            let scanned = scanned(closings);
            prop_assert!(found.len() <= 6 && found.len().abs_diff(scanned) <= 2, "{} against {scanned}", found.len());
            if found.len() != scanned {
                let lowest = found.iter().map(|&[a, b]| {
                    let [d1, d2] = closings.map(|closing| closing.residual(a, b).1);
                    let end = closings[0].residual(a, b).1.x.abs();
                    (cross(d1, d2).abs()).min(end * end)
                });
                prop_assert!(lowest.fold(f64::MAX, f64::min) < 1e-2, "{} against {scanned} far from any singularity", found.len());
            }
        }
    }

    /// Reference 7: link 2 A-C-B, link 3 BD, link 4 CE, link 5 K-E-D, crank OA at 70 deg.
    #[test]
    fn val_fourth_class_configurations_at_70_degrees() {
        let mut total = 0;
        for (side_b, side_d) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let mechanism = class_four(side_b, side_d);
            let structure = Structure::of(&mechanism, &[0]).unwrap();
            let mut pose = Pose(vec![LinkPose::GROUND; 6]);
            pose.0[1].angle = 70f64.to_radians();
            let group = &structure.groups[0];
            let all = configurations(&mechanism, group, &pose).unwrap();
            for one in &all {
                for (&link, &place) in group.links.iter().zip(&one.links) {
                    pose.0[link] = place;
                }
                assert!(pose.closure(&mechanism) < 1e-15 && pose.0[GROUND] == LinkPose::GROUND);
            }
            total += all.len();
            // The printed configuration: angles of AC, BD, CE, KE.
            let printed = [-53.70258, 2.58635, 20.59796, 151.55247];
            let is_printed = |one: &&Configuration| {
                one.links.iter().zip(printed).all(|(place, angle)| (place.angle.to_degrees() - angle).abs() < 0.5e-5)
            };
            let expected = usize::from(side_b > 0.0 && side_d < 0.0);
            assert_eq!(all.iter().filter(is_printed).count(), expected);
        }
        assert_eq!(total, 8);
    }
}
