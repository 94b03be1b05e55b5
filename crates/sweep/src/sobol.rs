//! Sobol's sequence, point by point.
//!
//! Source: S. Joe, F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci.
//! Comput. 30 (2008), 2635-2654, with the direction numbers of `new-joe-kuo-6`. Coordinates have 52 bits, and any point
//! is computed directly. Available libraries compute in single precision, or cannot compute a point without the points
//! before it.

/// Number of bits of a coordinate.
const BITS: usize = 52;

/// For each dimension after the first: the coefficients of the primitive polynomial, and the initial direction numbers.
/// The coefficients are the bits of one number. The polynomial's degree is the number of initial direction numbers.
const DIRECTIONS: [(u64, &[u64]); 39] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
    (1, &[1, 3, 3, 9, 7, 49]),
    (13, &[1, 1, 1, 15, 21, 21]),
    (16, &[1, 3, 1, 13, 27, 49]),
    (19, &[1, 1, 1, 15, 7, 5]),
    (22, &[1, 3, 1, 15, 13, 25]),
    (25, &[1, 1, 5, 5, 19, 61]),
    (1, &[1, 3, 7, 11, 23, 15, 103]),
    (4, &[1, 3, 7, 13, 13, 15, 69]),
    (7, &[1, 1, 3, 13, 7, 35, 63]),
    (8, &[1, 3, 5, 9, 1, 25, 53]),
    (14, &[1, 3, 1, 13, 9, 35, 107]),
    (19, &[1, 3, 1, 5, 27, 61, 31]),
    (21, &[1, 1, 5, 11, 19, 41, 61]),
    (28, &[1, 3, 5, 3, 3, 13, 69]),
    (31, &[1, 1, 7, 13, 1, 19, 1]),
    (32, &[1, 3, 7, 5, 13, 19, 59]),
    (37, &[1, 1, 3, 9, 25, 29, 41]),
    (41, &[1, 3, 5, 13, 23, 1, 55]),
    (42, &[1, 3, 7, 3, 13, 59, 17]),
    (50, &[1, 3, 1, 3, 5, 53, 69]),
    (55, &[1, 1, 5, 5, 23, 33, 13]),
    (56, &[1, 1, 7, 7, 1, 61, 123]),
    (59, &[1, 1, 7, 9, 13, 61, 49]),
    (62, &[1, 3, 3, 5, 3, 55, 33]),
    (14, &[1, 3, 1, 15, 31, 13, 49, 245]),
    (21, &[1, 3, 5, 15, 31, 59, 63, 97]),
    (22, &[1, 3, 1, 11, 11, 11, 77, 249]),
];

/// Largest number of dimensions.
pub(crate) const MOST: usize = DIRECTIONS.len() + 1;

/// Direction numbers of some dimensions.
#[derive(Clone, Debug)]
pub(crate) struct Sobol(Vec<[u64; BITS]>);

impl Sobol {
    /// The sequence in `dimensions` dimensions, at most [`MOST`].
    pub(crate) fn of(dimensions: usize) -> Sobol {
        let first = std::array::from_fn(|bit| 1 << (BITS - 1 - bit));
        let further = DIRECTIONS.iter().map(|(coefficients, initial)| directions(*coefficients, initial));
        Sobol(std::iter::once(first).chain(further).take(dimensions).collect())
    }

    /// The coordinate `dimension` of the point `index`, as a 52-bit integer.
    pub(crate) fn bits(&self, index: u64, dimension: usize) -> u64 {
        // The index is converted to a Gray code: consecutive points then differ in one direction number.
        let (mut gray, mut sum) = (index ^ (index >> 1), 0);
        while gray != 0 {
            sum ^= self.0[dimension][gray.trailing_zeros() as usize];
            gray &= gray - 1;
        }
        sum
    }
}

fn directions(coefficients: u64, initial: &[u64]) -> [u64; BITS] {
    let degree = initial.len();
    let mut all = [0; BITS];
    for bit in 0..BITS {
        all[bit] = match initial.get(bit) {
            Some(number) => number << (BITS - 1 - bit),
            None => {
                let mut own = all[bit - degree] ^ (all[bit - degree] >> degree);
                for k in 1..degree {
                    own ^= (coefficients >> (degree - 1 - k) & 1) * all[bit - k];
                }
                own
            }
        };
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first points of the sequence as the authors' program prints them (`sobol 10 3 new-joe-kuo-6.21201`).
    #[test]
    fn val_joe_kuo_first_points() {
        let sobol = Sobol::of(3);
        let expected = [
            [0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
            [0.625, 0.125, 0.875],
            [0.125, 0.625, 0.375],
            [0.1875, 0.3125, 0.9375],
            [0.6875, 0.8125, 0.4375],
        ];
        for (index, expected) in expected.into_iter().enumerate() {
            let found = [0, 1, 2].map(|of| sobol.bits(index as u64, of) as f64 / (1u64 << BITS) as f64);
            assert_eq!(found, expected, "point {index}");
        }
    }

    /// In every dimension, the range from 0 to 1 is divided into 2^k equal intervals. Each interval contains exactly
    /// one of the first 2^k points.
    #[test]
    fn every_dimension_is_stratified() {
        let sobol = Sobol::of(MOST);
        for dimension in 0..MOST {
            let mut hit = [false; 1 << 10];
            (0..1 << 10).for_each(|index| hit[(sobol.bits(index, dimension) >> (BITS - 10)) as usize] = true);
            assert!(hit.iter().all(|hit| *hit), "dimension {dimension}");
        }
    }
}
