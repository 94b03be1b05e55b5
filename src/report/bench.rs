//! Points of a work-precision diagram as text, CSV and JSON.

use crate::sentences;
use serde_json::{Value, json};

use super::pretty::{list, pretty};
use super::table_csv::as_csv;
use crate::plain::cells::table;
use lab::bench::{Bench, BenchOutcome, BenchPoint, CostAxis, Errors, MethodOwner, front};
use linkage::error::Result;
use linkage::math::statistics::distinct;
use linkage::trajectory::Stage;

/// Names and values that describe machine and build.
pub(crate) type Machine = [(&'static str, String)];

/// For each of these errors, the report names the fastest engine or peer.
const DECADES: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

/// Time of a point divided by the time of side 1.
pub(crate) fn ratio(bench: &Bench, point: &BenchPoint) -> Option<f64> {
    Some(point.seconds()? / bench.unit)
}

/// An error as text.
/// If the error of the reference limits the measured error, a note follows the number.
/// If the measured error is below the error of the reference, a note replaces the number.
pub(crate) fn error(errors: Errors, floor: f64) -> String {
    match (errors.is_limited, errors.max > floor) {
        (false, _) => format!("{:.1e}", errors.max),
        (true, true) => format!("{:.1e}, limited", errors.max),
        (true, false) => sentences::AT_THE_FLOOR.into(),
    }
}

/// A ratio with at most two decimals.
pub(crate) fn short(ratio: f64) -> String {
    match ratio {
        ratio if ratio >= 99.95 => format!("{ratio:.0}"),
        ratio if ratio >= 9.995 => format!("{ratio:.1}"),
        ratio => format!("{ratio:.2}"),
    }
}

/// The fastest point whose error in a stage is at most `within`, among the points that `of` accepts.
pub(crate) fn fastest<'a>(
    bench: &'a Bench,
    stage: Stage,
    within: f64,
    of: &dyn Fn(&BenchPoint) -> bool,
) -> Option<&'a BenchPoint> {
    let meets = |point: &&BenchPoint| of(point) && point.error(stage).is_some_and(|errors| errors.max <= within);
    let timed = bench.points.iter().filter(meets).filter_map(|point| Some((point.seconds()?, point)));
    timed.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, point)| point)
}

/// The Pareto fronts as text; below each front, for each error in [`DECADES`], the fastest engine or peer.
pub(crate) fn text(bench: &Bench) -> String {
    let mut text = format!("{}: {}\n\n", bench.scenario[0], bench.scenario[1]);
    let failed = bench.points.iter().filter(|point| point.run().is_none()).count();
    let (settings, instants, reference) = (bench.points.len(), bench.instants, &bench.floor.reference);
    say!(text, sentences::settings_on_instants_failed_times(&settings, &instants, &failed, &reference));
    say!(text, sentences::THE_FRONTS_WHAT_NOTHING_BEATS);
    for &stage in &bench.stages {
        let floor = bench.floor.errors[stage as usize];
        say!(text, sentences::the_reference_is_known_to(&stage.name(), &format_args!("{floor:.1e}")));
        let sides = front(&bench.points, stage, CostAxis::Time, floor, &|_| true);
        let others = front(&bench.points, stage, CostAxis::Time, floor, &|point| point.party != MethodOwner::Side);
        let others = others.into_iter().filter(|index| !sides.contains(index));
        let rows = sides.iter().copied().chain(others).filter_map(|index| {
            let point = &bench.points[index];
            let time = ratio(bench, point).map_or_else(String::new, short);
            let solutions = CostAxis::Solutions.of(point).map_or_else(String::new, |count| count.to_string());
            Some([error(point.error(stage)?, floor), time, solutions, point.program.clone(), point.told()])
        });
        say!(text, "{}", table("error> | time> | solutions> | program | settings").add_rows(rows));
        for within in DECADES {
            let other = fastest(bench, stage, within, &|point| point.party != MethodOwner::Side);
            let told = other.and_then(|point| Some(format!("{} {}", short(ratio(bench, point)?), point.program)));
            say!(
                text,
                sentences::other_programs_at(&format_args!("{within:e}"), &told.unwrap_or_else(|| "none".into()))
            );
        }
    }
    for (reason, times) in super::bench_plot::reasons(bench) {
        say!(text, sentences::failed_times(&times, &reason));
    }
    for (gap, times) in super::bench_plot::gaps(bench) {
        say!(text, sentences::judged_in_part_times(&times, &gap));
    }
    if bench.left_out > 0 {
        say!(text, sentences::finer_settings_were_not_run(&bench.left_out));
    }
    text
}

