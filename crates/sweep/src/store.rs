//! The directory of a sweep: its plan, its parts, and the joined table.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use files::{OutputTarget, put, read_text, replace};
use linkage::error::{Error, ErrorKind, Result};

use crate::plan::SweepPlan;
use crate::sentences;
use crate::table::{self, JoinedTable, RowGroup};

/// Name of the stored plan.
const PLAN: &str = "sweep.json";
/// Name of the joined table.
pub const TABLE: &str = "cases.parquet";
/// Directory of the parts.
const PARTS: &str = "parts";

/// Number of further attempts to remove the directory of the parts.
const REMOVALS: usize = 100;

/// A directory with the results of one sweep.
#[derive(Clone, Debug)]
pub struct SweepStore {
    directory: PathBuf,
}

/// The error of a file or directory that cannot be used.
pub(crate) fn broken(path: &Path, error: &dyn std::fmt::Display) -> Error {
    Error::new(ErrorKind::Io, sentences::cannot_be_used(&path.display(), error))
        .help(sentences::CHOOSE_ANOTHER_DIRECTORY)
}

/// Where a table is written: at `at`, in place of an earlier table of this program.
/// A file that is empty or holds only zeros is replaced too: it remains if the computer lost power during the writing.
fn target(at: &Path) -> OutputTarget<'_> {
    OutputTarget::Made(at, &|bytes| bytes.starts_with(b"PAR1") || bytes.iter().all(|byte| *byte == 0))
}

