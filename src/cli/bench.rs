//! `linkproof bench`.

use crate::sentences;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::engine_args::{engine_names, word};
use super::load::{only, plain};
use super::outputs::{Outputs, results};
use super::progress::Bar;
use super::{number, output};
use crate::report::{bench as report, bench_page, bench_plot, case_json};
use analytic::AssurSolver;
use analytic::range::explained;
use design::export::{first_state, mjcf};
use lab::bench::{Bench, BenchOptions, Clock, CostAxis, Peer, bench};

use lab::outside::{Command, Exports, machine, processor_time};

use linkage::error::{Error, ErrorKind, Result};
use prover::engines::{EngineName, usual_step, with_step};
use scenario::{Scenario, files_in};

/// Name of the file with the numbers of all scenarios.
const TOTAL: &str = "bench.json";
/// Output directory if `-o` is not given.
const NAME: &str = "bench";
/// Time limit for one call of a peer (s).
const LIMIT: f64 = 60.0;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/bench.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario files; `-` for standard input
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    outputs: Outputs<Benches>,
    /// Measure fewer settings, and time each only once
    #[arg(long)]
    quick: bool,
    /// Request only these channels from all parties, as in `run`. May be given several times
    #[arg(long, value_name = "WORD")]
    only: Vec<String>,
    /// Engine. May be given several times [default: all of this build]
    #[arg(long, value_name = "ENGINE", value_parser = word(engine_names(), EngineName::named))]
    engine: Vec<EngineName>,
    /// Another program, by a name and the command that runs it. May be given several times
    #[arg(long, value_name = "NAME=COMMAND", value_parser = peer)]
    peer: Vec<(String, String)>,
    /// Time limit in seconds for one call of a peer
    #[arg(long, value_name = "S", default_value_t = LIMIT, allow_hyphen_values = true, value_parser = number::positive)]
    peer_limit: f64,
    /// Work allowed to the engines of a scenario; the unit is an engine step without sweeps [default: 2e6, with
    /// `--quick` 3e5]
    #[arg(long, value_name = "STEPS", allow_hyphen_values = true, value_parser = number::positive)]
    budget: Option<f64>,
    /// Number of timing rounds; the shortest time counts [default: 3, with `--quick` 1]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = number::count)]
    rounds: Option<usize>,
}

results! { Benches {
    Results = "diagrams and numbers [default: bench]",
    Page = "a page with the results of all scenarios",
} }

/// Reads a peer's name and command.
fn peer(text: &str) -> std::result::Result<(String, String), String> {
    let (name, command) = text.split_once('=').ok_or(sentences::EXPECTED_NAME_COMMAND_FOR_EXAMPLE)?;
    let is_name = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));
    match (is_name, command.trim().is_empty()) {
        (true, false) => Ok((name.into(), command.trim().into())),
        (false, _) => Err(sentences::is_no_name_letters_digits(&name)),
        (true, true) => Err(sentences::THE_COMMAND_IS_EMPTY.into()),
    }
}

pub(super) fn run(args: &Args) -> Result<()> {
    let scenarios = args.files.iter().map(|file| only(plain(file)?, &args.only)).collect::<Result<Vec<_>>>()?;
    if let Some(twice) = (1..scenarios.len()).find(|&k| scenarios[..k].iter().any(|own| own.name == scenarios[k].name))
    {
        return Err(Error::new(ErrorKind::Input, sentences::two_scenarios_are_called(&scenarios[twice].name))
            .help(sentences::THEIR_FILES_IN_THE_DIRECTORY));
    }
    let machine = machine();
    let options =
        BenchOptions { engines: args.engine.clone(), is_quick: args.quick, budget: args.budget, rounds: args.rounds };
    for engine in &options.engines {
        with_step(*engine, 1.0)?;
    }
    let out = args.outputs.first(Benches::Results).unwrap_or(Path::new(NAME));
    output::make_directory(out, "--output", sentences::GIVE_A_DIRECTORY_THAT_MAY)?;
    let endings = || CostAxis::ALL.map(|axis| format!("{}.svg", axis.name())).into_iter().chain(["csv".into()]);
    let places = scenarios.iter().flat_map(|own| endings().map(|ending| place(out, &own.name, &ending)));
    output::may_make(&places.chain([out.join(TOTAL)]).collect::<Vec<_>>())?;
    let since = Instant::now();
    let wall = move || since.elapsed().as_secs_f64();
    let used = move || used(since);
    let mut benches = Vec::new();
    for scenario in &scenarios {
        let found = one(args, scenario, &options, &used, &wall)?;
        output::print(&format!("{}\n", report::text(&found)))?;
        put(out, &found, &machine)?;
        benches.push(found);
    }
    output::make(&report::json(&benches, &machine), &out.join(TOTAL))?;
    let page =
        |page: &Path| output::write(&bench_page::page(&benches, &machine, &command(args), &seen_from(page, out)), page);
    args.outputs.of(Benches::Page).try_for_each(page)
}

