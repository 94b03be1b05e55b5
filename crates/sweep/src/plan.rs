//! The plan of a sweep, the solver of its cases, and the result of a case.

use std::path::{Path, PathBuf};

use linkage::error::{Error, ErrorKind, Result};
use prover::run::{Options, prove};
use scenario::{CaseFigure, FigureGrid, FigureKind, Scenario, ScenarioFamily, StartRequest, unit};
use serde::{Deserialize, Serialize};

use crate::axis::SweepAxis;
use crate::design::{DesignKind, SweepDesign};
use crate::fast::FastCases;
use crate::figure;
use crate::sentences;

/// Everything that determines the table of a sweep.
#[derive(Clone, Debug)]
pub struct SweepPlan {
    /// Text of the scenario.
    pub text: String,
    /// Path of the scenario, for messages and for the tables that the scenario names.
    /// The path is not stored, because it may differ between machines.
    pub path: PathBuf,
    /// Values of keys in all cases. These values replace the values in the file.
    pub set: Vec<(String, f64)>,
    /// The values of the varied numbers in each case.
    pub design: SweepDesign,
    /// The figures of every case.
    pub figures: Vec<CaseFigure>,
    /// Cases whose index is a multiple of this number are proven, also by the physics engines; `None` for no proof.
    pub prove_every: Option<u64>,
    /// Number of cases that are stored together.
    pub part: u64,
    /// Unit of each figure.
    pub units: Vec<String>,
}

/// Result of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseResult {
    /// Reason why the case could not be solved; all figures are then NaN. `None` for a solved case.
    pub refusal: Option<String>,
    /// Verdict of the proof, or the message of the error that ended the proof; `None` for a case that is not proven.
    pub verdict: Option<String>,
}

/// The stored form of a plan. Two sweeps are the same if their stored plans are equal.
#[derive(Serialize, Deserialize, PartialEq)]
struct Stored {
    format: u32,
    program: String,
    scenario: String,
    set: Vec<(String, f64)>,
    design: DesignKind,
    axes: Vec<SweepAxis>,
    figures: Vec<String>,
    units: Vec<String>,
    prove_every: Option<u64>,
    cases: u64,
    part: u64,
}

/// Version of the stored plan and of the table.
pub const FORMAT: u32 = 1;

