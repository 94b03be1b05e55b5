//! Passing change points: by momentum in free motion, by `through = "smooth"` in a prescribed motion.

use std::path::Path;

use analytic::{AssurSolver, NewtonSolver};
use linkage::case::{Case, Grid, Wanted};
use linkage::drive::Load;
use linkage::error::ErrorKind;
use linkage::math::{KeepNan, Vec2};
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Stage, Trajectory, Unit};
use prover::bounds::Verdict;
use prover::run::{Options, prove};
use scenario::Scenario;

use super::free::{column, energies, solve};
use crate::common::spec::{Spec, four_bar};
use crate::common::{assert_within, chain, shipped};
use linkage::mechanism::LinkId;

const SIDES: [&dyn Solver; 2] = [&AssurSolver, &NewtonSolver];
const G: f64 = 9.81;

/// Moment of inertia of N four-bars about the pivots, and the moment of the weights if all pivoted bars are horizontal.
/// The N + 1 pivoted bars always have the same angle; the N rods between them move on a circle without rotating.
fn pendulum(pairs: usize) -> [f64; 2] {
    let n = pairs as f64;
    [(n + 1.0) / 3.0 + n, G * ((n + 1.0) / 2.0 + n)]
}

/// Angle and speed of theta'' = -c cos theta at instants `step` apart, by Taylor series of degree 25.
/// The solution is exact to rounding and uses no code of the crates.
fn by_series(c: f64, [mut theta, mut omega]: [f64; 2], step: f64, count: usize) -> Vec<[f64; 2]> {
    const ORDER: usize = 24;
    let mut found = vec![[theta, omega]];
    let parts = (step / 0.02).ceil();
    let h = step / parts;
    for _ in 0..count {
        for _ in 0..parts as usize {
            let (mut a, mut s, mut k) = (vec![theta, omega], vec![theta.sin()], vec![theta.cos()]);
            for n in 0..ORDER {
                if n > 0 {
                    let sum = |of: &[f64]| (1..=n).map(|j| j as f64 * a[j] * of[n - j]).sum::<f64>() / n as f64;
                    let (sine, cosine) = (sum(&k), -sum(&s));
                    s.push(sine);
                    k.push(cosine);
                }
                a.push(-c * k[n] / ((n + 1) * (n + 2)) as f64);
            }
            theta = a.iter().rev().fold(0.0, |sum, a| sum * h + a);
            omega = (1..a.len()).rev().fold(0.0, |sum, n| sum * h + n as f64 * a[n]);
        }
        found.push([theta, omega]);
    }
    found
}

/// The N-four-bar problem of the multibody benchmarks over ten seconds.
/// The motion passes some ten change points, at which all loops are singular at once.
#[test]
fn chains_of_four_bars_swing_through_their_change_points() {
    for pairs in [1, 2, 10] {
        let case = chain::four_bars(pairs, 10.0, 0.01);
        let [inertia, weight] = pendulum(pairs);
        let exact = by_series(weight / inertia, [std::f64::consts::FRAC_PI_2, -1.0], 0.01, 1000);
        let found = SIDES.map(|side| solve(side, &case));
        for (side, found) in SIDES.iter().zip(&found) {
            let (angle, omega) = (column(found, "link.bar0.angle_rad"), column(found, "link.bar0.omega_rad_s"));
            let energy = |row: usize| 0.5 * inertia * omega[row].powi(2) + weight * angle[row].sin();
            let drift = (0..angle.len()).map(|row| (energy(row) - energy(0)).abs()).fold(0.0, f64::larger);
            let range = 2.0 * weight;
            let off = exact.iter().zip(angle).map(|([exact, _], angle)| (exact - angle).abs()).fold(0.0, f64::larger);
            println!("{pairs} {}: energy {:.1e} of its range, angle {off:.1e} rad", side.name(), drift / range);
            assert_within!(drift / range, 1e-9, "{pairs} {}: {drift}", side.name());
            // With ten pairs, the coordinates and their rounding errors are ten times as large as with one pair.
            assert_within!(off, 1e-9 * (pairs as f64), "{pairs} {}: {off}", side.name());
        }
        let apart = apart(&found, |_| true);
        println!("{pairs}: sides {apart:.1e} apart");
        assert_within!(apart, 1e-8, "{pairs}: {apart}");
    }
}

