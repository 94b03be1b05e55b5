//! A derivation stored as a list of subexpressions and evaluated at several instants.
//! After a change of one subexpression, only the subexpressions that depend on it are evaluated again.

use std::collections::BTreeMap;

use crate::graph::Node;
use crate::rounded::Rounded;
use crate::tree::{FormulaTree, NodeShape, Operator};

/// A subexpression in the list. The arguments of a subexpression stand earlier in the list, with smaller indices.
#[derive(Clone, Copy, Debug)]
enum Part {
    /// Position of the subexpression to which the formula refers by name.
    Named(usize),
    Own(Node<usize>),
}

/// All subexpressions of the formulas of a derivation, and their values at several instants.
#[derive(Clone, Debug, Default)]
pub struct DerivationSheet {
    parts: Vec<Part>,
    /// Indices in `parts` of the subexpressions of every formula. Unlike in `parts`, a subexpression is listed before
    /// its arguments.
    formulas: Vec<Vec<usize>>,
    names: BTreeMap<String, usize>,
    /// Inputs, by instant.
    inputs: Vec<Vec<Rounded>>,
    /// Values of all subexpressions, for each instant.
    values: Vec<Vec<Rounded>>,
    /// Values after a change, each with the number of the change for which it was calculated.
    changed: Vec<(u32, Rounded)>,
    change: u32,
    /// Number of evaluations so far. One evaluation is that of one subexpression at one instant.
    /// Callers add their own evaluations to this number.
    pub operations: u64,
}

/// Prefix of names such as `#12`. In a tree made for a change, the name `#12` denotes the subexpression with the index
/// 12.
const PLACE: char = '#';
/// Upper limit of the number of Newton steps in the search for the correction of a subexpression at an instant.
const STEPS: usize = 30;
/// To measure a slope, the correction is changed by this fraction of its magnitude.
const DIFFERENCE: f64 = 1e-6;

/// Correct value of a formula at an instant.
#[derive(Clone, Copy, Debug)]
pub struct FormulaTarget {
    /// The correct value.
    pub value: f64,
    /// Largest allowed distance of a value from the correct value.
    pub bound: f64,
    /// A whole turn, in the unit of the value; `None` if the value is not an angle.
    pub turn: Option<f64>,
}

impl FormulaTarget {
    /// A value minus the correct value. For angles, whole turns are removed.
    #[must_use]
    pub fn difference(&self, value: f64) -> f64 {
        let difference = value - self.value;
        self.turn.map_or(difference, |turn| difference - turn * (difference / turn).round())
    }
}

impl DerivationSheet {
    /// A sheet without formulas, made from the names of the inputs and their values at every instant.
    #[must_use]
    pub fn new(names: &[&str], inputs: Vec<Vec<Rounded>>) -> Self {
        let values = vec![Vec::new(); inputs.len()];
        let mut own = DerivationSheet { inputs, values, ..DerivationSheet::default() };
        for (index, name) in names.iter().enumerate() {
            own.put_named(name, Node::Input(index));
        }
        own.constant("pi", Rounded::nearly(std::f64::consts::PI));
        own
    }

    /// Defines a constant by name.
    pub fn constant(&mut self, name: &str, number: Rounded) {
        self.put_named(name, Node::Number(number));
    }

    /// Adds a formula that later formulas may use by its name. `None` if the formula uses an unknown name.
    pub fn add(&mut self, name: &str, tree: &FormulaTree) -> Option<()> {
        let mut order = Vec::new();
        let place = self.read(tree, &mut order)?;
        self.names.insert(name.into(), place);
        self.formulas.push(order);
        Some(())
    }

    fn put_named(&mut self, name: &str, part: Node<usize>) {
        let place = self.put(Part::Own(part));
        self.names.insert(name.into(), place);
    }

