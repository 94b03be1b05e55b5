//! Times of repeated work.

use std::hint::black_box;
use std::time::Instant;

use linkage::math::KeepNan;

/// Shortest time (s) of several runs of `work`. Other activity of the machine only adds time.
pub fn shortest<T>(repeats: usize, mut work: impl FnMut() -> T) -> f64 {
    let time = |_| {
        let since = Instant::now();
        let _found = black_box(work());
        since.elapsed().as_secs_f64()
    };
    (0..repeats).map(time).fold(f64::INFINITY, f64::smaller)
}
