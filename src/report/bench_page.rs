//! The documentation page of work-precision results, in Markdown.

use super::bench::{Machine, error, fastest, ratio, short};
use super::bench_plot::{gaps, programs, reasons};
use super::html::filled;
use super::markdown::foreign;
use crate::sentences;
use lab::bench::{Bench, BenchPoint, CLEAR, CostAxis, MethodOwner, front};
use linkage::math::statistics::distinct;
use linkage::trajectory::Stage;

/// For each of these errors, a cell states the run time that a program needs to reach the error.
const WITHIN: [f64; 3] = [1e-3, 1e-6, 1e-9];
/// Largest number of failure reasons listed for a scenario.
const REASONS: usize = 6;

/// The page.
/// `command` is the command that made the page; `pictures` is the directory of the diagrams, relative to the page.
pub(crate) fn page(benches: &[Bench], machine: &Machine, command: &str, pictures: &str) -> String {
    let mut text = filled(include_str!("bench_page.md"), &[("command", command), ("clear", &CLEAR.to_string())]);
    let machine: Vec<String> = machine.iter().map(|(name, value)| format!("{name}: {value}")).collect();
    say!(text, "Machine: {}.\n", machine.join("; "));
    let versions = benches.iter().flat_map(|bench| &bench.versions);
    let versions = distinct(versions.map(|(name, version)| format!("{name}: {}", foreign(version))));
    say!(text, "Versions: {}.\n", versions.join("; "));
    for bench in benches {
        scenario(&mut text, bench, pictures);
    }
    // The page ends with exactly one newline.
    format!("{}\n", text.trim_end())
}

fn scenario(text: &mut String, bench: &Bench, pictures: &str) {
    let [name, title] = &bench.scenario;
    let failed = bench.points.iter().filter(|point| point.run().is_none()).count();
    say!(text, "## {name}\n\n{}.\n", foreign(title));
    say!(
        text,
        sentences::settings_on_instants_failed_diagram(&bench.points.len(), &bench.instants, &failed, &pictures, &name)
    );
    let stages: Vec<&str> = bench.stages.iter().map(|stage| stage.name()).collect();
    say!(text, "| | {} |", stages.join(" | "));
    say!(text, "|---|{}", "---|".repeat(stages.len()));
    let floors = bench.stages.iter().map(|&stage| format!("{:.0e}", bench.floor.errors[stage as usize]));
    say!(text, "| floor | {} |", floors.collect::<Vec<_>>().join(" | "));
    for program in programs(bench) {
        let cells = bench.stages.iter().map(|&stage| cell(bench, program, stage));
        say!(text, "| {program} | {} |", cells.collect::<Vec<_>>().join(" | "));
    }
    text.push('\n');
    for &stage in &bench.stages {
        let of_others = told(bench, stage, &|point| point.party != MethodOwner::Side);
        say!(text, sentences::front_of(&stage.name(), &told(bench, stage, &|_| true)));
        say!(text, sentences::of_engines_and_peers(&(if of_others.is_empty() { "none" } else { &of_others })));
    }
    for (reason, times) in reasons(bench).into_iter().take(REASONS) {
        say!(text, sentences::failed_times_2(&times, &foreign(&reason)));
    }
    for (gap, times) in gaps(bench).into_iter().take(REASONS) {
        say!(text, sentences::judged_in_part_times_2(&times, &foreign(&gap)));
    }
    if bench.left_out > 0 {
        say!(text, sentences::finer_settings_were_not_run_the_work(&bench.left_out));
    }
    text.push('\n');
}

/// The front of a stage, with time as the cost and with names of programs.
fn told(bench: &Bench, stage: Stage, of: &dyn Fn(&BenchPoint) -> bool) -> String {
    let floor = bench.floor.errors[stage as usize];
    let told = front(&bench.points, stage, CostAxis::Time, floor, of).into_iter().filter_map(|index| {
        let point = &bench.points[index];
        let errors = point.error(stage)?;
        Some(format!("{} ({}; time {})", named(point), error(errors, floor), short(ratio(bench, point)?)))
    });
    told.collect::<Vec<_>>().join("; ")
}

fn named(point: &BenchPoint) -> String {
    let told = foreign(&point.told());
    if told.is_empty() { point.program.clone() } else { format!("{} {told}", point.program) }
}

/// Times that a program needs for the errors in the table.
fn cell(bench: &Bench, program: &str, stage: Stage) -> String {
    let own = |point: &BenchPoint| point.program == program;
    if !bench.points.iter().any(|point| own(point) && point.error(stage).is_some()) {
        return String::new();
    }
    let at = |within: f64| {
        let found = fastest(bench, stage, within, &own).and_then(|point| ratio(bench, point));
        found.map_or_else(|| "–".to_string(), short)
    };
    WITHIN.map(at).join(" / ")
}
