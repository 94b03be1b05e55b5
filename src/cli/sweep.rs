//! `linkproof sweep`.

use crate::sentences;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use super::exit_code::{AGREE, DISAGREE};
use super::load::{each_once, named, setting, text};
use super::number;
use super::output;
use super::outputs::{Outputs, results};
use super::progress::Bar;
use crate::draw::{Drawn, Medium, PictureOptions, picture};
use crate::plain::cells::counted;
use crate::report::sweep as report;
use linkage::error::{Error, ErrorKind, Result};
use linkage::threads::cores;
use scenario::Scenario;
use sweep::{DesignKind, Goal, Shard, SweepAxis, SweepDesign, SweepPlan, SweepStore, SweepSummary, run};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/sweep.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Vary a parameter, or another number of the file by its path. Grid: KEY=FROM:TO:COUNT. Samples: KEY=FROM:TO,
    /// KEY=normal(MEAN, DEVIATION) or KEY=normal(MEAN, DEVIATION, FROM, TO). May be given several times
    #[arg(long, value_name = "KEY=VALUES", required = true, allow_hyphen_values = true)]
    vary: Vec<String>,
    #[command(flatten)]
    samples: Samples,
    /// Seed of the samples. The same seed gives the same cases
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// Figure of every case, such as `maxabs:drive.torque_N_m`: a statistic (max, min, maxabs, mean, rms, range,
    /// at=DEG) of a channel or of an expression of channels; the input at an extreme (at_max, at_min, at_maxabs); the
    /// smallest transmission angle (transmission_angle_deg); the limits of the motion (reach_from, reach_to); or the
    /// verdict of a formula (verdict:FORMULA). May be given several times
    #[arg(long, value_name = "FIGURE", required = true)]
    figure: Vec<String>,
    /// Value of a parameter, or of another number of the file, in all cases; may be given several times
    #[arg(long, value_name = "KEY=NUMBER", value_parser = setting)]
    set: Vec<(String, f64)>,
    /// Prove some cases, engines included: with `every:1000`, each case whose index is a multiple of 1000. A proof that
    /// disagrees stops the sweep
    #[arg(long, value_name = "every:N", value_parser = every)]
    prove: Option<u64>,
    /// Solve one of several equal shares of the cases, such as `2/8`; `linkproof merge` joins the shares
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<Shard>,
    /// Number of cases stored together [default: 1/64 of all cases, at least 64 and at most 20000; of more than 2e8
    /// cases 1/10000, at most 1000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    part: Option<u64>,
    /// Number of threads [default: number of cores]
    #[arg(long, value_name = "N", value_parser = number::count)]
    jobs: Option<usize>,
    /// Best cases to show: those with the smallest or largest values of a figure, as `min:FIGURE` or `max:FIGURE`
    /// [default: the smallest values of the first figure]
    #[arg(long, value_name = "END:FIGURE")]
    best: Option<String>,
    #[command(flatten)]
    outputs: Outputs<Sweeps>,
}

/// The kind and number of samples.
#[derive(Debug, clap::Args)]
#[group(multiple = false)]
struct Samples {
    /// Take N independent random samples
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    random: Option<u64>,
    /// Take N samples of a Latin hypercube
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    latin: Option<u64>,
    /// Take N samples of Sobol's sequence; powers of two are best
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    sobol: Option<u64>,
}

results! { Sweeps {
    Results = "directory of the sweep, with the table `cases.parquet` [default: sweep]",
    Html = "page with parallel coordinates and the best cases",
} }

fn every(text: &str) -> std::result::Result<u64, String> {
    let number = text.strip_prefix("every:").and_then(|number| number.parse().ok()).filter(|number| *number > 0);
    number.ok_or_else(|| sentences::EXPECTED_EVERY_AND_A_NUMBER.into())
}

fn shard(text: &str) -> std::result::Result<Shard, String> {
    let read = || {
        let (number, count) = text.split_once('/')?;
        let (number, count) = (number.parse().ok()?, count.parse().ok()?);
        (1 <= number && number <= count).then_some(Shard { number, count })
    };
    read().ok_or_else(|| sentences::EXPECTED_A_SHARE_OF_THE_CASES.into())
}

impl Args {
    fn plan(&self) -> Result<SweepPlan> {
        let axes = self.vary.iter().map(|text| SweepAxis::parse(text).map_err(|error| error.key("--vary")));
        let (axes, seed) = (axes.collect::<Result<Vec<_>>>()?, self.seed);
        let kind = match (self.samples.random, self.samples.latin, self.samples.sobol) {
            (Some(cases), ..) => DesignKind::Random { cases, seed },
            (_, Some(cases), _) => DesignKind::LatinHypercube { cases, seed },
            (_, _, Some(cases)) => DesignKind::Sobol { cases, seed },
            (None, None, None) => DesignKind::Grid,
        };
        let design = SweepDesign::of(kind, axes).map_err(|error| error.key("--vary"))?;
        if let Some(axis) = design.axes().iter().find(|axis| self.set.iter().any(|(key, _)| *key == axis.key)) {
            let error = Error::new(ErrorKind::Input, sentences::is_varied_and_set(&axis.key)).key("--set");
            return Err(error.help(sentences::VARY_OR_SET));
        }
        each_once(&self.set, "--set")?;
        let file = (text(&self.file)?.into_owned(), named(&self.file));
        SweepPlan::of(file, self.set.clone(), design, &self.figure, self.prove, self.part)
    }
}

