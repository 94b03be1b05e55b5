//! Solvers and engines with one fault.

use super::kinds::{FaultInstant, FaultKind, Plant};
use crate::sentences;
use linkage::case::Case;
use linkage::engine::{Hook, Wrapped};
use linkage::error::{Error, ErrorKind, Result};
use linkage::solver::State;

/// A solver, or an engine, with a fault.
pub(super) type Planted<S> = Wrapped<Fault, S>;

/// A kind of fault with its size.
#[derive(Clone, Copy)]
pub(super) struct Fault {
    pub(super) kind: &'static FaultKind,
    pub(super) size: f64,
}

impl Hook for Fault {
    fn case(&self, case: &Case) -> Result<Option<Case>> {
        match self.kind.plant {
            Plant::Case(change) => {
                let message = || sentences::the_case_with_the_fault_cannot(&self.kind.name);
                change(case, self.size).map(Some).ok_or_else(|| Error::new(ErrorKind::Geometry, message()))
            }
            Plant::Answer(_) | Plant::Formula(_) => Ok(None),
        }
    }

    fn answer(&self, case: &Case, row: usize, state: &mut State) {
        match self.kind.plant {
            Plant::Case(_) | Plant::Formula(_) => {}
            Plant::Answer(change) => {
                // If the state has no part that the fault affects, the state stays unchanged.
                let _ = change(FaultInstant { case, row }, state, self.size);
            }
        }
    }
}
