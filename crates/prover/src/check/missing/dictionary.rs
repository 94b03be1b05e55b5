//! Dictionary of terms and factors that may be missing in a derivation: steps (earlier formulas), sines and cosines of
//! angles, and products of such expressions.

use crate::check::slips::{at_every_place, with_parts};
use crate::check::trial::Trial;
use formula::{FormulaTree, Function, NodeShape, Operator, Program};
use linkage::math::KeepNan;

/// Largest number of angles whose sines and cosines are included.
const ANGLES: usize = 10;
/// Largest number of steps tried. The last steps before the formula are chosen. The number of products of two steps
/// grows with the square of the number of steps.
const STEPS: usize = 60;

/// An expression that varies with the crank angle, or the constant 1.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) tree: FormulaTree,
    /// Complexity of the expression.
    pub(super) weight: usize,
    /// Values of the expression at the few instants of the trial.
    pub(super) values: Vec<f64>,
    /// One more than the index of the last formula that the expression uses.
    pub(super) after: usize,
}

impl Entry {
    /// Whether the expression is the constant 1.
    pub(super) fn is_one(&self) -> bool {
        matches!(self.tree.shape, NodeShape::Number(_))
    }
}

/// The expressions that may be missing in a formula, and the constant steps before the formula with their names and
/// values.
pub(super) struct Dictionary {
    pub(super) entries: Vec<Entry>,
    pub(super) constants: Vec<(String, f64)>,
}

/// The following constants list expressions that may be missing, each with its weight. `a` and `b` are steps, `x` and
/// `y` are angles.
const OF_STEP: &str = "a: 1; a^2: 2; 1/a: 2; 1/a^2: 3";
const OF_STEPS: &str = "a*b: 2; a/b: 3; b/a: 3; a^2*b: 4; a*b^2: 4";
const OF_ANGLES: &str = "cos(x)*tan(y): 0; sin(x)*tan(y): 0";
const OF_BOTH: &str = "a*cos(x): 2; a^2*cos(x): 3; a/cos(x): 3; a*sin(x): 2; a^2*sin(x): 3; a/sin(x): 3; \
                       a*tan(x): 3; a^2*tan(x): 4; a/tan(x): 4";
const OF_ANGLE: &str = "cos(x)*sin(x): 2; cos(x)^2: 2; cos(x)^3: 2; 1/cos(x): 2; 1/cos(x)^2: 3; 1/cos(x)^3: 3; \
                        sin(x)^2: 2; sin(x)^3: 2; 1/sin(x): 2; 1/sin(x)^2: 3; 1/sin(x)^3: 3; \
                        cos(x): 0; sin(x): 0; tan(x): 1";

/// Parses expressions with their weights. Letters in the expressions are placeholders for steps and angles.
fn read(text: &str) -> Vec<(FormulaTree, usize)> {
    let one = |own: &str| {
        let (tree, weight) = own.split_once(':').expect("an expression has a weight");
        (FormulaTree::parse(tree.trim()).expect("it is a formula"), weight.trim().parse().expect("it is a number"))
    };
    text.split(';').map(one).collect()
}

impl Dictionary {
    /// Collects the expressions that may be missing in the formula of a trial. The parts of the expressions come from
    /// the derivation before this formula.
    pub(super) fn of(trial: &Trial) -> Self {
        let before = trial.index.saturating_sub(STEPS)..trial.index;
        let steps: Vec<FormulaTree> =
            trial.formulas.list[before].iter().map(|own| FormulaTree::name(own.name.as_str())).collect();
        let steps = valued(trial, steps.into_iter().map(|tree| (tree, 1)));
        let is_constant = |entry: &Entry| {
            let size = entry.values.iter().fold(0.0, |size: f64, value| size.larger(value.abs()));
            entry.values.iter().all(|value| (value - entry.values[0]).abs() <= 1e-13 * size)
        };
        let (fixed, steps): (Vec<Entry>, Vec<Entry>) = steps.into_iter().partition(is_constant);
        let constants = fixed.iter().map(|own| (own.tree.to_string(), own.values[0])).collect();
        let steps: Vec<FormulaTree> = steps.into_iter().map(|own| own.tree).collect();
        let [of_step, of_steps, of_angles, of_both, of_angle] =
            [OF_STEP, OF_STEPS, OF_ANGLES, OF_BOTH, OF_ANGLE].map(read);
        let mut all: Vec<(FormulaTree, usize)> = vec![(FormulaTree::number(1.0), 0)];
        let mut put = |of: &[(FormulaTree, usize)], parts: &[(&str, &FormulaTree)], more: usize| {
            all.extend(of.iter().map(|(tree, weight)| (with_parts(tree, parts), weight + more)));
        };
        for (index, step) in steps.iter().enumerate() {
            put(&of_step, &[("a", step)], 0);
            steps[index + 1..].iter().for_each(|other| put(&of_steps, &[("a", step), ("b", other)], 0));
        }
        put(&[(FormulaTree::name("phi"), 2), (FormulaTree::name("t"), 2)], &[], 0);
        let angles = angles(trial);
        for (angle, weight) in &angles {
            for (other, more) in angles.iter().filter(|(other, _)| other.to_string() != angle.to_string()) {
                put(&of_angles, &[("x", angle), ("y", other)], weight + more);
            }
        }
        for (angle, weight) in &angles {
            steps.iter().for_each(|step| put(&of_both, &[("a", step), ("x", angle)], *weight));
            put(&of_angle, &[("x", angle)], *weight);
        }
        let entries = valued(trial, all.into_iter())
            .into_iter()
            .filter(|own| own.values.iter().all(|value| value.is_finite()) && (own.is_one() || !is_constant(own)));
        Dictionary { entries: entries.collect(), constants }
    }
}

