//! `linkproof exercise`.

use crate::sentences;
use std::path::{Path, PathBuf};

use super::grid::GridArgs;
use super::load::plain;
use super::outputs::{Outputs, results};
use super::{number, output};
use crate::draw::{Drawn, Medium, PictureOptions, picture};
use crate::report::class_words::SheetLanguage;
use crate::report::exercise::{self as report, ClassKey, KeyedSheet, NamedSheet};
use design::exercise::{ExerciseMechanism, VariationWish, as_given, positions};
use linkage::case::When;
use linkage::error::{Error, ErrorKind, Result};
use prover::mark::{AnswerSheet, columns_of};
use scenario::Scenario;
use scenario::source::text_of;
use scenario::varied::NumberSort;
use scenario::words::choice;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/exercise.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario files. If there are several, the students take them in turn
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Number of students; numbers are drawn for each student. Without this option, each file gives one sheet with the
    /// numbers of the file
    #[arg(short = 'n', long = "students", value_name = "N", value_parser = number::count)]
    students: Option<usize>,
    /// Seed of the random numbers. The same seed gives the same numbers
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// Numbers that are drawn: lengths, speed, masses or loads; may be given several times [default: lengths and speed]
    #[arg(long, value_name = "WHAT", value_parser = sort, requires = "students")]
    vary: Vec<NumberSort>,
    /// Largest change of a number, in per cent
    #[arg(long, value_name = "PERCENT", default_value = "20", value_parser = per_cent)]
    spread: f64,
    /// Lower limit of the transmission angle over the whole range and at the requested positions. The sine of the limit
    /// is at most three quarters of each group's smallest sine in the original mechanism (range) or largest sine in the
    /// sheet's mechanism (positions)
    #[arg(long, value_name = "DEG", default_value = "20", value_parser = angle)]
    transmission_deg: f64,
    /// Requested quantities: a channel, a magnitude (point.B.v_m_s, point.B.a_m_s2, joint.B.f_N), or a stage
    /// (positions, reactions); may be given several times [default: all stages except reactions]
    #[arg(long, value_name = "WORD")]
    ask: Vec<String>,
    /// Number of requested positions: the start pose, and further positions evenly spread over the range
    #[arg(long, value_name = "N", default_value = "4", value_parser = number::count, conflicts_with_all = ["crank_deg", "times"])]
    positions: usize,
    #[command(flatten)]
    grid: GridArgs,
    /// Number of significant digits in the largest answer of each quantity
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=9))]
    digits: u8,
    /// Allowed error of an answer: a fraction of the value, such as 5%, or `digits` for half a unit of the last
    /// requested decimal
    #[arg(long, value_name = "SHARE", default_value = "5%", value_parser = within)]
    within: Within,
    /// Language of the sheets: en or uk
    #[arg(long, value_name = "LANGUAGE", default_value = "en", value_parser = language)]
    language: SheetLanguage,
    #[command(flatten)]
    outputs: Outputs<Exercises>,
}

results! { Exercises {
    Results = "task sheets, empty answer tables, scenarios, and the answers for the teacher [default: exercise]",
} }

/// The criterion of an exercise: a fraction of each value; `None` for half a unit of the last requested decimal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Within(pub(super) Option<f64>);

/// Reads a fraction such as `5%` or `0.05`, or `digits`.
pub(super) fn within(text: &str) -> std::result::Result<Within, String> {
    if text == "digits" {
        return Ok(Within(None));
    }
    let share = match text.strip_suffix('%') {
        Some(percent) => number::positive(percent)? / 100.0,
        None => number::positive(text)?,
    };
    if share < 1.0 { Ok(Within(Some(share))) } else { Err(sentences::EXPECTED_A_SHARE_SUCH_AS.into()) }
}

pub(super) fn language(text: &str) -> std::result::Result<SheetLanguage, String> {
    let codes = SheetLanguage::ALL.map(SheetLanguage::code);
    SheetLanguage::named(text).ok_or_else(|| sentences::expected_one_of(&choice(codes, "")))
}

fn sort(text: &str) -> std::result::Result<NumberSort, String> {
    NumberSort::named(text)
        .ok_or_else(|| sentences::expected_one_of(&choice(NumberSort::ALL.map(NumberSort::name), "")))
}

fn per_cent(text: &str) -> std::result::Result<f64, String> {
    let percent = number::positive(text.trim_end_matches('%'))?;
    if percent <= 50.0 { Ok(percent / 100.0) } else { Err(sentences::EXPECTED_AT_MOST_50_PER_CENT.into()) }
}

fn angle(text: &str) -> std::result::Result<f64, String> {
    let degrees = number::positive(text)?;
    if degrees < 90.0 { Ok(degrees.to_radians()) } else { Err(sentences::EXPECTED_AN_ANGLE_BELOW_90.into()) }
}

/// A sheet with its scenario and drawing. `start` is the input of the given start pose, if the sheet replaces this pose
/// because it is nearly singular.
struct Made {
    own: NamedSheet,
    scenario: Scenario,
    picture: String,
    start: Option<f64>,
}

