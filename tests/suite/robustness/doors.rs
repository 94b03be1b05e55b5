//! Hostile inputs of every kind, passed to the built command.
//! With 2 GB of memory and a minute of processor time, each run ends with an exit code and a message.
//! Each run leaves all files of the user unchanged.
#![cfg(target_os = "linux")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::LazyLock;

use assert_cmd::cargo::CommandCargoExt;
use linkage::mechanism::is_unseen;

use crate::cli::tools::{Place, listed};
use crate::common::draws;
use crate::common::hostile::{Attack, DOORS, Good, OLDER, attack};
use crate::common::many::{each, number};

/// Seed of all attacks.
const SEED: u64 = 1;
/// Number of attacks in an ordinary run; every kind of input gets the same number.
const FEW: u64 = 16 * DOORS.len() as u64;
/// Limits of memory (kB) and processor time (s) for a command.
/// Processor times of all threads add up, so a command with two busy threads reaches the limit in half the time.
const MEMORY: u64 = 2_000_000;
const SECONDS: u64 = 60;
/// If a command takes longer than this elapsed time (s), the command is stopped.
/// The slowest command takes a small fraction of this time.
const PATIENCE: u64 = 900;

static GOOD: LazyLock<Good> = LazyLock::new(|| {
    let place = Place::new();
    place.ok("run scenarios/pendulum.toml --route differences --record .");
    place.ok("accept scenarios/pendulum.toml --route differences");
    place.ok("stress turns --quick --out .");
    let columns = "solve scenarios/crank_rocker.toml --with assur --only point.B --csv table.csv";
    place.ok(columns);
    place.ok("solve scenarios/five_bar.toml --with newton --only positions --csv positions.csv");
    let read = |name: &str| fs::read(place.path(name)).unwrap();
    let recording = read("pendulum.mcap");
    let older = OLDER.map(|command| {
        let place = Place::empty();
        for name in ["pendulum.toml", "five_bar.toml"] {
            fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(name), place.path(name)).unwrap();
        }
        ["r", "h", "p"].iter().for_each(|name| fs::create_dir(place.path(name)).unwrap());
        if command.starts_with("view") {
            fs::write(place.path("r/pendulum.mcap"), &recording).unwrap();
        }
        let before = files(&place.path(""));
        place.ok(command);
        let made: Vec<_> = files(&place.path("")).into_iter().filter(|(name, _)| !before.contains_key(name)).collect();
        assert!(!made.is_empty(), "{command}");
        (command, made)
    });
    Good {
        recording,
        accepted: read("scenarios/pendulum.accepted"),
        stress: read("turns.json"),
        table: read("table.csv"),
        positions: read("positions.csv"),
        older: older.into(),
    }
});

/// All files below a directory, with their contents.
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

/// Outcome of an attack: exit code and processor time (s), or a description of the failure.
fn ending(own: &Attack) -> Result<(i32, f64), String> {
    let place = Place::empty();
    for (name, bytes) in &own.files {
        fs::create_dir_all(place.path(name).parent().unwrap()).unwrap();
        fs::write(place.path(name), bytes).unwrap();
    }
    // Files of the user under names that the program chooses.
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
    // If the command does not read its input, it closes the pipe, and the write fails; this failure is ignored.
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
        return Err(format!("the message contains {unseen:?}: {complaint:?}"));
    }
    let after = files(&place.path(""));
    for (name, bytes) in &before {
        if after.get(name) != Some(bytes) && !own.may.contains(name) {
            return Err(format!("{name} is not what it was"));
        }
    }
    // `times` prints processor times in minutes and seconds: the first line for the shell, the second line for the
    // command.
    let times = fs::read_to_string(told.path()).unwrap();
    let seconds = |word: &str| {
        let (minutes, seconds) = word.trim_end_matches('s').split_once('m')?;
        Some(60.0 * minutes.parse::<f64>().ok()? + seconds.parse::<f64>().ok()?)
    };
    let taken = times.lines().nth(1).unwrap_or_default().split_whitespace().filter_map(seconds).sum();
    Ok((code, taken))
}

/// `LINKPROOF_HOSTILE_FROM` and `LINKPROOF_HOSTILE` select attacks by number.
#[test]
fn hostile_inputs_stay_within_limits_and_change_no_other_files() {
    let usual = draws(FEW as usize) as u64;
    let (from, count) = (number("LINKPROOF_HOSTILE_FROM").unwrap_or(0), number("LINKPROOF_HOSTILE").unwrap_or(usual));
    let found = each(from, count, |index| {
        let own = attack(SEED, index, &GOOD);
        let line = format!("{:.200}", own.arguments.join(" "));
        let what = format!("number {index}, {}, {:?}: linkproof {line}", DOORS[own.door], own.what);
        let ended = ending(&own);
        if let Err(why) = &ended {
            println!("{what}: {why}");
        }
        (own.door, what, ended)
    });
    let mut endings = BTreeMap::<(usize, i32), usize>::new();
    let (mut times, mut failures) = (Vec::<(f64, &str)>::new(), Vec::<String>::new());
    for (_, (door, what, ended)) in &found {
        match ended {
            Ok((code, seconds)) => {
                *endings.entry((*door, *code)).or_insert(0) += 1;
                times.push((*seconds, what));
            }
            Err(why) => failures.push(format!("{what}: {why}")),
        }
    }
    times.sort_by(|a, b| b.0.total_cmp(&a.0));
    println!("{count} hostile inputs from number {from}:");
    endings.iter().for_each(|((door, code), count)| println!("{count:6} {} with exit code {code}", DOORS[*door]));
    times.iter().take(10).for_each(|(seconds, what)| println!("{seconds:6.2} s {what:.300}"));
    // A kind of input counts as tested only if some of its inputs are not refused at once.
    let is_tried = |door: usize| endings.keys().any(|&(own, code)| own == door && code != 2);
    let untried: Vec<&str> = (0..DOORS.len()).filter(|&door| !is_tried(door)).map(|door| DOORS[door]).collect();
    assert!(
        untried.is_empty() || count < FEW || from > 0,
        "all inputs of these kinds are refused at once: {untried:?}"
    );
    assert!(failures.is_empty(), "{} of {count}:\n{}", failures.len(), failures.join("\n"));
}

