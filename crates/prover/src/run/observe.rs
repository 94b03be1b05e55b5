//! Solves one case with one solver, and records quantities during the run.

use std::f64::consts::PI;

use analytic::range::is_singular;
use analytic::witness::{momentum, power};
use linkage::case::{Case, FrictionSeat};
use linkage::drive::{Drive, Load, Senses as LoadSenses};
use linkage::error::Error;
use linkage::math::statistics::share;
use linkage::math::{KeepNan, Vec2, largest_size, unit};
use linkage::mechanism::Pose;
use linkage::solver::{Progress, Sampler, Solver, State};
use linkage::trajectory::{Stage, Trajectory};

/// The quantities that are observed during a run in addition to its trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Watch {
    /// All quantities, for an analytic side.
    Side,
    /// Quantities for an engine's checks: closure and balance of powers.
    Engine,
    /// Only the velocities that determine the directions of loads.
    Senses,
}

/// A trajectory and the quantities observed while it was computed. Quantities that are not observed are empty or zero.
#[derive(Clone, Debug)]
pub(super) struct Observed {
    pub(super) trajectory: Trajectory,
    /// Largest opening of a joint (m) at every instant: the distance between the joint's positions on its two links.
    pub(super) opening: Vec<f64>,
    /// For every instant and load, the velocity that determines the direction of the load.
    /// This velocity is the angular velocity of a link (rad/s, as x) or the velocity of a point (m/s).
    pub(super) senses: Senses,
    /// Largest distance of a joint from the origin (m).
    pub(super) reach: f64,
    /// Balancing moment from the balance of powers (N m) at every instant; empty if no balancing moment is requested.
    /// If the crank's speed changes, the moment is multiplied by the crank's speed and divided by its top speed. In a
    /// motion under forces, the divisor is the crank's nominal speed, or the largest speed that a driving link reaches
    /// in the run, if that speed is larger.
    pub(super) power: Vec<f64>,
    /// Balancing moments of the trajectory, reduced to the crank (N m), at every instant. If the crank's speed changes,
    /// these moments are multiplied by the same ratio of speeds as `power`.
    pub(super) torque: Vec<f64>,
    /// Largest relative difference between the shaking from reactions and the shaking from momentum: the larger of two
    /// ratios over the run. The first ratio is the largest difference of the shaking forces divided by the largest
    /// force of joints, inertia and loads. The second ratio is the largest difference of the shaking moments divided by
    /// the largest moment of these forces about the origin.
    pub(super) unbalance: Option<f64>,
    /// Largest moment on the driving link (N m): the balancing moment, or a joint's force times the link's length.
    pub(super) moment: f64,
    /// Largest summand of the balance of powers, as a moment like those in `power` (N m).
    pub(super) summand: f64,
    /// Largest condition number of a passage of a side through a change point; 1 if no side passes a change point.
    pub(super) passing: f64,
    /// For every row, whether its pose is a singular change point; empty if the crank may not pass change points.
    pub(super) singular: Vec<bool>,
    /// For every row, the time (s) to the nearest end of a piece of a cam's law; empty if there is no transmission.
    pub(super) to_knot: Vec<f64>,
}

/// Several vectors at every instant, in one list: the velocities whose direction loads depend on, and vectors that
/// reverse where the crank passes a jump of a table.
#[derive(Clone, Debug)]
pub(super) struct Senses {
    each: usize,
    values: Vec<Vec2>,
    /// For each vector at each instant, whether the vector's load would jump if the vector reversed.
    jumps: Vec<bool>,
}

impl Senses {
    fn new(each: usize, rows: usize) -> Self {
        Senses { each, values: vec![Vec2::zeros(); each * rows], jumps: vec![false; each * rows] }
    }

    /// The vectors of one row of the grid.
    pub(super) fn of(&self, row: usize) -> &[Vec2] {
        &self.values[row * self.each..][..self.each]
    }

