//! Decides to which paths files may be written and which files may be replaced.
//! If a file may not be written or replaced, this module describes the error.

use crate::sentences;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::temporary::{create, directory_of};
use linkage::error::{Error, ErrorKind};

/// Upper limit of the number of symbolic links followed from a name to its file.
const LINKS: usize = 40;
/// Number of bytes at the beginning of an older file that decide whether the file may be replaced.
const SEEN: u64 = 64 << 20;

/// A file to be written, with the rule for replacing an existing file.
/// A file is replaced only if the caller named it or this program wrote it.
/// A symbolic link is followed only if the caller named it.
pub enum OutputTarget<'a> {
    /// The caller named exactly this file.
    Named(&'a Path),
    /// The program generated the name of the file, or a part of the name.
    /// An older file is replaced if `is_ours` accepts its content (its first 64 MiB if it is longer).
    Made(&'a Path, &'a dyn Fn(&[u8]) -> bool),
}

/// The path or file to which the content is written.
pub(super) enum Place {
    /// The content goes to a path that is already open or that is not a regular file.
    Open(PathBuf),
    /// The content replaces this file. The metadata describe the existing file, if there is one.
    File(PathBuf, Option<fs::Metadata>),
}

impl OutputTarget<'_> {
    /// Returns the destination of the content.
    ///
    /// # Errors
    /// [`io::ErrorKind::AlreadyExists`] if an existing file may not be replaced.
    /// The errors of the file system are passed on.
    pub(super) fn place(&self) -> io::Result<Place> {
        match *self {
            OutputTarget::Named(path) => {
                let old = fs::metadata(path).ok();
                if is_open_already(path) || old.as_ref().is_some_and(|old| !old.is_file()) {
                    return Ok(Place::Open(path.to_path_buf()));
                }
                Ok(Place::File(followed(path)?, old))
            }
            OutputTarget::Made(path, is_ours) => {
                let in_the_way = |what: &str| Err(io::Error::new(io::ErrorKind::AlreadyExists, what));
                let old = match fs::symlink_metadata(path) {
                    Err(error) if error.kind() == io::ErrorKind::NotFound => None,
                    other => Some(other?),
                };
                match &old {
                    None => {}
                    Some(old) if old.is_symlink() => return in_the_way(sentences::A_SYMBOLIC_LINK_THAT_NOBODY),
                    Some(old) if !old.is_file() => return in_the_way(sentences::SOMETHING_ELSE_THAN_A_FILE),
                    Some(_) => {
                        let mut bytes = Vec::new();
                        File::open(path)?.take(SEEN).read_to_end(&mut bytes)?;
                        if !is_ours(&bytes) {
                            return in_the_way(sentences::A_FILE_IS_THERE_THAT_THIS_PROGRAM);
                        }
                    }
                }
                Ok(Place::File(path.to_path_buf(), old))
            }
        }
    }

    /// The reason, in words, why an existing file may not be replaced; otherwise `None`.
    pub fn in_the_way(&self) -> Option<String> {
        self.place().err().filter(|error| error.kind() == io::ErrorKind::AlreadyExists).map(|error| error.to_string())
    }
}

/// Whether a path names a file that this process or the system already has open.
fn is_open_already(path: &Path) -> bool {
    let open = ["/dev/stdout", "/dev/stderr", "/dev/stdin"].map(Path::new);
    open.contains(&path) || path.starts_with("/dev/fd") || path.starts_with("/proc/self/fd")
}

/// The file to which a path leads through all symbolic links, whether or not it exists.
fn followed(path: &Path) -> io::Result<PathBuf> {
    let mut place = path.to_path_buf();
    for _ in 0..LINKS {
        match fs::read_link(&place) {
            Ok(next) => place = directory_of(&place).join(next),
            // `place` is not a symbolic link, so the search ends here.
            Err(_) => return Ok(place),
        }
    }
    Err(io::Error::other(sentences::more_than_symbolic_links_lead(&LINKS)))
}

