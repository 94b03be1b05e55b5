//! Accuracy of the Rapier model (crate `rapier-twin`) at a step of 0.08 deg of the crank.
//! The tested figures are those of `docs/rapier.md`, with the numbers of sweeps given in that page.

use analytic::AssurSolver;
use linkage::case::{Case, Wanted};
use linkage::engine::{Engine, Route, Settings};
use linkage::math::KeepNan;
use linkage::solver::{Solver, State};
use linkage::trajectory::{Stage, Unit};
use prover::bounds::convergence::observed_order;
use prover::bounds::{Residual, residuals};

use super::solve;
#[cfg(feature = "f32")]
use crate::common::by_night;
use crate::common::{assert_within, shipped};
use linkage::mechanism::JointId;

/// Number of sweeps that is enough for the mechanisms of these tests, because their Rapier model has a flywheel on the
/// crank (story 14).
const SWEEPS: usize = 256;

fn whole(name: &str) -> Case {
    shipped(&format!("{name}.toml")).case.wanting(Wanted::ALL)
}

/// The engine at a step of 0.08 deg of the crank.
fn fine(name: &str, case: &Case, route: Route, extrapolated: usize) -> Box<dyn Engine> {
    let engine = prover::engines::named(name, 0.08f64.to_radians() / case.crank().at(0.0).rate.abs()).unwrap();
    engine.with(Settings { route, extrapolated, sweeps: SWEEPS, ..engine.settings() })
}

/// Largest error divided by half the range: first of angles, then of reactions and moment.
fn worst(found: &[Residual]) -> [f64; 2] {
    let most = |wanted: &dyn Fn(&Residual) -> bool| {
        found.iter().filter(|r| wanted(r)).map(|r| r.share()).fold(0.0, f64::larger)
    };
    [most(&|r| r.channel.kind.unit == Unit::Radian), most(&|r| r.channel.kind.stage >= Stage::Reactions)]
}

/// Story 61.
/// Errors of angles, and errors of reactions and moments by every route; all are divided by half the range.
/// The bounds are 10 % above the measured errors.
#[test]
fn regress_61_errors_of_every_route_are_as_measured() {
    let case = whole("crank_rocker");
    let truth = solve(&AssurSolver, &case);
    let routes = [(Route::Differences, 5.5e-6, 1e-7), (Route::Native, 3.5e-3, 1e-6), (Route::Probe, 7.5e-6, 1e-7)];
    for (route, plain, extrapolated) in routes {
        for (extrapolated, bounds) in [(0, [2e-6, plain]), (1, [1e-9, extrapolated])] {
            let run = solve(fine("rapier", &case, route, extrapolated).as_ref(), &case);
            let found = worst(&residuals(&truth, &run).unwrap());
            eprintln!(
                "{route:?} extrapolated {extrapolated}: angles {:.1e}, reactions and moment {:.1e}",
                found[0], found[1]
            );
            assert_within!(found[0], bounds[0], "{route:?} {extrapolated}: {found:?}");
            assert_within!(found[1], bounds[1], "{route:?} {extrapolated}: {found:?}");
        }
    }
}

/// One quantity of every state of a solver, in the order of the grid.
fn of_states(solver: &dyn Solver, case: &Case, of: impl Fn(&State) -> f64) -> Vec<f64> {
    let mut found = vec![f64::NAN; case.grid.len()];
    let mut visit = |row: usize, state: &State| {
        found[row] = of(state);
        Ok(())
    };
    solver.each(case, &mut visit).unwrap();
    found
}

/// Largest gap in a joint, divided by the mechanism's size.
fn gap(case: &Case, state: &State) -> f64 {
    let gaps = case.mechanism.joints().iter().map(|joint| {
        let [a, b] = [joint.first, joint.second].map(|side| state.motions[side.link].point(side.local));
        (b - a).norm() / case.mechanism.size()
    });
    gaps.fold(0.0, f64::larger)
}

/// Opening of a four-bar's loop after a step of `step` (s) with constant velocities, divided by the mechanism's size.
/// If a link rotates by omega h, its vector r becomes r + omega h n - (omega h)^2 r / 2 to second order in h. Here n is
/// r turned by 90 deg.
/// The terms omega h n add up to zero around the loop, so the loop opens by the last terms: h^2 / 2 |sum of omega^2 r|.
/// Every step corrects the whole earlier gap (erp = 1), so only the gap of one step remains.
fn gap_of_a_step(case: &Case, state: &State, step: f64) -> f64 {
    let joints = case.mechanism.joints();
    let around: linkage::math::Vec2 = (0..joints.len())
        .map(|k| {
            // The joints have the order O, A, B, C.
            // Joint k and the next joint are on one link, which may be the ground.
            let (from, to) = (&joints[JointId(k)], &joints[JointId((k + 1) % joints.len())]);
            let link = [from.first.link, from.second.link].into_iter().find(|&link| to.on(link).is_some()).unwrap();
            let motion = &state.motions[link];
            (motion.point(to.on(link).unwrap()) - motion.point(from.on(link).unwrap())) * motion.omega.powi(2)
        })
        .sum();
    0.5 * step * step * around.norm() / case.mechanism.size()
}

