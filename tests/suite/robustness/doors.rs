//! Hostile inputs to every door, through the built command: with 2 GB of memory and a minute of processor time each ends
//! with an exit code and a message, and leaves every file alone that is not its own.
#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use assert_cmd::cargo::CommandCargoExt;
use linkage::mechanism::is_unseen;

use crate::cli::tools::Place;
use crate::common::hostile::{Attack, DOORS, Good, attack};

/// Seed of all attacks.
const SEED: u64 = 1;
/// Attacks of an ordinary run, as many at each door; by night 10 000 in all.
const FEW: u64 = 189;
const MANY: u64 = 10_000;
/// Memory (kB) and processor time (s) that a command may take. Two threads take the time twice as fast.
const MEMORY: u64 = 2_000_000;
const SECONDS: u64 = 60;
/// Time (s) after which a command is stopped that waits for something, many times what the slowest one takes.
const PATIENCE: u64 = 900;

fn good() -> Good {
    let place = Place::new();
    place.ok("run scenarios/pendulum.toml --route differences --record .");
    place.ok("accept scenarios/pendulum.toml --route differences");
    place.ok("stress turns --quick --out .");
    let columns = "solve scenarios/crank_rocker.toml --with assur --only point.B --csv table.csv";
    place.ok(columns);
    place.ok("solve scenarios/five_bar.toml --with newton --only positions --csv positions.csv");
    let read = |name: &str| fs::read(place.path(name)).unwrap();
    Good {
        recording: read("pendulum.mcap"),
        accepted: read("scenarios/pendulum.accepted"),
        stress: read("turns.json"),
        table: read("table.csv"),
        positions: read("positions.csv"),
    }
}

/// All files below a directory, with what is in them.
fn files(root: &Path) -> BTreeMap<String, Vec<u8>> {
    let (mut found, mut open) = (BTreeMap::new(), vec![root.to_path_buf()]);
    while let Some(directory) = open.pop() {
        for entry in fs::read_dir(directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() && !path.is_symlink() {
                open.push(path);
            } else if path.is_file() {
                found.insert(path.strip_prefix(root).unwrap().display().to_string(), fs::read(&path).unwrap());
            }
        }
    }
    found
}

/// How an attack ended: an exit code, and the processor time (s); or what went wrong.
fn ending(own: &Attack) -> Result<(i32, f64), String> {
    let place = Place::empty();
    for (name, bytes) in &own.files {
        fs::create_dir_all(place.path(name).parent().unwrap()).unwrap();
        fs::write(place.path(name), bytes).unwrap();
    }
    // What a user may have where names are made up.
    for name in ["precious", "recordings/pendulum.foxglove.json", "recordings/crank_rocker.mcap", "crank_rocker.xml"] {
        fs::create_dir_all(place.path(name).parent().unwrap()).unwrap();
        fs::write(place.path(name), "mine").unwrap();
    }
    std::os::unix::fs::symlink("../precious", place.path("recordings/crank_rocker.foxglove.json")).unwrap();
    let before = files(&place.path(""));
    let told = tempfile::NamedTempFile::new().unwrap();
    let script = format!(
        "ulimit -v {MEMORY}; ulimit -t {SECONDS}; timeout {PATIENCE} \"$@\"; code=$?; times > {}; exit $code",
        told.path().display()
    );
    let linkproof = Command::cargo_bin("linkproof").unwrap().get_program().to_owned();
    let mut command = Command::new("sh");
    command.args(["-c", &script, "sh"]).arg(linkproof).args(&own.arguments).current_dir(place.path(""));
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let (input, mut to) = (own.standard_input.clone(), child.stdin.take().unwrap());
    // Whoever reads nothing closes the pipe.
    let feed = std::thread::spawn(move || drop(to.write_all(&input)));
    let output = child.wait_with_output().unwrap();
    feed.join().unwrap();
    let [said, complaint] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    let Some(code @ 0..=3) = output.status.code() else {
        return Err(format!("it ended with {}: {complaint:.2000}", output.status));
    };
    if complaint.contains("panicked") || code == 2 && complaint.trim().is_empty() && said.trim().is_empty() {
        return Err(format!("exit code {code}: {complaint:.2000}"));
    }
    if let Some(unseen) = said.chars().chain(complaint.chars()).find(|&letter| is_unseen(letter) && letter != '\n') {
        return Err(format!("it says {unseen:?}: {complaint:?}"));
    }
    let after = files(&place.path(""));
    for (name, bytes) in &before {
        if after.get(name) != Some(bytes) && !own.may.contains(&name.as_str()) {
            return Err(format!("{name} is not what it was"));
        }
    }
    // `times` tells minutes and seconds: of the shell, then of the command.
    let times = fs::read_to_string(told.path()).unwrap();
    let seconds = |word: &str| {
        let (minutes, seconds) = word.trim_end_matches('s').split_once('m')?;
        Some(60.0 * minutes.parse::<f64>().ok()? + seconds.parse::<f64>().ok()?)
    };
    let taken = times.lines().nth(1).unwrap_or_default().split_whitespace().filter_map(seconds).sum();
    Ok((code, taken))
}

/// `LINKPROOF_HOSTILE_FROM` and `LINKPROOF_HOSTILE` choose some by number.
#[test]
fn hostile_inputs_end_in_little_time_and_memory_and_change_no_file_of_others() {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let usual = if std::env::var_os("LINKPROOF_NIGHTLY").is_some() { MANY } else { FEW };
    let (from, count) = (number("LINKPROOF_HOSTILE_FROM").unwrap_or(0), number("LINKPROOF_HOSTILE").unwrap_or(usual));
    let good = good();
    let next = AtomicU64::new(from);
    let found = Mutex::new((BTreeMap::<(usize, i32), usize>::new(), Vec::<String>::new(), Vec::<(f64, String)>::new()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= from + count {
                        return;
                    }
                    let own = attack(SEED, index, &good);
                    let line = format!("{:.200}", own.arguments.join(" "));
                    let what = format!("number {index}, {}, {:?}: linkproof {line}", DOORS[own.door], own.what);
                    let ended = ending(&own);
                    let mut found = found.lock().unwrap();
                    match ended {
                        Ok((code, seconds)) => {
                            *found.0.entry((own.door, code)).or_insert(0) += 1;
                            found.2.push((seconds, what));
                        }
                        Err(why) => {
                            println!("{what}: {why}");
                            found.1.push(format!("{what}: {why}"));
                        }
                    }
                }
            });
        }
    });
    let (endings, failures, mut times) = found.into_inner().unwrap();
    times.sort_by(|a, b| b.0.total_cmp(&a.0));
    println!("{count} hostile inputs from number {from}:");
    endings.iter().for_each(|((door, code), count)| println!("{count:6} {} with exit code {code}", DOORS[*door]));
    times.iter().take(10).for_each(|(seconds, what)| println!("{seconds:6.2} s {what:.300}"));
    // A door at which everything is refused at once is no door that was tried.
    let is_tried = |door: usize| endings.keys().any(|&(own, code)| own == door && code != 2);
    let untried: Vec<&str> = (0..DOORS.len()).filter(|&door| !is_tried(door)).map(|door| DOORS[door]).collect();
    assert!(untried.is_empty() || count < FEW, "everything is refused at {untried:?}");
    assert!(failures.is_empty(), "{} of {count}:\n{}", failures.len(), failures.join("\n"));
}
