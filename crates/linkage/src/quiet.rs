//! Catches panics inside an engine or a file reader and turns them into the message of an error.
//! The panic hook is global to the process, so this library sets no hook.
//! The program's panic hook can call `is_guarded` to find out whether a panic will become an error.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread;

thread_local! {
    /// Whether this thread is inside [`guarded`].
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Whether the current thread is inside a call of [`guarded`], for example a step of the engine. A panic inside such a
/// call is caught and becomes an error.
///
/// The panic hook of a program may call this function, and print nothing if the result is true: the error contains the
/// panic's message.
/// The hook runs on the thread that panics, before the panic is caught.
/// This crate sets no hook.
#[must_use]
pub fn is_guarded() -> bool {
    GUARDED.get()
}

/// Runs `action` and catches its panic. During the call [`is_guarded`] is true.
///
/// # Errors
/// The payload of the panic, as in [`catch_unwind`].
pub fn guarded<R>(action: impl FnOnce() -> R) -> thread::Result<R> {
    let before = GUARDED.replace(true);
    let outcome = catch_unwind(AssertUnwindSafe(action));
    GUARDED.set(before);
    outcome
}

/// The message of a caught panic; `None` if its payload is not a text.
#[must_use]
pub fn panic_text(panic: &(dyn Any + Send)) -> Option<&str> {
    panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::set_hook;
    use std::process::Command;
    use std::sync::atomic::{AtomicUsize, Ordering};

    const ALONE: &str = "LINKPROOF_TEST_OF_THE_PANIC_HOOK";
    const NAME: &str = "quiet::tests::the_panic_hook_is_unchanged_and_recognises_caught_panics";

    /// Panic hooks are global to the process. The test therefore starts itself again in a separate process.
    #[test]
    fn the_panic_hook_is_unchanged_and_recognises_caught_panics() {
        static HEARD: AtomicUsize = AtomicUsize::new(0);
        static CAUGHT: AtomicUsize = AtomicUsize::new(0);
        if std::env::var_os(ALONE).is_none() {
            let mut again = Command::new(std::env::current_exe().unwrap());
            let output = again.args(["--exact", NAME]).env(ALONE, "").output().unwrap();
            let told = String::from_utf8_lossy(&output.stdout).into_owned();
            assert!(output.status.success() && told.contains("1 passed"), "{output:?}");
            return;
        }
        set_hook(Box::new(|_| {
            HEARD.fetch_add(1, Ordering::SeqCst);
            CAUGHT.fetch_add(usize::from(is_guarded()), Ordering::SeqCst);
        }));
        let cause = guarded(|| panic!("inside")).unwrap_err();
        assert_eq!(cause.downcast_ref(), Some(&"inside"));
        assert!(!is_guarded());
        assert!(guarded(is_guarded).unwrap());
        // The hook set by this test is still active. The hook was called for one panic, and `is_guarded` was true in
        // this call.
        assert_eq!((HEARD.load(Ordering::SeqCst), CAUGHT.load(Ordering::SeqCst)), (1, 1));
        // The guard applies to one thread only, so the panic of a spawned thread counts as not caught.
        let outside = guarded(|| thread::spawn(|| panic!("outside")).join()).unwrap();
        outside.unwrap_err();
        catch_unwind(|| panic!("outside")).unwrap_err();
        assert_eq!((HEARD.load(Ordering::SeqCst), CAUGHT.load(Ordering::SeqCst)), (3, 1));
    }
}
