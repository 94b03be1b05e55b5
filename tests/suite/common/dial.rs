//! One factor scales every bound of the tests: `LINKPROOF_TOLERANCE_SCALE=0.1 cargo test --release --test suite`.
//!
//! With the factor zero, no bound fails.
//! Instead, a test prints each residual that uses more of its bound than any earlier residual at the same line of code.
//! Printing requires `-- --nocapture`.
//! The last residual printed for a line of code is therefore the worst one at this line.

use std::panic::Location;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// Asserts that a residual is at most its bound times the factor; NaN fails.
/// A message may follow, as in `assert!`.
macro_rules! assert_within {
    ($value:expr, $bound:expr $(,)?) => {
        $crate::common::assert_within!($value, $bound, "{}", stringify!($value))
    };
    ($value:expr, $bound:expr, $($message:tt)+) => {{
        static WORST: std::sync::atomic::AtomicU64 = std::sync::atomic::AtomicU64::new(0);
        $crate::common::dial::judge(&WORST, $value, $bound, || format!($($message)+));
    }};
}
pub(crate) use assert_within;

/// The factor: 1 unless the environment states a different factor.
fn scale() -> f64 {
    static SCALE: LazyLock<f64> = LazyLock::new(|| match std::env::var("LINKPROOF_TOLERANCE_SCALE") {
        Ok(text) => {
            text.parse().ok().filter(|scale| *scale >= 0.0).expect("LINKPROOF_TOLERANCE_SCALE is a number >= 0")
        }
        Err(_) => 1.0,
    });
    *SCALE
}

/// Whether a residual is at most its bound times the factor; always true with the factor zero.
pub fn accepts(value: f64, bound: f64) -> bool {
    scale() == 0.0 || value <= scale() * bound
}

/// Implementation of [`assert_within`].
/// `worst` stores the largest ratio of residual to bound at the calling line, as the bit pattern of a double.
/// The bit patterns of non-negative doubles have the same order as the doubles, and the bit pattern of NaN is the
/// largest.
#[track_caller]
pub fn judge(worst: &AtomicU64, value: f64, bound: f64, what: impl FnOnce() -> String) {
    if scale() > 0.0 {
        assert!(accepts(value, bound), "{value:e} is beyond {bound:e}, scaled by {}: {}", scale(), what());
        return;
    }
    let share = if value == 0.0 { 0.0 } else { (value / bound).abs() };
    if share.to_bits() > worst.fetch_max(share.to_bits(), Ordering::Relaxed) {
        println!("{}: {value:.3e} of {bound:.3e}, {}", Location::caller(), what());
    }
}
