//! Slips as rules: each rule gives a written form and its possible corrections.

use crate::sentences;
use std::sync::LazyLock;

use super::slip::SlipKind;
use formula::{FormulaTree, NodeShape};
use scenario::INPUTS;
use scenario::formula::OMEGA;

/// Written form and possible corrections, the likeliest first.
/// Letters of the written form:
/// `a`, `b` and `c` are any subexpressions. `n` is a number. `q` is any subexpression except a number or pi. `u` is
/// any subexpression except a number, pi or a function call. `t` contains the crank angle or the time outside function
/// calls. Few factors are tried for `t`: its product with a factor can equal an angle by chance, up to whole
/// revolutions. `r` is any subexpression except a number, pi or a `t`. `g` is an `r` in a file without a parameter in
/// m/s^2; gravity is then written as a number.
/// `w` is the crank's angular velocity.
const RULES: [(SlipKind, &str); 52] = [
    (SlipKind::Sign, "a + b => a - b"),
    (SlipKind::Sign, "a - b => a + b; b - a"),
    (SlipKind::Sign, "a => -a"),
    (SlipKind::Branch, "sqrt(a) => -sqrt(a)"),
    (SlipKind::Branch, "abs(a) => a"),
    (SlipKind::Branch, "asin(a) => pi - asin(a)"),
    (SlipKind::Branch, "acos(a) => -acos(a)"),
    (SlipKind::Branch, "atan(a) => atan(a) + pi"),
    (SlipKind::Branch, "atan(a/b) => atan2(a, b)"),
    (SlipKind::Branch, "atan2(a, b) => atan2(a, b) + pi"),
    // Wrong unit conversions: degrees, revolutions per minute, seconds per minute, revolutions, and powers of ten.
    (SlipKind::Unit, sentences::PI_PI),
    (SlipKind::Unit, sentences::PI_PI_PI_PI_PI_PI),
    (SlipKind::Unit, "r => r*1e3; r/1e3; r*1e6; r/1e6"),
    (SlipKind::Unit, "g => g*9.81; g/9.81; g*9.80665; g/9.80665"),
    (SlipKind::Unit, "1e3 => 1"),
    (SlipKind::Unit, "1e6 => 1"),
    (SlipKind::Unit, "1e-3 => 1"),
    (SlipKind::Unit, "1e-6 => 1"),
    (SlipKind::Unit, "30 => 60; 180; 360"),
    (SlipKind::Unit, "60 => 1; 30; 180; 360"),
    (SlipKind::Unit, "90 => 90*(pi/180)"),
    (SlipKind::Unit, "180 => 30; 60; 360; 180*(pi/180)"),
    (SlipKind::Unit, "270 => 270*(pi/180)"),
    (SlipKind::Unit, "360 => 30; 60; 180; 360*(pi/180)"),
    (SlipKind::Function, "sin(a) => cos(a); tan(a); a"),
    (SlipKind::Function, "cos(a) => sin(a); tan(a); a"),
    (SlipKind::Function, "tan(a) => sin(a); cos(a); atan(a); a"),
    (SlipKind::Function, "asin(a) => acos(a); atan(a); sin(a)"),
    (SlipKind::Function, "acos(a) => asin(a); atan(a); cos(a)"),
    (SlipKind::Function, "atan(a) => asin(a); acos(a); tan(a)"),
    (SlipKind::Function, "atan2(a, b) => atan2(b, a)"),
    // A function is missing. For example, a small angle is used in place of its sine.
    (SlipKind::Function, "u => sin(u); cos(u); tan(u); asin(u); atan(u)"),
    (SlipKind::Power, "a^b => a; a^2; a^3; a^4; a^0.5"),
    (SlipKind::Power, "sqrt(a) => a"),
    (SlipKind::Power, "q => q^2; q^3; sqrt(q)"),
    (SlipKind::PerRadian, "q => q*w; q*w^2"),
    (SlipKind::PerSecond, "q => q/w; q/w^2"),
    (SlipKind::Term, "a + b => a; b"),
    (SlipKind::Term, "a - b => a; -b"),
    (SlipKind::Reference, sentences::PI_PI_PI_PI_PI_PI_PI_PI),
    (SlipKind::Factor, "q => q*2; q/2; q*3; q/3; q*4; q/4"),
    (SlipKind::Operator, "a*b => a/b"),
    (SlipKind::Operator, "a*n => a^n"),
    (SlipKind::Operator, "a/b => a*b; b/a"),
    (SlipKind::Operator, "a^b => a*b"),
    (SlipKind::Parentheses, "a + b*c => (a + b)*c"),
    (SlipKind::Parentheses, "a + b/c => (a + b)/c"),
    (SlipKind::Parentheses, "a - b*c => (a - b)*c"),
    (SlipKind::Parentheses, "a - b/c => (a - b)/c"),
    (SlipKind::Parentheses, "a/b*c => a/(b*c)"),
    (SlipKind::Parentheses, "a*b^c => (a*b)^c"),
    (SlipKind::Parentheses, "a/b^c => (a/b)^c"),
];