/// Reads `min:FIGURE` or `max:FIGURE`.
pub(super) fn goal(asked: Option<&str>, plan: &SweepPlan) -> Result<Goal> {
    let Some(asked) = asked else { return Ok(Goal::default()) };
    let found = asked.split_once(':').and_then(|(end, figure)| {
        let is_largest = [("min", false), ("max", true)].into_iter().find(|(own, _)| *own == end)?.1;
        Some(Goal { figure: plan.figures.iter().position(|own| own.text == figure)?, is_largest })
    });
    found.ok_or_else(|| {
        let names = plan.figures.iter().map(|own| own.text.as_str());
        let error = Error::new(ErrorKind::Input, sentences::is_no_end_of_a_figure(&asked)).key("--best");
        error.help(sentences::write_min_or_max_of(&scenario::words::choice(names, "`")))
    })
}

pub(super) fn sweep(args: &Args) -> Result<u8> {
    let plan = args.plan()?;
    let goal = goal(args.best.as_deref(), &plan)?;
    let directory = args.outputs.first(Sweeps::Results).unwrap_or(Path::new("sweep"));
    let store = SweepStore::open(directory, &plan)?;
    let mut summary = None;
    if !store.is_complete() {
        let cases = args.shard.unwrap_or(Shard::WHOLE).cases(&plan);
        let mut bar = Bar::new(&counted(cases as usize, "case"));
        let (tally, found) = run(&plan, &store, args.shard, args.jobs.unwrap_or(cores()), goal, &mut |tally| {
            bar.at(tally.cases() as f64 / cases as f64);
            ControlFlow::Continue(())
        })?;
        summary = found;
        drop(bar);
        if tally.disagreement.is_some() {
            return verdict(&plan, tally.disagreement);
        }
        if let Some(shard) = args.shard {
            output::print(&report::of_shard(&tally, shard, directory))?;
            return Ok(AGREE);
        }
    }
    let summary = summary.map_or_else(|| SweepSummary::of(&plan, &store.table(), goal), Ok)?;
    told(&plan, &summary, goal, &store, args.outputs.of(Sweeps::Html))
}

/// The exit code of a sweep. Names the case whose proof disagrees, if there is one.
fn verdict(plan: &SweepPlan, disagreement: Option<u64>) -> Result<u8> {
    let Some(case) = disagreement else { return Ok(AGREE) };
    let mut values = vec![0.0; plan.design.axes().len()];
    plan.design.values(case, &mut values);
    let message = sentences::the_proof_of_a_case_disagrees(&case, &file(plan), &sets(plan, &values));
    output::print(&format!("{message}\n"))?;
    Ok(DISAGREE)
}

/// The file of the scenario. A stored plan, as read by `merge`, has no path of the scenario.
fn file(plan: &SweepPlan) -> String {
    let standard = Path::new("-");
    let path = match plan.path.as_path() {
        path if path.as_os_str().is_empty() => Path::new("FILE"),
        path if path == named(standard) => standard,
        path => path,
    };
    output::quoted(&path.to_string_lossy())
}

/// The `--set` options that give another command the numbers of a case.
fn sets(plan: &SweepPlan, values: &[f64]) -> String {
    let set = plan.set.iter().cloned().chain(plan.design.setting(values));
    set.map(|(key, value)| format!(" --set {key}={value:?}")).collect()
}

/// Prints the summary of a sweep, and writes its page to the files `pages`. Returns the exit code.
pub(super) fn told<'p>(
    plan: &SweepPlan,
    summary: &SweepSummary,
    goal: Goal,
    store: &SweepStore,
    pages: impl Iterator<Item = &'p Path>,
) -> Result<u8> {
    let next = summary.best.first().map(|row| sentences::repeat_a_case(&file(plan), &sets(plan, &row.values)));
    output::print(&report::text(plan, summary, goal, &store.table(), &next.unwrap_or_default(), output::width()))?;
    let code = verdict(plan, summary.disagreement)?;
    let mut pages = pages.peekable();
    if pages.peek().is_some() {
        let (title, drawings) = drawn(plan, summary)?;
        let page = report::page(plan, summary, goal, &title, &drawings);
        pages.try_for_each(|to| output::write(&page, to))?;
    }
    Ok(code)
}

/// Title of the scenario, and the drawings of the best cases.
fn drawn(plan: &SweepPlan, summary: &SweepSummary) -> Result<(String, Vec<String>)> {
    let family = plan.family()?;
    let (mut title, mut drawings) = (None, Vec::new());
    for row in &summary.best {
        let own = family.member(&plan.design.setting(&row.values))?;
        title = Some(own.title.clone());
        let wish = PictureOptions::default();
        let drawn = Drawn::of(Scenario { title: String::new(), ..own }, &wish, Medium::Svg)?;
        drawings.push(String::from_utf8_lossy(&picture(&[drawn], &wish, Medium::Svg)?).into_owned());
    }
    Ok((title.map_or_else(|| family.member(&[]).map(|own| own.title), Ok)?, drawings))
}
