//! Panics that are caught on purpose say nothing on the terminal: what they say becomes an error's message.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;
use std::thread;

thread_local! {
    /// Whether this thread is inside [`quietly`].
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// Runs `action` and catches its panic, which the process's panic hook does not see. Installs, once, a hook that passes on all other panics to the
/// hook that was there before.
pub(super) fn quietly<R>(action: impl FnOnce() -> R) -> thread::Result<R> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let previous = take_hook();
        set_hook(Box::new(move |info| {
            if !QUIET.get() {
                previous(info);
            }
        }));
    });
    let before = QUIET.replace(true);
    let outcome = catch_unwind(AssertUnwindSafe(action));
    QUIET.set(before);
    outcome
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Command;
    use std::sync::atomic::{AtomicUsize, Ordering};

    const ALONE: &str = "LINKPROOF_TEST_OF_THE_PANIC_HOOK";

    /// Hooks belong to the process: the test runs again in one of its own.
    #[test]
    fn only_panics_inside_are_kept_from_the_hook() {
        static HEARD: AtomicUsize = AtomicUsize::new(0);
        if std::env::var_os(ALONE).is_none() {
            let name = "engine::rapier::quiet::tests::only_panics_inside_are_kept_from_the_hook";
            let mut again = Command::new(std::env::current_exe().unwrap());
            let output = again.args(["--exact", name]).env(ALONE, "").output().unwrap();
            assert!(output.status.success(), "{output:?}");
            return;
        }
        set_hook(Box::new(|_| {
            HEARD.fetch_add(1, Ordering::SeqCst);
        }));
        let cause = quietly(|| panic!("inside")).unwrap_err();
        assert_eq!(cause.downcast_ref(), Some(&"inside"));
        assert_eq!(quietly(|| 2).unwrap(), 2);
        assert_eq!(HEARD.load(Ordering::SeqCst), 0);
        thread::spawn(|| panic!("outside")).join().unwrap_err();
        catch_unwind(|| panic!("outside")).unwrap_err();
        assert_eq!(HEARD.load(Ordering::SeqCst), 2);
    }
}
