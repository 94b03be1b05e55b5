//! Lists of scenarios, channels and solvers.

use std::fmt::{Display, Write};
use std::path::{Path, PathBuf};

use super::tell::Tell;
use crate::scenario::Scenario;
use linkage::error::Result;
use linkage::trajectory::{CHANNELS, Channel};

/// The scenario files of a directory with title and structure, or the reason why a file cannot be read.
pub(crate) fn scenarios(directory: &Path, all: &[(Result<Scenario>, PathBuf)], tell: Tell) -> String {
    let mut text = String::new();
    for (scenario, file) in all {
        let _ = match scenario {
            Ok(scenario) => writeln!(
                text,
                "{}\n    {}\n    {}",
                file.display(),
                scenario.title,
                scenario.case.structure.formula(&scenario.case.mechanism)
            ),
            Err(error) => writeln!(
                text,
                "{}\n    cannot be read: {}",
                file.display(),
                error.lines_by(tell).replace('\n', "\n    ")
            ),
        };
    }
    if all.is_empty() {
        let _ = writeln!(text, "no scenario files (*.toml) in {}", directory.display());
    }
    text
}

/// Every channel with its unit, its quantity and the stage that it is computed with.
pub(crate) fn channels() -> String {
    let mut text = String::new();
    for kind in &CHANNELS {
        let of = if kind.subject.is_whole() { "" } else { "NAME" };
        let name = Channel { of: of.into(), kind }.to_string();
        let _ = writeln!(text, "{name:40} {:8} {:26} with \"{}\"", kind.unit, kind.quantity, kind.stage.name());
    }
    text
}

/// Names of the analytic solvers, then names and versions of the engines.
pub(crate) fn solvers<'a, V: Display>(
    analytic: impl IntoIterator<Item = &'a str>,
    engines: impl IntoIterator<Item = (&'a str, V)>,
) -> String {
    let mut text = String::new();
    for name in analytic {
        let _ = writeln!(text, "{name:10} analytic");
    }
    for (name, version) in engines {
        let _ = writeln!(text, "{name:10} engine, {version}");
    }
    text
}
