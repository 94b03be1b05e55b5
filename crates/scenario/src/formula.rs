//! `[[formula]]`: derived formulas, and the channels that they claim.

use crate::sentences;
use std::collections::{BTreeMap, BTreeSet};

use super::claim::Claim;
use super::keys::key::{Section, ValueKind, needed, optional};
use super::parameters::{INPUTS, Parameter, fault_of_name};
use super::reader::{Faults, Sign, TomlTable};
use super::unit::of_input;
use super::words::suggestion;
use formula::{FormulaFault, FormulaGraph, FormulaTree, NodeId, Rounded};
use std::ops::Range;

use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Place, Result};
use linkage::math::KeepNan;

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[Section::at("formula").with(&[
    needed("name", ValueKind::Text).means("letters, digits and `_`; later formulas may use this name"),
    needed("expression", ValueKind::Text).means(
        "arithmetic of numbers, `phi`, `t`, `pi`, parameters (in SI, or by their keys as plain numbers) \
         and earlier formulas",
    ),
    optional("channel", ValueKind::Text, "none: a step of a derivation").means(
        "claimed quantity: a channel, in the unit of its name (`link.rocker.angle_deg`, `point.B.x_mm`, \
         `joint.B.f_N`), an expression of channels, a quantity reduced to the crank, a transfer function or an instant \
         centre",
    ),
    optional("source", ValueKind::Text, "none").means("source of the formula"),
    optional("from", ValueKind::INPUTS, "the whole run")
        .means("first input (crank angle or slide) for which the formula is claimed"),
    optional("to", ValueKind::INPUTS, "the whole run").means("last input for which the formula is claimed"),
    optional("error", ValueKind::Number, "none: the formula is exact")
        .means("claimed error, in the unit of the channel: for series and approximations"),
    optional("finding", ValueKind::Text, "none: the formula is right").means(
        "anchor of the section of `docs/findings.md` that says why the formula is wrong as printed; \
         such a formula must disagree",
    ),
])];

/// Name of the crank's angular velocity in the diagnosis of a formula that disagrees with its claim.
pub const OMEGA: &str = "omega_crank";

/// The formulas of a scenario. The formulas depend on the parameters, the input of the first drive and the time.
#[derive(Clone, Debug)]
pub struct Formulas {
    /// Numbers with names.
    pub parameters: Vec<Parameter>,
    /// The formulas, in the order of the file. Each formula may use the formulas before it.
    pub list: Vec<Formula>,
    /// Graph of all formulas. The named inputs of the graph are the input of the first drive (rad or m, as the scenario
    /// states it) and the time (s).
    /// Two more inputs of the graph have no names: the first and the second derivative of the first drive's input.
    pub graph: FormulaGraph,
}

/// A formula.
#[derive(Clone, Debug)]
pub struct Formula {
    /// Name of the formula. Later formulas may use it.
    pub name: String,
    /// Text of the formula.
    pub text: String,
    /// The text of the formula as a tree.
    pub tree: FormulaTree,
    /// Node of the formula in the graph.
    pub id: NodeId,
    /// Claim of the formula; `None` for a step of a derivation.
    pub claim: Option<Claim>,
    /// Source of the formula.
    pub source: Option<String>,
    /// First and last input at which the formula is claimed to hold (rad or m).
    pub valid: [Option<f64>; 2],
    /// Claimed error of the formula, in the unit of the claim; `None` for an exact formula.
    pub error: Option<f64>,
    /// Anchor of the section of `docs/findings.md` that says why the formula is wrong as printed; `None` for a right
    /// formula.
    pub finding: Option<String>,
}

impl Formula {
    /// Whether the formula is claimed to hold at an input of the first drive (rad or m).
    /// An input that exceeds an end of the range only by rounding belongs to the range.
    #[must_use]
    pub fn holds_at(&self, crank: f64) -> bool {
        let slack = 1e-9 * crank.abs().larger(1.0);
        let [from, to] = self.valid;
        from.is_none_or(|from| crank >= from - slack) && to.is_none_or(|to| crank <= to + slack)
    }
}