/// Largest difference between the analytic sides in the channels that `of` selects.
/// The difference is divided by the largest value with the same unit, but by at least 1.
fn apart(found: &[Trajectory; 2], of: impl Fn(&Channel) -> bool) -> f64 {
    let largest = |unit: Unit| {
        let own = found[0].iter().filter(move |(channel, _)| channel.kind.unit == unit);
        own.flat_map(|(_, values)| values.iter()).fold(1.0f64, |most, value| most.larger(value.abs()))
    };
    let mut worst = 0.0f64;
    for ((channel, one), (_, two)) in found[0].iter().zip(found[1].iter()).filter(|((channel, _), _)| of(channel)) {
        let size = largest(channel.kind.unit);
        worst = one.iter().zip(two).fold(worst, |worst, (a, b)| worst.larger((a - b).abs() / size));
    }
    worst
}

/// One parallelogram, computed by hand.
/// The rod does not rotate, so half of the rod's weight and inertia force acts at each of its ends.
/// The remaining forces follow from the moments on a bar about its pivot.
#[test]
fn reactions_of_one_four_bar_match_the_hand_calculation() {
    let case = shipped("n_four_bar_1.toml").case;
    for side in SIDES {
        let found = solve(side, &case);
        let of = |name: &str| column(&found, name).to_vec();
        let (angle, omega, alpha) =
            (of("link.bar0.angle_rad"), of("link.bar0.omega_rad_s"), of("link.bar0.alpha_rad_s2"));
        let [x0, y0, y1] = ["joint.A0_1.fx_N", "joint.A0_1.fy_N", "joint.A1.fy_N"].map(of);
        let [ox0, oy0, ox1, oy1] = ["joint.O0.fx_N", "joint.O0.fy_N", "joint.O1.fx_N", "joint.O1.fy_N"].map(of);
        for row in 0..angle.len() {
            let (s, c) = angle[row].sin_cos();
            let acceleration =
                Vec2::new(-s * alpha[row] - c * omega[row].powi(2), c * alpha[row] - s * omega[row].powi(2));
            // The sum of the forces on two bars, with their mass centres at half length, and on the rod.
            let all = acceleration * 2.0 + Vec2::new(0.0, 3.0 * G);
            let ground = Vec2::new(ox0[row] + ox1[row], oy0[row] + oy1[row]);
            assert_within!((ground - all).norm(), 1e-8, "{} row {row}: {ground} {all}", side.name());
            let end = (acceleration.y + G) / 2.0;
            for own in [y0[row], -y1[row]] {
                assert_within!((own - end).abs(), 1e-8, "{} row {row}: {own} {end}", side.name());
            }
            if s.abs() > 0.05 {
                let along = (alpha[row] / 3.0 + G / 2.0 * c + end * c) / s;
                assert_within!((x0[row] - along).abs(), 1e-8, "{} row {row}: {} {along}", side.name(), x0[row]);
            }
        }
    }
}

