//! Largest reactions and moments over the grid's range, refined between samples, and the journal diameters they require.

use linkage::math::KeepNan;
use std::f64::consts::PI;

use analytic::PoseSolver;
use linkage::case::Case;
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::math::extremum;
use linkage::mechanism::JointId;
use linkage::solver::State;
use linkage::trajectory::Stage;

/// Largest crank angle between two samples (rad): a reaction has a few maxima in a turn, not hundreds.
const SAMPLE_STEP: f64 = PI / 360.0;

/// Largest value of a quantity over a range of crank angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The largest magnitude (N, or N m for a moment).
    pub value: f64,
    /// Crank angle at which it occurs (rad, as the scenario defines it).
    pub crank: f64,
}

/// Peaks of one case.
#[derive(Clone, Debug, PartialEq)]
pub struct Peaks {
    /// Magnitude of the reaction in each joint (N).
    pub reactions: Vec<Peak>,
    /// Magnitude of the moment in each joint that keeps an angle (N m); `None` for joints that transmit none.
    pub moments: Vec<Option<Peak>>,
    /// Magnitude of the shaking force (N).
    pub shaking_force: Peak,
    /// Magnitude of the balancing moment on the crank (N m).
    pub balancing_moment: Peak,
}

/// Smallest diameter of a journal (m) for the force `force` (N), lever arm `lever` (m) and bending stress `stress` (Pa).
/// M = F l and sigma = 32 M / (pi d^3) give d = cbrt(32 F l / (pi sigma)).
#[must_use]
pub fn journal_diameter(force: f64, lever: f64, stress: f64) -> f64 {
    (32.0 * force * lever / (PI * stress)).cbrt()
}

/// Peaks over the range of crank angles that the case's grid spans.
///
/// # Errors
/// Those of [`PoseSolver::solve`], for crank angles within the range that cannot be reached.
pub fn over_range(case: &Case) -> Result<Peaks> {
    if case.grid.inputs.iter().any(|&crank| case.crank().time_of(crank).is_nan()) {
        let message =
            "peaks are looked for over the crank angle, but the drive's law may come to an angle more than once";
        return Err(Error::new(ErrorKind::Unsupported, message).help(Advice::SolutionTable));
    }
    let mut poses = PoseSolver::new(case)?;
    let (from, to) =
        case.grid.inputs.iter().fold((f64::MAX, f64::MIN), |(low, high), &c| (low.smaller(c), high.larger(c)));
    let parts = ((to - from) / SAMPLE_STEP).ceil().larger(1.0) as usize;
    let cranks: Vec<f64> = (0..=parts).map(|k| from + (to - from) * (k as f64 / parts as f64)).collect();
    let joints = case.mechanism.joints();
    let mut quantities: Vec<Quantity> = joints.ids().map(Quantity::Reaction).collect();
    let sliding = joints.entries().filter(|(_, joint)| joint.keeps_angle());
    quantities.extend(sliding.map(|(joint, _)| Quantity::Moment(joint)));
    quantities.extend([Quantity::ShakingForce, Quantity::BalancingMoment]);
    let mut samples = vec![Vec::with_capacity(cranks.len()); quantities.len()];
    for &crank in &cranks {
        let state = at(case, &mut poses, crank)?;
        for (column, quantity) in samples.iter_mut().zip(&quantities) {
            column.push(quantity.of(case, state));
        }
    }
    let mut peaks = Vec::with_capacity(quantities.len());
    for (quantity, column) in quantities.iter().zip(&samples) {
        peaks.push(refined(case, &mut poses, *quantity, &cranks, column)?);
    }
    let of = |wanted: Quantity| quantities.iter().position(|&own| own == wanted).map(|index| peaks[index]);
    let known = |wanted: Quantity| of(wanted).expect("every mechanism has it");
    Ok(Peaks {
        reactions: joints.ids().map(|joint| known(Quantity::Reaction(joint))).collect(),
        moments: joints.ids().map(|joint| of(Quantity::Moment(joint))).collect(),
        shaking_force: known(Quantity::ShakingForce),
        balancing_moment: known(Quantity::BalancingMoment),
    })
}

/// A quantity whose peak is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    Reaction(JointId),
    Moment(JointId),
    ShakingForce,
    BalancingMoment,
}

impl Quantity {
    fn of(self, case: &Case, state: &State) -> f64 {
        match self {
            Quantity::Reaction(joint) => state.forces[joint].norm(),
            Quantity::Moment(joint) => state.moments[joint].abs(),
            Quantity::ShakingForce => state.shaking(case).0.norm(),
            Quantity::BalancingMoment => state.torques[0].abs(),
        }
    }
}

fn at<'p>(case: &Case, poses: &'p mut PoseSolver, crank: f64) -> Result<&'p State> {
    let drive = case.crank().at(case.crank().time_of(crank));
    poses.solve(crank, drive.rate, drive.acceleration, Stage::BalancingMoment)
}

/// The largest sample, refined by golden section between its neighbours.
fn refined(case: &Case, poses: &mut PoseSolver, quantity: Quantity, cranks: &[f64], samples: &[f64]) -> Result<Peak> {
    let mut value = |crank: f64| -> Result<f64> { Ok(quantity.of(case, at(case, poses, crank)?)) };
    let (crank, value) = extremum::greatest(cranks, samples, &mut value)?;
    Ok(Peak { value, crank })
}
