//! A number with a bound on its error.

use crate::tree::{Function, Operator};

/// A number with a bound on its error.
/// Every operation propagates the errors of its arguments and adds the operation's own rounding error.
///
/// An operation outside its domain gives [`Rounded::UNDEFINED`], and so does every operation on an undefined number.
/// Unlike in IEEE 754, `1/(1/0)`, `(0/0)^0` and `atan(1/0)` have no value.
/// If an argument is outside the domain by less than its error, the end of the domain is used instead.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Rounded {
    /// The number; NaN if the number is undefined.
    pub value: f64,
    /// Largest distance of the exact number from `value`; infinite if the distance has no known limit.
    pub error: f64,
}

/// Rounding error of an IEEE 754 operation: half a unit in the last place.
const HALF: f64 = f64::EPSILON / 2.0;
/// Rounding error of a function of the system library. The error is less than one unit in the last place; as a margin,
/// two units are assumed.
const WHOLE: f64 = 2.0 * f64::EPSILON;

impl Rounded {
    /// Result of an operation outside its domain.
    pub const UNDEFINED: Self = Rounded { value: f64::NAN, error: f64::INFINITY };
    /// An unknown number: the result is too large for a double, or the divisor may be zero.
    pub const UNKNOWN: Self = Rounded { value: 0.0, error: f64::INFINITY };

    /// A number that is exact.
    pub const fn exact(value: f64) -> Self {
        Rounded { value, error: 0.0 }
    }

    /// The double of a decimal number: exact if the number is whole, otherwise with an error of half a unit in the last
    /// place.
    pub fn decimal(value: f64) -> Self {
        let is_whole = value.fract() == 0.0 && value.abs() < 9e15;
        Rounded { value, error: if is_whole { 0.0 } else { HALF * value.abs() } }
    }

    /// A number with an error of one unit in the last place.
    pub fn nearly(value: f64) -> Self {
        Rounded { value, error: f64::EPSILON * value.abs() }
    }

    fn of(value: f64, error: f64, rounding: f64) -> Self {
        if !value.is_finite() {
            return Rounded::UNKNOWN;
        }
        let error = error + rounding * value.abs();
        // Zero times an unknown (infinite) error is NaN. In this case the error of the result is infinite too.
        Rounded { value, error: if error.is_nan() { f64::INFINITY } else { error } }
    }

    /// Adds the error of underflow to a result that may be too small for a double.
    /// If the result is exactly zero (`is_zero`), it has no such error.
    fn or_tiny(self, is_zero: bool) -> Self {
        match self.value.abs() < f64::MIN_POSITIVE && !is_zero {
            true => Rounded { error: self.error + f64::MIN_POSITIVE, ..self },
            false => self,
        }
    }

    /// Whether the number comes from an operation outside its domain, directly or through later operations.
    #[must_use]
    pub fn is_undefined(self) -> bool {
        self.value.is_nan()
    }

    /// The number; NaN if it is undefined, or if nothing is known of it, for example after an overflow.
    #[must_use]
    pub fn known(self) -> f64 {
        if self.error.is_finite() { self.value } else { f64::NAN }
    }

    /// Whether the number is exactly zero.
    fn is_zero(self) -> bool {
        self.value == 0.0 && self.error == 0.0
    }

    /// The negative.
    pub fn negative(self) -> Self {
        Rounded { value: -self.value, error: self.error }
    }

    /// Result of an operator on two numbers.
    #[inline]
    pub fn pair(operator: Operator, a: Self, b: Self) -> Self {
        if !a.value.is_finite() || !b.value.is_finite() {
            return Rounded::UNDEFINED;
        }
        match operator {
            Operator::Plus => Rounded::of(a.value + b.value, a.error + b.error, HALF),
            Operator::Minus => Rounded::of(a.value - b.value, a.error + b.error, HALF),
            Operator::Times => {
                let error = a.value.abs() * b.error + b.value.abs() * a.error + a.error * b.error;
                Rounded::of(a.value * b.value, error, HALF).or_tiny(a.value == 0.0 || b.value == 0.0)
            }
            Operator::Over if b.is_zero() => Rounded::UNDEFINED,
            Operator::Over => {
                let value = a.value / b.value;
                let least = b.value.abs() - b.error;
                let error = if least > 0.0 { (a.error + value.abs() * b.error) / least } else { f64::INFINITY };
                Rounded::of(value, error, HALF).or_tiny(a.value == 0.0)
            }
            Operator::Power => power(a, b),
        }
    }