/// With two parallelograms, the equations of the reactions contradict each other in level poses.
/// Reactions therefore have a pole in level poses, but the motion does not.
/// The middle bar carries two half rods, each end bar carries one half rod.
#[test]
fn reactions_may_have_a_pole_at_a_change_point() {
    let case = chain::four_bars(2, 1.0, 0.1);
    let level = root_of(&case);
    for side in SIDES {
        let at = |ahead: f64| {
            let grid = Grid::of_times(case.crank(), vec![level + ahead]);
            let found = solve(side, &case.on(grid).unwrap());
            [column(&found, "joint.O2_bar2.fx_N")[0] * column(&found, "link.bar0.angle_rad")[0], {
                column(&found, "link.bar0.alpha_rad_s2")[0]
            }]
        };
        // The first bar in the limit of level bars: J alpha = -(w + w_rod) / 2 - R sin(theta).
        let [inertia, weight] = pendulum(2);
        let alpha = -weight / inertia;
        let residue = -(alpha * (1.0 / 3.0 + 0.5) + G);
        for ahead in [1e-4, 1e-5, 1e-6, -1e-6, -1e-4] {
            let [found, acceleration] = at(ahead);
            println!("{} {ahead:e}: {found} {residue} {acceleration}", side.name());
            assert_within!((found.abs() - residue.abs()).abs(), 1e-7 + 300.0 * ahead.abs(), "{}: {found}", side.name());
            assert_within!((acceleration - alpha).abs(), 1e-7 + 100.0 * ahead.abs(), "{}", side.name());
        }
    }
}

/// The first instant at which the bars are level (s).
fn root_of(case: &Case) -> f64 {
    let [mut low, mut high] = [0.5, 1.0];
    while high - low > 1e-13 {
        let middle = 0.5 * (low + high);
        let grid = Grid::of_times(case.crank(), vec![middle]);
        let wanted = case.on(grid).unwrap().wanting(Wanted::of(&[Stage::Positions]));
        let angle = column(&solve(&AssurSolver, &wanted), "link.bar0.angle_rad")[0];
        if angle > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// A four-bar (ground, crank, coupler, rocker) released with a speed (rad/s), over a time of `to` seconds.
fn let_go(lengths: [f64; 4], left: bool, start: f64, speed: f64, to: f64) -> Spec {
    let mut spec = four_bar(lengths, left);
    spec.start = start.to_radians();
    spec.other.drive = format!("motion = \"free\"\nspeed_rad_s = {speed:?}\ninitial_speed_rad_s = {speed:?}\n");
    spec.other.times = Some((to, 300));
    spec
}

fn drift(case: &Case, found: &Trajectory) -> f64 {
    let all = energies(case, found);
    let (least, most) = all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), e| (a.smaller(*e), b.larger(*e)));
    (most - least) / all[0].abs().larger(1.0)
}

/// Mechanisms with change points; no known fault of this program ever concerned one of these mechanisms.
/// These are kites, antiparallelograms, and a four-bar whose longest and shortest links together are as long as the
/// two remaining links.
/// The energy is constant, and the sides agree.
#[test]
fn other_change_point_mechanisms_pass_by_momentum() {
    let all = [
        ("kite", [0.3, 0.2, 0.2, 0.3], 90.0, -9.0),
        ("kite with a long crank", [0.2, 0.3, 0.3, 0.2], 60.0, -9.0),
        ("antiparallelogram", [0.4, 0.2, 0.4, 0.2], 80.0, -8.0),
        ("its inversion", [0.2, 0.4, 0.2, 0.4], 80.0, -8.0),
        ("sum", [0.5, 0.1, 0.25, 0.35], 90.0, 25.0),
    ];
    for (what, lengths, start, speed) in all {
        for left in [true, false] {
            let case =
                let_go(lengths, left, start, speed, 3.0).scenario().unwrap_or_else(|error| panic!("{error}")).case;
            let found = SIDES.map(|side| solve(side, &case));
            for (side, found) in SIDES.iter().zip(&found) {
                let lost = drift(&case, found);
                println!("{what} {left} {}: energy {lost:.1e}", side.name());
                assert_within!(lost, 1e-9, "{what} {left} {}: {lost}", side.name());
            }
            let turned = column(&found[0], "link.crank.angle_rad");
            let ends =
                turned.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.smaller(*x), b.larger(*x)]);
            assert!(ends[1] - ends[0] > std::f64::consts::PI, "{what} passes no change point");
            let off = apart(&found, |channel| channel.kind.stage <= Stage::Accelerations);
            println!("{what} {left}: {off:.1e}");
            assert_within!(off, 1e-7, "{what} {left}: {off}");
        }
    }
}

