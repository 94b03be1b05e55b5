//! Products of powers of known quantities, to be recognised by their value.

use crate::scenario::Formulas;
use formula::{Function, Operator, Program, Rounded, Shape, Tree};

/// Most quantities that products are made of.
const MOST: usize = 14;
/// Numbers that derivations have as factors, with what they add to the complexity.
const NUMBERS: [(f64, usize); 9] =
    [(1.0, 0), (2.0, 1), (0.5, 1), (4.0, 4), (0.25, 4), (1.5, 4), (3.0, 5), (1.0 / 3.0, 5), (0.125, 5)];

/// Most products of one value that are told apart.
const SIMPLEST: usize = 100;

/// A product of powers of quantities, times a number.
#[derive(Clone, Debug)]
struct Product {
    /// Its size.
    value: f64,
    is_negative: bool,
    weight: usize,
    number: f64,
    /// Indices of quantities with their exponents.
    powers: Vec<(u8, i8)>,
}

/// All products, by their value.
pub(in crate::claims) struct Monomials {
    quantities: Vec<(Tree, f64)>,
    products: Vec<Product>,
}

impl Monomials {
    /// Of the parameters, of steps before `formula` that do not change, and of sine and cosine of constant angles.
    pub(in crate::claims) fn of(formulas: &Formulas, formula: usize, steps: &[(String, f64)]) -> Self {
        let known = |own: &crate::scenario::Parameter| {
            let (_, number) = own.names().find(|(name, _)| *name == own.quantity())?;
            Some((Tree::name(own.quantity()), number.value))
        };
        let mut quantities: Vec<(Tree, f64)> = vec![(Tree::name("pi"), std::f64::consts::PI)];
        quantities.extend(formulas.parameters.iter().filter_map(known));
        quantities.extend(steps.iter().map(|(name, value)| (Tree::name(name.as_str()), *value)));
        quantities.extend(calls(formulas, formula));
        quantities.retain(|(_, value)| *value != 0.0);
        quantities.truncate(MOST);
        let mut products = Vec::new();
        put(&quantities, 0, &mut Vec::new(), &mut products);
        products.sort_by(|one, other| one.value.total_cmp(&other.value));
        Monomials { quantities, products }
    }

    /// Products with this value, to this relative accuracy, with their complexity; the simplest first, and not too many.
    pub(in crate::claims) fn with_value(&self, value: f64, accuracy: f64) -> Vec<(Tree, usize)> {
        let size = value.abs();
        let [low, high] = [size * (1.0 - accuracy), size * (1.0 + accuracy)];
        let first = self.products.partition_point(|own| own.value < low);
        let near = self.products[first..].iter().take_while(|own| own.value <= high);
        let mut near: Vec<&Product> = near.collect();
        near.sort_by_key(|own| own.weight);
        near.truncate(SIMPLEST);
        near.into_iter().map(|own| (self.tree(own, own.is_negative != (value < 0.0)), own.weight)).collect()
    }

    fn tree(&self, product: &Product, is_negative: bool) -> Tree {
        let power = |&(index, exponent): &(u8, i8)| {
            let own = self.quantities[usize::from(index)].0.clone();
            match exponent.abs() {
                1 => own,
                size => Tree::pair(Operator::Power, own, Tree::number(f64::from(size))),
            }
        };
        let times = |one: Tree, other: Tree| Tree::pair(Operator::Times, one, other);
        let of = |is_above: bool| {
            let powers = product.powers.iter().filter(move |(_, exponent)| (*exponent > 0) == is_above);
            powers.map(power)
        };
        // Halves and thirds stand below the stroke, as they are written.
        let is_whole = |below: &f64| (below * product.number).fract() == 0.0;
        let below = [1.0, 2.0, 3.0, 4.0, 8.0].into_iter().find(is_whole).unwrap_or(1.0);
        let above = below * product.number;
        let number = |value: f64| (value != 1.0).then(|| Tree::number(value));
        let above = number(above).into_iter().chain(of(true)).reduce(times).unwrap_or(Tree::number(1.0));
        let size =
            number(below).into_iter().chain(of(false)).fold(above, |tree, part| Tree::pair(Operator::Over, tree, part));
        if is_negative { size.negative() } else { size }
    }
}

/// Sine and cosine of names that do not change, as formulas up to this one have them.
fn calls(formulas: &Formulas, formula: usize) -> Vec<(Tree, f64)> {
    let mut found: Vec<Tree> = Vec::new();
    for own in &formulas.list[..=formula] {
        crate::claims::slips::at_every_place(&own.tree, &mut |_, part| {
            if let Shape::Call(Function::Sin | Function::Cos, _) = &part.shape
                && !found.iter().any(|own| own.to_string() == part.to_string())
            {
                found.push(part.clone());
            }
        });
    }
    // Angles of the file, not only those that formulas take the cosine of.
    for own in formulas.parameters.iter().filter(|own| own.is_angle()) {
        found.push(Tree::call(Function::Cos, vec![Tree::name(own.quantity())]));
        found.push(Tree::call(Function::Sin, vec![Tree::name(own.quantity())]));
    }
    let mut graph = formulas.graph.clone();
    let constant = |tree: Tree| {
        let id = graph.add(&tree).ok()?;
        let value = Program::of(&graph, &[id]).run(&[Rounded::exact(f64::NAN); 2])[0].value;
        value.is_finite().then_some((tree, value))
    };
    found.into_iter().filter_map(constant).collect()
}

/// Adds all products of up to three of the quantities from `next` on to those chosen.
fn put(quantities: &[(Tree, f64)], next: usize, chosen: &mut Vec<(u8, i8)>, products: &mut Vec<Product>) {
    let value: f64 = chosen.iter().map(|&(index, power)| quantities[usize::from(index)].1.powi(power.into())).product();
    // The square of one quantity is simpler than a product of two.
    let weight: usize = chosen.iter().map(|(_, power)| 1 + usize::from(power.unsigned_abs())).sum();
    for (number, more) in NUMBERS {
        let (size, is_negative) = (number * value.abs(), value < 0.0);
        products.push(Product { value: size, is_negative, weight: weight + more, number, powers: chosen.clone() });
    }
    if chosen.len() == 3 {
        return;
    }
    for index in next..quantities.len() {
        for power in [1, -1, 2, -2] {
            chosen.push((index as u8, power));
            put(quantities, index + 1, chosen, products);
            chosen.pop();
        }
    }
}
