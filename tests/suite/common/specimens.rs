//! Random correct mechanisms of all kinds, as scenario text, reproducible from a seed and a number.
//!
//! Sizes are from 1 mm to 10 m, and masses within a mechanism spread over four decades.
//! Speeds are from 0.1 to 3000 rpm in either direction.
//! Motions are prescribed or free.
//! Loads are of all kinds; each load has the order of magnitude of the inertia forces and weights.
//! Within the range of its grid, no specimen comes near a singular pose.

mod motions;
mod shapes;

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use analytic::AssurSolver;
use linkage::case::Case;
use linkage::drive::Load;
use linkage::math::{KeepNan, Vec2, unit};
use linkage::solver::{Solver, State};

use super::loads::{Sizes, loads};
use super::sketch::RandomSource;
use super::spec::Spec;
use shapes::{Shape, short};

/// Crank angle (rad) per engine step at the largest crank speed, in scenarios that state a step.
const STEP: f64 = 0.005;

/// A mechanism with its motion and loads.
pub struct Specimen {
    pub spec: Spec,
    /// Description of the specimen.
    pub sort: String,
}

impl Specimen {
    /// The scenario as text, with a step of the engine or without the section `[engine]`.
    pub fn toml(&self, with_step: bool) -> String {
        let dt = self.spec.dt.filter(|_| with_step);
        format!("# {}\n{}", self.sort, Spec { dt, ..self.spec.clone() }.toml())
    }
}

/// The specimen with number `index` of a seed.
/// `dropped` counts the rejected candidates, by reason.
pub fn specimen(seed: u64, index: u64, dropped: &mut BTreeMap<String, usize>) -> Specimen {
    let mut random = RandomSource::of_sample(seed, index);
    // The kind of motion is chosen before the rejections, because free candidates are rejected more often than
    // prescribed ones.
    let is_free = random.number(0.0, 1.0) < 0.4;
    loop {
        match drawn(&mut random, index, is_free) {
            Ok(mut specimen) => {
                specimen.spec.other.name = format!("random_{seed}_{index:04}");
                return specimen;
            }
            Err(why) => *dropped.entry(why).or_insert(0) += 1,
        }
    }
}

fn drawn(random: &mut RandomSource, index: u64, is_free: bool) -> Result<Specimen, String> {
    let Shape { sort, spec, safe } = shapes::shape(random, index)?;
    let unscaled = spec.scenario().map_err(|error| short(error.message()))?.case.mechanism.size();
    let size = random.decades(1e-3, 10.0);
    let mut spec = spec.larger(size / unscaled);
    masses(random, &mut spec, size, !is_free);
    let falls = is_free && random.index(4) == 0;
    spec.gravity = match random.index(10) {
        0..=2 if !falls => Vec2::zeros(),
        3 | 4 => random.vector(1.6, 9.81),
        _ => Vec2::new(0.0, -9.81),
    };
    let mut speed = TAU / 60.0 * random.decades(0.1, 3000.0);
    let swing = (spec.gravity.norm() / (0.3 * size)).sqrt();
    if is_free {
        // At a start speed below half of `swing`, a free motion would hardly differ from a motion that starts at rest.
        speed = if falls { swing } else { speed.larger(0.5 * swing) };
    }
    spec.speed = if random.yes() { speed } else { -speed };
    spec.grid = (safe.from, (safe.to - safe.from) / 60.0, 60);
    if spec.speed < 0.0 {
        spec.grid.0 = safe.to;
        spec.grid.1 *= -1.0;
    }
    let (force, moment) = natural(&spec)?;
    // Half of the free mechanisms have a flywheel; without a flywheel, the other links accelerate a light crank
    // strongly.
    if let Some((_, _, inertia)) = spec.links[0].mass.as_mut()
        && is_free
        && random.yes()
    {
        *inertia = inertia.larger(moment / (speed * speed) * random.number(0.3, 2.0));
    }
    let count = [0, 1, 1, 2, 3, 4][random.index(6)];
    let sizes = Sizes { force: 0.3 * force, length: 0.3 * size, speed: 0.3 * size * speed };
    let case = spec.scenario().map_err(|error| short(error.message()))?.case;
    let added = loads(random, &case, count, sizes);
    spec.other.sections.push_str(&added);
    apart(&spec, 0.02 * size)?;
    let motion = if is_free {
        let motion = motions::free(random, &mut spec, moment, falls);
        let end = random.number(0.3, 1.5) * TAU / speed;
        spec.other.times = Some((motions::rounded(end), 40 + random.index(110)));
        motion
    } else if random.number(0.0, 1.0) < 0.3 {
        motions::law(random, &mut spec, safe)
    } else {
        motions::constant(random, &mut spec, safe)
    };
    let top = if spec.other.times.is_some() { motions::shortened(&mut spec, safe)? } else { speed };
    spec.dt = Some(motions::rounded(STEP / top));
    Ok(Specimen { sort: format!("{sort}, {motion}, {size:.2e} m, {:.2e} rpm", spec.speed * 60.0 / TAU), spec })
}

