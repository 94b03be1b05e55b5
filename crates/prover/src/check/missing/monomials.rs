//! Products of powers of known quantities, in the form in which a formula may contain them.

use crate::check::dimension::{Dimensions, Known};
use formula::{FormulaTree, Function, NodeShape, Operator, Product, Products, information};
use scenario::Formulas;

/// Largest number of quantities that are combined into products.
const MOST: usize = 14;
/// Largest number of different products kept for one value.
const SIMPLEST: usize = 100;

/// All products of known quantities. A search by value finds the products that equal a number.
pub(in crate::check) struct Monomials {
    quantities: Vec<(FormulaTree, f64)>,
    products: Products,
}

impl Monomials {
    /// Builds the products of the parameters, of constant steps before `formula`, and of sines and cosines of constant
    /// angles.
    pub(in crate::check) fn of(
        formulas: &Formulas,
        formula: usize,
        steps: &[(String, f64)],
        dimensions: &Dimensions,
    ) -> Self {
        let known = |own: &scenario::Parameter| {
            let (_, number) = own.names().find(|(name, _)| *name == own.quantity())?;
            Some((FormulaTree::name(own.quantity()), number.value))
        };
        let mut quantities: Vec<(FormulaTree, f64)> = vec![(FormulaTree::name("pi"), std::f64::consts::PI)];
        quantities.extend(formulas.parameters.iter().filter_map(known));
        quantities.extend(steps.iter().map(|(name, value)| (FormulaTree::name(name.as_str()), *value)));
        quantities.extend(calls(formulas, formula));
        quantities.retain(|(_, value)| *value != 0.0);
        quantities.truncate(MOST);
        let valued: Vec<(f64, Known)> =
            quantities.iter().map(|(tree, value)| (*value, dimensions.of_constant(tree))).collect();
        Monomials { products: Products::of(&valued), quantities }
    }

    /// Number of products. The work of building them is proportional to this number.
    pub(in crate::check) fn len(&self) -> usize {
        self.products.len()
    }

    /// Returns the products that equal `value` within the relative accuracy `accuracy`, each with its complexity. The
    /// simplest products come first, and the number of products is limited.
    pub(in crate::check) fn with_value(&self, value: f64, accuracy: f64) -> Vec<(FormulaTree, usize)> {
        let near = self.products.near(value.abs(), accuracy).into_iter().take(SIMPLEST);
        near.map(|own| (self.tree(own, own.is_negative != (value < 0.0)), own.weight)).collect()
    }

    /// Returns two numbers. The first number counts the products of this dimension whose complexity is at most
    /// `weight`.
    /// The second is the expected number of these products that match `value` by chance within `accuracy`.
    pub(in crate::check) fn by_chance(
        &self,
        value: f64,
        accuracy: f64,
        weight: usize,
        dimension: Known,
    ) -> (usize, f64) {
        let alike = self.products.alike(weight, dimension);
        (alike, alike as f64 * (-information(value, accuracy)).exp2())
    }

    fn tree(&self, product: &Product, is_negative: bool) -> FormulaTree {
        let power = |&(index, exponent): &(u8, i8)| {
            let own = self.quantities[usize::from(index)].0.clone();
            match exponent.abs() {
                1 => own,
                size => FormulaTree::pair(Operator::Power, own, FormulaTree::number(f64::from(size))),
            }
        };
        let times = |one: FormulaTree, other: FormulaTree| FormulaTree::pair(Operator::Times, one, other);
        let of = |is_above: bool| {
            let powers = product.powers.iter().filter(move |(_, exponent)| (*exponent > 0) == is_above);
            powers.map(power)
        };
        // A fractional coefficient is written as a quotient: one half times `a` is written as `a/2`.
        let is_whole = |below: &f64| (below * product.number).fract() == 0.0;
        let below = [1.0, 2.0, 3.0, 4.0, 8.0].into_iter().find(is_whole).unwrap_or(1.0);
        let above = below * product.number;
        let number = |value: f64| (value != 1.0).then(|| FormulaTree::number(value));
        let above = number(above).into_iter().chain(of(true)).reduce(times).unwrap_or(FormulaTree::number(1.0));
        let size = number(below)
            .into_iter()
            .chain(of(false))
            .fold(above, |tree, part| FormulaTree::pair(Operator::Over, tree, part));
        if is_negative { size.negative() } else { size }
    }
}

/// Sines and cosines of constants that occur in the formula `formula` and in the formulas before it.
fn calls(formulas: &Formulas, formula: usize) -> Vec<(FormulaTree, f64)> {
    let mut found: std::collections::BTreeMap<String, FormulaTree> = std::collections::BTreeMap::new();
    let mut put = |part: &FormulaTree| {
        found.entry(part.to_string()).or_insert_with(|| part.clone());
    };
    for own in &formulas.list[..=formula] {
        crate::check::slips::at_every_place(&own.tree, &mut |_, part| {
            // Only a name is accepted as argument, because each angle given in a drawing is a single parameter.
            if let NodeShape::Call(Function::Sin | Function::Cos, arguments) = &part.shape
                && matches!(arguments[0].shape, NodeShape::Name(_))
            {
                put(part);
            }
        });
    }
    // Adds the sines and cosines of all angles in the file, even if no formula uses them.
    for own in formulas.parameters.iter().filter(|own| own.is_angle()) {
        put(&FormulaTree::call(Function::Cos, vec![FormulaTree::name(own.quantity())]));
        put(&FormulaTree::call(Function::Sin, vec![FormulaTree::name(own.quantity())]));
    }
    let mut graph = formulas.graph.clone();
    let constant = |tree: FormulaTree| {
        let id = graph.add(&tree).ok()?;
        let value = graph.constant_of(id)?.value;
        value.is_finite().then_some((tree, value))
    };
    found.into_values().filter_map(constant).collect()
}