    /// Result of a function for these arguments.
    pub fn call(function: Function, arguments: [Self; 2]) -> Self {
        let [x, other] = arguments;
        if !x.value.is_finite() || !other.value.is_finite() {
            return Rounded::UNDEFINED;
        }
        match function {
            Function::Sin => {
                let (sine, cosine) = x.value.sin_cos();
                Rounded::of(sine, swing(x, cosine), WHOLE)
            }
            Function::Cos => {
                let (sine, cosine) = x.value.sin_cos();
                Rounded::of(cosine, swing(x, sine), WHOLE)
            }
            Function::Tan => {
                let value = x.value.tan();
                // The slope is taken at the end of the argument's interval that is nearer to a pole, because the
                // function is steepest there.
                let steepest = value.abs() + x.error * (1.0 + value * value) * 2.0;
                let is_near = !(x.error * (1.0 + value.abs()) < 0.1);
                let error = if is_near { f64::INFINITY } else { x.error * (1.0 + steepest * steepest) };
                Rounded::of(value, error, WHOLE)
            }
            Function::Asin | Function::Acos if x.value.abs() - x.error > 1.0 => Rounded::UNDEFINED,
            Function::Asin | Function::Acos => {
                let of = |value: f64| if function == Function::Asin { value.asin() } else { value.acos() };
                let end = x.value.abs() + x.error;
                if end < 1.0 {
                    // The function is steepest at the ends of its domain, so the slope is taken at the argument's
                    // largest possible absolute value.
                    return Rounded::of(of(x.value), x.error / ((1.0 - end) * (1.0 + end)).sqrt(), WHOLE);
                }
                growing(of, x, [-1.0, 1.0])
            }
            Function::Atan => {
                let near = not_below_zero(x.value.abs() - x.error);
                Rounded::of(x.value.atan(), x.error / (1.0 + near * near), WHOLE)
            }
            Function::Sqrt if x.value > x.error => {
                let root = x.value.sqrt();
                Rounded::of(root, x.error / (root + (x.value - x.error).sqrt()), HALF)
            }
            Function::Sqrt if x.value + x.error < 0.0 => Rounded::UNDEFINED,
            Function::Sqrt => growing(f64::sqrt, x, [0.0, f64::INFINITY]),
            Function::Exp => {
                let value = x.value.exp();
                Rounded::of(value, value * x.error.exp_m1(), WHOLE).or_tiny(false)
            }
            Function::Ln if x.value > x.error => Rounded::of(x.value.ln(), x.error / (x.value - x.error), WHOLE),
            Function::Ln if x.value + x.error <= 0.0 => Rounded::UNDEFINED,
            Function::Ln => growing(f64::ln, x, [0.0, f64::INFINITY]),
            Function::Abs => Rounded { value: x.value.abs(), error: x.error },
            Function::Sign => {
                let error = if x.value.abs() > x.error || x.error == 0.0 { 0.0 } else { 2.0 };
                let value = if x.value == 0.0 { 0.0 } else { x.value.signum() };
                Rounded { value, error }
            }
            Function::Atan2 if x.is_zero() && other.is_zero() => Rounded::UNDEFINED,
            Function::Atan2 => {
                let (y, x) = (x, other);
                let nearest = y.value.hypot(x.value) - y.error.hypot(x.error);
                let error = match nearest > 0.0 {
                    true => (x.value.abs() * y.error + y.value.abs() * x.error + y.error * x.error) / nearest.powi(2),
                    false => std::f64::consts::PI,
                };
                Rounded::of(y.value.atan2(x.value), error, WHOLE).or_tiny(y.value == 0.0)
            }
        }
    }
}

/// Error of a sine or cosine at `x`. `slope` is the slope of the sine or cosine at `x`.
fn swing(x: Rounded, slope: f64) -> f64 {
    let least = |bound: f64, other: f64| if other < bound { other } else { bound };
    least(least(slope.abs() * x.error + x.error * x.error / 2.0, x.error), 2.0)
}

