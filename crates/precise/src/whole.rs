//! Solves any mechanism of revolute and prismatic pairs. All constraint equations are solved at once, and so are all
//! equations of equilibrium.
//!
//! The unknowns are the frames of all moving links.
//! From the start pose, the motion is followed in steps of at most one degree of the crank.
//! At each requested instant, Newton's method is repeated until the pose changes only by rounding errors.
//! The elimination is dense, which is suitable for some tens of links.

use crate::sentences;
use linkage::case::Case;
use linkage::error::Result;
use linkage::mechanism::{GROUND, Joint, JointKind, LinkId};
use linkage::trajectory::Trajectory;

use super::Long;
use super::frame::{Frame, Snapshot};
use super::readings::trajectory;
use super::task::{Task, at_start, stuck};
use super::vector::Vector;

/// Largest rotation of the crank in one step between requested instants (rad).
const STEP: f64 = std::f64::consts::PI / 180.0;
/// Upper limit of the number of iterations at one pose. Convergence is quadratic.
const MOST: usize = 30;
/// If the change of a pose, divided by the mechanism's size, is at most this limit, the iteration ends.
/// The remaining change is then rounding error.
const SETTLED: f64 = 1e-28;
/// If an iteration does not halve the change, this larger limit applies instead of `SETTLED`.
const ROUNDING: f64 = 1e-20;
/// At steps between requested instants, this larger limit replaces `SETTLED`.
const NEAR: f64 = 1e-10;

/// Does the same as [`solve`](super::solve), for mechanisms with revolute and prismatic pairs and up to some tens of
/// links.
///
/// # Errors
/// The errors of [`solve`](super::solve).
pub fn solve(case: &Case) -> Result<Trajectory> {
    let task = Task::of(case)?;
    let whole = Whole { case, task, size: case.mechanism.size() };
    let mut instants: Vec<Option<Snapshot>> = vec![None; case.grid.len()];
    let (mut frames, mut time) = (at_start(case), 0.0);
    for row in case.grid.ascending() {
        let to = case.grid.times[row];
        let steps = (((to - time) * whole.task.speed.abs() / STEP).ceil() as usize).max(1);
        for step in 1..=steps {
            let at = if step == steps { to } else { time + (to - time) * step as f64 / steps as f64 };
            let settled = if step == steps { SETTLED } else { NEAR };
            let gone = whole.task.angle(at);
            whole.close(&mut frames, gone, settled).ok_or_else(|| stuck(case, row, sentences::THE_POSE_IS_SINGULAR))?;
        }
        time = to;
        let instant = whole.instant(&frames).ok_or_else(|| stuck(case, row, sentences::THE_POSE_IS_SINGULAR))?;
        instants[row] = Some(Snapshot { crank: whole.task.angle(to), ..instant });
    }
    let instants: Vec<Snapshot> = instants.into_iter().map(|instant| instant.expect("every row is visited")).collect();
    trajectory(case, &instants)
}

struct Whole<'a> {
    case: &'a Case,
    task: Task,
    size: f64,
}

/// Rows of a linear system: coefficients and right-hand side.
struct System {
    rows: Vec<Vec<Long>>,
    right: Vec<Long>,
}

impl System {
    /// Gaussian elimination with the largest pivot of each column; `None` if the matrix is singular.
    fn solved(mut self) -> Option<Vec<Long>> {
        let count = self.right.len();
        for k in 0..count {
            let size = |row: &usize| self.rows[*row][k].abs().rounded();
            let pivot = (k..count).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            self.rows.swap(k, pivot);
            self.right.swap(k, pivot);
            let lead = self.rows[k][k];
            if !(lead.abs() > Long::ZERO) {
                return None;
            }
            let (above, below) = self.rows.split_at_mut(k + 1);
            let (own, right) = (&above[k], self.right[k]);
            for (row, value) in below.iter_mut().zip(&mut self.right[k + 1..]) {
                if row[k] == Long::ZERO {
                    continue;
                }
                let factor = row[k] / lead;
                for (entry, own) in row[k..].iter_mut().zip(&own[k..]).filter(|(_, own)| **own != Long::ZERO) {
                    *entry = *entry - factor * *own;
                }
                *value = *value - factor * right;
            }
        }
        let mut found = vec![Long::ZERO; count];
        for k in (0..count).rev() {
            let sum = (k + 1..count).fold(self.right[k], |sum, j| sum - self.rows[k][j] * found[j]);
            found[k] = sum / self.rows[k][k];
        }
        Some(found)
    }
}