/// Story 64.
/// At a step of 0.08 deg of the crank, loops open by 1.02e-7 of the mechanism's size.
/// At every crank angle, the opening equals the local error of one step, except for 3 % of the largest local error.
/// With two substeps, the opening is a quarter of the opening with one substep.
/// In an extrapolated run, only the rounding error of the combination remains.
#[test]
fn regress_64_loops_open_by_the_local_error_of_a_step() {
    let case = whole("crank_rocker");
    let engine = fine("rapier", &case, Route::Differences, 0);
    let step = engine.settings().resolution;
    let most = |of: &[f64]| of.iter().copied().fold(0.0, f64::larger);
    for (substeps, bound) in [(1, 1.1e-7), (2, 2.75e-8)] {
        let engine = engine.with(Settings { substeps, ..engine.settings() });
        let measured = of_states(engine.as_ref(), &case, |state| gap(&case, state));
        let told = of_states(&AssurSolver, &case, |state| gap_of_a_step(&case, state, step / substeps as f64));
        let off = measured.iter().zip(&told).map(|(a, b)| (a - b).abs()).fold(0.0, f64::larger);
        eprintln!(
            "closure gap with {substeps} substeps: {:.3e} of the size, by the formula {:.3e}, apart by {off:.1e}",
            most(&measured),
            most(&told)
        );
        assert_within!(most(&measured), bound, "{:e}", most(&measured));
        assert_within!(off, 0.03 * most(&told), "{substeps} substeps: {off:e} of {:e}", most(&told));
    }
    let extrapolated = fine("rapier", &case, Route::Differences, 1);
    let measured = most(&of_states(extrapolated.as_ref(), &case, |state| gap(&case, state)));
    eprintln!("closure gap extrapolated: {measured:.1e} of the size");
    assert_within!(measured, 1e-10, "{measured:e}");
}

/// Story 70.
/// With two substeps, a step of 0.08 deg meets all required accuracies at once.
/// The required accuracies are fractions of the range.
/// For angles, the required accuracy is 1e-6.
/// For reactions in all joints and the balancing moment, the required accuracy is 3e-6 by differences, 1e-7 with
/// extrapolation and 1e-6 by probe.
/// The openings of the loops are at most 1e-7 of the mechanism's size.
#[test]
fn regress_70_two_substeps_meet_all_accuracy_goals_at_once() {
    let case = whole("crank_rocker");
    let truth = solve(&AssurSolver, &case);
    let engine = |route, extrapolated| {
        let engine = fine("rapier", &case, route, extrapolated);
        engine.with(Settings { substeps: 2, ..engine.settings() })
    };
    // Converts fractions of half the range to fractions of the range.
    let of_range = |found: [f64; 2]| found.map(|share| 0.5 * share);
    for (route, extrapolated, bound) in
        [(Route::Differences, 0, 3e-6), (Route::Differences, 1, 1e-7), (Route::Probe, 0, 1e-6)]
    {
        let run = solve(engine(route, extrapolated).as_ref(), &case);
        let [angles, forces] = of_range(worst(&residuals(&truth, &run).unwrap()));
        eprintln!(
            "{route:?} extrapolated {extrapolated}, two substeps: angles {angles:.1e}, forces {forces:.1e} of the range"
        );
        assert_within!(angles, 1e-6, "{route:?} {extrapolated}: {angles:e}, {forces:e}");
        assert_within!(forces, bound, "{route:?} {extrapolated}: {angles:e}, {forces:e}");
    }
    let gaps = of_states(engine(Route::Differences, 0).as_ref(), &case, |state| gap(&case, state));
    let largest = gaps.into_iter().fold(0.0, f64::larger);
    assert_within!(largest, 1e-7, "{largest:e}");
}

