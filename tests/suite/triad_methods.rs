//! The published methods for class III groups of order 3 against both solvers, on the published mechanism over its
//! revolution and on random mechanisms.

use std::cell::Cell;
use std::fmt::Write;
use std::path::Path;

use crate::common::{shipped, states};
use analytic::witness::triad::class_change::ClassChange;
use analytic::witness::triad::cramer::{self, Contours};
use analytic::witness::triad::{Triad, assur_point, linear_system};
use analytic::{AssurSolver, NewtonSolver};
use linkage::ErrorKind;
use linkage::case::Case;
use linkage::math::{KeepNan, Matrix, Vec2, cross, rotated, turned, unit};
use linkage::mechanism::{GROUND, LinkId};
use linkage::solver::{Solver, State};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use prover::run::{Options, prove};
use scenario::Scenario;

/// Largest differences from a solver, relative to the largest value of the quantity.
#[derive(Clone, Copy, Debug, Default)]
struct Differences {
    cramer: [f64; 2],
    /// Differences between the method of class change and the solver: in the links' directions, angular velocities and
    /// angular accelerations.
    /// The differences are zero if the layout does not allow the method.
    change: [f64; 3],
    assur_point: f64,
    linear: f64,
    /// Largest condition number of the contours.
    condition: f64,
    /// Largest condition number of the chain of dyads.
    chain: f64,
    /// The method of class change drives a ground lead, the conditional driver.
    /// This is the number of times that the method changes to another conditional driver.
    exchanges: usize,
    /// Number of reversals of the first lead on the ground.
    limits: usize,
}

impl Differences {
    /// Whether all differences are within `rounding` times a power of the condition number.
    /// The power is one for the solution of each linear system and for the angles.
    /// The power grows by one with every derivative of the angles.
    fn are_within(&self, rounding: f64) -> bool {
        let (own, chain) = (self.condition, self.condition.larger(self.chain));
        self.cramer[0] <= rounding * own
            && self.cramer[1] <= rounding * own.powi(2)
            && (0..3).all(|k| self.change[k] <= rounding * chain.powi(k as i32 + 1))
            && self.assur_point <= rounding * own
            && self.linear <= rounding * own
    }
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |max, value| if max.is_nan() || value <= max { max } else { value })
}

/// Product of the lengths of the four columns of a group's equations, divided by the absolute value of their
/// determinant; at least 1.
/// The quotient is the factor by which rounding errors of the coefficients can grow in the unknowns.
fn condition(contours: &Contours) -> f64 {
    let mut matrix = Matrix::zeros(4, 4);
    for (k, side) in contours.sides.into_iter().enumerate() {
        let columns = [(0, turned(contours.leads[0])), (k + 1, -turned(contours.leads[k + 1])), (3, turned(side))];
        for (column, vector) in columns {
            matrix[(2 * k, column)] = vector.x;
            matrix[(2 * k + 1, column)] = vector.y;
        }
    }
    matrix.column_iter().map(|column| column.norm()).product::<f64>() / matrix.determinant().abs()
}

/// Compares the methods with the given states of a solver.
fn differences(case: &Case, triad: &Triad, states: &[State], times: &[f64]) -> Differences {
    let links = triad.links();
    let speed = case.crank().at(0.0).rate;
    let all =
        |of: &dyn Fn(&State, LinkId) -> f64| largest(states.iter().flat_map(|s| links.map(|link| of(s, link).abs())));
    let omega = all(&|state, link| state.motions[link].omega).larger(speed.abs());
    let alpha = all(&|state, link| state.motions[link].alpha).larger(speed * speed);
    let mut change = ClassChange::new(case, triad);
    let mut found = Differences::default();
    let (mut force, mut last): (f64, Option<(usize, f64)>) = (0.0, None);
    let grounded = triad.leads.iter().position(|lead| lead.support.link == GROUND).unwrap_or(0);
    let keep = |worst: &mut f64, value: f64| *worst = largest([*worst, value]);
    for (state, &time) in states.iter().zip(times) {
        let motions = &state.motions;
        let compare = |worst: &mut [f64], [first, second]: [[f64; 4]; 2]| {
            for (k, link) in links.into_iter().enumerate() {
                keep(&mut worst[0], (first[k] - motions[link].omega).abs() / omega);
                keep(&mut worst[1], (second[k] - motions[link].alpha).abs() / alpha);
            }
        };
        compare(&mut found.cramer, cramer::rates(triad, motions).unwrap());
        keep(&mut found.condition, condition(&Contours::of(triad, motions)));
        if let Ok(change) = &mut change {
            let drive = case.crank().at(time);
            let transfer = change.solve(drive.value).unwrap_or_else(|error| panic!("{error}"));
            for (link, direction) in links.into_iter().zip(transfer.directions) {
                keep(&mut found.change[0], (direction - motions[link].direction).norm());
            }
            compare(&mut found.change[1..], transfer.rates(drive.rate, drive.acceleration));
            keep(&mut found.chain, transfer.condition);
            let now = (transfer.driver, transfer.first[grounded]);
            found.exchanges += usize::from(last.is_some_and(|last| last.0 != now.0));
            found.limits += usize::from(last.is_some_and(|last| last.1 * now.1 < 0.0));
            last = Some(now);
        }
        let (places, known) = (triad.places(motions), triad.known(case, state));
        let ways = [assur_point::reactions(&places, &known), linear_system::reactions(&places, &known)];
        for (way, worst) in ways.into_iter().zip([&mut found.assur_point, &mut found.linear]) {
            for (joint, own) in triad.joint_forces(&case.mechanism, &way.unwrap()) {
                keep(worst, (own - state.forces[joint]).norm());
                force = force.larger(state.forces[joint].norm());
            }
        }
    }
    found.assur_point /= force;
    found.linear /= force;
    found
}

