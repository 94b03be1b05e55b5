//! Runs work on several items in parallel. Results do not depend on the number of threads.

use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use crate::work;

/// Number of cores of this machine; 1 if it is unknown.
#[must_use]
pub fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// Calls `work` for every index below `count`, on at most `threads` threads. Each thread takes the next free index.
/// `work` may send any number of messages.
/// The calling thread passes each message to `hear`, with the index of the work that sent it.
/// After `hear` returns a break, no work is started for further indices.
/// The [counts](work) of the work done on the threads are added to the counts of the calling thread.
///
/// If `threads` is at most 1, or if the system cannot start any thread, the calling thread does all the work.
///
/// # Panics
/// If `work` panics. The other threads finish their work before the panic is passed on.
pub fn side_by_side<M: Send>(
    count: usize,
    threads: usize,
    work: impl Fn(usize, &mut dyn FnMut(M)) + Sync,
    mut hear: impl FnMut(usize, M) -> ControlFlow<()>,
) {
    let next = AtomicUsize::new(0);
    let take = |tell: &mut dyn FnMut(usize, M)| {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return;
            }
            work(index, &mut |message| tell(index, message));
        }
    };
    let mut heard = |index: usize, message: M| {
        let go_on = hear(index, message);
        if go_on.is_break() {
            next.store(count, Ordering::Relaxed);
        }
        go_on
    };
    let threads = if threads.min(count) > 1 { threads.min(count) } else { 0 };
    thread::scope(|scope| {
        let (tell, told) = mpsc::channel();
        let start = |_| {
            let tell = tell.clone();
            // After `hear` returns a break, the channel has no receiver, so a failed send is ignored.
            let all = || take(&mut move |index, message| drop(tell.send((index, message))));
            thread::Builder::new().spawn_scoped(scope, || work::counted(all).1).ok()
        };
        let started: Vec<_> = (0..threads).filter_map(start).collect();
        drop(tell);
        let _ = told.into_iter().try_for_each(|(index, message)| heard(index, message));
        for thread in started {
            work::add(&thread.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
    });
    take(&mut |index, message| {
        let _ = heard(index, message);
    });
}

/// Calls `work` for all items on at most `threads` threads and returns the results in the order of the items.
/// `done` is called after each item, with the number of items finished so far.
///
/// # Panics
/// If `work` panics.
pub fn made<T: Sync, R: Send>(
    items: &[T],
    threads: usize,
    work: impl Fn(&T) -> R + Sync,
    mut done: impl FnMut(usize),
) -> Vec<R> {
    let mut made: Vec<Option<R>> = items.iter().map(|_| None).collect();
    let mut finished = 0;
    let work = |index: usize, tell: &mut dyn FnMut(R)| tell(work(&items[index]));
    side_by_side(items.len(), threads, work, |index, result| {
        made[index] = Some(result);
        finished += 1;
        done(finished);
        ControlFlow::Continue(())
    });
    made.into_iter().map(|own| own.expect("all are done")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::work::{Count, WorkTally, counted};
    use std::time::Duration;

    #[test]
    fn results_are_ordered_and_work_counted_for_any_thread_count() {
        let items: Vec<u64> = (0..20).collect();
        for threads in [0, 1, 2, 7, 100] {
            let mut finished = Vec::new();
            let work = |&item: &u64| {
                // The first items take longest, so with several threads the items do not finish in order.
                thread::sleep(Duration::from_millis(20 - item));
                WorkTally::default().one(Count::Steps);
                item * item
            };
            let (squares, work) = counted(|| made(&items, threads, work, |count| finished.push(count)));
            assert_eq!(squares, items.iter().map(|item| item * item).collect::<Vec<_>>());
            assert_eq!(work.of(Count::Steps), 20, "{threads}");
            assert_eq!(finished, (1..=20).collect::<Vec<_>>());
        }
    }

    #[test]
    fn no_further_work_starts_after_a_break() {
        for threads in [1, 3] {
            let begun = AtomicUsize::new(0);
            let work = |index: usize, tell: &mut dyn FnMut(usize)| {
                begun.fetch_add(1, Ordering::Relaxed);
                thread::sleep(Duration::from_millis(5));
                tell(index);
            };
            let mut heard = 0;
            side_by_side(1000, threads, work, |_, _| {
                heard += 1;
                if heard == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            assert_eq!(heard, 2);
            assert!(begun.into_inner() < 500, "{threads}");
        }
    }

    #[test]
    fn a_panic_of_the_work_is_passed_on() {
        for threads in [1, 3] {
            let work = |&item: &u64| assert!(item != 4, "item four");
            let panic = std::panic::catch_unwind(|| made(&[1, 2, 3, 4, 5], threads, work, |_| {}));
            assert_eq!(panic.unwrap_err().downcast_ref::<&str>(), Some(&"item four"));
        }
    }
}