    /// For each vector of [`Senses::of`], whether the vector's load would jump if the vector reversed at this row.
    pub(super) fn jumps(&self, row: usize) -> &[bool] {
        &self.jumps[row * self.each..][..self.each]
    }
}

impl Observed {
    /// Largest opening of a joint at any instant (m).
    pub(super) fn closure(&self) -> f64 {
        largest_size(&self.opening)
    }

    /// Largest difference between the balancing moment of the trajectory and the balancing moment from the balance of
    /// powers, divided by the largest moment on the driving link, or by the largest summand of the balance of powers if
    /// this is larger.
    /// The balancing moment itself is no divisor: where it is zero, the moments on the driving link cancel each other,
    /// and the difference is their rounding error.
    pub(super) fn two_ways(&self) -> f64 {
        share(largest_size(&self.moment_gap().collect::<Vec<f64>>()), self.moment.larger(self.summand))
    }

    /// Balancing moment of the trajectory minus the balancing moment of the powers (N m) at every instant.
    pub(super) fn moment_gap(&self) -> impl Iterator<Item = f64> {
        self.torque.iter().zip(&self.power).map(|(torque, power)| torque - power)
    }
}

/// A run that failed, and its results up to the failure.
pub(super) struct Stopped {
    pub(super) error: Error,
    pub(super) kept: Option<Box<Trajectory>>,
    /// `None` if enough work was allowed. If the allowed work was too little even for the first runs, the work that the
    /// first runs need. If it was too little after the first runs, the allowed work.
    pub(super) spent: Option<f64>,
}

impl From<Error> for Stopped {
    fn from(error: Error) -> Self {
        Stopped { error, kept: None, spent: None }
    }
}

impl From<Stopped> for Error {
    fn from(stopped: Stopped) -> Self {
        stopped.error
    }
}