impl Formulas {
    /// An empty list of formulas, and the parameters that added formulas may use.
    #[must_use]
    pub fn over(parameters: Vec<Parameter>) -> Self {
        let mut graph = FormulaGraph::new(&INPUTS, 2);
        for (name, number) in parameters.iter().flat_map(Parameter::names) {
            let id = graph.constant(number);
            graph.name(name, id);
        }
        Formulas { parameters, list: Vec::new(), graph }
    }

    /// Adds a formula without a claim.
    ///
    /// # Errors
    /// The mistake, with its position in the text.
    pub fn add(&mut self, name: &str, text: &str) -> std::result::Result<&mut Formula, FormulaFault> {
        let tree = FormulaTree::parse(text)?;
        if let Some((name, at)) = tree.names().into_iter().find(|(name, _)| !self.graph.knows(name)) {
            return Err(self.unknown(name, at));
        }
        let (name, text, id) = (name.to_string(), text.to_string(), self.graph.input(0));
        let (claim, source, finding) = (None, None, None);
        self.put(Formula { name, text, tree, id, claim, source, valid: [None; 2], error: None, finding })?;
        Ok(self.list.last_mut().expect("just added"))
    }

    /// Adds a formula to the list, and its node to the graph.
    fn put(&mut self, mut formula: Formula) -> std::result::Result<(), FormulaFault> {
        formula.id = self.graph.add(&formula.tree)?;
        self.graph.name(&formula.name, formula.id);
        self.list.push(formula);
        Ok(())
    }

    /// Checks that a formula may have this name.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if the name is not allowed.
    pub fn check_name(&self, name: &str) -> Result<()> {
        if let Some((message, help)) = fault_of_name(name) {
            return Err(Error::new(ErrorKind::Input, message).help(help));
        }
        if self.graph.knows(name) {
            let message = sentences::is_a_parameter_or_a_formula(&name);
            return Err(Error::new(ErrorKind::Input, message).help(sentences::CHOOSE_ANOTHER_NAME));
        }
        Ok(())
    }

    /// The fault of an unknown name, with the nearest known name.
    fn unknown(&self, name: &str, at: Range<usize>) -> FormulaFault {
        let units = self.parameters.iter().find(|own| own.short() == Some(name));
        let help = match units {
            Some(own) => sentences::write_or(&name, &own.key),
            None => suggestion(name, self.graph.names(), "`"),
        };
        FormulaFault { message: sentences::there_is_no(&name), at, help }
    }

    /// The indices of the formulas up to and including `of`, by their names.
    fn places(&self, of: usize) -> BTreeMap<&str, usize> {
        self.list[..=of].iter().enumerate().map(|(index, own)| (own.name.as_str(), index)).collect()
    }

    /// The first operation outside its domain and the index of its formula, if the formula `of` has no value at
    /// `inputs`.
    /// The index belongs to the formula `of` or to a formula that `of` uses.
    /// `inputs` are the input of the first drive (rad or m) and the time (s).
    #[must_use]
    pub fn undefined(&self, of: usize, inputs: [Rounded; 2]) -> Option<(usize, FormulaFault)> {
        let places = self.places(of);
        let mut is_used = vec![false; of + 1];
        is_used[of] = true;
        for index in (0..=of).rev() {
            if is_used[index] {
                let names = self.list[index].tree.names();
                names.iter().filter_map(|(name, _)| places.get(name)).for_each(|&used| is_used[used] = true);
            }
        }
        let mut known: BTreeMap<&str, Rounded> = INPUTS.into_iter().zip(inputs).collect();
        known.extend(self.parameters.iter().flat_map(Parameter::names));
        known.insert("pi", Rounded::nearly(std::f64::consts::PI));
        for index in (0..=of).filter(|&index| is_used[index]) {
            let Formula { name, tree, .. } = &self.list[index];
            match tree.evaluated(&|name| known.get(name).copied().unwrap_or(Rounded::UNDEFINED)) {
                Ok(value) => known.insert(name, value),
                Err(fault) => return Some((index, fault)),
            };
        }
        None
    }