/// With a crank of half the length, the loop opens by less than 1e-7 of the mechanism's size.
/// With a crank of full length, the loop opens by more than 1e-7 of the mechanism's size.
#[test]
fn regress_64_half_the_crank_leaves_gaps_below_1e_7() {
    let whole_crank = whole("crank_rocker");
    let text = shipped("crank_rocker.toml").text;
    let half = text.replace("A = { x_m = 0.025995627740337, y_m = 0 }", "A = { x_m = 0.0129978138701685, y_m = 0 }");
    assert_ne!(text, half);
    let half = scenario::Scenario::parse(&half, std::path::Path::new("half.toml")).unwrap().case;
    let half = half.wanting(Wanted::of(&[Stage::Positions]));
    let gaps = [&whole_crank, &half].map(|case| {
        let run = of_states(fine("rapier", case, Route::Differences, 0).as_ref(), case, |state| gap(case, state));
        run.into_iter().fold(0.0, f64::larger)
    });
    eprintln!("closure gap with the whole crank {:.3e}, with half of it {:.3e}", gaps[0], gaps[1]);
    assert!(gaps[0] > 1e-7, "{gaps:?}");
    assert_within!(gaps[1], 1e-7, "{gaps:?}");
}

/// Story 62.
/// At a step of 0.08 deg of the crank, mechanisms of all classes, also with sliders, converge with order 2.
/// The test checks angles, and reactions by centred differences.
/// With extrapolation, the errors of angles are below 1e-7, and those of reactions below 1e-5.
#[test]
fn regress_62_orders_and_extrapolation_of_all_classes() {
    for name in ["ov7_base", "ov7_new", "fourth_class", "quick_return", "scotch_yoke"] {
        let case = whole(name);
        let truth = solve(&AssurSolver, &case);
        let engine = fine("rapier", &case, Route::Differences, 0);
        let runs = [1.0, 0.5].map(|part| solve(engine.at(part * engine.settings().resolution).as_ref(), &case));
        for residual in residuals(&truth, &runs[1]).unwrap() {
            let kind = residual.channel.kind;
            let wide = match kind.stage {
                Stage::Positions if kind.unit == Unit::Radian => 0.05,
                Stage::Reactions => 0.1,
                _ => continue,
            };
            if residual.rms <= 100.0 * engine.at(0.5 * engine.settings().resolution).noise(&case, kind) {
                continue;
            }
            let order = observed_order(&truth, [&runs[0], &runs[1]], &residual.channel).unwrap().unwrap();
            assert_within!((order - 2.0).abs(), wide, "{name} {}: order {order}", residual.channel);
        }
        let run = solve(fine("rapier", &case, Route::Differences, 1).as_ref(), &case);
        let found = worst(&residuals(&truth, &run).unwrap());
        assert_within!(found[0], 1e-7, "{name}: {found:?}");
        assert_within!(found[1], 1e-5, "{name}: {found:?}");
    }
}

/// Story 63.
/// Positions and velocities of an extrapolated run converge with order 3, because a term in h^3 remains.
/// Native reactions converge with order 2.
#[test]
fn regress_63_extrapolation_raises_the_order_by_one() {
    let case = whole("crank_rocker");
    let truth = solve(&AssurSolver, &case);
    let engine = fine("rapier", &case, Route::Native, 1);
    let runs = [8.0, 4.0].map(|part| solve(engine.at(part * engine.settings().resolution).as_ref(), &case));
    let mut seen = 0;
    for residual in residuals(&truth, &runs[1]).unwrap() {
        let kind = residual.channel.kind;
        let noise = engine.at(4.0 * engine.settings().resolution).noise(&case, kind);
        // In accelerations the third-order term is so small that the fourth-order term dominates, so accelerations are
        // skipped.
        if kind.stage == Stage::Accelerations || residual.rms <= 100.0 * noise {
            continue;
        }
        seen += 1;
        let order = observed_order(&truth, [&runs[0], &runs[1]], &residual.channel).unwrap().unwrap();
        let formal = engine.formal_order(&case, kind);
        assert_within!((order - formal).abs(), 0.15, "{}: order {order}, formal {formal}", residual.channel);
    }
    assert!(seen > 20, "only {seen} channels have more than rounding errors");
}

/// Story 14.
/// Symptom: errors of velocities are proportional to the step.
/// If the spanning tree cuts a joint of the crank, errors of forces are several times the forces.
/// Cause: too few sweeps for a light crank before a heavy coupler.
/// Remedy: a flywheel on the crank, which has no effect at constant speed.
/// With the flywheel, 32 sweeps must be as accurate as 1024 sweeps.
#[test]
fn regress_14_thirty_two_sweeps_are_as_good_as_a_thousand() {
    let case = whole("crank_rocker");
    let engine = prover::engines::named("rapier", 1e-3).unwrap();
    let runs = [32, 1024].map(|sweeps| solve(engine.with(Settings { sweeps, ..engine.settings() }).as_ref(), &case));
    for residual in residuals(&runs[1], &runs[0]).unwrap() {
        let share = residual.share();
        assert_within!(share, 1e-6, "{}: {share:e}", residual.channel);
    }
}

