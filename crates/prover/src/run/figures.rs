//! Figures of a mechanism, computed by the analytic sides.

use super::each_side::{EachSide, Reference};
use crate::sentences;
use analytic::reduced::means::{self as reduced, Means};
use formula::Rounded;
use linkage::case::{Case, Grid, Wanted};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::statistics::distinct;
use linkage::mechanism::JointSide;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;
use scenario::{Formulas, MechanismFigure};

/// Relative error assumed for a side's figures. The value was chosen so that rounding in sums over thousands of poses
/// stays below this error.
const KNOWN: f64 = 1e-11;

/// The figures that formulas claim, from both sides, in SI units. The error of a figure covers rounding, and the
/// difference between the two sides.
///
/// # Errors
/// The errors of [`Measured::value`].
pub(super) fn claimed(
    formulas: &Formulas,
    case: &Case,
    solvers: EachSide<&dyn Solver>,
) -> Result<EachSide<Vec<(MechanismFigure, Rounded)>>> {
    let asked = distinct(formulas.claims().flat_map(|(_, claim)| &claim.figures).map(|(_, figure)| *figure));
    let mut sides = EachSide::of(|side| Measured::of(case, solvers[side]));
    let mut found = EachSide::<Vec<_>>::default();
    for figure in asked {
        let values = EachSide::tried(|side| sides[side].value(figure))?;
        let [first, second] = values.pair();
        let error = KNOWN * first.abs() + 2.0 * (first - second).abs();
        for side in Reference::ALL {
            found[side].push((figure, Rounded { value: values[side], error }));
        }
    }
    Ok(found)
}

/// Figures computed by one analytic side. The means over a revolution are computed only once, at the first request.
pub(super) struct Measured<'a> {
    case: &'a Case,
    solver: &'a dyn Solver,
    means: Option<Means>,
}

impl<'a> Measured<'a> {
    /// Prepares the figures of a case in its nominal motion, without computing them yet.
    pub(super) fn of(case: &'a Case, solver: &'a dyn Solver) -> Self {
        Measured { case, solver, means: None }
    }

    /// A figure in SI units.
    ///
    /// # Errors
    /// The errors of the means over a revolution.
    /// An error if the motor cannot balance the resistance at any speed.
    pub(super) fn value(&mut self, figure: MechanismFigure) -> Result<f64> {
        Ok(match figure {
            MechanismFigure::ReducedInertiaMean => self.means()?.inertia,
            MechanismFigure::ReducedResistanceMean => self.means()?.resistance,
            MechanismFigure::SteadyCrankSpeed => self.steady()?[0],
            MechanismFigure::SteadyMotorSpeed => self.steady()?[1],
            MechanismFigure::Distance(ends) => self.distance(ends)?,
        })
    }

    fn means(&mut self) -> Result<Means> {
        let found = match self.means {
            Some(means) => means,
            None => reduced::means_over_turn(self.case, self.solver)?,
        };
        self.means = Some(found);
        Ok(found)
    }

    /// Steady speeds of the crank and of the motor (rad/s).
    fn steady(&mut self) -> Result<[f64; 2]> {
        let case = self.case;
        // This error occurs only for a changed case without a motor, because every scenario with this figure has a
        // motor.
        let no_motor = || Error::new(ErrorKind::Input, sentences::THE_STEADY_SPEED_NEEDS_A_MOTOR);
        let motor = case.crank().motor().ok_or_else(|| no_motor().help(sentences::ADD_MOTOR_OR_LEAVE_THE_FIGURE))?;
        // The motor acts in the direction in which the crank is driven.
        let sense = case.crank().sense();
        let resistance = sense * self.means()?.resistance;
        let Some(speed) = motor.steady_speed(resistance) else {
            return Err(reduced::no_steady_speed(resistance));
        };
        let crank = sense * speed;
        Ok([crank, crank * motor.ratio])
    }

    /// Distance of two points at t = 0, computed by this side (m).
    fn distance(&self, ends: [JointSide; 2]) -> Result<f64> {
        let base = self.case;
        let grid = Grid::of_times(base.crank(), vec![0.0]);
        let case = base.on(grid)?.wanting(Wanted::of(&[Stage::Positions]));
        let mut distance = f64::NAN;
        let mut visit = |_: usize, state: &State| {
            let [first, second] = ends.map(|end| state.motions[end.link].point(end.local));
            distance = (second - first).norm();
            Ok(())
        };
        self.solver.each(&case, &mut visit)?;
        Ok(distance)
    }
}
