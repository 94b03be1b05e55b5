//! Slips that are made wherever a quantity or a function stands.

use super::edits;
use super::places::at_every_place;
use super::slip::{Kind, Mended, Slip, Tried};
use crate::claims::dimension::Dimensions;
use crate::claims::trial::Trial;
use formula::{Function, Operator, Shape, Tree};
use scenario::Formulas;

/// Tries every quantity and every function mended wherever it stands: in the first of the formulas `used`, then in all
/// of them. What stands at one place only is no slip of this kind.
pub(super) fn tried(trial: &mut Trial, used: &[usize], names: &[&str], dimensions: &Dimensions, tried: &mut Tried) {
    use Function::{Cos, Sin, Tan};
    let formulas = trial.formulas.clone();
    for scope in [&used[..1], used] {
        let trees = || scope.iter().map(|&index| &formulas.list[index].tree);
        let mut found: Vec<&str> = trees().flat_map(Tree::names).map(|(name, _)| name).collect();
        found.sort_unstable();
        let several: Vec<&str> =
            found.chunk_by(|one, other| one == other).filter(|own| own.len() > 1).map(|own| own[0]).collect();
        for name in several.into_iter().filter(|name| *name != "pi") {
            if trial.is_spent() {
                return;
            }
            let places = places(trial, &formulas, scope, &|part| part.shape == Shape::Name(name.into()));
            let depending = trial.sheet.depending(&places);
            for (kind, right) in of_name(name, names, &formulas) {
                if trial.is_spent() {
                    return;
                }
                tried.count += 1;
                let changes: Vec<(usize, Tree)> = places.iter().map(|place| (*place, right.clone())).collect();
                if !trial.is_promising(&changes, &depending) {
                    continue;
                }
                let change = |tree: &Tree| tree.with_name(name, &right);
                let written = Tree::name(name);
                put(trial, scope, kind, [&written, &right], &change, dimensions, tried);
            }
        }
        for swaps in [&[(Sin, Cos)][..], &[(Cos, Sin)], &[(Tan, Sin)], &[(Sin, Cos), (Cos, Sin)]] {
            let other = |own: Function| swaps.iter().find(|(from, _)| *from == own).map_or(own, |(_, other)| *other);
            let is_meant = |part: &Tree| matches!(&part.shape, Shape::Call(own, _) if other(*own) != *own);
            let places = places(trial, &formulas, scope, &is_meant);
            if places.is_empty() {
                continue;
            }
            let depending = trial.sheet.depending(&places);
            let all: Vec<usize> = scope.iter().flat_map(|&index| trial.sheet.places(index).to_vec()).collect();
            let functions: Vec<Function> = trees().flat_map(|tree| functions(tree, &is_meant)).collect();
            let ordered = all.iter().filter(|place| places.contains(place));
            let change = |(place, own): (&usize, &Function)| {
                let argument = formula::Sheet::placeholder(trial.sheet.arguments(*place)[0]);
                (*place, Tree::call(other(*own), vec![argument]))
            };
            let changes: Vec<(usize, Tree)> = ordered.zip(&functions).map(change).collect();
            tried.count += 1;
            if trial.is_spent() || !trial.is_promising(&changes, &depending) {
                continue;
            }
            let text = |of: &dyn Fn(&(Function, Function)) -> Function| {
                let names: Vec<&str> = swaps.iter().map(|swap| of(swap).name()).collect();
                Tree::name(names.join(" and "))
            };
            let [written, right] = [text(&|swap| swap.0), text(&|swap| swap.1)];
            let change = |tree: &Tree| with_function(tree, &other);
            put(trial, scope, Kind::Function, [&written, &right], &change, dimensions, tried);
        }
    }
}

fn put(
    trial: &mut Trial,
    scope: &[usize],
    kind: Kind,
    [written, right]: [&Tree; 2],
    change: &dyn Fn(&Tree) -> Tree,
    dimensions: &Dimensions,
    tried: &mut Tried,
) {
    let changed: Vec<(usize, Tree)> =
        scope.iter().map(|&index| (index, change(&trial.formulas.list[index].tree))).collect();
    let standing = dimensions.standing(&changed, trial.index, [written, right]);
    trial.sheet.count(dimensions.work());
    let Some(is_sound) = standing else { return };
    let formula = trial.formulas.list[trial.index].name.clone();
    let text = |tree: &Tree| tree.to_string().trim_matches('`').to_string();
    let slip = Slip { formula, kind, written: text(written), right: text(right), everywhere: true };
    let rank = (!is_sound, true, scope.len() > 1, kind);
    tried.put(trial, Mended { changed, slip, rank, left: f64::INFINITY, among: 0 });
}

/// Places of the parts of some formulas that are meant.
fn places(trial: &mut Trial, formulas: &Formulas, scope: &[usize], is_meant: &dyn Fn(&Tree) -> bool) -> Vec<usize> {
    let mut found = Vec::new();
    for &index in scope {
        let mut number = 0;
        at_every_place(&formulas.list[index].tree, &mut |_, part| {
            if is_meant(part) {
                found.push(trial.sheet.places(index)[number]);
            }
            number += 1;
        });
        trial.sheet.count(number as u64);
    }
    found
}

/// The functions of a tree that are meant, in the order of its places.
fn functions(tree: &Tree, is_meant: &dyn Fn(&Tree) -> bool) -> Vec<Function> {
    let mut found = Vec::new();
    at_every_place(tree, &mut |_, part| {
        if let Shape::Call(function, _) = &part.shape
            && is_meant(part)
        {
            found.push(*function);
        }
    });
    found
}

/// What may have been meant by a name wherever it stands.
fn of_name(name: &str, names: &[&str], formulas: &Formulas) -> Vec<(Kind, Tree)> {
    let own = Tree::name(name);
    let of = |operator: Operator, right: Tree| Tree::pair(operator, own.clone(), right);
    let kinds = [Kind::Sign, Kind::Unit, Kind::Reference, Kind::Name];
    let several =
        |kind: Kind| edits::of(&own, kind, names, &formulas.parameters).into_iter().map(move |own| (kind, own));
    let mut found: Vec<(Kind, Tree)> = kinds.into_iter().flat_map(several).collect();
    found.push((Kind::Power, of(Operator::Power, Tree::number(2.0))));
    found.push((Kind::Factor, of(Operator::Times, Tree::number(2.0))));
    found.push((Kind::Factor, of(Operator::Over, Tree::number(2.0))));
    found
}

fn with_function(tree: &Tree, other: &dyn Fn(Function) -> Function) -> Tree {
    let mut changed = tree.clone();
    if let Shape::Call(function, _) = &mut changed.shape {
        *function = other(*function);
    }
    for part in changed.parts_mut() {
        *part = with_function(part, other);
    }
    changed
}
