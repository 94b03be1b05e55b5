//! The interface of all solvers, and how they deliver their states.

use crate::case::{Case, Wanted};
use crate::error::{Error, ErrorKind, Result};
use crate::math::{KeepNan, Motion, Vec2, cross, unit};
use crate::mechanism::{GROUND, Joint, Side};
use crate::trajectory::channel::rows;
use crate::trajectory::{Channel, OfDrive, OfFrame, OfJoint, OfLink, OfPoint, OfSlider, Stage, Trajectory};
use std::cell::LazyCell;

/// How a solver obtains a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Provision {
    /// It is computed, or read from the engine, without conversion.
    Computed,
    /// It is derived from other quantities; the text says how.
    Derived(&'static str),
}

/// Receives the finished share of a long run, from 0 to 1.
pub type Progress<'a> = &'a mut dyn FnMut(f64);

/// Receives every state with its row of the grid. An error that it returns stops the run.
pub type Visit<'a> = &'a mut dyn FnMut(usize, &State) -> Result<()>;

/// Anything that turns a case into a trajectory.
pub trait Solver: Send + Sync {
    /// Short name, as on the command line.
    fn name(&self) -> &'static str;

    /// How this solver obtains `channel`.
    fn provides(&self, channel: &Channel) -> Provision;

    /// Passes the state at every instant of the case's grid to `visit`, with its row, in any order.
    /// Only the parts that the wanted channels need are computed; the rest of the state has no meaning.
    ///
    /// # Errors
    /// An error with the crank angle if the solution cannot stay on the requested branch; also the errors of `visit`.
    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()>;

    /// As [`Solver::sweep`], without progress reports.
    ///
    /// # Errors
    /// Those of [`Solver::sweep`].
    fn each(&self, case: &Case, visit: Visit) -> Result<()> {
        self.sweep(case, visit, &mut |_| {})
    }

    /// Solves the case: all its wanted channels on its grid.
    ///
    /// # Errors
    /// Those of [`Solver::sweep`]; also an error if a result is NaN or infinite.
    fn solve(&self, case: &Case) -> Result<Trajectory> {
        self.solve_with(case, &mut |_| {})
    }

    /// As [`Solver::solve`]; `progress` receives the finished share of the run, from 0 to 1.
    ///
    /// # Errors
    /// Those of [`Solver::solve`].
    fn solve_with(&self, case: &Case, progress: Progress) -> Result<Trajectory> {
        let mut sampler = Sampler::new(case);
        let mut put = |row: usize, state: &State| {
            sampler.put(case, row, state);
            Ok(())
        };
        self.sweep(case, &mut put, progress)?;
        sampler.finish(case)
    }
}

/// Checks that a free motion has no wanted instant before t = 0, where it begins. A prescribed motion allows any
/// instant.
///
/// # Errors
/// [`ErrorKind::Input`] with such an instant.
pub fn check_instants(case: &Case) -> Result<()> {
    match case.grid.times.iter().find(|&&t| t < 0.0) {
        Some(t) if case.is_free() => {
            let message = format!("the motion is free from t = 0 on, but an instant at {t} s is wanted");
            Err(Error::new(ErrorKind::Input, message).key("grid").help("let the grid go by time, from 0 s on"))
        }
        _ => Ok(()),
    }
}

/// State of the whole mechanism at one instant, in the form that all solvers share.
#[derive(Clone, Debug)]
pub struct State {
    /// Motion of every link's frame. The ground's motion is [`Motion::REST`].
    pub motions: Vec<Motion>,
    /// Angle of every link's frame, turns kept (rad).
    pub angles: Vec<f64>,
    /// Force of the first link on the second in every joint (N).
    pub forces: Vec<Vec2>,
    /// Moment of the first link on the second in every joint, about the joint's place on the second (N m). 0 in
    /// revolute joints.
    pub moments: Vec<f64>,
    /// Balancing moment on every driving link (N m), in the order of
    /// [`CaseParts::drives`](crate::case::CaseParts::drives).
    pub torques: Vec<f64>,
    /// Condition number that rounding goes by where the mechanism passes a change point. There that of the pose itself
    /// grows without bound, but the solver does not calculate at the pose. `None` elsewhere.
    pub passing: Option<f64>,
}