/// The number, or zero if the number is negative. NaN stays NaN.
fn not_below_zero(number: f64) -> f64 {
    if number < 0.0 { 0.0 } else { number }
}

/// The larger of two magnitudes; infinite if one of them is NaN.
fn larger(one: f64, other: f64) -> f64 {
    match one.is_nan() || other.is_nan() {
        true => f64::INFINITY,
        false if one >= other => one,
        false => other,
    }
}

/// Value of a function that is monotonic from `domain[0]` to `domain[1]`.
/// The values at the two ends of the argument's interval differ from the value at the argument.
/// The error is the larger of the two differences.
/// If the argument is outside the domain by less than its error, the end of the domain is used instead.
fn growing(function: impl Fn(f64) -> f64, x: Rounded, domain: [f64; 2]) -> Rounded {
    let at = |value: f64| function(value.clamp(domain[0], domain[1]));
    let value = at(x.value);
    if x.error == 0.0 {
        return Rounded::of(value, 0.0, WHOLE);
    }
    let [below, above] = [at(x.value - x.error) - value, at(x.value + x.error) - value].map(f64::abs);
    Rounded::of(value, larger(below, above), WHOLE)
}

/// Largest absolute value of a whole exponent for which a power is computed as a product.
/// The rounding error of the product grows with every factor.
const FACTORS: f64 = 1024.0;

fn power(a: Rounded, b: Rounded) -> Rounded {
    let is_whole = b.error == 0.0 && b.value.fract() == 0.0;
    if is_whole && a.is_zero() && b.value < 0.0 {
        return Rounded::UNDEFINED;
    }
    if is_whole && b.value.abs() <= FACTORS {
        let power = b.value as i32;
        let rounding = WHOLE * (1.0 + b.value.abs());
        let found = match power {
            2 => Rounded::of(a.value * a.value, a.error * (2.0 * a.value.abs() + a.error), HALF),
            _ if a.error == 0.0 || power == 0 => Rounded::of(a.value.powi(power), 0.0, rounding),
            _ => {
                // The error uses the steepest slope. The slope is steepest where the base is largest, or, for a
                // negative exponent, where the base is smallest.
                let end = if power >= 0 { a.value.abs() + a.error } else { a.value.abs() - a.error };
                let is_open = power < 0 && !(end > 0.0);
                let slope = if is_open { f64::INFINITY } else { b.value.abs() * end.powi(power - 1) };
                Rounded::of(a.value.powi(power), slope * a.error, rounding)
            }
        };
        return found.or_tiny(a.value == 0.0);
    }
    let has_whole = is_whole || (b.value + b.error).floor() >= (b.value - b.error).ceil();
    match () {
        () if a.value + a.error < 0.0 && !has_whole => return Rounded::UNDEFINED,
        () if a.value + a.error < 0.0 && !is_whole => return Rounded::UNKNOWN,
        () if a.is_zero() && b.value + b.error < 0.0 => return Rounded::UNDEFINED,
        () if a.is_zero() && b.value - b.error <= 0.0 => return Rounded::UNKNOWN,
        () => {}
    }
    // A base that is negative by less than its error counts as zero.
    let base = if a.value < 0.0 && a.value + a.error >= 0.0 { 0.0 } else { a.value };
    let value = base.powf(b.value);
    if a.error == 0.0 && b.error == 0.0 {
        return Rounded::of(value, 0.0, 4.0 * WHOLE).or_tiny(base == 0.0);
    }
    // The absolute value of the power is monotonic in the base's absolute value and in the exponent.
    // The largest change is therefore at one of the four corners of the two intervals.
    let sign = if value < 0.0 { -1.0 } else { 1.0 };
    let mut error = 0.0;
    for base in [a.value - a.error, a.value + a.error] {
        for exponent in [b.value - b.error, b.value + b.error] {
            let base = if is_whole { base.abs() } else { not_below_zero(base) };
            error = larger(error, (sign * base.powf(exponent) - value).abs());
        }
    }
    Rounded::of(value, error, 4.0 * WHOLE).or_tiny(base == 0.0)
}
