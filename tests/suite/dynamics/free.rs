//! Free motion: the two analytic sides against each other, against textbook equations, and against the Rapier engine.

use analytic::{AssurSolver, NewtonSolver};
use linkage::case::{Case, Grid, Wanted};
use linkage::drive::{DriveMotion, Motor};
use linkage::engine::{Engine, Route, Settings};
use linkage::error::Advice;
use linkage::math::statistics::largest_difference;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{LinkId, Mechanism};
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Stage, Trajectory, Unit};
use prover::bounds::{Verdict, residuals};
use prover::engines::EngineName;
use prover::run::{Options, prove};
use scenario::Scenario;

use crate::common::{assert_within, shipped};

pub(super) fn solve(solver: &dyn Solver, case: &Case) -> Trajectory {
    solver.solve(case).unwrap_or_else(|error| panic!("{}: {error}", solver.name()))
}

/// Largest error divided by the scale, over the channels that `of` selects.
pub(super) fn worst(reference: &Trajectory, other: &Trajectory, of: impl Fn(&Channel) -> bool) -> f64 {
    let all = residuals(reference, other).unwrap();
    let picked = all.iter().filter(|residual| of(&residual.channel));
    picked.map(|residual| residual.share()).fold(0.0, f64::larger)
}

pub(super) fn column<'a>(trajectory: &'a Trajectory, name: &str) -> &'a [f64] {
    trajectory.column(&Channel::named(name).unwrap()).unwrap_or_else(|| panic!("no channel {name}"))
}

const RUN_UPS: [&str; 9] = [
    "crank_rocker_runup",
    "crank_rocker_runup_published",
    "averaged_run_up",
    "ov7_new_runup",
    "compressor_runup",
    "pendulum",
    "double_pendulum",
    "five_bar_on_a_spring",
    "swinging_parallelogram",
];

/// Motions through change points.
const CHAINS: [&str; 2] = ["n_four_bar_1", "n_four_bar_2"];

/// Both sides are compared from positions to reactions.
/// Side 1 uses the reduced equation of motion, or transfer functions group by group.
/// Side 2 uses the embedding with the Jacobian of the whole mechanism.
#[test]
fn both_sides_agree_in_every_channel() {
    for name in RUN_UPS {
        let case = shipped(&format!("{name}.toml")).case;
        let found = worst(&solve(&AssurSolver, &case), &solve(&NewtonSolver, &case), |_| true);
        println!("{name}: {found:.1e}");
        assert_within!(found, 1e-10, "{name}: {found:e}");
    }
    for name in CHAINS {
        let case = shipped(&format!("{name}.toml")).case;
        let found = worst(&solve(&AssurSolver, &case), &solve(&NewtonSolver, &case), |_| true);
        println!("{name}: {found:.1e}");
        assert_within!(found, 1e-8, "{name}: {found:e}");
    }
}

/// The lists `RUN_UPS` and `CHAINS` contain every shipped free motion.
/// The comparison of both sides over these lists therefore omits no free motion.
#[test]
fn every_shipped_free_motion_is_compared() {
    let directory = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
    let files = std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path());
    let scenarios = files.filter(|path| path.extension().is_some_and(|end| end == "toml"));
    for scenario in scenarios.map(|path| Scenario::load(&path).unwrap()).filter(|s| s.case.crank().is_free()) {
        let listed = RUN_UPS.iter().chain(&CHAINS).any(|name| *name == scenario.name);
        assert!(listed, "{} is a free motion, and no test compares its two sides", scenario.name);
    }
}

/// A damper without effect makes side 1 use the transfer functions of its groups instead of the reduced equation of
/// motion.
/// The two methods agree.
#[test]
fn both_methods_of_side_1_agree() {
    for name in ["crank_rocker_runup", "compressor_runup"] {
        let case = shipped(&format!("{name}.toml")).case;
        let damper = linkage::drive::Load::TorsionDamper { links: [LinkId(0), LinkId(1)], damping: 0.0 };
        let damped = case.with(|parts| parts.loads.push(damper)).unwrap();
        let found = worst(&solve(&AssurSolver, &case), &solve(&AssurSolver, &damped), |_| true);
        assert_within!(found, 1e-10, "{name}: {found:e}");
    }
}

