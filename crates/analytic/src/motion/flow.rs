//! The pieces of a free motion. In each piece some quantities are constant; the piece ends at a bound.
//! See docs/numerics/forces.md.

use crate::sentences;
use std::cell::{Cell, RefCell};

use differential_equations::ode::ODE;

use super::knots::{self, Knots};
use super::march::Place;
use super::side::{self, Held, Inputs};
use super::step::Flow;
use linkage::case::{ANY_CRANK, Case};
use linkage::drive::load::sense_of;
use linkage::drive::{MotorBranch, Senses};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{KeepNan, Vec2, cross, just_below, root};
use linkage::mechanism::{JointId, JointSide, LinkId};
use linkage::solver::State;
use linkage::work::{Count, WorkTally};

/// Largest accepted rotation of a driving link within a step (rad). The first trial of a step may turn a driving link
/// farther; the trial is then refused.
const FARTHEST: f64 = std::f64::consts::PI;
/// A bound of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Bound {
    /// The load or transmission with this number depends on the sense of a motion, and this motion reverses.
    Sense(usize),
    /// The motor leaves its branch towards higher speeds.
    TooFast,
    /// The motor leaves its branch towards lower speeds.
    TooSlow,
    /// The crank reaches the next lower knot of the loads' tables.
    KnotBehind,
    /// The crank reaches the next higher knot of the loads' tables.
    KnotAhead,
}

/// Kinds of bounds that every piece of the motion has.
/// The numbers of these bounds come after the numbers of the loads' and transmissions' bounds.
const COMMON: [Bound; 4] = [Bound::TooFast, Bound::TooSlow, Bound::KnotBehind, Bound::KnotAhead];
/// A link, point or joint counts as at rest at the end of a piece if its speed is below this fraction of its largest
/// speed so far.
const AT_REST: f64 = 1e-11;
/// A link, point or joint that starts at its dead centre shows its sense of motion after a driving link has turned by
/// this angle (rad).
const NUDGE: f64 = 1e-7;
/// Largest number of iterations that find in which directions points at rest start to move. The directions of several
/// points depend on each other.
const ROUNDS: usize = 60;
/// Number of bisections for the starting acceleration of a point.
const HALVINGS: usize = 60;

/// Angles and speeds of the free driving links at t = 0: first all angles in the world, then all speeds.
pub(super) fn start<const N: usize>(case: &Case) -> [f64; N] {
    let mut y = [0.0; N];
    for (k, (_, drive)) in case.drives.free().enumerate() {
        (y[k], y[N / 2 + k]) = (drive.coordinate(drive.start), drive.initial_speed());
    }
    y
}

/// A load or transmission that depends on a sense of motion: its number in [`Case::senses`], and the link, point or
/// joint with this motion.
type Sensed = (usize, Senses);

/// The link, point or joint of [`Case::senses`]; `Senses::Nothing` for a link or joint that never moves.
fn sensed(case: &Case, senses: Senses) -> Senses {
    match senses {
        Senses::Link(link) if !case.can_turn(link) => Senses::Nothing,
        Senses::Joint(joint) if !case.can_move(joint) => Senses::Nothing,
        senses @ (Senses::Nothing | Senses::Link(_) | Senses::Point(_) | Senses::Joint(_)) => senses,
    }
}

/// A motion in pieces. The equations of motion are of first order in the free driving links' angles and speeds.
pub(super) struct Pieces<'a, const N: usize> {
    case: &'a Case,
    work: RefCell<Work<'a>>,
    /// Loads and transmissions that depend on a sense of motion, each with the link, point or joint that has this
    /// motion.
    sensed: Vec<Sensed>,
    /// For every load and transmission: the largest speed so far of the link, point or joint that determines its sense
    /// (rad/s or m/s).
    fastest: RefCell<Vec<f64>>,
    /// Time at which the present piece began (s).
    entered: Cell<f64>,
    branch: Cell<Option<MotorBranch>>,
    knots: Knots,
    /// Crank angles (rad) that limit the present piece, each a little beyond a knot of the loads' tables.
    smooth: Cell<[f64; 2]>,
    origin: Cell<[f64; N]>,
}