/// First of the three columns of a link's unknowns: origin x, origin y, angle.
fn column(link: LinkId) -> usize {
    3 * (link.index() - 1)
}

impl Whole<'_> {
    /// A system with three unknowns for every moving link. All its coefficients and right sides are zero.
    fn empty(&self) -> System {
        let unknowns = 3 * (self.case.mechanism.links().len() - 1);
        System { rows: vec![vec![Long::ZERO; unknowns]; unknowns], right: vec![Long::ZERO; unknowns] }
    }

    /// Adds the coefficients of `normal . (point of the link)` to a row, times `sign`.
    fn put(&self, row: &mut [Long], link: LinkId, arm: Vector, normal: Vector, sign: Long) {
        if link == GROUND {
            return;
        }
        let at = column(link);
        for (entry, value) in row[at..at + 3].iter_mut().zip([normal.x, normal.y, normal.dot(arm.turned())]) {
            *entry = *entry + value * sign;
        }
    }

    fn put_turn(&self, row: &mut [Long], link: LinkId, value: Long) {
        if link != GROUND {
            row[column(link) + 2] = row[column(link) + 2] + value;
        }
    }

    /// All equations in a pose: first those of the joints, then that of the drive.
    /// `what` selects the right-hand side: the gaps of the pose, the speeds, or the terms of the accelerations that are
    /// quadratic in the velocities.
    fn system(&self, frames: &[Frame], what: What) -> System {
        let mut system = self.empty();
        for (index, joint) in self.case.mechanism.joints().entries() {
            let [first, second] = [joint.first.link, joint.second.link];
            let sides = [&frames[first], &frames[second]];
            let arms = [sides[0].arm(joint.first.local), sides[1].arm(joint.second.local)];
            let gap = sides[1].origin + arms[1] - sides[0].origin - arms[0];
            let (one, two) = (Long::ONE, Long::of(2.0));
            let squares = arms[0] * (sides[0].omega * sides[0].omega) - arms[1] * (sides[1].omega * sides[1].omega);
            let first_row = self.case.mechanism.rows(index).start;
            let rows = [first_row, first_row + 1];
            // Difference of the joint's points on the second and the first link, along a direction.
            let mut apart = |row: usize, normal: Vector, turning: Long| {
                self.put(&mut system.rows[row], second, arms[1], normal, one);
                self.put(&mut system.rows[row], first, arms[0], normal, -one);
                system.right[row] = match what {
                    What::Gaps(_) => -normal.dot(gap),
                    What::Rates => Long::ZERO,
                    What::Squares => turning - normal.dot(squares),
                };
            };
            match joint.kind {
                JointKind::Revolute => {
                    apart(rows[0], Vector::X, Long::ZERO);
                    apart(rows[1], Vector::X.turned(), Long::ZERO);
                }
                JointKind::Prismatic { axes } => {
                    let axes = [0, 1].map(|k| sides[k].arm(axes[k]));
                    let normal = axes[0].turned();
                    // The normal rotates with the first link, so its angular velocity is that of the first link.
                    let omega = sides[0].omega;
                    let speed = |k: usize| sides[k].velocity + arms[k].turned() * sides[k].omega;
                    let turning = two * omega * axes[0].dot(speed(1) - speed(0)) + omega * omega * normal.dot(gap);
                    apart(rows[0], normal, turning);
                    self.put_turn(&mut system.rows[rows[0]], first, -axes[0].dot(gap));
                    self.put_turn(&mut system.rows[rows[1]], second, one);
                    self.put_turn(&mut system.rows[rows[1]], first, -one);
                    system.right[rows[1]] = match what {
                        What::Gaps(_) => -axes[0].cross(axes[1]) / axes[0].dot(axes[1]),
                        What::Rates | What::Squares => Long::ZERO,
                    };
                }
            }
        }
        let last = system.right.len() - 1;
        self.put_turn(&mut system.rows[last], self.task.link, Long::ONE);
        system.right[last] = match what {
            What::Gaps(angle) => {
                let own = frames[self.task.link].direction;
                let to = Vector::unit(angle);
                own.cross(to) / own.dot(to)
            }
            What::Rates => Long::of(self.task.speed),
            What::Squares => Long::ZERO,
        };
        system
    }

    /// Newton's method for the pose at a world angle of the crank.
    fn close(&self, frames: &mut [Frame], angle: Long, settled: f64) -> Option<()> {
        let mut before = f64::INFINITY;
        for _ in 0..MOST {
            let change = self.system(frames, What::Gaps(angle)).solved()?;
            let mut largest: f64 = 0.0;
            for (frame, own) in frames[1..].iter_mut().zip(change.as_chunks::<3>().0) {
                let [x, y, turn] = *own;
                frame.origin = frame.origin + Vector { x, y };
                frame.direction = frame.direction + frame.direction.turned() * turn;
                frame.direction = frame.direction * (Long::ONE / frame.direction.norm());
                for size in [x.abs().rounded() / self.size, y.abs().rounded() / self.size, turn.abs().rounded()] {
                    largest = if size > largest || size.is_nan() { size } else { largest };
                }
            }
            if !largest.is_finite() {
                return None;
            }
            // In ill-conditioned poses rounding errors are larger than `settled`. The iteration then also ends if the
            // change no longer decreases by half.
            if largest <= settled || (largest <= ROUNDING && largest > 0.5 * before) {
                return Some(());
            }
            before = largest;
        }
        None
    }

    /// Rates and forces in a closed pose.
    fn instant(&self, frames: &[Frame]) -> Option<Snapshot> {
        let mut instant = Snapshot::at_rest(self.case);
        instant.frames = frames.to_vec();
        let rates = self.system(frames, What::Rates).solved()?;
        for (frame, own) in instant.frames[1..].iter_mut().zip(rates.as_chunks::<3>().0) {
            (frame.velocity, frame.omega) = (Vector { x: own[0], y: own[1] }, own[2]);
        }
        let rates = self.system(&instant.frames, What::Squares).solved()?;
        for (frame, own) in instant.frames[1..].iter_mut().zip(rates.as_chunks::<3>().0) {
            (frame.acceleration, frame.alpha) = (Vector { x: own[0], y: own[1] }, own[2]);
        }
        self.forces(&mut instant)?;
        Some(instant)
    }

    /// For each of a joint's two unknowns, the action of the unknown on the second link.
    /// The action consists of a force, a moment about the world's origin, and the moment of the joint.
    fn reactions(joint: &Joint, frames: &[Frame]) -> [(Vector, Long, Long); 2] {
        let place = frames[joint.second.link].point(joint.second.local);
        let along = |force: Vector| (force, place.cross(force), Long::ZERO);
        match joint.axis_on(joint.first.link) {
            None => [along(Vector::X), along(Vector::X.turned())],
            Some(axis) => {
                let normal = frames[joint.first.link].arm(axis).turned();
                [along(normal), (Vector::ZERO, Long::ONE, Long::ONE)]
            }
        }
    }

    /// Equilibrium of all links. Each link has two force equations and a moment equation about the world's origin.
    fn forces(&self, instant: &mut Snapshot) -> Option<()> {
        let mut system = self.empty();
        let joints = self.case.mechanism.joints();
        for (index, joint) in joints.entries() {
            let unknowns = self.case.mechanism.rows(index);
            for (k, (force, moment, _)) in unknowns.zip(Whole::reactions(joint, &instant.frames)) {
                for (link, sign) in [(joint.second.link, Long::ONE), (joint.first.link, -Long::ONE)] {
                    if link != GROUND {
                        for (row, value) in [force.x, force.y, moment].into_iter().enumerate() {
                            system.rows[column(link) + row][k] = value * sign;
                        }
                    }
                }
            }
        }
        let last = system.right.len() - 1;
        system.rows[column(self.task.link) + 2][last] = Long::ONE;
        for link in self.case.mechanism.links().ids().skip(1) {
            let (force, moment) = instant.inertia(self.case, link);
            for (row, value) in [force.x, force.y, moment].into_iter().enumerate() {
                system.right[column(link) + row] = -value;
            }
        }
        let found = system.solved()?;
        for (index, joint) in joints.entries() {
            let unknowns = self.case.mechanism.rows(index);
            for (&value, (force, _, moment)) in found[unknowns].iter().zip(Whole::reactions(joint, &instant.frames)) {
                instant.forces[index] = instant.forces[index] + force * value;
                instant.moments[index] = instant.moments[index] + moment * value;
            }
        }
        instant.torque = found[last];
        Some(())
    }
}

/// Right-hand side of the equations.
#[derive(Clone, Copy)]
enum What {
    /// Gaps of a pose, for Newton's method, at a world angle of the crank.
    Gaps(Long),
    /// Speeds.
    Rates,
    /// Quadratic velocity terms, for accelerations.
    Squares,
}
