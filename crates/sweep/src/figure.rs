//! Figures of a case: one number for a whole motion.

use analytic::AssurSolver;
use analytic::assur::batch::{rrr_sine, spans};
use analytic::range::{Extent, reachable};
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::{KeepNan, Motion};
use linkage::mechanism::assembly::transmission_sine;
use linkage::mechanism::{Group, GroupId, GroupKind, PerLink, Pose};
use linkage::solver::{Sampler, Solver};
use linkage::trajectory::{Channel, Trajectory};
use scenario::{CaseFigure, Claim, FigureKind, Scenario};

/// The part of a case's solution that the figures need.
struct SolvedCase {
    trajectory: Trajectory,
    /// Smallest sine of the transmission angles of all dyads, over the whole motion.
    sine: f64,
}

/// Writes the figures of a scenario into `values`. Figures that do not exist are NaN.
///
/// # Errors
/// The errors of the analytic solver, of range of motion, and of formulas.
pub(crate) fn all(figures: &[CaseFigure], scenario: &Scenario, values: &mut [f64]) -> Result<()> {
    let case = &scenario.case;
    let mut claims: Vec<Option<Claim>> = Vec::new();
    for figure in figures {
        claims.push(figure.claim(case, &scenario.formulas)?);
    }
    let channels: Vec<Channel> = claims.iter().flatten().flat_map(Claim::components).collect();
    let needs_poses = figures.iter().any(|own| own.kind == FigureKind::TransmissionAngle);
    let solved = match channels.is_empty() && !needs_poses {
        true => None,
        false => Some(solved(case, &channels, needs_poses)?),
    };
    let mut extent = None;
    for ((figure, claim), value) in figures.iter().zip(&claims).zip(values) {
        *value = match (&figure.kind, claim, &solved) {
            (FigureKind::Turn(own), Some(claim), Some(solved)) => own.sampled(claim, &solved.trajectory)?.value,
            (FigureKind::Place(own), Some(claim), Some(solved)) => {
                let row = own.sampled(claim, &solved.trajectory)?.rows[0];
                case.crank().input.shown(solved.trajectory.inputs()[row])
            }
            (FigureKind::TransmissionAngle, _, Some(solved)) => angle_of_sine(solved.sine),
            (FigureKind::Turn(_) | FigureKind::Place(_) | FigureKind::TransmissionAngle, ..) => f64::NAN,
            (FigureKind::Reach(end), ..) => {
                let extent = match extent {
                    Some(extent) => extent,
                    None => *extent.insert(reachable(case)?),
                };
                match extent {
                    Extent::FullTurn(_) => [0.0, 360.0][*end],
                    Extent::Limited(limits) => case.crank().input.shown(limits[*end].crank),
                }
            }
            (FigureKind::Verdict(name), ..) => verdict(scenario, name)?,
        };
    }
    Ok(())
}

fn solved(case: &Case, channels: &[Channel], needs_poses: bool) -> Result<SolvedCase> {
    let mut sine = f64::NAN;
    // As in the command `solve`, only that part of the mechanism is solved on which the requested channels depend.
    // A transmission angle needs all links.
    let wanted = if needs_poses { case.clone() } else { case.wanting_only(channels).scene()?.case };
    let mut sampler = Sampler::new(&wanted);
    AssurSolver
        .each(&wanted, &mut |row, state| {
            if needs_poses {
                let groups = wanted.structure.groups.ids();
                let sines = groups.filter_map(|group| sine_of(&wanted, group, &state.motions));
                let least = sines.fold(f64::INFINITY, f64::smaller);
                if !(sine <= least) && least.is_finite() {
                    sine = least;
                }
            }
            sampler.put(&wanted, row, state);
            Ok(())
        })
        .map_err(|error| analytic::range::explained(&wanted, error))?;
    Ok(SolvedCase { trajectory: sampler.finish(&wanted)?, sine })
}

/// Sine of a dyad's transmission angle, without its sign.
fn sine_of(case: &Case, group: GroupId, motions: &PerLink<Motion>) -> Option<f64> {
    let own = &case.structure.groups[group];
    if is_plain_dyad(own) {
        return Some(rrr_sine([0, 1].map(|k| motions[own.links[k]].direction), spans(case, group)));
    }
    transmission_sine(&case.mechanism, own, &Pose::of(motions)).map(f64::abs)
}

/// The acute angle with this sine (deg, at most 90).
pub(crate) fn angle_of_sine(sine: f64) -> f64 {
    sine.smaller(1.0).asin().to_degrees()
}

/// Whether a group is a dyad with three pins.
pub(crate) fn is_plain_dyad(group: &Group) -> bool {
    group.kind == GroupKind::Rrr && group.is_rigid()
}

fn verdict(scenario: &Scenario, name: &str) -> Result<f64> {
    let mut only = scenario.clone();
    only.formulas.list.iter_mut().filter(|own| own.name != name).for_each(|own| own.claim = None);
    let found = prover::run::solved::judge(&only)?;
    Ok(match found.verdict {
        prover::bounds::Verdict::Agree { .. } => 1.0,
        prover::bounds::Verdict::Disagree { .. } | prover::bounds::Verdict::Expected { .. } => 0.0,
        prover::bounds::Verdict::Inconclusive { .. } => f64::NAN,
    })
}