/// Working memory of an evaluation.
struct Work<'a> {
    side: &'a mut dyn side::Side,
    inputs: Inputs,
    held: Held,
    fault: Option<Error>,
    tally: WorkTally,
}

impl Held {
    /// The sense of motion of a link, joint or point, as a unit vector.
    /// For a link or joint, the first component is +1 or -1.
    fn sense(&self, (index, senses): Sensed) -> Vec2 {
        match senses {
            Senses::Nothing => Vec2::zeros(),
            Senses::Link(_) | Senses::Joint(_) => Vec2::new(self.senses[index], 0.0),
            Senses::Point(_) => self.ways[index],
        }
    }
}

impl Work<'_> {
    /// Velocity of a link, joint or point at the present inputs.
    /// For a link, the first component is the angular velocity (rad/s); for a joint, the rate (rad/s or m/s).
    fn rate(&mut self, (_, senses): Sensed) -> Result<Vec2> {
        match senses {
            Senses::Nothing => Ok(Vec2::zeros()),
            Senses::Link(link) => Ok(Vec2::new(self.side.spin(&self.inputs, link)?, 0.0)),
            Senses::Point(at) => self.side.velocity(&self.inputs, at),
            Senses::Joint(joint) => Ok(Vec2::new(self.side.joint_rate(&self.inputs, joint)?, 0.0)),
        }
    }

    /// Time derivative of [`Work::rate`] after the last call of [accelerate](side::Side::accelerate).
    fn second(&mut self, (_, senses): Sensed) -> Vec2 {
        match senses {
            Senses::Nothing => Vec2::zeros(),
            Senses::Link(link) => Vec2::new(self.side.link_rates(link)[1], 0.0),
            Senses::Point(at) => self.side.acceleration(at),
            Senses::Joint(joint) => Vec2::new(self.side.joint_rates(joint)[1], 0.0),
        }
    }

    /// Stores the sense in which a link, joint or point moves at present.
    fn take_sense(&mut self, own: Sensed) -> Result<()> {
        let rate = self.rate(own)?;
        match own.1 {
            Senses::Nothing => {}
            Senses::Link(_) | Senses::Joint(_) => self.held.senses[own.0] = rate.x.signum(),
            Senses::Point(_) => self.held.ways[own.0] = sense_of(rate),
        }
        Ok(())
    }
}

impl<'a, const N: usize> Pieces<'a, N> {
    pub(super) fn new(case: &'a Case, side: &'a mut dyn side::Side) -> Self {
        let drives = case.drives.len();
        let zeros = || vec![0.0; drives];
        let count = case.senses().count();
        let held = Held {
            motor: 0.0,
            added: case.crank().moving_inertia(),
            senses: vec![0.0; count],
            ways: vec![Vec2::zeros(); count],
            piece: ANY_CRANK,
        };
        let sensed = case.senses().map(|senses| sensed(case, senses)).enumerate();
        let inputs = Inputs { angles: zeros(), speeds: zeros(), accelerations: zeros() };
        Pieces {
            case,
            work: RefCell::new(Work { side, inputs, held, fault: None, tally: WorkTally::default() }),
            sensed: sensed.filter(|(_, senses)| *senses != Senses::Nothing).collect(),
            fastest: RefCell::new(vec![0.0; count]),
            entered: Cell::new(0.0),
            branch: Cell::new(None),
            knots: Knots::of(case),
            smooth: Cell::new(ANY_CRANK),
            origin: Cell::new(start(case)),
        }
    }

    /// Sets the inputs to the angles and rates of the driving links for the time `t` and the state `y`.
    fn put(&self, inputs: &mut Inputs, t: f64, y: &[f64; N]) {
        let mut free = 0;
        for (index, drive) in self.case.drives.iter().enumerate() {
            if drive.is_free() {
                (inputs.angles[index], inputs.speeds[index]) = (y[free], y[N / 2 + free]);
                free += 1;
            } else {
                let state = drive.at(t);
                inputs.angles[index] = drive.coordinate(state.value);
                (inputs.speeds[index], inputs.accelerations[index]) = (state.rate, state.acceleration);
            }
        }
    }

    /// Moment of the motor on the crank (N m), counter-clockwise positive.
    fn motor_moment(&self, y: &[f64; N]) -> f64 {
        self.branch.get().map_or(0.0, |branch| self.case.crank().sense() * branch.moment(self.crank_speed(y)))
    }

