//! `linkproof mark`.

use crate::sentences;
use std::path::{Path, PathBuf};

use super::exercise::{Within, language, within};
use super::exit_code::{AGREE, DISAGREE, graver};
use super::output::{self, End};
use super::outputs::{Outputs, results};
use crate::report::class_words::SheetLanguage;
use crate::report::exercise::{ClassKey, KeyedSheet, NamedSheet};
use crate::report::mark::{self as report, MarkOptions, StudentMarks};
use linkage::error::{Error, ErrorKind, Result};
use prover::mark::{AnswerSheet, MarkCriterion, MarkedSheet, columns_of, marked, read_answers};
use scenario::Scenario;
use scenario::source::text_of;
use scenario::words::choice;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/mark.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Directory of an exercise, or tables of answers in its directory `answers`
    #[arg(required = true, value_name = "DIR|FILE")]
    paths: Vec<PathBuf>,
    /// Allowed error of an answer: a fraction of the value, such as 5%, or `digits` for half a unit of the last
    /// requested decimal [default: as the sheets say]
    #[arg(long, value_name = "SHARE", value_parser = within)]
    within: Option<Within>,
    /// Allowed error of an answer: half a unit of the last decimal. A quantity has as many decimals as give its largest
    /// answer N significant digits
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=9), conflicts_with = "within")]
    digits: Option<u8>,
    /// Allowed error of an answer: half a unit of the last digit that the student wrote, and at most half a unit of the
    /// last requested decimal
    #[arg(long, conflicts_with_all = ["within", "digits"])]
    written: bool,
    /// Leave the right values out of the pages of the students
    #[arg(long)]
    hide_answers: bool,
    /// Language of the marks: en or uk [default: the language of the sheets]
    #[arg(long, value_name = "LANGUAGE", value_parser = language)]
    language: Option<SheetLanguage>,
    #[command(flatten)]
    outputs: Outputs<Marks>,
}

results! { Marks {
    Csv = "the table of the class",
    Json = "all cells",
    Results = "the page of the class, and a page for each student",
    Html = "all of these pages in one page",
} }

/// A class: its directory, its key, and the sheets to be marked, each with the path of its answers.
struct Class {
    directory: PathBuf,
    key: ClassKey,
    sheets: Vec<(KeyedSheet, PathBuf)>,
}

pub(super) fn mark(args: &Args) -> Result<u8> {
    let class = class(&args.paths)?;
    let criterion = match (args.within, args.digits, args.written) {
        (Some(Within(Some(share))), ..) => MarkCriterion::Within(share),
        (Some(Within(None)), ..) | (_, Some(_), _) => MarkCriterion::Digits,
        (None, None, true) => MarkCriterion::Written,
        (None, None, false) => class.key.criterion(),
    };
    let digits = args.digits.map_or(class.key.digits, usize::from);
    let options = MarkOptions {
        language: args.language.unwrap_or_else(|| class.key.language()),
        criterion,
        hides_answers: args.hide_answers,
    };
    let sheets =
        class.sheets.iter().map(|(keyed, _)| sheet(&class, keyed, digits)).collect::<Result<Vec<NamedSheet>>>()?;
    let (mut code, mut judged) = (AGREE, Vec::new());
    for (own, (_, path)) in sheets.iter().zip(&class.sheets) {
        let others: Vec<(&str, &AnswerSheet)> = sheets
            .iter()
            .filter(|other| other.name != own.name)
            .map(|other| (other.name.as_str(), &other.sheet))
            .collect();
        match judge(&class.key, own, path, criterion, &others) {
            Ok(found) => judged.push(Some(found)),
            Err(error) => {
                // The other tables are marked although this table cannot be read.
                code = graver(code, Result::<()>::Err(error).code());
                judged.push(None);
            }
        }
    }
    let marks = sheets.into_iter().zip(judged).filter_map(|(own, marked)| Some(StudentMarks { own, marked: marked? }));
    let all: Vec<StudentMarks> = marks.collect();
    if all.iter().any(|own| !own.is_right()) {
        code = graver(code, DISAGREE);
    }
    if !args.outputs.take_standard() && !all.is_empty() {
        output::print(&report::text(&all, options, Some(output::columns())))?;
    }
    let written = args.outputs.write_some(|result| match result {
        Marks::Csv => report::table(&all, options).map(Some),
        Marks::Json => Ok(Some(report::json(&all, options))),
        Marks::Html => Ok(Some(report::class_page(&all, options, false))),
        Marks::Results => Ok(None),
    });
    let pages = args.outputs.of(Marks::Results).try_for_each(|directory| pages(directory, &all, options));
    Ok([written, pages].into_iter().map(End::code).fold(code, graver))
}

