//! Shape of a specimen of about one metre: links, joints, start pose.
//! The shape also states the range of crank angles that is far from singular poses.

use std::f64::consts::TAU;

use analytic::AssurSolver;
use analytic::range::{Extent, FourBar, FourBarType, Range};
use linkage::case::{Case, Grid, Wanted};
use linkage::mechanism::GroupKind;
use linkage::mechanism::assembly::transmission_sine;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

use super::super::higher::{Among, FAMILIES, mechanism};
use super::super::random::{DEAD, REACH, SORTS, chain};
use super::super::sketch::RandomSource;
use super::super::spec::{Spec, four_bar};

/// Upper limit of the condition number of a higher group.
/// For comparison, a dyad with a transmission angle of 10 degrees has the condition number 11.4.
const CONDITION: f64 = 25.0;
/// Upper limit of a link's angular velocity (rad/s) and of a joint's velocity (m/s), at a crank speed of 1 rad/s.
const FASTEST: f64 = 8.0;
/// If the safe range of crank angles (rad) is shorter than this value, the specimen is rejected.
const SHORTEST: f64 = 0.3;

/// A mechanism without masses and loads, and its safe range.
pub struct Shape {
    pub sort: String,
    pub spec: Spec,
    pub safe: Safe,
}

/// Range of crank angles (rad) that contains the start and is far from singular poses.
#[derive(Clone, Copy, Debug)]
pub struct Safe {
    pub from: f64,
    pub to: f64,
    /// Whether all crank angles are safe; `from` and `to` are then a revolution apart.
    pub full: bool,
}

impl Safe {
    pub fn has(&self, crank: f64) -> bool {
        self.full || (self.from <= crank && crank <= self.to)
    }
}

/// The shape with the number `index`; the last digit of `index` selects one of ten kinds of shape.
pub fn shape(random: &mut RandomSource, index: u64) -> Result<Shape, String> {
    let round = (index / 10) as usize;
    let (sort, mut spec) = match index % 10 {
        kind @ 0..=2 => four_bar_of(random, (3 * round + kind as usize) % 8),
        kind @ 3..=7 => {
            let (sort, sorts, dyads) = match kind {
                3 => ("one dyad with slides", &SORTS[1..], 1),
                4 => ("two RRR dyads", &SORTS[..1], 2),
                5 => ("two dyads", &SORTS[..], 2),
                6 => ("three dyads", &SORTS[..], 3),
                _ => ("two dyads with slides", &SORTS[1..], 2),
            };
            (sort.into(), chain(random, sorts, dyads).0)
        }
        kind => {
            let family = &FAMILIES[round % FAMILIES.len()];
            let among = match kind {
                8 => Among::Alone,
                _ => [Among::BehindADyad, Among::CarryingADyad][random.index(2)],
            };
            (format!("{} {among:?}", family.topology.name), mechanism(random, family, among).0)
        }
    };
    spec.loads.clear();
    spec.speed = 1.0;
    let case = spec.scenario().map_err(|error| short(error.message()))?.case;
    let safe = safe(&case)?;
    Ok(Shape { sort, spec, safe })
}

/// The message of an error without its numbers, for counting.
pub fn short(message: &str) -> String {
    let plain: String = message.chars().filter(|c| !c.is_ascii_digit()).collect();
    plain.chars().take(90).collect()
}