/// Processor time (s) that this thread has used.
/// Work of other programs on the machine changes the processor time less than it changes the elapsed time.
/// On systems other than Linux, the function returns the elapsed time.
fn used(since: Instant) -> f64 {
    // Linux updates the processor time when the thread yields, so the thread yields before it reads the time.
    std::thread::yield_now();
    processor_time().unwrap_or_else(|| since.elapsed().as_secs_f64())
}

/// Measures one scenario, with a progress bar.
/// The clock `used` times the runs; the clock `wall` limits the peers.
fn one(args: &Args, scenario: &Scenario, options: &BenchOptions, used: Clock, wall: Clock) -> Result<Bench> {
    let case = &scenario.case;
    let exports = match args.peer.is_empty() {
        true => None,
        false => {
            let start = first_state(case, &AssurSolver).map_err(|error| explained(case, error))?;
            let mjcf = mjcf::mjcf(case, &AssurSolver, &scenario.name, usual_step(case));
            Some(Exports {
                name: scenario.name.clone(),
                case: case_json::text(&scenario.name, case, &start),
                mjcf: mjcf.map_err(|error| error.to_string()),
                is_quick: args.quick,
            })
        }
    };
    let commands: Vec<Command> = exports
        .iter()
        .flat_map(|exports| args.peer.iter().map(move |own| (exports, own)))
        .map(|(exports, (name, command))| Command::new(name, command, exports, args.peer_limit, wall))
        .collect();
    let peers: Vec<&dyn Peer> = commands.iter().map(|command| command as &dyn Peer).collect();
    let mut bar = Bar::new(&scenario.name);
    bench(scenario, options, &peers, used, &mut |part| bar.at(part))
}

/// Path of a scenario's file in the output directory `out`.
fn place(out: &Path, name: &str, ending: &str) -> PathBuf {
    out.join(format!("{name}.{ending}"))
}

/// Writes the diagrams and the numbers of one scenario.
fn put(out: &Path, found: &Bench, machine: &report::Machine) -> Result<()> {
    let place = |end: &str| place(out, &found.scenario[0], end);
    output::make(&report::rows(found, machine)?, &place("csv"))?;
    for axis in CostAxis::ALL {
        if let Some(text) = bench_plot::drawing(found, axis) {
            output::make(&text, &place(&format!("{}.svg", axis.name())))?;
        }
    }
    Ok(())
}

/// The command, so that a user can repeat it.
/// If the scenarios are all files of a directory, one pattern replaces their names.
fn command(args: &Args) -> String {
    let files: Vec<String> = args.files.iter().map(|file| file.to_string_lossy().into_owned()).collect();
    let directory = args.files[0].parent().unwrap_or(Path::new("."));
    let mut sorted = args.files.clone();
    sorted.sort();
    let whole = sorted.len() > 1 && files_in(directory).is_ok_and(|all| all == sorted);
    let mut words = vec!["linkproof".to_string()];
    // The name of the program may be several words, such as an interpreter and its script.
    for word in std::env::args().skip_while(|word| word != "bench") {
        match files.iter().position(|file| *file == word) {
            Some(0) if whole => words.push(format!("{}/*.toml", directory.display())),
            Some(_) if whole => {}
            Some(_) | None => words.push(output::quoted(&word)),
        }
    }
    words.join(" ")
}

/// Path of the directory `directory` relative to the page `page`, for the links of the page.
fn seen_from(page: &Path, directory: &Path) -> String {
    let beside = page.parent().and_then(|parent| directory.strip_prefix(parent).ok()).unwrap_or(directory);
    let text = beside.to_string_lossy();
    if text.is_empty() { String::new() } else { format!("{text}/") }
}
