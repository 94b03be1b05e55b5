//! Motor and loads of a free motion. Motor and loads are set again before every step, from the engine's own state.
//! See docs/numerics/twins.md.

use super::added::Added;
use super::friction::Braking;
use super::guard::Guard;
use super::jumps::Jumps;
use super::rapier::Precision;
use super::window::Window;
use crate::sentences;
use linkage::case::{ANY_CRANK, Case};
use linkage::drive::load::sense_of;
use linkage::drive::{Drive, Load, MotorBranch, Wrench};
use linkage::engine::Settings;
use linkage::engine::bodies::check_inertias;
use linkage::error::Result;
use linkage::math::{KeepNan, Motion, Vec2, unit};
use linkage::mechanism::{GROUND, JointSide, LinkId};
use linkage::solver::State;

/// Rotation (rad) of the fastest driving link in the tiny step that makes the start velocities consistent.
/// If all driving links start from rest, the tiny step is this fraction of the engine's step.
const SETTLING_TURN: f64 = 1e-4;

/// If a link's initial speed is below this fraction of the fastest link's speed, the link counts as being at rest.
const STANDSTILL: f64 = 1e-9;

/// Number of tiny steps that undo a trial of the first step.
const UNDOING: usize = 8;
/// Largest number of trials of the first step.
/// The trials end earlier if two relative changes are at most `GUESSED`: the change of the compensating loads, and the
/// change of the accelerations from which the friction is computed.
const MOST_TRIALS: usize = 200;
const GUESSED: f64 = 1e-9;

/// Motor and loads of a case in free motion.
#[derive(Debug)]
pub(super) struct Acting {
    /// The engine's present state, and the angular velocities one step earlier.
    state: State,
    before: Vec<f64>,
    /// For each load that opposes the motion of a point: the velocity of this point one step earlier. NaN for other
    /// loads, and before the first step.
    swept: Vec<Vec2>,
    /// Angular velocity (rad/s) that each link reaches in the trial step. Without a trial step, the values are 0.
    setting_off: Vec<f64>,
    loads: Vec<Wrench>,
    /// The loads plus the loads that compensate added masses.
    relieved: Vec<Wrench>,
    jumps: Option<Jumps>,
    branch: Option<MotorBranch>,
    /// Moment of the motor on the crank (N m) that acts as a load in this step.
    /// Rapier's motor cannot apply this moment.
    direct: f64,
    /// Added masses of each world; `None` for a world without added masses.
    added: Vec<Option<Added>>,
    braking: Option<Braking>,
}

impl Acting {
    /// # Errors
    /// The errors of [`check_inertias`].
    pub(super) fn new(case: &Case, precision: Precision, worlds: &[Guard]) -> Result<Self> {
        if precision != Precision::Double {
            // In single precision, second differences of positions are only rounding noise and cannot compensate an
            // added mass.
            // A case that needs an added mass is therefore refused.
            check_inertias(case, sentences::RAPIER_IN_SINGLE_PRECISION)?;
        }
        let links = case.mechanism.links().len();
        Ok(Acting {
            state: State::at_rest(case),
            before: vec![f64::NAN; links],
            swept: vec![Vec2::repeat(f64::NAN); case.loads.len()],
            setting_off: vec![0.0; links],
            loads: vec![Wrench::ZERO; links],
            relieved: vec![Wrench::ZERO; links],
            jumps: Jumps::of(case),
            branch: None,
            direct: 0.0,
            added: worlds.iter().map(|guard| Added::of(case, guard.world().tree())).collect(),
            braking: Braking::of(case),
        })
    }

