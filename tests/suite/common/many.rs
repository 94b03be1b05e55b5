//! Many numbered inputs, tried in parallel.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// If an input takes longer than this time, the test prints the number of the input.
/// Even the slowest input takes only a small fraction of this limit.
/// The test does not fail at this limit, because any input may be slow on a busy machine.
/// Termination is proven when the test ends.
const PATIENCE: Duration = Duration::from_secs(300);

/// The environment variable `name` as a number.
pub fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Counts down when a thread ends, even by a panic; the monitoring thread ends when the count is zero.
struct Leaves<'a>(&'a AtomicUsize);

impl Drop for Leaves<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Results of `work` for `count` inputs, numbered from `from`, in order.
pub fn each<T: Send>(from: u64, count: u64, work: impl Fn(u64) -> T + Sync) -> Vec<(u64, T)> {
    let next = AtomicU64::new(from);
    let found: Mutex<BTreeMap<u64, T>> = Mutex::default();
    let busy: Mutex<BTreeMap<u64, Instant>> = Mutex::default();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let at_work = AtomicUsize::new(threads);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let _leaves = Leaves(&at_work);
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= from + count {
                        return;
                    }
                    busy.lock().unwrap().insert(index, Instant::now());
                    let own = work(index);
                    busy.lock().unwrap().remove(&index);
                    found.lock().unwrap().insert(index, own);
                }
            });
        }
        // Prints the number of an input that does not end, before the user stops the tests.
        scope.spawn(|| {
            while at_work.load(Ordering::Relaxed) > 0 {
                std::thread::sleep(Duration::from_millis(200));
                for (index, since) in busy.lock().unwrap().iter_mut().filter(|(_, since)| since.elapsed() > PATIENCE) {
                    eprintln!("number {index} has not ended after {PATIENCE:?}");
                    *since = Instant::now();
                }
            }
        });
    });
    found.into_inner().unwrap().into_iter().collect()
}
