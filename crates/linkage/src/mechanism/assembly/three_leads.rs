//! All poses of a base link that is connected with the frame by three leads. A lead is a link between frame and base.
//!
//! Each lead has one pair with the frame (near) and one pair with the base (far). The lead imposes one condition on the
//! base.
//! O is the position of the base's reference point, b = e^(i beta) the base's direction, w the far joint on the base,
//! a the near joint on the frame, e the direction of a prismatic pair:
//! - both pairs revolute: O + b w lies on a circle, |O + b w - a| = l;
//! - near prismatic, far revolute: O + b w lies on a line of the frame, e x (O + b w - a) = h;
//! - near revolute, far prismatic: the near pin lies on a line of the base, (b e) x (O + b w - a) = h;
//! - both prismatic: the base's angle is given.
//!
//! For a given beta all conditions are circles and lines for O.
//! Let X = O - c, where c is the centre and l the radius of one of the circles.
//! The remaining two conditions are then linear in X: p1 + q1 . X = 0 and p2 + q2 . X = 0.
//! If the second or third condition is a circle, its radical line with the first circle takes the place of the circle.
//! With |X| = l this leaves |q2 p1 - q1 p2|^2 = l^2 (q1 x q2)^2.
//! As a polynomial in e^(i beta), p has the powers -1 to 1.
//! The vector q has the powers 0 to 1 for a circle, the power 0 for a line of the frame, and the power 1 for a line of
//! the base.
//! The vector q2 p1 - q1 p2 therefore has the powers -1 to 2, and its square has the powers -3 to 3.
//! The equation for beta is therefore a trigonometric polynomial of degree 3.
//! This polynomial has at most six zeros, and all zeros can be found.
//! If all conditions are lines, the three lines must meet in one point. A determinant of degree 2 is then zero.

mod condition;

pub(super) use condition::{LeadPair, PairEnd, PlatformLead};

use crate::math::dense::Lu;
use crate::math::{KeepNan, Vec2, cross, harmonic, turned, unit};
use crate::mechanism::LinkPose;
use condition::{Condition, Locus};

/// A pose of the base: position of its reference point, and angle.
type Found = (Vec2, f64);

/// The three conditions. Frame coordinates are measured from a joint of the frame, base coordinates from a joint of the
/// base.
pub(super) struct Conditions {
    all: [Condition; 3],
    size: f64,
    frame: Vec2,
    base: Vec2,
}

impl Conditions {
    pub(super) fn of(leads: &[PlatformLead; 3]) -> Self {
        let (frame, base) = (leads[0].near.body.place, leads[0].far.body.place);
        let all = leads.each_ref().map(|lead| Condition::of(lead, frame, base));
        let size = all.iter().map(Condition::size).fold(f64::MIN_POSITIVE, f64::larger);
        Conditions { all, size, frame, base }
    }

    /// All poses of the base in the frame.
    /// `None` if the base can move although the frame and the lengths of the leads are fixed.
    pub(super) fn base_poses(&self) -> Option<Vec<LinkPose>> {
        let given: Vec<f64> = self
            .all
            .iter()
            .filter_map(|one| match one {
                Condition::Angle(angle) => Some(*angle),
                Condition::Circle { .. } | Condition::FrameLine { .. } | Condition::BaseLine { .. } => None,
            })
            .collect();
        let found = match given[..] {
            [] if self.all.iter().any(|one| matches!(one, Condition::Circle { .. })) => self.by_circle()?,
            [] => self.by_lines()?,
            [beta] => self.at_angle(beta)?,
            // Two or three leads have two prismatic pairs each.
            // Each of these leads fixes the base's angle, and the base can slide.
            _ => return None,
        };
        if found.iter().any(|&one| self.is_loose(one)) {
            return None;
        }
        Some(found.into_iter().map(|(o, beta)| LinkPose::through(self.base, self.frame + o, beta)).collect())
    }