    fn read(&mut self, tree: &FormulaTree, order: &mut Vec<usize>) -> Option<usize> {
        let own = order.len();
        order.push(0);
        let part = match &tree.shape {
            NodeShape::Number(value) => Part::Own(Node::Number(Rounded::decimal(*value))),
            NodeShape::Name(name) => Part::Named(*self.names.get(name)?),
            NodeShape::Negative(inner) => Part::Own(Node::Negative(self.read(inner, order)?)),
            NodeShape::Pair(operator, parts) => {
                let left = self.read(&parts[0], order)?;
                Part::Own(Node::Pair(*operator, left, self.read(&parts[1], order)?))
            }
            NodeShape::Call(function, parts) => {
                let first = self.read(&parts[0], order)?;
                let second = parts.get(1).map_or(Some(first), |second| self.read(second, order))?;
                Part::Own(Node::Call(*function, first, second))
            }
        };
        let place = self.put(part);
        order[own] = place;
        Some(place)
    }

    fn put(&mut self, part: Part) -> usize {
        self.operations += self.inputs.len() as u64;
        for instant in 0..self.inputs.len() {
            let value = self.evaluated(part, instant, |place| self.values[instant][place]);
            self.values[instant].push(value);
        }
        self.parts.push(part);
        self.changed.push((0, Rounded::exact(f64::NAN)));
        self.parts.len() - 1
    }

    #[inline]
    fn evaluated(&self, part: Part, instant: usize, at: impl Fn(usize) -> Rounded) -> Rounded {
        match part {
            Part::Named(place) => at(place),
            Part::Own(node) => node.value(&self.inputs[instant], at),
        }
    }

    /// Positions of the subexpressions of a formula, in the order of [`FormulaTree::parts`]. A subexpression is listed
    /// before its arguments.
    /// Formulas are numbered in the order in which they were added.
    #[must_use]
    pub fn places(&self, formula: usize) -> &[usize] {
        &self.formulas[formula]
    }

    /// Position of the subexpression with this name.
    #[must_use]
    pub fn named(&self, name: &str) -> Option<usize> {
        self.names.get(name).copied()
    }

    /// Positions of the arguments of a subexpression; empty for names and numbers.
    #[must_use]
    pub fn arguments(&self, place: usize) -> Vec<usize> {
        let Part::Own(node) = self.parts[place] else { return Vec::new() };
        match node.parts() {
            None => Vec::new(),
            Some([first, second]) if first == second && !matches!(node, Node::Pair(..)) => vec![first],
            Some(both) => both.to_vec(),
        }
    }

    /// A tree that refers to the unchanged subexpression at a position.
    pub fn placeholder(place: usize) -> FormulaTree {
        FormulaTree::name(format!("{PLACE}{place}"))
    }

    /// The position to which a name made by [`DerivationSheet::placeholder`] refers.
    #[must_use]
    pub fn placed(name: &str) -> Option<usize> {
        name.strip_prefix(PLACE)?.parse().ok()
    }

    /// The value of the unchanged subexpression at an instant.
    pub fn value(&self, place: usize, instant: usize) -> Rounded {
        self.values[instant][place]
    }

    /// The positions `places` and all later positions that depend on `places`, in the order of evaluation.
    pub fn depending(&mut self, places: &[usize]) -> Vec<usize> {
        let Some(&first) = places.iter().min() else { return Vec::new() };
        // This loop evaluates nothing. The visit of a subexpression therefore counts as a sixteenth of an operation.
        self.operations += (self.parts.len() - first) as u64 / 16;
        self.change += 1;
        let mut found = Vec::new();
        for place in first..self.parts.len() {
            let is_marked = |part: usize| part >= first && self.changed[part].0 == self.change;
            let depends = places.contains(&place)
                || match self.parts[place] {
                    Part::Named(part) => is_marked(part),
                    Part::Own(node) => node.parts().is_some_and(|parts| parts.into_iter().any(is_marked)),
                };
            if depends {
                self.changed[place].0 = self.change;
                found.push(place);
            }
        }
        found
    }

