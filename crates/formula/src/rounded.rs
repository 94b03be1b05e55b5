//! A number, and how far it may be from the exact one.

use crate::function::Function;
use crate::tree::Operator;

/// A number with a bound on its error. Every operation passes the errors of its arguments on and adds its own rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounded {
    /// The number.
    pub value: f64,
    /// How far the exact number may be from it. Infinite where nothing is known.
    pub error: f64,
}

/// Rounding of an operation of IEEE 754: half a unit in the last place.
const HALF: f64 = f64::EPSILON / 2.0;
/// Rounding of a function of the system's library: below a unit in the last place, with a margin.
const WHOLE: f64 = 2.0 * f64::EPSILON;

impl Rounded {
    /// A number that is exact.
    #[must_use]
    pub const fn exact(value: f64) -> Self {
        Rounded { value, error: 0.0 }
    }

    /// A number that stands for a decimal one: exact if it is whole, else with half a unit in the last place.
    #[must_use]
    pub fn decimal(value: f64) -> Self {
        let is_whole = value.fract() == 0.0 && value.abs() < 9e15;
        Rounded { value, error: if is_whole { 0.0 } else { HALF * value.abs() } }
    }

    /// A number with a unit in the last place.
    #[must_use]
    pub fn nearly(value: f64) -> Self {
        Rounded { value, error: f64::EPSILON * value.abs() }
    }

    fn of(value: f64, error: f64, rounding: f64) -> Self {
        Rounded { value, error: error + rounding * value.abs() }
    }

    /// The negative.
    #[must_use]
    pub fn negative(self) -> Self {
        Rounded { value: -self.value, error: self.error }
    }

    /// What an operator makes of two numbers.
    #[must_use]
    pub fn pair(operator: Operator, a: Self, b: Self) -> Self {
        match operator {
            Operator::Plus => Rounded::of(a.value + b.value, a.error + b.error, HALF),
            Operator::Minus => Rounded::of(a.value - b.value, a.error + b.error, HALF),
            Operator::Times => {
                let error = a.value.abs() * b.error + b.value.abs() * a.error + a.error * b.error;
                Rounded::of(a.value * b.value, error, HALF)
            }
            Operator::Over => {
                let value = a.value / b.value;
                let least = b.value.abs() - b.error;
                let error = match least > 0.0 {
                    true => (a.error + value.abs() * b.error) / least,
                    false => f64::INFINITY,
                };
                Rounded::of(value, error, HALF)
            }
            Operator::Power => power(a, b),
        }
    }

    /// What a function makes of its arguments.
    #[must_use]
    pub fn call(function: Function, arguments: [Self; 2]) -> Self {
        let [x, other] = arguments;
        match function {
            Function::Sin => Rounded::of(x.value.sin(), swing(x, x.value.cos()), WHOLE),
            Function::Cos => Rounded::of(x.value.cos(), swing(x, x.value.sin()), WHOLE),
            Function::Tan => {
                // Between two poles the tangent grows.
                let pole = x.value.cos().abs() <= x.error.min(1.0);
                if pole {
                    Rounded { value: x.value.tan(), error: f64::INFINITY }
                } else {
                    growing(f64::tan, x, [f64::NEG_INFINITY, f64::INFINITY])
                }
            }
            Function::Asin => growing(f64::asin, x, [-1.0, 1.0]),
            Function::Acos => growing(f64::acos, x, [-1.0, 1.0]),
            Function::Atan => growing(f64::atan, x, [f64::NEG_INFINITY, f64::INFINITY]),
            Function::Sqrt => growing(f64::sqrt, x, [0.0, f64::INFINITY]),
            Function::Exp => growing(f64::exp, x, [f64::NEG_INFINITY, f64::INFINITY]),
            Function::Ln => growing(f64::ln, x, [0.0, f64::INFINITY]),
            Function::Abs => Rounded { value: x.value.abs(), error: x.error },
            Function::Sign => {
                let error = if x.value.abs() > x.error || x.error == 0.0 { 0.0 } else { 2.0 };
                let value = if x.value == 0.0 { 0.0 } else { x.value.signum() };
                Rounded { value, error }
            }
            Function::Atan2 => {
                let (y, x) = (x, other);
                let nearest = y.value.hypot(x.value) - y.error.hypot(x.error);
                let error = match nearest > 0.0 {
                    true => (x.value.abs() * y.error + y.value.abs() * x.error + y.error * x.error) / nearest.powi(2),
                    false => std::f64::consts::PI,
                };
                Rounded::of(y.value.atan2(x.value), error, WHOLE)
            }
        }
    }
}

/// Error of a sine or cosine with this `slope`.
fn swing(x: Rounded, slope: f64) -> f64 {
    (slope.abs() * x.error + x.error * x.error / 2.0).min(x.error).min(2.0)
}

/// A function that grows, or falls, everywhere from `domain[0]` to `domain[1]`: its largest change is at one end of
/// what is known of its argument. An argument beyond the domain by less than its error is taken to its end.
fn growing(function: impl Fn(f64) -> f64, x: Rounded, domain: [f64; 2]) -> Rounded {
    let at = |value: f64| function(value.clamp(domain[0], domain[1]));
    let is_near = x.value + x.error >= domain[0] && x.value - x.error <= domain[1];
    let value = if is_near { at(x.value) } else { function(x.value) };
    if x.error == 0.0 {
        return Rounded::of(value, 0.0, WHOLE);
    }
    // A NaN stays one: larger() would lose it.
    let [below, above] = [at(x.value - x.error) - value, at(x.value + x.error) - value].map(f64::abs);
    let error = if below >= above { below } else { above };
    Rounded::of(value, error, WHOLE)
}

fn power(a: Rounded, b: Rounded) -> Rounded {
    let value = match b.value {
        2.0 => a.value * a.value,
        whole if whole.fract() == 0.0 && whole.abs() <= 64.0 && b.error == 0.0 => a.value.powi(whole as i32),
        other => {
            // A base below zero by less than its error stands for zero.
            let base = if a.value < 0.0 && a.value + a.error >= 0.0 { 0.0 } else { a.value };
            base.powf(other)
        }
    };
    // Products of many factors round at every one.
    let rounding = WHOLE * (1.0 + b.value.abs().min(64.0));
    let is_whole = b.value.fract() == 0.0 && b.error == 0.0;
    if a.error == 0.0 && b.error == 0.0 {
        return Rounded::of(value, 0.0, rounding);
    }
    let at = |base: f64, exponent: f64| if is_whole { base.powf(exponent) } else { base.max(0.0).powf(exponent) };
    let ends = [a.value - a.error, a.value + a.error];
    let exponents = [b.value - b.error, b.value + b.error];
    let corners = ends.iter().flat_map(|&base| exponents.map(|exponent| (at(base, exponent) - value).abs()));
    let mut error = 0.0;
    for corner in corners {
        if !(corner <= error) {
            error = corner;
        }
    }
    // An even power has its extreme at zero; a negative one has a pole there.
    if ends[0] < 0.0 && ends[1] > 0.0 {
        error = if b.value < 0.0 { f64::INFINITY } else { error.max(value.abs()) };
    }
    Rounded::of(value, error, rounding)
}