    /// p and q of two conditions, and centre and radius of a circle.
    /// The circle is the condition of the longest lead. p and q are measured from the centre of the circle.
    fn reduced(&self, b: Vec2) -> ([(f64, Vec2); 2], Vec2, f64) {
        let length = |one: &Condition| if let Condition::Circle { length, .. } = one { *length } else { -1.0 };
        let pivot = (0..3).max_by(|&i, &j| length(&self.all[i]).total_cmp(&length(&self.all[j]))).unwrap_or(0);
        let Some(Locus::Circle { centre, radius }) = self.all[pivot].locus(b) else {
            return ([(f64::NAN, Vec2::zeros()); 2], Vec2::zeros(), f64::NAN);
        };
        let linear = |index: usize| match self.all[index].locus(b) {
            Some(Locus::Circle { centre: other, radius: length }) => {
                let apart = centre - other;
                // The equation of a radical line is divided by the size. Lines and circles then have the same weight.
                let p = apart.norm_squared() + (radius - length) * (radius + length);
                (p / self.size, apart * (2.0 / self.size))
            }
            Some(Locus::Line { p, q }) => (p + q.dot(&centre), q),
            None => (f64::NAN, Vec2::zeros()),
        };
        ([linear((pivot + 1) % 3), linear((pivot + 2) % 3)], centre, radius)
    }

    fn by_circle(&self) -> Option<Vec<Found>> {
        let eliminant = |beta: f64| {
            let ([(p1, q1), (p2, q2)], _, radius) = self.reduced(unit(beta));
            (q2 * p1 - q1 * p2).norm_squared() - (radius * cross(q1, q2)).powi(2)
        };
        let terms = |beta: f64| {
            let ([(p1, q1), (p2, q2)], _, radius) = self.reduced(unit(beta));
            (q2.norm() * p1.abs() + q1.norm() * p2.abs()).powi(2) + (radius * q1.norm() * q2.norm()).powi(2)
        };
        let mut found = Vec::new();
        for beta in harmonic::zeros(3, self.most(terms), eliminant)? {
            let ([(p1, q1), (p2, q2)], centre, radius) = self.reduced(unit(beta));
            let met = turned(q2 * p1 - q1 * p2) / cross(q1, q2);
            // If the two lines coincide, the solutions are the intersections of this line with the circle.
            // The intersections with the circle are computed in every case, because they cost little.
            // A candidate counts only if it satisfies all conditions.
            let (p, q) = if q1.norm() > q2.norm() { (p1, q1) } else { (p2, q2) };
            let foot = -q * (p / q.norm_squared());
            let along = turned(q) * (((radius - foot.norm()) * (radius + foot.norm())).larger(0.0).sqrt() / q.norm());
            for x in [met, foot + along, foot - along] {
                self.keep(&mut found, (centre + x, beta));
            }
        }
        Some(found)
    }

    fn by_lines(&self) -> Option<Vec<Found>> {
        let lines = |beta: f64| {
            self.all.map(|one| match one.locus(unit(beta)) {
                Some(Locus::Line { p, q }) => (p, q),
                _ => (f64::NAN, Vec2::zeros()),
            })
        };
        let minors = |beta: f64| {
            let lines = lines(beta);
            [0, 1, 2].map(|k: usize| (lines[k].0, cross(lines[(k + 1) % 3].1, lines[(k + 2) % 3].1)))
        };
        let determinant = |beta: f64| minors(beta).iter().map(|(p, minor)| p * minor).sum::<f64>();
        let terms = |beta: f64| minors(beta).iter().map(|(p, minor)| p.abs() * minor.abs().larger(0.1)).sum::<f64>();
        let mut found = Vec::new();
        for beta in harmonic::zeros(2, self.most(terms), determinant)? {
            let (lines, minors) = (lines(beta), minors(beta));
            let best = (0..3).max_by(|&i, &j| minors[i].1.abs().total_cmp(&minors[j].1.abs())).unwrap_or(0);
            let [(p1, q1), (p2, q2)] = [lines[(best + 1) % 3], lines[(best + 2) % 3]];
            self.keep(&mut found, (turned(q2 * p1 - q1 * p2) / cross(q1, q2), beta));
        }
        Some(found)
    }