/// Tests whether a file can be written at `path`, which the caller named.
/// Callers run this test before they compute the file's content.
/// The test leaves no file behind and does not change an existing file.
///
/// # Errors
/// The obstacle, in words.
pub fn may_write(path: &Path) -> Result<(), String> {
    if fs::metadata(path).is_ok_and(|old| old.is_dir()) || path.as_os_str().to_string_lossy().ends_with('/') {
        return Err(sentences::THIS_IS_A_DIRECTORY_EXPECTED.into());
    }
    let place = match OutputTarget::Named(path).place() {
        // A pipe or a device is not tested here, because it is opened only when its content is written.
        Ok(Place::Open(_)) => return Ok(()),
        Ok(Place::File(place, _)) => place,
        Err(error) => return Err(sentences::expected_a_file(&error)),
    };
    let directory = directory_of(&place);
    match fs::metadata(directory) {
        Ok(found) if found.is_dir() => try_directory(directory),
        Ok(_) => Err(sentences::is_no_directory_expected_a_file(&directory.display())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            Err(sentences::there_is_no_directory_expected(&directory.display()))
        }
        Err(error) => Err(sentences::expected_a_directory_that_may(&directory.display(), &error)),
    }
}

/// Tests whether files can be written in a directory. The directory and its parents need not exist yet.
///
/// # Errors
/// The obstacle, in words.
pub fn may_fill(directory: &Path) -> Result<(), String> {
    let mut there: PathBuf = directory.to_path_buf();
    loop {
        match fs::metadata(&there) {
            Ok(found) if found.is_dir() => return try_directory(&there),
            Ok(_) => return Err(sentences::is_no_directory_expected_one(&there.display())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => there = directory_of(&there).to_path_buf(),
            Err(error) => return Err(sentences::expected_a_directory(&there.display(), &error)),
        }
    }
}

fn try_directory(directory: &Path) -> Result<(), String> {
    match create(directory) {
        Ok(_) => Ok(()),
        Err(error) => Err(sentences::expected_a_directory_that_may(&directory.display(), &why(&error))),
    }
}

/// The reason why an output could not be written, in words.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the standard library")]
fn why(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::StorageFull => sentences::NO_ROOM_IS_LEFT_ON_THE_DEVICE.into(),
        io::ErrorKind::QuotaExceeded => sentences::THE_QUOTA_ON_THE_DEVICE_IS_USED.into(),
        io::ErrorKind::FileTooLarge => sentences::A_FILE_OF_THIS_SIZE_IS_NOT_ALLOWED.into(),
        _ => error.to_string(),
    }
}

/// The error of an output that could not be written.
/// `what` names the output. `needs` is the size of the output in bytes, if known.
/// The remedy is `usual`, except for three causes: missing space, an existing file and a size limit.
/// Each of these causes has a special remedy.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the standard library")]
pub fn unwritten(what: &str, error: &io::Error, needs: Option<u64>, usual: &str) -> Error {
    let way_out = match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => sentences::MAKE_ROOM_THERE_OR_WRITE,
        io::ErrorKind::AlreadyExists => sentences::RENAME_OR_REMOVE_WHAT_IS_THERE,
        io::ErrorKind::FileTooLarge => sentences::RAISE_THE_LIMIT_ON_THE_SIZE,
        _ => usual,
    };
    let is_room = error.kind() != io::ErrorKind::AlreadyExists && way_out != usual;
    let needs = needs.filter(|_| is_room).map(|bytes| sentences::are_needed(&size(bytes)));
    let message = sentences::cannot_be_written(&what, &why(error), &needs.unwrap_or_default());
    Error::new(ErrorKind::Io, message).help(way_out)
}

/// A size in words, such as `875 kB`.
pub fn size(bytes: u64) -> String {
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
    fn checking_a_target_does_not_change_it() {
        let own = tempfile::tempdir().unwrap();
        let at = |name: &str| own.path().join(name);
        fs::write(at("file"), "old").unwrap();
        for (path, words) in [
            (at(""), "a directory"),
            (at("new/"), "a directory"),
            (at("no/file"), "the directory"),
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
    fn sizes_are_printed_with_few_digits() {
        let told = [874, 874_918, 5_000_000, 62_000_000].map(size);
        assert_eq!(told, ["874 bytes", "875 kB", "5.0 MB", "62 MB"]);
    }

    #[test]
    fn a_full_device_is_reported_as_such() {
        let told = |kind: io::ErrorKind| unwritten("out.csv", &kind.into(), Some(20_400), "usual").to_string();
        let full = "out.csv cannot be written: no space is left on the device; 20 kB are needed; free space there, or write to another device";
        assert_eq!(told(io::ErrorKind::StorageFull), full);
        assert!(
            told(io::ErrorKind::FileTooLarge)
                .contains("of this size is not allowed; 20 kB are needed; raise the limit")
        );
        assert!(told(io::ErrorKind::PermissionDenied).ends_with("; usual"));
    }
}