    /// The value of the last formula at an instant, after each tree of `changes` has replaced the subexpression at the
    /// tree's position.
    /// `depending` is the result of [`DerivationSheet::depending`] for the positions of `changes`.
    /// A name in a tree has the value NaN if it is not defined before the tree's position.
    pub fn changed(&mut self, changes: &[(usize, FormulaTree)], depending: &[usize], instant: usize) -> Rounded {
        self.change += 1;
        for &place in depending {
            let value = match changes.iter().find(|(own, _)| *own == place) {
                Some((_, tree)) => self.small(tree, place, instant),
                None => self.again(place, instant),
            };
            self.changed[place] = (self.change, value);
        }
        self.operations += depending.len() as u64 + 2;
        self.current(self.parts.len() - 1, instant)
    }

    /// The value of the last formula at an instant, if the first subexpression in `depending` has the value `number`.
    fn with_number(&mut self, number: Rounded, depending: &[usize], instant: usize) -> Rounded {
        self.change += 1;
        let Some((&first, rest)) = depending.split_first() else { return Rounded::exact(f64::NAN) };
        self.changed[first] = (self.change, number);
        for &place in rest {
            let value = self.again(place, instant);
            self.changed[place] = (self.change, value);
        }
        self.operations += rest.len() as u64 + 1;
        self.current(self.parts.len() - 1, instant)
    }

    fn again(&self, place: usize, instant: usize) -> Rounded {
        self.evaluated(self.parts[place], instant, |part| self.current(part, instant))
    }

    #[inline]
    fn current(&self, place: usize, instant: usize) -> Rounded {
        let (change, value) = self.changed[place];
        if change == self.change { value } else { self.values[instant][place] }
    }

    fn small(&mut self, tree: &FormulaTree, place: usize, instant: usize) -> Rounded {
        self.operations += 1;
        match &tree.shape {
            NodeShape::Number(value) => Rounded::decimal(*value),
            NodeShape::Name(name) => match DerivationSheet::placed(name).or_else(|| self.names.get(name).copied()) {
                Some(own) if own <= place => self.current(own, instant),
                Some(_) | None => Rounded::exact(f64::NAN),
            },
            NodeShape::Negative(part) => self.small(part, place, instant).negative(),
            NodeShape::Pair(operator, parts) => {
                let left = self.small(&parts[0], place, instant);
                Rounded::pair(*operator, left, self.small(&parts[1], place, instant))
            }
            NodeShape::Call(function, parts) => {
                let first = self.small(&parts[0], place, instant);
                let second = parts.get(1).map_or(first, |part| self.small(part, place, instant));
                Rounded::call(*function, [first, second])
            }
        }
    }

    /// Corrects a subexpression so that the last formula is correct at an instant. Returns the correction and its
    /// uncertainty. The correction is the amount to add to the subexpression (`Plus`) or the missing factor (`Times`).
    /// Newton's method starts at the correction `from`. `None` if the method finds no correction.
    /// `depending` is the result of [`DerivationSheet::depending`] for the position of the corrected subexpression.
    pub fn amount(
        &mut self,
        operator: Operator,
        depending: &[usize],
        instant: usize,
        from: f64,
        target: &FormulaTarget,
    ) -> Option<[f64; 2]> {
        let part = self.value(*depending.first()?, instant);
        let with = |amount: f64| Rounded::pair(operator, part, Rounded::exact(amount));
        let size = if operator == Operator::Plus { part.value.abs() } else { 1.0 };
        let mut amount = from;
        for _ in 0..STEPS {
            let least = if size > 0.0 { size } else { 1e-3 };
            let step = DIFFERENCE * if amount.abs() > least { amount.abs() } else { least };
            let here = self.with_number(with(amount), depending, instant).value;
            let beside = self.with_number(with(amount + step), depending, instant).value;
            let slope = (beside - here) / step;
            let change = target.difference(here) / slope;
            if slope == 0.0 || !change.is_finite() {
                return None;
            }
            amount -= change;
            let bound = (target.bound / slope).abs();
            if change.abs() <= 1e-13 * amount.abs() + bound {
                return Some([amount, 4.0 * bound + 1e-11 * amount.abs()]);
            }
        }
        None
    }
}
