//! The pieces of a free motion: what each keeps constant, and where it ends.

use std::cell::{Cell, RefCell};

use differential_equations::ode::ODE;

use super::march::{Flow, Place};
use super::side::{Held, Inputs, Side};
use linkage::case::Case;
use linkage::drive::Branch;
use linkage::error::{Error, ErrorKind, Result};
use linkage::solver::State;

/// Largest turn of a driving link within a step (rad). The first trial of a step may lead anywhere; such a trial must
/// be refused.
const FARTHEST: f64 = std::f64::consts::PI;
/// Bounds of the motor's piece, which come after those of the loads: too fast, too slow.
const OF_MOTOR: usize = 2;
/// The first of these bounds.
const TOO_FAST: usize = 0;

/// Angles and speeds of the free driving links at t = 0: first all angles in the world, then all speeds.
pub(super) fn start<const N: usize>(case: &Case) -> [f64; N] {
    let mut y = [0.0; N];
    for (k, (_, drive)) in case.drives.free().enumerate() {
        (y[k], y[N / 2 + k]) = (drive.world_angle(drive.start), drive.initial_speed());
    }
    y
}

/// A motion in pieces: first-order equations of the free driving links' angles and speeds.
pub(super) struct Pieces<'a, const N: usize> {
    case: &'a Case,
    work: RefCell<Work<'a>>,
    /// Loads that depend on the sense of a link's rotation, with that link.
    sensed: Vec<(usize, usize)>,
    branch: Cell<Option<Branch>>,
    origin: Cell<[f64; N]>,
}

/// Working memory of an evaluation.
struct Work<'a> {
    side: &'a mut dyn Side,
    inputs: Inputs,
    held: Held,
    fault: Option<Error>,
}

impl<'a, const N: usize> Pieces<'a, N> {
    pub(super) fn new(case: &'a Case, side: &'a mut dyn Side) -> Self {
        let drives = case.drives.len();
        let zeros = || vec![0.0; drives];
        let held = Held { motor: 0.0, added: case.crank().moving_inertia(), senses: vec![0.0; case.loads.len()] };
        let sensed = case.loads.iter().enumerate().filter_map(|(index, load)| Some((index, load.sensed_link()?)));
        let sensed = sensed.filter(|&(_, link)| case.can_turn(link));
        let inputs = Inputs { angles: zeros(), speeds: zeros(), accelerations: zeros() };
        Pieces {
            case,
            work: RefCell::new(Work { side, inputs, held, fault: None }),
            sensed: sensed.collect(),
            branch: Cell::new(None),
            origin: Cell::new(start(case)),
        }
    }

