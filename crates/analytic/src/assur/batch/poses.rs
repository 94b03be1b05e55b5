//! Storage for the poses of a batch. The columns of the storage are divided into tiles, whose rows are adjacent in
//! memory.

use super::lanes::{AlignedNumbers, Columns, Lanes, Plane, TILE};
use linkage::case::Case;
use linkage::math::{Motion, Vec2};
use linkage::mechanism::{GROUND, JointId, LinkId};
use linkage::solver::State;
use linkage::trajectory::Stage;
use pulp::Simd;

/// Number of columns for one link's motion: origin (2), direction (2), velocity (2), acceleration (2), angular velocity
/// (1), angular acceleration (1), in this order.
const OF_LINK: usize = 10;
/// Offsets of the six quantities of a link's motion from the link's first column.
pub(super) const ORIGIN: usize = 0;
pub(super) const DIRECTION: usize = 2;
pub(super) const VELOCITY: usize = 4;
pub(super) const ACCELERATION: usize = 6;
pub(super) const OMEGA: usize = 8;
pub(super) const ALPHA: usize = 9;

/// The layout of the columns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Layout {
    links: usize,
    joints: usize,
    drives: usize,
    /// Whether joints have a column for their moment; if `false`, all moments are 0.
    has_moments: bool,
}

impl Layout {
    pub(super) fn of(case: &Case, has_moments: bool) -> Self {
        let mechanism = &case.mechanism;
        let (links, joints) = (mechanism.links().len(), mechanism.joints().len());
        Layout { links, joints, drives: case.drives.len(), has_moments }
    }

    /// First column of a link; `None` for the ground.
    pub(super) fn link(&self, link: LinkId) -> Option<usize> {
        (link != GROUND).then(|| (link.index() - 1) * OF_LINK)
    }

    /// First of the two columns of the force in a joint.
    #[inline(always)]
    pub(super) fn force(&self, joint: JointId) -> usize {
        (self.links - 1) * OF_LINK + 2 * joint.index()
    }

    /// Column of the balancing moment of a drive.
    #[inline(always)]
    pub(super) fn torque(&self, drive: usize) -> usize {
        self.force(JointId(self.joints)) + drive
    }

    /// Column that is 0, or NaN if a group fails its check.
    #[inline(always)]
    pub(super) fn reach(&self) -> usize {
        self.torque(self.drives)
    }

    fn moment(&self, joint: JointId) -> usize {
        self.reach() + 1 + joint.index()
    }

    pub(super) fn columns(&self) -> usize {
        self.moment(JointId(if self.has_moments { self.joints } else { 0 }))
    }
}

/// The poses that [`Batch::solve`](super::Batch::solve) has found, one row per crank angle.
/// Keep this storage between calls: its memory is reused.
/// Values beyond the requested stage are meaningless. Methods panic if the row does not exist.
#[derive(Clone, Debug, Default)]
pub struct Poses {
    layout: Layout,
    rows: usize,
    tiles: AlignedNumbers,
}

impl Poses {
    /// Returns an empty storage.
    #[must_use]
    pub fn new() -> Self {
        Poses::default()
    }

    /// Number of poses.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows
    }

    /// Whether the storage holds no pose.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows == 0
    }

    /// Motion of a link's frame in the pose `row` (m, m/s, m/s^2, rad/s, rad/s^2); [`Motion::REST`] for the ground.
    #[must_use]
    pub fn motion(&self, row: usize, link: LinkId) -> Motion {
        let Some(first) = self.layout.link(link) else { return Motion::REST };
        Motion {
            origin: self.vector(row, first + ORIGIN),
            direction: self.vector(row, first + DIRECTION),
            velocity: self.vector(row, first + VELOCITY),
            omega: self.get(row, first + OMEGA),
            acceleration: self.vector(row, first + ACCELERATION),
            alpha: self.get(row, first + ALPHA),
        }
    }

    /// Force that the first link of a joint exerts on the second (N), in the pose `row`.
    #[must_use]
    pub fn force(&self, row: usize, joint: JointId) -> Vec2 {
        self.vector(row, self.layout.force(joint))
    }

    /// Moment that the first link of a joint exerts on the second, about the joint's position on the second link (N m),
    /// in the pose `row`; 0 in revolute joints.
    #[must_use]
    pub fn moment(&self, row: usize, joint: JointId) -> f64 {
        if self.layout.has_moments { self.get(row, self.layout.moment(joint)) } else { 0.0 }
    }

    /// Balancing moment on the driving link of the drive `drive` (N m), in the pose `row`.
    /// `drive` is an index of [`drives`](linkage::case::CaseParts::drives).
    #[must_use]
    pub fn torque(&self, row: usize, drive: usize) -> f64 {
        self.get(row, self.layout.torque(drive))
    }

    /// Copies the pose `row` to a state of the same case.
    /// The state's angles, which count turns, stay unchanged, as with [`PoseSolver::solve`](crate::PoseSolver::solve).
    pub fn copy_to(&self, row: usize, state: &mut State) {
        for (link, motion) in state.motions.iter_mut().enumerate() {
            *motion = self.motion(row, LinkId(link));
        }
        for (joint, (force, moment)) in state.forces.iter_mut().zip(&mut state.moments).enumerate() {
            (*force, *moment) = (self.force(row, JointId(joint)), self.moment(row, JointId(joint)));
        }
        for (drive, torque) in state.torques.iter_mut().enumerate() {
            *torque = self.torque(row, drive);
        }
    }

    /// Reserves space for `rows` rows.
    pub(super) fn prepare(&mut self, layout: Layout, rows: usize) {
        (self.layout, self.rows) = (layout, rows);
        self.tiles.resize(rows.div_ceil(TILE) * TILE * layout.columns());
    }

    /// Keeps only the first `rows` rows.
    pub(super) fn truncate(&mut self, rows: usize) {
        self.rows = rows;
    }

    /// Returns the columns of every tile.
    pub(super) fn tiles(&mut self) -> impl Iterator<Item = &mut [f64]> {
        self.tiles.chunks_exact_mut(self.layout.columns() * TILE)
    }

    /// Index of a value in the storage.
    fn index(&self, row: usize, column: usize) -> usize {
        (row / TILE * self.layout.columns() + column) * TILE + row % TILE
    }

    /// Whether the pose in a row can be assembled.
    #[inline]
    pub(super) fn is_placed(&self, row: usize) -> bool {
        !self.get(row, self.layout.reach()).is_nan()
    }

    /// Writes a state to a row.
    pub(super) fn put(&mut self, row: usize, state: &State) {
        let layout = self.layout;
        let mut put = |column: usize, value: f64| {
            let at = self.index(row, column);
            self.tiles[at] = value;
        };
        let vectors = |column: usize, v: Vec2| [(column, v.x), (column + 1, v.y)];
        for (link, motion) in state.motions.iter().enumerate() {
            let Some(first) = layout.link(LinkId(link)) else { continue };
            let all = [
                vectors(first + ORIGIN, motion.origin),
                vectors(first + DIRECTION, motion.direction),
                vectors(first + VELOCITY, motion.velocity),
                vectors(first + ACCELERATION, motion.acceleration),
                [(first + OMEGA, motion.omega), (first + ALPHA, motion.alpha)],
            ];
            all.into_iter().flatten().for_each(|(column, value)| put(column, value));
        }
        for (joint, (&force, &moment)) in state.forces.iter().zip(&state.moments).enumerate() {
            vectors(layout.force(JointId(joint)), force).into_iter().for_each(|(column, value)| put(column, value));
            if layout.has_moments {
                put(layout.moment(JointId(joint)), moment);
            }
        }
        for (drive, &torque) in state.torques.iter().enumerate() {
            put(layout.torque(drive), torque);
        }
        put(layout.reach(), 0.0);
    }

    #[inline]
    fn get(&self, row: usize, column: usize) -> f64 {
        assert!(row < self.rows, "row {row} of {}", self.rows);
        self.tiles[self.index(row, column)]
    }

    #[inline]
    fn vector(&self, row: usize, column: usize) -> Vec2 {
        Vec2::new(self.get(row, column), self.get(row, column + 1))
    }
}

