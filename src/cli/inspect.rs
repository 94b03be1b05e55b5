//! `linkproof inspect`.

use std::path::PathBuf;

use super::instant::InstantArgs;
use super::outputs::{Outputs, results};
use super::{load, number, output};
use crate::report::drivers::Drivers;
use crate::report::fixed::FixedStructure;
use crate::report::{inspect as report, modes, range};
use crate::sentences;
use analytic::range::explained;
use design::plan::grid_at;
use linkage::case::{Case, When};
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::JointId;
use linkage::work::limited;
use prover::run::BUDGET;
use scenario::StartRequest;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/inspect.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// List all real configurations of every group, with angles, angular velocities and positions of points
    #[arg(long)]
    modes: bool,
    /// Show the crank angles over which the mechanism can be followed, its singular and extreme positions, and its
    /// transmission angles
    #[arg(long, conflicts_with = "modes")]
    range: bool,
    #[command(flatten)]
    instant: InstantArgs,
    /// Show the structure for another driven joint: its groups and its class; `all` shows every joint
    #[arg(long, value_name = "JOINT", conflicts_with_all = ["modes", "range"])]
    driver: Option<String>,
    /// Work allowed for --range, in steps of an engine without sweeps [default: 2e7]
    #[arg(long, value_name = "STEPS", allow_hyphen_values = true, requires = "range", value_parser = number::positive)]
    budget: Option<f64>,
    /// Start a group in a different assembly mode from that of the file, as in `linkproof run`
    #[arg(long, value_name = "LINK,LINK=MODE")]
    mode: Vec<String>,
    #[command(flatten)]
    outputs: Outputs<Inspected>,
}

results! { Inspected {
    Json = "structure, configurations or range",
} }

pub(super) fn inspect(args: &Args) -> Result<()> {
    if let (false, (option, true)) = (args.modes, args.instant.told()) {
        return output::refused(option, sentences::ONLY_MODES_HAS_AN_INSTANT, sentences::LEAVE_IT_OUT_OR_ADD_MODES);
    }
    let asked = StartRequest { modes: args.mode.clone(), ..StartRequest::default() };
    // If the file leaves the configuration open, a list of all configurations is most useful, so `to_list` accepts such
    // a file.
    let found = match args.modes {
        true => load::to_list(&args.file, &asked),
        false => load::as_asked(&args.file, &asked).map(|scenario| (scenario, Vec::new())),
    };
    let (scenario, undecided) = match found {
        Ok(found) => found,
        Err(error) => return without_drive(args, &asked, error),
    };
    let scenario = scenario.nominal();
    let case = &scenario.case;
    let modes = match args.modes {
        true => {
            let when = args.instant.of(case.crank().input).unwrap_or(When::Crank(case.crank().start));
            let grid = grid_at(&case.drives, when).map_err(|error| args.instant.blamed(error))?;
            Some((grid.inputs[0], analytic::modes::all(case, when).map_err(|error| explained(case, error))?))
        }
        false => None,
    };
    let range = match args.range {
        true => Some(limited(args.budget.unwrap_or(BUDGET), || analytic::range::Range::of(case)).0?),
        false => None,
    };
    let drivers = args.driver.as_ref().map(|name| drivers(case, name)).transpose()?;
    let modes = modes.as_ref().map(|(crank, all)| (*crank, all.as_slice()));
    let text = |width| match (modes, &range, &drivers) {
        (Some((crank, modes)), ..) => modes::text(&scenario, crank, modes, &undecided),
        (None, Some(range), _) => range::text(&scenario, range, width),
        (None, None, Some(drivers)) => drivers.text(case),
        (None, None, None) => report::text(&scenario),
    };
    args.outputs.deliver(|_| Ok(report::json(&scenario, modes, &undecided, range.as_ref(), drivers.as_ref())), text)
}

/// Shows a file without a drive, if its links form a structure; otherwise returns `error`.
fn without_drive(args: &Args, asked: &StartRequest, error: Error) -> Result<()> {
    let Ok(draft) = load::draft(&args.file, asked) else { return Err(error) };
    if !draft.is_fixed() {
        return Err(error);
    }
    let moving = [("--range", args.range), ("--driver", args.driver.is_some()), args.instant.told()];
    if let Some((option, _)) = moving.into_iter().find(|(_, is_given)| *is_given) {
        let error = Error::new(ErrorKind::Input, sentences::THE_STRUCTURE_DOES_NOT_MOVE).key(option);
        return Err(error.help(sentences::TAKE_IT_OUT_OR_ADD_A_DRIVE));
    }
    let fixed = FixedStructure::of(&draft)?;
    let further = if args.modes { "" } else { sentences::MODES_LISTS_THEM };
    args.outputs.deliver(|_| Ok(fixed.json()), |_| fixed.text(args.modes) + further)
}

/// The structures for the driven joint called `name`, or for all joints without a further drive.
fn drivers(case: &Case, name: &str) -> Result<Drivers> {
    let joints = case.mechanism.joints();
    let is_open = |id: JointId| case.drives.further().iter().all(|drive| drive.joint != id);
    let asked: Vec<JointId> =
        joints.ids().filter(|&id| joints[id].name == name || name == "all" && is_open(id)).collect();
    if asked.is_empty() {
        let names: Vec<&str> = joints.iter().map(|joint| joint.name.as_str()).collect();
        let error = Error::new(ErrorKind::Input, sentences::there_is_no_joint_called(&name));
        return Err(error.help(sentences::give_one_of_the_joints(&names.join(", "))));
    }
    Ok(Drivers::of(case, &asked))
}
