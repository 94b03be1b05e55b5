//! Why a formula is wrong: the one slip that makes it right.
//!
//! Every slip is tried at every place of the formula, and of the steps that it uses; what then holds at every instant
//! explains it. Nothing is guessed from the shape of the error.

use crate::scenario::Formulas;
use formula::{Function, Operator, Shape, Tree};

/// A slip of the pen.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip {
    /// The formula that it is in.
    pub formula: String,
    /// What kind it is.
    pub kind: Kind,
    /// What is written, and what would be right.
    pub written: String,
    /// See `written`.
    pub right: String,
}

/// Kinds of slips, the simplest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A sign.
    Sign,
    /// Another branch of a square root or of an inverse function.
    Branch,
    /// Sine for cosine, and the like.
    Function,
    /// A square, a root, or their absence.
    Power,
    /// A derivative by the crank angle for one by time.
    PerRadian,
    /// Another of the names.
    Name,
    /// Two names exchanged.
    Exchanged,
    /// A term too many.
    Term,
    /// Degrees for radians, and the like.
    Unit,
    /// A reference angle that is a quarter or half a turn off.
    Reference,
    /// A factor or divisor that is a small number.
    Factor,
    /// A product for a quotient.
    Operator,
    /// A factor or a term too many or too few, which is one of the names.
    Missing,
}

impl Kind {
    /// The kind in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Kind::Sign => "a sign",
            Kind::Branch => "another branch",
            Kind::Function => "another function",
            Kind::Power => "a power",
            Kind::Factor => "a factor",
            Kind::Unit => "a unit",
            Kind::Reference => "another reference angle",
            Kind::Name => "another quantity",
            Kind::Term => "a term too many",
            Kind::Exchanged => "two quantities exchanged",
            Kind::Operator => "a product for a quotient",
            Kind::Missing => "a quantity missing or too many",
            Kind::PerRadian => "per radian of the crank in place of per second",
        }
    }
}

/// Most slips that are tried, so that a formula of many pages has an answer too.
const MOST: usize = 30_000;

/// One slip mended: the index of the formula that it is in, the formula as it would be right, and the slip in words.
pub(super) struct Mended {
    pub(super) index: usize,
    pub(super) tree: Tree,
    pub(super) slip: Slip,
}

/// Every formula with one slip mended, in a formula or in a step that it uses; the simplest slips come first.
pub(super) fn mended(formulas: &Formulas, formula: usize) -> impl Iterator<Item = Mended> {
    let names = quantities(formulas, formula);
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut edits = Vec::new();
    for index in used_by(formulas, formula) {
        at_every_place(&formulas.list[index].tree, &mut |place, part| {
            let of = edits_of(part, &known).into_iter();
            edits.extend(of.map(|(kind, right)| (kind, index, place.to_vec(), part, right)));
        });
    }
    // A slip in the formula itself is simpler than one in a step that it uses.
    edits.sort_by_key(|(kind, index, ..)| (*index != formula, *kind));
    edits.into_iter().take(MOST).map(|(kind, index, place, part, right)| {
        let own = &formulas.list[index];
        let slip = Slip { formula: own.name.clone(), kind, written: part.to_string(), right: right.to_string() };
        let mut tree = own.tree.clone();
        *part_at(&mut tree, &place) = right;
        Mended { index, tree, slip }
    })
}

/// Names of parameters (in SI), and of the steps before a formula: they stand for quantities.
fn quantities(formulas: &Formulas, formula: usize) -> Vec<String> {
    let short = |own: &crate::scenario::Parameter| own.short().unwrap_or(&own.key).to_string();
    let steps = formulas.list[..formula].iter().map(|step| step.name.clone());
    formulas.parameters.iter().map(short).chain(steps).collect()
}

/// Indices of a formula and of those that it uses, itself first.
fn used_by(formulas: &Formulas, formula: usize) -> Vec<usize> {
    let index_of = |name: &str| formulas.list.iter().position(|own| own.name == name);
    let mut found = vec![formula];
    let mut next = 0;
    while next < found.len() {
        for (name, _) in formulas.list[found[next]].tree.names() {
            if let Some(index) = index_of(name).filter(|index| !found.contains(index)) {
                found.push(index);
            }
        }
        next += 1;
    }
    found
}

fn at_every_place<'a>(tree: &'a Tree, visit: &mut dyn FnMut(&[usize], &'a Tree)) {
    fn go<'a>(tree: &'a Tree, place: &mut Vec<usize>, visit: &mut dyn FnMut(&[usize], &'a Tree)) {
        visit(place, tree);
        for (index, part) in tree.parts().iter().enumerate() {
            place.push(index);
            go(part, place, visit);
            place.pop();
        }
    }
    go(tree, &mut Vec::new(), visit);
}

