//! Work-precision measurement: the error floor, the Pareto fronts, the reasons of failures, and invalid answers of
//! peers.

use std::cell::Cell;

use analytic::NewtonSolver;
use lab::bench::{
    Answer, Bench, BenchOptions, BenchPoint, CLEAR, CostAxis, MethodOwner, Peer, RunEffort, Way, bench, front,
};
use linkage::case::Grid;
use linkage::solver::Solver;
use linkage::trajectory::{Stage, Trajectory};
use prover::engines::EngineName;
use scenario::Scenario;

use crate::common::{assert_within, shipped};

/// Measures with a clock that advances by one second at each reading.
fn measured(scenario: &Scenario, peers: &[&dyn Peer]) -> Bench {
    let now = Cell::new(0.0);
    let clock = || {
        now.set(now.get() + 1.0);
        now.get()
    };
    let options = BenchOptions { is_quick: true, engines: vec![EngineName::Rapier], ..BenchOptions::default() };
    bench(scenario, &options, peers, &clock, &mut |_| {}).unwrap()
}

/// A scenario with only a few instants.
fn few(name: &str) -> Scenario {
    let mut scenario = shipped(name);
    let last = scenario.case.grid.times.iter().fold(0.0f64, |most, &t| if t > most { t } else { most });
    let times = (0..=8).map(|k| f64::from(k) / 8.0 * last).collect();
    let grid = Grid::of_times(scenario.case.crank(), times);
    scenario.case = scenario.case.on(grid).unwrap();
    scenario
}

#[test]
fn engine_errors_are_well_above_the_floor() {
    for name in ["crank_rocker.toml", "crank_rocker_runup.toml", "ov7_new.toml"] {
        let found = measured(&few(name), &[]);
        assert_eq!(found.stages, Stage::ALL);
        for stage in Stage::ALL {
            let floor = found.floor.errors[stage as usize];
            let engines = found.points.iter().filter(|point| point.party == MethodOwner::Engine);
            let errors: Vec<_> = engines.filter_map(|point| point.error(stage)).collect();
            assert!(errors.len() >= 6, "{name} {stage:?}: {}", errors.len());
            for errors in errors {
                assert!(errors.max >= CLEAR * floor && !errors.is_limited, "{name} {stage:?}: {errors:?} {floor:e}");
                assert!(errors.rms <= errors.max, "{name} {stage:?}: {errors:?}");
            }
            // The errors of the analytic sides are at the error floor, so their points are marked as limited by this
            // floor.
            let sides = found.points.iter().filter(|point| point.party == MethodOwner::Side && point.is_usual);
            assert!(sides.filter_map(|point| point.error(stage)).all(|errors| errors.is_limited), "{name} {stage:?}");
            let best =
                front(&found.points, stage, CostAxis::Solutions, floor, &|point| point.party == MethodOwner::Engine);
            assert!(!best.is_empty(), "{name} {stage:?}");
        }
    }
}

#[test]
fn a_finer_step_takes_more_work_and_has_a_smaller_error() {
    let found = measured(&few("crank_rocker.toml"), &[]);
    let plain = found.points.iter().filter(|point| {
        point.settings.is_some_and(|own| own.extrapolated == 0 && own.route == linkage::engine::Route::Differences)
    });
    let rows: Vec<(u64, f64)> = plain
        .map(|point| (point.run().unwrap().effort.of("steps").unwrap(), point.error(Stage::Positions).unwrap().max))
        .collect();
    assert!(rows.len() >= 2, "{rows:?}");
    assert!(rows.windows(2).all(|pair| pair[0].0 < pair[1].0 && pair[0].1 > pair[1].1), "{rows:?}");
}

#[test]
fn failed_points_keep_their_reason() {
    let found = measured(&few("crank_rocker_runup.toml"), &[]);
    let failed: Vec<_> = found.points.iter().filter_map(|point| point.failure(Stage::Positions)).collect();
    assert!(!failed.is_empty() && failed.iter().all(|reason| reason.contains("probe")), "{failed:?}");
}

/// The same input gives the same numbers and counts; only times differ.
#[test]
fn errors_and_counts_are_reproducible() {
    let of = |bench: Bench| {
        let told = |point: &lab::bench::BenchPoint| {
            format!("{:?} {:?}", point.settings, point.run().map(|run| (run.errors, run.effort.clone())))
        };
        bench.points.iter().map(told).collect::<Vec<_>>()
    };
    let scenario = few("five_bar.toml");
    assert_eq!(of(measured(&scenario, &[])), of(measured(&scenario, &[])));
}

/// Measures both sides at two of the accuracies of `cargo bench --bench run_up`: 1e-11 and 1e-8.
/// At both accuracies, the position error is at most 1e-8.
#[test]
fn sides_keep_their_accuracy() {
    let found = measured(&few("crank_rocker_runup.toml"), &[]);
    let sides: Vec<_> = found.points.iter().filter(|point| point.party == MethodOwner::Side).collect();
    assert_eq!(sides.len(), 4);
    for point in sides {
        let error = point.error(Stage::Positions).unwrap().max;
        assert_within!(error, 1e-8, "{} {}", point.program, point.resolution);
    }
}

/// Changes an answer.
type Change = Box<dyn Fn(&mut Answer)>;

/// A named peer that answers with the solution of side 2, changed by a function.
struct Planted(String, Trajectory, Change);