    /// Calls `then` for the formula `of` while the formulas in `changed` have the given trees. Each changed formula is
    /// given by its index.
    /// Formulas that use a changed formula change too. The trees may use [`OMEGA`].
    /// After the call, the graph is as it was before the call. Returns `None` if a name is unknown.
    pub fn with_trees<T>(
        &mut self,
        changed: &[(usize, FormulaTree)],
        of: usize,
        then: impl FnOnce(&mut FormulaGraph, NodeId) -> T,
    ) -> Option<T> {
        let first = changed.iter().map(|(index, _)| *index).min()?;
        let list = &self.list;
        self.graph.meanwhile(|graph| {
            if !graph.knows(OMEGA) {
                graph.name(OMEGA, graph.input(2));
            }
            // As in the file, a name refers only to an earlier formula, so the names are updated one formula at a time.
            let mut last = None;
            for (own, formula) in list.iter().enumerate().take(of + 1).skip(first) {
                let other = changed.iter().find(|(index, _)| *index == own).map(|(_, tree)| tree);
                let id = graph.add(other.unwrap_or(&formula.tree)).ok()?;
                graph.name(&formula.name, id);
                last = Some(id);
            }
            last.map(|id| then(graph, id))
        })
    }

    /// The formulas that a search for a mistake in the formula `of` needs, and the index of `of` among these formulas.
    /// The needed formulas are `of`, the last formulas before `of` (at most `beside`), and all formulas that these use.
    /// All other formulas of the file are left out, so the length of the file does not matter.
    /// Of the parameters that no needed formula uses, at most `beside` are kept.
    #[must_use]
    pub fn derivation(&self, of: usize, beside: usize) -> (Formulas, usize) {
        let places = self.places(of);
        let mut kept: BTreeSet<usize> = (of.saturating_sub(beside)..=of).collect();
        let mut used: BTreeSet<&str> = BTreeSet::new();
        let mut next: Vec<usize> = kept.iter().copied().collect();
        while let Some(index) = next.pop() {
            for (name, _) in self.list[index].tree.names() {
                used.insert(name);
                if let Some(&step) = places.get(name).filter(|step| **step < index)
                    && kept.insert(step)
                {
                    next.push(step);
                }
            }
        }
        let mut free = beside;
        let is_kept = |own: &&Parameter| {
            let is_used = own.names().any(|(name, _)| used.contains(name));
            free -= usize::from(!is_used && free > 0);
            is_used || free > 0
        };
        let mut formulas = Formulas::over(self.parameters.iter().filter(is_kept).cloned().collect());
        for index in &kept {
            formulas.put(self.list[*index].clone()).expect("a formula knows what stands before it");
        }
        (formulas, kept.len() - 1)
    }

    /// These formulas, with `tree` in place of the tree of the formula `of`. Formulas that use `of` change too.
    /// `tree` may use [`OMEGA`]. `None` if `tree` uses an unknown name.
    #[must_use]
    pub fn with_tree(&self, of: usize, tree: FormulaTree) -> Option<Formulas> {
        let mut formulas = Formulas::over(self.parameters.clone());
        if !formulas.graph.knows(OMEGA) {
            let omega = formulas.graph.input(2);
            formulas.graph.name(OMEGA, omega);
        }
        for (index, formula) in self.list.iter().enumerate() {
            let mut own = formula.clone();
            if index == of {
                (own.text, own.tree) = (tree.to_string(), tree.clone());
            }
            formulas.put(own).ok()?;
        }
        Some(formulas)
    }

    /// A node's rate of change with time, in the graph.
    pub fn rate(&mut self, of: NodeId) -> NodeId {
        let one = self.graph.constant(Rounded::exact(1.0));
        let [omega, alpha] = [2, 3].map(|input| self.graph.input(input));
        self.graph.rate(of, &[Some(omega), Some(one), Some(alpha)])
    }

