//! Processes several files in parallel.
//! The results have the order of the files, whatever the number of threads.

use crate::sentences;
use std::any::Any;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use linkage::error::{Error, ErrorKind, Result};
use linkage::quiet::panic_text;

/// The memory that all items in progress share.
/// An item keeps its reserved memory until its result has been passed on.
pub(super) struct Room {
    most: f64,
    held: Mutex<Held>,
    freed: Condvar,
}

/// The index of the next item, and the memory reserved by each item.
#[derive(Debug, Default)]
struct Held {
    next: usize,
    bytes: f64,
    shares: BTreeMap<usize, f64>,
}

impl Room {
    fn of(most: f64) -> Self {
        Room { most, held: Mutex::new(Held::default()), freed: Condvar::new() }
    }

    fn lock(&self) -> MutexGuard<'_, Held> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until item `index` may reserve `bytes`.
    /// Items reserve memory in their order.
    /// If no item other than this one has reserved memory, this item always gets its memory.
    /// The earliest item without a result therefore never waits for memory that a later item holds.
    /// `tell` is called when the item's memory has been reserved.
    pub(super) fn take(&self, index: usize, bytes: f64, tell: impl FnOnce()) {
        let full = |held: &mut Held| held.next != index || (held.bytes > 0.0 && held.bytes + bytes > self.most);
        let mut held = self.freed.wait_while(self.lock(), full).unwrap_or_else(PoisonError::into_inner);
        tell();
        held.next += 1;
        held.bytes += bytes;
        held.shares.insert(index, bytes);
        self.freed.notify_all();
    }

    /// Frees the memory that an item has reserved, if any.
    fn give_back(&self, index: usize) {
        let mut held = self.lock();
        held.shares.remove(&index);
        // The sum is computed anew, so that no rounding error accumulates.
        held.bytes = held.shares.values().sum();
        self.freed.notify_all();
    }

    /// Lets later items continue if item `index` ends before it has reserved memory.
    fn pass(&self, index: usize) {
        let mut held =
            self.freed.wait_while(self.lock(), |held| held.next < index).unwrap_or_else(PoisonError::into_inner);
        if held.next == index {
            held.next += 1;
        }
        self.freed.notify_all();
    }
}

/// Does `work` on all items, on `threads` threads, with `most` bytes of memory for all items in progress.
/// `give` receives the results in the order of the items.
/// `give` receives each result as soon as all earlier results are available.
/// If `work` panics, the result is an error.
///
/// `work` gets the index of its item, and the [`Room`] in which it reserves memory once, before it allocates.
/// With one thread, the next item begins after the previous result has been passed on.
pub(super) fn side_by_side<T, R: Send>(
    items: &[T],
    threads: usize,
    most: f64,
    work: impl Fn(usize, &T, &Room) -> Result<R> + Sync,
    mut give: impl FnMut(usize, &T, Result<R>),
) where
    T: Sync,
{
    let room = Room::of(most);
    let done = |index: usize| {
        let result = catch_unwind(AssertUnwindSafe(|| work(index, &items[index], &room)));
        room.pass(index);
        result.unwrap_or_else(|panic| Err(panicked(panic.as_ref())))
    };
    let mut waiting = BTreeMap::new();
    let mut due = 0;
    linkage::threads::side_by_side(
        items.len(),
        threads,
        |index, tell| tell(done(index)),
        |index, result| {
            waiting.insert(index, result);
            while let Some(result) = waiting.remove(&due) {
                give(due, &items[due], result);
                room.give_back(due);
                due += 1;
            }
            ControlFlow::Continue(())
        },
    );
}

/// A panic as an error; its location is already on standard error.
fn panicked(panic: &(dyn Any + Send)) -> Error {
    let message = sentences::this_is_a_fault_of_the_program(&panic_text(panic).unwrap_or("it panicked"));
    Error::new(ErrorKind::Numeric, message).help(sentences::REPORT_IT_WITH_THE_SCENARIO)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    fn results(threads: usize, most: f64, work: impl Fn(usize, &Room) -> Result<usize> + Sync) -> Vec<Result<usize>> {
        let items = [(); 20];
        let mut given = Vec::new();
        let work = |index: usize, (): &(), room: &Room| work(index, room);
        side_by_side(&items, threads, most, work, |index, (), result| {
            assert_eq!(index, given.len(), "in the order of the items");
            given.push(result);
        });
        assert_eq!(given.len(), items.len());
        given
    }

    #[test]
    fn results_are_in_order_for_any_number_of_threads() {
        for threads in [1, 2, 7, 100] {
            let squares = results(threads, 1.0, |index, room| {
                // In this test, the first items need the longest time.
                std::thread::sleep(Duration::from_millis(20 - index as u64));
                room.take(index, 0.0, || {});
                Ok(index * index)
            });
            let squares: Vec<usize> = squares.into_iter().map(|square| square.unwrap()).collect();
            assert_eq!(squares, (0..20).map(|index| index * index).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_panic_fails_only_its_item() {
        let given = results(3, 1.0, |index, room| {
            assert!(index != 4, "item four");
            room.take(index, 1.0, || {});
            assert!(index != 7, "item seven");
            if index == 9 { Err(Error::new(ErrorKind::Input, "item nine")) } else { Ok(index) }
        });
        for (index, result) in given.iter().enumerate() {
            match index {
                4 | 7 | 9 => assert!(result.as_ref().unwrap_err().message().contains("item "), "{index}"),
                _ => assert!(result.is_ok(), "{index}"),
            }
        }
    }

    #[test]
    fn jobs_share_the_memory_and_an_oversized_job_runs_alone() {
        let taken = AtomicUsize::new(0);
        let given = results(6, 100.0, |index, room| {
            let own = if index == 11 { 500 } else { 10 * (index % 5) };
            room.take(index, own as f64, || {});
            let all = taken.fetch_add(own, Ordering::SeqCst) + own;
            assert!(all <= 100 || all == 500, "{all}");
            std::thread::sleep(Duration::from_millis(2));
            taken.fetch_sub(own, Ordering::SeqCst);
            Ok(index)
        });
        assert!(given.iter().all(Result::is_ok), "{given:?}");
    }
}
