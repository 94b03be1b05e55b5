//! `linkproof diagram`.

use std::fmt::Write;
use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use serde_json::{Value, json};

use super::load::reference_names;
use super::output;
use crate::scenario::Scenario;
use analytic::range::explained;
use linkage::error::Result;
use workshop::diagram::draw::{self, significant};
use workshop::diagram::{Course, MotionDiagram};

const EXAMPLES: &str = "\
Examples:
  linkproof diagram scenarios/crank_rocker.toml --channel point.B.x_m
  linkproof diagram scenarios/ov7_base.toml --channel link.rocker_87.angle_rad --divisions 24 --svg needle.svg
  linkproof diagram scenarios/crank_rocker.toml --channel link.rocker.angle_rad --csv points.csv

Chords of the displacement give the velocity at the middles of the divisions, chords of that the acceleration at their ends;
backwards, the exact velocity and acceleration at the middles are summed up.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Scenario file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Position or angle, named as in `linkproof list --channels`
    #[arg(long, value_name = "NAME")]
    channel: String,
    /// Number of equal divisions of one crank turn
    #[arg(long, value_name = "N", default_value_t = 12)]
    divisions: usize,
    /// Analytic solver
    #[arg(long, value_name = "SOLVER", default_value = "assur", value_parser = PossibleValuesParser::new(reference_names()))]
    with: String,
    /// Draw the three diagrams to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target, conflicts_with_all = ["json", "csv"])]
    svg: Option<PathBuf>,
    /// Write errors and points as JSON to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target, conflicts_with = "csv")]
    json: Option<PathBuf>,
    /// Write the points as CSV to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    csv: Option<PathBuf>,
}

pub(super) fn diagram(args: &Args) -> Result<()> {
    let scenario = Scenario::load(&args.file)?.nominal();
    let solver = analytic::named(&args.with).expect("the argument parser knows all names");
    let course = Course::named(&scenario.case, &args.channel)?;
    let diagram = MotionDiagram::of(&scenario.case, solver, &course, args.divisions)
        .map_err(|error| explained(&scenario.case, error))?;
    if let Some(to) = &args.svg {
        return output::write(&draw::motion(&diagram, &scenario.name), to);
    }
    if let Some(to) = &args.csv {
        return output::write(&as_csv(&diagram), to);
    }
    match &args.json {
        Some(to) => {
            let value = as_json(&scenario, &diagram);
            let text = serde_json::to_string_pretty(&value).expect("plain values are always JSON");
            output::write(&format!("{text}\n"), to)
        }
        None => output::print(&as_text(&scenario, &diagram)),
    }
}

fn as_text(scenario: &Scenario, diagram: &MotionDiagram) -> String {
    let mut text = String::new();
    let _ =
        writeln!(text, "{}: {} over one turn in {} divisions", scenario.name, diagram.course.0[0], diagram.divisions);
    for (which, channel) in diagram.course.0.iter().enumerate() {
        let half = significant(diagram.half_range(which));
        let _ = writeln!(text, "  {:28} half range {half:>10} {}", channel.to_string(), channel.kind.unit);
    }
    let header = ["largest error", "rms", "of half range", "order", "order"];
    let [largest, rms, share, first, second] = header;
    let _ = writeln!(text, "\n  {:34} {largest:>20} {rms:>20} {share:>14} {first:>6} {second:>6}", "method");
    for found in &diagram.found {
        let unit = diagram.course.0[found.method.gives()].kind.unit.symbol();
        let [first, second] = found.orders.map(|order| order.map_or_else(|| "-".into(), |order| format!("{order:.2}")));
        let with = |value: f64| format!("{} {unit}", significant(value));
        let _ = writeln!(
            text,
            "  {:34} {:>20} {:>20} {:>12.3} % {first:>6} {second:>6}",
            found.method.words(),
            with(found.largest),
            with(found.rms),
            found.share * 100.0
        );
    }
    let n = diagram.divisions;
    let _ =
        writeln!(text, "\norders: of the rms error, from {n} to {} and from {} to {} divisions", 2 * n, 2 * n, 4 * n);
    text
}

/// One row per point: the method, the place, the value it found and the true value; 17 significant digits.
fn as_csv(diagram: &MotionDiagram) -> String {
    let mut text = String::from("method,channel,crank_rad,t_s,value,exact\n");
    for found in &diagram.found {
        let which = found.method.gives();
        for (&row, value) in found.rows.iter().zip(&found.values) {
            let numbers = [diagram.cranks[row], diagram.times[row], *value, diagram.exact[which][row]];
            let numbers = numbers.map(|number| format!("{number:.16e}")).join(",");
            let _ =
                writeln!(text, "{},{},{numbers}", found.method.words(), quoted(&diagram.course.0[which].to_string()));
        }
    }
    text
}

/// A name chosen in the scenario, quoted as a CSV cell.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.into() }
}

fn as_json(scenario: &Scenario, diagram: &MotionDiagram) -> Value {
    let found = diagram.found.iter().map(|found| {
        let which = found.method.gives();
        let points = found.rows.iter().zip(&found.values).map(|(&row, value)| {
            json!({"crank_rad": diagram.cranks[row], "t_s": diagram.times[row], "value": value, "exact": diagram.exact[which][row]})
        });
        json!({
            "method": found.method.words(), "channel": diagram.course.0[which].to_string(), "largest": found.largest,
            "rms": found.rms, "share_of_half_range": found.share, "orders": found.orders, "points": points.collect::<Vec<_>>(),
        })
    });
    let course = diagram.course.0.iter().enumerate().map(|(which, channel)| {
        json!({"channel": channel.to_string(), "unit": channel.kind.unit.symbol(), "half_range": diagram.half_range(which)})
    });
    json!({
        "schema": 1, "scenario": scenario.name, "divisions": diagram.divisions,
        "course": course.collect::<Vec<_>>(), "methods": found.collect::<Vec<_>>(),
    })
}