impl SweepStore {
    /// Opens or creates the directory of a sweep.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if the directory holds another sweep, or other files.
    /// [`ErrorKind::Io`] if the directory cannot be read or written.
    pub fn open(directory: &Path, plan: &SweepPlan) -> Result<SweepStore> {
        let store = SweepStore { directory: directory.into() };
        let (at, text) = (directory.join(PLAN), plan.stored());
        match read_text(&at) {
            Ok(stored) if stored == text => {}
            Ok(_) => {
                let message = sentences::holds_another_sweep(&directory.display());
                return Err(Error::new(ErrorKind::Input, message).help(sentences::CHOOSE_ANOTHER_DIRECTORY));
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let entries = fs::read_dir(directory).into_iter().flatten().flatten();
                let mut names = entries.map(|own| own.file_name().to_string_lossy().into_owned());
                if let Some(name) = names.find(|name| !files::is_temporary(name)) {
                    // Another process of the same sweep may have written the plan since the attempt to read it.
                    if at.is_file() {
                        return SweepStore::open(directory, plan);
                    }
                    let message = sentences::holds_other_files(&directory.display(), &files::visible(&name));
                    return Err(Error::new(ErrorKind::Input, message).help(sentences::CHOOSE_ANOTHER_DIRECTORY));
                }
                fs::create_dir_all(directory).map_err(|error| broken(directory, &error))?;
                let target = OutputTarget::Made(&at, &|_| false);
                let write = |mut file: &File| io::Write::write_all(&mut file, text.as_bytes());
                // `AlreadyExists`: another process of the same sweep has written the plan since the check.
                match replace::<io::Error>(&target, write) {
                    Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                        return SweepStore::open(directory, plan);
                    }
                    result => result.map_err(|error| broken(&at, &error))?,
                }
            }
            Err(error) => return Err(broken(&at, &error)),
        }
        let parts = store.directory.join(PARTS);
        match store.is_complete() {
            // A run that was killed after joining may have left parts.
            true => store.remove_parts()?,
            false => fs::create_dir_all(&parts).map_err(|error| broken(&parts, &error))?,
        }
        Ok(store)
    }

    /// Opens the directory of an earlier run, and reads its plan.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] if the directory has no plan, and the errors of [`SweepPlan::of_stored`].
    pub fn found(directory: &Path) -> Result<(SweepStore, SweepPlan)> {
        let text = read_text(&directory.join(PLAN)).map_err(|error| {
            let message = format!("{}: {error}", sentences::no_sweep_in(&directory.display()));
            Error::new(ErrorKind::Io, message).help(sentences::NAME_THE_DIRECTORY_OF_A_SWEEP)
        })?;
        Ok((SweepStore { directory: directory.into() }, SweepPlan::of_stored(&text)?))
    }

    /// Joins the shards in some directories to one table in the directory `to`, if it is not there yet. If one of the
    /// directories already has the joined table, this table is copied.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if the directories are of different sweeps. The errors of [`SweepStore::found`],
    /// [`SweepStore::open`] and [`SweepStore::join`].
    pub fn merged(directories: &[PathBuf], to: &Path) -> Result<(SweepStore, SweepPlan)> {
        let found = directories.iter().map(|own| SweepStore::found(own)).collect::<Result<Vec<_>>>()?;
        let (stores, mut plans): (Vec<SweepStore>, Vec<SweepPlan>) = found.into_iter().unzip();
        if let Some(other) = plans.iter().position(|plan| plan.stored() != plans[0].stored()) {
            let [first, other] = [0, other].map(|index| directories[index].display().to_string());
            let message = sentences::are_of_different_sweeps(&first, &other);
            return Err(Error::new(ErrorKind::Input, message).help(sentences::NAME_THE_SHARDS_OF_ONE_SWEEP));
        }
        let plan = plans.swap_remove(0);
        let store = SweepStore::open(to, &plan)?;
        match stores.iter().find(|own| own.is_complete()) {
            _ if store.is_complete() => {}
            Some(done) => {
                let at = store.table();
                let copy = |mut file: &File| io::copy(&mut File::open(done.table())?, &mut file).map(drop);
                replace::<io::Error>(&target(&at), copy).map_err(|error| broken(&at, &error))?;
                store.remove_parts()?;
            }
            None => store.join(&plan, &stores)?,
        }
        Ok((store, plan))
    }

    /// The joined table.
    #[must_use]
    pub fn table(&self) -> PathBuf {
        self.directory.join(TABLE)
    }

    /// Whether the joined table exists.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.table().is_file()
    }

    /// The directory.
    #[must_use]
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// The file of a part. The file exists until the parts are joined.
    #[must_use]
    pub fn part(&self, part: u64) -> PathBuf {
        self.directory.join(PARTS).join(format!("{part:09}.parquet"))
    }

    /// Whether a part is stored. If the end of a part's file is missing, for example after a loss of power, the part
    /// counts as not stored.
    #[must_use]
    pub fn has(&self, part: u64) -> bool {
        let ends = |mut file: File| {
            let mut end = [0; 4];
            file.seek(SeekFrom::End(-4)).and_then(|_| file.read_exact(&mut end)).is_ok_and(|()| end == *b"PAR1")
        };
        File::open(self.part(part)).is_ok_and(ends)
    }

    /// Writes the rows of a part. If a run is killed, unfinished files remain until the parts are joined and removed.
    pub(crate) fn write(&self, plan: &SweepPlan, part: u64, rows: &RowGroup) -> Result<()> {
        let (at, first) = (self.part(part), plan.cases_of(part).start);
        match put(&target(&at), |file| table::write(plan, first, rows, file).map_err(io::Error::other)) {
            // Another process of the same sweep was faster: it has joined and removed the parts.
            Err(_) if self.is_complete() => Ok(()),
            result => result.map_err(|error| broken(&at, &error)),
        }
    }

    /// Joins all parts to one table, and removes the parts of this directory.
    /// Parts may be in the directories `others` of further shards.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if a part is missing. [`ErrorKind::Io`] if a part cannot be read.
    pub fn join(&self, plan: &SweepPlan, others: &[SweepStore]) -> Result<()> {
        let mut parts = Vec::new();
        for part in 0..plan.parts() {
            let Some(holder) = std::iter::once(self).chain(others).find(|store| store.has(part)) else {
                let cases = plan.cases_of(part);
                let message = sentences::a_part_is_missing(&part, &cases.start, &(cases.end - 1));
                return Err(Error::new(ErrorKind::Input, message).help(sentences::RUN_THE_MISSING_SHARD));
            };
            parts.push(holder.part(part));
        }
        self.fill(plan, |table| Ok(parts.iter().try_for_each(|part| table.append(part)).map_err(io::Error::other)?))
    }

    /// Lets `fill` append all parts to the joined table, and removes the parts of this directory.
    /// If `fill` returns `Err(None)`, the sweep is not finished: there is no joined table, and the parts stay.
    pub(crate) fn fill(
        &self,
        plan: &SweepPlan,
        fill: impl FnOnce(&mut JoinedTable) -> std::result::Result<(), Option<io::Error>>,
    ) -> Result<()> {
        let at = self.table();
        let filled = replace::<Option<io::Error>>(&target(&at), |file| {
            let mut table = JoinedTable::new(plan, file).map_err(io::Error::other)?;
            fill(&mut table)?;
            Ok(table.close().map_err(io::Error::other)?)
        });
        match filled {
            // Another process of the same sweep was faster, and has removed the parts.
            Err(Some(_)) if self.is_complete() => Ok(()),
            Err(Some(error)) => Err(broken(&at, &error)),
            Err(None) => Ok(()),
            Ok(()) => self.remove_parts(),
        }
    }

    /// Removes the directory of the parts, if it exists.
    fn remove_parts(&self) -> Result<()> {
        let own = self.directory.join(PARTS);
        // Another process may still write a part, and then the directory is not empty at the end of its removal.
        let mut removed = fs::remove_dir_all(&own);
        for _ in 0..REMOVALS {
            if removed.as_ref().is_err_and(|error| error.kind() == io::ErrorKind::DirectoryNotEmpty) {
                removed = fs::remove_dir_all(&own);
            }
        }
        match removed {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(broken(&own, &error)),
            Err(_) | Ok(()) => Ok(()),
        }
    }
}
