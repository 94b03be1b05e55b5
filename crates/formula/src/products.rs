//! Products of powers of known quantities, for recognising a number by its value.

/// Typical numeric factors in derivations, each with its contribution to the complexity.
const NUMBERS: [(f64, usize); 9] =
    [(1.0, 0), (2.0, 1), (0.5, 1), (4.0, 4), (0.25, 4), (1.5, 4), (3.0, 5), (1.0 / 3.0, 5), (0.125, 5)];
/// Upper limit of the number of quantities in a product.
const FACTORS: usize = 3;

/// Exponents of kilogram, metre and second; `None` if unknown.
type Dimension = Option<[f64; 3]>;

/// A product of powers of quantities, times a number.
#[derive(Clone, Debug)]
pub struct Product {
    /// Absolute value of the product.
    pub value: f64,
    /// Whether the product is negative.
    pub is_negative: bool,
    /// Complexity of the product. A quantity or its reciprocal adds 2, a square or its reciprocal 3, and the numeric
    /// factor 0 to 5.
    pub weight: usize,
    /// The numeric factor.
    pub number: f64,
    /// Indices of quantities with their exponents.
    pub powers: Vec<(u8, i8)>,
    /// Dimension of the product.
    pub dimension: Dimension,
}

/// All products of up to three quantities, sorted by the value of the product.
#[derive(Clone, Debug)]
pub struct Products {
    list: Vec<Product>,
}

impl Products {
    /// The products of the quantities with the given values and dimensions; at most 255 quantities.
    #[must_use]
    pub fn of(quantities: &[(f64, Dimension)]) -> Self {
        let mut list = Vec::new();
        put(&quantities[..quantities.len().min(255)], 0, &mut Vec::new(), &mut list);
        list.sort_by(|one: &Product, other| one.value.total_cmp(&other.value));
        Products { list }
    }

    /// Number of all products.
    #[must_use]
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there are no products.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The products whose absolute value is `size` to within the relative `accuracy`, the simplest product first.
    #[must_use]
    pub fn near(&self, size: f64, accuracy: f64) -> Vec<&Product> {
        let [low, high] = [size * (1.0 - accuracy), size * (1.0 + accuracy)];
        let first = self.list.partition_point(|own| own.value < low);
        let mut near: Vec<&Product> = self.list[first..].iter().take_while(|own| own.value <= high).collect();
        near.sort_by_key(|own| own.weight);
        near
    }

    /// Number of products of the given dimension up to the given complexity. An unknown dimension matches any
    /// dimension.
    #[must_use]
    pub fn alike(&self, weight: usize, dimension: Dimension) -> usize {
        let is_alike = |own: &&Product| match (own.dimension, dimension) {
            (Some(own), Some(other)) => own == other,
            _ => true,
        };
        self.list.iter().filter(|own| own.weight <= weight).filter(is_alike).count()
    }
}

/// Adds the product of the chosen powers of quantities. Also adds all products of these with powers of the quantities
/// from index `next` on.
fn put(quantities: &[(f64, Dimension)], next: usize, chosen: &mut Vec<(u8, i8)>, products: &mut Vec<Product>) {
    let value: f64 = chosen.iter().map(|&(index, power)| quantities[usize::from(index)].0.powi(power.into())).product();
    let dimension = chosen.iter().try_fold([0.0; 3], |sum: [f64; 3], &(index, power)| {
        let own = quantities[usize::from(index)].1?;
        Some([0, 1, 2].map(|axis: usize| sum[axis] + f64::from(power) * own[axis]))
    });
    // The square of one quantity has a smaller weight than a product of two quantities.
    let weight: usize = chosen.iter().map(|(_, power)| 1 + usize::from(power.unsigned_abs())).sum();
    for (number, more) in NUMBERS {
        let (value, is_negative) = (number * value.abs(), value < 0.0);
        products.push(Product { value, is_negative, weight: weight + more, number, powers: chosen.clone(), dimension });
    }
    if chosen.len() == FACTORS {
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

/// Information (bits) in a number that is known to a relative accuracy. For example, 1/60 has 3 bits and 1.4715 has 13.
/// A round number, a simple fraction, or a simple fraction of pi has few bits. Any other number has the bits of its
/// accuracy, which are `-log2(accuracy)`.
/// A number with few bits is easily matched by chance.
#[must_use]
pub fn information(value: f64, accuracy: f64) -> f64 {
    let most = -(if accuracy > 1e-15 { accuracy } else { 1e-15 }).log2();
    let mut least = most;
    for (power, more) in [(0, 0.0), (1, 2.0), (-1, 2.0), (2, 3.0), (-2, 3.0)] {
        let factor = std::f64::consts::PI.powi(power);
        for below in 1..=180_u32 {
            let Some(digits) = whole(value.abs() * factor * f64::from(below), accuracy) else { continue };
            let bits = more + digits.log2() + f64::from(below).log2();
            least = if bits < least { bits } else { least };
        }
    }
    least
}

/// The digits of a decimal number as a whole number, without leading and trailing zeros. At most nine digits are
/// allowed.
fn whole(value: f64, accuracy: f64) -> Option<f64> {
    if !(value > 0.0) || !value.is_finite() {
        return None;
    }
    let mut scaled = value / 10f64.powf(value.log10().floor());
    for _ in 0..9 {
        let round = scaled.round();
        if (scaled - round).abs() <= accuracy * scaled {
            return Some(round);
        }
        scaled *= 10.0;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::{Products, information};

    #[test]
    fn round_numbers_carry_little_information() {
        for (value, bits) in [(1.0, 0.0), (60.0, 2.6), (1.0 / 60.0, 2.6), (1.4715, 12.5), (std::f64::consts::TAU, 3.0)]
        {
            let found = information(value, 1e-9);
            assert!((found - bits).abs() < 0.1, "{value}: {found}");
        }
        assert!(information(0.123_456_789_123, 1e-10) > 30.0);
    }

    #[test]
    fn a_product_is_recognised_with_its_dimension() {
        let (mass, length) = ((5.0, Some([1.0, 0.0, 0.0])), (0.03, Some([0.0, 1.0, 0.0])));
        let products = Products::of(&[mass, length]);
        let found = products.near(5.0 * 0.03 * 0.03, 1e-12);
        assert_eq!(
            (found[0].powers.as_slice(), found[0].dimension),
            ([(0, 1), (1, 2)].as_slice(), Some([1.0, 2.0, 0.0]))
        );
        for size in [0.0045 * (1.0 + 0.9e-6), 0.0045 * (1.0 - 0.9e-6)] {
            assert_eq!(products.near(size, 1e-6)[0].powers, [(0, 1), (1, 2)], "{size}");
            assert!(products.near(size, 1e-7).is_empty(), "{size}");
        }
        // The products are m, 1/m, l, 1/l and so on, with the numeric factors. Few of the products have the dimension
        // of a mass.
        assert_eq!(products.alike(2, Some([1.0, 0.0, 0.0])), 1);
        assert_eq!(products.alike(3, Some([1.0, 0.0, 0.0])), 3);
    }
}
