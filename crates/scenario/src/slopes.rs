//! Derivatives of all numbers of a case by the keys of its file.
//!
//! A key is a parameter (`a_mm`), or the path of another number of the file (see `numbers.rs`).
//! Expressions are differentiated symbolically, and units are factors, so the derivatives are exact.
//! This module reads the file independently of the readers of the sections. Tests compare every number with the same
//! number of the case. They also change each key in the file, and compare the change of every number with the
//! derivative.

mod drives;
mod file;
mod found;
mod loads;
mod slope;

use self::file::SlopeFile;
pub use self::found::{CaseKey, CaseSlopes, KeySort};
pub use self::slope::Slope;
use super::Scenario;
use super::asked::StartRequest;
use super::source::Source;
use linkage::error::Result;

impl CaseSlopes {
    /// The derivatives of the numbers of a scenario. `asked` is the start with which the scenario was read from its
    /// file.
    ///
    /// # Errors
    /// The errors of [`Scenario::parse_as`], if `scenario.text` was changed after the scenario was read.
    pub fn of(scenario: &Scenario, asked: &StartRequest) -> Result<CaseSlopes> {
        let source = Source::new(&scenario.path, &scenario.text);
        let tree = source.tree()?;
        Ok(SlopeFile::read(&scenario.case, tree.get_ref(), asked, &scenario.formulas.parameters).finish())
    }
}

#[cfg(test)]
mod tests;
