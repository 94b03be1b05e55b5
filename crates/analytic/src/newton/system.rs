//! The equations of one case and the state for which they are solved.

use std::f64::consts::TAU;

use super::blocks::Blocks;
use linkage::case::Case;
use linkage::drive::{Drive, InputState, Wrench};
use linkage::math::{Motion, Vec2, rotated, turned, unit};
use linkage::mechanism::{GROUND, Joint, JointSide, LinkId, PerTransmission};
use linkage::trajectory::Stage;
use linkage::work::WorkTally;

/// Newton's method ends if the changes of two successive iterations are below this value. Angles are in rad; positions
/// are divided by the mechanism's size.
const SETTLED: f64 = 1e-9;

/// The equations of one case and the state for which they are solved.
pub(super) struct System<'a> {
    pub(super) case: &'a Case,
    pub(super) stage: Stage,
    pub(super) time: f64,
    /// Coordinates, velocities and accelerations: x, y, theta of each moving link's mass centre.
    pub(super) q: Vec<f64>,
    pub(super) rate: Vec<f64>,
    pub(super) second: Vec<f64>,
    /// Multipliers of the joints, transmissions and drives, in this order. The multipliers of the joints are in the
    /// order of [`Mechanism::rows`](linkage::mechanism::Mechanism::rows).
    pub(super) lambda: Vec<f64>,
    /// Changes of the multipliers that arise because the forces of some transmissions act along their second lines of
    /// action.
    pub(super) beside: Vec<f64>,
    /// For every joint: see [`twist`].
    pub(super) twists: Vec<f64>,
    /// Whether any joint has friction, or any transmission has losses.
    pub(super) has_friction: bool,
    /// For every transmission: q2 - f(q1) in the start pose.
    pub(super) phases: PerTransmission<f64>,
    pub(super) jacobian: Blocks,
    /// Signs of the determinants of the Jacobian's blocks on the followed branch.
    pub(super) branch: Vec<f64>,
    pub(super) residual: Vec<f64>,
    pub(super) predicted: Vec<f64>,
    /// Coordinates, velocities and accelerations before the step. These values are restored if the step fails.
    pub(super) before: Vec<f64>,
    pub(super) rate_before: Vec<f64>,
    pub(super) second_before: Vec<f64>,
    /// Coordinate, rate and acceleration of every drive at the present time. For a crank, the coordinate is its world
    /// angle.
    pub(super) inputs: Vec<InputState>,
    /// Motions and angles of all links, and the loads computed from them.
    pub(super) motions: Vec<Motion>,
    pub(super) angles: Vec<f64>,
    pub(super) loads: Vec<Wrench>,
    /// Change below which Newton's method ends.
    pub(super) settled: f64,
    pub(super) tally: WorkTally,
}

impl<'a> System<'a> {
    pub(super) fn new(case: &'a Case) -> Self {
        let links = &case.mechanism.links()[1..];
        let n = 3 * links.len();
        let mut q = Vec::with_capacity(n);
        for (link, pose) in links.iter().zip(&case.start.0[1..]) {
            let centre = pose.point(link.mass_centre);
            q.extend([centre.x, centre.y, pose.angle]);
        }
        let zeros = || vec![0.0; n];
        let mut system = System {
            case,
            stage: case.wanted.deepest(),
            time: 0.0,
            q,
            rate: zeros(),
            second: zeros(),
            lambda: zeros(),
            beside: zeros(),
            phases: PerTransmission::default(),
            has_friction: case.has_friction(),
            twists: case.mechanism.joints().iter().map(|joint| twist(case, joint)).collect(),
            jacobian: Blocks::of(case),
            branch: Vec::new(),
            residual: zeros(),
            predicted: zeros(),
            before: zeros(),
            rate_before: zeros(),
            second_before: zeros(),
            motions: vec![Motion::REST; links.len() + 1],
            angles: vec![0.0; links.len() + 1],
            loads: vec![Wrench::ZERO; links.len() + 1],
            settled: SETTLED,
            tally: WorkTally::default(),
            inputs: case.drives.iter().map(|drive| by_law(drive, 0.0)).collect(),
        };
        system.phases = case.mechanism.transmissions().iter().map(|own| system.coupled(own)).collect();
        system
    }

