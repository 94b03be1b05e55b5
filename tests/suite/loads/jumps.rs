//! Loads whose law changes when a motion reverses: the load either jumps at the reversal or only has a kink.

use linkage::engine::Route;
use linkage::trajectory::Stage;
use prover::run::{Options, Proof, prove};
use scenario::Scenario;

use crate::common::{assert_within, from_outside, shipped, states};

/// For the pendulum under a load: the largest number of instants left out of a channel.
fn left_out(load: &str) -> usize {
    let path = shipped("pendulum.toml").path;
    let text = std::fs::read_to_string(&path).unwrap();
    let text = text.strip_suffix(from_outside(&text)).unwrap();
    let scenario =
        Scenario::parse(&format!("{text}[[loads]]\n{load}\n"), &path).unwrap_or_else(|error| panic!("{error}"));
    let proof = prove(&scenario, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(proof.verdict.word(), "agree", "{load}");
    proof.engine().channels.iter().map(|channel| channel.left_out).max().unwrap()
}

/// The pendulum reverses at 150 deg to either side of its lowest position.
#[test]
fn only_instants_at_a_load_jump_are_left_out() {
    let table = |away: f64| {
        format!(
            "type = \"moment\"\nlink = \"rod\"\nacts = \"clockwise\"\ntable = [{{ crank_deg = -40, moment_N_m = {away} }}, \
             {{ crank_deg = 0, moment_N_m = 1 }}, {{ crank_deg = 40, moment_N_m = {away} }}]"
        )
    };
    let none = left_out(&table(0.0));
    assert_eq!(left_out("type = \"resistance\"\nlink = \"rod\"\nmoment_N_m = 0"), none);
    for jumping in [table(0.5), "type = \"resistance\"\nlink = \"rod\"\nmoment_N_m = 0.5".into()] {
        assert!(left_out(&jumping) > none, "{jumping}");
    }
}

/// Proof of the crank-rocker on a given grid, without its published numbers.
/// The rocker has a resistance, and reverses at the two crank angles that the scenario states.
fn rocker(grid: &str, options: &Options) -> Proof {
    let path = shipped("crank_rocker.toml").path;
    let text = std::fs::read_to_string(&path).unwrap();
    let text = &text[..text.find("[[oracle]]").unwrap()];
    let text = text.replace("from_deg = 0\nto_deg = 360\nstep_deg = 1\n", grid);
    prove(&Scenario::parse(&text, &path).unwrap(), options).unwrap_or_else(|error| panic!("{error}"))
}

/// For all channels of one stage: the largest number of instants left out of a channel.
fn left_out_in(proof: &Proof, stage: Stage) -> usize {
    let own = proof.engine().channels.iter().filter(|own| own.residual.channel.kind.stage == stage);
    own.map(|own| own.left_out).max().unwrap()
}

/// Exactly at a reversal, the sign of the speed is determined by rounding error.
/// The analytic sides and the runs find different signs, so the forces of a resistance differ by twice the resistance.
/// Only the instant of the reversal is left out; at all judged instants, the forces agree.
#[test]
fn forces_are_not_judged_where_the_runs_reverse_at_another_instant() {
    let grid = "angles_deg = [0, 20, 33.6108197898815586, 50, 90, 120, 150, 180, 210, 240, 270, 300, 330]\n";
    let proof = rocker(grid, &Options::default().step(2e-3).sweeps(16).extrapolated(0));
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
    assert_eq!([Stage::Accelerations, Stage::Reactions].map(|stage| left_out_in(&proof, stage)), [0, 1]);
}

/// In a prescribed motion, a resistance makes the forces jump, but not the accelerations.
#[test]
fn a_prescribed_acceleration_is_judged_where_a_load_jumps() {
    // The angles 33.3 and 33.9 deg are close to the reversal.
    // The extrapolation combines the impulses of several runs, in which the resistance may have different signs there.
    let grid = "angles_deg = [0, 30, 33.3, 33.9, 60, 120, 180, 240, 300]\n";
    let proof = rocker(grid, &Options::default().step(2e-3).sweeps(16).extrapolated(1).route(Route::Probe));
    let [accelerations, forces] = [Stage::Accelerations, Stage::Reactions].map(|stage| left_out_in(&proof, stage));
    assert_eq!([accelerations, forces], [0, 2]);
}

/// A moment on the rocker.
/// The moment jumps at a crank angle of 90 deg, which is an instant of the grid, and at the end of its period.
const TABLE: &str = "[[loads]]\ntype = \"moment\"\nlink = \"rocker\"\ntable = [{ crank_deg = 0, moment_N_m = 5 }, \
    { crank_deg = 90, moment_N_m = 10 }, { crank_deg = 90, moment_N_m = -40 }, { crank_deg = 360, moment_N_m = 30 }]\n";

/// A scenario with the table in place of its resistance.
fn with_table(name: &str, grid: &str) -> Scenario {
    let path = shipped(name).path;
    let text = std::fs::read_to_string(&path).unwrap();
    let text = &text[..text.find("[[oracle]]").unwrap()];
    let [loads, start, end] = ["[[loads]]", "[start]", "[grid]"].map(|section| text.find(section).unwrap());
    let text = format!("{}{TABLE}{}[grid]\n{grid}", &text[..loads], &text[start..end]);
    Scenario::parse(&text, &path).unwrap_or_else(|error| panic!("{error}"))
}

/// At the crank angle of a jump, the second value applies on both analytic sides.
#[test]
fn val_a_table_jumps_at_its_crank_angle() {
    let case = with_table("crank_rocker.toml", "angles_deg = [0, 89.99999, 90, 90.00001, 180, 359.99999, 360]\n").case;
    for solver in analytic::all() {
        let found = states(solver, &case, &case.grid.times).unwrap();
        let rocker = case.mechanism.link_named("rocker").unwrap();
        let mut wrenches = vec![linkage::drive::Wrench::ZERO; case.mechanism.links().len()];
        let moments = found.iter().map(|state| {
            case.loads_on(&state.motions, &state.angles, &mut wrenches);
            wrenches[rocker].moment
        });
        let expected = [5.0, 10.0, -40.0, -40.0, -40.0 + 70.0 / 3.0, 30.0, 5.0];
        for (moment, expected) in moments.zip(expected) {
            assert_within!((moment - expected).abs(), 1e-4, "{}: {expected}", solver.name());
        }
    }
}

/// The engine is not judged at instants at which its crank and the reference's crank are on different sides of the
/// jump.
/// In the free motion, side 1 reduces the mechanism to the crank, and side 2 does not.
#[test]
fn a_table_that_jumps_agrees_in_prescribed_and_free_motions() {
    let prescribed = with_table("crank_rocker.toml", "from_deg = 0\nto_deg = 360\nstep_deg = 10\n");
    let free = with_table("crank_rocker_runup.toml", "from_s = 0\nto_s = 0.4\nstep_s = 0.004\n");
    for scenario in [prescribed, free] {
        let proof = prove(&scenario, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(proof.verdict.word(), "agree", "{}: {:?}", scenario.name, proof.verdict);
        let least = usize::from(scenario.case.is_free());
        assert!(left_out_in(&proof, Stage::Reactions) >= least && left_out_in(&proof, Stage::Positions) == 0);
    }
}
