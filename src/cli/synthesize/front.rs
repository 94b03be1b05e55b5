//! `linkproof synthesize front`.

use crate::sentences;
use std::path::PathBuf;

use crate::cli::number::Parsed;
use crate::cli::outputs::{Made, Outputs, results};
use crate::cli::progress;
use crate::report::front::{self as report, Front};
use design::synthesize::front::{FrontLimit, front as points};
use design::synthesize::task_file::TaskFile;
use linkage::error::{ErrorKind, Result};

use super::search::{EffortArgs, Found, found};

results! { FrontResults {
    Csv = "the points with their dimensions",
    Json = "the result",
    Svg = "deviation over the limit",
} }

/// Upper limit of the number of points.
const MOST: usize = 1000;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Synthesis file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Limit that is varied: acceleration_m_s2, transmission_deg or the largest value of a limited quantity, with first
    /// and last value and the number of points
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = varied)]
    limit: Varied,
    #[command(flatten)]
    effort: EffortArgs,
    /// Threads; the result does not depend on them [default: the number of cores]
    #[arg(long, value_name = "N", default_value = "0", hide_default_value = true)]
    threads: usize,
    #[command(flatten)]
    outputs: Outputs<FrontResults>,
}

/// A limit with its values.
#[derive(Clone, Debug)]
struct Varied {
    name: String,
    values: Vec<f64>,
}

fn varied(text: &str) -> Parsed<Varied> {
    let wrong = || sentences::is_no_varied_limit(&text, &MOST);
    let (name, range) = text.rsplit_once('=').ok_or_else(wrong)?;
    let parts: Vec<&str> = range.split(':').collect();
    let [from, to, count] = parts[..] else { return Err(wrong()) };
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    let count = count.trim().parse::<usize>().ok().filter(|count| (2..=MOST).contains(count));
    let (Some(from), Some(to), Some(count)) = (number(from), number(to), count) else { return Err(wrong()) };
    let value = |index: usize| from + (to - from) * (index as f64 / (count - 1) as f64);
    Ok(Varied { name: name.trim().into(), values: (0..count).map(value).collect() })
}

pub(super) fn front(args: &Args) -> Result<()> {
    let TaskFile { mut task, drawing } = TaskFile::load(&args.file)?;
    args.effort.apply(&mut task.effort);
    let limit = FrontLimit::named(&args.limit.name, &task)
        .map_err(|error| if error.kind() == ErrorKind::Input { error.key("--limit") } else { error })?;
    let mut bar = progress::Bar::new(&task.name);
    let points = points(&task, limit, &args.limit.values, args.threads, &mut |part| bar.at(part))?;
    drop(bar);
    let mut rows = Vec::with_capacity(points.len());
    for point in points {
        let found = point.found.as_ref().map(|own| found(&point.task, &drawing, own)).transpose()?;
        let reached = |Found { task, achieved, values, verdict }| report::Reached { task, achieved, values, verdict };
        rows.push((point.limit, found.map(reached)));
    }
    let all = Front { task: &task, limit: &args.limit.name, noun: limit.noun(&task), points: &rows };
    let result = |result| -> Result<Made> {
        Ok(match result {
            FrontResults::Csv => report::rows(&all)?.into(),
            FrontResults::Json => report::json(&all).into(),
            FrontResults::Svg => report::picture(&all)?.into(),
        })
    };
    args.outputs.deliver(result, |_| report::text(&all))
}
