//! The equation of motion on one piece, in two independent forms.
//!
//! The first form is a function of time, for run-ups, which begin at rest: phi' = omega, omega' = (M - omega^2 / 2
//! dI*/dphi) / I*.
//! The second form is a function of the crank angle, for steady regimes, in which the interval and the positions of the
//! kinks are known.
//! With E = I* omega^2 / 2, the second form is dE/dphi = M and dt/dphi = 1 / omega.
//! The second form does not contain dI*/dphi, so that each form checks the other.

use std::cell::{Cell, RefCell};

use differential_equations::ode::ODE;

use super::model::{Piece, Reduced, ReducedModel};
use crate::PoseSolver;
use crate::motion::step::Flow;
use linkage::drive::MotorBranch;
use linkage::error::{Error, Result};
use linkage::work::{Count, WorkTally};

/// Largest accepted distance (rad) from the beginning of a step to an evaluation in this step.
/// The first trial of a step may exceed this distance; the trial is then refused.
const FARTHEST: f64 = std::f64::consts::TAU;

/// The evaluation of the forces, which both forms of the equation of motion share.
pub(crate) struct Forces<'m, 'a> {
    pub(crate) model: &'m ReducedModel<'a>,
    poses: RefCell<PoseSolver<'a>>,
    fault: RefCell<Option<Error>>,
    /// Crank angle at which the present step began.
    origin: Cell<f64>,
    pub(crate) piece: Cell<Piece>,
    /// Direction of the crank's motion: +1 or -1.
    pub(crate) way: Cell<f64>,
    pub(crate) branch: Cell<Option<MotorBranch>>,
    tally: RefCell<WorkTally>,
}

impl<'m, 'a> Forces<'m, 'a> {
    pub(crate) fn of(model: &'m ReducedModel<'a>, piece: Piece, way: f64) -> Result<Self> {
        Ok(Forces {
            model,
            poses: RefCell::new(model.guided(PoseSolver::new(model.case)?)),
            fault: RefCell::new(None),
            origin: Cell::new(model.case.crank().start),
            piece: Cell::new(piece),
            way: Cell::new(way),
            branch: Cell::new(model.branch(0.0, way)),
            tally: RefCell::default(),
        })
    }

    /// Counts an evaluation.
    fn count(&self) {
        self.tally.borrow_mut().one(Count::Evaluations);
    }

    /// Begins a step at this crank angle, which may be at any distance from the previous step.
    pub(crate) fn begin_at(&self, crank: f64) {
        self.origin.set(crank);
    }

    /// Reduced quantities on the present piece, including the inertia that turns with the crank.
    /// All quantities are NaN if the crank angle is too far from the beginning of the step; the step is then repeated.
    /// After an error, all quantities are NaN too, and the error is stored.
    pub(crate) fn reduced(&self, crank: f64) -> Reduced {
        if !((crank - self.origin.get()).abs() <= FARTHEST) {
            return Reduced { inertia: f64::NAN, slope: f64::NAN, applied: f64::NAN };
        }
        let piece = self.piece.get();
        match self.model.on_piece(&mut self.poses.borrow_mut(), crank, self.way.get(), piece) {
            Ok(found) => Reduced { inertia: found.inertia + self.model.added, ..found },
            Err(error) => {
                self.fault.borrow_mut().get_or_insert(error);
                Reduced { inertia: f64::NAN, slope: f64::NAN, applied: f64::NAN }
            }
        }
    }

    /// Moment of the motor on the crank (N m), counter-clockwise positive.
    pub(crate) fn motor_moment(&self, omega: f64) -> f64 {
        let sense = self.model.sense;
        self.branch.get().map_or(0.0, |branch| sense * branch.moment(sense * omega))
    }

    /// Derivative of the motor's moment with respect to the crank's speed (N m s).
    fn motor_slope(&self, omega: f64) -> f64 {
        self.branch.get().map_or(0.0, |branch| branch.slope(self.model.sense * omega))
    }

