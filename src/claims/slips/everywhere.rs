//! Slips that are made wherever a quantity or a function stands.

use super::edits;
use super::slip::{Kind, Mended, Slip};
use crate::scenario::Formulas;
use formula::{Function, Operator, Shape, Tree};

/// Every quantity and every function mended wherever it stands: in the first of the formulas `used`, then in all of
/// them. What stands at one place only is no slip of this kind.
pub(super) fn mended(formulas: &Formulas, used: &[usize], names: &[&str]) -> Vec<Mended> {
    let mut all = Vec::new();
    for scope in [&used[..1], used] {
        let trees = || scope.iter().map(|&index| &formulas.list[index].tree);
        let mut found: Vec<&str> = trees().flat_map(Tree::names).map(|(name, _)| name).collect();
        found.sort_unstable();
        let several: Vec<&str> =
            found.chunk_by(|one, other| one == other).filter(|own| own.len() > 1).map(|own| own[0]).collect();
        let mut put = |kind: Kind, written: String, right: String, change: &dyn Fn(&Tree) -> Tree| {
            let formula = formulas.list[used[0]].name.clone();
            let changed = scope.iter().map(|&index| (index, change(&formulas.list[index].tree))).collect();
            all.push(Mended {
                changed,
                slip: Slip { formula, kind, written, right, everywhere: true },
                is_sound: false,
            });
        };
        for name in several.into_iter().filter(|name| *name != "pi") {
            for (kind, right) in of_name(name, names, formulas) {
                put(kind, name.into(), right.to_string(), &|tree| tree.with_name(name, &right));
            }
        }
        for [from, to] in
            [[Function::Sin, Function::Cos], [Function::Cos, Function::Sin], [Function::Tan, Function::Sin]]
        {
            put(Kind::Function, from.name().into(), to.name().into(), &|tree| {
                with_function(tree, &|own| if own == from { to } else { own })
            });
        }
        let exchanged = |own: Function| {
            let other = [(Function::Sin, Function::Cos), (Function::Cos, Function::Sin)];
            other.into_iter().find(|(from, _)| *from == own).map_or(own, |(_, to)| to)
        };
        put(Kind::Function, "sin and cos".into(), "cos and sin".into(), &|tree| with_function(tree, &exchanged));
    }
    all.sort_by_key(|mended| (mended.changed.len(), mended.slip.kind));
    all
}

/// What may have been meant by a name wherever it stands.
fn of_name(name: &str, names: &[&str], formulas: &Formulas) -> Vec<(Kind, Tree)> {
    let own = || Tree::name(name);
    let of = |operator: Operator, right: Tree| Tree::pair(operator, own(), right);
    let over = |one: Tree, other: Tree| Tree::pair(Operator::Over, one, other);
    let pi = || Tree::name("pi");
    let quarter = || over(pi(), Tree::number(2.0));
    let mut found = edits::of_name(name, names, &formulas.parameters);
    found.push((Kind::Sign, own().negative()));
    found.push((Kind::Power, of(Operator::Power, Tree::number(2.0))));
    for turned in [quarter(), pi()] {
        found.push((Kind::Reference, of(Operator::Plus, turned.clone())));
        found.push((Kind::Reference, of(Operator::Minus, turned.clone())));
        found.push((Kind::Reference, Tree::pair(Operator::Minus, turned, own())));
    }
    for factor in [over(pi(), Tree::number(180.0)), over(Tree::number(180.0), pi()), over(pi(), Tree::number(30.0))] {
        found.push((Kind::Unit, of(Operator::Times, factor)));
    }
    found.push((Kind::Unit, of(Operator::Over, Tree::number(1e3))));
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
