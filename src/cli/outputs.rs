//! The option `-o FILE` of all commands: the file ending selects the result and its form.

use crate::sentences;
use std::collections::VecDeque;
use std::fmt::Debug;
use std::path::{Path, PathBuf};

use clap::error::ErrorKind as Wrong;
use clap::{Arg, ArgAction, ArgMatches, Command, FromArgMatches};

use super::output;
use crate::draw::Medium;
use drawing::paper::document::Drawing;
use linkage::error::{Error, Result};

/// A form of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Csv,
    Dxf,
    Html,
    Json,
    Junit,
    Markdown,
    Mjcf,
    /// A page of Markdown in a directory that the command makes.
    Page,
    /// A directory of files whose names the command chooses.
    Results,
    Scenario,
    Sdf,
    Svg,
    Urdf,
    Usd,
}

impl Form {
    /// Endings of files of this form; the first ending is the usual ending.
    fn endings(self) -> &'static [&'static str] {
        match self {
            Form::Csv => &["csv"],
            Form::Dxf => &["dxf"],
            Form::Html => &["html", "htm"],
            Form::Json => &["json"],
            Form::Junit => &["xml"],
            Form::Markdown | Form::Page => &["md"],
            Form::Mjcf => &["xml", "mjcf"],
            Form::Results => &[],
            Form::Scenario => &["toml"],
            Form::Sdf => &["sdf"],
            Form::Svg => &["svg", "pdf", "png"],
            Form::Urdf => &["urdf"],
            Form::Usd => &["usda"],
        }
    }

    /// Options of earlier versions that requested a result of this form, such as `--csv`.
    fn aliases(self) -> &'static [&'static str] {
        match self {
            Form::Csv => &["csv"],
            Form::Html => &["html"],
            Form::Json => &["json"],
            Form::Junit => &["junit"],
            Form::Markdown => &["markdown"],
            Form::Mjcf => &["mjcf"],
            Form::Page => &["page"],
            Form::Results => &["out"],
            Form::Dxf | Form::Scenario | Form::Sdf | Form::Urdf | Form::Usd => &[],
            Form::Svg => &["svg"],
        }
    }

    /// The form as users see it: `.json`, or `DIR`.
    pub(super) fn sign(self) -> String {
        self.endings().first().map_or("DIR".into(), |ending| format!(".{ending}"))
    }

    /// The endings that help shows for this form: all endings for a drawing, only the usual ending for any other form.
    fn told(self) -> String {
        match self {
            Form::Svg => sentences::SVG_PDF_OR_PNG.into(),
            Form::Csv
            | Form::Dxf
            | Form::Html
            | Form::Json
            | Form::Junit
            | Form::Markdown
            | Form::Mjcf
            | Form::Page
            | Form::Results
            | Form::Scenario
            | Form::Sdf
            | Form::Urdf
            | Form::Usd => self.sign(),
        }
    }

    /// The path of a result of this form.
    fn target(self, text: &str) -> std::result::Result<PathBuf, String> {
        match self {
            Form::Html => page_target(text),
            Form::Results => output::directory(text),
            Form::Page => output::page(text),
            Form::Scenario => output::scenario(text),
            Form::Csv
            | Form::Dxf
            | Form::Json
            | Form::Junit
            | Form::Markdown
            | Form::Mjcf
            | Form::Sdf
            | Form::Svg
            | Form::Urdf
            | Form::Usd => output::target(text),
        }
    }
}

/// Path of a page, or of a directory of pages; `-` is refused because standard output carries the report.
fn page_target(text: &str) -> std::result::Result<PathBuf, String> {
    match text {
        "-" => Err(sentences::A_PAGE_GOES_TO_A_FILE_EXPECTED.into()),
        _ if text.ends_with(".toml") => output::target(text),
        _ => Ok(PathBuf::from(text)),
    }
}

/// The results of a command.
pub(super) trait Results: Clone + Copy + Debug + PartialEq + Send + Sync + 'static {
    /// The results with their forms and contents. `-o -` writes the first result of this list.
    const ALL: &'static [(Self, Form, &'static str)];

    /// The form of this result.
    fn form(self) -> Form {
        Self::ALL.iter().find(|(own, ..)| *own == self).expect("the macro lists every result").1
    }
}