impl SweepPlan {
    /// The plan of a sweep over the scenario at `path`.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if there is no figure, for an unknown figure, for a figure given twice, and for a key that
    /// the file does not have. The errors of [`Scenario::parse_as`].
    pub fn of(
        (text, path): (String, &Path),
        set: Vec<(String, f64)>,
        design: SweepDesign,
        figures: &[String],
        prove_every: Option<u64>,
        part: Option<u64>,
    ) -> Result<SweepPlan> {
        let scenario = member(&design, |values| {
            let set = set.iter().cloned().chain(values).collect();
            Scenario::parse_as(&text, path, &StartRequest { set, ..StartRequest::default() })
        })?;
        if figures.is_empty() {
            return Err(Error::new(ErrorKind::Input, sentences::NO_FIGURE_IS_WANTED).help(CaseFigure::HELP));
        }
        let figures = figures
            .iter()
            .map(|text| CaseFigure::parse(text, &scenario.case, &scenario.formulas))
            .collect::<Result<Vec<_>>>()?;
        let varies_grid = design.axes().iter().any(|axis| axis.key.starts_with("grid."));
        let case = &scenario.case;
        if !case.is_free() && !varies_grid {
            // An instant that the grid does not have is reported here, and not for every case.
            let grid = FigureGrid::of(&case.grid.times, case.crank().input, &case.grid.inputs);
            let zeros = vec![0.0; case.grid.len()];
            let turn = |own: &CaseFigure| if let FigureKind::Turn(own) = &own.kind { Some(own.clone()) } else { None };
            figures.iter().filter_map(turn).try_for_each(|own| own.on(&grid, &zeros).map(|_| ()))?;
        }
        let units = figures.iter().map(|figure| figure.unit(&scenario.case, &scenario.formulas)).collect();
        let mut names: Vec<&str> = figures.iter().map(|figure| figure.text.as_str()).collect();
        names.extend(design.axes().iter().map(|axis| axis.key.as_str()));
        names.sort_unstable();
        if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            let error = Error::new(ErrorKind::Input, sentences::is_wanted_twice(&twice[0]));
            return Err(error.help(sentences::NAME_EVERY_COLUMN_ONCE));
        }
        let cases = design.cases();
        let part = part.unwrap_or_else(|| usual_part(cases)).max(1);
        let plan = SweepPlan { text, path: path.into(), set, design, figures, prove_every, part, units };
        let keys: Vec<&str> = plan.design.axes().iter().map(|axis| axis.key.as_str()).collect();
        plan.family()?.check_keys(&keys, &scenario)?;
        Ok(plan)
    }

    /// Number of parts.
    #[must_use]
    pub fn parts(&self) -> u64 {
        self.design.cases().div_ceil(self.part)
    }

    /// Cases of a part.
    #[must_use]
    pub fn cases_of(&self, part: u64) -> std::ops::Range<u64> {
        part * self.part..((part + 1) * self.part).min(self.design.cases())
    }

    /// The stored form of the plan, as JSON.
    #[must_use]
    pub fn stored(&self) -> String {
        let stored = Stored {
            format: FORMAT,
            program: format!("linkproof {}", env!("CARGO_PKG_VERSION")),
            scenario: self.text.clone(),
            set: self.set.clone(),
            design: self.design.kind(),
            axes: self.design.axes().to_vec(),
            figures: self.figures.iter().map(|figure| figure.text.clone()).collect(),
            units: self.units.clone(),
            prove_every: self.prove_every,
            cases: self.design.cases(),
            part: self.part,
        };
        serde_json::to_string_pretty(&stored).expect("texts and numbers") + "\n"
    }

    /// Reads the stored form of a plan. The path of the scenario is empty.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if the text is not a plan that this version has stored.
    pub fn of_stored(text: &str) -> Result<SweepPlan> {
        let wrong = |error: &dyn std::fmt::Display| {
            Error::new(ErrorKind::Input, sentences::no_plan(error)).help(sentences::RUN_THE_SWEEP_WITH_THIS_VERSION)
        };
        let stored: Stored = serde_json::from_str(text).map_err(|error| wrong(&error))?;
        let figures = stored.figures.iter().map(|text| CaseFigure::unchecked(text)).collect::<Result<_>>()?;
        let plan = SweepPlan {
            text: stored.scenario,
            path: PathBuf::new(),
            set: stored.set,
            design: SweepDesign::of(stored.design, stored.axes)?,
            figures,
            prove_every: stored.prove_every,
            part: stored.part.max(1),
            units: stored.units,
        };
        if plan.stored() == text { Ok(plan) } else { Err(wrong(&sentences::IT_IS_OF_ANOTHER_VERSION)) }
    }

    /// Gives the scenario of any case.
    ///
    /// # Errors
    /// The errors of [`ScenarioFamily::of`].
    pub fn family(&self) -> Result<ScenarioFamily<'_>> {
        let asked = StartRequest { set: self.set.clone(), ..StartRequest::default() };
        // A proof also judges the formulas of the file.
        let is_judged = self.prove_every.is_some() || self.figures.iter().any(CaseFigure::is_of_formulas);
        ScenarioFamily::of(&self.text, &self.path, asked, is_judged)
    }

    /// Names and units of the varied numbers and of the figures, in the order of the table's columns.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &str)> {
        let unit = |axis: &SweepAxis| unit::ending(&axis.key).map_or("", |(_, unit)| unit.suffix);
        let axes = self.design.axes().iter().map(move |axis| (axis.key.as_str(), unit(axis)));
        let figures = self.figures.iter().map(|figure| figure.text.as_str());
        axes.chain(figures.zip(self.units.iter().map(String::as_str)))
    }

    /// The keys and values of case `index`, including those that are the same in all cases.
    #[must_use]
    pub fn setting_of(&self, index: u64) -> Vec<(String, f64)> {
        self.set.iter().cloned().chain(self.design.setting_of(index)).collect()
    }

    /// A solver for the cases of this plan.
    ///
    /// # Errors
    /// The errors of [`SweepPlan::family`].
    pub fn solver(&self) -> Result<CaseSolver<'_>> {
        let family = self.family()?;
        let member = member(&self.design, |values| family.member(&values)).ok();
        let fast = member.and_then(|member| FastCases::of(self.design.axes(), &self.figures, &family, &member));
        Ok(CaseSolver { plan: self, family, fast })
    }
}

