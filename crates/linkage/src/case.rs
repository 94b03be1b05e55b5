//! What every solver is given: the mechanism, what drives and loads it, where it starts, and what is wanted.

use std::f64::consts::TAU;

use crate::drive::{Action, Drive, Load, MotionLaw, Motor, Setting, Wrench};
use crate::math::statistics::ascending;
use crate::math::{KeepNan, Motion, Vec2};
use crate::mechanism::{AssemblyMode, Mechanism, Pose, Structure};
use crate::trajectory::{CHANNELS, Channel, Stage, Subject};

/// Instants at which a solution is wanted.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Grid {
    /// Times (s), in any order.
    pub times: Vec<f64>,
    /// Crank angles at those times (rad, as the scenario states them).
    pub cranks: Vec<f64>,
}

impl Grid {
    /// Grid of the given times.
    #[must_use]
    pub fn of_times(drive: &Drive, times: Vec<f64>) -> Self {
        let cranks = times.iter().map(|&t| drive.at(t).angle).collect();
        Grid { times, cranks }
    }

    /// Grid of the given crank angles (rad, as the scenario states them).
    #[must_use]
    pub fn of_cranks(drive: &Drive, cranks: Vec<f64>) -> Self {
        let times = cranks.iter().map(|&angle| drive.time_of(angle)).collect();
        Grid { times, cranks }
    }

    /// Number of instants.
    #[must_use]
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether there is no instant.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Largest number of turns of the crank, from its zero, that a grid may lead away: solvers follow the branch all the way, and
    /// an angle of more turns has lost its last digits.
    pub const MOST_TURNS: f64 = 1e5;

    /// Checks that all times and angles are finite and within [`Grid::MOST_TURNS`], and that the law of the drive holds at all of them.
    ///
    /// # Errors
    /// A message that says how far the grid leads, or where the law ends.
    pub fn check(&self, drive: &Drive) -> std::result::Result<(), String> {
        if drive.law.constant().is_none() {
            let name = drive.law.name();
            if self.times.iter().any(|t| t.is_nan()) && self.cranks.iter().all(|crank| crank.is_finite()) {
                return Err(format!(
                    "the drive's law, \"{name}\", does not come to a crank angle of the grid at one time"
                ));
            }
            // The rounding of the last instant belongs to it.
            let end = drive.law.end().unwrap_or(f64::INFINITY);
            if let Some(t) = self.times.iter().find(|&&t| t < 0.0 || t > end * (1.0 + 1e-12)) {
                return Err(format!(
                    "the grid leads to {t} s, but the drive's law, \"{name}\", goes from 0 to {end} s"
                ));
            }
        }
        let most = self.cranks.iter().fold(0.0, |most: f64, crank| most.larger(crank.abs())) / TAU;
        if most <= Self::MOST_TURNS && self.times.iter().chain(&self.cranks).all(|value| value.is_finite()) {
            return Ok(());
        }
        Err(format!("the grid leads {most:.1e} turns away, the limit is {:e}", Self::MOST_TURNS))
    }

    /// Rows of the grid in ascending order of time.
    #[must_use]
    pub fn ascending(&self) -> Vec<usize> {
        ascending(&self.times)
    }
}

/// Which stages of channels a run wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted([bool; Stage::ALL.len()]);

impl Wanted {
    /// All channels.
    pub const ALL: Wanted = Wanted([true; Stage::ALL.len()]);

    /// The channels of the given stages.
    #[must_use]
    pub fn of(stages: &[Stage]) -> Self {
        let mut wanted = Wanted([false; Stage::ALL.len()]);
        for &stage in stages {
            wanted.0[stage as usize] = true;
        }
        wanted
    }

    /// Whether the channels of `stage` are wanted.
    #[inline]
    #[must_use]
    pub fn has(&self, stage: Stage) -> bool {
        self.0[stage as usize]
    }

    /// The last stage that must be computed; positions at least.
    #[must_use]
    pub fn deepest(&self) -> Stage {
        Stage::ALL.into_iter().rev().find(|&stage| self.has(stage)).unwrap_or(Stage::Positions)
    }
}

