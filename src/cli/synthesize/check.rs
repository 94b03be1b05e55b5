//! `linkproof synthesize check` and `cyclogram`.

use std::path::{Path, PathBuf};

use crate::cli::load::plain;
use crate::cli::number;
use crate::cli::outputs::{Made, Outputs, results};
use crate::report::comparison::{self, Contender};
use crate::report::cyclogram::{self, Cycle};
use crate::report::synthesize::{self as report, Story};
use analytic::range::explained;
use design::bearings;
use design::synthesize::Achieved;
use design::synthesize::machine_file::Machine;
use design::synthesize::target::{OutputAccelerations, OutputNames, at_speed, in_mechanism};
use design::synthesize::task::{OutputQuantity, Task};
use design::synthesize::task_file::TaskFile;
use linkage::error::{ErrorKind, Result};
use scenario::Scenario;
use std::f64::consts::TAU;

results! { CheckResults {
    Json = "the result",
    Svg = "required and achieved motion",
    Csv = "the table that compares the scenarios",
    Markdown = "this table, with the best values in bold",
} }

results! { CyclogramResults {
    Svg = "circular cyclogram and displacements",
    Json = "phases and moments",
    Csv = "displacements over the main shaft",
} }

#[derive(Debug, clap::Args)]
pub(super) struct CheckArgs {
    /// Synthesis file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Scenarios of any structure; several scenarios are compared at one speed
    #[arg(value_name = "SCENARIO", required = true)]
    scenarios: Vec<PathBuf>,
    /// Speed of the comparison, in turns per minute; every crank keeps its sense of rotation [default: the
    /// first scenario's speed]
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = number::positive)]
    speed_rpm: Option<f64>,
    /// Output link, if its name differs from the name in the synthesis file; may be given several times: in every
    /// scenario, the first of these names that exists is used [default: the only rocker of the last group]
    #[arg(long, value_name = "NAME")]
    link: Vec<String>,
    /// Working point or output point, found like the output link of --link [default: the link's only point without a
    /// joint]
    #[arg(long, value_name = "NAME")]
    point: Vec<String>,
    #[command(flatten)]
    outputs: Outputs<CheckResults>,
}

#[derive(Debug, clap::Args)]
pub(super) struct CyclogramArgs {
    /// Machine file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    outputs: Outputs<CyclogramResults>,
}

pub(super) fn check(args: &CheckArgs) -> Result<()> {
    let TaskFile { task, .. } = TaskFile::load(&args.file)?;
    let names = OutputNames { links: args.link.clone(), points: args.point.clone() };
    let option = if matches!(task.output, OutputQuantity::Angle { .. }) { "--link" } else { "--point" };
    let mut found: Vec<(Scenario, Task, Achieved)> = Vec::new();
    for path in &args.scenarios {
        let scenario = plain(path)?.nominal();
        let own = in_mechanism(&task, &scenario, &names).map_err(|error| {
            // With this option, the user chooses the output, so an input error names the option.
            if error.kind() == ErrorKind::Input { error.key(option) } else { error }
        })?;
        let achieved = Achieved::of_either(&own)?;
        found.push((scenario, own, achieved));
    }
    let speed = args.speed_rpm.map_or_else(|| found[0].1.case.crank().top_speed().abs(), |rpm| rpm * TAU / 60.0);
    let contenders =
        || found.iter().map(|own| contender(own, &args.file, speed)).collect::<Result<Vec<_>>>().map(apart);
    if found.len() > 1 || args.speed_rpm.is_some() {
        let all = contenders()?;
        let result = |result| -> Result<Made> {
            Ok(match result {
                CheckResults::Json => comparison::json(&all).into(),
                CheckResults::Svg => comparison::sheet(&all).into(),
                CheckResults::Csv => comparison::table(&all)?.into(),
                CheckResults::Markdown => comparison::markdown(&all).into(),
            })
        };
        return args.outputs.deliver(result, |width| comparison::text(&all, width));
    }
    let (scenario, task, _) = &found[0];
    let named = Task { name: scenario.name.clone(), title: scenario.title.clone(), ..task.clone() };
    let story = Story { task: &named, achieved: &found[0].2, search: None };
    let result = |result| -> Result<Made> {
        Ok(match result {
            CheckResults::Json => report::json(&story).into(),
            CheckResults::Svg => report::picture(&story)?.into(),
            CheckResults::Csv => comparison::table(&contenders()?)?.into(),
            CheckResults::Markdown => comparison::markdown(&contenders()?).into(),
        })
    };
    args.outputs.deliver(result, |_| report::text(&story))
}

/// A mechanism at the speed `speed` (rad/s), with its largest accelerations, reactions and moments. Its task gets the
/// name of its `file`, because the tasks of all mechanisms come from one synthesis file and have the same name.
fn contender((scenario, task, achieved): &(Scenario, Task, Achieved), file: &Path, speed: f64) -> Result<Contender> {
    let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let task = Task { name, case: at_speed(&task.case, speed)?, ..task.clone() };
    let told = |error| explained(&task.case, error);
    let (accelerations, peaks) =
        (OutputAccelerations::of(&task).map_err(told)?, bearings::over_range(&task.case).map_err(told)?);
    Ok(Contender { name: scenario.name.clone(), achieved: achieved.clone(), accelerations, peaks, task })
}

/// Appends numbers to the names of scenarios that have equal names.
fn apart(mut all: Vec<Contender>) -> Vec<Contender> {
    let names: Vec<String> = all.iter().map(|own| own.name.clone()).collect();
    for (index, own) in all.iter_mut().enumerate() {
        let earlier = names[..index].iter().filter(|name| **name == names[index]).count();
        if earlier > 0 {
            own.name = format!("{}-{}", own.name, earlier + 1);
        }
    }
    all
}

pub(super) fn cyclogram(args: &CyclogramArgs) -> Result<()> {
    let machine = Machine::load(&args.file)?;
    let achieved = machine.organs.iter().map(|organ| Achieved::of_either(&organ.task)).collect::<Result<Vec<_>>>()?;
    let cycle = Cycle { machine, achieved };
    let result = |result| -> Result<Made> {
        Ok(match result {
            CyclogramResults::Svg => cyclogram::sheet(&cycle).into(),
            CyclogramResults::Json => cyclogram::json(&cycle).into(),
            CyclogramResults::Csv => cyclogram::table(&cycle)?.into(),
        })
    };
    args.outputs.deliver(result, |width| cyclogram::text(&cycle, width))
}