    /// Computes the accelerations of the driving links; the result is in the inputs of `work`.
    fn accelerate(&self, work: &mut Work, t: f64, y: &[f64; N]) -> Result<()> {
        self.put(&mut work.inputs, t, y);
        work.held.motor = self.motor_moment(y);
        work.side.accelerate(&mut work.inputs, &work.held)
    }

    /// Fills in the whole state at time `t`.
    pub(super) fn fill(&self, t: f64, y: &[f64; N], state: &mut State) -> Result<()> {
        let work = &mut *self.work.borrow_mut();
        self.accelerate(work, t, y)?;
        work.side.fill(&work.inputs, state)
    }

    /// Chooses the senses and the motor's branch for the next piece, at the beginning of the motion or at a bound.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] if a resistance holds a link at rest, and the errors of the side.
    pub(super) fn enter(&self, place: &mut Place<N>, bound: Option<usize>) -> Result<()> {
        let work = &mut *self.work.borrow_mut();
        let stood = match bound.map(|bound| self.bound(bound)) {
            None => return self.begin(work, place),
            Some(Bound::Sense(load)) => self.stopped(work, place, load)?,
            Some(Bound::TooFast) => self.at_branch_end(place, 1, 1.0),
            Some(Bound::TooSlow) => self.at_branch_end(place, 0, -1.0),
            Some(Bound::KnotBehind | Bound::KnotAhead) => Vec::new(),
        };
        self.entered.set(place.x);
        self.go_on(work, place, &stood)
    }

    fn bound(&self, index: usize) -> Bound {
        index.checked_sub(self.fastest.borrow().len()).map_or(Bound::Sense(index), |common| COMMON[common])
    }

    /// Sets the crank's speed exactly to this end of the motor's branch and chooses the branch beyond the end.
    /// Without the exact speed, the same piece would be chosen again.
    /// The result is empty, because no link, point or joint comes to rest at the end of a branch.
    fn at_branch_end(&self, place: &mut Place<N>, end: usize, towards: f64) -> Vec<Sensed> {
        let speeds = self.branch.get().map_or([0.0; 2], |branch| branch.speeds);
        place.y[N / 2] = self.case.crank().sense() * speeds[end];
        self.choose_branch(place, towards);
        Vec::new()
    }

    /// Chooses senses and branch at the beginning of the motion.
    /// A crank at rest starts on the branch on which the motor drives.
    /// If other forces then accelerate the crank backwards, the branch on which power flows to the motor is chosen
    /// instead.
    fn begin(&self, work: &mut Work, place: &Place<N>) -> Result<()> {
        self.choose_branch(place, 1.0);
        let stood = self.begin_senses(work, place)?;
        self.go_on(work, place, &stood)?;
        let forwards = self.branch.get();
        if self.crank_speed(&place.y) == 0.0 && self.crank_acceleration(work) < 0.0 {
            self.choose_branch(place, -1.0);
            if self.branch.get() != forwards {
                self.go_on(work, place, &stood)?;
                if self.crank_acceleration(work) > 0.0 {
                    return Err(self.is_held(place, self.case.crank().link, sentences::THE_LOSSES_OF_THE_REDUCER));
                }
            }
        }
        Ok(())
    }

    /// Computes the accelerations at `place`. The links, points and joints in `stood` are at rest at `place`.
    fn go_on(&self, work: &mut Work, place: &Place<N>, stood: &[Sensed]) -> Result<()> {
        self.origin.set(place.y);
        let ends = self.knots.around(self.crank(place.x, &place.y));
        // At the upper end of a piece, a table may already have the value after a jump.
        work.held.piece = [ends[0], just_below(ends[1])];
        self.smooth.set(knots::beyond(ends));
        if stood.is_empty() { self.accelerate(work, place.x, &place.y) } else { self.set_off(work, place, stood) }
    }

    /// Chooses the motor's branch at the crank's speed.
    /// Where two branches meet, a positive `towards` selects the branch of the higher speeds.
    /// Any other `towards` selects the branch of the lower speeds.
    fn choose_branch(&self, place: &Place<N>, towards: f64) {
        let motor = self.case.crank().moving_motor();
        self.branch.set(motor.map(|motor| motor.branch(self.crank_speed(&place.y), towards)));
    }