    /// Sets motor and loads of all worlds for the step between the times `ends` (s).
    /// The newest state of the window is the start of the step.
    ///
    /// # Errors
    /// The errors of [`Braking::add`].
    pub(super) fn act(&mut self, case: &Case, window: &Window, worlds: &mut [Guard], ends: [f64; 2]) -> Result<()> {
        for (before, motion) in self.before.iter_mut().zip(&self.state.motions) {
            *before = if window.newest() > 0 { motion.omega } else { f64::NAN };
        }
        let motions = &self.state.motions;
        for (swept, load) in self.swept.iter_mut().zip(&case.loads) {
            let velocity = |at: JointSide| motions[at.link].point_velocity(at.local);
            let known = load.sensed_point().filter(|_| window.newest() > 0);
            *swept = known.map_or(Vec2::repeat(f64::NAN), velocity);
        }
        window.newest_motion(case, &mut self.state);
        if window.newest() == 0 {
            self.begin_exactly(case);
        }
        let State { motions, angles, .. } = &self.state;
        let (before, setting_off) = (&self.before, &self.setting_off);
        // If a link reverses within the step, its load is the mean of the loads before and after the reversal, weighted
        // by their durations.
        let sensed = |_: usize, load: &Load, crank: f64| {
            let Some(link) = load.sensed_link() else { return load.moment_in(case.load_rate(load, motions), crank) };
            let now = motions[link].omega;
            if now == 0.0 {
                return load.moment_in(setting_off[link], crank);
            }
            let next = 2.0 * now - before[link];
            let own = load.moment_in(now, crank);
            if now * next < 0.0 {
                let share = now / (now - next);
                return share * own + (1.0 - share) * load.moment_in(next, crank);
            }
            own
        };
        // If a force opposes the motion of a point and this motion reverses within the step, the force is the mean of
        // the forces before and after the reversal, weighted by their durations.
        let swept = &self.swept;
        let way = |index: usize, now: Vec2| {
            let next = 2.0 * now - swept[index];
            let (own, size) = (sense_of(now), now.norm() + next.norm());
            match now.dot(&next) < 0.0 {
                true => (now.norm() / size) * own + (next.norm() / size) * sense_of(next),
                false => own,
            }
        };
        case.loads_along(motions, angles, ANY_CRANK, sensed, way, &mut self.loads);
        let passed = self
            .jumps
            .as_mut()
            .and_then(|own| own.passed(case.state_in(motions, angles), ends[1] - ends[0], window.newest() == 0));
        if let Some((share, beyond)) = passed {
            case.loads_along(motions, angles, beyond, sensed, way, &mut self.relieved);
            for (own, beyond) in self.loads.iter_mut().zip(&self.relieved) {
                own.force = share * own.force + (1.0 - share) * beyond.force;
                own.moment = share * own.moment + (1.0 - share) * beyond.moment;
            }
        }
        if let Some(braking) = &mut self.braking {
            braking.add(case, window, &self.state, &mut self.loads, ends[0])?;
        }
        let motor = self.motor(case);
        self.loads[GROUND] = Wrench::ZERO;
        for (guard, added) in worlds.iter_mut().zip(&mut self.added) {
            match added {
                Some(added) => {
                    added.follow(window);
                    added.relieve(case, &self.loads, &mut self.relieved);
                    guard.put_loads(&self.relieved);
                }
                None => guard.put_loads(&self.loads),
            }
            guard.drive_freely(ends, motor);
        }
        Ok(())
    }

    /// Gives driving links their exact speeds at t = 0, and zero speed to links at rest.
    /// The tiny step before the motion leaves rounding errors in these speeds.
    /// Without the exact speeds, the sign of a rounding error would choose a direction of motion.
    fn begin_exactly(&mut self, case: &Case) {
        let motions = &mut self.state.motions;
        for drive in &case.drives {
            motions[drive.link].omega = drive.initial_speed();
        }
        let fastest = motions.iter().fold(0.0f64, |most, motion| most.larger(motion.omega.abs()));
        let moving = case.drives.iter().any(|drive| drive.initial_speed() != 0.0);
        for motion in motions {
            if !moving || motion.omega.abs() <= STANDSTILL * fastest {
                motion.omega = 0.0;
            }
            if !moving {
                motion.velocity = Vec2::zeros();
            }
        }
    }