impl State {
    /// A state at rest with all values zero.
    #[must_use]
    pub fn at_rest(case: &Case) -> Self {
        State {
            motions: vec![Motion::REST; case.mechanism.links().len()],
            angles: vec![0.0; case.mechanism.links().len()],
            forces: vec![Vec2::zeros(); case.mechanism.joints().len()],
            moments: vec![0.0; case.mechanism.joints().len()],
            torques: vec![0.0; case.drives.len()],
            passing: None,
        }
    }

    /// Slide of a prismatic joint (m) with its first and second derivative; `None` for a revolute joint.
    /// s = e . (p2 - p1) along the axis e of the first link.
    /// With p2 - p1 = s e: e . (v2 - v1) = s' and e . (a2 - a1) = s'' - s omega^2.
    #[inline]
    #[must_use]
    pub fn slide(&self, joint: &Joint) -> Option<[f64; 3]> {
        let [first, second] = [joint.first, joint.second].map(|side| (&self.motions[side.link], side.local));
        let axis = first.0.arm(joint.axis_on(joint.first.link)?);
        let slide = axis.dot(&(second.0.point(second.1) - first.0.point(first.1)));
        let speed = axis.dot(&(second.0.point_velocity(second.1) - first.0.point_velocity(first.1)));
        let second_derivative =
            axis.dot(&(second.0.point_acceleration(second.1) - first.0.point_acceleration(first.1)));
        Some([slide, speed, second_derivative + slide * first.0.omega * first.0.omega])
    }

    /// Shaking force (N) and shaking moment about the origin (N m).
    /// They are the sum of what the joints with the ground, the drives, and the springs and dampers fastened to the
    /// ground exert on the frame.
    #[must_use]
    pub fn shaking(&self, case: &Case) -> (Vec2, f64) {
        // Drives stand on the frame, so their reactions there are opposite to the balancing moments.
        let (mut force, mut moment) = (Vec2::zeros(), -self.torques.iter().sum::<f64>());
        for (index, joint) in case.mechanism.joints().iter().enumerate() {
            let sign = match (joint.first.link, joint.second.link) {
                (GROUND, _) => -1.0,
                (_, GROUND) => 1.0,
                _ => continue,
            };
            let place = self.motions[joint.second.link].point(joint.second.local);
            force += self.forces[index] * sign;
            moment += (cross(place, self.forces[index]) + self.moments[index]) * sign;
        }
        case.each_load(&self.motions, &self.angles, |action| {
            if action.link == GROUND {
                force += action.force;
                moment += action.about(Vec2::zeros());
            }
        });
        (force, moment)
    }

    /// Largest distance between the two sides of a joint (m), that of a prismatic joint across its guide, its wrong
    /// angle (rad) counted at `size` (m); and the largest distance of a joint from the origin (m).
    #[must_use]
    pub fn opening(&self, case: &Case, size: f64) -> [f64; 2] {
        let mut largest = [0.0; 2];
        for joint in case.mechanism.joints() {
            let sides = [joint.first, joint.second];
            let places = sides.map(|side| self.motions[side.link].point(side.local));
            let (distance, turn) = joint.opening(places, sides.map(|side| self.motions[side.link].direction));
            let own = [distance.larger(turn * size), places[0].norm()];
            largest = [largest[0].larger(own[0]), largest[1].larger(own[1])];
        }
        largest
    }

    /// Largest moment (N m): of a drive, or of a joint's force at `arm` (m).
    #[must_use]
    pub fn largest_moment(&self, arm: f64) -> f64 {
        let torques = self.torques.iter().map(|torque| torque.abs());
        self.forces.iter().map(|force| force.norm() * arm).chain(torques).fold(0.0, f64::larger)
    }

