//! The figures that the project promises, measured on published mechanisms.

use crate::common::assert_within;
use std::path::Path;

use analytic::{AssurSolver, NewtonSolver, witness::power};
use approx::assert_abs_diff_eq;
use linkage::case::{Case, Grid};
use linkage::math::KeepNan;
use linkage::mechanism::JointId;
use linkage::solver::{Solver, State};
use linkage::trajectory::{Channel, Stage, Trajectory};
use prover::bounds::{Verdict, difference, residuals, scales};
use prover::run::{Options, Proof, prove};
use prover::tolerance::{BoundBasis, BoundOrigin};
use scenario::Scenario;

const ALL: [&str; 5] = ["crank_rocker", "ov7_base", "ov7_new", "ov7_new_tabulated", "fourth_class"];

fn scenario(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn solve(solver: &dyn Solver, case: &Case) -> Trajectory {
    solver.solve(case).unwrap_or_else(|error| panic!("{error}"))
}

fn proof(name: &str, step: Option<f64>) -> Proof {
    let options = step.map_or_else(Options::default, |step| Options::default().step(step));
    prove(&scenario(name), &options).unwrap()
}

/// A revolution in steps of a tenth of a degree, in the direction of the drive.
fn fine(case: &Case) -> Case {
    let sense = case.crank().sense();
    let cranks = (0..=3600).map(|k| (sense * f64::from(k) / 10.0).to_radians() + case.crank().start).collect();
    case.on(Grid::of_inputs(case.crank(), cranks)).unwrap()
}

#[test]
fn val_ov7_base_every_printed_number_by_both_sides() {
    let scenario = scenario("ov7_base");
    let cells: Vec<usize> =
        scenario.oracles.iter().map(|oracle| oracle.series.iter().map(|series| series.points.len()).sum()).collect();
    // The first three entries count positions, velocities and accelerations: five points in two directions at 13 crank
    // angles.
    // The next three entries count seven angles at each crank angle, and their first and second derivatives.
    // The last two entries are not published: a distance at the start, and one pose with its forces.
    assert_eq!(cells, [130, 130, 130, 91, 91, 91, 0, 84]);
    assert!(
        scenario.oracles.iter().all(|oracle| oracle.series.iter().all(|s| s.expected.is_empty() && s.wrong.is_none()))
    );

    let proof = proof("ov7_base", None);
    let published: Vec<_> = proof
        .checks
        .iter()
        .filter(|c| matches!(c.basis, BoundBasis::Digits { origin: BoundOrigin::Published, .. }))
        .collect();
    assert_eq!(published.len(), 2 * 51);
    for check in published {
        assert!(matches!(check.verdict, Verdict::Agree { .. }), "{}: {:?}", check.name(), check.verdict);
        // The bound is at most half a unit of the second printed decimal (positions in mm, angles in degrees).
        let half_unit: f64 = match check.unit {
            "m" => 0.005e-3,
            "rad" => 0.005f64.to_radians(),
            _ => 0.005,
        };
        // The factor 1 + 1e-6 allows for the rounding errors of the analytic sides.
        assert!(check.bound <= half_unit * (1.0 + 1e-6), "{}", check.name());
    }
}

#[test]
fn the_two_analytic_sides_agree_to_rounding_over_a_turn() {
    for name in ALL {
        let case = fine(&scenario(name).case);
        let (assur, newton) = (solve(&AssurSolver, &case), solve(&NewtonSolver, &case));
        for residual in residuals(&assur, &newton).unwrap() {
            let bound = match residual.channel.kind.stage {
                Stage::Positions => 1e-12,
                Stage::Velocities | Stage::Accelerations => 1e-11,
                Stage::Reactions | Stage::BalancingMoment => 1e-10,
            };
            assert_within!(residual.max, bound * residual.scale, "{name} {}: {:e}", residual.channel, residual.share());
        }
    }
}

#[test]
fn balancing_moment_from_equilibrium_and_from_powers() {
    for name in ALL {
        let case = fine(&scenario(name).case);
        for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
            let (mut amplitude, mut worst): (f64, f64) = (0.0, 0.0);
            let mut visit = |_: usize, state: &State| {
                amplitude = amplitude.larger(state.torques[0].abs());
                worst = worst.larger((state.torques[0] - power::balancing_moment(&case, state)).abs());
                Ok(())
            };
            solver.each(&case, &mut visit).unwrap();
            assert_within!(worst, 1e-11 * amplitude, "{name} {}: {:e}", solver.name(), worst / amplitude);
        }
    }
}