    /// Whether a trial step is needed. There are three cases: a link that is at rest at the start has a load that
    /// depends on its sense of rotation; the crank is at rest at the start and its motor has a reducer with losses; or
    /// a joint with friction is at rest at the start.
    fn must_try(&self, case: &Case) -> bool {
        let losses = case.crank().moving_motor().is_some_and(|motor| motor.efficiency < 1.0);
        let mut sensed = case
            .loads
            .iter()
            .filter_map(Load::sensed_link)
            .filter(|&link| case.can_turn(link))
            .chain(losses.then_some(case.crank().link));
        sensed.any(|link| self.state.motions[link].omega == 0.0)
            || case.frictions().any(|friction| friction.rate(&self.state.motions) == 0.0)
    }

    /// Target speed and damping of Rapier's motor. At the crank's speed, Rapier's motor then has the moment and the
    /// slope of the motor's law. If the moment rises with the speed or does not depend on the speed, the moment is
    /// applied as a load instead.
    fn motor(&mut self, case: &Case) -> [f64; 2] {
        self.direct = 0.0;
        let Some(motor) = case.crank().moving_motor() else { return [0.0; 2] };
        let sense = case.crank().sense();
        let omega = sense * self.state.motions[case.crank().link].omega;
        let holds = |branch: &MotorBranch| omega >= branch.speeds[0] && omega < branch.speeds[1];
        let branch = match self.branch {
            Some(branch) if holds(&branch) => branch,
            _ => {
                // If the crank is at rest, the speed reached in the trial step selects the branch of the motor's law.
                let towards = if omega == 0.0 { sense * self.setting_off[case.crank().link] } else { 0.0 };
                *self.branch.insert(motor.branch(omega, if towards < 0.0 { -1.0 } else { 1.0 }))
            }
        };
        let (mut moment, mut slope) = (branch.moment(omega), branch.slope(omega));
        // The speed may leave the present branch of the motor's law within the step.
        // If the power flow reverses, the losses of a reducer make the motor's moment jump.
        // In both cases, the motor's moment is the mean of the moments before and after the change, weighted by their
        // durations.
        let next = 2.0 * omega - sense * self.before[case.crank().link];
        let [least, most] = branch.speeds;
        if next < least || next >= most {
            let edge = if next < least { least } else { most };
            let share = (omega - edge) / (omega - next);
            let other = motor.branch(next, if next < omega { -1.0 } else { 1.0 });
            let there = other.moment(next) + other.slope(next) * (omega - next);
            moment = share * moment + (1.0 - share) * there;
            slope = share * slope + (1.0 - share) * other.slope(next);
        }
        if slope < 0.0 {
            return [sense * (omega - moment / slope), -slope];
        }
        self.direct = sense * moment;
        self.loads[case.crank().link].moment += self.direct;
        [0.0; 2]
    }

    /// Moment of the motor on the crank (N m) that was applied as a load in the last step.
    /// The impulse of Rapier's motor does not contain this moment.
    pub(super) fn direct(&self) -> f64 {
        self.direct
    }
}

/// Gives worlds at the start pose the start velocities of the driving links.
/// Returns the window of the motion.
/// One step is tried and undone in two cases:
/// - A load or the losses of a reducer depend on the sense of rotation of a link at rest.
/// - A joint with friction is at rest.
///
/// In the trial step, loads that depend on the sense of rotation of a link at rest do not act. The friction of joints
/// at rest does not act either. The power is assumed to flow from the motor.
///
/// # Errors
/// The errors of [`Guard::step`].
pub(super) fn begin(case: &Case, acting: &mut Acting, worlds: &mut [Guard], settings: &Settings) -> Result<Window> {
    let step = settings.resolution;
    settle(case, worlds, step)?;
    let window = Window::beginning(case, settings, &worlds[0]);
    guess(case, acting, &window, worlds, step)?;
    acting.act(case, &window, worlds, [0.0, step])?;
    if acting.must_try(case) {
        worlds[0].step(step)?;
        if let Some(braking) = &mut acting.braking {
            braking.setting_off = set_off(case, &worlds[0], step);
        }
        let world = worlds[0].world();
        for (link, speed) in case.start.0.ids().zip(&mut acting.setting_off).skip(1) {
            *speed = (world.angle(link) - case.start.0[link].angle) / step;
        }
        let fastest = acting.setting_off.iter().fold(0.0f64, |most, speed| most.larger(speed.abs()));
        for speed in acting.setting_off.iter_mut().filter(|speed| speed.abs() <= STANDSTILL * fastest) {
            *speed = 0.0;
        }
        acting.branch = None;
        undo(case, worlds, step)?;
        guess(case, acting, &window, worlds, step)?;
    }
    Ok(window)
}