fn part_at<'a>(tree: &'a mut Tree, place: &[usize]) -> &'a mut Tree {
    place.iter().fold(tree, |tree, &index| &mut tree.parts_mut()[index])
}

fn whole(shape: Shape) -> Tree {
    Tree { shape, at: 0..0 }
}

fn number(value: f64) -> Tree {
    whole(Shape::Number(value))
}

fn name(name: &str) -> Tree {
    whole(Shape::Name(name.into()))
}

fn pair(operator: Operator, left: Tree, right: Tree) -> Tree {
    whole(Shape::Pair(operator, Box::new([left, right])))
}

fn negative(part: &Tree) -> Tree {
    match &part.shape {
        Shape::Negative(inner) => (**inner).clone(),
        Shape::Number(_) | Shape::Name(_) | Shape::Pair(..) | Shape::Call(..) => {
            whole(Shape::Negative(Box::new(part.clone())))
        }
    }
}

/// A sum, difference or quotient of two quantities with these exchanged, wherever they stand in it.
fn exchanged(part: &Tree, names: &[&str]) -> Vec<Tree> {
    let Shape::Pair(Operator::Plus | Operator::Minus | Operator::Over | Operator::Times, _) = part.shape else {
        return Vec::new();
    };
    let mut own: Vec<&str> = part.names().into_iter().map(|(name, _)| name).filter(|own| names.contains(own)).collect();
    own.sort_unstable();
    own.dedup();
    let pairs = (0..own.len()).flat_map(|first| (first + 1..own.len()).map(move |second| (first, second)));
    pairs.map(|(first, second)| with_exchanged(part, [own[first], own[second]])).collect()
}

fn with_exchanged(part: &Tree, [one, other]: [&str; 2]) -> Tree {
    let mut changed = part.clone();
    if let Shape::Name(own) = &mut changed.shape {
        if own == one {
            *own = other.into();
        } else if own == other {
            *own = one.into();
        }
    }
    for inner in changed.parts_mut() {
        *inner = with_exchanged(inner, [one, other]);
    }
    changed
}

/// What may have been meant by a part.
fn edits_of(part: &Tree, names: &[&str]) -> Vec<(Kind, Tree)> {
    use Operator::{Minus, Over, Plus, Power, Times};
    let mut edits = Vec::new();
    match &part.shape {
        Shape::Pair(operator, parts) => {
            let [left, right] = [&parts[0], &parts[1]].map(Tree::clone);
            if matches!(operator, Plus | Minus) {
                edits.push((Kind::Term, left.clone()));
                edits.push((Kind::Term, if *operator == Minus { negative(&right) } else { right.clone() }));
            }
            match operator {
                Plus => edits.push((Kind::Sign, pair(Minus, left, right))),
                Minus => {
                    edits.push((Kind::Sign, pair(Plus, left.clone(), right.clone())));
                    edits.push((Kind::Sign, pair(Minus, right, left)));
                }
                Times => edits.push((Kind::Operator, pair(Over, left, right))),
                Over => {
                    edits.push((Kind::Operator, pair(Times, left.clone(), right.clone())));
                    edits.push((Kind::Operator, pair(Over, right, left)));
                }
                Power => {
                    edits.push((Kind::Power, left.clone()));
                    for exponent in [2.0, 3.0, 4.0, 0.5] {
                        edits.push((Kind::Power, pair(Power, left.clone(), number(exponent))));
                    }
                }
            }
        }
        Shape::Call(function, parts) => edits.extend(of_call(*function, parts)),
        Shape::Name(own) => {
            for other in names.iter().filter(|other| *other != own) {
                edits.push((Kind::Name, name(other)));
            }
        }
        Shape::Number(value) if [1e3, 1e6, 1e-3, 1e-6].contains(value) => edits.push((Kind::Unit, number(1.0))),
        Shape::Number(value) if [90.0, 180.0, 270.0, 360.0].contains(value) => {
            edits.push((Kind::Unit, pair(Times, part.clone(), pair(Over, name("pi"), number(180.0)))));
        }
        Shape::Number(value) => {
            for other in [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0].into_iter().filter(|other| other != value) {
                edits.push((Kind::Factor, number(other)));
            }
        }
        Shape::Negative(_) => {}
    }
    edits.push((Kind::Sign, negative(part)));
    edits.extend(exchanged(part, names).into_iter().map(|right| (Kind::Exchanged, right)));
    let of = |operator: Operator, right: Tree| pair(operator, part.clone(), right);
    let is_constant = matches!(&part.shape, Shape::Number(_)) || part.shape == Shape::Name("pi".into());
    if !is_constant {
        edits.push((Kind::Power, of(Power, number(2.0))));
        edits.push((Kind::Power, of(Power, number(3.0))));
        edits.push((Kind::Power, whole(Shape::Call(Function::Sqrt, vec![part.clone()]))));
        for factor in [2.0, 3.0, 4.0] {
            edits.push((Kind::Factor, of(Times, number(factor))));
            edits.push((Kind::Factor, of(Over, number(factor))));
        }
        let to_degrees = pair(Over, number(180.0), name("pi"));
        edits.push((Kind::Unit, of(Times, to_degrees.clone())));
        edits.push((Kind::Unit, of(Over, to_degrees)));
        let per_minute = pair(Over, number(30.0), name("pi"));
        edits.push((Kind::Unit, of(Times, per_minute.clone())));
        edits.push((Kind::Unit, of(Over, per_minute)));
        for factor in [1e3, 1e6] {
            edits.push((Kind::Unit, of(Times, number(factor))));
            edits.push((Kind::Unit, of(Over, number(factor))));
        }
        for shift in [pair(Over, name("pi"), number(2.0)), name("pi"), pair(Times, number(2.0), name("pi"))] {
            edits.push((Kind::Reference, of(Plus, shift.clone())));
            edits.push((Kind::Reference, of(Minus, shift)));
        }
        edits.push((Kind::Reference, pair(Minus, name("pi"), part.clone())));
        edits.push((Kind::Reference, pair(Minus, pair(Over, name("pi"), number(2.0)), part.clone())));
        for quantity in names {
            edits.push((Kind::Missing, of(Times, name(quantity))));
            edits.push((Kind::Missing, of(Over, name(quantity))));
        }
        for term in names {
            for term in [name(term), pair(Power, name(term), number(2.0))] {
                edits.push((Kind::Missing, of(Plus, term.clone())));
                edits.push((Kind::Missing, of(Minus, term.clone())));
                edits.push((Kind::Missing, pair(Minus, term, part.clone())));
            }
        }
        // Hidden names: the crank's angular velocity.
        edits.push((Kind::PerRadian, of(Times, name(OMEGA))));
        edits.push((Kind::PerRadian, of(Over, name(OMEGA))));
        edits.push((Kind::PerRadian, of(Times, pair(Power, name(OMEGA), number(2.0)))));
        edits.push((Kind::PerRadian, of(Over, pair(Power, name(OMEGA), number(2.0)))));
    }
    edits
}