/// A problem, ready for any solver. SI units, world axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Its driving link and Assur groups.
    pub structure: Structure,
    /// Prescribed motion of the driving link by whose angle instants are told: the crank.
    pub drive: Drive,
    /// Prescribed motions of further driving links.
    pub further_drives: Vec<Drive>,
    /// Motor whose speed under the load is asked for; under a prescribed motion it moves nothing.
    pub motor: Option<Motor>,
    /// Loads besides gravity and inertia.
    pub loads: Vec<Load>,
    /// Acceleration of gravity (m/s^2).
    pub gravity: Vec2,
    /// Pose at t = 0.
    pub start: Pose,
    /// Assembly mode of each group, in the order of the structure.
    pub modes: Vec<AssemblyMode>,
    /// Instants wanted.
    pub grid: Grid,
    /// Channels wanted.
    pub wanted: Wanted,
}

impl Case {
    /// The wanted channels in the order of columns: links, points, joints, sliders, frame, drive, further drives; within each as in [`CHANNELS`].
    #[must_use]
    pub fn channels(&self) -> Vec<Channel> {
        let links = self.mechanism.links()[1..].iter().map(|link| (Subject::Link, link.name.as_str()));
        let points = self.mechanism.moving_points().map(|(name, _)| (Subject::Point, name));
        let joints = self.mechanism.joints().iter().map(|joint| (Subject::Joint, joint.name.as_str()));
        let sliders = self.mechanism.joints().iter().filter(|joint| joint.is_prismatic());
        let sliders = sliders.map(|joint| (Subject::Slider, joint.name.as_str()));
        let frame = std::iter::once((Subject::Frame, ""));
        let moved = self.moved().map(|(index, drive)| match index {
            0 => (Subject::Drive, ""),
            _ => (Subject::Motor, self.mechanism.joints()[drive.joint].name.as_str()),
        });
        let subjects = links.chain(points).chain(joints).chain(sliders).chain(frame).chain(moved);
        let rows = |(subject, of): (Subject, &str)| {
            let kinds = CHANNELS.iter().filter(move |kind| kind.subject == subject && self.wanted.has(kind.stage));
            kinds.map(|kind| Channel { of: of.to_string(), kind }).collect::<Vec<_>>()
        };
        subjects.flat_map(rows).collect()
    }

    /// All drives, the crank's first, in the order of [`Structure::drivers`].
    pub fn drives(&self) -> impl Iterator<Item = &Drive> {
        std::iter::once(&self.drive).chain(&self.further_drives)
    }

    /// The drives that have a moment, with their numbers: all but those of free links without a motor.
    pub fn moved(&self) -> impl Iterator<Item = (usize, &Drive)> {
        let has_motor = self.motor_of_free_crank().is_some();
        self.drives().enumerate().filter(move |&(index, drive)| drive.free.is_none() || (index == 0 && has_motor))
    }

    /// The drives of free links, with their numbers.
    pub fn free_drives(&self) -> impl Iterator<Item = (usize, &Drive)> {
        self.drives().enumerate().filter(|(_, drive)| drive.free.is_some())
    }

    /// The motor where it moves the crank: in a free motion.
    #[must_use]
    pub fn motor_of_free_crank(&self) -> Option<&Motor> {
        self.motor.as_ref().filter(|_| self.drive.free.is_some())
    }

    /// Moment of inertia of rotor and reducer that turn with a free crank (kg m^2).
    #[must_use]
    pub fn inertia_on_free_crank(&self) -> f64 {
        self.motor_of_free_crank().map_or(0.0, Motor::inertia_on_crank)
    }

    /// Whether forces decide the motion of a driving link. Then crank angles are known of solved trajectories only: those of the grid are
    /// of the nominal motion.
    #[must_use]
    pub fn is_free(&self) -> bool {
        self.free_drives().next().is_some()
    }

    /// The same problem with every drive in its nominal motion: what questions about crank angles are about.
    #[must_use]
    pub fn nominal(&self) -> Case {
        let bound = |drive: &Drive| Drive { free: None, ..drive.clone() };
        Case {
            drive: bound(&self.drive),
            further_drives: self.further_drives.iter().map(bound).collect(),
            ..self.clone()
        }
    }