    /// Chooses the senses at the beginning. Returns the entries of `sensed` that stand still.
    fn begin_senses(&self, work: &mut Work, place: &Place<N>) -> Result<Vec<Sensed>> {
        self.put(&mut work.inputs, place.x, &place.y);
        let fastest = work.inputs.speeds.iter().fold(0.0f64, |most, speed| most.larger(speed.abs()));
        let mut stood = Vec::new();
        for &own in &self.sensed {
            let slides = |joint: JointId| self.case.mechanism.joints()[joint].slides();
            let is_length = matches!(own.1, Senses::Point(_)) || matches!(own.1, Senses::Joint(joint) if slides(joint));
            let size = if is_length { self.case.mechanism.size() } else { 1.0 };
            if self.look(work, own)? <= AT_REST * fastest * size {
                stood.push(own);
            } else {
                work.take_sense(own)?;
            }
        }
        Ok(stood)
    }

    /// The entries of `sensed` that stand still at the end of a piece.
    /// The result contains the entry of the bound, and every further entry that stops at the same instant as this
    /// entry.
    /// A point that has only changed its direction is not at rest.
    fn stopped(&self, work: &mut Work, place: &Place<N>, bound: usize) -> Result<Vec<Sensed>> {
        self.put(&mut work.inputs, place.x, &place.y);
        let mut stood = Vec::new();
        for &own in &self.sensed {
            let is_bound = own.0 == bound && !matches!(own.1, Senses::Point(_));
            if self.look(work, own)? <= AT_REST * self.fastest.borrow()[own.0] || is_bound {
                stood.push(own);
            } else if matches!(own.1, Senses::Point(_)) {
                work.take_sense(own)?;
            }
        }
        Ok(stood)
    }

    /// Speed of a link, point or joint at the present inputs (rad/s or m/s). Updates the largest speed so far.
    fn look(&self, work: &mut Work, own: Sensed) -> Result<f64> {
        let speed = work.rate(own)?.norm();
        let fastest = &mut self.fastest.borrow_mut()[own.0];
        *fastest = fastest.larger(speed);
        Ok(speed)
    }

    /// Chooses the senses of the links, points and joints at rest, which are in `stood`.
    /// Each link, point or joint starts in the direction of its acceleration without resistances.
    /// If a resistance prevents this start, returns an error.
    fn set_off(&self, work: &mut Work, place: &Place<N>, stood: &[Sensed]) -> Result<()> {
        let before = work.held.clone();
        for &(index, _) in stood {
            work.held.senses[index] = 0.0;
            work.held.ways[index] = Vec2::zeros();
        }
        self.accelerate(work, place.x, &place.y)?;
        let begun: Vec<Vec2> = stood.iter().map(|&own| work.second(own)).collect();
        let ahead = self.ahead(work, place, stood);
        // A link, point or joint at its dead centre is idle: it has no acceleration, and its load does no work at
        // first.
        // The sense of an idle link, point or joint is the sense of its velocity after a short time.
        let idle =
            |second: Vec2, k: usize, (after, rates): &(f64, Vec<Vec2>)| second.norm() * after < 0.5 * rates[k].norm();
        let is_idle = |k: usize| ahead.as_ref().is_some_and(|found| idle(begun[k], k, found));
        let is_idle: Vec<bool> = (0..stood.len()).map(is_idle).collect();
        for (k, &(index, senses)) in stood.iter().enumerate() {
            let way = match &ahead {
                Some((_, rates)) if is_idle[k] => sense_of(rates[k]),
                Some(_) | None => sense_of(begun[k]),
            };
            let way = if way == Vec2::zeros() { before.sense((index, senses)) } else { way };
            match senses {
                Senses::Nothing => {}
                Senses::Link(_) | Senses::Joint(_) => work.held.senses[index] = way.x,
                Senses::Point(_) => work.held.ways[index] = way,
            }
        }
        self.accelerate(work, place.x, &place.y)?;
        if N > 2 {
            let working = stood.iter().zip(&is_idle).filter(|(_, is_idle)| !**is_idle).map(|(own, _)| *own);
            self.settle(work, place, &working.collect::<Vec<_>>())?;
        }
        let is_held = |(k, &own): (usize, &Sensed)| {
            let second = work.second(own);
            let is_idle = is_idle[k] && ahead.as_ref().is_some_and(|found| idle(second, k, found));
            (!is_idle && !(second.dot(&work.held.sense(own)) >= 0.0)).then_some(own)
        };
        match stood.iter().enumerate().find_map(is_held) {
            Some((_, Senses::Link(link) | Senses::Point(JointSide { link, .. }))) => {
                Err(self.is_held(place, link, sentences::ITS_RESISTANCE_HOLDS))
            }
            Some((_, Senses::Joint(joint))) => {
                let link = self.case.mechanism.joints()[joint].second.link;
                Err(self.is_held(place, link, sentences::FRICTION_HOLDS))
            }
            Some((_, Senses::Nothing)) | None => Ok(()),
        }
    }