    pub(crate) fn acceleration(&self, crank: f64, omega: f64) -> f64 {
        let reduced = self.reduced(crank);
        (reduced.applied + self.motor_moment(omega) - omega * omega / 2.0 * reduced.slope) / reduced.inertia
    }

    pub(super) fn take_fault(&self) -> Option<Error> {
        self.fault.borrow_mut().take()
    }

    /// Distances of the motor's speed from the two bounds of its branch, positive inside the branch.
    fn branch_margins(&self, omega: f64) -> [f64; 2] {
        let speed = self.model.sense * omega;
        self.branch.get().map_or([f64::INFINITY; 2], |branch| [branch.speeds[1] - speed, speed - branch.speeds[0]])
    }
}

/// Crank angle and speed as functions of time.
pub(crate) struct InTime<'m, 'a>(pub(crate) Forces<'m, 'a>);

impl InTime<'_, '_> {
    pub(crate) const UPPER: usize = 0;
    pub(crate) const LOWER: usize = 1;
    pub(crate) const STANDSTILL: usize = 2;
    pub(crate) const FAST: usize = 3;
}

impl ODE<f64, [f64; 2]> for InTime<'_, '_> {
    fn diff(&self, _: f64, &[crank, omega]: &[f64; 2], rate: &mut [f64; 2]) {
        self.0.count();
        *rate = [omega, self.0.acceleration(crank, omega)];
    }
}

impl Flow<2> for InTime<'_, '_> {
    fn bounds(&self) -> usize {
        5
    }

    fn margin(&self, bound: usize, _: f64, &[crank, omega]: &[f64; 2]) -> f64 {
        let [from, to] = self.0.piece.get().ends;
        match bound {
            Self::UPPER => to - crank,
            Self::LOWER => crank - from,
            Self::STANDSTILL => self.0.way.get() * omega,
            _ => self.0.branch_margins(omega)[bound - Self::FAST],
        }
    }

    fn begin(&self, _: f64, &[crank, _]: &[f64; 2]) {
        self.0.begin_at(crank);
    }

    fn fault(&self) -> Option<Error> {
        self.0.take_fault()
    }
}

/// Kinetic energy, time, and the derivative of the energy with respect to its initial value.
/// All three quantities are functions of the crank angle, which is counted in the sense of motion.
pub(crate) struct OverAngle<'m, 'a>(pub(crate) Forces<'m, 'a>);

impl OverAngle<'_, '_> {
    /// Speed of the crank (rad/s) at the position `x`, for the energy `energy` (J).
    pub(crate) fn speed(&self, x: f64, energy: f64) -> f64 {
        let way = self.0.way.get();
        way * (2.0 * energy / self.0.reduced(way * x).inertia).sqrt()
    }
}

impl ODE<f64, [f64; 3]> for OverAngle<'_, '_> {
    fn diff(&self, x: f64, &[energy, _, share]: &[f64; 3], rate: &mut [f64; 3]) {
        let way = self.0.way.get();
        self.0.count();
        let reduced = self.0.reduced(way * x);
        let omega = way * (2.0 * energy / reduced.inertia).sqrt();
        let moment = reduced.applied + self.0.motor_moment(omega);
        *rate = [way * moment, 1.0 / omega.abs(), way * self.0.motor_slope(omega) * omega / (2.0 * energy) * share];
    }
}

impl Flow<3> for OverAngle<'_, '_> {
    fn bounds(&self) -> usize {
        2
    }

    fn margin(&self, bound: usize, x: f64, y: &[f64; 3]) -> f64 {
        self.0.branch_margins(self.speed(x, y[0]))[bound]
    }

    fn begin(&self, x: f64, _: &[f64; 3]) {
        self.0.begin_at(self.0.way.get() * x);
    }

    fn fault(&self) -> Option<Error> {
        self.0.take_fault()
    }
}