/// Two rods of length l and mass m, with Lagrange's equations for their angles from the vertical, as in textbooks.
/// The test integrates Lagrange's equations with classical Runge-Kutta steps.
#[test]
fn the_double_pendulum_obeys_lagranges_equations() {
    let case = shipped("double_pendulum.toml").case;
    let (m, l, g) = (1.0, 0.5, 9.80665);
    let rates = |[a, b, u, v]: [f64; 4]| {
        let (c, s) = ((a - b).cos(), (a - b).sin());
        // The first equation is (4/3) a'' + (1/2) cos(a - b) b'' = -(1/2) sin(a - b) b'^2 - (3/2) (g / l) sin a.
        // The second equation has the same form; both equations are divided by m l^2.
        let (p, q, r) = (4.0 / 3.0, 0.5 * c, 1.0 / 3.0);
        let first = -0.5 * s * v * v - 1.5 * g / l * a.sin();
        let second = 0.5 * s * u * u - 0.5 * g / l * b.sin();
        let determinant = p * r - q * q;
        [u, v, (r * first - q * second) / determinant, (p * second - q * first) / determinant]
    };
    let mut y = [75f64.to_radians(), 40f64.to_radians(), 0.0, 0.0];
    let energy = |[a, b, u, v]: [f64; 4]| {
        let kinetic = m * l * l * (2.0 / 3.0 * u * u + 0.5 * (a - b).cos() * u * v + v * v / 6.0);
        kinetic - m * g * l * (1.5 * a.cos() + 0.5 * b.cos())
    };
    let begun = energy(y);
    let found = solve(&NewtonSolver, &case);
    let (upper, lower) = (column(&found, "link.upper.angle_rad"), column(&found, "link.lower.angle_rad"));
    let quarter = std::f64::consts::FRAC_PI_2;
    let (parts, h) = (100, 0.005 / 100.0);
    let mut farthest = 0.0f64;
    for row in 0..found.times().len() {
        farthest = farthest.larger((upper[row] + quarter - y[0]).abs()).larger((lower[row] + quarter - y[1]).abs());
        for _ in 0..parts {
            let step = |y: [f64; 4], k: [f64; 4], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
            let k1 = rates(y);
            let k2 = rates(step(y, k1, h / 2.0));
            let k3 = rates(step(y, k2, h / 2.0));
            let k4 = rates(step(y, k3, h));
            y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        }
    }
    assert_within!((energy(y) - begun).abs(), 1e-10, "the textbook's side: {:e}", energy(y) - begun);
    println!("double pendulum: {farthest:.1e} rad");
    assert_within!(farthest, 1e-9, "{farthest:e}");
}

/// Sum of kinetic and potential energy (J) at every instant, computed from the channels alone.
pub(super) fn energies(case: &Case, found: &Trajectory) -> Vec<f64> {
    let of = |row: usize| {
        let links = case.mechanism.links()[1..].iter();
        links
            .map(|link| {
                let at = |quantity: &str| column(found, &format!("link.{}.{quantity}", link.name))[row];
                let (place, velocity) = (Vec2::new(at("x_m"), at("y_m")), Vec2::new(at("vx_m_s"), at("vy_m_s")));
                0.5 * (link.mass * velocity.norm_squared() + link.inertia * at("omega_rad_s").powi(2))
                    - link.mass * case.gravity.dot(&place)
            })
            .sum()
    };
    (0..found.times().len()).map(of).collect()
}

/// Both sides over ten seconds of a motion that becomes chaotic.
/// The solutions of the two sides may separate, but the energy of each solution must stay constant.
#[test]
fn several_degrees_of_freedom_conserve_energy() {
    let case = shipped("double_pendulum.toml").case;
    let grid = Grid::of_times(case.crank(), (0..=1000).map(|k| f64::from(k) * 0.01).collect());
    let case = case.on(grid).unwrap().wanting(Wanted::of(&[Stage::Positions, Stage::Velocities]));
    for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
        let energies = energies(&case, &solve(solver, &case));
        let drift = energies.iter().map(|energy| (energy - energies[0]).abs()).fold(0.0, f64::larger);
        let drift = drift / (1.5 * 9.80665);
        println!("{}: energy kept to {drift:.1e}", solver.name());
        assert_within!(drift, 1e-9, "{}: {drift:e}", solver.name());
    }
}

/// Step of the engines (s).
const STEP: f64 = 1e-4;

pub(super) fn twin(name: &str, settings: impl Fn(Settings) -> Settings) -> Box<dyn Engine> {
    let engine = prover::engines::named(name, STEP).unwrap();
    engine.with(settings(engine.settings()))
}