/// Synthesis from the two extreme positions: l_OB1 = l_OA + l_AB and l_OB2 = l_AB - l_OA.
#[test]
fn val_crank_rocker_lengths_follow_from_the_extreme_positions() {
    let scenario = scenario("crank_rocker");
    let mechanism = &scenario.case.mechanism;
    let length = |link: &str| mechanism.links()[mechanism.link_named(link).unwrap()].size();
    let distance = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        (0.15 + 0.25 * cos).hypot(0.015 + 0.25 * sin)
    };
    assert_abs_diff_eq!(length("crank"), (distance(50.0) - distance(82.0)) / 2.0, epsilon = 1e-14);
    assert_abs_diff_eq!(length("coupler"), (distance(50.0) + distance(82.0)) / 2.0, epsilon = 1e-14);

    let rocker = Channel::named("link.rocker.angle_rad").unwrap();
    let turn = solve(&AssurSolver, &fine(&scenario.case));
    let angles = turn.column(&rocker).unwrap();
    let (low, high) = angles.iter().fold((f64::MAX, f64::MIN), |(l, h), &a| (l.smaller(a), h.larger(a)));
    // Two samples are a tenth of a degree apart.
    // Near its extremes, the rocker rotates by less than 1e-6 rad between two samples, so a tolerance of 1e-4 deg is
    // enough.
    assert_abs_diff_eq!(low.to_degrees(), 50.0, epsilon = 1e-4);
    assert_abs_diff_eq!(high.to_degrees(), 82.0, epsilon = 1e-4);
}

#[test]
fn val_crank_rocker_mean_reduced_inertia_and_resistance() {
    let case = scenario("crank_rocker").case;
    for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
        let means = analytic::reduced::means::means_over_turn(&case, solver).unwrap();
        assert_abs_diff_eq!(means.inertia, 0.164846013, epsilon = 0.5e-9);
        // The exact mean is 100 N m times twice the swing, divided by one revolution.
        assert_abs_diff_eq!(means.resistance, 100.0 * 2.0 * 32.0 / 360.0, epsilon = 5e-5);
    }
}

/// Effect of the crank's printed mass and inertia on the mean reduced inertia (docs/findings.md).
/// No solver computes a mass, but a wrong mass or inertia changes this mean.
#[test]
fn val_crank_rocker_printed_mass_and_inertia_show_in_the_mean_reduced_inertia() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let mean = |changes: &[(&str, &str)], solver: &dyn Solver| {
        let wrong = changes.iter().fold(text.clone(), |text, (from, to)| {
            assert_eq!(text.matches(from).count(), 1, "{from}");
            text.replace(from, to)
        });
        analytic::reduced::means::means_over_turn(&Scenario::parse(&wrong, &path).unwrap().case, solver)
            .unwrap()
            .inertia
    };
    // Two wrong moments of inertia of the crank: `heavy` is m l^2 / 12 with 22.6 kg, `listed` is m l^2 / 5 with 2.6 kg.
    let mass = ("mass_kg = 2.6", "mass_kg = 22.6");
    let [heavy, listed] = ["inertia_kg_m2 = 0.0012727", "inertia_kg_m2 = 0.00035"]
        .map(|to| ("inertia_kg_m2 = 0.00014641741001640535", to));
    for solver in analytic::all() {
        assert_abs_diff_eq!(mean(&[mass], solver), 0.168225, epsilon = 0.5e-6);
        assert_abs_diff_eq!(mean(&[mass, heavy], solver), 0.169351, epsilon = 0.5e-6);
        assert_abs_diff_eq!(mean(&[listed], solver), 0.165050, epsilon = 0.5e-6);
    }
}

/// Largest error in the given stages, divided by the channel's scale.
/// Among positions, only angles count.
fn worst_share(reference: &Trajectory, run: &Trajectory, wanted: &[Stage]) -> f64 {
    let errors = difference(reference, run).unwrap();
    let shares = errors.iter().zip(scales(reference)).filter(|((channel, _), _)| {
        wanted.contains(&channel.kind.stage)
            && !(channel.kind.stage == Stage::Positions && channel.kind.suffix != "angle_rad")
    });
    shares.map(|((_, e), scale)| e.iter().fold(0.0f64, |m, x| m.larger(x.abs())) / scale).fold(0.0, f64::larger)
}

#[test]
fn rapier_is_within_a_thousandth_and_converges_a_hundredfold() {
    let case = scenario("crank_rocker").case;
    let reference = solve(&AssurSolver, &case);
    let stages = [Stage::Positions, Stage::Reactions, Stage::BalancingMoment];
    let error = |step| {
        worst_share(&reference, &solve(prover::engines::named("rapier", step).unwrap().as_ref(), &case), &stages)
    };
    let [coarse, fine] = [1e-3, 1e-4].map(error);
    assert_within!(coarse, 1e-3, "{coarse:e}");
    assert_within!(fine, 1e-5, "{fine:e} against {coarse:e}");
    assert_within!(fine, coarse / 95.0, "{fine:e} against {coarse:e}");
}