impl Peer for Planted {
    fn name(&self) -> &str {
        &self.0
    }

    fn ways(&self) -> Result<Vec<Way>, String> {
        Ok(vec![Way { name: "as it is".into(), resolution: "none".into(), told: "{}".into() }])
    }

    fn run(&self, _: &Way) -> Result<Answer, String> {
        let columns = self.1.iter().map(|(channel, values)| (channel.to_string(), values.to_vec()));
        let columns = std::iter::once(("t_s".to_string(), self.1.times().to_vec())).chain(columns).collect();
        let effort = RunEffort(vec![("steps".into(), 7)]);
        let mut answer = Answer { version: "planted 1".into(), columns, seconds: vec![0.5, 0.25], effort };
        (self.2)(&mut answer);
        Ok(answer)
    }
}

#[test]
fn invalid_answers_are_failures_with_a_reason() {
    let scenario = few("crank_rocker.toml");
    let exact = NewtonSolver.solve(&scenario.case).unwrap();
    // Measures all planted peers in one call.
    let with = |changes: Vec<Change>| -> Vec<BenchPoint> {
        let planted = |(index, change)| Planted(format!("planted {index}"), exact.clone(), change);
        let peers: Vec<Planted> = changes.into_iter().enumerate().map(planted).collect();
        let peers: Vec<&dyn Peer> = peers.iter().map(|peer| peer as &dyn Peer).collect();
        measured(&scenario, &peers).points.into_iter().filter(|point| point.party == MethodOwner::Peer).collect()
    };
    let of = |name: &'static str, change: fn(&mut Vec<f64>)| -> Change {
        Box::new(move |answer| change(&mut answer.columns.iter_mut().find(|(own, _)| own == name).unwrap().1))
    };
    let whole: [(Change, &str); 6] = [
        (Box::new(|answer| answer.columns.clear()), "no column t_s"),
        (Box::new(|answer| answer.columns.truncate(1)), "no requested channel"),
        (of("t_s", |times| times[3] += 1e-3), "row 4 of the answer"),
        (of("t_s", |times| times[0] = f64::NAN), "row 1 of the answer"),
        (of("t_s", |times| times.truncate(2)), "2 instants"),
        (Box::new(|answer| answer.seconds = vec![f64::NAN, -1.0, 0.0]), "no time"),
    ];
    let (whole, reasons): (Vec<Change>, Vec<&str>) = whole.into_iter().unzip();
    let others: [Change; 4] = [
        Box::new(|_| {}),
        of("joint.B.fx_N", |values| values[2] = f64::NAN),
        of("joint.B.fx_N", |values| values.truncate(1)),
        Box::new(|answer| answer.columns.retain(|(name, _)| !name.starts_with("joint."))),
    ];
    let points = with(others.into_iter().chain(whole).collect());
    let [good, nan, short, silent] = [0, 1, 2, 3].map(|index| &points[index]);
    assert!(Stage::ALL.iter().all(|&stage| good.error(stage).unwrap().max < 1e-9 && good.failure(stage).is_none()));
    assert_eq!((good.seconds(), good.run().unwrap().effort.solutions()), (Some(0.25), Some(7)));
    for (point, reason) in points[4..].iter().zip(&reasons) {
        assert!(point.run().is_none(), "{reason}");
        let told = point.failure(Stage::Velocities).unwrap();
        assert!(told.contains(reason), "{reason}: {told}");
    }
    assert_eq!(points.len(), 4 + reasons.len());
    // If one stage of an answer fails, the remaining stages stay valid.
    assert!(nan.failure(Stage::Reactions).unwrap().contains("joint.B.fx_N is NaN"));
    assert!(nan.error(Stage::Positions).is_some() && nan.error(Stage::Reactions).is_none());
    assert!(short.failure(Stage::Reactions).is_some() && short.error(Stage::Positions).is_some());
    // A stage that a peer does not offer at all does not count as a failure.
    assert!(silent.error(Stage::Reactions).is_none() && silent.failure(Stage::Reactions).is_none());
}

/// An older peer does not know the newest channels.
/// The channels that the older peer provides are judged, and the missing channels are reported.
#[test]
fn a_peer_with_missing_channels_is_judged_in_the_others() {
    let scenario = few("crank_rocker.toml");
    let exact = NewtonSolver.solve(&scenario.case).unwrap();
    let with = |more: f64| -> Planted {
        let change = move |answer: &mut Answer| {
            answer.columns.retain(|(name, _)| !name.starts_with("joint.B."));
            let (_, values) = answer.columns.iter_mut().find(|(name, _)| name == "joint.C.fx_N").unwrap();
            values.iter_mut().for_each(|value| *value *= 1.0 + more);
        };
        Planted(format!("planted {more}"), exact.clone(), Box::new(change))
    };
    let found = measured(&scenario, &[&with(0.0), &with(1e-3)]);
    let mut peers = found.points.iter().filter(|point| point.party == MethodOwner::Peer);
    let [right, wrong] = [(); 2].map(|()| peers.next().unwrap());
    assert_eq!(
        (right.without(Stage::Reactions), right.failure(Stage::Reactions)),
        (Some("joint.B.fx_N and 1 more"), None)
    );
    assert!(right.error(Stage::Reactions).unwrap().max < 1e-9 && right.without(Stage::Positions).is_none());
    // The channels that the peer provides are still judged.
    assert!(wrong.error(Stage::Reactions).unwrap().max > 1e-4);
}
