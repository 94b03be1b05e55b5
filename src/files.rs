//! Files that appear whole or not at all.
//!
//! The content goes to a temporary file in the same directory, created new and locked, which then takes the place of
//! the file. So a run that fails or is killed leaves an older file alone, and two runs to one path do not mix.

mod text;

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

pub(crate) use text::{read_named, read_text, text, way_out};

use tempfile::{Builder, NamedTempFile};

/// Beginning and end of the names of temporary files.
const TEMPORARY: [&str; 2] = [".linkproof-", ".partial"];

/// Lets `fill` write the file at `path`, which is replaced when all is written. A link is followed to the file that it
/// names. What is no regular file, such as a pipe, and what is open already, such as `/dev/stdout`, is written to as it
/// is.
///
/// # Errors
/// Those of `fill` and of the file system. The file at `path` is then what it was.
pub(crate) fn replace<E: From<io::Error>>(path: &Path, fill: impl FnOnce(&File) -> Result<(), E>) -> Result<(), E> {
    let old = fs::metadata(path).ok();
    if path.starts_with("/dev") || old.as_ref().is_some_and(|old| !old.is_file()) {
        return fill(&File::options().write(true).open(path)?);
    }
    let place = match old {
        Some(_) => fs::canonicalize(path)?,
        None => path.to_path_buf(),
    };
    let directory = place.parent().filter(|parent| *parent != Path::new("")).unwrap_or(Path::new("."));
    clear(directory);
    let temporary = create(directory)?;
    if let Some(old) = old {
        temporary.as_file().set_permissions(old.permissions())?;
    }
    fill(temporary.as_file())?;
    temporary.as_file().sync_all()?;
    temporary.persist(&place).map_err(|error| error.error)?;
    Ok(())
}

/// A new temporary file that is locked as long as it is open.
fn create(directory: &Path) -> io::Result<NamedTempFile> {
    loop {
        let mut builder = Builder::new();
        builder.prefix(TEMPORARY[0]).suffix(TEMPORARY[1]);
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let temporary = builder.tempfile_in(directory)?;
        // Where a file system has no locks, nothing is cleared either.
        let _ = temporary.as_file().lock();
        // Another run may have taken it for a stale one before it was locked.
        if temporary.path().exists() {
            return Ok(temporary);
        }
    }
}

/// Removes the temporary files of runs that were killed: nobody holds their locks.
fn clear(directory: &Path) {
    let Ok(entries) = fs::read_dir(directory) else { return };
    let is_temporary = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str());
        name.is_some_and(|name| name.starts_with(TEMPORARY[0]) && name.ends_with(TEMPORARY[1]))
    };
    for path in entries.flatten().map(|entry| entry.path()).filter(is_temporary) {
        // A link is no file of ours, and is not followed.
        if !fs::symlink_metadata(&path).is_ok_and(|found| found.is_file()) {
            continue;
        }
        let Ok(file) = File::open(&path) else { continue };
        match file.try_lock() {
            // What cannot be removed stays.
            Ok(()) => drop(fs::remove_file(&path)),
            Err(TryLockError::WouldBlock | TryLockError::Error(_)) => {}
        }
    }
}