fn only_triad(case: &Case) -> Triad {
    let found = Triad::all(case);
    assert_eq!(found.len(), 1);
    found[0]
}

#[test]
fn all_methods_agree_with_both_solvers_over_the_turn_of_the_published_drive() {
    for name in ["ov7_new.toml", "ov7_new_tabulated.toml"] {
        let scenario = shipped(name);
        let case = &scenario.case;
        assert_eq!(case.grid.len(), 361);
        for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
            let states = states(solver, case, &case.grid.times).unwrap();
            let found = differences(case, &only_triad(case), &states, &case.grid.times);
            // Some two hundred operations lie between a pose and the accelerations.
            // If the rounding errors (1.1e-16) of all operations had the same sign, the sum would be 2e-14.
            // The bound is 1e-13, because the solver has rounding errors too.
            assert!(found.are_within(1e-13), "{name} {} {found:?}", solver.name());
            assert!(found.condition < 2.0 && found.chain < 2.0, "{found:?}");
            // The motion passes both limits of the first ground lead.
            // The base link is never nearly in line with the ground lead that does not drive, so no exchange occurs.
            assert_eq!((found.limits, found.exchanges), (2, 0));
        }
    }
}

struct Draw<'a>(std::slice::Iter<'a, f64>);

impl Draw<'_> {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.next().expect("enough numbers are drawn")
    }

    fn place(&mut self) -> Vec2 {
        Vec2::new(self.between(-0.5, 0.5), self.between(-0.5, 0.5))
    }

    fn yes(&mut self) -> bool {
        self.between(0.0, 1.0) < 0.5
    }
}

fn inline(place: Vec2) -> String {
    format!("{{ x_m = {:?}, y_m = {:?} }}", place.x, place.y)
}

/// A link through world points, with an arbitrary frame.
fn link(text: &mut String, draw: &mut Draw, name: &str, points: &[(&str, Vec2)]) {
    let (turn, origin) = (unit(draw.between(-3.1, 3.1)), draw.place());
    let local = |place: Vec2| inline(rotated(turn, place - origin));
    let (mass, inertia) = (draw.between(0.2, 3.0), draw.between(0.01, 0.1));
    let centre = local(draw.place());
    let _ = writeln!(text, "[links.{name}]\nmass_kg = {mass:?}\ninertia_kg_m2 = {inertia:?}\nmass_centre = {centre}");
    let _ = writeln!(text, "[links.{name}.points]");
    for (point, place) in points {
        let _ = writeln!(text, "{point} = {}", local(*place));
    }
}