    /// A short time (s), and the velocities that the links, points and joints now at rest have after this time.
    /// The driving links keep their present accelerations.
    /// `None` if nothing moves, or if the mechanism cannot reach the pose after this time.
    fn ahead(&self, work: &mut Work, place: &Place<N>, stood: &[Sensed]) -> Option<(f64, Vec<Vec2>)> {
        let alphas: Vec<f64> = self.case.drives.free().map(|(index, _)| work.inputs.accelerations[index]).collect();
        let of = |k: usize| {
            let (speed, alpha) = (place.y[N / 2 + k].abs(), alphas[k].abs());
            (NUDGE / speed).smaller_number((2.0 * NUDGE / alpha).sqrt())
        };
        let after = (0..N / 2).map(of).fold(f64::INFINITY, f64::smaller_number);
        if !after.is_finite() {
            return None;
        }
        let mut y = place.y;
        for k in 0..N / 2 {
            y[k] += after * (y[N / 2 + k] + after / 2.0 * alphas[k]);
            y[N / 2 + k] += after * alphas[k];
        }
        self.put(&mut work.inputs, place.x + after, &y);
        let rates: Result<Vec<Vec2>> = stood.iter().map(|&own| work.rate(own)).collect();
        Some((after, rates.ok()?))
    }

    /// Finds the directions in which points at rest start. The force on each point acts against the starting direction
    /// of this point.
    /// With several degrees of freedom, a force changes the direction of its point's acceleration.
    /// The acceleration is linear in the force: a(u) = a0 + B u with the direction u.
    /// The solution satisfies a(u) = s u with s > 0, so that |(s - B)^-1 a0| = 1.
    /// The left side falls as s grows. If the left side is below 1 at s = 0, the force holds the point at rest.
    fn settle(&self, work: &mut Work, place: &Place<N>, stood: &[Sensed]) -> Result<()> {
        for _ in 0..ROUNDS {
            let mut moved = 0.0f64;
            for &(index, senses) in stood {
                let Senses::Point(at) = senses else { continue };
                let before = work.held.ways[index];
                let mut of = |way: Vec2| -> Result<Vec2> {
                    work.held.ways[index] = way;
                    self.accelerate(work, place.x, &place.y)?;
                    Ok(work.side.acceleration(at))
                };
                let free = of(Vec2::zeros())?;
                let [first, second] = [of(Vec2::x())? - free, of(Vec2::y())? - free];
                let solve = |s: f64| {
                    // (s - B) v = a0 by Cramer's rule; -B is positive semidefinite.
                    let (a, b) = (Vec2::x() * s - first, Vec2::y() * s - second);
                    Vec2::new(cross(free, b), cross(a, free)) / cross(a, b)
                };
                let most = free.norm();
                let way = if most > 0.0 {
                    let [_, s] = root::halved([0.0, most], HALVINGS, |s| Ok::<bool, Error>(!(solve(s).norm() <= 1.0)))?;
                    sense_of(solve(s))
                } else {
                    before
                };
                of(way)?;
                moved = moved.larger((way - before).norm());
            }
            if moved <= 8.0 * f64::EPSILON {
                break;
            }
        }
        Ok(())
    }