    /// Solutions for a given angle of the base. The remaining two conditions determine the base's position.
    fn at_angle(&self, beta: f64) -> Option<Vec<Found>> {
        let mut loci = self.all.iter().filter_map(|one| one.locus(unit(beta)));
        let (first, second) = (loci.next()?, loci.next()?);
        let mut found = Vec::new();
        let on_circle = |(p, q): (f64, Vec2), centre: Vec2, radius: f64| {
            let distance = p / q.norm();
            let along_squared = (radius - distance) * (radius + distance);
            let (normal, along) = (q / q.norm(), along_squared.sqrt());
            let foot = centre - normal * distance;
            // The square root of a negative number is NaN, and `keep` drops solutions that are NaN.
            [foot + turned(normal) * along, foot - turned(normal) * along]
        };
        let candidates: Vec<Vec2> = match (first, second) {
            (Locus::Line { p: p1, q: q1 }, Locus::Line { p: p2, q: q2 }) => {
                let sine = cross(q1, q2);
                if !(sine.abs() > 1e-12) {
                    return None;
                }
                vec![turned(q2 * p1 - q1 * p2) / sine]
            }
            (Locus::Circle { centre, radius }, Locus::Line { p, q })
            | (Locus::Line { p, q }, Locus::Circle { centre, radius }) => {
                on_circle((p + q.dot(&centre), q), centre, radius).into()
            }
            (Locus::Circle { centre, radius }, Locus::Circle { centre: other, radius: length }) => {
                let apart = centre - other;
                if !(apart.norm() > 1e-12 * self.size) {
                    return None;
                }
                let p = apart.norm_squared() + (radius - length) * (radius + length);
                on_circle((p, apart * 2.0), centre, radius).into()
            }
        };
        candidates.into_iter().for_each(|o| self.keep(&mut found, (o, beta)));
        Some(found)
    }

    /// Largest value of a function of beta at a few angles.
    fn most(&self, of: impl Fn(f64) -> f64) -> f64 {
        (0..8).map(|k| of(f64::from(k) * std::f64::consts::FRAC_PI_4)).fold(0.0, f64::larger)
    }

    /// Refines a candidate to rounding error, and adds the result if it is a new solution of the conditions.
    /// If Newton's method fails because the base can move, adds a nearby pose that satisfies the conditions.
    fn keep(&self, found: &mut Vec<Found>, candidate: Found) {
        let apart = |known: &Found, one: &Found| {
            (known.0 - one.0).norm() > 1e-7 * self.size || (unit(known.1) - unit(one.1)).norm() > 1e-7
        };
        let loose = || self.settled(candidate).filter(|&one| self.is_loose(one));
        if let Some(one) = self.polish(candidate).or_else(loose)
            && found.iter().all(|known| apart(known, &one))
        {
            found.push(one);
        }
    }

    /// Rows of the Jacobian with respect to x / size, y / size and beta.
    /// Each row is paired with the residual of its condition.
    fn rows(&self, (o, beta): Found) -> [([f64; 3], f64); 3] {
        self.all.each_ref().map(|one| {
            let (gap, by_place, by_angle) = one.residual(o, beta, self.size);
            ([by_place.x * self.size, by_place.y * self.size, by_angle], gap)
        })
    }