/// Writes the page of the class and the pages of the students.
fn pages(directory: &Path, all: &[StudentMarks], options: MarkOptions) -> Result<()> {
    let mut files = vec![(directory.join("class.html"), report::class_page(all, options, true))];
    let student = |own| report::student_page(own, options);
    files.extend(all.iter().map(|own| (directory.join(format!("{}.html", own.own.name)), student(own))));
    output::may_make(&files.iter().map(|(path, _)| path.clone()).collect::<Vec<_>>())?;
    output::make_directory(directory, "--output", sentences::GIVE_A_DIRECTORY_THAT_MAY)?;
    files.iter().try_for_each(|(path, text)| output::make(text, path))
}

/// The class to which all paths belong. A directory selects all sheets of the class.
fn class(paths: &[PathBuf]) -> Result<Class> {
    let first = &paths[0];
    let refused = |message: String| {
        Err(Error::new(ErrorKind::Input, message).help(sentences::NAME_THE_DIRECTORY_OF_THE_EXERCISE))
    };
    let directory = match first.is_dir() {
        true => first.clone(),
        false => first.parent().unwrap_or(Path::new("")).join(".."),
    };
    let place = directory.join("key.json");
    if !place.is_file() {
        return refused(sentences::there_is_no_key_of_a_class(&first.display(), &place.display()));
    }
    let key = ClassKey::parse(&text_of(&place)?, &place.display().to_string())?;
    let answers = |name: &str| directory.join("answers").join(format!("{name}.csv"));
    if first.is_dir() {
        if paths.len() > 1 {
            return refused(sentences::a_directory_and_other_paths(&first.display()));
        }
        let sheets = key.sheets.iter().map(|own| (own.clone(), answers(&own.name))).collect();
        return Ok(Class { directory, key, sheets });
    }
    let mut sheets = Vec::new();
    for path in paths {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let Some(own) = key.sheets.iter().find(|own| own.name == name) else {
            let names = choice(key.sheets.iter().map(|own| own.name.as_str()).take(3), "");
            let message = sentences::is_no_sheet_of_this_class(&path.display(), &place.display());
            return Err(Error::new(ErrorKind::Input, message).help(sentences::its_sheets_are(&names)));
        };
        sheets.push((own.clone(), path.clone()));
    }
    Ok(Class { directory, key, sheets })
}

/// The right answers of a sheet, from its scenario.
fn sheet(class: &Class, keyed: &KeyedSheet, digits: usize) -> Result<NamedSheet> {
    let scenario = Scenario::load(class.directory.join("scenarios").join(format!("{}.toml", keyed.name)))?;
    let input = scenario.case.crank().input;
    let positions: Vec<f64> = keyed.positions.iter().map(|own| input.read(*own)).collect();
    let columns = columns_of(&class.key.asked, &scenario.case)?;
    Ok(NamedSheet { name: keyed.name.clone(), sheet: AnswerSheet::of(&scenario.case, columns, &positions, digits)? })
}

/// Judges the table of answers at `path`; `None` if the file is missing or has no answer.
fn judge(
    key: &ClassKey,
    own: &NamedSheet,
    path: &Path,
    criterion: MarkCriterion,
    others: &[(&str, &AnswerSheet)],
) -> Result<Option<MarkedSheet>> {
    if path.symlink_metadata().is_err() {
        return Ok(None);
    }
    let answers = read_answers(&text_of(path)?, path, &key.id(&own.name), &own.sheet)?;
    let is_empty = answers.iter().flatten().all(Option::is_none);
    Ok((!is_empty).then(|| marked(&own.sheet, &answers, criterion, others)))
}