/// A parallelogram whose coupler has its mass centre beside its centre line, with loads that dissipate energy.
#[test]
fn a_loaded_parallelogram_passes_its_change_points() {
    let mut spec = let_go([0.4, 0.2, 0.4, 0.2], true, 80.0, -9.0, 2.0);
    spec.links[1].mass = Some((3.0, Vec2::new(0.15, 0.09), 0.05));
    spec.loads = vec![("rocker".into(), 0.4)];
    let case = spec.scenario().unwrap_or_else(|error| panic!("{error}")).case;
    let damper = Load::TorsionDamper { links: [LinkId(0), LinkId(3)], damping: 0.02 };
    for case in [&case, &case.with(|parts| parts.loads.push(damper)).unwrap()] {
        let found = SIDES.map(|side| solve(side, case));
        let off = apart(&found, |_| true);
        println!("{off:.1e}");
        assert_within!(off, 1e-8, "{off}");
        assert!(column(&found[0], "link.coupler.omega_rad_s").iter().all(|omega| omega.abs() < 1e-9));
    }
}

/// A motion that reverses next to a change point, before or behind the change point.
/// Near the change point, the sides interpolate the motion, because the equations of the pose are nearly singular.
#[test]
fn motions_may_reverse_beside_a_change_point() {
    for (start, left) in [(2.0f64, true), (0.1, true), (0.001, true), (-2.0, false), (-0.1, false), (-0.001, false)] {
        let text = chain::text(1, 4.0, 0.02).replace("crank_deg = 90", &format!("crank_deg = {start:?}"));
        let text = text.replace("initial_speed_rad_s = -1\n", "initial_speed_rad_s = 0\n");
        let text = if left { text } else { text.replace("mode = \"left\"", "mode = \"right\"") };
        let case = Scenario::parse(&text, Path::new("chain.toml")).unwrap_or_else(|error| panic!("{error}")).case;
        let [inertia, weight] = pendulum(1);
        let exact = by_series(weight / inertia, [start.to_radians(), 0.0], 0.02, 200);
        for side in SIDES {
            let found = solve(side, &case);
            let angle = column(&found, "link.bar1.angle_rad");
            let off = exact.iter().zip(angle).map(|([exact, _], angle)| (exact - angle).abs()).fold(0.0, f64::larger);
            println!("{start} {}: {off:.1e}", side.name());
            assert_within!(off, 1e-9, "{start} {}: {off}", side.name());
        }
    }
}

/// A four-bar driven at constant speed, at crank angles in degrees.
/// If `through` is true, the drive passes change points.
fn driven(lengths: [f64; 4], left: bool, start: f64, through: bool, cranks: &[f64]) -> Case {
    let mut spec = four_bar(lengths, left);
    spec.start = start.to_radians();
    if through {
        spec.other.drive = "speed_rad_s = 10\nthrough = \"smooth\"\n".into();
    }
    let case = spec.scenario().unwrap_or_else(|error| panic!("{error}")).case;
    let times = cranks.iter().map(|crank| case.crank().time_of(crank.to_radians())).collect();
    case.on(Grid::of_times(case.crank(), times)).unwrap()
}