/// Names of values in the help that are not paths of files or directories.
const NO_PATHS: &str = "KEY=NUMBER REFERENCE ENGINE S ACCURACY N ROUTE TIMES STEPS GB FROM:TO:STEP LINK,LINK=MODE DEG FACTOR HZ \
    [HOST:]PORT WORD EXPR CHANNEL NAME=EXPR NUMBER [CHANNEL=]SHARE CHANNEL=SIZE WHAT NAME SOLVER SHARE KIND PARTY FAMILY \
    TEMPLATE MM MPA POINT PIXELS X,Y X,Y,DEG CRANK,ROCKER KG_PER_M K RPM SHELL PAGE[#SECTION] WITH COMMAND \
    METHOD SCALE SEED PERCENT LANGUAGE CURVE[,CURVE...] PORT TEXT NAME,NAME W,H KEY=VALUES every:N I/N END:FIGURE FIGURE KEY";
/// Options that name an output file. The command replaces any existing file at this path.
const WRITTEN: [&str; 3] = ["--output", "--run-up", "--write-map"];
/// Options that name a directory. The program chooses the file names in this directory, and therefore inspects existing
/// files.
const MADE: [&str; 5] = ["bench --output", "golden --output", "man --output", "run --output", "stress --output"];
/// Arguments without hostile input.
/// `new --shipped` names only a directory for files that the program writes.
/// `watch` does not end by itself, so `tests/suite/watch.rs` tests it with damaged files.
const NO_INPUT: [&str; 2] = ["new --shipped", "watch FILE"];

/// Collects the arguments of a command from its help: command, option or value, and name of the value.
fn arguments(place: &Place, command: &str, found: &mut Vec<(String, String, String)>) {
    let help = place.ok(format!("{command} --help").trim());
    let section = |title: &'static str| {
        let lines = help.lines().skip_while(move |line| *line != title).skip(1);
        let lines = lines.take_while(|line| line.is_empty() || line.starts_with(' '));
        lines.map(str::trim_start).filter(|line| !line.is_empty())
    };
    for line in section("Arguments:").filter(|line| line.starts_with(['<', '['])) {
        let word = line.split(' ').next().unwrap().trim_end_matches('.');
        let name = &word[1..word.len() - 1];
        found.push((command.into(), name.into(), name.into()));
    }
    for line in section("Options:").filter(|line| line.starts_with('-')) {
        let Some((_, value)) = line.split_once('<') else { continue };
        let name = line.split([' ', '=', '[']).find(|word| word.starts_with("--")).unwrap();
        found.push((command.into(), name.into(), value.split('>').next().unwrap().into()));
    }
    for own in listed(&help).filter(|own| *own != "help") {
        arguments(place, format!("{command} {own}").trim(), found);
    }
}

/// For every argument that the command line describes as input, there is a kind of hostile input.
#[test]
fn every_argument_that_is_read_gets_hostile_input() {
    let mut listed = Vec::new();
    arguments(&Place::empty(), "", &mut listed);
    assert!(listed.len() > 100, "{}", listed.len());
    let is_read = |command: &str, name: &str, value: &str| {
        let whole = format!("{command} {name}");
        let is_written = WRITTEN.contains(&name) && !MADE.contains(&whole.as_str());
        !NO_PATHS.split_whitespace().any(|own| own == value) && !is_written && !NO_INPUT.contains(&whole.as_str())
    };
    let read = listed.iter().filter(|(command, name, value)| is_read(command, name, value));
    let read: BTreeSet<String> = read
        .map(|(command, name, _)| if name.starts_with("--") { format!("{command} {name}") } else { command.clone() })
        .collect();
    let mut tried = BTreeSet::new();
    for index in 0..40 * DOORS.len() as u64 {
        let own = attack(SEED, index, &GOOD);
        let words = if own.arguments[0] == "synthesize" { 2 } else { 1 };
        let command = own.arguments[..words].join(" ");
        let options = own.arguments.iter().filter(|word| word.starts_with("--"));
        tried.extend(options.map(|word| format!("{command} {word}")));
        tried.insert(command);
    }
    let missing: Vec<_> = read.difference(&tried).collect();
    assert!(missing.is_empty(), "nobody tries {missing:?}");
}
