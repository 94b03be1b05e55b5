//! Slips at one place of a formula.

use super::functions;
use super::regrouped;
use super::slip::Kind;
use formula::Operator::{Minus, Over, Plus, Power, Times};
use formula::{Function, Operator, Shape, Tree};
use scenario::formula::OMEGA;
use scenario::{INPUTS, Parameter};

/// Factors between units, besides powers of ten: degrees, turns a minute, seconds in a minute, turns.
fn units() -> [Tree; 4] {
    let over_pi = |number: f64| Tree::pair(Over, Tree::number(number), Tree::name("pi"));
    [over_pi(180.0), over_pi(30.0), Tree::number(60.0), Tree::pair(Times, Tree::number(2.0), Tree::name("pi"))]
}

/// Values of the acceleration of gravity (m/s^2), as they are written.
pub(super) const GRAVITY: [f64; 5] = [9.81, 9.806_65, 9.8, 9.807, 10.0];

/// What may have been meant by a part, where it is wrong by one kind of slip. `names` are those of quantities.
pub(super) fn of(part: &Tree, kind: Kind, names: &[&str], parameters: &[Parameter]) -> Vec<Tree> {
    let of = |operator: Operator, right: Tree| Tree::pair(operator, part.clone(), right);
    let both = |factors: &[Tree]| -> Vec<Tree> {
        factors.iter().flat_map(|factor| [of(Times, factor.clone()), of(Over, factor.clone())]).collect()
    };
    let is_name = matches!(&part.shape, Shape::Name(_));
    let is_constant = matches!(&part.shape, Shape::Number(_)) || part.shape == Shape::Name("pi".into());
    let pair = match &part.shape {
        Shape::Pair(operator, parts) => Some((*operator, parts[0].clone(), parts[1].clone())),
        Shape::Number(_) | Shape::Name(_) | Shape::Negative(_) | Shape::Call(..) => None,
    };
    match kind {
        Kind::Sign => {
            let mut edits = match pair {
                Some((Plus, left, right)) => vec![Tree::pair(Minus, left, right)],
                Some((Minus, left, right)) => {
                    vec![Tree::pair(Plus, left.clone(), right.clone()), Tree::pair(Minus, right, left)]
                }
                Some((Times | Over | Power, ..)) | None => Vec::new(),
            };
            edits.push(part.negative());
            edits
        }
        Kind::Branch => match &part.shape {
            Shape::Call(function, parts) => functions::branches(*function, parts),
            Shape::Number(_) | Shape::Name(_) | Shape::Negative(_) | Shape::Pair(..) => Vec::new(),
        },
        Kind::Function => match &part.shape {
            Shape::Call(function, parts) => functions::others(*function, parts),
            _ if is_constant => Vec::new(),
            Shape::Number(_) | Shape::Name(_) | Shape::Negative(_) | Shape::Pair(..) => functions::missing(part),
        },
        Kind::Power => {
            let mut edits = match pair {
                Some((Power, left, _)) => {
                    let exponents = [2.0, 3.0, 4.0, 0.5].map(|own| Tree::pair(Power, left.clone(), Tree::number(own)));
                    [vec![left], exponents.to_vec()].concat()
                }
                Some((Plus | Minus | Times | Over, ..)) | None => Vec::new(),
            };
            if let Shape::Call(Function::Sqrt, parts) = &part.shape {
                edits.push(parts[0].clone());
            }
            if !is_constant {
                edits.extend([2.0, 3.0].map(|exponent| of(Power, Tree::number(exponent))));
                edits.push(Tree::call(Function::Sqrt, vec![part.clone()]));
            }
            edits
        }
        // Hidden names: the crank's angular velocity.
        Kind::PerRadian | Kind::PerSecond if is_constant => Vec::new(),
        Kind::PerRadian => powers_of_speed().map(|omega| of(Times, omega)).to_vec(),
        Kind::PerSecond => powers_of_speed().map(|omega| of(Over, omega)).to_vec(),
        Kind::Name if is_constant || !is_name => Vec::new(),
        Kind::Name => others(part, names, parameters),
        Kind::Exchanged => exchanged(part, names),
        Kind::Term => match pair {
            Some((Plus, left, right)) => vec![left, right],
            Some((Minus, left, right)) => vec![left, right.negative()],
            Some((Times | Over | Power, ..)) | None => Vec::new(),
        },
        Kind::Unit => match &part.shape {
            Shape::Number(value) => of_number(*value, part),
            Shape::Name(_) | Shape::Negative(_) | Shape::Pair(..) | Shape::Call(..) if is_constant => Vec::new(),
            Shape::Name(_) | Shape::Negative(_) | Shape::Pair(..) | Shape::Call(..) => {
                let mut edits: Vec<Tree> = quantity(part, parameters).map(Tree::name).into_iter().collect();
                if is_turning(part) {
                    return both(&units()[..1]);
                }
                edits.extend(both(&units()));
                edits.extend(both(&[1e3, 1e6].map(Tree::number)));
                // Where gravity has a name, it is missing by its name.
                let is_known = parameters.iter().any(|own| own.unit() == Some("m_s2"));
                edits.extend(if is_known { Vec::new() } else { both(&[9.81, 9.806_65].map(Tree::number)) });
                edits
            }
        },
        Kind::Reference if is_constant => Vec::new(),
        Kind::Reference => {
            let pi = || Tree::name("pi");
            let quarter = || Tree::pair(Over, pi(), Tree::number(2.0));
            let shifts = [quarter(), pi(), Tree::pair(Times, Tree::number(2.0), pi())];
            let mut edits: Vec<Tree> =
                shifts.into_iter().flat_map(|shift| [of(Plus, shift.clone()), of(Minus, shift)]).collect();
            edits.extend([pi(), quarter()].map(|shift| Tree::pair(Minus, shift, part.clone())));
            edits
        }
        Kind::Factor => match &part.shape {
            Shape::Number(value) if is_unit(*value) => Vec::new(),
            Shape::Number(value) => {
                let others = [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0].into_iter().filter(|other| other != value);
                others.map(Tree::number).collect()
            }
            Shape::Name(_) | Shape::Negative(_) | Shape::Pair(..) | Shape::Call(..) if is_constant => Vec::new(),
            Shape::Name(_) | Shape::Negative(_) | Shape::Pair(..) | Shape::Call(..) => {
                both(&[2.0, 3.0, 4.0].map(Tree::number))
            }
        },
        Kind::Operator => match pair {
            Some((Times, left, right)) => match right.shape {
                Shape::Number(_) => [Over, Power].map(|own| Tree::pair(own, left.clone(), right.clone())).to_vec(),
                Shape::Name(_) | Shape::Negative(_) | Shape::Pair(..) | Shape::Call(..) => {
                    vec![Tree::pair(Over, left, right)]
                }
            },
            Some((Over, left, right)) => {
                vec![Tree::pair(Times, left.clone(), right.clone()), Tree::pair(Over, right, left)]
            }
            Some((Power, left, right)) => vec![Tree::pair(Times, left, right)],
            Some((Plus | Minus, ..)) | None => Vec::new(),
        },
        Kind::Parentheses => regrouped::of(part),
        // Sought by its number, not tried.
        Kind::Value => Vec::new(),
    }
}

