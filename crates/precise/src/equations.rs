//! The equations of any mechanism of revolute and prismatic pairs.
//! All constraint equations are solved at once, and so are all equations of equilibrium.
//!
//! The unknowns are the frames of all moving links.
//! The equations accept any [`Scalar`]. Double-double numbers give a reference, and dual numbers give exact
//! sensitivities.
//! The elimination is dense, which is suitable for some tens of links.

use linkage::case::Case;
use linkage::input::Input;
use linkage::math::Motion;
use linkage::mechanism::{GROUND, JointId, JointKind, LinkId};

use super::frame::{Frame, Snapshot, slide};
use super::law::DriveNumbers;
use super::numbers::CaseNumbers;
use super::scalar::{Scalar, angle_of};
use super::vector::Vector;

/// Upper limit of the number of iterations at one pose. Convergence is quadratic.
const MOST: usize = 30;

/// A mechanism, with its numbers in a scalar type.
#[derive(Clone, Copy, Debug)]
pub struct Whole<'a, S> {
    pub(crate) case: &'a Case,
    pub(crate) numbers: &'a CaseNumbers<S>,
    size: f64,
}

/// First of the three columns of a link's unknowns: origin x, origin y, angle.
fn column(link: LinkId) -> usize {
    3 * (link.index() - 1)
}

/// Right-hand side of the equations.
#[derive(Clone, Copy)]
enum What {
    /// Gaps of a pose, for Newton's method.
    Gaps,
    /// Rates of the drives, for velocities.
    Rates,
    /// Quadratic velocity terms, for accelerations.
    Squares,
}

impl<'a, S: Scalar> Whole<'a, S> {
    /// The mechanism of a case, with its numbers.
    #[must_use]
    pub fn new(case: &'a Case, numbers: &'a CaseNumbers<S>) -> Self {
        Whole { case, numbers, size: case.mechanism.size() }
    }

    /// The state at the time `time` (s). The iteration starts from the pose of another solver, given by the motion and
    /// the angle (rad) of every link.
    /// If `keeps_input` is true, all derivatives are taken at a constant input of the first drive. The time at which
    /// the drive reaches this input then depends on the numbers of the drive's law, and has derivatives with respect to
    /// these numbers.
    /// `None` if the pose is singular, or if Newton's method does not converge. `None` also if the time must have
    /// derivatives but the drive stands still.
    #[must_use]
    pub fn near(&self, motions: &[Motion], angles: &[f64], time: f64, keeps_input: bool) -> Option<Snapshot<S>> {
        let frame = |motion: &Motion| Frame {
            origin: Vector::of(motion.origin),
            direction: Vector::of(motion.direction),
            ..Frame::REST
        };
        let mut frames: Vec<Frame<S>> = motions.iter().map(frame).collect();
        let time = if keeps_input { self.numbers.drives[0].time_of_same_input(time)? } else { S::of(time) };
        let drives = self.drive_states(time);
        self.close(&mut frames, &drives, S::SETTLED)?;
        // The derivatives after the last step belong to the pose before this step. One more step gives the derivatives
        // at the settled pose.
        self.step(&mut frames, &drives)?;
        Some(Snapshot { time, ..self.instant(&frames, angles, &drives)? })
    }

    /// Whether all derivatives at a constant input of the first drive are known.
    /// If the law of a drive is a table or formula, these derivatives are unknown, because this crate does not
    /// differentiate the acceleration of such a law.
    #[must_use]
    pub fn can_keep_input(&self) -> bool {
        !self.numbers.drives.iter().any(DriveNumbers::is_curve)
    }

    /// Input, rate and acceleration of every drive at a time (s).
    pub(crate) fn drive_states(&self, time: S) -> Vec<[S; 3]> {
        self.numbers.drives.iter().map(|drive| drive.at(time)).collect()
    }

    /// Number of unknowns: three for every moving link.
    fn unknowns(&self) -> usize {
        3 * (self.case.mechanism.links().len() - 1)
    }

    /// Adds to a row the derivatives of `normal . (point of the link)` with respect to the unknowns of the link, times
    /// `sign`.
    fn put(row: &mut [S], link: LinkId, arm: Vector<S>, normal: Vector<S>, sign: S) {
        if link == GROUND {
            return;
        }
        let at = column(link);
        for (entry, value) in row[at..at + 3].iter_mut().zip([normal.x, normal.y, normal.dot(arm.turned())]) {
            *entry = *entry + value * sign;
        }
    }

    fn put_turn(row: &mut [S], link: LinkId, value: S) {
        if link != GROUND {
            row[column(link) + 2] = row[column(link) + 2] + value;
        }
    }

