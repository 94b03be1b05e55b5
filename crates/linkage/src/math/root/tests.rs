use std::convert::Infallible;

use proptest::prelude::*;

use super::*;
use crate::math::KeepNan;

/// The result of a search whose function cannot fail.
fn sure<T>(answer: Result<T, Infallible>) -> T {
    let Ok(found) = answer;
    found
}

const EXACT: Close = Close { value: 0.0, width: 0.0 };

#[test]
fn a_sign_change_includes_zero_but_not_nan() {
    assert!(changes(-1.0, 2.0) && changes(2.0, -1.0) && changes(0.0, 1.0) && changes(-1.0, 0.0) && changes(0.0, 0.0));
    // The product of the two values would underflow to zero, so a test of the product's sign would fail.
    assert!(!changes(1e-200, 1e-200) && !changes(-1e-200, -1e-200));
    assert!(!changes(f64::NAN, 1.0) && !changes(-1.0, f64::NAN) && !changes(f64::NAN, 0.0));
}

#[test]
fn bisection_without_a_change_returns_an_end() {
    let ends = |before: bool| sure(halved([1.0, 2.0], 60, |_| Ok(before)));
    assert_eq!((ends(true), ends(false)), ([2.0; 2], [1.0; 2]));
    assert_eq!(
        halved([0.0, 1.0], 3, |x| if x < 0.3 { Err("cannot be reached") } else { Ok(false) }),
        Err("cannot be reached")
    );
    assert_eq!(sure(halved([0.0, 1.0], 0, |_| Ok(true))), [0.0, 1.0]);
}

#[test]
fn a_sign_change_is_sought_in_either_direction() {
    let f = |x: f64| Ok::<f64, Infallible>(x * x - 9.0);
    assert_eq!(sure(widened((0.0, -9.0), 1.0, 100.0, f)), Some([(2.0, -5.0), (4.0, 7.0)]));
    assert_eq!(sure(widened((0.0, -9.0), -1.0, 100.0, f)), Some([(-2.0, -5.0), (-4.0, 7.0)]));
    assert_eq!(sure(widened((0.0, -9.0), 1.0, 3.9, f)), None);
    assert_eq!(sure(widened((0.0, -9.0), 0.0, 100.0, f)), None);
    assert_eq!(sure(widened((0.0, -9.0), f64::NAN, 100.0, f)), None);
    assert_eq!(sure(widened((0.0, -1.0), 1.0, 100.0, |_| Ok(f64::NAN))), None);
    assert_eq!(widened((0.0, -9.0), 1.0, 100.0, |_| Err("fails")), Err("fails"));
}

#[test]
fn regula_falsi_needs_a_sign_change() {
    let f = |x: f64| Ok::<f64, Infallible>(x - 0.3);
    assert_eq!(sure(regula_falsi([(1.0, 0.7), (2.0, 1.7)], EXACT, 60, f)), None);
    assert_eq!(sure(regula_falsi([(1.0, f64::NAN), (2.0, 1.7)], EXACT, 60, f)), None);
    assert_eq!(sure(regula_falsi([(0.0, -0.3), (2.0, 1.7)], EXACT, 60, |_| Ok(f64::NAN))), None);
    assert_eq!(sure(regula_falsi([(0.3, 0.0), (2.0, 1.7)], EXACT, 60, |_| panic!("known"))), Some(0.3));
    assert_eq!(sure(regula_falsi([(0.0, -1.0), (2.0, 7.0)], EXACT, 1, |x| Ok(x * x * x - 1.0))), None);
    assert_eq!(regula_falsi([(0.0, -0.3), (2.0, 1.7)], EXACT, 60, |_| Err("fails")), Err("fails"));
}

/// Checks that the value at an unmoved bound is halved.
/// Without halving, one bound would never move, and the search would need 1000 steps or more.
#[test]
fn regula_falsi_moves_both_ends_of_the_bracket() {
    let mut steps = 0;
    let f = |x: f64| x.powi(9) - 1e-3;
    let found = regula_falsi([(0.0, f(0.0)), (2.0, f(2.0))], EXACT, 100, |x| {
        steps += 1;
        Ok::<f64, Infallible>(f(x))
    });
    assert!((sure(found).unwrap() - 1e-3f64.powf(1.0 / 9.0)).abs() < 1e-15 && steps < 50, "{found:?} {steps}");
}

#[test]
fn newton_stays_within_its_bounds() {
    // From 0.1, Newton's method on atan(20 x) goes to -0.18, then to 0.7, and then diverges.
    let steep = |x: f64| Ok::<_, Infallible>(((20.0 * x).atan(), 20.0 / (1.0 + 400.0 * x * x)));
    for (bounds, rises) in [([-0.3, 0.1], true), ([0.1, -0.3], false)] {
        assert!(sure(newton(bounds, rises, 0.1, 1e-9, steep)).unwrap().abs() < f64::EPSILON);
    }
    // The function reports a slope of zero, so only bisection can find the zero.
    let flat = |x: f64| Ok::<_, Infallible>((x - 0.3, 0.0));
    assert!((sure(newton([0.0, 1.0], true, 0.5, 1e-9, flat)).unwrap() - 0.3).abs() < 1e-15);
    let touched = |x: f64| Ok::<_, Infallible>(((x - 0.5).powi(3), 3.0 * (x - 0.5).powi(2)));
    assert_eq!(sure(newton([0.0, 1.0], true, 0.5, 1e-9, touched)), Some(0.5));
    assert_eq!(sure(newton([0.0, 1.0], true, 0.5, 1e-9, |_| Ok((f64::NAN, 1.0)))), None);
    assert_eq!(newton([0.0, 1.0], true, 0.5, 1e-9, |_| Err("ends")), Err("ends"));
}