/// In a prescribed motion, the scenario states whether change points are passed.
/// If the scenario does not state whether change points are passed, change points are errors.
#[test]
fn a_drive_passes_change_points_only_on_request() {
    let cranks: Vec<f64> = (0..200).map(|k| 61.3 + 5.7 * f64::from(k)).collect();
    let all = [[0.4, 0.1, 0.4, 0.1], [0.3, 0.2, 0.2, 0.3], [0.2, 0.3, 0.3, 0.2], [0.5, 0.1, 0.25, 0.35]];
    for lengths in all {
        for left in [true, false] {
            let case = driven(lengths, left, 60.0, true, &cranks);
            let found = SIDES.map(|side| solve(side, &case));
            let off = apart(&found, |_| true);
            println!("{lengths:?} {left}: {off:.1e}");
            assert_within!(off, 1e-8, "{lengths:?} {left}: {off}");
            for side in SIDES {
                assert!(side.solve(&driven(lengths, left, 60.0, false, &cranks)).is_err(), "{}", side.name());
                // The motion from the same start in the opposite direction is tested too.
                let back: Vec<f64> = cranks.iter().map(|crank| 120.0 - crank).collect();
                let there = solve(side, &driven(lengths, left, 60.0, true, &back));
                assert_eq!(there.times().len(), back.len());
            }
        }
    }
    // In a parallelogram the rocker rotates with the crank through the whole revolution.
    let found = solve(&AssurSolver, &driven(all[0], true, 60.0, true, &cranks));
    for (crank, rocker) in column(&found, "link.crank.angle_rad").iter().zip(column(&found, "link.rocker.angle_rad")) {
        assert_within!((crank - rocker).abs(), 1e-12, "{crank} {rocker}");
    }
}

/// Velocities and accelerations are computed at the change point itself.
/// Reactions with a pole at the change point are refused with an error.
#[test]
fn a_change_point_itself_has_velocities_and_accelerations() {
    let case = driven([0.3, 0.2, 0.2, 0.3], true, 90.0, true, &[179.0, 180.0, 181.0]);
    for side in SIDES {
        let error = side.solve(&case).unwrap_err();
        assert!(error.message().contains("without bound"), "{error}");
        assert_eq!(error.kind(), ErrorKind::Numeric);
        assert_within!((error.input().unwrap().value.to_degrees() - 180.0).abs(), 1e-9, "{error}");
        let wanted = Wanted::of(&[Stage::Positions, Stage::Velocities, Stage::Accelerations]);
        let found = solve(side, &case.wanting(wanted));
        // At the change point, the angular velocity is a limit, which must be the mean of the values at the two
        // neighbouring poses.
        // The sides compute the limit from the branch equation, with the second derivatives of |AB|^2.
        let omega = column(&found, "link.rocker.omega_rad_s");
        assert_within!((omega[1] - 0.5 * (omega[0] + omega[2])).abs(), 1e-3, "{omega:?}");
    }
}

/// An invalid value of the key `through` is refused.
#[test]
fn invalid_values_of_through_are_refused() {
    let with = |value: &str| {
        let mut spec = four_bar([0.4, 0.1, 0.4, 0.1], true);
        spec.start = 1.0;
        spec.other.drive = format!("speed_rad_s = 10\nthrough = {value}\n");
        spec.scenario().map(|_| ()).unwrap_err()
    };
    for (value, part) in [("\"jump\"", "infinite forces"), ("\"left\"", "not a way to pass"), ("1", "through")] {
        let error = with(value);
        assert!(error.to_string().contains(part), "{error}");
        assert!(error.scenario_key().is_some_and(|key| key.contains("through")), "{error}");
    }
}

/// Without any engine setting, the proof ends with the verdict agree.
#[test]
fn the_benchmark_agrees_with_rapier() {
    for name in ["n_four_bar_1.toml", "n_four_bar_2.toml"] {
        let proof = prove(&shipped(name), &Options::default()).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(matches!(proof.verdict, Verdict::Agree { .. }), "{name}: {:?}", proof.verdict);
    }
}

