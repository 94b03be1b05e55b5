//! The command line. Only this module and `testing::folder` print, or read the arguments, the clock or the environment.

mod accept;
mod advice;
mod bearings;
mod bench;
mod check;
mod clearance;
mod compare;
mod completions;
mod diagram;
mod docs;
mod draw;
mod drive;
mod engine_args;
mod engine_section;
mod exercise;
mod exit_code;
mod export;
mod golden;
mod graph;
mod grid;
mod html;
mod import;
mod inspect;
mod instant;
mod jobs;
mod list;
mod live;
mod load;
mod man;
mod mark;
mod merge;
mod mutate;
mod new;
mod number;
mod output;
mod outputs;
mod panics;
mod plan;
mod progress;
mod record_args;
mod run;
mod schema;
mod sensitivity;
mod solve;
mod solving;
mod stress;
mod sweep;
mod synthesize;
mod tune;
mod view;
mod watch;

use std::ffi::OsString;
use std::process::ExitCode;

use crate::plain::style::wrapped;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use linkage::error::Result;
use output::End;

/// Largest width of the list of commands in the help (columns).
const WIDEST: usize = 100;

/// Builds planar mechanisms twice, analytically and as a Rapier multibody, and proves that the two agree.
#[derive(Debug, Parser)]
#[command(name = "linkproof", version, after_help = include_str!("cli/help/linkproof.txt").trim_ascii_end())]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// Declares the commands. Each command has a purpose, arguments, and a function.
macro_rules! commands {
    ($($group:literal { $($(#[$about:meta])* $name:ident($args:ty) = $run:path,)* })*) => {
        #[derive(Debug, Subcommand)]
        enum Command {
            $($($(#[$about])* $name($args),)*)*
        }

        impl Command {
            /// Commands by purpose.
            const GROUPS: &[(&str, &[&str])] = &[$(($group, &[$(stringify!($name)),*])),*];

            fn run(&self) -> u8 {
                match self {
                    $($(Command::$name(args) => $run(args).code(),)*)*
                }
            }
        }
    };
}

commands! {
    "Prove" {
        /// Write a first mechanism: a commented scenario, with dimensions as options
        New(new::Args) = new::new,
        /// Solve scenarios analytically and with an engine, compare the solutions, record them, and say whether they
        /// agree
        Run(Box<run::Args>) = run::run,
        /// Store the figures of proven scenarios in files beside them, and judge later runs against these figures and
        /// their bounds
        Accept(accept::Args) = accept::run,
        /// Judge formulas over the whole motion, by value and by derivative, against both analytic sides
        Check(check::Args) = check::check,
        /// Compare a table, a recording or another scenario with a scenario, or two tables or recordings with each
        /// other
        Compare(compare::Args) = compare::compare,
        /// Solve a scenario with one solver and write the solution as CSV, one row per instant
        Solve(solve::Args) = solve::solve,
    }
    "Look" {
        /// Show the structure of a mechanism (links, joints, mobility, driving link and Assur groups), its
        /// configurations and its range of motion
        Inspect(inspect::Args) = inspect::inspect,
        /// Serve a page with the moving mechanism and its verdict, renewed at each save of the file
        Watch(watch::Args) = watch::watch,
        /// Draw mechanisms, also those that cannot be assembled yet, and all configurations: SVG, PDF, PNG, animated
        /// GIF and WebP
        Draw(draw::Args) = draw::draw,
        /// Velocity and acceleration plans at one instant, as a table, as JSON or drawn to scale
        Plan(plan::Args) = plan::plan,
        /// Velocity and acceleration by chords and tangents, velocity and displacement by graphical integration, and
        /// their errors
        Diagram(diagram::Args) = diagram::diagram,
        /// Graphs for print: channels, formulas and magnitudes over crank angle, time or each other, and hodographs:
        /// SVG, PDF, PNG and CSV
        Graph(graph::Args) = graph::graph,
        /// Show a recording in Rerun or Foxglove: the mechanism from above, beside plots of reference and engine
        View(view::Args) = view::view,
        /// List scenarios, or the available channels and solvers
        List(list::Args) = list::list,
    }
    "Design" {
        /// Largest reactions over the range of the grid, and the smallest journals that carry them
        Bearings(bearings::Args) = bearings::bearings,
        /// Smallest distances of links from each other and from a housing over the whole turn, first collision, swept
        /// areas
        Clearance(clearance::Args) = clearance::clearance,
        /// The mechanism reduced to its crank; its steady motion under its motor; flywheel and run-up; choice of a
        /// motor
        Drive(drive::Args) = drive::drive,
        /// How dimensions, masses and loads change figures such as the largest reaction: exact derivatives, tolerance
        /// stacks, tornado drawing
        Sensitivity(Box<sensitivity::Args>) = sensitivity::sensitivity,
        /// Find dimensions for a required motion: crank-rocker and slider-crank in closed form, any linkage by search
        Synthesize(synthesize::Args) = synthesize::synthesize,
        /// Solve many mechanisms that differ in some numbers: grids, random samples, Latin hypercubes and Sobol
        /// sequences, with figures of every case in a Parquet table
        Sweep(Box<sweep::Args>) = sweep::sweep,
        /// Join the shards of a sweep into one table
        Merge(merge::Args) = merge::merge,
        /// Turn a mechanism of another program into a scenario: links of PMKS+, models for MuJoCo, files of Linkage
        Import(import::Args) = import::import,
        /// Write a mechanism for another program: MJCF, SDF, URDF, USD, or JSON
        Export(export::Args) = export::export,
    }
    "Teach" {
        /// Give every student of a class different numbers for a mechanism: task sheets, answer tables, and the answers
        /// for the teacher
        Exercise(Box<exercise::Args>) = exercise::exercise,
        /// Judge the answers of a class cell by cell, and name the causes of wrong answers
        Mark(mark::Args) = mark::mark,
    }
    "Study" {
        /// Find the cheapest settings of an engine that reach a required accuracy, by measurement
        Tune(tune::Args) = tune::run,
        /// Change one parameter at a time until results become wrong: the limit of every solver and engine, with maps
        /// of stability
        Stress(stress::Args) = stress::run,
        /// Plant faults in one party of a proof, or in code that all parties share, and say which faults are found
        Mutate(mutate::Args) = mutate::run,
        /// Measure run time and error of every solver, engine and setting, and of other programs: diagrams and
        /// numbers
        Bench(bench::Args) = bench::run,
        /// Write a set of truths for simulators: mechanisms as models, their motion and reactions with bounds, and a
        /// checker
        Golden(golden::Args) = golden::golden,
    }
    "Help" {
        /// Show a page of the documentation
        Docs(docs::Args) = docs::docs,
        /// Write the JSON Schema of scenario files, with which editors complete and check keys
        Schema(schema::Args) = schema::schema,
        /// Write the command-line completions for a shell
        Completions(completions::Args) = completions,
        /// Write the manual: the page of linkproof, or the pages of all commands
        Man(man::Args) = man,
    }
}

/// The command line with its commands listed by purpose.
fn command() -> clap::Command {
    let command = Cli::command();
    let mut listed = String::new();
    for (group, names) in Command::GROUPS {
        listed += &format!("\n\n{group}:");
        for name in *names {
            let name = name.to_lowercase();
            let about = command.find_subcommand(&name).and_then(clap::Command::get_about);
            let row = format!("  {name:<13}{}", about.map(ToString::to_string).unwrap_or_default());
            listed += &format!("\n{}", wrapped(&row, Some(output::columns().min(WIDEST)), 15));
        }
    }
    command.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}{listed}\n\nOptions:\n{{options}}{{after-help}}"
    ))
}

fn completions(args: &completions::Args) -> Result<()> {
    completions::run(args, Cli::command())
}

fn man(args: &man::Args) -> Result<()> {
    man::run(args, Cli::command())
}

/// Runs the command line and returns its exit code.
#[must_use]
pub fn main() -> ExitCode {
    ExitCode::from(run(std::env::args_os()))
}

/// Silences panics that are caught and become errors. One call at the start of the process is enough.
pub fn silence() {
    panics::silence(linkage::quiet::is_guarded);
}

/// Runs the command line with these arguments, the name of the program first, and returns its exit code.
/// A host such as Python calls this function, because the arguments of its process are not those of the command.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    silence();
    let read = command().try_get_matches_from(arguments).and_then(|matches| Cli::from_arg_matches(&matches));
    match read {
        Ok(cli) => cli.command.run(),
        Err(error) => {
            // A closed terminal does not count as an error.
            let _ = error.print();
            u8::try_from(error.exit_code()).unwrap_or(exit_code::BAD_INPUT)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::{Path, PathBuf};

    use super::*;

    #[test]
    fn arguments_are_consistent() {
        Cli::command().debug_assert();
    }

    /// Commands whose code is only in `src/cli/NAME.rs`: no other module and no crate has the command's name.
    const ONLY_HERE: [&str; 12] =
        ["merge", "completions", "docs", "golden", "inspect", "list", "man", "new", "schema", "solve", "view", "watch"];

    /// The code of the command `NAME` is in `src/cli/NAME.rs`, and in the module or crate `NAME` that does the work.
    #[test]
    fn every_command_has_a_room_of_its_name() {
        let top = Path::new(env!("CARGO_MANIFEST_DIR"));
        let crates = ["src", "crates/prover/src", "crates/design/src", "crates/lab/src"];
        for command in Cli::command().get_subcommands() {
            let file = format!("{}.rs", command.get_name());
            assert!(top.join("src/cli").join(&file).is_file(), "src/cli/{file}");
            let is_crate = top.join("crates").join(command.get_name()).is_dir();
            let found = is_crate || crates.iter().any(|source| top.join(source).join(&file).is_file());
            assert_eq!(found, !ONLY_HERE.contains(&command.get_name()), "room of {file}");
        }
    }

    /// The documents in the top directory of the repository, in `docs`, and in the Python example.
    fn documents() -> Vec<PathBuf> {
        let top = Path::new(env!("CARGO_MANIFEST_DIR"));
        let all =
            ["", "docs", "examples/pytest"].into_iter().flat_map(|folder| fs::read_dir(top.join(folder)).unwrap());
        let mut files: Vec<PathBuf> = all.map(|entry| entry.unwrap().path()).collect();
        files.retain(|file| file.extension().is_some_and(|extension| extension == "md"));
        files.sort();
        files
    }

    /// Commands in the shell and CI blocks of a document, with continuation lines joined.
    fn commands(page: &str) -> Vec<Vec<String>> {
        let mut found = Vec::new();
        let mut language = None;
        for line in page.replace("\\\n", " ").lines() {
            match (line.trim_start().strip_prefix("```"), language) {
                (Some(begun), None) => language = Some(matches!(begun, "sh" | "yaml")),
                (Some(_), Some(_)) => language = None,
                (None, Some(true)) => found.extend(command(line)),
                (None, Some(false) | None) => {}
            }
        }
        found
    }

    /// The words of a line from `linkproof` to the end of the command. A pipe, `;` or a similar sign ends the command.
    /// For a line with `cargo run`, the words begin at `--`.
    fn command(line: &str) -> Option<Vec<String>> {
        let words = shlex::split(line).unwrap_or_else(|| panic!("no shell understands {line}"));
        let is_ours = |word: &String| word == "linkproof" || word.ends_with("/linkproof") && !word.contains('=');
        let is_run =
            words.starts_with(&["cargo".into(), "run".into()]) && !words.iter().any(|word| word == "--example");
        let start = words.iter().position(|word| if is_run { word == "--" } else { is_ours(word) })?;
        // Only a list marker, `run:` and variable assignments may precede the command.
        let begins = |word: &String| matches!(word.as_str(), "-" | "run:") || word.contains('=');
        let ends = |word: &&String| !matches!(word.as_str(), "|" | ">" | ">>" | "&&" | ";");
        let words: Vec<String> = words[..start]
            .iter()
            .all(|word| is_run || begins(word))
            .then(|| words[start..].iter().take_while(ends).cloned().collect())?;
        // A single word is a name, not a command.
        (words.len() > 1).then_some(words)
    }

    #[test]
    fn every_command_in_the_documents_parses() {
        let mut count = 0;
        for file in documents() {
            for words in commands(&fs::read_to_string(&file).unwrap()) {
                if let Err(error) = Cli::try_parse_from(&words) {
                    // Help is a result, not an error.
                    assert_eq!(error.exit_code(), 0, "{}: {}\n{error}", file.display(), words.join(" "));
                }
                count += 1;
            }
        }
        assert!(count >= 70, "only {count} commands are found");
    }

    /// A command with its subcommands.
    fn with_all(command: &clap::Command) -> Vec<clap::Command> {
        let inner = command.get_subcommands().flat_map(with_all);
        std::iter::once(command.clone()).chain(inner).collect()
    }

    /// Example commands of a help text, with continuation lines joined. In the help text, two blanks separate a command
    /// from its explanation; the explanation is left out.
    fn examples(help: &str) -> Vec<Vec<String>> {
        let joined: String = help.split("\\\n").map(str::trim_start).collect();
        let lines = joined.lines().filter_map(|line| line.strip_prefix("  linkproof "));
        lines.map(|line| command(&format!("linkproof {}", line.split("  ").next().unwrap())).unwrap()).collect()
    }

    /// The other examples name files that the first example writes. The program has a copy of each of these files.
    #[test]
    fn every_help_example_parses_and_its_files_are_shipped() {
        let shipped = crate::shipped::files();
        let is_there = |word: &str| {
            let (begin, end) = word.split_once('*').unwrap_or((word, ""));
            shipped.iter().any(|(path, _)| path.starts_with(begin) && path.ends_with(end))
        };
        let mut count = 0;
        for command in with_all(&Cli::command()) {
            let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(!help.contains("docs/"), "{}: a file that is not there", command.get_name());
            let mut brings_files = false;
            for words in examples(&help) {
                let told = words.join(" ");
                if let Err(error) = Cli::try_parse_from(&words) {
                    assert_eq!(error.exit_code(), 0, "{told}\n{error}");
                }
                brings_files |= words.contains(&"--shipped".to_string());
                for word in
                    words.iter().filter(|word| word.starts_with("scenarios/") || word.starts_with("catalogues/"))
                {
                    assert!(brings_files && is_there(word), "{told}: {word}");
                }
                count += 1;
            }
        }
        assert!(count >= 90, "only {count} examples are found");
    }

    /// An installed program has only the embedded files of the repository.
    #[test]
    fn help_texts_name_no_repository_file() {
        for command in with_all(&Cli::command()) {
            let told = command.clone().render_long_help().to_string();
            for word in told.split_whitespace() {
                assert!(
                    !["docs/", "examples/", "tests/", "src/"].iter().any(|folder| word.starts_with(folder)),
                    "{word}"
                );
            }
        }
    }

    #[test]
    fn an_invalid_command_is_found_in_any_code_block() {
        for block in [
            "```sh\nlinkproof prove a.toml\n```",
            "```yaml\n  run: linkproof run a.toml --juint x\n```",
            "```yaml\n    - linkproof accept a.toml --checked\n```",
            "```sh\nA=1 target/release/linkproof run \\\n  --no-file | head\n```",
        ] {
            let found = commands(block);
            assert_eq!(found.len(), 1, "{block}");
            assert!(Cli::try_parse_from(&found[0]).is_err(), "{block}");
        }
        assert!(
            commands("```sh\ncargo install --path linkproof\n```\nlinkproof prove\n```text\nlinkproof x\n```")
                .is_empty()
        );
    }
}