/// A four-bar of a given kind: one of the four Grashof types, or a non-Grashof type given by its longest link.
fn four_bar_of(random: &mut RandomSource, kind: usize) -> (String, Spec) {
    use FourBarType::{CrankRocker, DoubleCrank, DoubleRocker, RockerCrank, TripleRocker};
    let types = [CrankRocker, RockerCrank, DoubleCrank, DoubleRocker];
    let wanted = types.get(kind).copied().unwrap_or(TripleRocker);
    let lengths = loop {
        let lengths = [(); 4].map(|()| random.number(0.2, 1.0));
        let mut sorted = lengths;
        sorted.sort_by(f64::total_cmp);
        let near = (sorted[0] + sorted[3] - sorted[1] - sorted[2]).abs() < 0.1;
        let fits = kind < types.len() || lengths[kind - types.len()] == sorted[3];
        if !near && fits && FourBar::of_lengths(lengths).of_type == wanted {
            break lengths;
        }
    };
    let mut spec = four_bar(lengths, random.yes());
    let coupler = &mut spec.links[1];
    coupler.points.push(("E".into(), random.vector(0.1, 0.5)));
    spec.start = random.angle();
    let spec = spec.moved(random.vector(0.0, 0.5), random.angle());
    (format!("four-bar {wanted:?}"), if random.yes() { spec.mirrored() } else { spec })
}

/// Follows the mechanism from its start in both directions until it comes near a singular pose.
fn safe(case: &Case) -> Result<Safe, String> {
    // Rejects an unsuitable start without following the motion.
    let sine = |group| transmission_sine(&case.mechanism, group, &case.start);
    if case.structure.groups.iter().filter_map(sine).any(|sine| !(sine.abs() >= DEAD)) {
        return Err("too near a singular pose".into());
    }
    let range = Range::of(case).map_err(|error| short(error.message()))?;
    let kinds: Vec<bool> = case.structure.groups.iter().map(|group| group.kind == GroupKind::Higher).collect();
    let mut samples: Vec<(f64, bool)> = Vec::new();
    for sample in &range.samples {
        let mut groups = sample.groups.iter().zip(&kinds);
        let good =
            groups.all(
                |(measure, &is_higher)| {
                    if is_higher { measure.condition <= CONDITION } else { measure.determinant.abs() >= DEAD }
                },
            );
        samples.push((sample.crank, good));
    }
    let start = case.crank().start;
    let safe = if let Extent::FullTurn(turns) = range.extent {
        if samples.iter().all(|(_, good)| *good) {
            Safe { from: start, to: start + TAU, full: true }
        } else {
            let period = TAU * f64::from(turns);
            let before = samples.iter().map(|&(crank, good)| (crank - period, good));
            around(start, &before.chain(samples.iter().copied()).collect::<Vec<_>>())
        }
    } else {
        around(start, &samples)
    };
    if !(safe.to - safe.from >= SHORTEST) {
        return Err("too near a singular pose".into());
    }
    let places = (0..=60).map(|k| safe.from + (safe.to - safe.from) * f64::from(k) / 60.0).collect();
    let grid = Grid::of_inputs(case.crank(), places);
    let solved = case.on(grid).map(|case| case.wanting(Wanted::of(&[Stage::Positions, Stage::Velocities])));
    let (mut fast, mut far) = (false, false);
    let mut look = |_: usize, state: &State| {
        fast |= state.motions.iter().any(|motion| !(motion.omega.abs() <= FASTEST));
        let joints = case.mechanism.joints().iter();
        far |= joints.flat_map(|joint| [joint.first, joint.second]).any(|side| {
            let motion = &state.motions[side.link];
            !(motion.point(side.local).norm() <= REACH && motion.point_velocity(side.local).norm() <= FASTEST)
        });
        Ok(())
    };
    solved.and_then(|case| AssurSolver.each(&case, &mut look)).map_err(|error| short(error.message()))?;
    match (fast, far) {
        (false, false) => Ok(safe),
        (true, _) => Err("a link is much faster than the crank".into()),
        (_, true) => Err("a joint goes too far or too fast".into()),
    }
}

/// The longest range around `start` in which all samples are marked as safe.
fn around(start: f64, samples: &[(f64, bool)]) -> Safe {
    let reach = |samples: &mut dyn Iterator<Item = &(f64, bool)>| {
        samples.take_while(|(_, good)| *good).last().map_or(start, |(crank, _)| *crank)
    };
    let to = reach(&mut samples.iter().filter(|(crank, _)| *crank >= start));
    let from = reach(&mut samples.iter().rev().filter(|(crank, _)| *crank <= start));
    Safe { from, to, full: false }
}
