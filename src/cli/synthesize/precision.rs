//! `linkproof synthesize function`, `motion` and `path`.

use crate::sentences;
use std::f64::consts::TAU;
use std::fmt::Display;

use super::closed_form::{ClosedForms, deliver, named, numbers, pair};
use crate::cli::outputs::Outputs;
use crate::cli::{number, output};
use crate::report::precision as report;
use design::synthesize::DraftContents;
use design::synthesize::precision::{
    CouplerPose, FunctionSpec, FunctionStart, MotionSpec, PathSpec, PrecisionFourBar, PrecisionSynthesis, TimedPoint,
};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Complex;

/// Number of four-bars in the table, unless `--take` has a larger number.
const SHOWN: usize = 10;

/// Destination of the results, the four-bar to write, and the scenario's data other than dimensions.
#[derive(Debug, clap::Args)]
struct Target {
    #[command(flatten)]
    outputs: Outputs<ClosedForms>,
    /// Table number of the four-bar to write and prove [default: 1, if it has no defect]
    #[arg(long, value_name = "N", value_parser = number::row)]
    take: Option<usize>,
    /// Speed of the crank in the scenario, in turns per minute. The sense follows from the order of the positions
    #[arg(long, value_name = "RPM", default_value = "60", allow_hyphen_values = true, value_parser = number::positive)]
    rpm: f64,
    /// Mass per metre of the links in the scenario, which are uniform bars
    #[arg(long, value_name = "KG_PER_M", default_value = "1", allow_hyphen_values = true, value_parser = number::positive)]
    bar_kg_per_m: f64,
}

impl Target {
    /// Number of four-bars in the table.
    fn wanted(&self) -> usize {
        self.take.map_or(SHOWN, |take| take.max(SHOWN))
    }

    /// Index of the four-bar to write.
    fn taken(&self, found: &PrecisionSynthesis) -> Result<usize> {
        match self.take {
            Some(take) if take > found.best.len() => {
                let message = sentences::the_table_has_only(&found.best.len(), &take);
                output::refused("--take", message, sentences::TAKE_A_NUMBER_OF_THE_TABLE)
            }
            Some(take) => Ok(take - 1),
            None if found.keep_order == 0 => {
                let message = sentences::four_bars_have_defects(&found.found);
                Err(Error::new(ErrorKind::Geometry, message).help(sentences::TAKE_ONE_NEVERTHELESS))
            }
            None => Ok(0),
        }
    }

    /// Writes the four-bar of `--take`, and reports all four-bars.
    fn deliver(&self, task: &Task, found: &PrecisionSynthesis) -> Result<()> {
        let taken = self.taken(found)?;
        let own: &PrecisionFourBar = &found.best[taken];
        let Task { command, title, arguments } = task;
        let take = self.take.map_or(String::new(), |take| format!(" --take {take}"));
        let sheet = DraftContents {
            name: named(&self.outputs, &format!("{command}_found")),
            title: (*title).into(),
            comment: sentences::linkproof_synthesize_precision(command, &(arguments.clone() + &take)),
            speed: self.rpm * TAU / 60.0,
            bar: self.bar_kg_per_m,
        };
        deliver(&self.outputs, &own.scenario(&sheet), |proof| report::precision(title, found, taken, proof))
    }
}

/// The command and its arguments, as a comment of the scenario.
struct Task {
    command: &'static str,
    title: &'static str,
    arguments: String,
}

/// An option given once for each value, as on the command line.
fn repeated<const N: usize>(option: &str, values: &[[f64; N]]) -> String {
    values.iter().map(|value| format!(" --{option} {}", joined(value))).collect()
}

fn joined(values: &[impl Display]) -> String {
    values.iter().map(ToString::to_string).collect::<Vec<_>>().join(",")
}

/// A point from millimetres.
fn place(&[x, y]: &[f64; 2]) -> Complex {
    Complex::new(x / 1e3, y / 1e3)
}

fn places(all: &[[f64; 2]]) -> Vec<Complex> {
    all.iter().map(place).collect()
}

#[derive(Debug, clap::Args)]
pub(super) struct FunctionArgs {
    /// Pivot of the crank
    #[arg(long, value_name = "X,Y", default_value = "0,0", value_parser = pair, allow_hyphen_values = true)]
    crank_pivot_mm: [f64; 2],
    /// Pivot of the rocker
    #[arg(long, value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    pivot_mm: [f64; 2],
    /// Angles of crank and rocker, counter-clockwise positive; three to five times. Three pairs are angles from x.
    /// Of four and five pairs, only the differences from the first pair are kept
    #[arg(long, value_name = "CRANK,ROCKER", required = true, value_parser = pair, allow_hyphen_values = true)]
    pair_deg: Vec<[f64; 2]>,
    /// Keep only the differences from the first pair, also with three pairs
    #[arg(long)]
    free_start: bool,
    #[command(flatten)]
    target: Target,
}

