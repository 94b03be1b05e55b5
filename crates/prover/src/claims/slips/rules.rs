//! Slips as rules: what is written, and what may have been meant by it.

use crate::sentences;
use std::sync::LazyLock;

use super::slip::Kind;
use formula::{Shape, Tree};
use scenario::INPUTS;
use scenario::formula::OMEGA;

/// What is written, and what may have been meant, the likeliest first. In what is written, `a`, `b` and `c` are any
/// parts, `n` is a number, `q` is neither a number nor pi, `u` is that and no call, `t` is an angle or a time by its
/// form: multiples of it may turn by whole turns from instant to instant; `r` is none of these, and `g` is it where
/// gravity has no name. `w` is the crank's angular velocity.
const RULES: [(Kind, &str); 52] = [
    (Kind::Sign, "a + b => a - b"),
    (Kind::Sign, "a - b => a + b; b - a"),
    (Kind::Sign, "a => -a"),
    (Kind::Branch, "sqrt(a) => -sqrt(a)"),
    (Kind::Branch, "abs(a) => a"),
    (Kind::Branch, "asin(a) => pi - asin(a)"),
    (Kind::Branch, "acos(a) => -acos(a)"),
    (Kind::Branch, "atan(a) => atan(a) + pi"),
    (Kind::Branch, "atan(a/b) => atan2(a, b)"),
    (Kind::Branch, "atan2(a, b) => atan2(a, b) + pi"),
    // Degrees, turns a minute, seconds in a minute, turns, and powers of ten.
    (Kind::Unit, sentences::PI_PI),
    (Kind::Unit, sentences::PI_PI_PI_PI_PI_PI),
    (Kind::Unit, "r => r*1e3; r/1e3; r*1e6; r/1e6"),
    (Kind::Unit, "g => g*9.81; g/9.81; g*9.80665; g/9.80665"),
    (Kind::Unit, "1e3 => 1"),
    (Kind::Unit, "1e6 => 1"),
    (Kind::Unit, "1e-3 => 1"),
    (Kind::Unit, "1e-6 => 1"),
    (Kind::Unit, "30 => 60; 180; 360"),
    (Kind::Unit, "60 => 1; 30; 180; 360"),
    (Kind::Unit, "90 => 90*(pi/180)"),
    (Kind::Unit, "180 => 30; 60; 360; 180*(pi/180)"),
    (Kind::Unit, "270 => 270*(pi/180)"),
    (Kind::Unit, "360 => 30; 60; 180; 360*(pi/180)"),
    (Kind::Function, "sin(a) => cos(a); tan(a); a"),
    (Kind::Function, "cos(a) => sin(a); tan(a); a"),
    (Kind::Function, "tan(a) => sin(a); cos(a); atan(a); a"),
    (Kind::Function, "asin(a) => acos(a); atan(a); sin(a)"),
    (Kind::Function, "acos(a) => asin(a); atan(a); cos(a)"),
    (Kind::Function, "atan(a) => asin(a); acos(a); tan(a)"),
    (Kind::Function, "atan2(a, b) => atan2(b, a)"),
    // As where a small angle is taken for its sine.
    (Kind::Function, "u => sin(u); cos(u); tan(u); asin(u); atan(u)"),
    (Kind::Power, "a^b => a; a^2; a^3; a^4; a^0.5"),
    (Kind::Power, "sqrt(a) => a"),
    (Kind::Power, "q => q^2; q^3; sqrt(q)"),
    (Kind::PerRadian, "q => q*w; q*w^2"),
    (Kind::PerSecond, "q => q/w; q/w^2"),
    (Kind::Term, "a + b => a; b"),
    (Kind::Term, "a - b => a; -b"),
    (Kind::Reference, sentences::PI_PI_PI_PI_PI_PI_PI_PI),
    (Kind::Factor, "q => q*2; q/2; q*3; q/3; q*4; q/4"),
    (Kind::Operator, "a*b => a/b"),
    (Kind::Operator, "a*n => a^n"),
    (Kind::Operator, "a/b => a*b; b/a"),
    (Kind::Operator, "a^b => a*b"),
    (Kind::Parentheses, "a + b*c => (a + b)*c"),
    (Kind::Parentheses, "a + b/c => (a + b)/c"),
    (Kind::Parentheses, "a - b*c => (a - b)*c"),
    (Kind::Parentheses, "a - b/c => (a - b)/c"),
    (Kind::Parentheses, "a/b*c => a/(b*c)"),
    (Kind::Parentheses, "a*b^c => (a*b)^c"),
    (Kind::Parentheses, "a/b^c => (a/b)^c"),
];