/// A class III group that is singular where its two equal leads are in line with the plate.
/// The group is tested alone, and behind a parallelogram whose change points are 4.8 deg away from the group's change
/// point.
/// In a window of crank angles around each change point, the results come from polynomials through neighbouring poses.
/// Reactions have poles at the change points of the group and of the parallelogram.
#[test]
fn higher_groups_pass_their_change_points() {
    // For two close change points, the windows are ten times narrower than usual, so accelerations lose three digits.
    let texts = [
        (include_str!("through/level_triad.toml"), 1e-8, 1e-5),
        (include_str!("through/behind_parallelogram.toml"), 1e-5, 1e-3),
    ];
    for (text, smooth, poles) in texts {
        let driven = text.replace("initial_speed_rad_s = 9\nmotion = \"free\"\n", "through = \"smooth\"\n");
        for text in [text, driven.as_str()] {
            let scenario = Scenario::parse(text, Path::new("through.toml")).unwrap_or_else(|error| panic!("{error}"));
            let case = scenario.case;
            let found = SIDES.map(|side| solve(side, &case));
            let motion = apart(&found, |channel| channel.kind.stage <= Stage::Accelerations);
            let all = apart(&found, |_| true);
            println!("free {}: motion {motion:.1e}, all {all:.1e}", case.is_free());
            assert_within!(motion, smooth, "{motion}");
            // With reactions, the bound is wider: near a pole, the relative error of a reaction is the error of the
            // crank angle divided by the distance to the pole.
            assert_within!(all, poles, "{all}");
            if case.is_free() {
                for found in &found {
                    assert_within!(drift(&case, found), smooth, "{}", drift(&case, found));
                }
            }
        }
        // Without the key `through`, the motion is refused.
        let plain = driven.replace("through = \"smooth\"\n", "");
        let case = Scenario::parse(&plain, Path::new("through.toml")).unwrap_or_else(|error| panic!("{error}")).case;
        // The different steps put instants at different distances from the change point.
        // On the wrong branch, the determinant keeps its sign beyond the change point, so the sign reveals nothing.
        // Near the change point, the distance from the previous pose does not reveal the wrong branch either.
        for steps in [20.0f64, 30.0, 60.0, 37.0, 100.0, 200.0, 300.0, 731.0, 2000.0] {
            let times = (0..).map(|k| 0.6 * f64::from(k) / steps).take_while(|&t| t <= 0.6).collect();
            let case = case.on(Grid::of_times(case.crank(), times)).unwrap();
            for side in SIDES {
                let Err(error) = side.solve(&case) else { panic!("{} passes with {steps} steps", side.name()) };
                assert!(error.input().is_some(), "{error}");
            }
        }
    }
}

/// With several driving links, singular poses do not lie at isolated angles of the drives.
/// Both sides refuse to pass singular poses, in free motion too.
#[test]
fn several_driving_links_do_not_pass_change_points() {
    let other = "[links.other]\nmass_kg = 1\ninertia_kg_m2 = 0.083\nmass_centre = { x_m = 0.5, y_m = 0 }\n\
                 [links.other.points]\nP = { x_m = 0, y_m = 0 }\n[[joints]]\nname = \"P\"\ntype = \"revolute\"\n\
                 links = [\"ground\", \"other\"]\n[[joints]]";
    let drive = "[[drive]]\njoint = \"P\"\nmotion = \"free\"\nstart_deg = 10\nspeed_rad_s = 1\n[gravity]";
    let text = chain::text(1, 2.0, 0.1)
        .replacen("[ground.points]\n", "[ground.points]\nP = { x_m = 3, y_m = 0 }\n", 1)
        .replacen("[[joints]]", other, 1)
        .replacen("[drive]", "[[drive]]", 1)
        .replacen("[gravity]", drive, 1);
    let case = Scenario::parse(&text, Path::new("two.toml")).unwrap_or_else(|error| panic!("{error}")).case;
    for side in SIDES {
        let error = side.solve(&case).unwrap_err();
        let crank = error.input().unwrap_or_else(|| panic!("{error}")).value.to_degrees();
        assert_within!(crank.abs(), 0.5, "{}: {error}", side.name());
    }
    let text = text.replacen("joint = \"P\"\n", "joint = \"P\"\nthrough = \"smooth\"\n", 1);
    let error = Scenario::parse(&text, Path::new("two.toml")).unwrap_err();
    assert!(error.message().contains("one drive only"), "{error}");
}

/// The key that lets a drive pass change points.
const SMOOTH: &str = "through = \"smooth\"";