/// A result: text, or a drawing. The path to which a drawing is written selects its picture format.
pub(super) enum Made {
    Text(String),
    Drawing(Drawing),
}

impl From<String> for Made {
    fn from(text: String) -> Made {
        Made::Text(text)
    }
}

impl From<Drawing> for Made {
    fn from(drawing: Drawing) -> Made {
        Made::Drawing(drawing)
    }
}

impl Made {
    /// Writes the result to the file `to`, or to standard output.
    pub(super) fn write(&self, to: &Path) -> Result<()> {
        match self {
            Made::Text(text) => output::write(text, to),
            Made::Drawing(drawing) => {
                let medium = Medium::of(to).unwrap_or(Medium::Svg);
                output::write_bytes(&medium.drawn(drawing)?, to)?;
                medium.lacking([&drawing.figure].into_iter()).iter().for_each(output::warn);
                Ok(())
            }
        }
    }
}

/// Declares the results of a command, one line `Form = "contents",` for each result.
macro_rules! results {
    ($name:ident { $($form:ident = $contents:expr,)* }) => {
        /// Results of the command.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(in crate::cli) enum $name {
            $($form,)*
        }

        impl $crate::cli::outputs::Results for $name {
            const ALL: &'static [(Self, $crate::cli::outputs::Form, &'static str)] =
                &[$(($name::$form, $crate::cli::outputs::Form::$form, $contents),)*];
        }
    };
}
pub(super) use results;

/// The results that the user requests as files. If a path is empty, the command chooses the name.
#[derive(Clone, Debug)]
pub(super) struct Outputs<R: Results> {
    all: Vec<(R, PathBuf)>,
}

/// Reads the value of `-o`: the requested result and its path.
fn read<R: Results>(text: &str) -> std::result::Result<(R, PathBuf), String> {
    let path = Path::new(text);
    let (first, form, _) = R::ALL[0];
    let all = || R::ALL.iter().map(|(own, form, _)| (*own, *form));
    let standard = match text.strip_prefix("-.") {
        Some(ending) => Some(ending),
        None if output::is_standard(path) => Some(form.endings().first().copied().unwrap_or("")),
        None => None,
    };
    let folder = all().find(|(_, form)| matches!(form, Form::Html | Form::Results));
    if let (Some((own, form)), None) = (folder, standard)
        && (text.ends_with('/') || path.is_dir() || form == Form::Results && path.extension().is_none())
    {
        return Ok((own, form.target(text)?));
    }
    let ending = match standard {
        Some(ending) => ending.to_string(),
        None => path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default(),
    };
    let (own, form) = match all().find(|(_, form)| form.endings().contains(&ending.as_str())) {
        Some(found) => found,
        None if path.starts_with("/dev") => (first, form),
        None if ending == "toml" => return output::target(text).map(|path| (first, path)),
        None => {
            let named = |form: Form| if form == Form::Results { "DIR".into() } else { format!("FILE{}", form.sign()) };
            let expected: Vec<String> = all().map(|(_, form)| named(form)).collect();
            let found = if ending.is_empty() { sentences::NO_ENDING.into() } else { format!(".{ending}") };
            return Err(sentences::expected_found(&expected.join(", "), &found));
        }
    };
    // A drawing for standard output keeps its path `-.ENDING`, because the ending selects the picture format.
    Ok((own, form.target(if standard.is_some() && form != Form::Svg { "-" } else { text })?))
}

