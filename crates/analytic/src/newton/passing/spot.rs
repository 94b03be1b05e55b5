//! Poses on the path, and steps between them.

use crate::newton::steps::TRACKING_STEP;
use crate::newton::system::System;
use crate::sentences;
use linkage::error::Result;

/// A pose on the path: the crank's angle in the world (rad), all coordinates, and their derivatives with respect to
/// this angle.
#[derive(Clone, Debug, Default)]
pub(in crate::newton) struct Spot {
    pub(in crate::newton) angle: f64,
    pub(in crate::newton) q: Vec<f64>,
    pub(in crate::newton) slope: Vec<f64>,
    pub(in crate::newton) curve: Vec<f64>,
    /// Signs of the blocks' determinants.
    pub(in crate::newton) signs: Vec<f64>,
    /// For every block: signed ratio of its determinant to the largest possible determinant; empty before the
    /// computation.
    pub(in crate::newton) shares: Vec<f64>,
}

/// The spot of a system at its present pose. The system's Jacobian must be factored at this pose.
pub(super) fn spot(system: &mut System) -> Spot {
    (system.inputs[0].rate, system.inputs[0].acceleration) = (1.0, 0.0);
    system.differentiate();
    Spot {
        angle: system.inputs[0].value,
        q: system.q.clone(),
        slope: system.rate.clone(),
        curve: system.second.clone(),
        signs: system.jacobian.signs().collect(),
        shares: Vec::new(),
    }
}

/// Places a system at a spot, and factors its Jacobian at this spot.
pub(super) fn place(system: &mut System, spot: &Spot) -> Result<()> {
    system.q.copy_from_slice(&spot.q);
    system.inputs[0].value = spot.angle;
    system.branch.clone_from(&spot.signs);
    system.assemble();
    match system.jacobian.factor() {
        true => Ok(()),
        false => Err(system.lost(sentences::THE_JACOBIAN_IS_SINGULAR_THERE)),
    }
}

/// Takes one step from a spot to another angle, on the same branch.
pub(super) fn walked(system: &mut System, from: &Spot, to: f64) -> Result<Spot> {
    let turn = to - from.angle;
    let expected = from.q.iter().zip(&from.slope).zip(&from.curve);
    let expected: Vec<f64> = expected.map(|((q, slope), curve)| q + turn * (slope + 0.5 * turn * curve)).collect();
    system.branch.clone_from(&from.signs);
    let found = settled(system, to, &expected)?;
    system.check_signs()?;
    Ok(found)
}

/// The pose at the angle `angle`, corrected by Newton's method from the coordinates `expected`.
pub(super) fn settled(system: &mut System, angle: f64, expected: &[f64]) -> Result<Spot> {
    system.q.copy_from_slice(expected);
    system.inputs[0].value = angle;
    system.correct()?;
    let size = system.case.mechanism.size();
    for (index, (q, expected)) in system.q.iter().zip(expected).enumerate() {
        let allowed = TRACKING_STEP * if index % 3 == 2 { 1.0 } else { size };
        if !((q - expected).abs() <= allowed) {
            return Err(system.lost(sentences::THE_SOLUTION_HAS_JUMPED_TO_ANOTHER));
        }
    }
    let mut found = spot(system);
    found.shares = system.jacobian.shares().collect();
    Ok(found)
}