#[test]
fn rapier_shows_second_order_in_every_channel_of_both_mechanisms() {
    for name in ALL {
        let degrees: f64 = match name {
            "crank_rocker" | "ov7_base" => 0.78,
            "fourth_class" => 0.25,
            _ => 0.39,
        };
        let step = degrees.to_radians() / scenario(name).case.crank().top_speed().abs();
        let proof = proof(name, Some(step));
        assert!(matches!(proof.verdict, Verdict::Agree { .. }), "{name}: {:?}", proof.verdict);
        let orders: Vec<(String, f64)> = proof
            .engine()
            .channels
            .iter()
            .filter(|c| !c.convergence.observed.is_nan())
            .map(|c| (c.residual.channel.to_string(), c.convergence.observed))
            .collect();
        // Only the motion of the crank and of its points is exact, so only these channels have no observed order.
        assert!(
            orders.len() * 10 > proof.engine().channels.len() * 7,
            "{name}: {} of {}",
            orders.len(),
            proof.engine().channels.len()
        );
        for (channel, order) in orders {
            assert_within!((order - 2.0).abs(), 0.1, "{name} {channel}: {order}");
        }
    }
}

/// Motor law, gear ratio and resistance of the published course.
/// The printed speeds follow only if the resistance is divided by the gear ratio twice.
#[test]
fn val_crank_rocker_steady_speed() {
    let scenario = scenario("crank_rocker");
    let (ratio, a, b): (f64, f64, f64) = (2745.0 / 130.0, 22.51, 0.0716);
    // The closure solves i (a - b i omega) = M for the speed omega.
    let speed = |resistance: f64| (a - resistance / ratio) / (b * ratio);
    for solver in analytic::all() {
        let mean = analytic::reduced::means::means_over_turn(&scenario.case, solver).unwrap().resistance;
        assert_within!((speed(mean) - 14.33204).abs(), 0.5e-5, "{mean}");
        assert_within!((ratio * speed(mean) - 302.6266).abs(), 0.5e-4, "{mean}");
    }
    // The printed speeds follow from the law before its coefficients were rounded.
    let (a, b) = (22.50986, 0.071_651_1);
    let twice = (a - 17.76 / (ratio * ratio)) / b;
    assert_within!((twice - 313.6).abs(), 0.05, "{twice}");
    assert_within!((twice / ratio - 14.85).abs(), 0.005, "{twice}");
}

/// The headings of the findings as anchors.
pub(crate) fn anchors() -> Vec<String> {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/findings.md")).unwrap();
    let anchor = |heading: &str| {
        let kept = |c: &char| c.is_alphanumeric() || " -_".contains(*c);
        heading.to_lowercase().chars().filter(kept).collect::<String>().replace(' ', "-")
    };
    text.lines().filter_map(|line| line.strip_prefix("### ")).map(anchor).collect()
}

#[test]
fn every_expected_disagreement_has_its_finding() {
    let anchors = anchors();
    for (name, numbers) in [("crank_rocker", 6), ("ov7_new", 5), ("ov7_new_tabulated", 19)] {
        let degrees: f64 = match name {
            "crank_rocker" | "ov7_base" => 0.78,
            "fourth_class" => 0.25,
            _ => 0.39,
        };
        let step = degrees.to_radians() / scenario(name).case.crank().top_speed().abs();
        let proof = proof(name, Some(step));
        assert!(matches!(proof.verdict, Verdict::Agree { .. }), "{name}: {:?}", proof.verdict);
        let expected: Vec<&String> = proof
            .checks
            .iter()
            .filter_map(|check| match &check.verdict {
                Verdict::Expected { finding, .. } => Some(finding),
                _ => None,
            })
            .collect();
        assert_eq!(expected.len(), 2 * numbers, "{name}, each number on both sides");
        for finding in expected {
            assert!(anchors.contains(finding), "{finding} is not in docs/findings.md: {anchors:?}");
        }
    }
}

/// The proof of the crank-rocker after a change of one oracle: the rocker angle of 50 deg.
/// The oracle then states the number `printed`, a finding that calls this number wrong, and the correct number `right`.
fn with_correction(printed: f64, right: f64) -> Proof {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let value = r#"{ channel = "link.rocker.angle_deg", value = 50, digits = 9 }"#;
    let correction = format!(
        r#"{{ channel = "link.rocker.angle_deg", value = {printed}, digits = 9, finding = "x", right = {{ value = {right}, digits = 9 }} }}"#
    );
    let wrong = text.replace(value, &correction);
    assert_ne!(text, wrong);
    let scenario = Scenario::parse(&wrong, &path).unwrap();
    prove(&scenario, &Options::default()).unwrap()
}

