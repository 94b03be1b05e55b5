//! Random mechanisms with the drive at a random joint. The input may be a slide, or an angle between two moving links.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use linkage::case::Case;
use linkage::drive::MotionLaw;
use linkage::input::Input;
use linkage::math::Curve;
use linkage::mechanism::JointId;

use super::sketch::RandomSource;

/// Largest motion of the driven joint: a rotation in rad, or a slide divided by the mechanism's size.
const RISE: f64 = 0.4;

/// The mechanism of `case` with the drive at a random joint, over a short motion from rest to rest.
/// `None` if the structure does not allow this drive, or if the start pose is singular for it.
pub fn driven_elsewhere(random: &mut RandomSource, case: &Case) -> Option<Case> {
    let joints: Vec<JointId> = case.mechanism.joints().ids().filter(|&joint| joint != case.crank().joint).collect();
    let joint = joints[random.index(joints.len())];
    let share = RISE * random.number(0.1, 1.0) * if random.yes() { 1.0 } else { -1.0 };
    let law = |input: Input| {
        let rise = share * input.span(case.mechanism.size());
        // The motion law is half a period of an oscillation, or a cycloid.
        let half = Curve::Harmonic { amplitude: rise / 2.0, period: 2.0, phase: -FRAC_PI_2 };
        if share > 0.0 { MotionLaw::Curve(Arc::new(half)) } else { MotionLaw::Cycloidal { rise, time: 1.0 } }
    };
    case.driven_at(joint, law, (0..=20).map(|k| f64::from(k) * 0.05).collect()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::specimens::dyads::{SORTS, chain, sample};
    use crate::specimens::frictional::frictional;
    use crate::specimens::geared::geared;
    use analytic::{AssurSolver, NewtonSolver};
    use linkage::math::{KeepNan, largest_size};
    use linkage::solver::Solver;
    use linkage::trajectory::{Channel, Trajectory};
    use std::collections::BTreeSet;

    /// Largest difference of two trajectories.
    /// The difference of a channel is divided by the largest value of all channels with the same unit.
    fn apart(one: &Trajectory, other: &Trajectory) -> f64 {
        let off = |(channel, values): (&Channel, &[f64])| {
            let alike = one.iter().filter(|(own, _)| own.kind.unit == channel.kind.unit);
            let scale = alike.map(|(_, values)| largest_size(values)).fold(1e-9, f64::larger);
            let others = other.column(channel).unwrap();
            values.iter().zip(others).map(|(a, b)| (a - b).abs() / scale).fold(0.0, f64::larger)
        };
        one.iter().map(off).fold(0.0, f64::larger)
    }

    /// About a third of the mechanisms cannot be assembled at some instant. Both analytic sides must refuse these
    /// mechanisms.
    #[test]
    fn both_sides_agree_wherever_the_drive_is() {
        let (mut agreed, mut refused, mut worst) = (0, 0, 0.0);
        let mut kinds = BTreeSet::new();
        for seed in 0..1000 {
            let mut random = RandomSource::of_sample(31, seed);
            let dyads = 1 + random.index(3);
            let Some(specimen) = sample(chain(&mut random, &SORTS, dyads).0) else { continue };
            let case = &specimen.scenario.case;
            // Every second mechanism has a wheel.
            let case = if seed % 2 == 0 { geared(&mut random, case) } else { Some(case.clone()) };
            let Some(case) = case.and_then(|case| driven_elsewhere(&mut random, &case)) else { continue };
            // Every third mechanism has friction.
            let case = if seed % 3 == 0 { frictional(&mut random, &case) } else { Some(case) };
            let Some(case) = case else { continue };
            match (AssurSolver.solve(&case), NewtonSolver.solve(&case)) {
                (Ok(one), Ok(other)) => {
                    agreed += 1;
                    let fused = case.structure.groups.iter().filter(|group| !group.is_rigid());
                    kinds.extend(fused.map(|group| format!("{:?} {}", group.kind, group.trains.len())));
                    worst = f64::larger(worst, apart(&one, &other));
                }
                (Err(_), Err(_)) => refused += 1,
                // Only side 1 detects that several states of the forces are in equilibrium.
                (Err(error), Ok(_)) if error.message().contains("several states") => refused += 1,
                (one, other) => {
                    let told = [one, other].map(|own| own.err().map(|error| error.to_string()));
                    panic!("seed {seed}, {}: one side alone: {told:?}", case.structure.formula(&case.mechanism))
                }
            }
        }
        assert!(agreed >= 250 && refused < agreed && kinds.len() >= 5, "{agreed} {refused} {kinds:?}");
        assert!(worst <= 1e-11, "{worst:e}");
    }
}