/// The crank's angular velocity, as a slip names it.
pub(super) use crate::scenario::formula::OMEGA;

fn of_call(function: Function, parts: &[Tree]) -> Vec<(Kind, Tree)> {
    let call = |function: Function| whole(Shape::Call(function, parts.to_vec()));
    let own = || call(function);
    let minus = |left: Tree, right: Tree| pair(Operator::Minus, left, right);
    let mut edits = Vec::new();
    let others: &[Function] = match function {
        Function::Sin => &[Function::Cos, Function::Tan],
        Function::Cos => &[Function::Sin, Function::Tan],
        Function::Tan => &[Function::Sin, Function::Cos],
        Function::Asin => &[Function::Acos, Function::Atan],
        Function::Acos => &[Function::Asin, Function::Atan],
        Function::Atan => &[Function::Asin, Function::Acos],
        Function::Atan2 | Function::Sqrt | Function::Abs | Function::Exp | Function::Ln | Function::Sign => &[],
    };
    edits.extend(others.iter().map(|other| (Kind::Function, call(*other))));
    match function {
        Function::Sqrt => {
            edits.push((Kind::Branch, negative(&own())));
            edits.push((Kind::Power, parts[0].clone()));
        }
        Function::Abs => edits.push((Kind::Branch, parts[0].clone())),
        Function::Acos => edits.push((Kind::Branch, negative(&own()))),
        Function::Asin => edits.push((Kind::Branch, minus(name("pi"), own()))),
        Function::Atan => {
            edits.push((Kind::Branch, pair(Operator::Plus, own(), name("pi"))));
            if let Shape::Pair(Operator::Over, sides) = &parts[0].shape {
                edits.push((Kind::Branch, whole(Shape::Call(Function::Atan2, sides.to_vec()))));
            }
        }
        Function::Atan2 => {
            let swapped = vec![parts[1].clone(), parts[0].clone()];
            edits.push((Kind::Function, whole(Shape::Call(Function::Atan2, swapped))));
            edits.push((Kind::Branch, pair(Operator::Plus, own(), name("pi"))));
        }
        Function::Sin | Function::Cos | Function::Tan | Function::Exp | Function::Ln | Function::Sign => {}
    }
    edits
}
