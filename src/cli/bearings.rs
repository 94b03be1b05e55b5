//! `linkproof bearings`.

use std::fmt::Write;
use std::path::PathBuf;

use serde_json::json;

use super::output;
use crate::report::table;
use crate::scenario::Scenario;
use analytic::range::explained;
use linkage::error::{Error, ErrorKind, Result};
use workshop::bearings::{self, Peak, Peaks, journal_diameter};

const EXAMPLES: &str = "\
Examples:
  linkproof bearings scenarios/crank_rocker.toml
  linkproof bearings scenarios/ov7_new_tabulated.toml --lever-mm 10 --stress-mpa 200
  linkproof bearings scenarios/compressor.toml --json -

The smallest journal carries the reaction F at the lever l in bending: d = cbrt(32 F l / (pi sigma)).";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Scenario file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Lever of the reaction on its journal, in mm
    #[arg(long, value_name = "MM", default_value = "10", allow_hyphen_values = true)]
    lever_mm: f64,
    /// Bending stress that the journals may carry, in MPa
    #[arg(long, value_name = "MPA", default_value = "200", allow_hyphen_values = true)]
    stress_mpa: f64,
    /// Write the result as JSON to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    json: Option<PathBuf>,
}

pub(super) fn bearings(args: &Args) -> Result<()> {
    for (name, value) in [("--lever-mm", args.lever_mm), ("--stress-mpa", args.stress_mpa)] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(Error::new(ErrorKind::Input, format!("{name} is {value}")).help("give a number above zero"));
        }
    }
    let scenario = Scenario::load(&args.file)?.nominal();
    let peaks = bearings::over_range(&scenario.case).map_err(|error| explained(&scenario.case, error))?;
    match &args.json {
        Some(to) => output::write(&format!("{}\n", as_json(args, &scenario, &peaks)), to),
        None => output::print(&as_text(args, &scenario, &peaks)),
    }
}

fn diameter(args: &Args, peak: Peak) -> f64 {
    journal_diameter(peak.value, args.lever_mm * 1e-3, args.stress_mpa * 1e6)
}

fn as_text(args: &Args, scenario: &Scenario, peaks: &Peaks) -> String {
    let header = ["joint", "largest reaction", "at crank deg", "smallest journal", "largest moment", "at crank deg"];
    let mut table = table(header, &[1, 2, 3, 4, 5]);
    let degrees = |peak: Peak| format!("{:.4}", peak.crank.to_degrees());
    for (index, joint) in scenario.case.mechanism.joints().iter().enumerate() {
        let reaction = peaks.reactions[index];
        let mut row = vec![joint.name.clone(), format!("{:.6} N", reaction.value), degrees(reaction)];
        match peaks.moments[index] {
            None => row.extend([format!("{:.3} mm", 1e3 * diameter(args, reaction)), String::new(), String::new()]),
            Some(moment) => row.extend(["slider".into(), format!("{:.6} N m", moment.value), degrees(moment)]),
        }
        table.add_row(row);
    }
    let mut text = String::new();
    let _ = writeln!(text, "{}: {}\n\n{table}\n", scenario.name, scenario.title);
    for (name, peak, unit) in
        [("shaking force", peaks.shaking_force, "N"), ("balancing moment", peaks.balancing_moment, "N m")]
    {
        let _ = writeln!(text, "largest {name:16} {:.6} {unit} at {} deg", peak.value, degrees(peak));
    }
    let _ = writeln!(text, "\njournals: lever {} mm, bending stress {} MPa", args.lever_mm, args.stress_mpa);
    text
}

fn as_json(args: &Args, scenario: &Scenario, peaks: &Peaks) -> String {
    let whole = |peak: Peak, unit: &str| json!({unit: peak.value, "crank_rad": peak.crank});
    let joints = scenario.case.mechanism.joints().iter().enumerate().map(|(index, joint)| {
        json!({
            "joint": joint.name, "reaction": whole(peaks.reactions[index], "N"),
            "moment": peaks.moments[index].map(|moment| whole(moment, "N_m")),
            "smallest_journal_m": joint.is_pin().then(|| diameter(args, peaks.reactions[index])),
        })
    });
    let value = json!({
        "schema": 1, "scenario": scenario.name, "lever_m": args.lever_mm * 1e-3, "stress_Pa": args.stress_mpa * 1e6,
        "joints": joints.collect::<Vec<_>>(), "shaking_force": whole(peaks.shaking_force, "N"),
        "balancing_moment": whole(peaks.balancing_moment, "N_m"),
    });
    serde_json::to_string_pretty(&value).expect("plain values are always JSON")
}