/// A rule, read.
struct Rule {
    kind: Kind,
    written: Tree,
    meant: Vec<Tree>,
}

static READ: LazyLock<Vec<Rule>> = LazyLock::new(|| {
    let tree = |text: &str| Tree::parse(text.trim()).expect("a rule is a formula");
    let read = |(kind, text): (Kind, &str)| {
        let (written, meant) = text.split_once("=>").expect("a rule has two sides");
        Rule { kind, written: tree(written), meant: meant.split(';').map(tree).collect() }
    };
    RULES.into_iter().map(read).collect()
});

/// Adds what may have been meant by a part, by the rules of a kind.
pub(super) fn with_slips(part: &Tree, kind: Kind, has_gravity: bool, edits: &mut Vec<Tree>) {
    for rule in READ.iter().filter(|rule| rule.kind == kind) {
        let mut found = Vec::new();
        if goes_with(&rule.written, part, has_gravity, &mut found) {
            edits.extend(rule.meant.iter().map(|meant| with_parts(meant, &found)));
        }
    }
}

/// Whether a part has the form of what is written; `found` are the parts that its letters stand for.
fn goes_with<'a>(written: &'a Tree, part: &'a Tree, has_gravity: bool, found: &mut Vec<(&'a str, &'a Tree)>) -> bool {
    let mut go = |written: &'a Tree, part: &'a Tree| goes_with(written, part, has_gravity, found);
    match (&written.shape, &part.shape) {
        (Shape::Name(letter), shape) => {
            found.push((letter, part));
            let is_number = matches!(shape, Shape::Number(_));
            let is_constant = is_number || matches!(shape, Shape::Name(name) if name == "pi");
            match letter.as_str() {
                "n" => is_number,
                "q" => !is_constant,
                "u" => !is_constant && !matches!(shape, Shape::Call(..)),
                "t" => is_turning(part),
                "r" => !is_constant && !is_turning(part),
                "g" => !is_constant && !is_turning(part) && !has_gravity,
                _ => true,
            }
        }
        (Shape::Pair(written, sides), Shape::Pair(own, parts)) => {
            written == own && go(&sides[0], &parts[0]) && go(&sides[1], &parts[1])
        }
        (Shape::Call(written, arguments), Shape::Call(own, parts)) => {
            written == own && arguments.iter().zip(parts).all(|(argument, part)| go(argument, part))
        }
        (Shape::Number(written), Shape::Number(own)) => written == own,
        _ => false,
    }
}

/// Whether a part is an angle or a time by its form.
fn is_turning(part: &Tree) -> bool {
    match &part.shape {
        Shape::Name(name) => INPUTS.contains(&name.as_str()),
        Shape::Number(_) | Shape::Call(..) => false,
        Shape::Negative(_) | Shape::Pair(..) => part.parts().iter().any(is_turning),
    }
}

/// A tree with parts in place of the letters that stand for them.
pub(in crate::claims) fn with_parts(tree: &Tree, parts: &[(&str, &Tree)]) -> Tree {
    let go = |tree: &Tree| with_parts(tree, parts);
    match &tree.shape {
        Shape::Number(value) => Tree::number(*value),
        Shape::Name(name) => match parts.iter().find(|(letter, _)| letter == name) {
            Some((_, part)) => (*part).clone(),
            None if name == "w" => Tree::name(OMEGA),
            None => Tree::name(name.as_str()),
        },
        Shape::Negative(part) => go(part).negative(),
        Shape::Pair(operator, sides) => Tree::pair(*operator, go(&sides[0]), go(&sides[1])),
        Shape::Call(function, arguments) => Tree::call(*function, arguments.iter().map(go).collect()),
    }
}
