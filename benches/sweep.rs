//! Cost of a sweep: four-bars with a full turn of 361 poses each, and ten figures of forces and motion.
//! The processor time of the whole sweep, with its table and summary, is divided by the processor time of its poses in
//! a batch.
//! The processor time of the poses is the cost of one pose of the first case, with all quantities, times the number of
//! poses.
//! Then one thread is compared with two.
//! `cargo bench --bench sweep [-- CASES [REPEATS]]`.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use analytic::assur::batch::{Batch, Poses};
use lab::outside::processor_time;
use linkage::math::KeepNan;
use linkage::trajectory::Stage;
use scenario::Scenario;
use sweep::{DesignKind, Goal, SweepAxis, SweepDesign, SweepPlan, SweepStore};

const AXES: [&str; 3] = ["crank_mm=20:40", "coupler_mm=110:135", "rocker_mm=80:100"];
/// No two figures use the same quantity, so that each figure adds the cost of its own quantity.
const FIGURES: [&str; 10] = [
    "max:joint.O.f_N",
    "max:joint.A.f_N",
    "max:joint.B.f_N",
    "max:joint.C.f_N",
    "maxabs:drive.torque_N_m",
    "rms:joint.C.fx_N",
    "range:point.E.x_mm",
    "at_max:point.E.y_mm",
    "maxabs:link.rocker.alpha_rad_s2",
    "mean:link.coupler.omega_rad_s",
];

fn plan(cases: u64) -> SweepPlan {
    let text = scenario::templates::named("four-bar").and_then(|own| own.scenario("four_bar", &[]));
    let text = text.expect("a template").replace("step_deg = 2", "step_deg = 1");
    let axes = AXES.map(|axis| SweepAxis::parse(axis).expect("an axis")).to_vec();
    let design = SweepDesign::of(DesignKind::Sobol { cases, seed: 1 }, axes).expect("a design");
    let figures = FIGURES.map(String::from);
    let file = (text, Path::new("four_bar.toml"));
    SweepPlan::of(file, Vec::new(), design, &figures, None, None).unwrap_or_else(|error| panic!("{error}"))
}

/// Processor time of this thread, and the time by the clock (s).
fn seconds(work: impl FnOnce()) -> [f64; 2] {
    let used = || processor_time().unwrap_or(f64::NAN);
    // Linux updates the processor time when the thread yields.
    std::thread::yield_now();
    let (before, clock) = (used(), Instant::now());
    work();
    std::thread::yield_now();
    [used() - before, clock.elapsed().as_secs_f64()]
}

/// The whole sweep in a new directory.
fn sweep(plan: &SweepPlan, threads: usize) {
    let place = tempfile::tempdir().expect("a directory");
    let done = || {
        let store = SweepStore::open(&place.path().join("sweep"), plan)?;
        let goal = Goal::default();
        let (tally, summary) = sweep::run(plan, &store, None, threads, goal, &mut |_| ControlFlow::Continue(()))?;
        assert_eq!(tally.solved, plan.design.cases());
        Ok::<_, linkage::error::Error>(summary.expect("the table is complete"))
    };
    black_box(done().unwrap_or_else(|error| panic!("{error}")));
}

fn main() {
    let mut numbers = std::env::args().filter_map(|word| word.parse().ok());
    let (cases, repeats) = (numbers.next().unwrap_or(100_000), numbers.next().unwrap_or(5));
    let plan = plan(cases);
    let member = Scenario::parse(&plan.text, "four_bar.toml").unwrap_or_else(|error| panic!("{error}"));
    let (case, omega) = (&member.case, member.case.crank().at(0.0).rate);
    let mut cranks: Vec<f64> = (0..361).map(|degree| case.crank().start + f64::from(degree).to_radians()).collect();
    assert_eq!(case.grid.len(), cranks.len());
    let (mut batch, mut poses) = (Batch::of(case).expect("a batch"), Poses::new());
    let mut best = [[f64::INFINITY; 2]; 3];
    for _ in 0..repeats {
        let found = [
            seconds(|| {
                for _ in 0..cases {
                    batch.solve(black_box(&cranks), omega, 0.0, Stage::BalancingMoment, &mut poses).expect("it turns");
                    black_box(&poses);
                    // The next call solves the poses in reverse order, so it starts where this call ends.
                    cranks.reverse();
                }
            }),
            seconds(|| sweep(&plan, 1)),
            seconds(|| sweep(&plan, 2)),
        ];
        let round = found.map(|[used, clock]| format!("{used:.3}/{clock:.3}")).join("  ");
        println!("batch, one thread, two threads (processor time of the first thread/clock, s): {round}");
        for (best, found) in best.iter_mut().flatten().zip(found.as_flattened()) {
            *best = best.smaller(*found);
        }
    }
    let [[poses, _], [sweep, one], [_, two]] = best;
    println!("a pose in a batch: {:.1} ns", poses * 1e9 / (cases * cranks.len() as u64) as f64);
    println!(
        "{cases} cases: {:.2} of their poses in a batch; one thread by two threads: {:.2}",
        sweep / poses,
        one / two
    );
    let peak = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    println!("largest memory: {}", peak.lines().find(|line| line.starts_with("VmHWM")).unwrap_or("unknown"));
}