    /// Sets the time, and sets the driving links to the values of their laws at that time.
    pub(super) fn set_time(&mut self, t: f64) {
        self.time = t;
        for (input, drive) in self.inputs.iter_mut().zip(self.case.drives.iter()) {
            *input = by_law(drive, t);
        }
    }

    /// Motion and angle of a moving link's frame.
    pub(super) fn motion(&self, link: LinkId) -> (Motion, f64) {
        let i = 3 * (link.index() - 1);
        let pair = |of: &[f64]| Vec2::new(of[i], of[i + 1]);
        let motion = Motion::of_point(
            self.case.mechanism.links()[link].mass_centre,
            [pair(&self.q), pair(&self.rate), pair(&self.second)],
            unit(self.q[i + 2]),
            self.rate[i + 2],
            self.second[i + 2],
        );
        (motion, self.q[i + 2])
    }

    /// The drives with their rows, which come after the rows of joints and transmissions.
    pub(super) fn drives(&self) -> impl Iterator<Item = (usize, &'a Drive)> + use<'a> {
        let first = self.case.mechanism.row_of_drive(0);
        self.case.drives.iter().enumerate().map(move |(index, drive)| (first + index, drive))
    }

    /// World position of a link's mass centre; the origin for the ground.
    pub(super) fn centre(&self, link: LinkId) -> Vec2 {
        if link == GROUND {
            Vec2::zeros()
        } else {
            Vec2::new(self.q[3 * (link.index() - 1)], self.q[3 * (link.index() - 1) + 1])
        }
    }

    /// World vector from a link's mass centre (for the ground: the origin) to a point of the link.
    pub(super) fn arm(&self, link: LinkId, local: Vec2) -> Vec2 {
        if link == GROUND {
            return local;
        }
        rotated(unit(self.q[3 * (link.index() - 1) + 2]), local - self.case.mechanism.links()[link].mass_centre)
    }

    /// Converts a vector from a link's frame to the world.
    pub(super) fn along(&self, link: LinkId, local: Vec2) -> Vec2 {
        if link == GROUND { local } else { rotated(unit(self.angle(link)), local) }
    }

    pub(super) fn angle(&self, link: LinkId) -> f64 {
        if link == GROUND { 0.0 } else { self.q[3 * (link.index() - 1) + 2] }
    }

    pub(super) fn omega(&self, link: LinkId) -> f64 {
        if link == GROUND { 0.0 } else { self.rate[3 * (link.index() - 1) + 2] }
    }

    /// Velocity of a joint's position on a link.
    pub(super) fn velocity(&self, side: JointSide) -> Vec2 {
        self.velocity_at(side.link, self.arm(side.link, side.local))
    }

    /// Velocity of the point of a link at the vector `arm` from its mass centre.
    pub(super) fn velocity_at(&self, link: LinkId, arm: Vec2) -> Vec2 {
        if link == GROUND {
            return Vec2::zeros();
        }
        let i = 3 * (link.index() - 1);
        Vec2::new(self.rate[i], self.rate[i + 1]) + turned(arm) * self.rate[i + 2]
    }
}

/// State of a drive according to its law. The value is counted as in [`Drive::coordinate`].
fn by_law(drive: &Drive, t: f64) -> InputState {
    let state = drive.at(t);
    InputState { value: drive.coordinate(state.value), ..state }
}

/// For a prismatic joint: angle of the second link minus angle of the first link (rad) that makes the joint's axes on
/// both links parallel.
/// This angle includes the whole turns of the start pose. For a revolute joint the function returns 0, which is unused.
fn twist(case: &Case, joint: &Joint) -> f64 {
    let Some(axes) = joint.kind.axes() else { return 0.0 };
    let [first, second] = axes.map(|axis| axis.y.atan2(axis.x));
    let start = case.start.0[joint.second.link].angle - case.start.0[joint.first.link].angle;
    let parallel = first - second;
    parallel + TAU * ((start - parallel) / TAU).round()
}
