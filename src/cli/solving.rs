//! The solver of a scenario: an analytic side or an engine, with its settings and the memory that it may use.

use crate::sentences;
use clap::builder::TypedValueParser;

use super::engine_args::{MemoryArgs, SettingArgs, engine_names, word};
use super::progress::Bar;
use analytic::range::explained;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::trajectory::Trajectory;
use prover::engines::EngineName;
use prover::run::{Reference, memory};
use scenario::Scenario;

/// The solver: an analytic side or an engine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum With {
    Side(Reference),
    Engine(EngineName),
}

impl With {
    pub(super) fn parser() -> impl TypedValueParser<Value = With> {
        let names = Reference::ALL.map(Reference::name).into_iter().chain(engine_names());
        word(names, |name| Reference::named(name).map(With::Side).or_else(|| EngineName::named(name).map(With::Engine)))
    }

    /// The name, as on the command line.
    pub(super) fn name(self) -> &'static str {
        match self {
            With::Side(side) => side.name(),
            With::Engine(engine) => engine.name(),
        }
    }

    /// Solves `case`, the part of the scenario's case on which the requested channels depend.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if a setting of an engine is given but the solver is an analytic side, or if the solution
    /// needs more memory than allowed. The errors of the solver.
    pub(super) fn solve(
        self,
        scenario: &Scenario,
        case: &Case,
        settings: &SettingArgs,
        allowed: MemoryArgs,
    ) -> Result<Trajectory> {
        let engine = match self {
            With::Side(_) => None,
            With::Engine(engine) => Some(settings.engine(engine, scenario)?),
        };
        let runs = engine.as_ref().map_or(1, |engine| engine.settings().extrapolated + 1);
        let needed = memory::of_solution(case, runs);
        memory::check(case, needed, Some(allowed.bytes()))?;
        allowed.tell(case, needed);
        let mut bar = Bar::new(&scenario.name);
        let mut progress = |part| bar.at(part);
        match (self, settings.given()) {
            (With::Side(side), Some(option)) => {
                let engines = EngineName::ALL.map(EngineName::name).join(", ");
                let error = Error::new(ErrorKind::Input, sentences::is_a_setting_of_an_engine(&option, &side));
                Err(error.help(sentences::leave_out_or_solve_with_one_of(&option, &engines)))
            }
            (With::Side(side), None) => {
                side.solver().solve_with(case, &mut progress).map_err(|error| explained(case, error))
            }
            (With::Engine(_), _) => engine.expect("it was made above").solve_with(case, &mut progress),
        }
    }
}