pub(super) fn exercise(args: &Args) -> Result<()> {
    let directory = args.outputs.first(Exercises::Results).unwrap_or(Path::new("exercise"));
    let seed = args.students.map(|_| args.seed);
    let mut key = ClassKey::new(seed, args.language, args.within.0, usize::from(args.digits), args.ask.clone());
    let mut all = Vec::new();
    for scenario in scenarios(args)? {
        let made = made(args, scenario)?;
        let input = made.scenario.case.crank().input;
        // The key has the positions in the units and digits of the sheet, so a program reads the positions back
        // unchanged.
        let positions = made.own.sheet.positions().iter().map(|own| input.shown(*own)).collect();
        key.sheets.push(KeyedSheet { name: made.own.name.clone(), positions });
        all.push(made);
    }
    let place = |folder: &str, name: &str| directory.join(folder).join(name);
    let mut files = Vec::new();
    for made in &all {
        let name = &made.own.name;
        let page = report::task(&made.own, &made.scenario, &made.picture, &key, made.start);
        files.push((place("tasks", &format!("{name}.html")), page));
        let answers = report::empty_answers(&key.id(name), &made.own.sheet)?;
        files.push((place("answers", &format!("{name}.csv")), answers));
        files.push((place("scenarios", &format!("{name}.toml")), made.scenario.text.clone()));
    }
    let sheets: Vec<NamedSheet> = all.into_iter().map(|made| made.own).collect();
    files.push((place("teacher", "answers.csv"), report::all_answers(&sheets)?));
    files.push((place("teacher", "answers.html"), report::answers_page(&sheets, &key)));
    files.push((directory.join("key.json"), key.text()));
    output::may_make(&files.iter().map(|(path, _)| path.clone()).collect::<Vec<_>>())?;
    is_of_this_class(directory, &key)?;
    for (path, text) in &files {
        if let Some(parent) = path.parent() {
            output::make_directory(parent, "--output", sentences::GIVE_A_DIRECTORY_THAT_MAY)?;
        }
        output::make(text, path)?;
    }
    let quoted = output::quoted(&directory.to_string_lossy());
    output::print(&sentences::sheets_are_in(&sheets.len(), &directory.display(), &quoted))
}

/// Refuses a directory with sheets of another class, which would otherwise stay beside the new sheets.
fn is_of_this_class(directory: &Path, key: &ClassKey) -> Result<()> {
    let place = directory.join("key.json");
    // `may_make` has already refused anything but a regular file with a key.
    let old = text_of(&place).and_then(|text| ClassKey::parse(&text, &place.display().to_string()));
    let sheets = old.map(|old| old.sheets).unwrap_or_default();
    let Some(other) = sheets.iter().find(|old| key.sheets.iter().all(|new| new.name != old.name)) else {
        return Ok(());
    };
    let message = sentences::holds_the_sheets_of_another_class(&directory.display(), &other.name);
    Err(Error::new(ErrorKind::Input, message).key("--output").help(sentences::NAME_ANOTHER_DIRECTORY_FOR_THE_CLASS))
}

/// The scenarios of all sheets: one for each student, or one for each file.
fn scenarios(args: &Args) -> Result<Vec<Scenario>> {
    let originals = args.files.iter().map(|file| plain(file)).collect::<Result<Vec<Scenario>>>()?;
    let Some(students) = args.students else {
        let names: Vec<&str> = originals.iter().map(|own| own.name.as_str()).collect();
        if let Some(twice) = (1..names.len()).find(|&at| names[..at].contains(&names[at])) {
            let error = Error::new(ErrorKind::Input, sentences::two_scenarios_are_called(&names[twice]));
            return Err(error.help(sentences::GIVE_EVERY_SCENARIO_A_NAME));
        }
        return originals.iter().map(|own| as_given(own, &own.name)).collect();
    };
    let sorts = if args.vary.is_empty() { vec![NumberSort::Lengths, NumberSort::Speed] } else { args.vary.clone() };
    let transmission = args.transmission_deg;
    let wish = VariationWish { seed: args.seed, share: args.spread, sorts, transmission };
    let mechanisms = originals.into_iter().map(|own| ExerciseMechanism::of(own, &wish)).collect::<Result<Vec<_>>>()?;
    let drawn = |student: usize| {
        let name = format!("student_{:03}", student + 1);
        let mechanism = &mechanisms[student % mechanisms.len()];
        Ok(mechanism.drawn(&wish, student as u64, &name)?.scenario)
    };
    (0..students).map(drawn).collect()
}

fn made(args: &Args, scenario: Scenario) -> Result<Made> {
    let input = scenario.case.crank().input;
    let found = match args.grid.is_given() {
        true => args.grid.on(scenario.clone())?.case.grid.inputs.clone(),
        false => positions(&scenario, args.positions, args.transmission_deg)?,
    };
    // The sheet shows positions with few decimals. The answers must belong to these rounded positions.
    let found: Vec<f64> = found.iter().map(|own| input.read((input.shown(*own) * 1e6).round() / 1e6)).collect();
    let columns = columns_of(&args.ask, &scenario.case)?;
    let sheet = AnswerSheet::of(&scenario.case, columns, &found, usize::from(args.digits))?;
    let start = scenario.case.crank().start;
    let moved = (!args.grid.is_given() && (found[0] - start).abs() > 1e-6).then(|| input.shown(start));
    let wish = PictureOptions { at: Some(When::Crank(found[0])), dimensions: true, ..PictureOptions::default() };
    // The page has a title, so the drawing needs none.
    let untitled = Scenario { title: String::new(), ..scenario.clone() };
    let drawn = Drawn::of(untitled, &wish, Medium::Svg)?;
    let picture = String::from_utf8_lossy(&picture(&[drawn], &wish, Medium::Svg)?).into_owned();
    Ok(Made { own: NamedSheet { name: scenario.name.clone(), sheet }, scenario, picture, start: moved })
}