impl<R: Results> clap::Args for Outputs<R> {
    fn augment_args(command: Command) -> Command {
        let contents: Vec<String> = R::ALL.iter().map(|(_, form, what)| format!("{} {what}", form.told())).collect();
        let first = R::ALL[0].1.sign();
        let standard = if first == "DIR" { String::new() } else { sentences::is_standard_output_as(&first) };
        let output = Arg::new("output")
            .short('o')
            .long("output")
            .value_name("FILE")
            .allow_hyphen_values(true)
            .action(ArgAction::Append)
            .value_parser(read::<R>)
            .help(sentences::write_to_a_file_by_its_ending(&contents.join("; "), &standard));
        R::ALL.iter().fold(command.arg(output), |command, (own, form, _)| {
            let (own, form) = (*own, *form);
            let old = move |text: &str| match text {
                "" => Ok((own, PathBuf::new())),
                _ => form.target(text).map(|path| (own, path)),
            };
            command.args(form.aliases().iter().map(|alias| {
                Arg::new(*alias)
                    .long(*alias)
                    .value_name("FILE")
                    .hide(true)
                    .action(ArgAction::Append)
                    .num_args(if R::ALL[0].1 == Form::Mjcf { 0..=1 } else { 1..=1 })
                    .default_missing_value("")
                    .value_parser(old)
            }))
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<R: Results> FromArgMatches for Outputs<R> {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Self, clap::Error> {
        let names = R::ALL.iter().flat_map(|(_, form, _)| form.aliases()).chain(&["output"]);
        let all: Vec<(R, PathBuf)> =
            names.filter_map(|name| matches.get_many::<(R, PathBuf)>(name)).flatten().cloned().collect();
        let outputs = Outputs { all };
        let is_directory = |(own, _): &(R, &Path)| own.form() == Form::Results;
        if let Some((_, second)) = outputs.each().filter(is_directory).nth(1) {
            return Err(clap::Error::raw(Wrong::ArgumentConflict, sentences::a_second_directory(&second.display())));
        }
        match output::apart(&outputs.named()) {
            Ok(()) => Ok(outputs),
            Err(error) => {
                let help = error.way_out().map_or(String::new(), |help| format!("\n  = help: {help}"));
                Err(clap::Error::raw(Wrong::ArgumentConflict, format!("{}{help}\n", error.message())))
            }
        }
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> std::result::Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<R: Results> Outputs<R> {
    /// Whether a result goes to standard output; the text for people is then omitted.
    pub(super) fn take_standard(&self) -> bool {
        self.each().any(|(_, path)| output::is_standard(path))
    }

    /// All results with their paths.
    pub(super) fn each(&self) -> impl Iterator<Item = (R, &Path)> {
        self.all.iter().map(|(own, path)| (*own, path.as_path()))
    }

    /// Whether no result is requested.
    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Paths of a result.
    pub(super) fn of(&self, result: R) -> impl Iterator<Item = &Path> {
        self.each().filter(move |(own, _)| *own == result).map(|(_, path)| path)
    }

    /// First path of a result.
    pub(super) fn first(&self, result: R) -> Option<&Path> {
        self.of(result).next()
    }

    /// All paths, in the form that [`output::apart`] requires.
    pub(super) fn named(&self) -> Vec<(&'static str, &Path)> {
        self.each().map(|(_, path)| ("--output", path)).collect()
    }

    /// Writes every result that `make` returns.
    /// If a result cannot be written, the other results are still written.
    ///
    /// # Errors
    /// The first error is returned; the other errors are shown.
    pub(super) fn write_some<T: Into<Made>>(&self, mut make: impl FnMut(R) -> Result<Option<T>>) -> Result<()> {
        let mut one = |(own, to): (R, &Path)| make(own)?.map_or(Ok(()), |made| made.into().write(to));
        let mut errors: VecDeque<Error> = self.each().filter_map(|found| one(found).err()).collect();
        let first = errors.pop_front();
        errors.iter().for_each(output::show);
        first.map_or(Ok(()), Err)
    }

    /// Writes every result, like [`Outputs::write_some`].
    ///
    /// # Errors
    /// The errors of [`Outputs::write_some`].
    pub(super) fn write<T: Into<Made>>(&self, mut make: impl FnMut(R) -> Result<T>) -> Result<()> {
        self.write_some(|own| make(own).map(Some))
    }

    /// Writes every result, then prints the text for people.
    /// If a result goes to standard output, the text is omitted.
    ///
    /// # Errors
    /// The errors of [`Outputs::write_some`].
    pub(super) fn deliver<T: Into<Made>>(
        &self,
        make: impl FnMut(R) -> Result<T>,
        text: impl FnOnce(Option<usize>) -> String,
    ) -> Result<()> {
        self.write(make)?;
        if self.take_standard() { Ok(()) } else { output::print(&text(output::width())) }
    }
}
