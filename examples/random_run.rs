//! Runs a built `linkproof run` on many scenario files, and counts the outcomes.
//!
//! `cargo run --release --example random_run -- BINARY FILE_OR_DIR.. [--jobs 2] [--limit SECONDS] [-- OPTIONS OF RUN]`
//!
//! The example prints one line for each file that does not agree, the counts, and the total processor time of the runs.
//! The binary is an argument, so that two versions of the program can be compared.

use std::collections::{BTreeMap, VecDeque};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use serde_json::Value;

/// Outcome of a run, and its reason.
struct Outcome {
    word: &'static str,
    why: String,
    seconds: f64,
}

fn main() {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let further = match arguments.iter().position(|argument| argument == "--") {
        Some(place) => arguments.split_off(place).split_off(1),
        None => Vec::new(),
    };
    let mut number = |name: &str, default: u64| match arguments.iter().position(|argument| argument == name) {
        Some(place) => arguments.drain(place..place + 2).nth(1).unwrap().parse().expect("a whole number"),
        None => default,
    };
    let (jobs, limit) = (number("--jobs", 2), number("--limit", 120));
    let (binary, files) = arguments.split_first().expect("BINARY FILE_OR_DIR..");
    let files: Vec<PathBuf> = files.iter().flat_map(|file| listed(file.as_ref())).collect();
    let waiting = Mutex::new(files.iter().cloned().enumerate().collect::<VecDeque<_>>());
    let outcomes = Mutex::new(BTreeMap::new());
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            scope.spawn(|| {
                loop {
                    let next = waiting.lock().unwrap().pop_front();
                    let Some((index, file)) = next else { return };
                    let outcome = run(binary, &file, Duration::from_secs(limit), &further);
                    if outcome.word != "agree" {
                        let name = file.file_name().unwrap_or_default().display();
                        println!("{name}: {} after {:.1} s: {}", outcome.word, outcome.seconds, outcome.why);
                    }
                    outcomes.lock().unwrap().insert(index, outcome);
                }
            });
        }
    });
    let mut counts = BTreeMap::new();
    for outcome in outcomes.lock().unwrap().values() {
        *counts.entry(outcome.word).or_insert(0) += 1;
    }
    println!("{} files: {counts:?}; {:.1} s of processor time", files.len(), processor_time());
}

/// A file, or the scenarios of a directory in order.
fn listed(path: &Path) -> Vec<PathBuf> {
    if !path.is_dir() {
        return vec![path.into()];
    }
    let entries = std::fs::read_dir(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    files
}

fn run(binary: &str, file: &Path, limit: Duration, further: &[String]) -> Outcome {
    let since = Instant::now();
    let mut command = Command::new(binary);
    command.arg("run").arg(file).args(["--no-record", "-o", "-"]).args(further);
    let spawned = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let mut child = spawned.unwrap_or_else(|error| panic!("{binary}: {error}"));
    let reader = |mut from: Box<dyn Read + Send>| {
        std::thread::spawn(move || {
            let mut bytes = Vec::new();
            from.read_to_end(&mut bytes).map(|_| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default()
        })
    };
    let out = reader(Box::new(child.stdout.take().unwrap()));
    let told = reader(Box::new(child.stderr.take().unwrap()));
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break Some(status);
        }
        if since.elapsed() > limit {
            child.kill().unwrap();
            child.wait().unwrap();
            break None;
        }
        std::thread::sleep(Duration::from_millis(10));
    };
    let (out, told) = (out.join().unwrap(), told.join().unwrap());
    let (word, why) = match status {
        None => ("timeout", String::new()),
        Some(status) => match serde_json::from_str::<Value>(&out) {
            Ok(report) if status.code().is_some_and(|code| code <= 3) => judged(&report),
            _ => ("panic", format!("{status}: {}", told.lines().take(3).collect::<Vec<_>>().join(" | "))),
        },
    };
    Outcome { word, why, seconds: since.elapsed().as_secs_f64() }
}

/// The verdict, and its reason: the first two checks with this verdict, and the worst channel.
/// If the run disagrees, the worst channel has the largest ratio of residual to bound.
/// Otherwise, the worst channel has the widest bound, relative to the scale of the channel.
fn judged(report: &Value) -> (&'static str, String) {
    let Some(run) = report["runs"].get(0) else {
        let error = &report["errors"][0];
        return ("refused", error["message"].as_str().unwrap_or("no message").replace('\n', " "));
    };
    let words = ["agree", "disagree", "inconclusive"];
    let Some(word) = words.into_iter().find(|word| run["verdict"] == **word) else {
        return ("other", run["verdict"].to_string());
    };
    let all = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let number = |item: &Value, key: &str| item[key].as_f64().unwrap_or(f64::NAN);
    let engines = all(&run["engines"]);
    let of_engines = |key: &str| engines.iter().flat_map(|engine| all(&engine[key])).collect::<Vec<_>>();
    let mut checks = all(&run["checks"]);
    checks.extend(of_engines("checks"));
    checks.retain(|check| check["verdict"] == word);
    let channels = of_engines("channels");
    let (count, mut blamed) = (channels.len(), channels);
    blamed.retain(|channel| channel["verdict"] == word);
    let used = |channel: &Value| match word {
        "disagree" => number(channel, "max") / number(channel, "bound"),
        _ => number(channel, "bound") / number(channel, "scale"),
    };
    let mut why = Vec::new();
    for check in checks.iter().take(2) {
        let (value, bound) = (number(check, "value"), number(check, "bound"));
        why.push(format!("check {} {value:.1e} of {bound:.1e}", check["name"].as_str().unwrap_or("")));
    }
    if let Some(worst) = blamed.iter().max_by(|a, b| used(a).total_cmp(&used(b))) {
        let [max, bound, scale] = ["max", "bound", "scale"].map(|key| number(worst, key));
        let reason = worst["reason"].as_str().or(run["reason"].as_str()).unwrap_or("");
        why.push(format!(
            "{} of {count} channels, worst {} error {:.1e} bound {:.1e} of its scale: {reason}",
            blamed.len(),
            worst["channel"].as_str().unwrap_or(""),
            max / scale,
            bound / scale
        ));
    } else if let Some(reason) = run["reason"].as_str() {
        why.push(reason.into());
    }
    (word, why.join("; ").replace('\n', " "))
}

/// Processor time of all finished child processes (s); Linux counts it in hundredths of a second.
fn processor_time() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or("").split_whitespace().collect();
    let ticks = |place: usize| fields.get(place).and_then(|text| text.parse::<f64>().ok()).unwrap_or(f64::NAN);
    // In `/proc/self/stat`, fields 16 and 17 are the times of child processes. `fields` leaves out fields 1 and 2.
    (ticks(13) + ticks(14)) / 100.0
}
