//! Cost of one pose: of all quantities, of the positions alone, and of all quantities in a batch of poses.
//! All quantities are positions, velocities, accelerations, all reactions and the balancing moment.
//! Each cost is divided by the cost of computing all quantities with a hand-written four-bar solver, which is timed in
//! the same process.
//! `cargo bench --bench pose`.

mod four_bar;

#[path = "shared/timing.rs"]
mod timing;

use linkage::case::Case;
use std::hint::black_box;
use std::path::Path;

use analytic::assur::batch::{Batch, Poses};
use analytic::{AssurSolver, PoseSolver};
use four_bar::FourBar;
use linkage::drive::MotionLaw;
use linkage::mechanism::LinkId;
use linkage::solver::Solver;
use linkage::trajectory::Stage;
use scenario::Scenario;

use timing::shortest;

/// Poses per timing, over one turn.
const POSES: usize = 3600;
/// Number of timings; the shortest counts.
const REPEATS: usize = 200;

fn scenario(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn angle(k: usize) -> f64 {
    std::f64::consts::TAU * k as f64 / POSES as f64
}

fn by_hand(scenario: &Scenario) -> FourBar {
    let case = &scenario.case;
    let [crank, coupler, rocker] = [1, 2, 3].map(|k| &case.mechanism.links()[LinkId(k)]);
    let length = |link: &linkage::mechanism::Link| link.points[1].local.x;
    FourBar {
        crank: length(crank),
        coupler: length(coupler),
        rocker: length(rocker),
        pivot: [0.15, 0.015],
        mass: [crank, coupler, rocker].map(|link| link.mass),
        inertia: [crank, coupler, rocker].map(|link| link.inertia),
        centre: [crank, coupler, rocker].map(|link| link.mass_centre.x),
        gravity: -case.gravity.y,
        resistance: 100.0,
    }
}

/// Asserts that the general solver and the hand-written four-bar give equal solutions; otherwise the ratio of their
/// costs is meaningless.
fn check(scenario: &Scenario, hand: &FourBar) {
    let omega = scenario.case.crank().at(0.0).rate;
    let mut poses = PoseSolver::new(&scenario.case).unwrap();
    for k in 0..POSES {
        let state = poses.solve(angle(k), omega, 0.0, Stage::BalancingMoment).unwrap();
        let general = state.forces.iter().flat_map(|force| [force.x, force.y]).chain([state.torques[0]]);
        // The scenario lists the joints in the order O, A, B, C.
        for (ours, theirs) in general.zip(hand.solve(angle(k), omega)) {
            assert!((ours - theirs).abs() < 1e-8, "{ours} {theirs} at {k}");
        }
    }
}

/// The timed part of a mechanism's solution.
#[derive(Clone, Copy, Debug)]
enum Part {
    All,
    Positions,
    Batch,
}

const PARTS: [(&str, Part); 3] = [("all", Part::All), ("positions", Part::Positions), ("batch", Part::Batch)];

/// Returns a function that solves one revolution of a mechanism.
fn turns_of(case: &Case, part: Part) -> Box<dyn FnMut() + '_> {
    let (start, omega) = (case.crank().start, case.crank().at(0.0).rate);
    let one_by_one = |deepest: Stage| -> Box<dyn FnMut() + '_> {
        let mut poses = PoseSolver::new(case).unwrap();
        Box::new(move || {
            for k in 0..POSES {
                let crank = start + angle(k);
                let _ = black_box(poses.solve(black_box(crank), omega, 0.0, deepest).unwrap().torques[0]);
            }
        })
    };
    match part {
        Part::All => one_by_one(Stage::BalancingMoment),
        Part::Positions => one_by_one(Stage::Positions),
        Part::Batch => {
            let cranks: Vec<f64> = (0..POSES).map(|k| start + angle(k)).collect();
            let mut found = Poses::new();
            // Every revolution uses a new batch: a used batch already contains the anchors of its higher groups.
            Box::new(move || {
                let mut batch = Batch::of(case).unwrap();
                batch.solve(black_box(&cranks), omega, 0.0, Stage::BalancingMoment, &mut found).unwrap();
                assert_eq!(batch.solved_singly(), 0);
                black_box(&found);
            })
        }
    }
}

