//! Reduced quantities as functions of the crank angle, and their extremes.

use crate::PoseSolver;
use crate::reduced::means::no_turn;
use crate::reduced::model::ReducedModel;
use linkage::error::Result;
use linkage::math::extremum;
use std::f64::consts::PI;

/// Largest crank angle between two samples (rad). A reduced quantity has a few extremes per turn, not hundreds.
const SAMPLE_STEP: f64 = PI / 360.0;

/// The reduced quantities at one crank angle, without motor, reducer and flywheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReducedRow {
    /// Crank angle (rad, in the scenario's convention).
    pub crank: f64,
    /// Reduced moment of inertia I* (kg m^2).
    pub inertia: f64,
    /// dI*/dphi (kg m^2).
    pub slope: f64,
    /// Reduced moment of resistance of gravity and loads (N m), in the sense of the scenario's speed.
    /// The moment is positive where the drive must work against gravity and loads.
    pub resistance: f64,
}

/// Smallest and largest value of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// Crank angle (rad) and value of the minimum.
    pub least: (f64, f64),
    /// Crank angle (rad) and value of the maximum.
    pub greatest: (f64, f64),
}

impl ReducedModel<'_> {
    /// The reduced quantities at crank angles (rad).
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`](linkage::error::ErrorKind::Geometry) for crank angles that cannot be reached.
    pub fn rows(&self, cranks: &[f64]) -> Result<Vec<ReducedRow>> {
        let mut poses = PoseSolver::new(self.case)?;
        cranks.iter().map(|&crank| self.row(&mut poses, crank)).collect()
    }

    fn row(&self, poses: &mut PoseSolver, crank: f64) -> Result<ReducedRow> {
        let found = self.at(poses, crank, self.sense)?;
        // A moment against the motion is positive, in whichever sense the crank turns.
        let resistance = -self.sense * found.applied;
        Ok(ReducedRow { crank, inertia: found.inertia, slope: found.slope, resistance })
    }

    /// Extremes of the reduced moments of inertia and of resistance over one period, refined between samples.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`](linkage::error::ErrorKind::Geometry) for a crank that does not turn fully.
    pub fn extremes(&self) -> Result<[Extremes; 2]> {
        self.extremes_of([|row| row.inertia, |row| row.resistance])
    }

    /// Extremes of dI*/dphi over one period, refined between samples.
    ///
    /// # Errors
    /// The errors of [`ReducedModel::extremes`].
    pub fn slope_extremes(&self) -> Result<Extremes> {
        Ok(self.extremes_of([|row| row.slope])?[0])
    }

    fn extremes_of<const N: usize>(&self, quantities: [fn(&ReducedRow) -> f64; N]) -> Result<[Extremes; N]> {
        let Some(period) = self.kinks().period else { return Err(no_turn(self.kinks())) };
        let count = (period / SAMPLE_STEP).ceil();
        let start = self.case.crank().start;
        let mut cranks: Vec<f64> = (0..=count as usize).map(|k| start + period * (k as f64 / count)).collect();
        // Kinks are added as samples: a kink may be an extreme at which the curve is not flat.
        cranks.extend(&self.kinks().cranks);
        cranks.sort_by(f64::total_cmp);
        let mut poses = PoseSolver::new(self.case)?;
        let rows = cranks.iter().map(|&crank| self.row(&mut poses, crank)).collect::<Result<Vec<ReducedRow>>>()?;
        let mut found = [Extremes { least: (start, 0.0), greatest: (start, 0.0) }; N];
        for (extremes, of) in found.iter_mut().zip(quantities) {
            let mut end = |sign: f64| -> Result<(f64, f64)> {
                let values: Vec<f64> = rows.iter().map(|row| sign * of(row)).collect();
                let mut value = |crank: f64| -> Result<f64> { Ok(sign * of(&self.row(&mut poses, crank)?)) };
                let (crank, value) = extremum::greatest(&cranks, &values, &mut value)?;
                Ok((crank, sign * value))
            };
            *extremes = Extremes { least: end(-1.0)?, greatest: end(1.0)? };
        }
        Ok(found)
    }
}