pub(super) fn function(args: &FunctionArgs) -> Result<()> {
    let is_free = args.free_start || args.pair_deg.len() > 3;
    let spec = FunctionSpec {
        pivots: [&args.crank_pivot_mm, &args.pivot_mm].map(place),
        pairs: args.pair_deg.iter().map(|pair| pair.map(f64::to_radians)).collect(),
        start: if is_free { FunctionStart::Free } else { FunctionStart::World },
    };
    let pivots = [("crank-pivot-mm", args.crank_pivot_mm), ("pivot-mm", args.pivot_mm)];
    let mut arguments: String = pivots.iter().map(|(option, value)| repeated(option, &[*value])).collect();
    arguments += &repeated("pair-deg", &args.pair_deg);
    if args.free_start {
        arguments += " --free-start";
    }
    let task = Task { command: "function", title: sentences::FUNCTION_GENERATOR_THROUGH_PAIRS, arguments };
    args.target.deliver(&task, &spec.four_bars(args.target.wanted())?)
}

/// Three numbers separated by commas.
fn triple(text: &str) -> std::result::Result<[f64; 3], String> {
    numbers(text, sentences::THREE_NUMBERS_WITH_COMMAS)
}

#[derive(Debug, clap::Args)]
pub(super) struct MotionArgs {
    /// Pose of the coupler: working point in mm, and angle in deg, counter-clockwise; three to five times
    #[arg(long, value_name = "X,Y,DEG", required = true, value_parser = triple, allow_hyphen_values = true)]
    pose: Vec<[f64; 3]>,
    /// Given pivot, for three poses; at most two pivots and pins together
    #[arg(long, value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    pivot_mm: Vec<[f64; 2]>,
    /// Given pin of the coupler, for three poses; origin at the working point, x axis at the pose's angle
    #[arg(long, value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    pin_mm: Vec<[f64; 2]>,
    #[command(flatten)]
    target: Target,
}

pub(super) fn motion(args: &MotionArgs) -> Result<()> {
    let pose = |&[x, y, angle]: &[f64; 3]| CouplerPose { point: place(&[x, y]), angle: angle.to_radians() };
    let spec = MotionSpec {
        poses: args.pose.iter().map(pose).collect(),
        pivots: places(&args.pivot_mm),
        pins: places(&args.pin_mm),
    };
    let given = [("pivot-mm", &args.pivot_mm), ("pin-mm", &args.pin_mm)];
    let given: String = given.iter().map(|(option, values)| repeated(option, values)).collect();
    let arguments = repeated("pose", &args.pose) + &given;
    let task = Task { command: "motion", title: sentences::MOTION_GENERATOR_THROUGH_POSES, arguments };
    args.target.deliver(&task, &spec.four_bars(args.target.wanted())?)
}

#[derive(Debug, clap::Args)]
pub(super) struct PathArgs {
    /// Point of the path; three to five times
    #[arg(long, value_name = "X,Y", required = true, value_parser = pair, allow_hyphen_values = true)]
    point_mm: Vec<[f64; 2]>,
    /// Crank angle at a point, counter-clockwise positive; once for each point. Only differences of crank angles matter
    #[arg(long, value_name = "DEG", required = true, value_parser = number::finite, allow_hyphen_values = true)]
    crank_deg: Vec<f64>,
    #[command(flatten)]
    target: Target,
}

pub(super) fn path(args: &PathArgs) -> Result<()> {
    let (points, cranks) = (&args.point_mm, &args.crank_deg);
    if points.len() != cranks.len() {
        let message = sentences::points_and_crank_angles_differ(&points.len(), &cranks.len());
        return output::refused("--crank-deg", message, sentences::GIVE_EVERY_POINT_ITS_CRANK_ANGLE);
    }
    let all = points.iter().zip(cranks);
    let point = |(at, crank): (&[f64; 2], &f64)| TimedPoint { point: place(at), crank: crank.to_radians() };
    let spec = PathSpec { points: all.clone().map(point).collect() };
    let one = |(at, crank): (&[f64; 2], &f64)| repeated("point-mm", &[*at]) + &repeated("crank-deg", &[[*crank]]);
    let task =
        Task { command: "path", title: sentences::PATH_GENERATOR_THROUGH_POINTS, arguments: all.map(one).collect() };
    args.target.deliver(&task, &spec.four_bars(args.target.wanted())?)
}
