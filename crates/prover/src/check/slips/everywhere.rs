//! Slips that are repeated at every occurrence of a quantity, or of a sine, cosine or tangent.

use super::edits;
use super::places::at_every_place;
use super::slip::{FormulaSlip, SlipKind, Tried};
use crate::check::dimension::Dimensions;
use crate::check::trial::Trial;
use formula::{DerivationSheet, FormulaTree, Function, NodeShape, Operator};
use scenario::Formulas;

/// Tries corrections of every quantity, and of sines, cosines and tangents. A correction is made at all occurrences at
/// once.
/// The corrections are tried first in the formula `used[0]` only, then in all formulas of `used`.
/// A quantity that occurs only once is not tried.
pub(super) fn tried(trial: &mut Trial, used: &[usize], names: &[&str], dimensions: &Dimensions, tried: &mut Tried) {
    use Function::{Cos, Sin, Tan};
    let formulas = trial.formulas.clone();
    for scope in [&used[..1], used] {
        let trees = scope.iter().map(|&index| &formulas.list[index].tree);
        let mut found: Vec<&str> = trees.flat_map(FormulaTree::names).map(|(name, _)| name).collect();
        found.sort_unstable();
        let several: Vec<&str> =
            found.chunk_by(|one, other| one == other).filter(|own| own.len() > 1).map(|own| own[0]).collect();
        let mut search = Search { trial: &mut *trial, scope, dimensions, tried: &mut *tried };
        for name in several.into_iter().filter(|name| *name != "pi") {
            if search.trial.is_spent() {
                return;
            }
            let places = search.places(&formulas, &|part| part.shape == NodeShape::Name(name.into()));
            let depending = search.depending(&places);
            for (kind, right) in of_name(name, names, &formulas) {
                if search.trial.is_spent() {
                    return;
                }
                let changes: Vec<(usize, FormulaTree)> =
                    places.iter().map(|(place, _)| (*place, right.clone())).collect();
                let change = |tree: &FormulaTree| tree.with_name(name, &right);
                search.mended(kind, [&FormulaTree::name(name), &right], &changes, &depending, &change);
            }
        }
        for swaps in [&[(Sin, Cos)][..], &[(Cos, Sin)], &[(Tan, Sin)], &[(Sin, Cos), (Cos, Sin)]] {
            let other = |own: Function| swaps.iter().find(|(from, _)| *from == own).map_or(own, |(_, other)| *other);
            let is_meant = |part: &FormulaTree| matches!(&part.shape, NodeShape::Call(own, _) if other(*own) != *own);
            let places = search.places(&formulas, &is_meant);
            if places.is_empty() {
                continue;
            }
            let depending = search.depending(&places);
            let change = |&(place, part): &(usize, &FormulaTree)| {
                let NodeShape::Call(own, _) = &part.shape else { return None };
                let argument = DerivationSheet::placeholder(search.trial.sheet.arguments(place)[0]);
                Some((place, FormulaTree::call(other(*own), vec![argument])))
            };
            let changes: Vec<(usize, FormulaTree)> = places.iter().filter_map(change).collect();
            let text = |of: &dyn Fn(&(Function, Function)) -> Function| {
                let names: Vec<&str> = swaps.iter().map(|swap| of(swap).name()).collect();
                FormulaTree::name(names.join(" and "))
            };
            let [written, right] = [text(&|swap| swap.0), text(&|swap| swap.1)];
            let change = |tree: &FormulaTree| with_function(tree, &other);
            search.mended(SlipKind::Function, [&written, &right], &changes, &depending, &change);
        }
    }
}

/// A search in several formulas.
struct Search<'a, 'b> {
    trial: &'a mut Trial<'b>,
    /// Indices of the formulas.
    scope: &'a [usize],
    dimensions: &'a Dimensions<'a>,
    tried: &'a mut Tried,
}

impl Search<'_, '_> {
    /// The subexpressions for which `is_meant` returns true, with their positions.
    fn places<'t>(
        &mut self,
        formulas: &'t Formulas,
        is_meant: &dyn Fn(&FormulaTree) -> bool,
    ) -> Vec<(usize, &'t FormulaTree)> {
        let mut found = Vec::new();
        for &index in self.scope {
            let places = self.trial.sheet.places(index).to_vec();
            let mut numbers = 0..;
            at_every_place(&formulas.list[index].tree, &mut |_, part| {
                let place = numbers.next().map(|number: usize| places[number]);
                found.extend(place.filter(|_| is_meant(part)).map(|place| (place, part)));
            });
            self.trial.sheet.operations += numbers.start as u64;
        }
        found
    }

    fn depending(&mut self, places: &[(usize, &FormulaTree)]) -> Vec<usize> {
        self.trial.sheet.depending(&places.iter().map(|(place, _)| *place).collect::<Vec<usize>>())
    }

    /// Tries a correction. `changes` lists positions in the derivation, each with its corrected subexpression. `change`
    /// makes the same correction in the tree of a formula.
    fn mended(
        &mut self,
        kind: SlipKind,
        replaced: [&FormulaTree; 2],
        changes: &[(usize, FormulaTree)],
        depending: &[usize],
        change: &dyn Fn(&FormulaTree) -> FormulaTree,
    ) {
        self.tried.count += 1;
        if self.trial.is_spent() || !self.trial.is_promising(changes, depending) {
            return;
        }
        let list = &self.trial.formulas.list;
        let changed: Vec<(usize, FormulaTree)> =
            self.scope.iter().map(|&index| (index, change(&list[index].tree))).collect();
        let [written, right] = replaced.map(|tree| tree.to_string().trim_matches('`').to_string());
        let slip = FormulaSlip {
            formula: list[self.trial.index].name.clone(),
            kind,
            written,
            right,
            everywhere: true,
            marks: Vec::new(),
        };
        self.tried.put_standing(self.trial, self.dimensions, &changed, replaced, slip);
    }
}

/// Possible corrections of a name at all its occurrences.
fn of_name(name: &str, names: &[&str], formulas: &Formulas) -> Vec<(SlipKind, FormulaTree)> {
    let own = FormulaTree::name(name);
    let of = |operator: Operator, right: FormulaTree| FormulaTree::pair(operator, own.clone(), right);
    let kinds = [SlipKind::Sign, SlipKind::Unit, SlipKind::Reference, SlipKind::Name];
    let several =
        |kind: SlipKind| edits::of(&own, kind, names, &formulas.parameters).into_iter().map(move |own| (kind, own));
    let mut found: Vec<(SlipKind, FormulaTree)> = kinds.into_iter().flat_map(several).collect();
    found.push((SlipKind::Power, of(Operator::Power, FormulaTree::number(2.0))));
    found.push((SlipKind::Factor, of(Operator::Times, FormulaTree::number(2.0))));
    found.push((SlipKind::Factor, of(Operator::Over, FormulaTree::number(2.0))));
    found
}

fn with_function(tree: &FormulaTree, other: &dyn Fn(Function) -> Function) -> FormulaTree {
    let mut changed = tree.clone();
    if let NodeShape::Call(function, _) = &mut changed.shape {
        *function = other(*function);
    }
    for part in changed.parts_mut() {
        *part = with_function(part, other);
    }
    changed
}