/// Angles of the derivation, each with the complexity of its sine or cosine.
/// The list starts with the crank angle, with the steps in arguments of sines, cosines and tangents, and with the
/// steps that are values of inverse functions. The rest of the list are the differences between two of these angles,
/// and two and three times the crank angle.
fn angles(trial: &Trial) -> Vec<(FormulaTree, usize)> {
    let mut names: Vec<FormulaTree> = vec![FormulaTree::name("phi")];
    let known = &trial.formulas.list[..trial.index];
    let mut put = |name: &str| {
        let is_new = names.iter().all(|own| own.to_string() != name);
        if is_new && names.len() < ANGLES && known.iter().any(|step| step.name == name) {
            names.push(FormulaTree::name(name));
        }
    };
    for own in trial.formulas.list.iter().rev() {
        at_every_place(&own.tree, &mut |_, part| {
            let NodeShape::Call(Function::Sin | Function::Cos | Function::Tan, arguments) = &part.shape else { return };
            arguments[0].names().iter().for_each(|(name, _)| put(name));
        });
    }
    // Adds the steps that are angles, even if no sine, cosine or tangent in the derivation uses them.
    known.iter().rev().filter(|own| is_angle(&own.tree)).for_each(|own| put(&own.name));
    let multiple =
        |factor: f64| FormulaTree::pair(Operator::Times, FormulaTree::number(factor), FormulaTree::name("phi"));
    let pairs = (0..names.len()).flat_map(|first| (first + 1..names.len()).map(move |second| (first, second)));
    let minus = |(first, second): (usize, usize)| {
        (FormulaTree::pair(Operator::Minus, names[first].clone(), names[second].clone()), 4)
    };
    let differences: Vec<(FormulaTree, usize)> = pairs.map(minus).collect();
    let single = names.into_iter().map(|name| (name, 2));
    single.chain([2.0, 3.0].map(|factor| (multiple(factor), 3))).chain(differences).collect()
}

/// Whether a formula has the form of an angle.
fn is_angle(tree: &FormulaTree) -> bool {
    match &tree.shape {
        NodeShape::Call(Function::Asin | Function::Acos | Function::Atan | Function::Atan2, _) => true,
        NodeShape::Negative(part) => is_angle(part),
        NodeShape::Pair(_, parts) => parts.iter().any(is_angle),
        NodeShape::Number(_) | NodeShape::Name(_) | NodeShape::Call(..) => false,
    }
}

/// Evaluates expressions at the trial's few instants.
fn valued(trial: &Trial, all: impl Iterator<Item = (FormulaTree, usize)>) -> Vec<Entry> {
    let mut graph = trial.formulas.graph.clone();
    let all: Vec<(FormulaTree, usize)> = all.collect();
    let ids: Vec<_> = all.iter().map(|(tree, _)| graph.add(tree).expect("made of names that are known")).collect();
    let mut program = Program::of(&graph, &ids);
    let mut values = vec![Vec::with_capacity(trial.few.len()); all.len()];
    for &place in &trial.few {
        let found = program.run(&trial.inputs(place));
        values.iter_mut().zip(found).for_each(|(values, found)| values.push(found.value));
    }
    let after = |tree: &FormulaTree| {
        let index_of = |name: &str| trial.formulas.list.iter().position(|own| own.name == name);
        tree.names().into_iter().filter_map(|(name, _)| index_of(name)).map(|index| index + 1).max().unwrap_or(0)
    };
    all.into_iter()
        .zip(values)
        .map(|((tree, weight), values)| Entry { after: after(&tree), tree, weight, values })
        .collect()
}