/// Masses over four decades; the mass centres are not on the lines between the joints.
/// A few links of prescribed motions are massless or point masses.
fn masses(random: &mut RandomSource, spec: &mut Spec, size: f64, bare: bool) {
    let heaviest = 100.0 * size * size * random.decades(0.3, 3.0);
    for body in &mut spec.links {
        let middle = body.points.iter().map(|(_, at)| at).sum::<Vec2>() / body.points.len() as f64;
        let reach = body.points.iter().map(|(_, at)| (at - middle).norm()).fold(0.05 * size, f64::larger);
        let centre = middle + unit(random.angle()) * (reach * random.number(0.0, 1.0));
        let mass = heaviest * random.decades(1e-4, 1.0);
        let inertia = mass * reach * reach * random.number(0.1, 1.0);
        body.mass = match random.index(25) {
            0 if bare => None,
            1 if bare => Some((mass, centre, 0.0)),
            _ => Some((mass, centre, inertia)),
        };
    }
}

/// Visits all states of the prescribed motion on the grid.
fn each(spec: &Spec, mut visit: impl FnMut(&Case, &State)) -> Result<(), String> {
    let case = spec.scenario().map_err(|error| format!("scenario: {}", error.message()))?.case;
    let mut look = |_: usize, state: &State| {
        visit(&case, state);
        Ok(())
    };
    AssurSolver.each(&case, &mut look).map_err(|error| short(error.message()))
}

/// Size of the reactions (N) and of the balancing moment (N m) from inertia and weight.
/// The function takes the largest reaction and the moment at each instant, and returns their medians over the motion.
/// Medians are used because reactions and moment grow towards the ends of a limited range.
fn natural(spec: &Spec) -> Result<(f64, f64), String> {
    let (mut forces, mut moments) = (Vec::new(), Vec::new());
    each(spec, |_, state| {
        forces.push(state.forces.iter().map(|own| own.norm()).fold(0.0, f64::larger));
        moments.push(state.torques[0].abs());
    })?;
    let [force, moment] = [forces, moments].map(|mut values| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    });
    if force > 0.0 && moment > 0.0 { Ok((force, moment)) } else { Err("no inertia".into()) }
}

/// Checks that springs and dampers always stay longer than `least` (m).
/// Where the end points of a spring or damper coincide, its direction is undefined.
fn apart(spec: &Spec, least: f64) -> Result<(), String> {
    let mut shortest = f64::MAX;
    each(spec, |case, state| {
        for load in &case.loads {
            if let Load::Spring { ends, .. } | Load::Damper { ends, .. } = load {
                let [a, b] = ends.map(|side| state.motions[side.link].point(side.local));
                shortest = shortest.smaller((a - b).norm());
            }
        }
    })?;
    if shortest >= least { Ok(()) } else { Err("a spring or damper loses its direction".into()) }
}