/// Solves `case` with `solver` and records the requested quantities.
pub(super) fn observe(
    case: &Case,
    solver: &dyn Solver,
    watch: Watch,
    progress: Progress,
) -> std::result::Result<Observed, Stopped> {
    let mut sampler = Sampler::new(case);
    let with_power = watch != Watch::Senses && case.wanted.has(Stage::BalancingMoment);
    let mut power = if with_power { vec![0.0; case.grid.len()] } else { Vec::new() };
    let mut torque = power.clone();
    let (arm, size, steady) = (case.drive_arm(), case.mechanism.size(), case.is_steady());
    let mut opening = if watch == Watch::Senses { Vec::new() } else { vec![0.0; case.grid.len()] };
    let with_sense = case.senses().filter(|senses| *senses != LoadSenses::Nothing);
    let tables: Vec<[f64; 2]> = case.load_jumps().collect();
    let mut senses = Senses::new(with_sense.count() + tables.len(), case.grid.len());
    let (mut reach, mut moment, mut fastest, mut summand): (f64, f64, f64, f64) = (0.0, 0.0, 0.0, 0.0);
    let mut unbalance = Unbalance::default();
    let mut passing: f64 = 1.0;
    let mut singular = if case.crank().passes() { vec![false; case.grid.len()] } else { Vec::new() };
    let transmissions = case.mechanism.transmissions();
    let mut to_knot = vec![f64::INFINITY; if transmissions.is_empty() { 0 } else { case.grid.len() }];
    let mut visit = |row: usize, state: &State| {
        if let Some(nearest) = to_knot.get_mut(row) {
            let times = transmissions.iter().map(|own| own.time_to_knot(case.mechanism.joints(), &state.motions));
            *nearest = times.fold(f64::INFINITY, f64::smaller);
        }
        let crank = case.input_in(&state.motions, &state.angles);
        let jump = |index: usize| case.loads.get(index).is_none_or(|load| load.jump(crank) > 0.0);
        let sensed = case.senses().enumerate().filter_map(|(k, own)| Some((sensed_in(case, state, own)?, jump(k))));
        let beside = tables.iter().map(|&jump| (beside(crank, jump), true));
        let own = senses.values.iter_mut().zip(&mut senses.jumps).skip(row * senses.each);
        own.zip(sensed.chain(beside)).for_each(|((value, jumps), now)| (*value, *jumps) = now);
        if let Some(opening) = opening.get_mut(row) {
            let [own, far] = state.opening(case, size);
            (*opening, reach) = (own, reach.larger(far));
        }
        if with_power {
            // At a crank at rest, no moment follows from a power. If the crank's speed changes, powers are therefore
            // compared instead of moments. After the run, the powers are divided by the top speed.
            (power[row], torque[row]) = match steady {
                true => (power::balancing_moment(case, state), reduced_torque(case, state)),
                false => (-power::of_known_forces(case, state), state.drive_power(case)),
            };
            fastest = case
                .drives
                .iter()
                .map(|drive| case.drive_state(drive, &state.motions, &state.angles).rate.abs())
                .fold(fastest, f64::larger);
            moment = moment.larger(state.largest_moment(case, arm));
            summand = summand.larger(power::largest(case, state));
            if watch == Watch::Side {
                unbalance.add(case, state, crank);
            }
        }
        passing = passing.larger(state.passing.unwrap_or(1.0));
        if let Some(singular) = singular.get_mut(row).filter(|_| state.passing.is_some()) {
            let pose = pose_of(state);
            let groups = &case.structure.groups;
            *singular = groups.iter().any(|group| is_singular(&case.mechanism, group, &pose));
        }
        sampler.put(case, row, state);
        Ok(())
    };
    if let Err(error) = solver.sweep(case, &mut visit, progress) {
        let kept = sampler.so_far(case).map(Box::new);
        return Err(Stopped { error, kept, spent: None });
    }
    // In a free motion, powers are divided by the larger of two speeds: the largest speed, because the motion may be
    // much faster than the nominal speed, and the nominal speed, because the speeds of an engine's links at rest are
    // only rounding errors.
    let nominal = case.crank().top_speed();
    let top = if case.is_free() { fastest.larger(nominal.abs()) } else { nominal };
    if !steady {
        power.iter_mut().chain(&mut torque).for_each(|power| *power = share(*power, top));
    }
    Ok(Observed {
        trajectory: sampler.finish(case)?,
        opening,
        senses,
        reach,
        power,
        torque,
        unbalance: (with_power && watch == Watch::Side).then(|| unbalance.share()),
        moment,
        summand: share(summand, top.abs()),
        passing,
        singular,
        to_knot,
    })
}

/// The velocity on whose direction a load depends: an angular velocity (rad/s, as the first component) or a velocity
/// (m/s); zero at standstill.
fn sensed_in(case: &Case, state: &State, senses: LoadSenses) -> Option<Vec2> {
    match senses {
        LoadSenses::Nothing => None,
        LoadSenses::Link(link) => Some(Vec2::new(case.spin(&state.motions, link), 0.0)),
        LoadSenses::Joint(joint) => Some(Vec2::new(case.joint_rate(&state.motions, joint), 0.0)),
        LoadSenses::Point(at) => Some(match case.moves(&state.motions, at) {
            true => state.motions[at.link].point_velocity(at.local),
            false => Vec2::zeros(),
        }),
    }
}

/// Positions and directions of all links.
pub(super) fn pose_of(state: &State) -> Pose {
    Pose::of(&state.motions)
}

/// Balancing moments of all drives (N m), reduced to the crank by their powers.
fn reduced_torque(case: &Case, state: &State) -> f64 {
    let rate = |drive: &Drive| case.drive_state(drive, &state.motions, &state.angles).rate;
    let further = case.drives.further().iter().zip(&state.torques[1..]);
    let further = further.map(|(drive, effort)| effort * (rate(drive) / rate(case.crank())));
    state.torques[0] + further.sum::<f64>()
}

