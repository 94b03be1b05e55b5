//! Motion in time from a given speed of the crank: run-up, run-down, swinging.

use super::flow::{Forces, InTime};
use super::model::{Piece, ReducedModel};
use crate::motion::march::{MOST_EMPTY, Pace, Place, Stop, march};
use crate::motion::step::Step;
use crate::{PoseSolver, sentences};
use linkage::case::{Case, Grid};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::solver::{Sampler, Visit};
use linkage::trajectory::{Channel, Stage, Trajectory};

/// Distance (rad, or a fraction of the mechanism's size for a slide) over which the slope of an acceleration is taken.
const SLOPE: f64 = 1e-6;
/// Rounding errors of a crank angle, in units of the last place of the angle plus 1 rad.
const ROUNDED: f64 = 8.0;

/// The crank at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrankState {
    /// Time (s).
    pub t: f64,
    /// Crank angle (rad, as the scenario states it), including whole turns.
    pub crank: f64,
    /// Crank angle (rad) without the completed periods. This angle loses no digits after many turns.
    pub within: f64,
    /// Angular velocity of the crank (rad/s).
    pub omega: f64,
    /// Angular acceleration of the crank (rad/s^2).
    pub alpha: f64,
    /// Static moment of the motor on the crank (N m), counter-clockwise positive. The moment that accelerates rotor and
    /// reducer is not subtracted.
    pub motor: f64,
    /// Moment that the crank's shaft transmits to the mechanism (N m): the motor's moment minus the moment that
    /// accelerates rotor, reducer and flywheel.
    pub shaft: f64,
}

/// How a motion ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RunUpEnd {
    /// The motion ended at the last requested instant.
    Reached,
    /// The motion ended at a standstill, held by loads and losses. The fields are time (s) and crank angle (rad).
    Held(f64, f64),
    /// The motion ended before a limit of rotation. The fields are time (s) and crank angle (rad).
    Limit(f64, f64),
}

/// Motion of the crank at the requested times (s, from 0, ascending), and how it ended.
/// The motion begins at the start of the case with the speed `omega` (rad/s).
/// Instants after the end are left out.
///
/// # Errors
/// [`ErrorKind::Input`] if a time is negative, if the times do not ascend, or if a number is not finite.
/// [`ErrorKind::Unsupported`] if the crank may start from rest in either sense.
/// [`ErrorKind::Numeric`] where the integration cannot continue.
/// The errors of [`PoseSolver::solve`] are passed on.
pub fn motion(model: &ReducedModel, omega: f64, times: &[f64], accuracy: f64) -> Result<(Vec<CrankState>, RunUpEnd)> {
    if times.iter().chain(&[omega]).any(|value| !value.is_finite())
        || times.first().is_some_and(|&first| first < 0.0)
        || times.windows(2).any(|pair| !(pair[0] < pair[1]))
    {
        let error = Error::new(ErrorKind::Input, sentences::THE_INSTANTS_OF_A_MOTION);
        return Err(error.help(sentences::GIVE_FINITE_TIMES_IN_ASCENDING));
    }
    followed(model, omega, times, accuracy, Stage::BalancingMoment)
}

/// Like `motion`, up to the stage `deepest`.
/// If `deepest` is before the accelerations, acceleration and moments are not computed and are zero.
pub(crate) fn followed(
    model: &ReducedModel,
    omega: f64,
    times: &[f64],
    accuracy: f64,
    deepest: Stage,
) -> Result<(Vec<CrankState>, RunUpEnd)> {
    let mut runner = Runner::begin(model, omega, deepest >= Stage::Accelerations)?;
    let mut found = Vec::with_capacity(times.len());
    let end = runner.run(times, accuracy, &mut found)?;
    Ok((found, end))
}

struct Runner<'m, 'a> {
    flow: InTime<'m, 'a>,
    /// Present state; the crank angle is counted from the beginning of the present period.
    place: Place<2>,
    /// Crank angle (rad) of all completed periods together.
    gone: f64,
    /// Whether accelerations are requested at the instants.
    is_accelerated: bool,
}

