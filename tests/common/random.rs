//! Random chains of dyads, the same ones in every run.

use std::cell::Cell;

use linkproof::math::{Vec2, cross, rotated, unit};
use linkproof::reference::AssurSolver;
use linkproof::scenario::Scenario;
use linkproof::solver::State;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use super::spec::{Body, Dyad, Pin, Spec};
use super::states;

/// Sine of the smallest transmission angle allowed: 10 degrees.
const DEAD: f64 = 0.17364817766693033;
/// Numbers in [0, 1) that one mechanism is made of.
const NUMBERS: usize = 128;

/// A mechanism that can be assembled on its whole grid, away from dead points.
pub struct Sample {
    pub spec: Spec,
    pub scenario: Scenario,
    /// Product over the dyads of 1 / sin(smallest transmission angle): how much one dyad after another can magnify an error.
    pub condition: f64,
}

struct Draw<'a>(std::slice::Iter<'a, f64>);

impl Draw<'_> {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.next().expect("enough numbers are drawn")
    }

    fn yes(&mut self) -> bool {
        self.between(0.0, 1.0) < 0.5
    }

    fn sign(&mut self) -> f64 {
        if self.yes() { 1.0 } else { -1.0 }
    }

    fn vector(&mut self, low: f64, high: f64) -> Vec2 {
        unit(self.between(-3.1, 3.1)) * self.between(low, high)
    }

    /// Mass data with the mass centre off the line of the link.
    fn mass(&mut self, length: f64) -> Option<(f64, Vec2, f64)> {
        let mass = self.between(0.1, 5.0);
        let centre = Vec2::new(self.between(-0.2, 1.2), self.between(-0.5, 0.5)) * length;
        Some((mass, centre, mass * length * length * self.between(0.02, 0.3)))
    }

    fn pin(&mut self, name: String, a: &str, b: &str) -> Pin {
        let links = if self.yes() { [a.into(), b.into()] } else { [b.into(), a.into()] };
        Pin { name, links }
    }
}

/// A crank and `dyads` dyads, each hung on a random point of what is there already and on a ground point near by.
fn chain(numbers: &[f64], dyads: usize) -> Spec {
    let mut draw = Draw(numbers.iter());
    let zero = draw.between(-3.1, 3.1);
    let start = draw.between(-3.1, 3.1);
    let radius = draw.between(0.1, 1.0);
    let pivot = draw.vector(0.0, 0.2);
    let origin = draw.vector(0.0, 1.0);
    let crank = Body {
        name: "link0".into(),
        points: vec![("P0".into(), pivot), ("Q0".into(), pivot + draw.vector(radius, radius))],
        mass: draw.mass(radius),
    };
    let speed = draw.between(0.5, 30.0) * draw.sign();
    let mut spec = Spec {
        ground: vec![("P0".into(), origin)],
        pins: vec![draw.pin("P0".into(), "ground", "link0")],
        links: vec![crank],
        speed,
        zero,
        start,
        gravity: draw.vector(0.0, 10.0),
        loads: Vec::new(),
        dyads: Vec::new(),
        grid: (start - 0.3, 0.05, 12),
        dt: 1e-3,
    };
    // World place of a joint to hang the next dyad on, guessed from the crank's pose; the dyad is aimed at it.
    let mut hook = origin + rotated(unit(zero + start), spec.links[0].points[1].1 - pivot);
    for k in 1..=dyads {
        // Hung on the point that the last step has made.
        let (base, point) = (spec.links.len() - 1, format!("Q{}", k - 1));
        let base = spec.links[base].name.clone();
        let (first, second) = (format!("link{}", 2 * k - 1), format!("link{}", 2 * k));
        let lengths = [draw.between(0.1, 1.0), draw.between(0.1, 1.0)];
        let inner = hook + draw.vector(lengths[0], lengths[0]);
        let foot = inner + draw.vector(lengths[1], lengths[1]);
        let left = cross(foot - hook, inner - hook) > 0.0;
        let body = |name: &str, from: String, to: String, length: f64, draw: &mut Draw| {
            let (from_at, along) = (draw.vector(0.0, 0.2), draw.vector(length, length));
            let next = from_at + draw.vector(0.1, 1.0);
            let mass = draw.mass(length);
            (Body { name: name.into(), points: vec![(from, from_at), (to, from_at + along)], mass }, along, next)
        };
        let (one, _, _) = body(&first, point.clone(), format!("I{k}"), lengths[0], &mut draw);
        let (mut two, along, next) = body(&second, format!("P{k}"), format!("I{k}"), lengths[1], &mut draw);
        let heading = |v: Vec2| v.y.atan2(v.x);
        let turn = heading(inner - foot) - heading(along);
        two.points.push((format!("Q{k}"), next));
        hook = foot + rotated(unit(turn), next - two.points[0].1);
        spec.ground.push((format!("P{k}"), foot));
        spec.links.extend([one, two]);
        spec.pins.push(draw.pin(point, &base, &first));
        spec.pins.push(draw.pin(format!("I{k}"), &first, &second));
        spec.pins.push(draw.pin(format!("P{k}"), "ground", &second));
        spec.dyads.push(if draw.yes() {
            Dyad { links: [first, second.clone()], left }
        } else {
            Dyad { links: [second.clone(), first], left: !left }
        });
        if draw.yes() {
            spec.loads.push((second, draw.between(0.0, 20.0)));
        }
    }
    spec
}