/// A vector that reverses when the crank passes a jump of a table, and only then. The length of the vector is the
/// distance of the crank from the nearest jump (rad).
fn beside(crank: f64, [jump, period]: [f64; 2]) -> Vec2 {
    let share = ((crank - jump) / period).rem_euclid(1.0);
    unit(PI * share) * (period * share.smaller(1.0 - share))
}

/// Largest part of the shaking force (N) and of the shaking moment about the origin (N m) that the state does not
/// determine. A load on a link or point at rest already opposes the motion that begins, but in the state all velocities
/// are still zero.
fn open(case: &Case, state: &State, crank: f64) -> [f64; 2] {
    let mut open = [0.0; 2];
    let of_state =
        |load: &&Load| load.joint().is_none() && sensed_in(case, state, load.nature().senses) == Some(Vec2::zeros());
    for load in case.loads.iter().filter(of_state) {
        let (jump, point) = (load.jump(crank), load.sensed_point());
        let lever = point.map(|at| state.motions[at.link].point(at.local).norm());
        open[0] += if point.is_some() { jump } else { 0.0 };
        open[1] += jump * lever.unwrap_or(1.0);
    }
    for friction in case.frictions().filter(|own| own.rate(&state.motions) == 0.0) {
        let largest = 2.0 * friction.largest(friction.reaction(state.reactions()));
        if let FrictionSeat::Mesh { losses, .. } = friction.seat {
            open[1] += largest * losses.lever.abs();
            continue;
        }
        let (joint, size) = (&case.mechanism.joints()[friction.joint], largest * friction.lever());
        let place = state.motions[joint.second.link].point(joint.second.local).norm();
        open[0] += if joint.slides() { size } else { 0.0 };
        open[1] += size * if joint.slides() { place } else { 1.0 };
    }
    open
}

/// Equilibrium of the whole mechanism, recorded during a run.
#[derive(Default)]
struct Unbalance {
    force: f64,
    moment: f64,
    largest_force: f64,
    largest_moment: f64,
}

impl Unbalance {
    fn add(&mut self, case: &Case, state: &State, crank: f64) {
        let ((force, moment), (other_force, other_moment)) = (state.shaking(case), momentum::shaking(case, state));
        let [open_force, open_moment] = open(case, state, crank);
        self.force = self.force.larger(((force - other_force).norm() - open_force).larger(0.0));
        self.moment = self.moment.larger(((moment - other_moment).abs() - open_moment).larger(0.0));
        for (index, joint) in case.mechanism.joints().entries() {
            let place = state.motions[joint.second.link].point(joint.second.local);
            let own = state.forces[index].norm();
            self.largest_force = self.largest_force.larger(own);
            // For a joint at the origin, the mechanism's size serves as the lever arm of its force.
            let lever = place.norm().larger(case.mechanism.size());
            self.largest_moment = self.largest_moment.larger(own * lever).larger(state.moments[index].abs());
        }
        // The reactions may be zero, such as those of a balanced rotor on a spring.
        let (largest_force, largest_moment) = momentum::largest(case, state);
        self.largest_force = self.largest_force.larger(largest_force);
        self.largest_moment = self.largest_moment.larger(largest_moment);
    }

    fn share(&self) -> f64 {
        share(self.force, self.largest_force).larger(share(self.moment, self.largest_moment))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Differences of forces are divided by the largest force, differences of moments by the largest moment. The result
    /// is the larger ratio.
    #[test]
    fn unbalance_is_the_larger_share_of_force_and_moment() {
        for (force, moment, wanted) in
            [(0.0, 0.0, 0.0), (4.0, 0.0, 2.0), (0.0, 4.0, 0.5), (4.0, 4.0, 2.0), (4.0, 32.0, 4.0)]
        {
            let found = Unbalance { force, moment, largest_force: 2.0, largest_moment: 8.0 }.share();
            assert_eq!(found, wanted, "{force} N, {moment} N m");
        }
    }
}
