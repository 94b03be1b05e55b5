//! A world under supervision. A step returns an error in each of these cases:
//! - A loop opens.
//! - A link turns too far in one step.
//! - The kinetic energy grows too much in one step.
//! - A number is NaN or infinite.
//! - The engine panics.
//!
//! The error states time, crank angle, and joint or link.
//! See docs/numerics/twins.md.

use crate::sentences;
use std::fmt;

use super::masses::{Loading, masses};
use super::rapier::Rapier;
use super::tree::SpanningTree;
use super::world::{LinkFrame, World, opening};
use linkage::case::Case;
use linkage::drive::{Drive, DriveMotion, Wrench};
use linkage::engine::Settings;
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::input::InputValue;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{JointSide, LinkId, LinkPose};
use linkage::quiet::{guarded, panic_text};
use linkage::solver::State;
use linkage::work::{Count, WorkTally};

/// If a loop opens by more than this fraction of the mechanism's size, the run is stopped.
const LARGEST_GAP: f64 = 0.05;
/// If a link turns by more than this angle (rad) in one step, the run is stopped: its trajectory is meaningless.
const LARGEST_TURN: f64 = std::f64::consts::FRAC_PI_2;
/// If the kinetic energy after a step is more than this factor times the largest kinetic energy before the step, the
/// run has diverged and is stopped.
/// The factor corresponds to a factor of ten in the speeds.
/// In a prescribed motion, the drives enforce their speeds and energy is not conserved. But the kinetic energy of a
/// prescribed motion changes little in a step, because it depends only on the pose and the speeds of the drives.
const LARGEST_GROWTH: f64 = 100.0;

/// A world and the quantities that are supervised.
pub(super) struct Guard<'a> {
    case: &'a Case,
    world: Box<dyn World>,
    /// The mechanism's size (m).
    size: f64,
    largest_gap: f64,
    /// Frames of all links after the last step. `centres` are the mass centres of all links (m), also after the last
    /// step.
    frames: Vec<LinkFrame>,
    centres: Vec<Vec2>,
    loads: Vec<Wrench>,
    /// Mass (kg) and moment of inertia (kg m^2) of all links.
    masses: Vec<[f64; 2]>,
    step: f64,
    /// Sweeps in a step, summed over its substeps.
    sweeps: usize,
    tally: WorkTally,
    /// Largest kinetic energy so far (J).
    /// The initial value assumes that all links turn as fast as the fastest drive.
    /// The initial value also assumes that every mass centre is one mechanism size from the axis of rotation.
    energy: f64,
    /// Whether no step has been done yet.
    first: bool,
}

impl<'a> Guard<'a> {
    /// Supervises a world in its start pose; `settings` are those of the world.
    pub(super) fn new(case: &'a Case, world: Box<dyn World>, settings: &Settings) -> Self {
        let mut tally = WorkTally::default();
        tally.one(Count::Worlds);
        let size = case.mechanism.size();
        let masses = masses(case, world.tree());
        let energy = masses.iter().map(|[mass, inertia]| 0.5 * (mass * size * size + inertia)).sum::<f64>();
        let mut guard = Guard {
            case,
            world,
            size,
            largest_gap: LARGEST_GAP * size,
            frames: Vec::new(),
            centres: Vec::new(),
            masses,
            step: settings.resolution,
            sweeps: settings.sweeps * settings.substeps,
            tally,
            loads: vec![Wrench::ZERO; case.mechanism.links().len()],
            energy: energy * case.drives.top_speed(size).powi(2),
            first: true,
        };
        guard.stand();
        guard
    }

    /// Stores the world's present frames.
    fn stand(&mut self) {
        self.frames.clear();
        self.frames.extend_from_slice(self.world.frames());
        self.centres.clear();
        let links = self.case.mechanism.links();
        self.centres.extend(self.frames.iter().zip(links).map(|(frame, link)| frame.point(link.mass_centre)));
    }

    /// Frames of all links after the last step or placement.
    pub(super) fn frames(&self) -> &[LinkFrame] {
        &self.frames
    }

    /// Mass centres of all links (m) after the last step or placement.
    pub(super) fn centres(&self) -> &[Vec2] {
        &self.centres
    }

    pub(super) fn world(&self) -> &dyn World {
        self.world.as_ref()
    }

    /// Sets the speed of every drive to the value that `speed` returns for the drive (rad/s, or m/s for a slide).
    pub(super) fn drive(&mut self, speed: impl Fn(&Drive) -> f64) {
        for (index, drive) in self.case.drives.iter().enumerate() {
            self.world.set_drive(index, speed(drive));
        }
    }

