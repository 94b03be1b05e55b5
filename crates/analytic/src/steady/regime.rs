//! Steady periodic motion: the crank has the same speed after every period.

use crate::sentences;
use linkage::math::{KeepNan, root};
use std::f64::consts::TAU;

use crate::AssurSolver;
use crate::motion::march::{MOST_EMPTY, Place, Stop, march};
use crate::motion::step::{Step, one_step};
use crate::reduced::flow::{Forces, OverAngle};
use crate::reduced::means::{self, no_turn};
use crate::reduced::model::{Piece, ReducedModel};
use linkage::error::{Error, ErrorKind, Result};

/// Largest number of Newton steps of the shooting method. The method usually needs three to six steps.
const MOST_SHOTS: usize = 60;
/// If the relative change of the energy over a period is at most this value, the change counts as zero.
const CLOSED: f64 = 2e-14;

/// Speed of the crank at a crank angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedAtCrank {
    /// Crank angle (rad, in the scenario's convention).
    pub crank: f64,
    /// Angular velocity of the crank (rad/s).
    pub omega: f64,
    /// Angular acceleration of the crank (rad/s^2).
    pub alpha: f64,
}

/// A steady periodic motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Regime {
    /// Time of one period (s).
    pub period: f64,
    /// Turns of the crank in a period. There are several turns for some higher groups and for load tables that cover
    /// several turns, otherwise one.
    pub turns: f64,
    /// Mean angular velocity over time (rad/s): the angle of all turns, divided by the duration of the period.
    pub mean_speed: f64,
    /// Angular velocity of the crank at the start of the case (rad/s).
    pub start_speed: f64,
    /// The largest speed of the crank and its crank angle.
    pub fastest: SpeedAtCrank,
    /// The smallest speed of the crank and its crank angle.
    pub slowest: SpeedAtCrank,
    /// Factor by which a period multiplies a small deviation from the energy of the steady motion.
    /// The factor is below 1 for a stable motion.
    pub multiplier: f64,
    /// Speeds of the crank at the requested crank angles.
    pub samples: Vec<SpeedAtCrank>,
    /// Energy of the reduced motion at the start of the period (J).
    energy: f64,
}

impl Regime {
    /// Coefficient of non-uniformity of the absolute speeds: (fastest - slowest) / (mean over time).
    #[must_use]
    pub fn non_uniformity(&self) -> f64 {
        let [slowest, fastest] = self.ends();
        (fastest - slowest) / self.mean_speed.abs()
    }

    /// Smallest and largest speed in the motor's sense (rad/s).
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        [self.slowest.omega.abs(), self.fastest.omega.abs()]
    }
}

impl ReducedModel<'_> {
    /// The steady periodic motion in the motor's sense.
    /// Newton's method finds the energy at the start of a period.
    /// The derivative that Newton's method needs is integrated along with the motion.
    /// `cranks` are the crank angles (rad) at which the crank's speed is requested.
    /// These angles lie in one period from the start of the case, in the order of the motion.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] without a motor, [`ErrorKind::Geometry`] if the crank does not turn fully,
    /// [`ErrorKind::Numeric`] if the motor has no stable speed, or stalls within a period.
    pub fn regime(&self, cranks: &[f64], accuracy: f64) -> Result<Regime> {
        let Some(motor) = &self.motor else {
            let message = sentences::A_STEADY_MOTION_IS_ASKED;
            return Err(Error::new(ErrorKind::Input, message).help(sentences::ADD_A_MOTOR_SECTION_ITS_LAW));
        };
        let Some(period) = self.kinks().period else { return Err(no_turn(self.kinks())) };
        let turn = Turn::of(self, period)?;
        let means = means::means_over_turn(self.case, &AssurSolver)?;
        let resistance = self.sense * means.resistance;
        let guess = motor.steady_speed(resistance).filter(|&speed| speed > 0.0);
        let Some(speed) = guess else { return Err(means::no_steady_speed(resistance)) };
        // The first energy of the search is computed from the mean inertia, not from the inertia at the start. The
        // energy varies less over a period than the speed, because the crank is fast where the reduced inertia is
        // small.
        let mut energy = (means.inertia + self.added) * speed * speed / 2.0;
        let mut share = 0.0;
        for _ in 0..MOST_SHOTS {
            let [after, _, multiplier] = turn.run(energy, &[], accuracy, &mut |_, _| Ok(()))?;
            let change = after - energy;
            share = multiplier;
            if change.abs() <= CLOSED * energy {
                return turn.described(after, share, cranks, accuracy);
            }
            let next = energy + change / (1.0 - multiplier);
            energy = if next > 0.0 && next.is_finite() { next } else { after };
        }
        let message = sentences::no_steady_motion_was_found(&MOST_SHOTS, &share);
        Err(Error::new(ErrorKind::Numeric, message).help(sentences::FOLLOW_THE_RUN_UP_INSTEAD))
    }

    /// The results of [`ReducedModel::regime`] for the known steady motion `found`, at the crank angles `cranks`.
    /// The motion is followed over one more period, without another search.
    ///
    /// # Errors
    /// The errors of [`ReducedModel::regime`].
    pub fn regime_at(&self, found: &Regime, cranks: &[f64], accuracy: f64) -> Result<Regime> {
        let Some(period) = self.kinks().period else { return Err(no_turn(self.kinks())) };
        Turn::of(self, period)?.described(found.energy, found.multiplier, cranks, accuracy)
    }
}