/// All points as CSV, with the machine's description in lines that begin with `#`.
///
/// # Errors
/// [`ErrorKind::Io`](linkage::error::ErrorKind::Io) if the table cannot be written.
pub(crate) fn rows(bench: &Bench, machine: &Machine) -> Result<String> {
    let mut text = String::new();
    for (name, value) in machine {
        say!(text, "# {name}: {value}");
    }
    for (name, version) in &bench.versions {
        say!(text, "# {name}: {version}");
    }
    say!(text, "# reference: {}; its error: {}", bench.floor.reference, bench.floor.basis);
    for &stage in &bench.stages {
        say!(text, "# floor of {}: {:e}", stage.name(), bench.floor.errors[stage as usize]);
    }
    let counts = counts(bench);
    let mut header = ["scenario", "program", "party", "way", "resolution", "ratio"].map(String::from).to_vec();
    for &stage in &bench.stages {
        header.extend(["max", "rms", "limited", "front"].map(|what| format!("{}_{what}", stage.name())));
    }
    header.extend(counts.iter().cloned());
    header.extend(["seconds", "all_seconds", "failure", "without"].map(String::from));
    let mut rows = vec![header];
    let fronts = fronts(bench);
    for (index, point) in bench.points.iter().enumerate() {
        let mut row = vec![
            bench.scenario[0].clone(),
            point.program.clone(),
            point.party.name().into(),
            point.way.clone(),
            point.resolution.clone(),
            ratio(bench, point).map_or_else(String::new, |ratio| format!("{ratio:.6e}")),
        ];
        for (&stage, front) in bench.stages.iter().zip(&fronts) {
            row.extend(match point.error(stage) {
                Some(errors) => [
                    format!("{:.6e}", errors.max),
                    format!("{:.6e}", errors.rms),
                    errors.is_limited.to_string(),
                    front.contains(&index).to_string(),
                ],
                None => Default::default(),
            });
        }
        let run = point.run();
        let of = |name: &String| run.and_then(|run| run.effort.of(name)).map_or_else(String::new, |n| n.to_string());
        row.extend(counts.iter().map(of));
        row.push(point.seconds().map_or_else(String::new, |seconds| format!("{seconds:.6e}")));
        let all = run.map_or(&[][..], |run| &run.seconds);
        row.push(all.iter().map(|seconds| format!("{seconds:.6e}")).collect::<Vec<_>>().join(" "));
        let joined = |all: &[(Stage, String)]| all.iter().map(|(_, what)| what.as_str()).collect::<Vec<_>>().join("; ");
        row.extend(match &point.outcome {
            BenchOutcome::Failed(reason) => [reason.clone(), String::new()],
            BenchOutcome::Answered(run) => [&run.failed, &run.without].map(|all| joined(all)),
        });
        rows.push(row);
    }
    Ok(text + &as_csv(rows)?)
}

/// Names of all counts of the points (such as evaluations), in the order of their first appearance.
fn counts(bench: &Bench) -> Vec<String> {
    distinct(
        bench.points.iter().filter_map(BenchPoint::run).flat_map(|run| &run.effort.0).map(|(name, _)| name.clone()),
    )
}

/// The front of every stage, with time as the cost.
fn fronts(bench: &Bench) -> Vec<Vec<usize>> {
    let of =
        |&stage: &Stage| front(&bench.points, stage, CostAxis::Time, bench.floor.errors[stage as usize], &|_| true);
    bench.stages.iter().map(of).collect()
}

/// Everything as JSON, schema 1.
pub(crate) fn json(benches: &[Bench], machine: &Machine) -> String {
    let machine: Value = machine.iter().map(|(name, value)| (*name, value.as_str())).collect();
    pretty(&json!({ "schema": 1, "machine": machine, "scenarios": list(benches, scenario) }))
}

fn scenario(bench: &Bench) -> Value {
    let by_stage = |of: &dyn Fn(Stage) -> Value| -> Value {
        bench.stages.iter().map(|&stage| (stage.name(), of(stage))).collect()
    };
    let points = list(&bench.points, |point| {
        let run = point.run();
        let errors = by_stage(&|stage| match point.error(stage) {
            Some(errors) => json!({
                "max": errors.max, "rms": errors.rms, "limited": errors.is_limited, "without": point.without(stage),
            }),
            None => json!(point.failure(stage).map(|reason| json!({ "failed": reason }))),
        });
        let counts = run.map(|run| run.effort.0.iter().cloned().collect::<Value>());
        json!({
            "program": point.program, "party": point.party.name(), "way": point.way, "resolution": point.resolution,
            "ratio": ratio(bench, point), "errors": errors, "work": counts, "seconds": run.map(|run| &run.seconds),
        })
    });
    let fronts = by_stage(&|stage| {
        list(CostAxis::ALL, |axis| {
            let floor = bench.floor.errors[stage as usize];
            json!({ "over": axis.name(), "points": front(&bench.points, stage, axis, floor, &|_| true) })
        })
    });
    json!({
        "scenario": bench.scenario[0], "title": bench.scenario[1], "instants": bench.instants, "span_s": bench.span,
        "free": bench.is_free, "reference": bench.floor.reference, "floor_basis": bench.floor.basis,
        "floor": by_stage(&|stage| json!(bench.floor.errors[stage as usize])), "ratio_to": sentences::SIDE_ASSUR,
        "versions": bench.versions.iter().cloned().collect::<Value>(), "not_run": bench.left_out,
        "absent": list(&bench.absent, |(name, reason)| json!({ "peer": name, "reason": reason })),
        "front": fronts, "points": points,
    })
}