#[test]
fn known_wrong_numbers_disagree_and_their_corrections_agree() {
    assert_eq!(with_correction(51.0, 50.0).verdict.word(), "agree");
    // First case: the printed number agrees, although the finding calls it wrong.
    // Second case: neither number agrees; the number given as correct is off by two units of its last digit.
    for (printed, right, words) in [(50.0, 51.0, "but the number agrees"), (51.0, 50.000_000_002, "are both wrong")] {
        match with_correction(printed, right).verdict {
            Verdict::Disagree { place } => assert!(place.contains(words), "{place}"),
            other => panic!("{other:?}"),
        }
    }
}

/// A solved length is compared with the length in the file.
/// If the coupler is longer by a unit of the twelfth digit, the oracle of the length disagrees.
#[test]
fn a_solved_length_is_checked_to_its_last_digit() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let longer = text.replace("B = { x_m = 0.34707193189181,", "B = { x_m = 0.34707193189281,");
    assert_ne!(text, longer);
    let proof = prove(&Scenario::parse(&longer, &path).unwrap(), &Options::default()).unwrap();
    let wrong: Vec<String> = proof
        .checks
        .iter()
        .filter(|check| check.verdict.word() == "disagree")
        .map(prover::bounds::Check::name)
        .collect();
    for side in ["assur", "newton"] {
        let name = format!("published lengths, known to be wrong ({side}), distance_m of A B");
        assert!(wrong.contains(&name), "{wrong:?}");
    }
}

/// The authors' formula for the moment on the crank uses only one component of the reaction at joint 2.
/// The component in the formula is perpendicular to link 2-3.
#[test]
fn val_ov7_new_printed_r1_and_moment_come_from_half_a_reaction() {
    let case = fine(&scenario("ov7_new_tabulated").case);
    let printed = [170.13, 220.93, 212.23, 128.99, 20.9, 142.67, 220.34, 227.77, 180.22, 101.93, 17.84, 87.63];
    let (mut largest_force, mut largest, mut first): (f64, f64, f64) = (0.0, 0.0, 0.0);
    let mut visit = |row: usize, state: &State| {
        let mechanism = &case.mechanism;
        let (crank, lead) = (mechanism.link_named("crank").unwrap(), mechanism.link_named("lead_23").unwrap());
        // Joint 2 names the crank first and the lead second, so the force on the crank is opposite to the force of the
        // joint.
        let whole = -state.forces[mechanism.joint_named("2").unwrap()];
        let along = state.motions[lead].direction;
        let half = whole - along * along.dot(&whole);
        let body = &mechanism.links()[crank];
        let motion = &state.motions[crank];
        let inertial = (case.gravity - motion.point_acceleration(body.mass_centre)) * body.mass;
        let r1 = half + inertial;
        if row.is_multiple_of(300) && row < 3600 {
            assert_abs_diff_eq!(r1.norm(), printed[row / 300], epsilon = 0.02);
        }
        largest_force = largest_force.larger(r1.norm());
        let arm = motion.arm(mechanism.joints()[JointId(1)].first.local);
        let centre = motion.arm(body.mass_centre);
        let moment = -(arm.perp(&half) + centre.perp(&inertial));
        largest = largest.larger(moment.abs());
        if row == 0 {
            first = moment;
        }
        Ok(())
    };
    AssurSolver.each(&case, &mut visit).unwrap();
    // The printed -5.831 is the moment of the forces on the crank, not the moment that balances it.
    assert_abs_diff_eq!(-first, -5.831, epsilon = 0.5e-3);
    // Printed maxima over the revolution; they occur between the twelve angles of the table.
    assert_abs_diff_eq!(largest, 6.34, epsilon = 5e-3);
    assert_abs_diff_eq!(largest_force, 232.74, epsilon = 0.02);
}

#[test]
fn val_fourth_class_branch_closes_after_a_turn() {
    let case = scenario("fourth_class").case;
    let turn = solve(&AssurSolver, &case);
    for (channel, values) in turn.iter().filter(|(channel, _)| channel.of != "crank") {
        let (first, last) = (values[0], values[values.len() - 1]);
        let size = values.iter().fold(0.0f64, |max, v| max.larger(v.abs()));
        assert_within!((first - last).abs(), 1e-11 * size, "{channel}: {first} {last}");
    }
}