    /// The matrix of all equations in a pose: first the equations of the joints, then the equations of the drives.
    fn matrix(&self, frames: &[Frame<S>]) -> Vec<Vec<S>> {
        let count = self.unknowns();
        let mut matrix = vec![vec![S::ZERO; count]; count];
        let one = S::ONE;
        // Adds the derivatives of the distance between the joint's points along an axis of the first link.
        let along = |row: &mut [S], link: [LinkId; 2], arms: [Vector<S>; 2], axis: Vector<S>, gap: Vector<S>| {
            Self::put(row, link[1], arms[1], axis, one);
            Self::put(row, link[0], arms[0], axis, -one);
            // The axis turns with the first link.
            Self::put_turn(row, link[0], axis.turned().dot(gap));
        };
        for (index, joint) in self.case.mechanism.joints().entries() {
            let links = [joint.first.link, joint.second.link];
            let (arms, gap) = self.between(frames, index);
            let rows = self.case.mechanism.rows(index).start;
            match joint.kind {
                JointKind::Revolute => {
                    for (row, normal) in [(rows, Vector::X), (rows + 1, Vector::X.turned())] {
                        Self::put(&mut matrix[row], links[1], arms[1], normal, one);
                        Self::put(&mut matrix[row], links[0], arms[0], normal, -one);
                    }
                }
                JointKind::Prismatic { .. } => {
                    let [axis, _] = self.guides(frames, index);
                    along(&mut matrix[rows], links, arms, axis.turned(), gap);
                    Self::put_turn(&mut matrix[rows + 1], links[1], one);
                    Self::put_turn(&mut matrix[rows + 1], links[0], -one);
                }
            }
        }
        let first = self.case.mechanism.equations();
        for (row, drive) in matrix[first..].iter_mut().zip(&self.numbers.drives) {
            let joint = &self.case.mechanism.joints()[drive.joint];
            let links = [joint.first.link, joint.second.link];
            match drive.input {
                Input::Angle => Self::put_turn(row, drive.link, one),
                Input::Turn => {
                    Self::put_turn(row, links[1], one);
                    Self::put_turn(row, links[0], -one);
                }
                Input::Slide => {
                    let (arms, gap) = self.between(frames, drive.joint);
                    let [axis, _] = self.guides(frames, drive.joint);
                    along(row, links, arms, axis, gap);
                }
            }
        }
        matrix
    }

    /// Vectors from the origins of both links of a joint to the joint's points, and the gap from the first point to the
    /// second.
    fn between(&self, frames: &[Frame<S>], joint: JointId) -> ([Vector<S>; 2], Vector<S>) {
        let (own, numbers) = (&self.case.mechanism.joints()[joint], &self.numbers.joints[joint]);
        let sides = [&frames[own.first.link], &frames[own.second.link]];
        let arms = [0, 1].map(|k| sides[k].arm(numbers.places[k]));
        (arms, sides[1].origin + arms[1] - sides[0].origin - arms[0])
    }

    /// Axes of a prismatic joint on both links, in world axes.
    fn guides(&self, frames: &[Frame<S>], joint: JointId) -> [Vector<S>; 2] {
        let (own, numbers) = (&self.case.mechanism.joints()[joint], &self.numbers.joints[joint]);
        let guides = numbers.guides.unwrap_or([Vector::X; 2]);
        [frames[own.first.link].arm(guides[0]), frames[own.second.link].arm(guides[1])]
    }

    /// The right-hand side of all equations in a pose. `drives` are the states of the drives.
    fn right(&self, frames: &[Frame<S>], drives: &[[S; 3]], what: What) -> Vec<S> {
        let mut right = vec![S::ZERO; self.unknowns()];
        let two = S::of(2.0);
        for (index, joint) in self.case.mechanism.joints().entries() {
            let (arms, gap) = self.between(frames, index);
            let rows = self.case.mechanism.rows(index).start;
            let sides = [&frames[joint.first.link], &frames[joint.second.link]];
            let squares = arms[0] * (sides[0].omega * sides[0].omega) - arms[1] * (sides[1].omega * sides[1].omega);
            // Right-hand side for the distance between the joint's points along `normal`. `turning` is the part due to
            // the rotation of the normal.
            let apart = |normal: Vector<S>, turning: S| match what {
                What::Gaps => -normal.dot(gap),
                What::Rates => S::ZERO,
                What::Squares => turning - normal.dot(squares),
            };
            match joint.kind {
                JointKind::Revolute => {
                    right[rows] = apart(Vector::X, S::ZERO);
                    right[rows + 1] = apart(Vector::X.turned(), S::ZERO);
                }
                JointKind::Prismatic { .. } => {
                    let axes = self.guides(frames, index);
                    let normal = axes[0].turned();
                    // The normal rotates with the first link, so normal and first link have the same angular velocity.
                    let omega = sides[0].omega;
                    let speed = |k: usize| sides[k].velocity + arms[k].turned() * sides[k].omega;
                    let turning = two * omega * axes[0].dot(speed(1) - speed(0)) + omega * omega * normal.dot(gap);
                    right[rows] = apart(normal, turning);
                    right[rows + 1] = match what {
                        What::Gaps => -axes[0].cross(axes[1]) / axes[0].dot(axes[1]),
                        What::Rates | What::Squares => S::ZERO,
                    };
                }
            }
        }
        let first = self.case.mechanism.equations();
        for ((own, drive), [input, rate, acceleration]) in
            right[first..].iter_mut().zip(&self.numbers.drives).zip(drives)
        {
            *own = match what {
                What::Gaps => self.drive_gap(frames, drive, drive.zero + *input),
                What::Rates => *rate,
                What::Squares => *acceleration - self.drive_squares(frames, drive),
            };
        }
        right
    }

