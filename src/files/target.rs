//! Whether a file can be written, and what is said if not.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::temporary::{create, directory_of};
use linkage::error::{Error, ErrorKind};

/// Tries whether a file can be written at `path`, before any work is done. Nothing is left there, and nothing that is
/// there is touched.
///
/// # Errors
/// What is in the way.
pub(crate) fn may_write(path: &Path) -> Result<(), String> {
    let old = fs::metadata(path).ok();
    if old.as_ref().is_some_and(fs::Metadata::is_dir) || path.as_os_str().to_string_lossy().ends_with('/') {
        return Err("this is a directory; expected a file".into());
    }
    // A pipe or a device is opened when there is something to write.
    if path.starts_with("/dev") || old.as_ref().is_some_and(|old| !old.is_file()) {
        return Ok(());
    }
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let directory = directory_of(&place);
    match fs::metadata(directory) {
        Ok(found) if found.is_dir() => try_directory(directory),
        Ok(_) => Err(format!("{} is no directory; expected a file in a directory", directory.display())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            Err(format!("there is no directory {}; expected one that is there", directory.display()))
        }
        Err(error) => Err(format!("{}: {error}; expected a directory that may be written to", directory.display())),
    }
}

/// The same for a directory that is made with all that it lies in.
///
/// # Errors
/// What is in the way.
pub(crate) fn may_fill(directory: &Path) -> Result<(), String> {
    let mut there: PathBuf = directory.to_path_buf();
    loop {
        match fs::metadata(&there) {
            Ok(found) if found.is_dir() => return try_directory(&there),
            Ok(_) => return Err(format!("{} is no directory; expected one", there.display())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => there = directory_of(&there).to_path_buf(),
            Err(error) => return Err(format!("{}: {error}; expected a directory", there.display())),
        }
    }
}

fn try_directory(directory: &Path) -> Result<(), String> {
    match create(directory) {
        Ok(_) => Ok(()),
        Err(error) => {
            Err(format!("{}: {}; expected a directory that may be written to", directory.display(), why(&error)))
        }
    }
}

/// Why something could not be written, in words.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the standard library")]
fn why(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::StorageFull => "no room is left on the device".into(),
        io::ErrorKind::QuotaExceeded => "the quota on the device is used up".into(),
        io::ErrorKind::FileTooLarge => "a file of this size is not allowed".into(),
        _ => error.to_string(),
    }
}

/// The error of an output that could not be written: `what` it is, and how many bytes it `needs`, if that is known.
/// `usual` is the way out where there is room.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the standard library")]
pub(crate) fn unwritten(what: &str, error: &io::Error, needs: Option<u64>, usual: &str) -> Error {
    let way_out = match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "make room there, or write to another device",
        io::ErrorKind::FileTooLarge => "raise the limit on the size of files, or ask for fewer instants or channels",
        _ => usual,
    };
    let needs = needs.filter(|_| way_out != usual).map(|bytes| format!("; {} are needed", size(bytes)));
    let message = format!("{what} cannot be written: {}{}", why(error), needs.unwrap_or_default());
    Error::new(ErrorKind::Io, message).help(way_out)
}

/// A size in words.
pub(crate) fn size(bytes: u64) -> String {
    match bytes {
        0..10_000 => format!("{bytes} bytes"),
        10_000..1_000_000 => format!("{:.0} kB", bytes as f64 / 1e3),
        1_000_000..10_000_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.0} MB", bytes as f64 / 1e6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_are_tried_and_left_alone() {
        let own = tempfile::tempdir().unwrap();
        let at = |name: &str| own.path().join(name);
        fs::write(at("file"), "old").unwrap();
        for (path, words) in [
            (at(""), "a directory"),
            (at("new/"), "a directory"),
            (at("no/file"), "there is no directory"),
            (at("file/below"), "directory"),
        ] {
            let told = may_write(&path).unwrap_err();
            assert!(told.contains(words) && told.contains("expected"), "{}: {told}", path.display());
        }
        assert_eq!(
            [may_write(&at("file")), may_write(&at("new")), may_write(Path::new("/dev/null"))],
            [Ok(()), Ok(()), Ok(())]
        );
        assert_eq!([may_fill(own.path()), may_fill(&at("a/b/c"))], [Ok(()), Ok(())]);
        assert!(may_fill(&at("file")).is_err() && may_fill(&at("file/a")).is_err());
        let left: Vec<_> = fs::read_dir(own.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!((left, fs::read_to_string(at("file")).unwrap().as_str()), (vec!["file".into()], "old"));
    }

    #[test]
    fn sizes_are_told_in_few_digits() {
        let told = [874, 874_918, 5_000_000, 62_000_000].map(size);
        assert_eq!(told, ["874 bytes", "875 kB", "5.0 MB", "62 MB"]);
    }

    #[test]
    fn a_full_device_is_called_so() {
        let told = |kind: io::ErrorKind| unwritten("out.csv", &kind.into(), Some(20_400), "usual").to_string();
        let full = "out.csv cannot be written: no room is left on the device; 20 kB are needed; make room there, or write to another device";
        assert_eq!(told(io::ErrorKind::StorageFull), full);
        assert!(
            told(io::ErrorKind::FileTooLarge)
                .contains("of this size is not allowed; 20 kB are needed; raise the limit")
        );
        assert!(told(io::ErrorKind::PermissionDenied).ends_with("; usual"));
    }
}