/// Motion of a link's frame, one per pose.
#[derive(Clone, Copy)]
pub(super) struct LinkMotion<S: Simd> {
    pub(super) origin: Plane<S>,
    pub(super) direction: Plane<S>,
    pub(super) velocity: Plane<S>,
    pub(super) acceleration: Plane<S>,
    pub(super) omega: Lanes<S>,
    pub(super) alpha: Lanes<S>,
}

impl<S: Simd> LinkMotion<S> {
    /// World position of a point of the link.
    #[inline(always)]
    pub(super) fn point(&self, local: Vec2) -> Plane<S> {
        if local == Vec2::zeros() { self.origin } else { self.origin + self.direction.rotate(local) }
    }

    /// Position, velocity and acceleration of the tip of `arm`, a vector from the link's origin in world axes.
    #[inline(always)]
    pub(super) fn at(&self, arm: Plane<S>) -> [Plane<S>; 3] {
        let turned = arm.turned();
        let velocity = self.velocity + turned * self.omega;
        let acceleration = self.acceleration + turned * self.alpha - arm * (self.omega * self.omega);
        [self.origin + arm, velocity, acceleration]
    }
}

/// The columns of a link's motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkColumns<'a, S: Simd>(Columns<'a, S>);

impl<'a, S: Simd> LinkColumns<'a, S> {
    /// The link's direction in one row.
    pub(super) fn direction(self, row: usize) -> Vec2 {
        let v = self.0.vector(DIRECTION, row / S::F64_LANES);
        Vec2::new(v.x.number(row % S::F64_LANES), v.y.number(row % S::F64_LANES))
    }

    /// The columns of the link's origin.
    #[inline(always)]
    pub(super) fn origin(self) -> Columns<'a, S> {
        self.0.adjacent::<2>(ORIGIN)
    }

    #[inline(always)]
    pub(super) fn get(self, part: usize) -> LinkMotion<S> {
        LinkMotion {
            origin: self.0.vector(ORIGIN, part),
            direction: self.0.vector(DIRECTION, part),
            velocity: self.0.vector(VELOCITY, part),
            acceleration: self.0.vector(ACCELERATION, part),
            omega: self.0.get(OMEGA, part),
            alpha: self.0.get(ALPHA, part),
        }
    }

    /// Writes a motion up to the stage `deepest`.
    #[inline(always)]
    pub(super) fn put(self, deepest: Stage, part: usize, motion: &LinkMotion<S>) {
        self.0.put_vector(ORIGIN, part, motion.origin);
        self.0.put_vector(DIRECTION, part, motion.direction);
        if deepest >= Stage::Velocities {
            self.0.put_vector(VELOCITY, part, motion.velocity);
            self.0.put(OMEGA, part, motion.omega);
        }
        if deepest >= Stage::Accelerations {
            self.0.put_vector(ACCELERATION, part, motion.acceleration);
            self.0.put(ALPHA, part, motion.alpha);
        }
    }
}

impl<'a, S: Simd> Columns<'a, S> {
    /// The motion of the link with the first column `first`.
    #[inline(always)]
    pub(super) fn link(self, first: usize) -> LinkColumns<'a, S> {
        LinkColumns(self.adjacent::<OF_LINK>(first))
    }
}