/// Channels requested for parallel cranks; reactions are omitted because they have a pole at the change points.
const MOTION: &str = "want = [\"positions\", \"velocities\", \"accelerations\"]";

/// Parallel cranks with a length ratio of two to five and a load on the coupler, over a whole revolution in steps of
/// `step` (deg).
/// `want` gives the requested channels; `through` is the key that lets the drive pass change points, or an empty text.
fn parallel_cranks(through: &str, want: &str, step: f64) -> Case {
    let mut spec = four_bar([0.127, 0.0508, 0.127, 0.0508], true);
    spec.links[0].mass = Some((0.5, Vec2::new(0.025, 0.0), 0.0003));
    spec.links[1].mass = Some((2.0, Vec2::new(0.076, 0.038), 0.004));
    spec.links[2].mass = Some((1.0, Vec2::new(0.114, 0.0), 0.005));
    spec.links[1].points.push(("P".into(), Vec2::new(0.13, 0.076)));
    spec.start = 90f64.to_radians();
    spec.grid = (spec.start, step.to_radians(), (360.0 / step) as usize);
    spec.dt = None;
    spec.other.drive = format!("speed_rpm = 100\n{through}");
    let load = "type = \"force\"\nlink = \"coupler\"\npoint = \"P\"\nx_N = 0\ny_N = -355.9";
    spec.other.sections = format!("[channels]\n{want}\n[[loads]]\n{load}\n");
    spec.scenario().unwrap_or_else(|error| panic!("{error}")).case
}

/// Symptom: if an instant of the grid was exactly at a change point, 16 of 51 numbers of the engine disagreed.
/// Cause: the engine's equations have many solutions at a change point, and the engine's rates at this instant were
/// judged.
#[test]
fn regress_an_instant_exactly_at_a_change_point_is_passed() {
    let case = parallel_cranks(SMOOTH, MOTION, 10.0);
    for side in SIDES {
        let found = side.solve(&case).unwrap();
        // The coupler of parallel cranks never rotates, not even at the change points (180 and 360 deg).
        for channel in ["link.coupler.omega_rad_s", "link.coupler.alpha_rad_s2"] {
            let values = column(&found, channel);
            assert_within!(values.iter().map(|value| value.abs()).fold(0.0, f64::larger), 1e-6, "{channel}");
        }
    }
    let proof = prove(&Scenario::of_case("parallel", case).unwrap(), &Options::default()).unwrap();
    assert_ne!(proof.verdict.word(), "disagree", "{:?}", proof.verdict);
    let engine = &proof.engines[0];
    let of = |name: &str| engine.channels.iter().find(|own| own.residual.channel.to_string() == name).unwrap().left_out;
    // Rates are left out only at the two change points; positions are judged everywhere.
    assert_eq!([of("point.P.x_m"), of("point.P.vx_m_s"), of("point.P.ax_m_s2")], [0, 2, 2]);
}

/// Symptom: the error at a change point said "shorten the grid" or "change a length", but did not mention `through`.
/// If a load would do work in a motion along the second branch, reactions have a pole at the change point.
/// If reactions are requested at the change point, the error names this pole.
#[test]
fn the_error_at_a_change_point_suggests_the_key_through() {
    for step in [10.0, 7.0] {
        let case = parallel_cranks("", MOTION, step);
        for side in SIDES {
            let error = side.solve(&case).unwrap_err();
            let way_out = error.way_out().unwrap();
            assert!(
                way_out.contains("`through = \"smooth\"` in [drive]"),
                "{}, {step}: {error}; {way_out}",
                side.name()
            );
        }
    }
    let reactions = "want = [\"reactions\"]";
    for side in SIDES {
        let error = side.solve(&parallel_cranks(SMOOTH, reactions, 10.0)).unwrap_err();
        assert!(error.message().contains("reactions grow without bound"), "{error}");
        assert!(error.way_out().unwrap().contains(MOTION), "{error}");
        side.solve(&parallel_cranks(SMOOTH, reactions, 7.0)).unwrap();
    }
}
