//! Runs a program with a time limit.
//! The program's output goes to files. A long output therefore cannot block the program or fill the memory.

use crate::sentences;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::Duration;

use crate::bench::Clock;

/// Pause between two checks of a running program: one value for the first 0.1 s, and one value for the time afterwards.
/// The first pauses are short, so that the end of a quick program is noticed without delay.
const PAUSES: [Duration; 2] = [Duration::from_millis(2), Duration::from_millis(20)];
/// Largest number of bytes read from a program.
const MOST: u64 = 64 << 20;
/// Number of characters of standard error that are shown.
const TOLD: usize = 200;

/// Runs a shell command with arguments in a directory, and returns its standard output.
///
/// # Errors
/// The reason of the failure: the program cannot be started, takes too long, writes too much, or ends with an error.
pub(super) fn run(
    command: &str,
    arguments: &[&str],
    directory: &Path,
    limit: f64,
    clock: Clock,
) -> Result<String, String> {
    let [out, err] = ["stdout", "stderr"].map(|name| directory.join(name));
    let file = |path: &Path| {
        // A symbolic link left by an earlier call must not be followed, so the file is removed.
        let _ = fs::remove_file(path);
        File::create_new(path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let mut shell = Command::new("sh");
    // `sh` takes the first word after the script as the script's name.
    // The other words are arguments, which `sh` never parses as a script.
    shell.arg("-c").arg(format!("exec {command} \"$@\"")).arg("peer").args(arguments);
    shell.stdin(Stdio::null()).stdout(file(&out)?).stderr(file(&err)?);
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut shell, 0);
    let mut child = shell.spawn().map_err(|error| sentences::it_cannot_be_started(&error))?;
    let status = wait(&mut child, &[&out, &err], limit, clock)?;
    // Processes that are still running are ended, because they could change the answer while it is read.
    end_group(&child);
    let written = text(&out)?;
    if status.success() {
        return Ok(written);
    }
    let complaint = text(&err).unwrap_or_default();
    let last =
        complaint.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or(sentences::NOTHING_ON_STANDARD_ERROR);
    Err(sentences::it_ended_with(&status, &(last.trim().chars().take(TOLD).collect::<String>())))
}

fn wait(child: &mut Child, files: &[&Path], limit: f64, clock: Clock) -> Result<ExitStatus, String> {
    let since = clock();
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(status),
            Ok(None) => {}
            Err(error) => return Err(sentences::it_cannot_be_waited_for(&error)),
        }
        let taken = clock() - since;
        let written = files.iter().filter_map(|file| fs::metadata(file).ok()).map(|found| found.len()).max();
        let reason = match (taken > limit, written > Some(MOST)) {
            (true, _) => sentences::it_was_stopped_after_without(&limit),
            (false, true) => sentences::it_was_stopped_after_bytes(&MOST),
            (false, false) => {
                std::thread::sleep(PAUSES[usize::from(taken > 0.1)]);
                continue;
            }
        };
        stop(child);
        return Err(reason);
    }
}

/// Ends the processes that a program has started.
/// Processes started by the program belong to the program's process group.
fn end_group(child: &Child) {
    if cfg!(unix) {
        let group = format!("-{}", child.id());
        // An empty process group is not a failure, so the message of `kill` is suppressed.
        let _ = Command::new("kill").args(["-KILL", "--", &group]).stderr(Stdio::null()).status();
    }
}

/// Ends a program and the processes that it has started.
fn stop(child: &mut Child) {
    end_group(child);
    // An error is ignored, because the program may have ended already.
    let _ = child.kill();
    let _ = child.wait();
}

/// Text of a file that a program should have written; bytes that are not text are replaced.
/// Only regular files are read. A pipe or a device might never end, and a symbolic link might lead to another file.
pub(super) fn text(path: &Path) -> Result<String, String> {
    let found = fs::symlink_metadata(path).map_err(|error| sentences::is_not_there(&name(path), &error))?;
    if !found.is_file() {
        return Err(sentences::is_no_regular_file(&name(path)));
    }
    let file = File::open(path).map_err(|error| sentences::cannot_be_read_2(&name(path), &error))?;
    taken(file).map_err(|error| format!("{} {error}", name(path)))
}

/// Text of an open file, of bounded length.
fn taken(file: File) -> Result<String, String> {
    let mut bytes = Vec::new();
    file.take(MOST + 1).read_to_end(&mut bytes).map_err(|error| sentences::cannot_be_read(&error))?;
    if bytes.len() as u64 > MOST {
        return Err(sentences::has_more_than_bytes(&MOST));
    }
    Ok(String::from_utf8(bytes).unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned()))
}

fn name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}