/// A mechanism with one class III group, described in a pose that it can take, and a dyad joined to the group. The feet
/// of two leads are on the ground or, if `moving`, on coupler and rocker of a four-bar.
fn mechanism(draw: &mut Draw, moving: bool) -> Option<Scenario> {
    let mut text = String::from("format = 1\nname = \"random\"\ntitle = \"random\"\n");
    let [o, a, b, f, d, e] = [(); 6].map(|()| draw.place());
    let [n, p, k, q, w] = [(); 5].map(|()| draw.place());
    let radius = draw.between(0.02, 0.05);
    let crank = unit(draw.between(-3.1, 3.1)) * radius;
    let (c, m) = (o + crank, o + Vec2::new(-crank.y, crank.x));
    let ground: &[(&str, Vec2)] =
        if moving { &[("O", o), ("P", p), ("W", w)] } else { &[("O", o), ("A", a), ("B", b), ("W", w)] };
    let _ = writeln!(text, "[ground.points]");
    for (name, place) in ground {
        let _ = writeln!(text, "{name} = {}", inline(*place));
    }
    let mut pins = vec![("O", "ground", "crank"), ("C", "crank", "lead"), ("F", "base", "lead")];
    pins.extend([("D", "base", "left"), ("E", "right", "base"), ("Q", "arm", "swing"), ("W", "ground", "swing")]);
    let mut starts = vec![(vec!["lead", "base", "left", "right"], "D", d), (vec!["arm", "swing"], "Q", q)];
    if moving {
        link(&mut text, draw, "crank", &[("O", o), ("C", c), ("M", m)]);
        link(&mut text, draw, "coupler", &[("M", m), ("N", n), ("A", a)]);
        link(&mut text, draw, "rocker", &[("P", p), ("N", n), ("B", b)]);
        pins.extend([("M", "crank", "coupler"), ("N", "coupler", "rocker"), ("P", "rocker", "ground")]);
        pins.extend([("A", "coupler", "left"), ("B", "right", "rocker")]);
        starts.push((vec!["coupler", "rocker"], "N", n));
    } else {
        link(&mut text, draw, "crank", &[("O", o), ("C", c)]);
        pins.extend([("A", "ground", "left"), ("B", "right", "ground")]);
    }
    let on_base = draw.yes();
    let carrier = if on_base { "base" } else { "left" };
    pins.push(("K", carrier, "arm"));
    let with = |mut points: Vec<(&'static str, Vec2)>, carries: bool| {
        points.extend(carries.then_some(("K", k)));
        points
    };
    link(&mut text, draw, "lead", &[("C", c), ("F", f)]);
    link(&mut text, draw, "base", &with(vec![("F", f), ("D", d), ("E", e)], on_base));
    link(&mut text, draw, "left", &with(vec![("A", a), ("D", d)], !on_base));
    link(&mut text, draw, "right", &[("B", b), ("E", e)]);
    link(&mut text, draw, "arm", &[("K", k), ("Q", q)]);
    link(&mut text, draw, "swing", &[("Q", q), ("W", w)]);
    for (name, first, second) in pins {
        let (first, second) = if draw.yes() { (first, second) } else { (second, first) };
        let _ =
            writeln!(text, "[[joints]]\nname = \"{name}\"\ntype = \"revolute\"\nlinks = [\"{first}\", \"{second}\"]");
    }
    let speed = if draw.yes() { 7.0 } else { -7.0 };
    let _ = writeln!(text, "[drive]\njoint = \"O\"\nspeed_rad_s = {speed:?}\nzero_rad = {:?}", draw.between(-3.1, 3.1));
    let _ = writeln!(text, "[gravity]\nx_m_s2 = 1\ny_m_s2 = -9.8");
    let _ = writeln!(text, "[[loads]]\ntype = \"resistance\"\nlink = \"right\"\nmoment_N_m = 3");
    // The crank's frame is arbitrary, so the code computes the crank angle that puts the crank pin at the drawn
    // position.
    let own = text.split("[links.crank.points]").nth(1).unwrap_or_default().lines().skip(1).take(2).map(|line| {
        let number =
            |key: &str| line.split(key).nth(1)?.split([',', ' ', '}']).find(|word| !word.is_empty())?.parse().ok();
        Vec2::new(number("x_m = ").unwrap_or(f64::NAN), number("y_m = ").unwrap_or(f64::NAN))
    });
    let own: Vec<Vec2> = own.collect();
    let local = own[1] - own[0];
    let start = cross(local, crank).atan2(local.dot(&crank));
    let zero: f64 = text.split("zero_rad = ").nth(1)?.lines().next()?.parse().ok()?;
    let _ = writeln!(text, "[start]\ncrank_rad = {:?}", start - zero);
    for (links, point, place) in starts {
        let (x, y) = (place.x, place.y);
        let _ = writeln!(
            text,
            "[[start.groups]]\nlinks = {links:?}\nnear = {{ point = \"{point}\", x_m = {x:?}, y_m = {y:?} }}"
        );
    }
    let from = start - zero - 0.3;
    let _ = writeln!(
        text,
        "[grid]\nfrom_rad = {from:?}\nto_rad = {:?}\nstep_rad = 0.05\n[engine]\ndt_s = 1e-3",
        from + 0.6
    );
    match Scenario::parse(&text, Path::new("random.toml")) {
        Ok(scenario) => Some(scenario),
        Err(error) if error.kind() == ErrorKind::Geometry => None,
        Err(error) => panic!("{error}\n{text}"),
    }
}