    /// Sets all drives for a step between two times (s).
    /// Links with prescribed motion get their mean speed in the step.
    /// A free crank gets `motor`: target speed (rad/s) and damping (N m s/rad). Free links other than the crank get no
    /// motor.
    pub(super) fn drive_freely(&mut self, [from, to]: [f64; 2], motor: [f64; 2]) {
        for (index, drive) in self.case.drives.iter().enumerate() {
            match (&drive.motion, index) {
                (DriveMotion::Prescribed { .. }, _) => self.world.set_drive(index, drive.step_speed(from, to)),
                (DriveMotion::Free { .. }, 0) => self.world.set_motor(index, motor[0], motor[1]),
                (DriveMotion::Free { .. }, _) => self.world.set_motor(index, 0.0, 0.0),
            }
        }
    }

    /// Sets the loads of all links.
    pub(super) fn put_loads(&mut self, loads: &[Wrench]) {
        for (link, &load) in loads.iter().enumerate().skip(1) {
            self.world.set_load(LinkId(link), load);
        }
    }

    /// Sets the loads of the case that act on all links in a state.
    pub(super) fn load(&mut self, state: &State) {
        if self.case.loads.is_empty() {
            return;
        }
        let mut loads = std::mem::take(&mut self.loads);
        self.case.loads_on(&state.motions, &state.angles, &mut loads);
        self.put_loads(&loads);
        self.loads = loads;
    }

    /// Sets the time step (s).
    pub(super) fn set_step(&mut self, step: f64) {
        self.world.set_step(step);
        self.step = step;
    }

    /// Sets whether the velocities after a step exclude the correction of gaps.
    pub(super) fn set_stabilised(&mut self, stabilised: bool) {
        self.world.set_stabilised(stabilised);
    }

    /// Moves all links into the given poses; velocities stay as they are.
    pub(super) fn place(&mut self, poses: &[LinkPose]) {
        self.world.place(poses);
        self.stand();
    }

    /// Does one time step, which ends at `t` (s).
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] in any of these cases: a loop has opened, a link has turned by more than a quarter turn,
    /// the kinetic energy has grown a hundredfold, a number is not finite, or the engine has panicked.
    pub(super) fn step(&mut self, t: f64) -> Result<()> {
        self.tally.one(Count::Steps);
        self.tally.many(Count::Sweeps, self.sweeps);
        let Guard { case, world, frames: before, centres, masses, size, .. } = self;
        let (links, joints) = (case.mechanism.links(), case.mechanism.joints());
        // For a free crank, the error states the crank angle before the step.
        let place = |before: &[LinkFrame]| {
            Moment::of(case.crank(), case.crank().from_coordinate(before[case.crank().link].angle()), t)
        };
        guarded(|| world.step()).map_err(|cause| panicked(place(before), cause.as_ref()))?;
        let frames = world.frames();
        let mut twice_energy = 0.0;
        for ((link, body), (frame, before_it)) in links.entries().zip(frames.iter().zip(before.iter())).skip(1) {
            let turn = frame.turn_since(before_it);
            // The comparison is negated so that NaN also stops the run.
            if !(turn <= LARGEST_TURN) {
                let (name, degrees, place) = (&body.name, turn.to_degrees(), place(before));
                let message = sentences::the_engine_link_has_turned(&name, &degrees, &place);
                return Err(place.failed(message).of_link(name).beyond(turn, LARGEST_TURN, "rad"));
            }
            let [mass, inertia] = masses[link];
            let centre = frame.point(body.mass_centre);
            let moved = (centre - centres[link]).norm_squared();
            twice_energy += mass * moved + inertia * turn * turn;
            centres[link] = centre;
        }
        let energy = 0.5 * twice_energy / (self.step * self.step);
        // The first step sets the reference energy, because links may be much faster than the drives.
        let first = std::mem::take(&mut self.first) && energy.is_finite();
        if !first && !(energy <= LARGEST_GROWTH * self.energy) {
            let (growth, place) = (energy / self.energy, place(before));
            let message = sentences::the_engine_kinetic_energy_has_grown(&format_args!("{growth:.1e}"), &place);
            return Err(place.failed(message).beyond(growth, LARGEST_GROWTH, ""));
        }
        self.energy = self.energy.larger(energy);
        for &joint in &world.tree().cut {
            let gap = opening(frames, &joints[joint], *size);
            if !(gap <= self.largest_gap) {
                let (name, place) = (&joints[joint].name, place(before));
                let message = sentences::the_engine_loop_has_opened(&format_args!("{gap:.3e}"), &name, &place);
                return Err(place.failed(message).of_joint(name).beyond(gap, self.largest_gap, "m"));
            }
        }
        before.copy_from_slice(frames);
        Ok(())
    }

    /// Checks that the world is back in the case's start pose after it has run backwards and forwards.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] if a link deviates from the start pose by more than the allowed loop opening.
    /// A larger deviation means that the engine has passed a dead point into an assembly mode other than that of the
    /// start.
    pub(super) fn check_start(&self) -> Result<()> {
        let case = self.case;
        for ((id, link), pose) in case.mechanism.links().entries().zip(&case.start.0).skip(1) {
            let off = |local| (self.world.point(JointSide { link: id, local }) - pose.point(local)).norm();
            let far = link.points.iter().map(|point| off(point.local)).fold(off(link.mass_centre), f64::larger);
            // The comparison is negated so that NaN also stops the run.
            if !(far <= self.largest_gap) {
                let at = case.told(case.crank().start);
                let message = sentences::the_engine_ran_up_from_a_few(&at, &link.name, &format_args!("{far:.3e}"));
                return Err(Error::new(ErrorKind::Numeric, message)
                    .at_time(0.0)
                    .at_input(at)
                    .of_link(&link.name)
                    .beyond(far, self.largest_gap, "m")
                    .help(Advice::SmallerStep { to: None })
                    .or_help(sentences::BEGIN_THE_GRID_FARTHER_FROM_THE_DEAD));
            }
        }
        Ok(())
    }
}

