//! What every solver is given: the mechanism, what drives and loads it, where it starts, and what is wanted.

mod check;

use std::f64::consts::TAU;
use std::ops::Deref;

use crate::Result;
use crate::drive::{Action, Drive, Drives, Load, Motor, Setting, Wrench};
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
        if drive.constant_speed().is_none() {
            let name = drive.law_name();
            if self.times.iter().any(|t| t.is_nan()) && self.cranks.iter().all(|crank| crank.is_finite()) {
                return Err(format!(
                    "the drive's law, \"{name}\", does not come to a crank angle of the grid at one time"
                ));
            }
            // The rounding of the last instant belongs to it.
            let end = drive.end().unwrap_or(f64::INFINITY);
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

/// What a [`Case`] is made of, not checked yet. SI units, world axes.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseParts {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Its driving links and Assur groups.
    pub structure: Structure,
    /// What moves the mechanism, in the order of [`Structure::drivers`].
    pub drives: Drives,
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

/// A problem, ready for any solver: parts that fit together. They are read as fields, `case.mechanism` for one; what changes them gives a new case, and
/// checks it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case(CaseParts);

impl Deref for Case {
    type Target = CaseParts;

    #[inline]
    fn deref(&self) -> &CaseParts {
        &self.0
    }
}

impl Case {
    /// The case of these parts.
    ///
    /// # Errors
    /// [`ErrorKind::Input`](crate::ErrorKind::Input) with the part at fault as key, if drives, loads, start pose or modes do not belong to the mechanism or
    /// hold numbers that are none, or the structure is not that of mechanism and drives; [`ErrorKind::Geometry`](crate::ErrorKind::Geometry) if the start pose
    /// leaves a joint open or a driving link off its angle; [`ErrorKind::Unsupported`](crate::ErrorKind::Unsupported) for drives that this version does not solve
    /// together; those of [`Structure::of`] and [`Grid::check`].
    pub fn new(parts: CaseParts) -> Result<Case> {
        check::all(&parts)?;
        Ok(Case(parts))
    }

    /// The case of these parts, whatever they are: for tests that plant a fault and ask who notices it.
    #[cfg(any(test, feature = "fixtures"))]
    #[doc(hidden)]
    #[must_use]
    pub fn unchecked(parts: CaseParts) -> Case {
        Case(parts)
    }

    /// The parts, to be changed and put together again.
    #[must_use]
    pub fn into_parts(self) -> CaseParts {
        self.0
    }

    /// The same problem with some parts changed by `change`.
    ///
    /// # Errors
    /// Those of [`Case::new`].
    pub fn with(&self, change: impl FnOnce(&mut CaseParts)) -> Result<Case> {
        let mut parts = self.0.clone();
        change(&mut parts);
        Case::new(parts)
    }

    /// The same problem on another grid.
    ///
    /// # Errors
    /// Those of [`Grid::check`].
    pub fn on(&self, grid: Grid) -> Result<Case> {
        check::grid(&grid, self.crank())?;
        Ok(Case(CaseParts { grid, ..self.0.clone() }))
    }

    /// The same problem with other channels wanted.
    #[must_use]
    pub fn wanting(&self, wanted: Wanted) -> Case {
        Case(CaseParts { wanted, ..self.0.clone() })
    }

    /// The same problem with another motor of the crank, or without one.
    ///
    /// # Errors
    /// Those of [`Case::new`]: of a motor whose numbers are none.
    pub fn with_motor(&self, motor: Option<Motor>) -> Result<Case> {
        self.with(|parts| *parts.drives.crank_mut() = self.crank().with_motor(motor))
    }

    /// The same problem with every drive in its nominal motion: what questions about crank angles are about.
    #[must_use]
    pub fn nominal(&self) -> Case {
        Case(CaseParts { drives: self.drives.map(Drive::nominal), ..self.0.clone() })
    }

    /// The same problem with the crank turning at its drive's top speed all the time.
    #[must_use]
    pub fn at_top_speed(&self) -> Case {
        let mut drives = self.drives.clone();
        *drives.crank_mut() = self.crank().at_top_speed();
        Case(CaseParts { drives, ..self.0.clone() })
    }
    /// The wanted channels in the order of columns: links, points, joints, sliders, frame, drive, further drives; within each as in [`CHANNELS`].
    #[must_use]
    pub fn channels(&self) -> Vec<Channel> {
        let links = self.mechanism.links()[1..].iter().map(|link| (Subject::Link, link.name.as_str()));
        let points = self.mechanism.moving_points().map(|(name, _)| (Subject::Point, name));
        let joints = self.mechanism.joints().iter().map(|joint| (Subject::Joint, joint.name.as_str()));
        let sliders = self.mechanism.joints().iter().filter(|joint| joint.slides());
        let sliders = sliders.map(|joint| (Subject::Slider, joint.name.as_str()));
        let frame = std::iter::once((Subject::Frame, ""));
        let moved = self.drives.with_moment().map(|(index, drive)| match index {
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

    /// The driving link by whose angle instants are told.
    #[inline]
    #[must_use]
    pub fn crank(&self) -> &Drive {
        self.drives.crank()
    }

    /// Whether forces decide the motion of a driving link. Then crank angles are known of solved trajectories only: those of the grid are
    /// of the nominal motion.
    #[must_use]
    pub fn is_free(&self) -> bool {
        self.drives.iter().any(Drive::is_free)
    }

    /// Whether all driving links turn with constant speeds.
    #[must_use]
    pub fn is_steady(&self) -> bool {
        !self.is_free() && self.drives.iter().all(|drive| drive.constant_speed().is_some())
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
        let crank = angles[self.crank().link] - self.crank().zero;
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