/// Whether the method of class change also reports that the group cannot be followed to one of the times.
fn class_change_is_lost(case: &Case, times: &[f64]) -> bool {
    match ClassChange::new(case, &only_triad(case)) {
        Ok(mut change) => times.iter().any(|&time| change.solve(case.crank().at(time).value).is_err()),
        Err(error) => error.kind() == ErrorKind::Geometry,
    }
}

/// Compares the methods on `count` random mechanisms.
/// Returns the number of exchanges of a conditional driver, and the number of dead points.
fn on_random_mechanisms(moving: bool, count: u32) -> [usize; 2] {
    let config = Config {
        cases: count,
        max_global_rejects: 50 * count,
        failure_persistence: None,
        // Shrinking is off: a smaller mechanism would be nearer to failure, not simpler.
        max_shrink_iters: 0,
        ..Config::default()
    };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let seen = Cell::new([0; 2]);
    let outcome = runner.run(&prop::collection::vec(0.0..1.0, 160), |numbers| {
        let Some(scenario) = mechanism(&mut Draw(numbers.iter()), moving) else {
            return Err(TestCaseError::reject("not assembled"));
        };
        let (case, text) = (&scenario.case, &scenario.text);
        let mut times = case.grid.times.clone();
        times.sort_by(f64::total_cmp);
        for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
            let states = match states(solver, case, &times) {
                Ok(states) => states,
                Err(error) => {
                    // Only higher groups are followed from pose to pose; a dyad is computed directly.
                    // The error therefore comes from the class III group.
                    if error.message().contains("cannot be followed") && !moving {
                        prop_assert!(class_change_is_lost(case, &times), "{error}\n{text}");
                        seen.set([seen.get()[0], seen.get()[1] + 1]);
                    }
                    return Err(TestCaseError::reject("dead point"));
                }
            };
            let found = differences(case, &only_triad(case), &states, &times);
            // The bound also allows for the difference between the two solvers.
            prop_assert!(found.are_within(1e-11), "{} {found:?}\n{text}", solver.name());
            seen.set([seen.get()[0] + found.exchanges, seen.get()[1]]);
        }
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    seen.get()
}

#[test]
fn all_methods_agree_with_both_solvers_on_random_groups_between_ground_and_crank() {
    let [exchanges, lost] = on_random_mechanisms(false, 300);
    assert!(exchanges > 0 && lost > 0, "the conditional driver was exchanged {exchanges} times, {lost} were lost");
}

#[test]
fn all_methods_but_class_change_agree_on_random_groups_on_moving_links() {
    on_random_mechanisms(true, 300);
}

#[test]
fn class_change_says_which_layout_it_needs() {
    let numbers: Vec<Vec<f64>> =
        (1..400).map(|k| (0..160).map(|n| ((k * n) as f64 * 0.618_033_988_749).fract()).collect()).collect();
    let scenario = numbers.iter().find_map(|numbers| mechanism(&mut Draw(numbers.iter()), true)).unwrap();
    let error = ClassChange::new(&scenario.case, &only_triad(&scenario.case)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    let message = error.to_string();
    for part in ["two leads on the ground and one on the driving link \"crank\"", "coupler", "rocker", "Cramer"] {
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn only_a_base_link_on_three_leads_is_a_class_iii_group_of_order_3() {
    for name in ["fourth_class.toml", "ov7_base.toml", "crank_rocker.toml"] {
        assert!(Triad::all(&shipped(name).case).is_empty(), "{name}");
    }
}

#[test]
fn a_proof_shows_the_methods_only_for_class_iii_groups() {
    let of_methods = |name: &str| {
        let proof = prove(&shipped(name), &Options::default()).unwrap();
        let checks = proof.checks.into_iter().filter(|check| check.family.starts_with("class III"));
        checks.map(|check| (check.family, check.verdict.word())).collect::<Vec<_>>()
    };
    let all = [
        "by Cramer's rule",
        "by class change",
        "reactions by the singular Assur point",
        "reactions by the group's linear system",
    ];
    assert_eq!(of_methods("ov7_new.toml"), all.map(|way| (format!("class III {way}"), "agree")));
    assert_eq!(of_methods("crank_rocker.toml"), []);
}