/// One period as a function of the crank angle.
struct Turn<'m, 'a> {
    flow: OverAngle<'m, 'a>,
    start: f64,
    period: f64,
}

impl<'m, 'a> Turn<'m, 'a> {
    fn of(model: &'m ReducedModel<'a>, period: f64) -> Result<Self> {
        let flow = OverAngle(Forces::of(model, Piece::unbounded(), model.sense)?);
        Ok(Turn { flow, start: model.sense * model.case.crank().start, period })
    }

    /// Energy and time at the end of a period that begins with `energy` (J), and the [multiplier](Regime::multiplier).
    /// `visit` receives every step. Steps are divided at the crank angles `targets`.
    fn run(
        &self,
        energy: f64,
        targets: &[f64],
        accuracy: f64,
        visit: &mut dyn FnMut(&OverAngle, &Step<3>) -> Result<()>,
    ) -> Result<[f64; 3]> {
        let forces = &self.flow.0;
        let (way, last) = (forces.way.get(), self.start + self.period);
        forces.begin_at(way * self.start);
        let mut place = Place { x: self.start, y: [energy, 0.0, 1.0], h: 0.0 };
        // The speed at which a branch of the motor's law has just ended.
        // A speed computed from the energy would have a rounding error and might lie on the wrong side of the end.
        let mut reached: Option<f64> = None;
        let mut empty = 0;
        while place.x < last {
            let piece = forces.model.piece_at(way * place.x, way).ok_or_else(|| stalled(way * place.x))?;
            forces.piece.set(piece);
            let end = if way > 0.0 { piece.ends[1] } else { -piece.ends[0] };
            // Selects the branch of the motor's law for the speeds that follow.
            let omega = reached.take().unwrap_or_else(|| self.flow.speed(place.x, place.y[0]));
            forces.branch.set(forces.model.branch(omega, way));
            let alpha = forces.acceleration(way * place.x, omega);
            forces.branch.set(forces.model.branch(omega, alpha));
            let from = place.x;
            let end = end.smaller(last);
            let inner = targets.iter().copied().filter(|&target| target > from && target < end);
            let targets: Vec<f64> = inner.chain([end]).collect();
            let stop = march(&self.flow, &mut place, &targets, accuracy, visit)
                .map_err(|error| if error.kind() == ErrorKind::Numeric { stalled(way * from) } else { error })?;
            if let Stop::Bound(bound) = stop {
                // Sets the energy to its exact value at the speed where the present branch ends and the next begins.
                let speeds = forces.branch.get().map_or([0.0; 2], |branch| branch.speeds);
                let speed = speeds[1 - bound];
                place.y[0] = forces.reduced(way * place.x).inertia * speed * speed / 2.0;
                reached = Some(forces.model.sense * speed);
            }
            empty = if place.x > from { 0 } else { empty + 1 };
            if empty > MOST_EMPTY {
                return Err(stalled(way * from));
            }
        }
        Ok(place.y)
    }