    /// The start pose of the case, at rest.
    #[must_use]
    pub fn at_start(case: &Case) -> Self {
        let mut state = State::at_rest(case);
        for (index, pose) in case.start.0.iter().enumerate() {
            state.motions[index].origin = pose.origin;
            state.motions[index].direction = unit(pose.angle);
            state.angles[index] = pose.angle;
        }
        state
    }
}

/// Rows collected before they are written to their columns.
/// Each column is a separate block of memory; a whole group of rows needs one access to it.
const BLOCK: usize = 8;

/// Collects states into the columns of a trajectory, row by row in any order.
#[derive(Debug)]
pub struct Sampler {
    wanted: Wanted,
    points: Vec<Side>,
    channels: Vec<Channel>,
    columns: Vec<Vec<f64>>,
    rows: Vec<usize>,
    /// The last rows. The first `kept` rows of all are in the columns already.
    block: Vec<f64>,
    kept: usize,
    /// Crank angles (rad, as the scenario states them): those of the grid, or those of the states where forces decide
    /// the motion.
    cranks: Vec<f64>,
}

impl Sampler {
    /// Storage for all rows and wanted channels of a case.
    #[must_use]
    pub fn new(case: &Case) -> Self {
        let channels = case.channels();
        let columns = vec![vec![f64::NAN; case.grid.len()]; channels.len()];
        let points = case.mechanism.moving_points().map(|(_, side)| side).collect();
        Sampler {
            wanted: case.wanted,
            points,
            block: vec![f64::NAN; BLOCK * channels.len()],
            channels,
            columns,
            rows: Vec::with_capacity(case.grid.len()),
            kept: 0,
            cranks: case.grid.cranks.clone(),
        }
    }

    /// Stores a state in a row. The order of values is that of [`Case::channels`].
    pub fn put(&mut self, case: &Case, row: usize, state: &State) {
        if self.rows.len() == self.kept + BLOCK {
            self.keep();
        }
        let (at, width) = (self.rows.len() - self.kept, self.channels.len());
        self.rows.push(row);
        if case.is_free() {
            self.cranks[row] = state.angles[case.crank().link] - case.crank().zero;
        }
        let wanted =
            Stage::ALL.into_iter().filter(|&stage| self.wanted.has(stage)).fold(0, |all, stage| all | bit(stage));
        let mut out = Row { values: &mut self.block[at * width..][..width], wanted };
        for (index, link) in case.mechanism.links().iter().enumerate().skip(1) {
            let motion = &state.motions[index];
            let centre = BodyPoint::of(motion, link.mass_centre);
            out.put(&rows::LINK, |of| match of {
                OfLink::Angle => state.angles[index],
                OfLink::Omega => motion.omega,
                OfLink::Alpha => motion.alpha,
                OfLink::Centre(of) => centre.read(of),
            });
        }
        for side in &self.points {
            let point = BodyPoint::of(&state.motions[side.link], side.local);
            out.put(&rows::POINT, |of| point.read(of));
        }
        for force in &state.forces {
            out.put(&rows::JOINT, |of| match of {
                OfJoint::ForceX => force.x,
                OfJoint::ForceY => force.y,
            });
        }
        for (index, joint) in case.mechanism.joints().iter().enumerate() {
            let Some([slide, speed, acceleration]) = state.slide(joint) else { continue };
            out.put(&rows::SLIDER, |of| match of {
                OfSlider::Slide => slide,
                OfSlider::Speed => speed,
                OfSlider::Acceleration => acceleration,
                OfSlider::Moment => state.moments[index],
            });
        }
        // Computed once, and only if a wanted row uses it.
        let shaking = LazyCell::new(|| state.shaking(case));
        out.put(&rows::FRAME, |of| match of {
            OfFrame::ForceX => shaking.0.x,
            OfFrame::ForceY => shaking.0.y,
            OfFrame::Moment => shaking.1,
        });
        for (index, _) in case.drives.with_moment() {
            let read = |of| match of {
                OfDrive::Torque => state.torques[index],
            };
            match index {
                0 => out.put(&rows::DRIVE, read),
                _ => out.put(&rows::MOTOR, read),
            }
        }
        debug_assert!(out.values.is_empty(), "as many values as channels");
    }

