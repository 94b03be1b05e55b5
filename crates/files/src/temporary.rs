//! Temporary files in the directory of the file that they will replace.

use std::fs::{self, File, TryLockError};
use std::hash::{BuildHasher, RandomState};
use std::io;
use std::path::{Path, PathBuf};

use super::seal::check;
use tempfile::{Builder, NamedTempFile};

/// Beginning and end of the names of temporary files.
/// Between them are random digits and their check digits, so that other files with a similar name are not mistaken for
/// temporary ones.
const TEMPORARY: [&str; 2] = [".linkproof-", ".partial"];

/// A name that no other run has.
fn name() -> String {
    let random = format!("{:016x}", RandomState::new().hash_one(0));
    format!("{}{random}-{}{}", TEMPORARY[0], check(&random), TEMPORARY[1])
}

/// Whether [`name`] generated a file's name.
fn is_own(name: &str) -> bool {
    let inner = name.strip_prefix(TEMPORARY[0]).and_then(|rest| rest.strip_suffix(TEMPORARY[1]));
    inner.and_then(|inner| inner.split_once('-')).is_some_and(|(random, digits)| check(random) == digits)
}

/// The directory that contains a path.
pub(super) fn directory_of(path: &Path) -> &Path {
    path.parent().filter(|parent| *parent != Path::new("")).unwrap_or(Path::new("."))
}

/// A new temporary file that is locked as long as it is open.
pub(super) fn create(directory: &Path) -> io::Result<NamedTempFile> {
    loop {
        let own = name();
        let mut builder = Builder::new();
        builder.prefix(&own).rand_bytes(0);
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let temporary = builder.tempfile_in(directory)?;
        // On a file system without locks, nothing is cleared either.
        let _ = temporary.as_file().lock();
        // Before the lock, another run may have taken the file for a stale one and removed it.
        if temporary.path().exists() {
            return Ok(temporary);
        }
    }
}

/// Removes the temporary files of killed runs, recognised by their free locks.
pub(super) fn clear(directory: &Path) {
    let Ok(entries) = fs::read_dir(directory) else { return };
    let is_temporary = |path: &PathBuf| path.file_name().and_then(|name| name.to_str()).is_some_and(is_own);
    for path in entries.flatten().map(|entry| entry.path()).filter(is_temporary) {
        // A symbolic link is not one of these files, and is not followed.
        if !fs::symlink_metadata(&path).is_ok_and(|found| found.is_file()) {
            continue;
        }
        let Ok(file) = File::open(&path) else { continue };
        match file.try_lock() {
            // A file that cannot be removed stays.
            Ok(()) => drop(fs::remove_file(&path)),
            Err(TryLockError::WouldBlock | TryLockError::Error(_)) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_killed_run_has_left_goes_and_what_others_call_so_stays() {
        let own = tempfile::tempdir().unwrap();
        let at = |name: &str| own.path().join(name);
        let (stale, busy) = (name(), name());
        let others =
            [".linkproof-notes.partial", ".linkproof-0123456789abcdef-00000000.partial", ".linkproof-.partial"];
        for file in others.iter().copied().chain([stale.as_str(), busy.as_str()]) {
            fs::write(at(file), "half a file").unwrap();
        }
        let writing = File::open(at(&busy)).unwrap();
        writing.lock().unwrap();
        clear(own.path());
        assert!(!at(&stale).exists());
        assert!(at(&busy).exists() && others.iter().all(|other| at(other).exists()));
        assert!(create(own.path()).unwrap().path().file_name().and_then(|name| name.to_str()).is_some_and(is_own));
    }
}