/// One supervised world for each tree.
///
/// # Errors
/// [`ErrorKind::Unsupported`] if Rapier refuses a joint.
pub(super) fn guards<'a>(
    engine: &Rapier,
    case: &'a Case,
    trees: Vec<SpanningTree>,
    loading: Loading,
) -> Result<Vec<Guard<'a>>> {
    let world = |tree| Ok(Guard::new(case, engine.world_for(case, tree, loading)?, &engine.settings));
    trees.into_iter().map(world).collect()
}

/// Time and input at which a step failed.
#[derive(Clone, Copy)]
struct Moment {
    /// Time (s).
    t: f64,
    /// Value of the input at this time.
    input: InputValue,
}

impl Moment {
    /// The input of a free crank is `before`, the angle before the step.
    /// The input of a prescribed crank is its value at `t`.
    fn of(drive: &Drive, before: f64, t: f64) -> Self {
        Moment { t, input: drive.told(if drive.is_free() { before } else { drive.at(t).value }) }
    }

    fn error(self, message: String) -> Error {
        let error = Error::new(ErrorKind::Numeric, message).at_time(self.t).at_input(self.input);
        error.help(Advice::SmallerStep { to: None })
    }

    fn failed(self, message: String) -> Error {
        self.error(message).or_help(sentences::CHECK_THAT_THE_POSE_CAN_BE_ASSEMBLED)
    }
}

impl fmt::Display for Moment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "t = {:.6} s, {}", self.t, self.input)
    }
}

