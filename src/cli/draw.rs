//! `linkproof draw`.

mod media;
mod motion;
mod subject;

use std::path::PathBuf;

use super::engine_args::side;
use super::{exit_code, number, output};
use drawing::sheet::{Cell, columns, sheet};
use drawing::view::Extras;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;
use media::Medium;
use prover::proof::Reference;
use subject::{Drawn, Wish};

/// Room of a picture that stands alone, and of one among others (mm).
const ALONE: [f64; 2] = [150.0, 120.0];
const AMONG: [f64; 2] = [100.0, 96.0];

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/draw.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario files; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Picture to write: .svg, .png, or one turn of the crank as .gif or .webp; `-` for SVG on standard output
    #[arg(long, short, value_name = "PICTURE", value_parser = picture)]
    output: PathBuf,
    /// Crank angle in degrees, as the scenario states it [default: that of the start]
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = number::finite)]
    crank_deg: Option<f64>,
    /// Start a group in another assembly mode than the file states, as in `linkproof run`
    #[arg(long, value_name = "LINK,LINK=MODE")]
    mode: Vec<String>,
    /// Number of a parameter, by its key in `[parameters]`; may be given several times
    #[arg(long, value_name = "KEY=NUMBER", value_parser = super::load::setting)]
    set: Vec<(String, f64)>,
    /// Draw all configurations at this crank angle, each with the modes of its groups
    #[arg(long)]
    each_mode: bool,
    /// Draw forces and moments as arrows with their sizes, and gravity
    #[arg(long)]
    loads: bool,
    /// Draw the paths of the points that are no joints
    #[arg(long)]
    traces: bool,
    /// Draw the path of this point; may be given several times
    #[arg(long, value_name = "POINT")]
    trace: Vec<String>,
    /// Write the lengths of the links
    #[arg(long)]
    dimensions: bool,
    /// Width of a bitmap in pixels [default: 800]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(100..=4000))]
    width: Option<u32>,
    /// Frames of an animation [default: 48]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=720))]
    frames: Option<u32>,
    /// Seconds that a turn takes in an animation [default: 4]
    #[arg(long, value_name = "S", value_parser = number::positive)]
    seconds: Option<f64>,
    /// Analytic solver
    #[arg(long, value_name = "SOLVER", default_value = "assur", value_parser = side())]
    with: Reference,
}

/// Path of a picture: one whose ending says how it is written, or standard output.
fn picture(text: &str) -> std::result::Result<PathBuf, String> {
    let path = output::target(text)?;
    Medium::of(&path)?;
    Ok(path)
}

/// Refuses options that mean nothing for the medium.
fn fits(args: &Args, medium: Medium) -> Result<()> {
    let refused = |option: &str, message: &str, help: &str| {
        Err(Error::new(ErrorKind::Input, message).key(option).help(help.to_string()))
    };
    let still = [("--frames", args.frames.is_some()), ("--seconds", args.seconds.is_some())];
    match still.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) if !medium.moves() => {
            refused(option, "the picture does not move", "leave it out, or write a .gif or a .webp")
        }
        _ if args.each_mode && medium.moves() => {
            let message = "an animation shows one configuration, but all of them are asked for";
            refused("--each-mode", message, "write an SVG or a PNG")
        }
        _ if args.width.is_some() && medium == Medium::Svg => {
            refused("--width", "an SVG has no pixels", "leave it out, or write a .png, .gif or .webp")
        }
        _ => Ok(()),
    }
}

/// Draws and writes. What could not be assembled is told on standard error, and by the exit code.
pub(super) fn draw(args: &Args) -> Result<u8> {
    let medium = Medium::of(&args.output).map_err(|message| Error::new(ErrorKind::Input, message).key("--output"))?;
    fits(args, medium)?;
    let frames = if medium.moves() { args.frames.map_or(48, |count| count as usize) } else { 1 };
    let extras = Extras { loads: args.loads, dimensions: args.dimensions, is_moving: medium.moves() };
    let wish = Wish {
        crank: args.crank_deg.map(f64::to_radians),
        modes: &args.mode,
        set: &args.set,
        each_mode: args.each_mode,
        all_traces: args.traces,
        traces: &args.trace,
        frames,
        solver: args.with.solver(),
    };
    let all = args.files.iter().map(|file| Drawn::of(file, &wish)).collect::<Result<Vec<_>>>()?;
    let count: usize = all.iter().map(|own| if args.each_mode { own.shots.len() } else { 1 }).sum();
    let room = Vec2::from(if columns(count) == 1 { ALONE } else { AMONG });
    // Per frame, the cells of all files.
    let mut sheets: Vec<Vec<Cell>> = vec![Vec::new(); frames];
    for own in &all {
        let cells = own.cells(extras, room, args.files.len() == 1);
        match args.each_mode {
            true => sheets[0].extend(cells),
            // What cannot move stands still in every frame.
            false => {
                let last = cells.last().cloned().into_iter().cycle();
                sheets.iter_mut().zip(cells.into_iter().chain(last)).for_each(|(sheet, cell)| sheet.push(cell));
            }
        }
    }
    let (title, subtitle) = headline(&all, medium.moves());
    let pages: Vec<_> = sheets.iter().map(|cells| sheet(&title, &subtitle, cells, room.x)).collect();
    let bytes = medium.bytes(&pages, &title, args.width.unwrap_or(800), args.seconds.unwrap_or(4.0) / frames as f64)?;
    output::write_bytes(&bytes, &args.output)?;
    for error in all.iter().flat_map(Drawn::faults) {
        output::show(error);
    }
    for note in all.iter().filter_map(|own| own.note.as_ref()) {
        output::note(note);
    }
    let is_whole = all.iter().all(|own| own.faults().next().is_none());
    Ok(if is_whole { exit_code::AGREE } else { exit_code::BAD_INPUT })
}

/// Title and subtitle of a sheet.
fn headline(all: &[Drawn], moves: bool) -> (String, String) {
    match all {
        [one] if moves => (one.name.clone(), one.title.clone()),
        [one] => (format!("{}, crank at {}", one.name, one.angle()), one.title.clone()),
        _ => (all.iter().map(|own| own.name.clone()).collect::<Vec<_>>().join(", "), String::new()),
    }
}