/// Reads a chain and looks whether it keeps away from dead points on its grid.
pub fn sample(spec: Spec) -> Option<Sample> {
    let scenario = spec.scenario().ok()?;
    let case = &scenario.case;
    let poses = states(&AssurSolver, case, &case.grid.times).ok()?;
    let mut condition = 1.0;
    for group in &case.structure.groups {
        let sine = |state: &State| {
            let at = |joint: usize| {
                let side = case.mechanism.joints()[joint].first;
                state.motions[side.link].point(side.local)
            };
            let (a, b) = (at(group.inner[0]) - at(group.outer[0]), at(group.inner[0]) - at(group.outer[1]));
            (cross(a, b) / (a.norm() * b.norm())).abs()
        };
        let least = poses.iter().map(sine).fold(1.0, f64::min);
        if !(least >= DEAD) {
            return None;
        }
        condition /= least;
    }
    Some(Sample { spec, scenario, condition })
}

/// Runs `check` on `count` random mechanisms of one to three dyads, and asserts that there were as many.
pub fn for_each(count: u32, check: impl Fn(&Sample) -> Result<(), TestCaseError>) {
    let config = Config {
        cases: count,
        max_global_rejects: 50 * count,
        failure_persistence: None,
        // Shrinking a mechanism leads to the edge of what fails, not to a simpler one, and takes minutes.
        max_shrink_iters: 0,
        ..Config::default()
    };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let checked = Cell::new(0);
    let numbers = (prop::collection::vec(0.0..1.0, NUMBERS), 1usize..=3);
    let outcome = runner.run(&numbers, |(numbers, dyads)| {
        let Some(sample) = sample(chain(&numbers, dyads)) else { return Err(TestCaseError::reject("dead point")) };
        check(&sample).map_err(|error| TestCaseError::fail(format!("{error}\n{}", sample.spec.toml())))?;
        checked.set(checked.get() + 1);
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    assert!(checked.get() >= count, "only {} mechanisms were checked", checked.get());
}

/// Fails with both numbers unless `value` is at most `bound`; NaN fails.
pub fn within(what: &str, value: f64, bound: f64) -> Result<(), TestCaseError> {
    if value <= bound { Ok(()) } else { Err(TestCaseError::fail(format!("{what}: {value:.3e} is beyond {bound:.3e}"))) }
}