    fn is_held(&self, place: &Place<N>, link: LinkId, what: &str) -> Error {
        let name = &self.case.mechanism.links()[link].name;
        Error::new(ErrorKind::Numeric, sentences::link_at_rest_at(&what, &name, &place.x))
            .at_time(place.x)
            .of_link(name)
            .help(sentences::GIVE_THE_MOTOR_MORE_TORQUE)
    }

    /// The crank angle (rad, as the scenario states it).
    fn crank(&self, t: f64, y: &[f64; N]) -> f64 {
        let crank = self.case.crank();
        if crank.is_free() { crank.from_coordinate(y[0]) } else { crank.at(t).value }
    }

    /// The crank's speed in the motor's sense. If the motor has a branch, the crank is the first free driving link.
    fn crank_speed(&self, y: &[f64; N]) -> f64 {
        self.case.crank().sense() * y[N / 2]
    }

    /// The crank's acceleration in the motor's sense, from the last evaluation.
    fn crank_acceleration(&self, work: &Work) -> f64 {
        self.case.crank().sense() * work.inputs.accelerations[0]
    }
}

impl<const N: usize> ODE<f64, [f64; N]> for Pieces<'_, N> {
    fn diff(&self, t: f64, y: &[f64; N], rate: &mut [f64; N]) {
        let origin = self.origin.get();
        let near = (0..N / 2).all(|k| (y[k] - origin[k]).abs() <= FARTHEST);
        let work = &mut *self.work.borrow_mut();
        if !near {
            rate.fill(f64::NAN);
            return;
        }
        work.tally.one(Count::Evaluations);
        if let Err(error) = self.accelerate(work, t, y) {
            work.fault.get_or_insert(error);
            rate.fill(f64::NAN);
            return;
        }
        for (k, (index, _)) in self.case.drives.free().enumerate() {
            (rate[k], rate[N / 2 + k]) = (y[N / 2 + k], work.inputs.accelerations[index]);
        }
    }
}

impl<const N: usize> Flow<N> for Pieces<'_, N> {
    fn bounds(&self) -> usize {
        self.fastest.borrow().len() + COMMON.len()
    }

    fn margin(&self, bound: usize, t: f64, y: &[f64; N]) -> f64 {
        let of_branch = |margin: fn([f64; 2], f64) -> f64| {
            self.branch.get().map_or(f64::INFINITY, |branch| margin(branch.speeds, self.crank_speed(y)))
        };
        let load = match self.bound(bound) {
            Bound::Sense(load) => load,
            Bound::TooFast => return of_branch(|[_, most], speed| most - speed),
            Bound::TooSlow => return of_branch(|[least, _], speed| speed - least),
            Bound::KnotBehind => return self.crank(t, y) - self.smooth.get()[0],
            Bound::KnotAhead => return self.smooth.get()[1] - self.crank(t, y),
        };
        let Some(&(_, senses)) = self.sensed.iter().find(|(index, _)| *index == load) else { return f64::INFINITY };
        let work = &mut *self.work.borrow_mut();
        self.put(&mut work.inputs, t, y);
        match work.rate((load, senses)) {
            Ok(rate) => {
                let fastest = &mut self.fastest.borrow_mut()[load];
                *fastest = fastest.larger(rate.norm());
                work.held.sense((load, senses)).dot(&rate)
            }
            Err(error) => {
                work.fault.get_or_insert(error);
                f64::NAN
            }
        }
    }

    fn begin(&self, t: f64, y: &[f64; N]) {
        self.origin.set(*y);
        // At the beginning of a piece, the senses are kept: those at zero speed were chosen from the accelerations.
        if t == self.entered.get() {
            return;
        }
        let work = &mut *self.work.borrow_mut();
        self.put(&mut work.inputs, t, y);
        for &own in self.sensed.iter().filter(|(_, senses)| matches!(senses, Senses::Point(_))) {
            let took = self.look(work, own).and_then(|speed| match speed > AT_REST * self.fastest.borrow()[own.0] {
                true => work.take_sense(own),
                false => Ok(()),
            });
            if let Err(error) = took {
                work.fault.get_or_insert(error);
            }
        }
    }

    fn fault(&self) -> Option<Error> {
        self.work.borrow_mut().fault.take()
    }
}