    /// The formulas that claim something.
    pub fn claims(&self) -> impl Iterator<Item = (&Formula, &Claim)> {
        self.list.iter().filter_map(|formula| Some((formula, formula.claim.as_ref()?)))
    }
}

/// Checks the range `valid` (rad or m) and the claimed error `error` of a formula.
/// Returns the key of a wrong value (`to` or `error`), with message and help.
#[must_use]
pub fn fault_of_claim(
    valid: [Option<f64>; 2],
    error: Option<f64>,
) -> Option<(&'static str, &'static str, &'static str)> {
    if let [Some(from), Some(to)] = valid
        && !(from <= to)
    {
        return Some(("to", sentences::THE_LAST_CRANK_ANGLE_IS_LESS, "exchange them"));
    }
    let is_wrong = error.is_some_and(|error| !(error > 0.0) || !error.is_finite());
    is_wrong.then_some(("error", sentences::A_CLAIMED_ERROR_MUST_BE_A_POSITIVE, sentences::LEAVE_IT_OUT_IF_THE_FORMULA))
}

/// An error in a text that does not come from a file, such as an argument; `what` names the text.
pub fn refused(what: &str, text: &str, fault: &FormulaFault) -> Error {
    let place = Place { file: what.into(), text: text.into(), span: fault.at.clone() };
    Error::new(ErrorKind::Input, fault.message.clone()).at(place).help(fault.help.clone())
}

/// Reads the formulas of a scenario. Formulas with mistakes are left out.
pub(super) fn read(parameters: Vec<Parameter>, tables: Vec<TomlTable>, case: &Case, faults: &mut Faults) -> Formulas {
    let mut formulas = Formulas::over(parameters);
    for mut table in tables {
        let read = faults.read(&mut table, |table| formula(table, &mut formulas, case));
        // A later formula of the file may name a formula that was left out because of a mistake.
        // After such a mistake, errors that may follow from it are therefore not reported (see `Faults::whole`).
        faults.whole &= read.is_some();
    }
    formulas
}

/// Adds one formula.
fn formula(table: &mut TomlTable, formulas: &mut Formulas, case: &Case) -> Result<()> {
    let name = table.string("name")?;
    formulas.check_name(&name).map_err(|error| {
        let wrong = table.wrong(ErrorKind::Input, "name", error.message());
        error.advice().iter().cloned().fold(wrong, Error::or_help)
    })?;
    let text = table.string("expression")?;
    let claimed = table.optional_string("channel")?;
    let source = table.optional_string("source")?;
    let family = of_input(case.crank().input);
    let valid = ["from", "to"].map(|key| table.optional_quantity(key, family, Sign::Any));
    let [from, to] = valid;
    let valid = [from?, to?];
    let error = table.optional_number("error")?;
    let finding = table.optional_string("finding")?;
    if let Some((key, message, help)) = fault_of_claim(valid, error) {
        return table.refuse(key, message, help);
    }
    if claimed.is_none() {
        let spellings = ["from", "to"]
            .into_iter()
            .flat_map(|key| family.all_keys(key))
            .chain(["error", "finding"].map(String::from));
        if let Some(key) = spellings.into_iter().find(|key: &String| table.has(key)) {
            let message = sentences::belongs_to_a_claim_and_this_formula(&key);
            return table.refuse(&key, message, sentences::ADD_CHANNEL_OR_TAKE_IT_OUT);
        }
    }
    let claim = claimed.map(|claimed| Claim::with_parameters(&claimed, case, &formulas.parameters));
    let formula = formulas.add(&name, &text).map_err(|fault| table.fault_in("expression", &fault))?;
    formula.claim = claim.transpose().map_err(|fault| table.fault_in("channel", &fault))?;
    (formula.source, formula.valid, formula.error, formula.finding) = (source, valid, error, finding);
    table.finish()
}