/// The run-up of the complete design problem with a step of 1e-4 s.
/// Without extrapolation the method has first order.
/// With extrapolation, the errors of angles are below 1e-6 rad.
/// After the start, the errors of forces are then below 1e-5 of the range of forces.
#[test]
fn twin_run_ups_are_of_order_one_and_extrapolate_accurately() {
    let scenario = shipped("crank_rocker_runup.toml");
    let begun = (0..=100).map(|k| f64::from(k) * 1e-3).collect();
    let begun = scenario.case.on(Grid::of_times(scenario.case.crank(), begun)).unwrap();
    let angle = |channel: &Channel| channel.kind.unit == Unit::Radian;
    let force = |channel: &Channel| channel.kind.stage >= Stage::Reactions;
    // The impulse build needs thousands of sweeps, so it simulates only a fifth of the run-up.
    for (name, route, case) in [
        ("rapier", Route::Differences, &scenario.case),
        ("rapier", Route::Native, &scenario.case),
        ("impulse", Route::Differences, &begun),
    ] {
        let reference = solve(&AssurSolver, case);
        let at = |resolution: f64, extrapolated: usize| {
            let engine = twin(name, |own| Settings { resolution, extrapolated, route, ..own });
            solve(engine.as_ref(), case)
        };
        let [coarse, fine] = [2e-4, 1e-4].map(|step| at(step, 0));
        for picked in [&angle as &dyn Fn(&Channel) -> bool, &force] {
            let ratio = worst(&reference, &coarse, picked) / worst(&reference, &fine, picked);
            assert_within!((ratio.log2() - 1.0).abs(), 0.05, "{name} {}: order {}", route.name(), ratio.log2());
        }
        let best = at(1e-4, 1);
        let crank = residuals(&reference, &best).unwrap();
        let most = crank.iter().filter(|r| angle(&r.channel)).map(|r| r.max).fold(0.0, f64::larger);
        let forces = worst(&reference, &best, force);
        println!("{name} {}: {most:.1e} rad, {forces:.1e} of the range of forces", route.name());
        assert_within!(most, 1e-6, "{name} {}: {most:e} rad, {forces:e}", route.name());
        // At the start, forces are extrapolated from the forces of later steps: there the bound is wider.
        assert_within!(forces, 4e-5, "{name} {}: {most:e} rad, {forces:e}", route.name());
        let forces = crank.iter().filter(|residual| force(&residual.channel) && residual.max > 0.0);
        let later = forces.map(|residual| {
            let values = [&reference, &best].map(|run| &run.column(&residual.channel).unwrap()[1..]);
            largest_difference(values[0], values[1], false) * residual.share() / residual.max
        });
        let later = later.fold(0.0, f64::larger);
        assert_within!(later, 1e-5, "{name} {}: {later:e} after the start", route.name());
    }
}

/// The case has neither rotor nor flywheel inertia.
/// A second pass of Rapier over the constraints, after each step, would multiply the error by 23.
/// The pass would remove the part of the velocities that corrects the gaps of the joints.
/// The bodies have moved with this part during the step, so it must stay.
#[test]
fn the_twin_keeps_the_velocities_that_moved_it() {
    let scenario = shipped("crank_rocker_runup.toml");
    let motor = Motor { inertia: Default::default(), ..scenario.case.crank().motor().unwrap().clone() };
    let case = scenario.case.with_motor(Some(motor)).unwrap();
    let reference = solve(&AssurSolver, &case);
    let angle = |channel: &Channel| channel.kind.unit == Unit::Radian;
    let settings = |own| Settings { resolution: 5e-4, extrapolated: 1, sweeps: 16, ..own };
    let found = solve(twin("rapier", settings).as_ref(), &case);
    let worst = worst(&reference, &found, angle);
    assert_within!(worst, 3e-5, "{worst:e}");
}

/// Without rotor and flywheel, the inertia reduced to the crank almost vanishes at one crank angle.
/// The crank passes the angle of vanishing inertia so fast that the passage lasts about one step.
/// The proof must be inconclusive; the verdict disagree would be wrong.
#[test]
fn an_ill_conditioned_run_up_is_inconclusive_with_its_sensitivity() {
    let mut scenario = shipped("crank_rocker_runup.toml");
    let motor = Motor { inertia: Default::default(), ..scenario.case.crank().motor().unwrap().clone() };
    scenario.case = scenario.case.with_motor(Some(motor)).unwrap();
    // The published numbers are valid for a different motor, so they are removed.
    scenario.oracles.clear();
    let proof = prove(&scenario, &Options::default().engine(EngineName::Rapier).step(1e-4)).unwrap();
    assert!(matches!(proof.verdict, Verdict::Inconclusive { .. }), "{:?}", proof.verdict);
    let unclear: Vec<_> = proof.engine().channels.iter().filter(|c| c.verdict.word() == "inconclusive").collect();
    assert!(!unclear.is_empty());
    for channel in unclear {
        let Verdict::Inconclusive { reason, .. } = &channel.verdict else { unreachable!() };
        assert!(reason.contains("increasing gravity and motor torque"), "{reason}");
        assert!(channel.sensitivity.unwrap() > 1e-3);
    }
    assert!(proof.engine().channels.iter().all(|channel| channel.verdict.word() != "disagree"));
}

