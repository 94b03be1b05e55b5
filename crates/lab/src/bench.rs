//! Work and precision of every solver, engine and setting: error against time, and against counts of operations.
//!
//! Each method of solving a scenario is a [`BenchPoint`].
//! Methods that fail are kept, with the reason.
//! The command line supplies the clock.
//! See docs/numerics/laboratory.md.

mod front;
mod ladder;
mod measure;
mod options;
mod peer;
mod point;
mod reference;

pub use front::{CostAxis, front};
pub use options::{BenchOptions, CLEAR, Clock};
pub use peer::{Answer, Peer, Way};
pub use point::{AnsweredRun, BenchOutcome, BenchPoint, Errors, MethodOwner, RunEffort};
pub use reference::Floor;

use linkage::error::Result;
use linkage::solver::Progress;
use linkage::trajectory::Stage;
use scenario::Scenario;

/// All [`BenchPoint`]s of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Bench {
    /// Name and title of the scenario.
    pub scenario: [String; 2],
    /// Number of instants.
    pub instants: usize,
    /// Times of the first and the last instant (s).
    pub span: [f64; 2],
    /// Whether the motion is free, that is, determined by forces.
    pub is_free: bool,
    /// Stages that were requested.
    pub stages: Vec<Stage>,
    /// The reference, and its error.
    pub floor: Floor,
    /// Shortest time (s) of analytic side 1 at its usual accuracy: the unit of relative times.
    pub unit: f64,
    /// Versions of engines and peers, by name.
    pub versions: Vec<(String, String)>,
    /// The points, in the order of their creation.
    pub points: Vec<BenchPoint>,
    /// Number of settings that were not measured, because of the budget.
    pub left_out: usize,
    /// Peers that could not be called, with the reason.
    pub absent: Vec<(String, String)>,
}

/// Measures all methods of solving a scenario. `progress` receives the completed fraction.
///
/// # Errors
/// Any error of the two analytic sides, because they compute the reference.
/// A failure of an engine or a peer is not returned as an error: its [`BenchPoint`] contains the reason.
pub fn bench(
    scenario: &Scenario,
    options: &BenchOptions,
    peers: &[&dyn Peer],
    clock: Clock,
    progress: Progress,
) -> Result<Bench> {
    let case = &scenario.case;
    let (reference, floor) = reference::of(case)?;
    let plan = ladder::plan(case, options);
    let (mut found, left_out) = (plan.points, plan.left_out);
    let mut versions = plan.versions;
    let mut absent = Vec::new();
    for (index, peer) in peers.iter().enumerate() {
        match peer.ways() {
            Ok(ways) => found.extend(ways.into_iter().map(|way| ladder::Planned::of_peer(index, peer.name(), way))),
            Err(reason) => absent.push((peer.name().to_string(), reason)),
        }
    }
    let rounds = options.rounds();
    let desk = measure::Desk { case, reference: &reference, floor: &floor, peers, clock };
    let points = desk.measure(found, rounds, progress, &mut versions);
    let own = |point: &&BenchPoint| point.party == MethodOwner::Side && point.is_usual && point.program == "assur";
    let unit = points.iter().find(own).and_then(BenchPoint::seconds).unwrap_or(f64::NAN);
    let times = &case.grid.times;
    Ok(Bench {
        scenario: [scenario.name.clone(), scenario.title.clone()],
        instants: case.grid.len(),
        span: [*times.first().unwrap_or(&0.0), *times.last().unwrap_or(&0.0)],
        is_free: case.is_free(),
        stages: Stage::ALL.into_iter().filter(|&stage| case.wanted.has(stage)).collect(),
        floor,
        unit,
        versions,
        points,
        left_out,
        absent,
    })
}