fn panicked(place: Moment, cause: &(dyn std::any::Any + Send)) -> Error {
    let words = panic_text(cause).unwrap_or("no message");
    place.error(sentences::the_engine_has_panicked(&words, &place)).or_help(Advice::OtherEngine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::LinkAngle;
    use crate::{Build, Precision};
    use fixtures::{four_bar, turning};
    use linkage::math::{rotated, unit};
    use linkage::mechanism::{JointId, TransmissionId};

    /// A world whose steps fail. After a failing step, the world reports wrong positions and angles.
    struct Broken {
        world: Box<dyn World>,
        wrong: fn(&mut dyn World),
        off: (Vec2, f64),
        /// Number of sound steps before the first failing step.
        healthy: usize,
        frames: Vec<LinkFrame>,
    }

    impl World for Broken {
        fn tree(&self) -> &SpanningTree {
            self.world.tree()
        }
        fn step(&mut self) {
            if self.healthy > 0 {
                self.healthy -= 1;
                self.world.step();
                self.frames.copy_from_slice(self.world.frames());
                return;
            }
            (self.wrong)(self.world.as_mut());
            for (frame, own) in self.frames.iter_mut().zip(self.world.frames()) {
                let direction = rotated(unit(self.off.1), own.direction);
                frame.follow(own.origin + self.off.0, direction);
                if let LinkAngle::Whole(angle) = own.angle {
                    frame.angle = LinkAngle::Whole(angle + self.off.1);
                }
            }
        }
        fn bare_step(&mut self) {
            self.world.bare_step();
        }
        fn set_step(&mut self, step: f64) {
            self.world.set_step(step);
        }
        fn set_stabilised(&mut self, stabilised: bool) {
            self.world.set_stabilised(stabilised);
        }
        fn set_drive(&mut self, drive: usize, omega: f64) {
            self.world.set_drive(drive, omega);
        }
        fn set_motor(&mut self, drive: usize, target: f64, damping: f64) {
            self.world.set_motor(drive, target, damping);
        }
        fn set_load(&mut self, link: LinkId, load: Wrench) {
            self.world.set_load(link, load);
        }
        fn place(&mut self, poses: &[LinkPose]) {
            self.world.place(poses);
        }
        fn frames(&self) -> &[LinkFrame] {
            &self.frames
        }
        fn relative_speed(&self, index: usize) -> f64 {
            self.world.relative_speed(index)
        }
        fn velocity(&self, link: LinkId) -> Option<(Vec2, f64)> {
            self.world.velocity(link)
        }
        fn reaction(&self, joint: JointId) -> Option<(Vec2, f64)> {
            self.world.reaction(joint)
        }
        fn transmitted(&self, transmission: TransmissionId) -> f64 {
            self.world.transmitted(transmission)
        }
        fn torque(&self, drive: usize) -> f64 {
            self.world.torque(drive)
        }
    }

    const BUILDS: [Build; 2] = [Build::Multibody, Build::Impulse];

    /// Result of one guarded step of a broken world. In the step, the world calls `wrong` and then shifts all positions
    /// and angles of its links by `off`.
    fn step(build: Build, wrong: fn(&mut dyn World), off: (Vec2, f64)) -> Result<()> {
        step_after(0, build, wrong, off)
    }

    /// Result of a guarded step that fails after `healthy` sound steps.
    fn step_after(healthy: usize, build: Build, wrong: fn(&mut dyn World), off: (Vec2, f64)) -> Result<()> {
        let case = turning(four_bar());
        let engine = Rapier::new(build, Precision::Double, 1e-3);
        let tree = if build == Build::Impulse {
            SpanningTree::none(&case.mechanism)
        } else {
            SpanningTree::of(&case.mechanism)
        };
        let world = engine.world(&case, tree, false).unwrap();
        let frames = world.frames().to_vec();
        let mut guard = Guard::new(&case, Box::new(Broken { world, wrong, off, healthy, frames }), &engine.settings);
        (0..healthy).try_for_each(|_| guard.step(0.249))?;
        guard.step(0.25)
    }

    fn turned(by: f64) -> (Vec2, f64) {
        (Vec2::zeros(), by)
    }

    #[test]
    fn a_panic_of_the_engine_becomes_an_error_of_that_engine() {
        for build in BUILDS {
            let error = step(build, |_| panic!("index out of bounds"), turned(0.0)).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Numeric);
            for part in ["index out of bounds", "t = 0.250000 s", "crank angle"] {
                assert!(error.message().contains(part), "{error}");
            }
        }
    }

    #[test]
    fn nan_stops_the_run() {
        for build in BUILDS {
            let error = step(build, |_| {}, turned(f64::NAN)).unwrap_err();
            assert!(error.message().contains("has turned by NaN deg in one step, t = 0.250000 s"), "{error}");
        }
    }

    #[test]
    fn an_implausible_rotation_stops_the_run() {
        for build in BUILDS {
            let error = step(build, |_| {}, turned(1.6)).unwrap_err();
            assert!(error.message().contains("has turned by 91.7 deg in one step"), "{error}");
            let error = step(build, |_| {}, turned(-1.6)).unwrap_err();
            assert!(error.message().contains("has turned by 91.7 deg in one step"), "{error}");
        }
    }

    /// All links move away together, as sliders can: no link turns and no loop opens.
    /// The links reach 5 m from the origin, and the drive turns at 1 rad/s.
    /// In a step of a millisecond, a point at 5 m travels 5 mm. The limit of ten times this speed is near 5 cm per
    /// step.
    #[test]
    fn spurious_energy_stops_the_run() {
        for build in BUILDS {
            step_after(1, build, |_| {}, (Vec2::new(0.01, 0.0), 0.0)).unwrap();
            // The first step sets the reference energy, so a large displacement in the first step is accepted.
            step(build, |_| {}, (Vec2::new(0.2, 0.0), 0.0)).unwrap();
            let error = step_after(1, build, |_| {}, (Vec2::new(0.2, 0.0), 0.0)).unwrap_err();
            assert!(error.message().contains("kinetic energy has grown"), "{error}");
            assert!(error.message().contains("t = 0.250000 s, crank angle"), "{error}");
            let error = step(build, |_| {}, (Vec2::new(f64::NAN, 0.0), 0.0)).unwrap_err();
            assert!(error.message().contains("NaN"), "{error}");
        }
    }
}