/// A crank released with an initial speed: in both builds all links start with velocities that match this speed.
#[test]
fn the_twin_starts_at_a_given_speed() {
    let mut scenario = shipped("crank_rocker_runup.toml");
    let case = scenario.case.with(|parts| match &mut parts.drives.crank_mut().motion {
        DriveMotion::Free { initial_speed, .. } => *initial_speed = 9.0,
        motion @ DriveMotion::Prescribed { .. } => panic!("{motion:?}"),
    });
    scenario.case = case.unwrap();
    let case = scenario.case.on(Grid::of_times(scenario.case.crank(), vec![0.0, 0.002, 0.05, 0.1])).unwrap();
    let reference = solve(&AssurSolver, &case);
    assert_within!((column(&reference, "link.crank.omega_rad_s")[0] - 9.0).abs(), 1e-14);
    // The measured errors are 8.5e-6 for `rapier` and 3.1e-4 for `impulse`.
    // The separate bodies of the impulse build start with a gap in every joint.
    // The gap causes an error that is larger than the error that extrapolation removes.
    for (name, bound) in [("rapier", 2e-5), ("impulse", 1e-3)] {
        let engine = twin(name, |settings| Settings { extrapolated: 1, ..settings });
        let found = worst(&reference, &solve(engine.as_ref(), &case), |_| true);
        println!("{name} from a speed: {found:.1e}");
        assert_within!(found, bound, "{name}: {found:e}");
    }
}

#[test]
fn invalid_requests_to_a_free_motion_are_refused() {
    let scenario = shipped("crank_rocker_runup.toml");
    let case = &scenario.case;
    let before = case.on(Grid::of_times(case.crank(), vec![-0.1, 0.0])).unwrap();
    let motor = Motor { ratio: 0.1, ..case.crank().motor().unwrap().clone() };
    let held = case.with_motor(Some(motor)).unwrap();
    let sides: [(&dyn Solver, &str); 2] =
        [(&AssurSolver, "the loads stall the mechanism at t = "), (&NewtonSolver, "at rest at t = ")];
    for (solver, words) in sides {
        let error = solver.solve(&held).unwrap_err();
        assert!(error.message().contains(words), "{}: {error}", solver.name());
        assert!(error.way_out().unwrap().contains("torque"), "{error}");
    }
    // All solvers refuse an instant before the start of a free motion.
    // Some engines also refuse a link without inertia.
    let mut links = case.mechanism.links().to_vec();
    let coupler = case.mechanism.link_named("coupler").unwrap();
    links[coupler].inertia = 0.0;
    let mechanism = Mechanism::new(links, case.mechanism.joints().to_vec()).unwrap();
    let bare = case.with(|parts| parts.mechanism = mechanism).unwrap();
    let extrapolated = twin("rapier", |settings| Settings { extrapolated: 1, ..settings });
    let engines: Vec<_> = prover::engines::all(STEP).into_iter().chain([extrapolated]).collect();
    let solvers = engines.iter().map(|engine| engine.as_ref() as &dyn Solver);
    for solver in solvers.clone().chain([&AssurSolver as &dyn Solver, &NewtonSolver]) {
        let error = solver.solve(&before).unwrap_err();
        assert!(error.message().contains("an instant at -0.1 s"), "{}: {error}", solver.name());
    }
    for solver in solvers.filter(|solver| solver.name().ends_with("-f32") || solver.name() == "simbody") {
        let error = solver.solve(&bare).unwrap_err();
        assert!(error.message().contains("link \"coupler\" has no mass or no moment"), "{}: {error}", solver.name());
    }
    let probe = twin("rapier", |settings| Settings { route: Route::Probe, ..settings });
    let error = probe.solve(&scenario.case).unwrap_err();
    assert_eq!(error.advice(), [Advice::OtherRoute { routes: &["differences", "native"] }], "{error}");
}