    /// All results for the period that begins with `energy`.
    fn described(&self, energy: f64, multiplier: f64, cranks: &[f64], accuracy: f64) -> Result<Regime> {
        let forces = &self.flow.0;
        let way = forces.way.get();
        let here = |flow: &OverAngle, x: f64, energy: f64| {
            let omega = flow.speed(x, energy);
            SpeedAtCrank { crank: way * x, omega, alpha: flow.0.acceleration(way * x, omega) }
        };
        let mut extremes: Vec<SpeedAtCrank> = Vec::new();
        let mut samples: Vec<SpeedAtCrank> = Vec::with_capacity(cranks.len());
        let last = self.start + self.period;
        let targets: Vec<f64> = cranks.iter().map(|crank| way * crank).collect();
        forces.begin_at(way * self.start);
        let first = here(&self.flow, self.start, energy);
        let mut low = first;
        let mut visit = |flow: &OverAngle, step: &Step<3>| {
            let high = here(flow, step[1].0, step[1].1[0]);
            if low.alpha * high.alpha <= 0.0 {
                // If a load jumps at the beginning of the step, the sign may have changed there.
                low = here(flow, step[0].0, step[0].1[0]);
                if low.alpha * high.alpha <= 0.0 {
                    extremes.push(extreme(flow, step, low, &here)?);
                }
            }
            extremes.push(high);
            low = high;
            Ok(())
        };
        let [_, period, _] = self.run(energy, &targets, accuracy, &mut visit)?;
        // Every target is the end of a visited step. The state at the end of the period is the same as at its
        // beginning.
        for &crank in cranks {
            let at = extremes.iter().find(|at| at.crank == crank);
            let ends = [self.start, last].map(|end| (way * crank - end).abs() < 1e-9);
            samples.push(match at {
                Some(at) => *at,
                None if ends.contains(&true) => SpeedAtCrank { crank, ..first },
                None => return Err(outside(crank)),
            });
        }
        let by_speed = |a: &&SpeedAtCrank, b: &&SpeedAtCrank| a.omega.abs().total_cmp(&b.omega.abs());
        let fastest = *extremes.iter().max_by(by_speed).unwrap_or(&first);
        let slowest = *extremes.iter().min_by(by_speed).unwrap_or(&first);
        let turns = (self.period / TAU).round();
        let mean_speed = way * self.period / period;
        let start_speed = first.omega;
        Ok(Regime { period, turns, mean_speed, start_speed, fastest, slowest, multiplier, samples, energy })
    }
}

/// The position in a step at which the acceleration changes its sign, by bisection.
fn extreme(
    flow: &OverAngle,
    &[(x, y), (end, _)]: &Step<3>,
    low: SpeedAtCrank,
    here: &dyn Fn(&OverAngle, f64, f64) -> SpeedAtCrank,
) -> Result<SpeedAtCrank> {
    let mut found = low;
    // At an extreme the speed changes only with the square of the angle, so half the digits of the angle are enough.
    root::halved([0.0, end - x], 30, |h| -> Result<bool> {
        found = here(flow, x + h, one_step(flow, x, &y, h)?[0]);
        Ok(found.alpha * low.alpha > 0.0)
    })?;
    Ok(found)
}

fn outside(crank: f64) -> Error {
    let message = sentences::the_steady_speed_is_asked(&crank.to_degrees());
    Error::new(ErrorKind::Input, message).help(sentences::GIVE_CRANK_ANGLES_FROM_THE_START)
}

fn stalled(crank: f64) -> Error {
    let message = sentences::the_motor_does_not_carry(&crank.to_degrees());
    Error::new(ErrorKind::Numeric, message).help(sentences::CHOOSE_A_STRONGER_MOTOR_OR_A_LARGER_RATIO)
}