    /// Amount by which the coordinate of a drive must increase to reach `to`.
    fn drive_gap(&self, frames: &[Frame<S>], drive: &DriveNumbers<S>, to: S) -> S {
        let joint = &self.case.mechanism.joints()[drive.joint];
        let turn = |direction: Vector<S>| {
            let to = Vector::unit(to);
            direction.cross(to) / direction.dot(to)
        };
        match drive.input {
            Input::Angle => turn(frames[drive.link].direction),
            Input::Turn => turn(frames[joint.second.link].direction.rotated_back(frames[joint.first.link].direction)),
            Input::Slide => {
                let (_, gap) = self.between(frames, drive.joint);
                to - self.guides(frames, drive.joint)[0].dot(gap)
            }
        }
    }

    /// The part of the second derivative of a drive's coordinate that is quadratic in the velocities.
    fn drive_squares(&self, frames: &[Frame<S>], drive: &DriveNumbers<S>) -> S {
        match drive.input {
            Input::Angle | Input::Turn => S::ZERO,
            Input::Slide => {
                let joint = &self.case.mechanism.joints()[drive.joint];
                let mut at = Snapshot { frames: frames.to_vec(), ..Snapshot::at_rest(self.case) };
                for frame in &mut at.frames {
                    (frame.acceleration, frame.alpha) = (Vector::ZERO, S::ZERO);
                }
                slide(&at, joint, &self.numbers.joints[drive.joint])[2]
            }
        }
    }

    /// One step of Newton's method; returns the largest change of the pose, divided by the mechanism's size.
    fn step(&self, frames: &mut [Frame<S>], drives: &[[S; 3]]) -> Option<f64> {
        let factors = S::factors(self.matrix(frames))?;
        let change = S::solution(&factors, &self.right(frames, drives, What::Gaps));
        let mut largest: f64 = 0.0;
        for (frame, own) in frames[1..].iter_mut().zip(change.as_chunks::<3>().0) {
            let [x, y, turn] = *own;
            frame.origin = frame.origin + Vector { x, y };
            frame.direction = frame.direction + frame.direction.turned() * turn;
            frame.direction = frame.direction * (S::ONE / frame.direction.norm());
            for size in [x.value().abs() / self.size, y.value().abs() / self.size, turn.value().abs()] {
                largest = if size > largest || size.is_nan() { size } else { largest };
            }
        }
        largest.is_finite().then_some(largest)
    }

    /// Moves `frames` to the pose with these inputs of the drives (Newton's method).
    pub(crate) fn close(&self, frames: &mut [Frame<S>], drives: &[[S; 3]], settled: f64) -> Option<()> {
        let mut before = f64::INFINITY;
        for _ in 0..MOST {
            let largest = self.step(frames, drives)?;
            // In ill-conditioned poses rounding errors are larger than `settled`. The iteration then also ends if the
            // change no longer decreases by half.
            if largest <= settled || (largest <= S::ROUNDING && largest > 0.5 * before) {
                return Some(());
            }
            before = largest;
        }
        None
    }

    /// Velocities, accelerations and forces in a closed pose. `angles` are approximate angles of the links (rad), with
    /// errors of less than half a turn. They give the number of whole turns.
    pub(crate) fn instant(&self, frames: &[Frame<S>], angles: &[f64], drives: &[[S; 3]]) -> Option<Snapshot<S>> {
        let mut instant = Snapshot::at_rest(self.case);
        instant.frames = frames.to_vec();
        let factors = S::factors(self.matrix(frames))?;
        let rates = S::solution(&factors, &self.right(frames, drives, What::Rates));
        for (frame, own) in instant.frames[1..].iter_mut().zip(rates.as_chunks::<3>().0) {
            (frame.velocity, frame.omega) = (Vector { x: own[0], y: own[1] }, own[2]);
        }
        let rates = S::solution(&factors, &self.right(&instant.frames, drives, What::Squares));
        for (frame, own) in instant.frames[1..].iter_mut().zip(rates.as_chunks::<3>().0) {
            (frame.acceleration, frame.alpha) = (Vector { x: own[0], y: own[1] }, own[2]);
        }
        let angle = |(frame, near): (&Frame<S>, &f64)| angle_of([frame.direction.x, frame.direction.y], *near);
        instant.angles = instant.frames.iter().zip(angles).map(angle).collect();
        instant.crank = self.numbers.drives[0].zero + drives[0][0];
        self.forces(&mut instant, drives[0][0])?;
        Some(instant)
    }
}