impl<'m, 'a> Runner<'m, 'a> {
    fn begin(model: &'m ReducedModel<'a>, omega: f64, is_accelerated: bool) -> Result<Self> {
        let crank = model.case.crank().start;
        let somewhere = Piece::unbounded();
        let flow = InTime(Forces::of(model, somewhere, 1f64.copysign(omega))?);
        Ok(Runner { flow, place: Place { x: 0.0, y: [crank, omega], h: 0.0 }, gone: 0.0, is_accelerated })
    }

    fn run(&mut self, times: &[f64], accuracy: f64, found: &mut Vec<CrankState>) -> Result<RunUpEnd> {
        let Some(&last) = times.last() else { return Ok(RunUpEnd::Reached) };
        let (mut empty, mut pace) = (0, Pace::default());
        if let Some(end) = self.enter()? {
            return Ok(self.ended(times, found, end));
        }
        if times[0] == 0.0 {
            found.push(instant(&self.flow, 0.0, self.place.y, self.gone, self.is_accelerated));
        }
        while self.place.x < last {
            let from = self.place.x;
            let (gone, is_accelerated) = (self.gone, self.is_accelerated);
            let mut visit = |flow: &InTime, &[_, (x, y)]: &Step<2>| {
                if times.get(found.len()) == Some(&x) {
                    found.push(instant(flow, x, y, gone, is_accelerated));
                }
                Ok(())
            };
            let stop = march(&self.flow, &mut self.place, times, accuracy, &mut visit)?;
            empty = if self.place.x > from { 0 } else { empty + 1 };
            if empty > MOST_EMPTY {
                let at = self.flow.0.model.case.told(self.place.y[0]);
                let message = sentences::the_motion_does_not_get_away_from_at(&at, &from);
                return Err(Error::new(ErrorKind::Numeric, message).help(sentences::A_LOAD_THAT_TURNS_ABOUT_JUST_THERE));
            }
            if let Stop::Bound(bound) = stop {
                pace.piece(self.place.x, last)?;
                self.arrive(bound);
                if let Some(end) = self.enter()? {
                    return Ok(self.ended(times, found, end));
                }
            } else {
                break;
            }
        }
        Ok(RunUpEnd::Reached)
    }

    /// Sets the coordinate that has reached a bound exactly to the bound.
    fn arrive(&mut self, bound: usize) {
        let forces = &self.flow.0;
        let [from, to] = forces.piece.get().ends;
        match bound {
            InTime::UPPER | InTime::LOWER => {
                let reached = if bound == InTime::UPPER { to } else { from };
                let back = forces.model.wrap(reached, forces.way.get());
                self.gone += back;
                self.place.y[0] = reached - back;
                forces.begin_at(self.place.y[0]);
            }
            InTime::STANDSTILL => self.place.y[1] = 0.0,
            _ => {
                let ends = forces.branch.get().map_or([0.0; 2], |branch| branch.speeds);
                let speed = if bound == InTime::FAST { ends[1] } else { ends[0] };
                self.place.y[1] = forces.model.sense * speed;
            }
        }
    }

    /// Chooses sense, piece and branch for the next part of the motion. If the motion does not continue, returns its
    /// end.
    fn enter(&mut self) -> Result<Option<RunUpEnd>> {
        let (t, [crank, omega]) = (self.place.x, self.place.y);
        // From standstill, the crank starts in a direction if its acceleration points in this direction.
        // The acceleration includes the loads that resist a motion in this direction.
        let ways: &[f64] = if omega == 0.0 { &[1.0, -1.0] } else { &[omega.signum()] };
        for &way in ways {
            let Some(alpha) = self.turned(way) else {
                if omega == 0.0 {
                    continue;
                }
                return Ok(Some(RunUpEnd::Limit(t, crank + self.gone)));
            };
            let forces = &self.flow.0;
            if omega == 0.0 && !(way * alpha > self.rounding(crank)) {
                continue;
            }
            if omega == 0.0 && way > 0.0 && self.starts_back() {
                let at = forces.model.case.told(crank + self.gone);
                return Err(Error::new(ErrorKind::Unsupported, sentences::at_the_crank_may_start_from_rest(&t, &at))
                    .at_time(t)
                    .at_input(at)
                    .help(sentences::GIVE_THE_CRANK_A_SPEED_AT_OR_LET));
            }
            if omega != 0.0 {
                forces.branch.set(forces.model.branch(omega, alpha));
            }
            return Ok(None);
        }
        Ok(Some(RunUpEnd::Held(t, crank + self.gone)))
    }