/// A parsed rule.
struct Rule {
    kind: SlipKind,
    written: FormulaTree,
    meant: Vec<FormulaTree>,
}

static READ: LazyLock<Vec<Rule>> = LazyLock::new(|| {
    let tree = |text: &str| FormulaTree::parse(text.trim()).expect("a rule is a formula");
    let read = |(kind, text): (SlipKind, &str)| {
        let (written, meant) = text.split_once("=>").expect("a rule has two sides");
        Rule { kind, written: tree(written), meant: meant.split(';').map(tree).collect() }
    };
    RULES.into_iter().map(read).collect()
});

/// Adds the possible corrections of a subexpression, by the rules for one kind of slip.
pub(super) fn with_slips(part: &FormulaTree, kind: SlipKind, has_gravity: bool, edits: &mut Vec<FormulaTree>) {
    for rule in READ.iter().filter(|rule| rule.kind == kind) {
        let mut found = Vec::new();
        if goes_with(&rule.written, part, has_gravity, &mut found) {
            edits.extend(rule.meant.iter().map(|meant| with_parts(meant, &found)));
        }
    }
}

/// Whether a subexpression matches a written form; `found` receives the subexpressions that match the letters of the
/// form.
fn goes_with<'a>(
    written: &'a FormulaTree,
    part: &'a FormulaTree,
    has_gravity: bool,
    found: &mut Vec<(&'a str, &'a FormulaTree)>,
) -> bool {
    let mut go = |written: &'a FormulaTree, part: &'a FormulaTree| goes_with(written, part, has_gravity, found);
    match (&written.shape, &part.shape) {
        (NodeShape::Name(letter), shape) => {
            found.push((letter, part));
            let is_number = matches!(shape, NodeShape::Number(_));
            let is_constant = is_number || matches!(shape, NodeShape::Name(name) if name == "pi");
            match letter.as_str() {
                "n" => is_number,
                "q" => !is_constant,
                "u" => !is_constant && !matches!(shape, NodeShape::Call(..)),
                "t" => is_turning(part),
                "r" => !is_constant && !is_turning(part),
                "g" => !is_constant && !is_turning(part) && !has_gravity,
                _ => true,
            }
        }
        (NodeShape::Pair(written, sides), NodeShape::Pair(own, parts)) => {
            written == own && go(&sides[0], &parts[0]) && go(&sides[1], &parts[1])
        }
        (NodeShape::Call(written, arguments), NodeShape::Call(own, parts)) => {
            written == own && arguments.iter().zip(parts).all(|(argument, part)| go(argument, part))
        }
        (NodeShape::Number(written), NodeShape::Number(own)) => written == own,
        _ => false,
    }
}

/// Whether a subexpression contains the crank angle or the time outside function calls.
fn is_turning(part: &FormulaTree) -> bool {
    match &part.shape {
        NodeShape::Name(name) => INPUTS.contains(&name.as_str()),
        NodeShape::Number(_) | NodeShape::Call(..) => false,
        NodeShape::Negative(_) | NodeShape::Pair(..) => part.parts().iter().any(is_turning),
    }
}

/// The tree of a written form in which the given subexpressions replace the letters.
pub(in crate::check) fn with_parts(tree: &FormulaTree, parts: &[(&str, &FormulaTree)]) -> FormulaTree {
    let go = |tree: &FormulaTree| with_parts(tree, parts);
    match &tree.shape {
        NodeShape::Number(value) => FormulaTree::number(*value),
        NodeShape::Name(name) => match parts.iter().find(|(letter, _)| letter == name) {
            Some((_, part)) => (*part).clone(),
            None if name == "w" => FormulaTree::name(OMEGA),
            None => FormulaTree::name(name.as_str()),
        },
        NodeShape::Negative(part) => go(part).negative(),
        NodeShape::Pair(operator, sides) => FormulaTree::pair(*operator, go(&sides[0]), go(&sides[1])),
        NodeShape::Call(function, arguments) => FormulaTree::call(*function, arguments.iter().map(go).collect()),
    }
}
