//! Temporary files in the directory of the file that they will replace.

use std::fs::{self, File, TryLockError};
use std::hash::{BuildHasher, RandomState};
use std::io;
use std::path::{Path, PathBuf};

use super::seal::check;
use tempfile::{Builder, NamedTempFile};

/// Beginning and end of the names of temporary files.
/// Each name contains random digits and their check digits between this beginning and this end.
/// A file of another program is therefore not mistaken for a temporary file, even if its name is similar.
const TEMPORARY: [&str; 2] = [".linkproof-", ".partial"];

/// A random name for a temporary file.
fn name() -> String {
    let random = format!("{:016x}", RandomState::new().hash_one(0));
    format!("{}{random}-{}{}", TEMPORARY[0], check(&random), TEMPORARY[1])
}

/// Whether a file of this name is a temporary file of this program.
#[must_use]
pub fn is_temporary(name: &str) -> bool {
    let inner = name.strip_prefix(TEMPORARY[0]).and_then(|rest| rest.strip_suffix(TEMPORARY[1]));
    inner.and_then(|inner| inner.split_once('-')).is_some_and(|(random, digits)| check(random) == digits)
}

/// The directory that contains a path.
pub(super) fn directory_of(path: &Path) -> &Path {
    path.parent().filter(|parent| *parent != Path::new("")).unwrap_or(Path::new("."))
}

/// Creates a temporary file. The file stays locked until it is closed.
pub(super) fn create(directory: &Path) -> io::Result<NamedTempFile> {
    loop {
        let own = name();
        let mut builder = Builder::new();
        builder.prefix(&own).rand_bytes(0);
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let temporary = builder.tempfile_in(directory)?;
        // On a file system without locks this call fails. The failure is harmless, because `clear` then removes no
        // files.
        let _ = temporary.as_file().lock();
        // Before this run locked the file, another run may have removed it as stale. A new file is then created.
        if temporary.path().exists() {
            return Ok(temporary);
        }
    }
}

/// Removes the temporary files of killed runs. No process holds the lock of such a file.
pub(super) fn clear(directory: &Path) {
    let Ok(entries) = fs::read_dir(directory) else { return };
    let is_old = |path: &PathBuf| path.file_name().and_then(|name| name.to_str()).is_some_and(is_temporary);
    for path in entries.flatten().map(|entry| entry.path()).filter(is_old) {
        // A symbolic link is skipped and not followed, because it cannot be a temporary file of this program.
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
    fn stale_temporary_files_are_removed_and_foreign_files_kept() {
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
        assert!(
            create(own.path()).unwrap().path().file_name().and_then(|name| name.to_str()).is_some_and(is_temporary)
        );
    }
}
