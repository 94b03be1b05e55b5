//! Many numbered inputs, tried side by side.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Time after which an input is named that has not ended, many times what the slowest one takes. A clock proves nothing
/// on a busy machine: that all end is what a test shows by ending.
const PATIENCE: Duration = Duration::from_secs(300);

/// What the environment says is the number of something.
pub fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Counts down when a thread ends, also by a panic: who watches over it ends too.
struct Leaves<'a>(&'a AtomicUsize);

impl Drop for Leaves<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// What `work` finds out about each of `count` inputs from the number `from` on, in their order.
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
        // One that does not end is named before whoever runs the tests stops them.
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