    /// Moves the rows of the block into their columns.
    fn keep(&mut self) {
        let width = self.channels.len();
        let rows = &self.rows[self.kept..];
        for (channel, column) in self.columns.iter_mut().enumerate() {
            for (values, &row) in self.block.chunks_exact(width).zip(rows) {
                column[row] = values[channel];
            }
        }
        self.kept = self.rows.len();
    }

    /// The trajectory on the case's grid.
    ///
    /// # Errors
    /// If a value is missing, NaN or infinite.
    pub fn finish(mut self, case: &Case) -> Result<Trajectory> {
        self.keep();
        Trajectory::new(case.grid.times.clone(), self.cranks, self.channels, self.columns)
    }

    /// The trajectory so far: the stored rows in the order in which they came.
    /// `None` if there are no rows, or if a number is not finite.
    #[must_use]
    pub fn so_far(mut self, case: &Case) -> Option<Trajectory> {
        self.keep();
        if self.rows.is_empty() {
            return None;
        }
        let stored = |values: &[f64]| self.rows.iter().map(|&row| values[row]).collect::<Vec<f64>>();
        let columns = self.columns.iter().map(|column| stored(column)).collect();
        Trajectory::new(stored(&case.grid.times), stored(&self.cranks), self.channels, columns).ok()
    }
}

/// The unfilled rest of a row; it is filled in the order of channels.
struct Row<'a> {
    values: &'a mut [f64],
    /// The wanted stages, one [`bit`] each.
    wanted: u8,
}

const fn bit(stage: Stage) -> u8 {
    1 << stage as u8
}

impl Row<'_> {
    /// Stores the quantities of `rows` whose stages are wanted. `read` gives their values.
    #[inline(always)]
    fn put<Of: Copy, const N: usize>(&mut self, rows: &[(Of, Stage); N], read: impl Fn(Of) -> f64) {
        let needed = rows.iter().fold(0, |all, &(_, stage)| all | bit(stage));
        if self.wanted & needed == needed {
            let (own, rest) =
                std::mem::take(&mut self.values).split_first_chunk_mut::<N>().expect("as many values as channels");
            // Written out instead of a loop: every quantity is then a constant, and the compiler removes the match on
            // it.
            macro_rules! each {
                ($($row:literal)*) => {{
                    const { assert!(N <= [$($row),*].len(), "every row of a subject is put") };
                    $(if $row < N {
                        own[$row] = read(rows[$row].0);
                    })*
                }};
            }
            each!(0 1 2 3 4 5 6 7 8 9 10 11);
            self.values = rest;
            return;
        }
        for &(of, stage) in rows {
            if self.wanted & bit(stage) != 0 {
                let (own, rest) =
                    std::mem::take(&mut self.values).split_first_mut().expect("as many values as channels");
                *own = read(of);
                self.values = rest;
            }
        }
    }
}

/// Position (m), velocity (m/s) and acceleration (m/s^2) of a body point.
struct BodyPoint([Vec2; 3]);

impl BodyPoint {
    #[inline]
    fn of(motion: &Motion, local: Vec2) -> Self {
        let arm = motion.arm(local);
        BodyPoint([motion.origin + arm, motion.velocity_beyond(arm), motion.acceleration_beyond(arm)])
    }

    #[inline]
    fn read(&self, of: OfPoint) -> f64 {
        let BodyPoint([position, velocity, acceleration]) = self;
        match of {
            OfPoint::X => position.x,
            OfPoint::Y => position.y,
            OfPoint::VelocityX => velocity.x,
            OfPoint::VelocityY => velocity.y,
            OfPoint::AccelerationX => acceleration.x,
            OfPoint::AccelerationY => acceleration.y,
        }
    }
}