    /// The driving links at time `t` in the state `y`.
    fn put(&self, inputs: &mut Inputs, t: f64, y: &[f64; N]) {
        let mut free = 0;
        for (index, drive) in self.case.drives.iter().enumerate() {
            if drive.is_free() {
                (inputs.angles[index], inputs.speeds[index]) = (y[free], y[N / 2 + free]);
                free += 1;
            } else {
                let state = drive.at(t);
                inputs.angles[index] = drive.world_angle(state.angle);
                (inputs.speeds[index], inputs.accelerations[index]) = (state.omega, state.alpha);
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

    /// The whole state.
    pub(super) fn fill(&self, t: f64, y: &[f64; N], state: &mut State) -> Result<()> {
        let work = &mut *self.work.borrow_mut();
        self.accelerate(work, t, y)?;
        work.side.fill(&work.inputs, state)
    }

    /// Chooses the senses and the motor's branch for the next piece: at the beginning of the motion, or after it has
    /// reached a bound.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] where a resistance holds a link at rest, and those of the side.
    pub(super) fn enter(&self, place: &mut Place<N>, bound: Option<usize>) -> Result<()> {
        let work = &mut *self.work.borrow_mut();
        let stood = match bound.map(|bound| (bound, bound.checked_sub(self.case.loads.len()))) {
            None => return self.begin(work, place),
            Some((_, Some(end))) => {
                // Exactly on the bound; otherwise the same piece would be chosen again.
                let speeds = self.branch.get().map_or([0.0; 2], |branch| branch.speeds);
                place.y[N / 2] = self.case.crank().sense() * speeds[1 - end];
                self.choose_branch(place, if end == TOO_FAST { 1.0 } else { -1.0 });
                Vec::new()
            }
            Some((bound, None)) => self.sensed.iter().copied().filter(|&(index, _)| index == bound).collect(),
        };
        self.go_on(work, place, &stood)
    }

    /// Chooses senses and branch at the beginning of the motion.
    /// From rest the motor drives the crank, unless the other forces then turn it back: power flows to the motor.
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
                    return Err(self.is_held(place, self.case.crank().link, "the losses of the reducer hold"));
                }
            }
        }
        Ok(())
    }

    /// Accelerations at a place where loads in `stood` have links at rest.
    fn go_on(&self, work: &mut Work, place: &Place<N>, stood: &[(usize, usize)]) -> Result<()> {
        self.origin.set(place.y);
        match stood.is_empty() {
            true => self.accelerate(work, place.x, &place.y),
            false => self.set_off(work, place, stood),
        }
    }

    /// Chooses the motor's branch at the crank's speed.
    /// Where two meet: the one towards higher speeds for a positive `towards`, otherwise the one towards lower speeds.
    fn choose_branch(&self, place: &Place<N>, towards: f64) {
        let motor = self.case.crank().moving_motor();
        self.branch.set(motor.map(|motor| motor.branch(self.crank_speed(&place.y), towards)));
    }

    /// Senses at the beginning. Returns the entries of `sensed` whose links stand still.
    fn begin_senses(&self, work: &mut Work, place: &Place<N>) -> Result<Vec<(usize, usize)>> {
        self.put(&mut work.inputs, place.x, &place.y);
        let mut stood = Vec::new();
        for &(index, link) in &self.sensed {
            let spin = work.side.spin(&work.inputs, link)?;
            if spin == 0.0 {
                stood.push((index, link));
            } else {
                work.held.senses[index] = spin.signum();
            }
        }
        Ok(stood)
    }

    /// Chooses the sense of links at rest, with their loads in `stood`.
    /// Each starts in the direction in which it is accelerated without its resistances, if the resistances allow it.
    fn set_off(&self, work: &mut Work, place: &Place<N>, stood: &[(usize, usize)]) -> Result<()> {
        let before = work.held.senses.clone();
        for &(index, _) in stood {
            work.held.senses[index] = 0.0;
        }
        self.accelerate(work, place.x, &place.y)?;
        for &(index, link) in stood {
            let [_, alpha] = work.side.link_rates(link);
            work.held.senses[index] = if alpha == 0.0 { before[index] } else { alpha.signum() };
        }
        self.accelerate(work, place.x, &place.y)?;
        let goes = |index: usize, link: usize| work.side.link_rates(link)[1] * work.held.senses[index] >= 0.0;
        match stood.iter().find(|&&(index, link)| !goes(index, link)) {
            Some(&(_, link)) => Err(self.is_held(place, link, "its resistance holds")),
            None => Ok(()),
        }
    }

    fn is_held(&self, place: &Place<N>, link: usize, what: &str) -> Error {
        let name = &self.case.mechanism.links()[link].name;
        let message = format!("{what} link \"{name}\" at rest at t = {:.6} s", place.x);
        Error::new(ErrorKind::Numeric, message)
            .at_time(place.x)
            .of_link(name)
            .help("give the motor more torque or the mechanism more speed, or let the grid end before")
    }

    /// The crank's speed in the motor's sense. Wherever there is a branch, the crank is the first free driving link.
    fn crank_speed(&self, y: &[f64; N]) -> f64 {
        self.case.crank().sense() * y[N / 2]
    }

    /// The crank's acceleration in the motor's sense, from the last evaluation.
    fn crank_acceleration(&self, work: &Work) -> f64 {
        self.case.crank().sense() * work.inputs.accelerations[0]
    }

    /// Distance of the motor's speed from the bounds of its branch, positive inside.
    fn branch_margin(&self, bound: usize, y: &[f64; N]) -> f64 {
        let speed = self.crank_speed(y);
        self.branch.get().map_or(f64::INFINITY, |branch| match bound {
            TOO_FAST => branch.speeds[1] - speed,
            _ => speed - branch.speeds[0],
        })
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
        self.case.loads.len() + OF_MOTOR
    }

    fn margin(&self, bound: usize, t: f64, y: &[f64; N]) -> f64 {
        let Some(load) = self.case.loads.get(bound) else {
            return self.branch_margin(bound - self.case.loads.len(), y);
        };
        let Some(link) = load.sensed_link().filter(|&link| self.case.can_turn(link)) else { return f64::INFINITY };
        let work = &mut *self.work.borrow_mut();
        self.put(&mut work.inputs, t, y);
        match work.side.spin(&work.inputs, link) {
            Ok(spin) => work.held.senses[bound] * spin,
            Err(error) => {
                work.fault.get_or_insert(error);
                f64::NAN
            }
        }
    }

    fn begin(&self, _: f64, y: &[f64; N]) {
        self.origin.set(*y);
    }

    fn fault(&self) -> Option<Error> {
        self.work.borrow_mut().fault.take()
    }
}