/// Solves the cases of a plan.
pub struct CaseSolver<'a> {
    plan: &'a SweepPlan,
    family: ScenarioFamily<'a>,
    /// Solver of batches; `None` if the plan does not allow batches.
    fast: Option<FastCases>,
}

impl CaseSolver<'_> {
    /// This solver without batches, so that every case is read and solved alone.
    #[must_use]
    pub fn one_by_one(self) -> Self {
        CaseSolver { fast: None, ..self }
    }

    /// Whether cases are solved in batches. A case that a batch cannot solve is still read and solved alone.
    #[must_use]
    pub fn is_fast(&self) -> bool {
        self.fast.is_some()
    }

    /// Solves case `index`, and writes its varied numbers to `values` and its figures to `figures`.
    /// A figure that does not exist is NaN.
    pub fn solve(&mut self, index: u64, values: &mut [f64], figures: &mut [f64]) -> CaseResult {
        let plan = self.plan;
        plan.design.values(index, values);
        let is_proven = plan.prove_every.is_some_and(|every| index.is_multiple_of(every));
        if !is_proven && self.fast.as_mut().is_some_and(|fast| fast.solve(values, figures)) {
            return CaseResult { refusal: None, verdict: None };
        }
        figures.fill(f64::NAN);
        let scenario = match self.family.member(&plan.design.setting(values)) {
            Ok(scenario) => scenario,
            Err(error) => return CaseResult { refusal: Some(one_line(error.message())), verdict: None },
        };
        let refusal = figure::all(&plan.figures, &scenario, figures).err().map(|error| one_line(error.message()));
        if refusal.is_some() {
            figures.fill(f64::NAN);
        }
        let proof = (refusal.is_none() && is_proven).then(|| prove(&scenario, &Options::default()));
        let verdict = proof.map(|proof| match proof {
            Ok(proof) => proof.verdict.word().to_string(),
            Err(error) => one_line(error.message()),
        });
        CaseResult { refusal, verdict }
    }
}

/// Usual number of cases of a part. There are enough parts for many threads, and few enough for one directory and for
/// the list of row groups at the end of the table. A part fits into memory, and a stop loses only a part per thread.
fn usual_part(cases: u64) -> u64 {
    (cases / 64).clamp(64, (cases / 10_000).clamp(20_000, 1_000_000))
}

/// Largest number of cases that are tried if the numbers of the file are refused.
const TRIED: u64 = 1000;

/// A scenario of a sweep. The scenario has the numbers of the file.
/// If these are refused, it has the numbers of the first case that is not.
fn member(design: &SweepDesign, scenario: impl Fn(Vec<(String, f64)>) -> Result<Scenario>) -> Result<Scenario> {
    scenario(Vec::new()).or_else(|error| {
        let mut cases = (0..design.cases().min(TRIED)).map(|case| scenario(design.setting_of(case)));
        cases.find_map(Result::ok).ok_or(error)
    })
}

/// A message on one line.
pub(crate) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::usual_part;

    #[test]
    fn parts_grow_with_the_number_of_cases_but_stay_small_enough() {
        let parts = [10, 1_000_000, 100_000_000, 1_000_000_000, 1 << 45].map(usual_part);
        assert_eq!(parts, [64, 15_625, 20_000, 100_000, 1_000_000]);
    }
}