/// Story 60.
/// Symptom: halving the step makes an f32 run worse.
/// Cause: rounding error.
/// The bound on the rounding error must be valid for every route, on long and on short grids.
/// The difference between the f32 and the f64 run consists of rounding error only.
#[test]
#[cfg(feature = "f32")]
fn regress_60_single_precision_is_within_its_rounding_bound() {
    // The test concerns rounding, not convergence, so each grid has few instants.
    // The grids cover from a quarter of a revolution to two revolutions.
    let parts = [
        ("crank_rocker", 0.0, 1.0),
        ("crank_rocker", 0.0, 0.25),
        ("ov7_base", 0.0, 0.5),
        ("quick_return", 0.0, 2.0),
        ("scotch_yoke", 0.0, 0.5),
    ];
    let mut used: std::collections::BTreeMap<(Stage, &str, Option<&str>), f64> = Default::default();
    for (name, from, to) in parts {
        let base = whole(name);
        let turn = std::f64::consts::TAU / base.crank().at(0.0).rate.abs();
        let times = (0..=45).map(|k| turn * (from + (to - from) * f64::from(k) / 45.0)).collect();
        let case = base.on(linkage::case::Grid::of_times(base.crank(), times)).unwrap();
        // The rounding error of an impulse grows with the condition number of the loop that determines the impulse.
        // The constants of the bounds were found on the crank-rocker, so the probe is tested only there.
        let routes: &[Route] = if name == "crank_rocker" { &Route::ALL } else { &[Route::Differences, Route::Native] };
        for (single, double) in [("rapier-f32", "rapier"), ("impulse-f32", "impulse")] {
            // Short grids always use the smaller step too, long grids only if `LINKPROOF_DRAWS` is above 1.
            let steps = if to - from < 0.5 || by_night() { &[1e-3, 2.5e-4][..] } else { &[1e-3] };
            for (&route, &step) in routes.iter().flat_map(|route| steps.iter().map(move |step| (route, step))) {
                let engines = [double, single].map(|name| {
                    let engine = prover::engines::named(name, step).unwrap();
                    engine.with(Settings { route, ..engine.settings() })
                });
                assert!(super::epsilon(engines[1].as_ref()) > 1e-8);
                let [wide, narrow] = [0, 1].map(|k| solve(engines[k].as_ref(), &case));
                for residual in residuals(&wide, &narrow).unwrap() {
                    let kind = residual.channel.kind;
                    let noise = engines[1].noise(&case, kind);
                    // Channels that do not depend on the route have the same rounding error by every route.
                    let by_route = (kind.stage >= Stage::Reactions).then(|| route.name());
                    let most = used.entry((kind.stage, kind.unit.symbol(), by_route)).or_insert(0.0);
                    *most = most.larger(residual.max / noise);
                    // The bound is proportional to epsilon, so a bound that is valid in single precision is also valid
                    // in double precision.
                    // Only the rotation of a probe has a bound that is not proportional to epsilon.
                    if route != Route::Probe {
                        let [own, single] =
                            [0, 1].map(|k| engines[k].noise(&case, kind) / super::epsilon(engines[k].as_ref()));
                        assert_within!((own / single - 1.0).abs(), 1e-6, "{}: {own:e} {single:e}", residual.channel);
                    }
                    assert_within!(
                        residual.max,
                        noise,
                        "{name} {from}..{to} {single} {route:?} {step} {}: {:e} of {noise:e}",
                        residual.channel,
                        residual.max
                    );
                }
            }
        }
    }
    // The bounds are tight: for each bound, the error of some channel is at least a fiftieth of the bound.
    // The bound of a slide's moment assumes that the forces of all masses have the mechanism's size as their lever arm.
    // The guided links of `quick_return` and `scotch_yoke` are lighter and nearer than this bound assumes.
    // For the moments of these slides, an error of a thousandth of the bound is therefore enough.
    used.iter().for_each(|(what, share)| println!("{what:?}: {share:.1e}"));
    for (what, share) in &used {
        let least = if (what.0, what.1) == (Stage::Reactions, "N m") { 1e-3 } else { 1.0 / 50.0 };
        assert!(*share >= least, "{what:?}: the bound is {:.0} times the largest measured error", 1.0 / share);
    }
    assert!(used.len() >= 12, "{used:?}");
}
