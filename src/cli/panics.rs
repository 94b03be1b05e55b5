//! The panic hook of the process.
//! A panic that is caught and becomes an error prints nothing on the terminal.

use std::panic::{set_hook, take_hook};

/// Sets a hook that forwards every panic to the present hook, except panics for which `is_caught` returns true.
/// Call it once, at the start of the process.
/// The hook, and therefore `is_caught`, runs on the thread that panics.
pub(super) fn silence(is_caught: fn() -> bool) {
    let previous = take_hook();
    set_hook(Box::new(move |info| {
        if !is_caught() {
            previous(info);
        }
    }));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;
    use std::panic::catch_unwind;
    use std::process::Command;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::thread;

    const ALONE: &str = "LINKPROOF_TEST_OF_THE_SILENCED_HOOK";
    const NAME: &str = "cli::panics::tests::only_caught_panics_bypass_the_hook";

    thread_local! {
        static CAUGHT: Cell<bool> = const { Cell::new(false) };
    }

    /// A hook applies to the whole process, so the test runs again in a separate process.
    #[test]
    fn only_caught_panics_bypass_the_hook() {
        static HEARD: AtomicUsize = AtomicUsize::new(0);
        if std::env::var_os(ALONE).is_none() {
            let mut again = Command::new(std::env::current_exe().unwrap());
            let output = again.args(["--exact", NAME]).env(ALONE, "").output().unwrap();
            let told = String::from_utf8_lossy(&output.stdout).into_owned();
            assert!(output.status.success() && told.contains("1 passed"), "{output:?}");
            return;
        }
        set_hook(Box::new(|_| {
            HEARD.fetch_add(1, Ordering::SeqCst);
        }));
        silence(|| CAUGHT.get());
        CAUGHT.set(true);
        catch_unwind(|| panic!("inside")).unwrap_err();
        assert_eq!(HEARD.load(Ordering::SeqCst), 0);
        thread::spawn(|| panic!("outside")).join().unwrap_err();
        CAUGHT.set(false);
        catch_unwind(|| panic!("outside")).unwrap_err();
        assert_eq!(HEARD.load(Ordering::SeqCst), 2);
    }
}