fn powers_of_speed() -> [Tree; 2] {
    [Tree::name(OMEGA), Tree::pair(Power, Tree::name(OMEGA), Tree::number(2.0))]
}

/// Whether a part is an angle or a time by its form: multiples of it may turn by whole turns from instant to instant.
fn is_turning(part: &Tree) -> bool {
    match &part.shape {
        Shape::Name(name) => INPUTS.contains(&name.as_str()),
        Shape::Number(_) | Shape::Call(..) => false,
        Shape::Negative(_) | Shape::Pair(..) => part.parts().iter().any(is_turning),
    }
}

/// Whether a number stands in formulas because of units.
fn is_unit(value: f64) -> bool {
    GRAVITY.contains(&value) || [1e3, 1e6, 1e-3, 1e-6, 30.0, 60.0, 90.0, 180.0, 270.0, 360.0, 3600.0].contains(&value)
}

/// A number of a unit, as it may have been meant.
fn of_number(value: f64, part: &Tree) -> Vec<Tree> {
    let mut edits = Vec::new();
    if GRAVITY.contains(&value) {
        edits.extend(GRAVITY.into_iter().filter(|other| *other != value).map(Tree::number));
    }
    if [1e3, 1e6, 1e-3, 1e-6, 60.0].contains(&value) {
        edits.push(Tree::number(1.0));
    }
    if [30.0, 60.0, 180.0, 360.0].contains(&value) {
        edits.extend([30.0, 60.0, 180.0, 360.0].into_iter().filter(|other| *other != value).map(Tree::number));
    }
    if [90.0, 180.0, 270.0, 360.0].contains(&value) {
        let radian = Tree::pair(Over, Tree::name("pi"), Tree::number(180.0));
        edits.push(Tree::pair(Times, part.clone(), radian));
    }
    edits
}

/// The quantity whose plain number a name stands for.
pub(super) fn quantity<'a>(part: &Tree, parameters: &'a [Parameter]) -> Option<&'a str> {
    let Shape::Name(own) = &part.shape else { return None };
    parameters.iter().find(|parameter| parameter.key == *own).and_then(Parameter::short)
}

/// The other names that may have been meant by one.
pub fn others(part: &Tree, names: &[&str], parameters: &[Parameter]) -> Vec<Tree> {
    let Shape::Name(own) = &part.shape else { return Vec::new() };
    let quantity = quantity(part, parameters);
    let others = names.iter().filter(|other| **other != own.as_str() && Some(**other) != quantity);
    others.map(|other| Tree::name(*other)).collect()
}

/// A sum, difference, product or quotient of two quantities with these exchanged, wherever they stand in it.
fn exchanged(part: &Tree, names: &[&str]) -> Vec<Tree> {
    let Shape::Pair(Plus | Minus | Over | Times, _) = part.shape else { return Vec::new() };
    let mut own: Vec<&str> = part.names().into_iter().map(|(name, _)| name).filter(|own| names.contains(own)).collect();
    own.sort_unstable();
    own.dedup();
    let pairs = (0..own.len()).flat_map(|first| (first + 1..own.len()).map(move |second| (first, second)));
    pairs.map(|(first, second)| with_exchanged(part, [own[first], own[second]])).collect()
}

fn with_exchanged(part: &Tree, [one, other]: [&str; 2]) -> Tree {
    let mut changed = part.clone();
    rename(&mut changed, [one, other]);
    changed
}

fn rename(tree: &mut Tree, [one, other]: [&str; 2]) {
    if let Shape::Name(own) = &mut tree.shape {
        if own == one {
            *own = other.into();
        } else if own == other {
            *own = one.into();
        }
    }
    for inner in tree.parts_mut() {
        rename(inner, [one, other]);
    }
}