#[test]
fn polishing_rejects_long_steps() {
    let f = |x: f64| Ok::<_, Infallible>((x * x - 2.0, 2.0 * x));
    assert!((sure(polished(1.4, 4, f64::INFINITY, f)) - 2f64.sqrt()).abs() < 1e-15);
    assert_eq!(sure(polished(1.4, 4, 1e-3, f)), 1.4);
    assert_eq!(sure(polished(1.4, 4, 1.0, |_| Ok((0.0, 0.0)))), 1.4);
    assert_eq!(polished(1.4, 4, 1.0, |_| Err("fails")), Err("fails"));
}

#[test]
fn the_secant_method_keeps_lengths_positive() {
    let mut asked = 0;
    let found = secants((2.0, 2f64.exp() - 3.0), 1.0, 10, |x: f64| {
        asked += 1;
        Ok::<f64, Infallible>(x.exp() - 3.0)
    });
    assert!((sure(found) - 3f64.ln()).abs() < 1e-15 && asked < 9, "{found:?} {asked}");
    // The line through (2, 3) and (1, 2) crosses zero at the length -1, so the search must keep the guess 1.
    assert_eq!(sure(secants((2.0, 3.0), 1.0, 6, |_| Ok(2.0))), 1.0);
    assert_eq!(sure(secants((2.0, 3.0), 1.0, 6, |_| Ok(f64::NAN))), 1.0);
    assert_eq!(secants((2.0, 3.0), 1.0, 6, |_| Err("fails")), Err("fails"));
}

/// Close to the zero, values differ only by rounding errors, and the secant through two such values is arbitrary.
#[test]
fn the_secant_method_stops_at_rounding() {
    let mut asked = 0.0;
    let found = secants((2.0, 2f64.exp() - 3.0), 1.0, 20, |x: f64| {
        asked += 1.0;
        let value = x.exp() - 3.0;
        Ok::<f64, Infallible>(if value.abs() < 1e-10 { 1e-13 * (1.0 + 1e-9 * asked) } else { value })
    });
    assert!((sure(found) - 3f64.ln()).abs() < 1e-10, "{found:?}");
}

/// A cubic that rises everywhere and is zero at `zero`. Returns value and slope.
fn cubic(zero: f64, a: f64, b: f64) -> impl Fn(f64) -> (f64, f64) {
    move |x: f64| {
        let d = x - zero;
        (a * d * d * d + b * d, 3.0 * a * d * d + b)
    }
}

proptest! {
    /// All methods find the same zero up to rounding error, for a rising and for a falling function.
    #[test]
    fn every_method_finds_the_zero(zero in -5.0f64..5.0, below in 0.01f64..10.0, above in 0.01f64..10.0, a in 0.0f64..10.0, b in 0.1f64..10.0,
        falls in any::<bool>()) {
        let sign = if falls { -1.0 } else { 1.0 };
        let f = |x: f64| { let (value, slope) = cubic(zero, a, b)(x); (sign * value, sign * slope) };
        let (low, high) = (zero - below, zero + above);
        let near = |x: f64| (x - zero).abs() <= 4.0 * f64::EPSILON * low.abs().larger(high.abs());
        let [under, over] = sure(halved([low, high], 60, |x| Ok((f(x).0 > 0.0) == falls)));
        prop_assert!(near(under) && near(over) && under <= over, "{under} {over}");
        let ends = [low, high].map(|x| (x, f(x).0));
        for ends in [ends, [ends[1], ends[0]]] {
            let found = sure(regula_falsi(ends, EXACT, 100, |x| Ok(f(x).0)));
            prop_assert!(found.is_some_and(near), "{found:?}");
            let found = sure(newton(ends.map(|end| end.0), ends[1].1 > 0.0, ends[0].0, 1e-9, |x| Ok(f(x))));
            prop_assert!(found.is_some_and(near), "{found:?}");
        }
        let polish = sure(polished(zero + 1e-3, 5, 1e-2, |x| Ok(f(x))));
        prop_assert!(near(polish) || a * 1e-4 > b, "{polish}");
        // The search starts at one end and moves towards the zero. The zero may be far away.
        let wide = sure(widened(ends[0], 1e-3, 100.0, |x| Ok(f(x).0))).unwrap();
        prop_assert!(wide[0].0 <= zero && zero <= wide[1].0 && changes(wide[0].1, wide[1].1));
        let of_length = |length: f64| f(low + length).0;
        let known = 1.1 * below;
        let length = sure(secants((known, of_length(known)), 1.05 * below, 12, |length| Ok(of_length(length))));
        prop_assert!((length - below).abs() <= 16.0 * f64::EPSILON * low.abs().larger(high.abs()), "{length} {below}");
    }

    /// The error stays within the requested tolerance, and the search makes no unnecessary steps.
    #[test]
    fn regula_falsi_stops_at_the_requested_tolerance(zero in -1.0f64..1.0, tolerance in 1e-9f64..1e-2) {
        let f = |x: f64| (x - zero).exp() - 1.0;
        let ends = [-2.0, 2.0].map(|x| (x, f(x)));
        let by_value = sure(regula_falsi(ends, Close { value: tolerance, width: 0.0 }, 100, |x| Ok(f(x)))).unwrap();
        prop_assert!(f(by_value).abs() <= tolerance);
        let mut steps = 0;
        let by_width = regula_falsi(ends, Close { value: 0.0, width: tolerance }, 100, |x| { steps += 1; Ok(f(x)) });
        prop_assert!((sure(by_width).unwrap() - zero).abs() <= tolerance && steps < 30, "{steps}");
    }
}
