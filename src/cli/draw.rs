//! `linkproof draw`.

use crate::sentences;
use std::path::PathBuf;

use super::engine_args::side;
use super::instant::InstantArgs;
use super::output::{self, refused};
use super::{load, number};
use crate::draw::{Drawn, Medium, Note, PictureOptions, picture_and_warning};
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use prover::run::Reference;
use scenario::StartRequest;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/draw.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario files; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Picture to write: .svg, .pdf, .png, .dxf at full size in mm, or the motion as .gif or .webp; `-` for SVG on
    /// standard output
    /// [default: FILE.svg, for several files mechanisms.svg, in this directory]
    #[arg(long, short, value_name = "PICTURE", value_parser = target)]
    output: Option<PathBuf>,
    #[command(flatten)]
    instant: InstantArgs,
    /// Start a group in a different assembly mode from that of the file, as in `linkproof run`
    #[arg(long, value_name = "LINK,LINK=MODE")]
    mode: Vec<String>,
    /// Value of a parameter by its key, or of a number of the file by its path (links.crank.mass_kg); may be given
    /// several times
    #[arg(long, value_name = "KEY=NUMBER", value_parser = load::setting)]
    set: Vec<(String, f64)>,
    /// Draw all configurations at one crank angle, each with the modes of its groups
    #[arg(long)]
    each_mode: bool,
    /// Draw gravity, forces and moments as arrows with their sizes
    #[arg(long)]
    loads: bool,
    /// Draw the paths of all moving points, except joints that move on a circle about a pivot
    #[arg(long)]
    traces: bool,
    /// Draw the path of this point, or of a mass centre such as link.coupler; may be given several times
    #[arg(long, value_name = "POINT")]
    trace: Vec<String>,
    /// Draw N positions in one picture, equally spaced over a turn, over the grid or in time, and numbered along the
    /// paths of the points
    #[arg(long, value_name = "N")]
    positions: Option<usize>,
    /// Draw the path of this point beside the picture at a larger scale, with numbered positions; may be given several
    /// times
    #[arg(long, value_name = "POINT", value_delimiter = ',')]
    enlarge: Vec<String>,
    /// Draw the driving links and the groups apart, in the order in which they are solved
    #[arg(long)]
    groups: bool,
    /// Write the lengths and angles that define the links and the ground into the picture
    #[arg(long)]
    dimensions: bool,
    /// Draw a small picture, to be shown about 240 pixels wide: without words, numbers and scale, and with large
    /// symbols
    #[arg(long, conflicts_with_all = ["loads", "positions", "enlarge", "groups", "dimensions"])]
    small: bool,
    /// Width of a bitmap in pixels [default: 800]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(100..=4000))]
    width: Option<u32>,
    /// Frames of an animation [default: 48]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=720))]
    frames: Option<u32>,
    /// Duration of an animation in seconds [default: 4]
    #[arg(long, value_name = "S", value_parser = number::positive)]
    seconds: Option<f64>,
    /// Analytic solver
    #[arg(long, value_name = "SOLVER", default_value = "assur", value_parser = side())]
    with: Reference,
}

/// Reads the path of a picture, whose ending selects the format, or `-` for standard output.
fn target(text: &str) -> std::result::Result<PathBuf, String> {
    let path = output::target(text)?;
    Medium::of(&path)?;
    Ok(path)
}

/// Refuses options that do not apply to the picture's format.
fn fits(args: &Args, medium: Medium) -> Result<()> {
    let still = [("--frames", args.frames.is_some()), ("--seconds", args.seconds.is_some())];
    match still.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) if !medium.moves() => {
            refused(option, sentences::THE_PICTURE_DOES_NOT_MOVE, sentences::LEAVE_IT_OUT_OR_WRITE_A_GIF)
        }
        _ if args.each_mode && medium.moves() => {
            refused("--each-mode", sentences::AN_ANIMATION_SHOWS_ONE_CONFIGURATION, sentences::WRITE_AN_SVG_OR_A_PNG)
        }
        _ if args.width.is_some() && matches!(medium, Medium::Svg | Medium::Pdf | Medium::Dxf) => {
            refused("--width", sentences::AN_SVG_HAS_NO_PIXELS, sentences::LEAVE_IT_OUT_OR_WRITE_A_PNG)
        }
        _ => Ok(()),
    }
}

/// Draws the mechanisms and writes the picture.
/// If a mechanism cannot be assembled, the part that can be assembled is drawn, with a warning on standard error.
pub(super) fn draw(args: &Args) -> Result<()> {
    let medium = args.output.as_ref().map_or(Ok(Medium::Svg), Medium::of);
    let medium = medium.map_err(|message| Error::new(ErrorKind::Input, message).key("--output"))?;
    fits(args, medium)?;
    let wish = PictureOptions {
        at: None,
        each_mode: args.each_mode,
        loads: args.loads,
        dimensions: args.dimensions,
        all_traces: args.traces,
        traces: args.trace.clone(),
        positions: args.positions,
        enlarged: args.enlarge.clone(),
        groups: args.groups,
        small: args.small,
        solver: args.with,
        width: args.width,
        frames: args.frames.map(|count| count as usize),
        seconds: args.seconds,
        keys: Some(["--trace", "--enlarge", "--positions", "--groups"]),
    };
    load::each_once(&args.set, "--set")?;
    let asked = StartRequest { modes: args.mode.clone(), set: args.set.clone(), ..StartRequest::default() };
    let at_instant = |input: Input| PictureOptions { at: args.instant.of(input), ..wish.clone() };
    let drawn = |file: &PathBuf| match load::as_asked(file, &asked) {
        Ok(scenario) => {
            let wish = at_instant(scenario.case.crank().input);
            Drawn::of(scenario, &wish, medium).map_err(|error| args.instant.blamed(error))
        }
        // If the text itself has errors, reading the draft reports them.
        Err(error) => {
            let draft = load::draft(file, &asked)?;
            let wish = at_instant(draft.input());
            Drawn::of_draft(draft, &wish, medium, error)
        }
    };
    let all = args.files.iter().map(drawn).collect::<Result<Vec<_>>>()?;
    let (bytes, warning) = picture_and_warning(&all, &wish, medium)?;
    match &args.output {
        Some(to) => output::write_bytes(&bytes, to)?,
        None => {
            let stem = match args.files.as_slice() {
                [one] if !load::is_standard_input(one) => one.file_stem().unwrap_or_default().to_string_lossy(),
                _ => "mechanisms".into(),
            };
            output::make_here(&String::from_utf8_lossy(&bytes), &format!("{stem}.svg"))?;
        }
    }
    all.iter().filter_map(|own| own.fault.as_ref()).chain(&warning).for_each(output::warn);
    for own in &all {
        match &own.note {
            Some(Note::Said(note)) => output::note(note),
            Some(Note::OneOfMany) => {
                output::note(&sentences::each_mode_draws_all_configurations(&own.name));
            }
            None => {}
        }
    }
    Ok(())
}