/// Solves a few revolutions without timing them, so that another program can count the instructions:
/// `valgrind --tool=callgrind target/release/deps/pose-... --turns ov7_new all 3`.
fn count(name: &str, part: &str, turns: usize) {
    if name == "hand" {
        let crank_rocker = scenario("crank_rocker");
        let (hand, omega) = (by_hand(&crank_rocker), crank_rocker.case.crank().at(0.0).rate);
        for k in 0..turns * POSES {
            black_box(hand.solve(black_box(angle(k % POSES)), omega));
        }
        return;
    }
    let scenario = scenario(name);
    let part = PARTS.into_iter().find(|(known, _)| *known == part).expect("all, positions or batch").1;
    let mut turn = turns_of(&scenario.case, part);
    (0..turns).for_each(|_| turn());
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some([_, name, part, turns]) = arguments.windows(4).find(|found| found[0] == "--turns") {
        return count(name, part, turns.parse().expect("a number of turns"));
    }
    let crank_rocker = scenario("crank_rocker");
    let hand = by_hand(&crank_rocker);
    check(&crank_rocker, &hand);
    let omega = crank_rocker.case.crank().at(0.0).rate;
    let measure = shortest(REPEATS, || {
        for k in 0..POSES {
            black_box(hand.solve(black_box(angle(k)), omega));
        }
    });
    let placed = shortest(REPEATS, || {
        for k in 0..POSES {
            black_box(hand.positions(black_box(angle(k))));
        }
    });
    println!(
        "four-bar by hand: 1 ({:.0} ns a pose on this machine, now), positions {:.2}\n",
        measure * 1e9 / POSES as f64,
        placed / measure
    );
    println!("{:20} {:>10} {:>10} {:>10}", "scenario", "all", "positions", "batch");
    for name in ["crank_rocker", "ov7_base", "ov7_new", "fourth_class"] {
        let scenario = scenario(name);
        let [all, positions, batch] =
            PARTS.map(|(_, part)| shortest(REPEATS, turns_of(&scenario.case, part)) / measure);
        println!("{name:20} {all:>10.2} {positions:>10.2} {batch:>10.2}");
    }
    let boom = scenario("boom_lift").case;
    let crank = boom.mechanism.joint_named("O").expect("the boom is hinged at O");
    let inputs = |case: &Case| case.grid.inputs.clone();
    let of_ram = shortest(REPEATS, swing_of(&boom, &inputs(&boom)));
    // The boom lift with the same motion of the boom, but driven at the boom's hinge instead of its cylinder.
    let angles = angles_of(&boom);
    let rise = angles[angles.len() - 1] - angles[0];
    let law = |_| MotionLaw::Cycloidal { rise, time: 1.0 };
    let at_crank = boom.driven_at(crank, law, vec![0.0, 1.0]).expect("the boom is a crank");
    let of_crank = shortest(REPEATS, swing_of(&at_crank, &angles));
    println!(
        "\nboom on a ram, all: {:.2}; driven at its hinge: {:.2}; ratio {:.2}",
        of_ram / measure,
        of_crank / measure,
        of_ram / of_crank
    );
}

/// Returns a function that solves `POSES` poses on the way from the first to the last of `inputs` and back.
fn swing_of<'a>(case: &'a Case, inputs: &[f64]) -> Box<dyn FnMut() + 'a> {
    let (from, to) = (inputs[0], inputs[inputs.len() - 1]);
    let at = |k: usize| from + (to - from) * (1.0 - (angle(k)).cos()) / 2.0;
    let all: Vec<f64> = (0..POSES).map(at).collect();
    let mut poses = PoseSolver::new(case).unwrap();
    Box::new(move || {
        for &input in &all {
            let _ = black_box(poses.solve(black_box(input), 1.0, 0.0, Stage::BalancingMoment).unwrap().torques[0]);
        }
    })
}

/// Angles of the boom at its first and last instant (rad).
fn angles_of(boom: &Case) -> Vec<f64> {
    let solved = AssurSolver.solve(boom).unwrap();
    let angles = solved.named("link.boom.angle_rad").unwrap();
    vec![angles[0], angles[angles.len() - 1]]
}
