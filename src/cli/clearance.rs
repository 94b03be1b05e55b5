//! `linkproof clearance`.

use crate::sentences;
use std::path::{Path, PathBuf};

use super::exit_code::graver;
use super::load::plain;
use super::outputs::{Made, Outputs, results};
use super::progress::Bar;
use super::{exit_code, load, output};
use crate::report::clearance::{self as report, Standing};
use analytic::range::explained;
use design::clearance::{ClearanceResult, course, find};
use design::draw;
use linkage::error::{Error, ErrorKind, Result};
use scenario::Scenario;
use scenario::clearance::ClearanceQuestion;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/clearance.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario files with a section `[clearance]`; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    outputs: Outputs<ClearanceResults>,
}

results! { ClearanceResults {
    Json = "the results",
    Svg = "outlines, housing, swept areas and nearest points, for one scenario",
    Csv = "distance of every pair at the instants of the grid, for one scenario",
} }

/// Computes the clearance for every file. If a file is bad, the remaining files are still processed.
pub(super) fn clearance(args: &Args) -> Result<u8> {
    if args.outputs.each().any(|(form, _)| form != ClearanceResults::Json) && args.files.len() > 1 {
        let message = sentences::scenarios_are_given_but_a_drawing(&args.files.len());
        return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_ONE_SCENARIO_OR_WRITE));
    }
    let mut worst = exit_code::AGREE;
    let mut documents = Vec::new();
    for file in &args.files {
        match answer(args, file) {
            Ok((scenario, found)) => {
                let code = match report::standing(&found) {
                    Standing::Clear => exit_code::AGREE,
                    Standing::Collides | Standing::TooNear => exit_code::DISAGREE,
                    Standing::Open => exit_code::INCONCLUSIVE,
                };
                worst = graver(worst, code);
                documents.push(report::value(&scenario, question(&scenario), &found));
            }
            Err(error) => {
                output::show(&error);
                worst = exit_code::BAD_INPUT;
                documents.extend(report::failures(&load::named(file).display().to_string(), &error));
            }
        }
    }
    for to in args.outputs.of(ClearanceResults::Json) {
        output::write(&report::json(documents.clone()), to)?;
    }
    Ok(worst)
}

fn question(scenario: &Scenario) -> &ClearanceQuestion {
    scenario.clearance.as_ref().expect("only scenarios that ask are answered")
}

fn answer(args: &Args, file: &Path) -> Result<(Scenario, ClearanceResult)> {
    let scenario = plain(file)?;
    let Some(asked) = &scenario.clearance else {
        return Err(Error::new(ErrorKind::Input, sentences::the_scenario_asks_nothing_about(&file.display()))
            .key("clearance")
            .help(sentences::ADD_A_SECTION_CLEARANCE_FOR_EXAMPLE));
    };
    let mut bar = Bar::new(&scenario.name);
    let found =
        find(&scenario.case, asked, &mut |part| bar.at(part)).map_err(|error| explained(&scenario.case, error))?;
    drop(bar);
    for to in args.outputs.of(ClearanceResults::Svg) {
        Made::from(draw::clearance(&scenario.case, &scenario.name, asked, &found)?).write(to)?;
    }
    for to in args.outputs.of(ClearanceResults::Csv) {
        let course = course(&scenario.case, asked)?;
        let (input, times) = (scenario.case.crank().input, &scenario.case.grid.times);
        output::write(&report::distances(asked, input, times, &course)?, to)?;
    }
    if !args.outputs.take_standard() {
        output::print(&report::text(&scenario, asked, &found, output::width()))?;
    }
    Ok((scenario, found))
}