    /// Chooses piece, sense and branch for a motion in the sense `way` from the present state. Returns the crank's
    /// acceleration, or `None` at a limit of the motion in this sense.
    fn turned(&self, way: f64) -> Option<f64> {
        let (forces, [crank, omega]) = (&self.flow.0, self.place.y);
        forces.piece.set(forces.model.piece_at(crank, way)?);
        forces.way.set(way);
        forces.branch.set(forces.model.branch(omega, way));
        Some(forces.acceleration(crank, omega))
    }

    /// Whether the crank could start clockwise from rest. Piece, sense and branch are unchanged afterwards.
    fn starts_back(&self) -> bool {
        let forces = &self.flow.0;
        let before = (forces.piece.get(), forces.way.get(), forces.branch.get());
        let back = self.turned(-1.0).is_some_and(|alpha| alpha < 0.0);
        forces.piece.set(before.0);
        forces.way.set(before.1);
        forces.branch.set(before.2);
        back
    }

    /// The rounding error of the crank's acceleration at rest (rad/s^2, or m/s^2 for a slide): the change of the
    /// acceleration within the rounding of the crank angle. Zero if the acceleration has no value near the crank angle.
    fn rounding(&self, crank: f64) -> f64 {
        let forces = &self.flow.0;
        let [nudge, size] = [SLOPE, 1.0].map(|turn| forces.model.case.step(turn));
        let [behind, ahead] = [-nudge, nudge].map(|by| forces.acceleration(crank + by, 0.0));
        // An error beside the crank angle does not concern the motion.
        let _ = forces.take_fault();
        let slope = ((ahead - behind) / (2.0 * nudge)).abs();
        if slope.is_finite() { ROUNDED * f64::EPSILON * (crank.abs() + size) * slope } else { 0.0 }
    }

    /// Whether no force moves the crank from rest: its acceleration is a rounding error, whatever the sense.
    fn is_in_equilibrium(&self) -> bool {
        let is_rounding = |alpha: f64| alpha.abs() <= self.rounding(self.place.y[0]);
        [1.0, -1.0].iter().all(|&way| self.turned(way).is_some_and(is_rounding))
    }

    /// Adds the instants after the end of a motion. A crank in equilibrium stays at rest at all further instants. If
    /// resistances hold the crank, only the instant of the standstill is added.
    fn ended(&self, times: &[f64], found: &mut Vec<CrankState>, end: RunUpEnd) -> RunUpEnd {
        let RunUpEnd::Held(t, crank) = end else { return end };
        let (within, rests) = (crank - self.gone, self.is_in_equilibrium());
        // The shaft transmits the whole moment of the motor. The forces that hold the crank balance this moment.
        let motor = self.flow.0.motor_moment(0.0);
        let is_added = |time: &&f64| rests || **time == t;
        for &t in times[found.len()..].iter().take_while(is_added) {
            found.push(CrankState { t, crank, within, omega: 0.0, alpha: 0.0, motor, shaft: motor });
        }
        if rests { RunUpEnd::Reached } else { end }
    }
}

/// The [`CrankState`] for crank angle and speed at the time `t`. The angle `gone` (rad) of the completed periods is
/// added to the crank angle.
fn instant(flow: &InTime, t: f64, [crank, omega]: [f64; 2], gone: f64, is_accelerated: bool) -> CrankState {
    if !is_accelerated {
        return CrankState { t, crank: crank + gone, within: crank, omega, alpha: 0.0, motor: 0.0, shaft: 0.0 };
    }
    let alpha = flow.0.acceleration(crank, omega);
    let motor = flow.0.motor_moment(omega);
    CrankState { t, crank: crank + gone, within: crank, omega, alpha, motor, shaft: motor - flow.0.model.added * alpha }
}

