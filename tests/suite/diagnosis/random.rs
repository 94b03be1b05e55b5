//! Random faults of the case: one number of one part changes by a random percentage.

use super::{Outcome, examined, outcome, parsed, text, told};
use linkage::case::{Case, CaseParts, Grid};
use linkage::mechanism::{AssemblyMode, Link, LinkId, Mechanism, StartGroup, first_pose};
use linkage::solver::Solver;

/// Numbers from 0 to 1, the same in every run.
struct RandomSource(u64);

impl RandomSource {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    /// A fraction from 1 % to 30 %, of either sign.
    fn share(&mut self) -> f64 {
        let size = 0.01 * 30f64.powf(self.next());
        if self.next() < 0.5 { -size } else { size }
    }
}

fn with_links(parts: &mut CaseParts, change: impl FnOnce(&mut [Link])) {
    let mut links = parts.mechanism.links().to_vec();
    change(&mut links);
    parts.mechanism = Mechanism::new(links, parts.mechanism.joints().to_vec()).unwrap();
}

/// A case with a random fault, and the words that name it.
fn planted(case: &Case, random: &mut RandomSource) -> Option<(Case, String)> {
    let mut parts = case.clone().into_parts();
    let link = LinkId(1 + random.below(parts.mechanism.links().len() - 1));
    let name = parts.mechanism.links()[link].name.clone();
    let (share, other) = (random.share(), random.next() < 0.5);
    let words = match random.below(6) {
        0 => {
            with_links(&mut parts, |links| links[link].mass *= 1.0 + share);
            format!("mass of {name}: ")
        }
        1 => {
            with_links(&mut parts, |links| links[link].inertia *= 1.0 + share);
            format!("moment of inertia of {name}: ")
        }
        2 => {
            let size = case.mechanism.links()[link].extent();
            let axis = if other { "x" } else { "y" };
            with_links(&mut parts, |links| links[link].mass_centre[usize::from(!other)] += 0.3 * share * size);
            format!("mass centre of {name}, {axis}: ")
        }
        3 => {
            parts.gravity *= 1.0 + share;
            "gravity: ".into()
        }
        4 if !parts.loads.is_empty() => {
            let index = random.below(parts.loads.len());
            let own = parts.loads[index].times(1.0 + 3.0 * share)?;
            parts.loads.splice(index..=index, own);
            format!("load {}, ", index + 1)
        }
        _ => {
            let joint = random.below(parts.mechanism.joints().len());
            let mut joints = parts.mechanism.joints().to_vec();
            let side = if other { &mut joints[joint].first } else { &mut joints[joint].second };
            let (link, old) = (side.link, side.local);
            let along_guide = joints[joint].slides();
            let axis = random.below(2);
            let by = 0.03 * share * case.mechanism.size();
            let mut links = parts.mechanism.links().to_vec();
            let points = links[link].points.iter_mut().map(|point| &mut point.local);
            let sides = joints.iter_mut().flat_map(|joint| [&mut joint.first, &mut joint.second]);
            let sides = sides.filter(|side| side.link == link).map(|side| &mut side.local);
            points.chain(sides).filter(|local| **local == old).for_each(|local| local[axis] += by);
            let names: Vec<String> = joints
                .iter()
                .filter(|joint| joint.on(link).is_some_and(|local| (local - old).norm() <= by.abs() * 1.001))
                .map(|joint| format!("position of {} on {}, ", joint.name, links[link].name))
                .collect();
            parts.mechanism = Mechanism::new(links, joints).ok()?;
            if along_guide || parts.modes.contains(&AssemblyMode::Followed) {
                return None;
            }
            let wanted: Vec<StartGroup> = parts
                .modes
                .iter()
                .map(|mode| StartGroup {
                    mode: (*mode != AssemblyMode::Only).then_some(*mode),
                    ..StartGroup::default()
                })
                .collect();
            let angles: Vec<f64> = parts.drives.iter().map(|drive| drive.coordinate(drive.start)).collect();
            (parts.start, parts.modes) = first_pose(&parts.mechanism, &parts.structure, &angles, &wanted).ok()?;
            names.join("|")
        }
    };
    parts.grid = Grid::of_times(parts.drives.crank(), parts.grid.times.clone());
    Some((Case::new(parts).ok()?, words))
}

/// Every fault is named or at least mentioned.
/// The faults that are only mentioned are at most a twentieth of the named faults.
#[test]
fn random_faults_are_named() {
    let names = [
        "crank_rocker",
        "loaded_slider",
        "quick_return",
        "class3_group",
        "five_bar",
        "six_bar_slider",
        "cycloidal_start",
        "pendulum",
        "crank_rocker_runup",
    ];
    let (mut random, mut counts, mut lines) = (RandomSource(7), [0; 4], Vec::new());
    for name in names {
        let case = parsed(name, &text(name)).case;
        let mut done = 0;
        while done < COUNT {
            let Some((wrong, expected)) = planted(&case, &mut random) else { continue };
            let Ok(suspect) = analytic::AssurSolver.solve(&wrong) else { continue };
            let Some(found) = examined(&case, &suspect, None) else { continue };
            done += 1;
            let outcome = outcome(Some(&found), &expected);
            counts[outcome as usize] += 1;
            let line = format!("{outcome:?}: {name}, {expected}: {}", told(Some(&found)));
            println!("{line}");
            if outcome != Outcome::Named {
                lines.push(line);
            }
        }
    }
    let [named, mentioned, wrong, nothing] = counts;
    println!("random faults: {named} named, {mentioned} mentioned, {wrong} wrong, {nothing} nothing");
    assert!(wrong == 0 && nothing == 0 && mentioned * 20 <= named, "\n{}", lines.join("\n"));
}

/// Number of faults that are planted in each scenario.
const COUNT: usize = 6;