/// Repeats the first step until its accelerations no longer change.
/// The repetition is needed because the compensating loads and the friction depend on these accelerations.
/// Every trial is undone.
fn guess(case: &Case, acting: &mut Acting, window: &Window, worlds: &mut [Guard], step: f64) -> Result<()> {
    for _ in 0..MOST_TRIALS {
        if acting.added.iter().all(Option::is_none) && acting.braking.is_none() {
            break;
        }
        acting.act(case, window, worlds, [0.0, step])?;
        worlds[0].step(step)?;
        let own = &worlds[0];
        let mut change = 0.0f64;
        for added in acting.added.iter_mut().flatten() {
            change = change.larger(added.guess(case, |link| window.next_acceleration(own, LinkId(link))));
        }
        if let Some(braking) = &mut acting.braking {
            change = change.larger(braking.guess(case, |link| window.next_acceleration(own, LinkId(link))));
        }
        undo(case, worlds, step)?;
        if change <= GUESSED {
            break;
        }
    }
    Ok(())
}

/// Mean rates of the joints with friction in a trial step from the start. Rates as small as rounding errors become 0.
fn set_off(case: &Case, guard: &Guard, step: f64) -> Vec<f64> {
    let mut motions = vec![Motion::REST; case.mechanism.links().len()];
    for (link, body) in case.mechanism.links().entries().skip(1) {
        let (pose, angle) = (case.start.0[link], guard.frames()[link].angle());
        let start = pose.point(body.mass_centre);
        let rates = [start, (guard.centres()[link] - start) / step, Vec2::zeros()];
        motions[link] = Motion::of_point(body.mass_centre, rates, unit(pose.angle), (angle - pose.angle) / step, 0.0);
    }
    let rates: Vec<f64> = case.frictions().map(|friction| friction.rate(&motions)).collect();
    let fastest = rates.iter().fold(0.0f64, |most, rate| most.larger(rate.abs()));
    rates.into_iter().map(|rate| if rate.abs() <= STANDSTILL * fastest { 0.0 } else { rate }).collect()
}

/// Undoes a trial step by several tiny steps.
/// Each tiny step starts from the velocities and impulses of the step before.
/// After several tiny steps, velocities and impulses no longer depend on the trial step.
fn undo(case: &Case, worlds: &mut [Guard], step: f64) -> Result<()> {
    (0..UNDOING).try_for_each(|_| settle(case, worlds, step))
}

/// Places worlds at the start pose and gives the driving links their start velocities.
/// A tiny step with rigid drives then makes all other velocities consistent.
/// The velocities after the tiny step exclude the correction of gaps.
/// The reason is that the correction of even a rounding error in a tiny step would give a large speed.
/// Later velocities include the correction of gaps.
fn settle(case: &Case, worlds: &mut [Guard], step: f64) -> Result<()> {
    let fastest = case.drives.iter().fold(0.0f64, |most, drive| most.larger(drive.initial_speed().abs()));
    for guard in worlds {
        guard.set_step(if fastest > 0.0 { SETTLING_TURN / fastest } else { SETTLING_TURN * step });
        guard.drive(Drive::initial_speed);
        guard.set_stabilised(true);
        guard.place(&case.start.0);
        guard.step(0.0)?;
        guard.place(&case.start.0);
        guard.set_step(step);
        guard.set_stabilised(false);
    }
    Ok(())
}