/// Kinetostatics of a motion: the state at every instant, up to the stage that the case requests.
/// `model` is the model from which `motion` was computed. The grid of `case` may differ from the grid of the model's
/// case, and `case` may request fewer channels.
pub(crate) fn states(model: &ReducedModel, case: &Case, motion: &[CrankState], visit: Visit) -> Result<()> {
    let mut poses = model.guided(PoseSolver::counting_turns(case)?);
    let deepest = case.wanted.deepest();
    for (row, instant) in motion.iter().enumerate() {
        poses.solve(instant.crank, instant.omega, instant.alpha, deepest)?;
        // At the instant of starting from rest, loads act against the motion that is about to begin.
        if instant.omega == 0.0 && instant.alpha != 0.0 && deepest >= Stage::Reactions {
            visit(row, poses.set_off(instant.crank, instant.alpha, deepest)?)?;
            continue;
        }
        visit(row, poses.with_angles())?;
    }
    Ok(())
}

/// A motion with all its effects on the mechanism.
#[derive(Clone, Debug)]
pub struct RunUp {
    /// The crank at every instant.
    pub motion: Vec<CrankState>,
    /// All requested channels at these instants.
    /// `drive.torque_N_m` is the moment of the shaft on the crank. It follows from the equilibrium of the crank under
    /// the reactions in its joints.
    pub trajectory: Trajectory,
    /// How the motion ended.
    pub end: RunUpEnd,
    /// Largest reaction times the mechanism's size (N m). This product is the reference for moments if it exceeds all
    /// moments on the crank.
    natural: f64,
}

impl RunUp {
    /// Motion of the case's mechanism at the given times, with the channels that the case requests.
    /// Kinetostatics uses the speed and acceleration of this motion.
    ///
    /// # Errors
    /// The errors of [`motion`].
    pub fn of(model: &ReducedModel, omega: f64, times: &[f64], accuracy: f64) -> Result<Self> {
        let (motion, end) = motion(model, omega, times, accuracy)?;
        let grid = Grid {
            times: motion.iter().map(|instant| instant.t).collect(),
            inputs: motion.iter().map(|instant| instant.crank).collect(),
        };
        // Forces determine this motion, so the crank's prescribed law must not limit the times of the grid.
        let case = model.case.at_top_speed().on(grid)?;
        let mut sampler = Sampler::new(&case);
        let (mut natural, size) = (0.0f64, case.mechanism.size());
        states(model, &case, &motion, &mut |row, state| {
            natural = state.forces.iter().fold(natural, |most, force| most.larger(force.norm() * size));
            sampler.put(&case, row, state);
            Ok(())
        })?;
        let trajectory = sampler.finish(&case)?;
        Ok(RunUp { motion, trajectory, end, natural })
    }

    /// Largest difference between the shaft's moment of the equation of motion ([`CrankState::shaft`]) and
    /// `drive.torque_N_m`.
    /// The difference is divided by the largest moment or by the largest reaction times the mechanism's size, whichever
    /// is larger.
    /// The difference compares the equation of motion with the reactions, which are computed without reduced
    /// quantities.
    /// `None` if the balancing moment is not requested.
    #[must_use]
    pub fn power_residual(&self) -> Option<f64> {
        let asked = self.trajectory.column(&Channel::named("drive.torque_N_m")?)?;
        let scale =
            asked.iter().chain(self.motion.iter().map(|i| &i.motor)).fold(self.natural, |most, m| most.larger(m.abs()));
        let worst =
            self.motion.iter().zip(asked).fold(0.0f64, |most, (i, &asked)| most.larger((i.shaft - asked).abs()));
        Some(if scale > 0.0 { worst / scale } else { worst })
    }
}
