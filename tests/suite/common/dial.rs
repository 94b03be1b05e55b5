//! One dial scales every bound of the tests: `LINKPROOF_TOLERANCE_SCALE=0.1 cargo test --release --test suite`.
//!
//! At zero no bound fails. Instead every residual that uses more of its bound than any before it at the same place is printed beside it (with
//! `-- --nocapture`), so that the last line of a place is its worst.

use std::panic::Location;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// Asserts that a residual is at most its bound, by the dial; NaN fails. What follows is a message as in `assert!`.
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

/// The dial: 1 unless the environment says otherwise.
fn scale() -> f64 {
    static SCALE: LazyLock<f64> = LazyLock::new(|| match std::env::var("LINKPROOF_TOLERANCE_SCALE") {
        Ok(text) => {
            text.parse().ok().filter(|scale| *scale >= 0.0).expect("LINKPROOF_TOLERANCE_SCALE is a number >= 0")
        }
        Err(_) => 1.0,
    });
    *SCALE
}

/// Whether a residual is within its bound, by the dial.
pub fn accepts(value: f64, bound: f64) -> bool {
    scale() == 0.0 || value <= scale() * bound
}

/// What [`assert_within`] does. `worst` keeps the largest share of the bound seen at the place of the call, as bits: those of numbers that are
/// not negative stand in their order, and NaN above them all.
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
