//! `linkproof inspect`.

use std::path::PathBuf;

use super::instant::InstantArgs;
use super::outputs::{Made, Outputs, results};
use super::{load, number, output};
use crate::draw::{Drawn, Medium, PictureOptions, drawing};
use crate::report::drivers::Drivers;
use crate::report::fixed::FixedStructure;
use crate::report::{inspect as report, modes, range};
use crate::sentences;
use analytic::range::explained;
use design::plan::grid_at;
use linkage::case::{Case, When};
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::mechanism::{GROUND, JointId, LinkId};
use linkage::work::limited;
use prover::run::BUDGET;
use scenario::StartRequest;
use scenario::words::nearest;

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
    /// Show groups and class of the structure for another driving link on the ground, or for another driven joint;
    /// without a name, or with `all`, a table with a row for every joint
    #[arg(long, value_name = "LINK", num_args = 0..=1, default_missing_value = ALL)]
    #[arg(conflicts_with_all = ["modes", "range"])]
    driver: Option<String>,
    /// Work allowed for --range; the unit is an engine step without sweeps [default: 2e7]
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
    Svg = "groups drawn apart, in the order in which they are solved",
} }

/// Name that means all joints.
const ALL: &str = "all";

impl Args {
    /// The first given option whose result the drawing of the groups cannot show.
    fn of_motion(&self) -> Option<&'static str> {
        let all = self.driver.as_ref().is_some_and(|name| name == ALL);
        [("--modes", self.modes), ("--range", self.range), ("--driver", all)]
            .into_iter()
            .find(|own| own.1)
            .map(|own| own.0)
    }

    /// The picture options for the drawing of the groups.
    fn groups(&self, input: Input) -> PictureOptions {
        PictureOptions { at: self.instant.of(input), groups: true, ..PictureOptions::default() }
    }
}

pub(super) fn inspect(args: &Args) -> Result<()> {
    let is_drawn = args.outputs.each().any(|(own, _)| own != Inspected::Json);
    if let (false, (option, true)) = (args.modes || is_drawn, args.instant.told()) {
        return output::refused(option, sentences::ONLY_MODES_HAS_AN_INSTANT, sentences::LEAVE_IT_OUT_OR_ADD_MODES);
    }
    if let (true, Some(option)) = (is_drawn, args.of_motion()) {
        return output::refused(option, sentences::A_DRAWING_SHOWS_THE_GROUPS, sentences::LEAVE_IT_OUT_OR_WRITE_JSON);
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
    let of_file = is_drawn.then(|| scenario.clone());
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
    let made = |result: Inspected| match (result, &of_file) {
        (Inspected::Svg, Some(scenario)) => {
            let wish = args.groups(scenario.case.crank().input);
            let drawn = Drawn::of(scenario.clone(), &wish, Medium::Svg).map_err(|error| args.instant.blamed(error))?;
            let drawn = match &drivers {
                Some(drivers) => drawn.with_structure(drivers.only()?),
                None => drawn,
            };
            Ok(drawing_of(drawn, &wish))
        }
        (Inspected::Json | Inspected::Svg, _) => {
            Ok(report::json(&scenario, modes, &undecided, range.as_ref(), drivers.as_ref()).into())
        }
    };
    args.outputs.deliver(made, text)
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
    let made = |result: Inspected| match result {
        Inspected::Svg => {
            let wish = args.groups(draft.input());
            Ok(drawing_of(Drawn::of_draft(draft.clone(), &wish, Medium::Svg, error.clone())?, &wish))
        }
        Inspected::Json => Ok(fixed.json().into()),
    };
    args.outputs.deliver(made, |_| fixed.text(args.modes) + further)
}

/// The drawing. If parts of it are missing because of a fault, the fault is printed as a warning.
fn drawing_of(drawn: Drawn, wish: &PictureOptions) -> Made {
    drawn.fault.iter().for_each(output::warn);
    drawing(drawn, wish).into()
}

/// The structures for the driven joint or the driving link called `name`.
/// For the name `all`, the result contains the structure for every joint, except the joints of the further drives.
fn drivers(case: &Case, name: &str) -> Result<Drivers> {
    let (links, joints) = (case.mechanism.links(), case.mechanism.joints());
    let is_open = |id: &JointId| case.drives.further().iter().all(|drive| drive.joint != *id);
    let on_ground = |link: LinkId| case.mechanism.joints_on(link).iter().filter(|&&id| joints[id].on(GROUND).is_some());
    let refused = |message: String, help: String| Err(Error::new(ErrorKind::Input, message).key("--driver").help(help));
    let asked: Vec<JointId> = match (case.mechanism.joint_named(name), case.mechanism.link_named(name)) {
        _ if name == ALL => joints.ids().collect(),
        (Some(joint), _) => vec![joint],
        (None, Some(link)) if link != GROUND => on_ground(link).copied().collect(),
        (None, _) => Vec::new(),
    };
    let open: Vec<JointId> = asked.iter().copied().filter(is_open).collect();
    if !open.is_empty() {
        return Ok(Drivers::of(case, &open));
    }
    if let [joint, ..] = asked[..] {
        let message = sentences::another_drive_moves_the_joint(&joints[joint].name);
        return refused(message, sentences::GIVE_A_JOINT_WITHOUT_A_FURTHER_DRIVE.into());
    }
    let named = |id: LinkId| links[id].name.as_str();
    let drivable = links.ids().skip(1).filter(|&link| on_ground(link).any(is_open)).map(named);
    let drivable = drivable.collect::<Vec<_>>().join(", ");
    if let Some(link) = case.mechanism.link_named(name) {
        let own =
            case.mechanism.joints_on(link).iter().map(|&id| joints[id].name.as_str()).collect::<Vec<_>>().join(", ");
        let help = sentences::give_a_link_on_the_ground_or_a_joint(&drivable, &own);
        let message = match link {
            GROUND => sentences::THE_GROUND_IS_NO_DRIVING_LINK.to_string(),
            _ => sentences::the_link_has_no_joint_with_the_ground(&name),
        };
        return refused(message, help);
    }
    let names = || links.iter().skip(1).map(|link| &link.name).chain(joints.iter().map(|joint| &joint.name));
    let near =
        nearest(name, names().map(String::as_str)).map_or_else(String::new, |near| sentences::did_you_mean(&near));
    let joints = joints.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>().join(", ");
    let help = near + &sentences::give_a_driving_link_or_a_joint(&drivable, &joints);
    refused(sentences::there_is_no_link_or_joint_called(&name), help)
}