    /// World angles of the driving links' x axes (rad) where the crank angle is `crank` (rad, as the scenario states it).
    #[must_use]
    pub fn drive_angles(&self, crank: f64) -> Vec<f64> {
        let t = self.drive.time_of(crank);
        let further = self.further_drives.iter().map(|drive| drive.world_angle(drive.at(t).angle));
        std::iter::once(self.drive.world_angle(crank)).chain(further).collect()
    }

    /// Angular velocities of the driving links as shares of the crank's at the time `t` (s); the crank's own is 1.
    pub fn ratios(&self, t: f64) -> impl Iterator<Item = f64> {
        let omega = self.drive.at(t).omega;
        self.drives().enumerate().map(move |(index, drive)| if index == 0 { 1.0 } else { drive.at(t).omega / omega })
    }

    /// Whether all driving links turn with constant speeds.
    #[must_use]
    pub fn is_steady(&self) -> bool {
        !self.is_free() && self.drives().all(|drive| drive.law.constant().is_some())
    }

    /// Largest speed of a driving link (rad/s), without sign.
    #[must_use]
    pub fn fastest_drive(&self) -> f64 {
        self.drives().fold(0.0, |most: f64, drive| most.larger(drive.top_speed().abs()))
    }

    /// The same problem with the crank turning at its drive's top speed all the time.
    #[must_use]
    pub fn at_top_speed(&self) -> Case {
        let law = MotionLaw::ConstantSpeed(self.drive.top_speed());
        Case { drive: Drive { law, ..self.drive.clone() }, ..self.clone() }
    }

    /// The same problem on another grid.
    #[must_use]
    pub fn on(&self, grid: Grid) -> Case {
        Case { grid, ..self.clone() }
    }

    /// Hands what every load does to every link, the ground included, to `put`; `motions` and `angles` (rad, turns kept) are those of all
    /// links, as in [`State`](crate::solver::State). Loads read positions and velocities, no accelerations.
    #[inline]
    pub fn each_load(&self, motions: &[Motion], angles: &[f64], mut put: impl FnMut(Action)) {
        let setting = self.setting(motions, angles);
        for load in &self.loads {
            load.act(&setting, &mut put);
        }
    }

    #[inline]
    fn setting<'a>(&'a self, motions: &'a [Motion], angles: &'a [f64]) -> Setting<'a> {
        let crank = angles[self.drive.link] - self.drive.zero;
        Setting { motions, angles, start: &self.start.0, crank }
    }

    /// Fills in the resultant of all loads on every link, the ground included: force at the mass centre and moment about it. Arguments as in
    /// [`Case::each_load`]; `out` has one entry a link.
    #[inline]
    pub fn loads_on(&self, motions: &[Motion], angles: &[f64], out: &mut [Wrench]) {
        self.loads_with(motions, angles, |_, load, link, crank| load.moment_in(motions[link].omega, crank), out);
    }

    /// The same, with the moment (N m) of every load that asks for the sense of a link's rotation from `sensed`, which is given its number, the load, the
    /// link and the crank angle (rad).
    #[inline]
    pub fn loads_with(
        &self,
        motions: &[Motion],
        angles: &[f64],
        sensed: impl Fn(usize, &Load, usize, f64) -> f64,
        out: &mut [Wrench],
    ) {
        out.fill(Wrench::ZERO);
        if self.loads.is_empty() {
            return;
        }
        let links = self.mechanism.links();
        let setting = self.setting(motions, angles);
        let mut add = |action: Action| {
            let centre = motions[action.link].point(links[action.link].mass_centre);
            out[action.link].force += action.force;
            out[action.link].moment += action.about(centre);
        };
        for (index, load) in self.loads.iter().enumerate() {
            match load.sensed_link() {
                Some(link) => add(Action::of_moment(link, sensed(index, load, link, setting.crank))),
                None => load.act(&setting, &mut add),
            }
        }
    }

    /// Power of all loads (W). Arguments as in [`Case::each_load`].
    #[must_use]
    pub fn load_power(&self, motions: &[Motion], angles: &[f64]) -> f64 {
        let mut power = 0.0;
        self.each_load(motions, angles, |action| power += action.power(&motions[action.link]));
        power
    }
}