    /// Whether the base can move from a pose while all conditions remain satisfied.
    /// The test makes one step along the free direction of the Jacobian, and one step in the opposite direction.
    /// After each of the two steps, damped steps lead back to a pose that satisfies the conditions.
    /// If both resulting poses differ from the original pose, the base can move.
    /// At a double root the base cannot move.
    fn is_loose(&self, at: Found) -> bool {
        let rows = self.rows(at).map(|(row, _)| row);
        let product = |a: [f64; 3], b: [f64; 3]| {
            [0, 1, 2].map(|k: usize| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
        };
        let norm = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let products = [0, 1, 2].map(|k: usize| product(rows[(k + 1) % 3], rows[(k + 2) % 3]));
        let free = products.into_iter().fold([0.0; 3], |best, one| if norm(one) > norm(best) { one } else { best });
        let volume: f64 = (0..3).map(|k| rows[0][k] * products[0][k]).sum();
        // The determinant of the normalised rows tends to zero at a double root.
        // A double root is accurate only to half the digits, 1e-7 of the size.
        // The threshold for the determinant is therefore larger than 1e-7.
        if volume.abs() > 1e-5 * rows.map(norm).iter().product::<f64>() {
            return false;
        }
        let step = 0.02 / norm(free);
        [step, -step].into_iter().all(|step| {
            let start = (at.0 + Vec2::new(free[0], free[1]) * (step * self.size), at.1 + free[2] * step);
            let back = |pose: Found| (pose.0 - at.0).norm() / self.size + (pose.1 - at.1).abs() <= 0.01;
            self.settled(start).is_some_and(|pose| !back(pose))
        })
    }

    /// Pose after damped steps from a given pose. `None` if a condition is not satisfied after the steps.
    /// Unlike Newton steps, damped steps do not move along free directions.
    fn settled(&self, mut pose: Found) -> Option<Found> {
        for _ in 0..30 {
            let (mut normal, mut step) = (Lu::new(3), [0.0; 3]);
            for (row, gap) in self.rows(pose) {
                for i in 0..3 {
                    step[i] += row[i] * gap;
                    (0..3).for_each(|j| normal.add(i, j, row[i] * row[j]));
                }
            }
            (0..3).for_each(|i| normal.add(i, i, 1e-6 * self.size * self.size));
            if !normal.factor() {
                return None;
            }
            normal.solve(&mut step);
            pose = (pose.0 - Vec2::new(step[0], step[1]) * self.size, pose.1 - step[2]);
        }
        self.rows(pose).iter().all(|(_, gap)| gap.abs() <= 1e-11 * self.size).then_some(pose)
    }

    /// Newton's method. Returns the best iterate if it satisfies all conditions and is near the start.
    fn polish(&self, start: Found) -> Option<Found> {
        let (mut at, mut best, mut least) = (start, start, f64::INFINITY);
        let mut worse = 0;
        // Near a double root, the first steps may increase the residual. The search therefore does not stop at the
        // first increase.
        // At the level of rounding errors, further steps give no improvement.
        while worse < 4 {
            let rows = self.rows(at);
            let worst = rows.iter().map(|(_, gap)| gap.abs()).fold(0.0, f64::larger);
            let (mut system, mut step) = (Lu::new(3), rows.map(|(_, gap)| gap));
            for (index, (row, _)) in rows.into_iter().enumerate() {
                row.into_iter().enumerate().for_each(|(column, value)| system.add(index, column, value));
            }
            if worst < least {
                (best, least) = (at, worst);
            } else {
                worse += 1;
            }
            if !(worst > 0.0 && system.factor()) {
                break;
            }
            system.solve(&mut step);
            at = (at.0 - Vec2::new(step[0], step[1]) * self.size, at.1 - step[2]);
        }
        // Lines may intersect far away.
        // Rounding errors grow with the distance of the intersection, so the limits also grow with this distance.
        let reach = self.size + best.0.norm();
        let near = (best.0 - start.0).norm() <= 0.1 * reach && (best.1 - start.1).abs() <= 0.1;
        (least <= CLOSED * reach && near).then_some(best)
    }
}

/// Largest residual of a condition in a valid pose, as a fraction of a reference length.
/// This length is the sum of the size and of the distance from the frame's origin to the base.
/// The limit is the rounding error, with a margin. A small margin is enough even for double roots: there Newton's
/// method finds only half the digits of the pose, but the residual is of the order of the square of the pose's error.
const CLOSED: f64 = 1e-13;
