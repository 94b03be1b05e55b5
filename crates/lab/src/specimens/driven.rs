//! Random mechanisms that are driven at any of their joints: slides, and angles between moving links.

use linkage::case::Case;
use linkage::drive::MotionLaw;
use linkage::input::Input;
use linkage::mechanism::JointId;

use super::sketch::RandomSource;

/// Largest rotation of the driven joint (rad), and largest slide divided by the mechanism's size.
const RISE: f64 = 0.4;

/// The mechanism of `case` with the drive at a random joint, over a short motion from rest to rest.
/// `None` if the structure does not allow this drive, or if the start pose is singular for it.
pub fn driven_elsewhere(random: &mut RandomSource, case: &Case) -> Option<Case> {
    let joints: Vec<JointId> = case.mechanism.joints().ids().filter(|&joint| joint != case.crank().joint).collect();
    let joint = joints[random.index(joints.len())];
    let share = RISE * random.number(0.1, 1.0) * if random.yes() { 1.0 } else { -1.0 };
    let law = |input: Input| MotionLaw::Cycloidal {
        rise: share * case.mechanism.size() / input.reach(case.mechanism.size()),
        time: 1.0,
    };
    case.driven_at(joint, law, (0..=20).map(|k| f64::from(k) * 0.05).collect()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::specimens::dyads::{SORTS, chain, sample};
    use analytic::{AssurSolver, NewtonSolver};
    use linkage::error::Result;
    use linkage::math::KeepNan;
    use linkage::solver::{Sampler, Solver};
    use linkage::trajectory::Trajectory;

    fn solved(case: &Case, solver: &dyn Solver) -> Result<Trajectory> {
        let mut sampler = Sampler::new(case);
        solver.sweep(
            case,
            &mut |row, state| {
                sampler.put(case, row, state);
                Ok(())
            },
            &mut |_| {},
        )?;
        sampler.finish(case)
    }

    #[test]
    fn both_sides_agree_wherever_the_drive_is() {
        let (mut agreed, mut refused, mut none, mut worst) = (0, 0, 0, 0.0f64);
        let mut kinds = std::collections::BTreeMap::new();
        for seed in 0..200u8 {
            let mut random = RandomSource::from_seed(seed);
            let dyads = 1 + random.index(3);
            let Some(specimen) = sample(chain(&mut random, &SORTS, dyads).0) else { continue };
            let Some(case) = driven_elsewhere(&mut random, &specimen.scenario.case) else {
                none += 1;
                continue;
            };
            let formula = case.structure.formula(&case.mechanism);
            match (solved(&case, &AssurSolver), solved(&case, &NewtonSolver)) {
                (Ok(one), Ok(other)) => {
                    agreed += 1;
                    for group in case.structure.groups.iter().filter(|group| !group.is_rigid()) {
                        *kinds.entry(format!("{:?}", group.kind)).or_insert(0) += 1;
                    }
                    let columns = |of: &Trajectory| -> Vec<Vec<f64>> {
                        of.channels().iter().map(|own| of.column(own).unwrap().to_vec()).collect()
                    };
                    let [ones, others] = [columns(&one), columns(&other)];
                    for (index, channel) in one.channels().iter().enumerate() {
                        let [a, b] = [&ones[index], &others[index]];
                        let same =
                            one.channels().iter().zip(&ones).filter(|(own, _)| own.kind.unit == channel.kind.unit);
                        let scale = same.flat_map(|(_, column)| column).fold(1e-9f64, |most, x| most.larger(x.abs()));
                        let off = a.iter().zip(b).fold(0.0f64, |most, (a, b)| most.larger((a - b).abs())) / scale;
                        if off > 1e-8 {
                            println!("{seed}: {channel} {off:.1e} {formula}");
                        }
                        worst = worst.larger(off);
                    }
                }
                (Err(_), Err(_)) => refused += 1,
                (Err(one), Ok(_)) => println!("{seed}: side 1 alone refuses: {one} {formula}"),
                (Ok(_), Err(one)) => println!("{seed}: side 2 alone refuses: {one} {formula}"),
            }
        }
        println!("{agreed} agree, {refused} refused, {none} none, worst {worst:.1e} {kinds:?}");
    }
}
